"""The noise of records, from differences of their samples."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb

import numpy as np
from jaxtyping import Float

from acausal.training.objective.records import Records

ORDERS = range(2, 9)
"""Orders of differences: a high one leaves little of a smooth signal, and all of white noise."""

SAMPLES_EACH = 4
"""Samples that are needed for each order."""


def noise_of(records: Records) -> Float[np.ndarray, " n_targets"]:
    """By target, the standard deviation of white noise in its samples; at most, where there is other noise."""
    measured, of = records.measured, np.asarray(records.of)
    pieces = [measured[of == k] for k in range(records.count)]
    return np.array(
        [noise_level([piece[:, i] for piece in pieces]) for i in range(measured.shape[1])]
    )


def noise_loss(records: Records) -> float:
    """The loss of a model that leaves nothing but this noise, for losses that are root mean squares."""
    return float(np.sqrt(np.sum((noise_of(records) / np.asarray(records.sigma)) ** 2)))


def noise_level(pieces: Sequence[Float[np.ndarray, " n"]]) -> float:
    """The standard deviation of white noise in pieces of a signal, whose samples may be NaN; 0 for a few samples.

    The differences of order n of white noise of standard deviation σ have the variance ``σ² binomial(2n, n)``. A smooth
    signal adds to it, so that the least estimate over `ORDERS` is taken.
    """
    found: list[float] = []
    for order in ORDERS:
        known = [y[np.isfinite(y)] for y in pieces]
        rows = [np.diff(y, order) for y in known if len(y) > SAMPLES_EACH * order]
        if rows:
            with np.errstate(over="ignore"):
                mean = np.mean(np.concatenate(rows) ** 2)
            found.append(float(np.sqrt(mean / comb(2 * order, order))))
    return min(found, default=0.0)
