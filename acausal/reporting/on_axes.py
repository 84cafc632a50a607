"""The old drawing of a model, on matplotlib axes: `acausal.diagram` has it for one more release."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import networkx as nx

from acausal.modeling import Component, Connector, Module, owner_and_name
from acausal.reporting.drawing import need_axes, new_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLORS = ("#1f5c99", "#b0413e", "#3d7a4a", "#8a5a9e", "#b8860b", "#417f8a")
"""Line colours, one per kind of connector; signals are grey."""

NEURAL = "#fdebd0"
PLAIN = "#eef2f6"
SIGNAL = "#808080"


@dataclass(frozen=True)
class _Wire:
    """A node of the drawing that joins ends of components; ``kind`` is a connector class, ``None`` for signals."""

    kind: type[Connector] | None
    ends: tuple[tuple[str, str], ...]


def draw_on_axes(model: Component, ax: Axes | None = None) -> Axes:
    """Draw the parts of a model and their connections, one level deep.

    Parts lie in layers by their distance from the first part; parts with networks are tinted.

    Arguments:
        model: the component whose parts are drawn.
        ax: where to draw; a new figure by default.

    Returns:
        The axes drawn on.
    """
    wires = _wires(model)
    positions = _layers(model, wires)
    if ax is None:
        depth = max((x for x, _ in positions.values()), default=0.0)
        breadth = max((abs(y) for _, y in positions.values()), default=0.0)
        (ax,) = new_axes((max(1.25 * depth + 2.2, 4), max(2.2 * breadth + 1.4, 2)))
    ax = need_axes(ax)
    kinds = list(dict.fromkeys(w.kind for w in wires if w.kind is not None))
    for number, wire in enumerate(wires):
        color = SIGNAL if wire.kind is None else COLORS[kinds.index(wire.kind) % len(COLORS)]
        _draw_wire(ax, wire, positions, positions[f"#{number}"], color)
    for name, part in model._node.children.items():
        _draw_box(ax, positions[name], name, type(part).__name__, learned=_learns(part))
    _frame(ax, list(positions.values()))
    return ax


def _wires(model: Component) -> list[_Wire]:
    """Connections made in the model itself, joined to nodes."""
    graph: nx.Graph[tuple[str, str]] = nx.Graph()
    kind: dict[tuple[str, str], type[Connector] | None] = {}
    for a, b in model._node.connections:
        ends = [_end(model, a), _end(model, b)]
        graph.add_edge(*ends)
        for end, given in zip(ends, (a, b), strict=True):
            kind[end] = type(given) if isinstance(given, Connector) else None
    order = {end: i for i, end in enumerate(graph.nodes)}
    sets = [tuple(sorted(c, key=order.__getitem__)) for c in nx.connected_components(graph)]
    return [_Wire(kind[ends[0]], ends) for ends in sorted(sets, key=lambda e: order[e[0]])]


def _end(model: Component, end: Any) -> tuple[str, str]:
    """The part of the model that an endpoint belongs to ("" for the model itself), and the endpoint's name."""
    owner, name = owner_and_name(end)
    route = None if owner is None else owner.route_from(model._node)
    part, *rest = route or ("",)
    return part, ".".join((*rest, name))


def _layers(model: Component, wires: list[_Wire]) -> dict[str, tuple[float, float]]:
    """Positions: x by the number of wires from the first part, y spread within a layer."""
    graph: nx.Graph[str] = nx.Graph()
    graph.add_nodes_from(model._node.children)
    for number, wire in enumerate(wires):
        graph.add_edges_from((f"#{number}", part) for part, _ in wire.ends if part)
    positions: dict[str, tuple[float, float]] = {}
    offset = 0.0
    for start in model._node.children:
        if start in positions:
            continue
        layers = [list(layer) for layer in nx.bfs_layers(graph, start)]
        order = {node: i for i, node in enumerate(graph.nodes)}
        for depth, layer in enumerate(layers):
            layer.sort(key=lambda n: (_height(graph, n, positions), order[n]))
            for i, node in enumerate(layer):
                positions[node] = depth, offset - (i - (len(layer) - 1) / 2)
        lowest = min(y for _, y in positions.values())
        offset = lowest - 1.0
    for number in range(len(wires)):
        positions.setdefault(f"#{number}", (0.0, offset))
    return positions


def _height(graph: nx.Graph[str], node: str, placed: dict[str, tuple[float, float]]) -> float:
    """Mean height of the neighbours that are placed already, downwards."""
    heights = [-placed[n][1] for n in graph.neighbors(node) if n in placed]
    return sum(heights) / len(heights) if heights else 0.0


def _learns(part: Component) -> bool:
    return any(isinstance(d, Module) for _, d in part._node.declarations()) or any(
        _learns(child) for child in part._node.children.values()
    )


def _draw_wire(
    ax: Axes,
    wire: _Wire,
    positions: dict[str, tuple[float, float]],
    node: tuple[float, float],
    color: str,
) -> None:
    for part, name in wire.ends:
        if not part:
            ax.annotate(
                name,
                node,
                xytext=(0, 8),
                textcoords="offset points",
                ha="center",
                fontsize=8,
                color=color,
            )
            continue
        x, y = positions[part]
        ax.plot([node[0], x], [node[1], y], color=color, lw=1.6, zorder=1, solid_capstyle="round")
    ax.plot(*node, "o", color=color, ms=5, zorder=2)


def _draw_box(
    ax: Axes, position: tuple[float, float], name: str, kind: str, *, learned: bool
) -> None:
    ax.annotate(
        f"{name}\n{kind}",
        position,
        ha="center",
        va="center",
        fontsize=8,
        linespacing=1.3,
        zorder=3,
        bbox={
            "boxstyle": "round,pad=0.45",
            "fc": NEURAL if learned else PLAIN,
            "ec": "#44525f",
            "lw": 1.0,
        },
    )


def _frame(ax: Axes, positions: list[tuple[float, float]]) -> None:
    xs, ys = zip(*(positions or [(0.0, 0.0)]), strict=True)
    ax.set_xlim(min(xs) - 0.9, max(xs) + 0.9)
    ax.set_ylim(min(ys) - 0.6, max(ys) + 0.6)
    ax.set_axis_off()
