"""Operators of expressions, on numbers, truth values, arrays and records; and where an expression stands."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.errors import ModelError, shown
from acausal.modelica.classes import ClassNode
from acausal.modelica.meanings import Literal
from acausal.modelica.syntax import (
    Choice,
    Expression,
    OperatorExpression,
)
from acausal.modelica.tokens import PREDEFINED, ModelicaError, NumbersNeededError
from acausal.modelica.values import (
    Absent,
    Record,
    each,
    identity,
    is_real,
    is_record,
    type_of,
    without_index,
)
from acausal.modeling import (
    Parameter,
    Previous,
    Reference,
    check_size,
    condition,
    where,
)
from acausal.netlist import Arithmetic, evaluated

MAX_OPERATIONS = 20_000
MAX_CALLS = 30


@dataclass(frozen=True, eq=False)
class Frame:
    """Where an expression stands.

    Attributes:
        node: the class whose text it is.
        build: the component that it belongs to; None in a package or a function.
        local: loop variables, and the variables of a function.
        events: whether conditions are events.
        calls: how many functions are being called.
    """

    node: ClassNode
    build: Any = None
    local: dict[str, Any] = field(default_factory=dict[str, Any])
    events: bool = True
    calls: int = 0

    def with_local(self, **local: Any) -> Frame:
        """The same with further local names."""
        return replace(self, local={**self.local, **local})

    def find(self, words: tuple[str, ...]) -> tuple[Any, Any]:
        """A class or constant by its name, and the words that are left."""
        return self.node.lookup(words)


class Operators(Arithmetic):
    """Operators on values.

    Attributes:
        at: of the expression that is being evaluated, for errors.
        build: of the component whose statement is evaluated; also in the functions that it calls.
    """

    max_operations = MAX_OPERATIONS

    def __init__(self, frame: Frame) -> None:
        self.frame, self.build = frame, frame.build
        self.at = 0
        self.ends: list[int] = []

    def wrong(self, reason: str, length: int | None = None) -> Exception:
        """The error at the present place."""
        return self.frame.node.wrong(self.at, reason, length)

    def too_large(self, reason: str, length: int | None = None) -> Exception:
        """The error for what exceeds a limit, or needs numbers for another reason."""
        return NumbersNeededError(str(self.wrong(reason, length)))

    def value(self, expression: Expression) -> Any:
        """The value of an expression."""
        raise NotImplementedError

    def _operation(self, expression: OperatorExpression) -> Any:
        """An operator; long sums are walked through from their first operand on."""
        spine: list[OperatorExpression] = []
        first: Expression = expression
        while isinstance(first, OperatorExpression):
            spine.append(first)
            first = first.operands[0]
        value = self.value(first)
        for operation in reversed(spine):
            self.at = operation.at
            others = [self.value(v) for v in operation.operands[1:]]
            self.at = operation.at
            value = self._applied(operation.operator, value, *others)
        return value

    def _applied(self, operator: str, first: Any, *others: Any) -> Any:
        for value in (first, *others):
            if isinstance(value, Absent):
                raise self.wrong("this is left out by its condition")
        if any(map(is_record, (first, *others))):
            return self.overloaded(operator, first, *others)
        if operator == "not":
            return each(lambda a: self.logical(sp.Not, a), first)
        if not others:
            if operator.endswith("+"):
                return each(self.number, first)
            return each(lambda a: self.arithmetic("-", 0, a), first)
        second = others[0]
        if operator in ("and", "or"):
            function = sp.And if operator == "and" else sp.Or
            return each(lambda a, b: self.logical(function, a, b), first, second)
        if operator in ("<", "<=", ">", ">=", "==", "<>"):
            return self.relation(operator, first, second)
        if operator == "+" and isinstance(first, str) and isinstance(second, str):
            return first + second
        arrays = isinstance(first, np.ndarray) + isinstance(second, np.ndarray)
        if operator in ("+", "-") and arrays == 1:
            raise self.wrong("an array and a number are added by .+ and .-")
        if operator == "*" and arrays == 2:
            return self._product(first, second)
        if operator == "/" and isinstance(second, np.ndarray):
            raise self.wrong("an array is no divisor; ./ divides by each element")
        if operator == "^" and isinstance(first, np.ndarray):
            found = identity(len(first))
            for _ in range(self.whole(second, "an exponent")):
                found = self._product(found, first)
            return found
        sign = operator.lstrip(".")
        return each(lambda a, b: self.arithmetic(sign, a, b), first, second)

    def need_factors(self, a: Any, b: Any) -> None:
        """Refuse arrays of sizes that have no product."""
        if a.shape[-1] != b.shape[0]:
            sizes = f"{list(a.shape)} and {list(b.shape)}"
            raise self.wrong(f"arrays of sizes {sizes} cannot be multiplied")

    def _product(self, a: Any, b: Any) -> Any:
        self.need_factors(a, b)
        check_size(a.size * (b.shape[1] if b.ndim > 1 else 1), "the product")
        if not a.shape[-1]:
            return np.zeros((*a.shape[:-1], *b.shape[1:]), dtype=object)[()]
        return self.result(np.dot(a, b))

    def overloaded(self, operator: str, *values: Any) -> Any:
        """An operator of which an operand is a record."""
        raise NotImplementedError

    def result(self, value: Any) -> Any:
        """What numpy gives: an array, or a number."""
        return value if isinstance(value, np.ndarray) else self.finite(value)

    def relation(self, sign: str, left: Any, right: Any) -> Any:
        """A comparison; values of enumerations are compared by their numbers."""
        if sign in ("==", "<>") and self._are_whole(left, right):
            sides = [v.number if isinstance(v, Literal) else v for v in (left, right)]
            apart = self.arithmetic("-", *sides)
            return self.relation("<" if sign == "==" else ">=", sp.Abs(apart), 0.5)
        if isinstance(left, sp.Basic) and isinstance(right, Literal):
            right = right.number
        if isinstance(right, sp.Basic) and isinstance(left, Literal):
            left = left.number
        if isinstance(left, Literal) and isinstance(right, Literal) and sign not in ("==", "<>"):
            left, right = left.number, right.number
        if "Boolean" in (type_of(left), type_of(right)) and sign in ("==", "<>"):
            a, b = self.truth(left), self.truth(right)
            same = a == b if isinstance(a, bool) and isinstance(b, bool) else None
            if same is not None:
                return same is (sign == "==")
            equal = sp.Or(sp.And(a, b), sp.And(sp.Not(a), sp.Not(b)))
            return self._plain(equal if sign == "==" else sp.Not(equal))
        if isinstance(left, np.ndarray) or isinstance(right, np.ndarray):
            raise self.wrong("arrays cannot be compared")
        return super().relation(sign, left, right)

    @staticmethod
    def _are_whole(*sides: Any) -> bool:
        """Whether these are integers or values of enumerations that change with time: equal, or at least 1 apart."""
        kinds = [
            type_of(v.reference if isinstance(v, Previous) else v)
            for v in sides
            if isinstance(v, sp.Expr)
        ]
        whole = all(kind not in ("", "Real", "Boolean", "String") for kind in kinds)
        return bool(kinds) and (whole or any(isinstance(v, Literal) for v in sides))

    def truth(self, value: Any) -> Any:
        """A condition; a Boolean variable is one, too."""
        if isinstance(value, sp.Expr) and type_of(value) in ("", "Boolean"):
            return condition(value, "a condition")
        if isinstance(value, sp.Expr):
            raise self.wrong("a number is neither true nor false")
        return super().truth(value)

    def holds(self, test: Expression | None) -> Any:
        """The condition of a branch; that of ``else`` is true."""
        return True if test is None else self.truth(self.value(test))

    def need_type(self, kind: str, value: Any) -> None:
        """Refuse a value that surely has another type than the variable that it is for."""
        if kind == "Integer" and is_real(value):
            raise self.wrong("an Integer is needed here, this is a Real; integer(...) rounds it")
        plain = isinstance(value, int | float) and not isinstance(value, bool)
        if kind and kind not in PREDEFINED and plain:
            raise self.wrong(f"a value of {kind} is needed here, not a number")

    def number(self, value: Any) -> Any:
        """A value to calculate with."""
        if isinstance(value, Absent):
            raise self.wrong("this is left out by its condition")
        if type_of(value) == "Boolean":
            raise self.wrong("a Boolean is not a number to calculate with")
        if isinstance(value, np.ndarray):
            raise self.wrong("a single number is needed here, not an array")
        return super().number(value)

    def whole(self, value: Any, what: str) -> int:
        """A number that is known when the model is built."""
        if isinstance(value, Literal):
            return value.number
        if isinstance(value, sp.Expr):
            value = self.known(value, what)
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if isinstance(value, bool) or not isinstance(value, int):
            raise self.wrong(f"{what} is a whole number, not {shown(value, 40)}")
        return value

    def known(self, value: Any, what: str) -> Any:
        """A number or truth value that parameters decide when the model is built."""
        if not isinstance(value, sp.Basic):
            return value
        used: dict[Any, Any] = {}
        try:
            found = number_or_truth(value, what, used)
        except ModelError as error:
            raise self.wrong(str(error)) from None
        except TypeError:
            raise self.wrong(f"{what} is no finite real number here") from None
        if isinstance(found, sp.Basic):
            raise self.wrong(
                f"{what} has to be known when the model is built; this changes with time"
            )
        if self.build is not None:
            self.build.decided[str(value)] = found
        for symbol in used:
            owner = symbol.owner.component.__dict__.get("_build")
            if owner is not None:
                owner.deciding.setdefault(without_index(symbol.path), {})[str(value)] = value, found
        return found

    def known_array(self, value: Any) -> Any:
        """Numbers of an array that parameters decide when the model is built."""
        return np.array(each(lambda v: float(self.known(v, "a matrix")), value), dtype=float)

    @staticmethod
    def varies(value: Any) -> bool:
        """Whether a value changes with time."""
        return any(
            not (isinstance(s, Reference) and isinstance(s.declaration, Parameter))
            for s in value.free_symbols
        )

    def _choice(self, expression: Choice) -> Any:
        branches: list[tuple[Any, Any]] = []
        otherwise: Any = None
        for test, branch in expression.branches:
            holds = self.holds(test)
            if holds is True:
                otherwise = self.value(branch)
                break
            if holds is not False:
                try:
                    branches.append((holds, self.value(branch)))
                except ModelicaError:  # no matter where parameters rule that branch out
                    if self.varies(holds) or self.known(holds, "this condition"):
                        raise
        else:
            otherwise = self.value(expression.otherwise)
        for holds, value in reversed(branches):
            otherwise = self.chosen(holds, value, otherwise)
        return otherwise

    def chosen(self, holds: Any, value: Any, otherwise: Any) -> Any:
        """One value or another, as a condition decides; the condition of parameters alone is no event."""
        self.count()
        if isinstance(value, Record) and isinstance(otherwise, Record):
            fields = otherwise.fields
            chosen = {k: self.chosen(holds, v, fields[k]) for k, v in value.fields.items()}
            return Record(chosen, value.node)
        if isinstance(value, str) or isinstance(otherwise, str):
            sides = [v.number if isinstance(v, Literal) else v for v in (value, otherwise)]
            if not any(isinstance(v, str) for v in sides):
                value, otherwise = sides
            else:
                return value if self.known(holds, "the condition of a text") else otherwise
        events = self.frame.events and self.varies(holds)
        if events and self.frame.calls and holds.has(sp.Eq, sp.Ne):
            events = False  # a function has no events; nothing can watch for equal numbers

        def one(a: Any, b: Any) -> Any:
            if isinstance(a, Record):
                return self.chosen(holds, a, b)
            if "Boolean" in (type_of(a), type_of(b)):
                a, b = self.truth(a), self.truth(b)
                return self._plain(sp.Or(sp.And(holds, a), sp.And(sp.Not(holds), b)))
            return where(holds, self.number(a), self.number(b), events=events)

        return each(one, value, otherwise)


def number_or_truth(value: sp.Basic, what: str, used: dict[Any, Any]) -> Any:
    """What parameters make of an expression or a condition; ``used`` are their values, which are added."""
    if not isinstance(value, sp.logic.boolalg.Boolean) or isinstance(value, sp.Symbol):
        return evaluated(cast(sp.Expr, value), what, used)
    symbols = sorted(value.free_symbols, key=str)
    found = value.xreplace({s: evaluated(cast(sp.Expr, s), what, used) for s in symbols})
    return bool(found) if found in (sp.true, sp.false) else found
