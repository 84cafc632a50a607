"""Wheels on the plane, seen from above; air drag and a differential gear."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, thermal
from acausal.components.choices import STATE_SELECT
from acausal.components.mechanics import rotational
from acausal.components.rotational.gears import IdealPlanetary

from . import shapes
from .conventions import direction, equal, turned
from .friction import striple
from .interfaces import Frame

__modelica__ = "PlanarMechanics.VehicleComponents.Wheels"


class PartialWheel(thermal.PartialElementaryConditionalHeatPortWithoutT):
    """A wheel of a ``radius`` that rolls along ``r`` on the plane; ``flange_a`` drives it.

    ``v_long`` [m/s] is the speed of ``frame_a`` along ``r``, ``w_roll = der(phi_roll)`` the wheel's angular speed; the
    longitudinal force is ``f_long = -flange_a.tau/radius``. A subclass states how it holds to the ground.
    """

    __modelica__ = None
    ICON = icons.ROLLING
    UNUSED = ("animate", "zPosition", "diameter", "width", "specularCoefficient")

    radius = ac.Parameter(unit="m", doc="radius of the wheel")
    r = ac.Parameter(unit="m", shape=2, doc="direction of driving, resolved in frame_a")
    stateSelect = ac.Option("default", choices=STATE_SELECT, doc="priority of w_roll as a state")
    frame_a = Frame()
    flange_a = rotational.Flange()
    e0 = ac.Variable(unit="1", shape=2, doc="direction of driving, resolved in the world")
    phi_roll = ac.Variable(unit="rad", doc="angle of the wheel")
    w_roll = ac.Variable(unit="rad/s", state="stateSelect", doc="angular speed of the wheel")
    v = ac.Variable(unit="m/s", shape=2, doc="speed, resolved in the world")
    v_long = ac.Variable(unit="m/s", doc="speed along the direction of driving")
    f_long = ac.Variable(unit="N", doc="force along the direction of driving, at frame_a")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        frame = self.frame_a
        yield from equal(self.e0, turned(frame.phi, *direction(self.r)))
        yield ac.Eq(self.v[0], ac.der(frame.x))
        yield ac.Eq(self.v[1], ac.der(frame.y))
        yield ac.Eq(self.phi_roll, self.flange_a.phi)
        yield ac.Eq(self.w_roll, ac.der(self.phi_roll))
        yield ac.Eq(-self.f_long * self.radius, self.flange_a.tau)
        yield ac.Eq(frame.t, 0)
        yield ac.Eq(self.f_long, frame.fx * self.e0[0] + frame.fy * self.e0[1])

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.at(
            self.frame_a,
            shapes.BOX,
            phi=ac.atan2(self.e0[1], self.e0[0]),
            size=(self.radius, 0.4 * self.radius),
            filled=True,
        )


class IdealWheelJoint(PartialWheel):
    """A wheel that rolls without slip, and does not move sideways: ``v = v_long e0``, ``v_long = radius w_roll``."""

    ICON = icons.WHEEL

    __modelica__ = "PlanarMechanics.VehicleComponents.Wheels"

    stateSelect = ac.Option("prefer", choices=STATE_SELECT, doc="priority of the speeds as states")
    v_long = ac.Variable(
        unit="m/s", state="stateSelect", doc="speed along the direction of driving"
    )
    a = ac.Variable(unit="m/s2", doc="acceleration along the direction of driving")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v[0], self.v_long * self.e0[0])
        yield ac.Eq(self.v[1], self.v_long * self.e0[1])
        yield ac.Eq(self.v_long, self.radius * self.w_roll)
        yield ac.Eq(self.a, ac.der(self.v_long))
        yield ac.Eq(self.lossPower, 0)


class PartialSlippingWheel(PartialWheel):
    """A wheel that slips: its force is against the speed of the contact, ``v_slip_long``, ``v_slip_lat`` [m/s].

    ``v_slip_long = v_long - radius w_roll``; ``v_slip`` is the size of both, and at least 1e-4 m/s. A subclass
    states the force ``f`` [N].
    """

    v_lat = ac.Variable(unit="m/s", doc="speed to the left of the direction of driving")
    v_slip_long = ac.Variable(unit="m/s", doc="speed of the contact, along")
    v_slip_lat = ac.Variable(unit="m/s", doc="speed of the contact, sideways")
    v_slip = ac.Variable(unit="m/s", start=1e-4, doc="size of the contact's speed")
    f = ac.Variable(unit="N", doc="force against the slip")
    f_lat = ac.Variable(unit="N", doc="force to the left, at frame_a")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        frame, e0, v = self.frame_a, self.e0, self.v
        yield ac.Eq(self.v_long, v[0] * e0[0] + v[1] * e0[1])
        yield ac.Eq(self.v_lat, v[1] * e0[0] - v[0] * e0[1])
        yield ac.Eq(self.v_slip_lat, self.v_lat)
        yield ac.Eq(self.v_slip_long, self.v_long - self.radius * self.w_roll)
        square = self.v_slip_long**2 + self.v_slip_lat**2
        yield ac.Eq(self.v_slip, ac.sqrt(square + 1e-20) + 1e-4)  # its root has a slope at rest
        yield ac.Eq(self.f_long, self.f * self.v_slip_long / self.v_slip)
        yield ac.Eq(self.f_lat, self.f * self.v_slip_lat / self.v_slip)
        yield ac.Eq(self.f_lat, frame.fy * e0[0] - frame.fx * e0[1])
        yield ac.Eq(self.lossPower, self.f * self.v_slip)


class DryFrictionWheelJoint(PartialSlippingWheel):
    """A wheel with dry friction: ``f = N mu(v_slip)``.

    Friction rises smoothly to ``mu_A`` at the slip ``vAdhesion`` and falls to ``mu_S`` from ``vSlide`` on.
    """

    ICON = icons.marked(icons.WHEEL, "dry")

    __modelica__ = "PlanarMechanics.VehicleComponents.Wheels"

    N = ac.Parameter(unit="N", doc="normal force")
    vAdhesion = ac.Parameter(unit="m/s", doc="slip at which friction is greatest")
    vSlide = ac.Parameter(unit="m/s", doc="slip from which on friction is that of sliding")
    mu_A = ac.Parameter(unit="1", doc="coefficient of friction at adhesion")
    mu_S = ac.Parameter(unit="1", doc="coefficient of friction of sliding")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        mu = striple(self.v_slip, self.vAdhesion, self.vSlide, self.mu_A, self.mu_S)
        yield ac.Eq(self.f, self.N * mu)


class SlipBasedWheelJoint(PartialSlippingWheel):
    """A wheel whose friction depends on the slip against the speed of its rim: ``f = fN mu(v_slip)``.

    ``vAdhesion = max(sAdhesion |radius w_roll|, vAdhesion_min)``, ``vSlide`` likewise; the load is
    ``fN = max(0, N + dynamicLoad)``.
    """

    ICON = icons.marked(icons.WHEEL, "slip")

    __modelica__ = "PlanarMechanics.VehicleComponents.Wheels"

    N = ac.Parameter(unit="N", doc="normal force without dynamicLoad")
    vAdhesion_min = ac.Parameter(unit="m/s", doc="least slip at which friction is greatest")
    vSlide_min = ac.Parameter(unit="m/s", doc="least slip from which on friction is that of sliding")  # fmt: skip
    sAdhesion = ac.Parameter(unit="1", doc="slip of greatest friction, over the rim's speed")
    sSlide = ac.Parameter(unit="1", doc="slip of sliding, over the rim's speed")
    mu_A = ac.Parameter(unit="1", doc="coefficient of friction at adhesion")
    mu_S = ac.Parameter(unit="1", doc="coefficient of friction of sliding")
    dynamicLoad = ac.Input(unit="N", doc="load in addition to N")
    fN = ac.Variable(unit="N", doc="normal force")
    vAdhesion = ac.Variable(unit="m/s", start=1.0, doc="slip at which friction is greatest")
    vSlide = ac.Variable(unit="m/s", start=2.0, doc="slip from which on friction is that of sliding")  # fmt: skip

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        rim = ac.Abs(self.radius * self.w_roll)
        yield ac.Eq(self.vAdhesion, ac.maximum(self.sAdhesion * rim, self.vAdhesion_min))
        yield ac.Eq(self.vSlide, ac.maximum(self.sSlide * rim, self.vSlide_min))
        yield ac.Eq(self.fN, ac.maximum(0, self.N + self.dynamicLoad))
        mu = striple(self.v_slip, self.vAdhesion, self.vSlide, self.mu_A, self.mu_S)
        yield ac.Eq(self.f, self.fN * mu)


class AirResistanceLongitudinal(ac.Component):
    """Air drag against driving along ``r``: ``c_W area rho/2 vAir[1]**2``; nothing where it drives backwards.

    ``vAir`` [m/s] is the speed of the air against the vehicle, along ``r`` and to its left.
    """

    __modelica__ = "PlanarMechanics.VehicleComponents"
    ICON = icons.marked(icons.DAMPER, "air")

    c_W = ac.Parameter(0.5, unit="1", min=0, doc="drag coefficient")
    area = ac.Parameter(2.0, unit="m2", min=0, doc="cross section")
    rho = ac.Parameter(1.18, unit="kg/m3", doc="density of air")
    r = ac.Parameter((1.0, 0.0), unit="m", shape=2, doc="direction of driving, resolved in frame_a")
    frame_a = Frame()
    vAir = ac.Variable(unit="m/s", shape=2, doc="speed of the air against the vehicle")
    fDrag = ac.Variable(unit="N", doc="drag at that speed")

    def equations(self) -> Iterator[ac.Eq]:
        frame = self.frame_a
        e0 = turned(frame.phi, *direction(self.r))
        v_x, v_y = -ac.der(frame.x), -ac.der(frame.y)
        yield ac.Eq(self.vAir[0], v_x * e0[0] + v_y * e0[1])
        yield ac.Eq(self.vAir[1], v_y * e0[0] - v_x * e0[1])
        size = self.c_W * self.area * self.rho / 2
        yield ac.Eq(self.fDrag, size * self.vAir[0] ** 2)
        force = size * ac.minimum(self.vAir[0], 0) ** 2
        yield ac.Eq(frame.fx, force * e0[0])
        yield ac.Eq(frame.fy, force * e0[1])
        yield ac.Eq(frame.t, 0)


class DifferentialGear(ac.Component):
    """A differential gear: ``flange_b`` drives, ``flange_left`` and ``flange_right`` share the torque."""

    __modelica__ = "PlanarMechanics.VehicleComponents"
    ICON = icons.DIFFERENTIAL

    flange_b = rotational.Flange()
    flange_left = rotational.Flange()
    flange_right = rotational.Flange()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.idealPlanetary = IdealPlanetary(ratio=-2.0)
        self.connect(self.flange_b, self.idealPlanetary.ring)
        self.connect(self.flange_right, self.idealPlanetary.carrier)
        self.connect(self.flange_left, self.idealPlanetary.sun)
