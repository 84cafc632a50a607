"""Equations of sympy as Modelica text."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational
from sympy.printing.str import StrPrinter

from acausal.errors import ModelError
from acausal.export.modelica_text.discrete import cases, is_discrete, is_whole
from acausal.export.modelica_text.spelling import array as array_text, number, text as quoted
from acausal.modeling import (
    HALF,
    INITIAL,
    Assert,
    Eq,
    Floored,
    Parameter,
    Reference,
    Reinit,
    Tick,
    When,
    element_names,
    time,
)

FUNCTIONS = {
    "Abs": "abs", "acos": "acos", "asin": "asin", "atan": "atan", "atan2": "atan2", "cos": "cos", "cosh": "cosh",
    "der": "der", "exp": "exp", "log": "log", "sign": "sign", "sin": "sin", "sinh": "sinh", "tan": "tan",
    "tanh": "tanh",
}  # fmt: skip
"""Functions of Modelica by their names in equations."""


@dataclass(frozen=True)
class Names:
    """What a class calls things; each that has no name yet gets one, with its equations.

    Attributes:
        reference: the text of a reference. call: of a network that is applied, by the printer of its arguments.
        variable: of a variable that equals a text. tick: of the condition that is true at some instants only.
    """

    reference: Callable[[Any], str]
    call: Callable[[Any, Callable[[Any], str]], str]
    variable: Callable[[str], str]
    tick: Callable[[Tick], str]


class Printer(StrPrinter):
    """Prints expressions for one class."""

    printmethod = "_modelica"  # that of `str` would print names within their own components

    def __init__(self, names: Names) -> None:
        super().__init__({"order": "none"})
        self.names = names

    def literally(self, text: str) -> str:
        """Something whose conditions are no events."""
        return f"noEvent({text})"

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
            case Tick() | sp.Symbol(name=INITIAL.name):
                return self.condition(sp.Gt(expression, HALF))
            case _ if expression.func is sp.ITE:
                first, yes, no = map(self.condition, expression.args)
                return f"(if {first} then {yes} else {no})"
            case _:
                return f"({self.print(expression)} > 0.5)"

    def _relation(self, relation: Any) -> str:
        left, right = relation.args
        if right in (HALF, 0.5) and (left == INITIAL or isinstance(left, Tick)):
            happens = "initial()" if left == INITIAL else self.names.tick(left)
            return happens if isinstance(relation, sp.Gt | sp.Ge) else f"not {happens}"
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
        return self.names.reference(expr)

    def _print_Previous(self, expr: Any) -> str:
        return f"pre({self.names.reference(expr.reference)})"

    def _print_Tick(self, expr: Any) -> str:
        return f"(if {self.condition(sp.Gt(expr, HALF))} then 1 else 0)"

    def _print_Symbol(self, expr: Any) -> str:
        return self._print_Tick(expr) if expr == INITIAL else str(expr.name)

    def _print_ModuleCall(self, expr: Any) -> str:
        return self.names.call(expr, self.print)

    def _print_Prescribed(self, expr: Any) -> str:
        return self.print(expr.args[2 + int(expr.args[0])])

    def _print_Watched(self, expr: Any) -> str:
        condition, value, otherwise, _ = expr.args
        text = (
            f"if {self.condition(condition)} then {self.print(value)} else {self.print(otherwise)}"
        )
        changes = all(is_whole(s) for s in condition.free_symbols)  # at events of others only
        return self.literally(text) if changes else f"({text})"

    def _print_Piecewise(self, expr: Any) -> str:
        *cases, (last, always) = expr.args
        if always != sp.true:
            raise ModelError(
                "export.modelica: a case distinction has no last case; give where(...) all values"
            )
        chain = "".join(
            f"if {self.condition(holds)} then {self.print(value)} else " for value, holds in cases
        )
        return self.literally(f"{chain}{self.print(last)}") if cases else self.print(last)

    def _print_floor(self, expr: Any) -> str:
        return self.literally(f"floor({self.print(expr.args[0])})")

    def _print_Floored(self, expr: Any) -> str:
        return f"floor({self.print(expr.args[0])})"

    def _print_ceiling(self, expr: Any) -> str:
        return self.literally(f"ceil({self.print(expr.args[0])})")

    def _print_Function(self, expr: Any) -> str:
        name = FUNCTIONS.get(type(expr).__name__)
        if name is None:
            return self.emptyPrinter(expr)
        if name == "der" and not expr.args[0].is_Symbol:
            found = _by_chain_rule(expr.args[0], expr.func)
            if found is not None:
                return f"({self.print(found)})"
            return f"der({self.names.variable(self.print(expr.args[0]))})"
        return f"{name}({', '.join(self.print(a) for a in expr.args)})"

    _print_Abs = _print_sign = _print_Function

    def _print_asinh(self, expr: Any) -> str:
        (x,) = expr.args
        return f"log({self.print(x)} + sqrt(({self.print(x)})^2 + 1))"

    def _print_Mod(self, expr: Any) -> str:
        first, second = map(self.print, expr.args)
        return self.literally(f"mod({first}, {second})")

    def _print_Max(self, expr: Any) -> str:
        """One within the other: Modelica's functions take two arguments."""
        function = "max" if isinstance(expr, sp.Max) else "min"
        *others, found = sorted(map(self.print, expr.args))
        for text in reversed(others):
            found = f"{function}({text}, {found})"
        return found

    _print_Min = _print_Max

    def _print_Heaviside(self, expr: Any) -> str:
        return self.literally(f"if {self.print(expr.args[0])} > 0 then 1 else 0")

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

    def _print_Float(self, expr: Any) -> str:
        return number(expr) if abs(float(expr)) < 1e15 else repr(float(expr))


