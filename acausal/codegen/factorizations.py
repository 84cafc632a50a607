"""The latest LU factorizations of sparse matrices with one pattern, by SuperLU; found again by their entries."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from acausal.flattening import Integers
from acausal.structure import SETTINGS, THRESHOLD

PANEL = 1
"""Columns that SuperLU factorizes together: more were slower for plates, and no faster for bands and blocks."""

MOST = 64
"""The most factorizations that are kept, as where the members of a batch have a matrix each."""

BUDGET = 1 << 23
"""The most entries of all factors that are kept, but for those of the latest matrix: about 100 MB."""


@dataclass(frozen=True, eq=False)
class Factorized:
    """A matrix's entries and its factors; None if it is singular."""

    entries: np.ndarray
    factors: Any

    @property
    def size(self) -> int:
        """How many entries the factors have."""
        return 0 if self.factors is None else self.factors.nnz


@cache
def _thread(process: int) -> ThreadPoolExecutor:
    """The thread of a process that factorizes; a forked process has its own."""
    return ThreadPoolExecutor(1, f"factorizations of {process}")


class Factorizations:
    """The latest factorizations of matrices with one pattern.

    JAX calls the host from threads of its own, and SciPy does not free a factorization that another thread drops than
    the one that has made it. So one thread makes and drops them all.
    """

    def __init__(self, rows: Integers, columns: Integers, n: int) -> None:
        self._order = np.lexsort((rows, columns))
        starts = np.searchsorted(columns[self._order], np.arange(n + 1))
        self._pattern: Any = csc_array((np.zeros(len(rows)), rows[self._order], starts), (n, n))
        self._weights = np.random.default_rng(0).normal(size=len(rows))
        self._kept: dict[float, Factorized] = {}
        self._latest: Factorized | None = None

    def of(self, entries: np.ndarray) -> Any:
        """LU factors of the matrix with these entries, or None if it is singular or not finite."""
        latest = self._latest
        if latest is not None and np.array_equal(latest.entries, entries):
            return latest.factors
        del latest  # so that the other thread drops it
        key = float(np.einsum("i,i", self._weights, entries))
        if not np.isfinite(key) and not np.isfinite(entries).all():
            return None
        found = self._kept.get(key)
        if found is None or not np.array_equal(found.entries, entries):
            del found
            found = _thread(os.getpid()).submit(self._add, key, np.array(entries)).result()
        self._latest = found
        return found.factors

    def _add(self, key: float, entries: np.ndarray) -> Factorized:
        """Factorize, and drop the oldest that are too many."""
        self._latest = None
        self._kept.pop(key, None)
        self._kept[key] = added = Factorized(entries, self._factorize(entries))
        size = sum(kept.size for kept in self._kept.values())
        while len(self._kept) > 1 and (len(self._kept) > MOST or size > BUDGET):
            size -= self._kept.pop(next(iter(self._kept))).size
        return added

    def _factorize(self, entries: np.ndarray) -> Any:
        p = self._pattern
        values = entries[self._order].astype(float)
        try:
            return splu(
                csc_array((values, p.indices, p.indptr), shape=p.shape),
                permc_spec="NATURAL",
                diag_pivot_thresh=THRESHOLD,
                panel_size=PANEL,
                options=SETTINGS,
            )
        except RuntimeError:  # exactly singular
            return None
