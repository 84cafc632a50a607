"""A placed drawing as SVG: wires and boxes. Lines take the text colour of the page around, light or dark."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from html import escape

from acausal.drawing.crossings import Point
from acausal.drawing.placed import Placed, PlacedBox, PlacedNet, Rect
from acausal.drawing.ports import SIGNAL
from acausal.drawing.reach import reach
from acausal.drawing.scheme import OPPOSITE, Box, Footing
from acausal.drawing.sizes import FONT, SMALL, hangs, named_ports
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


NEURAL = "#e0962f"
"""Tint of what holds a network."""

SCALE = 0.7
"""Of a ground that is drawn right at a port."""

LINES = 'stroke="{}" stroke-width="1.2"'


def box(placed: PlacedBox) -> str:
    """The group of a component, and those of the grounds right at it."""
    drawn = placed.box
    if drawn.is_port:
        parts = (*_leads(placed), *_gate(placed), *_label(placed))
        return titled("ac-port", f'data-port="{escape(drawn.path)}"', drawn.path, parts)
    parts = (
        *_frame(placed), *_leads(_with_open(placed)), *_picture(placed), *_port_names(placed),
        *_label(placed),
    )  # fmt: skip
    data = f'data-component="{escape(drawn.path)}"' + (
        ' data-inside="true"' if drawn.inside else ""
    )
    title = f"{drawn.path}: {drawn.role}" + (f" ({drawn.count} of them)" if drawn.count > 1 else "")
    grounds = "".join(_footing(placed, footing) for footing in drawn.footings)
    return titled("ac-component", data, title, parts) + grounds


def _with_open(placed: PlacedBox) -> PlacedBox:
    """With places for the ports that nothing is connected to: inputs of the model, and ends of elements."""
    drawn, icon = placed.box, placed.icon
    taken = {*placed.ports, *(footing.port for footing in drawn.footings)}
    waiting = [
        number
        for number, port in enumerate(drawn.ports)
        if number not in taken
        and not drawn.icon.reference
        and (port.kind == "input" or (port.kind == "connector" and not drawn.icon.frame))
        and (port.kind == "input" or placed.side(number) in ("left", "right"))
    ]
    sides = [placed.side(number) for number in (*taken, *waiting)]
    places = {
        number: drawn.icon.places.get(drawn.ports[number].name, 0.0)
        for number in waiting
        if sides.count(placed.side(number)) == 1 or drawn.ports[number].name in drawn.icon.places
    }
    right, down = -1 if placed.facing.mirrored else 1, -1 if placed.facing.flipped else 1
    ports = {
        number: {
            "left": (icon.left, icon.y + down * place * icon.height / 2),
            "right": (icon.right, icon.y + down * place * icon.height / 2),
            "top": (icon.x + right * place * icon.width / 2, icon.top),
            "bottom": (icon.x + right * place * icon.width / 2, icon.bottom),
        }[placed.side(number)]
        for number, place in places.items()
    }
    return replace(placed, ports={**placed.ports, **ports})


def _leads(placed: PlacedBox) -> Iterator[str]:
    """From where wires end to where the picture begins."""
    icon, pieces = placed.icon, dict[str, list[str]]()
    for number, (x, y) in placed.ports.items():
        port, side = placed.box.ports[number], placed.side(number)
        end = {
            "left": (icon.left, y), "right": (icon.right, y), "top": (x, icon.top), "bottom": (x, icon.bottom)
        }[side]  # fmt: skip
        plain = placed.box.icon.frame or placed.box.is_port
        data = at((x, y), end) if plain else at((x, y)) + _to_stroke(placed, to_pin(placed, number))
        width = 1.6 if port.kind == "connector" else 1.2
        pieces.setdefault(f'stroke="{port.color}" stroke-width="{width}"', []).append(data)
        if port.kind == "input" and not placed.box.is_port:
            yield arrow(end, side, port.color)
    for style, lines in pieces.items():
        yield f'<path d="{"".join(lines)}" {style}/>'


def to_pin(placed: PlacedBox, number: int) -> tuple[Point, ...]:
    """Points on the way from a port to the edge of an unframed picture; the last is on the edge."""
    icon, (x, y), side = placed.icon, placed.ports[number], placed.side(number)
    if hangs(placed.box):
        return (icon.x, y), (icon.x, icon.top)
    if placed.facing.upright and len({placed.side(other) for other in placed.ports}) == 1:
        return (icon.x, y), (icon.x, icon.top if y < icon.y else icon.bottom)
    if side in ("top", "bottom"):
        return ((x, icon.top if side == "top" else icon.bottom),)
    alone = sum(placed.side(other) == side for other in placed.ports) == 1
    edge = icon.left if side == "left" else icon.right
    return ((edge, y), (edge, icon.y)) if alone and not placed.box.icon.sides else ((edge, y),)


def _to_stroke(placed: PlacedBox, points: tuple[Point, ...]) -> str:
    """The way along points to the edge of a picture, and on to its strokes."""
    inside = contact(placed, points[-1])
    return at(*points, *(() if inside is None else (inside,))).replace("M", "L", 1)


def contact(placed: PlacedBox, point: Point) -> Point | None:
    """Where a lead that enters a picture at a point of its edge meets the strokes; None if it misses them."""
    icon, drawn = placed.icon, placed.box.icon
    (_, (a, b, c, d)), (x, y) = _turn(placed), point
    upright = abs(x - icon.x) * icon.height < abs(y - icon.y) * icon.width
    u, v = (0, 1 if y < icon.y else -1) if upright else (1 if x < icon.x else -1, 0)
    p, q = x - icon.x, y - icon.y
    start, way = (a * p + c * q, b * p + d * q), (a * u + c * v, b * u + d * v)
    length = reach(drawn.strokes + drawn.fills, start, way)
    return None if length is None else (x + u * length, y + v * length)


def _turn(placed: PlacedBox) -> tuple[str, tuple[int, int, int, int]]:
    """How a picture is turned: as an SVG transform, and as a matrix in rows."""
    if placed.facing.upright:
        down = placed.ports[min(placed.ports)][1] < placed.icon.y
        return (" rotate(90)", (0, -1, 1, 0)) if down else (" rotate(-90)", (0, 1, -1, 0))
    x, y = -1 if placed.facing.mirrored else 1, -1 if placed.facing.flipped else 1
    return "" if x == y == 1 else f" scale({x} {y})", (x, 0, 0, y)


def _frame(placed: PlacedBox) -> Iterator[str]:
    """A box where the class has one; else a place to click. Lists have more boxes behind."""
    drawn, icon = placed.box, placed.icon
    if drawn.count > 1:
        for step in (6.0, 3.0):
            behind = replace(icon, x=icon.x + step, y=icon.y - step)
            yield rectangle(behind, f'{LINES.format("currentColor")} stroke-opacity="0.5"')
    lines = LINES.format(_color(drawn))
    framed = drawn.icon.frame or drawn.count > 1
    tint = f'fill="{NEURAL}" fill-opacity="0.16"' if drawn.learned else 'fill="transparent"'
    yield rectangle(icon, f"{tint} {lines}" if framed else tint)
    if drawn.inside and framed:
        inner = replace(icon, width=icon.width - 5, height=icon.height - 5)
        yield rectangle(inner, f'{lines} stroke-opacity="0.4"', radius=2.0)


def _color(drawn: Box) -> str:
    """Of a frame: blocks of truth values and of whole numbers have the colour of their signals."""
    signals = sorted(drawn.ports, key=lambda port: port.kind != "output")
    acausal = any(port.kind == "connector" for port in signals)
    return (
        "currentColor" if not signals or acausal or signals[0].color == SIGNAL else signals[0].color
    )


def _picture(placed: PlacedBox) -> Iterator[str]:
    drawn, icon = placed.box.icon, placed.icon
    turn, (a, b, c, d) = _turn(placed)
    if drawn.strokes or drawn.fills:
        place = f"translate({n(icon.x)} {n(icon.y)}){turn}"
        yield f'<g transform="{place}" stroke="currentColor" stroke-width="1.4">'
        yield f'<path d="{drawn.strokes}"/>' if drawn.strokes else ""
        yield f'<path d="{drawn.fills}" fill="currentColor" stroke="none"/>' if drawn.fills else ""
        yield "</g>"
    for x, y, data in drawn.upright:
        place = f"translate({n(icon.x + a * x + b * y)} {n(icon.y + c * x + d * y)})"
        yield f'<path transform="{place}" d="{data}" stroke="currentColor" stroke-width="1.4"/>'
    if drawn.text:
        yield text(drawn.text, icon.x, icon.y + 4)
    if drawn.mark:
        yield _mark(placed)


def _mark(placed: PlacedBox) -> str:
    """At the upper right, or where the picture and the names of ports leave room."""
    drawn, icon = placed.box.icon, placed.icon
    y = icon.bottom - 2 if drawn.upright else icon.top + SMALL + (2 if drawn.frame else -1)
    named = {placed.side(number) for number in named_ports(placed.box, placed.facing)}
    if named >= {"left", "right"}:
        return text(drawn.mark, icon.x, y, size=SMALL)
    if "right" in named or placed.facing.mirrored:
        return text(drawn.mark, icon.left + 4, y, anchor="start", size=SMALL)
    return text(drawn.mark, icon.right - 4, y, anchor="end", size=SMALL)


def _port_names(placed: PlacedBox) -> Iterator[str]:
    """Names of ports, where a framed box has several."""
    named = named_ports(placed.box, placed.facing)
    for number, (_, y) in placed.ports.items():
        if number not in named:
            continue
        side, name = placed.side(number), placed.box.ports[number].name
        if side == "left":
            yield text(name, placed.icon.left + 4, y + 3, anchor="start", size=SMALL)
        elif side == "right":
            yield text(name, placed.icon.right - 4, y + 3, anchor="end", size=SMALL)


def _gate(placed: PlacedBox) -> Iterator[str]:
    """A connector of an opened component: a square, or an arrow head for a signal."""
    icon, port = placed.icon, placed.box.ports[0]
    if port.kind == "connector":
        yield rectangle(Rect(icon.x, icon.y, 8, 8), f'fill="{port.color}"', radius=0.0)
    else:
        corners = (icon.left, icon.top), (icon.right, icon.y), (icon.left, icon.bottom)
        yield f'<path d="{at(*corners)}Z" fill="{port.color}"/>'


def _label(placed: PlacedBox) -> Iterator[str]:
    """The name, where `PlacedBox.label` says."""
    if label := placed.label:
        yield text(label.words, *label.point, anchor=label.anchor, size=label.size)


def _footing(placed: PlacedBox, footing: Footing) -> str:
    """A ground right at a port."""
    icon, port, side = placed.icon, placed.box.ports[footing.port], placed.side(footing.port)
    dx, dy = INTO[OPPOSITE[side]]
    x, y = icon.x + dx * icon.width / 2, icon.y + dy * icon.height / 2
    reach = 4.0 if dy else 7.0
    lead = at((x + reach * dx, y + reach * dy), (x, y))
    lead += "" if placed.box.icon.frame else _to_stroke(placed, ((x, y),))
    width, height = footing.icon.size
    x, y = x + reach * dx, y + reach * dy
    if "top" in footing.icon.sides.values():  # it hangs
        turn = "rotate(180)" if dy < 0 else ""
        y += (dy or 1) * SCALE * height / 2
    else:
        turn = {"right": "", "left": "scale(-1 1)", "bottom": "rotate(90)", "top": "rotate(-90)"}[
            side
        ]
        x, y = x + dx * SCALE * width / 2, y + dy * SCALE * width / 2
    picture = (
        f'<path d="{lead}" stroke="{port.color}" stroke-width="1.6"/>'
        f'<g transform="translate({n(x)} {n(y)}) {turn} scale({SCALE})" stroke="currentColor" '
        f'stroke-width="2"><path d="{footing.icon.strokes}"/></g>'
    )
    names, path = escape(" ".join(footing.names)), escape(footing.path)
    title = f"{footing.path}: {footing.role}"
    whole = titled("ac-component", f'data-component="{path}"', title, [picture])
    return f'<g class="ac-wire" data-connection="{names}">{whole}</g>'


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