class AtEvents(Printer):
    """Prints what is evaluated at events, where every condition is one."""

    def literally(self, text: str) -> str:
        """In parentheses, if need be."""
        return f"({text})" if text.startswith("if ") else text

    def whole(self, expression: Any) -> str:
        """The text of an Integer, rounded branch by branch where it is real."""
        if is_whole(expression):
            return self.print(expression)
        if isinstance(expression, sp.floor | Floored):
            return f"integer({self.print(expression.args[0])})"
        pairs, otherwise = cases(expression)
        if not pairs:
            return f"integer({self.print(expression)} + 0.5)"
        chain = "".join(
            f"if {self.condition(holds)} then {self.whole(value)} else " for holds, value in pairs
        )
        return f"({chain}{self.whole(otherwise)})"

    def value(self, variable: Any, expression: Any) -> str:
        """The text of what a variable becomes."""
        whole = is_discrete(variable, "int", "bool")
        return self.whole(expression) if whole else self.print(expression)


def equation(names: Names, stated: Any, indent: str) -> list[str]:
    """The lines of an equation, or of what happens at an event."""
    match stated:
        case Eq() if is_discrete(stated.lhs):
            value = AtEvents(names).value(stated.lhs, stated.rhs)
            return [f"{indent}{names.reference(stated.lhs)} = {value};"]
        case Eq():
            left, right = map(Printer(names).print, (stated.lhs, stated.rhs))
            if not stated.lhs.is_Symbol and any(map(is_whole, stated.lhs.free_symbols)):
                return [
                    f"{indent}0 = {right} - ({left});"
                ]  # rumoca would solve it for what is discrete
            return [f"{indent}{left} = {right};"]
        case When():
            return _when(names, stated, indent)
        case Assert():
            holds, level = Printer(names).condition(stated.condition), stated.level
            also = f", AssertionLevel.{level}" if level != "error" else ""
            return [f"{indent}assert({holds}, {quoted(stated.text)}{also});"]
        case _:
            raise ModelError(f"export.modelica: {type(stated).__name__} is no equation")


def _when(names: Names, stated: When, indent: str) -> list[str]:
    """All branches assign the same variables (Modelica 3.6, section 8.3.5)."""
    printer, lines = AtEvents(names), list[str]()
    every = {s.lhs: None for link in stated.chain() for s in link.statements if isinstance(s, Eq)}
    for link in stated.chain():
        texts = [
            t for given in link.conditions for c in instants(given) for t in _comes(printer, c)
        ]
        either = texts[0] if len(texts) == 1 else "{" + ", ".join(texts) + "}"
        lines.append(f"{indent}{'elsewhen' if lines else 'when'} {either} then")
        becomes = {v: f"pre({names.reference(v)})" for v in every}
        for statement in link.statements:
            if isinstance(statement, Reinit):
                state, value = names.reference(statement.state), printer.print(statement.value)
                lines.append(f"{indent}  reinit({state}, {value});")
            else:
                becomes[statement.lhs] = printer.value(statement.lhs, statement.rhs)
        lines += [f"{indent}  {name} = {text};" for name, text in _arrays(names, becomes).items()]
    return [*lines, f"{indent}end when;"]


def instants(condition: Any) -> tuple[Any, ...]:
    """The parts of a condition that are joined by "or", if one of them is true at instants only."""
    return condition.args if isinstance(condition, sp.Or) and condition.has(Tick) else (condition,)


def _comes(printer: Printer, condition: Any) -> list[str]:
    """The text of a condition of a when-clause; of a counted instant another one, which is true at the start."""
    text = printer.condition(condition)
    if not condition.has(Tick) or text.startswith("sample("):
        return [text]
    start = printer.print(next(iter(condition.atoms(Tick))).start)
    return [text, f"initial() and time >= {start} and time <= {start}"]


def _arrays(names: Names, texts: Mapping[Any, str]) -> dict[str, str]:
    """What variables become, by name: an array as a whole where all of its elements are there, else by element."""
    found = {names.reference(variable): text for variable, text in texts.items()}
    for variable in texts:
        array, _, _ = names.reference(variable).rpartition("[")
        local, _, _ = variable.path.rpartition("[")
        shape = variable.owner.shape(local, variable.declaration) if local else None
        elements = element_names(array, shape)
        if shape and found.keys() >= set(elements):
            whole = np.reshape([found.pop(element) for element in elements], shape)
            found[array] = array_text(whole, str)
    return found


def _by_chain_rule(expr: sp.Expr, der: Any) -> sp.Expr | None:
    """The derivative of an expression by those of its variables, which stay states; None where it has no formula."""
    if expr.atoms(sp.Piecewise, sp.core.function.AppliedUndef):
        return None
    varying = [
        s
        for s in sorted(expr.free_symbols, key=str)
        if not (isinstance(s, Reference) and isinstance(s.declaration, Parameter))
    ]
    partial = {s: sp.diff(expr, s) for s in varying}
    if any(p.has(sp.Derivative, sp.Subs, sp.DiracDelta) for p in partial.values()):
        return None
    return sp.Add(*(p * (1 if s is time else der(s)) for s, p in partial.items()))
