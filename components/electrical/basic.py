"""Resistors, capacitors, inductors and two-ports; other basic elements come from their own modules."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import ConditionalHeatPort, OnePort, Pin, TwoPort

__modelica__ = "Modelica.Electrical.Analog.Basic"


class Ground(ac.Component):
    """The potential zero: ``p.v = 0``. Every circuit needs one."""

    ICON = icons.GROUND

    p = Pin()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p.v, 0)


class Resistor(OnePort, ConditionalHeatPort):
    """Linear resistor: ``v = R_actual i``, ``LossPower = v i``.

    ``R_actual = R (1 + alpha (T_heatPort - T_ref))`` [Ohm]; ``R`` may be zero or negative.
    """

    ICON = icons.RESISTOR

    R = ac.Parameter(unit="Ohm", doc="resistance at T_ref")
    T_ref = ac.Parameter(300.15, unit="K", doc="reference temperature")
    alpha = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T = ac.Parameter(lambda self: self.T_ref, unit="K", doc="temperature without heat port")
    R_actual = ac.Variable(unit="Ohm", doc="resistance at the actual temperature")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.R_actual, self.R * (1 + self.alpha * (self.T_heatPort - self.T_ref)))
        yield ac.Eq(self.v, self.R_actual * self.i)
        yield ac.Eq(self.LossPower, self.v * self.i)


class Conductor(OnePort, ConditionalHeatPort):
    """Linear conductor: ``i = G_actual v``, ``LossPower = v i``.

    ``G_actual = G/(1 + alpha (T_heatPort - T_ref))`` [S]; ``G`` may be zero or negative.
    """

    ICON = icons.marked(icons.RESISTOR, "G")

    G = ac.Parameter(unit="S", doc="conductance at T_ref")
    T_ref = ac.Parameter(300.15, unit="K", doc="reference temperature")
    alpha = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T = ac.Parameter(lambda self: self.T_ref, unit="K", doc="temperature without heat port")
    G_actual = ac.Variable(unit="S", doc="conductance at the actual temperature")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.G_actual, self.G / (1 + self.alpha * (self.T_heatPort - self.T_ref)))
        yield ac.Eq(self.i, self.G_actual * self.v)
        yield ac.Eq(self.LossPower, self.v * self.i)


class Capacitor(OnePort):
    """Linear capacitor: ``i = C der(v)``."""

    ICON = icons.CAPACITOR

    C = ac.Parameter(unit="F", min=0, doc="capacitance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i, self.C * ac.der(self.v))


class Inductor(OnePort):
    """Linear inductor: ``v = L der(i)``."""

    ICON = icons.INDUCTOR

    L = ac.Parameter(unit="H", min=0, doc="inductance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.L * ac.der(self.i), self.v)


class Gyrator(TwoPort):
    """Gyrator: ``i1 = G2 v2``, ``i2 = -G1 v1``."""

    ICON = icons.block("gyr")

    G1 = ac.Parameter(unit="S", doc="primary gyration conductance")
    G2 = ac.Parameter(unit="S", doc="secondary gyration conductance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i1, self.G2 * self.v2)
        yield ac.Eq(self.i2, -self.G1 * self.v1)


class VCV(TwoPort):
    """Voltage-controlled voltage source: ``v2 = gain v1``, ``i1 = 0``."""

    ICON = icons.controlled("voltage", "voltage")

    gain = ac.Parameter(doc="voltage gain")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v2, self.v1 * self.gain)
        yield ac.Eq(self.i1, 0)


class VCC(TwoPort):
    """Voltage-controlled current source: ``i2 = transConductance v1``, ``i1 = 0``."""

    ICON = icons.controlled("voltage", "current")

    transConductance = ac.Parameter(unit="S", doc="transconductance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i2, self.v1 * self.transConductance)
        yield ac.Eq(self.i1, 0)


class CCV(TwoPort):
    """Current-controlled voltage source: ``v2 = transResistance i1``, ``v1 = 0``."""

    ICON = icons.controlled("current", "voltage")

    transResistance = ac.Parameter(unit="Ohm", doc="transresistance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v2, self.i1 * self.transResistance)
        yield ac.Eq(self.v1, 0)


class CCC(TwoPort):
    """Current-controlled current source: ``i2 = gain i1``, ``v1 = 0``."""

    ICON = icons.controlled("current", "current")

    gain = ac.Parameter(doc="current gain")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i2, self.i1 * self.gain)
        yield ac.Eq(self.v1, 0)
