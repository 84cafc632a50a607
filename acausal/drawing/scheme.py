"""A model as a drawing needs it: boxes with ports, and nets that join them. No places yet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from acausal.modeling import Icon, Placement, Side

Kind = Literal["input", "output", "connector"]

OPPOSITE: Mapping[Side, Side] = {
    "left": "right", "right": "left", "top": "bottom", "bottom": "top"
}  # fmt: skip


@dataclass(frozen=True)
class Port:
    """A connector or a signal of a box.

    Attributes:
        name: its name there.
        kind: which way a signal runs, or that it is a connector.
        side: where it usually is; None if both ends will do, as for the two ends of a spring.
        color: of its wires.
    """

    name: str
    kind: Kind
    side: Side | None
    color: str


@dataclass(frozen=True)
class Footing:
    """A ground that is drawn right at a port above or below a box.

    Attributes:
        port: number of the port.
        path, role, icon: of the ground.
        names: full names of the two ends.
    """

    port: int
    path: str
    role: str
    icon: Icon
    names: tuple[str, ...]


@dataclass(frozen=True)
class Box:
    """A component, several components of a list, or an outside connector of what is drawn.

    Attributes:
        path: dotted name in the model; copies of a ground share it.
        label: what is written below.
        role: name of its class.
        icon: its picture.
        ports: all of them, connected or not.
        count: how many components it stands for.
        learned: whether there is a network in it.
        inside: whether it has parts and connections of its own.
        inner: what is drawn in it where it is opened.
        is_port: whether it is an outside connector of what is drawn.
        footings: grounds of its own.
        placement: where the model's author put it.
    """

    path: str
    label: str
    role: str
    icon: Icon
    ports: tuple[Port, ...]
    count: int = 1
    learned: bool = False
    inside: bool = False
    inner: Scheme | None = None
    is_port: bool = False
    footings: tuple[Footing, ...] = ()
    placement: Placement | None = None


@dataclass(frozen=True, order=True)
class End:
    """An end of a wire: indices of a box and of one of its ports."""

    box: int
    port: int


@dataclass(frozen=True)
class Net:
    """What one set of connected ports becomes.

    Attributes:
        ends: in order of declaration; of a signal the source is first.
        names: full names of the ends, as in the model.
        signal: whether it carries a signal.
        color: of its wires.
    """

    ends: tuple[End, ...]
    names: tuple[str, ...]
    signal: bool
    color: str


@dataclass(frozen=True)
class Scheme:
    """All there is to draw."""

    boxes: tuple[Box, ...]
    nets: tuple[Net, ...]

    @property
    def is_placed(self) -> bool:
        """Whether the author gave a place to every component."""
        places = [box.placement for box in self.boxes if not box.is_port]
        return bool(places) and None not in places

    def port(self, end: End) -> Port:
        """The port at an end."""
        return self.boxes[end.box].ports[end.port]
