"""Expandable connectors: what is connected to them makes their members (Modelica 3.6, section 9.1.3)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from acausal.modelica.sections import SectionReader
from acausal.modelica.statements import fed_by_connections
from acausal.modelica.syntax import FunctionCall
from acausal.modelica.values import (
    Bus,
    BusMember,
    as_array,
    elements,
    nested,
    type_of,
    without_index,
)
from acausal.modeling import Connector, Input, Output, Reference


@dataclass(frozen=True, eq=False)
class BusEnd:
    """Something that is connected to a member of a bus.

    Attributes:
        value: a connector, a signal, an array of signals, or a member of a bus.
        reader: of the class that states it. at: the place of the statement.
    """

    value: Any
    reader: _Collector
    at: int

    @property
    def build(self) -> Any:
        """Of the component whose class states it."""
        return self.reader.frame.build

    @property
    def is_member(self) -> bool:
        """Whether it is a member of a bus, too."""
        return isinstance(self.value, BusMember)

    def wrong(self, reason: str) -> Exception:
        """The error at the connection."""
        self.reader.at = self.at
        return self.reader.wrong(reason, len("connect"))


class _Collector(SectionReader):
    """Reads connections to learn what expandable connectors have to have.

    Attributes:
        joined: signal -> those to which it is connected without a bus.
    """

    joined: dict[Any, list[Any]]

    def noted(self, call: FunctionCall) -> None:
        """Nothing: it is noted when the connections are made."""

    def _join(self, left: Any, right: Any) -> None:
        for one, other in ((left, right), (right, left)):
            if isinstance(one, BusMember) and isinstance(other, Bus):
                one = one.bus.nested(one.name)
            if isinstance(one, Bus) and isinstance(other, Bus | BusMember):
                other = other.bus.nested(other.name) if isinstance(other, BusMember) else other
                one.links.append((self.frame.build, other))
            elif isinstance(one, BusMember) and isinstance(other, list) and [*_buses(other)]:
                for i, element in enumerate(other, start=1):
                    self._join(one.element([i]), element)
            elif isinstance(one, BusMember):
                end = BusEnd(as_array(other), self, self.at)
                one.bus.ends.setdefault(one.name, []).append(end)
            elif isinstance(one, Reference) and isinstance(other, Reference):
                self.joined.setdefault(one, []).append(other)
            elif isinstance(one, list) and isinstance(other, list) and one is left:
                for pair in zip(one, other, strict=False):
                    self._join(*pair)


def expand(top: Any) -> None:
    """Give all expandable connectors of a model the members that are connected to them, or to others in their net.

    Raises:
        ModelicaError: where nothing says what a member is.
    """
    builds = list(_builds(top))
    roots = [value for build in builds for value in build.made.values()]
    if not any(True for _ in _buses(roots)):
        return
    joined: dict[Any, list[Any]] = {}
    for build in builds:
        for kind, stated, node in build.node.view().sections:
            if kind == "equations":
                reader = _Collector(build.frame(node))
                reader.joined = joined
                reader.connections(stated)
    while _spread(list(_buses(roots))):
        pass
    members = [(bus, name) for bus in _buses(roots) for name in bus.ends]
    for bus, name in members:
        used = name in bus.declared and _known(bus, name)  # maybe, in an expression
        if used or _any(bus, name, bus.build, lambda end: True):
            _declare(bus, name)
    for build in builds:
        done = set[tuple[int, str]]()
        for bus, name in members:
            if (id(bus), name) not in done:
                net = list(_net(bus, name, build))
                _connect(build, net)
                done |= {(id(one), word) for one, word in net}


def _builds(build: Any) -> Iterator[Any]:
    yield build
    for part in build.parts_of_text:
        yield from _builds(part._build)


def _buses(value: Any) -> Iterator[Bus]:
    """The expandable connectors among values, and those within them."""
    if isinstance(value, list):
        for one in value:
            yield from _buses(one)
    elif isinstance(value, Bus):
        yield value
        for inner in value.fields.values():
            yield from _buses(inner)


def _connect(build: Any, net: list[tuple[Bus, str]]) -> None:
    """Connect what a component connects through buses: members, and in the place of one that is not there its ends."""
    ends: list[Any] = []
    for bus, name in net:
        if name in bus.fields:
            ends.append(bus.fields[name])
        else:
            ends += [e.value for e in bus.ends[name] if e.build is build and not e.is_member]
    reader = SectionReader(build.frame(build.node))
    reader.at = build.node.definition.at
    for a, b in pairwise(ends):
        reader._join(nested(a), nested(b))


def _spread(buses: list[Bus]) -> bool:
    """Whether members have come to connected buses that had not all of them."""
    changed = False
    for bus in buses:
        for name in bus.ends:
            whole = name.partition("[")[0]
            if isinstance(bus.fields.get(name), Bus) or (whole != name and whole in bus.ends):
                kind = "expandable" if whole == name else "connected as a whole, too"
                raise _known(bus, name)[0].wrong(f"'{bus.name}.{whole}' is {kind}; this end is not")
        for build, other in bus.links:
            for name in bus.ends.keys() - other.ends.keys():
                other.ends[name], changed = [], True
            for name, inner in bus.fields.items():
                pair = (build, other.nested(name))
                if pair not in inner.links:
                    inner.links.append(pair)
                    changed = True
    return changed


def _net(bus: Bus, name: str, within: Any = None) -> Iterator[tuple[Bus, str]]:
    """The member, and those that are connected to it by statements of one class, or of any."""
    todo, seen = [(bus, name)], set[tuple[int, str]]()
    while todo:
        one, word = todo.pop()
        if (id(one), word) not in seen:
            seen.add((id(one), word))
            yield one, word
            links = [(build, other, word) for build, other in one.links]
            links += [
                (e.build, e.value.bus, e.value.name) for e in one.ends.get(word, ()) if e.is_member
            ]
            todo += [link[1:] for link in links if within in (None, link[0])]


def _known(bus: Bus, name: str) -> list[BusEnd]:
    """What is connected to a member anywhere."""
    net = _net(bus, name)
    return [e for one, word in net for e in one.ends.get(word, ()) if not e.is_member]


def _declare(bus: Bus, name: str) -> None:
    """Make a member: of the kind of what is connected to it."""
    build, path = bus.build, f"{bus.name}.{name}"
    known = _known(bus, name)
    end = known[0].value
    first = elements(end)[0] if isinstance(end, np.ndarray) and end.size else end
    if isinstance(first, Connector) and not isinstance(end, np.ndarray):
        declared: Any = type(first)()
    elif isinstance(first, Reference):
        given: Any = {"unit": first.declaration.unit, "shape": np.shape(end) or None}
        kind: Any = getattr(first.declaration, "kind", "real")
        fed = _any(bus, name, build, _feeds) or any(
            one.build is build and word in one.fields for one, word in _net(bus, name, build)
        )
        declared = Output(**given) if fed else Input(kind=kind, **given)
        build.types[without_index(path)] = type_of(first)
    else:
        raise known[0].wrong(
            f"'{path}' of an expandable connector has to be a signal or a connector"
        )
    build.made[path] = bus.fields[name] = as_array(build.component._node.declare(path, declared))


def _any(bus: Bus, name: str, build: Any, test: Callable[[BusEnd], bool]) -> bool:
    """Whether something that is connected to a member within a component is so."""
    for one, word in _net(bus, name, build):
        if one.build is not build and _any(one, word, one.build, test):
            return True
        if any(e.build is build and not e.is_member and test(e) for e in one.ends.get(word, ())):
            return True
    return False


def _feeds(end: BusEnd) -> bool:
    """Whether a signal is a source for the connections that its reader makes."""
    todo, seen, build = elements(end.value)[:1], list[Any](), end.build
    while todo:  # through signals that are passed on
        signal = todo.pop()
        if signal in seen:
            continue
        seen.append(signal)
        own = signal.owner is build.component._node
        if isinstance(signal.declaration, Input if own else Output):
            return True
        if own and signal.path.partition("[")[0] not in fed_by_connections(build):
            return True
        todo += end.reader.joined.get(signal, []) if own else []
    return False
