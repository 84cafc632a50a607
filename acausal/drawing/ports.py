"""The ports of a component and the sides they are usually on."""

from __future__ import annotations

from collections.abc import Sequence

from acausal.drawing.scheme import Kind, Port
from acausal.modeling import Component, Connector, Declaration, Icon, Input, Output, Side

SIGNAL, BOOLEAN, INTEGER = "#6f7fa3", "#b650a8", "#c27c2c"
"""Colours of signals: of real numbers, truth values and whole numbers."""

KINDS = {"bool": BOOLEAN, "int": INTEGER}

FEW = 4
"""A vector of signals with more elements than this is one port."""


BELOW = ("support", "heatPort", "bearing")
"""Connectors that are below others."""


def ports_of(part: Component, icon: Icon, *, is_list: bool = False) -> tuple[Port, ...]:
    """Connectors and signals of a component, or of a list of such, in order; its icon may say on which side."""
    declared = [
        (name, d)
        for name, d in part._node.declarations()
        if isinstance(d, Connector | Input | Output)
    ]
    connectors = [name for name, d in declared if isinstance(d, Connector)]
    free = [n for n in connectors if n not in BELOW] if len(connectors) > 1 else connectors
    ports: list[Port] = []
    for name, d in declared:
        color = KINDS.get(icon.kinds.get(name, "")) or color_of(d)
        usual = _usual(name, d, free)
        stated = name in icon.sides and not icon.reference
        side = icon.sides[name] if stated else usual
        if is_list and side is None:
            side = "left" if name == free[0] else "right"
        kind: Kind = (
            "connector"
            if isinstance(d, Connector)
            else "input"
            if isinstance(d, Input)
            else "output"
        )
        for element in _elements(part, name, d, is_list):
            ports.append(Port(element, kind, side, color))
    return tuple(ports)


def color_of(declared: Declaration | Connector) -> str:
    """Colour of the wires of a connector, or of a signal of a kind."""
    if isinstance(declared, Connector):
        return declared.COLOR
    return KINDS.get(getattr(declared, "kind", "real"), SIGNAL)


def port_of_element(name: str, elements: int) -> str:
    """The name of the port that an element of a vector belongs to."""
    return name if elements <= FEW else name.partition("[")[0]


def _elements(
    part: Component, name: str, declared: Declaration | Connector, is_list: bool
) -> list[str]:
    """Names of a vector's elements while they are few."""
    if isinstance(declared, Connector) or declared.shape is None or is_list:
        return [name]
    shape = part._node.shape(name, declared)
    if shape is None or len(shape) != 1 or shape[0] > FEW:
        return [name]
    return [f"{name}[{i + 1}]" for i in range(shape[0])]


def _usual(name: str, declared: Declaration | Connector, free: Sequence[str]) -> Side | None:
    """Signals flow from left to right; two connectors face each other; supports and heat ports are below."""
    if isinstance(declared, Output):
        return "bottom" if len(free) >= 2 else "right"
    if isinstance(declared, Input):
        return "top" if len(free) >= 2 else "left"
    if name not in free:
        return "bottom"
    if len(free) <= 2:
        return None
    if name.endswith(("_a", "1")) or name == "p":
        return "left"
    if name.endswith(("_b", "2")) or name == "n":
        return "right"
    return "left" if free.index(name) < len(free) // 2 else "right"


def side_of_gate(kind: Kind, usual: Side | None) -> Side:
    """The side of an outside connector of what is drawn: left or right."""
    if usual in ("left", "right"):
        return usual
    return "right" if kind == "output" or usual == "bottom" else "left"
