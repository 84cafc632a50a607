"""Instances: the equations of a component tree as templates, and the indices that fill their slots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.errors import DeclarationError, shown
from acausal.flattening.equation_group import (
    AssertionGroup,
    EquationGroup,
    EventEquations,
    GuardGroup,
    UpdateGroup,
)
from acausal.flattening.layout import Layout, members_of_forms
from acausal.flattening.origin import Origin
from acausal.flattening.reading import read_statements
from acausal.flattening.stated import Stated, UpdateStatement, without_events
from acausal.flattening.template import Integers
from acausal.flattening.templates import EquationShape, Filled, SlotSource, Templates, route_to
from acausal.modeling import Component, Eq, Reference, charge


@dataclass(frozen=True)
class Instances:
    """All that components state, as groups of instances of templates.

    Attributes:
        constants: numbers of equations; they are numbered behind the parameters.
    """

    equations: tuple[EquationGroup, ...]
    initial: tuple[EquationGroup, ...]
    events: EventEquations
    assertions: tuple[AssertionGroup, ...]
    constants: tuple[float, ...]


def instantiate(layout: Layout, statements: Sequence[Stated]) -> Instances:
    """All equations, all initial equations, those of events, and assertions.

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
    assertions: list[AssertionGroup] = []
    members = members_of_forms(layout)
    templates = Templates(layout)
    shapes: list[list[EquationShape]] = []
    for form, stated in zip(layout.forms, statements, strict=True):
        shapes.append([_shape(templates, form.prototype, e) for e in stated.equations])
        for shape in shapes[-1]:
            templates.count(shape)
    for number, form in enumerate(layout.forms):
        prototype, own, stated = form.prototype, members[number], statements[number]
        charge("equations", (len(own) - 1) * len(stated.equations), prototype._node)
        at_start = read_statements(prototype, prototype.initial_equations, len(own))
        equations += [_equation(templates, shape, own) for shape in shapes[number]]
        at_start_shapes = [_shape(templates, prototype, e) for e in at_start]
        initial += [_equation(templates, shape, own) for shape in at_start_shapes]
        for guard in stated.guards:
            parts = vars(_update(templates, prototype, guard, own))
            guards.append(GuardGroup(**parts, strict=guard.strict, ticks=guard.ticks))
        updates += [_update(templates, prototype, update, own) for update in stated.updates]
        jumps += [_update(templates, prototype, jump, own) for jump in stated.jumps]
        for one in stated.assertions:
            filled = templates.of(templates.shape(prototype, one.truth, str(one)))
            group = _fill(templates, filled, Origin(str(one), prototype), own)
            assertions.append(AssertionGroup(group, one))
    order = np.argsort([g.components[0] for g in equations], kind="stable")
    events = EventEquations(tuple(guards), tuple(updates), tuple(jumps))
    constants = tuple(templates.constants)
    always = tuple(equations[i] for i in order)
    return Instances(always, tuple(initial), events, tuple(assertions), constants)


def _shape(templates: Templates, owner: Component, stated: Any) -> EquationShape:
    """The shape of an equation of a component."""
    if not isinstance(stated, Eq):
        raise DeclarationError(
            f"{owner._node.label}: equations() yields {shown(stated)}; yield ac.Eq(left, right)"
        )
    return templates.shape(owner, without_events(stated))


def _equation(templates: Templates, shape: EquationShape, members: Integers) -> EquationGroup:
    """An equation as a template's residual, for all members."""
    stated = Eq(*shape.sides).stated_in(shape.place)
    return _fill(templates, templates.of(shape), Origin(stated, shape.owner), members)


def _update(
    templates: Templates, owner: Component, stated: UpdateStatement, members: Integers
) -> UpdateGroup:
    """What an expression gives, as a template's residual, for all members."""
    filled = templates.of(templates.shape(owner, stated.value, stated.text))
    group = _fill(templates, filled, Origin(stated.text, owner), members)
    targets = _targets(templates.layout, owner, stated.target, members)
    return UpdateGroup(group, targets, filled.previous, stated.always)


def _targets(layout: Layout, owner: Component, target: Reference, members: Integers) -> Integers:
    """The variable that each member's equation gives."""
    route = route_to(owner, target, lambda: f"{type(owner).__name__}: {target.path}")
    local = layout.form(layout.position[id(target.owner)]).variable_index[target.path]
    return layout.variable_base[_owners(layout, members, route)] + local


def _fill(templates: Templates, filled: Filled, origin: Origin, members: Integers) -> EquationGroup:
    layout = templates.layout

    def column(entry: SlotSource | float, base: Integers) -> Integers:
        if isinstance(entry, tuple):
            route, local = entry
            return base[_owners(layout, members, route)] + local
        return np.full(len(members), templates.constant(entry), dtype=np.int64)

    def indices(entries: Sequence[SlotSource | float], base: Integers) -> Integers:
        columns = [column(entry, base) for entry in entries]
        return np.stack(columns, axis=1) if columns else np.empty((len(members), 0), dtype=np.int64)

    return EquationGroup(
        template=filled.template,
        variables=indices(filled.variables, layout.variable_base),
        parameters=indices(filled.parameters, layout.parameter_base),
        modules=indices(filled.modules, layout.module_base),
        components=members,
        origins=origin.of(len(members)),
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
