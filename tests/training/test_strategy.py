"""Strategies of training: L-BFGS, equation error, initial states that are found."""

from __future__ import annotations

from functools import cache
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal._jax import levenberg_marquardt
from acausal.training.build_problem import build_problem
from acausal.training.history import TrainingLog
from acausal.training.objective.records import Places
from acausal.training.objective.sequences import Batch
from acausal.training.objective.smoothing import rate, smoothed
from acausal.training.objective.whole_record import over_whole_record
from acausal.training.optimizers.gradients import LossDerivatives
from acausal.training.optimizers.trainer import Trainer, advance, begin
from acausal.training.options import FitOptions
from tests.support.oscillator import learned, record

QUIET: dict[str, Any] = {"progress": False}


# -- L-BFGS ------------------------------------------------------------------------------------------


def descend(function: Any, start: Any, updates: int) -> tuple[Any, Any]:
    optimizer = ac.lbfgs()

    @jax.jit
    def one(x: Any, state: Any) -> tuple[Any, Any]:
        value, gradient = jax.value_and_grad(function)(x)
        finite = jnp.isfinite(value)
        gradient = jax.tree.map(lambda g: jnp.where(finite, g, 0.0), gradient)
        moves, state = optimizer.update(gradient, state, x, value=jnp.where(finite, value, jnp.inf))
        return jax.tree.map(jnp.add, x, moves), state

    x, state = start, optimizer.init(start)
    for _ in range(updates):
        x, state = one(x, state)
    return x, state


@pytest.mark.slow
def test_lbfgs_follows_a_curved_valley():
    def rosenbrock(x: Any) -> Any:
        x = jnp.concatenate(x)
        return jnp.sum(100 * (x[1:] - x[:-1] ** 2) ** 2 + (1 - x[:-1]) ** 2)

    _, state = descend(rosenbrock, [jnp.zeros(12), jnp.zeros(8)], 150)
    assert float(state.value) < 1e-15
    np.testing.assert_allclose(state.point, 1.0, atol=1e-6)


@pytest.mark.slow
def test_lbfgs_takes_back_steps_to_where_there_is_no_value():
    _, state = descend(lambda x: jnp.sum(x - jnp.log(x) + (x - 3) ** 2), jnp.full(5, 0.01), 60)
    np.testing.assert_allclose(state.point, (5 + np.sqrt(33)) / 4, rtol=1e-6)
    assert np.isfinite(float(state.value))


def test_lbfgs_says_when_it_finds_nothing_better():
    _, state = descend(lambda x: jnp.sum(x**2), jnp.ones(3), 80)
    assert bool(state.converged)
    assert float(state.value) == pytest.approx(0.0, abs=1e-20)


SCALES = np.logspace(0, 2, 10)


@pytest.mark.cases(fast=1, slow=9)
@pytest.mark.parametrize("times", [1.01, 1.1, 2.0, 10.0, 100.0])
@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_lbfgs_does_not_ruin_a_good_start(times: float, unit: float):
    """A root mean square over stiff and loose directions alike, as of networks; at best it is 0.02 of its unit."""

    def loss(x: Any) -> Any:
        return unit * jnp.sqrt(jnp.sum((jnp.asarray(SCALES) * x) ** 2) + 0.02**2)

    away = np.random.default_rng(3).standard_normal(len(SCALES)) / SCALES
    start = jnp.asarray(0.02 * np.sqrt(times**2 - 1) * away / np.linalg.norm(SCALES * away))
    trial, _ = descend(loss, start, 1)
    assert float(loss(trial)) < 1.1 * float(loss(start))
    _, state = descend(loss, start, 150)
    assert float(state.value) < 1.001 * 0.02 * unit


