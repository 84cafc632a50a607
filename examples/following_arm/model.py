"""An arm on a motor, against its weight and the friction of its bearing."""

from __future__ import annotations

from collections.abc import Iterator

import acausal as ac
from acausal.components import neural, rotational as rot

MOTOR, ANGLE, SPEED = "motor.tau", "arm.phi", "arm.w"
LIMIT = 0.9
"""Largest torque of the motor [N.m]; the arm weighs 0.6 N.m where it is level."""


class Rubbing(rot.PartialTwoFlanges):
    """The true friction, most of which does not depend on the speed: ``flange_a.tau = d w + c tanh(w/0.2)``."""

    d = ac.Parameter(0.01, unit="N.m.s/rad")
    c = ac.Parameter(0.15, unit="N.m")
    w = ac.Variable(unit="rad/s")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.w, ac.der(self.flange_a.phi - self.flange_b.phi))
        yield ac.Eq(self.flange_a.tau, self.d * self.w + self.c * ac.tanh(self.w / 0.2))
        yield ac.Eq(self.flange_a.tau + self.flange_b.tau, 0)


class Weight(ac.Component):
    """The torque of gravity: ``flange.tau = mgl sin(phi)``, which is zero where the arm hangs."""

    flange = rot.Flange()
    mgl = ac.Parameter(0.6, unit="N.m")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange.tau, self.mgl * ac.sin(self.flange.phi))


class Arm(ac.Component):
    """Arm, weight, motor and bearing.

    Arguments:
        bearing: what brakes the arm, with two flanges; by default it is to be learned.
    """

    def __init__(self, bearing: ac.Component | None = None) -> None:
        super().__init__()
        self.arm = rot.Inertia(J=0.02, phi=ac.Start(0.0), w=ac.Start(0.0))
        self.weight, self.motor, self.frame = Weight(), rot.Torque(), rot.Fixed()
        learned = neural.Resistance(rot.Flange, activation="tanh")
        self.bearing = learned if bearing is None else bearing
        self.connect(self.motor.flange, self.arm.flange_a)
        self.connect(self.arm.flange_b, self.weight.flange, self.bearing.flange_a)
        self.connect(self.bearing.flange_b, self.frame.flange)


def true() -> ac.System:
    """The plant."""
    return ac.compile(Arm(Rubbing()))
