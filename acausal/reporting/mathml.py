"""Equations as MathML, which browsers draw without help: short names with subscripts, dots for time derivatives."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp
from sympy.printing.latex import LatexPrinter
from sympy.printing.mathml import MathMLPresentationPrinter

from acausal.reporting.short_names import Short

INVISIBLE_TIMES, FUNCTION_APPLICATION = "\u2062", "\u2061"
DOT = "\u2022"  # browsers without a mathematical font hardly show smaller ones


def mathml(equation: Any, names: Mapping[str, Short]) -> str:
    """An equation as a ``<math>`` element.

    Arguments:
        equation: of sympy.
        names: how symbols and functions are written; others as they are called.
    """
    printed: Any = _MathML(names)._print(equation)
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">{_written(printed)}</math>'


def name_as_mathml(short: Short) -> str:
    """One name as a ``<math>`` element within a line."""
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML">{_written(_MathML({}).short(short))}</math>'


def _written(element: Any) -> str:
    """With minus signs in the place of hyphens."""
    return str(element.toxml()).replace("<mo>-</mo>", "<mo>\u2212</mo>")


def latex(expression: Any, names: Mapping[str, Short]) -> str:
    """An expression as LaTeX; arguments as for `mathml`."""
    return str(_Latex(names).doprint(expression))


def names_in(equations: Iterable[sp.Equality]) -> list[str]:
    """Names of symbols and functions in equations, in order."""
    found: dict[str, None] = {}
    for equation in equations:
        symbols: Any = equation.free_symbols
        functions: Any = equation.atoms(sp.core.function.AppliedUndef)  # pyright: ignore[reportAttributeAccessIssue]
        names = {s.name for s in symbols} | {f.func.__name__ for f in functions}
        found |= dict.fromkeys(sorted(names))
    return list(found)


class _MathML(MathMLPresentationPrinter):
    """MathML with short names, and time derivatives as Newton's dots."""

    dom: Any

    def __init__(self, names: Mapping[str, Short]) -> None:
        super().__init__({"mul_symbol": INVISIBLE_TIMES})
        self.names = names

    def short(self, short: Short) -> Any:
        base = self._of("mi", short.base)
        if short.dots:
            dots = self._of("mtext", DOT * short.dots)
            dots.setAttribute("mathsize", "70%")
            base = self._of("mover", base, dots)
        if short.primes:
            base = self._of("msup", base, self._of("mo", short.primes.replace("'", "\u2032")))
        if not short.subscript:
            return base
        return self._of("msub", base, self._of("mtext", short.subscript))

    def _print_Symbol(self, sym: sp.Symbol, style: str = "plain") -> Any:
        return self.short(self.names.get(sym.name) or Short.of(sym.name))

    def _print_Derivative(self, e: sp.Derivative) -> Any:
        state: Any = e.expr
        return self.short((self.names.get(state.name) or Short.of(state.name)).differentiated())

    def _print_AppliedUndef(self, e: Any) -> Any:
        name = e.func.__name__
        row = self._of("mrow", self.short(self.names.get(name) or Short.of(name)))
        row.appendChild(self._of("mo", FUNCTION_APPLICATION))
        row.appendChild(self._of("mo", "("))
        for i, argument in enumerate(e.args):
            if i:
                row.appendChild(self._of("mo", ","))
            row.appendChild(self._print(argument))
        row.appendChild(self._of("mo", ")"))
        return row

    def _of(self, tag: str, *content: Any) -> Any:
        element = self.dom.createElement(tag)
        for one in content:
            element.appendChild(self.dom.createTextNode(one) if isinstance(one, str) else one)
        return element


class _Latex(LatexPrinter):
    """LaTeX with short names, and time derivatives as Newton's dots."""

    def __init__(self, names: Mapping[str, Short]) -> None:
        super().__init__()
        self.names = names

    def _print_Symbol(self, expr: sp.Symbol, style: str = "plain") -> str:
        return (self.names.get(expr.name) or Short.of(expr.name)).latex

    def _print_Derivative(self, expr: sp.Derivative) -> str:
        state: Any = expr.expr
        return (self.names.get(state.name) or Short.of(state.name)).differentiated().latex

    def _print_AppliedUndef(self, expr: Any) -> str:
        name = expr.func.__name__
        written = ", ".join(str(self._print(a)) for a in expr.args)
        return rf"{(self.names.get(name) or Short.of(name)).latex}\left({written}\right)"
