"""A condition whose number jumps: its instant is found as exactly as that of a smooth one."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import acausal as ac


class Counted(ac.Component):
    """Counts how often a clock of its own passes a level, by a number that is 1 or -1."""

    level = ac.Parameter(0.4)
    x = ac.Variable(fixed=True)
    n = ac.Discrete(0, kind="int")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), 1)
        side = ac.sign(self.x - self.level)
        yield ac.When(side > 0, ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.slow
def test_the_instant_of_a_jump_is_exact() -> None:
    system = ac.compile(Counted())
    for level in np.linspace(0.21, 0.87, 12).tolist():
        run = ac.simulate(system, 1.0, saveat=[1.0], params={"level": level})
        (event,) = run.events
        assert abs(event.t - level) < 1e-14
        assert run["n"][-1] == 1
