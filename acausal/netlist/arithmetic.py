"""Arithmetic and logic on the values of expressions in files: numbers, truth values, texts and sympy expressions."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

import sympy as sp

from acausal.errors import shortened

MAX_INTEGER = 2**53
MAX_EXPONENT = 100
MAX_OPERATIONS = 300

RELATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": sp.Eq,
    "<>": sp.Ne,
}


class Arithmetic:
    """Operators on values, with limits; a reader of expressions says where one is wrong.

    Attributes:
        operations: how many on parameters there were, of at most ``max_operations``.
    """

    operations: int = 0
    max_operations: int = MAX_OPERATIONS

    def wrong(self, reason: str) -> Exception:
        """The error at the present place."""
        raise NotImplementedError

    def too_large(self, reason: str) -> Exception:
        """The error for what exceeds a limit."""
        return self.wrong(reason)

    def relation(self, sign: str, left: Any, right: Any) -> Any:
        """A comparison; of texts and truth values by ``==`` and ``<>`` only."""
        self.count()
        relation = RELATIONS[sign]
        if isinstance(left, str | bool) and isinstance(right, type(left)):
            if relation not in (sp.Eq, sp.Ne):
                raise self.wrong("texts and truth values can only be compared by == and <>")
            return (left == right) is (relation is sp.Eq)
        return self._plain(relation(self.number(left), self.number(right)))

    def logical(self, function: Any, *values: Any) -> Any:
        """And, or, not of conditions."""
        self.count()
        return self._plain(function(*(self.truth(v) for v in values)))

    def truth(self, value: Any) -> Any:
        """A condition.

        Raises:
            ExpressionError: for what is neither true nor false.
        """
        if not isinstance(value, bool | sp.logic.boolalg.Boolean):
            raise self.wrong(f"{shortened(repr(value))} is neither true nor false")
        return value

    @staticmethod
    def _plain(value: Any) -> Any:
        """Sympy's true and false as Python's."""
        return bool(value) if value in (sp.true, sp.false) else value

    def arithmetic(self, operator: str, a: Any, b: Any) -> Any:
        """``a + b``, and so on for ``- * / ^``; numbers stay finite."""
        a, b = self.number(a), self.number(b)
        if operator == "/" and isinstance(b, int | float) and b == 0:
            raise self.wrong("divides by zero")
        if isinstance(a, sp.Expr) or isinstance(b, sp.Expr):
            self.count()
            a, b = _inexact(a), b if operator == "^" and _is_small(b) else _inexact(b)
        try:
            match operator:
                case "+":
                    result = a + b
                case "-":
                    result = -b if isinstance(a, int | float) and a == 0 else a - b
                case "*":
                    result = a * b
                case "/":
                    result = a / b
                case _:
                    plain = isinstance(a, int | float) and isinstance(b, int | float)
                    result = math.pow(a, b) if plain else a**b
        except (OverflowError, ValueError):
            raise self.wrong("not a finite number") from None
        return self.finite(result)

    def count(self) -> None:
        """Count an operation on parameters, within the limit."""
        self.operations += 1
        if self.operations > self.max_operations:
            raise self.too_large(f"more than {self.max_operations} operations on parameters")

    def number(self, value: Any) -> Any:
        """A value to calculate with; others are refused."""
        if not isinstance(value, int | float | sp.Expr) or isinstance(value, bool):
            raise self.wrong(f"{shortened(repr(value))} is not a number to calculate with")
        return value

    def finite(self, value: Any) -> Any:
        """A result; one that is not a finite number is refused."""
        if isinstance(value, sp.Expr) and value.is_number:
            value = float(value) if value.is_real else math.nan
        if isinstance(value, int) and abs(value) > MAX_INTEGER:
            value = float(value) if value.bit_length() < 1000 else math.inf
        if isinstance(value, float) and not math.isfinite(value):
            raise self.wrong("not a finite number")
        return value


def _is_small(exponent: Any) -> bool:
    return isinstance(exponent, int) and abs(exponent) <= MAX_EXPONENT


def _inexact(value: Any) -> Any:
    """Integers as floats: sympy's exact powers of them could grow without end."""
    return float(value) if isinstance(value, int) else value
