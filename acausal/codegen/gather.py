"""Gather: how a group of instances reads one argument out of arrays that earlier groups have made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import jax.numpy as jnp
import numpy as np

from acausal.flattening import Integers

Arrays = Sequence[Any]
MAX_RUNS = 8


@dataclass(frozen=True)
class One:
    """A single element (or a source that is a scalar), the same for all instances."""

    source: int
    index: int

    def read(self, arrays: Arrays) -> Any:
        """The argument's value, read from the arrays."""
        array = arrays[self.source]
        return array if jnp.ndim(array) == 0 else array[self.index]

    @property
    def sources(self) -> tuple[int, ...]:
        """The arrays that are read."""
        return (self.source,)


@dataclass(frozen=True)
class Runs:
    """Slices (source, start, step, length), one behind the other."""

    runs: tuple[tuple[int, int, int, int], ...]

    def read(self, arrays: Arrays) -> Any:
        """The argument's value, read from the arrays."""
        pieces = [
            _slice(arrays[source], start, step, length) for source, start, step, length in self.runs
        ]
        if not pieces:
            return jnp.zeros(0)
        return pieces[0] if len(pieces) == 1 else jnp.concatenate(pieces)

    @property
    def sources(self) -> tuple[int, ...]:
        """The arrays that are read."""
        return tuple(dict.fromkeys(source for source, *_ in self.runs))


@dataclass(frozen=True)
class Interleaved:
    """Elements of the first column, the second and so on in turn, as states of equal components lie.

    Unlike a `Take`, it is differentiated without a scatter.
    """

    columns: tuple[Runs, ...]

    def read(self, arrays: Arrays) -> Any:
        """The argument's value, read from the arrays."""
        return jnp.stack([column.read(arrays) for column in self.columns], axis=1).ravel()

    @property
    def sources(self) -> tuple[int, ...]:
        """The arrays that are read."""
        return tuple(dict.fromkeys(s for column in self.columns for s in column.sources))


@dataclass(frozen=True)
class Take:
    """Scattered elements: an index into the sources laid one behind the other."""

    sources: tuple[int, ...]
    index: Integers

    def read(self, arrays: Arrays) -> Any:
        """The argument's value, read from the arrays."""
        pieces = [jnp.atleast_1d(arrays[s]) for s in self.sources]
        whole = pieces[0] if len(pieces) == 1 else jnp.concatenate(pieces)
        return jnp.take(
            whole, self.index, axis=0, unique_indices=len(np.unique(self.index)) == len(self.index)
        )


Gather = One | Runs | Interleaved | Take


def _slice(array: Any, start: int, step: int, length: int) -> Any:
    if jnp.ndim(array) == 0:
        return array[None]
    if step == 1 and start == 0 and length == array.shape[0]:
        return array
    return array[start : start + step * (length - 1) + 1 : step]


def gather(source: Integers, index: Integers, sizes: Sequence[int]) -> Gather:
    """The cheapest way to read elements ``index[i]`` of arrays ``source[i]``.

    One element where all are the same, slices where the indices progress evenly, or every second one does, or
    third, and so on; else a take. ``sizes`` are the lengths of the arrays.
    """
    if len(source) and (source == source[0]).all() and (index == index[0]).all():
        return One(int(source[0]), int(index[0]))
    runs = _runs(source, index)
    if len(runs) <= MAX_RUNS:
        return Runs(runs)
    for n in range(2, MAX_RUNS + 1):
        columns = (
            [_runs(source[i::n], index[i::n]) for i in range(n)] if len(source) % n == 0 else ()
        )
        if columns and sum(map(len, columns)) <= MAX_RUNS:
            return Interleaved(tuple(Runs(column) for column in columns))
    used = list(dict.fromkeys(source.tolist()))
    offset = np.zeros(max(used) + 1, dtype=np.int64)
    offset[used] = np.cumsum([0, *(sizes[s] for s in used[:-1])])
    return Take(tuple(used), index + offset[source])


def _runs(source: Integers, index: Integers) -> tuple[tuple[int, int, int, int], ...]:
    """Split into the longest stretches of one source and one positive step."""
    runs: list[tuple[int, int, int, int]] = []
    step = np.diff(index)
    same = np.diff(source) == 0
    i, n = 0, len(index)
    while i < n and len(runs) <= MAX_RUNS:
        j = i
        if i + 1 < n and same[i] and step[i] > 0:
            breaks = np.flatnonzero(~same[i:] | (step[i:] != step[i]))
            j = i + int(breaks[0]) if len(breaks) else n - 1
        runs.append((int(source[i]), int(index[i]), int(step[i]) if j > i else 1, j - i + 1))
        i = j + 1
    return tuple(runs)
