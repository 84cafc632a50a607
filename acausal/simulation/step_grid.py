"""The ends of equal steps, and which times are among them."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from acausal.errors import DataError

ON_GRID = 1e-6
"""A time counts as the end of a step if it is within this fraction of a step of it."""


def step_ends(start: float, end: float, dt: float) -> Float[np.ndarray, " n_ends"]:
    """The ends of equal steps ``dt`` from start to end, shape (n + 1,).

    Raises:
        DataError: if they do not divide the span.
    """
    if not (isinstance(dt, float | int | np.number) and np.isfinite(dt) and dt > 0):
        raise DataError(f"dt={dt!r} is not a step; give a positive time in seconds.")
    span = end - start
    n = max(round(span / dt), 1)
    if abs(span / dt - n) > ON_GRID * n:
        raise DataError(
            f"Steps of dt={dt:g} s do not divide the {span:g} s from {start:g} to {end:g} s; "
            f"choose dt={span:g}/{n}, or end at {start + n * dt:g} s."
        )
    return start + span / n * np.arange(n + 1)


def rows_of(
    ends: Float[np.ndarray, " n_ends"], times: Float[np.ndarray, " n"]
) -> Int[np.ndarray, " n"]:
    """The indices of times among the ends of steps.

    Raises:
        DataError: for a time that is not among them.
    """
    position = (times - ends[0]) / (ends[1] - ends[0])
    rows = np.round(position).astype(int)
    off = np.abs(position - rows) > ON_GRID * len(ends)
    if off.any():
        raise DataError(
            f"saveat has {times[off][0]:g} s, not the end of a step; "
            "save multiples of dt, or leave dt out for adaptive steps."
        )
    return rows
