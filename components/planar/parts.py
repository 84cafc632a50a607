"""Bodies, what is fixed or rigid, springs and dampers."""

from collections.abc import Iterator
from typing import Any, ClassVar

import acausal as ac
from acausal.components import icons, thermal
from acausal.components.choices import STATE_SELECT

from . import shapes
from .conventions import DRAWN, GRAVITY, coincident, turned
from .interfaces import Frame, Offset, PartialTwoFrames

__modelica__ = "PlanarMechanics.Parts"

_LINE = (
    *DRAWN, "animateConnectors", "diameterConnector_a", "diameterConnector_b", "colorConnector_a",
    "colorConnector_b", "enableAssert", "length_a", "diameter_a", "diameter_b", "color_a", "color_b",
    "numberOfWindings", "width", "color", "s_small",
)  # fmt: skip


class Fixed(ac.Component):
    """A frame fixed in the world, at the place ``r`` [m] and the angle ``phi`` [rad]."""

    ICON = icons.FIXED
    UNUSED = DRAWN

    r = ac.Parameter(0.0, unit="m", shape=2, doc="position, resolved in the world")
    phi = ac.Parameter(0.0, unit="rad", doc="angle against the world")
    frame = Frame()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.frame.x, self.r[0])
        yield ac.Eq(self.frame.y, self.r[1])
        yield ac.Eq(self.frame.phi, self.phi)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.at(self.frame, shapes.GROUND, extent=(-1.7, -2.1, 1.7, 0.0))


class Body(ac.Component):
    """A rigid body of mass ``m`` and inertia ``I`` at its centre of mass, ``frame_a``.

    ``m (a - g) = f`` and ``I z = frame_a.t`` with ``v = der(r)``, ``a = der(v)``, ``w = der(phi)``, ``z = der(w)``.
    Gravity ``g`` is that of the world (`PlanarWorld`), unless ``enableGravity`` is false.
    """

    ICON = icons.MASS
    UNUSED = (*DRAWN, "sphereDiameter", "sphereColor")
    OUTER: ClassVar = {"g": "planarWorld.g"}

    m = ac.Parameter(unit="kg", min=0, doc="mass")
    I = ac.Parameter(unit="kg.m2", min=0, doc="moment of inertia about the centre of mass")
    g = ac.Parameter(GRAVITY, unit="m/s2", shape=2, doc="acceleration of gravity of the world")
    enableGravity = ac.Option(True, doc="whether gravity acts")
    stateSelect = ac.Option("default", choices=STATE_SELECT, doc="priority of r, v, phi and w as states")  # fmt: skip
    frame_a = Frame()
    f = ac.Variable(unit="N", shape=2, doc="force at frame_a")
    r = ac.Variable(unit="m", shape=2, state="stateSelect", doc="position")
    v = ac.Variable(unit="m/s", shape=2, state="stateSelect", doc="speed")
    a = ac.Variable(unit="m/s2", shape=2, doc="acceleration")
    phi = ac.Variable(unit="rad", state="stateSelect", doc="angle")
    w = ac.Variable(unit="rad/s", state="stateSelect", doc="angular speed")
    z = ac.Variable(unit="rad/s2", doc="angular acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        frame = self.frame_a
        for i, (place, force) in enumerate(((frame.x, frame.fx), (frame.y, frame.fy))):
            yield ac.Eq(self.r[i], place)
            yield ac.Eq(self.v[i], ac.der(self.r[i]))
            yield ac.Eq(self.a[i], ac.der(self.v[i]))
            yield ac.Eq(self.f[i], force)
            gravity = self.m * self.g[i] if self.enableGravity else 0
            yield ac.Eq(self.f[i] + gravity, self.m * self.a[i])
        yield ac.Eq(self.phi, frame.phi)
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.z, ac.der(self.w))
        yield ac.Eq(frame.t, self.I * self.z)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.disc(self.frame_a, ac.sqrt(2 * self.I / self.m), traced=True)


