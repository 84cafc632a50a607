"""The schematic of a model as SVG, in which components can be clicked."""

from __future__ import annotations

from acausal.drawing import draw
from acausal.errors import AcausalError
from acausal.modeling import Component

MOST_PARTS = 150
"""Models with more parts at one level are not drawn on pages."""


def schematic(component: Component) -> str:
    """The parts of a component and how they are connected; empty where there are none, or nothing to draw with."""
    if not 0 < len(component._node.children) <= MOST_PARTS:
        return ""
    try:
        return draw(component).svg
    except AcausalError:  # the package that lays drawings out is not installed
        return ""
