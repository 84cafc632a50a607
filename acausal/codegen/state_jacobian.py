"""The Jacobian ``J = d(dx/dt)/dx`` of a model, with a pattern that is known from its structure.

Where large algebraic loops make every state depend on every other, ``J`` is full, and yet ``(I - c J) x = b`` is a
sparse system in ``x`` and the change ``z`` of the loops' unknowns:

    (I - c f_x) x - c f_z z = b,    g_x x + g_z z = 0

with the derivatives ``f`` of the states for given unknowns, and the residuals ``g`` of the loops' equations. The loops
are then called open, and the entries are those of ``f_x, f_z, g_x, g_z``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal.codegen.colored_pattern import ColoredPattern
from acausal.codegen.interpreter import rates, rates_and_residuals, results
from acausal.codegen.iteration_matrix import (
    DenseIterationMatrix,
    SparseIterationMatrix,
)
from acausal.codegen.program import Program
from acausal.codegen.values import Packed, Values
from acausal.flattening import Integers, LeavesCaches
from acausal.structure import ReducedModel, SparseLoop, TornLoop, jacobian_pattern


@dataclass(frozen=True, eq=False)
class Field:
    """``dx/dt`` as a function of ``x``, at a time and for inputs and parameters.

    Attributes:
        t: time [s]. u: inputs, shape (n_inputs,). packed: parameters.
        d: discrete variables, shape (n_discrete,), or None.
    """

    program: Program
    t: ArrayLike
    u: Array
    packed: Packed
    d: Array | None = None

    def __call__(self, x: Float[Array, " n"]) -> Float[Array, " n"]:
        """Derivatives of the states."""
        return rates(self.program, self.values(x))

    def loop_unknowns(self, loops: Sequence[int], x: Float[Array, " n"]) -> Float[Array, " m"]:
        """The unknowns of some loops, by their instructions' numbers, at the solution: one behind the other."""
        return jnp.concatenate(
            [jnp.atleast_1d(a) for a in results(self.program, self.values(x), loops)]
        )

    def with_open_loops(
        self, loops: Sequence[int], x: Float[Array, " n"], unknowns: Float[Array, " m"]
    ) -> Float[Array, " n_plus_m"]:
        """Derivatives of the states for given unknowns of some loops, and the residuals of the loops' equations.

        The residuals are in the order of the unknowns that they are matched to.
        """
        given: dict[int, list[Array]] = {}
        for i in loops:
            outputs, size = (getattr(self.program.instructions[i], a) for a in ("outputs", "size"))
            own, unknowns = unknowns[: outputs * size], unknowns[outputs * size :]
            given[i] = list(own.reshape((outputs, size) if size > 1 else (outputs,)))
        dx, residuals = rates_and_residuals(self.program, self.values(x), given)
        return jnp.concatenate([dx, *map(jnp.atleast_1d, residuals)])

    def values(self, x: Float[Array, " n"]) -> Values:
        """The values at some states."""
        return Values(self.t, x, self.u, self.packed, self.d)


FEW = 32
"""Up to so many states a Jacobian is dense: one product with a matrix of directions finds all columns."""

DENSE = 0.2
"""The share of entries from which on a Jacobian is dense."""

LISTED = 1_000_000, 10_000_000
"""How many dependences are listed at least and at most, before a Jacobian is taken for dense: up to about a second."""

SMALL = 100
"""Up to so many states LAPACK is faster than a sparse factorization on the host."""


WIDE = 32
"""Torn loops of more unknowns may be opened."""


