"""A drawing with places: what the layout makes and the SVG writer reads. Pixels; x points right, y down."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

from acausal.drawing.crossings import Point as Point, crossings, shared
from acausal.drawing.facing import Facing
from acausal.drawing.scheme import Box, Net
from acausal.drawing.sizes import FONT, LINE, SMALL, label_of
from acausal.modeling import Side


@dataclass(frozen=True)
class Rect:
    """A rectangle by its centre and size."""

    x: float
    y: float
    width: float
    height: float

    @classmethod
    def between(cls, left: float, right: float, top: float, bottom: float) -> Rect:
        """The rectangle with these edges."""
        return cls((left + right) / 2, (top + bottom) / 2, right - left, bottom - top)

    @property
    def left(self) -> float:
        """Smallest x."""
        return self.x - self.width / 2

    @property
    def right(self) -> float:
        """Largest x."""
        return self.x + self.width / 2

    @property
    def top(self) -> float:
        """Smallest y."""
        return self.y - self.height / 2

    @property
    def bottom(self) -> float:
        """Largest y."""
        return self.y + self.height / 2

    def overlaps(self, other: Rect) -> bool:
        """Whether they share more than an edge."""
        return (
            abs(self.x - other.x) < (self.width + other.width) / 2 - 1e-6
            and abs(self.y - other.y) < (self.height + other.height) / 2 - 1e-6
        )


@dataclass(frozen=True)
class Label:
    """A text that begins, ends or has its middle at a point of its baseline."""

    words: str
    point: Point
    anchor: Literal["start", "middle", "end"] = "middle"
    size: float = FONT


@dataclass(frozen=True)
class PlacedBox:
    """A box, where it lies and where wires reach it.

    Attributes:
        box: what it is.
        facing: how it is turned.
        rect: what it covers, with its label.
        icon: what its picture covers.
        framed: for an outside connector, whether it lies on the frame of an opened box.
        inner: what is drawn in it where it is opened, and how far that is moved to the right and down.
        ports: the point at which a wire reaches each connected port, by its number.
    """

    box: Box
    facing: Facing
    rect: Rect
    icon: Rect
    ports: Mapping[int, Point]
    framed: bool = False
    inner: tuple[Placed, Point] | None = None

    def side(self, port: int) -> Side:
        """The side that a port is on."""
        return self.facing.sides.get(port, "right")

    @property
    def label(self) -> Label | None:
        """The name: below, or above where a wire leaves below, or beside the wires where they leave at both."""
        words, icon, box = label_of(self.box), self.icon, self.box
        if not words or self.inner is not None:
            return None
        if box.is_port and self.framed:
            left = self.side(0) == "right"
            x = icon.right + 2 if left else icon.left - 2
            return Label(words, (x, icon.y - 4), "start" if left else "end", SMALL)
        used = [*self.ports, *(footing.port for footing in box.footings)]
        sides = {self.side(number) for number in used}
        if "bottom" not in sides:
            return Label(words, (icon.x, icon.bottom + LINE - 3))
        if "top" not in sides:
            return Label(words, (icon.x, icon.top - 4 - (6 if box.count > 1 else 0)))
        below = [self.ports.get(n, (icon.x, 0.0))[0] for n in used if self.side(n) == "bottom"]
        return Label(words, (max(below) + 5, icon.bottom + LINE - 3), "start")


@dataclass(frozen=True)
class PlacedNet:
    """A net as lines of horizontal and vertical pieces.

    Attributes:
        net: what it is.
        lines: one from the source of a signal to each other end, or from a node to each end.
        dots: where lines part.
    """

    net: Net
    lines: tuple[tuple[Point, ...], ...]
    dots: tuple[Point, ...]


@dataclass(frozen=True)
class Placed:
    """The drawing."""

    boxes: tuple[PlacedBox, ...]
    nets: tuple[PlacedNet, ...]

    @property
    def bounds(self) -> Rect:
        """What it covers."""
        points = [point for net in self.nets for line in net.lines for point in line]
        xs = [x for box in self.boxes for x in (box.rect.left, box.rect.right)] + [
            p[0] for p in points
        ]
        ys = [y for box in self.boxes for y in (box.rect.top, box.rect.bottom)] + [
            p[1] for p in points
        ]
        return (
            Rect.between(min(xs), max(xs), min(ys), max(ys)) if xs else Rect(0.0, 0.0, 40.0, 24.0)
        )

    def levels(self) -> Iterator[Placed]:
        """This drawing and those in its boxes."""
        yield self
        for box in self.boxes:
            if box.inner is not None:
                yield from box.inner[0].levels()

    @property
    def crossings(self) -> int:
        """How often wires of different nets cross."""
        return sum(len(crossings([net.lines for net in level.nets])) for level in self.levels())

    @property
    def shared(self) -> int:
        """How often wires of different nets lie on each other."""
        return sum(shared([net.lines for net in level.nets]) for level in self.levels())

    @property
    def touched(self) -> int:
        """How often wires run along or through pictures that they do not belong to."""
        return sum(_touched(level) for level in self.levels())

    @cached_property
    def flaws(self) -> int:
        """How often wires can be taken for what they are not."""
        return self.crossings + self.shared + self.touched

    @property
    def bends(self) -> int:
        """How often wires turn."""
        return sum(max(len(line) - 2, 0) for net in self.nets for line in net.lines)

    @property
    def length(self) -> float:
        """Of all wires together."""
        return sum(
            abs(b[0] - a[0]) + abs(b[1] - a[1])
            for net in self.nets
            for line in net.lines
            for a, b in pairwise(line)
        )


BESIDE = 6.0
"""A wire that is so near to a picture looks as if it belonged to it, in pixels."""


def _touched(level: Placed) -> int:
    count = 0
    for net in level.nets:
        own = {end.box for end in net.net.ends}
        pieces = [piece for line in net.lines for piece in pairwise(line)]
        others = [box.icon for i, box in enumerate(level.boxes) if i not in own]
        count += sum(icon.overlaps(_around(a, b)) for a, b in pieces for icon in others)
    return count


def _around(a: Point, b: Point) -> Rect:
    """What a piece of a wire covers, and what is beside it."""
    (left, right), (top, bottom) = (sorted(ends) for ends in zip(a, b, strict=True))
    return Rect.between(left - BESIDE, right + BESIDE, top - BESIDE, bottom + BESIDE)
