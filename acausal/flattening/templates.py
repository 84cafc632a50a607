"""Read equations as templates: sympy works once on all equations of one shape, whatever class states them.

The *shape* of an equation is its tree, with local paths in the place of references. Many classes mostly repeat few
shapes: they inherit equations, or a program wrote them.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.concrete.expr_with_limits import ExprWithLimits

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


@dataclass(frozen=True)
class Filled:
    """A template, and what fills its slots.

    Attributes:
        previous: for every slot of a variable whether it takes the value before an event.
    """

    template: Template
    variables: tuple[SlotSource, ...]
    parameters: tuple[SlotSource, ...]
    modules: tuple[SlotSource, ...]
    previous: tuple[bool, ...]


@dataclass(frozen=True)
class _Read:
    """A template, and for every slot the reference that fills it, by its place in the equation."""

    template: Template
    variables: tuple[int, ...]
    parameters: tuple[int, ...]
    modules: tuple[int, ...]
    previous: tuple[bool, ...]


class Templates:
    """The templates of a model's equations, by shape."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self._known: dict[Hashable, _Read] = {}

    def of(self, owner: Component, stated: Eq | sp.Expr, text: str | None = None) -> Filled:
        """The template of an equation, or with an expression as residual.

        Arguments:
            owner: the component that states it. text: how messages call an expression.

        Raises:
            DeclarationError: for an equation that cannot be read, or refers to something outside of the component.
        """
        sides = (stated.lhs, stated.rhs) if isinstance(stated, Eq) else (stated,)
        routes: dict[Reference, tuple[str, ...]] = {}

        def where() -> str:
            return f"{type(owner).__name__}: {text or stated}"

        def shape(node: Any) -> Hashable:
            if isinstance(node, Reference):
                if node not in routes:
                    routes[node] = route_to(owner, node, where)
                return (*routes[node], node.path)
            if isinstance(node, Previous):
                return Previous, shape(node.reference)
            return (node.func, *map(shape, node.args)) if node.args else (type(node), node)

        shapes = tuple(map(shape, sides))
        references = list(routes)
        order = sorted(range(len(references)), key=lambda i: references[i].serial)
        key = shapes, tuple(order), tuple(_kind(r) for r in references)
        if key not in self._known:
            self._known[key] = _read(sides, routes, where)
        read = self._known[key]
        variables, parameters, modules = (
            tuple((routes[references[i]], self._local(references[i])) for i in slots)
            for slots in (read.variables, read.parameters, read.modules)
        )
        return Filled(read.template, variables, parameters, modules, read.previous)

    def _local(self, reference: Reference) -> int:
        """The local index of what a reference names."""
        form = self.layout.form(self.layout.position[id(reference.owner)])
        index: dict[type[Declaration], dict[str, int]] = {
            Variable: form.variable_index,
            Module: form.module_index,
            Parameter: form.parameter_index,
        }
        return index[_kind(reference)][reference.path]


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


def _read(
    sides: Sequence[Any], routes: Mapping[Reference, tuple[str, ...]], where: Callable[[], str]
) -> _Read:
    """The template of ``left = right``, or with one side as residual."""
    first, *others = sides
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
