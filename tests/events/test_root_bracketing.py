"""A condition whose number jumps: its instant is found as exactly as that of a smooth one."""

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.events import look, no_bracketing
from acausal.events.root_bracketing import TRIES


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


def test_a_search_ends_where_shorter_steps_do_not_show_the_change() -> None:
    """As where a trial explodes, and the interpolation within a long step is far from what shorter steps make."""
    events: Any = SimpleNamespace(n_guards=1, timed=np.array([False]), strict=np.array([False]))
    like = jnp.asarray(0.0)
    d, deadband, t, h = jnp.zeros(1), jnp.zeros(1), jnp.asarray(0.01), jnp.asarray(1e-4)
    shown = jnp.asarray([-1.0, -1.0, 1.0, 1.0, 1.0])[:, None]
    found = look(events, no_bracketing(events, like), shown, deadband, d, t, h)
    while not found.is_event:
        bracketing = found.bracketing
        found = look(events, bracketing, -jnp.ones((5, 1)), deadband, d, t, bracketing.h)
    assert found.bracketing.tries < TRIES
