"""What an author wrote, as text: expressions, defaults, and declarations with the arguments that were given."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from functools import cache
from typing import Any

import sympy as sp
from sympy.printing.str import StrPrinter

from acausal.errors import shortened


def as_written(expression: object) -> str:
    """The text of an expression or a condition, for messages and pages."""
    return _AsWritten().doprint(expression)


class _AsWritten(StrPrinter):
    """A signal counts as true above 1/2, and whole numbers are equal if they differ by less."""

    def _print_Relational(self, expr: Any) -> str:
        if _is_flag(expr):
            text = self.parenthesize(expr.lhs, 1000, strict=True)
            return text if isinstance(expr, sp.Gt) else f"~{text}"
        whole = isinstance(expr, sp.Lt | sp.Ge) and isinstance(expr.lhs, sp.Abs)
        if expr.rhs is not sp.S.Half or not whole:
            return super()._print_Relational(expr)
        difference: Any = expr.lhs.args[0]
        terms = sp.Add.make_args(difference)
        right = sp.Add(*(-term for term in terms if term.could_extract_minus_sign()))
        sign = "==" if isinstance(expr, sp.Lt) else "!="
        return f"{self._print(difference + right)} {sign} {self._print(right)}"

    def _print_And(self, expr: Any) -> str:
        texts = set(map(self._inner, expr.args))
        edges = {text for text in texts if f"~pre({text})" in texts}
        kept = texts - edges - {f"~pre({text})" for text in edges}
        return " & ".join(sorted({*kept, *(f"edge({text})" for text in edges)}))

    def _print_Or(self, expr: Any) -> str:
        return " | ".join(sorted(map(self._inner, expr.args)))

    def _inner(self, condition: sp.Basic) -> str:
        """A condition among others."""
        text = self._print(condition)
        alone = condition.is_Symbol or isinstance(condition, sp.Not) or _is_flag(condition)
        return text if alone else f"({text})"

    def _print_Piecewise(self, expr: Any) -> str:
        *pieces, (last, condition) = expr.args
        if condition is not sp.true:
            return self._print_Function(expr)
        cases = "".join(f"where({self._print(c)}, {self._print(v)}, " for v, c in pieces)
        return f"{cases}{self._print(last)}{')' * len(pieces)}"


def _is_flag(condition: Any) -> bool:
    """Whether a condition is that a signal is true, or that it is not."""
    is_limit = isinstance(condition, sp.Gt | sp.Le) and condition.rhs is sp.S.Half
    return is_limit and condition.lhs.is_Symbol


def default_text(default: Any) -> str:
    """A default as its author would write it; that of a function of the component is its formula."""
    if not callable(default) or isinstance(default, type):
        return shortened(" ".join(repr(default).split()))
    try:
        return shortened(default(_Names()))
    except Exception:  # any function of a user: one that needs more than names has no formula
        return "..."


class _Names:
    """A stand-in for a component, whose parameters are symbols."""

    def __getattr__(self, name: str) -> sp.Symbol:
        if name.startswith("_"):
            raise AttributeError(name)
        return sp.Symbol(name)


def call_text(made: object) -> str:
    """How an object is made, for its ``repr``: its class, and the arguments that differ from their defaults.

    Every argument must have an attribute of the same name.
    """
    given: list[str] = []
    for i, (name, kind, default) in enumerate(_arguments(type(made))):
        value = getattr(made, name, default)
        if (text := default_text(value)) != default_text(default):
            given.append(f"{name}={text}" if i or kind is inspect.Parameter.KEYWORD_ONLY else text)
    return f"{type(made).__name__}({', '.join(given)})"


@cache
def _arguments(cls: type) -> tuple[tuple[str, Any, Any], ...]:
    """Name, kind and default of the arguments of a class; where it passes others on, its base's follow."""
    return tuple(_walk(cls, set()))


def _walk(cls: type, seen: set[str]) -> Iterator[tuple[str, Any, Any]]:
    passes_on = False
    for parameter in list(inspect.signature(cls.__init__).parameters.values())[1:]:
        if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL):
            passes_on = True
        elif parameter.name not in seen:
            seen.add(parameter.name)
            yield parameter.name, parameter.kind, parameter.default
    if passes_on:
        yield from _walk(cls.__mro__[1], seen)
