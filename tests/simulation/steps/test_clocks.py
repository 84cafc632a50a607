"""Clocks: `ac.sample`."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import acausal as ac
from tests.support.hybrid import Sampled
from tests.support.paths import ROOT


class Clock(ac.Component):
    """Counts its ticks."""

    period = ac.Parameter(0.1, unit="s")
    n = ac.Discrete(0, kind="int")

    def equations(self):
        yield ac.When(ac.sample(0.0, self.period), ac.Eq(self.n, ac.pre(self.n) + 1))


class Counter(Clock):
    """Another class with the same parameter."""


class Clocks(ac.Component):
    """Two clocks of different classes."""

    def __init__(self):
        super().__init__()
        self.slow, self.fast = Clock(period=0.3), Counter()


@pytest.mark.slow
def test_clocks_of_several_components_keep_their_periods():
    sol = ac.simulate(ac.compile(Clocks()), (0.0, 0.65), saveat=[0.0, 0.25, 0.65])
    np.testing.assert_array_equal(sol["slow.n"], [1, 1, 3])
    np.testing.assert_array_equal(sol["fast.n"], [1, 3, 7])


@pytest.mark.slow
def test_a_clock_ticks_at_the_start_but_for_rounding():
    sol = ac.simulate(ac.compile(Clock()), (0.3, 0.75), saveat=[0.3, 0.35, 0.75])
    np.testing.assert_array_equal(sol["n"], [1, 1, 5])


@pytest.mark.slow
@pytest.mark.parametrize("dt", [None, 0.05])
def test_what_is_saved_at_a_tick_but_for_rounding_follows_it(dt: float | None):
    """3 * 0.1 is more than 0.3."""
    times = np.round(np.linspace(0, 2, 21), 9)
    run = ac.simulate(ac.compile(Clock()), (0.0, 2.0), saveat=times, dt=dt)
    np.testing.assert_array_equal(run["n"], np.arange(1, 22))


class Held(ac.Component):
    """A sampled controller and its plant, whose state decays towards what is held."""

    k = ac.Parameter(2.0)
    x = ac.Variable(start=0.0, fixed=True)
    u = ac.Discrete()

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.u - self.x)
        yield ac.When(ac.sample(0, 0.1), ac.Eq(self.u, self.k * (1 - self.x)))


@pytest.mark.slow
def test_a_fit_compares_what_is_measured_at_a_tick_with_what_follows_it():
    t, x, u = np.round(np.linspace(0, 3, 31), 9), [0.0], [2.0]
    for _ in t[1:]:
        x.append((x[-1] - u[-1]) * np.exp(-0.1) + u[-1])
        u.append(2.0 * (1 - x[-1]))
    data = ac.Data(t, {"u": np.array(u)})
    fit = ac.fit(ac.compile(Held()), data, ["u"], params={"k": 1.5}, modifiers=["k"])
    assert abs(float(fit.params["k"]) - 2.0) < 1e-5


EARLY = 1e-13


class Relayed(ac.Component):
    """A clock beside a relay whose events come just before its instants, by no more than rounding may."""

    x = ac.Variable(start=0.0, fixed=True)
    on = ac.Discrete(1, kind="bool")
    n = ac.Discrete(0, kind="int")

    def equations(self):
        yield ac.Eq(ac.der(self.x), ac.where(self.on > 0.5, 1, -1, events=True))
        high = (ac.pre(self.on) > 0.5) & (self.x < 0.8 - EARLY)
        yield ac.Eq(self.on, (self.x < 0.2 + EARLY) | high)
        yield ac.When(ac.sample(0, 0.1), ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.slow
def test_a_clock_does_not_stop_where_another_event_comes_first_by_rounding():
    run = ac.simulate(ac.compile(Relayed()), (0.0, 6.05), saveat=[6.05], rtol=1e-9, atol=1e-11)
    assert float(run["n"][0]) == 61
    assert any(e.after and {"on", "n"} <= e.after.keys() for e in run.events)


@pytest.mark.slow
def test_no_tick_is_lost_in_seconds_of_a_calendar():
    """Few digits are left there: an instant may lie within what counts as now before it has come."""
    system, begin = ac.compile(Sampled()), 1.7e9
    for ticks in range(20, 40, 2):
        run = ac.simulate(system, (begin, begin + 0.1 * ticks + 0.05))
        assert len(run.events) == ticks
        assert np.allclose(np.diff([e.t for e in run.events]), 0.1, atol=1e-6)


class Counted(Clock):
    """A clock whose ticks are added up."""

    x = ac.Variable(start=0.0, fixed=True)

    def equations(self):
        yield from super().equations()
        yield ac.Eq(ac.der(self.x), self.n)


@pytest.mark.slow
@pytest.mark.parametrize("solver", ["auto", "stiff"])
def test_clocks_tick_in_single_precision(solver):
    system = ac.compile(Counted())
    for period in (0.1, 0.3, 1 / 3, 0.7, 1.0):
        saved = {"saveat": [4.95 * period, 9.95 * period], "params": {"period": period}}
        sol = ac.simulate(system, 10 * period, dtype="float32", solver=solver, **saved)
        np.testing.assert_array_equal(sol["n"], [5, 10])
        np.testing.assert_allclose(sol["x"], [14.75 * period, 54.5 * period], rtol=1e-5)


class Levelled(Clock):
    """Beside a clock, two levels behind a check valve: their difference becomes zero, but for rounding."""

    first, second = ac.Variable(start=2.0, fixed=True), ac.Variable(start=1.0, fixed=True)
    valve = ac.Discrete(1, kind="bool")

    def equations(self):
        yield from super().equations()
        flow = ac.where(self.valve, 0.5 * (self.first - self.second), 0)
        yield ac.Eq(self.valve, self.first > self.second)
        yield ac.Eq(ac.der(self.first), -flow)
        yield ac.Eq(ac.der(self.second), flow)


class Settled(Clock):
    """Beside a clock, a lag that settles at the level of a comparison, and crosses it to and fro by rounding."""

    goal = ac.Parameter(0.3)
    x = ac.Variable(start=1.3, fixed=True)
    above = ac.Discrete(kind="bool")

    def equations(self):
        yield from super().equations()
        yield ac.Eq(ac.der(self.x), 100 * (self.goal - self.x))
        yield ac.Eq(self.above, self.x > self.goal)


def ticks_beside_levels() -> list[float]:
    """How often the clock has ticked in 60 s, by method and the levels' starts, or the level."""
    levels, lag = ac.compile(Levelled(period=1.0)), ac.compile(Settled(period=1.0))
    each = (levels, {"first": np.linspace(1.5, 2.0, 9)}), (lag, {"goal": [0.3, 123.456]})
    found = [
        ac.sweep(system, values, 60.5, saveat=[60.5], solver=solver)["n"][:, -1]
        for solver in ("auto", "stiff")
        for system, values in each
    ]
    return np.concatenate(found).tolist()


@pytest.mark.slow
def test_no_tick_is_lost_where_a_condition_rests_at_its_level():
    """What rounding makes of such a condition differs by XLA's optimizations: here they are those of a user."""
    run = "import json; from tests.simulation.steps.test_clocks import *; print(json.dumps(ticks_beside_levels()))"
    mine = {**os.environ, "XLA_FLAGS": "", "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", run], env=mine, cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert set(json.loads(done.stdout)) == {61.0}
