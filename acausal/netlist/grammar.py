"""The operators of Modelica's expressions, by recursive descent over tokens: for netlists and for Modelica text.

What an operator makes of its operands is the reader's: a value at once, or a node of a syntax tree.
"""

from __future__ import annotations

from collections.abc import Callable, Container
from typing import Any

from acausal.errors import shortened
from acausal.netlist.arithmetic import RELATIONS

SUMS, PRODUCTS, POWERS = ("+", "-", ".+", ".-"), ("*", "/", ".*", "./"), ("^", ".^")

MAX_DEPTH = 60
"""So deep may expressions be nested."""


class FormulaTokens:
    """The tokens of a text, and how far they are read.

    Attributes:
        texts: of the tokens; the last one is the end, with an empty text. position: of the next.
        end: what it is called in messages.
    """

    texts: list[str]
    position: int = 0
    end: str = "the end"

    def wrong(self, reason: str) -> Exception:
        """The error at the next token."""
        raise NotImplementedError

    @property
    def peek(self) -> str:
        """The next token; empty at the end."""
        return self.texts[self.position]

    @property
    def found(self) -> str:
        """The next token, for a message."""
        return f"'{shortened(self.peek, 40)}'" if self.peek else self.end

    def advance(self) -> str:
        """The next token, which is then read."""
        self.position += 1
        return self.texts[self.position - 1]

    def accept(self, expected: str) -> bool:
        """Read a token if it is the next."""
        if self.texts[self.position] == expected:
            self.position += 1
            return True
        return False

    def take(self, expected: str) -> None:
        """Read that token; the error of `wrong` if another is next."""
        if not self.accept(expected):
            raise self.wrong(f"'{expected}' expected, {self.found} found")


class Grammar(FormulaTokens):
    """Reads operators and their operands."""

    depth: int = 0

    def deeper(self) -> None:
        """Count a level; the error of `wrong` beyond the limit."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.wrong(f"nested more than {MAX_DEPTH} deep")

    def operation(self, operator: str, place: int, *operands: Any) -> Any:
        """What an operator makes of one or two operands; ``place`` is its position among the tokens."""
        raise NotImplementedError

    def primary(self) -> Any:
        """An operand: a number, a name, or anything in brackets."""
        raise NotImplementedError

    def exponent(self) -> Any:
        """What stands behind ``^``."""
        return self.primary()

    def disjunction(self) -> Any:
        """The operators from ``or`` on."""
        return self._from_left(("or",), self._conjunction)

    def _conjunction(self) -> Any:
        return self._from_left(("and",), self._negation)

    def _negation(self) -> Any:
        if self.texts[self.position] != "not":
            return self._relation()
        place = self.position
        return self.operation(self.advance(), place, self._relation())

    def _relation(self) -> Any:
        value, place = self._sum(), self.position
        if self.texts[place] not in RELATIONS:
            return value
        return self.operation(self.advance(), place, value, self._sum())

    def _sum(self) -> Any:
        return self._from_left(SUMS, self._product, signed=self.texts[self.position] in SUMS)

    def _product(self) -> Any:
        return self._from_left(PRODUCTS, self._power)

    def _from_left(
        self, operators: Container[str], operand: Callable[[], Any], *, signed: bool = False
    ) -> Any:
        """Operands with operators between them, from left to right; the first one may have a sign."""
        place = self.position
        value = self.operation(self.advance(), place, operand()) if signed else operand()
        while self.texts[self.position] in operators:
            place = self.position
            value = self.operation(self.advance(), place, value, operand())
        return value

    def _power(self) -> Any:
        value, place = self.primary(), self.position
        if self.texts[place] not in POWERS:
            return value
        return self.operation(self.advance(), place, value, self.exponent())

    def matrix(self) -> list[list[Any]]:
        """The rows behind ``[``, up to ``]``."""
        rows: list[list[Any]] = [[self.expression()]]
        while self.peek in (",", ";"):
            if self.advance() == ";":
                rows.append([])
            rows[-1].append(self.expression())
        self.take("]")
        return rows

    def expression(self) -> Any:
        """A whole expression."""
        raise NotImplementedError
