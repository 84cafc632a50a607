"""A small, safe parser for expressions in files, in Modelica's syntax.

Numbers, names, arithmetic, comparisons, ``if`` ... ``then`` ... ``else``, vectors, matrices, texts and a few functions.
Nothing is evaluated as Python. The caller looks names up, so that an expression can only use what the caller provides.
`written` is the inverse.
"""

from __future__ import annotations

import dataclasses
import math
import operator
from collections.abc import Callable
from typing import Any

import sympy as sp

from acausal.errors import listing, nearest, shortened
from acausal.modeling import where
from acausal.netlist.tokens import ExpressionError as ExpressionError, TokenStream
from acausal.netlist.vocabulary import BARE_CONSTANTS, CONSTANTS, CONVERSIONS, FUNCTIONS, function

MAX_DEPTH = 60
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

Lookup = Callable[[str], Any]


def parse(text: str, lookup: Lookup) -> Any:
    """The value of an expression: a number, truth value, text, sympy expression, list, or any result of `lookup`.

    Arguments:
        lookup: from a dotted name to its value; ``name()`` for a name that is called. It raises KeyError for a
            name it does not know.

    Raises:
        ExpressionError: one sentence that says where the expression is wrong.
    """
    reader = Reader(text, lookup)
    value = reader.expression()
    reader.expect_end()
    return value


def parse_equation(text: str, lookup: Lookup) -> tuple[Any, Any]:
    """Both sides of ``lhs = rhs``.

    Raises:
        ExpressionError: one sentence that says where the equation is wrong.
    """
    reader = Reader(text, lookup)
    left = reader.expression()
    reader.take("=")
    right = reader.expression()
    reader.expect_end()
    return left, right