class FixedTranslation(Offset):
    """A rigid rod without mass: ``frame_b`` is ``r`` [m] away from ``frame_a``, at the same angle."""

    ICON = icons.ROD
    UNUSED = (*DRAWN, "width", "color")

    r = ac.Parameter((1.0, 0.0), unit="m", shape=2, doc="from frame_a to frame_b, resolved in frame_a")  # fmt: skip

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        away = turned(self.frame_a.phi, self.r[0], self.r[1])
        yield ac.Eq(self.r0[0], away[0])
        yield ac.Eq(self.r0[1], away[1])

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.between(self.frame_a, self.frame_b, shapes.ROD)


class FixedRotation(PartialTwoFrames):
    """Two frames at one place, ``frame_b`` turned by ``alpha`` [rad] against ``frame_a``."""

    ICON = icons.marked(icons.ROD, "∠")
    UNUSED = (*DRAWN, "cylinderLength", "cylinderDiameter", "cylinderColor")

    alpha = ac.Parameter(unit="rad", doc="fixed angle from frame_a to frame_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from coincident(self.frame_a, self.frame_b)
        yield ac.Eq(self.frame_a.phi + self.alpha, self.frame_b.phi)
        yield ac.Eq(self.frame_a.t + self.frame_b.t, 0)


class PartialSpring(PartialTwoFrames):
    """Forces ``f_x``, ``f_y`` [N] over ``s_relx``, ``s_rely`` [m], resolved in the world; a subclass states them.

    ``frame_b.fx = f_x = -frame_a.fx``, and likewise along y. ``phi_rel = frame_b.phi - frame_a.phi`` [rad].
    """

    UNUSED = _LINE

    c_x = ac.Parameter(unit="N/m", min=0, doc="stiffness along the world's x-axis")
    c_y = ac.Parameter(unit="N/m", min=0, doc="stiffness along the world's y-axis")
    c_phi = ac.Parameter(1e5, unit="N.m/rad", min=0, doc="stiffness against rotation")
    s_relx0 = ac.Parameter(0.0, unit="m", doc="unstretched length along x")
    s_rely0 = ac.Parameter(0.0, unit="m", doc="unstretched length along y")
    phi_rel0 = ac.Parameter(0.0, unit="rad", doc="unstretched angle")
    stateSelect = ac.Option("default", choices=STATE_SELECT, doc="priority of the lengths as states")  # fmt: skip
    s_relx = ac.Variable(unit="m", state="stateSelect", doc="length along x")
    s_rely = ac.Variable(unit="m", state="stateSelect", doc="length along y")
    phi_rel = ac.Variable(unit="rad", state="stateSelect", doc="angle from frame_a to frame_b")
    f_x = ac.Variable(unit="N", doc="force along x, = frame_b.fx")
    f_y = ac.Variable(unit="N", doc="force along y, = frame_b.fy")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield ac.Eq(self.s_relx, b.x - a.x)
        yield ac.Eq(self.s_rely, b.y - a.y)
        yield ac.Eq(self.phi_rel, b.phi - a.phi)
        yield ac.Eq(a.fx, -self.f_x)
        yield ac.Eq(a.fy, -self.f_y)
        yield ac.Eq(b.fx, self.f_x)
        yield ac.Eq(b.fy, self.f_y)


class Spring(PartialSpring):
    """A linear spring along both axes of the world: ``f_x = c_x (s_relx - s_relx0)``, and likewise along y.

    It transmits no torque; ``c_phi`` is without effect, as in Modelica's library.
    """

    ICON = icons.SPRING

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f_x, self.c_x * (self.s_relx - self.s_relx0))
        yield ac.Eq(self.f_y, self.c_y * (self.s_rely - self.s_rely0))
        yield ac.Eq(self.frame_a.t, 0)
        yield ac.Eq(self.frame_b.t, 0)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.between(self.frame_a, self.frame_b, shapes.SPRING)


