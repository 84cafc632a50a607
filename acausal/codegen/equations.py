"""Write a program down as sympy equations, for people to read.

Every derivative of a state is an expression of states, inputs and parameters. The unknowns of nonlinear loops cannot be
expressed so: they keep their names, and their equations follow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
import sympy as sp

from acausal.codegen.gather import Gather
from acausal.codegen.instructions import (
    Accumulate,
    Arguments,
    ArrayFormula,
    Place,
    SolveSparseLoop,
    SolveTornLoop,
    UnlikeFormulas,
)
from acausal.codegen.parameters import ParameterLayout
from acausal.codegen.program import DISCRETE, INPUTS, STATES, ZERO, Program
from acausal.flattening import Integers
from acausal.modeling import ModuleCall, primes, time as internal_time

MAX_LOOP, MAX_OPERATIONS = 6, 400
"""Linear loops of more unknowns, or whose solution takes more operations, are not solved symbolically."""

time = sp.Symbol("time")

SlotExpressions = dict[sp.Symbol, sp.Expr]


def explicit_equations(
    program: Program, parameters: ParameterLayout, name: Callable[[int], str]
) -> tuple[sp.Equality, ...]:
    """``der(state) = ...`` for every state, in order, then the equations of loops left implicit; nodes have names."""
    if program.state_rates is None:
        return ()
    writer = _Writer(program, parameters, name)
    states = [writer.symbol((STATES, i)) for i in range(program.sizes[STATES])]
    places = writer.places(program.state_rates, len(states))
    rates: list[Any] = [
        sp.Eq(sp.Derivative(state, time), int(sign) * writer.value(place), evaluate=False)
        for state, place, sign in zip(states, places, program.rate_signs, strict=True)
    ]
    return (*rates, *writer.implicit)


class _Writer:
    """Writes values as expressions, each once."""

    def __init__(
        self, program: Program, parameters: ParameterLayout, name: Callable[[int], str]
    ) -> None:
        self.program, self.parameters, self.name = program, parameters, name
        self.implicit: list[Any] = []
        self._values: dict[Place, sp.Expr] = {(ZERO, 0): sp.S.Zero}
        self._places: dict[tuple[int, int], list[Place]] = {}

    def symbol(self, place: Place) -> sp.Symbol:
        return sp.Symbol(self.name(int(self.program.nodes[place[0]][place[1]])))

    def value(self, place: Place) -> sp.Expr:
        """A value as an expression of states, inputs and parameters (without recursion: chains may be long)."""
        stack = [place]
        while stack:
            current = stack[-1]
            if current in self._values:
                stack.pop()
            elif current[0] in (STATES, INPUTS, DISCRETE):
                self._values[current] = self.symbol(current)
            else:
                i = self.program.filled_by[current[0]]
                instruction = self.program.instructions[i]
                needs, write = _RULES[type(instruction)]
                missing = [p for p in needs(self, instruction, current) if p not in self._values]
                if missing:
                    stack += missing
                else:
                    write(self, instruction, current)
        return self._values[place]

    # -- where arguments lie ---------------------------------------------------------------------------

    def places(self, gather: Gather, size: int, sizes: Sequence[int] = ()) -> list[Place]:
        """Where a gather reads, for each of ``size`` instances; looked up once for all of them.

        ``sizes`` are the lengths of the arrays that it reads, if not the program's.
        """
        key = id(gather), size  # the program keeps the gathers alive
        if key not in self._places:
            source, index = gather.positions(sizes or self.program.sizes)
            arrays, rows = (np.broadcast_to(side, size).tolist() for side in (source, index))
            self._places[key] = list(zip(arrays, rows, strict=True))
        return self._places[key]

    def _read(self, arguments: Arguments, size: int, row: int) -> list[Place]:
        return [self.places(g, size)[row] for _, g in arguments.variables]

    def _slots(self, arguments: Arguments, size: int, row: int) -> SlotExpressions:
        """What fills the slots of one instance."""
        names: SlotExpressions = {internal_time: time}
        for symbol, gather in arguments.variables:
            names[symbol] = self._values[self.places(gather, size)[row]]
        for symbol, gather in arguments.parameters:
            place = self.places(gather, size, (self.parameters.size,))[row]
            names[symbol] = self.parameters.symbol(place[1])
        for symbol, chosen in arguments.modules:
            one = chosen[row if len(chosen) == size else 0]
            names[symbol] = sp.Symbol(self.parameters.model.layout.module(one))
        return names

    # -- rules: what an instruction needs for one value, and how that value is written ------------------

    def formula_needs(self, one: ArrayFormula | UnlikeFormulas, place: Place) -> list[Place]:
        formula, row = one.at(place[1])
        return self._read(formula.arguments, formula.size, row)

    def formula(self, one: ArrayFormula | UnlikeFormulas, place: Place) -> None:
        formula, row = one.at(place[1])
        names = self._slots(formula.arguments, formula.size, row)
        self._values[place] = _readable(formula.expression.xreplace(names))

    def accumulate_needs(self, one: Accumulate, place: Place) -> list[Place]:
        return self.places(one.values, one.terms * one.size)[place[1] :: one.size]

    def accumulate(self, one: Accumulate, place: Place) -> None:
        weights = np.broadcast_to(one.weights, (one.terms, one.size))[:, place[1]].tolist()
        pairs = zip(weights, self.accumulate_needs(one, place), strict=True)
        self._values[place] = sp.Add(*(sp.nsimplify(w) * self._values[p] for w, p in pairs))

    def torn_loop_needs(self, loop: SolveTornLoop, place: Place) -> list[Place]:
        return self._read(loop.arguments, loop.size, place[1])

    def torn_loop(self, loop: SolveTornLoop, place: Place) -> None:
        array, row = place
        first = self.program.first[self.program.filled_by[array]]
        unknowns = [(first + i, row) for i in range(loop.outputs)]
        own = [self.symbol(p) for p in unknowns]
        _, *filled = self._slots(loop.arguments, loop.size, row).values()
        residuals = [_written(formula, [*own, *filled], filled) for formula in loop.equations]
        is_small = loop.is_linear and len(own) <= MAX_LOOP and _is_readable(residuals, own)
        solved = sp.solve(residuals, own, dict=True) if is_small else []
        if solved:
            self._values.update({p: solved[0][s] for p, s in zip(unknowns, own, strict=True)})
        else:
            self._values.update(dict(zip(unknowns, own, strict=True)))
            self.implicit += [sp.Eq(r, 0, evaluate=False) for r in residuals]

    def sparse_loop_needs(self, loop: SolveSparseLoop, place: Place) -> list[Place]:
        gathers = [(g, f.size) for f in loop.formulas for _, g in f.arguments.variables]
        gathers.append((loop.balances.outer, len(loop.balances.outer_rows)))
        return list(dict.fromkeys(p for g, size in gathers for p in self.places(g, size)))

    def sparse_loop(self, loop: SolveSparseLoop, place: Place) -> None:
        own = [self.symbol((place[0], i)) for i in range(loop.size)]
        self._values.update({(place[0], i): s for i, s in enumerate(own)})
        for formula in loop.formulas:
            for row in range(formula.size):
                names = self._slots(formula.arguments, formula.size, row)
                names |= {s: own[int(places[row])] for s, places in formula.inner}
                residual = _readable(formula.residual.xreplace(names))
                self.implicit.append(sp.Eq(residual, 0, evaluate=False))
        b = loop.balances
        outer = self.places(b.outer, len(b.outer_rows))
        terms: list[list[sp.Expr]] = [[] for _ in b.origins]
        _add(terms, b.rows, b.factors, (own[int(p)] for p in b.places))
        _add(terms, b.outer_rows, b.outer_factors, (self._values[p] for p in outer))
        self.implicit += [sp.Eq(sp.Add(*parts), 0, evaluate=False) for parts in terms]


_RULES: dict[type, tuple[Callable[..., list[Place]], Callable[..., None]]] = {
    ArrayFormula: (_Writer.formula_needs, _Writer.formula),
    UnlikeFormulas: (_Writer.formula_needs, _Writer.formula),
    Accumulate: (_Writer.accumulate_needs, _Writer.accumulate),
    SolveTornLoop: (_Writer.torn_loop_needs, _Writer.torn_loop),
    SolveSparseLoop: (_Writer.sparse_loop_needs, _Writer.sparse_loop),
}


def _add(
    terms: list[list[sp.Expr]], rows: Integers, factors: np.ndarray, values: Iterable[sp.Expr]
) -> None:
    for row, factor, value in zip(rows.tolist(), factors.tolist(), values, strict=True):
        terms[row].append(sp.nsimplify(factor) * value)


def _is_readable(residuals: list[sp.Expr], unknowns: list[sp.Symbol]) -> bool:
    """Whether the solution of linear equations can be read: elimination with names for coefficients shows its size."""
    names: dict[sp.Expr, sp.Symbol] = {}

    def named(value: sp.Expr) -> sp.Expr:
        return value if value.is_number else names.setdefault(value, sp.Dummy())

    try:
        matrix, right = (m.applyfunc(named) for m in sp.linear_eq_to_matrix(residuals, unknowns))
        values = {name: value for value, name in names.items()}
        found = matrix.LUsolve(right).xreplace(values)
    except ValueError:  # singular, or linear in each case alone: there is nothing to read
        return False
    return sum(e.count_ops() for e in found) <= MAX_OPERATIONS


def _written(
    formula: ArrayFormula, known: Sequence[sp.Expr], modules: Sequence[sp.Expr]
) -> sp.Expr:
    """A formula of a torn loop in the names of what it reads."""
    names: SlotExpressions = {internal_time: time}
    for symbol, gather in formula.arguments.variables:
        names[symbol] = known[gather.sources[0]]
    names |= {symbol: modules[m] for symbol, (m,) in formula.arguments.modules}
    return _readable(formula.expression.xreplace(names))


def _readable(expression: Any) -> Any:
    """Modules as ordinary functions named by their parameter."""
    calls = {c: _function(c) for c in expression.atoms(ModuleCall)}
    return expression.xreplace(calls) if calls else expression


def _function(call: Any) -> Any:
    module_name, orders, *args = call.args
    plain = sp.Function(f"{module_name}{primes(orders)}")
    return plain(*(_readable(a) for a in args))
