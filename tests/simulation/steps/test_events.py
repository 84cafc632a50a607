"""What happens at events: order, initial values, results, and errors in one sentence."""

from collections.abc import Iterator
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.events import event_iteration
from tests.support.hybrid import Ball, Sampled, Thermostat


@pytest.fixture(scope="module")
def thermostat() -> ac.System:
    return ac.compile(Thermostat())


@pytest.mark.slow
def test_a_thermostat_switches_where_it_should(thermostat: ac.System) -> None:
    sol = ac.simulate(thermostat, (0.0, 9.0), rtol=1e-9, atol=1e-11)
    assert [e.condition for e in sol.events] == ["T < low", "T < high"] * 3
    # T = 40 - 25 exp(-t/10) until 21, then 10 + 11 exp(-t/10) until 19, and again from 19 to 21
    up, down, again = 10 * np.log(25 / 19), 10 * np.log(11 / 9), 10 * np.log(21 / 19)
    expected = [10 * np.log(25 / 21), up, up + down, up + down + again]
    np.testing.assert_allclose([e.t for e in sol.events[:4]], expected, rtol=1e-8)
    on = np.asarray(sol["on"])
    assert set(on) == {0.0, 1.0}
    assert sol.d.shape == (500, 3)
    assert "_event" not in " ".join(sol.names)


@pytest.mark.slow
def test_fixed_steps_end_at_events_too(thermostat: ac.System) -> None:
    fine = ac.simulate(thermostat, (0.0, 9.0), saveat=[9.0], rtol=1e-10, atol=1e-12)
    coarse = ac.simulate(thermostat, (0.0, 9.0), dt=0.25, solver="rk4")
    assert len(coarse.t) == 37
    assert coarse["T"][-1] == pytest.approx(float(fine["T"][-1]), abs=1e-7)
    assert [e.condition for e in coarse.events] == ["T < low", "T < high"] * 3


@pytest.mark.slow
def test_a_solution_is_read_and_written_as_any_other(thermostat: ac.System, tmp_path: Any) -> None:
    sol = ac.simulate(thermostat, (0.0, 3.0), saveat=[0.0, 1.0, 3.0])
    assert sol.to_dataframe(["T", "on"]).shape == (3, 2)
    sol.to_csv(tmp_path / "run.csv")
    assert "on []" in (tmp_path / "run.csv").read_text(encoding="utf-8")


@pytest.mark.slow
def test_initial_conditions_and_events_at_the_start() -> None:
    class Starts(ac.Component):
        x = ac.Variable(start=2.0, fixed=True)
        above = ac.Discrete(0, kind="bool")
        first = ac.Discrete(-1.0)
        counted = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), -self.x)
            yield ac.Eq(self.above, self.x > 1)
            yield ac.When(ac.initial(), ac.Eq(self.first, self.x))
            yield ac.When(ac.sample(0, 0.5), ac.Eq(self.counted, ac.pre(self.counted) + 1))

    sol = ac.simulate(ac.compile(Starts()), (0.0, 1.2), saveat=[0.0, 0.5, 1.0, 1.2])
    np.testing.assert_allclose(sol["above"], [1, 1, 0, 0])
    np.testing.assert_allclose(sol["first"], 2.0)
    np.testing.assert_allclose(sol["counted"], [1, 2, 3, 3])


@pytest.mark.slow
def test_samplers_with_periods_that_floats_do_not_divide_meet() -> None:
    class Two(ac.Component):
        a = ac.Discrete(0, kind="int")
        b = ac.Discrete(0, kind="int")
        together = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            fast, slow = ac.sample(0, 0.1), ac.sample(0, 0.3)
            yield ac.When(fast, ac.Eq(self.a, ac.pre(self.a) + 1))
            yield ac.When(slow, ac.Eq(self.b, ac.pre(self.b) + 1))
            both = (self.a > ac.pre(self.a)) & (self.b > ac.pre(self.b))
            yield ac.Eq(
                self.together, ac.where(both, ac.pre(self.together) + 1, ac.pre(self.together))
            )

    sol = ac.simulate(ac.compile(Two()), (0.0, 3.05), saveat=[3.05])
    assert [float(sol[n][0]) for n in ("a", "b", "together")] == [31, 11, 11]