@dataclass(frozen=True, eq=False)
class StateJacobian(LeavesCaches):
    """Positions of the entries of ``d(dx/dt)/dx``, and how to compute them.

    Attributes:
        n: number of states.
        pattern: positions of the entries, the whole diagonal of the states among them; None if all n * n entries are
            present, row by row. Open loops have rows and columns behind those of the states.
        open_loops: numbers of the instructions that solve open loops.
    """

    n: int
    pattern: ColoredPattern | None
    open_loops: tuple[int, ...] = ()

    @classmethod
    def of(cls, reduced: ReducedModel, program: Program) -> StateJacobian:
        """The pattern of a model's Jacobian, with a colouring of its columns; with open loops if that saves entries."""
        n = len(reduced.states)
        if n <= FEW:
            return cls(n, None)
        most = int(np.clip(2 * DENSE * n**2, *LISTED))
        needed = set(program.needed(program.rate_sources) if n > SMALL else ())
        number = [
            program.filled_by[int(program.positions[0][s.results[0][0]])] for s in reduced.steps
        ]
        loops = tuple(i for i, s in enumerate(reduced.steps) if number[i] in needed and _is_wide(s))
        ways = ((), loops) if loops else ((),)
        choices = [
            (jacobian_pattern(reduced, most, opened), tuple(number[i] for i in opened))
            for opened in ways
        ]
        listed = [(*pattern, opened) for pattern, opened in choices if pattern is not None]
        if not listed:
            return cls(n, None)
        size, rows, columns, opened = min(listed, key=lambda choice: len(choice[1]))
        if len(rows) > DENSE * n**2:
            return cls(n, None)
        return cls(n, ColoredPattern.of(size, *_with_diagonal(rows, columns, n, size)), opened)

    @property
    def n_entries(self) -> int:
        """How many entries there are."""
        return self.n**2 if self.pattern is None else len(self.pattern.rows)

    @property
    def rows(self) -> Integers:
        """The row of every entry."""
        return np.repeat(np.arange(self.n), self.n) if self.pattern is None else self.pattern.rows

    @property
    def columns(self) -> Integers:
        """The column of every entry."""
        return np.tile(np.arange(self.n), self.n) if self.pattern is None else self.pattern.columns

    @property
    def n_colors(self) -> int:
        """How many products with a vector give all entries but those of long rows."""
        return self.n if self.pattern is None else self.pattern.n_colors

    def entries(
        self,
        field: Callable[[Float[Array, " n"]], Float[Array, " n"]],
        x: Float[Array, " n"],
        unknowns: Float[Array, " m"] | None = None,
    ) -> Float[Array, " n_entries"]:
        """The entries of the Jacobian of ``field`` at ``x``.

        Arguments:
            field: derivatives of the states as a function of the states, with this pattern; a `Field` if there are
                open loops.
            x: states.
            unknowns: those of the open loops, if they are known or the loops need not be solved exactly.
        """
        if self.n <= FEW:
            return jax.jacfwd(field)(x).ravel()
        if self.pattern is None:
            push = jax.linearize(field, x)[1]
            columns = jax.lax.map(push, jnp.eye(self.n, dtype=x.dtype), batch_size=FEW)
            return columns.T.ravel()
        if not self.open_loops:
            return self.pattern.entries(field, x)
        if not isinstance(field, Field):
            raise TypeError("a Jacobian with open loops needs a Field, from System.field.")

        def opened(both: Array) -> Array:
            return field.with_open_loops(self.open_loops, both[: self.n], both[self.n :])

        if unknowns is None:
            unknowns = field.loop_unknowns(self.open_loops, x)
        return self.pattern.entries(opened, jnp.concatenate([x, unknowns]))

    def factorized(
        self,
        field: Callable[[Float[Array, " n"]], Float[Array, " n"]],
        x: Float[Array, " n"],
        c: Float[Array, ""],
    ) -> Any:
        """The factors of ``I - c J`` at a point, to solve with by `iteration_matrix`; arguments as for `entries`."""
        return self.iteration_matrix.factorize(self.entries(field, x), c)

    @cached_property
    def iteration_matrix(self) -> DenseIterationMatrix | SparseIterationMatrix:
        """How to solve equations with ``I - c J``: with LAPACK for few states or a full matrix, else with SuperLU."""
        if self.pattern is None:
            return DenseIterationMatrix(self.n, None)
        positions = self.pattern.rows, self.pattern.columns
        if self.n <= SMALL and not self.open_loops:
            return DenseIterationMatrix(self.n, positions)
        return SparseIterationMatrix.of(self.n, self.pattern.size, *positions)


def _is_wide(step: object) -> bool:
    """Whether a step is an algebraic loop that may join many states."""
    if isinstance(step, TornLoop):
        return step.shape.n_unknowns > WIDE
    return isinstance(step, SparseLoop)


def _with_diagonal(
    rows: Integers, columns: Integers, n: int, size: int
) -> tuple[Integers, Integers]:
    """Positions row by row, the first n of the diagonal among them."""
    places = np.union1d(rows * size + columns, np.arange(n) * (size + 1))
    return places // size, places % size
