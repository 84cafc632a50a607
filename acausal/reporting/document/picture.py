"""Plots as SVG text, without matplotlib: for pages without a plot library, and for views in notebooks.

They suit light and dark pages: colours are attributes, and the style sheet of a page overrides them by classes.
"""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import cycle

import numpy as np

from acausal.reporting.document.content import Curve, Numbers, Plot, Role
from acausal.reporting.document.thinning import thinned

COLORS = ("#3b82c4", "#d1603d", "#3f9b5c", "#9467bd", "#b8860b", "#2a9d9d")
"""Colours of curves without a role, in turn: legible on white and on black."""

ROLES: dict[Role, str] = {
    "measured": "currentColor",
    "before": COLORS[1],
    "after": COLORS[0],
    "known": COLORS[2],
    "sum": COLORS[3],
}
"""Colours of the others."""

WIDTH, HEIGHT = 640, 190
LEFT, RIGHT, TOP, BOTTOM = 64, 12, 24, 30
"""Size of a plot and its margins, in pixels."""

DIGIT = 8.0
"""How wide a digit is at most."""

POINTS = 600
"""About so many points of a curve are drawn, one for each pixel."""

_Range = tuple[float, float]


def colors(curves: Iterable[Curve]) -> Iterator[tuple[str, str]]:
    """The class in the style sheet of each curve, and its colour without one."""
    turns = cycle(enumerate(COLORS))
    for curve in curves:
        if curve.role == "other":
            place, color = next(turns)
            yield f"o{place}", color
        else:
            yield curve.role, ROLES[curve.role]


def small_plot(
    curves: Sequence[Curve],
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
    plot = Plot("", across, upwards, tuple(curves), log=logarithmic)
    return picture(plot, size, legend=True) if _extents(plot) else ""


def picture(plot: Plot, size: tuple[int, int] = (WIDTH, HEIGHT), *, legend: bool = False) -> str:
    """A plot as an ``<svg>`` element of a width and a height in pixels, perhaps with the names of its curves."""
    curves = [c for curve in plot.curves for c in thinned([_levelled(curve, plot.log)], POINTS)]
    across, upwards = _extents(plot) or ((0.0, 1.0), (0.0, 1.0))
    frame, (width, height) = _Frame(across, upwards, *size), size
    title = plot.caption or ", ".join(c.label for c in curves if c.label) or plot.ylabel
    opening = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" role="img" style="max-width:100%;height:auto" font-family="sans-serif" '
        f'font-size="11" fill="currentColor"><title>{html.escape(title)}</title>'
    )
    drawn = "".join(_drawn(frame, curves))
    if plot.limits is not None:  # nothing is drawn beyond them
        x, y, w, h = LEFT, TOP, width - LEFT - RIGHT, frame.bottom - TOP
        box = f'x="{x}" y="{y}" width="{w}" height="{h}" viewBox="{x} {y} {w} {h}"'
        drawn = f"<svg {box}>{drawn}</svg>"
    around = "".join([*_grid(frame, plot.log), *_marks(frame, plot)])
    labels = "".join(_labels(frame, plot, curves, legend))
    return f"{opening}{around}{drawn}{labels}</svg>"


@dataclass(frozen=True)
class _Frame:
    """Where the numbers of a plot lie in it: those of the upward axis by their logarithms, if it is logarithmic."""

    across: _Range
    upwards: _Range
    width: int
    height: int

    @property
    def bottom(self) -> int:
        return self.height - BOTTOM

    def right(self, x: np.ndarray) -> np.ndarray:
        low, high = self.across
        return LEFT + (x - low) / (high - low) * (self.width - LEFT - RIGHT)

    def down(self, y: np.ndarray) -> np.ndarray:
        low, high = self.upwards
        place = self.bottom - (y - low) / (high - low) * (self.bottom - TOP)
        return np.clip(place, -self.height, 2 * self.height)


def _line(kind: str, data: str, style: str) -> str:
    return f'<path class="{kind}" d="{data}" {style}/>'


