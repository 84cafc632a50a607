"""SVG in small pieces: numbers, texts, rectangles, lines."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from acausal.drawing.crossings import Point
from acausal.drawing.placed import Rect
from acausal.drawing.sizes import FONT
from acausal.modeling import Side

INTO: dict[Side, tuple[int, int]] = {
    "left": (1, 0), "right": (-1, 0), "top": (0, 1), "bottom": (0, -1)
}  # fmt: skip
"""Which way a wire runs that enters a box at a side."""


def n(value: float) -> str:
    """A number with at most one decimal."""
    return f"{round(value, 1) + 0.0:g}"


def at(*points: Point) -> str:
    """Path data of a line through points."""
    return "M" + "L".join(f"{n(x)} {n(y)}" for x, y in points)


def text(
    words: str, x: float, y: float, *, anchor: str = "middle", size: float = FONT, weight: int = 400
) -> str:
    """A text in the colour of the page's."""
    extra = f' font-size="{n(size)}"' if size != FONT else ""
    extra += f' font-weight="{weight}"' if weight != 400 else ""
    return f'<text x="{n(x)}" y="{n(y)}" text-anchor="{anchor}" fill="currentColor"{extra}>{escape(words)}</text>'


def rectangle(rect: Rect, style: str, radius: float = 4.0) -> str:
    """A rectangle with attributes."""
    return (
        f'<rect x="{n(rect.left)}" y="{n(rect.top)}" width="{n(rect.width)}" height="{n(rect.height)}" '
        f'rx="{n(radius)}" {style}/>'
    )


def arrow(tip: Point, side: Side, color: str) -> str:
    """The head of a signal that enters at a side."""
    dx, dy = INTO[side]
    x, y = tip
    corners = [(x - 7 * dx + 3.2 * s * dy, y - 7 * dy + 3.2 * s * dx) for s in (1, -1)]
    return f'<path d="{at(tip, *corners)}Z" fill="{color}"/>'


def titled(kind: str, data: str, title: str, parts: Iterable[str]) -> str:
    """A group of a class, with a data attribute and a title that browsers show under the pointer."""
    return f'<g class="{kind}" {data}><title>{escape(title)}</title>{"".join(parts)}</g>'
