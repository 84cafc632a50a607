"""A condition whose number jumps: its instant is found as exactly as that of a smooth one."""

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.events import POINTS, look, no_bracketing
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
    seen = jax.jit(lambda *found: look(events, *found))
    found = seen(no_bracketing(events, like), shown, deadband, d, t, h)
    while not found.is_event:
        bracketing = found.bracketing
        found = seen(bracketing, -np.ones((5, 1)), deadband, d, t, bracketing.h)
    assert found.bracketing.tries < TRIES


@pytest.mark.slow
def test_a_step_is_shortened_to_where_a_condition_seems_to_change_and_to_change_back() -> None:
    events: Any = SimpleNamespace(n_guards=1, timed=np.array([False]), strict=np.array([True]))
    like, points = jnp.asarray(0.0), jnp.asarray(POINTS)
    d, deadband, t, h = jnp.zeros(1), jnp.zeros(1), jnp.asarray(0.0), jnp.asarray(1.0)
    for height, peak in ((1e-3, 0.40625), (-1e-3, 1.0)):  # at the points it is -9e-3 at most
        number = (height - (points - 0.4) ** 2)[:, None]
        found = look(events, no_bracketing(events, like), number, deadband, d, t, h)
        assert not found.bracketing.active
        assert found.peak == peak


class Limit(ac.Component):
    """Counts how often an oscillator passes a level just below its amplitude of 1, for 0.9 % of a period."""

    x = ac.Variable(start=0.0, fixed=True)
    v = ac.Variable(start=1.0, fixed=True)
    n = ac.Discrete(0, kind="int")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.v)
        yield ac.Eq(ac.der(self.v), -self.x)
        yield ac.When(self.x > 1 - 1e-4, ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.slow
def test_short_changes_of_a_condition_are_events() -> None:
    run = ac.simulate(ac.compile(Limit()), 60.0)
    assert run["n"][-1] == 10
    begins = np.arccos(1 - 1e-4)
    expected = np.pi / 2 - begins + 2 * np.pi * np.arange(10)
    # the amplitude is as exact as the steps, and here its error moves the instant by far more
    np.testing.assert_allclose([e.t for e in run.events][::2], expected, atol=begins)
