"""The vehicle: a body with a wheel for each axle, of which the front one is steered."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import acausal as ac
from acausal.components import blocks, neural, planar, rotational as rot

STEER, YAW_RATE, LATERAL = "steering.delta", "body.w", "a_lat"
AXLES = ("front", "rear")
GRAVITY = 9.81

MASS, INERTIA, RADIUS, SPEED = 1500.0, 2500.0, 0.3, 20.0
AHEAD, BEHIND = 1.2, 1.5
"""Distance [m] of either axle from the centre of mass."""
LOADS = {
    "front": MASS * GRAVITY * BEHIND / (AHEAD + BEHIND),
    "rear": MASS * GRAVITY * AHEAD / (AHEAD + BEHIND),
}
"""What each axle carries [N]."""

TYRES = {
    "front": {"B": 11.0, "C": 1.5, "D": 0.95},
    "rear": {"B": 14.0, "C": 1.5, "D": 1.05},
}
"""The true tyres, by the constants of `TrueTyre`; those at the rear are wider."""

Axle = Callable[[str], planar.PartialSlippingWheel]


class Steering(planar.PartialTwoFrames):
    """Turns ``frame_b`` by an angle against ``frame_a``."""

    delta = ac.Input(unit="rad", doc="steering angle of the wheel")

    def equations(self) -> Iterator[ac.Eq]:
        a, b = self.frame_a, self.frame_b
        yield ac.Eq(b.x, a.x)
        yield ac.Eq(b.y, a.y)
        yield ac.Eq(b.phi, a.phi + self.delta)
        yield ac.Eq(a.fx + b.fx, 0)
        yield ac.Eq(a.fy + b.fy, 0)
        yield ac.Eq(a.t + b.t, 0)


class TrueTyre(planar.PartialSlippingWheel):
    """Friction by the magic formula of Pacejka (1992): ``f = N D sin(C atan(B slip))``."""

    N = ac.Parameter(unit="N", doc="normal force")
    B = ac.Parameter(doc="stiffness factor")
    C = ac.Parameter(doc="shape factor")
    D = ac.Parameter(doc="greatest coefficient of friction")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        slip = self.v_slip / ac.Abs(self.radius * self.w_roll)
        yield ac.Eq(self.f, self.N * self.D * ac.sin(self.C * ac.atan(self.B * slip)))


class LinearTyre(planar.PartialSlippingWheel):
    """Friction that grows with the slip alone, as in the linear single-track model: ``f = N c slip``."""

    N = ac.Parameter(unit="N", doc="normal force")
    c = ac.Parameter(12.0, doc="cornering stiffness over the normal force, for a slip of one")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        slip = self.v_slip / ac.Abs(self.radius * self.w_roll)
        yield ac.Eq(self.f, self.N * self.c * slip)


class SingleTrack(ac.Component):
    """A vehicle that coasts from 20 m/s while its front wheel is steered.

    Arguments:
        tyre: makes the wheel of an axle; by default its friction is to be learned.
    """

    a_lat = ac.Variable(
        unit="m/s2", doc="lateral acceleration of the body, as a sensor on it shows"
    )

    def __init__(self, tyre: Axle | None = None) -> None:
        super().__init__()
        tyre = learned if tyre is None else tyre
        self.body = planar.Body(
            m=MASS, I=INERTIA, enableGravity=False, stateSelect="always",
            r=ac.Start((0.0, 0.0), fixed=True), v=ac.Start((SPEED, 0.0), fixed=True),
            phi=ac.Start(0.0, fixed=True), w=ac.Start(0.0, fixed=True),
        )  # fmt: skip
        self.ahead = planar.FixedTranslation(r=(AHEAD, 0.0))
        self.behind = planar.FixedTranslation(r=(-BEHIND, 0.0))
        self.steering = Steering()
        self.front, self.rear = (tyre(axle) for axle in AXLES)
        self.front_rim, self.rear_rim = (
            rot.Inertia(
                J=1.5, w=ac.Start(SPEED / RADIUS, fixed=True), phi=ac.Start(0.0, fixed=True)
            )
            for _ in AXLES
        )
        self.connect(self.body.frame_a, self.ahead.frame_a, self.behind.frame_a)
        self.connect(self.ahead.frame_b, self.steering.frame_a)
        self.connect(self.steering.frame_b, self.front.frame_a)
        self.connect(self.behind.frame_b, self.rear.frame_a)
        self.connect(self.front.flange_a, self.front_rim.flange_a)
        self.connect(self.rear.flange_a, self.rear_rim.flange_a)
        loads = [w.dynamicLoad for w in (self.front, self.rear) if isinstance(w, neural.Tyre)]
        if loads:  # they do not change
            self.load = blocks.Constant(k=0.0)
            self.connect(self.load.y, *loads)

    def equations(self) -> Iterator[ac.Eq]:
        body = self.body
        yield ac.Eq(self.a_lat, body.a[1] * ac.cos(body.phi) - body.a[0] * ac.sin(body.phi))


def true(axle: str) -> TrueTyre:
    """The tyre of the vehicle."""
    return TrueTyre(radius=RADIUS, r=(1.0, 0.0), N=LOADS[axle], **TYRES[axle])


def linear(axle: str) -> LinearTyre:
    """A tyre of the linear single-track model."""
    return LinearTyre(radius=RADIUS, r=(1.0, 0.0), N=LOADS[axle])


def learned(axle: str) -> neural.Tyre:
    """A tyre whose coefficient of friction is a curve over its slip."""
    return neural.Tyre(radius=RADIUS, r=(1.0, 0.0), N=LOADS[axle], width=8, depth=1)
