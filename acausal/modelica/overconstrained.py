"""Overconstrained connections: where connections of redundant records close a loop, which of them is cut.

The virtual connection graph and its spanning trees are those of the Modelica specification 3.6, section 9.4.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

from acausal.modelica.evaluate import Evaluator
from acausal.modelica.syntax import FunctionCall
from acausal.modelica.values import Redundant
from acausal.modeling import Component

GraphNode: TypeAlias = Component | Redundant
"""A record, or variables of a type that has an ``equalityConstraint``."""


@dataclass(eq=False)
class Edge:
    """Two records that a connection makes equal; where it is cut, their ``equalityConstraint`` is zero instead."""

    ends: tuple[GraphNode, GraphNode]
    at: int
    cut: bool = False


@dataclass(eq=False)
class ConnectionGraph:
    """The virtual connection graph of a model; its nodes are records.

    Attributes:
        roots: those that state they are a root. potential: those that may be one, with their priorities.
        branches: pairs that a component relates. edges: pairs that are connected.
        depth: how far each is from the root of its tree.
    """

    roots: list[GraphNode] = field(default_factory=list[GraphNode])
    potential: list[tuple[int, GraphNode]] = field(default_factory=list[tuple[int, GraphNode]])
    branches: list[tuple[GraphNode, GraphNode]] = field(
        default_factory=list[tuple[GraphNode, GraphNode]]
    )
    edges: list[Edge] = field(default_factory=list[Edge])
    depth: dict[GraphNode, int] = field(default_factory=dict[GraphNode, int])

    def cut(self) -> None:
        """Cut connections until each tree has one root and no loop, and measure how far the records are from it."""
        if not (self.roots or self.potential or self.branches or self.edges):
            return
        import networkx as nx  # most models have no such connections, and it takes its time to import

        candidates = [node for _, node in sorted(self.potential, key=lambda item: item[0])]
        forest: Any = nx.Graph(self.branches)
        forest.add_nodes_from([*self.roots, *candidates, *(n for e in self.edges for n in e.ends)])
        trees: Any = nx.utils.UnionFind(forest)
        for pair in self.branches:
            trees.union(*pair)
        rooted = {trees[node] for node in self.roots}
        for edge in self.edges:
            first, second = (trees[node] for node in edge.ends)
            edge.cut = first is second or (first in rooted and second in rooted)
            if not edge.cut:
                forest.add_edge(*edge.ends)
                trees.union(first, second)
                if first in rooted or second in rooted:
                    rooted.add(trees[first])
        for node in (*self.roots, *candidates, *forest):
            if node not in self.depth:
                self.depth |= nx.single_source_shortest_path_length(forest, node)


def note(self: Evaluator, call: FunctionCall) -> None:
    """Take what ``Connections.branch``, ``root`` or ``potentialRoot`` states into the graph of the model."""
    word = call.function.words[-1]
    graph, given = graph_of(self), _records(self, call)
    if word == "branch":
        graph.branches.append((given[0], given[1]))
    elif word == "root":
        graph.roots.append(given[0])
    elif word == "potentialRoot":
        stated = [*call.arguments[1:], *call.named.values()]
        priority = self.whole(self.value(stated[0]), "a priority") if stated else 0
        graph.potential.append((priority, given[0]))


def is_root(self: Evaluator, call: FunctionCall) -> bool:
    """Whether a record is the root of its tree."""
    return _depth(self, call) == 0


def is_rooted(self: Evaluator, call: FunctionCall) -> bool:
    """Whether a record is nearer to the root than the one to which its component relates it."""
    depth, graph, node = _depth(self, call), graph_of(self), _records(self, call)[0]
    pairs = [pair for pair in graph.branches if node in pair]
    return all(depth <= graph.depth[end] for pair in pairs for end in pair)


def graph_of(self: Evaluator) -> ConnectionGraph:
    """The graph of the whole model."""
    build: Any = self.frame.build
    if build is None:
        raise self.wrong("this stands in equations of a model only")
    while build.above is not None:
        build = build.above
    return build.graph


def _depth(self: Evaluator, call: FunctionCall) -> int:
    return graph_of(self).depth.get(_records(self, call)[0], 0)


def _records(self: Evaluator, call: FunctionCall) -> list[GraphNode]:
    before, self.connecting = self.connecting, True
    count = 2 if call.function.words[-1] == "branch" else 1
    found = [self.value(a) for a in call.arguments[:count]]
    self.connecting = before
    if len(found) < count or not all(isinstance(v, Component | Redundant) for v in found):
        spatial = any(np.shape(v) == (3, 3) for v in found)  # the orientation of a frame
        hint = "; spatial mechanics is not supported" if spatial else ""
        name = call.function.text
        raise self.wrong(f"{name} takes records of connectors{hint}", len(name))
    return found
