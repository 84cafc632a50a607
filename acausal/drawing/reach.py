"""How far it is from the edge of an icon to its strokes, so that no wire ends in the air."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from math import atan2, cos, hypot, pi, sin, sqrt

from acausal.drawing.crossings import Point

NEAR = 0.6
"""Strokes so near to a line, in pixels, are on it."""

PIECES = 12
"""Straight pieces of a curve."""

Piece = tuple[Point, Point]


def reach(data: str, start: Point, way: Point) -> float | None:
    """How far a line goes, along a unit vector, until it meets the strokes of SVG path data; None where it misses."""
    found: list[float] = []
    for piece in pieces(data):
        (u, v), (x, y) = (_along(point, start, way) for point in piece)
        if min(v, y) > NEAR or max(v, y) < -NEAR:
            continue
        beside = abs(v - y) < 1e-9
        meets = min(u, x) if beside else u + (x - u) * min(max(v / (v - y), 0.0), 1.0)
        found.append(max(meets, 0.0) if beside and max(u, x) >= 0 else meets)
    return min((length for length in found if length >= -NEAR), default=None)


def _along(point: Point, start: Point, way: Point) -> Point:
    """A point in coordinates along a line and across it."""
    x, y = point[0] - start[0], point[1] - start[1]
    return x * way[0] + y * way[1], y * way[0] - x * way[1]


@cache
def pieces(data: str) -> tuple[Piece, ...]:
    """Path data as straight pieces."""
    points = list(_points(data))
    return tuple((a, b) for (a, _), (b, drawn) in pairwise(points) if drawn)


def _points(data: str) -> Iterator[tuple[Point, bool]]:
    """The points of path data, each with whether a stroke leads to it."""
    x = y = 0.0
    first, bend = (0.0, 0.0), (0.0, 0.0)
    for word, text in re.findall(r"([A-Za-z])([^A-Za-z]*)", data):
        numbers = [float(n) for n in re.findall(r"-?[\d.]+", text)]
        kind, own = word.upper(), word.islower()
        count = {"H": 1, "V": 1, "C": 6, "S": 4, "A": 7, "Z": 0}.get(kind, 2)
        if kind == "Z":
            x, y = first
            yield first, True
        for i in range(0, len(numbers), count or 1):
            part, (x0, y0) = numbers[i : i + count], (x, y)
            base = (x0, y0) if own else (0.0, 0.0)
            x = x0 if kind == "V" else base[0] + (part[0] if kind == "H" else part[-2])
            y = y0 if kind == "H" else base[1] + part[-1]
            if kind == "A":
                yield from _arc((x0, y0), (x, y), part[0], part[3] > 0, part[4] > 0)
            elif kind in "CS":
                ends = [
                    (base[0] + u, base[1] + v) for u, v in zip(part[::2], part[1::2], strict=True)
                ]
                begun = ends[0] if kind == "C" else (2 * x0 - bend[0], 2 * y0 - bend[1])
                bend = ends[-2]
                yield from _curve((x0, y0), begun, bend, (x, y))
            else:
                yield (x, y), kind != "M"
            if kind == "M" and i == 0:
                first = x, y


def _arc(
    a: Point, b: Point, radius: float, large: bool, sweep: bool
) -> Iterator[tuple[Point, bool]]:
    """A part of a circle from one point to another; the flags are those of SVG."""
    (x, y), (u, v) = a, b
    chord = hypot(u - x, v - y)
    off = sqrt(max(radius**2 - chord**2 / 4, 0.0)) / chord * (1 if large == sweep else -1)
    cx, cy = (x + u) / 2 + off * (v - y), (y + v) / 2 - off * (u - x)
    begin, r = atan2(y - cy, x - cx), hypot(x - cx, y - cy)
    turn = (atan2(v - cy, u - cx) - begin) % (2 * pi) - (0 if sweep else 2 * pi)
    for k in range(1, PIECES + 1):
        angle = begin + turn * k / PIECES
        yield (cx + r * cos(angle), cy + r * sin(angle)), True


def _curve(a: Point, p: Point, q: Point, b: Point) -> Iterator[tuple[Point, bool]]:
    """A cubic curve with two control points."""
    for k in range(1, PIECES + 1):
        t = k / PIECES
        w = (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3
        yield (
            (
                sum(c * point[0] for c, point in zip(w, (a, p, q, b), strict=True)),
                sum(c * point[1] for c, point in zip(w, (a, p, q, b), strict=True)),
            ),
            True,
        )
