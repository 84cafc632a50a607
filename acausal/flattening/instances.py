"""Instances: the equations of a component tree as templates, and the indices that fill their slots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp
from sympy.concrete.expr_with_limits import ExprWithLimits

from acausal.errors import DeclarationError, shown
from acausal.flattening.equation_group import (
    EquationGroup,
    EventEquations,
    GuardGroup,
    UpdateGroup,
)
from acausal.flattening.layout import Layout, members_of_forms
from acausal.flattening.reading import read_statements
from acausal.flattening.stated import Stated, without_events
from acausal.flattening.template import Integers, Template, slot
from acausal.modeling import (
    COMPUTABLE,
    INITIAL,
    Component,
    Eq,
    Module,
    Previous,
    Reference,
    Variable,
    charge,
    der,
    references,
    time,
)

SlotSource = tuple[tuple[str, ...], int]
"""What fills a slot, relative to the component that states the equation: the names of the parts on the way to the owner
(none for the component itself), and the local index there."""


@dataclass(frozen=True)
class _Places:
    """What fills the slots of a template."""

    variables: tuple[SlotSource, ...]
    parameters: tuple[SlotSource, ...]
    modules: tuple[SlotSource, ...]


def instantiate(
    layout: Layout, statements: Sequence[Stated]
) -> tuple[tuple[EquationGroup, ...], tuple[EquationGroup, ...], EventEquations]:
    """All equations, all initial equations, and those of events, as groups of instances of templates.

    Arguments:
        layout: where everything lies. statements: what the components of each form state.

    Raises:
        DeclarationError: for an equation that cannot be read, or refers to something outside of the model.
    """
    equations: list[EquationGroup] = []
    initial: list[EquationGroup] = []
    guards: list[GuardGroup] = []
    updates: list[UpdateGroup] = []
    jumps: list[UpdateGroup] = []
    members = members_of_forms(layout)
    for number, form in enumerate(layout.forms):
        prototype, own, stated = form.prototype, members[number], statements[number]
        charge("equations", (len(own) - 1) * len(stated.equations), prototype._node)
        at_start = read_statements(prototype, prototype.initial_equations, len(own))
        for groups, some in ((equations, stated.equations), (initial, at_start)):
            for equation in some:
                _check_equation(prototype, equation)
                groups.append(_fill(layout, *_template(layout, prototype, equation), own))
        for guard in stated.guards:
            group, previous = _group(layout, prototype, guard.value, guard.text, own)
            targets = _targets(layout, prototype, guard.target, own)
            guards.append(GuardGroup(group, targets, previous, guard.strict, guard.ticks))
        for groups, some in ((updates, stated.updates), (jumps, stated.jumps)):
            for update in some:
                group, previous = _group(layout, prototype, update.value, update.text, own)
                targets = _targets(layout, prototype, update.target, own)
                groups.append(UpdateGroup(group, targets, previous))
    order = np.argsort([g.components[0] for g in equations], kind="stable")
    events = EventEquations(tuple(guards), tuple(updates), tuple(jumps))
    return tuple(equations[i] for i in order), tuple(initial), events


def _check_equation(owner: Component, equation: Any) -> None:
    if not isinstance(equation, Eq):
        raise DeclarationError(
            f"{owner._node.label}: equations() yields {shown(equation)}; yield ac.Eq(left, right)"
        )


def _group(
    layout: Layout, owner: Component, value: sp.Expr, text: str, members: Integers
) -> tuple[EquationGroup, tuple[bool, ...]]:
    """An expression as a template's residual, for all members; and which slots take values before an event."""
    origin = f"{type(owner).__name__}: {text}"
    template, places, previous = _expression_template(layout, owner, _without_der(value), origin)
    return _fill(layout, template, places, members), previous


def _targets(layout: Layout, owner: Component, target: Reference, members: Integers) -> Integers:
    """The variable that each member's equation gives."""
    route = _route(owner, target, f"{type(owner).__name__}: {target.path}")
    local = layout.form(layout.position[id(target.owner)]).variable_index[target.path]
    return layout.variable_base[_owners(layout, members, route)] + local


def _template(layout: Layout, owner: Component, stated: Eq) -> tuple[Template, _Places]:
    """The template of one equation of a component."""
    equation = without_events(stated)
    origin = f"{type(owner).__name__}: {_with_names(equation, owner)}"
    residual: Any = _without_der(equation.lhs - equation.rhs)
    where = f"{type(owner).__name__}: {equation}"
    template, places, _ = _expression_template(layout, owner, residual, origin, where)
    return template, places


