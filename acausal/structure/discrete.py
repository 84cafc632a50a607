"""Discrete variables of a flat model: each is given by one equation of events, and only states jump."""

from __future__ import annotations

import numpy as np

from acausal.errors import StructureError, listing
from acausal.flattening import FlatModel, Integers
from acausal.structure.aliases import AliasFree


def discrete_nodes(model: FlatModel, aliases: AliasFree) -> Integers:
    """The nodes of the discrete variables: first those of watched conditions.

    Raises:
        StructureError: for one that no equation gives, that two give, that is zero, an input, or differentiated.
    """
    if not len(model.discrete):
        return model.discrete
    free = {aliases.zero: "zero"}
    for v in model.inputs.tolist():
        node, what = int(aliases.representative[v]), f"the input '{model.layout.variable(v)}'"
        while node >= 0:
            free[node] = what
            node, what = int(aliases.derivative[node]), f"the derivative of {what}"
    given: dict[int, str] = {}
    for update in (*model.events.guards, *model.events.updates):
        components = update.group.components.tolist()
        for variable, component in zip(update.targets.tolist(), components, strict=True):
            origin = model.stated_at(component, update.group.origins[0])
            node, name = int(aliases.representative[variable]), model.layout.variable(variable)
            if node in free:
                hint = "" if node == aliases.zero else "; or make the input an Output, if it is set"
                raise StructureError(
                    f"the discrete variable '{name}' is tied to {free[node]}, but given by {origin}; remove one{hint}"
                )
            if node in given:
                raise StructureError(
                    f"two equations give the discrete variable '{name}': {given[node]}, and {origin}"
                )
            given[node] = origin
    nodes = aliases.representative[model.discrete]
    missing = [v for v in model.discrete.tolist() if int(aliases.representative[v]) not in given]
    if missing:
        names = listing([model.layout.variable(v) for v in missing], 6)
        raise StructureError(
            f"no equation gives the discrete variables {names}; yield ac.Eq(variable, ...) or an ac.When(...) for each"
        )
    for node in nodes.tolist():
        if aliases.derivative[node] >= 0:
            raise StructureError(
                f"'{model.layout.variable(node)}' is discrete, so it has no derivative; differentiate another variable"
            )
    _, first = np.unique(nodes, return_index=True)
    return nodes[np.sort(first)]


def check_jumps(model: FlatModel, aliases: AliasFree, states: set[int]) -> None:
    """Refuse jumps of what is not a state, and two of one state."""
    jumping: set[int] = set()
    for group in model.events.jumps:
        for variable in group.targets.tolist():
            node, name = int(aliases.representative[variable]), model.layout.variable(variable)
            if node not in states:
                raise StructureError(
                    f"Reinit of '{name}', which is not a state: only states can jump; give it state=\"always\", or let "
                    "a state that it depends on jump"
                )
            if node in jumping:
                raise StructureError(f"two Reinit of '{name}' in different When(...); join them")
            jumping.add(node)
