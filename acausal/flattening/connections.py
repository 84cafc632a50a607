"""Connection sets: who meets in one node, and the equations that follow.

A connector seen from the component that owns it (its *inside*) and from that component's surroundings (its
*outside*) lies in two different nodes, as in Modelica; a `Side` is a connector in one of these two roles.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from acausal.errors import ConnectionError
from acausal.flattening.sums import Statement, balance
from acausal.flattening.template import EquationGroup, Integers, Template, slot
from acausal.modeling import Component, Connector, Flow, Input, Output, endpoint_label

if TYPE_CHECKING:
    from acausal.flattening.layout import Layout


@dataclass(frozen=True)
class _Node:
    """One connection set: first variables of its connectors, and which are seen from within their owner."""

    variables: tuple[int, ...]
    within: tuple[bool, ...]
    kind: type[Connector] | None


@dataclass(frozen=True)
class ConnectionSets:
    """All nodes of a model, ordered by their first member, and the joined sides they were made of."""

    nodes: tuple[_Node, ...]
    edges: Integers


def connection_sets(layout: Layout) -> ConnectionSets:
    """Collect what `Component.connect` joined, across all levels of the hierarchy.

    Raises:
        ConnectionError: where a connected component is not part of the model.
    """
    edges, kinds = _edges(layout)
    if not len(edges):
        return ConnectionSets((), edges)
    sides, index = np.unique(edges, return_inverse=True)
    pairs = index.reshape(edges.shape)
    graph = coo_array(
        (np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(sides), len(sides))
    )
    _, label = connected_components(graph, directed=False)
    order = np.argsort(label, kind="stable")
    members = np.split(sides[order], np.flatnonzero(np.diff(label[order])) + 1)
    members.sort(key=lambda m: int(m[0]))
    nodes = tuple(
        _Node(tuple(int(s) >> 1 for s in m), tuple(bool(s & 1) for s in m), kinds[int(m[0]) >> 1])
        for m in members
    )
    return ConnectionSets(nodes, edges)


def connection_groups(layout: Layout, sets: ConnectionSets) -> tuple[EquationGroup, ...]:
    """Equations of all connections: equal potentials, flows that sum to zero, unconnected flows zero.

    Raises:
        ConnectionError: where two sources feed one signal.
    """
    equal: list[tuple[int, int]] = []
    sums: dict[tuple[bool, ...], list[tuple[int, ...]]] = {}
    for node in sets.nodes:
        first, *others = node.variables
        if node.kind is None:
            _check_sources(layout, node)
            equal += [(first, other) for other in others]
            continue
        for offset, declaration in enumerate(node.kind.declarations.values()):
            members = tuple(v + offset for v in node.variables)
            if isinstance(declaration, Flow):
                sums.setdefault(node.within, []).append(members)
            else:
                equal += [(members[0], other) for other in members[1:]]
    zero = _unconnected_flows(layout, sets.edges)
    groups = [_group(_equality(), np.asarray(equal, dtype=np.int64).reshape(-1, 2))]
    groups += [_group(_balance(within), np.asarray(rows)) for within, rows in sums.items()]
    groups.append(_group(balance((1,), "unconnected: no flow"), zero[:, None]))
    return tuple(g for g in groups if len(g))


def model_inputs(layout: Layout, sets: ConnectionSets) -> Integers:
    """Input signals that no connection feeds: the inputs of the model, in order of declaration."""
    inputs = _declared(layout, Input)
    fed = {v for node in sets.nodes if node.kind is None for v in _fed(layout, node)}
    return np.asarray([v for v in inputs if v not in fed], dtype=np.int64)


def _fed(layout: Layout, node: _Node) -> list[int]:
    """The signals of a node that it determines; where nothing feeds the node, its first stays open."""
    sinks = [
        v for v, w in zip(node.variables, node.within, strict=True) if not _is_source(layout, v, w)
    ]
    return sinks if len(sinks) < len(node.variables) else sinks[1:]


def _is_source(layout: Layout, variable: int, within: bool) -> bool:
    return isinstance(layout.variable_declaration(variable), Output) is not within


def _check_sources(layout: Layout, node: _Node) -> None:
    sources = [
        v for v, w in zip(node.variables, node.within, strict=True) if _is_source(layout, v, w)
    ]
    if len(sources) > 1:
        names = " and ".join(f"'{layout.variable(v)}'" for v in sources[:12])
        raise ConnectionError(f"{names} feed one signal; a signal has one source")


def _edges(layout: Layout) -> tuple[Integers, dict[int, type[Connector] | None]]:
    """Pairs of joined sides (twice the first variable, plus one if seen from within) and kinds by variable."""
    edges: list[tuple[int, int]] = []
    kinds: dict[int, type[Connector] | None] = {}
    for component in layout.components:
        for ends in component._node.connections:
            sides: list[int] = []
            for end in ends:
                owner, variable, kind = _locate(layout, component, end)
                kinds[variable] = kind
                sides.append(2 * variable + (owner is component._node))
            edges.append((sides[0], sides[1]))
    return np.asarray(edges, dtype=np.int64).reshape(-1, 2), kinds


def _locate(
    layout: Layout, scope: Component, end: Any
) -> tuple[Component, int, type[Connector] | None]:
    owner: Any = end._owner if isinstance(end, Connector) else end.owner
    number = layout.position.get(id(owner))
    if number is None:
        raise ConnectionError(
            f"{scope._node.label} connects {endpoint_label(end)} of {owner.label}, which is not part of the model; "
            "assign that component to an attribute"
        )
    form, base = layout.form(number), int(layout.variable_base[number])
    if isinstance(end, Connector):
        kind, first = form.connectors[end._name]
        return owner, base + first, kind
    return owner, base + form.variable_index[end.path], None


def _declared(layout: Layout, role: type) -> list[int]:
    """Indices of all variables declared as `role`, in order."""
    found: list[Integers] = []
    for number, form in enumerate(layout.forms):
        local = [i for i, (_, d) in enumerate(form.variables) if isinstance(d, role)]
        if local:
            members = np.flatnonzero(layout.form_of == number)
            found.append((layout.variable_base[members][:, None] + np.asarray(local)).ravel())
    return np.sort(np.concatenate(found)).tolist() if found else []


def _unconnected_flows(layout: Layout, edges: Integers) -> Integers:
    connected = np.zeros(int(layout.variable_base[-1]) + 1, dtype=bool)
    outer = edges.ravel()
    connected[outer[outer % 2 == 0] >> 1] = True
    flows: list[Integers] = []
    for number, form in enumerate(layout.forms):
        base = layout.variable_base[np.flatnonzero(layout.form_of == number)]
        for kind, first in form.connectors.values():
            free = base[~connected[base + first]] + first
            for offset, declaration in enumerate(kind.declarations.values()):
                if isinstance(declaration, Flow):
                    flows.append(free + offset)
    return np.sort(np.concatenate(flows)) if flows else np.empty(0, dtype=np.int64)


def _group(template: Statement, variables: Integers) -> EquationGroup:
    nothing = np.empty((len(variables), 0), dtype=np.int64)
    return EquationGroup(template, variables, nothing, nothing, -1 - variables[:, -1])


@cache
def _equality() -> Template:
    a, b = slot("a"), slot("b")
    return Template(a - b, (a, b), (0, 0), (), (), "connected: equal potentials")


def _balance(within: tuple[bool, ...]) -> Statement:
    """Flows out of a node: a connector seen from within counts negatively."""
    return balance(tuple(-1 if w else 1 for w in within), "connected: flows sum to zero")
