"""Cross-validation: what a fold leaves out trains nothing, and is predicted; all folds share one program."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from acausal.training.objective.folds import judged_on, left_out, without
from acausal.training.options import FitOptions
from tests.support.counted import compilations
from tests.support.oscillator import plain
from tests.training.test_checkpoint import stop
from tests.training.test_records import pose, run

OPTIONS: dict[str, Any] = {
    "modifiers": ["mass.m", "spring.d"], "gamma": 0.9, "strategy": "gauss_newton", "epochs": 12,
    "progress": False,
}  # fmt: skip

ONE_EPOCH: dict[str, Any] = OPTIONS | {"epochs": 1}


def noisy(data: ac.Data, seed: int) -> ac.Data:
    rng = np.random.default_rng(seed)
    s = data.signals["mass.s"]
    return ac.Data(data.time, {**data.signals, "mass.s": s + rng.normal(0, 0.02 * s.std(), len(s))})


@cache
def records() -> dict[str, ac.Data]:
    """Three runs of unequal lengths with noise; the springs differ from day to day."""
    days = (("a", 2.0, 46.0), ("b", 6.0, 50.0), ("c", 4.0, 57.0))
    return {
        name: noisy(run(end, k, **{"spring.c": c}), k)
        for k, (name, end, c) in enumerate(days, start=1)
    }


def validate(data: Any = None, **options: Any) -> ac.CrossValidation:
    return ac.cross_validate(plain(), data or records(), "mass.s", **(OPTIONS | options))


@cache
def compiled_and_found() -> tuple[list[str], ac.CrossValidation]:
    with compilations() as compiled:
        found = validate()
    return compiled, found


def by_record() -> ac.CrossValidation:
    return compiled_and_found()[1]


@pytest.mark.slow
def test_each_record_is_left_out_in_turn():
    found = by_record()
    assert [fold.name for fold in found.folds] == ["a", "b", "c"]
    for fold in found.folds:
        assert list(fold.fit.held_out) == [fold.name]
        assert list(fold.fit.records) == [n for n in records() if n != fold.name]
        error = fold.fit.held_out[fold.name].errors[:, 0]
        assert fold.rms["mass.s"] == pytest.approx(np.sqrt(np.mean(error**2)))
        sigma = float(fold.fit.problem.records.sigma[0])
        assert fold.held_out_loss == pytest.approx(fold.rms["mass.s"] / sigma)
    assert list(found.records) == ["a", "b", "c"]


@pytest.mark.slow
def test_a_fold_is_the_training_without_the_record():
    fold = by_record().folds[1]
    alone = ac.fit(plain(), {n: d for n, d in records().items() if n != "b"}, "mass.s", **OPTIONS)
    for name in ("mass.m", "spring.d"):
        assert fold.fit.params[name] == pytest.approx(float(alone.params[name]), rel=1e-6)
    assert fold.fit.rms["mass.s"] == pytest.approx(alone.rms["mass.s"], rel=1e-6)


def test_folds_share_one_program():
    compiled, _ = compiled_and_found()
    assert compiled.count("jit(advance)") == 1


def test_mean_and_spread_are_those_of_the_folds():
    found = by_record()
    losses = [fold.held_out_loss for fold in found.folds]
    assert found.held_out_loss == pytest.approx((np.mean(losses), np.std(losses, ddof=1)))
    masses = [float(fit.params["mass.m"]) for fit in found.fits]
    assert found.parameters["mass.m"] == pytest.approx((np.mean(masses), np.std(masses, ddof=1)))
    assert found.training_loss.mean == pytest.approx(
        np.mean([f.training_loss for f in found.folds])
    )
    worst = max(found.folds, key=lambda fold: fold.held_out_loss).name
    assert f"worst without '{worst}'" in found.summary()
    assert "m RMS of mass.s" in found.summary()
    assert len(repr(found).splitlines()) == 2 + 3 + 1


def test_blocks_of_time_are_left_out_of_every_record():
    found = validate(folds=3)
    assert [fold.name for fold in found.folds] == [f"block {k} of 3" for k in (1, 2, 3)]
    middle = found.folds[1].fit.held_out["b"]
    known = middle.time[~np.isnan(middle.measured[:, 0])]
    assert (known[0], known[-1]) == pytest.approx((2.0, 3.99), abs=0.011)
    for name, record in found.records.items():  # every sample is left out once
        given = records()[name].signals["mass.s"]
        np.testing.assert_allclose(record.measured[:, 0], given, rtol=1e-12)
        np.testing.assert_array_equal(record.time, records()[name].time)


@pytest.mark.slow
def test_a_single_record_has_blocks_only():
    with pytest.raises(ac.DataError, match="there is only one: take folds=5"):
        validate(data=records()["a"])
    found = validate(data=records()["b"], folds=2, epochs=2)
    assert len(found.folds) == 2


@pytest.mark.slow
def test_what_is_left_out_has_no_gradient():
    """Neither in whole records nor in sequences, whatever state and parameter of their own they have."""
    problem = pose(
        records(), per_record={"spring.c": None}, x0="fit", sequence_length=0.5, batch_size=24
    )
    fold = left_out(problem.records, "records")[1]
    own = without(problem, fold)
    start = own.start()

    def loss(trainable: Any) -> Any:
        batch = own.draw(jax.random.key(0))
        return jnp.average(own.losses(trainable, batch), weights=batch.weight)

    gradient = jax.jit(jax.grad(loss))(start)
    assert gradient.per_record["spring.c"][1] == 0
    assert (gradient.per_record["spring.c"][jnp.array([0, 2])] != 0).all()
    assert own.shooting is not None
    rows = np.asarray(own.sequences.starts)[np.asarray(own.sequences.weight) > 0]
    assert not np.any(fold.rows[rows])


@pytest.mark.parametrize("batch_size", [2, 24])
def test_sequences_lie_outside_of_what_is_left_out(batch_size: int):
    for x0 in ("data", "fit"):
        problem = pose(records(), x0=x0, sequence_length=0.5, batch_size=batch_size)
        for fold in left_out(problem.records, 2):
            own = without(problem, fold)
            assert own.sequences.starts.shape == problem.sequences.starts.shape
            batch = own.draw(jax.random.key(1))
            weight = np.asarray(own.records.weight).any(axis=1)
            for start in np.asarray(batch.start)[np.asarray(batch.weight) > 0]:
                assert weight[start : start + own.sequences.length].any()


def test_a_record_that_is_left_out_is_predicted_with_what_is_expected_of_it():
    """Free values: their mean over the records trained on; where states are trained, from its measured one."""
    problem = pose(records(), per_record={"spring.c": None}, x0="fit")
    fold = left_out(problem.records, "records")[2]
    data = {n: d.for_system(plain()) for n, d in records().items()}
    judged = judged_on(problem, fold, data, "fit")
    start = problem.start()
    moves = jnp.array([0.1, 0.3, 7.0])
    known = judged.over_other_records(replace(start, per_record={"spring.c": moves}))
    np.testing.assert_allclose(known.per_record["spring.c"], 0.2)
    packed = judged.pack(judged.assemble(known), known)
    np.testing.assert_allclose(
        judged.start_states(known, packed)[2],
        [records()["c"].signals[n][0] for n in plain().states],
    )


@pytest.mark.slow
def test_a_parameter_of_each_record_leaves_the_others_better(tmp_path: Path):
    common, own = by_record(), validate(per_record={"spring.c": 5.0})
    assert own.training_loss.mean < 0.5 * common.training_loss.mean
    page = own.report(tmp_path).read_text()
    assert own.summary().split(";")[0] in page
    assert "What was left out" in page
    assert "Trained parameters" in page


def test_a_fold_says_how_it_was_trained():
    """The options and the seed, as a fit does."""
    alone = ac.fit(plain(), records()["a"], "mass.s", seed=3, **ONE_EPOCH)
    for fit in validate(seed=3, epochs=1).fits:
        assert fit.settings == alone.settings


@pytest.mark.slow
def test_folds_begin_where_an_earlier_training_ended():
    earlier = by_record().fits[0]
    found = validate(prior=earlier, epochs=1)
    for fit in found.fits:
        for name in ("mass.m", "spring.d"):
            assert fit.problem.params[name] == pytest.approx(float(earlier.params[name]))
    given = validate(prior=earlier, epochs=1, params={"mass.m": 1.5})
    assert given.fits[0].problem.params["mass.m"] == pytest.approx(1.5)


class Stepped(ac.Component):
    """A lag behind a step, whose time acts through a condition alone."""

    def __init__(self) -> None:
        super().__init__()
        self.step = blocks.Step(startTime=0.5)
        self.lag = blocks.FirstOrder(T=0.3, y=ac.Start(0.0, fixed=True))
        self.connect(self.step.y, self.lag.u)


@pytest.mark.slow
def test_conditions_that_a_trained_parameter_moves_are_watched():
    """Without events the time of a step has no gradient, and stays where it is."""
    t = np.linspace(0.0, 2.0, 21)
    late = np.maximum(t - 0.6, 0.0)
    data = ac.Data(t, {"lag.y": 1 - np.exp(-late / 0.3)})
    found = ac.cross_validate(
        ac.compile(Stepped()), data, "lag.y", folds=2, x0="model",
        modifiers={"step.startTime": ac.Bounded(0.3, 0.9)},
        strategy="gauss_newton", epochs=5, solver="rk4", progress=False,
    )  # fmt: skip
    assert found.fits[1].params["step.startTime"] == pytest.approx(0.6, abs=0.02)


@pytest.mark.parametrize(
    "wrong",
    [{"seed": 0.5}, {"params": [1.0]}, {"targets": 3}],
    ids=["seed", "params", "targets"],
)
def test_all_trainings_refuse_alike(wrong: dict[str, Any]):
    """`fit` and `cross_validate` check what they are given in one place."""
    said: list[str] = []
    for function in (ac.fit, ac.cross_validate):
        call: dict[str, Any] = {"targets": "mass.s", **OPTIONS, **wrong}
        with pytest.raises((ac.DataError, ac.TrainingError)) as caught:
            function(plain(), records(), **call)
        said.append(str(caught.value))
    assert said[0] == said[1]


@pytest.mark.slow
def test_several_starts_go_into_every_fold():
    found = validate(starts=4, epochs=6)
    assert all(fit.starts is not None and len(fit.starts) == 4 for fit in found.fits)


def test_ctrl_c_keeps_the_folds_that_are_complete():
    seen: list[Any] = []

    def third(progress: Any) -> None:
        if progress.epoch == 1:
            seen.append(progress)
        if len(seen) == 3:
            raise KeyboardInterrupt

    found = validate(observers=[third])
    assert [fold.name for fold in found.folds] == ["a", "b"]
    with pytest.raises(KeyboardInterrupt):
        validate(observers=[stop(1)])


def test_what_cannot_be_is_refused():
    with pytest.raises(ac.TrainingError, match="no validation=: it holds out"):
        validate(validation=0.2)
    with pytest.raises(ac.TrainingError, match="no checkpoint="):
        validate(checkpoint="x")
    with pytest.raises(ac.DataError, match="folds=1; give 'records', or a number of blocks"):
        validate(folds=1)
    with pytest.raises(ac.DataError, match="'days'"):
        validate(folds="days")  # pyright: ignore[reportArgumentType]
    gappy = ac.Data(
        np.arange(100) * 0.01,
        {**{n: x[:100] for n, x in records()["a"].signals.items()},
         "mass.s": np.where(np.arange(100) < 50, records()["a"].signals["mass.s"][:100], np.nan)},
        missing="nan",
    )  # fmt: skip
    with pytest.raises(ac.DataError, match=r"block 1 of 2.*no samples to train on"):
        validate(data=gappy, folds=2, x0="model")
    assert FitOptions().starts == 1
