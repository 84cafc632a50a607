"""Thin curves out for drawing: where samples are left out, the extremes of each stretch stay."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int

from acausal.reporting.document.content import Curve


def kept_rows(columns: Sequence[Float[np.ndarray, " n"]], most: int) -> Int[np.ndarray, " m"]:
    """The rows of some curves over one axis that are drawn, about ``most`` of them.

    Half of them lie at equal distances. The others are where a curve is lowest or highest within a stretch, so that no
    peak is lost. What is no number is skipped, but for a gap of a whole stretch.
    """
    n = len(columns[0]) if columns else 0
    stretches = max(1, most // (4 * max(1, len(columns))))
    size = -(-n // stretches)
    if n <= most or size <= 2:
        return np.arange(n)
    padded = stretches * size - n
    first = size * np.arange(stretches)
    rows = [np.linspace(0, n - 1, max(2, most // 2)).round().astype(int)]
    for column in columns:
        cells = np.pad(column, (0, padded), constant_values=np.nan).reshape(stretches, size)
        finite = np.isfinite(cells)
        rows += [
            first + np.argmin(np.where(finite, cells, np.inf), axis=1),
            first + np.argmax(np.where(finite, cells, -np.inf), axis=1),
        ]
    return np.unique(np.minimum(np.concatenate(rows), n - 1))


def thinned(curves: Sequence[Curve], most: int) -> tuple[Curve, ...]:
    """Curves over common points with about so many of them; extremes stay."""
    rows = kept_rows([c.y for c in curves], most)
    return tuple(c if len(rows) == len(c.x) else c.at(rows) for c in curves)


def broken_at_gaps(
    x: Float[np.ndarray, " n"], y: Float[np.ndarray, " n"], gap: float = 5.0
) -> tuple[Float[np.ndarray, " m"], Float[np.ndarray, " m"]]:
    """A curve without what is not known, broken where points are missing for more than ``gap`` usual distances."""
    known = np.isfinite(y)
    x, y = x[known], y[known]
    distances = np.diff(x)
    if not len(distances):
        return x, y
    after = np.flatnonzero(distances > gap * np.median(distances)) + 1
    return np.insert(x, after, x[after]), np.insert(y, after, np.nan)
