"""Solve large sparse systems of linear equations inside JAX programs: SuperLU on the host, a fixed order of pivots.

The pattern is analysed once, when a model is compiled. Factorizations are kept as long as their entries come back, so
that a matrix of parameters alone is factorized once for a whole simulation, and the transposed system of a gradient is
solved with the factors of the system itself.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import jax
import numpy as np
from jax.experimental.buffer_callback import buffer_callback
from jaxtyping import Array, Float

from acausal.codegen.factorizations import Factorizations
from acausal.structure import Pattern


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
        """``x`` with ``A x = b``, or ``A^T x = b``, differentiable by both; NaN where the matrix is singular.

        Arguments:
            entries: values of the entries, shape (nnz,). b: right side, shape (n,).
        """

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
