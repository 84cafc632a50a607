"""The linkage: crank, coupler and rocker between two bearings, and a motor that holds the crank's speed."""

from __future__ import annotations

from collections.abc import Iterator

import acausal as ac
from acausal.components import neural, planar, rotational as rot

SPEED, TORQUE, ANGLE, RATE = "motor.w_ref", "motor.tau", "crank.phi", "crank.w"
JOINT = "rocker.w"
"""Speed of the worn joint, between rocker and frame."""
FRICTION = "friction.net"


class Motor(ac.Component):
    """A motor that holds a speed: ``tau = k (w_ref - w)``, and its torque is known from its current."""

    flange = rot.Flange()
    k = ac.Parameter(1.5, unit="N.m.s/rad", doc="gain of the speed controller")
    w_ref = ac.Input(unit="rad/s", doc="wanted speed")
    w = ac.Variable(unit="rad/s", doc="speed")
    tau = ac.Variable(unit="N.m", doc="torque on the crank")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.w, ac.der(self.flange.phi))
        yield ac.Eq(self.tau, self.k * (self.w_ref - self.w))
        yield ac.Eq(self.flange.tau, -self.tau)


class Worn(rot.PartialTwoFlanges):
    """The true friction, greatest where the joint is slow: ``(c + b exp(-(w/w_s)^2)) tanh(w/0.1) + d w``."""

    c = ac.Parameter(0.3, unit="N.m", doc="sliding friction")
    b = ac.Parameter(0.4, unit="N.m", doc="how much more acts at rest")
    w_s = ac.Parameter(0.8, unit="rad/s", doc="speed at which that is gone")
    d = ac.Parameter(0.03, unit="N.m.s/rad", doc="viscous friction")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange_a.phi, self.flange_b.phi)
        w = ac.der(self.flange_a.phi)
        dry = self.c + self.b * ac.exp(-((w / self.w_s) ** 2))
        yield ac.Eq(self.flange_a.tau + self.flange_b.tau, dry * ac.tanh(w / 0.1) + self.d * w)


class Viscous(rot.PartialTwoFlanges):
    """Friction that grows with the speed alone: ``d w``."""

    d = ac.Parameter(0.1, unit="N.m.s/rad", doc="damping constant")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange_a.phi, self.flange_b.phi)
        torque = self.d * ac.der(self.flange_a.phi)
        yield ac.Eq(self.flange_a.tau + self.flange_b.tau, torque)


class Link(ac.Component):
    """A slender rod of a length and a mass, with its body in the middle."""

    frame_a, frame_b = planar.Frame(), planar.Frame()

    def __init__(self, length: float, mass: float) -> None:
        super().__init__()
        self.first, self.second = (planar.FixedTranslation(r=(length / 2, 0.0)) for _ in range(2))
        self.body = planar.Body(m=mass, I=mass * length**2 / 12)
        self.connect(self.frame_a, self.first.frame_a)
        self.connect(self.first.frame_b, self.body.frame_a, self.second.frame_a)
        self.connect(self.second.frame_b, self.frame_b)


class FourBar(ac.Component):
    """Crank, coupler and rocker; the crank turns round, and the rocker goes to and fro.

    Arguments:
        friction: of the joint between rocker and frame, with two flanges; by default it is to be learned.
    """

    def __init__(self, friction: ac.Component | None = None) -> None:
        super().__init__()
        self.left, self.right = planar.Fixed(), planar.Fixed(r=(0.30, 0.0))
        self.motor, self.rotor = Motor(), rot.Inertia(J=0.03)
        self.crank = planar.Revolute(
            useFlange=True,
            stateSelect="always",
            phi=ac.Start(1.0, fixed=True),
            w=ac.Start(0.0, fixed=True),
        )
        # The assembly: about where the other joints stand while the crank is at its start.
        self.elbow, self.knee = (
            planar.Revolute(phi=ac.Start(-0.5)),
            planar.Revolute(phi=ac.Start(1.1)),
        )
        self.rocker = planar.Revolute(useFlange=True, phi=ac.Start(-1.6))
        self.short, self.coupler = Link(0.10, 0.4), Link(0.30, 0.9)
        self.long = Link(0.25, 0.8)
        self.friction = learned() if friction is None else friction
        self.connect(self.left.frame, self.crank.frame_a)
        self.connect(self.crank.frame_b, self.short.frame_a)
        self.connect(self.short.frame_b, self.elbow.frame_a)
        self.connect(self.elbow.frame_b, self.coupler.frame_a)
        self.connect(self.coupler.frame_b, self.knee.frame_a)
        self.connect(self.knee.frame_b, self.long.frame_a)
        self.connect(self.long.frame_b, self.rocker.frame_a)
        self.connect(self.rocker.frame_b, self.right.frame)
        self.connect(self.motor.flange, self.rotor.flange_a)
        self.connect(self.rotor.flange_b, self.crank.flange_a)
        self.connect(self.rocker.flange_a, self.friction.flange_a)


def learned() -> neural.BearingFriction:
    """A joint whose friction is a curve over its speed, the same in both directions."""
    return neural.BearingFriction(
        smooth=True, w_small=0.1, width=8, depth=1, input_scale=2.0, output_scale=0.5
    )