class Valley(eqx.Module):
    """A kinked valley with its minimum at 1; beyond ``edge`` there is no loss, or no gradient."""

    edge: float
    value: bool

    def draw(self, key: Any, update: Any) -> Batch:
        return Batch(jnp.zeros(1, int), jnp.ones(1), None)

    def losses(self, x: Any, batch: Batch) -> Any:
        beyond = x > self.edge
        if self.value:
            spoilt = jnp.where(beyond, jnp.inf, 0.0)
        else:  # zero, with an infinite derivative
            spoilt = jnp.where(beyond, jnp.sqrt(jnp.where(beyond, x - x, 1.0)), 0.0)
        return (jnp.sqrt(1 + (50 * (x - 1)) ** 2) + spoilt)[None]

    def weighed(self, loss: Any, x: Any) -> Any:
        return loss

    def entry(self, best: Any) -> Any:
        return best

    def penalties(self, x: Any) -> dict[str, Any]:
        return {}


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("value", [True, False])
def test_lbfgs_survives_a_trial_that_fails(value: bool):
    """The slope far from the kink lets the second trial be long, so that it leads beyond the edge."""
    trainer = Trainer(ac.lbfgs(), 1e3, lambda objective, x: {})
    state = begin(trainer, jnp.asarray(0.95), jax.random.key(0))
    state, rows = advance(Valley(1.004, value), trainer, state, jnp.asarray(20))
    log = TrainingLog(Places(np.zeros(1), np.zeros(3, int), ("record",)), (), ())
    assert log.add(rows, 20, 0.0, 1.0) == []
    assert int(state.rejected) == 0
    assert float(state.optimizer.point[0]) == pytest.approx(1.0, abs=1e-9)
    history = log.history()
    assert bool(rows.turned_down[2])
    assert history.loss[2] == history.loss[0]
    if value:
        assert history.tried[2] == np.inf
    assert (np.diff(history.loss) <= 0).all()
    assert log.loss == history.loss[-1]


@pytest.mark.parametrize("times", [1.01, 2.0, 10.0, 100.0])
def test_trials_that_gauss_newton_turns_down_are_no_divergence(times: float):
    """Where the model is so curved that the first step leads beyond where it has a loss."""
    start = jnp.asarray([1.0 + np.sqrt(times**2 - 1)])

    def evaluate(objective: Any, x: Any, batch: Any) -> LossDerivatives:
        slope = (x - 1) / jnp.sqrt(1 + (x - 1) ** 2)
        loss = jnp.where(x > -50, jnp.sqrt(1 + (x - 1) ** 2), jnp.inf)
        none = jnp.zeros(1, bool)
        return LossDerivatives(
            loss, {}, loss[0], slope, none, (1 / (1 + (x - 1) ** 2) ** 1.5)[None]
        )

    trainer = Trainer(levenberg_marquardt(), 1e3, lambda objective, x: {}, evaluate)
    state = begin(trainer, start, jax.random.key(0))
    state, rows = advance(Valley(np.inf, True), trainer, state, jnp.asarray(60))
    log = TrainingLog(Places(np.zeros(1), np.zeros(3, int), ("record",)), (), ())
    made = int(state.epoch)
    assert log.add(rows, made, 0.0, 1.0) == []
    history = log.history()
    assert bool(rows.turned_down[:made].any()) == (times > 1.5)
    assert (np.diff(history.loss) <= 0).all()
    assert history.loss[-1] == pytest.approx(1.0, rel=1e-6)


class Explosive(eqx.Module):
    """A cubic spring with so large a unit of its weight that some trial of L-BFGS diverges."""

    weight: Any

    def __call__(self, x: Any) -> Any:
        return 1e8 * self.weight * x**3


@pytest.mark.slow
def test_a_segment_over_the_whole_record_survives_a_trial_that_diverges():
    params = learned().parameters() | {"extra.net": Explosive(jnp.asarray(0.0))}
    fit = ac.fit(
        learned(), record(end=5.0), "mass.a", params=params, strategy="whole_record", epochs=40, **QUIET
    )  # fmt: skip
    assert not fit.history.divergences
    assert not (fit.history.tried <= 10 * fit.history.loss[0]).all()
    assert (np.diff(fit.history.loss) <= 0).all()
    assert (np.diff(fit.history.full_loss[:, 1]) <= 1e-9).all()
    assert float(fit.params["extra.net"].weight) * 1e8 == pytest.approx(80.0, rel=0.02)
    assert "diverged" not in repr(fit)


# -- equation error ----------------------------------------------------------------------------------


@cache
def equation_error() -> ac.Fit:
    return ac.fit(
        learned(), record(), "mass.a", strategy="equation_error", epochs=100, x0="model", **QUIET
    )


@pytest.mark.slow
def test_the_equation_error_finds_a_law_without_simulation():
    fit = equation_error()
    assert fit.loss < 0.02 * fit.loss_before
    assert fit.history.epochs <= 100


