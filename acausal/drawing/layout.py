"""Places for boxes and wires: several drawings are made, and the one with the fewest crossings is kept."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

from acausal.drawing.engine import Question
from acausal.drawing.facing import Faced, Facing, face, face_placed
from acausal.drawing.placed import Placed, PlacedBox, Point, Rect
from acausal.drawing.scheme import OPPOSITE, Box, Scheme

EFFORT = 1500
"""How many boxes are placed, in all trials together, to turn boxes the other way round."""

LARGE = 150
"""With more boxes than this, one drawing will do."""

LONGER = 15.0
"""Another length of straight wire at a port, which makes some wires take another way, in pixels."""

HABIT = 6
"""How many more bends a drawing may have that begins as readers expect: with a source of voltage, else with signals."""

WIDE = 1000.0
"""A wider drawing is folded into rows, in pixels."""

FOLDS = (3.0, 2.0, 1.5)
"""Width over height that is tried then."""

ROOM = 16.0
"""Room in the frame of an opened component, in pixels."""

HEADER = 12.0
"""More room at its top, for its name."""


def lay_out(scheme: Scheme) -> Placed:
    """Places for all boxes and wires, from the innermost boxes outwards.

    Raises:
        AcausalError: if graphlay is not installed.
    """
    inner: dict[int, Placed] = {}
    boxes: list[Box] = []
    for number, box in enumerate(scheme.boxes):
        if box.inner is not None:
            inner[number] = _framed(lay_out(box.inner))
            box = _opened(box, inner[number])
        boxes.append(box)
    scheme = replace(scheme, boxes=tuple(boxes))
    placed = _best(scheme, {number: _heights(placed) for number, placed in inner.items()})
    return replace(
        placed,
        boxes=tuple(
            _filled(drawn, inner[number]) if number in inner else drawn
            for number, drawn in enumerate(placed.boxes)
        ),
    )


def _best(scheme: Scheme, gates: dict[int, dict[str, float]]) -> Placed:
    """The best of several drawings of one level, or the author's."""
    if scheme.is_placed:
        return Question(
            scheme, face_placed(scheme), gates, trunks=False, middles=_middles(scheme)
        ).placed()
    if len(scheme.boxes) > LARGE:
        return Question(scheme, face(scheme), gates, trunks=True).placed()
    found: list[tuple[tuple[float, ...], Placed, Faced, bool]] = []
    powered = any(box.icon.source and _begins(box) for box in scheme.boxes)
    for signals_first in (True, False):
        faced = face(scheme, signals_first=signals_first)
        for trunks in (True, False):
            placed, turned_to = _improved(scheme, faced, gates, trunks)
            crossings, bends, length = _cost(placed)
            usual = signals_first != powered
            cost = (crossings, bends + (0 if usual else HABIT), length)
            found.append((cost, placed, turned_to, trunks))
        if not any(net.signal for net in scheme.nets):
            break
    _, best, faced, trunks = min(found, key=lambda drawing: drawing[0])
    if best.bounds.width <= WIDE:
        return best
    folded = (Question(scheme, faced, gates, trunks=trunks, aspect=a).placed() for a in FOLDS)
    return min(best, *folded, key=lambda placed: (placed.flaws, max(placed.bounds.width, WIDE)))


UNIT = 3.4
"""Of Modelica's diagrams, in pixels."""


def _middles(scheme: Scheme) -> dict[int, Point]:
    """Where the author put the parts; outside connectors are beside what they lead to."""
    found = {
        number: (UNIT * box.placement.x, -UNIT * box.placement.y)
        for number, box in enumerate(scheme.boxes)
        if box.placement is not None
    }
    edges = [min(x for x, _ in found.values()), max(x for x, _ in found.values())]
    for net in scheme.nets:
        near = [found[end.box][1] for end in net.ends if end.box in found]
        for end in net.ends:
            if end.box not in found:
                right = scheme.boxes[end.box].ports[0].side == "left"
                x = edges[right] + (50.0 if right else -50.0)
                found[end.box] = x, near[0] if near else 0.0
    return found


def _begins(box: Box) -> bool:
    """Whether what flows through a model comes from here: two ends, and no signal that says how much."""
    return [port.kind for port in box.ports if port.kind != "output"] == ["connector", "connector"]


def _improved(
    scheme: Scheme, faced: Faced, gates: dict[int, dict[str, float]], trunks: bool
) -> tuple[Placed, Faced]:
    """A drawing whose boxes are turned, one after the other, while that makes crossings fewer."""
    best = Question(scheme, faced, gates, trunks=trunks).placed()
    if best.flaws:
        best = min(
            best, Question(scheme, faced, gates, trunks=trunks, stub=LONGER).placed(), key=_cost
        )
    trials = EFFORT // max(len(scheme.boxes), 1)
    for turn in islice(turns(scheme, faced), trials):
        if not best.flaws:
            break
        trial = Question(scheme, turned(faced, turn), gates, trunks=trunks).placed()
        if _cost(trial) < _cost(best):
            best, faced = trial, turned(faced, turn)
    return best, faced


