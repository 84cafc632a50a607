"""Several trainings in one program are the trainings alone, and their spread is told."""

from __future__ import annotations

import copy
import pickle
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.training.build_problem import build_problem
from acausal.training.objective.problem import Problem
from acausal.training.optimizers.trainer import Trainer, advance, begin
from acausal.training.options import FitOptions
from tests.support.oscillator import learned, record
from tests.support.slow_machine import slow_down
from tests.training.test_checkpoint import stop
from tests.training.test_held_out import noisy

OPTIMIZER = optax.adam(0.01)
SEEDS = (3, 4, 5)
OPTIONS: dict[str, Any] = {
    "strategy": ("sequences", "whole_record"), "epochs": (20, 12), "evaluate_every": 5,
    "sequence_length": 0.2, "batch_size": 3, "optimizer": OPTIMIZER, "modifiers": ["mass.m"],
    "regularizers": [ac.ZeroCrossing()], "validation": 0.2, "progress": False,
}  # fmt: skip


def train(**options: Any) -> ac.Ensemble:
    defaults: dict[str, Any] = {"members": len(SEEDS), "seed": SEEDS[0]}
    return ac.ensemble(learned(), record(end=5.0), "mass.a", **(defaults | OPTIONS | options))


@cache
def trained() -> ac.Ensemble:
    return train()


@pytest.mark.slow
def test_every_member_is_the_training_of_its_seed():
    """Adam on sequences, then L-BFGS, whose line searches differ from member to member."""
    member = trained().fits[1]
    alone = ac.fit(learned(), record(end=5.0), "mass.a", seed=SEEDS[1], **OPTIONS)
    np.testing.assert_allclose(member.history.loss, alone.history.loss, rtol=1e-6)
    np.testing.assert_allclose(member.history.full_loss, alone.history.full_loss, rtol=1e-6)
    assert member.best_epoch == alone.best_epoch
    assert member.loss == pytest.approx(alone.loss, rel=1e-6)
    assert member.loss_before == alone.loss_before
    assert member.validation_loss == pytest.approx(alone.validation_loss, rel=1e-6)
    before = [next(iter(fit.before.values())).predicted for fit in (member, alone)]
    np.testing.assert_allclose(*before)
    assert member.loss != trained().fits[0].loss


@pytest.mark.machines
def test_copies_answer_as_the_ensemble_and_its_fits(tmp_path):
    ensemble = pickle.loads(pickle.dumps(trained()))
    assert str(ensemble) == str(trained())
    fit, other = trained().fits[0], ensemble.fits[0]
    assert other.system is ensemble.fits[1].system is not fit.system
    assert str(other) == str(copy.copy(fit)) == str(copy.deepcopy(fit)) == str(fit)
    at = {"dt": 0.01, "inputs": {"push.f": np.ones(101)}}
    found, expected = (ac.simulate(f.system, (0, 1), params=f.params, **at) for f in (other, fit))
    np.testing.assert_array_equal(found.x, expected.x)
    assert other.residuals()[0].share == fit.residuals()[0].share
    assert "mass.m" in other.report(tmp_path).read_text()


@pytest.mark.slow
def test_members_side_by_side_find_the_same():
    """As on an accelerator: mapped over, L-BFGS with its line searches and all."""
    system, data = learned(), record(end=5.0)
    params = [system.parameters(seed) for seed in SEEDS[:2]]
    problem = build_problem(
        system, {"record": data}, ("mass.a",), params[0], FitOptions(modifiers=["mass.m"])
    )
    trainer = Trainer(ac.lbfgs(), 1e3, Problem.changes)
    trainables = [replace(problem, params=own).start() for own in params]
    keys = [jax.random.key(seed) for seed in SEEDS[:2]]
    states = [begin(trainer, one, key) for one, key in zip(trainables, keys, strict=True)]
    stacked = jax.tree.map(lambda *rows: jnp.stack(rows), *states)
    _, both = advance(problem, trainer, stacked, jnp.asarray(12), side_by_side=True)
    for k, state in enumerate(states):
        _, alone = advance(problem, trainer, state, jnp.asarray(12))
        np.testing.assert_allclose(both.loss[:12, k], alone.loss[:12], rtol=1e-6)
    assert both.loss[0, 0] != both.loss[0, 1]


