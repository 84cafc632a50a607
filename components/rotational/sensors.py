"""Sensors: flange quantities as output signals, without a reaction on the flange."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import PartialAbsoluteSensor, PartialRelativeSensor

__modelica__ = "Modelica.Mechanics.Rotational.Sensors"


class AngleSensor(PartialAbsoluteSensor):
    """Absolute angle: ``phi = flange.phi`` [rad]."""

    ICON = icons.meter("φ")

    phi = ac.Output(unit="rad", doc="absolute angle of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi, self.flange.phi)


class SpeedSensor(PartialAbsoluteSensor):
    """Absolute speed: ``w = der(flange.phi)`` [rad/s]."""

    ICON = icons.meter("ω")

    w = ac.Output(unit="rad/s", doc="absolute speed of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w, ac.der(self.flange.phi))


class AccSensor(PartialAbsoluteSensor):
    """Absolute acceleration: ``a = der(w)`` [rad/s2] with ``w = der(flange.phi)``."""

    ICON = icons.meter("α")

    w = ac.Variable(unit="rad/s", doc="absolute speed of the flange")
    a = ac.Output(unit="rad/s2", doc="absolute acceleration of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w, ac.der(self.flange.phi))
        yield ac.Eq(self.a, ac.der(self.w))


class RelAngleSensor(PartialRelativeSensor):
    """Relative angle: ``phi_rel = flange_b.phi - flange_a.phi`` [rad]."""

    ICON = icons.meter2("φ")

    phi_rel = ac.Output(unit="rad", doc="angle from flange_a to flange_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi_rel, self.flange_b.phi - self.flange_a.phi)
        yield ac.Eq(self.flange_a.tau, 0)


class RelSpeedSensor(PartialRelativeSensor):
    """Relative speed: ``w_rel = der(phi_rel)`` [rad/s], ``phi_rel = flange_b.phi - flange_a.phi``."""

    ICON = icons.meter2("ω")

    phi_rel = ac.Variable(unit="rad", doc="angle from flange_a to flange_b")
    w_rel = ac.Output(unit="rad/s", doc="relative speed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi_rel, self.flange_b.phi - self.flange_a.phi)
        yield ac.Eq(self.w_rel, ac.der(self.phi_rel))
        yield ac.Eq(self.flange_a.tau, 0)


class RelAccSensor(PartialRelativeSensor):
    """Relative acceleration: ``a_rel = der(w_rel)`` [rad/s2] with ``w_rel = der(phi_rel)``."""

    ICON = icons.meter2("α")

    phi_rel = ac.Variable(unit="rad", doc="angle from flange_a to flange_b")
    w_rel = ac.Variable(unit="rad/s", doc="relative speed")
    a_rel = ac.Output(unit="rad/s2", doc="relative acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi_rel, self.flange_b.phi - self.flange_a.phi)
        yield ac.Eq(self.w_rel, ac.der(self.phi_rel))
        yield ac.Eq(self.a_rel, ac.der(self.w_rel))
        yield ac.Eq(self.flange_a.tau, 0)


class _CutSensor(PartialRelativeSensor):
    """Base of sensors in a rigid cut: ``flange_a.phi = flange_b.phi``."""

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.phi, self.flange_b.phi)


class TorqueSensor(_CutSensor):
    """Cut torque: ``tau = flange_a.tau`` [N.m]."""

    ICON = icons.meter2("τ")

    tau = ac.Output(unit="N.m", doc="torque in flange_a, = -flange_b.tau")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.tau, self.flange_a.tau)


class PowerSensor(_CutSensor):
    """Power through the cut: ``power = flange_a.tau der(flange_a.phi)`` [W]."""

    ICON = icons.meter2("W")

    power = ac.Output(unit="W", doc="power into flange_a")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.power, self.flange_a.tau * ac.der(self.flange_a.phi))


class MultiSensor(_CutSensor):
    """Speed ``w`` [rad/s], cut torque ``tau`` [N.m] and ``power = tau w`` [W] at once."""

    ICON = icons.meters("ωτ")

    power = ac.Output(unit="W", doc="power into flange_a")
    w = ac.Output(unit="rad/s", doc="absolute speed of the flanges")
    tau = ac.Output(unit="N.m", doc="torque in flange_a, = -flange_b.tau")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w, ac.der(self.flange_a.phi))
        yield ac.Eq(self.tau, self.flange_a.tau)
        yield ac.Eq(self.power, self.tau * self.w)
