"""Joints: prismatic and revolute ones, and wheels that roll on the x-axis."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons, thermal
from acausal.components.choices import STATE_SELECT
from acausal.components.mechanics import rotational, translational

from . import shapes
from .conventions import DRAWN, coincident, direction, turned
from .friction import striple
from .interfaces import Frame, Offset, PartialTwoFrames

__modelica__ = "PlanarMechanics.Joints"


class Prismatic(Offset):
    """A joint along ``r``, without friction: ``frame_b`` is ``s`` [m] away from ``frame_a``, at the same angle.

    With ``useFlange`` the force ``f = flange_a.f`` drives it against ``support``, which is fixed in the world.
    """

    ICON = icons.PRISMATIC
    UNUSED = (*DRAWN, "boxWidth", "boxColor")

    useFlange = ac.Option(False, doc="whether a flange drives the joint")
    stateSelect = ac.Option("prefer", choices=STATE_SELECT, doc="priority of s and v as states")
    r = ac.Parameter(unit="m", shape=2, doc="direction, resolved in frame_a")
    flange_a = translational.Flange(when="useFlange")
    support = translational.Support(when="useFlange")
    s = ac.Variable(unit="m", state="stateSelect", doc="elongation")
    v = ac.Variable(unit="m/s", state="stateSelect", doc="speed of elongation")
    a = ac.Variable(unit="m/s2", doc="acceleration of elongation")
    f = ac.Variable(unit="N", doc="force in the direction of elongation")
    e0 = ac.Variable(unit="1", shape=2, doc="unit vector along the joint, resolved in the world")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        for e0, along, r0 in zip(
            self.e0, turned(self.frame_a.phi, *direction(self.r)), self.r0, strict=True
        ):
            yield ac.Eq(e0, along)
            yield ac.Eq(r0, e0 * self.s)
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))
        yield ac.Eq(self.frame_a.fx * self.e0[0] + self.frame_a.fy * self.e0[1], self.f)
        if self.useFlange:
            yield ac.Eq(self.flange_a.s, self.s)
            yield ac.Eq(self.flange_a.f, self.f)
            yield ac.Eq(self.support.s, 0)
        else:
            yield ac.Eq(self.f, 0)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.between(self.frame_a, self.frame_b, shapes.SLIDE)


class Revolute(PartialTwoFrames):
    """A hinge without friction: ``frame_b`` is turned by ``phi`` [rad] against ``frame_a``.

    With ``useFlange`` the torque ``t = flange_a.tau`` drives it against ``support``, which is fixed in the world.
    """

    ICON = icons.REVOLUTE
    UNUSED = (*DRAWN, "cylinderLength", "cylinderDiameter", "cylinderColor", "extraLine")

    useFlange = ac.Option(False, doc="whether a flange drives the joint")
    stateSelect = ac.Option("prefer", choices=STATE_SELECT, doc="priority of phi and w as states")
    flange_a = rotational.Flange(when="useFlange")
    support = rotational.Support(when="useFlange")
    phi = ac.Variable(unit="rad", state="stateSelect", doc="angle from frame_a to frame_b")
    w = ac.Variable(unit="rad/s", state="stateSelect", doc="angular speed")
    z = ac.Variable(unit="rad/s2", doc="angular acceleration")
    t = ac.Variable(unit="N.m", doc="driving torque, = frame_a.t")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from self._held_together()
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.z, ac.der(self.w))
        yield ac.Eq(self.frame_a.phi + self.phi, self.frame_b.phi)
        yield ac.Eq(self.frame_a.t + self.frame_b.t, 0)
        yield ac.Eq(self.frame_a.t, self.t)
        if self.useFlange:
            yield ac.Eq(self.flange_a.phi, self.phi)
            yield ac.Eq(self.flange_a.tau, self.t)
            yield ac.Eq(self.support.phi, 0)
        else:
            yield ac.Eq(self.t, 0)

    def _held_together(self) -> Iterator[ac.Eq]:
        """Both frames are at one place."""
        return coincident(self.frame_a, self.frame_b)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.pin(self.frame_a)


class CutRevolute(Revolute):
    """A hinge that closes a loop, whose other joints all keep their states: nothing is solved by Newton's method.

    Its frames are held together by accelerations: of the gap ``g = frame_b - frame_a``, resolved in the world,
    ``der(der(g)) + 2 der(g)/T + g/T**2 = 0``. It is zero at the start and stays so but for errors of integration, which
    vanish within some ``T`` [s] (J. Baumgarte: Stabilization of constraints and integrals of motion in dynamical
    systems, Computer Methods in Applied Mechanics and Engineering 1, 1972, with alpha = beta = 1/T). Steps must resolve
    ``T``.
    """

    ICON = icons.marked(icons.REVOLUTE, "cut")

    __modelica__ = None

    stateSelect = ac.Option("avoid", choices=STATE_SELECT, doc="priority of phi and w as states")
    T = ac.Parameter(0.05, unit="s", min=0, doc="time in which a gap closes")
    gap = ac.Variable(unit="m", shape=2, state="never", doc="from frame_a to frame_b")
    rate = ac.Variable(unit="m/s", shape=2, state="never", doc="speed of the gap")

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield from super().initial_equations()
        for value in (*self.gap, *self.rate):
            yield ac.Eq(value, 0)

    def _held_together(self) -> Iterator[ac.Eq]:
        a, b = self.frame_a, self.frame_b
        ends = ((a.x, b.x), (a.y, b.y))
        for gap, rate, (start, end) in zip(self.gap, self.rate, ends, strict=True):
            yield ac.Eq(gap, end - start)
            yield ac.Eq(rate, ac.der(gap))
            yield ac.Eq(ac.der(rate) + 2 * rate / self.T + gap / self.T**2, 0)
        yield ac.Eq(a.fx + b.fx, 0)
        yield ac.Eq(a.fy + b.fy, 0)


class PartialRolling(ac.Component):
    """A wheel of radius ``R`` whose hub is ``frame_a``, on the world's x-axis: ``frame_a.y = R``.

    ``frame_a.fx R = frame_a.t``. A subclass states how it rolls.
    """

    ICON = icons.ROLLING
    UNUSED = ("animate",)

    R = ac.Parameter(1.0, unit="m", doc="radius of the wheel")
    stateSelect = ac.Option("prefer", choices=STATE_SELECT, doc="priority of x, phi and w as states")  # fmt: skip
    frame_a = Frame()
    x = ac.Variable(unit="m", state="stateSelect", doc="position of the hub")
    phi = ac.Variable(unit="rad", state="stateSelect", doc="angle")
    w = ac.Variable(unit="rad/s", state="stateSelect", doc="angular speed")
    z = ac.Variable(unit="rad/s2", doc="angular acceleration")
    vx = ac.Variable(unit="m/s", doc="speed of the hub")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.x, self.frame_a.x)
        yield ac.Eq(self.phi, self.frame_a.phi)
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.z, ac.der(self.w))
        yield ac.Eq(self.vx, ac.der(self.x))
        yield ac.Eq(self.frame_a.y, self.R)
        yield ac.Eq(self.frame_a.fx * self.R, self.frame_a.t)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.disc(self.frame_a, self.R)


class IdealRolling(PartialRolling):
    """A wheel that rolls on the x-axis without slip: ``vx = -w R``."""

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.vx, -self.w * self.R)


class DryFrictionBasedRolling(PartialRolling, thermal.PartialElementaryConditionalHeatPort):
    """A wheel that slips on the x-axis: ``frame_a.fx = N mu(v_slip)``, ``v_slip = vx + w R``, ``N = -frame_a.fy``.

    Friction rises smoothly to ``mu_A`` at the speed ``vAdhesion`` and falls to ``mu_S`` from ``vSlide`` on
    (`striple`). So it creeps at rest, and there are no events.
    """

    ICON = icons.marked(icons.ROLLING, "dry")

    vAdhesion = ac.Parameter(unit="m/s", doc="slip at which friction is greatest")
    vSlide = ac.Parameter(unit="m/s", doc="slip from which on friction is that of sliding")
    mu_A = ac.Parameter(unit="1", doc="coefficient of friction at adhesion")
    mu_S = ac.Parameter(unit="1", doc="coefficient of friction of sliding")
    vx = ac.Variable(unit="m/s", state="stateSelect", doc="speed of the hub")
    N = ac.Variable(unit="N", doc="normal force")
    v_slip = ac.Variable(unit="m/s", doc="speed of the contact")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v_slip, self.vx + self.w * self.R)
        yield ac.Eq(self.N, -self.frame_a.fy)
        mu = striple(self.v_slip, self.vAdhesion, self.vSlide, self.mu_A, self.mu_S)
        yield ac.Eq(self.frame_a.fx, self.N * mu)
        yield ac.Eq(self.lossPower, self.frame_a.fx * self.v_slip)
