"""Small models with events whose solutions and derivatives are known in closed form."""

from collections.abc import Iterator
from typing import Any

import numpy as np

import acausal as ac
from acausal.components import blocks, rotational as rot

GRAVITY = 9.81


class Ball(ac.Component):
    """A ball that bounces."""

    e = ac.Parameter(0.8)
    h = ac.Variable(start=1.0, unit="m", fixed=True)
    v = ac.Variable(unit="m/s", state="always", fixed=True)
    n = ac.Discrete(0, kind="int")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.h), self.v)
        yield ac.Eq(ac.der(self.v), -GRAVITY)
        bounces = (
            ac.Reinit(self.v, -self.e * ac.pre(self.v)),
            ac.Eq(self.n, ac.pre(self.n) + 1),
        )
        yield ac.When(self.h < 0, *bounces)


class Thermostat(ac.Component):
    """A zone that a heater keeps between two temperatures."""

    C = ac.Parameter(10.0)
    G = ac.Parameter(1.0)
    P = ac.Parameter(30.0)
    low = ac.Parameter(19.0)
    high = ac.Parameter(21.0)
    T = ac.Variable(start=15.0, fixed=True)
    on = ac.Discrete(1, kind="bool")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.C * ac.der(self.T), self.P * self.on - self.G * (self.T - 10))
        stays = (ac.pre(self.on) > 0.5) & (self.high > self.T)
        yield ac.Eq(self.on, (self.low > self.T) | stays)


class Sampled(ac.Component):
    """A plant of first order with a controller that sees it at instants only."""

    period = ac.Parameter(0.1)
    k = ac.Parameter(2.0)
    x = ac.Variable(start=0.0, fixed=True)
    u = ac.Discrete(0.0)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.u - self.x)
        yield ac.When(ac.sample(0, self.period), ac.Eq(self.u, self.k * (1 - self.x)))


class Step(ac.Component):
    """A lag after a step, and a counter that begins when the lag's output passes a threshold."""

    t1 = ac.Parameter(0.5)
    threshold = ac.Parameter(0.2)
    x = ac.Variable(fixed=True)
    late = ac.Variable(fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), ac.where(ac.time >= self.t1, 1, 0, events=True) - self.x)
        yield ac.Eq(ac.der(self.late), ac.where(self.x > self.threshold, 1, 0, events=True))


def ball_height(h0: Any, e: Any, t: float) -> Any:
    """The ball's height at a time, in exact arithmetic."""
    t1 = (2 * h0 / GRAVITY) ** 0.5
    if t < t1:
        return h0 - GRAVITY * t**2 / 2
    v, begin = e * GRAVITY * t1, t1
    while t > begin + 2 * v / GRAVITY:
        begin, v = begin + 2 * v / GRAVITY, e * v
    return v * (t - begin) - GRAVITY * (t - begin) ** 2 / 2


def sampled_end(period: float, k: float, t: float) -> float:
    """The output of the sampled plant at a time."""
    x, now = 0.0, 0.0
    while now < t - 1e-12:
        u, h = k * (1 - x), min(period, t - now)
        x, now = u + (x - u) * np.exp(-h), now + h
    return x


class Braked(ac.Component):
    """A wheel whose brake is pressed from a known time on: what it is pressed by rises from zero there."""

    def __init__(self) -> None:
        super().__init__()
        start = ac.Start(10.0, fixed=True)
        self.wheel = rot.Inertia(J=0.5, phi=ac.Start(0.0, fixed=True), w=start)
        self.brake = rot.Brake(fn_max=30.0, mu_pos=[[0.0, 0.3]])
        self.press = blocks.Ramp(duration=1.0, startTime=1.5)
        self.connect(self.wheel.flange_b, self.brake.flange_a)
        self.connect(self.press.y, self.brake.f_normalized)
