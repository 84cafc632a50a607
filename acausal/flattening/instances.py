"""Instantiate: the equations of a component tree as templates, and what fills their slots."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError
from acausal.flattening.layout import Form, Layout, members_of_forms
from acausal.flattening.template import EquationGroup, Integers, Template, slot
from acausal.modeling import (
    COMPUTABLE,
    Component,
    Eq,
    InitialParameter,
    Module,
    Reference,
    Variable,
    der,
    time,
)


@dataclass(frozen=True)
class _Slots:
    """Where a template's slots are found, seen from the component that states the equation.

    Each entry is the chain of part names to the owner (empty: the component itself) and the local index there.
    """

    variables: tuple[tuple[tuple[str, ...], int], ...]
    parameters: tuple[tuple[tuple[str, ...], int], ...]
    modules: tuple[tuple[tuple[str, ...], int], ...]


def instantiate(layout: Layout) -> tuple[tuple[EquationGroup, ...], tuple[EquationGroup, ...]]:
    """All equations, and all initial equations, as groups of instances of templates."""
    equations: list[EquationGroup] = []
    initial: list[EquationGroup] = []
    members = members_of_forms(layout)
    for number, form in enumerate(layout.forms):
        for found, stated in (
            (equations, lambda p=form.prototype: _equations(p)),
            (initial, form.prototype.initial_equations),
        ):
            for equation in _stated(form.prototype, stated):
                template, slots = _template(layout, form, equation)
                found.append(_fill(layout, template, slots, members[number]))
    order = np.argsort([g.components[0] for g in equations], kind="stable")
    return tuple(equations[i] for i in order), tuple(initial)


def _equations(component: Component) -> Iterable[Eq]:
    """What a component states, what its modifiers add, and what holds of parameters found at the initial time."""
    yield from component.equations()
    yield from component._node.bindings
    for name, declared in component._node.declarations():
        if isinstance(declared, InitialParameter):
            yield Eq(der(getattr(component, name)), 0)


def _stated(component: Component, equations: Callable[[], Iterable[Eq]]) -> list[Eq]:
    try:
        return list(equations())
    except (TypeError, ValueError) as error:
        reason = str(error).partition("\n")[0]
        frames = traceback.extract_tb(error.__traceback__)
        own = [f for f in frames if "site-packages" not in f.filename and f.filename != __file__]
        line = f", line {own[-1].lineno} of {Path(own[-1].filename).name}" if own else ""
        raise DeclarationError(
            f"{component._node.label}: its equations cannot be read ({reason}){line}. Yield ac.Eq(left, right) from "
            "the method, and use ac.sin, ac.where, ... for what depends on variables, not math, numpy or if"
        ) from None


def _template(layout: Layout, form: Form, equation: Eq) -> tuple[Template, _Slots]:
    owner = form.prototype
    if not isinstance(equation, Eq):
        raise DeclarationError(
            f"{owner._node.label}: equations() yields {equation!r}; yield ac.Eq(left, right)"
        )
    where = f"{type(owner).__name__}: {equation}"
    residual: Any = _without_der(equation.lhs - equation.rhs, where)
    if residual.has(sp.nan, sp.oo, -sp.oo, sp.zoo, sp.I):
        raise DeclarationError(f"{where}: all numbers in an equation must be real and finite")
    for call in residual.atoms(sp.Function):
        if not isinstance(call, COMPUTABLE):
            raise DeclarationError(
                f"{where}: '{call.func}' cannot be computed; use the functions that acausal exports"
            )
    names: dict[sp.Symbol, sp.Symbol] = {}
    variables: dict[sp.Symbol, tuple[int, tuple[tuple[str, ...], int]]] = {}
    parameters: dict[sp.Symbol, tuple[tuple[str, ...], int]] = {}
    modules: dict[sp.Symbol, tuple[tuple[str, ...], int]] = {}
    of_parts: dict[Any, Any] = {}
    for symbol in _symbols(residual):
        if symbol == time:
            continue
        reference, order = (
            (symbol.reference, symbol.order) if isinstance(symbol, _Derived) else (symbol, 0)
        )
        if not isinstance(reference, Reference):
            raise DeclarationError(f"{where}: '{reference}' is not declared")
        chain = _chain(owner, reference, where)
        local = layout.form(layout.position[id(reference.owner)])
        path = ".".join((*chain, reference.path))
        named = slot(path, order)
        names[symbol] = named
        if chain:
            of_parts[reference] = slot(path)
        match reference.declaration:
            case Variable():
                variables[named] = order, (chain, local.variable_index[reference.path])
            case Module():
                modules[named] = chain, local.module_index[reference.path]
            case _:
                parameters[named] = chain, local.parameter_index[reference.path]
    template = Template(
        residual=residual.xreplace(names),
        variables=tuple(variables),
        orders=tuple(order for order, _ in variables.values()),
        parameters=tuple(parameters),
        modules=tuple(modules),
        origin=f"{type(owner).__name__}: {_with_names(equation, of_parts)}",
    )
    slots = _Slots(
        tuple(w for _, w in variables.values()), tuple(parameters.values()), tuple(modules.values())
    )
    return template, slots


def _with_names(equation: Eq, names: dict[Any, Any]) -> Eq:
    """The equation with dotted names for what belongs to parts."""
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


def _without_der(expression: Any, where: str) -> Any:
    """Replace every ``der`` by derivative symbols, differentiating what stands inside."""
    replaced = {d: _total(_without_der(d.args[0], where)) for d in expression.atoms(der)}
    return expression.xreplace(replaced) if replaced else expression


def _total(expression: sp.Expr) -> sp.Expr:
    """Total time derivative of an expression of references."""
    terms = [expression.diff(time)]
    for symbol in _symbols(expression):
        if isinstance(symbol, _Derived):
            terms.append(expression.diff(symbol) * _Derived(symbol.reference, symbol.order + 1))
        elif isinstance(symbol, Reference) and isinstance(symbol.declaration, Variable):
            terms.append(expression.diff(symbol) * _Derived(symbol, 1))
    return sp.Add(*terms)


def _symbols(expression: sp.Expr) -> list[sp.Symbol]:
    """Free symbols in order of appearance."""
    seen: dict[sp.Symbol, None] = {}
    for node in sp.preorder_traversal(expression):
        if isinstance(node, sp.Symbol):
            seen.setdefault(node)
    return sorted(seen, key=lambda s: _age(s))


def _age(symbol: sp.Symbol) -> tuple[int, int]:
    """Order of creation: sympy's own order of arguments would depend on names."""
    reference = symbol.reference if isinstance(symbol, _Derived) else symbol
    serial = int(reference.name.rpartition("#")[2]) if isinstance(reference, Reference) else -1
    return serial, symbol.order if isinstance(symbol, _Derived) else 0


