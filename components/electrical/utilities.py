"""Parts of the examples (`Modelica.Electrical.Analog.Examples.Utilities`): circuits, elements with signals for pins.

The latter couple circuits with other tools; each holds a ground.
"""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from . import basic
from .adaptors import GeneralCurrentToVoltageAdaptor, GeneralVoltageToCurrentAdaptor
from .bipolar import NPN
from .currents import SignalCurrent
from .interfaces import OnePort, Pin
from .mosfets import NMOS, PMOS
from .voltages import SignalVoltage

__modelica__ = "Modelica.Electrical.Analog.Examples.Utilities"


class NonlinearResistor(OnePort):
    """Chua's resistor: ``i = Ga v`` for ``|v| < Ve``, outside with the conductance ``Gb``."""

    ICON = icons.KNEE

    Ga = ac.Parameter(unit="S", doc="conductance at small voltages")
    Gb = ac.Parameter(unit="S", doc="conductance at large voltages")
    Ve = ac.Parameter(unit="V", doc="voltage at which the conductance changes")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        inner = ac.maximum(ac.minimum(self.v, self.Ve), -self.Ve)
        yield ac.Eq(self.i, self.Gb * (self.v - inner) + self.Ga * inner)


class Transistor(ac.Component):
    """An `NPN` transistor ``Tr`` with resistances before base and collector and a capacitor at the base."""

    ICON = icons.boxed(icons.NPN)

    c = Pin()
    b = Pin()
    e = Pin()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.rtb, self.rtc, self.ct = (
            basic.Resistor(R=0.05),
            basic.Resistor(R=0.1),
            basic.Capacitor(C=1e-10),
        )
        self.Tr = NPN()
        self.Ground1 = basic.Ground()
        self.connect(self.b, self.rtb.p)
        self.connect(self.rtb.n, self.Tr.B, self.ct.p)
        self.connect(self.ct.n, self.Ground1.p)
        self.connect(self.Tr.C, self.rtc.p)
        self.connect(self.rtc.n, self.c)
        self.connect(self.Tr.E, self.e)


class Nand(ac.Component):
    """CMOS gate: ``y`` is low where ``x1`` and ``x2`` are high. Tietze, Schenk: Halbleiter-Schaltungstechnik."""

    ICON = icons.block("&")

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
        self.C4, self.C7 = basic.Capacitor(C=0.4e-13), basic.Capacitor(C=0.4e-13)
        self.Gnd, self.Gnd2, self.Gnd3 = basic.Ground(), basic.Ground(), basic.Ground()
        self.Gnd6, self.Gnd7, self.Gnd8 = basic.Ground(), basic.Ground(), basic.Ground()
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


class DirectCapacitor(ac.Component):
    """A capacitor driven by ``iDrive`` that gives its voltage and takes the current ``i``."""

    ICON = icons.boxed(icons.CAPACITOR, "i → v")

    C = ac.Parameter(1.0, unit="F", min=0, doc="capacitance")
    iDrive = ac.Input(unit="A", doc="driving current")
    i = ac.Input(unit="A", doc="current from what is connected")
    v = ac.Output(unit="V", doc="voltage")
    dv = ac.Output(unit="V/s", doc="rate of the voltage")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.capacitor = basic.Capacitor(C=self.C, v=ac.Start(0.0, fixed=True))
        self.currentSource = SignalCurrent()
        self.currentToVoltage = GeneralCurrentToVoltageAdaptor(use_fder=False)
        self.ground = basic.Ground()
        self.connect(self.currentSource.n, self.capacitor.p, self.currentToVoltage.pin_p)
        self.connect(
            self.currentSource.p, self.capacitor.n, self.currentToVoltage.pin_n, self.ground.p
        )
        self.connect(self.iDrive, self.currentSource.i)
        self.connect(self.i, self.currentToVoltage.f)
        self.connect(self.currentToVoltage.p, self.v)
        self.connect(self.currentToVoltage.pder, self.dv)


class InverseCapacitor(ac.Component):
    """A capacitor at the voltage that the signals say, and the current that this takes."""

    ICON = icons.boxed(icons.CAPACITOR, "v → i")

    C = ac.Parameter(1.0, unit="F", min=0, doc="capacitance")
    v = ac.Input(unit="V", doc="voltage")
    dv = ac.Input(unit="V/s", doc="rate of the voltage, consistent with v")
    i = ac.Output(unit="A", doc="current that charges the capacitor")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.capacitor = basic.Capacitor(C=self.C)
        self.voltageToCurrent = GeneralVoltageToCurrentAdaptor(use_fder=False)
        self.ground = basic.Ground()
        self.connect(self.voltageToCurrent.pin_p, self.capacitor.p)
        self.connect(self.voltageToCurrent.pin_n, self.capacitor.n, self.ground.p)
        self.connect(self.v, self.voltageToCurrent.p)
        self.connect(self.dv, self.voltageToCurrent.pder)
        self.connect(self.voltageToCurrent.f, self.i)


