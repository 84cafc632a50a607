"""Several records in one training: unequal, gappy, at several rates, with parameters of their own."""

from __future__ import annotations

from functools import cache
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.training.build_problem import build_problem
from acausal.training.objective.problem import Problem
from acausal.training.objective.whole_record import over_beginnings
from acausal.training.options import FitOptions
from tests.support.oscillator import force, learned, plain

TRUE = {"mass.m": 2.4, "spring.d": 1.5}


def run(end: float, seed: int = 0, dt: float = 0.01, **params: float) -> ac.Data:
    """What the linear oscillator does under a force of its own, from a state of its own."""
    time = np.arange(0.0, end + dt / 2, dt)
    push = force(time + 3 * seed)
    sol = ac.simulate(
        plain(), (0, time[-1]), dt=dt, inputs={"push.f": push}, solver="heun",
        params={**plain().parameters(), **TRUE, **params}, x0=[0.1 * seed, -0.2],
    )  # fmt: skip
    return ac.Data(time, {n: np.asarray(sol[n]) for n in ("mass.s", "mass.v", "mass.a", "push.f")})


@cache
def runs() -> dict[str, ac.Data]:
    """Three runs of unequal lengths."""
    return {"short": run(2.0, 1), "long": run(6.0, 2), "medium": run(4.0, 3)}


def pose(data: Any = None, system: ac.System | None = None, **chosen: Any) -> Problem:
    system = plain() if system is None else system
    options = FitOptions(**({"modifiers": ["mass.m", "spring.d"], "gamma": 0.9} | chosen))
    records = {n: d.for_system(system) for n, d in (data or runs()).items()}
    return build_problem(system, records, ("mass.a", "mass.s"), system.parameters(0), options)


def train(data: Any = None, system: ac.System | None = None, **chosen: Any) -> ac.Fit:
    defaults: dict[str, Any] = {
        "modifiers": ["mass.m", "spring.d"], "gamma": 0.9, "strategy": "gauss_newton", "progress": False,
    }  # fmt: skip
    return ac.fit(system or plain(), data or runs(), ["mass.a", "mass.s"], **(defaults | chosen))


@cache
def trained() -> ac.Fit:
    return train()


@pytest.mark.slow
def test_every_record_is_simulated_from_its_own_start_with_its_own_inputs():
    fit = trained()
    assert fit.modifiers == pytest.approx(
        {n: value / plain().parameters()[n] - 1 for n, value in TRUE.items()}, rel=1e-6
    )
    for name, data in runs().items():
        found = fit.records[name]
        sol = ac.simulate(
            plain(), (0, data.time[-1]), dt=0.01, inputs={"push.f": data["push.f"]}, solver="heun",
            params=fit.params, x0=[data[n][0] for n in plain().states],
        )  # fmt: skip
        expected = np.stack([sol["mass.a"], sol["mass.s"]], axis=1)
        np.testing.assert_allclose(found.predicted, expected, rtol=0, atol=1e-12)
        np.testing.assert_array_equal(found.time, data.time)
        assert found.x0 == pytest.approx({n: data[n][0] for n in plain().states}, rel=1e-12)
        assert max(found.rms.values()) < 1e-6


@pytest.mark.slow
def test_the_loss_is_that_of_all_samples():
    problem = pose()
    simulated = problem.simulate(problem.start())
    miss, sigma = [], np.asarray(problem.records.sigma)
    for name, record in runs().items():
        alone = pose({name: record})
        y = np.asarray(alone.simulate(alone.start()).y)
        miss.append((y - np.asarray(alone.records.y)) / sigma)
    expected = np.sqrt(np.mean(np.sum(np.concatenate(miss) ** 2, axis=1)))
    assert float(simulated.loss) == pytest.approx(expected, rel=1e-12)


