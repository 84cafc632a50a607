"""What is held out chooses the best, ends the training, and never moves it."""

from __future__ import annotations

import warnings
from functools import cache
from pathlib import Path
from typing import Any

import equinox as eqx
import jax
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.training.objective.held_out import split
from tests.support.oscillator import learned, plain, record
from tests.support.slow_machine import slow_down
from tests.training.test_checkpoint import same, stop

OPTIMIZER = optax.adam(0.03)
PATIENCE, EVERY, EPOCHS = 4, 5, 400


def noisy() -> ac.Data:
    """A short record with a tenth of noise: its first part is soon learned by heart."""
    data, rng = record(end=5.0), np.random.default_rng(0)
    a = data["mass.a"] + 0.1 * data["mass.a"].std() * rng.standard_normal(len(data))
    return ac.Data(data.time, {**data.signals, "mass.a": a})


def train(**chosen: Any) -> ac.Fit:
    defaults: dict[str, Any] = {
        "sequence_length": 0.2, "batch_size": 3, "epochs": EPOCHS, "evaluate_every": EVERY,
        "optimizer": OPTIMIZER, "validation": 0.4, "patience": PATIENCE, "progress": False,
    }  # fmt: skip
    return ac.fit(learned(), noisy(), "mass.a", **(defaults | chosen))


@cache
def trained() -> ac.Fit:
    return train()


@pytest.mark.slow
def test_the_best_is_the_one_that_predicts_what_was_held_out():
    fit, data = trained(), noisy()
    assert fit.samples_trained == 301
    epochs, losses = fit.history.validation_loss.T
    assert fit.validation_loss == losses.min()
    assert fit.best_epoch == epochs[losses.argmin()]
    assert fit.loss == fit.history.full_loss[losses.argmin(), 1]
    sol = ac.simulate(
        learned(), (0, 5), dt=0.01, inputs=data, params=fit.params, solver="heun",
        x0=[data[n][0] for n in learned().states],
    )  # fmt: skip
    sigma = data["mass.a"][:301].std()
    miss = (np.asarray(sol["mass.a"]) - data["mass.a"])[301:] / sigma
    assert fit.validation_loss == pytest.approx(np.sqrt(np.mean(miss**2)), rel=1e-9)
    assert f"held out  {fit.validation_loss:.4g}" in repr(fit)


@pytest.mark.slow
def test_patience_ends_a_training():
    fit = trained()
    assert fit.history.epochs == fit.best_epoch + PATIENCE * EVERY < EPOCHS
    assert not fit.interrupted


@pytest.mark.slow
def test_what_is_held_out_never_moves_the_training():
    """With other samples there, all updates are the same."""
    data = noisy()
    a = np.where(np.arange(len(data)) < 301, data["mass.a"], 0.0)
    other = ac.Data(data.time, {**data.signals, "mass.a": a})
    runs = [
        ac.fit(learned(), d, "mass.a", sequence_length=0.2, batch_size=3, epochs=10,
               optimizer=OPTIMIZER, evaluate_every=EVERY, validation=0.4, progress=False)
        for d in (data, other)
    ]  # fmt: skip
    np.testing.assert_allclose(runs[0].history.loss, runs[1].history.loss, rtol=1e-12)
    np.testing.assert_allclose(runs[0].history.loss, trained().history.loss[:10], rtol=1e-12)
    assert runs[0].validation_loss != runs[1].validation_loss


@pytest.mark.slow
def test_another_record_is_held_out():
    """Its start is its own, its errors count as those of the training's record."""
    data = noisy()
    other = {"time": data.time[250:], **{n: v[250:] for n, v in data.signals.items()}}
    fit = ac.fit(
        plain(), data.between(0, 2), "mass.a", modifiers=["mass.m"], strategy="whole_record",
        epochs=4, validation=other, x0="fit", progress=False,
    )  # fmt: skip
    sol = ac.simulate(
        plain(), (2.5, 5), dt=0.01, inputs=data.between(2.5, 5), params=fit.params, solver="heun",
        x0=[data[n][250] for n in plain().states],
    )  # fmt: skip
    miss = (np.asarray(sol["mass.a"]) - data["mass.a"][250:]) / data["mass.a"][:201].std()
    assert fit.validation_loss == pytest.approx(np.sqrt(np.mean(miss**2)), rel=1e-9)


