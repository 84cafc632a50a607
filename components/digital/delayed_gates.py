"""Gates with a delay behind them."""

from typing import Any

import acausal as ac
from acausal.components import icons

from . import gates
from .delays import InertialDelaySensitive
from .logic import LOGIC, DigitalInput, DigitalOutput

__modelica__ = "Modelica.Electrical.Digital.Gates"


class _Delayed(ac.Component):
    """A gate, and a delay behind it: ``tLH`` [s] for rising, ``tHL`` [s] for falling outputs."""

    tLH = ac.Parameter(0.0, unit="s", min=0, doc="delay of rising outputs")
    tHL = ac.Parameter(0.0, unit="s", min=0, doc="delay of falling outputs")
    y0 = ac.Option("'U'", choices=LOGIC, doc="output before the start")
    y = DigitalOutput(doc="output")

    def _with_delay(self) -> InertialDelaySensitive:
        self.G2 = InertialDelaySensitive(tLH=self.tLH, tHL=self.tHL, y0=self.y0)
        self.connect(self.G2.y, self.y)
        return self.G2


class _One(_Delayed):
    x = DigitalInput(doc="input")


class InvGate(_One):
    """`Not` with a delay."""

    ICON = icons.marked(icons.block("not"), "t")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.G1 = gates.Not()
        self.connect(self.x, self.G1.x)
        self.connect(self.G1.y, self._with_delay().x)


class BufGate(_One):
    """The input with a delay."""

    ICON = icons.block("buf")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.connect(self.x, self._with_delay().x)


class _Several(_Delayed):
    """Of several inputs."""

    GATE: type[ac.Component]

    n = ac.Option(2, min=1, doc="number of inputs")
    x = DigitalInput(shape="n", doc="inputs")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.G1: Any = self.GATE(n=self.n)
        for given, to in zip(self.x, self.G1.x, strict=True):
            self.connect(given, to)
        self.connect(self.G1.y, self._with_delay().x)


class AndGate(_Several):
    """`And` with a delay."""

    ICON, GATE = icons.marked(icons.block("and"), "t"), gates.And


class NandGate(_Several):
    """`Nand` with a delay."""

    ICON, GATE = icons.marked(icons.block("nand"), "t"), gates.Nand


class OrGate(_Several):
    """`Or` with a delay."""

    ICON, GATE = icons.marked(icons.block("or"), "t"), gates.Or


class NorGate(_Several):
    """`Nor` with a delay."""

    ICON, GATE = icons.marked(icons.block("nor"), "t"), gates.Nor


class XorGate(_Several):
    """`Xor` with a delay."""

    ICON, GATE = icons.marked(icons.block("xor"), "t"), gates.Xor


class XnorGate(_Several):
    """`Xnor` with a delay."""

    ICON, GATE = icons.marked(icons.block("xnor"), "t"), gates.Xnor