def _chain(owner: Component, reference: Reference, where: str) -> tuple[str, ...]:
    names = reference.owner.route_from(owner._node)
    if names is None:
        raise DeclarationError(
            f"{where}: '{reference.path}' belongs to {reference.owner.label}, which is not part of "
            f"{owner._node.label}; assign it to an attribute, or connect instead"
        )
    return names


def _fill(layout: Layout, template: Template, slots: _Slots, members: Integers) -> EquationGroup:
    def indices(entries: tuple[tuple[tuple[str, ...], int], ...], base: Integers) -> Integers:
        columns = [base[_owners(layout, members, chain)] + local for chain, local in entries]
        return np.stack(columns, axis=1) if columns else np.empty((len(members), 0), dtype=np.int64)

    return EquationGroup(
        template=template,
        variables=indices(slots.variables, layout.variable_base),
        parameters=indices(slots.parameters, layout.parameter_base),
        modules=indices(slots.modules, layout.module_base),
        components=members,
    )


def _owners(layout: Layout, members: Integers, chain: tuple[str, ...]) -> Integers:
    if not chain:
        return members
    owners: list[int] = []
    for member in members:
        component = layout.components[member]
        for name in chain:
            component = component._node.children[name]
        owners.append(layout.position[id(component._node)])
    return np.asarray(owners, dtype=np.int64)
