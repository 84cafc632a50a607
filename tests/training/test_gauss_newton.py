"""Gauss-Newton: gradients and Hessians of simulations, damped steps, and trainings that use them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax.flatten_util import ravel_pytree

import acausal as ac
from acausal._jax import levenberg_marquardt
from acausal.training.build_problem import build_problem
from acausal.training.objective.problem import Problem
from acausal.training.objective.whole_record import over_whole_record
from acausal.training.optimizers.gradients import with_gauss_newton_hessian, with_gradient
from acausal.training.options import FitOptions
from tests.support.oscillator import C, learned, plain, record
from tests.support.slow_machine import slow_down

QUIET: dict[str, Any] = {"progress": False}


# -- derivatives -------------------------------------------------------------------------------------


def quartic(predicted: Any, measured: Any, sigma: Any) -> Any:
    return jnp.mean(((predicted - measured) / sigma) ** 4)


def posed(**chosen: Any) -> Problem:
    """The learned oscillator, all that can be trained in it, and a second model beside it."""
    system = learned()
    options = FitOptions(
        modifiers=["mass.m", "spring.c"], gamma=0.5, parameter_spread={"spring.d": 0.2}, x0="fit", **chosen
    )  # fmt: skip
    problem = build_problem(
        system, {"record": record(end=2.0)}, ("mass.a", "mass.s"), system.parameters(0), options
    )
    return over_whole_record(problem)


@pytest.mark.parametrize(
    "chosen",
    [
        pytest.param({}, marks=pytest.mark.slow),
        {"loss": quartic},
        {"regularizers": (ac.ZeroCrossing(1.0),)},
    ],
    ids=["nrmse", "another loss", "regularizer"],
)
def test_both_ways_give_one_gradient(chosen: dict[str, Any]):
    problem = posed(**chosen)
    at = jax.tree.map(lambda a: a + 0.01, problem.start())
    batch = problem.draw(jax.random.key(0))
    back, forth = (
        eqx.filter_jit(way)(problem, at, batch)
        for way in (with_gradient, with_gauss_newton_hessian)
    )
    assert float(forth.total) == pytest.approx(float(back.total), rel=1e-12)
    np.testing.assert_allclose(forth.losses, back.losses, rtol=1e-12)
    a, b = (ravel_pytree(found.gradient)[0] for found in (forth, back))
    np.testing.assert_allclose(a, b, rtol=1e-8, atol=1e-10 * float(jnp.abs(b).max()))


@pytest.mark.slow
def test_the_hessian_of_root_mean_squares_is_that_of_their_squares():
    """``J' J / ℓ``, of normalised errors, by finite differences of the predictions."""
    problem = posed()
    start, unravel = ravel_pytree(problem.start())
    predict = jax.jit(lambda z: problem.predictions(unravel(z)))
    rows = np.random.default_rng(0).choice(len(start), 4, replace=False)
    h = 1e-5
    derivatives = [
        (predict(start.at[i].add(h)) - predict(start.at[i].add(-h))) / (2 * h) for i in rows
    ]
    at = predict(start)
    losses = jax.vmap(problem.compare)(at)
    J = jnp.stack(derivatives) / problem.records.sigma
    expected = jnp.einsum("imnk,jmnk,m->ij", J, J, 1 / losses) / (len(problem.records) * len(at))
    found = eqx.filter_jit(with_gauss_newton_hessian)(
        problem, problem.start(), problem.draw(jax.random.key(0))
    )
    np.testing.assert_allclose(
        np.asarray(found.hessian)[np.ix_(rows, rows)], expected, rtol=1e-4, atol=1e-6
    )


# -- steps -------------------------------------------------------------------------------------------


def descend(residuals: Callable[[Any], Any], start: Any, updates: int) -> Any:
    """The method's state after updates of half the sum of squared residuals."""
    method = levenberg_marquardt()

    @jax.jit
    def one(x: Any, state: Any) -> tuple[Any, Any]:
        r, J = residuals(x), jax.jacfwd(residuals)(x)
        value = jnp.where(jnp.isfinite(r).all(), 0.5 * r @ r, jnp.inf)
        J, r = (jnp.where(jnp.isfinite(value), a, 0.0) for a in (J, r))
        moves, state = method.update(J.T @ r, state, x, value=value, hessian=J.T @ J)
        return x + moves, state

    x, state = start, method.init(start)
    for _ in range(updates):
        x, state = one(x, state)
    return state


def test_it_follows_a_curved_valley():
    def rosenbrock(x: Any) -> Any:
        return jnp.concatenate([10 * (x[1:] - x[:-1] ** 2), 1 - x[:-1]])

    state = descend(rosenbrock, jnp.asarray([-1.2, 1.0]), 30)
    assert bool(state.converged)
    np.testing.assert_allclose(state.point, 1.0, atol=1e-6)


