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
from acausal.structure import ReducedModel, color_columns, jacobian_pattern

FEW = 32
"""Up to so many states a Jacobian is dense: one product with a matrix of directions finds all columns."""

DENSE = 0.2
"""The share of entries from which on a Jacobian is dense."""

SMALL = 100
"""Up to so many states LAPACK is faster than a sparse factorization on the host."""

AT_ONCE = 1 << 24
"""The most numbers of products with directions that are computed side by side."""


@dataclass(frozen=True, eq=False)
class StateJacobian(LeavesCaches):
    """Positions of the entries of ``d(dx/dt)/dx`` and how to compute them.

    Attributes:
        n: number of states.
        rows, columns: positions of the entries, row by row, shape (n_entries,); the whole diagonal is among them.
        colors: of every column, shape (n,); columns of one colour share no row.
        is_dense: whether all entries are present, so that they are a matrix of shape (n, n), row by row.
    """

    n: int
    rows: Integers
    columns: Integers
    colors: Integers
    is_dense: bool

    @classmethod
    def of(cls, reduced: ReducedModel) -> StateJacobian:
        """The pattern of a model's Jacobian, with a colouring of its columns."""
        n = len(reduced.states)
        found = jacobian_pattern(reduced) if n > FEW else None
        if found is not None:
            diagonal = np.arange(n) * (n + 1)
            places = np.union1d(found[0] * n + found[1], diagonal)
            rows, columns = np.divmod(places, n)
            if len(places) <= DENSE * n**2:
                return cls(n, rows, columns, color_columns(rows, columns, n, n), False)
        rows, columns = np.divmod(np.arange(n**2), max(n, 1))
        return cls(n, rows, columns, np.arange(n), True)

    @cached_property
    def n_colors(self) -> int:
        """How many products with a vector give all entries."""
        return int(self.colors.max(initial=-1)) + 1

    def entries(
        self, field: Callable[[Float[Array, " n"]], Float[Array, " n"]], x: Float[Array, " n"]
    ) -> Float[Array, " n_entries"]:
        """The entries of the Jacobian of ``field`` at ``x``, by forward derivatives, one for each colour.

        Arguments:
            field: derivatives of the states as a function of the states, with this pattern. x: states.
        """
        if self.is_dense:
            return jax.jacfwd(field)(x).ravel()

        def product(color: Array) -> Array:
            return jax.jvp(field, (x,), ((self.colors == color).astype(x.dtype),))[1]

        colors = jnp.arange(self.n_colors)
        if self.n_colors * self.n <= AT_ONCE:
            products = jax.vmap(product)(colors)
        else:
            products = jax.lax.map(product, colors, batch_size=max(AT_ONCE // self.n, 1))
        places = self.colors[self.columns] * self.n + self.rows
        return jnp.take(products.ravel(), places, unique_indices=True, mode="clip")

    @cached_property
    def iteration_matrix(self) -> IterationMatrix:
        """How to solve equations with ``I - c J``: with LAPACK for few states or a full matrix, else with SuperLU."""
        if self.is_dense or self.n <= SMALL:
            return DenseIterationMatrix(self.n, self.rows, self.columns)
        return SparseIterationMatrix.of(self.n, self.rows, self.columns)