@pytest.mark.slow
def test_otherwise_and_several_conditions() -> None:
    class Order(ac.Component):
        x = ac.Variable(start=0.0, fixed=True)
        mode = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), 1)
            second = ac.When(self.x > 1, ac.Eq(self.mode, 2))
            yield ac.When((self.x > 1) & (self.x < 3), ac.Eq(self.mode, 1), otherwise=second)

    sol = ac.simulate(ac.compile(Order()), (0.0, 2.0), saveat=[0.5, 1.5])
    np.testing.assert_allclose(sol["mode"], [0, 1])


@pytest.mark.slow
def test_one_of_several_conditions_comes_true_while_another_holds() -> None:
    class Both(ac.Component):
        x = ac.Variable(start=0.0, fixed=True)
        each = ac.Discrete(0, kind="int")
        joined = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            low, high = self.x > 0.5, self.x > 1
            yield ac.Eq(ac.der(self.x), 1)
            yield ac.When((low, high), ac.Eq(self.each, ac.pre(self.each) + 1))
            yield ac.When(low | high, ac.Eq(self.joined, ac.pre(self.joined) + 1))

    sol = ac.simulate(ac.compile(Both()), (0.0, 2.0), saveat=[2.0])
    assert [float(sol[n][0]) for n in ("each", "joined")] == [2, 1]


@pytest.mark.slow
def test_ideal_diodes_in_a_loop_find_their_branch() -> None:
    class Rectifier(ac.Component):
        """Two branches of a diode and a resistance from one source: ``off`` and the current depend on each other."""

        s = ac.Variable(shape=2)
        v = ac.Variable(shape=2)
        i = ac.Variable(shape=2)
        off = ac.Discrete(0, kind="bool", shape=2)
        q = ac.Variable(start=0.0, fixed=True)

        def equations(self) -> Iterator[Any]:
            source = ac.sin(2 * ac.pi * ac.time)
            for k, sign in enumerate((1, -1)):
                s, v, i, off = self.s[k], self.v[k], self.i[k], self.off[k]
                yield ac.Eq(off, s < 0)
                yield ac.Eq(v, s * ac.where(off, 1, 1e-5))
                yield ac.Eq(i, s * ac.where(off, 1e-5, 1))
                yield ac.Eq(sign * source, v + 10 * i)
            yield ac.Eq(ac.der(self.q), self.i[0] + self.i[1])

    sol = ac.simulate(ac.compile(Rectifier()), (0.0, 2.0), rtol=1e-9, atol=1e-12)
    # the mean of |sin| is 2/pi; a diode that conducts has 1e-5 ohm, one that blocks leaks 1e-5 S
    current = 1 / (10 + 1e-5) - 1e-5 / (1 + 1e-4)
    assert float(sol["q"][-1]) == pytest.approx(2 * 2 / np.pi * current, rel=1e-7)
    assert len(sol.events) >= 3


# -- errors --------------------------------------------------------------------------------------


class Broken(ac.Component):
    x = ac.Variable(start=1.0, fixed=True)
    y = ac.Variable()
    n = ac.Discrete(0, kind="int")

    def __init__(self, kind: str) -> None:
        super().__init__()
        self.kind = kind

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), -1)
        yield ac.Eq(self.y, 2 * self.x)
        count = ac.Eq(self.n, ac.pre(self.n) + 1)
        match self.kind:
            case "twice":
                yield ac.When(self.x < 0, count)
                yield ac.When(self.x < 0.5, count)
            case "nothing":
                pass
            case "no state":
                yield ac.When(self.x < 0, count, ac.Reinit(self.y, 1))
            case "two jumps":
                yield ac.When(self.x < 0, count, ac.Reinit(self.x, 1))
                yield ac.When(self.x < 0.5, ac.Reinit(self.x, 2))
            case "not discrete":
                yield ac.When(self.x < 0, ac.Eq(self.y, 1))
            case "equal":
                yield ac.When(ac.sin(self.x) >= 0, count)
                yield ac.Eq(self.y, ac.where(self.x > 0, 1, 2, events="x"))
            case "circle":
                yield ac.Eq(self.n, ac.where(self.n > 0.5, 0, 1))
            case "follows":
                yield ac.Eq(self.n, ac.where(self.x < 0.5, self.y, 1))
            case "slides":
                yield ac.Eq(self.n, ac.where(self.x < 0.5, 1, -1))
            case _:
                yield count


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("twice", "two equations give the discrete variable 'n'"),
        ("nothing", "no equation gives the discrete variables 'n'"),
        ("no state", "Reinit of 'y', which is not a state"),
        ("two jumps", "two When(...) make 'x' jump"),
        ("not discrete", "neither side is a discrete variable"),
        ("follows", "would follow 'x' between them, too; declare it as ac.Variable, or give it in"),
    ],
)
def test_wrong_events_are_refused_in_a_sentence(kind: str, words: str) -> None:
    with pytest.raises(ac.ModelError) as caught:
        ac.compile(Broken(kind))
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_period_of_zero_is_refused() -> None:
    with pytest.raises(ac.DeclarationError, match="period above zero"):
        ac.sample(0, 0)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("period", [0.0, -0.1])
