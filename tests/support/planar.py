"""Planar mechanics for tests: bodies, rods and joints, and robots and linkages made of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import sympy as sp

import acausal as ac

GRAVITY = 9.81


class Frame(ac.Connector):
    """A frame in the plane, with the force and the torque into the component."""

    x = ac.Potential(unit="m")
    y = ac.Potential(unit="m")
    phi = ac.Potential(unit="rad")
    f_x = ac.Flow(unit="N")
    f_y = ac.Flow(unit="N")
    tau = ac.Flow(unit="N.m")


class Fixed(ac.Component):
    """A frame that does not move."""

    frame = Frame()
    x0 = ac.Parameter(0.0, unit="m")
    y0 = ac.Parameter(0.0, unit="m")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.frame.x, self.x0)
        yield ac.Eq(self.frame.y, self.y0)
        yield ac.Eq(self.frame.phi, 0)


class Body(ac.Component):
    """A mass with an inertia at a frame, under gravity."""

    frame = Frame()
    m = ac.Parameter(unit="kg")
    J = ac.Parameter(unit="kg.m2")
    phi = ac.Variable(unit="rad")
    v_x = ac.Variable(unit="m/s")
    v_y = ac.Variable(unit="m/s")
    w = ac.Variable(unit="rad/s")
    a_x = ac.Variable(unit="m/s2")
    a_y = ac.Variable(unit="m/s2")
    z = ac.Variable(unit="rad/s2")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.phi, self.frame.phi)
        yield ac.Eq(self.v_x, ac.der(self.frame.x))
        yield ac.Eq(self.v_y, ac.der(self.frame.y))
        yield ac.Eq(self.w, ac.der(self.frame.phi))
        yield ac.Eq(self.a_x, ac.der(self.v_x))
        yield ac.Eq(self.a_y, ac.der(self.v_y))
        yield ac.Eq(self.z, ac.der(self.w))
        yield ac.Eq(self.m * self.a_x, self.frame.f_x)
        yield ac.Eq(self.m * (self.a_y + GRAVITY), self.frame.f_y)
        yield ac.Eq(self.J * self.z, self.frame.tau)


class Rod(ac.Component):
    """A rigid distance ``L`` along the frames' own x-axis."""

    frame_a, frame_b = Frame(), Frame()
    L = ac.Parameter(unit="m")

    def equations(self) -> Iterator[ac.Eq]:
        a, b = self.frame_a, self.frame_b
        r_x, r_y = self.L * sp.cos(a.phi), self.L * sp.sin(a.phi)
        yield ac.Eq(b.x, a.x + r_x)
        yield ac.Eq(b.y, a.y + r_y)
        yield ac.Eq(b.phi, a.phi)
        yield ac.Eq(a.f_x + b.f_x, 0)
        yield ac.Eq(a.f_y + b.f_y, 0)
        yield ac.Eq(a.tau + b.tau + r_x * b.f_y - r_y * b.f_x, 0)


class Revolute(ac.Component):
    """A hinge with viscous friction and a motor's torque."""

    frame_a, frame_b = Frame(), Frame()
    d = ac.Parameter(0.1, unit="N.m.s/rad")
    drive = ac.Parameter(0.0, unit="N.m")
    phi = ac.Variable(unit="rad", state="always")
    w = ac.Variable(unit="rad/s", state="always")
    z = ac.Variable(unit="rad/s2")

    def equations(self) -> Iterator[ac.Eq]:
        a, b = self.frame_a, self.frame_b
        yield ac.Eq(self.phi, b.phi - a.phi)
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.z, ac.der(self.w))
        yield ac.Eq(b.x, a.x)
        yield ac.Eq(b.y, a.y)
        yield ac.Eq(a.f_x + b.f_x, 0)
        yield ac.Eq(a.f_y + b.f_y, 0)
        yield ac.Eq(a.tau + b.tau, 0)
        yield ac.Eq(b.tau, self.drive - self.d * self.w)


class Pin(ac.Component):
    """A hinge that closes a chain: it holds the frames together and transmits no torque."""

    frame_a, frame_b = Frame(), Frame()

    def equations(self) -> Iterator[ac.Eq]:
        a, b = self.frame_a, self.frame_b
        yield ac.Eq(b.x, a.x)
        yield ac.Eq(b.y, a.y)
        yield ac.Eq(a.f_x + b.f_x, 0)
        yield ac.Eq(a.f_y + b.f_y, 0)
        yield ac.Eq(a.tau, 0)
        yield ac.Eq(b.tau, 0)


class Arm(ac.Component):
    """Links of two rods with a body between them, each hinged to the one before, from a fixed frame.

    Arguments:
        load: how many more rods, each with a body, are rigidly fixed to its end.
    """

    def __init__(self, n: int, lengths: Sequence[float] = (), load: int = 0) -> None:
        super().__init__()
        lengths = lengths or [1.0] * n
        self.base = Fixed()
        self.joint = [Revolute(d=0.1 + 0.01 * k) for k in range(n)]
        self.inner = [Rod(L=0.6 * length) for length in lengths]
        self.outer = [Rod(L=0.4 * length) for length in lengths]
        self.body = [Body(m=1.0 + 0.1 * k, J=0.1) for k in range(n)]
        end = self.base.frame
        for joint, inner, outer, body in zip(
            self.joint, self.inner, self.outer, self.body, strict=True
        ):
            self.connect(end, joint.frame_a)
            self.connect(joint.frame_b, inner.frame_a)
            self.connect(inner.frame_b, body.frame, outer.frame_a)
            end = outer.frame_b
        self.rod = [Rod(L=0.1) for _ in range(load)]
        self.load = [Body(m=0.2, J=0.01) for _ in range(load)]
        for rod, body in zip(self.rod, self.load, strict=True):
            self.connect(end, rod.frame_a)
            self.connect(rod.frame_b, body.frame)
            end = rod.frame_b


class Linkage(Arm):
    """An arm whose end is hinged to a second fixed frame; ``start`` has guesses of its links' angles."""

    def __init__(
        self, lengths: Sequence[float], start: Sequence[float] = (), base: float = 1.0
    ) -> None:
        super().__init__(len(lengths), lengths)
        for body, angle in zip(self.body, start, strict=False):
            body.modify(phi=ac.Start(angle))
        self.end, self.pin = Fixed(x0=base), Pin()
        self.connect(self.outer[-1].frame_b, self.pin.frame_a)
        self.connect(self.pin.frame_b, self.end.frame)


def chained(
    model: ac.Component,
    end: Any,
    joints: Sequence[Any],
    rods: Sequence[Any],
    bodies: Sequence[Any],
) -> Any:
    """Connect joints, each with its rod and a body at that rod's end, from a frame on; the last end."""
    for joint, rod, body in zip(joints, rods, bodies, strict=True):
        model.connect(end, joint.frame_a)
        model.connect(joint.frame_b, rod.frame_a)
        model.connect(rod.frame_b, body.frame_a)
        end = rod.frame_b
    return end
