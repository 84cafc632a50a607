"""Solve meshes: residuals and slopes as array code, the linear equations by a sparse factorization."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp

from acausal.codegen.gather import Gather
from acausal.codegen.instructions import STATE, Arguments
from acausal.codegen.lower import evaluate
from acausal.codegen.newton import root
from acausal.codegen.parameters import Packed
from acausal.codegen.sparse import SparseMatrix
from acausal.flattening import Integers, Template


@dataclass(frozen=True)
class Formula:
    """An equation of ``size`` instances, and its slopes by the unknowns.

    Attributes:
        arguments: what fills the other slots; ``inner``: where the unknowns stand that fill these.
    """

    template: Template
    slopes: tuple[sp.Expr, ...]
    arguments: Arguments
    inner: tuple[tuple[sp.Symbol, Integers], ...]
    size: int


@dataclass(frozen=True)
class Balances:
    """Equations ``sum(factors * unknowns[places]) + sum(outer_factors * outer) = 0`` by row, from ``origins``."""

    rows: Integers
    places: Integers
    factors: np.ndarray
    outer_rows: Integers
    outer: Gather
    outer_factors: np.ndarray
    origins: tuple[str, ...]


@dataclass(frozen=True)
class SolveMesh:
    """Solve a mesh; ``guess`` is where Newton's method starts if it is not linear."""

    formulas: tuple[Formula, ...]
    balances: Balances
    matrix: SparseMatrix
    is_linear: bool
    guess: np.ndarray
    scale: np.ndarray

    outputs = 1

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        own = {s for f in self.formulas for s in f.arguments.sources}
        return own | set(self.balances.outer.sources)

    @property
    def origins(self) -> list[str]:
        """The equations as they were written, row by row."""
        own = [origin for f in self.formulas for origin in [f.template.origin] * f.size]
        return [*own, *self.balances.origins]

    def run(self, t: Any, arrays: Sequence[Any], packed: Packed) -> list[Any]:
        """The unknowns, as one array."""
        solve = _linear if self.is_linear else _nonlinear
        dtype = arrays[STATE].dtype
        guess, scale = jnp.asarray(self.guess, dtype), jnp.asarray(self.scale, dtype)
        return [solve(self._equations(t, arrays, packed), guess, scale)]

    def nearest(self, t: Any, arrays: Sequence[Any], packed: Packed) -> tuple[Any, Any]:
        """Unknowns and residuals where the solution stopped."""
        equations = self._equations(t, arrays, packed)
        found = root(equations, jnp.asarray(self.guess), jnp.asarray(self.scale))[0]
        return found, equations.residual(found)

    def _equations(self, t: Any, arrays: Sequence[Any], packed: Packed) -> _Sparse:
        """The equations with all that is known filled in."""
        known = [f.arguments.read(t, arrays, packed) for f in self.formulas]
        b, n = self.balances, len(self.balances.origins)
        read = jnp.broadcast_to(b.outer.read(arrays), b.outer_rows.shape)
        inner, outer = (jnp.asarray(f, read.dtype) for f in (b.factors, b.outer_factors))
        outside = jax.ops.segment_sum(read * outer, b.outer_rows, n)

        def every(expressions: Callable[[Formula], Sequence[sp.Expr]], z: Any) -> list[Any]:
            """Values of expressions of every formula, instance by instance."""
            return [
                jnp.broadcast_to(jnp.asarray(evaluate(e, values), dtype=z.dtype), (f.size,))
                for f, own in zip(self.formulas, known, strict=True)
                for values in [own | {symbol: z[places] for symbol, places in f.inner}]
                for e in expressions(f)
            ]

        def residual(z: Any) -> Any:
            inside = jax.ops.segment_sum(z[b.places] * inner, b.rows, n)
            return jnp.concatenate([*every(lambda f: (f.template.residual,), z), inside + outside])

        def slopes(z: Any) -> Any:
            return jnp.concatenate([*every(lambda f: f.slopes, z), inner])

        return _Sparse(self.matrix, residual, slopes)


@dataclass(frozen=True)
class _Slopes:
    """The slopes of a mesh at one point: the entries of its matrix."""

    matrix: SparseMatrix
    entries: Any

    def reach(self, sizes: Any) -> Any:
        """See `acausal.codegen.newton.Slopes`."""
        return self.matrix.times(jnp.abs(self.entries), sizes)

    def step(self, r: Any, column: Any, row: Any) -> Any:
        """See `acausal.codegen.newton.Slopes`; the last unknown is eliminated."""
        both = jax.vmap(self.matrix.solve, (None, 0))(self.entries, jnp.stack([r, column]))
        last = -(row[:-1] @ both[0]) / (row[-1] - row[:-1] @ both[1])
        return jnp.append(both[0] - both[1] * last, last)


@dataclass(frozen=True)
class _Sparse:
    """The equations of a mesh, for `acausal.codegen.newton.root`."""

    matrix: SparseMatrix
    residual: Callable[[Any], Any]
    slopes: Callable[[Any], Any]

    def linearized(self, z: Any) -> tuple[Any, _Slopes]:
        """The residuals and their slopes."""
        r, entries = jax.lax.optimization_barrier((self.residual(z), self.slopes(z)))
        return r, _Slopes(self.matrix, entries)


def _linear(equations: _Sparse, guess: Any, scale: Any) -> Any:
    del scale
    origin = jnp.zeros_like(guess)
    return equations.matrix.solve(equations.slopes(origin), -equations.residual(origin))


def _nonlinear(equations: _Sparse, guess: Any, scale: Any) -> Any:
    """A root near the guess, NaN if it is not reached; gradients by the implicit function theorem."""
    matrix = equations.matrix
    residual, read = jax.closure_convert(equations.residual, guess)
    slopes, also_read = jax.closure_convert(equations.slopes, guess)

    @jax.custom_jvp
    def solved(read: Any, also_read: Any) -> Any:
        filled = _Sparse(matrix, lambda z: residual(z, *read), lambda z: slopes(z, *also_read))
        z, arrived = root(filled, guess, scale)
        return jnp.where(arrived, z, jnp.nan)

    @solved.defjvp
    def _(known: Any, tangents: Any) -> tuple[Any, Any]:
        z = solved(*known)
        change = jax.jvp(lambda read: residual(z, *read), known[:1], tangents[:1])[1]
        return z, -matrix.solve(slopes(z, *known[1]), change)

    return solved(read, also_read)
