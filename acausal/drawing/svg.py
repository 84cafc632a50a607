"""A placed drawing as SVG. Lines take the text colour of the page around, so that it suits light and dark pages."""

from __future__ import annotations

from html import escape

from acausal.drawing.crossings import Point
from acausal.drawing.pictures import NEURAL, box
from acausal.drawing.placed import Placed, PlacedBox, PlacedNet
from acausal.drawing.sizes import FONT
from acausal.drawing.strokes import at, n, rectangle, text, titled

EDGE = 14.0
"""Room round the drawing, in pixels."""

STYLE = (
    ".acausal-diagram{max-width:100%;height:auto}"
    ":root.acausal-diagram{color:#1f2933}"
    "@media(prefers-color-scheme:dark){:root.acausal-diagram{color:#e4e8ec}}"
)
"""Colours are for a file of its own only: within a page, the page's colours hold."""


def write(placed: Placed, title: str) -> str:
    """The SVG of a drawing.

    Components are groups with ``data-component``, their dotted path; wires are groups with ``data-connection``, the
    names of their ends with spaces between.
    """
    bounds = placed.bounds
    width, height = bounds.width + 2 * EDGE, bounds.height + 2 * EDGE
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" class="acausal-diagram" role="img" '
        f'aria-label="{escape(title)}" width="{n(width)}" height="{n(height)}" '
        f'viewBox="{n(bounds.left - EDGE)} {n(bounds.top - EDGE)} {n(width)} {n(height)}" '
        f'font-family="system-ui,sans-serif" font-size="{n(FONT)}" '
        f'fill="none" stroke-linecap="round" stroke-linejoin="round"><style>{STYLE}</style>'
        f"{_level(placed)}</svg>"
    )


def _level(placed: Placed) -> str:
    """Opened boxes, then wires, then boxes."""
    opened = (_opened(drawn, *drawn.inner) for drawn in placed.boxes if drawn.inner is not None)
    closed = (box(drawn) for drawn in placed.boxes if drawn.inner is None)
    return "".join((*opened, *(_net(net) for net in placed.nets), *closed))


def _opened(placed: PlacedBox, inner: Placed, moved: Point) -> str:
    """A frame with a drawing in it."""
    drawn, frame = placed.box, placed.icon
    tint = f'fill="{NEURAL}" fill-opacity="0.07"' if drawn.learned else 'fill="transparent"'
    edge = 'stroke="currentColor" stroke-opacity="0.45" stroke-dasharray="4 3"'
    name = text(drawn.label, frame.left + 9, frame.top + 15, anchor="start", weight=600)
    level = f'<g transform="translate({n(moved[0])} {n(moved[1])})">{_level(inner)}</g>'
    data = f'data-component="{escape(drawn.path)}" data-inside="true"'
    parts = (rectangle(frame, f"{tint} {edge}", radius=7.0), name, level)
    return titled("ac-group", data, f"{drawn.path}: {drawn.role}", parts)


def _net(placed: PlacedNet) -> str:
    net = placed.net
    width = 1.2 if net.signal else 1.6
    data = "".join(at(*line) for line in placed.lines)
    parts = [f'<path d="{data}" stroke="{net.color}" stroke-width="{width}"/>']
    parts += [
        f'<circle cx="{n(x)}" cy="{n(y)}" r="2.6" fill="{net.color}"/>' for x, y in placed.dots
    ]
    names = f'data-connection="{escape(" ".join(net.names))}"'
    return titled("ac-wire", names, " – ".join(net.names), parts)
