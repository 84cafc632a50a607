"""The layout engine: a layered layout with orthogonal wires, by the package graphlay.

It is asked twice: first which order the ports of a side should have, then with the ports in their places.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import median
from typing import Any

from acausal.drawing.crossings import Point, branches, without_stub
from acausal.drawing.facing import Faced
from acausal.drawing.placed import Placed, PlacedBox, PlacedNet, Rect
from acausal.drawing.scheme import Box, End, Net, Scheme
from acausal.drawing.sizes import Size, hangs, size_of
from acausal.errors import AcausalError, need_package
from acausal.modeling import Side

NODE = 4.0
"""Size of a node of three or more wires, in pixels."""

JOG = 3.0
"""A wire does not step aside by so little, in pixels."""

STUB = 9.0
"""How far a wire goes straight on from a port, at least, in pixels."""

OPTIONS: Mapping[str, Any] = {
    "direction": "leftright",
    "spacing": {
        "layer_gap": 34.0, "node_gap": 14.0, "dummy_gap": 14.0, "port_gap": 12.0,
        "isolated_gap": 24.0,
    },
    "routing": {"bundle_parallel": False, "lane_gap": 10.0},
}  # fmt: skip


@dataclass(frozen=True)
class _Wire:
    """An edge of the layout: from and to are an end of a net, or None for the net's node."""

    net: int
    source: End | None
    target: End | None


