"""A small, safe parser for expressions in files, in Modelica's syntax.

Numbers, names, arithmetic, comparisons, ``if`` ... ``then`` ... ``else``, vectors, matrices, texts and a few functions.
Nothing is evaluated as Python. The caller looks names up, so that an expression can only use what the caller provides.
`written` is the inverse.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Callable
from typing import Any

import sympy as sp

from acausal.errors import DeclarationError, listing, nearest, shortened
from acausal.modeling import where
from acausal.netlist.arithmetic import MAX_INTEGER, RELATIONS, Arithmetic
from acausal.netlist.grammar import Grammar
from acausal.netlist.vocabulary import BARE_CONSTANTS, CONSTANTS, CONVERSIONS, FUNCTIONS, function

MAX_LENGTH = 10_000
"""Characters up to which an expression is read."""

TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<name>[A-Za-z_]\w*(?:\[\d+(?:,\s*\d+)*\])?(?:\.(?:[A-Za-z_]\w*|'[^'\\.]*')(?:\[\d+(?:,\s*\d+)*\])?)*)"
    r'|(?P<text>"[^"\\]*")'
    r"|(?P<op><=|>=|==|<>|[-+*/^(){}\[\],;=<>]))"
)
KEYWORDS = ("if", "then", "elseif", "else", "and", "or", "not", "when", "elsewhen")


class ExpressionError(DeclarationError):
    """An expression in a file is malformed; the message holds the expression and the place in it."""


def tokens_of(text: str) -> tuple[list[str], list[str]]:
    """Kinds and texts of the tokens of an expression; the last one is the end, with an empty text.

    Raises:
        ExpressionError: for a text that is too long, or a sign that no expression has.
    """
    if len(text) > MAX_LENGTH:
        raise ExpressionError(
            f"an expression of {len(text)} characters; at most {MAX_LENGTH} are read"
        )
    kinds: list[str] = []
    texts: list[str] = []
    at, end = 0, len(text.rstrip())
    while at < end:
        match = TOKEN.match(text, at, end)
        if match is None:
            sign = text[at:].strip()[:1]
            raise ExpressionError(
                f"'{shortened(text)}': '{sign}' is not allowed; numbers, names, + - * / ^ and parentheses are"
            )
        kind = str(match.lastgroup)
        kinds.append("op" if match[kind] in KEYWORDS else kind)
        texts.append(match[kind])
        at = match.end()
    return [*kinds, ""], [*texts, ""]


LOGICAL: dict[str, Any] = {"and": sp.And, "or": sp.Or, "not": sp.Not}

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


class Reader(Grammar, Arithmetic):
    """Evaluates one text while reading it.

    Attributes:
        events: whether the conditions of ``if`` are events.
    """

    events: bool = False

    def __init__(self, text: str, lookup: Lookup) -> None:
        self.text, self.lookup = text, lookup
        self.kinds, self.texts = tokens_of(text)

    def wrong(self, reason: str) -> ExpressionError:
        """The error, with the text and the reason."""
        return ExpressionError(f"'{shortened(self.text)}': {reason}")

    def expect_end(self) -> None:
        """Make sure that nothing follows.

        Raises:
            ExpressionError: if something does.
        """
        if self.peek:
            raise self.wrong(f"'{shortened(self.peek)}' is not expected there")

    # -- operators -----------------------------------------------------------------------------------

    def expression(self) -> Any:
        """The lowest level: ``if`` or a disjunction."""
        self.deeper()
        value = self._choice() if self.peek == "if" else self.disjunction()
        self.depth -= 1
        return value

    def _choice(self) -> Any:
        self.advance()
        condition = self.truth(self.expression())
        self.take("then")
        value = self.expression()
        if self.peek == "elseif":
            self.deeper()
            otherwise = self._choice()
            self.depth -= 1
        else:
            self.take("else")
            otherwise = self.expression()
        if isinstance(condition, bool):
            return value if condition else otherwise
        return where(condition, self.number(value), self.number(otherwise), events=self.events)

    def operation(self, operator: str, place: int, *operands: Any) -> Any:
        """The value that an operator gives."""
        if operator in LOGICAL:
            return self.logical(LOGICAL[operator], *operands)
        if operator in RELATIONS:
            return self.relation(operator, *operands)
        left, right = operands if len(operands) == 2 else (0, *operands)
        return self.arithmetic(operator, left, right)

    def exponent(self) -> Any:
        """What stands behind ``^``, perhaps with a sign."""
        if self.peek in ("+", "-"):
            return self.arithmetic(self.advance(), 0, self.primary())
        return self.primary()

    def primary(self) -> Any:
        """The value of an operand."""
        kind, token = self.kinds[self.position], self.advance()
        if kind == "number":
            return self._literal(token)
        if kind == "text":
            return token[1:-1]
        if kind == "name":
            return self.call(token) if self.peek == "(" else self._name(token)
        if token == "(":
            value = self.expression()
            self.take(")")
            return value
        if token == "{":
            return self._list("}", self.expression)
        if token == "[":
            return self._matrix()
        raise self.wrong(
            f"a number or a name expected, {repr(token) if token else 'the end'} found"
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
        given = self._list(")", self._argument)
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
        here = self.position
        if self.kinds[here] == "name" and self.texts[here + 1] == "=":
            self.position += 2
            return self.texts[here], self.expression()
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

    def _list(self, closing: str, read: Callable[[], Any]) -> list[Any]:
        values: list[Any] = []
        if self.peek != closing:
            values.append(read())
            while self.accept(","):
                values.append(read())
        self.take(closing)
        return values

    def _matrix(self) -> list[list[Any]]:
        rows = self.matrix()
        if len({len(row) for row in rows}) > 1:
            raise self.wrong("the rows of the matrix differ in length")
        return rows


def _is_record(value: Any) -> bool:
    return dataclasses.is_dataclass(value) and not isinstance(value, type)
