"""Circuits that the examples are made of (`Modelica.Electrical.Analog.Examples.Utilities`)."""

from collections.abc import Iterator
from typing import Any

import acausal as ac

from .basic import Capacitor, Ground, Resistor
from .interfaces import OnePort, Pin
from .semiconductors import NMOS, NPN, PMOS

__all__ = ["Nand", "NonlinearResistor", "Transistor"]


class NonlinearResistor(OnePort):
    """Chua's resistor: ``i = Ga v`` for ``|v| < Ve``, beyond with the slope ``Gb``."""

    Ga = ac.Parameter(unit="S", doc="conductance at small voltages")
    Gb = ac.Parameter(unit="S", doc="conductance at large voltages")
    Ve = ac.Parameter(unit="V", doc="voltage at which the conductance changes")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        inner = ac.maximum(ac.minimum(self.v, self.Ve), -self.Ve)
        yield ac.Eq(self.i, self.Gb * (self.v - inner) + self.Ga * inner)


class Transistor(ac.Component):
    """An `NPN` transistor ``Tr`` with resistances before base and collector and a capacitor at the base."""

    c = Pin()
    b = Pin()
    e = Pin()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.rtb, self.rtc, self.ct = Resistor(R=0.05), Resistor(R=0.1), Capacitor(C=1e-10)
        self.Tr = NPN()
        self.Ground1 = Ground()
        self.connect(self.b, self.rtb.p)
        self.connect(self.rtb.n, self.Tr.B, self.ct.p)
        self.connect(self.ct.n, self.Ground1.p)
        self.connect(self.Tr.C, self.rtc.p)
        self.connect(self.rtc.n, self.c)
        self.connect(self.Tr.E, self.e)


class Nand(ac.Component):
    """CMOS gate: ``y`` is low where ``x1`` and ``x2`` are high. Tietze, Schenk: Halbleiter-Schaltungstechnik."""

    x1 = Pin()
    x2 = Pin()
    Vdd = Pin()
    y = Pin()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        shape = {"W": 6.5e-6, "L": 3.1e-6, "dW": -2.5e-6}
        p_type = {**shape, "Beta": 1.05e-5, "Vt": -1, "K2": 0.41, "K5": 0.8385, "dL": -2.1e-6}
        n_type = {**shape, "Beta": 4.1e-5, "Vt": 0.8, "K2": 1.144, "K5": 0.7311, "dL": -1.5e-6}
        self.TP1, self.TP2 = PMOS(**p_type), PMOS(**p_type)
        self.TN1, self.TN2 = NMOS(**n_type), NMOS(**n_type)
        self.C4, self.C7 = Capacitor(C=0.4e-13), Capacitor(C=0.4e-13)
        self.Gnd, self.Gnd2, self.Gnd3 = Ground(), Ground(), Ground()
        self.Gnd6, self.Gnd7, self.Gnd8 = Ground(), Ground(), Ground()
        self.connect(self.x1, self.TP2.G, self.TN2.G)
        self.connect(self.x2, self.TP1.G, self.TN1.G)
        self.connect(self.Vdd, self.TP1.D, self.TP2.D)
        self.connect(self.y, self.TP1.S, self.TP2.S, self.TN1.D, self.C4.p)
        self.connect(self.TN1.S, self.TN2.D, self.C7.p)
        self.connect(self.TN2.S, self.TN2.B, self.Gnd.p)
        self.connect(self.C4.n, self.Gnd2.p)
        self.connect(self.C7.n, self.Gnd3.p)
        self.connect(self.TP2.B, self.Gnd6.p)
        self.connect(self.TN1.B, self.Gnd7.p)
        self.connect(self.TP1.B, self.Gnd8.p)
