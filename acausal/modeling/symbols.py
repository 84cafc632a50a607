"""Symbols for the declarations of components, and equations between expressions of them.

A *reference* is a sympy symbol that knows its owner, so that one expression may mix names of several components.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Iterator
from copy import copy
from dataclasses import dataclass, field
from itertools import count
from types import FrameType
from typing import Any, Literal, Protocol

import numpy as np
import sympy as sp
from sympy.logic.boolalg import Boolean

from acausal.errors import DeclarationError, shown
from acausal.modeling.arrays import elements, elementwise, is_array, pairs
from acausal.modeling.declarations import Declaration, Variable, element_names
from acausal.modeling.written import as_written

HALF = sp.Rational(1, 2)
COMPARED_WITH = (bool, int, float, np.number, sp.Expr)
WITHIN = ("acausal", "numpy", "sympy")


class TimeSymbol(sp.Symbol):
    """The symbol of time. Models differentiate by it with `der`: to sympy, their variables do not depend on it."""

    @classmethod
    def class_key(cls) -> Any:
        """Its place in sympy's order: that of other symbols."""
        return sp.Symbol.class_key()

    @property
    def _diff_wrt(self) -> Literal[True]:
        frame: FrameType | None = sys._getframe(1)
        expression = (
            frame.f_locals.get("expr") if frame else None
        )  # of sympy's Derivative, which asks
        while frame is not None and _package(frame) == "sympy":
            frame = frame.f_back
        symbols = expression.free_symbols if isinstance(expression, sp.Basic) else ()
        if frame is not None and _package(frame) != "acausal" and any(map(_varies, symbols)):
            raise DeclarationError(
                "to sympy, variables do not depend on time; a derivative in time is ac.der(...)"
            )
        return True


def _varies(symbol: object) -> bool:
    """Whether it stands for a variable of a model."""
    return isinstance(symbol, Reference) and isinstance(symbol.declaration, Variable)


time = TimeSymbol("time", real=True)
"""The independent variable, in seconds."""


class Owner(Protocol):
    """The node of a component (`acausal.modeling.node`), as its declarations see it."""

    modifiers: dict[str, Any]
    bindings: list[Eq]

    @property
    def path(self) -> str:
        """Dotted name in the model."""
        ...

    @property
    def label(self) -> str:
        """The component's name in messages."""
        ...

    def route_from(self, ancestor: Owner) -> tuple[str, ...] | None:
        """Names of the parts on the way down from an ancestor."""
        ...


class Compared(sp.Symbol):
    """A symbol that a model compares by ``==`` and ``!=``, where sympy would compare identities.

    Only what is written outside of sympy, NumPy and this package is read so; they need the identity.
    """

    def has_whole_values(self) -> bool:
        """Whether its values are whole numbers or truth values, of which one equals another or not."""
        return False

    def __eq__(self, other: object) -> Any:
        if other is self or not isinstance(other, COMPARED_WITH) or _is_within():
            return super().__eq__(other)
        return self._equals(other)

    def __ne__(self, other: object) -> Any:
        if other is self or not isinstance(other, COMPARED_WITH) or _is_within():
            return super().__ne__(other)
        return ~self._equals(other)

    def _equals(self, other: Any) -> Any:
        is_whole = (
            other.has_whole_values()
            if isinstance(other, Compared)
            else not isinstance(other, sp.Expr)
        )
        if not (self.has_whole_values() and is_whole):
            raise DeclarationError(
                f"{self} == {other}: an equation is ac.Eq(left, right), and in a condition a real number, which "
                "has a value at instants only, is compared by <, <=, > or >=. Whole numbers are variables of "
                "kind='int' or 'bool'; give one to an expression."
            )
        value = other if isinstance(other, sp.Expr) else number_or_expression(other, "a comparison")
        return sp.Lt(sp.Abs(self - value), HALF)

    __hash__ = sp.Symbol.__hash__

    def __bool__(self) -> bool:
        if _is_within():
            return True
        raise DeclarationError(
            f"Python asks whether {self} is true, but its value is not known yet: "
            "use &, | and ~ in place of and, or and not, and ac.where in place of if."
        )


