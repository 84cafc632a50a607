"""Gear wheels that mesh, and a planetary gear made of them."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, thermal
from acausal.components.mechanics import rotational
from acausal.components.rotational.components import Inertia

from . import multibody, shapes
from .interfaces import PartialTwoFramesAndHeat
from .joints import Revolute
from .parts import Body, Fixed, FixedRotation, FixedTranslation
from .world import PlanarWorldIn3D

__modelica__ = "PlanarMechanics.GearComponents"

_DRAWN = ("animate", "StartAngle_a", "StartAngle_b", "Tooth_a", "RGB_a", "RGB_b", "z_offset")


class PartialGear(PartialTwoFramesAndHeat):
    """Two gear wheels of radii ``r_a`` and ``r_b`` that mesh without loss, with the force ``F_n`` [N].

    ``phi_gear`` [rad] is the angle of the line between the axes, which are kept ``r_a + r_b`` (external) or
    ``r_b - r_a`` (internal) apart by the parts around; it starts at the angle that they have.
    """

    ICON = icons.GEAR
    UNUSED = _DRAWN
    _INSIDE = False

    r_a = ac.Parameter(1.0, unit="m", doc="radius of gear A")
    r_b = ac.Parameter(1.0, unit="m", doc="radius of gear B")
    w_a = ac.Variable(unit="rad/s", doc="angular speed of gear A")
    w_b = ac.Variable(unit="rad/s", doc="angular speed of gear B")
    w_gear = ac.Variable(unit="rad/s", doc="angular speed of the line between the axes")
    F_n = ac.Variable(unit="N", doc="force in the mesh")
    v_mesh = ac.Variable(unit="m/s", doc="speed in the mesh")
    a_mesh = ac.Variable(unit="m/s2", doc="acceleration in the mesh")
    xmesh_a = ac.Variable(unit="m", doc="way of gear A in the mesh")
    xmesh_b = ac.Variable(unit="m", doc="way of gear B in the mesh")
    phi_gear = ac.Variable(unit="rad", doc="angle of the line between the axes")

    def _line(self) -> tuple[Any, Any]:
        """From the axis of gear A to that of gear B; of an internal gear, the other way."""
        a, b = self.frame_a, self.frame_b
        return (a.x - b.x, a.y - b.y) if self._INSIDE else (b.x - a.x, b.y - a.y)

    def initial_equations(self) -> Iterator[ac.Eq]:
        x, y = self._line()
        yield ac.Eq(self.phi_gear, ac.atan2(y, x))

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a, b, (x, y) = self.frame_a, self.frame_b, self._line()
        side = 1 if self._INSIDE else -1
        yield ac.Eq(self.lossPower, 0)
        yield ac.Eq(self.w_gear, ac.der(self.phi_gear))
        yield ac.Eq(self.w_gear * (x**2 + y**2), x * ac.der(y) - y * ac.der(x))
        yield ac.Eq(self.w_a, ac.der(a.phi))
        yield ac.Eq(self.w_b, ac.der(b.phi))
        yield ac.Eq(self.xmesh_a, self.r_a * (a.phi - self.phi_gear))
        yield ac.Eq(self.xmesh_b, side * self.r_b * (b.phi - self.phi_gear))
        yield ac.Eq(self.xmesh_a, self.xmesh_b)
        yield ac.Eq(self.v_mesh, ac.der(self.xmesh_a))
        yield ac.Eq(self.a_mesh, ac.der(self.v_mesh))
        yield ac.Eq(a.t, self.F_n * self.r_a)
        yield ac.Eq(b.t, -side * self.F_n * self.r_b)
        yield ac.Eq(a.fx, -ac.sin(self.phi_gear) * self.F_n)
        yield ac.Eq(a.fy, ac.cos(self.phi_gear) * self.F_n)
        yield ac.Eq(a.fx + b.fx, 0)
        yield ac.Eq(a.fy + b.fy, 0)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.disc(self.frame_a, self.r_a)
        yield shapes.disc(self.frame_b, self.r_b)


class RigidNoLossExternal(PartialGear):
    """Two gear wheels side by side: they turn in opposite directions."""


class RigidNoLossInternal(PartialGear):
    """Gear A within the ring gear B: they turn in the same direction."""

    ICON = icons.marked(icons.GEAR, "in")

    _INSIDE = True


class RigidNoLossPlanetary(thermal.PartialConditionalHeatPort):
    """A planetary gear of a sun, a planet, a carrier and a ring, each with its inertia.

    With ``connectToMultiBody`` the frame ``frameVisualisation`` says where it is in a spatial world.
    """

    __modelica__ = "PlanarMechanics.GearComponents.Examples.Utilities"
    ICON = icons.PLANETARY
    UNUSED = ("animate", "Tooth_a", "RGB_s", "RGB_p", "RGB_r", "z_offset")

    r_s = ac.Parameter(1.0, unit="m", doc="radius of the sun")
    r_p = ac.Parameter(1.0, unit="m", doc="radius of the planet")
    r_r = ac.Parameter(3.0, unit="m", doc="radius of the ring")
    J_s = ac.Parameter(1e-3, unit="kg.m2", min=0, doc="inertia of the sun")
    J_p = ac.Parameter(1e-3, unit="kg.m2", min=0, doc="not used, as in Modelica's library")
    J_c = ac.Parameter(1e-3, unit="kg.m2", min=0, doc="inertia of the carrier")
    J_r = ac.Parameter(1e-3, unit="kg.m2", min=0, doc="inertia of the ring")
    connectToMultiBody = ac.Option(False, doc="whether there is a spatial frame")
    flange_Sun = rotational.Flange()
    flange_Carrier = rotational.Flange()
    flange_Ring = rotational.Flange()
    frameVisualisation = multibody.Frame(when="connectToMultiBody")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.planarWorld = PlanarWorldIn3D(connectToMultiBody=self.connectToMultiBody)
        self.sun, self.ring = Inertia(J=self.J_s), Inertia(J=self.J_r)
        self.carrier = Inertia(J=self.J_c)
        self.planet = Body(m=1.0, I=1e-3, g=self.planarWorld.g)
        self.bearing_Sun, self.bearing_Ring = Revolute(useFlange=True), Revolute(useFlange=True)
        self.bearing_Carrier, self.bearing_Planet = Revolute(useFlange=True), Revolute()
        self.sunPlanet = RigidNoLossExternal(r_a=self.r_s, r_b=self.r_p, useHeatPort=True)
        self.planetRing = RigidNoLossInternal(r_a=self.r_p, r_b=self.r_r, useHeatPort=True)
        self.carrierAngle = FixedRotation(alpha=0.0)
        self.carrierPart = FixedTranslation(r=[self.r_s + self.r_p, 0.0])
        self.fixed = Fixed()
        for bearing in (self.bearing_Sun, self.bearing_Carrier, self.bearing_Ring):
            self.connect(self.fixed.frame, bearing.frame_a)
        self.connect(self.bearing_Sun.flange_a, self.sun.flange_a, self.flange_Sun)
        self.connect(self.bearing_Ring.flange_a, self.ring.flange_a, self.flange_Ring)
        self.connect(self.bearing_Carrier.flange_a, self.carrier.flange_a)
        self.connect(self.carrier.flange_b, self.flange_Carrier)
        self.connect(self.bearing_Carrier.frame_b, self.carrierAngle.frame_a)
        self.connect(self.carrierAngle.frame_b, self.carrierPart.frame_a)
        self.connect(self.carrierPart.frame_b, self.bearing_Planet.frame_a)
        self.connect(
            self.bearing_Planet.frame_b,
            self.planet.frame_a,
            self.planetRing.frame_a,
            self.sunPlanet.frame_b,
        )
        self.connect(self.bearing_Sun.frame_b, self.sunPlanet.frame_a)
        self.connect(self.bearing_Ring.frame_b, self.planetRing.frame_b)
        for gear in (self.sunPlanet, self.planetRing):
            self.connect(gear.heatPort, self.internalHeatPort)
        if self.connectToMultiBody:
            self.body3D = multibody.Body(m=1e-5)
            self.connect(self.planarWorld.MBFrame_a, self.body3D.frame_a, self.frameVisualisation)
