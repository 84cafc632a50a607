"""Several trainings in one program are the trainings alone, and their spread is told."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.training import loop
from acausal.training.optimizers import trainer
from acausal.training.optimizers.trainer import State
from tests.support.oscillator import learned, record
from tests.training.test_checkpoint import stop

OPTIMIZER = optax.adam(0.01)
SEEDS = (3, 4, 5)
WISHES: dict[str, Any] = {
    "strategy": ("sequences", "whole_record"), "epochs": (20, 12), "evaluate_every": 5,
    "sequence_length": 0.2, "batch_size": 3, "optimizer": OPTIMIZER, "modifiers": ["mass.m"],
    "regularizers": [ac.ZeroCrossing()], "validation": 0.2, "progress": False,
}  # fmt: skip


def train(**wishes: Any) -> ac.Ensemble:
    defaults: dict[str, Any] = {"members": len(SEEDS), "seed": SEEDS[0]}
    return ac.ensemble(learned(), record(end=5.0), "mass.a", **(defaults | WISHES | wishes))


@cache
def trained() -> ac.Ensemble:
    return train()


def test_every_member_is_the_training_of_its_seed():
    """Adam on sequences, then L-BFGS, whose line searches differ from member to member."""
    member = trained().fits[1]
    alone = ac.fit(learned(), record(end=5.0), "mass.a", seed=SEEDS[1], **WISHES)
    np.testing.assert_allclose(member.history.loss, alone.history.loss, rtol=1e-6)
    np.testing.assert_allclose(member.history.full_loss, alone.history.full_loss, rtol=1e-6)
    assert member.best_epoch == alone.best_epoch
    assert member.loss == pytest.approx(alone.loss, rel=1e-6)
    assert member.loss_before == alone.loss_before
    assert member.validation_loss == pytest.approx(alone.validation_loss, rel=1e-6)
    np.testing.assert_allclose(member.predicted_before, alone.predicted_before)
    assert member.loss != trained().fits[0].loss


def test_members_side_by_side_find_the_same(monkeypatch: pytest.MonkeyPatch):
    """As on an accelerator: mapped over, L-BFGS with its line searches and all."""
    monkeypatch.setattr(trainer, "_each", jax.vmap)
    wishes = WISHES | {"strategy": "whole_record", "epochs": 12}
    _, member = train(members=2, **wishes).fits
    alone = ac.fit(learned(), record(end=5.0), "mass.a", seed=SEEDS[1], **wishes)
    np.testing.assert_allclose(member.history.loss, alone.history.loss, rtol=1e-6)
    np.testing.assert_allclose(member.history.full_loss, alone.history.full_loss, rtol=1e-6)


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
    assert len(told.x) == len(found.fits[0].problem.record)
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


def test_an_ensemble_goes_on_where_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(loop, "LOOK", 0.0)
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


def test_a_leg_ends_when_it_has_ended_for_all():
    """One has converged; of the others one is still within its patience."""

    def is_over(*vain: int) -> bool:
        members = [SimpleNamespace(vain=lambda since, n=n: n) for n in vain]
        run: Any = SimpleNamespace(members=members, before=0)
        zeros = jnp.zeros(3, int)
        optimizer = jax.vmap(ac.lbfgs(memory=1).init)(jnp.zeros((3, 1)))
        optimizer = replace(optimizer, converged=jnp.asarray([True, False, False]))
        leg: Any = SimpleNamespace(patience=2)
        return loop._Run._is_over(run, leg, State(None, optimizer, zeros, zeros, zeros))

    assert is_over(0, 2, 3)
    assert not is_over(0, 1, 3)


def test_the_page_shows_bands(tmp_path: Path):
    text = trained().report(tmp_path, "Three").read_text(encoding="utf-8")
    for word in ("Three", "extra.net", "mass.m", "mass.a"):
        assert word in text
    assert text.count("data:image/png;base64,") == 3


@pytest.mark.parametrize(
    ("wishes", "sentence"),
    [
        ({"members": 1}, "members=1; an ensemble has two at least."),
        ({"members": 2.5}, "members=2.5; an ensemble has two at least."),
        ({"devices": jax.devices()}, "An ensemble is trained on one device: leave out devices=."),
        ({"params": [{}]}, "There are 1 params for 3 members."),
        (
            {"params": [learned().parameters() | {"extra.net": ac.MLP(width=w, key=0)} for w in (4, 5, 6)]},
            "The networks 'extra.net' that are trained together are not alike: give all of them one architecture.",
        ),
    ],
    ids=["alone", "no number", "devices", "too few", "architectures"],
)  # fmt: skip
def test_mistakes_get_one_sentence(wishes: dict[str, Any], sentence: str):
    with pytest.raises(ac.TrainingError) as error:
        train(**wishes)
    assert str(error.value) == sentence


def test_a_wish_that_fit_does_not_know():
    with pytest.raises(
        TypeError, match=r"^ensemble has no argument 'epoch': did you mean 'epochs'"
    ):
        train(epoch=3)
