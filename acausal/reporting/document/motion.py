"""A mechanism at one time as SVG text: what a page sets in motion, and a notebook shows as it is."""

from __future__ import annotations

import html
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from acausal.reporting.document.content import Animation, Moving, Numbers
from acausal.reporting.document.picture import COLORS, ticks

WIDE, HIGH, LOW, MARGIN, FOOT = 600.0, 420.0, 120.0, 10.0, 26.0
"""The greatest size of a drawing and its least height, its margins, and what the scale takes below, in pixels."""

MARK = 7.0
"""The unit of a mark, in pixels."""


@dataclass(frozen=True)
class Viewport:
    """Where a mechanism lies in its drawing: ``pixels`` to a metre, with the world's origin at ``x`` and ``y``."""

    pixels: float
    x: float
    y: float
    width: float
    height: float

    @property
    def mark(self) -> float:
        """The unit of a mark [m]."""
        return MARK / self.pixels


def stage(animation: Animation) -> Viewport:
    """The stage that holds all that ever moves."""
    corners = [_corners(one, len(animation.time), 0.0) for one in animation.shapes]
    x, y = (np.concatenate([np.ravel(c[k]) for c in corners]) for k in range(2))
    low_x, high_x, low_y, high_y = x.min(), x.max(), y.min(), y.max()
    room = MARGIN + 2 * MARK
    pixels = min(
        (WIDE - 2 * room) / max(high_x - low_x, 1e-9),
        (HIGH - 2 * room - FOOT) / max(high_y - low_y, 1e-9),
    )
    height = max(LOW, pixels * (high_y - low_y) + 2 * room + FOOT)
    left = (WIDE - pixels * (high_x - low_x)) / 2 - pixels * low_x
    top = (height - FOOT - pixels * (high_y - low_y)) / 2 + pixels * high_y
    return Viewport(float(pixels), float(left), float(top), WIDE, float(height))


def still(animation: Animation, row: int = -1) -> str:
    """The mechanism at one of its times as an ``<svg>`` element, with the whole way of the traced point."""
    place = stage(animation)
    title = html.escape(animation.caption or "mechanism")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {place.width:.0f} {place.height:.0f}" '
        f'width="{place.width:.0f}" height="{place.height:.0f}" role="img" style="max-width:100%;height:auto" '
        f'font-family="sans-serif" font-size="16" fill="currentColor"><title>{title}</title>'
        f'<g class="world" transform="translate({place.x:.2f} {place.y:.2f}) scale({place.pixels:.6g} '
        f'{-place.pixels:.6g})" stroke="currentColor" stroke-width="1.6" fill="none" stroke-linejoin="round" '
        f'stroke-linecap="round">{"".join(_drawn(animation, place, row))}</g>{_scale(place)}</svg>'
    )


def _way(animation: Animation, name: str) -> tuple[Numbers, Numbers]:
    """Where a point is over time."""
    one = next(s for s in animation.shapes if s.name == name and s.traced)
    n = len(animation.time)
    return _whole(one.x, n), _whole(one.y, n)


def _drawn(animation: Animation, place: Viewport, row: int) -> Iterator[str]:
    fixed = 'vector-effect="non-scaling-stroke"'
    x, y = _way(animation, animation.trace) if animation.trace else (np.zeros(0), np.zeros(0))
    points = "L".join(f"{a:.5g} {b:.5g}" for a, b in zip(x.tolist(), y.tolist(), strict=True))
    data = f"M{points}" if points else ""
    yield f'<path class="way" d="{data}" stroke="{COLORS[1]}" stroke-width="1.2" {fixed}/>'
    for one in animation.shapes:
        kind, paint = "moving", ""
        if one.filled and one.along is None:
            paint = 'fill="currentColor" '
        elif one.filled:
            kind = "moving body"
            paint = f'fill="{COLORS[0]}" fill-opacity="0.22" stroke="{COLORS[0]}" '
        yield (
            f'<path class="{kind}" d="{one.path}" transform="{_pose(one, place, row)}" '
            f"{paint}{fixed}><title>{html.escape(one.name)}</title></path>"
        )


def _pose(one: Moving, place: Viewport, row: int) -> str:
    def at(values: Numbers | None) -> float:
        return place.mark if values is None else float(values[min(row, len(values) - 1)])

    angle = float(np.degrees(at(one.phi)))
    return (
        f"translate({at(one.x):.6g} {at(one.y):.6g}) rotate({angle:.5g}) "
        f"scale({at(one.along):.6g} {at(one.across):.6g})"
    )


def _scale(place: Viewport) -> str:
    """A bar of a round length."""
    length = max(ticks(0.0, 0.25 * place.width / place.pixels, 2))
    x, y = place.width - MARGIN, place.height - 8
    bar = f"M{x - length * place.pixels:.1f} {y - 4:.1f}v4H{x:.1f}v-4"
    text = f'<text x="{x - length * place.pixels - 6:.1f}" y="{y:.1f}" text-anchor="end">{length:.6g} m</text>'
    return f'<path d="{bar}" fill="none" stroke="currentColor"/>{text}'


def _corners(one: Moving, n: int, mark: float) -> tuple[np.ndarray, np.ndarray]:
    """The corners of an outline over time, in the world."""
    x0, y0, x1, y1 = one.extent
    along, across = (np.full(1, mark) if v is None else v for v in (one.along, one.across))
    found: list[tuple[Numbers, Numbers]] = []
    for a, b in ((x0, y0), (x0, y1), (x1, y0), (x1, y1)):
        u, v, c, s = a * along, b * across, np.cos(one.phi), np.sin(one.phi)
        found.append((_whole(one.x + c * u - s * v, n), _whole(one.y + s * u + c * v, n)))
    return np.stack([f[0] for f in found]), np.stack([f[1] for f in found])


def _whole(values: Numbers, n: int) -> Numbers:
    return np.broadcast_to(values, (n,))