class DirectInductor(ac.Component):
    """An inductor driven by ``vDrive`` that gives its current and takes the voltage ``v`` behind it."""

    ICON = icons.boxed(icons.INDUCTOR, "v → i")

    L = ac.Parameter(1.0, unit="H", min=0, doc="inductance")
    vDrive = ac.Input(unit="V", doc="driving voltage")
    v = ac.Input(unit="V", doc="voltage of what is connected")
    i = ac.Output(unit="A", doc="current")
    di = ac.Output(unit="A/s", doc="rate of the current")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.inductor = basic.Inductor(L=self.L, i=ac.Start(0.0, fixed=True))
        self.voltageSource = SignalVoltage()
        self.currentToVoltage = GeneralVoltageToCurrentAdaptor(use_pder=False)
        self.ground = basic.Ground()
        self.connect(self.voltageSource.p, self.inductor.p)
        self.connect(self.inductor.n, self.currentToVoltage.pin_p)
        self.connect(self.voltageSource.n, self.currentToVoltage.pin_n, self.ground.p)
        self.connect(self.vDrive, self.voltageSource.v)
        self.connect(self.v, self.currentToVoltage.p)
        self.connect(self.currentToVoltage.f, self.i)
        self.connect(self.currentToVoltage.fder, self.di)


class InverseInductor(ac.Component):
    """An inductor with the current that the signals say, and the voltage that this takes."""

    ICON = icons.boxed(icons.INDUCTOR, "i → v")

    L = ac.Parameter(1.0, unit="H", min=0, doc="inductance")
    i = ac.Input(unit="A", doc="current")
    di = ac.Input(unit="A/s", doc="rate of the current, consistent with i")
    v = ac.Output(unit="V", doc="voltage that drives the current")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.inductor = basic.Inductor(L=self.L)
        self.currentToVoltage = GeneralCurrentToVoltageAdaptor(use_pder=False)
        self.ground = basic.Ground()
        self.connect(self.currentToVoltage.pin_p, self.inductor.p)
        self.connect(self.currentToVoltage.pin_n, self.inductor.n, self.ground.p)
        self.connect(self.i, self.currentToVoltage.f)
        self.connect(self.di, self.currentToVoltage.fder)
        self.connect(self.currentToVoltage.p, self.v)


class Resistor(ac.Component):
    """A resistor between two voltages, and the currents that these take."""

    ICON = icons.boxed(icons.RESISTOR, "v → i")

    R = ac.Parameter(1.0, unit="Ohm", doc="resistance")
    v1 = ac.Input(unit="V", doc="voltage of the left end")
    i1 = ac.Output(unit="A", doc="current into the left end")
    v2 = ac.Input(unit="V", doc="voltage of the right end")
    i2 = ac.Output(unit="A", doc="current into the right end")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.resistor = basic.Resistor(R=self.R)
        self.voltageToCurrent1 = GeneralVoltageToCurrentAdaptor(use_pder=False, use_fder=False)
        self.voltageToCurrent2 = GeneralVoltageToCurrentAdaptor(use_pder=False, use_fder=False)
        self.ground = basic.Ground()
        self.connect(self.voltageToCurrent1.pin_p, self.resistor.p)
        self.connect(self.voltageToCurrent2.pin_p, self.resistor.n)
        self.connect(self.voltageToCurrent1.pin_n, self.voltageToCurrent2.pin_n, self.ground.p)
        self.connect(self.v1, self.voltageToCurrent1.p)
        self.connect(self.voltageToCurrent1.f, self.i1)
        self.connect(self.v2, self.voltageToCurrent2.p)
        self.connect(self.voltageToCurrent2.f, self.i2)


class Conductor(ac.Component):
    """A conductor to ground that two currents feed, and the voltage that these find."""

    ICON = icons.boxed(icons.marked(icons.RESISTOR, "G"), "G")

    G = ac.Parameter(1.0, unit="S", doc="conductance")
    i1 = ac.Input(unit="A", doc="current from the left")
    v1 = ac.Output(unit="V", doc="voltage that it finds")
    i2 = ac.Input(unit="A", doc="current from the right")
    v2 = ac.Output(unit="V", doc="voltage that it finds")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.conductor = basic.Conductor(G=self.G)
        self.currentToVoltage1 = GeneralCurrentToVoltageAdaptor(use_pder=False, use_fder=False)
        self.currentToVoltage2 = GeneralCurrentToVoltageAdaptor(use_pder=False, use_fder=False)
        self.ground = basic.Ground()
        self.connect(self.currentToVoltage1.pin_p, self.conductor.p, self.currentToVoltage2.pin_p)
        self.connect(
            self.currentToVoltage1.pin_n,
            self.conductor.n,
            self.currentToVoltage2.pin_n,
            self.ground.p,
        )
        self.connect(self.i1, self.currentToVoltage1.f)
        self.connect(self.currentToVoltage1.p, self.v1)
        self.connect(self.i2, self.currentToVoltage2.f)
        self.connect(self.currentToVoltage2.p, self.v2)
