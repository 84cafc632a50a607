"""Starts of discrete variables: their values before the first event, fixed or not."""

import numpy as np
import pytest

import acausal as ac


class Latch(ac.Component):
    """Counts how often a rising signal passes 1, from a given start on."""

    x = ac.Variable(start=0.5, fixed=True)
    n = ac.Discrete(0, kind="int")
    high = ac.Discrete(kind="bool")

    def equations(self):
        yield ac.Eq(self.high, self.x > 0.2)
        yield ac.Eq(ac.der(self.x), 1)
        yield ac.When(self.x > 1, ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("fixed", [True, False])
def test_a_fixed_start_is_the_value_before_the_first_event(fixed):
    system = ac.compile(Latch(n=ac.Start(3, fixed=fixed), high=ac.Start(0, fixed=fixed)))
    found = ac.simulate(system, (0, 1), saveat=[0.0, 1.0])
    assert found["n"].tolist() == [3, 4]
    assert found["high"].tolist() == [1, 1]
    assert found["x"].tolist() == pytest.approx([0.5, 1.5])


class Heater(ac.Component):
    """A zone that a heater keeps between two temperatures, on from below the lower to above the upper one."""

    G, P = ac.Parameter(0.1), ac.Parameter(2.0)
    T = ac.Variable(start=20.0, fixed=True)
    on = ac.Discrete(0, kind="bool")

    def equations(self):
        yield ac.Eq(ac.der(self.T), self.P * self.on - self.G * (self.T - 10))
        off = ac.When(self.T > 22, ac.Eq(self.on, 0))
        yield ac.When(self.T < 18, ac.Eq(self.on, 1), otherwise=off)


@pytest.fixture(scope="module")
def heater() -> ac.System:
    return ac.compile(Heater())


@pytest.mark.slow
def test_x0_gives_what_events_remember(heater):
    """From 20 with the heater on, the zone reaches 22 where exp(-0.1 t) = 8 / 10, and cools to 18 from there."""
    found = ac.simulate(heater, 10.0, x0={"on": True})
    assert [e.t for e in found.events] == pytest.approx(
        [10 * np.log(10 / 8), 10 * np.log(10 / 8) + 10 * np.log(12 / 8)], rel=1e-6
    )
    later = ac.simulate(heater, (3.0, 4.0), x0={"T": 19.0, "on": 1}, saveat=[3.0, 4.0])
    assert later["T"].tolist() == pytest.approx([19.0, 30 - 11 * np.exp(-0.1)], rel=1e-6)


@pytest.mark.slow
def test_points_and_sweeps_take_it(heater):
    at = ac.operating_point(heater, x0={"T": 20.0, "on": 1})
    assert float(at["on"]) == 1.0
    runs = ac.sweep(heater, {"on": [0, 1]}, 1.0, saveat=[0.0, 1.0])
    cold, warm = 10 + 10 * np.exp(-0.1), 30 - 10 * np.exp(-0.1)
    assert np.asarray(runs["T"])[:, -1].tolist() == pytest.approx([cold, warm], rel=1e-6)


def test_what_follows_from_others_has_no_start():
    system = ac.compile(Latch())
    with pytest.raises(ac.DataError, match=r"x0: 'high' follows from other .* Give 'n'\."):
        ac.simulate(system, 1.0, x0={"high": 1})
