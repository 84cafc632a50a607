"""Instructions: the parts of a program, each one operation over all instances of a formula.

They are data: the operation, and where its arguments lie. `acausal.codegen.interpreter` runs them with JAX,
`acausal.codegen.explicit_equations` writes them down with sympy.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import sympy as sp

from acausal.codegen.gather import Gather
from acausal.flattening import Integers, LeavesCaches, Origin
from acausal.modeling import as_written
from acausal.structure import Pattern

Place = tuple[int, int]
"""One of the arrays that an instruction fills, and the row in it."""


@dataclass(frozen=True)
class Arguments:
    """What fills the slots of a formula, by symbol: for one instance, or for each.

    Attributes:
        variables: where they lie in arrays. parameters: in `Packed.values`, source 0, and a zero, source 1.
        modules: those of `Packed`.
    """

    variables: tuple[tuple[sp.Symbol, Gather], ...] = ()
    parameters: tuple[tuple[sp.Symbol, Gather], ...] = ()
    modules: tuple[tuple[sp.Symbol, tuple[int, ...]], ...] = ()

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return {s for _, g in self.variables for s in g.sources}

    @property
    def symbols(self) -> set[sp.Symbol]:
        """The slots that are filled."""
        return {s for part in (self.variables, self.parameters, self.modules) for s, _ in part}


class ExplicitInstruction:
    """An instruction that solves nothing: it fills one array."""

    outputs = 1

    @property
    def text(self) -> str:
        """The right-hand side in words."""
        raise NotImplementedError

    def text_at(self, row: int) -> str:
        """That of a row."""
        return self.text

    def found_with(self, place: Place) -> list[Place]:
        """The values that are computed with this one: only itself."""
        return [place]


@dataclass(frozen=True)
class ArrayFormula(ExplicitInstruction):
    """One expression for ``size`` instances; as an instruction it fills an array with its values."""

    expression: sp.Expr
    arguments: Arguments
    size: int

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return self.arguments.sources

    @property
    def text(self) -> str:
        """The right-hand side in words."""
        return f" = {as_written(self.expression)}"

    def at(self, row: int) -> tuple[ArrayFormula, int]:
        """The formula that gives a row, and which of its instances that is."""
        return self, row


@dataclass(frozen=True)
class UnlikeFormulas(ExplicitInstruction, LeavesCaches):
    """Many formulas, whose values lie one behind the other in one array.

    Attributes:
        formulas: as they are written. None reads what another fills.
        operations: what computes them, each an array, which may read those before it.
        values: what of all these arrays are the formulas' values.
        constants: numbers in the formulas.
        first: how many arrays of the program the operations see; `Packed.values`, a zero, the time, and the constants
            follow.
    """

    formulas: tuple[ArrayFormula, ...]
    operations: tuple[ArrayFormula, ...]
    values: Gather
    constants: np.ndarray
    size: int
    first: int

    @property
    def text(self) -> str:
        """The right-hand side in words."""
        return ", unlike formulas,"

    @cached_property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return {s for f in self.formulas for s in f.sources}

    def at(self, row: int) -> tuple[ArrayFormula, int]:
        """The formula that gives a row, and which of its instances that is."""
        ends = np.cumsum([f.size for f in self.formulas])
        i = int(np.searchsorted(ends, row, side="right"))
        return self.formulas[i], row - int(ends[i]) + self.formulas[i].size

    def text_at(self, row: int) -> str:
        """The right-hand side of a row in words."""
        return self.at(row)[0].text


@dataclass(frozen=True)
class Accumulate(ExplicitInstruction):
    """Add up ``terms`` values each for ``size`` instances: ``sum(weights * value)``.

    Attributes:
        values: the terms, the first of all instances before the second of all.
        weights: (terms, size), or one number if they are all equal.
    """

    values: Gather
    weights: np.ndarray
    terms: int
    size: int

    @property
    def text(self) -> str:
        """The right-hand side in words."""
        return ", a sum,"

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return set(self.values.sources)


@dataclass(frozen=True)
class SolveTornLoop:
    """Solve ``size`` algebraic loops of one shape, linear or not.

    For given tearing variables the other unknowns follow one by one; the remaining equations give residuals.

    Attributes:
        equations: ``expression = 0`` of one loop, in order; ``residual_rows`` are those that give residuals. They read
            the unknowns, then the values of ``arguments`` in their order, among which their modules are counted.
        assigned: in order of computation, an unknown and the expression that gives it.
        tears: the tearing variables, as numbers of unknowns.
        matched: for every unknown an equation of its own that contains it.
        may_repeat_itself: whether equations of linear loops may come to depend on each other, as two frictions do that
            lock one motion. Then the least of the solutions is taken.
        arguments: what the loops read.
        guess, scale: start values and magnitudes of the tearing variables, (size, n_tears).
        guessed: for every tearing variable the states that are better guesses of it, if there are any.
        origins: where the equations that give residuals are stated, for each instance.
    """

    equations: tuple[ArrayFormula, ...]
    residual_rows: tuple[int, ...]
    assigned: tuple[tuple[int, ArrayFormula], ...]
    tears: tuple[int, ...]
    matched: tuple[int, ...]
    is_linear: bool
    may_repeat_itself: bool
    arguments: Arguments
    guess: np.ndarray
    guessed: tuple[Gather | None, ...]
    scale: np.ndarray
    size: int
    origins: tuple[tuple[Origin, ...], ...]

    @property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        return self.arguments.sources

    @property
    def outputs(self) -> int:
        """How many arrays are filled: one for every unknown."""
        return len(self.equations)

    @property
    def residuals(self) -> tuple[ArrayFormula, ...]:
        """The residuals for given tearing variables."""
        return tuple(self.equations[row] for row in self.residual_rows)

    def origins_of(self, place: Place) -> Sequence[Origin]:
        """Where the residuals of an unknown's loop are stated."""
        return self.origins[place[1]]

    def found_with(self, place: Place) -> list[Place]:
        """The values that are computed with this one: all unknowns of its loop."""
        return [(array, place[1]) for array in range(self.outputs)]


