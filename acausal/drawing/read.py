"""What there is to draw of a model: its parts as boxes, its connections as nets."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from networkx.utils import UnionFind

from acausal.drawing.ports import SIGNAL, color_of, port_of_element, ports_of, side_of_gate
from acausal.drawing.scheme import OPPOSITE, Box, End, Footing, Kind, Net, Port, Scheme
from acausal.modeling import Component, Connector, Icon, Input, Module, full_name, owner_and_name

MANY = 8
"""A list with more components than this is drawn as one box."""

GATE = Icon(size=(12.0, 12.0))
"""The picture of an outside connector of what is drawn."""


def read(model: Component, depth: int = 1) -> Scheme:
    """The parts of a model and how they are connected.

    Arguments:
        model: the component whose parts are drawn.
        depth: how many levels of parts are shown; parts with parts of their own are opened above the last.
            At 0 the model itself is one box.
    """
    return _Reader(model, depth, ()).scheme()


class _Reader:
    """Reads one level, and the levels below it in the boxes that are opened.

    Arguments:
        model: the component whose parts are read.
        depth: how many levels are shown.
        reached: connectors of the model, and of parts of it, to which levels above connect something.
    """

    def __init__(self, model: Component, depth: int, reached: Iterable[Any]) -> None:
        self.model, self.depth, self.reached = model, depth, tuple(reached)
        self.boxes: list[Box] = []
        self.port_index: list[dict[str, int]] = []
        self.box_of: dict[str, int] = {}
        self.parts: dict[int, Component] = {}  # that stand alone, by the number of their box
        self.from_outside: dict[int, list[Any]] = {}  # connected ends, by box
        self.gates: dict[str, int] = {}
        for label, parts in [*(_families(model) if depth else ())] or _itself(model, depth):
            number = self._add_box(parts[0], label, len(parts))
            self.box_of |= {part._node.name: number for part in parts}
            if len(parts) == 1:
                self.parts[number] = parts[0]

    def scheme(self) -> Scheme:
        """Boxes and nets, with grounds at each component that needs them."""
        nets = tuple(self._nets())  # which may add ports to boxes
        for number, part in self.parts.items() if self.depth > 1 else ():
            if self.boxes[number].inside:
                inner = _Reader(part, self.depth - 1, self.from_outside.get(number, ())).scheme()
                self.boxes[number] = replace(self.boxes[number], inner=inner)
        scheme = Scheme(tuple(self.boxes), nets)
        return scheme if scheme.is_placed else with_local_references(scheme)

    # -- boxes -----------------------------------------------------------------------------------

    def _add_box(self, part: Component, label: str, count: int) -> int:
        role = type(part).__name__
        icon = _icon(part)
        ports = ports_of(part, icon, is_list=count > 1)
        path = part._node.path if count == 1 else part._node.path.rpartition("[")[0]
        self.port_index.append({port.name: i for i, port in enumerate(ports)})
        inside = bool(part._node.children and part._node.connections)
        box = Box(path, label, role, icon, ports, count, learned=learns(part), inside=inside)
        box = replace(box, placement=part._node.placement if count == 1 else None)
        self.boxes.append(box)
        return len(self.boxes) - 1

    def _add_port(self, box: int, port: Port) -> int:
        self.boxes[box] = replace(self.boxes[box], ports=(*self.boxes[box].ports, port))
        return len(self.boxes[box].ports) - 1

    # -- ends ------------------------------------------------------------------------------------

    def _end(self, end: Any, *, outside: bool = False) -> _Fine:
        """The connector of an end, with the box and the port that it is drawn at.

        ``outside``: whether levels above reach into the model for it, so that it is a gate.
        """
        owner, name = owner_and_name(end)
        route = () if owner is None else owner.route_from(self.model._node) or ()
        if outside or not route:
            name = ".".join((*route, name))
            return _Fine("", name, self._gate(end, name))
        part, *rest = route
        name = ".".join((*rest, name))
        box = self.box_of[part]
        self.from_outside.setdefault(box, []).append(end)
        return _Fine(part, name, End(box, self._port(box, end, name)))

    def _port(self, box: int, end: Any, name: str) -> int:
        """The number of a box's port; a connector of a part inside it becomes a port of the box."""
        index = self.port_index[box]
        whole = name.rpartition("[")[0] if name.endswith("]") else name
        if name not in index and whole not in index:
            kind, color = _kind_and_color(end)
            index[name] = self._add_port(box, Port(name, kind, side_of_gate(kind, None), color))
        return index.get(name, index.get(whole, 0))

    def _gate(self, end: Any, name: str) -> End:
        """An outside connector: a small box."""
        node: Any = self.model._node
        shape = getattr(node.declaration(name.partition("[")[0]), "shape", None)
        name = port_of_element(name, shape[0] if shape and isinstance(shape[0], int) else 1)
        if name not in self.gates:
            kind, color = _kind_and_color(end)
            ports = {port.name: port for port in ports_of(self.model, _icon(self.model))}
            usual = ports[name].side if name in ports else None
            inward = OPPOSITE[side_of_gate(kind, usual)]
            self.gates[name] = len(self.boxes)
            self.port_index.append({})
            path = full_name(node.path, name)
            port = Port(name, kind, inward, color)
            self.boxes.append(Box(path, name, "", GATE, (port,), is_port=True))
        return End(self.gates[name], 0)

    # -- nets ------------------------------------------------------------------------------------

    def _nets(self) -> Iterator[Net]:
        """Connected ends, joined. Of nets between the same ports, as lists have them, one is drawn."""
        sets: Any = UnionFind()
        given: dict[_Fine, Any] = {}
        for a, b, pair in self._connections():
            given.setdefault(a, pair[0])
            given.setdefault(b, pair[1])
            sets.union(a, b)
        together: dict[_Fine, list[_Fine]] = {}
        for fine in given:
            together.setdefault(sets[fine], []).append(fine)
        seen: set[tuple[End, ...]] = set()
        used: set[End] = set()
        for fine in together.values():
            ends = list(dict.fromkeys(f.end for f in fine))
            if len(ends) < 2 or self._within_list(ends) or tuple(sorted(ends)) in seen:
                continue
            seen.add(tuple(sorted(ends)))
            names = {f.end: _name_of_end(given[f]) for f in reversed(fine)}
            kind = _kind_and_color(given[fine[0]])[0]
            colors = [self.boxes[end.box].ports[end.port].color for end in ends]
            color = next((color for color in colors if color != SIGNAL), SIGNAL)
            if kind != "connector":
                ends.sort(key=lambda end: not self._is_source(end))
            own = tuple(self._own(end, used) for end in ends)
            yield Net(own, tuple(names[e] for e in ends), kind != "connector", color)

    def _connections(self) -> Iterator[tuple[_Fine, _Fine, tuple[Any, Any]]]:
        """Pairs of connectors, and their ends; those that levels above reach are connected to a gate."""
        for a, b in self.model._node.connections if self.depth else ():
            yield self._end(a), self._end(b), (a, b)
        for end in self.reached:
            owner, name = owner_and_name(end)
            if owner is self.model._node:
                self._gate(end, name)
            else:
                yield self._end(end, outside=True), self._end(end), (end, end)

    def _within_list(self, ends: list[End]) -> bool:
        """Whether a net only joins components of one list."""
        return len({end.box for end in ends}) == 1 and self.boxes[ends[0].box].count > 1

    def _own(self, end: End, used: set[End]) -> End:
        """A port for each net: a list's port, or a vector's, may have several."""
        if end in used:
            end = End(end.box, self._add_port(end.box, self.boxes[end.box].ports[end.port]))
        used.add(end)
        return end

    def _is_source(self, end: End) -> bool:
        """Whether a signal comes from here."""
        box = self.boxes[end.box]
        return box.ports[end.port].kind == ("input" if box.is_port else "output")


