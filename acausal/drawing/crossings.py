"""Where wires of different nets meet: lines of horizontal and vertical pieces, in pixels."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, pairwise

Point = tuple[float, float]

Lines = Sequence[Sequence[Point]]
"""The lines of one net."""

_Piece = tuple[int, float, float, float, float]
"""Number of a net; smallest and largest x, smallest and largest y."""


def _pieces(nets: Sequence[Lines]) -> tuple[list[_Piece], list[_Piece]]:
    """Horizontal and vertical pieces of lines."""
    flat = [
        (n, min(a[0], b[0]), max(a[0], b[0]), min(a[1], b[1]), max(a[1], b[1]))
        for n, lines in enumerate(nets)
        for line in lines
        for a, b in pairwise(line)
    ]
    return [p for p in flat if p[3] == p[4]], [p for p in flat if p[1] == p[2] and p[3] != p[4]]


def crossings(nets: Sequence[Lines]) -> list[Point]:
    """Points where a horizontal piece of one net crosses a vertical piece of another."""
    lying, standing = _pieces(nets)
    found = {
        (min(n, m), max(n, m), x, y)
        for n, left, right, y, _ in lying
        for m, x, _, top, bottom in standing
        if n != m and left < x < right and top < y < bottom
    }
    return [(x, y) for _, _, x, y in sorted(found)]


NEAR = 5.0
"""Wires on one line look like one if less than this is between them, in pixels."""


def shared(nets: Sequence[Lines]) -> int:
    """How many pairs of pieces of different nets lie on one line, and look like one wire."""
    lying, standing = _pieces(nets)
    along_x = [(n, y, left, right) for n, left, right, y, _ in lying]
    along_y = [(n, x, top, bottom) for n, x, _, top, bottom in standing]
    count = 0
    for pieces in (along_x, along_y):
        for (n, at, low, high), (m, there, start, stop) in combinations(sorted(pieces), 2):
            count += n != m and abs(at - there) < 1.5 and min(high, stop) - max(low, start) > -NEAR
    return count


def branches(lines: Lines) -> list[Point]:
    """Points where three or more ways of one net meet, in order."""
    ends = {point for line in lines for point in line}
    ways: dict[Point, set[Point]] = {}
    for line in lines:
        for a, b in pairwise(line):
            inside = [p for p in ends if _between(a, p, b)]
            for p, q in pairwise(sorted(inside)):
                ways.setdefault(p, set()).add(q)
                ways.setdefault(q, set()).add(p)
    return sorted(p for p, others in ways.items() if len(others) >= 3)


def without_stub(lines: Sequence[tuple[Point, ...]]) -> list[tuple[Point, ...]]:
    """Lines that start at one point, without the first piece if all of them start along it."""
    (start, *_), *_ = lines
    for axis in (0, 1):
        ways = [line[1][axis] - start[axis] for line in lines]
        same_line = all(line[1][1 - axis] == start[1 - axis] for line in lines)
        if same_line and (min(ways) > 0 or max(ways) < 0):
            way = min(ways, key=abs)
            moved = (start[0] + way, start[1]) if axis == 0 else (start[0], start[1] + way)
            cut = [line[1:] if line[1] == moved else (moved, *line[1:]) for line in lines]
            return [(*line, *line) if len(line) == 1 else line for line in cut]
    return list(lines)


def _between(a: Point, p: Point, b: Point) -> bool:
    """Whether a point lies on a horizontal or vertical piece, its ends included."""
    return all(min(a[i], b[i]) <= p[i] <= max(a[i], b[i]) for i in (0, 1))
