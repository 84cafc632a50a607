"""The drawing of a model, from the component to SVG."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from acausal.drawing.layout import lay_out
from acausal.drawing.placed import Placed
from acausal.drawing.read import read
from acausal.drawing.svg import write
from acausal.errors import DataError, ModelError, need_whole
from acausal.files import need_path, write_files
from acausal.modeling import Component


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


def draw(model: Any, depth: int = 1) -> Diagram:
    """Draw a model: see `acausal.diagram`."""
    if not isinstance(model, Component):
        model = getattr(model, "model", model)  # of a system
    if not isinstance(model, Component):
        raise ModelError(f"diagram needs a Component, got {type(model).__name__}")
    placed = lay_out(read(model, need_whole(depth, "diagram: depth", ModelError, 1)))
    node = model._node
    return Diagram(write(placed, f"Diagram of {node.path or type(model).__name__}"), placed)
