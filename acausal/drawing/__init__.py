"""Draw: a component tree as a schematic.

In: a component, with the icons and colours that its classes state. Out: SVG, and where everything lies.
It knows neither plots nor results.
"""

from acausal.drawing.diagram import (
    Diagram as Diagram,
    diagram as diagram,
    diagram_svg as diagram_svg,
    place as place,
)
