"""Models whose start values follow from their parameters."""

from collections.abc import Iterator
from typing import Any

import acausal as ac


class Sagging(ac.Component):
    """A mass on a hardening spring, which starts at rest under a load."""

    c = ac.Parameter(100.0, unit="N/m")
    b = ac.Parameter(1e4, unit="N/m3")
    load = ac.Parameter(5.0, unit="N")
    m = ac.Parameter(2.0, unit="kg")
    s = ac.Variable(unit="m")
    v = ac.Variable(unit="m/s", start=0.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.s), self.v)
        yield ac.Eq(self.m * ac.der(self.v), self.load - self.c * self.s - self.b * self.s**3)

    def initial_equations(self) -> Iterator[Any]:
        yield ac.Eq(self.load, self.c * self.s + self.b * self.s**3)


class Sharing(ac.Component):
    """Two tanks that share what is there: one condition for two states."""

    total = ac.Parameter(3.0)
    a = ac.Variable(start=0.5)
    b = ac.Variable(start=0.7)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.a), self.b - self.a)
        yield ac.Eq(ac.der(self.b), self.a - self.b)

    def initial_equations(self) -> Iterator[Any]:
        yield ac.Eq(self.a + 2 * self.b, self.total)


class Redundant(ac.Component):
    """Two conditions that say the same of one state; a negative ``square`` contradicts."""

    square = ac.Parameter(4.0)
    x = ac.Variable(start=1.0)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), -self.x)

    def initial_equations(self) -> Iterator[Any]:
        yield ac.Eq(self.x**2, self.square)
        yield ac.Eq(3 * self.x**2, 3 * self.square)


class Filling(ac.Component):
    """A lag that starts at a parameter, and counts from another one how often it fills up."""

    k = ac.Parameter(2.0)
    x0 = ac.Parameter(0.3)
    n0 = ac.Parameter(1.0)
    u = ac.Input()
    x = ac.Variable(start="x0", fixed=True)
    n = ac.Discrete("n0", kind="int")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), -self.k * self.x + self.u)
        yield ac.When(self.x > 0.6, ac.Eq(self.n, ac.pre(self.n) + 1))


class Pressed(ac.Component):
    """A mass that starts without acceleration, against a friction that depends on the speed that is to be found.

    The force grows with the number of times that it has passed a level.
    """

    c = ac.Parameter(40.0)
    slow = ac.Parameter(0.5)
    fast = ac.Parameter(3.0)
    s0 = ac.Parameter(0.1)
    n0 = ac.Parameter(2.0)
    u = ac.Input()
    s = ac.Variable(start="s0", fixed=True)
    v = ac.Variable()
    n = ac.Discrete("n0", kind="int")

    def equations(self) -> Iterator[Any]:
        above = self.v - 1
        friction = self.slow * self.v + ac.where(above > 0, self.fast * above, 0, events=True)
        force = self.u * (1 + 0.1 * self.n) - self.c * self.s
        yield ac.Eq(ac.der(self.s), self.v)
        yield ac.Eq(ac.der(self.v), force - friction)
        yield ac.When(self.s > 0.2, ac.Eq(self.n, ac.pre(self.n) + 1))

    def initial_equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.v), 0)


class Kicked(ac.Component):
    """A lag that a clock doubles at the start, and every second after that."""

    x0 = ac.Parameter(0.3)
    k = ac.Parameter(2.0)
    x = ac.Variable(start="x0", fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), -self.k * self.x)
        yield ac.When(ac.sample(0.0, 1.0), ac.Reinit(self.x, 2 * self.x))
