"""Connections of the text, and what they are made of: loops and conditions that are known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, cast

import numpy as np

from acausal.errors import ModelError
from acausal.modelica import overconstrained
from acausal.modelica.functions import Interpreter
from acausal.modelica.outer import around
from acausal.modelica.overconstrained import Edge, GraphNode
from acausal.modelica.syntax import (
    Branches,
    Connect,
    Do,
    FunctionCall,
    Loop,
    Statement,
)
from acausal.modelica.values import (
    Absent,
    Bus,
    BusMember,
    Record,
    Redundant,
    as_record,
    is_array,
    is_end,
    nested,
    without_index,
)
from acausal.modeling import Component, Connector, Eq, Reference, owner_and_name


class Connecting(Interpreter):
    """Makes the connections of one section."""

    def pairs(self, left: Any, right: Any) -> Iterator[Eq]:
        """The equations ``left = right``."""
        raise NotImplementedError

    def connections(self, stated: Sequence[Statement]) -> None:
        """Connect what the statements connect; loops and conditions are known."""
        for statement in stated:
            self.at = statement.at
            match statement:
                case Connect():
                    self._connect(statement)
                case Loop() if _connects(statement.body):
                    for _ in self.repeated(statement):
                        self.connections(statement.body)
                case Branches() if _connects([s for _, body in statement.branches for s in body]):
                    self.connections(self._chosen(statement))
                case Do() if is_of_graph(statement):
                    self.noted(statement.call)
                case _:
                    pass

    def noted(self, call: FunctionCall) -> None:
        """What is stated about the graph of connections."""
        overconstrained.note(self, call)

    def _connect(self, statement: Connect) -> None:
        self.connecting = True
        ends = [self.value(end) for end in statement.ends]
        self.at, self.connecting = statement.at, False
        assert self.frame.build is not None
        if any(isinstance(end, Absent) for end in ends) or all(
            is_array(e) and not len(e) for e in ends
        ):
            return
        self._join(*(nested(end) for end in ends))

    def _join(self, left: Any, right: Any) -> None:
        """Connect two ends; of those that consist of several each with that of its name."""
        assert self.frame.build is not None
        match left, right:
            case (Bus() | BusMember(), _) | (_, Bus() | BusMember()):
                return  # what comes of it is connected already
            case Record(), Record():
                ends = [
                    {k: nested(v) for k, v in r.fields.items() if is_end(v)} for r in (left, right)
                ]
                if ends[0].keys() != ends[1].keys():
                    names = ", ".join(f"'{n}'" for n in sorted(ends[0].keys() ^ ends[1].keys()))
                    raise self.wrong(f"unlike connectors: only one has {names}", len("connect"))
                for name, end in ends[0].items():
                    self._join(end, ends[1][name])
                for name, record in left.fields.items():
                    if isinstance(record, Component | Redundant):
                        self._relate(record, right.fields[name])
            case list(), list() if len(left) == len(right):
                for a, b in zip(left, right, strict=True):
                    self._join(a, b)
            case list(), list() if isinstance(left[0], list) != isinstance(right[0], list) and len(
                _rows(left)
            ) == len(_rows(right)):  # some classes of the library have one list of all rows
                self._join(_rows(left), _rows(right))
            case (Connector() | Reference(), Connector() | Reference()) if owner_and_name(
                left
            ) == owner_and_name(right):
                return  # one end
            case (Reference(), Reference()) if _has_value(left) or _has_value(right):
                self.frame.build.given_inwards.append((left, right))
            case _:
                try:
                    owners = [
                        owner_and_name(e)[0]
                        for e in (left, right)
                        if isinstance(e, Connector | Reference)
                    ]
                    around(self.frame.build, *owners).component.connect(left, right)
                except ModelError as error:
                    raise self.wrong(str(error), len("connect")) from None

    def _relate(self, left: GraphNode, right: GraphNode) -> None:
        """Connect redundant records of two connectors."""
        edge = Edge((left, right), self.at)
        owners = [e.build.component if isinstance(e, Redundant) else e for e in edge.ends]
        around(self.frame.build, *(e._node for e in owners)).edges.append(edge)
        overconstrained.graph_of(self).edges.append(edge)

    def related(self, edge: Edge) -> Iterator[Eq]:
        """The equations of a connection of redundant records."""
        self.at = edge.at
        ends = [as_record(end) for end in edge.ends]
        if not edge.cut:
            yield from self.pairs(*ends)
            return
        left = edge.ends[0]
        node = left.node if isinstance(left, Redundant) else ends[0].node
        residual = self.called(node.member("equalityConstraint"), ends, {})
        yield from self.pairs(residual, np.zeros(np.shape(residual), dtype=object))

    def repeated(self, loop: Loop) -> Iterator[None]:
        """Once for all values of the loop's variables."""
        if loop.condition is not None:
            raise self.wrong("'while' stands in algorithms only")
        for _ in self.iterated(loop.iterators):
            yield

    def _chosen(self, statement: Branches) -> list[Statement]:
        """The branch that is taken, which has to be known."""
        for test, body in statement.branches:
            if self.known(self.holds(test), "a condition of connections"):
                return body
        return []


def _has_value(end: Reference) -> bool:
    """Whether this is an input whose declaration gives it a value, so that a connection is one more equation."""
    component = getattr(end.owner, "component", None)
    build = None if component is None else component.__dict__.get("_build")
    return build is not None and without_index(end.path) in build.bound_inputs


def _rows(ends: Any) -> list[Any]:
    """The elements of nested lists, row by row."""
    many = isinstance(ends, list)
    return [e for one in cast(list[Any], ends) for e in _rows(one)] if many else [ends]


def _connects(stated: Iterable[Statement]) -> bool:
    """Whether statements connect something."""
    return any(True for _ in _connections(stated)) or any(map(is_of_graph, stated))


def is_of_graph(statement: Statement) -> bool:
    """Whether a statement is one about overconstrained connections."""
    return isinstance(statement, Do) and statement.call.function.words[0] == "Connections"


def ends_of(stated: Iterable[Statement]) -> set[str]:
    """The signals and connectors of a class itself that statements connect."""
    ends = [end for one in _connections(stated) for end in one.ends]
    return {end.words[0] for end in ends if len(end.words) == 1}


def _connections(stated: Iterable[Statement]) -> Iterator[Connect]:
    """The connections among statements, at any depth."""
    for statement in stated:
        match statement:
            case Connect():
                yield statement
            case Loop():
                yield from _connections(statement.body)
            case Branches():
                for _, body in statement.branches:
                    yield from _connections(body)
            case _:
                pass