@dataclass(frozen=True)
class _Fine:
    """A connector by the name of its part and its own, and where it is drawn."""

    part: str
    name: str
    end: End


def _families(component: Component) -> Iterator[tuple[str, list[Component]]]:
    """Label and parts: one part each, but all of a long list of one class together."""
    families: dict[tuple[str, type], list[Component]] = {}
    for name, part in component._node.children.items():
        families.setdefault((name.partition("[")[0], type(part)), []).append(part)
    for (name, _), parts in families.items():
        if len(parts) > MANY:
            yield name, parts
        else:
            for part in parts:
                yield part._node.name, [part]


def _itself(component: Component, depth: int) -> list[tuple[str, list[Component]]]:
    """A component without parts is drawn as its icon, and so is any at depth 0."""
    drawn = component.ICON is not None or depth == 0
    return [(component._node.name, [component])] if drawn else []


def learns(part: Component) -> bool:
    """Whether there is a network in a component."""
    return any(isinstance(d, Module) and not d.data for _, d in part._node.declarations()) or any(
        learns(child) for child in part._node.children.values()
    )


def default_icon(role: str) -> Icon:
    """A box with the name of the class, for classes that state no picture."""
    return Icon(text=role, size=(max(60.0, 6.0 * len(role) + 14.0), 40.0), frame=True)