@pytest.mark.slow
def test_segments_follow_each_other_from_the_best():
    fit = ac.fit(
        learned(), record(), "mass.a", strategy=("equation_error", "whole_record"),
        epochs=(100, 10), x0="model", evaluate_every=5, **QUIET,
    )  # fmt: skip
    first = equation_error()
    assert 100 < fit.history.epochs <= 110
    assert fit.loss < first.loss
    assert list(fit.history.full_loss[:, 0]) == sorted(set(fit.history.full_loss[:, 0]))
    np.testing.assert_allclose(fit.history.loss[:100], first.history.loss)


def test_smoothing_takes_out_noise_and_leaves_what_has_none():
    t = np.linspace(0, 10, 2001)
    clean = np.sin(4 * t) + 0.3 * np.sin(21 * t)
    noisy = clean + 0.05 * np.random.default_rng(0).standard_normal(len(t))
    assert np.std(smoothed(noisy) - clean) < 0.4 * 0.05
    np.testing.assert_allclose(smoothed(clean), clean, atol=1e-5)
    np.testing.assert_array_equal(smoothed(np.full(50, 2.0)), 2.0)
    np.testing.assert_array_equal(smoothed(clean[:3]), clean[:3])
    true = 4 * np.cos(4 * t) + 6.3 * np.cos(21 * t)
    assert np.std(rate(t, noisy) - true) < 0.15 * np.std(true)
    assert np.std(np.gradient(noisy, t) - true) > 1.0 * np.std(true)
    gap = np.where((t > 3) & (t < 4), np.nan, clean)
    np.testing.assert_array_equal(np.isnan(rate(t, gap)), np.isnan(gap))


def test_smoothed_states_lessen_the_bias_of_noise():
    data, rng = record(), np.random.default_rng(1)
    signals = {n: s + 0.05 * s.std() * rng.standard_normal(len(s)) for n, s in data.signals.items()}
    noisy = ac.Data(data.time, {**signals, "push.f": data["push.f"]})
    fit = ac.fit(
        learned(), noisy, "mass.a", strategy="equation_error", epochs=60, x0="model", **QUIET
    )
    assert fit.loss < 0.12
    assert fit.loss_before > 0.5


# -- initial states that are found -------------------------------------------------------------------


def without_states(end: float | None = None) -> ac.Data:
    data = record() if end is None else record(end=end)
    return data.select(["mass.a", "push.f"])


@pytest.mark.slow
def test_the_state_at_the_start_is_found():
    data = record()
    later = data.between(data.time[300], data.time[900])
    fit = ac.fit(
        learned(), later.select(["mass.a", "push.f"]), "mass.a",
        strategy="whole_record", x0="fit", epochs=80, solver="rk4",
        regularizers=[ac.ZeroCrossing(1.0)], **QUIET,
    )  # fmt: skip
    assert fit.loss < 0.02
    for name in learned().states:
        assert fit.x0[name] == pytest.approx(later[name][0], abs=0.05 * later[name].std())


@pytest.mark.slow
def test_batches_of_sequences_need_no_measured_states():
    fit = ac.fit(
        learned(), without_states(10.0), "mass.a", x0="fit", sequence_length=0.5, batch_size=5,
        epochs=300, **QUIET,
    )  # fmt: skip
    assert fit.loss < 0.3 * fit.loss_before


@cache
def shooting() -> Any:
    system = learned()
    data, options = without_states(), FitOptions(sequence_length=0.5, batch_size=3, x0="fit")
    return build_problem(
        system, {"record": data.for_system(system)}, ("mass.a",), system.parameters(0), options
    )


@pytest.mark.slow
def test_sequences_lie_side_by_side():
    cut = shooting().sequences
    starts = np.sort(cut.draw(jax.random.key(0)).start)
    assert len(set(starts.tolist())) == 3
    assert not np.any(starts % cut.length)
    assert len(shooting().records) - len(cut.starts) * cut.length < len(cut.starts)
    assert over_whole_record(shooting()).sequences.always_alike


def test_states_of_records_are_those_of_their_first_parts():
    problem = shooting()
    whole = over_whole_record(problem)
    found = eqx.tree_at(lambda t: t.states, whole.start(), jnp.ones_like(whole.start().states))
    states = np.asarray(problem.entry(found).states)
    assert len(states) == len(problem.sequences.starts) > 1
    assert np.all(states[0] == 1.0)
    assert not states[1:].any()  # the others were not found
    np.testing.assert_array_equal(whole.entry(problem.entry(found)).states, found.states)


