"""A small, safe parser for expressions in files, in Modelica's syntax.

Numbers, names, arithmetic, comparisons, ``if`` ... ``then`` ... ``else``, vectors, matrices, texts and a few functions.
Nothing is evaluated as Python. The caller looks names up, so that an expression can only use what the caller provides.
`written` is the inverse.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import sympy as sp

from acausal.errors import listing, nearest, shortened
from acausal.modeling import where
from acausal.netlist.arithmetic import MAX_INTEGER, RELATIONS, Arithmetic
from acausal.netlist.tokens import ExpressionError as ExpressionError, TokenStream
from acausal.netlist.vocabulary import BARE_CONSTANTS, CONSTANTS, CONVERSIONS, FUNCTIONS, function

MAX_DEPTH = 60

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


class Reader(TokenStream, Arithmetic):
    """Recursive descent over the tokens of one text.

    Attributes:
        events: whether the conditions of ``if`` are events.
    """

    events: bool = False

    def __init__(self, text: str, lookup: Lookup) -> None:
        super().__init__(text)
        self.lookup = lookup
        self.depth = 0

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
        return where(condition, self.number(value), self.number(otherwise), events=self.events)

    def _any(self) -> Any:
        value = self._all()
        while self.peek() == "or":
            self.advance()
            value = self.logical(sp.Or, value, self._all())
        return value

    def _all(self) -> Any:
        value = self._negation()
        while self.peek() == "and":
            self.advance()
            value = self.logical(sp.And, value, self._negation())
        return value

    def _negation(self) -> Any:
        if self.peek() == "not":
            self.advance()
            return self.logical(sp.Not, self._relation())
        return self._relation()

    def _relation(self) -> Any:
        left = self._sum()
        if self.peek() not in RELATIONS:
            return left
        return self.relation(self.advance(), left, self._sum())

    # -- arithmetic ----------------------------------------------------------------------------------

    def _sum(self) -> Any:
        value = self._signed_product()
        while self.peek() in ("+", "-"):
            value = self.arithmetic(self.advance(), value, self._product())
        return value

    def _signed_product(self) -> Any:
        if self.peek() in ("+", "-"):
            return self.arithmetic(self.advance(), 0, self._product())
        return self._product()

    def _product(self) -> Any:
        value = self._power()
        while self.peek() in ("*", "/"):
            value = self.arithmetic(self.advance(), value, self._power())
        return value

    def _power(self) -> Any:
        base = self._primary()
        if self.peek() != "^":
            return base
        self.advance()
        exponent = (
            self.arithmetic(self.advance(), 0, self._primary())
            if self.peek() in ("+", "-")
            else self._primary()
        )
        return self.arithmetic("^", base, exponent)

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
        self.count()
        try:
            return self.finite(known(*(sp.sympify(self.number(value)) for _, value in given)))
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
        self.count()
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


def _is_record(value: Any) -> bool:
    return dataclasses.is_dataclass(value) and not isinstance(value, type)