def _expression_template(
    layout: Layout, owner: Component, residual: Any, origin: str, where: str = ""
) -> tuple[Template, _Places, tuple[bool, ...]]:
    """The template of an expression, and for every slot of a variable whether it takes the value before an event."""
    where = where or origin
    _check_residual(residual, where)
    names: dict[sp.Basic, sp.Basic] = {}
    orders: dict[sp.Symbol, int] = {}
    previous: dict[sp.Symbol, bool] = {}
    variables: dict[sp.Symbol, SlotSource] = {}
    parameters: dict[sp.Symbol, SlotSource] = {}
    modules: dict[sp.Symbol, SlotSource] = {}
    for symbol in _symbols(residual):
        if symbol in (time, INITIAL):
            continue
        reference, order = _undifferentiated(symbol)
        if not isinstance(reference, Reference):
            raise DeclarationError(f"{where}: '{reference}' is not declared")
        route = _route(owner, reference, where)
        local = layout.form(layout.position[id(reference.owner)])
        path = ".".join((*route, reference.path))
        is_previous = isinstance(symbol, Previous)
        named = names[symbol] = slot(f"pre({path})" if is_previous else path, order)
        match reference.declaration:
            case Variable():
                orders[named], previous[named] = order, is_previous
                variables[named] = route, local.variable_index[reference.path]
            case Module():
                modules[named] = route, local.module_index[reference.path]
            case _:
                parameters[named] = route, local.parameter_index[reference.path]
    template = Template(
        residual=residual.xreplace(names),
        variables=tuple(variables),
        orders=tuple(orders.values()),
        parameters=tuple(parameters),
        modules=tuple(modules),
        origin=origin,
    )
    places = (tuple(p.values()) for p in (variables, parameters, modules))
    return template, _Places(*places), tuple(previous.values())


def _check_residual(residual: sp.Expr, where: str) -> None:
    if residual.has(sp.nan, sp.oo, -sp.oo, sp.zoo, sp.I):
        raise DeclarationError(f"{where}: all numbers in an equation must be real and finite")
    for call in residual.atoms(sp.Function):
        if not isinstance(call, COMPUTABLE):
            raise DeclarationError(
                f"{where}: '{call.func}' cannot be computed; use the functions that acausal exports"
            )
    for whole in residual.atoms(sp.Derivative, ExprWithLimits, sp.Dict):
        raise DeclarationError(
            f"{where}: '{whole}' cannot be computed; a derivative in time is ac.der(...)"
        )


def _with_names(equation: Eq, owner: Component) -> Eq:
    """The equation with dotted names for the variables and parameters of parts, also where it says nothing (x = x)."""
    names: dict[sp.Basic, sp.Basic] = {}
    for reference in {*references(equation.lhs), *references(equation.rhs)}:
        if route := reference.owner.route_from(owner._node):
            names[reference] = slot(".".join((*route, reference.path)))
    if not names:
        return equation
    return Eq(equation.lhs.xreplace(names), equation.rhs.xreplace(names))


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


def _route(owner: Component, reference: Reference, where: str) -> tuple[str, ...]:
    names = reference.owner.route_from(owner._node)
    if names is None:
        raise DeclarationError(
            f"{where}: '{reference.path}' belongs to {reference.owner.label}, which is not part of "
            f"{owner._node.label}; assign it to an attribute, or connect instead"
        )
    return names


def _fill(layout: Layout, template: Template, places: _Places, members: Integers) -> EquationGroup:
    def indices(entries: tuple[SlotSource, ...], base: Integers) -> Integers:
        columns = [base[_owners(layout, members, route)] + local for route, local in entries]
        return np.stack(columns, axis=1) if columns else np.empty((len(members), 0), dtype=np.int64)

    return EquationGroup(
        template=template,
        variables=indices(places.variables, layout.variable_base),
        parameters=indices(places.parameters, layout.parameter_base),
        modules=indices(places.modules, layout.module_base),
        components=members,
    )


def _owners(layout: Layout, members: Integers, route: tuple[str, ...]) -> Integers:
    """For each component, the part of it that a route leads to."""
    if not route:
        return members
    owners: list[int] = []
    for member in members:
        component = layout.components[member]
        for name in route:
            component = component._node.children[name]
        owners.append(layout.position[id(component._node)])
    return np.asarray(owners, dtype=np.int64)
