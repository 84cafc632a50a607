"""Where a part lies on the schematic of its model, if somebody said so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from acausal.errors import DeclarationError, shown

TURNS = (0, 90, 180, 270)


@dataclass(frozen=True)
class Placement:
    """The place of a part, in the units of Modelica's diagrams: a component is 20 wide, and y points upwards.

    Attributes:
        x, y: of its middle.
        turned: by how many degrees, counter-clockwise: 0, 90, 180 or 270.
        mirrored: whether left and right are exchanged, before it is turned.

    Raises:
        DeclarationError: for what is no number, and for another angle.
    """

    x: float
    y: float
    turned: int = 0
    mirrored: bool = False

    def __post_init__(self) -> None:
        for name, value in (("x", self.x), ("y", self.y)):
            given: Any = value
            if isinstance(given, bool) or not isinstance(given, int | float) or abs(given) > 1e6:
                raise DeclarationError(f"a placement's {name} is a number, got {shown(given)}")
        if self.turned not in TURNS or isinstance(self.turned, bool):
            raise DeclarationError(
                f"a placement is turned by 0, 90, 180 or 270 degrees, got {shown(self.turned)}"
            )
        if not isinstance(self.mirrored, bool):
            raise DeclarationError(f"a placement's mirrored is a bool, got {shown(self.mirrored)}")
