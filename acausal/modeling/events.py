"""The language of events: values before an event, conditions that are watched, and what happens when one comes true.

A condition is an expression of sympy's: a comparison, ``&``, ``|`` and ``~`` of others, or a variable that is 1 or 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import sympy as sp
from sympy.logic.boolalg import Boolean, BooleanAtom, BooleanFunction

from acausal.errors import DeclarationError, shown
from acausal.modeling.arrays import elementwise, is_array, pairs
from acausal.modeling.declarations import DependentParameter, Discrete, InitialParameter, Variable
from acausal.modeling.functions import Floored, floor
from acausal.modeling.symbols import (
    HALF,
    Compared,
    Eq,
    RealFunction,
    Reference,
    each,
    number_or_expression,
    time,
)
from acausal.modeling.written import as_written

INITIAL = sp.Symbol("initial()", real=True)
"""1 while initial values are being found, else 0."""


class Previous(Compared):
    """The value of a variable just before an event; between events its value."""

    reference: Reference

    def __new__(cls, reference: Reference) -> Previous:
        """The same symbol for the same variable."""
        symbol = super().__new__(cls, f"pre({reference.name})", real=True)
        symbol.reference = reference
        return symbol

    def __reduce_ex__(self, protocol: Any) -> Any:
        return Previous, (self.reference,)

    def has_whole_values(self) -> bool:
        """Whether those of the variable are."""
        return self.reference.has_whole_values()

    def _sympystr(self, printer: Any) -> str:
        return f"pre({self.reference.path})"


class Tick(sp.Symbol):
    """1 at the instants ``start + k * period``, k = 0, 1, ...; else 0.

    Attributes:
        start, period: expressions of parameters, in seconds.
    """

    start: sp.Expr
    period: sp.Expr

    def __new__(cls, start: sp.Expr, period: sp.Expr) -> Tick:
        """The same symbol for the same instants."""
        of = sorted(
            s.name for s in (start.free_symbols | period.free_symbols) if isinstance(s, sp.Symbol)
        )
        symbol = super().__new__(cls, f"sample({start}, {period})#{','.join(of)}", real=True)
        symbol.start, symbol.period = start, period
        return symbol

    def __reduce_ex__(self, protocol: Any) -> Any:
        return Tick, (self.start, self.period)

    def _sympystr(self, printer: Any) -> str:
        return f"sample({printer._print(self.start)}, {printer._print(self.period)})"


class Watched(RealFunction):
    """``Watched(condition, value, otherwise, always)``: a case distinction whose condition is an event.

    With ``always`` 0 it is an event only in a model that has others, too.
    """

    nargs = 4

    def _sympystr(self, printer: Any) -> str:
        return printer._print(literal(self))


def literal(expression: Any) -> Any:
    """The same without events: case distinctions are evaluated as they stand."""
    return _literal(expression, {}) if expression.has(Watched, Floored) else expression


def _literal(expression: Any, known: dict[Any, Any]) -> Any:
    """The same, once for each part of it: what an algorithm assigns may occur in it thousands of times."""
    if not expression.args:
        return expression
    if expression not in known:
        args = [_literal(a, known) for a in expression.args]
        if isinstance(expression, Watched):
            found = _cases(*args[:3])
        elif isinstance(expression, Floored):
            found = floor(args[0])
        elif all(a is b for a, b in zip(args, expression.args, strict=True)):
            found = expression
        else:
            found = expression.func(*args)
        known[expression] = found
    return known[expression]


def condition(value: Any, where: str) -> Boolean:
    """What a user gave as a condition; a variable or another signal counts as true above 1/2.

    Raises:
        DeclarationError: for what is not a condition; it says where.
    """
    if isinstance(value, bool):
        raise DeclarationError(
            f"{where} is {value} already: the model does not decide it. Two expressions are compared by <, <=, > or >= "
            "(== asks whether they are written alike); what is known beforehand, Python's if decides."
        )
    if isinstance(value, BooleanFunction | BooleanAtom) and not value.is_Relational:
        return value.func(*(condition(a, where) for a in value.args)) if value.args else value
    if isinstance(value, Boolean) and value.is_Relational:
        return value
    if isinstance(value, sp.Expr):
        return sp.Gt(value, HALF)
    raise DeclarationError(
        f"{where} is {type(value).__name__} {shown(value)}; give a comparison such as u > 1, or a variable that is "
        "1 or 0"
    )


def where(condition_: Any, value: Any, otherwise: Any, *, events: bool | None = False) -> Any:
    """``value`` where the condition holds, else ``otherwise``.

    Chain it for more than two branches. Derivatives are taken branch by branch.

    Arguments:
        condition_: a comparison, or ``&``, ``|``, ``~`` of some; a variable counts as true above 1/2.
        value, otherwise: expressions or numbers. Of arrays it is taken element by element.
        events: whether steps end where the condition changes. With False it is evaluated as it stands at every
            point, and a parameter that acts through the condition alone has no gradient, unless it is a comparison of
            time; but a jump that a discrete variable or a condition of an event of the same component follows is an
            event in any case. None: in models that have other events.
    """
    if any(map(is_array, (condition_, value, otherwise))):
        return elementwise(partial(where, events=events), condition_, value, otherwise)
    holds = condition(condition_, "the condition of where(...)")
    first, second = number_or_truth(value), number_or_truth(otherwise)
    if events is False or isinstance(holds, BooleanAtom):
        return _cases(holds, first, second)
    return Watched(holds, first, second, sp.Integer(events is True))


def _cases(condition_: Any, value: Any, otherwise: Any) -> Any:
    """Two branches; a comparison of case distinctions becomes a choice of comparisons.

    sympy would do that itself, but it simplifies what comes out, for seconds.
    """
    if condition_.has(sp.Piecewise):
        condition_ = condition_.replace(lambda part: part.is_Relational, _chosen)
    return sp.Piecewise((value, condition_), (otherwise, True))


def _chosen(comparison: Any) -> Any:
    """A comparison without case distinctions in its sides: each of its cases, where that holds."""
    parts = sp.preorder_traversal(comparison)
    pieces: Any = next((p for p in parts if isinstance(p, sp.Piecewise)), None)
    if pieces is None:
        return comparison
    holds: list[Any] = []
    earlier: list[Any] = []
    for value, case in pieces.args:
        here = _chosen(comparison.xreplace({pieces: value}))
        if here is not sp.false:
            holds.append(sp.And(*earlier, case, here))
        earlier.append(~case)
    return sp.Or(*holds)


def number_or_truth(value: Any) -> sp.Expr:
    """An expression; of a condition 1 or 0."""
    if isinstance(value, Boolean) and not isinstance(value, sp.Symbol):
        return where(value, 1, 0, events=None)
    return number_or_expression(value, "a value of where(...)")


def pre(variable: Any) -> Any:
    """The value of a variable just before an event; between events its value.

    Raises:
        DeclarationError: for what is not a variable.
    """
    if is_array(variable):
        return elementwise(pre, variable)
    if not isinstance(variable, Reference):
        raise DeclarationError(f"pre({shown(variable)}): the value before an event is a variable's")
    return Previous(variable)


def edge(variable: Any) -> Any:
    """Whether a variable that is 1 or 0 has just become 1."""
    if is_array(variable):
        return elementwise(edge, variable)
    before = pre(variable)  # refuses what is not a variable
    return sp.And(sp.Gt(variable, HALF), sp.Le(before, HALF))


def change(variable: Any) -> Any:
    """Whether a discrete variable, or a signal of whole numbers or truth values, has just changed."""
    if is_array(variable):
        return elementwise(change, variable)
    before = pre(variable)
    if variable.has_whole_values():  # so that it can be watched: a signal may change between events
        return sp.Ge(sp.Abs(variable - before), HALF)
    return sp.Ne(variable, before)


def initial() -> sp.Symbol:
    """True while initial values are being found."""
    return INITIAL


def sample(start: Any, period: Any) -> Tick:
    """True at the instants ``start + k * period``, k = 0, 1, ...

    Arguments:
        start: the first instant [s]. period: from each to the next [s], positive.

    Raises:
        DeclarationError: for a period that is a number, but not positive, and for what varies in a simulation.
    """
    begin, length = (number_or_expression(v, "an argument of sample(...)") for v in (start, period))
    for symbol in sorted((begin + length).free_symbols, key=str):
        declared = symbol.declaration if isinstance(symbol, Reference) else None
        constant = not isinstance(declared, Variable) or isinstance(
            declared, InitialParameter | DependentParameter | Discrete
        )
        if symbol is time or not constant:
            raise DeclarationError(
                f"sample({begin}, {length}) needs what changes at events only; {symbol} varies in a simulation"
            )
    if length.is_number and not length > 0:
        raise DeclarationError(f"sample(...) needs a period above zero, not {length}")
    return Tick(begin, length)


@dataclass(frozen=True)
class Reinit:
    """A state that jumps to a value; of arrays a tuple of these.

    Attributes:
        state: the variable. value: an expression.
    """

    state: Reference
    value: sp.Expr

    def __new__(cls, state: Any = None, value: Any = None) -> Any:  # a copy gives none
        """One jump, or several."""
        if is_array(state) or is_array(value):
            return tuple(cls(*both) for both in pairs(state, value, "Reinit(...)"))
        return super().__new__(cls)

    def __init__(self, state: Any, value: Any) -> None:  # pyright: ignore[reportInconsistentConstructor]
        if not isinstance(state, Reference):
            raise DeclarationError(f"Reinit({shown(state)}, ...): only a variable can jump")
        object.__setattr__(self, "state", state)
        object.__setattr__(
            self, "value", number_or_expression(value, f"what {state.path} jumps to")
        )

    def __str__(self) -> str:
        return f"Reinit({self.state}, {as_written(self.value)})"


class When:
    """What happens at the instant at which a condition comes true: discrete equations and jumps.

    Attributes:
        conditions: it happens where one of them comes true, whether others hold already or not.
        statements: ``Eq(discrete variable, expression)`` and `Reinit`, one by one or in a list.
        otherwise: another `When`, which counts where this one does not happen at the same instant.
    """

    def __init__(self, condition_: Any, *statements: Any, otherwise: When | None = None) -> None:
        given = condition_ if isinstance(condition_, list | tuple) else (condition_,)
        self.conditions = tuple(condition(c, "a condition of When(...)") for c in given)
        single = tuple(each(statements))
        for statement in single:
            if not isinstance(statement, Eq | Reinit):
                raise DeclarationError(
                    f"When(...) contains {shown(statement)}; give ac.Eq(discrete variable, value) or "
                    "ac.Reinit(state, value)"
                )
        if not (otherwise is None or isinstance(otherwise, When)):
            raise DeclarationError(f"otherwise={shown(otherwise)} is not a When(...)")
        self.statements: tuple[Eq | Reinit, ...] = single
        self.otherwise = otherwise

    def chain(self) -> Iterator[When]:
        """It, and those that count where it does not happen."""
        link: When | None = self
        while link is not None:
            yield link
            link = link.otherwise

    def __str__(self) -> str:
        parts = *map(as_written, self.conditions), *map(str, self.statements)
        return f"When({', '.join(parts)})"
