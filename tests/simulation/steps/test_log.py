"""What a run tells of its events: who caused each, what it changed, and all variables on both sides."""

import copy
from collections.abc import Iterator
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.simulation.log import LOG, Event, EventList, Log, _effect
from tests.support.hybrid import GRAVITY, Ball, Thermostat

FALL = (2 / GRAVITY) ** 0.5
"""When the ball first meets the ground."""


class Both(ac.Component):
    """A ball beside a zone that an input heats."""

    u = ac.Input()
    y = ac.Variable()

    def __init__(self) -> None:
        super().__init__()
        self.ball = Ball()
        self.zone = Thermostat()

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.y, self.u + 10 * self.ball.v)


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Both())


@pytest.fixture(scope="module")
def run(system: ac.System) -> Any:
    steps = ac.Signal([0.0, 1.0, 3.0], [1.0, 2.0, 2.0], interpolation="previous")
    return ac.simulate(system, (0.0, 3.0), inputs={"u": steps}, saveat=np.linspace(0, 3, 7))


def test_a_condition_names_the_variables_of_parts_in_full() -> None:
    class Watch(ac.Component):
        n = ac.Discrete(0, kind="int")

        def __init__(self) -> None:
            super().__init__()
            self.ball = Ball()

        def equations(self) -> Iterator[Any]:
            yield ac.When(self.ball.v < -1, ac.Eq(self.n, ac.pre(self.n) + 1))

    run = ac.simulate(ac.compile(Watch()), (0.0, 0.2), dt=0.1)
    assert [event.condition for event in run.events] == ["ball.v < -1"]


@pytest.mark.slow
def test_events_name_the_component_and_what_has_changed(run: Any) -> None:
    first, jump, *_ = run.events
    assert (first.component, first.condition) == ("ball", "ball: h < 0")
    assert first.before == pytest.approx({"ball.v": -GRAVITY * FALL, "ball.n": 0})
    assert first.after == pytest.approx({"ball.v": 0.8 * GRAVITY * FALL, "ball.n": 1})
    assert (jump.t, jump.component, jump.condition) == (1.0, "", "an input jumps")
    assert jump.before == jump.after == {}
    switched = [e for e in run.events if e.component == "zone"][-1]
    assert (switched.before, switched.after) == ({"zone.on": 1.0}, {"zone.on": 0.0})


def test_events_print_what_happened_a_line_each(run: Any) -> None:
    first = str(run.events).splitlines()[0]
    assert first.endswith("ball.v -4.429 → 3.544; ball.n 0 → 1")
    many = str(EventList(run.events[:1] * 100)).splitlines()
    assert len(many) == 19
    assert many[-1] == "... and 82 more"


def test_an_event_is_told_in_the_words_of_what_came_true() -> None:
    class Contact(ac.Component):
        mode = ac.Discrete(0, kind="int", doc="0 stuck, 1 sliding")
        begins = ac.Discrete(0, kind="bool", doc="1 where sliding begins")
        count = ac.Discrete(0, kind="int")
        y = ac.Discrete(0, kind="bool", doc="output signal, 1 or 0")
        x = ac.Variable(start=0.0, fixed=True)

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), 1)
            yield ac.When(
                self.x > 1, *(ac.Eq(v, 1) for v in (self.mode, self.begins, self.count, self.y))
            )

    system = ac.compile(Contact())
    before = {"mode": 0.0, "begins": 0.0, "count": 0.0}
    assert _effect(system, before, dict.fromkeys(before, 1.0)) == "sliding; sliding begins"
    assert _effect(system, {"begins": 1.0}, {"begins": 0.0}) == "begins becomes false"
    assert _effect(system, {"y": 0.0}, {"y": 1.0}) == "y becomes true"


def test_a_time_is_reached() -> None:
    """The condition that made the event is over, and would read as its opposite."""
    for condition in (
        "step: startTime > time",
        "step: time >= startTime",
        "step: time < startTime",
    ):
        assert (
            str(Event(0.5, condition, "step", {}, {})) == "t = 0.5 s: step: time reaches startTime"
        )
    assert str(Event(0.5, "ball: h < 0", "ball", {}, {})).endswith("ball: h < 0")


