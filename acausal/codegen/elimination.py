"""Solve a few linear equations by Gaussian elimination, written out pivot by pivot in array operations.

For a dozen unknowns a call of LAPACK costs more than the arithmetic. It also keeps XLA from compiling the loop around
it as a whole (`acausal._jax.xla`), which costs ten times as much again.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import jax
import jax.numpy as jnp
from jax.custom_derivatives import SymbolicZero
from jaxtyping import Array, Bool, Float


class Pivot(NamedTuple):
    """One step of the elimination, of the k > 1 unknowns that are left.

    Attributes:
        chosen: which of the k rows is the pivot's, the one with the largest entry in the first column; the first row
            takes its place.
        row: that row, the pivot first. ``factors``: multiples of it that are subtracted from the k - 1 other rows.
    """

    chosen: Bool[Array, " k"]
    row: Float[Array, " k"]
    factors: Float[Array, " k-1"]


@jax.custom_jvp
def eliminate(a: Float[Array, "n n"], b: Float[Array, " n"]) -> Float[Array, " n"]:
    """``a^-1 b``, with partial pivoting; not finite where ``a`` is singular.

    Its derivatives are solutions with the same matrix, or its transpose; XLA computes the pivots they share once.
    """
    return _computed_once(_apply(*_factorize(_computed_once(a)), _computed_once(b)))


def _derivative(
    primals: tuple[Array, Array], tangents: tuple[Array | SymbolicZero, Array | SymbolicZero]
) -> tuple[Array, Array]:
    a, b = primals
    x = eliminate(a, b)
    change = jnp.zeros_like(b)
    if not isinstance(tangents[1], SymbolicZero):
        change += tangents[1]
    if not isinstance(tangents[0], SymbolicZero):
        change -= tangents[0] @ x
    return x, eliminate(a, change)


eliminate.defjvp(_derivative, symbolic_zeros=True)


def _factorize(a: Float[Array, "n n"]) -> tuple[list[Pivot], Float[Array, "1 1"]]:
    """The steps of the elimination, and the last entry that is left."""
    pivots: list[Pivot] = []
    while len(a) > 1:
        chosen = jnp.arange(len(a)) == jnp.argmax(jnp.abs(a[:, 0]))
        row = _chosen(chosen, a)
        rest = _others(chosen, a)
        factors = rest[:, 0] / row[0]
        pivots.append(Pivot(chosen, row, factors))
        a = rest[:, 1:] - factors[:, None] * row[1:]
    return pivots, a


def _apply(
    pivots: Sequence[Pivot], last: Float[Array, "1 1"], b: Float[Array, " n"]
) -> Float[Array, " n"]:
    """The solution for a right side; a linear function of it."""
    right: list[Array] = []
    for p in pivots:
        right.append(_chosen(p.chosen, b))
        b = _others(p.chosen, b) - p.factors * right[-1]
    x = b / last[0]
    for p, value in zip(reversed(pivots), reversed(right), strict=True):
        rest = value - jnp.sum(p.row[1:] * x)
        x = jnp.concatenate([(rest / p.row[0])[None], x])
    return x


def _computed_once(values: Array) -> Array:
    """The values: XLA would compute them again at every use, where that looks cheap."""
    return jax.lax.optimization_barrier(values)


def _chosen(chosen: Bool[Array, " k"], rows: Array) -> Array:
    """The chosen row, by a sum: reading at a computed place is slow side by side with others."""
    return jnp.sum(jnp.where(_over(chosen, rows), rows, 0.0), axis=0)


def _others(chosen: Bool[Array, " k"], rows: Array) -> Array:
    """The other rows; the first is in the place of the chosen one."""
    return jnp.where(_over(chosen[1:], rows), rows[:1], rows[1:])


def _over(chosen: Array, rows: Array) -> Array:
    return chosen.reshape(-1, *(1,) * (rows.ndim - 1))
