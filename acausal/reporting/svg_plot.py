"""A small plot as SVG text: for views in notebooks, without matplotlib, on light and dark pages alike."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

COLORS = ("#3b82c4", "#d1603d", "#3f9b5c", "#9467bd", "#b8860b", "#2a9d9d")
"""Colours of curves, legible on white and on black."""

WIDTH, HEIGHT = 640, 190
LEFT, RIGHT, TOP, BOTTOM = 64, 12, 24, 30
"""Size of a plot and its margins, in pixels."""

DIGIT = 6.5
"""How wide a digit is."""

_Map = Callable[[np.ndarray], np.ndarray]

POINTS = 600
"""Points of a curve that are drawn at most, about one for each pixel."""


@dataclass(frozen=True, eq=False)
class SmallCurve:
    """A curve of a small plot.

    Attributes:
        label: its name; empty for none.
        x, y: its points; NaN interrupts it.
        bounds: of a band around it, if it has one.
        steps: whether each value holds until the next.
    """

    label: str
    x: Float[np.ndarray, " n"]
    y: Float[np.ndarray, " n"]
    bounds: tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]] | None = None
    steps: bool = False


def small_plot(
    curves: Sequence[SmallCurve],
    *,
    across: str = "",
    upwards: str = "",
    logarithmic: bool = False,
    size: tuple[int, int] = (WIDTH, HEIGHT),
) -> str:
    """Curves over one axis as an ``<svg>`` element; empty where nothing is finite.

    Arguments:
        curves: at most as many as there are `COLORS` are told apart.
        across, upwards: what the axes show.
        logarithmic: whether the upward axis is.
        size: width and height, in pixels.
    """
    reduced = [_fewer(_scaled(curve, logarithmic)) for curve in curves]
    extent = _extent(reduced)
    if extent is None:
        return ""
    (x0, x1), (y0, y1) = extent
    width, height = size

    def right(x: np.ndarray) -> np.ndarray:
        return LEFT + (x - x0) / (x1 - x0) * (width - LEFT - RIGHT)

    def down(y: np.ndarray) -> np.ndarray:
        return height - BOTTOM - (y - y0) / (y1 - y0) * (height - TOP - BOTTOM)

    opening = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" role="img" style="max-width:100%;height:auto" font-family="sans-serif" '
        'font-size="11" fill="currentColor">'
    )
    title = html.escape(", ".join(c.label for c in curves if c.label) or upwards)
    parts = [opening, f"<title>{title}</title>"]
    parts += _axes(x0, x1, y0, y1, right, down, size, logarithmic)
    for number, curve in enumerate(reduced):
        color = COLORS[number % len(COLORS)]
        if curve.bounds is not None:
            parts.append(_band(curve, color, right, down))
        parts.append(
            f'<path d="{_path(right(curve.x), down(curve.y), curve.steps)}" fill="none" '
            f'stroke="{color}" stroke-width="1.5" stroke-linejoin="round"/>'
        )
    parts.append(_legend([c.label for c in curves], upwards))
    if across:
        parts.append(
            f'<text x="{width - RIGHT}" y="{height - 3}" text-anchor="end" opacity="0.75">{html.escape(across)}</text>'
        )
    return "".join([*parts, "</svg>"])


def _scaled(curve: SmallCurve, logarithmic: bool) -> SmallCurve:
    x, y = np.asarray(curve.x, float), np.asarray(curve.y, float)
    if logarithmic:
        y = np.log10(y, where=y > 0, out=np.full(y.shape, np.nan))
    y = np.where(np.isfinite(y), y, np.nan)
    return SmallCurve(curve.label, x, y, curve.bounds, curve.steps)


def _fewer(curve: SmallCurve) -> SmallCurve:
    """A curve of so many points at most: of each stretch, those with the least and the largest value."""
    n = len(curve.x)
    if n <= POINTS:
        return curve
    edges = np.linspace(0, n, POINTS // 2 + 1).astype(int)
    kept: set[int] = {0, n - 1}
    for start, end in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        piece = curve.y[start:end]
        if np.isnan(piece).all():
            kept.add(start)
        else:
            kept.update((start + int(np.nanargmin(piece)), start + int(np.nanargmax(piece))))
    rows = sorted(kept)
    bounds = curve.bounds and (curve.bounds[0][rows], curve.bounds[1][rows])
    return SmallCurve(curve.label, curve.x[rows], curve.y[rows], bounds, curve.steps)


def _extent(curves: Sequence[SmallCurve]) -> tuple[tuple[float, float], tuple[float, float]] | None:
    xs = [c.x[_finite(c.x)] for c in curves]
    ys = [y[_finite(y)] for c in curves for y in (c.y, *(c.bounds or ()))]
    if not any(map(len, xs)) or not any(map(len, ys)):
        return None
    x, y = np.concatenate(xs), np.concatenate(ys)
    return _with_room(x, 0.0), _with_room(y, 0.06)


def _finite(values: np.ndarray) -> Bool[np.ndarray, " n"]:
    return np.isfinite(values)


def _with_room(values: np.ndarray, room: float) -> tuple[float, float]:
    """Bounds of values with some room around them; of equal values, bounds that differ."""
    low, high = float(values.min()), float(values.max())
    if high - low <= 1e-9 * max(abs(low), abs(high)):
        span = abs(high) or 1.0
        return low - 0.5 * span, high + 0.5 * span
    return low - room * (high - low), high + room * (high - low)


def ticks(low: float, high: float, count: int = 5) -> list[float]:
    """Round numbers between two bounds, about so many."""
    step = 10.0 ** math.floor(math.log10((high - low) / count))
    for factor in (1, 2, 5, 10):
        if (high - low) / (factor * step) <= count:
            step *= factor
            break
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [n * step for n in range(first, last + 1)]


def _axes(
    x0: float,
    x1: float,
    y0: float,
    y1: float,
    right: _Map,
    down: _Map,
    size: tuple[int, int],
    logarithmic: bool,
) -> list[str]:
    """Grid lines with numbers."""
    width, height = size
    parts: list[str] = []
    for value in ticks(x0, x1, max(2, width // 90)):
        x, text = float(right(np.asarray(value))), _number(value)
        inside = min(x, width - DIGIT * len(text) / 2)
        parts.append(
            f'<path d="M{x:.1f} {TOP}V{height - BOTTOM}" stroke="currentColor" stroke-opacity="0.12"/>'
            f'<text x="{inside:.1f}" y="{height - BOTTOM + 14}" text-anchor="middle">{text}</text>'
        )
    found = ticks(y0, y1, max(3, (height - TOP - BOTTOM) // 24))
    whole = [v for v in found if float(v).is_integer()]
    for value in (whole or found) if logarithmic else found:
        y, text = float(down(np.asarray(value))), 10.0**value if logarithmic else value
        parts.append(
            f'<path d="M{LEFT} {y:.1f}H{width - RIGHT}" stroke="currentColor" stroke-opacity="0.12"/>'
            f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{_number(text)}</text>'
        )
    return parts


def _number(value: float) -> str:
    return f"{0.0 if abs(value) < 1e-300 else value:.6g}".replace("-", "\u2212")


def _path(x: np.ndarray, y: np.ndarray, steps: bool) -> str:
    """A path through points, interrupted where one is not finite."""
    pieces: list[str] = []
    draws = False
    for a, b in zip(x.tolist(), y.tolist(), strict=True):
        if not math.isfinite(b):
            draws = False
        elif not draws:
            pieces.append(f"M{a:.1f} {b:.1f}")
            draws = True
        else:
            pieces.append(f"H{a:.1f}V{b:.1f}" if steps else f"L{a:.1f} {b:.1f}")
    return "".join(pieces)


def _band(curve: SmallCurve, color: str, right: _Map, down: _Map) -> str:
    assert curve.bounds is not None
    low, high = curve.bounds
    known = np.isfinite(low) & np.isfinite(high)
    x, low, high = curve.x[known], low[known], high[known]
    around = np.concatenate([x, x[::-1]]), np.concatenate([high, low[::-1]])
    outline = _path(right(around[0]), down(around[1]), False)
    return f'<path d="{outline}Z" fill="{color}" fill-opacity="0.22"/>'


def _legend(labels: Sequence[str], upwards: str) -> str:
    """The curves' names above the plot, and what the upward axis shows."""
    x, parts = float(LEFT), list[str]()
    for number, label in enumerate(labels):
        if not label:
            continue
        color = COLORS[number % len(COLORS)]
        parts.append(
            f'<path d="M{x:.0f} 12h14" stroke="{color}" stroke-width="2.5"/>'
            f'<text x="{x + 18:.0f}" y="16">{html.escape(label)}</text>'
        )
        x += 34 + 6.2 * len(label)
    end = f'<text x="{LEFT - 6}" y="16" text-anchor="end" opacity="0.75">{html.escape(upwards)}</text>'
    return "".join([*parts, end if upwards else ""])