@pytest.mark.slow
def test_programs_do_not_grow_with_the_number_of_records():
    def size(count: int) -> int:
        ends = np.linspace(1.0, 3.0, count)
        problem = pose({f"run {i}": run(float(end), i) for i, end in enumerate(ends)})
        batch = problem.draw(jax.random.key(0))

        def loss(trainable: Any, problem: Problem) -> Any:
            return jnp.mean(problem.losses(trainable, batch))

        lowered = jax.jit(jax.grad(loss)).lower(problem.start(), problem)
        return len(lowered.as_text().splitlines())

    assert size(6) == size(2)


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize(
    "chosen",
    [
        {"per_record": {"spring.c": 5.0, "fixed.s0": None}},
        {"x0": "fit"},
        {"x0": "fit", "sequence_length": 1.5, "batch_size": 3},
        {"sequence_length": 3.0, "batch_size": 4, "per_record": {"spring.c": None}},
    ],
    ids=["parameters of records", "initial states", "shooting", "sequences"],
)
def test_gradients_are_those_of_differences(chosen: dict[str, Any]):
    problem = pose(system=offset(), **chosen)
    start = jax.tree.map(
        lambda a: a + 0.05 * jnp.arange(1.0, a.size + 1).reshape(a.shape), problem.start()
    )
    batch = problem.draw(jax.random.key(3))

    @eqx.filter_jit
    def total(trainable: Any) -> Any:
        loss = jnp.average(problem.losses(trainable, batch), weights=batch.weight)
        return problem.weighed(loss, trainable)

    gradient = eqx.filter_jit(eqx.filter_grad(total))(start)
    flat, unravel = jax.flatten_util.ravel_pytree(start)
    found, _ = jax.flatten_util.ravel_pytree(gradient)
    step = 1e-5
    for i in range(len(flat)):
        high, low = (total(unravel(flat.at[i].add(s))) for s in (step, -step))
        assert float(found[i]) == pytest.approx(float(high - low) / (2 * step), rel=1e-5, abs=1e-8)


