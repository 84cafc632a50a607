"""Loops with two solutions keep the one they are on; and hash seeds change nothing of a model with events."""

import os
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from tests.support.hybrid import Ball, Sampled, Step, Thermostat


class Comparator(ac.Component):
    """Its output is 1 or -1 and fed back by ``w``: two solutions while the input lies between -w and w."""

    w = ac.Parameter(0.4)
    sense, out = ac.Variable(), ac.Variable()
    high = ac.Discrete(1, kind="bool")

    def fed(self, u: Any) -> Iterator[Any]:
        """With an input."""
        yield ac.Eq(self.sense, u + self.w * self.out)
        yield ac.Eq(self.high, self.sense > 0)
        yield ac.Eq(self.out, 2 * self.high - 1)


class Schmitt(Comparator):
    """It follows a sine late."""

    def equations(self) -> Iterator[Any]:
        yield from self.fed(ac.sin(2 * ac.pi * ac.time))


class Multivibrator(Comparator):
    """A capacitance between the output and the sensed voltage: it swings by itself."""

    T = ac.Parameter(0.1)
    v = ac.Variable(start=0.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.T * ac.der(self.v), self.out - self.v)
        yield from self.fed(-self.v)


@pytest.mark.slow
def test_a_schmitt_trigger_keeps_its_branch() -> None:
    ts = np.linspace(0, 2, 201)
    run = ac.simulate(ac.compile(Schmitt()), (0.0, 2.0), saveat=ts)
    falls = 0.5 + np.arcsin(0.4) / (2 * np.pi)
    phase = (ts - falls) % 1
    clear = (abs(phase - 0.5) > 1e-6) & (phase > 1e-6) & (ts > 0.1)
    np.testing.assert_allclose(run["out"][clear], np.where(phase < 0.5, -1, 1)[clear])


@pytest.mark.slow
def test_a_multivibrator_swings() -> None:
    run = ac.simulate(ac.compile(Multivibrator()), (0.0, 1.0), rtol=1e-9, atol=1e-11)
    times = [e.t for e in run.events if e.after and "high" in e.after]
    assert len(times) > 5  # it turns at v = 0.4 and -0.4
    np.testing.assert_allclose(np.diff(times), 0.1 * np.log(1.4 / 0.6), rtol=1e-6)
    np.testing.assert_allclose(abs(run["out"]), 1.0)


class Several(ac.Component):
    """Models with many conditions side by side."""

    def __init__(self) -> None:
        super().__init__()
        self.ball, self.zone, self.loop, self.step = Ball(), Thermostat(), Sampled(), Step()
        self.trigger = Schmitt()


def text() -> str:
    """What holds at events of some models, as text."""
    system = ac.compile(Several())
    assert system.events is not None
    events = system.events
    lines = [str(guard.formula.expression) for guard in events.guards]
    updates = [*events.updates, *events.jumps]
    lines += [f"{u.formula.expression} -> {u.places.tolist()}" for u in updates]
    return "\n".join([*lines, str(system.discrete), str(system.states), str(system.equations)])


@pytest.mark.slow
def test_hash_seeds_do_not_change_what_holds_at_events() -> None:
    code = "from tests.simulation.steps import test_branches; print(test_branches.text())"
    runs = [
        subprocess.Popen(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed, "JAX_PLATFORMS": "cpu"},
            stdout=subprocess.PIPE,
            text=True,
        )
        for seed in ("0", "12345")
    ]
    expected = text()
    assert len(expected) > 1000
    for run in runs:
        assert run.communicate()[0].strip() == expected


class Follower(ac.Component):
    """A number that jumps with a state, and a discrete variable that follows it."""

    k = ac.Parameter(2.0)
    b, c = ac.Output(), ac.Output()
    h = ac.Discrete(0.0)
    x = ac.Variable(start=0.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.b, ac.where(self.x**2 > 1, 1, 0))
        yield ac.Eq(self.c, 2 * self.b)
        yield ac.Eq(ac.der(self.x), self.k * ac.time + self.h)
        yield self.follows()

    def follows(self) -> Any:
        return ac.Eq(self.h, self.c / 2)


class Triggered(Follower):
    def follows(self) -> Any:
        return ac.When(self.c > 1, ac.Eq(self.h, self.b))


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("model", [Follower, Triggered])
def test_a_jump_that_a_discrete_variable_follows_is_an_event(model: Any) -> None:
    """x = k t^2 / 2 up to 1, which it reaches at t = (2 / k)^1/2; from then on 1 more a second."""

    def end(k: Any) -> Any:
        return ac.simulate(system, 2.0, params={"k": k}, saveat=[2.0])["x"][0]

    system = ac.compile(model())
    value, slope = jax.value_and_grad(end)(2.0)
    np.testing.assert_allclose([value, slope], [5.0, 2.25], rtol=1e-9)
