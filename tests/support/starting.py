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
