"""Connection sets: the connectors that are connected to each other, and the equations that follow.

As in Modelica, a connector of a composite belongs to two connection sets: one outside of the composite and one within
it. A *side* is a connector in one of these two roles. Its number is ``2 * v`` for the outer side and ``2 * v + 1`` for
the inner side, where ``v`` is the connector's first variable.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from acausal.errors import ConnectionError
from acausal.flattening.equation_group import EquationGroup
from acausal.flattening.layout import Layout, declared
from acausal.flattening.origin import Origin
from acausal.flattening.sums import Statement, balance
from acausal.flattening.template import Integers, Template, interned, slot
from acausal.modeling import (
    Component,
    Connector,
    Endpoint,
    Flow,
    Input,
    Output,
    charge,
    endpoint_label,
    owner_and_name,
)


@dataclass(frozen=True)
class _ConnectionSet:
    """Connectors, or signals, that are connected to each other.

    Attributes:
        variables: the first variable of each.
        inner: for each, whether its inner side belongs to the set.
        kind: the class of the connectors; None for signals.
    """

    variables: tuple[int, ...]
    inner: tuple[bool, ...]
    kind: type[Connector] | None


@dataclass(frozen=True)
class ConnectionSets:
    """All connection sets of a model, ordered by their first member, and the connected pairs of sides."""

    sets: tuple[_ConnectionSet, ...]
    pairs: Integers


def connection_sets(layout: Layout) -> ConnectionSets:
    """Collect what `Component.connect` connected, across all levels of the hierarchy.

    scipy finds the sets: for 100,000 mass-spring-dampers in 0.34 s, `networkx.connected_components` in 1.7 s and its
    ``UnionFind`` in 1.4 s; and networkx would take 0.07 s to import before every first compilation.

    Raises:
        ConnectionError: where a connected component is not part of the model.
    """
    pairs, kinds = _pairs(layout)
    charge("equations", len(pairs), layout.components[0]._node)
    if not len(pairs):
        return ConnectionSets((), pairs)
    sides, index = np.unique(pairs, return_inverse=True)
    first, second = index.reshape(pairs.shape).T
    graph = coo_array((np.ones(len(first)), (first, second)), shape=(len(sides), len(sides)))
    _, label = connected_components(graph, directed=False)
    order = np.argsort(label, kind="stable")
    members = np.split(sides[order], np.flatnonzero(np.diff(label[order])) + 1)
    members.sort(key=lambda m: int(m[0]))
    sets = tuple(
        _ConnectionSet(
            tuple(int(s) >> 1 for s in m), tuple(bool(s & 1) for s in m), kinds[int(m[0]) >> 1]
        )
        for m in members
    )
    return ConnectionSets(sets, pairs)


def connection_groups(layout: Layout, connected: ConnectionSets) -> tuple[EquationGroup, ...]:
    """Equations of all connections: equal potentials, flows that sum to zero, unconnected flows zero.

    Raises:
        ConnectionError: where two sources feed one signal.
    """
    equal: list[tuple[int, int]] = []
    sums: dict[tuple[bool, ...], list[tuple[int, ...]]] = {}
    for members in connected.sets:
        if members.kind is None:
            _check_sources(layout, members)
            first, *others = members.variables
            equal += [(first, other) for other in others]
            continue
        for offset, declaration in enumerate(members.kind.declarations.values()):
            first, *others = variables = tuple(v + offset for v in members.variables)
            if isinstance(declaration, Flow):
                sums.setdefault(members.inner, []).append(variables)
            else:
                equal += [(first, other) for other in others]
    zero = _unconnected_flows(layout, connected.pairs)
    groups = [*equalities(equal)]
    for inner, rows in sums.items():
        signs = tuple(-1 if i else 1 for i in inner)  # an inner side's flow counts negatively
        groups.append(_group(balance(signs), np.asarray(rows), "connected: flows sum to zero"))
    groups.append(_group(balance((1,)), zero[:, None], "unconnected: no flow"))
    return tuple(g for g in groups if len(g))


def equalities(pairs: Sequence[tuple[int, int]]) -> tuple[EquationGroup, ...]:
    """Equations by which pairs of variables are equal."""
    if not pairs:
        return ()
    return (_group(_equality(), np.asarray(pairs, np.int64), "connected: equal potentials"),)


def feeds(layout: Layout, connected: ConnectionSets) -> dict[int, tuple[int, tuple[int, ...]]]:
    """For each signal that a connection feeds: its source, and all signals of that connection set."""
    found: dict[int, tuple[int, tuple[int, ...]]] = {}
    for signals in connected.sets:
        if signals.kind is None:
            sinks = _fed(layout, signals)
            source = next(v for v in signals.variables if v not in sinks)
            found |= dict.fromkeys(sinks, (source, signals.variables))
    return found


def zeros(variables: Integers, text: str) -> tuple[EquationGroup, ...]:
    """Equations by which variables are zero."""
    return (_group(balance((1,)), variables[:, None], text),) if len(variables) else ()


def model_inputs(layout: Layout, connected: ConnectionSets) -> Integers:
    """Input signals that no connection feeds: the inputs of the model, in order of declaration."""
    inputs = declared(layout, Input).tolist()
    fed = {v for signals in connected.sets if signals.kind is None for v in _fed(layout, signals)}
    return np.asarray([v for v in inputs if v not in fed], dtype=np.int64)


def model_outputs(layout: Layout, connected: ConnectionSets) -> Integers:
    """Output signals that no connection takes, and all of the model itself, in order of declaration."""
    taken = {
        v
        for signals in connected.sets
        if signals.kind is None
        for v, inner in zip(signals.variables, signals.inner, strict=True)
        if not inner and v >= layout.variable_base[1]
    }
    outputs = [v for v in declared(layout, Output).tolist() if v not in taken]
    return np.asarray(outputs, dtype=np.int64)


def _sources(layout: Layout, signals: _ConnectionSet) -> list[bool]:
    """For each signal, whether it is a source: an output seen from outside, an input seen from within."""
    return [
        isinstance(layout.variable_declaration(v), Output) is not inner
        for v, inner in zip(signals.variables, signals.inner, strict=True)
    ]


def _fed(layout: Layout, signals: _ConnectionSet) -> list[int]:
    """The signals that the set determines; where it has no source, its first stays open."""
    sources = _sources(layout, signals)
    sinks = [v for v, source in zip(signals.variables, sources, strict=True) if not source]
    return sinks if any(sources) else sinks[1:]


def _check_sources(layout: Layout, signals: _ConnectionSet) -> None:
    sources = _sources(layout, signals)
    if sum(sources) > 1:
        fed_by = [v for v, source in zip(signals.variables, sources, strict=True) if source]
        names = " and ".join(f"'{layout.variable(v)}'" for v in fed_by[:12])
        raise ConnectionError(f"{names} feed one signal; a signal has one source")


def _pairs(layout: Layout) -> tuple[Integers, dict[int, type[Connector] | None]]:
    """Pairs of connected sides, and the class of each connector by its first variable (None for a signal)."""
    pairs: list[tuple[int, int]] = []
    kinds: dict[int, type[Connector] | None] = {}
    for component in layout.components:
        for ends in component._node.connections:
            sides: list[int] = []
            for end in ends:
                is_own, variable, kind = _locate(layout, component, end)
                kinds[variable] = kind
                sides.append(2 * variable + is_own)
            pairs.append((sides[0], sides[1]))
    return np.asarray(pairs, dtype=np.int64).reshape(-1, 2), kinds


def _locate(
    layout: Layout, composite: Component, end: Endpoint
) -> tuple[bool, int, type[Connector] | None]:
    """For an end that a composite connects: whether it belongs to the composite, its first variable, its class."""
    owner, name = owner_and_name(end)
    number = layout.position.get(id(owner))
    if owner is None or number is None:
        of = "" if owner is None else f" of {owner.label}"
        raise ConnectionError(
            f"{composite._node.label} connects {endpoint_label(end)}{of}, which is not part of the model; "
            "assign that component to an attribute"
        )
    form, base = layout.form(number), int(layout.variable_base[number])
    is_own = owner is composite._node
    if isinstance(end, Connector):
        kind, first = form.connectors[name]
        return is_own, base + first, kind
    return is_own, base + form.variable_index[name], None


def unconnected(layout: Layout) -> tuple[str, ...]:
    """Connectors of parts that nothing is connected to, by dotted name: no flow goes through them."""
    _, *parts = (component._node for component in layout.components)
    nodes = (layout.components[0]._node, *parts)
    ends = (owner_and_name(end) for node in nodes for pair in node.connections for end in pair)
    taken = {(id(owner), name) for owner, name in ends}
    return tuple(
        f"{node.path}.{name}"
        for node in parts
        for name, declared in node.declarations()
        if isinstance(declared, Connector) and (id(node), name) not in taken
    )


def _unconnected_flows(layout: Layout, pairs: Integers) -> Integers:
    connected = np.zeros(int(layout.variable_base[-1]) + 1, dtype=bool)
    sides = pairs.ravel()
    connected[sides[sides % 2 == 0] >> 1] = True
    flows: list[Integers] = []
    for number, form in enumerate(layout.forms):
        base = layout.variable_base[np.flatnonzero(layout.form_of == number)]
        for kind, first in form.connectors.values():
            free = base[~connected[base + first]] + first
            for offset, declaration in enumerate(kind.declarations.values()):
                if isinstance(declaration, Flow):
                    flows.append(free + offset)
    return np.sort(np.concatenate(flows)) if flows else np.empty(0, dtype=np.int64)


def _group(template: Statement, variables: Integers, text: str) -> EquationGroup:
    nothing = np.empty((len(variables), 0), dtype=np.int64)
    components = -1 - variables[:, -1]
    origins = Origin(text).of(len(variables))
    return EquationGroup(template, variables, nothing, nothing, components, origins)


@cache
def _equality() -> Template:
    a, b = slot("a"), slot("b")
    return interned(Template(a - b, (a, b), (0, 0), (), ()))
