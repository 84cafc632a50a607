"""Solve large sparse systems of linear equations inside JAX programs: SuperLU on the host, a fixed order of pivots.

The pattern is analysed once, when a model is compiled. A factorization is kept as long as the entries
stay the same, so that a matrix of parameters alone is factorized once for a whole simulation, and the
transposed system of a gradient is solved with the factors of the system itself.
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

    def times(self, entries: Float[Array, " nnz"], x: Float[Array, " n"]) -> Float[Array, " n"]:
        """``A x``, shape (n,)."""
        p = self.pattern
        return jax.ops.segment_sum(entries * x[p.columns], p.rows, len(p.row_order))

    def solve(self, entries: Float[Array, " nnz"], b: Float[Array, " n"]) -> Float[Array, " n"]:
        """``x`` with ``A x = b``, differentiable by both; NaN where the matrix is singular.

        Arguments:
            entries: values of the entries, shape (nnz,). b: right side, shape (n,).
        """

        def solve(transposed: bool) -> Callable[[Any, Array], Array]:
            return lambda _, b: self._on_host(transposed, entries, b)

        return jax.lax.custom_linear_solve(
            lambda x: self.times(entries, x), b, solve(False), solve(True)
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
            return self._factorized(entries.ravel(), transposed)(rows).reshape(*batch, n)
        matrices = np.broadcast_to(entries, (*batch, entries.shape[-1]))
        sides = np.broadcast_to(b, (*batch, n))
        solved = np.empty((*batch, n))
        for i in np.ndindex(*batch):
            solved[i] = self._factorized(matrices[i], transposed)(sides[i][None])[0]
        return solved

    def _factorized(
        self, entries: np.ndarray, transposed: bool
    ) -> Callable[[np.ndarray], np.ndarray]:
        """From right sides (k, n) to solutions (k, n)."""
        factors = self._memory.factors(entries)
        if factors is None:
            return lambda b: np.full(b.shape, np.nan)
        into, out_of = self.pattern.row_order, self.pattern.column_order
        if transposed:
            into, out_of = out_of, into
        mode = "T" if transposed else "N"

        def solve(b: np.ndarray) -> np.ndarray:
            solved = np.empty(b.shape)
            solved[:, out_of] = factors.solve(b[:, into].T.astype(float), mode).T
            return solved

        return solve

    @cached_property
    def _memory(self) -> _Memory:
        p, n = self.pattern, len(self.pattern.row_order)
        rows, columns = np.argsort(p.row_order)[p.rows], np.argsort(p.column_order)[p.columns]
        order = np.lexsort((rows, columns))
        starts = np.searchsorted(columns[order], np.arange(n + 1))
        return _Memory(order, csc_array((np.zeros(len(order)), rows[order], starts), (n, n)))


@cache
def _thread(process: int) -> ThreadPoolExecutor:
    """The thread of a process that factorizes; a forked process has its own."""
    return ThreadPoolExecutor(1, f"factorizations of {process}")


class _Memory:
    """The latest factorization and the entries that it belongs to.

    JAX calls the host from threads of its own, and SciPy does not free a factorization that another thread drops than
    the one that has made it. So one thread makes and drops them all.
    """

    def __init__(self, order: Integers, matrix: csc_array) -> None:
        self._order = order
        self._pattern: Any = matrix
        self._latest: tuple[np.ndarray, Any] | None = None

    def factors(self, entries: np.ndarray) -> Any:
        """LU factors of the matrix with these entries, or None if it is singular or not finite."""
        latest = self._latest
        if latest is None or not np.array_equal(latest[0], entries):
            latest = None  # so that the other thread drops it
            latest = _thread(os.getpid()).submit(self._replace, np.array(entries)).result()
        return latest[1]

    def _replace(self, entries: np.ndarray) -> tuple[np.ndarray, Any]:
        self._latest = None
        self._latest = latest = entries, self._factorize(entries)
        return latest

    def _factorize(self, entries: np.ndarray) -> Any:
        if not np.isfinite(entries).all():
            return None
        p = self._pattern
        values = entries[self._order].astype(float)
        try:
            return splu(
                csc_array((values, p.indices, p.indptr), shape=p.shape),
                permc_spec="NATURAL",
                diag_pivot_thresh=THRESHOLD,
                options=SETTINGS,
            )
        except RuntimeError:  # exactly singular
            return None
