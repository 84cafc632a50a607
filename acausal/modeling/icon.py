"""How components look: icons and places in a diagram, and shapes where a mechanism is animated."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, cast

from acausal.errors import DeclarationError, shown

Side = Literal["left", "right", "top", "bottom"]

PATH = re.compile(r"[MmLlHhVvCcSsQqTtAaZz0-9eE+\-., \n]*")
"""What path data is made of: whoever reads a class need not fear its picture."""


@dataclass(frozen=True)
class Icon:
    """The picture of a component in a few strokes; a class states it as ``ICON`` and its subclasses inherit it.

    Strokes are SVG path data in pixels: the origin is the centre, x points right and y down. Wires end in the middle
    of a side, so the strokes of an element with two connectors run from ``(-width/2, 0)`` to ``(width/2, 0)``. Where
    the wires need it, a picture is mirrored or turned; its text stays upright.

    Attributes:
        strokes: path data that is drawn as lines.
        fills: path data that is filled.
        upright: path data of signs and curves that stay upright however the picture is turned, each with its place.
        text: short text in the middle.
        mark: shorter text at the upper right, which tells a class from others with the same strokes.
        size: width and height, in pixels.
        frame: whether a box surrounds it, as for blocks.
        sides: name of a connector or signal -> the side it is on, where that differs from the usual one.
        kinds: name of a signal -> ``"bool"`` or ``"int"``, for its colour, where a real variable holds such values.
        places: name -> its place on that side, from -1 at the left or top to 1; without, wires choose the order.
        source: whether a drawing begins with it, at the left, as with a voltage source.
        reference: whether it only fixes a potential, as a ground: one that is connected to several components is
            drawn at each of them.

    Raises:
        DeclarationError: for path data that has anything but commands and numbers, or for an unknown side.
    """

    strokes: str = ""
    fills: str = ""
    text: str = ""
    size: tuple[float, float] = (60.0, 40.0)
    frame: bool = False
    sides: Mapping[str, Side] = field(default_factory=dict[str, Side])
    source: bool = False
    reference: bool = False
    upright: tuple[tuple[float, float, str], ...] = ()
    places: Mapping[str, float] = field(default_factory=dict[str, float])
    mark: str = ""
    kinds: Mapping[str, str] = field(default_factory=dict[str, str])

    def __post_init__(self) -> None:
        placed: Any = self.upright
        if not isinstance(placed, tuple) or not all(
            isinstance(one, tuple) and len(cast(Any, one)) == 3 for one in cast(Any, placed)
        ):
            raise DeclarationError(
                f"an icon's upright path data each have a place, ((0.0, 0.0, 'M-5 0H5'),), got {shown(placed)}"
            )
        if not isinstance(self.sides, Mapping):
            raise DeclarationError(f"an icon's sides go by name, got {shown(self.sides)}")
        for data in (self.strokes, self.fills, *(data for _, _, data in self.upright)):
            if not isinstance(data, str) or not PATH.fullmatch(data):
                raise DeclarationError(
                    f"an icon's strokes are SVG path data such as 'M-30 0H30', got {shown(data)}"
                )
        if not isinstance(self.places, Mapping) or not all(
            isinstance(place, int | float) and -1 <= place <= 1 for place in self.places.values()
        ):
            raise DeclarationError(
                f"an icon's places go by name and lie between -1 and 1, got {shown(self.places)}"
            )
        for name, side in self.sides.items():
            if not isinstance(side, str) or side not in ("left", "right", "top", "bottom"):
                raise DeclarationError(
                    f"an icon's side of '{name}' is left, right, top or bottom, got {shown(side)}"
                )


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
