"""Diagnosis of singular models: which equations and unknowns do not fit, in the user's names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from acausal.errors import DeclarationError, listing
from acausal.flattening import FlatModel, Origin
from acausal.modeling import Component, Eq, Potential, each
from acausal.structure import graph
from acausal.structure.equations import Equations

MOST_LINES = 6
"""Lines of a file that are named."""
MOST_OTHERS = 5
"""Other variables that may be the undetermined one are named up to here."""


def explain_singularity(system: Equations, combined: Mapping[int, Sequence[int]]) -> str | None:
    """A sentence about a structurally singular model, or None for a sound one.

    A variable and its derivatives count as one unknown, so that constraints between states, which index reduction
    resolves, are not mistaken for singularities. ``combined`` lists the equations that an equation was combined with.
    """
    model, aliases, chains = system.model, system.aliases, system.chains()
    collapsed = [
        list(dict.fromkeys(chains[v] for v in row if v in chains)) for row in system.incidence
    ]
    bottoms = list(dict.fromkeys(chains.values()))
    number = {v: i for i, v in enumerate(bottoms)}
    found = graph.singularity(
        [[number[v] for v in row] for row in collapsed], len(bottoms), range(len(bottoms))
    )
    if found is None and not aliases.redundant:
        return None
    unknowns = model.n_variables - len(model.inputs) - len(model.discrete)
    parts = [f"structurally singular: {model.n_equations} equations for {unknowns} unknowns"]
    unmatched = [bottoms[i] for i in (found.unmatched_variables if found else ())]
    origins = list(zip(system.origin, system.component, strict=True))
    missing = [system.name(node) for node in unmatched]
    unmatched_equations = found.unmatched_equations if found else ()
    reached = [*(found.equations if found else ())]
    surplus = [] if missing else _from_outside(system, reached)
    surplus = surplus or [origins[e] for e in unmatched_equations]
    reached += [other for e in unmatched_equations for other in combined.get(e, ())]
    related = [origins[e] for e in reached if origins[e] not in surplus]
    variables = (v for v in unmatched if v < model.n_variables)
    kinds = map(model.layout.variable_declaration, variables)
    floating = any(isinstance(declared, Potential) for declared in kinds)
    excess = bool(surplus or aliases.redundant)
    if missing:
        parts.append(f"undetermined: {listing(missing)}")
        or_else = [bottoms[i] for i in (found.variables if found else ())]
        others = [system.name(v) for v in or_else if v not in unmatched]
        if 0 < len(others) <= MOST_OTHERS and not (excess or floating):
            parts[-1] += f", or else {listing(others)}"
    if excess:
        redundant = [model.stated_at(c, o) for o, c in (*surplus, *aliases.redundant)]
        parts.append(f"overdetermined; redundant equations: {listing(dict.fromkeys(redundant), 6)}")
    if related:
        parts.append(
            f"together with: {listing(dict.fromkeys(model.stated_at(c, o) for o, c in related), 6)}"
        )
    remedy = (missing and forgotten_equations(model)) or _remedy(bool(missing), excess, floating)
    if is_set := inputs_that_are_set(model, (*surplus, *aliases.redundant)):
        remedy = f"{is_set} {remedy}"
    places = [o.place for o, _ in (*surplus, *aliases.redundant, *related)]
    return "; ".join(parts) + f". {remedy}{_seen_in(places)}"


def _seen_in(places: Sequence[str]) -> str:
    """A sentence on the lines of files in which equations are stated, or nothing."""
    lines: dict[str, list[str]] = {}
    for place in filter(None, dict.fromkeys(places)):
        line, _, file = place.partition(" of ")
        lines.setdefault(file, []).append(line.removeprefix("line "))
    found = [
        f"line{'s' * (len(own) > 1)} {', '.join(own[:MOST_LINES])} of {file}"
        for file, own in lines.items()
    ]
    return f" See {'; '.join(found)}." if found else ""


def _remedy(missing: bool, surplus: bool, floating: bool) -> str:
    if not missing:
        return "Are two sources or fixed points joined rigidly, or is an equation stated twice?"
    if floating:
        return "Is a Fixed (a ground, a reference) missing, or a connector left unconnected?"
    if surplus:
        return "Are two sources or fixed points joined rigidly, in parallel or in series?"
    return "Is a connector left unconnected, or an equation forgotten?"


def inputs_that_are_set(model: FlatModel, surplus: Sequence[tuple[Origin, int]]) -> str | None:
    """A sentence on inputs of a singular model in surplus equations, by their origins and components, or None."""
    inputs = set(model.inputs.tolist())
    found: dict[str, None] = {}
    for origin, component in surplus:
        for group in model.groups:
            if origin in group.origins:
                for row in group.variables[np.flatnonzero(group.components == component)].tolist():
                    found |= {model.layout.variable(v): None for v in row if v in inputs}
    if not found:
        return None
    what = "the Input" if len(found) == 1 else "the Inputs"
    return (
        f"Does an equation set {what} {listing(found)}, to which nothing is connected? "
        "Connect it, or make it an Output."
    )


def _from_outside(system: Equations, equations: Sequence[int]) -> list[tuple[Origin, int]]:
    """The equations of other components, such as the one above, that set an input that these equations read.

    They have no unknowns but such inputs and what is read.
    """
    model, aliases = system.model, system.aliases
    read = {v for e in equations for v in system.variables[e]}

    def is_read(v: int) -> bool:
        node = int(aliases.representative[v])
        while node >= 0 and node not in read:
            node = int(aliases.derivative[node])
        return node >= 0

    inputs = [v for v in model.inputs.tolist() if is_read(v)]
    own = {v: model.layout.variable(v).rpartition(".")[0] for v in inputs}
    found: dict[tuple[Origin, int], None] = {}
    for group in model.groups if inputs else ():
        for row, column in np.argwhere(np.isin(group.variables, inputs)).tolist():
            component, others = int(group.components[row]), group.variables[row].tolist()
            path = own[int(group.variables[row, column])]
            outside = component >= 0 and model.layout.paths[component] != path
            if outside and all(map(is_read, others)):
                found[group.origins[row], component] = None
    return list(found)


def forgotten_equations(model: FlatModel) -> str | None:
    """A sentence on components that state none of the equations of one of their base classes, or None."""
    found = {
        f"'{c._node.path}' ({type(c).__name__})": base.__name__
        for c in (form.prototype for form in model.layout.forms)
        if (base := _base_without_effect(c)) is not None
    }
    if not found:
        return None
    component, base = next(iter(found.items()))
    also = f", and {len(found) - 1} more likewise" if len(found) > 1 else ""
    return (
        f"{component} states none of the equations of its base class {base}{also}: "
        "is 'yield from super().equations()' missing?"
    )


def _base_without_effect(component: Component) -> type[Component] | None:
    """The first base class whose equations its subclass neither states nor extends."""
    stating = [c for c in type(component).__mro__ if "equations" in vars(c) and c is not Component]
    if len(stating) < 2:
        return None
    own = list(each(component.equations()))
    for base in stating[1:]:
        expected = list(_equations_of(base, component))
        if expected and not any(equation in own for equation in expected):
            return base
    return None


def _equations_of(base: type[Component], component: Component) -> Iterator[Eq]:
    try:
        yield from each(base.equations(component))
    except (NotImplementedError, AttributeError, DeclarationError):
        return  # the base class leaves them to its subclasses
