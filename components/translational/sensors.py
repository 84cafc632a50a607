"""Sensors: flange quantities as output signals, without a reaction on the flange."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import PartialAbsoluteSensor, PartialRelativeSensor

__modelica__ = "Modelica.Mechanics.Translational.Sensors"


class PositionSensor(PartialAbsoluteSensor):
    """Absolute position: ``s = flange.s`` [m]."""

    ICON = icons.meter("s")

    s = ac.Output(unit="m", doc="absolute position of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s, self.flange.s)


class SpeedSensor(PartialAbsoluteSensor):
    """Absolute speed: ``v = der(flange.s)`` [m/s]."""

    ICON = icons.meter("v")

    v = ac.Output(unit="m/s", doc="absolute speed of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, ac.der(self.flange.s))


class AccSensor(PartialAbsoluteSensor):
    """Absolute acceleration: ``a = der(v)`` [m/s2] with ``v = der(flange.s)``."""

    ICON = icons.meter("a")

    v = ac.Variable(unit="m/s", doc="absolute speed of the flange")
    a = ac.Output(unit="m/s2", doc="absolute acceleration of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, ac.der(self.flange.s))
        yield ac.Eq(self.a, ac.der(self.v))


class RelPositionSensor(PartialRelativeSensor):
    """Distance: ``s_rel = flange_b.s - flange_a.s`` [m]."""

    ICON = icons.meter2("s")

    s_rel = ac.Output(unit="m", doc="distance from flange_a to flange_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s_rel, self.flange_b.s - self.flange_a.s)
        yield ac.Eq(self.flange_a.f, 0)


class RelSpeedSensor(PartialRelativeSensor):
    """Relative speed: ``v_rel = der(s_rel)`` [m/s] with ``s_rel = flange_b.s - flange_a.s``."""

    ICON = icons.meter2("v")

    s_rel = ac.Variable(unit="m", doc="distance from flange_a to flange_b")
    v_rel = ac.Output(unit="m/s", doc="relative speed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s_rel, self.flange_b.s - self.flange_a.s)
        yield ac.Eq(self.v_rel, ac.der(self.s_rel))
        yield ac.Eq(self.flange_a.f, 0)


class RelAccSensor(PartialRelativeSensor):
    """Relative acceleration: ``a_rel = der(v_rel)`` [m/s2] with ``v_rel = der(s_rel)``."""

    ICON = icons.meter2("a")

    s_rel = ac.Variable(unit="m", doc="distance from flange_a to flange_b")
    v_rel = ac.Variable(unit="m/s", doc="relative speed")
    a_rel = ac.Output(unit="m/s2", doc="relative acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s_rel, self.flange_b.s - self.flange_a.s)
        yield ac.Eq(self.v_rel, ac.der(self.s_rel))
        yield ac.Eq(self.a_rel, ac.der(self.v_rel))
        yield ac.Eq(self.flange_a.f, 0)


class _CutSensor(PartialRelativeSensor):
    """Base of sensors in a rigid cut: ``flange_a.s = flange_b.s``."""

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.s, self.flange_b.s)


class ForceSensor(_CutSensor):
    """Cut force: ``f = flange_a.f`` [N]."""

    ICON = icons.meter2("f")

    f = ac.Output(unit="N", doc="force in flange_a, = -flange_b.f")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.flange_a.f)


class PowerSensor(_CutSensor):
    """Power through the cut: ``power = flange_a.f der(flange_a.s)`` [W]."""

    ICON = icons.meter2("W")

    power = ac.Output(unit="W", doc="power into flange_a")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.power, self.flange_a.f * ac.der(self.flange_a.s))


class MultiSensor(_CutSensor):
    """Speed ``v`` [m/s], cut force ``f`` [N] and ``power = f v`` [W] at once."""

    ICON = icons.meters("vf")

    power = ac.Output(unit="W", doc="power into flange_a")
    f = ac.Output(unit="N", doc="force in flange_a, = -flange_b.f")
    v = ac.Output(unit="m/s", doc="absolute speed of the flanges")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.flange_a.f)
        yield ac.Eq(self.v, ac.der(self.flange_a.s))
        yield ac.Eq(self.power, self.f * self.v)
