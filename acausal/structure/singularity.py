"""Diagnosis of singular models: which equations and unknowns do not fit, in the user's names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from acausal.errors import listing
from acausal.flattening import FlatModel
from acausal.modeling import Potential
from acausal.structure import graph
from acausal.structure.equations import Equations
from acausal.structure.suspects import forgotten_equations, inputs_that_are_set


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
    unknowns = model.n_variables - len(model.inputs)
    parts = [f"structurally singular: {model.n_equations} equations for {unknowns} unknowns"]
    unmatched = [bottoms[i] for i in (found.unmatched_variables if found else ())]
    origins = list(zip(system.origin, system.component, strict=True))
    missing = [system.name(node) for node in unmatched]
    unmatched_equations = found.unmatched_equations if found else ()
    surplus = [origins[e] for e in unmatched_equations]
    reached = [*(found.equations if found else ())]
    reached += [other for e in unmatched_equations for other in combined.get(e, ())]
    related = [origins[e] for e in reached if origins[e] not in surplus]
    if missing:
        parts.append(f"undetermined: {listing(missing)}")
    if surplus or aliases.redundant:
        redundant = [model.stated_at(c, o) for o, c in (*surplus, *aliases.redundant)]
        parts.append(f"overdetermined; redundant equations: {listing(dict.fromkeys(redundant), 6)}")
    if related:
        parts.append(
            f"together with: {listing(dict.fromkeys(model.stated_at(c, o) for o, c in related), 6)}"
        )
    floating = any(_is_potential(model, node) for node in unmatched)
    excess = bool(surplus or aliases.redundant)
    mend = (missing and forgotten_equations(model)) or _mend(bool(missing), excess, floating)
    if is_set := inputs_that_are_set(model, (*surplus, *aliases.redundant)):
        mend = f"{is_set} {mend}"
    return "; ".join(parts) + f". {mend}"


def _is_potential(model: FlatModel, node: int) -> bool:
    if node >= model.n_variables:
        return False
    return isinstance(model.layout.variable_declaration(node), Potential)


def _mend(missing: bool, surplus: bool, floating: bool) -> str:
    if not missing:
        return "Are two sources or fixed points joined rigidly, or is an equation stated twice?"
    if floating:
        return "Is a Fixed (a ground, a reference) missing, or a connector left unconnected?"
    if surplus:
        return "Are two sources or fixed points joined rigidly, in parallel or in series?"
    return "Is a connector left unconnected, or an equation forgotten?"
