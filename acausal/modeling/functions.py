"""Functions for equations that sympy lacks, or that need other derivatives than sympy's."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

import sympy as sp

from acausal.modeling.arrays import elementwise, is_array
from acausal.modeling.symbols import (
    Compared,
    ModuleCall,
    OfOne,
    RealFunction,
    number_or_expression,
    time,
)


def _of_expressions(function: Callable[..., Any]) -> Callable[..., Any]:
    """The same function of numbers and expressions alone: sympy would read a text as an expression, and run it."""

    def of_numbers(*arguments: Any) -> Any:
        where = f"an argument of {checked.__name__}(...)"
        return function(*(number_or_expression(a, where) for a in arguments))

    @wraps(function, assigned=("__name__", "__qualname__", "__doc__"), updated=())
    def checked(*arguments: Any) -> Any:
        return elementwise(of_numbers, *arguments)

    return checked


class Atan2(sp.Function):
    """The angle of a point, zero at the origin (sympy's own turns ``cos(atan2(y, x))`` into a quotient, 0/0 there)."""

    nargs = 2

    @classmethod
    def eval(cls, y: Any, x: Any) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Of numbers the number."""
        if y.is_number and x.is_number:
            return sp.S.Zero if y == x == 0 else sp.atan2(y, x)
        return None

    def fdiff(self, argindex: int = 1) -> Any:
        """The derivative by one argument."""
        y, x = self.args
        return (x if argindex == 1 else -y) / (x**2 + y**2)  # pyright: ignore[reportOperatorIssue]

    def _eval_is_extended_real(self) -> bool:
        return True


Atan2.__name__ = "atan2"

acos, asin, asinh, atan, atan2 = map(_of_expressions, (sp.acos, sp.asin, sp.asinh, sp.atan, Atan2))
cos, cosh, exp, log = map(_of_expressions, (sp.cos, sp.cosh, sp.exp, sp.log))
sin, sinh, sqrt, tan, tanh = map(_of_expressions, (sp.sin, sp.sinh, sp.sqrt, sp.tan, sp.tanh))
maximum, minimum = _of_expressions(sp.Max), _of_expressions(sp.Min)


class Abs(OfOne, sp.Abs):
    """The absolute value of a real number (sympy's own expects complex ones, as in ``Abs(log(x))``)."""

    TAKES = "what Abs(...) takes"

    def _eval_derivative(self, s: Any) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        argument: Any = self.args[0]
        return sign(argument) * argument.diff(s)


class sign(OfOne, sp.sign):  # noqa: N801 (a mathematician's name)
    """-1, 0 or 1; piecewise constant, so its derivative counts as zero."""

    TAKES = "what sign(...) takes"

    def _eval_derivative(self, s: Any) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        return sp.S.Zero


class Prescribed(RealFunction):
    """``Prescribed(n, time, q, qd, ...)``: q's n-th derivative, which is the n-th of the signals after it."""

    def fdiff(self, argindex: int = 1) -> Any:
        """With respect to time the next signal, else zero."""
        parts: Any = self.args
        order, _, *signals = parts
        if argindex != 2:
            return sp.S.Zero
        last = order + 1 == len(signals) - 1
        return signals[-1] if last else Prescribed(order + 1, time, *signals)

    def _sympystr(self, printer: Any) -> str:
        parts: Any = self.args
        return printer._print(parts[2 + int(parts[0])])


def prescribed(q: Any, *derivatives: Any) -> Any:
    """The signal ``q``, whose time derivatives are not computed, but given as these signals."""
    signals = [number_or_expression(s, "an argument of prescribed(...)") for s in (q, *derivatives)]
    return Prescribed(0, time, *signals) if derivatives else q


COMPUTABLE: tuple[type, ...] = (
    ModuleCall,
    Prescribed,
    sp.Abs,
    sp.Heaviside,
    sp.Max,
    sp.Min,
    sp.Mod,
    sp.Piecewise,
    sp.acos,
    sp.asin,
    sp.asinh,
    sp.atan,
    sp.atan2,
    Atan2,
    sp.ceiling,
    sp.cos,
    sp.cosh,
    sp.exp,
    sp.floor,
    sp.log,
    sp.sign,
    sp.sin,
    sp.sinh,
    sp.tan,
    sp.tanh,
)
"""All functions that may stand in an equation."""


class floor(sp.floor):  # noqa: N801 (a mathematician's name)
    """The greatest integer not above the argument; piecewise constant, so its derivative counts as zero.

    ``floor(x, events=True)`` ends steps where it jumps; with ``events=None`` in models that have other events.
    """

    def __new__(cls, arg: Any, *, events: bool | None = False, **options: Any) -> Any:
        """The integer; a `Floored` if its jumps are events; of an array element by element."""
        if is_array(arg):
            return elementwise(lambda one: cls(one, events=events), arg)
        number = number_or_expression(arg, "the argument of floor(...)")
        if events is False or number.is_number:
            return super().__new__(cls, number, **options)
        return Floored(number, sp.Integer(events is True))

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Zero."""
        return sp.S.Zero


class Floored(RealFunction):
    """``Floored(number, always)``: the greatest integer not above a number, whose jumps are events.

    With ``always`` 0 they are events only in a model that has others, too.
    """

    nargs = 2

    @classmethod
    def eval(cls, *args: sp.Expr) -> Any:
        """The integer itself, of a number that is known."""
        return floor(args[0]) if args[0].is_number else None

    def _sympystr(self, printer: Any) -> str:
        return printer._print(floor(self.args[0]))


def _is_counted(x: Any) -> bool:
    return isinstance(x, Compared) and x.has_whole_values()


def has_whole_values(x: Any, is_whole: Callable[[Any], bool] = _is_counted) -> bool:
    """Whether an expression is a whole number by its form, of variables that are, as a function says."""
    if isinstance(x, int | float) or (isinstance(x, sp.Expr) and x.is_number):
        return float(x).is_integer()
    if isinstance(x, sp.floor | sp.ceiling | sp.sign | Floored):
        return True
    parts = x.args
    if isinstance(x, sp.Piecewise):
        parts = tuple(branch.args[0] for branch in x.args)
    elif isinstance(x, sp.Pow):
        return x.exp.is_Integer and x.exp > 0 and has_whole_values(x.base, is_whole)
    elif not isinstance(x, sp.Add | sp.Mul | sp.Abs | sp.Max | sp.Min):
        return is_whole(x)
    return all(has_whole_values(part, is_whole) for part in parts)


def dividend(x: Any, y: Any, is_whole: Callable[[Any], bool] = _is_counted) -> Any:
    """What is divided by a number for ``floor(x / y)``: of whole numbers x a half on, so that rounding does no harm."""
    known = isinstance(x, int | float) and isinstance(y, int | float)
    whole = not known and has_whole_values(x, is_whole) and has_whole_values(y, is_whole)
    return x + sp.sign(y) / 2 if whole else x
