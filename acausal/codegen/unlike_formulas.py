"""Many unlike formulas as few array operations: each kind of operation once for all of them, level by level.

XLA compiles unlike formulas one by one, in a time that grows faster than their number. Here all products whose factors
are known are one operation, then the sines of these, and so on: there are as many operations as kinds and levels. They
read what they need by index.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

import numpy as np
import sympy as sp
from sympy.logic.boolalg import Boolean

from acausal.codegen.gather import Gather, Positions, gather
from acausal.codegen.instructions import Arguments, ArrayFormula, UnlikeFormulas
from acausal.modeling import Prescribed, time

WHOLE = (sp.Piecewise, sp.ITE, Boolean, Prescribed)
"""Expressions that are one operation, of all symbols in them."""

X, Y = sp.symbols("x y", real=True)
ADD, SUBTRACT, NEGATE = (X + Y, (X, Y)), (X - Y, (X, Y)), (-X, (X,))
MULTIPLY, DIVIDE, INVERT = (X * Y, (X, Y)), (X / Y, (X, Y)), (1 / X, (X,))

Kind = tuple[sp.Expr, tuple[sp.Symbol, ...]]
"""A kind of operations: an expression, and its operands."""


FEW_INSTANCES, MANY_FORMULAS = 8, 64
"""So many formulas, of so few instances each, are computed together."""


def joinable(formula: ArrayFormula) -> bool:
    """Whether a formula may be one of many: it has few instances, and reads nothing but numbers."""
    own = {*(s for s, _ in (*formula.arguments.variables, *formula.arguments.parameters)), time}
    return formula.size <= FEW_INSTANCES and formula.expression.free_symbols <= own


def join_formulas(
    formulas: Sequence[ArrayFormula], sizes: Sequence[int], n_parameters: int
) -> list[ArrayFormula | UnlikeFormulas]:
    """The formulas in order; where many may be computed together, they are."""
    found: list[ArrayFormula | UnlikeFormulas] = []
    for may, run in groupby(formulas, joinable):
        some = list(run)
        is_one = may and len(some) >= MANY_FORMULAS
        found += [together(some, sizes, n_parameters)] if is_one else some
    return found


def together(
    formulas: Sequence[ArrayFormula], sizes: Sequence[int], n_parameters: int
) -> UnlikeFormulas:
    """The formulas, which are `joinable`, as one instruction, whose results lie one behind the other.

    None of them reads another's result. ``sizes`` are the lengths of the arrays before them.
    """
    levels = _Levels(sizes, n_parameters)
    values = [levels.value(formula) for formula in formulas]
    return UnlikeFormulas(
        tuple(formulas),
        levels.operations(),
        levels.gathered(values),
        np.asarray(list(levels.constants)),
        sum(formula.size for formula in formulas),
        len(sizes),
    )


@dataclass
class _Group:
    """Operations of one kind at one level, and the operands of each; ``array`` is what they fill."""

    kind: Kind
    members: list[tuple[_Value, ...]] = field(default_factory=list["tuple[_Value, ...]"])
    size: int = 0
    array: int = -1


@dataclass(frozen=True)
class _Value:
    """Where the instances of an expression lie: in arrays that are there, or in a group, from a place on."""

    size: int
    level: int = 0
    there: Positions | None = None
    group: _Group | None = None
    start: int = 0

    def positions(self) -> Positions:
        """For every instance the array and the place in it."""
        if self.group is None:
            assert self.there is not None
            return self.there
        return np.full(self.size, self.group.array), self.start + np.arange(self.size)


class _Levels:
    """Takes formulas apart, and groups equal operations of one level."""

    def __init__(self, sizes: Sequence[int], n_parameters: int) -> None:
        self.parameters, self.time, self.own = len(sizes), len(sizes) + 2, len(sizes) + 3
        self.sizes = [*sizes, n_parameters, 1, 1]
        self.constants: dict[float, int] = {}
        self.groups: dict[tuple[int, Kind], _Group] = {}

    def value(self, formula: ArrayFormula) -> _Value:
        """The value of a formula."""
        n = formula.size
        known: dict[sp.Basic, _Value] = {}

        def there(source: np.ndarray | int, index: np.ndarray | int) -> _Value:
            return _Value(n, there=(np.broadcast_to(source, n), np.broadcast_to(index, n)))

        for symbol, own in formula.arguments.variables:
            known[symbol] = there(*own.positions(self.sizes))
        for symbol, own in formula.arguments.parameters:
            source, index = own.positions((self.sizes[self.parameters], 1))
            known[symbol] = there(self.parameters + source, index)
        known[time] = there(self.time, 0)

        def visit(node: Any) -> _Value:
            if node not in known:
                known[node] = found(node)
            return known[node]

        def found(node: Any) -> _Value:
            if not node.free_symbols and not isinstance(node, Boolean):
                place = self.constants.setdefault(float(node), len(self.constants))
                return there(self.own, place)
            if isinstance(node, sp.Add):
                negative = [a.could_extract_minus_sign() for a in node.args]
                pairs = list(zip(node.args, negative, strict=True))
                return joined(
                    [visit(a) for a, is_negative in pairs if not is_negative],
                    [visit(-a) for a, is_negative in pairs if is_negative],
                    (ADD, SUBTRACT, NEGATE),
                )
            if isinstance(node, sp.Mul):
                return product(node)
            kind, operands = _taken_apart(node)
            return self._operation(kind, *map(visit, operands))

        def product(node: Any) -> _Value:
            above = [a for a in node.args if not _is_divisor(a) and a is not sp.S.NegativeOne]
            below = [sp.Pow(a.base, -a.exp) for a in node.args if _is_divisor(a)]
            kinds = MULTIPLY, DIVIDE, INVERT
            whole = joined([visit(a) for a in above], [visit(b) for b in below], kinds)
            return self._operation(NEGATE, whole) if sp.S.NegativeOne in node.args else whole

        def joined(
            one: list[_Value], other: list[_Value], kinds: tuple[Kind, Kind, Kind]
        ) -> _Value:
            """All of one side joined, then with those of the other the opposite way."""
            join, part, turn = kinds
            sides = [self._balanced(join, side) for side in (one, other) if side]
            if one and other:
                return self._operation(part, *sides)
            return sides[0] if one else self._operation(turn, *sides)

        return visit(formula.expression)

    def _balanced(self, kind: Kind, values: list[_Value]) -> _Value:
        """Values joined pair by pair, in few levels."""
        while len(values) > 1:
            values = sorted(values, key=lambda v: v.level)
            values = [self._operation(kind, *values[:2]), *values[2:]]
        return values[0]

    def _operation(self, kind: Kind, *operands: _Value) -> _Value:
        level = 1 + max(o.level for o in operands)
        group = self.groups.setdefault((level, kind), _Group(kind))
        value = _Value(operands[0].size, level, group=group, start=group.size)
        group.members.append(operands)
        group.size += value.size
        return value

    def operations(self) -> tuple[ArrayFormula, ...]:
        """All operations in order."""
        self.sizes.append(len(self.constants))
        found: list[ArrayFormula] = []
        for _, group in sorted(self.groups.items(), key=lambda item: item[0][0]):
            expression, symbols = group.kind
            columns = zip(*group.members, strict=True)
            filled = [(s, self.gathered(c)) for s, c in zip(symbols, columns, strict=True)]
            found.append(ArrayFormula(expression, Arguments(tuple(filled)), group.size))
            group.array = len(self.sizes)
            self.sizes.append(group.size)
        return tuple(found)

    def gathered(self, values: Sequence[_Value]) -> Gather:
        """How values are read, one behind the other."""
        sources, indices = zip(*(v.positions() for v in values), strict=True)
        return gather(np.concatenate(sources), np.concatenate(indices), self.sizes)


def _is_divisor(factor: Any) -> bool:
    return bool(factor.is_Pow and factor.exp.is_Number and factor.exp.is_negative)


def _taken_apart(node: Any) -> tuple[Kind, list[Any]]:
    """The kind of an operation, and its operands; exponents and the like belong to the kind."""
    is_whole = isinstance(node, WHOLE)
    operands = (
        sorted(node.free_symbols, key=str) if is_whole else [a for a in node.args if a.free_symbols]
    )
    symbols = tuple(sp.Symbol(f"x{i}", real=True) for i, _ in enumerate(operands))
    names: dict[Any, Any] = dict(zip(operands, symbols, strict=True))
    expression: Any = (
        node.xreplace(names) if is_whole else node.func(*(names.get(a, a) for a in node.args))
    )
    return (expression, symbols), operands