def test_a_parameter_that_is_no_period_is_refused(period: float) -> None:
    with pytest.raises(ac.SimulationError, match=r"'sample\(0, period\)' is .*not above zero"):
        ac.simulate(ac.compile(Sampled(period=period)), (0.0, 1.0))


def test_a_condition_on_an_undefined_name_is_refused() -> None:
    class Unknown(ac.Component):
        x = ac.Variable(start=1.0, fixed=True)
        n = ac.Discrete(0)

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), -1)
            yield ac.When(sp.Symbol("q") > 0, ac.Eq(self.n, 1))

    with pytest.raises(ac.DeclarationError, match=r"^Unknown: q > 0: 'q' is not declared$"):
        ac.compile(Unknown())


@pytest.mark.slow
def test_a_model_that_slides_along_a_condition_is_stopped_and_named() -> None:
    class Slides(ac.Component):
        x = ac.Variable(start=1.0, fixed=True)

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), ac.where(self.x > 0.5, -1, 1, events=True))

    with pytest.raises(ac.SimulationError, match=r"without end \(x > 0\.5\)\. The model slides"):
        ac.simulate(ac.compile(Slides()), (0.0, 1.0))


@pytest.mark.slow
def test_a_circle_of_discrete_variables_is_named() -> None:
    with pytest.raises(
        ac.AcausalError, match=r"At the start .*: 'n' change each other without end"
    ):
        ac.simulate(ac.compile(Broken("circle")), (0.0, 1.0))


@pytest.mark.slow
def test_a_circle_that_closes_later_is_named() -> None:
    class Later(ac.Component):
        x = ac.Variable(start=1.0, fixed=True)
        a = ac.Discrete(0, kind="bool")
        b = ac.Discrete(0, kind="bool")

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), -1)
            yield ac.Eq(self.a, (self.x < 0.5) & (self.b < 0.5))
            yield ac.Eq(self.b, self.a > 0.5)

    with pytest.raises(ac.SimulationError) as caught:
        ac.simulate(ac.compile(Later()), (0.0, 1.0))
    assert "at an event 'a', 'b' change each other without end (x < 0.5)" in str(caught.value)


class Blinks(ac.Component):
    """A timer that starts itself again, counting."""

    again = ac.Option("t0 = time")
    x = ac.Variable(start=0.0, fixed=True)
    t0 = ac.Discrete(0.0)
    n = ac.Discrete(0, kind="int")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.n)
        counts = ac.Eq(self.n, ac.pre(self.n) + 1)
        match self.again:
            case "t0 = time":
                yield ac.When(ac.time > self.t0 + 1, ac.Eq(self.t0, ac.time), counts)
            case "t0 = pre(t0) + 1":
                follows = ac.Eq(self.t0, ac.pre(self.t0) + 1)
                yield ac.When(ac.time - self.t0 >= 1, follows, counts)
            case _:
                yield ac.When(ac.time > ac.pre(self.t0) + 1, ac.Eq(self.t0, ac.time), counts)


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("steps", [{}, {"dt": 0.01}], ids=str)
@pytest.mark.parametrize("again", ["t0 = time", "t0 = pre(t0) + 1"])
def test_a_condition_whose_time_moves_with_what_it_sets_is_a_circle(again: str, steps: Any) -> None:
    with pytest.raises(ac.SimulationError, match=r"'t0', 'n' change each other without end"):
        ac.simulate(ac.compile(Blinks(again=again)), (0.0, 3.5), **steps)