class Question:
    """One question to the layout engine.

    Arguments:
        scheme, faced: what to draw.
        gates: for an opened box, by its number, the places of its ports from -1 at its top to 1.
        trunks: whether the wires of a node leave it on one line.
        stub: how far a wire goes straight on from a port, at least, in pixels.
        aspect: width over height that rows are folded for; 0 for one row.
        middles: of pictures, by the number of their box; then only wires are laid.
    """

    def __init__(
        self,
        scheme: Scheme,
        faced: Faced,
        gates: Mapping[int, Mapping[str, float]],
        *,
        trunks: bool,
        stub: float = STUB,
        aspect: float = 0.0,
        middles: Mapping[int, Point] | None = None,
    ) -> None:
        self.scheme, self.faced, self.gates = scheme, faced, gates
        self.trunks, self.stub, self.aspect, self.middles = trunks, stub, aspect, middles
        used: list[set[int]] = [set() for _ in scheme.boxes]
        for net in scheme.nets:
            for end in net.ends:
                used[end.box].add(end.port)
        self.sizes = [
            size_of(b, f, u) for b, f, u in zip(scheme.boxes, faced.boxes, used, strict=True)
        ]
        self.wires = list(self._wires())
        self.node_of = {
            number: len(scheme.boxes) + i
            for i, number in enumerate(n for n, net in enumerate(scheme.nets) if len(net.ends) > 2)
        }

    def placed(self) -> Placed:
        """The layout, with each port where the order of the wires wants it."""
        if not self.scheme.boxes:
            return Placed((), ())
        first = self._ask(self._graph({}))
        return self._read(self._ask(self._graph(self._offsets(first))))

    def _ask(self, graph: dict[str, Any]) -> dict[str, Any]:
        graphlay = need_package("graphlay", "Drawing a model", "diagram", AcausalError)
        spacing = {**OPTIONS["spacing"], "stub": self.stub}
        fold = {"viewport_aspect": self.aspect}
        work = graphlay.layout if self.middles is None else graphlay.reroute
        options = {**OPTIONS, "spacing": spacing, "wrap": fold}
        return json.loads(work(graph, options=options).to_json())

    # -- the question ----------------------------------------------------------------------------

    def _wires(self) -> Iterator[_Wire]:
        """Edges from left to right: a net of two ends is one, a larger one has a node in the middle."""
        for number, net in enumerate(self.scheme.nets):
            if len(net.ends) == 1:
                continue
            if len(net.ends) == 2:
                a, b = net.ends
                forward = self._leaves(a, number) >= self._leaves(b, number)
                yield _Wire(number, a, b) if forward else _Wire(number, b, a)
                continue
            for end in net.ends:
                leaves = self._leaves(end, number) > 0
                yield _Wire(number, end, None) if leaves else _Wire(number, None, end)

    def _leaves(self, end: End, net: int) -> float:
        """Positive if a wire leaves a box here, negative if it arrives; larger for boxes further left."""
        facing = self.faced.boxes[end.box]
        side = facing.sides.get(end.port, "right")
        if side in ("left", "right"):
            return (1.0 if side == "right" else -1.0) - 1e-3 * facing.place
        if self.scheme.nets[net].signal:
            return 1e-3 if end == self.scheme.nets[net].ends[0] else -1e-3
        return 1e-3 if facing.place <= self.faced.nets[net] else -1e-3

    def _graph(self, offsets: Mapping[End, float]) -> dict[str, Any]:
        nodes = [_node(*size.outside, self._rank(number)) for number, size in enumerate(self.sizes)]
        nodes += [_node(NODE, NODE) for _ in self.node_of]
        for number, (x, y) in self._middles().items():
            nodes[number]["position"] = {"x": x, "y": y}
        edges = [self._edge(wire, offsets) for wire in self.wires]
        return {"nodes": nodes, "edges": edges}

    def _middles(self) -> dict[int, Point]:
        """Of all nodes, if boxes have theirs: a net's is at the medians of where its wires leave boxes."""
        if self.middles is None:
            return {}
        found = {n: (x - self.sizes[n].shift, y) for n, (x, y) in self.middles.items()}
        for net, node in self.node_of.items():
            ends = [self._before(end, *found[end.box]) for end in self.scheme.nets[net].ends]
            found[node] = (median(x for x, _ in ends), median(y for _, y in ends))
        return found

    def _before(self, end: End, x: float, y: float) -> Point:
        """A point before the middle of the side that an end is on."""
        (width, height), side = self.sizes[end.box].outside, self._side(end)
        dx = {"left": -1.0, "right": 1.0}.get(side, 0.0) * (width / 2 + self.stub)
        dy = {"top": -1.0, "bottom": 1.0}.get(side, 0.0) * (height / 2 + self.stub)
        return x + dx, y + dy

    def _rank(self, number: int) -> str:
        """Outside connectors are in the first or last layer."""
        if not self.scheme.boxes[number].is_port:
            return "free"
        return "first" if self.faced.boxes[number].sides[0] == "right" else "last"

    def _edge(self, wire: _Wire, offsets: Mapping[End, float]) -> dict[str, Any]:
        edge: dict[str, Any] = {"weight": 1.0}
        for key, end in (("source", wire.source), ("target", wire.target)):
            if end is None:
                edge[key] = self.node_of[wire.net]
                if self.trunks:
                    side = "right" if key == "source" else "left"
                    edge[f"{key}_port"] = {"offset": {"side": side, "t": 0.0}}
                continue
            edge[key] = end.box
            side = self._side(end)
            edge[f"{key}_port"] = (
                {"offset": {"side": side, "t": offsets[end]}} if end in offsets else {"side": side}
            )
        return edge

    def _side(self, end: End) -> Side:
        return self.faced.boxes[end.box].sides.get(end.port, "right")

    def _offsets(self, answer: dict[str, Any]) -> dict[End, float]:
        """Where ports go on their sides, from -1 to 1: evenly, in the order that the wires want."""
        along: dict[tuple[int, Side], dict[End, float]] = {}
        for wire, edge in zip(self.wires, answer["edges"], strict=True):
            for end, port in ((wire.source, "source_port"), (wire.target, "target_port")):
                if end is not None:
                    point, side = edge[port]["point"], self._side(end)
                    value = point["y"] if side in ("left", "right") else point["x"]
                    along.setdefault((end.box, side), {})[end] = value
        offsets: dict[End, float] = {}
        for (box, side), ends in along.items():
            icon, outside = self.sizes[box].icon, self.sizes[box].outside
            axis = 1 if side in ("left", "right") else 0
            if places := self._places(box, ends):
                share = icon[axis] / outside[axis]
                facing = self.faced.boxes[box]
                way = -1 if (facing.mirrored, facing.flipped)[axis] else 1
                offsets |= {end: way * share * place for end, place in places.items()}
                continue
            spread = _spread(len(ends), upright=self.faced.boxes[box].upright)
            order = sorted(ends, key=lambda end: (ends[end], end))
            for end, share in zip(order, spread, strict=True):
                offsets[end] = share * icon[axis] / outside[axis]
        return offsets

    def _places(self, box: int, ends: Iterable[End]) -> dict[End, float]:
        """Places of the ports of a side, if its frame or its icon has one for each of them."""
        if self.faced.boxes[box].upright:
            return {}
        known = self.gates.get(box, self.scheme.boxes[box].icon.places)
        names = {end: self.scheme.port(end).name for end in ends}
        return (
            {e: known[n] for e, n in names.items()} if known.keys() >= set(names.values()) else {}
        )

    # -- the answer ------------------------------------------------------------------------------

    def _read(self, answer: dict[str, Any]) -> Placed:
        rects = [_rect(node) for node in answer["nodes"]]
        lines: dict[int, list[tuple[Point, ...]]] = {}
        ports: dict[End, Point] = {}
        for wire, edge in zip(self.wires, answer["edges"], strict=True):
            line = _square([(p["x"], p["y"]) for p in edge["points"]])
            if wire.source is None:
                line = _snapped(line, rects[self.node_of[wire.net]])
            if wire.target is None:
                line = _snapped(line[::-1], rects[self.node_of[wire.net]])[::-1]
            line = _straightened(_without_jogs(line))
            for end, point in ((wire.source, line[0]), (wire.target, line[-1])):
                if end is not None:
                    ports[end] = point
            outward = line[::-1] if wire.target is None else line
            lines.setdefault(wire.net, []).append(tuple(outward))
        nets = tuple(
            _placed_net(self.scheme.nets[number], own) for number, own in sorted(lines.items())
        )
        placed = tuple(
            PlacedBox(
                box, self.faced.boxes[i], rects[i], _icon(box, rects[i], self.sizes[i]),
                {end.port: point for end, point in ports.items() if end.box == i},
            )
            for i, box in enumerate(self.scheme.boxes)
        )  # fmt: skip
        return Placed(placed, nets)