def test_it_takes_back_steps_to_where_there_is_no_value():
    state = descend(lambda x: jnp.sqrt(x) - 0.2, jnp.full(3, 4.0), 40)
    np.testing.assert_allclose(state.point, 0.04, rtol=1e-4)


def test_it_ends_where_the_hessian_is_singular():
    """Two parameters of which only the sum matters: a Hessian without an inverse."""
    state = descend(lambda x: jnp.stack([x.sum() - 1.0, 2 * x.sum() - 1.0]), jnp.zeros(2), 20)
    assert bool(state.converged)
    assert float(state.point.sum()) == pytest.approx(0.6, rel=1e-6)


# -- trainings ---------------------------------------------------------------------------------------


def parameters(**chosen: Any) -> ac.Fit:
    """A training of an oscillator's parameters, from wrong ones, from an acceleration alone."""
    wrong = {**plain().parameters(), "spring.c": 1.3 * C, "mass.m": 1.5, "spring.d": 1.4}
    return ac.fit(
        plain(), true().select(["mass.a", "push.f"]), "mass.a", params=wrong, gamma=0.9, x0="fit",
        modifiers=["spring.c", "mass.m", "spring.d"], strategy="gauss_newton", **QUIET, **chosen,
    )  # fmt: skip


def true() -> ac.Data:
    ts = np.arange(0.0, 6.0, 0.01)
    force = 5 * np.sin(3 * ts) + 3 * np.sin(7 * ts)
    solution = ac.simulate(
        plain(), (0.0, 5.99), dt=0.01, inputs={"push.f": ac.Signal(ts, force)},
        x0={"mass.s": 0.2}, solver="heun",
    )  # fmt: skip
    signals = {n: np.asarray(solution[n]) for n in ("mass.a", "mass.s", "mass.v")}
    return ac.Data(ts, {**signals, "push.f": force})


@pytest.mark.slow
def test_parameters_and_the_first_state_are_found_exactly():
    fit = parameters()
    assert fit.history.epochs < 40  # of 50: it ends by itself, at 5e-16
    for name in ("spring.c", "mass.m", "spring.d"):
        assert float(fit.params[name]) == pytest.approx(float(plain().parameters()[name]), rel=1e-6)
    assert fit.x0["mass.s"] == pytest.approx(0.2, rel=1e-5)


def test_a_training_ends_at_the_same_update_however_often_it_is_looked_at(monkeypatch):
    whole = parameters()
    slow_down(monkeypatch)
    each = parameters()
    np.testing.assert_array_equal(each.history.loss, whole.history.loss)


@pytest.mark.slow
def test_networks_are_trained_with_a_segment_before():
    fit = ac.fit(
        learned(), record(end=5.0), "mass.a", strategy=("equation_error", "gauss_newton"),
        epochs=(30, 10), x0="model", **QUIET,
    )  # fmt: skip
    first = fit.history.full_loss[fit.history.full_loss[:, 0] <= 30][-1, 1]
    assert fit.loss < 0.5 * first


def test_what_does_not_fit_into_memory_is_refused():
    wide = {"extra.net": ac.MLP(width=300, depth=2, key=0)}
    weights = sum(a.size for a in jax.tree.leaves(eqx.filter(wide, eqx.is_inexact_array)))
    with pytest.raises(ac.TrainingError) as error:
        ac.fit(learned(), record(), "mass.a", params=wide, strategy="gauss_newton", **QUIET)
    assert str(error.value) == (
        f"The Jacobian of all predictions by {weights} weights and parameters takes "
        f"{8 * weights * len(record()) / 2**30:.1f} GB: take strategy='whole_record' "
        "in place of 'gauss_newton', smaller networks, or a coarser record."
    )


@pytest.mark.slow
def test_a_saddle_is_not_an_end():
    """From where the Hessian is indefinite, as a penalty's may be, to the minimum at (0, 1)."""

    def loss(p: Any) -> Any:
        return 2 + p[0] ** 2 / 2 + p[1] ** 4 / 4 - p[1] ** 2 / 2

    method, point = levenberg_marquardt(), jnp.array([0.05, 0.3])
    state = method.init(point)
    for _ in range(40):
        extra = {"value": loss(point), "hessian": jax.hessian(loss)(point)}
        step, state = method.update(jax.grad(loss)(point), state, point, **extra)
        if state.converged:
            break
        point = point + step
    np.testing.assert_allclose(state.point, [0.0, 1.0], atol=1e-4)
    assert state.converged
