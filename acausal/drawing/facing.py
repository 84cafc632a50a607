"""Which way each box faces: the sides of its ports, so that a drawing reads from left to right.

A walk through the model from its sources gives every net a position. An element with two connectors lies between its
nets, mirrored if need be; between two nets at one position it stands upright, as a capacitor beside a source.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass

from acausal.drawing.scheme import OPPOSITE, Box, Scheme
from acausal.modeling import Placement, Side


@dataclass(frozen=True)
class Facing:
    """How a box is turned.

    Attributes:
        sides: the side of each port, by its number.
        mirrored: whether left and right are exchanged.
        upright: whether an element that usually lies stands.
        place: its position from left to right, as a number of steps.
        flipped: whether top and bottom are exchanged.
    """

    sides: Mapping[int, Side]
    mirrored: bool
    upright: bool
    place: float
    flipped: bool = False


@dataclass(frozen=True)
class Faced:
    """All boxes with their facings, and the position of each net."""

    boxes: tuple[Facing, ...]
    nets: tuple[float, ...]


def face(scheme: Scheme, *, signals_first: bool = True) -> Faced:
    """Turn every box, beginning with the sources of signals, or with other sources such as voltages."""
    return _Walk(scheme, signals_first).faced()


def face_placed(scheme: Scheme) -> Faced:
    """Turn every box as its author did; outside connectors face the middle."""
    boxes = tuple(_as_placed(box) for box in scheme.boxes)
    ends = ([boxes[end.box].place for end in net.ends] for net in scheme.nets)
    return Faced(boxes, tuple(sum(places) / len(places) for places in ends))


ROUND: tuple[Side, ...] = ("left", "bottom", "right", "top")
"""Sides in the order in which they follow each other as a box is turned."""


def _as_placed(box: Box) -> Facing:
    placement = box.placement or Placement(0.0, 0.0)
    free = [i for i, port in enumerate(box.ports) if port.side is None]
    first: Side = "right" if box.icon.source and len(free) == 1 else "left"
    sides: dict[int, Side] = {
        i: port.side or (first if i == free[0] else "right") for i, port in enumerate(box.ports)
    }
    if box.icon.reference:
        sides = {i: box.icon.sides.get(box.ports[i].name, side) for i, side in sides.items()}
    if placement.mirrored:
        sides = {i: OPPOSITE[s] if s in ("left", "right") else s for i, s in sides.items()}
    quarters = 0 if box.icon.reference else placement.turned // 90
    sides = {i: ROUND[(ROUND.index(s) + quarters) % 4] for i, s in sides.items()}
    upright = quarters % 2 == 1 and not box.icon.frame
    half = quarters == 2
    return Facing(sides, placement.mirrored != half, upright, placement.x, half)


class _Walk:
    def __init__(self, scheme: Scheme, signals_first: bool) -> None:
        self.scheme, self.signals_first = scheme, signals_first
        self.net_at: list[dict[int, int]] = [{} for _ in scheme.boxes]
        for number, net in enumerate(scheme.nets):
            for end in net.ends:
                self.net_at[end.box].setdefault(end.port, number)
        self.facing: dict[int, Facing] = {}
        self.position: dict[int, float] = {}
        self.leftward: set[int] = set()  # nets that were first reached from the right

    def faced(self) -> Faced:
        """Walk from each start that no earlier walk has reached."""
        for start in self._starts():
            if start not in self.facing:
                self._walk(start)
        boxes = tuple(self.facing[i] for i in range(len(self.scheme.boxes)))
        return Faced(boxes, tuple(self.position.get(i, 0.0) for i in range(len(self.scheme.nets))))

    def _starts(self) -> list[int]:
        """Sources first, then what has outputs only, then the others; in order of declaration."""

        def rank(number: int) -> int:
            box, used = self.scheme.boxes[number], self.net_at[number]
            if not used or box.icon.reference:
                return 4
            kinds = [box.ports[p].kind for p in used]
            waits = any(p.kind == "input" and i not in used for i, p in enumerate(box.ports))
            begins = all(kind == "output" for kind in kinds) or waits
            if begins or (box.is_port and "input" in kinds):
                return 0 if self.signals_first else 2
            return 1 if box.icon.source and "input" not in kinds else 3

        return sorted(range(len(self.scheme.boxes)), key=rank)

    def _walk(self, start: int) -> None:
        queue, upstream = deque([start]), deque[int]()
        while queue or upstream:
            number = queue.popleft() if queue else upstream.popleft()
            if number in self.facing:
                continue
            self.facing[number] = facing = self._face(number, first=number == start)
            for port, net in self.net_at[number].items():
                if net not in self.position:
                    step = _step(facing.sides[port])
                    self.position[net] = facing.place + step
                    if step < 0:
                        self.leftward.add(net)
                ends = [end.box for end in self.scheme.nets[net].ends]
                comes_in = self.scheme.nets[net].signal and ends[0] != number
                (upstream if comes_in else queue).extend(ends)

    def _face(self, number: int, *, first: bool) -> Facing:
        box = self.scheme.boxes[number]
        fixed: dict[int, Side] = {i: p.side for i, p in enumerate(box.ports) if p.side is not None}
        free = [i for i, port in enumerate(box.ports) if port.side is None]
        used = [i for i in free if i in self.net_at[number]]
        if not free:
            return self._face_fixed(number, fixed)
        if len(used) == 2 and len(free) == 2:
            return self._face_two(number, fixed, used[0], used[1], first=first)
        lead = used[0] if used else free[0]
        right = self._leads_right(number, lead, fixed, first=first and bool(used))
        away: Side = "left" if right else "right"
        sides: dict[int, Side] = dict.fromkeys(free, away)
        fixed |= {i: away for i, side in fixed.items() if side in ("left", "right")}
        sides[lead] = "right" if right else "left"
        if len(free) > 2:
            sides |= {i: "left" if n % 2 == 0 else "right" for n, i in enumerate(used)}
        mirrored = (sides[free[0]] == "right") != (box.icon.source and len(free) == 1)
        return Facing(sides | fixed, mirrored, False, self._place(number, sides | fixed))

    def _leads_right(
        self, number: int, lead: int, fixed: Mapping[int, Side], *, first: bool
    ) -> bool:
        """Whether the only connector in use is on the right: opposite to a signal, else where the walk comes from."""
        ports, used = self.scheme.boxes[number].ports, self.net_at[number]
        level = [i for i, side in fixed.items() if side in ("left", "right")]
        kinds = [ports[i].kind for i in level if i in used]
        if kinds:
            return "input" in kinds
        net = used.get(lead)
        return first or (net is not None and (net in self.leftward or net not in self.position))

    def _face_fixed(self, number: int, fixed: dict[int, Side]) -> Facing:
        """Sides as the class has them; without signals mirrored if the walk comes from the right."""
        box = self.scheme.boxes[number]
        known = [i for i, net in self.net_at[number].items() if net in self.position]
        acausal = all(port.kind == "connector" for port in box.ports)
        may_turn = acausal and not box.is_port and box.inner is None
        mirrored = bool(known) and may_turn and all(fixed[i] == "right" for i in known)
        if mirrored:
            level = [i for i, side in fixed.items() if side in ("left", "right")]
            fixed |= {i: OPPOSITE[fixed[i]] for i in level}
        return Facing(fixed, mirrored, False, self._place(number, fixed))

    def _face_two(
        self, number: int, fixed: dict[int, Side], a: int, b: int, *, first: bool
    ) -> Facing:
        """An element with two connectors, between its nets or beside them."""
        nets = self.net_at[number][a], self.net_at[number][b]
        at = [self.position.get(net) for net in nets]
        stands = not any(i in self.net_at[number] for i in fixed)
        sides: dict[int, Side] = {a: "left", b: "right"}
        other: dict[int, Side] = {a: "right", b: "left"}
        if at[0] is None and at[1] is None:
            if first and stands and self._on_cycle(number, *nets):
                sides = {a: "right", b: "right"}
                return Facing(sides | fixed, False, True, 0.0)
            if self._is_grounded(nets[1]) or (
                not self._is_grounded(nets[0]) and self._ends(nets[1])
            ):
                sides = other
        elif at[0] is not None and at[1] is not None:
            if at[0] == at[1] and stands:
                side: Side = "right" if nets[0] in self.leftward else "left"
                place = at[0] - _step(side)
                sides = {a: side, b: side}
                return Facing(sides | fixed, False, True, place)
            if at[1] < at[0]:
                sides = other
            last = next(i for i, side in sides.items() if side == "right")
            if stands and len(self.scheme.nets[self.net_at[number][last]].ends) == 2:
                sides = {a: "left", b: "left"}
                return Facing(sides | fixed, False, True, max(at[0], at[1]) + 0.5)
        elif (at[0] is None) != (nets[0 if at[1] is None else 1] in self.leftward):
            sides = other
        return Facing(sides | fixed, sides[a] == "right", False, self._place(number, sides))

    def _is_grounded(self, net: int) -> bool:
        """Whether a ground is connected."""
        boxes = self.scheme.boxes
        return any(boxes[end.box].icon.reference for end in self.scheme.nets[net].ends)

    def _ends(self, net: int) -> bool:
        """Whether nothing goes on from here."""
        return len(self.scheme.nets[net].ends) < 2

    def _place(self, number: int, sides: Mapping[int, Side]) -> float:
        """Beside the first of its nets that has a position."""
        for port, net in self.net_at[number].items():
            if net in self.position and port in sides:
                return self.position[net] - _step(sides[port])
        return 0.0

    def _on_cycle(self, number: int, a: int, b: int) -> bool:
        """Whether two nets are also connected by other ways than through a box."""
        seen, queue = {number}, deque([a])
        nets = {a}
        while queue:
            for end in self.scheme.nets[queue.popleft()].ends:
                if end.box in seen:
                    continue
                seen.add(end.box)
                for net in self.net_at[end.box].values():
                    if net not in nets:
                        nets.add(net)
                        queue.append(net)
        return b in nets


def _step(side: Side) -> float:
    return -0.5 if side in ("left", "top") else 0.5
