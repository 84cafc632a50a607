"""Expressions as text that `acausal.netlist.parser.parse` reads back to the same numbers."""

from __future__ import annotations

from typing import Any

import sympy as sp
from sympy.printing.str import StrPrinter

from acausal.errors import DeclarationError
from acausal.netlist.vocabulary import FUNCTIONS

NAMES = {"Abs": "abs", "Max": "max", "Min": "min"}


def written(expression: sp.Basic) -> str:
    """The text of an expression whose symbols bear the names to write.

    Raises:
        DeclarationError: for a function that a file cannot hold.
    """
    return _Printer({"order": "none"}).doprint(expression)


class _Printer(StrPrinter):
    """Modelica's spelling, and numbers in full."""

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        if expr.exp == sp.S.Half:
            return f"sqrt({self._print(expr.base)})"
        if expr.exp.is_number and expr.exp.is_negative and not rational:
            inverse = 1 / expr
            text = self._print(inverse)
            plain = inverse.is_Symbol or text.startswith("sqrt(")
            return f"1/{text}" if plain else f"1/({text})"
        base, exponent = (self.parenthesize(p, 1000, strict=True) for p in (expr.base, expr.exp))
        return f"{base}^{exponent}"

    def _print_Float(self, expr: sp.Float) -> str:
        return repr(float(expr))

    def _print_Exp1(self, expr: Any) -> Any:
        return "exp(1)"

    def _print_Function(self, expr: sp.Function) -> str:
        name = type(expr).__name__
        name = NAMES.get(name, name)
        if name not in FUNCTIONS:
            raise DeclarationError(
                f"a file cannot hold the function {name}; expressions know {', '.join(FUNCTIONS)}"
            )
        return f"{name}({', '.join(self._print(a) for a in expr.args)})"

    _print_Abs = _print_Max = _print_Min = _print_floor = _print_Function

    def _print_Piecewise(self, expr: sp.Piecewise) -> str:
        pieces: list[Any] = list(expr.args)
        last, condition = pieces.pop()
        if condition != sp.true:
            raise DeclarationError(
                "a file cannot hold an expression that is defined piece by piece with gaps"
            )
        text = "".join(f"if {self._print(c)} then {self._print(v)} else " for v, c in pieces)
        return f"({text}{self._print(last)})"

    def _print_Relational(self, expr: Any) -> str:
        sign = {"==": "==", "!=": "<>"}.get(expr.rel_op, expr.rel_op)
        return f"({self._print(expr.lhs)} {sign} {self._print(expr.rhs)})"

    def _print_And(self, expr: Any) -> str:
        return f"({' and '.join(self._print(a) for a in expr.args)})"

    def _print_Or(self, expr: Any) -> str:
        return f"({' or '.join(self._print(a) for a in expr.args)})"

    def _print_ITE(self, expr: Any) -> str:
        condition, yes, no = expr.args
        return self._print(sp.Or(sp.And(condition, yes), sp.And(sp.Not(condition), no)))

    def _print_BooleanTrue(self, expr: Any) -> Any:
        return "true"

    def _print_BooleanFalse(self, expr: Any) -> Any:
        return "false"

    def _print_Not(self, expr: Any) -> str:
        return f"(not {self._print(expr.args[0])})"
