"""Say where a part lies on a schematic."""

from __future__ import annotations

from typing import Any

from acausal.errors import ModelError
from acausal.modeling import Component, Placement


def place(part: Component, x: float, y: float, *, turned: int = 0, mirrored: bool = False) -> None:
    """Say where a part lies on the schematic of its model; `ac.diagram` keeps it once all parts have a place.

    Arguments:
        part: the component.
        x, y: its middle, in the units of Modelica's diagrams: a component is 20 wide, and y points upwards.
        turned: by how many degrees, counter-clockwise: 0, 90, 180 or 270.
        mirrored: whether left and right are exchanged, before it is turned.

    Raises:
        ModelError: for what is not a component.
        DeclarationError: for what is no number, and for another angle.
    """
    given: Any = part
    if not isinstance(given, Component):
        raise ModelError(f"place needs a part, got {type(given).__name__}")
    given._node.placement = Placement(x, y, turned, mirrored)
