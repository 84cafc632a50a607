"""What a drawing must not have: parts that overlap, labels that something covers."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, pairwise

from acausal.drawing.placed import Label, Placed, Rect
from acausal.drawing.sizes import text_width


def overlaps(placed: Placed) -> list[tuple[str, str]]:
    """Paths of boxes that overlap."""
    pairs = (pair for level in placed.levels() for pair in combinations(level.boxes, 2))
    return [(a.box.path, b.box.path) for a, b in pairs if a.rect.overlaps(b.rect)]


def covered(placed: Placed) -> list[tuple[str, str]]:
    """Labels that a wire, a picture or another label touches: each with a name of what does."""
    return [pair for level in placed.levels() for pair in _covered(level)]


def _covered(level: Placed) -> Iterator[tuple[str, str]]:
    labels = [(box.box.path, _around(box.label)) for box in level.boxes if box.label is not None]
    wires = [
        (" ".join(net.net.names), Rect.between(min(a[0], b[0]), max(a[0], b[0]), min(a[1], b[1]), max(a[1], b[1])))
        for net in level.nets for line in net.lines for a, b in pairwise(line)
    ]  # fmt: skip
    pictures = [(box.box.path, box.icon) for box in level.boxes if box.inner is None]
    for i, (path, label) in enumerate(labels):
        for name, other in (*labels[i + 1 :], *wires, *pictures):
            if label.overlaps(other):
                yield path, name


def _around(label: Label) -> Rect:
    """About what a label covers."""
    (x, y), width = label.point, text_width(label.words, label.size)
    left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[label.anchor] * width
    return Rect.between(left, left + width, y - 0.75 * label.size, y + 0.2 * label.size)
