"""Triac from two ideal thyristors."""

from typing import Any

import acausal as ac
from acausal.components import icons

from .basic import Capacitor, Resistor
from .ideal import IdealThyristor
from .interfaces import NegativePin, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Ideal"


class IdealTriac(ac.Component):
    """Two ideal thyristors in opposite directions, which one signal fires, beside a snubber.

    ``idealThyristor`` conducts from ``n`` to ``p``, ``idealThyristor1`` from ``p`` to ``n``. ``resistor`` and
    ``capacitor`` in series are between the same pins.
    """

    ICON = icons.IDEAL_TRIAC

    Ron = ac.Parameter(1e-5, unit="Ohm", min=0, doc="resistance while conducting")
    Goff = ac.Parameter(1e-5, unit="S", min=0, doc="conductance while blocking")
    Vknee = ac.Parameter(0.8, unit="V", min=0, doc="threshold voltage in both directions")
    Rdis = ac.Parameter(100.0, unit="Ohm", doc="resistance of the snubber")
    Cdis = ac.Parameter(0.005, unit="F", doc="capacitance of the snubber")
    fire1 = ac.Input(kind="bool", doc="gate: fires above 0.5 (Modelica: true)")
    n = NegativePin()
    p = PositivePin()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        law = {name: getattr(self, name) for name in ("Ron", "Goff", "Vknee")}
        self.idealThyristor = IdealThyristor(**law)
        self.idealThyristor1 = IdealThyristor(**law)
        self.resistor, self.capacitor = Resistor(R=self.Rdis), Capacitor(C=self.Cdis)
        first, second = self.idealThyristor, self.idealThyristor1
        self.connect(self.n, first.p, second.n, self.resistor.p)
        self.connect(self.p, first.n, second.p, self.capacitor.n)
        self.connect(self.resistor.n, self.capacitor.p)
        self.connect(self.fire1, first.fire)
        self.connect(self.fire1, second.fire)
