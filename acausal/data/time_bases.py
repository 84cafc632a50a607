"""Several time bases as one: the sorted union of their times, in which each has its places."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from jaxtyping import Float, Int

Times: TypeAlias = Float[np.ndarray, " n"]
Rows: TypeAlias = Int[np.ndarray, " n"]

SAME = 1e-6
"""Times of two bases are one if they differ by less than this fraction of the local sample time."""


def union(bases: Sequence[Times]) -> tuple[Times, list[Rows | None]]:
    """The sorted times of all bases, and by base the rows of its samples there; ``None`` means all rows.

    Each base increases strictly. The local sample time is the shortest interval beside a sample; of times that are
    one, the earliest is kept. Equal bases cost one.
    """
    unlike, which = _unlike(bases)
    if len(unlike) == 1:
        return unlike[0], [None for _ in bases]
    everything = np.concatenate(unlike)
    order = np.argsort(everything, kind="stable")
    ts = everything[order]
    local = np.concatenate([_local_sample_time(base) for base in unlike])[order]
    is_new = np.ones(len(ts), bool)
    is_new[1:] = np.diff(ts) >= SAME * np.minimum(local[1:], local[:-1])
    rows = np.empty(len(ts), int)
    rows[order] = np.cumsum(is_new) - 1
    ends = np.cumsum([len(base) for base in unlike])[:-1]
    rows_of = np.split(rows, ends)
    merged = ts[is_new]
    return merged, [rows_of[i] if len(rows_of[i]) < len(merged) else None for i in which]


def on_rows(values: Float[np.ndarray, " n"], rows: Rows | None, length: int) -> Times:
    """Samples at their rows of a union of ``length`` times, and NaN elsewhere."""
    if rows is None:
        return values
    column = np.full(length, np.nan)
    column[rows] = values
    return column


def _unlike(bases: Sequence[Times]) -> tuple[list[Times], list[int]]:
    """The bases that differ, and by base which of them it is."""
    unlike: list[Times] = []
    which: list[int] = []
    for base in bases:
        places = (i for i, u in enumerate(unlike) if u is base or np.array_equal(u, base))
        place = next(places, len(unlike))
        unlike += [base] if place == len(unlike) else []
        which.append(place)
    return unlike, which


def _local_sample_time(ts: Times) -> Times:
    """The shorter of the two intervals beside each time."""
    steps = np.diff(ts)
    return np.minimum(np.concatenate([steps[:1], steps]), np.concatenate([steps, steps[-1:]]))
