"""The drawing of a model, from the component to SVG, and where its author wants the parts."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from acausal.drawing.layout import lay_out
from acausal.drawing.placed import Placed
from acausal.drawing.read import read
from acausal.drawing.svg import write
from acausal.errors import AcausalError, DataError, ModelError, need_whole
from acausal.files import need_path, write_files
from acausal.modeling import Component, Placement


class Modelled(Protocol):
    """What has a model, such as a system."""

    @property
    def model(self) -> Component:
        """The model."""
        ...


@dataclass(frozen=True)
class Diagram:
    """The drawing of a model; notebooks show it.

    Attributes:
        svg: the drawing, for a file or within a page.
        placed: where everything lies.
    """

    svg: str = field(repr=False)
    placed: Placed = field(repr=False)

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: str | Path) -> Path:
        """Write the drawing to a file that ends with ``.svg``, and create its folder.

        Raises:
            DataError: for another ending, or if it cannot be written.
        """
        path = need_path(path, "diagram.save")
        if path.suffix.lower() != ".svg":
            raise DataError(f"A diagram is saved as SVG: {path.name!r} should end with .svg.")
        write_files({path: self.svg}, make_folders=True)
        return path


MOST_PARTS = 60
"""Models of more parts are not drawn unasked: it takes long, and nobody can read it."""


def diagram(model: Component | Modelled, *, depth: int = 1) -> Diagram:
    """Draw a model as a schematic: the parts with the pictures of their classes, orthogonal wires, arrows on signals.

    Lists of more than eight parts are one box with a count; a ground that several parts need is drawn at each. What
    holds a network is tinted. A class states its picture as ``ICON``, an `acausal.Icon`.

    Arguments:
        model: the component, or system, whose parts are drawn.
        depth: how many levels of parts are shown; with 2, parts that have parts are opened, and so on. With 0, the
            component itself is drawn, as it looks within other models.

    Returns:
        The drawing, with its SVG as ``svg`` and a method ``save``; notebooks show it.

    Raises:
        ModelError: for what is not a component, or for a depth below 0.
        AcausalError: if graphlay is not installed.
    """
    component: Any = model if isinstance(model, Component) else getattr(model, "model", model)
    if not isinstance(component, Component):
        raise ModelError(f"diagram needs a Component, got {type(component).__name__}")
    placed = lay_out(read(component, need_whole(depth, "diagram: depth", ModelError, 0)))
    title = f"Diagram of {component._node.path or type(component).__name__}"
    return Diagram(write(placed, title), placed)


def diagram_svg(component: Component, most: int = MOST_PARTS) -> str:
    """The parts of a component and their connections as an ``<svg>`` element; of one without parts its icon.

    Empty for one that has neither, for more than ``most`` parts, and where nothing is installed that draws.
    """
    parts = len(component._node.children)
    if parts > most or (not parts and component.ICON is None):
        return ""
    try:
        return diagram(component).svg
    except AcausalError:
        return ""


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
