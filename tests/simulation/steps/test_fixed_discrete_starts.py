"""A discrete variable's start is its value before the first event, also where it is fixed."""

from collections.abc import Iterator
from typing import Any

import pytest

import acausal as ac


class Latch(ac.Component):
    """A truth value that is false from the first instant on."""

    x = ac.Variable(start=1.0, fixed=True)
    off = ac.Discrete(True, kind="bool")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), -self.x)
        yield ac.Eq(self.off, ac.where((self.x < 0) & (ac.pre(self.off) > 0.5), 1, 0))


@pytest.mark.slow
def test_a_fixed_start_is_the_value_before_the_first_event() -> None:
    system = ac.compile(Latch(off=ac.Start(1.0, fixed=True)))
    assert ac.simulate(system, (0.0, 1.0), dt=0.5)["off"].tolist() == [0.0, 0.0, 0.0]