@pytest.mark.slow
def test_coarser_records_are_integrated_as_finely():
    data = record(cubic=5.0, end=5.0)
    coarse = {"time": data.time[::4], **{n: v[::4] for n, v in data.signals.items()}}
    fit = ac.fit(
        plain(), data, "mass.a", modifiers=["mass.m"], strategy="whole_record", epochs=1, dt=0.005,
        validation=coarse, progress=False,
    )  # fmt: skip
    inputs = {"push.f": (data.time[::4], data["push.f"][::4])}
    sol = ac.simulate(
        plain(), (0, 5), dt=0.005, inputs=inputs, params=fit.params, solver="heun",
        saveat=data.time[::4], x0=[data[n][0] for n in plain().states],
    )  # fmt: skip
    miss = (np.asarray(sol["mass.a"]) - data["mass.a"][::4]) / data["mass.a"].std()
    assert fit.validation_loss == pytest.approx(np.sqrt(np.mean(miss**2)), rel=1e-6)


def test_a_training_goes_on_where_it_was_and_ends_where_it_would_have(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """Breaks before and after the best, whose evaluations still count."""
    slow_down(monkeypatch)
    best = trained().best_epoch
    for epoch in (best // 2, best + 2 * EVERY + 1):
        fit = train(checkpoint=tmp_path, resume=True, observers=[stop(epoch)])
        assert (fit.interrupted, fit.history.epochs) == (True, epoch)
    last = train(checkpoint=tmp_path, resume=True)
    same(last, trained())
    np.testing.assert_array_equal(last.history.validation_loss, trained().history.validation_loss)
    assert last.validation_loss == trained().validation_loss
    with pytest.raises(ac.DataError, match=r"another training: .*'patience', 'validation' differ"):
        train(checkpoint=tmp_path, resume=True, validation=0.5, patience=9)


@pytest.mark.slow
def test_the_next_part_begins_where_the_one_before_predicted_best():
    fit = train(strategy=("sequences", "whole_record"), epochs=(EPOCHS, 1), evaluate_every=EVERY)
    ended = trained().history.epochs
    assert fit.history.epochs == ended + 1
    start = fit.history.loss[ended]  # over the whole record, before the first update of L-BFGS
    assert start == pytest.approx(trained().loss, rel=1e-12)


@pytest.mark.slow
def test_patience_without_anything_held_out():
    """The whole record decides; an optimizer that stands still finds nothing better."""
    with pytest.warns(UserWarning, match=r"^Training did not move 'mass\.m'"):
        fit = ac.fit(
            plain(), record(end=1.0), "mass.a", modifiers=["mass.m"], optimizer=optax.sgd(0.0),
            epochs=30, evaluate_every=3, patience=2, progress=False,
        )  # fmt: skip
    assert (fit.best_epoch, fit.history.epochs) == (0, 6)
    assert fit.validation_loss is None
    assert fit.history.validation_loss.shape == (0, 2)
    assert "held out" not in repr(fit)


def test_it_is_drawn(tmp_path: Path):
    text = trained().report(tmp_path).read_text(encoding="utf-8")
    assert f"{trained().validation_loss:.4g}" in text
    assert "loss over what is held out" in text


@pytest.mark.parametrize(
    ("chosen", "sentence"),
    [
        ({"validation": 1.2}, "validation=1.2 of 501 samples leaves -100 to train on; give a"),
        ({"validation": 0.001}, "validation=0.001 of 501 samples leaves 500 to train on; give a"),
        (
            {"validation": float("nan")},
            "validation=nan is not a fraction; give a number between 0 and 1.",
        ),
        ({"validation": np.float32(1.5)}, "validation=1.5 of 501 samples leaves -251 to train on"),
        (
            {"validation": []},
            "validation=[] names nothing to hold out: leave it out, or name some.",
        ),
        ({"validation": {"time": [0, 1, 2], "mass.a": [0, 1, 0]}}, "The data lack 'push.f'"),
        ({"patience": 0}, "patience=0; give a whole number, 1 or more."),
    ],
)
def test_mistakes_get_one_sentence(chosen: dict[str, Any], sentence: str):
    with pytest.raises((ac.DataError, ac.TrainingError)) as error:
        train(**chosen)
    assert str(error.value).startswith(sentence)


def test_weights_are_those_of_the_best():
    """The parameters that come back are those of the best epoch, not of the last."""
    fit = trained()
    again = train(epochs=fit.best_epoch, patience=None)
    one, other = (eqx.filter(f.params["extra.net"], eqx.is_inexact_array) for f in (fit, again))
    jax.tree.map(np.testing.assert_array_equal, one, other)


def test_a_record_that_is_trained_on_validates_nothing():
    record = ac.Data(np.arange(4.0), {"u": np.arange(4.0), "y": np.ones(4)})
    other = ac.Data(np.arange(4.0), {"u": np.arange(4.0), "y": np.zeros(4)})
    with pytest.warns(UserWarning, match="'record' is the training's own record 'a'"):
        split({"a": record}, ac.Data(record.time, dict(record.signals)))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert split({"a": record}, other).held == {"record": other}
