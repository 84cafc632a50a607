"""The world: gravity for all bodies."""

from collections.abc import Iterator
from typing import Any, ClassVar

import acausal as ac
from acausal.components import icons

from . import multibody
from .conventions import GRAVITY

__modelica__ = "PlanarMechanics"

_DRAWN = (
    "enableAnimation", "animateWorld", "animateGravity", "label1", "label2", "axisLength", "axisDiameter",
    "axisShowLabels", "axisColor_x", "axisColor_y", "axisColor_z", "gravityArrowTail", "gravityArrowLength",
    "gravityArrowDiameter", "gravityArrowColor", "defaultZPosition", "nominalLength", "defaultJointLength",
    "defaultJointWidth", "defaultBodyDiameter", "defaultWidthFraction", "defaultArrowDiameter",
    "defaultForceLength", "defaultForceWidth", "defaultFrameDiameterFraction", "defaultSpecularCoefficient",
    "defaultN_to_m", "defaultNm_to_m",
)  # fmt: skip


class PlanarWorld(ac.Component):
    """The world of a planar model: its gravity ``g = constantGravity`` [m/s2] acts on all bodies.

    Bodies take the gravity of the world in the nearest enclosing model, unless they are given another ``g``.
    """

    ICON = icons.WORLD

    UNUSED = _DRAWN

    constantGravity = ac.Parameter(
        GRAVITY, unit="m/s2", shape=2, doc="acceleration of gravity, resolved in the world"
    )
    g = ac.Parameter(unit="m/s2", shape=2, doc="acceleration of gravity that acts, computed")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.modify(g=self._gravity())

    def _gravity(self) -> Any:
        return self.constantGravity


class PlanarWorldIn3D(PlanarWorld):
    """A planar world that lies in a spatial one, at ``MBFrame_a`` with ``connectToMultiBody``.

    With ``inheritGravityFromMultiBody`` gravity is that of the spatial world along the plane's x- and y-axis; the plane
    may be turned about the direction of gravity only. What moves in the plane does not act on the spatial frame.
    """

    ICON = icons.marked(icons.WORLD, "3D")

    UNUSED = _DRAWN
    OUTER: ClassVar = {"gravity": "world.gravity"}

    inheritGravityFromMultiBody = ac.Option(
        False, doc="whether gravity is that of the spatial world"
    )
    connectToMultiBody = ac.Option(False, doc="whether there is a spatial frame")
    gravity = ac.Parameter(
        (*GRAVITY, 0.0), unit="m/s2", shape=3, doc="acceleration of gravity of the spatial world"
    )
    MBFrame_a = multibody.Frame(when="connectToMultiBody")

    def _gravity(self) -> Any:
        return self.gravity[:2] if self.inheritGravityFromMultiBody else self.constantGravity

    def equations(self) -> Iterator[ac.Eq]:
        if self.connectToMultiBody:
            for flow in (*self.MBFrame_a.f, *self.MBFrame_a.t):
                yield ac.Eq(flow, 0)
