"""New data later: what an earlier training knew is the prior of the next."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.training.objective.prior import law_at
from tests.support.oscillator import C, D, M, Oscillator, force, learned, plain, record

QUIET: dict[str, Any] = {"progress": False, "x0": "model"}
NAMES = ["spring.c", "mass.m", "spring.d"]
TRUE = {"spring.c": C, "mass.m": M, "spring.d": D}
NOISE = 0.02


def data(push: Any, end: float, seed: int) -> ac.Data:
    """A noisy position of the linear oscillator under a force."""
    t = np.arange(0.0, end, 0.01)
    u = push(t)
    solution = ac.simulate(
        plain(), (0.0, float(t[-1])), dt=0.01, inputs={"push.f": u}, solver="heun"
    )
    noise = NOISE * np.random.default_rng(seed).normal(size=len(t))
    return ac.Data(t, {"push.f": u, "mass.s": np.asarray(solution["mass.s"]) + noise})


def slow(t: np.ndarray) -> np.ndarray:
    """A push so slow that only the stiffness counts."""
    return 20 * np.sin(0.25 * t) ** 2


def trained(given: Any, **chosen: Any) -> ac.Fit:
    options: dict[str, Any] = {"strategy": "gauss_newton", "gamma": 0.9, **QUIET, **chosen}
    return ac.fit(plain(), given, "mass.s", modifiers=NAMES, **options)


def values(fit: ac.Fit) -> np.ndarray:
    return np.array([float(fit.params[n]) for n in NAMES])


def deviations(fit: ac.Fit) -> np.ndarray:
    return np.array([fit.confidence().parameters[n] for n in NAMES]) * values(fit)


@pytest.fixture(scope="module")
def records() -> dict[str, ac.Data]:
    return {"a": data(force, 8.0, 0), "b": data(slow, 12.0, 1)}


@pytest.fixture(scope="module")
def first(records: dict[str, ac.Data]) -> ac.Fit:
    wrong = {**plain().parameters(), "spring.c": 60.0, "mass.m": 1.7}
    return trained(records["a"], params=wrong)


@pytest.fixture(scope="module")
def second(first: ac.Fit, records: dict[str, ac.Data]) -> ac.Fit:
    return trained(records["b"], prior=first)


@pytest.fixture(scope="module")
def joint(records: dict[str, ac.Data]) -> ac.Fit:
    return trained(records)


@pytest.mark.slow
def test_one_record_after_the_other_is_worth_both_together(
    first: ac.Fit, second: ac.Fit, joint: ac.Fit
):
    """Parameters lie within half a deviation of those from both records, and so do the deviations themselves."""
    sigma = deviations(joint)
    assert np.all(np.abs(values(second) - values(joint)) < 0.5 * sigma)
    np.testing.assert_allclose(deviations(second), sigma, rtol=0.15)
    assert (
        deviations(second)[0] < 0.95 * deviations(first)[0]
    )  # the stiffness, of which b knows more


@pytest.mark.slow
def test_what_the_first_record_alone_tells_is_kept(
    first: ac.Fit, second: ac.Fit, records: dict[str, ac.Data]
):
    forgetful = trained(records["b"], params=first.params)
    sigma = deviations(first)
    mass, damping = 1, 2
    for i in (mass, damping):
        assert abs(values(second) - values(first))[i] < 2 * sigma[i]
    assert np.any(np.abs(values(forgetful) - values(first))[1:] > 5 * sigma[1:])


@pytest.mark.slow
def test_likelihoods_add_what_is_known(first: ac.Fit, second: ac.Fit, records: dict[str, ac.Data]):
    fit = trained(records["b"], prior=first, loss=ac.Likelihood(noise={"mass.s": NOISE}))
    assert np.all(np.abs(values(fit) - values(second)) < 0.5 * deviations(second))


def test_a_third_training_knows_both_records(first: ac.Fit, second: ac.Fit):
    prior = second.confidence().prior
    assert prior.names == tuple(NAMES)
    np.testing.assert_allclose(prior.centres, values(second))
    np.testing.assert_allclose(prior.misfit(second.params), 0.0, atol=1e-12)
    mine, theirs = (np.asarray(f.confidence().prior.root) for f in (second, first))
    scale = np.diag(values(first) / values(second))
    more = mine.T @ mine - 0.9 * scale @ theirs.T @ theirs @ scale
    assert np.all(np.linalg.eigvalsh(more) > 0)


def test_another_prior_is_another_training(
    first: ac.Fit, second: ac.Fit, records: dict[str, ac.Data], tmp_path: Any
):
    chosen: dict[str, Any] = {"checkpoint": tmp_path / "one.safetensors", "params": first.params}
    trained(records["b"], prior=first, epochs=1, **chosen)
    with pytest.raises(ac.DataError, match="prior"):
        trained(records["b"], prior=second, epochs=1, resume=True, **chosen)


@pytest.mark.slow
def test_members_of_an_ensemble_start_from_what_is_known(
    first: ac.Fit, records: dict[str, ac.Data]
):
    several = ac.ensemble(
        plain(), records["b"], "mass.s", members=2, modifiers=NAMES, prior=first,
        strategy="gauss_newton", epochs=1, **QUIET,
    )  # fmt: skip
    for fit in several.fits:
        assert np.all(np.abs(values(fit) - values(first)) < 4 * deviations(first))


def test_what_a_record_alone_determines_knows_no_prior(first: ac.Fit, second: ac.Fit):
    alone, both = (second.confidence(r).parameters for r in ("record", None))
    assert alone["mass.m"] > 5 * both["mass.m"]


# -- laws --------------------------------------------------------------------------------------------


@pytest.mark.machines
def test_a_law_is_kept_where_new_data_do_not_reach():
    """First a large motion, then a small one, with a hardening spring to learn."""
    system = ac.compile(Oscillator(cubic=80.0))
    t = np.arange(0.0, 3.0, 0.01)
    push = 0.08 * force(t)
    solution = ac.simulate(system, (0.0, float(t[-1])), dt=0.01, inputs={"push.f": push})
    states = {n: np.asarray(solution[n]) for n in ("mass.s", "mass.v", "mass.a")}
    small = ac.Data(t, {**states, "push.f": push})
    rng = np.random.default_rng(0)
    noisy = [_noisy(d, rng) for d in (record(end=5.0), small)]
    chosen: dict[str, Any] = {"strategy": ("equation_error", "whole_record"), "epochs": (100, 60)}
    old = ac.fit(learned(), noisy[0], "mass.a", **QUIET, **chosen)
    (band,) = old.confidence().laws.values()
    chosen = {"strategy": "whole_record", "epochs": 60}
    kept = ac.fit(learned(), noisy[1], "mass.a", prior=old, **QUIET, **chosen)
    lost = ac.fit(learned(), noisy[1], "mass.a", params=old.params, **QUIET, **chosen)
    seen = slice(40, 161)  # within 1.8 deviations of what the first record showed
    points = jnp.asarray(band.x[seen])

    def moved(fit: ac.Fit) -> float:
        law = law_at(fit.params["extra.net"], points, jnp.zeros(0))
        return float(jnp.sqrt(jnp.mean((law - band.law[seen]) ** 2)))

    sigma = float(np.sqrt(np.mean(band.sigma[seen] ** 2)))
    assert moved(kept) < 2 * sigma
    assert moved(lost) > 4 * moved(kept)


def _noisy(given: ac.Data, rng: np.random.Generator) -> ac.Data:
    signals = dict(given.signals)
    signals["mass.a"] = signals["mass.a"] + 0.1 * rng.normal(size=len(given))
    return ac.Data(given.time, signals)


# -- misuse --------------------------------------------------------------------------------------------


def test_what_is_no_prior_is_refused(first: ac.Fit, records: dict[str, ac.Data]):
    with pytest.raises(ac.TrainingError) as error:
        trained(records["b"], prior={"mass.m": 0.1})
    assert str(error.value) == "prior={'mass.m': 0.1} is not the result of a training."

    body = ac.Component()
    body.body, body.push = tl.Mass(m=1.0), tl.Force()
    body.connect(body.push.flange, body.body.flange_a)
    system = ac.compile(body)
    signals = records["a"].signals
    given = ac.Data(records["a"].time, {"push.f": signals["push.f"], "body.s": signals["mass.s"]})
    with pytest.raises(ac.TrainingError) as error:
        ac.fit(system, given, "body.s", modifiers=["body.m"], prior=first, **QUIET)
    assert str(error.value).startswith("prior: it knows 'spring.c', which the model has not:")
