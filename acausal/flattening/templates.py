"""Read equations as templates: sympy works once on all equations of one shape, whatever class states them.

The *shape* of an equation is its tree without the component that states it and without its numbers. Many classes mostly
repeat few shapes: they inherit equations, or a program wrote them. Where many equations of one shape have numbers of
their own, these become constants, which fill slots as parameters do.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp
from sympy.concrete.expr_with_limits import ExprWithLimits
from sympy.core.relational import Relational

from acausal.errors import DeclarationError
from acausal.flattening.layout import Layout
from acausal.flattening.template import Template, interned, slot
from acausal.modeling import (
    COMPUTABLE,
    INITIAL,
    Component,
    Declaration,
    Eq,
    Module,
    ModuleCall,
    Parameter,
    Previous,
    Reference,
    Variable,
    der,
    time,
)

SlotSource = tuple[tuple[str, ...], int]
"""What fills a slot, relative to the component that states the equation: the names of the parts on the way to the owner
(none for the component itself), and the local index there."""

Number = tuple[type, float]
"""A number's kind, as whole numbers are exact in sympy, and its magnitude."""

FEW_VARIANTS = 8
"""Where so many classes state an equation, or it has so many variants that differ in numbers, they stay apart: programs
of few formulas are compiled and run as they are written."""

KEPT = (Relational, ModuleCall, sp.sign, sp.floor, sp.ceiling, sp.Heaviside)
"""Numbers in these stay numbers: they decide cases, or what a network is asked."""

LONG = 8
"""A sum of so many multiples of variables is read term by term, in the order in which they are declared. Rows of a
matrix, whose numbers have signs and sizes of their own, are then of one shape."""

EXACT = 2**53
"""Smaller whole numbers are exact as floating-point numbers."""


@dataclass(frozen=True)
class EquationShape:
    """An equation, taken apart.

    Attributes:
        owner: the component that states it. sides: of the equation, or one expression.
        tree: what is left of the sides; a reference is its place in ``references``, a number that in ``numbers``.
        numbers: each once, without its sign; of a long sum those of all terms, with signs.
        references: each with the way to its owner. where: how messages call the equation.
        is_sum: whether it is a long sum. place: where it is stated.
    """

    owner: Component
    sides: tuple[Any, ...]
    tree: Any
    numbers: tuple[Number, ...]
    references: dict[Reference, tuple[str, ...]]
    where: Callable[[], str]
    is_sum: bool
    place: str

    @cached_property
    def key(self) -> Hashable:
        """Equations with one key are read alike."""
        own = list(self.references)
        order = sorted(range(len(own)), key=lambda i: own[i].serial)
        names = ((*route, r.path, _kind(r)) for r, route in self.references.items())
        return self.tree, tuple(order), tuple(names)


@dataclass(frozen=True)
class Filled:
    """A template, and what fills its slots.

    Attributes:
        parameters: a number stands for a constant of the equation.
        previous: for every slot of a variable whether it takes the value before an event.
    """

    template: Template
    variables: tuple[SlotSource, ...]
    parameters: tuple[SlotSource | float, ...]
    modules: tuple[SlotSource, ...]
    previous: tuple[bool, ...]


@dataclass(frozen=True)
class _Read:
    """A template, and for every slot what fills it, by its place among the references (of a constant, -1 - place)."""

    template: Template
    variables: tuple[int, ...]
    parameters: tuple[int, ...]
    modules: tuple[int, ...]
    previous: tuple[bool, ...]