def test_any_variable_on_both_sides_of_an_instant(run: Any) -> None:
    times = [e.t for e in run.events]
    np.testing.assert_allclose(run.before.t, times)
    speed = GRAVITY * FALL
    assert float(run.before["y"][0]) == pytest.approx(1 - 10 * speed)
    assert float(run.after["y"][0]) == pytest.approx(1 + 8 * speed)
    i = times.index(1.0)
    assert float(run.after["y"][i] - run.before["y"][i]) == pytest.approx(1.0)
    np.testing.assert_allclose(run.after["ball.h"], run.before["ball.h"])


def test_a_model_without_events_has_no_sides() -> None:
    class Decay(ac.Component):
        x = ac.Variable(start=1.0, fixed=True)

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), -self.x)

    sol = ac.simulate(ac.compile(Decay()), (0.0, 1.0), dt=0.1)
    assert sol.events == ()
    assert sol.before["x"].shape == sol.after["x"].shape == (0,)
    assert not sol.system.is_discrete("x")


def test_a_plot_has_steps_at_the_instants(run: Any) -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    figure = run.plot("ball.v", "ball.n")
    speed, count = (ax.lines[0] for ax in figure.axes)
    assert (speed.get_drawstyle(), count.get_drawstyle()) == ("default", "steps-post")
    t, v = speed.get_data()
    assert len(t) == 7 + 2 * len(run.events)
    at = np.flatnonzero(np.isclose(t, FALL))
    np.testing.assert_allclose(v[at], [-GRAVITY * FALL, 0.8 * GRAVITY * FALL])
    assert (np.diff(t) >= 0).all()
    pyplot.close(figure)


def test_a_copy_keeps_its_events_and_asks_for_inputs(run: Any) -> None:
    assert copy.deepcopy(run).events == run.events
    copied = jax.tree.map(lambda a: a, run)
    with pytest.raises(ac.DataError, match="inputs at events are not known"):
        _ = copied.before
    pytest.importorskip("matplotlib.pyplot").close(copied.plot("ball.n"))


@pytest.mark.slow
def test_events_where_jax_traces_and_of_runs_side_by_side() -> None:
    ball = ac.compile(Ball())

    def fall(h: Any) -> ac.Solution:
        return ac.simulate(ball, (0.0, 0.8), x0={"h": h}, saveat=[0.8])

    def asks(h: Any) -> Any:
        return fall(h).events

    with pytest.raises(ac.DataError, match="not known while JAX traces"):
        jax.jit(asks)(1.0)
    many = jax.jit(jax.vmap(fall))(jnp.asarray([1.0, 4.0]))
    with pytest.raises(ac.DataError, match="side by side"):
        _ = many.events
    first, second = (jax.tree.map(lambda a, i=i: a[i], many) for i in (0, 1))
    assert [e.after["n"] for e in first.events] == [1.0]
    assert second.events == ()
    assert float(first.after["v"][0]) == pytest.approx(0.8 * GRAVITY * FALL)


def test_all_events_that_are_remembered_have_values() -> None:
    assert len(Log.empty(100, np.float64).before) == LOG


def test_many_columns_leave_values_of_few_events() -> None:
    log = Log.empty(3, np.float64, values=6)
    one = jnp.ones(2), jnp.zeros(1)
    for t in (1.0, 2.0):
        log = log.with_event(
            jnp.array(True), jnp.asarray(t), jnp.asarray(0), one, one, jnp.array(False)
        )
    log = log.with_event(
        jnp.array(False), jnp.asarray(9.0), jnp.asarray(0), one, one, jnp.array(False)
    )
    kept = log.kept()
    assert kept.t.tolist() == [1.0, 2.0]
    assert kept.before.tolist() == [[1.0, 1.0, 0.0]]
    assert len(log.t) == LOG


def test_events_at_seconds_of_a_calendar_have_a_time_each() -> None:
    at = [str(Event(1.7e9 + t, "x > 2", "", {}, {})) for t in (0.25, 0.5)]
    assert at == ["t = 1700000000.25 s: x > 2", "t = 1700000000.5 s: x > 2"]
