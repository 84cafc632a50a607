"""Discrete variables of a flat model: each is given by one equation of events, and only states jump."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from acausal.errors import StructureError, listing
from acausal.flattening import FlatModel, Integers
from acausal.modeling import time
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


def followed(
    model: FlatModel, aliases: AliasFree, reads: Callable[[int], Sequence[int | str]]
) -> set[int]:
    """The nodes that discrete variables follow by equations that must hold between events, too.

    Arguments:
        reads: of a node, the nodes that it is computed from; or the name of what changes between events.

    Raises:
        StructureError: where there is such a name.
    """
    found = set[int]()
    discrete = set(aliases.representative[model.discrete].tolist())
    memories = _memories(model, aliases)
    for update in model.events.updates:
        if not update.always or set(aliases.representative[update.targets].tolist()) <= memories:
            continue
        nodes = aliases.representative[update.group.variables]
        asks = [str(time)] if update.group.template.depends_on_time() else []
        for row in range(len(nodes)):
            left: list[int | str] = [*nodes[row].tolist(), *asks]
            while left:
                if isinstance(node := left.pop(), str):
                    name = model.layout.variable(int(update.targets[row]))
                    origin = update.group.origins[row]
                    raise StructureError(
                        f"the discrete variable '{name}' changes at events alone, but by "
                        f"{model.stated_at(int(update.group.components[row]), origin)} it would follow '{node}' "
                        "between them, too; declare it as ac.Variable, or give it in ac.When(...), such as "
                        "ac.When(ac.sample(0, period), ...)"
                    )
                if node not in discrete and node not in found:
                    found.add(node)
                    left += reads(node)
    return found


def _memories(model: FlatModel, aliases: AliasFree) -> set[int]:
    """The discrete variables without another name of which nothing but the values before events is read."""
    before, read = (set[int]() for _ in range(2))
    for event in model.events.all:
        for column, previous in zip(event.group.variables.T, event.previous, strict=True):
            (before if previous else read).update(aliases.representative[column].tolist())
    for group in aliases.groups:
        read.update(np.unique(group.variables).tolist())
    names = np.bincount(aliases.representative[: model.n_variables])
    return {node for node in before - read if names[node] == 1}
