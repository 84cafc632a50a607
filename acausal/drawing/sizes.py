"""How large boxes are: their pictures, their labels, and room for their ports."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from acausal.drawing.facing import Facing
from acausal.drawing.scheme import Box

FONT = 11.0
"""Size of labels, in pixels."""

SMALL = 9.0
"""Size of the names of ports."""

LINE = 15.0
"""Height of a line of a label."""

REACH = 24.0
"""Room for a ground beside a box, in pixels."""

PITCH = 16.0
"""Distance of ports on one side."""


@dataclass(frozen=True)
class Size:
    """Sizes of a box.

    Attributes:
        icon: width and height of its picture.
        outside: width and height with its label, and with grounds beside it.
        shift: how far the middle of the picture is to the right of the whole's.
    """

    icon: tuple[float, float]
    outside: tuple[float, float]
    shift: float = 0.0


def text_width(text: str, size: float = FONT) -> float:
    """About how wide a text is; an upper estimate for the usual sans-serif letters."""
    narrow = sum(letter in "ijlt1.,[]()fr I" for letter in text)
    wide = sum(letter in "mwMW@" for letter in text)
    return size * (0.6 * len(text) - 0.22 * narrow + 0.28 * wide)


def size_of(box: Box, facing: Facing, used: Collection[int]) -> Size:
    """The sizes of a box as it is turned, with room for its connected ports, by their numbers."""
    width, height = box.icon.size
    if box.inner is not None:
        return Size((width, height), (width, height))
    if hangs(box):
        return Size((width, height), (width, 2 * height))
    if facing.upright:
        width, height = max(height, 36.0), width
    at = dict.fromkeys(("left", "right", "top", "bottom"), 0)
    for number, side in facing.sides.items():
        at[side] += number in used or box.icon.frame
    height = max(height, PITCH * max(at["left"], at["right"]))
    width = max(width, PITCH * max(at["top"], at["bottom"]))
    if named := named_ports(box, facing):
        labels = [text_width(box.ports[number].name, SMALL) for number in named]
        inner = 34.0 if box.icon.strokes else text_width(box.icon.text)
        width = max(width, 2 * max(labels) + inner + 16)
    label = label_of(box)
    above = 2 * LINE if label else 0.0
    beside = [facing.sides[footing.port] for footing in box.footings]
    left, right = (REACH * beside.count(side) for side in ("left", "right"))
    both = at["top"] and at["bottom"]
    room = (
        2 * text_width(label) + 14 + PITCH * (at["bottom"] - 1) if both else text_width(label) + 4
    )
    broad = max(width, room)
    return Size((width, height), (broad + left + right, height + above), (left - right) / 2)


def named_ports(box: Box, facing: Facing) -> list[int]:
    """Ports whose names are shown: of framed boxes with several; with strokes, only of several on one side."""
    level = [i for i, side in facing.sides.items() if side in ("left", "right")]
    if not box.icon.frame or box.inner is not None or len(box.ports) <= 2:
        return []
    if not box.icon.strokes:
        return level
    on = [facing.sides[i] for i in level]
    return [i for i in level if on.count(facing.sides[i]) > 1]


def hangs(box: Box) -> bool:
    """Whether a box is a ground that hangs from its wire, as an electrical one does."""
    return box.icon.reference and "top" in box.icon.sides.values()


def label_of(box: Box) -> str:
    """What is written beside a box."""
    if box.icon.reference:
        return ""
    return box.label if box.count == 1 else f"{box.label} ({box.count})"
