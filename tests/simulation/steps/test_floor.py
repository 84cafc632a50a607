"""Integers that jump at events: `ac.floor` with ``events``."""

from itertools import pairwise

import jax
import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal.flattening.flat_model import flatten

START, PERIOD = 0.1, 0.3


class Steps(ac.Component):
    """Periods since a start, a phase in them, a rounded sine; the integral of both."""

    begin = ac.Parameter(START, unit="s")
    period = ac.Parameter(PERIOD, unit="s")
    phase = ac.Variable(unit="s")
    rounded = ac.Variable()
    x = ac.Variable(start=0, fixed=True, state="always")

    def __init__(self, *, events: bool | None = True) -> None:
        super().__init__()
        self.events = events

    def equations(self):
        elapsed = ac.time - self.begin
        periods = ac.floor(elapsed / self.period, events=self.events)
        yield ac.Eq(self.phase, elapsed - periods * self.period)
        yield ac.Eq(self.rounded, ac.floor(3 * ac.sin(2 * ac.time) + 0.5, events=self.events))
        early = ac.where(self.phase < 0.1, 1, 0, events=self.events)
        yield ac.Eq(ac.der(self.x), early + self.rounded)


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Steps())


def exact(t: float) -> float:
    """The integral, from the instants at which its integrand jumps."""
    k = np.arange(-3, 4)
    turns = np.arcsin(np.clip((k - 0.5) / 3, -1, 1)) / 2
    marks = [turns + np.pi * n for n in range(5)] + [
        np.pi / 2 - turns + np.pi * n for n in range(5)
    ]
    marks += [START + PERIOD * np.arange(-1, 40), START + 0.1 + PERIOD * np.arange(-1, 40)]
    ends = np.unique(np.clip(np.concatenate([[0.0, t], *marks]), 0, t))
    middle = (ends[1:] + ends[:-1]) / 2
    integrand = np.floor(3 * np.sin(2 * middle) + 0.5) + ((middle - START) % PERIOD < 0.1)
    return float(np.sum(integrand * np.diff(ends)))


@pytest.mark.slow
def test_steps_end_where_an_integer_jumps(system):
    sol = ac.simulate(system, (0, 10), saveat=np.linspace(0, 10, 33))
    assert float(sol["x"][-1]) == pytest.approx(exact(10.0), abs=1e-8)
    ts = np.asarray(sol.t)
    np.testing.assert_array_equal(sol["rounded"], np.floor(3 * np.sin(2 * ts) + 0.5))
    np.testing.assert_allclose(sol["phase"], (ts - START) % PERIOD, atol=1e-12)


@pytest.mark.slow
def test_a_start_that_is_an_instant_but_for_rounding(system):
    params = system.parameters() | {"begin": 0.0, "period": 0.1}
    sol = ac.simulate(system, (0.3, 0.95), saveat=[0.3, 0.35, 0.95], params=params)
    np.testing.assert_allclose(sol["phase"], [0.0, 0.05, 0.05], atol=1e-12)


def test_without_other_events_it_stays_literal_on_request():
    assert len(flatten(Steps(events=None)).discrete) == 0
    assert len(flatten(Steps(events=False)).discrete) == 0


class Modulated(ac.Component):
    """Pulse width modulation: a sine against a saw tooth, whose jumps and the level's are literal."""

    m = ac.Parameter(0.8)
    f = ac.Parameter(2000.0)
    late = ac.Parameter(0.003)
    i = ac.Variable(start=0.0, fixed=True)

    def equations(self):
        saw = 2 * (self.f * ac.time - ac.floor(self.f * ac.time)) - 1
        level = ac.where(ac.time >= self.late, self.m, 0.0)
        above = level * ac.sin(100 * ac.pi * ac.time) > saw
        yield ac.Eq(ac.der(self.i), ac.where(above, 100, -100, events=True))


@pytest.mark.slow
def test_jumps_of_time_within_a_condition_are_events():
    """One search would leap over two of them, and the instants of none have derivatives by what it compares."""
    m, f, late, end = 0.8, 2000.0, 0.003, 0.0323
    marks = np.array([*np.arange(f * end) / f, late, end])
    marks.sort()

    def number(t: float, low: float) -> float:
        middle = low + 1e-9
        return (
            m * (middle > late) * np.sin(100 * np.pi * t) - 2 * (f * t - np.floor(f * middle)) + 1
        )

    i, by_m = 0.0, 0.0
    for low, high in pairwise(marks):
        ends = number(low, low), number(high, low)
        t = brentq(number, low, high, (low,), xtol=1e-16) if ends[0] > 0 > ends[1] else high
        t = low if ends[0] <= 0 else t
        i += 100 * (2 * t - low - high)
        if low < t < high and low >= late:
            slope = m * 100 * np.pi * np.cos(100 * np.pi * t) - 2 * f
            by_m -= 200 * np.sin(100 * np.pi * t) / slope

    system = ac.compile(Modulated())

    def last(m: float) -> jax.Array:
        params = {**system.parameters(), "m": m}
        return ac.simulate(system, (0, end), params=params, saveat=[end])["i"][-1]

    value, slope = jax.value_and_grad(last)(m)
    assert float(value) == pytest.approx(i, abs=1e-9)
    assert float(slope) == pytest.approx(by_m, rel=1e-6)


class Counted(ac.Component):
    """Discrete variables that follow a ramp in steps, and a number in steps that an event waits for."""

    x = ac.Variable(start=0.0, fixed=True)
    n = ac.Discrete(0, kind="int")
    side, at, last = ac.Discrete(0.0), ac.Discrete(0.0), ac.Discrete(0.0)
    past = ac.Discrete(0, kind="bool")
    halves = ac.Variable()

    def equations(self):
        yield ac.Eq(ac.der(self.x), 1)
        yield ac.Eq(self.n, ac.floor(self.x))
        yield ac.Eq(self.side, ac.sign(self.x - 1.5))
        yield ac.Eq(self.halves, ac.floor(2 * self.x))
        yield ac.When(self.halves > 2, ac.Eq(self.at, ac.time))
        yield ac.Eq(self.past, self.x > 0.7)
        now = (self.past > 0.5) & (ac.pre(self.past) < 0.5)
        yield ac.Eq(self.last, ac.where(now, self.x, ac.pre(self.last)))


@pytest.mark.slow
def test_in_equations_of_discrete_variables_all_integers_jump_at_events():
    times = np.arange(0.1, 3, 0.25)
    sol = ac.simulate(ac.compile(Counted()), (0, 3), saveat=times)
    np.testing.assert_array_equal(sol["n"], np.floor(times))
    np.testing.assert_array_equal(sol["side"], np.sign(times - 1.5))
    np.testing.assert_allclose(sol["at"], np.where(times > 1.5, 1.5, 0.0), atol=1e-12)
    np.testing.assert_allclose(sol["last"], np.where(times > 0.7, 0.7, 0.0), atol=1e-12)
