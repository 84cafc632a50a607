"""The pendulum: two arms on ball bearings. Its angles count from where the arms point upward.

Arms, bearings and their numbers are those of K. Kaheman et al.: The experimental multi-arm pendulum on a cart,
HardwareX 15, 2023. A free swing determines masses and torques only up to a common factor, so the upper arm's mass is
kept.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import neural, planar, rotational as rot

ANGLES, SPEEDS = ("upper.phi", "lower.phi"), ("upper.w", "lower.w")
JOINTS = ("shoulder_friction", "elbow_friction")
GRAVITY = 9.80858
"""[m/s2]"""
ARMS = ("upper.I", "lower.I", "lower.m", "arm.r[2]")
"""Numbers of the arms that are trained beside the friction: all that a swing can tell of them."""
DRAG = "air.tau_nominal"


class Viscous(rot.PartialTwoFlanges):
    """The joints' friction as published: ``flange_a.tau = d w``."""

    d = ac.Parameter(unit="N.m.s/rad")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange_a.phi, self.flange_b.phi)
        torque = self.d * ac.der(self.flange_a.phi)
        yield ac.Eq(self.flange_a.tau + self.flange_b.tau, torque)


class DoublePendulum(ac.Component):
    """Two arms, each with its body, and what brakes them: both joints, and the air at the lower arm.

    Arguments:
        shoulder, elbow: friction of the joints, elements with flanges.
        drag: whether air brakes the lower arm, with the square of its speed.
    """

    def __init__(self, shoulder: ac.Component, elbow: ac.Component, *, drag: bool = False) -> None:
        super().__init__()
        state = ac.Start(state="always")
        absolute: dict[str, Any] = {"g": (0.0, -GRAVITY), "phi": state, "w": state}
        self.wall = planar.Fixed()
        self.shoulder, self.elbow = (_hinge(), _hinge())
        self.shoulder_friction, self.elbow_friction = shoulder, elbow
        self.to_upper = planar.FixedTranslation(r=(0.0, 0.10857))
        self.arm = planar.FixedTranslation(r=(0.0, 0.17272))
        self.to_lower = planar.FixedTranslation(r=(0.0, 0.11678))
        self.upper = planar.Body(m=0.09384, I=4.3753e-4, **absolute)
        self.lower = planar.Body(m=0.13760, I=1.26883e-3, **absolute)
        self.connect(self.wall.frame, self.shoulder.frame_a)
        self.connect(self.shoulder.frame_b, self.to_upper.frame_a, self.arm.frame_a)
        self.connect(self.to_upper.frame_b, self.upper.frame_a)
        self.connect(self.arm.frame_b, self.elbow.frame_a)
        self.connect(self.elbow.frame_b, self.to_lower.frame_a)
        self.connect(self.to_lower.frame_b, self.lower.frame_a)
        for joint, friction in ((self.shoulder, shoulder), (self.elbow, elbow)):
            self.connect(joint.flange_a, friction.flange_a)
        if drag:
            self.air = planar.QuadraticSpeedDependentForce(
                F_nominal=0.0, v_nominal=1.0, tau_nominal=-1e-5, w_nominal=1.0
            )
            self.connect(self.air.frame_b, self.lower.frame_a)


def _hinge() -> planar.Revolute:
    """A joint with a flange; the states are the arms' own angles, which are measured."""
    return planar.Revolute(useFlange=True, stateSelect="avoid")


def published() -> ac.System:
    """The pendulum with viscous joints, and the authors' numbers."""
    joints = (Viscous(d=2.3714e-4), Viscous(d=1e-5))
    return ac.compile(DoublePendulum(*joints))


def bearing() -> neural.BearingFriction:
    """A joint whose friction is a curve over its speed, the same in both directions: it never drives."""
    return neural.BearingFriction(
        smooth=True, w_small=0.3, width=6, depth=1, input_scale=3.0, output_scale=5e-4
    )


def learned() -> ac.System:
    """The pendulum with learned joints."""
    return ac.compile(DoublePendulum(bearing(), bearing(), drag=True))
