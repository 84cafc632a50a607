"""Graphviz' `dot` on the boxes and wires of a drawing, to compare with; where it is installed."""

from __future__ import annotations

import shutil
import subprocess
from itertools import pairwise

from acausal.drawing.placed import Placed

DOT = shutil.which("dot")

Segment = tuple[int, tuple[float, float], tuple[float, float]]


def crossings(placed: Placed) -> int:
    """How often wires of different nets cross where `dot` draws the same boxes and wires with ortho lines."""
    assert DOT is not None
    done = subprocess.run(
        [DOT, "-Tplain"], input=_text(placed), capture_output=True, text=True, check=True
    )
    segments: list[Segment] = []
    for line in done.stdout.splitlines():
        if line.startswith("edge"):
            _, tail, head, count, *rest = line.split()
            values = [float(v) for v in rest[: 2 * int(count)]]
            points = list(zip(values[::2], values[1::2], strict=True))[::3]
            net = _net_of(placed, tail, head)
            segments += [(net, a, b) for a, b in pairwise(points) if a != b]
    return sum(
        _cross(p, q) for i, p in enumerate(segments) for q in segments[i + 1 :] if p[0] != q[0]
    )


def _text(placed: Placed) -> str:
    lines = ['digraph { rankdir=LR; splines=ortho; node [shape=box, fixedsize=true, label=""];']
    for number, box in enumerate(placed.boxes):
        lines.append(f"b{number} [width={box.rect.width / 72}, height={box.rect.height / 72}];")
    for number, net in enumerate(placed.nets):
        ends = [(placed.boxes[e.box].ports[e.port], f"b{e.box}") for e in net.net.ends]
        if len(ends) == 2:
            (_, a), (_, b) = sorted(ends)
            lines.append(f"{a} -> {b} [dir=none, class={number}];")
            continue
        lines.append(f"n{number} [width=0.05, height=0.05];")
        middle = sum(x for (x, _), _ in ends) / len(ends)
        for (x, _), name in ends:
            pair = (name, f"n{number}") if x < middle else (f"n{number}", name)
            lines.append(f"{pair[0]} -> {pair[1]} [dir=none];")
    return "\n".join([*lines, "}"])


def _net_of(placed: Placed, tail: str, head: str) -> int:
    """The net of an edge, by the names of its nodes."""
    for name in (tail, head):
        if name.startswith("n"):
            return int(name[1:])
    pair = {int(tail[1:]), int(head[1:])}
    return next(
        number
        for number, net in enumerate(placed.nets)
        if len(net.net.ends) == 2 and {e.box for e in net.net.ends} == pair
    )


def _cross(p: Segment, q: Segment) -> bool:
    """Whether two segments cross properly."""

    def turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    (_, a, b), (_, c, d) = p, q
    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0
