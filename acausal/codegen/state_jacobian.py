"""The Jacobian ``d(dx/dt)/dx`` of a model, with a pattern that is known from its structure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.caches import LeavesCaches
from acausal.codegen.iteration_matrix import (
    DenseIterationMatrix,
    IterationMatrix,
    SparseIterationMatrix,
)
from acausal.flattening import Integers
from acausal.structure import ReducedModel, color_columns, jacobian_pattern, long_rows

FEW = 32
"""Up to so many states a Jacobian is dense: one product with a matrix of directions finds all columns."""

DENSE = 0.2
"""The share of entries from which on a Jacobian is dense."""

SMALL = 100
"""Up to so many states LAPACK is faster than a sparse factorization on the host."""


@dataclass(frozen=True, eq=False)
class StateJacobian(LeavesCaches):
    """Positions of the entries of ``d(dx/dt)/dx``, and how to compute them.

    Attributes:
        n: number of states.
        positions: rows and columns of the entries, row by row, the whole diagonal among them; None if all n * n
            entries are present.
        long_rows: rows that are found by a reverse derivative each.
        colors: of every column, shape (n,); columns of one colour share none of the other rows.
    """

    n: int
    positions: tuple[Integers, Integers] | None
    long_rows: Integers
    colors: Integers

    @classmethod
    def of(cls, reduced: ReducedModel) -> StateJacobian:
        """The pattern of a model's Jacobian, with a colouring of its columns."""
        n = len(reduced.states)
        found = jacobian_pattern(reduced) if n > FEW else None
        if found is not None:
            diagonal = np.arange(n) * (n + 1)
            places = np.union1d(found[0] * n + found[1], diagonal)
            if len(places) <= DENSE * n**2:
                rows, columns = np.divmod(places, n)
                above = long_rows(rows, n)
                short = ~np.isin(rows, above)
                colors = color_columns(rows[short], columns[short], n, n)
                return cls(n, (rows, columns), above, colors)
        return cls(n, None, np.zeros(0, dtype=np.int64), np.arange(n))

    @property
    def is_dense(self) -> bool:
        """Whether all entries are present, so that they are a matrix of shape (n, n), row by row."""
        return self.positions is None

    @property
    def n_entries(self) -> int:
        """How many entries there are."""
        return self.n**2 if self.positions is None else len(self.positions[0])

    @property
    def rows(self) -> Integers:
        """The row of every entry."""
        return np.repeat(np.arange(self.n), self.n) if self.positions is None else self.positions[0]

    @property
    def columns(self) -> Integers:
        """The column of every entry."""
        return np.tile(np.arange(self.n), self.n) if self.positions is None else self.positions[1]

    @cached_property
    def n_colors(self) -> int:
        """How many products with a vector give all entries but those of long rows."""
        return int(self.colors.max(initial=-1)) + 1

    def entries(
        self, field: Callable[[Float[Array, " n"]], Float[Array, " n"]], x: Float[Array, " n"]
    ) -> Float[Array, " n_entries"]:
        """The entries of the Jacobian of ``field`` at ``x``, by a forward derivative for each colour.

        They are computed in turn: side by side they take longer to compile and are slower for many states.

        Arguments:
            field: derivatives of the states as a function of the states, with this pattern. x: states.
        """
        if self.n <= FEW:
            return jax.jacfwd(field)(x).ravel()
        push = jax.linearize(field, x)[1]
        if self.positions is None:
            columns = jax.lax.map(push, jnp.eye(self.n, dtype=x.dtype), batch_size=FEW)
            return columns.T.ravel()

        def column_sum(color: Array) -> Array:
            return push((self.colors == color).astype(x.dtype))

        found = jax.lax.map(column_sum, jnp.arange(self.n_colors)).ravel()
        if len(self.long_rows):
            pull = jax.linear_transpose(push, x)

            def row(number: Array) -> Array:
                return pull(jax.nn.one_hot(number, self.n, dtype=x.dtype))[0]

            rows = jax.lax.map(row, jnp.asarray(self.long_rows))
            found = jnp.concatenate([found, rows.ravel()])
        return jnp.take(found, self._places, unique_indices=True, mode="clip")

    @cached_property
    def _places(self) -> Integers:
        """Where each entry lies among the derivatives."""
        rows, columns = self.rows, self.columns
        above = np.full(self.n, -1)
        above[self.long_rows] = np.arange(len(self.long_rows))
        forward = self.colors[columns] * self.n + rows
        reverse = (self.n_colors + above[rows]) * self.n + columns
        return np.where(above[rows] < 0, forward, reverse)

    @cached_property
    def iteration_matrix(self) -> IterationMatrix:
        """How to solve equations with ``I - c J``: with LAPACK for few states or a full matrix, else with SuperLU."""
        if self.positions is None or self.n <= SMALL:
            return DenseIterationMatrix(self.n, self.positions)
        return SparseIterationMatrix.of(self.n, *self.positions)
