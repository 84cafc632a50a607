"""A loss counts as down to the noise by how well the samples tell the noise."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from acausal.data import noise_level
from acausal.training.objective.down_to_noise import MANY, SCATTER, down_to, largest_ratio


def levels(samples: int, count: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """What least squares with three parameters leaves of white noise, and what that noise seems to be, many times."""
    rng, t = np.random.default_rng(samples), np.linspace(0, 4, samples)
    model = np.linalg.qr(np.stack([np.ones(samples), np.exp(-t), t * np.exp(-t)], axis=1))[0]
    noise = rng.standard_normal((count, samples))
    left = noise - noise @ model @ model.T
    found = [min(noise_level([a]), noise_level([b])) for a, b in zip(noise, left, strict=True)]
    return np.sqrt(np.mean(left**2, axis=1)), np.asarray(found)


@pytest.mark.parametrize("samples", [10, 20, 40, 100])
def test_a_right_model_is_hardly_ever_above_it(samples: int) -> None:
    left, noise = levels(samples)
    assert np.std(noise) / np.mean(noise) == pytest.approx(SCATTER / np.sqrt(samples), rel=0.25)
    assert np.mean(left > largest_ratio(samples) * noise) < 0.03
    assert np.mean(left > MANY * noise) > 0.08  # which a fixed limit takes for a wrong model


def test_twice_the_noise_is_above_it() -> None:
    left, noise = levels(100)
    assert np.mean(2 * left > largest_ratio(100) * noise) > 0.99


def test_many_samples_leave_the_usual_limit() -> None:
    assert largest_ratio(500) == pytest.approx(MANY, abs=0.03)
    assert largest_ratio(5000) == MANY


def test_only_samples_that_count_do() -> None:
    records: Any = SimpleNamespace(weight=np.repeat([[2.0, 1.0], [0.0, 1.0]], [60, 40], axis=0))
    assert down_to(records) == largest_ratio(80)