@pytest.mark.slow
def test_a_timer_that_starts_itself_again_by_what_was_before() -> None:
    run = ac.simulate(ac.compile(Blinks(again="pre")), (0.0, 5.5))
    np.testing.assert_allclose((run["n"][-1], run["x"][-1]), (5, 12.5))


@pytest.mark.slow
def test_values_that_differ_by_rounding_alone_end_an_event(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A value is computed to find it, and again for its derivatives, perhaps with other rounding errors."""

    class Follows(ac.Component):
        x = ac.Variable(start=1.0, fixed=True)
        last = ac.Discrete(0.0)
        n = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), 1)
            yield ac.Eq(self.last, 1.1 * self.x + ac.pre(self.n))
            yield ac.When(self.x > 2, ac.Eq(self.n, ac.pre(self.n) + 1))

    def rounded(events: Any, *args: Any) -> Any:
        x, d = after_pass(events, *args)
        return x, jnp.where(events.exact, d, d * (1 + 1e-15))

    after_pass = event_iteration.after_pass
    monkeypatch.setattr(event_iteration, "after_pass", rounded)
    run = ac.simulate(ac.compile(Follows()), 2.0)
    np.testing.assert_allclose((run["n"][-1], run["last"][-1]), (1, 3.2))


@pytest.mark.slow
def test_a_band_is_seen_however_soon_it_is_passed() -> None:
    class Passes(ac.Component):
        x = ac.Variable(start=0.0, fixed=True)
        inside, outside = ac.Discrete(0.0), ac.Discrete(0.0)

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), 1)
            yield ac.When(2 * ac.Abs(self.x - 3) - 2e-4 < 0, ac.Eq(self.inside, ac.time))
            yield ac.When(ac.Abs(3 - self.x) >= 1e-4, ac.Eq(self.outside, ac.time))

    run = ac.simulate(ac.compile(Passes()), (0.0, 5.0))
    np.testing.assert_allclose((run["inside"][-1], run["outside"][-1]), (2.9999, 3.0001))


@pytest.mark.slow
@pytest.mark.parametrize("steps", [{}, {"dt": 0.01}, {"dt": 0.5}], ids=str)
def test_a_ball_that_bounces_for_ever_is_stopped_and_named(steps: Any) -> None:
    with pytest.raises(ac.SimulationError, match="h < 0"):
        ac.simulate(ac.compile(Ball()), (0.0, 10.0), **steps)


def test_a_solver_that_looks_back_is_refused() -> None:
    with pytest.raises(ac.DataError, match="kvaerno5"):
        ac.simulate(ac.compile(Ball()), (0.0, 1.0), solver="bdf")


@pytest.mark.slow
def test_a_discrete_variable_may_be_a_derivative() -> None:
    class Counted(ac.Component):
        x = ac.Variable(fixed=True)
        n = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), self.n)
            yield ac.When(ac.time > 0.25, ac.Eq(self.n, 1))

    sol = ac.simulate(ac.compile(Counted()), (0.0, 1.0), saveat=[1.0])
    assert sol["x"][-1] == pytest.approx(0.75)


class Clamped(ac.Component):
    """A level that is put back to the threshold of a condition as soon as that is true: it slides along it."""

    x = ac.Variable(start=0.5, fixed=True)
    y = ac.Variable()
    is_low = ac.Discrete(False, kind="bool")

    def __init__(self, which: str) -> None:
        super().__init__()
        self.which = which

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), -1)
        yield ac.Eq(self.y, 2 * self.x + ac.sin(self.x))
        yield ac.Eq(self.is_low, self.x < 0)
        conditions = {
            "in part": (self.x < 0) & (ac.time > 0.2),
            "by a variable": self.y < 0,
            "by a discrete variable": self.is_low,
        }
        yield ac.When(conditions[self.which], ac.Reinit(self.x, 0))


@pytest.mark.cases(fast=1, slow=2)
@pytest.mark.parametrize("which", ["in part", "by a variable", "by a discrete variable"])
def test_a_level_that_is_clamped_at_its_threshold_does_not_run_away(which: str) -> None:
    with pytest.raises(ac.SimulationError, match="events follow each other without end"):
        ac.simulate(ac.compile(Clamped(which)), 1.0)


class BetweenWalls(ac.Component):
    """Something that flies between two walls and is put exactly onto the one that it has met."""

    x = ac.Variable(start=0.3, fixed=True)
    v = ac.Variable(start=1.7, fixed=True, state="always")

    def equations(self) -> Iterator[Any]:
        above, below = self.x > -0.4, self.x < 0.7
        yield ac.Eq(ac.der(self.x), self.v)
        yield ac.Eq(ac.der(self.v), -0.02 * self.v)
        wall = ac.where(above, 0.7, -0.4)
        yield ac.When(~(above & below), ac.Reinit(self.x, wall), ac.Reinit(self.v, -ac.pre(self.v)))


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("steps", [{}, {"dt": 0.01, "solver": "rk4"}])
def test_a_comparison_in_a_when_is_what_its_condition_has_become(steps: dict[str, Any]) -> None:
    sol = ac.simulate(ac.compile(BetweenWalls()), 30.0, **steps)
    assert len(sol.events) > 20
    for event in sol.events:
        assert event.before is not None
        assert event.after is not None
        assert event.after.get("x", 0.0) == pytest.approx(event.before.get("x", 0.0), abs=1e-6)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("dt", [1e-3, 5e-4])
def test_an_event_may_fall_on_the_end_of_a_fixed_step(dt: float) -> None:
    class HalfWaves(ac.Component):
        q = ac.Variable(start=0.0, fixed=True)

        def equations(self) -> Iterator[Any]:
            wave = ac.sin(100 * np.pi * ac.time)
            yield ac.Eq(ac.der(self.q), ac.where(wave < 0, 0.0, 1.0, events=True))

    sol = ac.simulate(ac.compile(HalfWaves()), 0.06, dt=dt, solver="rk4")
    assert sol["q"][-1] == pytest.approx(0.03, abs=1e-12)
    np.testing.assert_allclose([e.t for e in sol.events], [0.01, 0.02, 0.03, 0.04, 0.05])


@pytest.mark.slow
def test_a_clock_that_is_too_fast_for_its_times_is_refused() -> None:
    system = ac.compile(Sampled(period=1e-12))
    name, times = system.states[0], np.asarray([0.0, 0.25, 0.5])
    refused = {"match": r"ticks every 1e-12 s, .*give a period of 2e-12 s or more"}
    with pytest.raises(ac.SimulationError, **refused):
        ac.simulate(system, (0.0, 0.5))
    with pytest.raises(ac.SimulationError, **refused):
        ac.fit(system, ac.Data(times, {name: times}), [name], modifiers=["period"])


class _Switched(ac.Component):
    """A fast lag behind a sine, and a switch at a known time that changes nothing in it."""

    at = ac.Parameter(0.7)
    x = ac.Variable(start=0.0, fixed=True)
    on = ac.Discrete(0, kind="bool")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), 50 * (ac.sin(3 * ac.time) - self.x))
        yield ac.When(ac.time > self.at, ac.Eq(self.on, 1))


@pytest.mark.slow
def test_an_event_that_rounding_parts_from_the_end_of_an_implicit_step_costs_no_accuracy() -> None:
    system = ac.compile(_Switched())
    steps: dict[str, Any] = {"dt": 0.02, "solver": "kvaerno3"}
    beside = ac.simulate(system, 1.0, **steps)
    assert 0 < beside.t[35] - 0.7 < 1e-15  # a step of this length would follow
    without = ac.simulate(system, 1.0, params={"at": 5.0}, **steps)
    np.testing.assert_allclose(beside["x"], without["x"], atol=1e-12)
    assert beside["on"][-1] == 1


@pytest.mark.slow
@pytest.mark.parametrize("read", [lambda run: run.events[0].t, lambda run: run.after["v"][0]])
def test_events_are_refused_where_derivatives_are_taken(read: Any) -> None:
    """They have none: zero would be taken for one."""

    class Dropped(ac.Component):
        h = ac.Variable(start=1.0, fixed=True)
        v = ac.Variable(start=0.0, fixed=True)
        e = ac.Parameter(0.8)

        def equations(self):
            yield ac.Eq(ac.der(self.h), self.v)
            yield ac.Eq(ac.der(self.v), -9.81)
            yield ac.When(self.h < 0, ac.Reinit(self.v, -self.e * ac.pre(self.v)))

    system = ac.compile(Dropped())
    assert float(read(ac.simulate(system, 0.6))) > 0
    with pytest.raises(ac.DataError, match="have no derivatives"):
        jax.grad(lambda e: read(ac.simulate(system, 0.6, params={"e": e})))(0.8)