@dataclass(frozen=True)
class SparseFormula:
    """An equation ``residual = 0`` of ``size`` instances in a sparse loop, and its partial derivatives.

    Attributes:
        partials: by the unknowns, which fill the slots ``inner`` from their places.
        arguments: what fills the other slots.
    """

    residual: sp.Expr
    partials: tuple[sp.Expr, ...]
    arguments: Arguments
    inner: tuple[tuple[sp.Symbol, Integers], ...]
    size: int
    origins: tuple[Origin, ...]


@dataclass(frozen=True)
class Balances:
    """Equations ``sum(factors * unknowns[places]) + sum(outer_factors * outer) = 0`` by row, from ``origins``."""

    rows: Integers
    places: Integers
    factors: np.ndarray
    outer_rows: Integers
    outer: Gather
    outer_factors: np.ndarray
    origins: tuple[Origin, ...]


@dataclass(frozen=True)
class SolveSparseLoop(LeavesCaches):
    """Solve a large algebraic loop by Newton's method, or directly if it is linear.

    Attributes:
        formulas: equations in order of rows, then the ``balances``.
        pattern: where the Jacobian's entries are, in the same order.
        matched: for every unknown the equation that it is matched to.
        guess, scale: start values and magnitudes of the unknowns, shape (size,).
    """

    formulas: tuple[SparseFormula, ...]
    balances: Balances
    pattern: Pattern
    matched: Integers
    is_linear: bool
    guess: np.ndarray
    scale: np.ndarray

    outputs = 1

    @cached_property
    def at_origin(self) -> tuple[SparseFormula, ...]:
        """The formulas where all unknowns are zero."""

        def one(f: SparseFormula) -> SparseFormula:
            zero = {symbol: sp.S.Zero for symbol, _ in f.inner}
            found = [e.xreplace(zero) for e in (f.residual, *f.partials)]
            return replace(f, residual=found[0], partials=tuple(found[1:]), inner=())

        return tuple(map(one, self.formulas))

    @property
    def size(self) -> int:
        """The number of unknowns."""
        return len(self.guess)

    @cached_property
    def sources(self) -> set[int]:
        """The arrays that are read."""
        own = {s for f in self.formulas for s in f.arguments.sources}
        return own | set(self.balances.outer.sources)

    def origins_of(self, place: Place) -> Sequence[Origin]:
        """Where the equations are stated that an unknown is solved from: all of them."""
        return [*(origin for f in self.formulas for origin in f.origins), *self.balances.origins]

    def found_with(self, place: Place) -> list[Place]:
        """The values that are computed with this one: all unknowns."""
        return [(place[0], i) for i in range(self.size)]


Instruction = ArrayFormula | UnlikeFormulas | Accumulate | SolveTornLoop | SolveSparseLoop
