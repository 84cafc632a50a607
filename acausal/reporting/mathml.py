"""Equations as MathML, which browsers draw without help, and as LaTeX; with names as an engineer writes them."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable, Mapping
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.latex import LatexPrinter
from sympy.printing.mathml import MathMLPresentationPrinter

from acausal.modeling import ModuleCall, der, primes
from acausal.reporting.short_names import Short

INVISIBLE_TIMES, FUNCTION_APPLICATION = "\u2062", "\u2061"
DOT = "\u2022"  # browsers without a mathematical font hardly show smaller ones

DIGITS = 6
"""Significant digits of numbers."""

Naming = Callable[[str], Short]
"""How a name of a symbol or a function is written."""


def named(names: Mapping[str, Short]) -> Naming:
    """Some names as they are given, others as they are."""
    return lambda name: names.get(name) or Short.of(name)


def mathml(lhs: Any, rhs: Any, naming: Naming) -> str:
    """An equation between two expressions of sympy as a ``<math>`` element."""
    printer = _MathML(naming)
    sides = [printer._print(_readable(side)) for side in (lhs, rhs)]
    row = printer.of("mrow", sides[0], printer.of("mo", "="), sides[1])
    return (
        f'<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">{_written(row)}</math>'
    )


def name_as_mathml(short: Short) -> str:
    """One name as a ``<math>`` element within a line."""
    element = _MathML(Short.of).short(short)
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML">{_written(element)}</math>'


def _written(element: Any) -> str:
    """With minus signs in the place of hyphens."""
    return str(element.toxml()).replace("<mo>-</mo>", "<mo>\u2212</mo>")


def _readable(expression: Any) -> Any:
    """Floats with a few digits, and whole ones without a point."""
    shorter = {
        f: sp.Integer(int(f)) if f == int(f) and abs(f) < 1e6 else sp.Float(f, DIGITS)
        for f in expression.atoms(sp.Float)
    }
    return expression.xreplace(shorter) if shorter else expression


def latex(expression: Any, naming: Naming) -> str:
    """An expression as LaTeX."""
    return str(_Latex(naming).doprint(expression))


def name_of(symbol: Any) -> str:
    """The name of a symbol; of a reference, that within its component."""
    return getattr(symbol, "path", symbol.name)


def names_in(equations: Iterable[tuple[Any, Any]]) -> list[str]:
    """Names of symbols and functions in equations, pairs of expressions, in order."""
    found: dict[str, None] = {}
    for sides in equations:
        names = {name_of(symbol) for side in sides for symbol in side.free_symbols}
        names |= {f.func.__name__ for side in sides for f in side.atoms(AppliedUndef)}
        found |= dict.fromkeys(sorted(names))
    return list(found)


class _MathML(MathMLPresentationPrinter):
    """Names with indices, time derivatives as Newton's dots, networks as functions."""

    dom: Any

    def __init__(self, naming: Naming) -> None:
        super().__init__({"mul_symbol": INVISIBLE_TIMES})
        self.naming = naming

    def of(self, tag: str, *content: Any) -> Any:
        element = self.dom.createElement(tag)
        for one in content:  # sympy writes a text as it is
            is_text = isinstance(one, str)
            element.appendChild(self.dom.createTextNode(html.escape(one)) if is_text else one)
        return element

    def short(self, short: Short) -> Any:
        base = self.of("mi", short.base)
        if short.dots:
            dots = self.of("mtext", DOT * short.dots)
            dots.setAttribute("mathsize", "70%")
            base = self.of("mover", base, dots)
        if short.primes:
            base = self.of("msup", base, self.of("mo", short.primes.replace("'", "\u2032")))
        if not short.subscript:
            return base
        return self.of("msub", base, self.of("mtext", short.subscript))

    def _print_Symbol(self, sym: Any, style: str = "plain") -> Any:
        return self.short(self.naming(name_of(sym)))

    def _print_Derivative(self, e: Any) -> Any:
        return self._derivative(e.expr)

    def _derivative(self, inner: Any) -> Any:
        if inner.is_Symbol:
            return self.short(self.naming(name_of(inner)).differentiated())
        return self._called(self.of("mi", "der"), (inner,))

    def _called(self, head: Any, arguments: Iterable[Any]) -> Any:
        row = self.of("mrow", head, self.of("mo", FUNCTION_APPLICATION), self.of("mo", "("))
        for i, argument in enumerate(arguments):
            if i:
                row.appendChild(self.of("mo", ","))
            row.appendChild(self._print(argument))
        row.appendChild(self.of("mo", ")"))
        return row

    def _print_Function(self, e: Any) -> Any:
        match e:
            case der():
                return self._derivative(e.args[0])
            case ModuleCall():
                module, orders, *arguments = cast(tuple[Any, ...], e.args)
                name = getattr(module, "path", str(module)) + primes(orders)
                return self._called(self.short(self.naming(name)), arguments)
            case _ if isinstance(e, AppliedUndef) or type(e).__module__.startswith("acausal"):
                return self._called(self.short(self.naming(e.func.__name__)), e.args)
            case _:
                return super()._print_Function(e)

    _print_AppliedUndef = _print_Function


class _Latex(LatexPrinter):
    """LaTeX with short names, and time derivatives as Newton's dots."""

    def __init__(self, naming: Naming) -> None:
        super().__init__()
        self.naming = naming

    def _print_Symbol(self, expr: sp.Symbol, style: str = "plain") -> str:
        return self.naming(expr.name).latex

    def _print_Derivative(self, expr: sp.Derivative) -> str:
        state: Any = expr.expr
        return self.naming(state.name).differentiated().latex

    def _print_AppliedUndef(self, expr: Any) -> str:
        written = ", ".join(str(self._print(a)) for a in expr.args)
        return rf"{self.naming(expr.func.__name__).latex}\left({written}\right)"
