"""Draw a model as a schematic."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, overload

from acausal.drawing import Diagram, Modelled, draw
from acausal.errors import ModelError
from acausal.modeling import Component
from acausal.reporting.drawing import need_axes
from acausal.reporting.on_axes import draw_on_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@overload
def diagram(model: Component | Modelled, ax: None = None, *, depth: int = 1) -> Diagram: ...


@overload
def diagram(model: Component, ax: Axes, *, depth: int = 1) -> Axes: ...


def diagram(
    model: Component | Modelled, ax: Axes | None = None, *, depth: int = 1
) -> Diagram | Axes:
    """Draw a model as a schematic: the parts with the pictures of their classes, orthogonal wires, arrows on signals.

    Lists of more than eight parts are one box with a count; a ground that several parts need is drawn at each. What
    holds a network is tinted. A class states its picture as ``ICON``, an `acausal.Icon`.

    Arguments:
        model: the component, or system, whose parts are drawn.
        ax: deprecated; matplotlib axes on which the old drawing of plain boxes appears, one level deep.
        depth: how many levels of parts are shown; with 2, parts that have parts are opened, and so on.

    Returns:
        The drawing, with its SVG as ``svg`` and a method ``save``; notebooks show it.

    Raises:
        ModelError: for what is not a component, or for a depth below 1.
        AcausalError: if graphlay is not installed.
    """
    if ax is None:
        return draw(model, depth)
    if not isinstance(model, Component):
        raise ModelError(f"diagram needs a Component, got {type(model).__name__}")
    ax = need_axes(ax)
    warnings.warn(
        "diagram(model, ax=...) draws plain boxes and will be removed in the next release: use diagram(model).svg, "
        "or diagram(model).save('model.svg')",
        DeprecationWarning,
        stacklevel=2,
    )
    return draw_on_axes(model, ax)