def _is_within() -> bool:
    """Whether the function that called this was called by sympy, NumPy or this package."""
    return _package(sys._getframe(2)) in WITHIN


def _package(frame: FrameType) -> str:
    """The package of the code that runs in a frame."""
    return frame.f_globals.get("__name__", "").partition(".")[0]


class Reference(Compared):
    """A symbol that knows which component owns it (by its node) and its local name there.

    Attributes:
        owner: the component's node. ``path``: the name in the component. ``declaration``: what is declared there.
        serial: grows with every reference of a model, to put them in order of creation.
    """

    owner: Owner
    path: str
    declaration: Declaration
    serial: int

    _names, _serials = count(), count()

    def __new__(cls, owner: Owner, path: str, declaration: Declaration) -> Reference:
        """A new symbol, unlike any other."""
        symbol = cls._unlike_any_other(path)
        symbol.owner, symbol.declaration, symbol.serial = owner, declaration, next(cls._serials)
        return symbol

    @classmethod
    def _unlike_any_other(cls, path: str) -> Reference:
        symbol = super().__new__(cls, f"{path}#{next(cls._names)}", real=True)
        symbol.path = path
        return symbol

    @classmethod
    def _again(cls, path: str, serial: int) -> Reference:
        """A symbol in a copy of its model; symbols that are added to the copy come after it."""
        symbol = cls._unlike_any_other(path)
        symbol.serial = serial
        if next(cls._serials) <= serial:
            cls._serials = count(serial + 1)
        return symbol

    def __copy__(self) -> Reference:
        return self

    def __reduce_ex__(self, protocol: Any) -> Any:
        """A copy of the model has symbols of its own: a process may have one of this name already.

        The owner holds the symbol and follows when the symbol exists.
        """
        owner = {"owner": self.owner, "declaration": self.declaration}
        return Reference._again, (self.path, self.serial), owner

    def has_whole_values(self) -> bool:
        """Whether it is declared so."""
        return getattr(self.declaration, "kind", "real") != "real"

    def _sympystr(self, printer: Any) -> str:
        return self.path

    def _latex(self, printer: Any) -> str:
        return printer._print(sp.Symbol(self.path))


class RealFunction(sp.Function):
    """A function whose values are real."""

    def _eval_is_real(self) -> bool:
        return True


class OfOne:
    """A function of an expression, a number or an array; sympy would read a text."""

    TAKES = ""

    def __new__(cls, argument: Any, **options: Any) -> Any:
        """The function of it, or of each element."""
        if is_array(argument):
            return elementwise(cls, argument)
        made: Any = super().__new__
        return made(cls, number_or_expression(argument, cls.TAKES), **options)


class der(OfOne, RealFunction):  # noqa: N801 (Modelica's name)
    """Time derivative of a variable, or of an expression of variables."""

    nargs = 1
    TAKES = "what der(...) differentiates"

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Refused: total derivatives are taken when equations become templates."""
        raise DeclarationError(
            "der(...) inside der(...) of an expression: give the inner one a variable"
        )


class ModuleCall(RealFunction):
    """A callable parameter applied: ``ModuleCall(module, orders, *args)``.

    ``orders`` counts, per argument, how often the function is differentiated, so that sympy can carry
    a network through index reduction and linearization.
    """

    def fdiff(self, argindex: int = 1) -> Any:
        """The partial derivative by an argument (counted from 3), again a call."""
        module, orders, *args = self._parts
        raised = [n + (i == argindex - 3) for i, n in enumerate(orders)]
        return ModuleCall(module, sp.Tuple(*raised), *args)

    @property
    def _parts(self) -> tuple[Any, ...]:
        return self.args

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        terms = [self.fdiff(i) * a.diff(s) for i, a in enumerate(self._parts[2:], start=3)]
        return sp.Add(*terms)

    def _sympystr(self, printer: Any) -> str:
        module, orders, *args = self._parts
        name = printer._print(module) + primes(orders)
        return f"{name}({', '.join(printer._print(a) for a in args)})"


def primes(orders: Iterable[Any]) -> str:
    """How derivatives of a module are marked: a prime for each, ``'2`` for one by the second argument."""
    marks = ("'" if i == 1 else f"'{i}" for i in count(1))
    return "".join(mark * int(n) for mark, n in zip(marks, orders, strict=False))