@cache
def offset() -> ac.System:
    """The oscillator, whose wall stands at a place that can be changed."""
    from acausal.components import translational as tl

    class Offset(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.fixed = tl.Fixed(s0=0.01)
            self.spring = tl.SpringDamper(c=50.0, d=1.0)
            self.mass = tl.Mass(m=2.0)
            self.push = tl.Force()
            self.connect(self.fixed.flange, self.spring.flange_a)
            self.connect(self.spring.flange_b, self.mass.flange_a)
            self.connect(self.push.flange, self.mass.flange_b)

    return ac.compile(Offset())


def test_beginnings_are_the_first_rows_of_every_record():
    whole = pose(sequence_length=None)
    cut = over_beginnings(whole, 301)  # that of 2 s is shorter
    first = np.asarray(whole.records.first)
    rows = np.concatenate([a + np.arange(n) for a, n in zip(first, (201, 301, 301), strict=True)])
    np.testing.assert_allclose(cut.simulate(cut.start()).x, whole.simulate(whole.start()).x[rows])
    np.testing.assert_array_equal(cut.records.y, whole.records.y[rows])


@pytest.mark.slow
def test_sequences_end_with_their_record():
    """A sequence that is longer than its record counts the rest of it with no weight."""
    problem = pose(sequence_length=3.0, batch_size=8)
    records = problem.records
    short = int(records.first[0])
    window = records.window(jnp.asarray(short), problem.sequences.length)
    assert int((np.asarray(window.weight)[:, 0] > 0).sum()) == len(runs()["short"])
    np.testing.assert_array_equal(
        window.y[len(runs()["short"]) :, 0], records.y[records.last[0], 0]
    )
    starts = np.asarray(problem.sequences.starts)
    of, last = np.asarray(records.of), np.asarray(records.last)
    fits = starts + problem.sequences.length - 1 <= last[of[starts]]
    assert fits[of[starts] != 0].all()
    assert (of[starts] == 0).sum() == 1


@pytest.mark.slow
def test_a_sequence_that_diverges_names_its_record():
    data = dict(runs())
    spoilt = {n: v.copy() for n, v in data["medium"].signals.items()}
    spoilt["mass.s"][100:] = 1e300
    data["medium"] = ac.Data(data["medium"].time, spoilt)
    with pytest.warns(UserWarning, match="Something diverged"):
        fit = ac.fit(
            plain(), data, "mass.a", modifiers=["mass.m"], sequence_length=0.2, batch_size=8,
            epochs=10, progress=False,
        )  # fmt: skip
    assert fit.history.divergences[0].record == "medium"
    assert "of 'medium'" in str(fit.history.divergences[0])


# -- what is missing, and rates ----------------------------------------------------------------------


def thinned(data: ac.Data, seed: int = 0) -> ac.Data:
    generator = np.random.default_rng(seed)
    signals = {n: v.copy() for n, v in data.signals.items()}
    for name in ("mass.a", "mass.s"):
        signals[name][generator.random(len(data)) < 0.3] = np.nan
        signals[name][80:120] = np.nan
    return ac.Data(data.time, signals, missing="nan")


@pytest.mark.slow
def test_missing_samples_count_for_nothing():
    data = {n: thinned(d, i) for i, (n, d) in enumerate(runs().items())}
    fit = train(data, x0={"mass.s": 0.1, "mass.v": -0.2})
    records = fit.problem.records
    assert int((records.weight > 0).sum()) == sum(
        d.counts[n] for d in data.values() for n in ("mass.a", "mass.s")
    )
    known = {"short": data["short"]}
    alone = train(known, x0={"mass.s": 0.1, "mass.v": -0.2})
    assert alone.params["mass.m"] == pytest.approx(TRUE["mass.m"], rel=1e-6)
    assert np.isnan(alone.records["short"].errors).sum() == 2 * len(data["short"]) - sum(
        data["short"].counts[n] for n in ("mass.a", "mass.s")
    )
    assert all(len(r.values) == data["short"].counts[r.target] for r in alone.residuals())
    assert np.isfinite(alone.confidence().parameters["mass.m"])


@pytest.mark.slow
def test_a_record_may_lack_a_target_that_others_have():
    data = runs() | {"long": runs()["long"].select(["mass.a", "push.f"])}
    fit = train(data)
    assert fit.params["mass.m"] == pytest.approx(TRUE["mass.m"], rel=1e-4)
    assert np.isnan(fit.records["long"].rms["mass.s"])
    assert fit.confidence().parameters["mass.m"] > 0
    without = runs() | {"long": runs()["long"].select(["push.f"])}
    with pytest.raises(
        ac.DataError, match=r"^'long' lacks 'mass.a', 'mass.s', so .*leave this record out"
    ):
        train(without)


@pytest.mark.slow
def test_the_equation_error_bridges_short_gaps_and_leaves_out_long_ones():
    data = runs()["long"]
    signals = {n: v.copy() for n, v in data.signals.items()}
    signals["mass.s"][50:55] = signals["mass.v"][200:260] = np.nan
    gappy = ac.Data(data.time, signals, missing="nan")
    fit = ac.fit(
        plain(), gappy, "mass.a", modifiers=["mass.m", "spring.d"], gamma=0.9,
        strategy="equation_error", x0={"mass.s": 0.2, "mass.v": -0.2}, progress=False,
    )  # fmt: skip
    for name, value in TRUE.items():
        assert fit.params[name] == pytest.approx(value, rel=1e-3)


@pytest.mark.slow
def test_signals_with_times_of_their_own_are_compared_at_their_own_samples():
    data = runs()["long"]
    slow = np.arange(3, len(data), 10)
    signals = {
        "push.f": (data.time, data["push.f"]),
        "mass.a": (data.time, data["mass.a"]),
        "mass.s": (data.time[slow], data["mass.s"][slow]),
    }
    fit = train({"run": ac.Data(signals=signals)}, x0={"mass.s": 0.2, "mass.v": -0.2})
    assert fit.params["mass.m"] == pytest.approx(TRUE["mass.m"], rel=1e-6)
    errors = fit.records["run"].errors[:, 1]
    np.testing.assert_array_equal(np.flatnonzero(~np.isnan(errors)), slow)


@pytest.mark.slow
def test_uneven_samples_are_integrated_in_steps_that_are_short_enough():
    """Rows every 0.01 to 0.2 s; one record's clock is faster than the other's."""
    fine = run(6.0, 2, dt=0.002)
    rows = np.cumsum(np.random.default_rng(0).integers(5, 100, size=120))
    rows = np.append(0, rows[rows < len(fine)])
    inputs = (fine.time[::5], fine["push.f"][::5])
    uneven = ac.Data(
        signals={
            "push.f": inputs,
            "mass.a": (fine.time[rows], fine["mass.a"][rows]),
            "mass.s": (fine.time[rows], fine["mass.s"][rows]),
        }
    )
    coarse = ac.Data(
        fine.time[rows], {n: fine[n][rows] for n in ("push.f", "mass.a", "mass.s", "mass.v")}
    )
    problem = pose(
        {"uneven": uneven, "coarse": coarse}, dt=0.01, x0={"mass.s": 0.2, "mass.v": -0.2}
    )
    records = problem.records
    assert problem.substeps == 1
    assert float(records.steps.h.max()) <= 0.01 + 1e-12
    np.testing.assert_array_equal(records.steps.t[records.rows_of(1)], fine.time[rows])
    fit = train({"run": uneven}, dt=0.01, x0={"mass.s": 0.2, "mass.v": -0.2})
    assert fit.params["mass.m"] == pytest.approx(TRUE["mass.m"], rel=2e-3)


@pytest.mark.slow
def test_records_of_other_inputs_and_starts_may_be_mixed():
    """At rest with the first input, from given values, and as measured."""
    data = {n: runs()[n] for n in ("short", "long", "medium")}
    rest = data["long"]
    settled = rest["push.f"][0] / 50.0
    fit = train(
        data, offset(), x0={"short": "data", "long": "steady", "medium": {"mass.s": 0.3, "mass.v": -0.2}},
        epochs=1,
    )  # fmt: skip
    settled += 0.01
    assert fit.records["long"].x0 == pytest.approx({"mass.s": settled, "mass.v": 0.0}, abs=1e-9)
    assert fit.records["medium"].x0 == {"mass.s": 0.3, "mass.v": -0.2}


# -- parameters of records ---------------------------------------------------------------------------


@cache
def with_offsets() -> tuple[dict[str, ac.Data], ac.Fit]:
    """Runs whose stiffness differs, with noise."""
    stiffness = {"a": 46.0, "b": 52.0, "c": 57.0, "d": 49.0}
    generator = np.random.default_rng(0)
    data: dict[str, ac.Data] = {}
    for i, (name, c) in enumerate(stiffness.items()):
        record = run(4.0, i, **{"spring.c": c})
        noisy = {
            n: v + 0.01 * v.std() * generator.standard_normal(len(v)) if n != "push.f" else v
            for n, v in record.signals.items()
        }
        data[name] = ac.Data(record.time, noisy)
    return data, train(data, per_record={"spring.c": 5.0}, x0="fit")


@pytest.mark.slow
def test_parameters_of_records_are_found():
    _, fit = with_offsets()
    found = [r.parameters["spring.c"] for r in fit.records.values()]
    np.testing.assert_allclose(found, [46.0, 52.0, 57.0, 49.0], rtol=0.01)
    sigma = fit.confidence().per_record["spring.c"]
    off = (np.array(found) - [46.0, 52.0, 57.0, 49.0]) / sigma
    assert np.abs(off).max() < 4
    assert fit.params["spring.c"] == 50.0
    assert fit.params["mass.m"] == pytest.approx(TRUE["mass.m"], rel=0.01)


@pytest.mark.slow
def test_a_tight_spread_ties_and_free_values_are_not_tied():
    data, fit = with_offsets()
    tied = train(data, per_record={"spring.c": 1e-4}, x0="fit")
    assert np.abs([r.parameters["spring.c"] - 50.0 for r in tied.records.values()]).max() < 0.05
    free = train(data, per_record={"spring.c": None}, x0="fit")
    for name, record in fit.records.items():
        assert free.records[name].parameters["spring.c"] == pytest.approx(
            record.parameters["spring.c"], rel=2e-3
        )


@pytest.mark.slow
def test_a_new_record_gets_its_own_value_with_the_rest_frozen():
    _, fit = with_offsets()
    new = run(3.0, 7, **{"spring.c": 55.0})
    own = train(
        {"new": new}, params=fit.params, modifiers=None, per_record={"spring.c": 5.0}, epochs=20
    )
    assert own.records["new"].parameters["spring.c"] == pytest.approx(55.0, rel=0.01)
    assert own.params == fit.params


# -- what is held out, and answers by record ---------------------------------------------------------


@pytest.mark.slow
def test_records_are_held_out_by_name_or_in_part():
    fit = train(validation="medium", epochs=3)
    assert tuple(fit.records) == ("short", "long")
    assert tuple(fit.held_out) == ("medium",)
    assert fit.validation_loss is not None
    errors = fit.held_out["medium"].errors / np.asarray(fit.problem.records.sigma)
    expected = np.sqrt(np.mean(np.sum(errors**2, axis=1)))
    assert fit.validation_loss == pytest.approx(expected, rel=1e-9)
    share = train(validation=0.25, epochs=3)
    assert len(share.records["long"].time) == 451
    counted = ~np.isnan(share.held_out["long"].errors[:, 0])
    np.testing.assert_array_equal(np.flatnonzero(counted), np.arange(451, 601))


@pytest.mark.slow
def test_questions_are_answered_by_record_and_together():
    fit = train(learned_data(), learned(), modifiers=["mass.m"], strategy="whole_record", epochs=5)
    together, one = fit.residuals(), fit.residuals("short")
    assert len(together[0].values) == sum(len(d) for d in runs().values())
    assert len(one[0].values) == len(runs()["short"])
    assert fit.records["short"].residuals()[0].share == one[0].share
    sure, alone = fit.confidence(), fit.confidence("short")
    assert sure.parameters["mass.m"] < alone.parameters["mass.m"]
    assert fit.rms["mass.a"] > 0
    for ask in ("predicted", "x0", "time"):
        with pytest.raises(ac.TrainingError, match=rf"fit.records\['short'\].{ask}"):
            getattr(fit, ask)
    bands = fit.conformal(runs(), level=0.5)
    inside = [one.inside["mass.a"] for one in fit.predict(runs(), conformal=bands).values()]
    assert 0.3 < np.mean(inside) < 0.7


def learned_data() -> dict[str, ac.Data]:
    return runs()


@pytest.mark.slow
def test_the_report_shows_every_record(tmp_path: Any):
    chosen = {"validation": "medium", "epochs": 3, "per_record": {"spring.c": 5.0}}
    page = train(**chosen).report(tmp_path).read_text()
    assert "spring.c [N/m]" in page
    assert "of &#x27;long&#x27;" in page or "of 'long'" in page
    assert "Held out" in page
    assert "RMS error of mass.a" in page


@pytest.mark.parametrize(
    ("chosen", "sentence"),
    [
        ({"data": []}, "There are no records; give at least one."),
        ({"validation": "medum"}, "validation: there is no record 'medum': did you mean 'medium'"),
        ({"validation": ["short", "long", "medium"]}, "validation='short', 'long', 'medium' leaves no"),
        ({"x0": {"shrt": {"mass.s": 0.0}}}, "x0: there is no record 'shrt': did you mean 'short'"),
        ({"x0": {"short": "data"}}, "x0 says nothing about the records 'long', 'medium'."),
        ({"x0": "rest"}, "x0='rest' is not an initial state"),
        ({"per_record": {"spring.k": 1.0}}, "per_record: no parameter 'spring.k'"),
        ({"per_record": {"spring.c": -1.0}}, "per_record: 'spring.c' has the spread -1.0; give"),
        ({"per_record": ["spring.c"]}, "per_record=['spring.c'] is not standard deviations by name, such as"),
        ({"sequence_length": 9.0}, "sequence_length=9 s is 900 samples; the longest record has 601"),
    ],
)  # fmt: skip
def test_mistakes_get_one_sentence(chosen: dict[str, Any], sentence: str):
    chosen = dict(chosen)
    data = chosen.pop("data", runs())
    with pytest.raises((ac.DataError, ac.TrainingError)) as error:
        ac.fit(plain(), data, "mass.a", **({"modifiers": ["mass.m"], "progress": False} | chosen))
    assert str(error.value).startswith(sentence)
