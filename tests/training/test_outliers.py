"""Samples that no model should follow are named, and events that come at other times are not taken for such."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from acausal.training.auto.outliers import at_limits, outliers

N = 400
T = np.linspace(0.0, 10.0, N)
FIRST = 150


def sentences(
    measured: np.ndarray, predicted: np.ndarray, weight: Any = 1.0, noise: float = 0.01
) -> list[str]:
    """About two records of one target."""
    measured = measured + noise * np.random.default_rng(0).normal(size=N)
    rows = [np.arange(FIRST), np.arange(FIRST, N)]
    records: Any = SimpleNamespace(
        count=2,
        rows_of=lambda i: rows[i],
        weight=np.broadcast_to(weight, N)[:, None],
        steps=SimpleNamespace(t=T),
        y=np.clip(measured, -1.5, np.inf)[:, None],
    )
    problem: Any = SimpleNamespace(records=records, targets=("mass.s",))
    simulated: Any = SimpleNamespace(y=predicted[:, None])
    return [*outliers(problem, simulated), *at_limits(problem, simulated)]


def test_what_follows_its_record_has_none() -> None:
    assert not sentences(np.sin(T), np.sin(T))
    assert not sentences(np.sin(T), np.sin(T) + 0.3 * np.cos(T))  # a model that lacks something


def test_outliers_are_counted_over_records() -> None:
    measured = np.sin(T)
    measured[[0, 100, 101, 300]] += [3.0, -2.0, -2.0, 0.5]
    (sentence,) = sentences(measured, np.sin(T))
    assert sentence.startswith("4 of 400 samples of mass.s lie far from the others (at 0, 2.506, ")
    assert (
        "make 100 % of what is left: leave them out (nan, missing='nan') if they are wrong"
        in sentence
    )


def test_a_dropout_is_named() -> None:
    measured = np.sin(T)
    measured[220:245] = 1.0
    (sentence,) = sentences(measured, np.sin(T))
    assert sentence.startswith("25 of 400 samples")


def test_an_event_that_comes_late_is_none() -> None:
    assert not sentences(np.where(T > 5.0, 2.0, 0.0), np.where(T > 5.06, 2.0, 0.0))


def test_samples_that_are_not_measured_do_not_count() -> None:
    measured, weight = np.sin(T), np.ones(N)
    measured[20:30], weight[20:30] = 50.0, 0.0
    assert not sentences(measured, np.sin(T), weight)


@pytest.mark.parametrize("beyond", [True, False])
def test_a_sensor_at_its_limit_is_named(beyond: bool) -> None:
    found = sentences(2 * np.sin(T), (2 if beyond else 1.5) * np.sin(T))
    assert len(found) == beyond
    for sentence in found:
        assert "samples of mass.s have its least value, -1.5, where predictions go" in sentence


def test_rest_and_few_digits_are_no_limits() -> None:
    late = np.where(T > 2.0, 1 - np.exp(2.0 - T), 0.0)
    noise = np.where(late > 0, 0.01, 0.0) * np.random.default_rng(1).normal(size=N)
    for measured in (late + noise, 0.05 * np.round(np.sin(T) / 0.05)):
        assert not sentences(measured, 1.2 * late - 0.1, noise=0.0)


def cut(noise: float = 0.01) -> tuple[np.ndarray, np.ndarray]:
    """A noisy record that a sensor cuts at 0.9 several times, and a law that became steep there."""
    rng, y = np.random.default_rng(2), np.sin(3 * T)
    measured = np.minimum(y + noise * rng.normal(size=N), 0.9)
    return measured, np.where(y > 0.9, 0.87 + 0.3 * (y - 0.9), y)


def test_a_limit_is_named_where_the_law_has_become_steep() -> None:
    measured, predicted = cut()
    (sentence,) = sentences(measured, predicted, noise=0.0)
    assert "have its largest value, 0.9, without the noise of the others: leave them" in sentence
    (sentence,) = sentences(-measured, -predicted, noise=0.0)
    assert "have its least value, -0.9, without" in sentence


def test_what_rests_at_its_extreme_again_and_again_is_at_no_limit() -> None:
    measured, predicted = cut()
    resting = np.where(measured == 0.9, 0.9, predicted)
    digits = np.round(measured, 1)
    square = np.where(np.sin(3 * T) > 0, 1.0, -1.0)
    often_square = np.where(np.sin(3 * T) > 0, 1.0, measured)
    held = np.where(np.sin(3 * T) > 0.5, np.round(T), measured)  # rests elsewhere each time
    without_noise, _ = cut(noise=0.0)
    assert not sentences(measured, resting, noise=0.0)  # a mode of the model
    assert not sentences(measured - 0.9, predicted - 0.9, noise=0.0)  # nothing turns
    assert not sentences(digits, predicted, noise=0.0)
    assert not sentences(square, 0.9 * square, noise=0.0)
    assert not sentences(often_square, np.minimum(often_square, 1.0), noise=0.0)
    assert not sentences(held, 0.98 * held, noise=0.0)
    assert not sentences(without_noise, predicted, noise=0.0)
