"""Gather: how a group of instances reads one argument out of arrays that earlier instructions have filled.

This is data: where elements lie. `acausal.codegen.reading` reads them with JAX.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from acausal.flattening import Integers

MAX_RUNS = 8
"""The most slices that are read one by one; more are read by an index."""

Positions = tuple[Integers, Integers]
"""For every element, its array and its place there."""


@dataclass(frozen=True)
class One:
    """A single element (or a source that is a scalar), the same for all instances."""

    source: int
    index: int

    @property
    def sources(self) -> tuple[int, ...]:
        """The arrays that are read."""
        return (self.source,)

    def positions(self, sizes: Sequence[int]) -> Positions:
        """Where the element lies; ``sizes`` are the lengths of all arrays."""
        return np.asarray([self.source]), np.asarray([self.index])


@dataclass(frozen=True)
class IndexRuns:
    """Slices (source, start, step, length), one behind the other."""

    runs: tuple[tuple[int, int, int, int], ...]

    @property
    def sources(self) -> tuple[int, ...]:
        """The arrays that are read."""
        return tuple(dict.fromkeys(source for source, *_ in self.runs))

    def positions(self, sizes: Sequence[int]) -> Positions:
        """Where the elements lie; see `One.positions`."""
        sources = [np.full(length, source) for source, _, _, length in self.runs]
        indices = [start + step * np.arange(length) for _, start, step, length in self.runs]
        nothing = np.zeros(0, dtype=np.int64)
        return np.concatenate([nothing, *sources]), np.concatenate([nothing, *indices])


@dataclass(frozen=True)
class Interleaved:
    """Elements of the first column, the second and so on in turn, as states of equal components lie.

    Unlike a `Take`, it is differentiated without a scatter.
    """

    columns: tuple[IndexRuns, ...]

    @property
    def sources(self) -> tuple[int, ...]:
        """The arrays that are read."""
        return tuple(dict.fromkeys(s for column in self.columns for s in column.sources))

    def positions(self, sizes: Sequence[int]) -> Positions:
        """Where the elements lie; see `One.positions`."""
        columns = [column.positions(sizes) for column in self.columns]
        sources, indices = (np.stack(side, axis=1).ravel() for side in zip(*columns, strict=True))
        return sources, indices


@dataclass(frozen=True)
class Take:
    """Scattered elements: an index into the sources laid one behind the other."""

    sources: tuple[int, ...]
    index: Integers

    def positions(self, sizes: Sequence[int]) -> Positions:
        """Where the elements lie; see `One.positions`."""
        ends = np.cumsum([sizes[s] for s in self.sources])
        place = np.searchsorted(ends, self.index, side="right")
        begins = ends - np.asarray([sizes[s] for s in self.sources])
        positions: Integers = self.index - begins[place]
        return np.asarray(self.sources)[place], positions


Elements = One | IndexRuns | Interleaved | Take


@dataclass(frozen=True)
class Signed:
    """Elements that a gather selects, each times its sign."""

    elements: Elements
    signs: Integers

    @property
    def sources(self) -> tuple[int, ...]:
        """The arrays that are read."""
        return self.elements.sources

    def positions(self, sizes: Sequence[int]) -> Positions:
        """Where the elements lie, without their signs; see `One.positions`."""
        return self.elements.positions(sizes)


Gather = Elements | Signed


def signed(elements: Elements, signs: Integers) -> Gather:
    """The same, each times its sign."""
    return elements if (signs == 1).all() else Signed(elements, signs)


def gather(source: Integers, index: Integers, sizes: Sequence[int]) -> Elements:
    """The cheapest way to read elements ``index[i]`` of arrays ``source[i]``.

    One element where all are the same, slices where the indices progress evenly, or every second one does, or
    third, and so on; else a take. ``sizes`` are the lengths of the arrays.
    """
    if len(source) and (source == source[0]).all() and (index == index[0]).all():
        return One(int(source[0]), int(index[0]))
    runs = _runs(source, index)
    if len(runs) <= MAX_RUNS:
        return IndexRuns(runs)
    for n in range(2, MAX_RUNS + 1):
        columns = (
            [_runs(source[i::n], index[i::n]) for i in range(n)] if len(source) % n == 0 else ()
        )
        if columns and sum(map(len, columns)) <= MAX_RUNS:
            return Interleaved(tuple(IndexRuns(column) for column in columns))
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