def _cost(placed: Placed) -> tuple[int, int, float]:
    return placed.flaws, placed.bends, placed.length


# -- opened boxes ----------------------------------------------------------------------------------


def _framed(placed: Placed) -> Placed:
    """A drawing whose outside connectors are moved to its left and right edge."""
    bounds = placed.bounds
    edges = {"right": bounds.left - ROOM, "left": bounds.right + ROOM}

    def moved(drawn: PlacedBox) -> PlacedBox:
        if not drawn.box.is_port:
            return drawn
        x = edges[drawn.facing.sides[0]]
        icon = replace(drawn.icon, x=x)
        return replace(drawn, icon=icon, rect=icon, framed=True)

    return replace(placed, boxes=tuple(moved(drawn) for drawn in placed.boxes))


def _frame(placed: Placed) -> Rect:
    """The frame of an opened box: through its outside connectors, which lie in the middle of its edges."""
    gates = [drawn.rect for drawn in placed.boxes if drawn.box.is_port]
    bounds = replace(placed, boxes=tuple(d for d in placed.boxes if not d.box.is_port)).bounds
    left = min([bounds.left - ROOM] + [gate.x for gate in gates])
    right = max([bounds.right + ROOM] + [gate.x for gate in gates])
    top = min([bounds.top] + [gate.top for gate in gates]) - ROOM - HEADER
    bottom = max([bounds.bottom] + [gate.bottom for gate in gates]) + ROOM
    return Rect.between(left, right, top, bottom)


def _heights(placed: Placed) -> dict[str, float]:
    """Where the outside connectors of an opened box are, as parts of its height from its middle."""
    frame = _frame(placed)
    gates = [drawn for drawn in placed.boxes if drawn.box.is_port]
    return {gate.box.label: (gate.rect.y - frame.y) / (frame.height / 2) for gate in gates}


def _opened(box: Box, placed: Placed) -> Box:
    """A box as large as what is drawn in it, with its ports where the outside connectors are."""
    frame = _frame(placed)
    sides = {g.box.label: g.facing.sides[0] for g in placed.boxes if g.box.is_port}
    ports = tuple(
        replace(port, side="left" if sides.get(port.name, "right") == "right" else "right")
        for port in box.ports
    )
    icon = replace(
        box.icon, size=(frame.width, frame.height), frame=True, strokes="", fills="", text=""
    )
    return replace(box, icon=icon, ports=ports)


def _filled(drawn: PlacedBox, placed: Placed) -> PlacedBox:
    frame = _frame(placed)
    moved: Point = (drawn.icon.x - frame.x, drawn.icon.y - frame.y)
    return replace(drawn, inner=(placed, moved))


Turn = tuple[int, Facing]
"""A box, and how it may be turned instead."""


def turns(scheme: Scheme, faced: Faced) -> Iterator[Turn]:
    """Ports above may go below, pictures upside down; gates, and blocks and sensors that feed back, the other way."""
    back = set(_feeding_back(scheme, faced))
    for number, (box, facing) in enumerate(zip(scheme.boxes, faced.boxes, strict=True)):
        gate = box.is_port and box.ports[0].kind == "connector"
        if gate or (number in back and len(box.ports) <= 2):
            sides = {
                port: OPPOSITE[side] if side in ("left", "right") else side
                for port, side in facing.sides.items()
            }
            yield number, replace(facing, sides=sides, mirrored=not facing.mirrored)
        if box.icon.places and not facing.upright:
            sides = {
                p: OPPOSITE[s] if s in ("top", "bottom") else s for p, s in facing.sides.items()
            }
            yield number, replace(facing, sides=sides, flipped=not facing.flipped)
        for port, side in facing.sides.items():
            if side in ("top", "bottom") and box.ports[port].name not in box.icon.sides:
                yield number, replace(facing, sides={**facing.sides, port: OPPOSITE[side]})


def turned(faced: Faced, turn: Turn) -> Faced:
    """The facings with one box turned."""
    number, facing = turn
    return replace(faced, boxes=(*faced.boxes[:number], facing, *faced.boxes[number + 1 :]))


def _feeding_back(scheme: Scheme, faced: Faced) -> Iterator[int]:
    """Boxes whose signal goes to one that is not further right."""
    for net in scheme.nets:
        source, *sinks = net.ends
        place = faced.boxes[source.box].place
        if net.signal and any(faced.boxes[sink.box].place <= place for sink in sinks):
            yield source.box
