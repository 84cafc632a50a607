"""The noise of a signal, from differences of its samples."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy.lib.stride_tricks import sliding_window_view

ORDERS = range(2, 9)
"""Orders of differences: a high one leaves little of a smooth signal, and all of white noise."""

SAMPLES_EACH = 4
"""Samples that are needed for each order."""

MOST = 20_000
"""Differences of a piece and order, at most."""

GAP = 2.0
"""Differences over so many times the usual time lie across a gap."""


def noise_level(
    pieces: Sequence[Float[np.ndarray, " n"]],
    times: Sequence[Float[np.ndarray, " n"]] | None = None,
) -> float:
    """The standard deviation of white noise in pieces of a signal, whose samples may be NaN; 0 for a few samples.

    A divided difference of order n is a sum of n + 1 samples with weights whose squares add up to one, after scaling:
    of white noise it keeps the variance. A smooth signal adds to it, so that the least estimate over `ORDERS` is taken.
    Differences across gaps are left out. Without times, samples are evenly spaced.
    """
    places = [np.arange(len(y), dtype=float) for y in pieces] if times is None else times
    known = [(y[np.isfinite(y)], t[np.isfinite(y)]) for y, t in zip(pieces, places, strict=True)]
    found: list[float] = []
    for order in ORDERS:
        rows = [_differences(y, t, order) for y, t in known if len(y) > SAMPLES_EACH * order]
        if rows:
            with np.errstate(over="ignore"):
                found.append(float(np.sqrt(np.mean(np.concatenate(rows) ** 2))))
    return min(found, default=0.0)


def _differences(
    y: Float[np.ndarray, " n"], t: Float[np.ndarray, " n"], order: int
) -> Float[np.ndarray, " m"]:
    """Divided differences, scaled so that white noise keeps its variance, of samples without a gap between them."""
    every = -(-len(y) // MOST)
    nodes, values = (sliding_window_view(a, order + 1)[::every] for a in (t, y))
    span = nodes[:, -1] - nodes[:, 0]
    near = span <= GAP * np.median(span)
    nodes, values = nodes[near] / np.median(span), values[near]
    apart = nodes[:, :, None] - nodes[:, None, :] + np.eye(order + 1)
    weights = 1 / np.prod(apart, axis=2)
    return np.sum(weights * values, axis=1) / np.sqrt(np.sum(weights**2, axis=1))
