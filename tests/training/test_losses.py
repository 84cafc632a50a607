"""Losses: maximum likelihood, laws of errors with outliers, and weights."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax.flatten_util import ravel_pytree

import acausal as ac
from acausal.training.build_problem import build_problem
from acausal.training.objective.error_laws import ErrorLaw
from acausal.training.objective.losses import named, nrmse
from acausal.training.objective.problem import Problem
from acausal.training.objective.whole_record import over_whole_record
from acausal.training.optimizers.gradients import with_gauss_newton_hessian, with_gradient
from acausal.training.options import FitOptions
from tests.support.oscillator import C, D, M, force, plain, record

LAWS: list[ErrorLaw] = [ac.Likelihood(), ac.Huber(), ac.Student()]
TARGETS = ("mass.s", "mass.a")
NOISE = {"mass.s": 0.01, "mass.a": 0.8}


# -- the losses alone ----------------------------------------------------------------------------------


def samples(outliers: float = 0.0, n: int = 20000) -> np.ndarray:
    """Normal errors of 0.01 and 0.8; a share of them are twenty times as large."""
    rng = np.random.default_rng(1)
    errors = rng.normal(size=(n, 2)) * list(NOISE.values())
    return np.where(rng.random((n, 2)) < outliers, 20 * errors, errors)


def levels(law: ErrorLaw, errors: np.ndarray) -> np.ndarray:
    measured = jnp.asarray(errors)
    loss = law.of(TARGETS)
    sigma = jnp.asarray([0.3, 5.0])
    return np.asarray(
        jax.jit(loss.levels)(np.zeros(errors.shape), measured, sigma, np.ones(errors.shape))
    )


def test_likelihood_estimates_the_noise_of_two_sensors():
    np.testing.assert_allclose(levels(ac.Likelihood(), samples()), [0.01, 0.8], rtol=0.02)


@pytest.mark.parametrize("law", [ac.Huber(), ac.Student()])
def test_robust_levels_hardly_see_outliers(law: ErrorLaw):
    errors = samples(0.05)
    assert np.all(errors.std(axis=0) > [0.03, 2.4])
    np.testing.assert_allclose(levels(law, errors), [0.01, 0.8], rtol=0.2)


def test_hubers_level_is_the_deviation_of_normal_errors():
    np.testing.assert_allclose(levels(ac.Huber(), samples()), [0.01, 0.8], rtol=0.02)


def test_given_levels_stay():
    found = levels(ac.Huber(noise={"mass.a": 0.5}), samples())
    np.testing.assert_allclose(found, [0.01, 0.5], rtol=0.02)


def test_the_likelihood_of_one_target_is_the_logarithm_of_nrmse():
    rng = np.random.default_rng(0)
    y, p = (jnp.asarray(rng.normal(size=(50, 1))) for _ in range(2))
    sigma, weight = jnp.asarray([2.0]), jnp.asarray(rng.random((50, 1)))
    loss = ac.Likelihood().of(("mass.a",))
    assert float(loss(p, y, sigma, weight)) == pytest.approx(
        float(jnp.log(nrmse(p, y, sigma, weight))), rel=1e-12
    )


@pytest.mark.parametrize(
    "law", [*LAWS, ac.Huber(noise={"mass.a": 0.5}), ac.Student(nu=2, noise=NOISE)]
)
def test_gradients_are_those_of_finite_differences(law: ErrorLaw):
    """Though levels are held fixed in derivatives, the loss with estimated levels has this gradient."""
    rng = np.random.default_rng(3)
    y, p = jnp.asarray(samples(0.1, 40)), jnp.asarray(samples(0.0, 40)[::-1])
    weight = jnp.asarray(np.where(rng.random((40, 2)) < 0.2, 0.0, rng.random((40, 2))))
    loss, sigma = law.of(TARGETS), jnp.asarray([0.3, 5.0])
    of_p = jax.jit(lambda p: loss(p, y, sigma, weight))
    found = np.asarray(jax.jit(jax.grad(of_p))(p))
    for i, j in [(0, 0), (7, 1), (20, 0), (33, 1)]:
        h = 1e-6 * float(sigma[j])
        moved = np.zeros(p.shape)
        moved[i, j] = h
        sides = [float(of_p(np.asarray(p) + s)) for s in (moved, -moved)]
        assert float(found[i, j]) == pytest.approx((sides[0] - sides[1]) / (2 * h), rel=2e-4, abs=1e-7)  # fmt: skip


@pytest.mark.parametrize("law", [ac.Likelihood(noise=NOISE), ac.Huber(1e3), ac.Student(1e6)])
def test_laws_without_outliers_are_normal(law: ErrorLaw):
    y = jnp.asarray(samples(n=100))
    arguments = jnp.zeros_like(y), y, jnp.asarray([0.3, 5.0]), jnp.ones_like(y)
    wanted = ac.Likelihood(noise=law.noise).of(TARGETS)
    found = law.of(TARGETS)
    both = [jax.jit(loss.curvature)(*arguments) for loss in (found, wanted)]
    np.testing.assert_allclose(*both, rtol=1e-3)
    gradients = [jax.jit(jax.grad(loss))(*arguments) for loss in (found, wanted)]
    np.testing.assert_allclose(*gradients, rtol=1e-3, atol=1e-9)


@pytest.mark.slow
def test_the_curvature_is_the_second_derivative_of_normal_errors_and_above_that_of_others():
    y = jnp.asarray(samples(0.2, 30))
    arguments = y, jnp.asarray([0.3, 5.0]), jnp.ones_like(y)
    for law in (ac.Likelihood(noise=NOISE), ac.Huber(noise=NOISE), ac.Student(noise=NOISE)):
        loss = law.of(TARGETS)
        at = jnp.zeros(y.size)
        of_p = lambda p, loss=loss: loss(p.reshape(y.shape), *arguments)  # noqa: E731
        full = np.asarray(jax.jit(jax.hessian(of_p))(at))
        ours = np.ravel(jax.jit(loss.curvature)(at.reshape(y.shape), *arguments))
        assert np.all(ours - np.diag(full) > -1e-12 * np.max(np.abs(full)))
        if isinstance(law, ac.Likelihood):
            np.testing.assert_allclose(np.diag(full), ours, rtol=1e-9)
        assert np.all(ours > 0)


def test_only_ratios_of_weights_count_in_nrmse():
    rng = np.random.default_rng(0)
    y, p = (jnp.asarray(rng.normal(size=(50, 2))) for _ in range(2))
    w = jnp.where(jnp.asarray(rng.random((50, 2))) < 0.3, 0.0, 1.0)
    ones = float(nrmse(p, y, jnp.ones(2), w))
    assert float(nrmse(p, y, jnp.ones(2), 7 * w)) == pytest.approx(ones, rel=1e-12)
    squares = np.sum(np.asarray(w * (p - y) ** 2), axis=0) / np.sum(np.asarray(w), axis=0)
    assert ones == pytest.approx(np.sqrt(squares.sum()), rel=1e-12)
    assert float(nrmse(p, y, jnp.ones(2), w * jnp.asarray([3.0, 1e-9]))) == pytest.approx(
        np.sqrt(squares[0] * np.sum(w) / np.sum(np.asarray(w)[:, 0])), rel=1e-6
    )


# -- derivatives of a training ---------------------------------------------------------------------------


def posed(loss: Any, **chosen: Any) -> Problem:
    options = FitOptions(modifiers=["mass.m", "spring.c"], x0="fit", loss=loss, **chosen)
    params = {**plain().parameters(0), "mass.m": 1.9}
    given = record(cubic=0.0, end=1.0)
    return over_whole_record(build_problem(plain(), {"one": given}, TARGETS, params, options))


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize(
    "chosen",
    [
        {"loss": "likelihood"},
        {"loss": ac.Huber(noise={"mass.a": 0.1})},
        {"loss": "student", "per_record": {"spring.d": 0.1}, "parameter_spread": {"spring.d": 0.2}},
    ],
)
def test_both_ways_give_one_gradient(chosen: dict[str, Any]):
    problem = posed(**chosen)
    at = jax.tree.map(lambda a: a + 0.01, problem.start())
    batch = problem.draw(jax.random.key(0))
    back, forth = (
        eqx.filter_jit(way)(problem, at, batch)
        for way in (with_gradient, with_gauss_newton_hessian)
    )
    assert float(forth.total) == pytest.approx(float(back.total), rel=1e-10)
    a, b = (ravel_pytree(found.gradient)[0] for found in (forth, back))
    np.testing.assert_allclose(a, b, rtol=1e-7, atol=1e-9 * float(jnp.abs(b).max()))


def test_the_hessian_of_given_noise_is_the_jacobians_square():
    problem = posed(ac.Likelihood(noise=NOISE))
    start, unravel = ravel_pytree(problem.start())
    predict = jax.jit(lambda z: problem.predictions(unravel(z))[0])
    h = 1e-5
    at, steps = np.asarray(start), np.eye(len(start)) * h
    rises = [np.asarray(predict(at + e)) - np.asarray(predict(at - e)) for e in steps]
    jacobian = np.stack(rises) / (2 * h) / list(NOISE.values())
    expected = np.einsum("ink,jnk->ij", jacobian, jacobian) / problem.records.y.size
    found = eqx.filter_jit(with_gauss_newton_hessian)(
        problem, unravel(start), problem.draw(jax.random.key(0))
    )
    assert found.hessian is not None
    np.testing.assert_allclose(found.hessian, expected, rtol=1e-5, atol=1e-6)


# -- trainings -------------------------------------------------------------------------------------------


def noisy(outliers: float = 0.0, end: float = 6.0, seed: int = 0) -> ac.Data:
    """The linear oscillator, two sensors with different noise, perhaps with outliers of 30 deviations."""
    t = np.arange(0.0, end, 0.01)
    solution = ac.simulate(
        plain(), (0.0, float(t[-1])), dt=0.01, inputs={"push.f": force(t)}, solver="heun"
    )
    rng = np.random.default_rng(seed)
    signals = {"push.f": force(t)}
    for name, level in NOISE.items():
        error = level * rng.normal(size=len(t))
        error += np.where(rng.random(len(t)) < outliers, 30 * level, 0.0)
        signals[name] = np.asarray(solution[name]) + error
    return ac.Data(t, signals)


def trained(data: Any, loss: Any = "nrmse", **chosen: Any) -> ac.Fit:
    wrong = {**plain().parameters(), "spring.c": 1.2 * C, "mass.m": 1.7, "spring.d": 1.3}
    given: dict[str, Any] = {"strategy": "gauss_newton", "x0": "model", "progress": False, **chosen}
    names = ["spring.c", "mass.m", "spring.d"]
    return ac.fit(
        plain(), data, TARGETS, params=wrong, gamma=0.9, modifiers=names, loss=loss, **given
    )


def error(fit: ac.Fit) -> float:
    """The root mean square of the relative errors of parameters."""
    true = {"spring.c": C, "mass.m": M, "spring.d": D}
    return float(np.sqrt(np.mean([(float(fit.params[n]) / v - 1) ** 2 for n, v in true.items()])))


@pytest.fixture(scope="module")
def ml() -> ac.Fit:
    return trained(noisy(), "likelihood")


def test_the_levels_are_in_the_result(ml: ac.Fit):
    for name, level in NOISE.items():
        assert ml.noise[name] == pytest.approx(level, rel=0.06)
        assert ml.noise[name] == pytest.approx(ml.rms[name], rel=1e-9)
    deviations = ml.confidence().parameters
    for name, true in {"spring.c": C, "mass.m": M, "spring.d": D}.items():
        assert abs(float(ml.params[name]) / true - 1) < 4 * deviations[name]


@pytest.mark.slow
def test_given_noise_is_that_of_the_confidence(ml: ac.Fit):
    noise = {n: 3 * v for n, v in ml.noise.items()}
    fit = trained(noisy(), ac.Likelihood(noise=noise))
    assert fit.noise == pytest.approx(noise)
    assert fit.confidence().noise == pytest.approx(noise)
    for name, sigma in ml.confidence().parameters.items():
        assert fit.confidence().parameters[name] == pytest.approx(3 * sigma, rel=0.05)
        assert float(fit.params[name]) == pytest.approx(float(ml.params[name]), rel=1e-4)


@pytest.mark.slow
def test_robust_losses_bear_outliers(ml: ac.Fit):
    data = noisy(0.05)
    plainly = trained(data)
    for law in ("huber", "student"):
        fit = trained(data, law)
        assert error(fit) < 0.5 * error(plainly)
        for name, level in NOISE.items():
            assert fit.noise[name] == pytest.approx(level, rel=0.35)
            assert plainly.noise[name] > 3 * level


@pytest.mark.slow
def test_sequences_learn_with_a_likelihood():
    fit = trained(
        record(cubic=0.0, end=4.0), "student", strategy="sequences", sequence_length=0.5,
        batch_size=4, epochs=300, x0="data",
    )  # fmt: skip
    assert fit.loss < fit.loss_before - 1
    assert error(fit) < 0.12


def test_a_report_shows_losses_below_zero(ml: ac.Fit, tmp_path: Any):
    assert ml.loss < 0
    assert "The loss, update by update" in ml.report(tmp_path).read_text(encoding="utf-8")


# -- weights ---------------------------------------------------------------------------------------------


def two() -> dict[str, ac.Data]:
    return {"long": noisy(end=4.0), "short": noisy(end=1.0, seed=1)}


def problem_of(data: dict[str, ac.Data], **chosen: Any) -> Problem:
    given: dict[str, Any] = {"x0": "model", "sequence_length": None, **chosen}
    options = FitOptions(modifiers=["mass.m"], **given)
    return build_problem(plain(), data, TARGETS, plain().parameters(0), options)


def sums(problem: Problem) -> np.ndarray:
    """The weights of records and targets."""
    weight = np.asarray(problem.records.weight)
    of = np.asarray(problem.records.of)
    return np.stack([weight[of == k].sum(axis=0) for k in range(problem.records.count)])


def test_records_count_by_their_samples_or_alike_or_as_said():
    assert sums(problem_of(two())).tolist() == [[400, 400], [100, 100]]
    alike = sums(problem_of(two(), record_weights="records"))
    assert alike[0] == pytest.approx(alike[1])
    said = sums(problem_of(two(), record_weights={"short": 3}))
    assert said.tolist() == [[400, 400], [300, 300]]


def test_samples_count_by_target_and_time():
    def late(t: float) -> float:
        return 1.0 if t >= 0.5 else 0.0

    given = {"mass.s": 2, "mass.a": late}
    problem = problem_of(two(), sample_weights=given)
    np.testing.assert_allclose(sums(problem), [[800, 350], [200, 50]])
    at_zero = np.asarray(problem.records.weight)[0]
    assert at_zero.tolist() == [2.0, 0.0]


@pytest.mark.slow
def test_sequences_are_drawn_as_often_as_they_count():
    data = {n: record(cubic=0.0, end=end) for n, end in {"long": 8.0, "short": 2.0}.items()}
    problem = problem_of(data, sequence_length=0.2, batch_size=500, record_weights="records")
    batch = problem.draw(jax.random.key(0))
    assert np.asarray(batch.weight).tolist() == [1.0] * 500
    short = np.asarray(problem.records.of)[np.asarray(batch.start)].mean()
    assert short == pytest.approx(0.5, abs=0.08)
    tiled = problem_of(data, sequence_length=0.5, batch_size=8, record_weights="records", x0="fit")
    weight = np.asarray(tiled.sequences.weight)
    of = np.asarray(tiled.records.of)[np.asarray(tiled.sequences.starts)]
    assert weight[of == 1].sum() == pytest.approx(weight[of == 0].sum(), rel=0.05)


@pytest.mark.slow
def test_another_weight_is_another_training(tmp_path: Any):
    data, file = noisy(end=1.0), tmp_path / "one.safetensors"
    chosen: dict[str, Any] = {"strategy": "whole_record", "epochs": 2, "checkpoint": file}
    trained(data, ac.Student(noise={"mass.a": 0.8}), **chosen)
    with pytest.raises(ac.DataError, match="loss"):
        trained(data, ac.Student(noise={"mass.a": 0.7}), resume=True, **chosen)
    with pytest.raises(ac.DataError, match="sample_weights"):
        trained(
            data, ac.Student(noise={"mass.a": 0.8}), sample_weights={"mass.a": 2}, resume=True, **chosen
        )  # fmt: skip


# -- misuse ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: ac.Likelihood(noise={"mass.a": -1.0}), "Likelihood: the noise of 'mass.a' is -1.0; give its positive"),
        (lambda: ac.Likelihood(noise=cast(Any, 0.1)), "Likelihood: noise=0.1; give levels by target"),
        (lambda: ac.Student(nu=0), "Student: nu=0; give positive degrees of freedom."),
        (lambda: ac.Huber(delta=-2), "Huber: delta=-2; give a positive number of levels."),
        (lambda: ac.Student(noise={"mass.v": 1}).of(TARGETS), "Student: noise of 'mass.v', which is not a target"),
        (lambda: named("studnet", TARGETS), "No loss 'studnet': did you mean 'student'?"),
    ],
)  # fmt: skip
def test_what_is_no_law_is_refused(make: Callable[[], Any], sentence: str):
    with pytest.raises(ac.TrainingError) as found:
        make()
    assert str(found.value).startswith(sentence)


def of_three(predicted: Any, measured: Any, sigma: Any) -> Any:
    return jnp.mean(((predicted - measured) / sigma) ** 2)


@pytest.mark.parametrize(
    ("chosen", "sentence"),
    [
        ({"record_weights": "equal"}, "record_weights='equal': give 'samples', 'records', or factors"),
        ({"record_weights": {"shrt": 1}}, "record_weights: there is no record 'shrt': did you mean 'short'?"),
        ({"record_weights": {"short": 0}}, "record_weights: 'short' has the weight 0; give a positive number"),
        ({"sample_weights": {"mass.v": 1}}, "sample_weights: 'mass.v' is not a target"),
        ({"sample_weights": {"mass.a": -1}}, "sample_weights: 'mass.a' has the weight -1; give a positive"),
        ({"sample_weights": {"mass.a": lambda t: -t}}, "sample_weights: -0.01 at t = 0.01 s is not a weight"),
        ({"sample_weights": {"mass.a": lambda t: 0}}, "sample_weights: all weights of 'mass.a' are 0"),
        ({"sample_weights": {"mass.a": 2}, "loss": of_three}, "record_weights and sample_weights need a loss"),
    ],
)  # fmt: skip
def test_what_is_no_weight_is_refused(chosen: dict[str, Any], sentence: str):
    with pytest.raises(ac.TrainingError) as found:
        problem_of(two(), **chosen)
    assert str(found.value).startswith(sentence)