@pytest.mark.slow
def test_parts_of_one_trajectory_have_no_gaps():
    """Shooting states start on the model's own trajectory: sequences and the whole record agree."""
    problem = shooting()
    length, parts = problem.sequences.length, len(problem.sequences.starts)
    batch = Batch(jnp.arange(parts) * length, jnp.ones(parts), None)
    losses = problem.losses(problem.start(), batch)
    whole = over_whole_record(problem)
    total = whole.simulate(whole.start()).loss
    assert float(jnp.sqrt(jnp.mean(losses**2))) == pytest.approx(float(total), rel=1e-3)
    moved = eqx.tree_at(lambda t: t.states, problem.start(), problem.start().states.at[2].add(0.1))
    gap = problem.losses(moved, batch) - losses
    assert float(gap[1]) == pytest.approx(float(problem.shooting.continuity) * 0.01, rel=1e-6)
    assert float(gap[0]) == 0.0


@pytest.mark.slow
def test_the_gradient_with_initial_states_is_that_of_differences():
    problem = shooting()
    start, batch = problem.start(), problem.draw(jax.random.key(1))
    start = jax.tree.map(lambda a: a + 0.1, start)

    @eqx.filter_jit
    def total(trainable: Any) -> Any:
        return jnp.mean(problem.losses(trainable, batch))

    gradient = jax.grad(total)(start)
    along = jax.tree.map(lambda a: jax.random.normal(jax.random.key(2), a.shape), start)
    change = sum(map(jnp.sum, jax.tree.leaves(jax.tree.map(jnp.multiply, gradient, along))))
    ends = [total(jax.tree.map(lambda a, d, e=e: a + e * d, start, along)) for e in (1e-6, -1e-6)]
    assert float(change) == pytest.approx(float(ends[0] - ends[1]) / 2e-6, rel=1e-6)


# -- mistakes ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("chosen", "sentence"),
    [
        ({"strategy": "equation_eror"}, "No strategy 'equation_eror': did you mean 'equation_error'?"),
        ({"strategy": "equation_error", "data": ["mass.a", "push.f"]},
         ("The equation error needs all states in the data: "
          "leave 'equation_error' out of the strategy, or measure them.")),
        ({"strategy": "equation_error", "targets": "mass.s"},
         ("At an instant no target depends on 'extra.net': the equation error cannot train it. "
          "Add a target that does, such as a force or an acceleration, or leave 'equation_error' out.")),
        ({"epochs": (3, 4)}, "epochs=(3, 4) for the strategy ('auto',): give one number, or one for each part."),
        ({"epochs": 0}, "epochs=0; give a whole number, 1 or more."),
        ({"dt": "0.01"}, "dt='0.01' is not a step; give a positive time in seconds."),
        ({"epochs": 2.5}, "epochs=2.5; give a whole number, 1 or more."),
        ({"evaluate_every": 0}, "evaluate_every=0; give a whole number, 1 or more."),
        (
            {"optimizer": optax.adam(0.01), "strategy": "whole_record"},
            "optimizer= is for sequences, but the strategy is whole_record, which has its own: leave it out.",
        ),
        ({"optimizer": "adam"}, "optimizer='adam' is not an optax optimizer; give one such as optax.adam(0.01)."),
        ({"regularizers": [0.1]}, "0.1 is not a function, but the training calls it."),
        ({"observers": [0.1]}, "0.1 is not a function, but the training calls it."),
        ({"optimizer": ac.lbfgs(), "sequence_length": 0.5},
         ("L-BFGS compares losses of the same data, and every batch holds others: take the whole record "
          "(sequence_length=None), or strategy=('sequences', 'whole_record') with another optimizer.")),
    ],
)  # fmt: skip
def test_mistakes_get_one_sentence(chosen: dict[str, Any], sentence: str):
    data = record(end=2.0).select(chosen.pop("data", record().signals))
    targets = chosen.pop("targets", "mass.a")
    with pytest.raises(ac.TrainingError) as error:
        ac.fit(learned(), data, targets, x0="model", **QUIET, **chosen)
    assert str(error.value) == sentence