def _node(width: float, height: float, rank: str = "free") -> dict[str, Any]:
    size = {"width": width, "height": height}
    return {"size": size, "shape": "box", "key": "", "rank": rank}


def _rect(node: dict[str, Any]) -> Rect:
    center, size = node["center"], node["size"]
    return Rect(center["x"], center["y"], size["width"], size["height"])


def _placed_net(net: Net, lines: Sequence[tuple[Point, ...]]) -> PlacedNet:
    """A net with dots where its lines part, and without the piece in which all still run together."""
    if len(lines) > 1:
        lines = without_stub(lines)
    return PlacedNet(net, tuple(lines), tuple(branches(lines)))


def _icon(box: Box, rect: Rect, size: Size) -> Rect:
    middle = rect.y + size.icon[1] / 2 if hangs(box) else rect.y
    return Rect(rect.x + size.shift, middle, *size.icon)


def _spread(count: int, *, upright: bool) -> list[float]:
    """Places of ports on a side from -1 to 1; those of an upright element are at its ends."""
    if upright and count == 2:
        return [-0.94, 0.94]
    return [(2 * i + 1) / count - 1 for i in range(count)]


def _square(line: list[Point]) -> list[Point]:
    """The line with pieces that are a pixel off put straight."""
    line = list(line)
    for i, ((x, y), (u, v)) in enumerate(pairwise(line)):
        if x == u or y == v:
            continue
        steep = abs(x - u) < abs(y - v)
        if i == 0:
            line[1] = (x, v) if steep else (u, y)
        else:
            line[i] = (u, y) if steep else (x, v)
    return line


def _snapped(line: list[Point], node: Rect) -> list[Point]:
    """A line that starts at the edge of a node, moved to start in its middle."""
    (_, y), (u, v) = line[0], line[1]
    middle = node.x, node.y
    second = (u, node.y) if y == v else (node.x, v)
    return [middle, second, *line[2:]]


def _without_jogs(line: list[Point]) -> list[Point]:
    """The line without steps too small to mean anything; what follows a step moves by it."""
    line = list(line)
    for i, ((x, y), (u, v)) in enumerate(pairwise(line)):
        dx, dy = u - x, v - y
        last = i + 2 == len(line)
        if last or not 0 < abs(dx) + abs(dy) <= JOG:
            continue
        for j in (i + 1, i + 2):
            line[j] = (line[j][0] - dx, line[j][1] - dy)
    return line


def _straightened(line: list[Point]) -> list[Point]:
    """The line without points that repeat or lie on the way."""
    kept = [line[0]]
    for here, after in pairwise([*line[1:], line[-1]]):
        if here == kept[-1]:
            continue
        on_the_way = here != after and any(kept[-1][i] == here[i] == after[i] for i in (0, 1))
        if not on_the_way:
            kept.append(here)
    return kept if len(kept) > 1 else [line[0], line[-1]]