class Reader(TokenStream):
    """Recursive descent over the tokens of one text.

    Attributes:
        events: whether the conditions of ``if`` are events.
    """

    events: bool = False

    def __init__(self, text: str, lookup: Lookup) -> None:
        super().__init__(text)
        self.lookup = lookup
        self.depth = 0
        self.operations = 0

    # -- logic ---------------------------------------------------------------------------------------

    def expression(self) -> Any:
        """The lowest level: ``if`` or a disjunction."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.wrong(f"nested more than {MAX_DEPTH} deep")
        value = self._choice() if self.peek() == "if" else self._any()
        self.depth -= 1
        return value

    def _choice(self) -> Any:
        self.advance()
        condition = self.truth(self.expression())
        self.take("then")
        value = self.expression()
        if self.peek() == "elseif":
            self.depth += 1
            if self.depth > MAX_DEPTH:
                raise self.wrong(f"nested more than {MAX_DEPTH} deep")
            otherwise = self._choice()
            self.depth -= 1
        else:
            self.take("else")
            otherwise = self.expression()
        if isinstance(condition, bool):
            return value if condition else otherwise
        return where(condition, self._number(value), self._number(otherwise), events=self.events)

    def _any(self) -> Any:
        value = self._all()
        while self.peek() == "or":
            self.advance()
            value = self._logical(sp.Or, value, self._all())
        return value

    def _all(self) -> Any:
        value = self._negation()
        while self.peek() == "and":
            self.advance()
            value = self._logical(sp.And, value, self._negation())
        return value

    def _negation(self) -> Any:
        if self.peek() == "not":
            self.advance()
            return self._logical(sp.Not, self._relation())
        return self._relation()

    def _relation(self) -> Any:
        left = self._sum()
        if self.peek() not in RELATIONS:
            return left
        self._count()
        relation = RELATIONS[self.advance()]
        right = self._sum()
        if isinstance(left, str | bool) and isinstance(right, type(left)):
            if relation not in (sp.Eq, sp.Ne):
                raise self.wrong("texts and truth values can only be compared by == and <>")
            return (left == right) is (relation is sp.Eq)
        return self._plain(relation(self._number(left), self._number(right)))

    def _logical(self, function: Any, *values: Any) -> Any:
        self._count()
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

    # -- arithmetic ----------------------------------------------------------------------------------

    def _sum(self) -> Any:
        value = self._signed_product()
        while self.peek() in ("+", "-"):
            value = self._arithmetic(self.advance(), value, self._product())
        return value

    def _signed_product(self) -> Any:
        if self.peek() in ("+", "-"):
            return self._arithmetic(self.advance(), 0, self._product())
        return self._product()

    def _product(self) -> Any:
        value = self._power()
        while self.peek() in ("*", "/"):
            value = self._arithmetic(self.advance(), value, self._power())
        return value

    def _power(self) -> Any:
        base = self._primary()
        if self.peek() != "^":
            return base
        self.advance()
        exponent = (
            self._arithmetic(self.advance(), 0, self._primary())
            if self.peek() in ("+", "-")
            else self._primary()
        )
        return self._arithmetic("^", base, exponent)

    def _primary(self) -> Any:
        kind, token = self.tokens[self.position] if self.position < len(self.tokens) else ("", "")
        self.position += 1
        if kind == "number":
            return self._literal(token)
        if kind == "text":
            return token[1:-1]
        if kind == "name":
            return self.call(token) if self.peek() == "(" else self._name(token)
        if token == "(":
            value = self.expression()
            self.take(")")
            return value
        if token == "{":
            return self._list("}")
        if token == "[":
            return self._matrix()
        raise self.wrong(
            f"a number or a name expected, {f'{token!r}' if token else 'the end'} found"
        )

    def _literal(self, token: str) -> int | float:
        value = float(token)
        if not math.isfinite(value):
            raise self.wrong("not a finite number")
        return int(value) if token.isdigit() and value < MAX_INTEGER else value

    def _arithmetic(self, operator: str, a: Any, b: Any) -> Any:
        a, b = self._number(a), self._number(b)
        if operator == "/" and isinstance(b, int | float) and b == 0:
            raise self.wrong("divides by zero")
        if isinstance(a, sp.Expr) or isinstance(b, sp.Expr):
            self._count()
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
        return self._finite(result)

    def _count(self) -> None:
        self.operations += 1
        if self.operations > MAX_OPERATIONS:
            raise self.wrong(f"more than {MAX_OPERATIONS} operations on parameters")

    def _number(self, value: Any) -> Any:
        if not isinstance(value, int | float | sp.Expr) or isinstance(value, bool):
            raise self.wrong(f"{shortened(repr(value))} is not a number to calculate with")
        return value

    def _finite(self, value: Any) -> Any:
        if isinstance(value, sp.Expr) and value.is_number:
            value = float(value) if value.is_real else math.nan
        if isinstance(value, int) and abs(value) > MAX_INTEGER:
            value = float(value) if value.bit_length() < 1000 else math.inf
        if isinstance(value, float) and not math.isfinite(value):
            raise self.wrong("not a finite number")
        return value

    # -- names, calls, vectors -----------------------------------------------------------------------

    def _name(self, name: str) -> Any:
        try:
            return self.lookup(name)
        except KeyError:
            pass
        constant = name.removeprefix("Modelica.").removeprefix("Constants.")
        if constant in CONSTANTS and (constant != name or name in BARE_CONSTANTS):
            return CONSTANTS[constant]
        if name in ("true", "false"):
            return name == "true"
        raise self.wrong(f"'{shortened(name)}' is not known here")

    def call(self, name: str) -> Any:
        """The value of a call, whose name has been read."""
        self.take("(")
        given: list[tuple[str, Any]] = []
        if self.peek() != ")":
            given.append(self._argument())
            while self.peek() == ",":
                self.advance()
                given.append(self._argument())
        self.take(")")
        known = self.function(name)
        if known is None:
            return self._record(name, given)
        self._count()
        try:
            return self._finite(known(*(sp.sympify(self._number(value)) for _, value in given)))
        except (TypeError, ValueError):
            raise self.wrong(f"{name} does not take these arguments") from None

    def function(self, name: str) -> Callable[..., Any] | None:
        """A function that expressions know; None for others."""
        return function(name)

    def _argument(self) -> tuple[str, Any]:
        """Name ("" where there is none) and value of an argument."""
        here = self.tokens[self.position : self.position + 2]
        if len(here) == 2 and here[0][0] == "name" and here[1][1] == "=":
            self.position += 2
            return here[0][1], self.expression()
        return "", self.expression()

    def _record(self, name: str, given: list[tuple[str, Any]]) -> Any:
        """A record, perhaps with some of its fields changed; or the result of a library's function."""
        try:
            record = self.lookup(name + "()")
        except KeyError:
            known = [*FUNCTIONS, *(f"from_{unit}" for unit in CONVERSIONS)]
            raise self.wrong(
                f"'{shortened(name)}' cannot be called; {nearest(name, known)}"
            ) from None
        if callable(record):
            return self._applied(name, record, given)
        if not given:
            return record
        fields = [f.name for f in dataclasses.fields(record)] if _is_record(record) else []
        changes = {f"{key}_" if f"{key}_" in fields else key: value for key, value in given}
        for key in changes:
            if key not in fields:
                raise self.wrong(f"{name} has no '{key}'; it has {listing(fields) or 'no fields'}")
        return dataclasses.replace(record, **changes)

    def _applied(
        self, name: str, function: Callable[..., Any], given: list[tuple[str, Any]]
    ) -> Any:
        self._count()
        named = {key: value for key, value in given if key}
        try:
            return function(*(value for key, value in given if not key), **named)
        except (TypeError, ValueError):
            raise self.wrong(f"{name} does not take these arguments") from None

    def _list(self, closing: str) -> list[Any]:
        values: list[Any] = []
        if self.peek() != closing:
            values.append(self.expression())
            while self.peek() == ",":
                self.advance()
                values.append(self.expression())
        self.take(closing)
        return values

    def _matrix(self) -> list[list[Any]]:
        rows: list[list[Any]] = [[self.expression()]]
        while self.peek() in (",", ";"):
            if self.advance() == ";":
                rows.append([])
            rows[-1].append(self.expression())
        self.take("]")
        if len({len(row) for row in rows}) > 1:
            raise self.wrong("the rows of the matrix differ in length")
        return rows


def _is_small(exponent: Any) -> bool:
    return isinstance(exponent, int) and abs(exponent) <= MAX_EXPONENT


def _inexact(value: Any) -> Any:
    """Integers as floats: sympy's exact powers of them could grow without end."""
    return float(value) if isinstance(value, int) else value


def _is_record(value: Any) -> bool:
    return dataclasses.is_dataclass(value) and not isinstance(value, type)
