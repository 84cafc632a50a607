"""The grammar of expressions: their text becomes a syntax tree, which `acausal.modelica.evaluate` gives a meaning."""

from __future__ import annotations

import math

from acausal.modelica.syntax import (
    ArrayConstructor,
    Choice,
    Comprehension,
    DottedName,
    EndSubscript,
    Expression,
    FunctionCall,
    LiteralConstant,
    MatrixConstructor,
    OperatorExpression,
    RangeExpression,
    Several,
    Whole,
)
from acausal.modelica.tokens import KEYWORDS, Tokens

ESCAPES = {"n": "\n", "t": "\t", "r": "\r", "a": "\a", "b": "\b", "f": "\f", "v": "\v"}
CALLABLE = frozenset(("der", "initial", "pure"))
"""Keywords that are called as functions."""


class Expressions(Tokens):
    """Reads expressions."""

    def expression(self) -> Expression:
        """The lowest level: ``if``, or a range."""
        self.deeper()
        if self.texts[self.position] == "if":
            value = self._choice()
        else:
            value = self.disjunction()
            if self.texts[self.position] == ":":
                value = self._range(value)
        self.depth -= 1
        return value

    def _choice(self) -> Expression:
        at, branches = self.at, list[tuple[Expression, Expression]]()
        while self.accept("if") or self.accept("elseif"):
            condition = self.expression()
            self.take("then")
            branches.append((condition, self.expression()))
            if self.peek != "elseif":
                break
        self.take("else")
        return Choice(branches, self.expression(), at)

    def _range(self, first: Expression) -> Expression:
        at = self.at
        self.take(":")
        second = self.disjunction()
        if self.accept(":"):
            return RangeExpression(first, second, self.disjunction(), at)
        return RangeExpression(first, None, second, at)

    def operation(self, operator: str, place: int, *operands: Expression) -> Expression:
        """The node of an operator."""
        return OperatorExpression(operator, operands, self.starts[place])

    def primary(self) -> Expression:
        """The node of an operand."""
        text, at = self.texts[self.position], self.starts[self.position]
        first = text[:1]
        if first.isdigit() or (first == "." and len(text) > 1 and text[1].isdigit()):
            self.position += 1
            return LiteralConstant(
                int(text) if text.isdigit() and len(text) < 16 else self._float(text), at
            )
        if first == '"':
            return LiteralConstant(self.text(), at)
        if text in ("true", "false"):
            self.position += 1
            return LiteralConstant(text == "true", at)
        if text == "(":
            return self._parentheses()
        if text == "{":
            self.position += 1
            return self._array(at)
        if text == "[":
            self.position += 1
            return MatrixConstructor(self.matrix(), at)
        if text == "end":
            self.position += 1
            return EndSubscript(at)
        if text in CALLABLE:
            self.position += 1
            return self.call(DottedName((text,), {}, at))
        if text in KEYWORDS or not text:
            raise self.wrong(f"an expression expected, {self.found} found")
        name = self.reference()
        return self.call(name) if self.texts[self.position] == "(" else name

    def _float(self, text: str) -> float:
        value = float(text)
        if not math.isfinite(value):
            self.position -= 1
            raise self.wrong("not a finite number")
        return value

    def text(self) -> str:
        """Read a text in quotes."""
        token = self.texts[self.position]
        if token[:1] != '"':
            raise self.wrong(f"a text expected, {self.found} found")
        self.position += 1
        if "\\" not in token:
            return token[1:-1]
        parts = token[1:-1].split("\\")
        found, i = parts[0], 1
        while i < len(parts):
            part = parts[i]
            if part:
                found += ESCAPES.get(part[0], part[0]) + part[1:]
            elif i + 1 < len(parts):
                i += 1
                found += "\\" + parts[i]
            i += 1
        return found

    def reference(self, subscripted: bool = True) -> DottedName:
        """``a.b[2].c``, perhaps with subscripts; a leading dot is kept as an empty word."""
        at = self.at
        words: list[str] = [""] if self.accept(".") else []
        subscripts: dict[int, list[Expression]] = {}
        while True:
            words.append(self.identifier())
            if subscripted and self.texts[self.position] == "[":
                subscripts[len(words) - 1] = self.subscripts()
            if not self.accept("."):
                return DottedName(tuple(words), subscripts, at)

    def dotted(self) -> DottedName:
        """The name of a class."""
        return self.reference(subscripted=False)

    def subscripts(self) -> list[Expression]:
        """``[1, :, end]``."""
        self.take("[")
        found: list[Expression] = []
        while True:
            if self.peek == ":":
                found.append(Whole(self.at))
                self.position += 1
            else:
                found.append(self.expression())
            if not self.accept(","):
                break
        self.take("]")
        return found

    def call(self, function: DottedName, partial: bool = False) -> FunctionCall:
        """The arguments of a function whose name has been read."""
        self.deeper()
        self.take("(")
        given: list[Expression] = []
        named: dict[str, Expression] = {}
        while self.peek != ")":
            texts, here = self.texts, self.position
            if texts[here + 1] == "=" and texts[here] not in KEYWORDS:
                name = self.identifier()
                if name in named:
                    self.position = here
                    raise self.wrong(f"'{name}' is given twice")
                self.position += 1
                named[name] = self._argument()
            elif named:
                raise self.wrong("arguments with names stand behind all others")
            else:
                value = self._argument()
                given.append(self._comprehension(value) if self.peek == "for" else value)
            if not self.accept(","):
                break
        self.take(")")
        self.depth -= 1
        return FunctionCall(function, given, named, function.at, partial)

    def _argument(self) -> Expression:
        if self.accept("function"):
            return self.call(self.dotted(), partial=True)
        return self.expression()

    def _comprehension(self, value: Expression) -> Expression:
        at = self.at
        self.take("for")
        return Comprehension(value, self.iterators(), at)

    def iterators(self) -> list[tuple[str, Expression | None]]:
        """``i in 1:n, j``."""
        found: list[tuple[str, Expression | None]] = []
        while True:
            name = self.identifier()
            found.append((name, self.expression() if self.accept("in") else None))
            if not self.accept(","):
                return found

    def _parentheses(self) -> Expression:
        at = self.at
        self.take("(")
        items: list[Expression | None] = []
        several = False
        while True:
            items.append(None if self.peek in (",", ")") else self.expression())
            if not self.accept(","):
                break
            several = True
        self.take(")")
        if several or items == [None]:
            return Several(items, at)
        assert items[0] is not None
        return items[0]

    def _array(self, at: int) -> Expression:
        if self.accept("}"):
            return ArrayConstructor([], at)
        items = [self._argument()]
        if self.peek == "for":
            value = self._comprehension(items[0])
            self.take("}")
            return value
        while self.accept(","):
            items.append(self._argument())
        self.take("}")
        return ArrayConstructor(items, at)
