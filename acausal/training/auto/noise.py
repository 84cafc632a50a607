"""The noise of records, from differences of their samples."""

from __future__ import annotations

from math import comb

import numpy as np
from jaxtyping import Float

from acausal.training.objective.records import Records

ORDERS = range(2, 9)
"""Orders of differences: a high one leaves little of a smooth signal, and all of white noise."""


def noise_of(records: Records) -> Float[np.ndarray, " n_targets"]:
    """By target, the standard deviation of white noise in its samples; less where there is less than that.

    The differences of order n of white noise of standard deviation σ have the variance ``σ² binomial(2n, n)``; a smooth
    signal adds to it, so that the least estimate over `ORDERS` is taken.
    """
    measured, of = records.measured, np.asarray(records.of)
    pieces = [measured[of == k] for k in range(records.count)]
    return np.array([_level([piece[:, i] for piece in pieces]) for i in range(measured.shape[1])])


def _level(pieces: list[Float[np.ndarray, " n"]]) -> float:
    found: list[float] = []
    for order in ORDERS:
        rows = [
            np.diff(y[np.isfinite(y)], order) for y in pieces if np.isfinite(y).sum() > 4 * order
        ]
        if rows:
            found.append(
                float(np.sqrt(np.mean(np.concatenate(rows) ** 2) / comb(2 * order, order)))
            )
    return min(found, default=0.0)


def noise_loss(records: Records) -> float:
    """The loss of a model that leaves nothing but this noise, for losses that are root mean squares."""
    return float(np.sqrt(np.sum((noise_of(records) / np.asarray(records.sigma)) ** 2)))