class SpringDamper(PartialSpring, thermal.PartialElementaryConditionalHeatPort):
    """A linear spring and damper along both axes of the world, and against rotation.

    ``f_x = c_x (s_relx - s_relx0) + d_x v_relx``, likewise along y; ``tau = c_phi (phi_rel - phi_rel0) + d_phi w_rel``.
    """

    ICON = icons.SPRING_DAMPER

    d_x = ac.Parameter(1.0, unit="N.s/m", min=0, doc="damping along the world's x-axis")
    d_y = ac.Parameter(1.0, unit="N.s/m", min=0, doc="damping along the world's y-axis")
    d_phi = ac.Parameter(1.0, unit="N.m.s/rad", min=0, doc="damping against rotation")
    v_relx = ac.Variable(unit="m/s", doc="relative speed along x")
    v_rely = ac.Variable(unit="m/s", doc="relative speed along y")
    w_rel = ac.Variable(unit="rad/s", doc="relative angular speed")
    tau = ac.Variable(unit="N.m", doc="torque, = frame_b.t")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        v_x, v_y = self.v_relx, self.v_rely
        yield ac.Eq(v_x, ac.der(self.s_relx))
        yield ac.Eq(v_y, ac.der(self.s_rely))
        yield ac.Eq(self.w_rel, ac.der(self.phi_rel))
        yield ac.Eq(self.f_x, self.c_x * (self.s_relx - self.s_relx0) + self.d_x * v_x)
        yield ac.Eq(self.f_y, self.c_y * (self.s_rely - self.s_rely0) + self.d_y * v_y)
        turning = self.c_phi * (self.phi_rel - self.phi_rel0)
        yield ac.Eq(self.tau, turning + self.d_phi * self.w_rel)
        yield ac.Eq(self.frame_a.t, -self.tau)
        yield ac.Eq(self.frame_b.t, self.tau)
        yield ac.Eq(self.lossPower, self.d_x * v_x**2 + self.d_y * v_y**2)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.between(self.frame_a, self.frame_b, shapes.SPRING_DAMPER)


class Damper(PartialTwoFrames, thermal.PartialElementaryConditionalHeatPort):
    """A damper along the line between its frames: ``f = -d v`` with ``v = der(length)``.

    The direction is finite where the frames meet: there the distance counts as ``s_small`` [m].
    """

    ICON = icons.DAMPER
    UNUSED = _LINE

    d = ac.Parameter(1.0, unit="N.s/m", min=0, doc="damping constant")
    s_small = ac.Parameter(1e-10, unit="m", min=0, doc="least distance of the frames")
    stateSelect = ac.Option("default", choices=STATE_SELECT, doc="priority of r0 as states")
    r0 = ac.Variable(unit="m", shape=2, state="stateSelect", doc="from frame_a to frame_b")
    d0 = ac.Variable(unit="1", shape=2, doc="direction from frame_a to frame_b")
    length = ac.Variable(unit="m", doc="distance of the frames")
    vx = ac.Variable(unit="m/s", doc="relative speed along x")
    vy = ac.Variable(unit="m/s", doc="relative speed along y")
    v = ac.Variable(unit="m/s", doc="speed at which the frames part")
    f = ac.Variable(unit="N", doc="force along d0 at frame_a")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a, b, d0 = self.frame_a, self.frame_b, self.d0
        square: Any = self.r0[0] ** 2 + self.r0[1] ** 2
        yield ac.Eq(self.length, ac.sqrt(ac.maximum(square, self.s_small**2)))
        yield ac.Eq(a.x + self.r0[0], b.x)
        yield ac.Eq(a.y + self.r0[1], b.y)
        yield ac.Eq(d0[0], self.r0[0] / self.length)
        yield ac.Eq(d0[1], self.r0[1] / self.length)
        yield ac.Eq(self.vx, ac.der(self.r0[0]))
        yield ac.Eq(self.vy, ac.der(self.r0[1]))
        yield ac.Eq(self.v, self.vx * d0[0] + self.vy * d0[1])
        yield ac.Eq(self.f, -self.d * self.v)
        yield ac.Eq(a.fx, d0[0] * self.f)
        yield ac.Eq(a.fy, d0[1] * self.f)
        yield ac.Eq(a.fx + b.fx, 0)
        yield ac.Eq(a.fy + b.fy, 0)
        yield ac.Eq(a.t, 0)
        yield ac.Eq(b.t, 0)
        yield ac.Eq(self.lossPower, -self.f * self.v)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.between(self.frame_a, self.frame_b, shapes.DAMPER)
