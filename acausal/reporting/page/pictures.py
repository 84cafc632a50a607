"""Plots as plain SVG, for pages without a plot library: neither zoom nor cursor."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Sequence

import numpy as np

from acausal.reporting.page.colors import colors
from acausal.reporting.page.content import Curve, Numbers, Plot

WIDTH, HEIGHT, LOW = 760.0, 270.0, 150.0
LEFT, RIGHT, TOP, BOTTOM = 72.0, 746.0, 8.0, 38.0
DIGIT = 8.0
"""How wide a digit is at most."""

Scale = Callable[[float], float]


def picture(plot: Plot) -> str:
    """A plot as an SVG element."""
    height = LOW if plot.low else HEIGHT
    (x0, x1), (y0, y1) = _horizontal(plot), _vertical(plot)

    def level(v: float) -> float:
        return math.log10(v) if plot.log else v

    def x(v: float) -> float:
        return LEFT + (v - x0) / (x1 - x0) * (RIGHT - LEFT)

    def y(v: float) -> float:
        share = (level(v) - level(y0)) / (level(y1) - level(y0))
        return height - BOTTOM - share * (height - BOTTOM - TOP)

    def clipped(v: float) -> float:
        return min(max(y(v), -height), 2 * height) if not plot.log or v > 0 else 2 * height

    bottom = height - BOTTOM
    parts = [
        f'<svg viewBox="0 0 {WIDTH:g} {height:g}" role="img" aria-label="{html.escape(_name(plot), quote=True)}">',
        *(_tick(x(v), bottom + 16, v, "middle") for v in _ticks(x0, x1, 8)),
    ]
    for v in _decades(y0, y1) if plot.log else _ticks(y0, y1, 3 if plot.low else 6):
        parts.append(f'<path class="grid" d="M{LEFT:g},{y(v):.1f}H{RIGHT:g}"/>')
        parts.append(_tick(LEFT - 6, y(v) + 4, v, "end"))
    for low, high in _shaded(plot, x0, x1):
        size = f'width="{x(high) - x(low):.1f}" height="{bottom - TOP:g}"'
        parts.append(f'<rect class="shade" x="{x(low):.1f}" y="{TOP:g}" {size}/>')
    parts += [f'<path class="guide" d="M{x(g):.1f},{TOP:g}V{bottom:g}"/>' for g in plot.guides]
    if len(plot.samples):
        marks = "".join(f"M{x(v):.1f},{bottom:g}v-7" for v in plot.samples.tolist())
        parts.append(f'<path class="sample" d="{marks}"/>')
    parts.append(
        f'<svg x="{LEFT:g}" y="{TOP:g}" width="{RIGHT - LEFT:g}" height="{bottom - TOP:g}" '
    )
    parts.append(f'viewBox="{LEFT:g} {TOP:g} {RIGHT - LEFT:g} {bottom - TOP:g}">')
    for curve, color in zip(plot.curves, colors(plot.curves), strict=True):
        if curve.band is not None:
            parts.append(
                f'<path class="band {color}" d="{_band(curve, *curve.band, x, clipped)}"/>'
            )
        parts.append(f'<path class="curve {color}" d="{_line(curve, x, clipped)}"/>')
    parts.append("</svg>")
    middle = (TOP + bottom) / 2
    parts.append(
        f'<text class="label" text-anchor="middle" x="{(LEFT + RIGHT) / 2:g}" y="{height - 4:g}">'
        f"{html.escape(plot.xlabel)}</text>"
        f'<text class="label" text-anchor="middle" transform="translate(12,{middle:g}) rotate(-90)">'
        f"{html.escape(plot.ylabel)}</text></svg>"
    )
    return "".join(parts)


def _name(plot: Plot) -> str:
    return (
        plot.caption
        or f"{', '.join(c.label for c in plot.curves)}, {plot.ylabel} over {plot.xlabel}"
    )


def _horizontal(plot: Plot) -> tuple[float, float]:
    ends = [(float(c.x.min()), float(c.x.max())) for c in plot.curves if len(c.x)]
    low, high = min((a for a, _ in ends), default=0.0), max((b for _, b in ends), default=1.0)
    return (low, high) if low < high else (low - 0.5, high + 0.5)


def _vertical(plot: Plot) -> tuple[float, float]:
    if plot.limits is not None:
        return plot.limits
    values = np.concatenate([c.y for c in plot.curves]) if plot.curves else np.zeros(1)
    values = values[np.isfinite(values) & ((values > 0) | (not plot.log))]
    if not len(values):
        return (0.1, 1.0) if plot.log else (0.0, 1.0)
    low, high = float(values.min()), float(values.max())
    if plot.log:
        return low / 1.1, high * 1.1
    room = 0.06 * (high - low) if high > low else max(0.05 * abs(high), 1e-12)
    return low - room, high + room


def _ticks(low: float, high: float, about: int) -> list[float]:
    """Round numbers within an interval."""
    step = 10.0 ** math.floor(math.log10((high - low) / about))
    step *= next(f for f in (1, 2, 5, 10) if (high - low) / (f * step) <= about)
    first, last = math.ceil(low / step), math.floor(high / step)
    return [k * step for k in range(first, last + 1)]


def _decades(low: float, high: float) -> list[float]:
    """Powers of ten within an interval, with some of their multiples where these are few."""
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    factors = (1,) if len(exponents) > 4 else (1, 2, 5)
    return [v for n in exponents for f in factors if low <= (v := f * 10.0**n) <= high]


def _tick(x: float, y: float, value: float, anchor: str) -> str:
    """A number at an axis; the last one below it is moved inwards where it would be cut."""
    x = min(x, WIDTH - DIGIT * len(f"{value:.5g}") / 2)
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{value:.5g}</text>'


def _shaded(plot: Plot, low: float, high: float) -> Sequence[tuple[float, float]]:
    if plot.trusted is None:
        return ()
    sides = ((low, plot.trusted[0]), (plot.trusted[1], high))
    return [(a, b) for a, b in sides if b > a]


def _line(curve: Curve, x: Scale, y: Scale) -> str:
    points: list[str] = []
    command = "M"
    for a, b in zip(curve.x.tolist(), curve.y.tolist(), strict=True):
        if not math.isfinite(b):
            command = "M"
            continue
        corner = f"H{x(a):.1f}" if curve.steps and command == "L" else ""
        points.append(f"{corner}{command}{x(a):.1f},{y(b):.1f}")
        command = "L"
    return "".join(points)


def _band(curve: Curve, low: Numbers, high: Numbers, x: Scale, y: Scale) -> str:
    known = np.isfinite(low) & np.isfinite(high)
    xs, low, high = (a[known] for a in (curve.x, low, high))
    if not len(xs):
        return ""

    def side(x_values: Numbers, values: Numbers) -> str:
        pairs = zip(x_values.tolist(), values.tolist(), strict=True)
        return "L".join(f"{x(a):.1f},{y(b):.1f}" for a, b in pairs)

    return f"M{side(xs, high)}L{side(xs[::-1], low[::-1])}Z"
