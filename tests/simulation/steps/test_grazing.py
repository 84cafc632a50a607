"""A condition that hardly changes at its instant has no gradient there, and that is said."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import acausal as ac

GRAVITY = 10.0


class Shot(ac.Component):
    """A ball thrown upwards; it counts how long it is above a mark."""

    top = ac.Parameter(0.7)
    h = ac.Variable(start=0.0, fixed=True)
    v = ac.Variable(start=4.0, state="always", fixed=True)
    above = ac.Variable(fixed=True)
    n = ac.Discrete(0, kind="bool")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.h), self.v)
        yield ac.Eq(ac.der(self.v), -GRAVITY)
        yield ac.Eq(self.n, ac.where(self.h > self.top, 1, 0))
        yield ac.Eq(ac.der(self.above), self.n)


HIGHEST = 0.8


@pytest.fixture(scope="module")
def shot() -> ac.System:
    return ac.compile(Shot())


def thrown(shot: ac.System, top: float) -> ac.Solution:
    params = {**shot.parameters(), "top": top}
    return ac.simulate(shot, (0.0, 0.7), params=params, dt=0.01, solver="rk4")


@pytest.mark.slow
def test_an_event_says_where_its_condition_grazes(shot: ac.System) -> None:
    up, _ = thrown(shot, HIGHEST - 1e-12).events
    assert up.grazes
    assert up.t == pytest.approx(0.4, abs=1e-6)
    assert "hardly changes" in str(up)


@pytest.mark.parametrize("top", [0.5, 0.7, 0.79])
def test_a_condition_that_changes_does_not_graze(shot: ac.System, top: float) -> None:
    events = thrown(shot, top).events
    assert len(events) == 2
    assert not any(e.grazes for e in events)
    assert str(events[0]) == f"t = {events[0].t:.9g} s: n becomes true"


@pytest.mark.machines
def test_a_training_names_the_condition_that_grazes(shot: ac.System) -> None:
    ts = np.linspace(0.0, 0.7, 71)
    records = {n: ac.Data(ts, {"above": 0.2 * ts}) for n in ("first", "second")}
    with (
        pytest.warns(UserWarning, match="no better than the targets' mean"),
        pytest.warns(UserWarning, match=r"'h > top' hardly changes at t = 0.4 s of 'first'"),
    ):
        ac.fit(
            shot,
            records,
            targets=["above"],
            x0="model",
            params={"top": HIGHEST - 1e-12},
            modifiers={"top": ac.Bounded(0.5, 0.8)},
            strategy="whole_record",
            solver="rk4",
            epochs=1,
        )
