"""Solve large sparse systems of linear equations inside JAX programs: SuperLU on the host, a fixed order of pivots.

The pattern is analysed once, when a model is compiled. Factorizations are kept as long as their entries come back, so
that a matrix of parameters alone is factorized once for a whole simulation, and the transposed system of a gradient is
solved with the factors of the system itself.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import jax
import numpy as np
from jax.experimental.buffer_callback import buffer_callback
from jaxtyping import Array, Float
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from acausal.flattening import Integers
from acausal.structure import SETTINGS, THRESHOLD, Pattern


@dataclass(frozen=True, eq=False)
class SparseMatrix:
    """A square matrix with a fixed pattern and variable entries."""

    pattern: Pattern

    def times(
        self, entries: Float[Array, " nnz"], x: Float[Array, " n"], *, transposed: bool = False
    ) -> Float[Array, " n"]:
        """``A x``, or ``A^T x``, shape (n,)."""
        p = self.pattern
        read, added = (p.rows, p.columns) if transposed else (p.columns, p.rows)
        return jax.ops.segment_sum(entries * x[read], added, len(p.row_order))

    def solve(
        self, entries: Float[Array, " nnz"], b: Float[Array, " n"], *, transposed: bool = False
    ) -> Float[Array, " n"]:
        """``x`` with ``A x = b``, or ``A^T x = b``, differentiable by entries of A and b; NaN where it is singular."""

        def solve(other: bool) -> Callable[[Any, Array], Array]:
            return lambda _, b: self._on_host(transposed != other, entries, b)

        return jax.lax.custom_linear_solve(
            lambda x: self.times(entries, x, transposed=transposed), b, solve(False), solve(True)
        )

    def _on_host(self, transposed: bool, entries: Array, b: Array) -> Array:
        """Solve by a call of the host. On the CPU it reads and writes the program's own memory."""
        shape = jax.ShapeDtypeStruct(b.shape, b.dtype)

        def returned(entries: Array, b: Array) -> np.ndarray:
            return self._solved(transposed, np.asarray(entries), np.asarray(b)).astype(b.dtype)

        def written(_: Any, out: Array, entries: Array, b: Array) -> None:
            np.asarray(out)[...] = self._solved(transposed, np.asarray(entries), np.asarray(b))

        return jax.lax.platform_dependent(
            entries,
            b,
            cpu=buffer_callback(written, shape, vmap_method="expand_dims"),
            default=lambda *args: jax.pure_callback(
                returned, shape, *args, vmap_method="expand_dims"
            ),
        )

    def _solved(self, transposed: bool, entries: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Solutions for stacks of entries and right sides; one factorization where the entries are shared."""
        n, batch = b.shape[-1], np.broadcast_shapes(entries.shape[:-1], b.shape[:-1])
        if entries.size == entries.shape[-1]:
            rows = np.broadcast_to(b, (*batch, n)).reshape(-1, n)
            return self._one_matrix(transposed, entries.ravel(), rows).reshape(*batch, n)
        matrices = np.broadcast_to(entries, (*batch, entries.shape[-1]))
        sides = np.broadcast_to(b, (*batch, n))
        solved = np.empty((*batch, n))
        for i in np.ndindex(*batch):
            solved[i] = self._one_matrix(transposed, matrices[i], sides[i][None])[0]
        return solved

    def _one_matrix(self, transposed: bool, entries: np.ndarray, b: np.ndarray) -> np.ndarray:
        """From right sides (k, n) to solutions (k, n)."""
        factors = self._factorizations.of(entries)
        if factors is None:
            return np.full(b.shape, np.nan)
        p = self.pattern
        first, last = p.row_order, self._row_places if transposed else self._column_places
        if transposed:
            first = p.column_order
        sides = b.take(first, axis=1).T.astype(float, copy=False)
        return factors.solve(sides, "T" if transposed else "N").T.take(last, axis=1)

    @cached_property
    def _row_places(self) -> np.ndarray:
        return np.argsort(self.pattern.row_order)

    @cached_property
    def _column_places(self) -> np.ndarray:
        return np.argsort(self.pattern.column_order)

    @cached_property
    def _factorizations(self) -> Factorizations:
        p = self.pattern
        return Factorizations(
            self._row_places[p.rows], self._column_places[p.columns], len(p.row_order)
        )


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