def _icon(part: Component) -> Icon:
    return part.ICON or default_icon(type(part).__name__)


def _kind_and_color(end: Any) -> tuple[Kind, str]:
    if isinstance(end, Connector):
        return "connector", end.COLOR
    return ("input" if isinstance(end.declaration, Input) else "output"), color_of(end.declaration)


def _name_of_end(end: Any) -> str:
    owner, name = owner_and_name(end)
    return full_name("" if owner is None else owner.path, name)


def with_local_references(scheme: Scheme) -> Scheme:
    """Draw a ground that is connected to several components once at each of them.

    Only a component whose icon says ``reference`` is repeated; all its copies have its path. It is drawn right
    at the port but where several ports share a side.
    """
    boxes: list[Box | None] = list(scheme.boxes)
    nets: list[Net] = []
    for net in scheme.nets:
        ground = next((e for e in net.ends if scheme.boxes[e.box].icon.reference), None)
        if ground is None or len(scheme.boxes[ground.box].ports) != 1:
            nets.append(net)
            continue
        own = scheme.boxes[ground.box]
        own_name = net.names[net.ends.index(ground)]
        boxes[ground.box] = None
        for end, name in zip(net.ends, net.names, strict=True):
            box = boxes[end.box]
            if end == ground or box is None:
                continue
            if _may_go_below(box, end.port):
                lowered = replace(box.ports[end.port], side="bottom")
                ports = (*box.ports[: end.port], lowered, *box.ports[end.port + 1 :])
                box = replace(box, ports=ports)
            if _has_room(box, end.port):
                footing = Footing(end.port, own.path, own.role, own.icon, (name, own_name))
                boxes[end.box] = replace(box, footings=(*box.footings, footing))
                continue
            copy = End(len(boxes), ground.port)
            boxes.append(own)
            nets.append(replace(net, ends=(end, copy), names=(name, own_name)))
    return _without_gaps(boxes, scheme, nets)


def _has_room(box: Box, port: int) -> bool:
    """Whether a port will have a side for itself: above or below, or as one of the two ends of an element."""
    level = any(p.side in ("left", "right") and p.kind == "connector" for p in box.ports)
    side = box.ports[port].side
    return not box.is_port and (side in ("top", "bottom") or (side is None and not level))


def _may_go_below(box: Box, port: int) -> bool:
    """Whether a ground fits below a closed box: one whose ports have no places of their own."""
    closed = box.icon.frame and box.inner is None and not box.icon.strokes
    return closed and not _has_room(box, port) and all(p.side != "bottom" for p in box.ports)


def _without_gaps(boxes: list[Box | None], scheme: Scheme, nets: list[Net]) -> Scheme:
    """The scheme with the boxes that are left."""
    kept = [number for number, box in enumerate(boxes) if box is not None]
    new = {old: number for number, old in enumerate(kept)}
    moved = tuple(
        replace(net, ends=tuple(End(new[e.box], e.port) for e in net.ends if e.box in new))
        for net in nets
    )
    return Scheme(tuple(box for box in boxes if box is not None), moved)
