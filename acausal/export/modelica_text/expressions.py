"""Equations of sympy as Modelica text."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp
from sympy.core.relational import Relational
from sympy.printing.str import StrPrinter

from acausal.errors import ModelError
from acausal.export.modelica_text.spelling import number
from acausal.modeling import HALF, INITIAL, Eq, Reinit, Tick, When

FUNCTIONS = {
    "Abs": "abs", "acos": "acos", "asin": "asin", "atan": "atan", "atan2": "atan2", "cos": "cos", "cosh": "cosh",
    "der": "der", "exp": "exp", "log": "log", "sign": "sign", "sin": "sin", "sinh": "sinh", "tan": "tan",
    "tanh": "tanh",
}  # fmt: skip
"""Functions of Modelica by their names in equations."""


class Printer(StrPrinter):
    """Prints expressions for one class.

    Arguments:
        name: the text of a reference. call: the text of a network that is applied.
    """

    printmethod = "_modelica"  # that of `str` would print names within their own components

    def __init__(
        self, name: Callable[[Any], str], call: Callable[[Any, Callable[[Any], str]], str]
    ) -> None:
        super().__init__({"order": "none"})
        self.name, self.call = name, call

    def print(self, expression: Any) -> str:
        """The text of an expression; of a condition, that of a number."""
        if isinstance(expression, sp.logic.boolalg.Boolean) and not expression.is_Symbol:
            return f"(if {self.condition(expression)} then 1 else 0)"
        return str(self._print(expression))

    def condition(self, expression: Any) -> str:
        """The text of a condition."""
        match expression:
            case sp.logic.boolalg.BooleanTrue():
                return "true"
            case sp.logic.boolalg.BooleanFalse():
                return "false"
            case sp.And() | sp.Or():
                word = " and " if isinstance(expression, sp.And) else " or "
                return f"({word.join(sorted(map(self.condition, expression.args)))})"
            case sp.Not():
                return f"not ({self.condition(expression.args[0])})"
            case Relational():
                return self._relation(expression)
            case _ if expression.func is sp.ITE:
                first, yes, no = map(self.condition, expression.args)
                return f"(if {first} then {yes} else {no})"
            case _:
                return f"({self.print(expression)} > 0.5)"

    def _relation(self, relation: Any) -> str:
        left, right = relation.args
        if right == HALF and (left is INITIAL or isinstance(left, Tick)):
            raised = isinstance(relation, sp.Gt | sp.Ge)
            return self._print(left) if raised else f"not {self._print(left)}"
        truth = right == HALF and left.is_Symbol  # a number that is 1 or 0
        half = "0.5" if truth else self.print(right)
        first = self.print(left)
        match relation:
            case sp.Eq():
                return f"({first} >= {half} and {first} <= {half})"
            case sp.Ne():
                return f"({first} < {half} or {first} > {half})"
            case _:
                return f"({first} {relation.rel_op} {half})"

    # -- called by sympy, class by class -------------------------------------------------------------

    def emptyPrinter(self, expr: Any) -> str:
        """What has no rule is refused."""
        raise ModelError(
            f"export.modelica: '{type(expr).__name__}' has no counterpart in Modelica; "
            "use the functions that acausal exports"
        )

    def _print_Reference(self, expr: Any) -> str:
        return self.name(expr)

    def _print_Previous(self, expr: Any) -> str:
        return f"pre({self.name(expr.reference)})"

    def _print_Tick(self, expr: Any) -> str:
        return f"sample({self.print(expr.start)}, {self.print(expr.period)})"

    def _print_Symbol(self, expr: Any) -> str:
        return str(expr.name)

    def _print_ModuleCall(self, expr: Any) -> str:
        return self.call(expr, self.print)

    def _print_Prescribed(self, expr: Any) -> str:
        return self.print(expr.args[2 + int(expr.args[0])])

    def _print_Watched(self, expr: Any) -> str:
        condition, value, otherwise, _ = expr.args
        return f"(if {self.condition(condition)} then {self.print(value)} else {self.print(otherwise)})"

    def _print_Piecewise(self, expr: Any) -> str:
        *cases, (last, always) = expr.args
        if always != sp.true:
            raise ModelError(
                "export.modelica: a case distinction has no last case; give where(...) all values"
            )
        chain = "".join(
            f"if {self.condition(holds)} then {self.print(value)} else " for value, holds in cases
        )
        return f"noEvent({chain}{self.print(last)})" if cases else self.print(last)

    def _print_floor(self, expr: Any) -> str:
        return f"noEvent(floor({self.print(expr.args[0])}))"

    def _print_Floored(self, expr: Any) -> str:
        return f"floor({self.print(expr.args[0])})"

    def _print_ceiling(self, expr: Any) -> str:
        return f"noEvent(ceil({self.print(expr.args[0])}))"

    def _print_Function(self, expr: Any) -> str:
        name = FUNCTIONS.get(type(expr).__name__)
        if name is None:
            return self.emptyPrinter(expr)
        return f"{name}({', '.join(self.print(a) for a in expr.args)})"

    _print_Abs = _print_sign = _print_Function

    def _print_asinh(self, expr: Any) -> str:
        (x,) = expr.args
        return f"log({self.print(x)} + sqrt(({self.print(x)})^2 + 1))"

    def _print_Mod(self, expr: Any) -> str:
        first, second = map(self.print, expr.args)
        return f"noEvent(mod({first}, {second}))"

    def _print_Max(self, expr: Any) -> str:
        return self._nested("max", expr.args)

    def _print_Min(self, expr: Any) -> str:
        return self._nested("min", expr.args)

    def _nested(self, function: str, arguments: Any) -> str:
        *others, found = sorted(map(self.print, arguments))
        for text in reversed(others):
            found = f"{function}({text}, {found})"
        return found

    def _print_Heaviside(self, expr: Any) -> str:
        return f"noEvent(if {self.print(expr.args[0])} > 0 then 1 else 0)"

    def _print_Pow(self, expr: Any, rational: bool = False) -> str:
        base, exponent = expr.args
        if exponent == HALF:
            return f"sqrt({self.print(base)})"
        if exponent.is_number and exponent.is_negative and not rational:
            inverse = self.print(1 / expr)
            return f"1/({inverse})"
        power = [self.parenthesize(p, 1000, strict=True) for p in (base, exponent)]
        return "^".join(power)

    def _print_Exp1(self, expr: Any) -> Any:
        return "exp(1)"

    def _print_Pi(self, expr: Any) -> Any:
        return repr(float(sp.pi))

    def _print_Integer(self, expr: Any) -> str:
        return str(int(expr))

    def _print_Float(self, expr: Any) -> str:
        return number(expr) if abs(float(expr)) < 1e15 else repr(float(expr))

    def _print_Rational(self, expr: Any) -> str:
        return f"{expr.p}/{expr.q}"

    _print_Half = _print_Rational


def equation(printer: Printer, stated: Any, indent: str) -> list[str]:
    """The lines of an equation, or of what happens at an event."""
    match stated:
        case Eq():
            return [f"{indent}{printer.print(stated.lhs)} = {printer.print(stated.rhs)};"]
        case When():
            return _when(printer, stated, indent)
        case _:
            raise ModelError(f"export.modelica: {type(stated).__name__} is no equation")


def _when(printer: Printer, stated: When, indent: str) -> list[str]:
    lines: list[str] = []
    for link in stated.chain():
        conditions = list(map(printer.condition, link.conditions))
        either = conditions[0] if len(conditions) == 1 else "{" + ", ".join(conditions) + "}"
        lines.append(f"{indent}{'elsewhen' if lines else 'when'} {either} then")
        for statement in link.statements:
            if isinstance(statement, Reinit):
                jump = f"reinit({printer.name(statement.state)}, {printer.print(statement.value)})"
                lines.append(f"{indent}  {jump};")
            else:
                lines += equation(printer, statement, indent + "  ")
    return [*lines, f"{indent}end when;"]
