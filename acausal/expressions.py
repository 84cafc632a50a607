"""A small, safe parser for expressions in files: numbers, names, arithmetic and a few functions, as in Modelica.

Nothing is evaluated as Python. Names are looked up by the caller, so that an expression reaches only what the
caller hands out.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

import sympy as sp
from sympy.printing.str import StrPrinter

from acausal import functions
from acausal.errors import DeclarationError, nearest
from acausal.symbols import der

MAX_LENGTH = 10_000
MAX_DEPTH = 60

TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<name>[A-Za-z_]\w*(?:\[\d+(?:,\s*\d+)*\])?(?:\.[A-Za-z_]\w*(?:\[\d+(?:,\s*\d+)*\])?)*)"
    r"|(?P<op>[-+*/^(){},=]))"
)

CONSTANTS: dict[str, float] = {
    "pi": math.pi,
    "e": math.e,
    "g_n": 9.80665,
    "sigma": 5.670374419e-8,
    "mu_0": 4e-7 * math.pi,
    "eps_0": 8.8541878128e-12,
    "T_zero": -273.15,
    "R": 8.31446261815324,
    "k": 1.380649e-23,
    "q": 1.602176634e-19,
    "c": 299792458.0,
    "inf": 1e60,
    "eps": 2.220446049250313e-16,
    "small": 1e-60,
}
"""Of `Modelica.Constants`; the bare names ``pi`` and ``e`` are known too."""

FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sqrt": sp.sqrt, "exp": sp.exp, "log": sp.log, "log10": lambda x: sp.log(x) / sp.log(10),
    "sin": sp.sin, "cos": sp.cos, "tan": sp.tan, "asin": sp.asin, "acos": sp.acos, "atan": sp.atan,
    "atan2": sp.atan2, "sinh": sp.sinh, "cosh": sp.cosh, "tanh": sp.tanh,
    "abs": sp.Abs, "sign": sp.sign, "min": sp.Min, "max": sp.Max, "floor": functions.floor, "der": der,
}  # fmt: skip

Lookup = Callable[[str], Any]


class ExpressionError(DeclarationError):
    """An expression in a file is malformed; the message holds the expression and the place in it."""


def parse(text: str, lookup: Lookup) -> Any:
    """The value of an expression: a number, a sympy expression, whatever `lookup` gave, or a list of these.

    Arguments:
        lookup: from a dotted name to its value; it raises KeyError for a name it does not know.

    Raises:
        ExpressionError: one sentence that says where the expression is wrong.
    """
    reader = _Reader(text, lookup)
    value = reader.sum()
    reader.expect_end()
    return value


def parse_equation(text: str, lookup: Lookup) -> tuple[Any, Any]:
    """Both sides of ``lhs = rhs``.

    Raises:
        ExpressionError: one sentence that says where the equation is wrong.
    """
    reader = _Reader(text, lookup)
    left = reader.sum()
    reader.take("=")
    right = reader.sum()
    reader.expect_end()
    return left, right


class _Reader:
    """Recursive descent over the tokens of one text."""

    def __init__(self, text: str, lookup: Lookup) -> None:
        if len(text) > MAX_LENGTH:
            raise ExpressionError(
                f"an expression of {len(text)} characters; at most {MAX_LENGTH} are read"
            )
        self.text, self.lookup = text, lookup
        self.tokens = self._tokens()
        self.position = 0
        self.depth = 0

    def _tokens(self) -> list[tuple[str, str]]:
        found: list[tuple[str, str]] = []
        at, text = 0, self.text.rstrip()
        while at < len(text):
            match = TOKEN.match(text, at)
            if match is None:
                raise ExpressionError(
                    f"'{_short(self.text)}': '{text[at:].strip()[:1]}' is not allowed; "
                    "numbers, names, + - * / ^ and parentheses are"
                )
            found.append((str(match.lastgroup), match[str(match.lastgroup)]))
            at = match.end()
        return found

    def sum(self) -> Any:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise ExpressionError(f"'{_short(self.text)}' is nested more than {MAX_DEPTH} deep")
        value = self._signed_product()
        while self._peek() in ("+", "-"):
            operator = self._next()
            other = self._product()
            value = self._arithmetic(operator, value, other)
        self.depth -= 1
        return value

    def take(self, operator: str) -> None:
        """Read one operator."""
        if self._peek() != operator:
            found = f"'{self._peek()}'" if self._peek() else "the end"
            raise ExpressionError(f"'{_short(self.text)}': '{operator}' expected, {found} found")
        self.position += 1

    def expect_end(self) -> None:
        """Nothing may follow."""
        if self._peek():
            raise ExpressionError(f"'{_short(self.text)}': '{self._peek()}' is not expected there")

    def _signed_product(self) -> Any:
        if self._peek() in ("+", "-"):
            operator = self._next()
            return self._arithmetic(operator, 0, self._product())
        return self._product()

    def _product(self) -> Any:
        value = self._power()
        while self._peek() in ("*", "/"):
            operator = self._next()
            value = self._arithmetic(operator, value, self._power())
        return value

    def _power(self) -> Any:
        base = self._primary()
        if self._peek() != "^":
            return base
        self._next()
        exponent = (
            self._arithmetic(self._next(), 0, self._primary())
            if self._peek() in ("+", "-")
            else self._primary()
        )
        return self._arithmetic("^", base, exponent)

    def _primary(self) -> Any:
        kind, token = self.tokens[self.position] if self.position < len(self.tokens) else ("", "")
        self.position += 1
        if kind == "number":
            return _number(token, self.text)
        if kind == "name":
            return self._call(token) if self._peek() == "(" else self._name(token)
        if token == "(":
            value = self.sum()
            self.take(")")
            return value
        if token == "{":
            return self._until("}")
        raise ExpressionError(
            f"'{_short(self.text)}': a number or a name expected, {repr(token) if token else 'the end'} found"
        )

    def _name(self, name: str) -> Any:
        try:
            return self.lookup(name)
        except KeyError:
            pass
        constant = name.removeprefix("Modelica.Constants.")
        if constant in CONSTANTS and (constant != name or name in ("pi", "e")):
            return CONSTANTS[constant]
        if name in ("true", "false"):
            return name == "true"
        raise ExpressionError(f"'{_short(self.text)}': '{name}' is not known here")

    def _call(self, name: str) -> Any:
        self.take("(")
        arguments = self._until(")")
        bare = name.removeprefix("Modelica.Math.")
        if bare not in FUNCTIONS:
            try:
                return self.lookup(name + "()")
            except KeyError:
                raise ExpressionError(
                    f"'{_short(self.text)}': '{name}' cannot be called; {nearest(name, FUNCTIONS)}"
                ) from None
        try:
            return _finite(FUNCTIONS[bare](*(_expression(a) for a in arguments)), self.text)
        except (TypeError, ValueError):
            raise ExpressionError(
                f"'{_short(self.text)}': {name} does not take these arguments"
            ) from None

    def _until(self, closing: str) -> list[Any]:
        values: list[Any] = []
        if self._peek() != closing:
            values.append(self.sum())
            while self._peek() == ",":
                self._next()
                values.append(self.sum())
        self.take(closing)
        return values

    def _arithmetic(self, operator: str, a: Any, b: Any) -> Any:
        for value in (a, b):
            if not isinstance(value, int | float | sp.Expr) or isinstance(value, bool):
                raise ExpressionError(
                    f"'{_short(self.text)}': {value!r} is no number to reckon with"
                )
        try:
            match operator:
                case "+":
                    result = a + b
                case "-":
                    result = a - b if a != 0 else -b
                case "*":
                    result = a * b
                case "/":
                    result = a / b
                case _:
                    result = (
                        math.pow(a, b)
                        if isinstance(a, int | float) and isinstance(b, int | float)
                        else a**b
                    )
        except ZeroDivisionError:
            raise ExpressionError(f"'{_short(self.text)}' divides by zero") from None
        except (OverflowError, ValueError):
            raise ExpressionError(f"'{_short(self.text)}' is not a finite number") from None
        return _finite(result, self.text)

    def _peek(self) -> str:
        return self.tokens[self.position][1] if self.position < len(self.tokens) else ""

    def _next(self) -> str:
        self.position += 1
        return self.tokens[self.position - 1][1]


def _expression(value: Any) -> sp.Expr:
    if isinstance(value, sp.Expr):
        return value
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError
    return sp.Float(value)


def _number(token: str, text: str) -> int | float:
    value = float(token)
    if not math.isfinite(value):
        raise ExpressionError(f"'{_short(text)}' is not a finite number")
    return int(value) if token.isdigit() and value < 2**53 else value


def _finite(value: Any, text: str) -> Any:
    if isinstance(value, sp.Expr) and value.is_number:
        value = float(value) if value.is_real else math.nan
    if isinstance(value, float | int) and not math.isfinite(value):
        raise ExpressionError(f"'{_short(text)}' is not a finite number")
    return value


def _short(text: str) -> str:
    return text if len(text) <= 80 else text[:77] + "..."


def written(expression: sp.Expr) -> str:
    """An expression as a text that `parse` reads back."""
    return _Writer({"order": "none"}).doprint(expression)


class _Writer(StrPrinter):
    """Modelica's spelling: ``^`` for powers."""

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        if expr.exp == sp.S.Half:
            return f"sqrt({self._print(expr.base)})"
        base, exponent = (self.parenthesize(part, 1000, strict=False) for part in expr.as_base_exp())
        return f"{base}^{exponent}" if not exponent.startswith("-") else f"{base}^({exponent})"

    def _print_Abs(self, expr: sp.Abs) -> str:
        return f"abs({self._print(expr.args[0])})"