@pytest.mark.slow
def test_the_spread_is_that_of_the_members():
    found, at = trained(), 100
    band = found.laws["extra.net"]
    values = [float(fit.params["extra.net"](band.x[at])) for fit in found.fits]
    assert band.law[at] == pytest.approx(np.mean(values))
    assert band.sigma[at] == pytest.approx(np.std(values, ddof=1)) != 0
    told = found.predicted["mass.a"]
    ys = np.stack([fit.predicted[:, 0] for fit in found.fits])
    np.testing.assert_allclose(told.law, ys.mean(axis=0))
    np.testing.assert_allclose(told.sigma, ys.std(axis=0, ddof=1))
    assert len(told.x) == found.fits[0].samples_trained
    ahead = found.predict(record(end=5.0).between(2.5, 5.0))["mass.a"]
    sol = ac.simulate(
        learned(), (2.5, 5.0), dt=0.01, inputs=record(end=5.0).between(2.5, 5.0), solver="heun",
        params=found.fits[2].params, x0=[record(end=5.0)[n][250] for n in learned().states],
    )  # fmt: skip
    deviation = np.abs(np.asarray(sol["mass.a"]) - ahead.law)
    assert np.all(deviation <= 2 / np.sqrt(3) * ahead.sigma * (1 + 1e-6))  # one of three
    mean, sigma = found.modifiers["mass.m"]
    masses = [fit.modifiers["mass.m"] for fit in found.fits]
    assert (mean, sigma) == pytest.approx((np.mean(masses), np.std(masses, ddof=1)))
    assert found.best.validation_loss == min(fit.validation_loss or 0 for fit in found.fits)
    assert "Ensemble of 3 for extra.net, mass.m" in repr(found)


@pytest.mark.slow
def test_an_ensemble_goes_on_where_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    slow_down(monkeypatch)
    for epoch in (8, 25):
        part = train(checkpoint=tmp_path, resume=True, observers=[stop(epoch)])
        assert part.fits[0].interrupted
        assert {fit.history.epochs for fit in part.fits} == {epoch}
    last = train(checkpoint=tmp_path, resume=True)
    for one, other in zip(last.fits, trained().fits, strict=True):
        np.testing.assert_array_equal(one.history.loss, other.history.loss)
        np.testing.assert_array_equal(one.history.validation_loss, other.history.validation_loss)
        jax.tree.map(np.testing.assert_array_equal, one.trained, other.trained)
    with pytest.raises(ac.DataError, match=r"another training: .*'seed', 'members' differ"):
        train(checkpoint=tmp_path, resume=True, seed=0)


@pytest.mark.slow
def test_a_segment_ends_when_it_has_ended_for_all():
    """As many evaluations without a better one as patience allows, for every member, and no sooner."""
    patience, epochs = 2, 400
    found = ac.ensemble(
        learned(), noisy(), "mass.a", members=2, epochs=epochs, evaluate_every=5, validation=0.4,
        sequence_length=0.2, batch_size=3, optimizer=optax.adam(0.03), patience=patience, progress=False,
    )  # fmt: skip

    def without_improvement(fit: ac.Fit, evaluations: int) -> int:
        losses = fit.history.validation_loss[:evaluations, 1]
        return evaluations - 1 - int(np.argmin(losses))

    count = len(found.fits[0].history.validation_loss)
    since = [[without_improvement(f, n) for f in found.fits] for n in range(1, count + 1)]
    assert all(n >= patience for n in since[-1])
    assert all(any(n < patience for n in row) for row in since[:-1])
    assert any(any(n >= patience for n in row) for row in since[:-1])  # one waits for the other
    assert {fit.history.epochs for fit in found.fits} == {5 * (count - 1)}
    assert 5 * (count - 1) < epochs


@pytest.mark.slow
def test_the_page_shows_bands(tmp_path: Path):
    text = trained().report(tmp_path, "Three").read_text(encoding="utf-8")
    for word in ("Three", "extra.net", "mass.m", "mass.a"):
        assert word in text
    (plot,) = (p for p in trained().page_content().plots if p.ylabel.startswith("mass.a"))
    mean = plot.curves[1]
    band = trained().predicted["mass.a"]
    np.testing.assert_allclose(mean.y, np.interp(mean.x, band.x, band.law), rtol=1e-12)
    assert mean.sigma is not None


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"members": 1}, "members=1; give a whole number, 2 or more."),
        ({"members": 2.5}, "members=2.5; give a whole number, 2 or more."),
        ({"devices": jax.devices()}, "An ensemble is trained on one device: leave out devices=."),
        ({"params": [{}]}, "There are 1 params for 3 members."),
        (
            {"params": [learned().parameters() | {"extra.net": ac.MLP(width=w, key=0)} for w in (4, 5, 6)]},
            "The networks 'extra.net' of the members differ in architecture: give all of them the same.",
        ),
    ],
    ids=["alone", "no number", "devices", "too few", "architectures"],
)  # fmt: skip
def test_mistakes_get_one_sentence(options: dict[str, Any], sentence: str):
    with pytest.raises(ac.TrainingError) as error:
        train(**options)
    assert str(error.value) == sentence


def test_an_option_that_fit_does_not_know():
    with pytest.raises(
        TypeError, match=r"^ensemble has no argument 'epoch': did you mean 'epochs'"
    ):
        train(epoch=3)
    with pytest.raises(TypeError, match=r"^fit has no argument 'epoch': did you mean 'epochs'"):
        ac.fit(learned(), record(end=5.0), "mass.a", epoch=3)
