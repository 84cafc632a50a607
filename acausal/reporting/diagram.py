"""Draw a model as a schematic."""

from __future__ import annotations

from acausal.drawing import Diagram, Modelled, draw
from acausal.modeling import Component


def diagram(model: Component | Modelled, *, depth: int = 1) -> Diagram:
    """Draw a model as a schematic: the parts with the pictures of their classes, orthogonal wires, arrows on signals.

    Lists of more than eight parts are one box with a count; a ground that several parts need is drawn at each. What
    holds a network is tinted. A class states its picture as ``ICON``, an `acausal.Icon`.

    Arguments:
        model: the component, or system, whose parts are drawn.
        depth: how many levels of parts are shown; with 2, parts that have parts are opened, and so on.

    Returns:
        The drawing, with its SVG as ``svg`` and a method ``save``; notebooks show it.

    Raises:
        ModelError: for what is not a component, or for a depth below 1.
        AcausalError: if graphlay is not installed.
    """
    return draw(model, depth)
