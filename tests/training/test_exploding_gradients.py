"""Trainings with steps far outside the solver's region of stability: the states are right, the gradients are not."""

import functools
import warnings

import numpy as np
import pytest

import acausal as ac
from tests.support.friction import sticking

MEND = r"Its steps are too long for the solver to be stable: take a smaller dt"


@functools.cache
def record() -> ac.Data:
    """The clutch sticks for a second, and slips for another one."""
    time = np.linspace(0, 2, 2001)
    push = np.where(time < 1, 1.0, 400.0)
    run = ac.simulate(sticking(), (0, 2), inputs={"push": (time, push)}, saveat=time)
    return ac.Data(time, {"push": push, **{n: run[n] for n in ("v", "w")}})


def train(**options):
    return ac.fit(
        sticking(), record(), ["v", "w"], modifiers=["limit"], params={"limit": 51.0},
        solver="euler", progress=False, **options,
    )  # fmt: skip


@pytest.mark.slow
def test_sequences_whose_gradients_explode_are_left_out():
    with pytest.warns(UserWarning, match=r"in its gradient alone\); left out\. " + MEND):
        fit = train(epochs=10, sequence_length=0.4, batch_size=16)
    left_out = fit.history.divergences
    assert all(0 < d.exploded == d.count < 16 for d in left_out)
    assert not any(d.rejected for d in left_out)
    assert np.isfinite(fit.history.loss).all()
    assert -0.05 < fit.modifiers["limit"] < 0  # those that slip move it towards the truth, 50


@pytest.mark.slow
@pytest.mark.parametrize("strategy", ["whole_record", "gauss_newton"])
def test_a_training_whose_gradient_explodes_ends_with_a_mend(strategy):
    with pytest.raises(
        ac.TrainingError,
        match=r"of the sequence from t = 0 s explodes in steps of 0\.001 s by Euler\. " + MEND,
    ):
        train(epochs=60, strategy=strategy)


@pytest.mark.slow
def test_a_training_that_finds_nothing_is_told_of_its_steps():
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        train(epochs=2, strategy="whole_record")
    sentence = "Training found nothing better than its start. Steps of 0.001 s are far too long"
    assert any(str(w.message).startswith(sentence) for w in said)
