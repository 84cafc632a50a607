"""Factors of small covariances, written out column by column in array operations.

For a dozen numbers a call of LAPACK costs more than the arithmetic, and keeps XLA from compiling the loop around it as
a whole (`acausal._jax.xla`).
"""

from __future__ import annotations

import jax.numpy as jnp
from jax.scipy.linalg import solve_triangular
from jaxtyping import Array, Float

FEW = 12
"""The most rows that are written out; more take XLA too long to compile."""


def cholesky(a: Float[Array, "n n"]) -> Float[Array, "n n"]:
    """The lower triangular L with ``L L' = a``; not finite where ``a`` is not positive."""
    n = len(a)
    if n > FEW:
        return jnp.linalg.cholesky(a)
    columns: list[Array] = []
    for j in range(n):
        column = a[:, 0] / jnp.sqrt(a[0, 0])
        columns.append(jnp.pad(column, (j, 0)))
        a = a[1:, 1:] - column[1:, None] * column[1:]
    return jnp.stack(columns, axis=1)


def solve_lower(root: Float[Array, "n n"], b: Float[Array, "n k"]) -> Float[Array, "n k"]:
    """``L^-1 b``."""
    if len(root) > FEW:
        return solve_triangular(root, b, lower=True)
    rows: list[Array] = []
    for j in range(len(root)):
        rows.append(b[0] / root[j, j])
        b = b[1:] - root[j + 1 :, j, None] * rows[-1]
    return jnp.stack(rows)


def solve_upper(root: Float[Array, "n n"], b: Float[Array, "n k"]) -> Float[Array, "n k"]:
    """``L'^-1 b``, with the lower factor."""
    return solve_lower(root.T[::-1, ::-1], b[::-1])[::-1]
