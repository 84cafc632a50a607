"""Which sources the results of a computation depend on, from integers alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.structure.elimination_order import Integers


class TooManyError(Exception):
    """There are more dependences than are worth writing down."""


@dataclass(frozen=True)
class Computation:
    """Rows that compute all their results from all that they read.

    Attributes:
        n_rows: how many rows there are.
        result_rows, results: pairs of a row and a node that it computes.
        read_rows, reads: pairs of a row and a node that it reads.
    """

    n_rows: int
    result_rows: Integers
    results: Integers
    read_rows: Integers
    reads: Integers

    def chosen(self, wanted: np.ndarray) -> Computation:
        """The rows that compute a wanted node; ``wanted`` has a truth value for every node."""
        rows = np.zeros(self.n_rows, dtype=bool)
        rows[self.result_rows[wanted[self.results]]] = True
        number = np.cumsum(rows) - 1
        computing, reading = rows[self.result_rows], rows[self.read_rows]
        return Computation(
            int(rows.sum()),
            number[self.result_rows[computing]],
            self.results[computing],
            number[self.read_rows[reading]],
            self.reads[reading],
        )


def dependence(
    computations: Sequence[Computation],
    sources: Integers,
    wanted: Integers,
    n_nodes: int,
    most: int,
) -> tuple[Integers, Integers] | None:
    """The pairs (i, j) for which ``wanted[i]`` depends on ``sources[j]``, in order; None if there are too many.

    Arguments:
        computations: in order; each reads sources and results of those before it.
        n_nodes: nodes are less than this number.
        most: how many dependences may be written down.
    """
    needed = np.zeros(n_nodes, dtype=bool)
    needed[wanted] = True
    chosen: list[Computation] = []
    for computation in reversed(computations):
        chosen.append(computation.chosen(needed))
        needed[chosen[-1].reads] = True
    sets = _Sets(sources, n_nodes, most)
    try:
        for computation in reversed(chosen):
            sets.compute(computation)
        return sets.pairs(np.arange(len(wanted)), wanted)
    except TooManyError:
        return None


class _Sets:
    """For every node the sources that it depends on: a piece of one long array; equal nodes share a piece."""

    def __init__(self, sources: Integers, n_nodes: int, most: int) -> None:
        self._n_sources, self._most, self._used = len(sources), most, len(sources)
        self._members = np.arange(max(2 * len(sources), 1))
        self._start = np.zeros(n_nodes, dtype=np.int64)
        self._length = np.zeros(n_nodes, dtype=np.int64)
        self._start[sources], self._length[sources] = np.arange(len(sources)), 1

    def compute(self, computation: Computation) -> None:
        """Note the dependences of a computation's results."""
        rows, reads = computation.read_rows, computation.reads
        rows, reads = (a[self._length[reads] > 0] for a in (rows, reads))
        start, length = (np.zeros(computation.n_rows, dtype=np.int64) for _ in range(2))
        start[rows], length[rows] = self._start[reads], self._length[reads]
        several = np.bincount(rows, minlength=computation.n_rows) > 1
        if several.any():
            merged = np.flatnonzero(several)
            joining = several[rows]
            pairs = self.pairs(np.searchsorted(merged, rows[joining]), reads[joining])
            counts = np.bincount(pairs[0], minlength=len(merged))
            start[merged] = self._append(pairs[1]) + np.cumsum(counts) - counts
            length[merged] = counts
        self._start[computation.results] = start[computation.result_rows]
        self._length[computation.results] = length[computation.result_rows]

    def pairs(self, rows: Integers, nodes: Integers) -> tuple[Integers, Integers]:
        """The pairs of a row and a source that one of the row's nodes depends on; each once, in order."""
        length = self._length[nodes]
        ends = np.cumsum(length)
        total = int(ends[-1]) if len(ends) else 0
        if total > self._most:
            raise TooManyError
        places = np.repeat(self._start[nodes] - ends + length, length) + np.arange(total)
        keys = np.repeat(rows, length) * self._n_sources + self._members[places]
        found: Any = np.divmod(_distinct(keys), max(self._n_sources, 1))
        return found

    def _append(self, members: Integers) -> int:
        """Keep members; returns where they start."""
        start, self._used = self._used, self._used + len(members)
        if self._used > self._most:
            raise TooManyError
        if self._used > len(self._members):
            grown = np.zeros(2 * self._used, dtype=np.int64)
            grown[:start] = self._members[:start]
            self._members = grown
        self._members[start : self._used] = members
        return start


def _distinct(keys: Integers) -> Integers:
    """Each number once, in order."""
    keys = np.sort(keys)
    return keys[np.concatenate([[True], keys[1:] != keys[:-1]])] if len(keys) else keys
