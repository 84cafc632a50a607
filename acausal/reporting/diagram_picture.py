"""The diagram of a model as SVG text, for pages and notebooks."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from acausal.errors import AcausalError
from acausal.modeling import Component
from acausal.reporting.diagram import diagram
from acausal.reporting.drawing import close

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_PARTS = 60
"""Models of more parts are not drawn unasked: it takes long, and nobody can read it."""

UNSAID = dict.fromkeys(("Creator", "Date", "Format", "Type"))
"""What matplotlib would write about a picture."""


def diagram_svg(model: Component) -> str:
    """The parts of a model and their connections as an ``<svg>`` element.

    Of a component without parts it is its icon. Empty for one that has neither, for a model of more than `MOST_PARTS`,
    and where nothing is installed that draws.
    """
    parts = len(model._node.children)
    if parts > MOST_PARTS or (not parts and model.ICON is None):
        return ""
    try:
        drawn: Any = diagram(model)
    except AcausalError:
        return ""
    text = str(drawn._repr_svg_()) if hasattr(drawn, "_repr_svg_") else _saved(drawn.figure)
    return text[text.index("<svg") :]


def _saved(figure: Figure) -> str:
    """A figure as SVG; it is closed."""
    from matplotlib import rc_context

    written = io.StringIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "acausal"}):
        figure.savefig(written, format="svg", transparent=True, metadata=UNSAID)
    close(figure)
    return written.getvalue()