class GivenModule(sp.Symbol):
    """A module as a part of an expression: one that is no parameter."""

    value: Any

    def __new__(cls, name: str, value: Any) -> GivenModule:
        """The same symbol for the same name, which belongs to one module."""
        symbol = super().__new__(cls, name, real=True)
        symbol.value = value
        return symbol

    def __reduce_ex__(self, protocol: Any) -> Any:
        return GivenModule, (self.name, self.value)

    def __call__(self, *args: Any) -> Any:
        """The module applied to expressions."""
        return ModuleCall(self, sp.Tuple(*[0] * len(args)), *map(sp.sympify, args))

    def _sympystr(self, printer: Any) -> str:
        return self.name.partition("#")[0]


@dataclass(frozen=True)
class ModuleReference:
    """A `Module` read on an instance: callable with expressions."""

    symbol: Reference

    def __call__(self, *args: Any) -> Any:
        """The module applied to expressions."""
        return elementwise(self._applied, *args)

    def _applied(self, *args: Any) -> Any:
        expressions = [number_or_expression(a, f"an argument of {self.symbol.path}") for a in args]
        return ModuleCall(self.symbol, sp.Tuple(*[0] * len(args)), *expressions)


@dataclass(frozen=True)
class Eq:
    """An equation ``lhs = rhs`` between expressions; ``place`` is where it is stated, as far as that is known.

    Of arrays it is a tuple of equations, one for each element.
    """

    lhs: sp.Expr
    rhs: sp.Expr
    place: str = field(default="", compare=False, repr=False)

    def __new__(cls, lhs: Any = None, rhs: Any = None) -> Any:  # a copy gives none
        """One equation, or several."""
        if is_array(lhs) or is_array(rhs):
            return tuple(cls(*both) for both in pairs(lhs, rhs, "an equation"))
        return super().__new__(cls)

    def __init__(self, lhs: Any, rhs: Any) -> None:  # pyright: ignore[reportInconsistentConstructor]
        object.__setattr__(self, "lhs", _side(lhs, "an equation's left side"))
        object.__setattr__(self, "rhs", _side(rhs, "an equation's right side"))

    def stated_in(self, place: str) -> Eq:
        """The same, stated in a line of a file."""
        if not place:
            return self
        found = copy(self)
        object.__setattr__(found, "place", place)
        return found

    def __str__(self) -> str:
        return f"{as_written(self.lhs)} = {as_written(self.rhs)}"


def _side(value: Any, where: str) -> Any:
    """A side of an equation: an expression, or a condition, which is 1 or 0."""
    return value if isinstance(value, Boolean) else number_or_expression(value, where)


def number_or_expression(value: Any, where: str) -> sp.Expr:
    """An expression as it is; a finite number as one of sympy's.

    Raises:
        DeclarationError: for anything else; ``where`` it was found is named.
    """
    if isinstance(value, sp.Expr):
        return value
    try:
        if isinstance(value, str | bytes):  # Python reads "1" as a number
            raise TypeError
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise DeclarationError(
            f"{where} is {type(value).__name__} {shown(value)}; an expression or a number is needed"
        ) from None
    if not math.isfinite(number):
        raise DeclarationError(f"{where} is {number}; a finite number is needed")
    return sp.Integer(int(number)) if number.is_integer() else sp.Float(number)


def references(expression: sp.Basic) -> Iterator[Reference]:
    """The references in an expression, each once, in order of appearance."""
    seen: dict[Reference, None] = {}
    for node in sp.preorder_traversal(expression):
        if isinstance(node, Reference):
            seen.setdefault(node)
    return iter(seen)


def refer(owner: Owner, name: str, declaration: Declaration, shape: tuple[int, ...] | None) -> Any:
    """A reference, or an array of references."""
    references = [Reference(owner, path, declaration) for path in element_names(name, shape)]
    return elements(shape, references) if shape else references[0]


def each(stated: Iterable[Any]) -> Iterator[Any]:
    """Statements one by one, with those of lists, and those of arrays element by element."""
    for one in stated:
        if isinstance(one, tuple | list):
            yield from each(one)
        else:
            yield one
