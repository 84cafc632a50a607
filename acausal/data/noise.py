"""The noise of a signal, from differences of its samples."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb

import numpy as np
from jaxtyping import Float

ORDERS = range(2, 9)
"""Orders of differences: a high one leaves little of a smooth signal, and all of white noise."""

SAMPLES_EACH = 4
"""Samples that are needed for each order."""


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
