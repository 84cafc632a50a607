"""Solve a few linear equations by Gaussian elimination, written out pivot by pivot in array operations.

For a dozen unknowns a call of LAPACK costs more than the arithmetic. It also keeps XLA from compiling the loop around
it as a whole (`acausal._jax.xla`), which costs ten times as much again.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import jax
import jax.numpy as jnp
from jax.custom_derivatives import SymbolicZero
from jaxtyping import Array, Bool, Float

VOID = 500.0
"""Equations that are left with entries below this many roundings, of entries up to 1, follow from the others."""


class Pivot(NamedTuple):
    """One step of the elimination, of the k > 1 unknowns that are left.

    Attributes:
        chosen: which of the k rows is the pivot's, the one with the largest entry in the first column; the first row
            takes its place.
        row: that row, the pivot first. ``factors``: multiples of it that are subtracted from the k - 1 other rows.
        column: which of the k columns has changed places with the first one; None where it stays the first.
    """

    chosen: Bool[Array, " k"]
    row: Float[Array, " k"]
    factors: Float[Array, " k-1"]
    column: Bool[Array, " k"] | None


@partial(jax.custom_jvp, nondiff_argnums=(2,))
def eliminate(
    a: Float[Array, "n n"], b: Float[Array, " n"], may_be_singular: bool = False
) -> Float[Array, " n"]:
    """``a^-1 b``, with partial pivoting; not finite where ``a`` is singular.

    Its derivatives are solutions with the same matrix, or its transpose; XLA computes the pivots they share once.

    Arguments:
        may_be_singular: its equations may depend on each other. Then the result is the least of their solutions; where
            they contradict each other, it is none.
    """
    a, b = _computed_once(a), _computed_once(b)
    if not may_be_singular:
        return _computed_once(_apply(*_factorize(a, 0.0), b))
    rows = _magnitude(a, 1)
    a, b = a / rows[:, None], b / rows
    columns = _magnitude(a, 0)
    pivots, last = _factorize(a / columns, _void(a))
    found = _apply(pivots, last, b) / columns
    repeats = jnp.any(jnp.isinf(jnp.stack([last[0, 0], *(p.row[0] for p in pivots)])))
    return _computed_once(jnp.where(repeats, _least(a, b), found))


def _derivative(
    may_be_singular: bool,
    primals: tuple[Array, Array],
    tangents: tuple[Array | SymbolicZero, Array | SymbolicZero],
) -> tuple[Array, Array]:
    a, b = primals
    x = eliminate(a, b, may_be_singular)
    change = jnp.zeros_like(b)
    if not isinstance(tangents[1], SymbolicZero):
        change += tangents[1]
    if not isinstance(tangents[0], SymbolicZero):
        change -= tangents[0] @ x
    return x, eliminate(a, change, may_be_singular)


eliminate.defjvp(_derivative, symbolic_zeros=True)


def _least(a: Float[Array, "n n"], b: Float[Array, " n"]) -> Float[Array, " n"]:
    """The least solution of equations that do not contradict each other: it is orthogonal to what they leave open."""
    factors = _factorize(a @ a.T, _void(a))
    found = a.T @ _apply(*factors, b)
    return found + a.T @ _apply(*factors, b - a @ found)  # products have less digits


def _magnitude(a: Float[Array, "n n"], axis: int) -> Float[Array, " n"]:
    """The largest entry of each row or column, or 1 where all are zero."""
    largest = jnp.max(jnp.abs(a), axis)
    return jnp.where(largest > 0, largest, 1.0)


def _factorize(a: Float[Array, "n n"], void: float) -> tuple[list[Pivot], Float[Array, "1 1"]]:
    """The steps of the elimination, and the last entry that is left.

    Pivots up to ``void`` are infinite: what they are divided into is zero. With any such bound columns are chosen, too.
    """
    pivots: list[Pivot] = []
    while len(a) > 1:
        column = None
        if void:
            largest = jnp.max(jnp.abs(a), 0)
            column = jnp.arange(len(a)) == jnp.argmax(largest)
            a = _swapped(column, a.T).T
        chosen = jnp.arange(len(a)) == jnp.argmax(jnp.abs(a[:, 0]))
        row = _chosen(chosen, a)
        rest = _others(chosen, a)
        if void:
            row = jnp.concatenate([_unless_void(row[:1], void), row[1:]])
        factors = rest[:, 0] / row[0]
        pivots.append(Pivot(chosen, row, factors, column))
        a = rest[:, 1:] - factors[:, None] * row[1:]
    return pivots, _unless_void(a, void) if void else a


def _void(a: Array) -> float:
    return VOID * float(jnp.finfo(a.dtype).eps)


def _unless_void(pivot: Array, void: float) -> Array:
    return jnp.where(jnp.abs(pivot) > void, pivot, jnp.inf)


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
        if p.column is not None:
            x = _swapped(p.column, x)
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


def _swapped(chosen: Bool[Array, " k"], rows: Array) -> Array:
    """The rows, of which the chosen one and the first have changed places."""
    return jnp.concatenate([_chosen(chosen, rows)[None], _others(chosen, rows)])


def _over(chosen: Array, rows: Array) -> Array:
    return chosen.reshape(-1, *(1,) * (rows.ndim - 1))
