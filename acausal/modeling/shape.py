"""Shapes: what a class of components looks like where its mechanism is animated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from acausal.errors import DeclarationError, shown
from acausal.modeling.icon import PATH


@dataclass(frozen=True)
class Shape:
    """An outline that moves with a component; a class yields its own from the method ``shapes``.

    All but the path are numbers, or expressions of the component's own variables and parameters.

    Attributes:
        path: SVG path data; x points right, y up, and ``size`` is the unit.
        x, y: where the origin of the path is in the world [m].
        phi: by which angle it is turned, counter-clockwise [rad].
        size: units of the path along its own x and y [m]; None for that of a mark, such as a pin, that is drawn as
            large as it can be recognized.
        extent: least x and y of the path, and greatest ones, in its units.
        filled: whether it is an area.
        traced: whether the way of its origin can be shown.

    Raises:
        DeclarationError: for path data that has anything but commands and numbers.
    """

    path: str
    x: Any
    y: Any
    phi: Any = 0.0
    size: tuple[Any, Any] = (None, None)
    extent: tuple[float, float, float, float] = (-1.0, -1.0, 1.0, 1.0)
    filled: bool = False
    traced: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.path, str) or not PATH.fullmatch(self.path):
            raise DeclarationError(
                f"a shape's path is SVG path data such as 'M0 0H1', got {shown(self.path)}"
            )