def _grid(frame: _Frame, log: bool) -> Iterator[str]:
    """Lines with numbers."""
    faint = 'stroke="currentColor" stroke-opacity="0.12" fill="none"'
    for value in ticks(*frame.across, max(2, frame.width // 90)):
        x, text = float(frame.right(np.asarray(value))), _number(value)
        inside = min(x, frame.width - DIGIT * len(text) / 2)
        yield _line("grid", f"M{x:.1f} {TOP}V{frame.bottom}", faint)
        yield f'<text x="{inside:.1f}" y="{frame.bottom + 14}" text-anchor="middle">{text}</text>'
    levels = ticks(*frame.upwards, max(3, (frame.bottom - TOP) // 24))
    whole = [level for level in levels if float(level).is_integer()]
    for level in (whole or levels) if log else levels:
        y, text = float(frame.down(np.asarray(level))), _number(10.0**level if log else level)
        yield _line("grid", f"M{LEFT} {y:.1f}H{frame.width - RIGHT}", faint)
        yield f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{text}</text>'


def _marks(frame: _Frame, plot: Plot) -> Iterator[str]:
    """What is not trusted, vertical lines and samples."""
    (low, high), bottom = frame.across, frame.bottom
    trusted = plot.trusted or (low, high)
    for side in ((low, trusted[0]), (trusted[1], high)):
        a, b = frame.right(np.array(side)).tolist()
        if b > a:
            place = f'x="{a:.1f}" y="{TOP}" width="{b - a:.1f}" height="{bottom - TOP}"'
            yield f'<rect class="shade" {place} fill-opacity="0.1"/>'
    for x in frame.right(np.array(plot.guides)).tolist():
        dashed = 'stroke="currentColor" stroke-opacity="0.5" stroke-dasharray="5 4"'
        yield _line("guide", f"M{x:.1f} {TOP}V{bottom}", dashed)
    if len(plot.samples):
        places = "".join(f"M{x:.1f} {bottom}v-7" for x in frame.right(plot.samples).tolist())
        yield _line("sample", places, 'stroke="currentColor" stroke-opacity="0.35"')


def _drawn(frame: _Frame, curves: Sequence[Curve]) -> Iterator[str]:
    """The curves, in front of all bands."""
    styled = list(zip(curves, colors(curves), strict=True))
    for curve, (kind, color) in styled:
        if curve.band is not None:
            style = f'fill="{color}" fill-opacity="0.22"'
            yield _line(f"band {kind}", _band(frame, curve, *curve.band), style)
    for curve, (kind, color) in styled:
        style = f'fill="none" stroke="{color}" stroke-width="1.5" stroke-linejoin="round"'
        data = _path(frame.right(curve.x), frame.down(curve.y), curve.steps)
        yield _line(f"curve {kind}", data, style)


def _levelled(curve: Curve, log: bool) -> Curve:
    """A curve of finite numbers and gaps; on a logarithmic axis of their logarithms."""

    def level(y: Numbers) -> Numbers:
        y = np.asarray(y, float)
        if log:
            y = np.log10(y, where=y > 0, out=np.full(y.shape, np.nan))
        return np.where(np.isfinite(y), y, np.nan)

    band = curve.band and (level(curve.band[0]), level(curve.band[1]))
    x, y = np.asarray(curve.x, float), level(curve.y)
    return replace(curve, x=x, y=y, bounds=band, sigma=None)


def _extents(plot: Plot) -> tuple[_Range, _Range] | None:
    """What the axes show, a logarithmic one by its logarithms; None where nothing is finite."""
    curves = [_levelled(curve, plot.log) for curve in plot.curves]
    xs = [c.x[np.isfinite(c.x)] for c in curves]
    ys = [y[np.isfinite(y)] for c in curves for y in (c.y, *(c.band or ()))]
    if not any(map(len, xs)) or not any(map(len, ys)):
        return None
    across = _with_room(np.concatenate(xs), 0.0)
    if plot.limits is None:
        return across, _with_room(np.concatenate(ys), 0.06)
    low, high = (math.log10(v) if plot.log else v for v in plot.limits)
    return across, (low, high)


def _with_room(values: np.ndarray, room: float) -> _Range:
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


def _band(frame: _Frame, curve: Curve, low: Numbers, high: Numbers) -> str:
    """The outline of a band."""
    known = np.isfinite(low) & np.isfinite(high)
    x, low, high = curve.x[known], low[known], high[known]
    around = np.concatenate([x, x[::-1]]), np.concatenate([high, low[::-1]])
    return _path(frame.right(around[0]), frame.down(around[1]), False) + "Z" * bool(len(x))


def _labels(frame: _Frame, plot: Plot, curves: Sequence[Curve], legend: bool) -> Iterator[str]:
    """What the axes show, and the curves' names above the plot."""
    x, anchor = (LEFT - 6, "end") if legend else (4, "start")
    right, below = frame.width - RIGHT, frame.height - 3
    for text, place in (
        (plot.ylabel, f'x="{x}" y="16" text-anchor="{anchor}"'),
        (plot.xlabel, f'x="{right}" y="{below}" text-anchor="end"'),
    ):
        if text:
            yield f'<text class="label" {place} opacity="0.75">{html.escape(text)}</text>'
    x = float(LEFT)
    for curve, (_, color) in zip(curves, colors(curves), strict=True):
        if curve.label and legend:
            yield f'<path d="M{x:.0f} 12h14" stroke="{color}" stroke-width="2.5"/>'
            yield f'<text x="{x + 18:.0f}" y="16">{html.escape(curve.label)}</text>'
            x += 34 + 6.2 * len(curve.label)
