"""Integers that jump at events: `ac.floor` with ``events``."""

import numpy as np
import pytest

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


class Counted(ac.Component):
    """Discrete variables that follow a ramp in steps, and a number in steps that an event waits for."""

    x = ac.Variable(start=0.0, fixed=True)
    n = ac.Discrete(0, kind="int")
    side, at = ac.Discrete(0.0), ac.Discrete(0.0)
    halves = ac.Variable()

    def equations(self):
        yield ac.Eq(ac.der(self.x), 1)
        yield ac.Eq(self.n, ac.floor(self.x))
        yield ac.Eq(self.side, ac.sign(self.x - 1.5))
        yield ac.Eq(self.halves, ac.floor(2 * self.x))
        yield ac.When(self.halves > 2, ac.Eq(self.at, ac.time))


def test_in_equations_of_discrete_variables_all_integers_jump_at_events():
    times = np.arange(0.1, 3, 0.25)
    sol = ac.simulate(ac.compile(Counted()), (0, 3), saveat=times)
    np.testing.assert_array_equal(sol["n"], np.floor(times))
    np.testing.assert_array_equal(sol["side"], np.sign(times - 1.5))
    np.testing.assert_allclose(sol["at"], np.where(times > 1.5, 1.5, 0.0), atol=1e-12)
