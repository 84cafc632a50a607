"""Solve sparse loops with JAX: residuals and Jacobian as array code, linear equations by a sparse factorization."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import sympy as sp
from jax import Array

from acausal.codegen.instructions import SolveSparseLoop, SparseFormula
from acausal.codegen.lower import evaluate
from acausal.codegen.newton import root
from acausal.codegen.reading import Arrays, fill, read_elements, taken
from acausal.codegen.sparse import SparseMatrix
from acausal.codegen.values import Values
from acausal.structure import Pattern


def solve_sparse_loop(loop: SolveSparseLoop, values: Values, arrays: Arrays) -> list[Array]:
    """The unknowns, as one array."""
    dtype = values.x.dtype
    guess, scale = jnp.asarray(loop.guess, dtype), jnp.asarray(loop.scale, dtype)
    if loop.is_linear:
        at_origin = _equations(replace(loop, formulas=loop.at_origin), values, arrays)
        origin = jnp.zeros_like(guess)
        return [at_origin.matrix.solve(at_origin.entries(origin), -at_origin.residual(origin))]
    return [_nonlinear(_equations(loop, values, arrays), guess, scale)]


def nearest_of_sparse_loop(
    loop: SolveSparseLoop, row: int, values: Values, arrays: Arrays
) -> tuple[Array, Array]:
    """Unknowns and residuals where the search for a solution stopped."""
    equations = _equations(loop, values, arrays)
    found = root(equations, jnp.asarray(loop.guess), jnp.asarray(loop.scale))[0]
    return found, equations.residual(found)


def matched_residuals_of_sparse_loop(
    loop: SolveSparseLoop, values: Values, arrays: Arrays, unknowns: list[Array]
) -> list[Array]:
    """For given unknowns the residuals of the equations matched to them, as one array each."""
    return [_equations(loop, values, arrays).residual(unknowns[0])[loop.matched]]


def _equations(loop: SolveSparseLoop, values: Values, arrays: Arrays) -> _Sparse:
    """The equations with all that is known filled in."""
    known = [fill(f.arguments, values.packed, arrays, values.t) for f in loop.formulas]
    b, n = loop.balances, len(loop.balances.origins)
    outer_values = jnp.broadcast_to(read_elements(b.outer, arrays), b.outer_rows.shape)
    inner, outer = (jnp.asarray(f, outer_values.dtype) for f in (b.factors, b.outer_factors))
    outside = jax.ops.segment_sum(outer_values * outer, b.outer_rows, n)

    def every(expressions: Callable[[SparseFormula], Sequence[sp.Expr]], z: Array) -> list[Array]:
        """Values of expressions of every formula, instance by instance."""
        return [
            jnp.broadcast_to(jnp.asarray(evaluate(e, filled), dtype=z.dtype), (f.size,))
            for f, own in zip(loop.formulas, known, strict=True)
            for filled in [own | {symbol: taken(z, places) for symbol, places in f.inner}]
            for e in expressions(f)
        ]

    def residual(z: Array) -> Array:
        inside = jax.ops.segment_sum(z[b.places] * inner, b.rows, n)
        return jnp.concatenate([*every(lambda f: (f.residual,), z), inside + outside])

    def entries(z: Array) -> Array:
        return jnp.concatenate([*every(lambda f: f.partials, z), inner])

    return _Sparse(_matrix(loop.pattern), residual, entries)


@lru_cache(maxsize=64)
def _matrix(pattern: Pattern) -> SparseMatrix:
    """The matrix of a pattern, which keeps its last factors: one for all programs that solve the loop."""
    return SparseMatrix(pattern)


@dataclass(frozen=True)
class _Jacobian:
    """The Jacobian of a sparse loop at one point: the entries of its matrix, and the unknowns."""

    matrix: SparseMatrix
    entries: Array
    z: Array

    def reach(self, sizes: Array) -> Array:
        """See `newton.Jacobian`."""
        return self.matrix.times(jnp.abs(self.entries), sizes)

    def step(self, r: Array, column: Array, row: Array) -> Array:
        """See `newton.Jacobian`; the last unknown is eliminated."""
        both = jax.vmap(self.matrix.solve, (None, 0))(self.entries, jnp.stack([r, column]))
        last = -(row[:-1] @ both[0]) / (row[-1] - row[:-1] @ both[1])
        return jnp.append(both[0] - both[1] * last, last)

    def computed(self, dz: Array) -> tuple[Array, Array]:
        """See `newton.Jacobian`: nothing but the unknowns."""
        return self.z, dz


@dataclass(frozen=True)
class _Sparse:
    """The equations of a sparse loop, for `newton.root`."""

    matrix: SparseMatrix
    residual: Callable[[Any], Any]
    entries: Callable[[Any], Any]

    def linearized(self, z: Array) -> tuple[Array, _Jacobian]:
        """The residuals and their Jacobian."""
        r, entries = jax.lax.optimization_barrier((self.residual(z), self.entries(z)))
        return r, _Jacobian(self.matrix, entries, z)


_Functions = tuple[Callable[[Array], Array], Callable[[Array], Array]]
"""Residuals and entries of the Jacobian, as pytrees of all values that they read."""


def _nonlinear(equations: _Sparse, guess: Array, scale: Array) -> Array:
    """A root near the guess, NaN if it is not reached; gradients by the implicit function theorem."""
    matrix = equations.matrix
    residual = eqx.filter_closure_convert(equations.residual, guess)
    entries = eqx.filter_closure_convert(equations.entries, guess)
    return _root((residual, entries), matrix, guess, scale)


@eqx.filter_custom_jvp
def _root(functions: _Functions, matrix: SparseMatrix, guess: Array, scale: Array) -> Array:
    """The root as a function of all that the equations read."""
    z, arrived = root(_Sparse(matrix, *functions), guess, scale)
    return jnp.where(arrived, z, jnp.nan)


@_root.def_jvp
def _(primals: Any, tangents: Any) -> tuple[Array, Array]:
    (residual, entries), matrix, _, _ = primals
    z = _root(*primals)
    change = eqx.filter_jvp(lambda function: function(z), (residual,), (tangents[0][0],))[1]
    return z, -matrix.solve(entries(z), change)
