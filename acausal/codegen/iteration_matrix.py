"""Solve equations with ``I - c J``, the iteration matrix of implicit methods, factorized once for several right sides.

What is kept of a matrix is a pytree of arrays, so that a `jax.lax.while_loop` can carry it. All functions are pure;
they can be jitted, vmapped and differentiated.
"""

from __future__ import annotations

from dataclasses import dataclass

import jax.numpy as jnp
from jax.lax.linalg import lu, triangular_solve
from jaxtyping import Array, Float

from acausal.codegen.sparse import SparseMatrix
from acausal.flattening import Integers
from acausal.structure import analyse_diagonal


@dataclass(frozen=True, eq=False)
class DenseIterationMatrix:
    """By LAPACK; the factors themselves are kept: the LU factors in one matrix, and the permutation of the rows.

    Attributes:
        n: number of rows. positions: rows and columns of the entries, row by row; None if all are present.
    """

    n: int
    positions: tuple[Integers, Integers] | None

    def factorize(
        self, entries: Float[Array, " n_entries"], c: Float[Array, ""] | float
    ) -> tuple[Array, Array]:
        """What is kept of ``I - c J``: arrays; ``entries`` are those of ``J``."""
        n = self.n
        if self.positions is None:
            jacobian = entries.reshape(n, n)
        else:
            at = jnp.zeros((n, n), entries.dtype).at[self.positions]
            jacobian = at.set(entries, unique_indices=True, indices_are_sorted=True)
        factors, _, permutation = lu(jnp.eye(n, dtype=entries.dtype) - c * jacobian)
        return factors, permutation

    def solve(
        self, kept: tuple[Array, Array], b: Float[Array, " n"], *, transposed: bool = False
    ) -> Float[Array, " n"]:
        """``x`` with ``(I - c J) x = b``, or with the transposed matrix; not finite where it is singular."""
        factors, permutation = kept
        if not transposed:
            y = _triangular(factors, b[permutation], lower=True)
            return _triangular(factors, y, lower=False)
        y = _triangular(factors, b, lower=False, transposed=True)
        y = _triangular(factors, y, lower=True, transposed=True)
        return jnp.zeros_like(y).at[permutation].set(y, unique_indices=True)


def _triangular(factors: Array, b: Array, *, lower: bool, transposed: bool = False) -> Array:
    """Solve with one of two factors in a matrix; the lower one has ones on its diagonal."""
    return triangular_solve(
        factors,
        b[:, None],
        left_side=True,
        lower=lower,
        unit_diagonal=lower,
        transpose_a=transposed,
    )[:, 0]


@dataclass(frozen=True, eq=False)
class SparseIterationMatrix:
    """By SuperLU on the host; the matrix's entries are kept, and the host remembers the factors that belong to them.

    Attributes:
        n: number of states. matrix: the further rows and columns are those of open loops.

    Right sides may go on with those of the open loops' equations, which are zero otherwise; then the solution goes on
    with the changes of the loops' unknowns. So Newton's method can find states and unknowns together.
    """

    n: int
    matrix: SparseMatrix

    @classmethod
    def of(cls, n: int, size: int, rows: Integers, columns: Integers) -> SparseIterationMatrix:
        """With an order of elimination found here; the whole diagonal must be among the entries."""
        return cls(n, SparseMatrix(analyse_diagonal(rows, columns, size)))

    def factorize(
        self, entries: Float[Array, " n_entries"], c: Float[Array, ""] | float
    ) -> Float[Array, " n_entries"]:
        """See `DenseIterationMatrix`; the factorization is made when it is first needed."""
        pattern = self.matrix.pattern
        of_states = pattern.rows < self.n
        identity = (pattern.rows == pattern.columns) & of_states
        factors = jnp.where(of_states, c, -1.0).astype(entries.dtype)
        return jnp.asarray(identity, entries.dtype) - factors * entries

    def solve(
        self, kept: Float[Array, " n_entries"], b: Float[Array, " n"], *, transposed: bool = False
    ) -> Float[Array, " n"]:
        """See `DenseIterationMatrix`."""
        padded = jnp.pad(b, (0, len(self.matrix.pattern.row_order) - len(b)))
        return self.matrix.solve(kept, padded, transposed=transposed)[: len(b)]
