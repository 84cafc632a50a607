"""Several starts of trained parameters: where they lie, which of them go on, and what is told about them."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.training.build_problem import build_problem
from acausal.training.objective.problem import Problem
from acausal.training.optimizers.trainer import Trainer, advance, begin
from acausal.training.options import FitOptions
from acausal.training.starts import Halving, Rung, Starts, halving, spread_starts
from tests.support import oscillator
from tests.training.test_checkpoint import stop

BOUNDS = {"spring.c": ac.Bounded(5.0, 500.0), "spring.d": ac.Bounded(0.02, 2.0)}


class Oscillator(ac.Component):
    """A mass on a spring and a weak damper, let go at 1 m."""

    def __init__(self) -> None:
        super().__init__()
        self.fixed, self.spring = tl.Fixed(s0=0.0), tl.SpringDamper(c=50.0, d=0.2)
        self.mass = tl.Mass(m=2.0, s=ac.Start(1.0, fixed=True), v=ac.Start(0.0, fixed=True))
        self.connect(self.fixed.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)


@cache
def system() -> ac.System:
    return ac.compile(Oscillator())


@cache
def record() -> ac.Data:
    ts = np.arange(801) * 0.02
    s = np.asarray(ac.simulate(system(), (0, 16), dt=0.02)["mass.s"])
    return ac.Data(ts, {"mass.s": s + np.random.default_rng(0).normal(0, 0.005, len(ts))})


def train(**options: Any) -> ac.Fit:
    defaults: dict[str, Any] = {
        "params": {"spring.c": 12.5}, "modifiers": BOUNDS, "strategy": "gauss_newton", "epochs": 40,
        "x0": "model", "starts": 12, "progress": False,
    }  # fmt: skip
    return ac.fit(system(), record(), "mass.s", **(defaults | options))


@cache
def trained() -> ac.Fit:
    return train()


def starts() -> Starts:
    found = trained().starts
    assert found is not None
    return found


@pytest.mark.machines
def test_several_starts_find_what_a_single_one_misses():
    with pytest.warns(UserWarning, match=r"spring\.d.*limit"):
        alone = train(starts=1)
    assert alone.starts is None
    assert alone.loss > 0.5
    fit = trained()
    assert fit.loss < 0.02
    assert fit.params["spring.c"] == pytest.approx(50.0, rel=0.01)
    assert fit.loss == starts().loss.min() == starts().loss[starts().best]


@pytest.mark.slow
def test_the_given_start_is_the_first_and_trains_as_it_does_alone():
    table = starts()
    np.testing.assert_allclose(table.values[0], (12.5, 0.2))
    assert len(table) == len(np.unique(table.values[:, 0])) == 12
    with (
        pytest.warns(UserWarning, match=r"spring\.d.*limit"),
        pytest.warns(UserWarning, match="no better than the targets' mean"),
    ):
        alone = train(starts=1, epochs=halving(12, 40).rungs[0].at)
    assert table.loss_before[0] == pytest.approx(alone.loss_before)
    assert table.loss[0] <= alone.loss * (1 + 1e-9)


@pytest.mark.slow
def test_only_the_best_go_on():
    table, plan = starts(), halving(12, 40)
    assert plan.rungs == (Rung(12, 3), Rung(24, 2))
    order = np.argsort(table.loss)
    assert (table.updates[order[3:]] <= 12).all()
    assert (table.updates[order[2:3]] <= 24).all()
    assert table.finished[order[:2]].all()


@pytest.mark.slow
def test_the_same_seed_gives_the_same_starts_and_another_one_others():
    again = train(epochs=2).starts
    assert again is not None
    np.testing.assert_array_equal(again.values, starts().values)
    other = train(epochs=2, seed=1).starts
    assert other is not None
    assert (other.values[1:] != starts().values[1:]).all()
    np.testing.assert_array_equal(other.values[0], starts().values[0])


def test_a_table_tells_how_many_starts_reach_which_minimum(tmp_path: Path):
    table = starts()
    lowest = table.minima[0]
    assert lowest.loss == trained().loss
    assert lowest.values["spring.c"] == pytest.approx(50.0, rel=0.01)
    assert f"{lowest.count} of 12 starts reach the loss" in table.summary()
    assert table.summary() in repr(trained())
    assert len(repr(table).splitlines()) == 2 + 12
    page = trained().report(tmp_path).read_text()
    assert table.summary() in page


def told(losses: list[float], finished: list[bool]) -> Starts:
    n = len(losses)
    zeros = np.zeros((n, 1))
    return Starts(
        ("p",), zeros, zeros, np.ones(n), np.array(losses), np.ones(n, int), np.array(finished)
    )


def test_minima_are_counted():
    table = told([0.1, 0.4, 0.1005, 0.3, math.inf], [True, True, False, False, False])
    assert [(m.loss, m.count) for m in table.minima] == [(0.1, 2), (0.4, 1)]
    assert table.summary() == (
        "2 of 5 starts reach the loss 0.1; the next minimum is 0.4; 1 ended early at higher losses; 1 diverged."
    )
    assert told([math.inf, math.inf], [True, True]).summary() == "All of 2 starts diverged."


def test_a_quarter_goes_on_and_never_fewer_than_two():
    assert halving(32, 50).rungs == (Rung(15, 8), Rung(30, 2))
    assert halving(4, 50).rungs == (Rung(15, 2),)
    assert halving(1, 50).rungs == halving(2, 50).rungs == ()
    plan = halving(8, 10)
    scores = [5.0, 1.0, math.inf, 2.0, 8.0, 7.0, 1.0, 9.0]
    assert plan.survivors(scores, 2) == list(range(8))
    assert plan.survivors(scores, 3) == [1, 6]
    assert plan.until_next(1) == 2
    assert Halving().until_next(1) == math.inf


def test_starts_are_spread_over_the_ranges_of_modifiers():
    options = FitOptions(
        x0="model",
        modifiers={
            "spring.c": ac.Bounded(5.0, 500.0),
            "spring.d": ac.Bounded(0.1, 0.3),
            "mass.m": 0.5,
            "fixed.s0": ac.Shift(0.1),
        },
    )
    params = dict(system().parameters())
    problem = build_problem(
        system(), {"a": record().for_system(system())}, ("mass.s",), params, options
    )
    given, *others = spread_starts(problem, 65, 0)
    assert jax.tree.all(jax.tree.map(lambda d: d == 0, given.modifiers))
    found = [problem.assemble(one) for one in others]
    c, d, m, s0 = (
        np.array([float(p[n]) for p in found])
        for n in ("spring.c", "spring.d", "mass.m", "fixed.s0")
    )
    assert np.median(np.log(c)) == pytest.approx(np.log(50.0), abs=0.1)  # over decades
    assert (c.min() < 6) & (c.max() > 400)
    assert np.quantile(d, (0.25, 0.5, 0.75)) == pytest.approx((0.15, 0.2, 0.25), abs=0.01)
    assert np.quantile(m, (0.25, 0.5, 0.75)) == pytest.approx((1.5, 2.0, 2.5), abs=0.05)
    assert (s0.mean(), s0.std()) == pytest.approx((0.0, 0.1), abs=0.02)


def test_a_positive_parameter_is_spread_by_factors():
    kind = ac.Bounded(0.0, math.inf)
    values = [
        float(kind.change(jnp.asarray(3.0), jnp.asarray(kind.free(3.0, q)))) + 3
        for q in (0.16, 0.5, 0.84)
    ]
    assert values == pytest.approx((3 / math.e, 3.0, 3 * math.e), rel=0.02)


@pytest.mark.slow
def test_starts_are_trained_on_side_by_side_as_one_after_the_other():
    """As on an accelerator; those that have ended stay as they are."""
    options = FitOptions(x0="model", modifiers=BOUNDS)
    params = {**system().parameters(), "spring.c": 12.5}
    data = {"a": record().for_system(system())}
    problem = build_problem(system(), data, ("mass.s",), params, options)
    trainer = Trainer(optax.with_extra_args_support(optax.adam(0.01)), np.inf, Problem.changes)
    begun = [begin(trainer, one, jax.random.key(0)) for one in spread_starts(problem, 3, 0)]
    state = jax.tree.map(lambda *rows: jnp.stack(rows), *begun)
    active = jnp.array([True, False, True])
    (a, _), (b, _) = (
        advance(problem, trainer, state, jnp.asarray(3), active=active, side_by_side=side)
        for side in (False, True)
    )
    assert a.epoch.tolist() == b.epoch.tolist() == [3, 0, 3]
    for one, other, before in zip(
        *map(jax.tree.leaves, (a.trainable, b.trainable, state.trainable)), strict=True
    ):
        np.testing.assert_allclose(one, other, rtol=1e-9)
        assert one[1] == before[1]
        assert one[0] != before[0]


@pytest.mark.slow
def test_starts_that_diverge_end_no_others(recwarn: pytest.WarningsRecorder):
    """A mass of a gram on this spring diverges in steps of 20 ms."""
    wide = {"mass.m": ac.Bounded(1e-4, 1e3), "spring.d": ac.Bounded(0.02, 2.0)}
    fit = train(modifiers=wide, params={"mass.m": 8.0}, starts=16)
    assert fit.params["mass.m"] == pytest.approx(2.0, rel=0.01)
    assert fit.starts is not None
    assert (~np.isfinite(fit.starts.loss_before)).sum() > 2
    assert not [w for w in recwarn if "diverge" in str(w.message)]


@pytest.mark.slow
def test_an_interrupted_training_of_several_starts_goes_on(tmp_path: Path):
    fit = train(checkpoint=tmp_path, checkpoint_every=0.0, observers=[stop(14)])
    assert fit.interrupted
    assert fit.starts is not None
    assert fit.starts.loss.min() == fit.loss
    again = train(checkpoint=tmp_path, resume=True)
    assert again.loss == trained().loss
    assert again.starts is not None
    np.testing.assert_array_equal(again.starts.loss, starts().loss)
    np.testing.assert_array_equal(again.starts.updates, starts().updates)
    np.testing.assert_array_equal(again.starts.finished, starts().finished)


@pytest.mark.slow
def test_parts_of_a_strategy_follow_each_other():
    fit = train(strategy=("whole_record", "gauss_newton"), epochs=(12, 20), starts=5)
    assert fit.starts is not None
    assert fit.starts.updates.max() <= 32
    assert fit.loss < 0.02


@pytest.mark.slow
def test_what_cannot_be_is_refused():
    with pytest.raises(ac.TrainingError, match="starts=0; give a whole number, 1 or more"):
        train(starts=0)
    with pytest.raises(ac.TrainingError, match=r"starts=3 spreads trained parameters"):
        ac.fit(oscillator.learned(), oscillator.record(end=5.0), "mass.a", starts=3, progress=False)
    with pytest.raises(ac.TrainingError, match="one device"):
        train(devices=jax.devices())
    with pytest.raises(ac.TrainingError, match="leave out starts="):
        ac.ensemble(system(), record(), "mass.s", starts=3, modifiers=BOUNDS)
