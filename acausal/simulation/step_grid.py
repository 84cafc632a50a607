"""The ends of equal steps, and which times are among them."""

from __future__ import annotations

import os

import numpy as np
from jaxtyping import Float, Int

from acausal._jax import is_number, traced
from acausal.errors import DataError, shown

ON_GRID = 1e-6
"""A time counts as the end of a step if it is within this fraction of a step of it."""

UNITS = ("bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB")

UNKNOWN_MEMORY = 2**36
"""Bytes of memory that a machine is taken to have that does not say."""


def memory() -> float:
    """Bytes of this machine's memory."""
    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, OSError, ValueError):  # other systems than Unix
        return UNKNOWN_MEMORY


def in_bytes(size: float) -> str:
    """Bytes as text."""
    power = min(int(min(np.log2(size), 1024)) // 10, len(UNITS) - 1)
    return f"{size / 1024**power:.3g} {UNITS[power]}"


def step_ends(start: float, end: float, dt: float, width: int) -> Float[np.ndarray, " n_ends"]:
    """The ends of equal steps ``dt`` from start to end, shape (n + 1,).

    Arguments:
        start, end, dt: in seconds.
        width: how many numbers are stored for each step.

    Raises:
        DataError: if they do not divide the span, or if this machine's memory cannot hold so many.
    """
    if isinstance(dt, bool) or traced(dt) or not (is_number(dt) and dt > 0):
        raise DataError(f"dt={shown(dt)} is not a step; give a positive time in seconds.")
    span = end - start
    if (needed := 8.0 * width * (span / dt)) > memory():
        raise DataError(
            f"dt={dt:g} s makes {span / dt:.3g} steps from {start:g} to {end:g} s, which need {in_bytes(needed)} of "
            f"memory where there are {in_bytes(memory())}; choose a longer dt, or leave it out for adaptive steps."
        )
    n = max(round(span / dt), 1)
    if abs(span / dt - n) > ON_GRID * n:
        raise DataError(
            f"Steps of dt={dt:g} s do not divide the {span:g} s from {start:g} to {end:g} s; "
            f"choose dt={span:g}/{n}, or end at {start + n * dt:g} s."
        )
    return np.append(start + span / n * np.arange(n), end)  # rounding would put the last beyond


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