class Templates:
    """The templates of a model's equations, by shape."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self.constants: dict[float, int] = {}
        self._known: dict[Hashable, _Read] = {}
        self._variants: dict[Hashable, set[tuple[Number, ...]]] = {}

    def shape(
        self, owner: Component, stated: Eq | sp.Expr, text: str | None = None
    ) -> EquationShape:
        """An equation, or an expression, taken apart.

        Arguments:
            owner: the component that states it. text: how messages call an expression.

        Raises:
            DeclarationError: if it refers to something outside of the component.
        """
        sides = (stated.lhs, stated.rhs) if isinstance(stated, Eq) else (stated,)
        found: dict[Reference, tuple[str, ...]] = {}
        places: dict[Reference, int] = {}
        numbers: dict[Number, int] = {}

        def where() -> str:
            return f"{type(owner).__name__}: {text or stated}"

        def place(reference: Reference) -> int:
            if reference not in places:
                found[reference] = route_to(owner, reference, where)
                places[reference] = len(places)
            return places[reference]

        def tree(node: Any, lifts: bool, is_term: bool) -> Any:
            if isinstance(node, Reference):
                return place(node)
            if isinstance(node, Previous):
                return Previous, place(node.reference)
            if not node.args:
                if lifts and is_term and (magnitude := _magnitude(node)):
                    number = numbers.setdefault((type(node), magnitude), len(numbers))
                    return (sp.Number, bool(node > 0)), number
                return type(node), node
            lifts = lifts and not isinstance(node, KEPT)
            is_term = isinstance(node, sp.Add | sp.Mul)
            return node.func, tuple([tree(a, lifts, is_term) for a in node.args])

        sums = _long_sums(sides)
        if sums:
            trees, given = _trees_of_sums(sums, place)
        else:
            trees, given = tuple([tree(side, True, True) for side in sides]), tuple(numbers)
        stated_in = stated.place if isinstance(stated, Eq) else ""
        return EquationShape(owner, sides, trees, given, found, where, bool(sums), stated_in)

    def count(self, shape: EquationShape) -> None:
        """Count the numbers of an equation as a variant of its shape."""
        self._variants.setdefault(shape.key, set()).add(shape.numbers)

    def constant(self, number: float) -> int:
        """The number of a constant: they follow after the parameters."""
        first = int(self.layout.parameter_base[-1])
        return first + self.constants.setdefault(number, len(self.constants))

    def of(self, shape: EquationShape) -> Filled:
        """The template of an equation, or with an expression as residual.

        Raises:
            DeclarationError: for an equation that cannot be read.
        """
        is_lifted = len(self._variants.get(shape.key, ())) > FEW_VARIANTS
        key = shape.key, None if is_lifted else shape.numbers
        if key not in self._known:
            self._known[key] = _read(shape, is_lifted)
        read, own = self._known[key], list(shape.references)

        def source(i: int) -> SlotSource:
            return shape.references[own[i]], self._local(own[i])

        return Filled(
            read.template,
            tuple([source(i) for i in read.variables]),
            tuple([source(i) if i >= 0 else shape.numbers[-1 - i][1] for i in read.parameters]),
            tuple([source(i) for i in read.modules]),
            read.previous,
        )

    def _local(self, reference: Reference) -> int:
        """The local index of what a reference names."""
        form = self.layout.form(self.layout.position[id(reference.owner)])
        index: dict[type[Declaration], dict[str, int]] = {
            Variable: form.variable_index,
            Module: form.module_index,
            Parameter: form.parameter_index,
        }
        return index[_kind(reference)][reference.path]


Sum = list[tuple[sp.Expr, Reference | None]]
"""Numbers, and what each is multiplied by."""


def _long_sums(sides: Sequence[Any]) -> list[Sum]:
    """The sides of an equation as sums of multiples of references; none where they are anything else, or short."""
    found: list[Sum] = []
    for side in sides:
        if not isinstance(side, sp.Expr):
            return []
        terms = [term.as_coeff_Mul() for term in sp.Add.make_args(side) if term != 0]
        for number, rest in terms:
            if not (_is_unit(number) or _magnitude(number)):
                return []
            if not (rest is sp.S.One or isinstance(rest, Reference)):
                return []
        own: Sum = [(n, r if isinstance(r, Reference) else None) for n, r in terms]
        found.append(sorted(own, key=lambda term: term[1].serial if term[1] is not None else -1))
    return found if sum(map(len, found)) >= LONG else []


def _trees_of_sums(
    sums: Sequence[Sum], place: Callable[[Reference], int]
) -> tuple[tuple[Any, ...], tuple[Number, ...]]:
    """The trees of long sums, and their numbers, with signs, all but those that are 1 or -1."""
    numbers: list[Number] = []

    def factor(number: Any) -> Any:
        if _is_unit(number):
            return type(number), number
        numbers.append((type(number), float(number)))
        return (sp.Number, True), len(numbers) - 1

    def term(number: sp.Expr, reference: Reference | None) -> Any:
        own = factor(number)
        return own if reference is None else (sp.Mul, (own, place(reference)))

    trees = tuple([(sp.Add, tuple([term(n, r) for n, r in one])) for one in sums])
    return trees, tuple(numbers)


def _is_unit(number: Any) -> bool:
    return number is sp.S.One or number is sp.S.NegativeOne


def _magnitude(node: sp.Basic) -> float | None:
    """The magnitude of a number that may be a constant; None for others, and for 0 and 1, which shape an equation."""
    if not isinstance(node, sp.Float | sp.Integer) or not abs(node) < EXACT:
        return None
    magnitude = abs(float(node))
    return None if magnitude in (0, 1) else magnitude


def _kind(reference: Reference) -> type[Declaration]:
    """Variable, module or parameter."""
    kinds = Variable, Module
    return next((k for k in kinds if isinstance(reference.declaration, k)), Parameter)


def route_to(owner: Component, reference: Reference, where: Callable[[], str]) -> tuple[str, ...]:
    """The names of the parts on the way from a component to the owner of a reference in it.

    Raises:
        DeclarationError: if it is no part of the component; ``where`` it was found is named.
    """
    names = reference.owner.route_from(owner._node)
    if names is None:
        raise DeclarationError(
            f"{where()}: '{reference.path}' belongs to {reference.owner.label}, which is not part of "
            f"{owner._node.label}; assign it to an attribute, or connect instead"
        )
    return names


def _read(shape: EquationShape, is_lifted: bool) -> _Read:
    """The template of ``left = right``, or with one side as residual; with constants in the place of its numbers."""
    where, routes = shape.where, shape.references
    known = {"real": True, "nonzero": True} if shape.is_sum else {"positive": True}
    constants = [sp.Symbol(f"#{i}", **known) for i, _ in enumerate(shape.numbers)]
    first, *others = _with_constants(shape, constants) if is_lifted else shape.sides
    residual: Any = _without_der(first - others[0] if others else first)
    _check_residual(residual, where)
    place = {reference: i for i, reference in enumerate(routes)}
    names: dict[sp.Basic, sp.Basic] = {}
    orders: dict[sp.Symbol, int] = {}
    previous: dict[sp.Symbol, bool] = {}
    slots: dict[type[Declaration], dict[sp.Symbol, int]] = {Variable: {}, Parameter: {}, Module: {}}
    for symbol in _symbols(residual):
        if symbol in (time, INITIAL):
            continue
        if symbol in constants:
            slots[Parameter][symbol] = -1 - constants.index(symbol)
            continue
        reference, order = _undifferentiated(symbol)
        if not isinstance(reference, Reference):
            raise DeclarationError(f"{where()}: '{reference}' is not declared")
        path = ".".join((*routes[reference], reference.path))
        is_previous = isinstance(symbol, Previous)
        named = names[symbol] = slot(f"pre({path})" if is_previous else path, order)
        slots[_kind(reference)][named] = place[reference]
        if _kind(reference) is Variable:
            orders[named], previous[named] = order, is_previous
    variables, parameters, modules = slots.values()
    template = Template(
        residual=residual.xreplace(names),
        variables=tuple(variables),
        orders=tuple(orders.values()),
        parameters=tuple(parameters),
        modules=tuple(modules),
    )
    places = (tuple(found.values()) for found in (variables, parameters, modules))
    return _Read(interned(template), *places, previous=tuple(previous.values()))


def _with_constants(shape: EquationShape, constants: Sequence[sp.Symbol]) -> list[Any]:
    """The sides of an equation with constants in the place of its numbers."""
    references = list(shape.references)

    def built(tree: Any) -> Any:
        if isinstance(tree, int):
            return references[tree]
        head, rest = tree
        if isinstance(head, tuple):
            return constants[rest] if head[1] else -constants[rest]
        if isinstance(rest, tuple):
            return head(*map(built, rest))
        return head(references[rest]) if isinstance(rest, int) else rest

    return [built(side) for side in shape.tree]


def _check_residual(residual: sp.Expr, where: Callable[[], str]) -> None:
    if residual.has(sp.nan, sp.oo, -sp.oo, sp.zoo, sp.I):
        raise DeclarationError(f"{where()}: all numbers in an equation must be real and finite")
    for call in residual.atoms(sp.Function):
        if not isinstance(call, COMPUTABLE):
            raise DeclarationError(
                f"{where()}: '{call.func}' cannot be computed; use the functions that acausal exports"
            )
    for whole in residual.atoms(sp.Derivative, ExprWithLimits, sp.Dict):
        raise DeclarationError(
            f"{where()}: '{whole}' cannot be computed; a derivative in time is ac.der(...)"
        )


class _Derived(sp.Symbol):
    """A reference, ``order`` times differentiated, while an equation is being turned into a template."""

    reference: sp.Symbol
    order: int

    def __new__(cls, reference: sp.Symbol, order: int) -> _Derived:
        self = super().__new__(cls, f"der{order}({reference.name})", real=True)
        self.reference, self.order = reference, order
        return self


def _without_der(expression: Any) -> Any:
    """Replace every ``der`` by derivative symbols, differentiating the expression inside."""
    replaced = {d: _total_derivative(_without_der(d.args[0])) for d in expression.atoms(der)}
    return expression.xreplace(replaced) if replaced else expression


def _total_derivative(expression: sp.Expr) -> sp.Expr:
    """The derivative of an expression of references by time, chain rule included."""
    terms = [expression.diff(time)]
    for symbol in _symbols(expression):
        if isinstance(symbol, _Derived):
            terms.append(expression.diff(symbol) * _Derived(symbol.reference, symbol.order + 1))
        elif isinstance(symbol, Reference) and isinstance(symbol.declaration, Variable):
            terms.append(expression.diff(symbol) * _Derived(symbol, 1))
    return sp.Add(*terms)


def _symbols(expression: sp.Expr) -> list[sp.Symbol]:
    """Free symbols in order of creation."""
    seen: dict[sp.Symbol, None] = {}
    for node in sp.preorder_traversal(expression):
        if isinstance(node, sp.Symbol):
            seen.setdefault(node)
    return sorted(seen, key=_creation_order)


def _creation_order(symbol: sp.Symbol) -> tuple[int, int]:
    """References in the order in which they were made: sympy's own order of arguments depends on names."""
    reference, order = _undifferentiated(symbol)
    return (reference.serial if isinstance(reference, Reference) else -1), order


def _undifferentiated(symbol: sp.Symbol) -> tuple[sp.Symbol, int]:
    """The variable that a symbol stands for, and how often it is differentiated."""
    if isinstance(symbol, Previous):
        return symbol.reference, 0
    return (symbol.reference, symbol.order) if isinstance(symbol, _Derived) else (symbol, 0)
