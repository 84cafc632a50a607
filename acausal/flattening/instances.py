"""Instances: the equations of a component tree as templates, and the indices that fill their slots."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp
from sympy.concrete.expr_with_limits import ExprWithLimits

from acausal.errors import DeclarationError, shown
from acausal.flattening.equation_group import EquationGroup
from acausal.flattening.layout import Layout, members_of_forms
from acausal.flattening.template import Integers, Template, slot
from acausal.modeling import (
    COMPUTABLE,
    Component,
    Eq,
    InitialParameter,
    Module,
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


def instantiate(layout: Layout) -> tuple[tuple[EquationGroup, ...], tuple[EquationGroup, ...]]:
    """All equations, and all initial equations, as groups of instances of templates.

    Raises:
        DeclarationError: for an equation that cannot be read, or refers to something outside of the model.
    """
    equations: list[EquationGroup] = []
    initial: list[EquationGroup] = []
    members = members_of_forms(layout)
    for number, form in enumerate(layout.forms):
        for groups, stated in (
            (equations, lambda p=form.prototype: _equations(p)),
            (initial, form.prototype.initial_equations),
        ):
            for equation in _read(form.prototype, stated, len(members[number])):
                template, places = _template(layout, form.prototype, equation)
                groups.append(_fill(layout, template, places, members[number]))
    order = np.argsort([g.components[0] for g in equations], kind="stable")
    return tuple(equations[i] for i in order), tuple(initial)


def _equations(component: Component) -> Iterable[Eq]:
    """A component's equations, those that its modifiers add, and ``der(p) = 0`` for its initial parameters."""
    yield from component.equations()
    yield from component._node.bindings
    for name, declared in component._node.declarations():
        if isinstance(declared, InitialParameter):
            yield Eq(der(getattr(component, name)), 0)


def _read(component: Component, equations: Callable[[], Iterable[Eq]], instances: int) -> list[Eq]:
    """The equations of a user's method; an error in it becomes a sentence with the line."""
    found: list[Eq] = []
    try:
        for equation in equations():
            charge("equations", instances, component._node)
            found.append(equation)
        return found
    except (TypeError, ValueError, ArithmeticError, AttributeError) as error:
        if isinstance(error, AttributeError) and not _is_sympys(error):
            raise  # an unknown name in the user's own line
        reason, line = str(error).partition("\n")[0], _line(error)
        raise DeclarationError(
            f"{component._node.label}: its equations cannot be read ({reason}){line}. Yield ac.Eq(left, right) from "
            "the method, and use ac.sin, ac.where, ... for what depends on variables, not math, numpy or if"
        ) from None
    except DeclarationError as error:
        if component._node.label in str(error):
            raise
        raise DeclarationError(f"{component._node.label}{_line(error)}: {error}") from None


def _is_sympys(error: Exception) -> bool:
    """Whether sympy raised an error, which then is about what it was given."""
    return "sympy" in Path(traceback.extract_tb(error.__traceback__)[-1].filename).parts


def _line(error: Exception) -> str:
    """The line of the user's file that raised an error."""
    frames = traceback.extract_tb(error.__traceback__)
    inner = ("site-packages", __file__, str(Path("acausal", "modeling")))
    own = [f for f in frames if not any(part in f.filename for part in inner)]
    return f", line {own[-1].lineno} of {Path(own[-1].filename).name}" if own else ""


def _template(layout: Layout, owner: Component, equation: Eq) -> tuple[Template, _Places]:
    """The template of one equation of a component."""
    if not isinstance(equation, Eq):
        raise DeclarationError(
            f"{owner._node.label}: equations() yields {shown(equation)}; yield ac.Eq(left, right)"
        )
    where = f"{type(owner).__name__}: {equation}"
    residual: Any = _without_der(equation.lhs - equation.rhs)
    _check_residual(residual, where)
    names: dict[sp.Basic, sp.Basic] = {}
    orders: dict[sp.Symbol, int] = {}
    variables: dict[sp.Symbol, SlotSource] = {}
    parameters: dict[sp.Symbol, SlotSource] = {}
    modules: dict[sp.Symbol, SlotSource] = {}
    for symbol in _symbols(residual):
        if symbol == time:
            continue
        reference, order = _undifferentiated(symbol)
        if not isinstance(reference, Reference):
            raise DeclarationError(f"{where}: '{reference}' is not declared")
        route = _route(owner, reference, where)
        local = layout.form(layout.position[id(reference.owner)])
        path = ".".join((*route, reference.path))
        named = names[symbol] = slot(path, order)
        match reference.declaration:
            case Variable():
                orders[named] = order
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
        origin=f"{type(owner).__name__}: {_with_names(equation, owner)}",
    )
    places = (tuple(p.values()) for p in (variables, parameters, modules))
    return template, _Places(*places)


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
    """The symbol that was differentiated, and how often."""
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
