"""Planar mechanics: mechanisms, wheels and vehicles in a plane (after the Modelica library `PlanarMechanics` 1.6.0).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Literal, SupportsFloat

import acausal as ac
from acausal.components import (
    rotational as _rotational,
    thermal as _thermal,
    translational as _translational,
)
from acausal.components.planar import multibody as _planar_multibody

from . import multibody as multibody, utilities as utilities

__all__ = [
    "AbsoluteAcceleration",
    "AbsolutePosition",
    "AbsoluteVelocity",
    "AirResistanceLongitudinal",
    "Body",
    "CutForce",
    "CutForceAndTorque",
    "CutRevolute",
    "CutTorque",
    "Damper",
    "DifferentialGear",
    "Distance",
    "DryFrictionBasedRolling",
    "DryFrictionWheelJoint",
    "Fixed",
    "FixedRotation",
    "FixedTranslation",
    "Frame",
    "Frame_a",
    "Frame_b",
    "Frame_resolve",
    "IdealRolling",
    "IdealWheelJoint",
    "Offset",
    "PartialAbsolute",
    "PartialCutSensor",
    "PartialGear",
    "PartialRelative",
    "PartialResolving",
    "PartialRigidSensor",
    "PartialRolling",
    "PartialSlippingWheel",
    "PartialSpring",
    "PartialTransform",
    "PartialTwoFrames",
    "PartialTwoFramesAndHeat",
    "PartialWheel",
    "PlanarWorld",
    "PlanarWorldIn3D",
    "Power",
    "Prismatic",
    "QuadraticSpeedDependentForce",
    "RelativeAcceleration",
    "RelativeForce",
    "RelativePosition",
    "RelativeVelocity",
    "Revolute",
    "RigidNoLossExternal",
    "RigidNoLossInternal",
    "RigidNoLossPlanetary",
    "SlipBasedWheelJoint",
    "Spring",
    "SpringDamper",
    "TransformAbsoluteVector",
    "TransformRelativeVector",
    "WorldForce",
    "ZeroPosition",
    "multibody",
    "utilities",
]

class AirResistanceLongitudinal(ac.Component):
    """Air drag against driving along ``r``: ``c_W area rho/2 vAir[1]**2``; nothing where it drives backwards."""

    c_W: ClassVar[ac.Parameter]
    """drag coefficient"""
    area: ClassVar[ac.Parameter]
    """cross section [m2]"""
    rho: ClassVar[ac.Parameter]
    """density of air [kg/m3]"""
    r: ClassVar[ac.Parameter]
    """direction of driving, resolved in frame_a [m]"""
    frame_a: Frame
    vAir: ClassVar[ac.Variable]
    """speed of the air against the vehicle [m/s]"""
    fDrag: ClassVar[ac.Variable]
    """drag at that speed [N]"""
    def __init__(
        self,
        *,
        c_W: SupportsFloat | ac.Start = ...,
        area: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | Iterable[Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        vAir: ac.Start | Mapping[str, Any] = ...,
        fDrag: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Body(ac.Component):
    """A rigid body of mass ``m`` and inertia ``I`` at its centre of mass, ``frame_a``."""

    m: ClassVar[ac.Parameter]
    """mass [kg]"""
    I: ClassVar[ac.Parameter]
    """moment of inertia about the centre of mass [kg.m2]"""
    g: ClassVar[ac.Parameter]
    """acceleration of gravity of the world [m/s2]"""
    enableGravity: ClassVar[ac.Option]
    """whether gravity acts"""
    stateSelect: ClassVar[ac.Option]
    """priority of r, v, phi and w as states"""
    frame_a: Frame
    f: ClassVar[ac.Variable]
    """force at frame_a [N]"""
    r: ClassVar[ac.Variable]
    """position [m]"""
    v: ClassVar[ac.Variable]
    """speed [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration [m/s2]"""
    phi: ClassVar[ac.Variable]
    """angle [rad]"""
    w: ClassVar[ac.Variable]
    """angular speed [rad/s]"""
    z: ClassVar[ac.Variable]
    """angular acceleration [rad/s2]"""
    def __init__(
        self,
        *,
        m: SupportsFloat | ac.Start = ...,
        I: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | Iterable[Any] = ...,
        enableGravity: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        frame_a: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        r: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        z: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DifferentialGear(ac.Component):
    """A differential gear: ``flange_b`` drives, ``flange_left`` and ``flange_right`` share the torque."""

    flange_b: _rotational.Flange
    flange_left: _rotational.Flange
    flange_right: _rotational.Flange
    idealPlanetary: _rotational.IdealPlanetary
    def __init__(
        self,
        *,
        flange_b: Mapping[str, Any] = ...,
        flange_left: Mapping[str, Any] = ...,
        flange_right: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Fixed(ac.Component):
    """A frame fixed in the world, at the place ``r`` [m] and the angle ``phi`` [rad]."""

    r: ClassVar[ac.Parameter]
    """position, resolved in the world [m]"""
    phi: ClassVar[ac.Parameter]
    """angle against the world [rad]"""
    frame: Frame
    def __init__(
        self,
        *,
        r: SupportsFloat | Iterable[Any] = ...,
        phi: SupportsFloat | ac.Start = ...,
        frame: Mapping[str, Any] = ...,
    ) -> None: ...

class Frame(ac.Connector):
    """Position ``x``, ``y`` [m] and angle ``phi`` [rad] in the world; forces ``fx``, ``fy`` [N] and torque ``t`` [N.m]."""

    x: ClassVar[ac.Potential]
    """position along the world's x-axis [m]"""
    y: ClassVar[ac.Potential]
    """position along the world's y-axis [m]"""
    phi: ClassVar[ac.Potential]
    """angle against the world [rad]"""
    fx: ClassVar[ac.Flow]
    """cut force along the world's x-axis [N]"""
    fy: ClassVar[ac.Flow]
    """cut force along the world's y-axis [N]"""
    t: ClassVar[ac.Flow]
    """cut torque [N.m]"""

class PartialResolving(ac.Component):
    """Base of what resolves vectors along the axes of a chosen frame."""

    resolveInFrame: ClassVar[ac.Option]
    """frame whose axes are used"""
    frame_resolve: Frame
    def __init__(self, **modifiers: Any) -> None: ...

class PartialRolling(ac.Component):
    """A wheel of radius ``R`` whose hub is ``frame_a``, on the world's x-axis: ``frame_a.y = R``."""

    R: ClassVar[ac.Parameter]
    """radius of the wheel [m]"""
    stateSelect: ClassVar[ac.Option]
    """priority of x, phi and w as states"""
    frame_a: Frame
    x: ClassVar[ac.Variable]
    """position of the hub [m]"""
    phi: ClassVar[ac.Variable]
    """angle [rad]"""
    w: ClassVar[ac.Variable]
    """angular speed [rad/s]"""
    z: ClassVar[ac.Variable]
    """angular acceleration [rad/s2]"""
    vx: ClassVar[ac.Variable]
    """speed of the hub [m/s]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialTwoFrames(ac.Component):
    """Two frames without equations."""

    frame_a: Frame
    frame_b: Frame
    def __init__(self, **modifiers: Any) -> None: ...

class PlanarWorld(ac.Component):
    """The world of a planar model: its gravity ``g = constantGravity`` [m/s2] acts on all bodies."""

    constantGravity: ClassVar[ac.Parameter]
    """acceleration of gravity, resolved in the world [m/s2]"""
    g: ClassVar[ac.Parameter]
    """acceleration of gravity that acts, computed [m/s2]"""
    def __init__(
        self,
        *,
        g: SupportsFloat | Iterable[Any] = ...,
        constantGravity: SupportsFloat | Iterable[Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class ZeroPosition(ac.Component):
    """A frame at the origin of the world: ``frame_resolve.x = frame_resolve.y = frame_resolve.phi = 0``."""

    frame_resolve: Frame
    def __init__(self, **modifiers: Any) -> None: ...

class Distance(PartialTwoFrames):
    """The ``distance`` [m] of two frames."""

    s_small: ClassVar[ac.Parameter]
    """distance below which it is smoothed [m]"""
    distance: ClassVar[ac.Output]
    """distance of the frames [m]"""
    def __init__(
        self,
        *,
        s_small: SupportsFloat | ac.Start = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        distance: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FixedRotation(PartialTwoFrames):
    """Two frames at one place, ``frame_b`` turned by ``alpha`` [rad] against ``frame_a``."""

    alpha: ClassVar[ac.Parameter]
    """fixed angle from frame_a to frame_b [rad]"""
    def __init__(
        self,
        *,
        alpha: SupportsFloat | ac.Start = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
    ) -> None: ...

class IdealRolling(PartialRolling):
    """A wheel that rolls on the x-axis without slip: ``vx = -w R``."""
    def __init__(
        self,
        *,
        R: SupportsFloat | ac.Start = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        frame_a: Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        z: ac.Start | Mapping[str, Any] = ...,
        vx: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Offset(PartialTwoFrames):
    """Two frames of the same angle, a vector ``r0`` [m] apart that is resolved in the world; a subclass states ``r0``."""

    r0: ClassVar[ac.Variable]
    """from frame_a to frame_b, resolved in the world [m]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialAbsolute(PartialResolving):
    """Measures at ``frame_a``."""

    frame_a: Frame
    def __init__(self, **modifiers: Any) -> None: ...

class PartialRigidSensor(PartialTwoFrames):
    """Base of sensors in a rigid cut: both frames are at one place, forces and torques are in balance."""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialSpring(PartialTwoFrames):
    """Forces ``f_x``, ``f_y`` [N] over ``s_relx``, ``s_rely`` [m], resolved in the world; a subclass states them."""

    c_x: ClassVar[ac.Parameter]
    """stiffness along the world's x-axis [N/m]"""
    c_y: ClassVar[ac.Parameter]
    """stiffness along the world's y-axis [N/m]"""
    c_phi: ClassVar[ac.Parameter]
    """stiffness against rotation [N.m/rad]"""
    s_relx0: ClassVar[ac.Parameter]
    """unstretched length along x [m]"""
    s_rely0: ClassVar[ac.Parameter]
    """unstretched length along y [m]"""
    phi_rel0: ClassVar[ac.Parameter]
    """unstretched angle [rad]"""
    stateSelect: ClassVar[ac.Option]
    """priority of the lengths as states"""
    s_relx: ClassVar[ac.Variable]
    """length along x [m]"""
    s_rely: ClassVar[ac.Variable]
    """length along y [m]"""
    phi_rel: ClassVar[ac.Variable]
    """angle from frame_a to frame_b [rad]"""
    f_x: ClassVar[ac.Variable]
    """force along x, = frame_b.fx [N]"""
    f_y: ClassVar[ac.Variable]
    """force along y, = frame_b.fy [N]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialTransform(PartialResolving):
    """Resolves a vector ``r_in`` along other axes: from those of ``frame_r_in`` to those of ``frame_r_out``."""

    frame_r_in: ClassVar[ac.Option]
    """frame whose axes r_in has"""
    frame_r_out: ClassVar[ac.Option]
    """frame whose axes r_out has"""
    r_in: ClassVar[ac.Input]
    """vector"""
    r_out: ClassVar[ac.Output]
    """the same vector along other axes"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialWheel(_thermal.PartialElementaryConditionalHeatPortWithoutT):
    """A wheel of a ``radius`` that rolls along ``r`` on the plane; ``flange_a`` drives it."""

    radius: ClassVar[ac.Parameter]
    """radius of the wheel [m]"""
    r: ClassVar[ac.Parameter]
    """direction of driving, resolved in frame_a [m]"""
    stateSelect: ClassVar[ac.Option]
    """priority of w_roll as a state"""
    frame_a: Frame
    flange_a: _rotational.Flange
    e0: ClassVar[ac.Variable]
    """direction of driving, resolved in the world"""
    phi_roll: ClassVar[ac.Variable]
    """angle of the wheel [rad]"""
    w_roll: ClassVar[ac.Variable]
    """angular speed of the wheel [rad/s]"""
    v: ClassVar[ac.Variable]
    """speed, resolved in the world [m/s]"""
    v_long: ClassVar[ac.Variable]
    """speed along the direction of driving [m/s]"""
    f_long: ClassVar[ac.Variable]
    """force along the direction of driving, at frame_a [N]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PlanarWorldIn3D(PlanarWorld):
    """A planar world that lies in a spatial one, at ``MBFrame_a`` with ``connectToMultiBody``."""

    inheritGravityFromMultiBody: ClassVar[ac.Option]
    """whether gravity is that of the spatial world"""
    connectToMultiBody: ClassVar[ac.Option]
    """whether there is a spatial frame"""
    gravity: ClassVar[ac.Parameter]
    """acceleration of gravity of the spatial world [m/s2]"""
    MBFrame_a: _planar_multibody.Frame
    def __init__(
        self,
        *,
        g: SupportsFloat | Iterable[Any] = ...,
        constantGravity: SupportsFloat | Iterable[Any] = ...,
        gravity: SupportsFloat | Iterable[Any] = ...,
        inheritGravityFromMultiBody: bool = ...,
        connectToMultiBody: bool = ...,
        MBFrame_a: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class QuadraticSpeedDependentForce(PartialResolving):
    """A force along each axis that grows with the square of the speed along it, and a torque likewise."""

    resolveInFrame: ClassVar[ac.Option]
    """frame whose axes are used"""
    F_nominal: ClassVar[ac.Parameter]
    """force at the nominal speed [N]"""
    v_nominal: ClassVar[ac.Parameter]
    """nominal speed [m/s]"""
    tau_nominal: ClassVar[ac.Parameter]
    """torque at the nominal angular speed [N.m]"""
    w_nominal: ClassVar[ac.Parameter]
    """nominal angular speed [rad/s]"""
    frame_b: Frame
    force: ClassVar[ac.Variable]
    """force along x and y, and torque"""
    def __init__(
        self,
        *,
        F_nominal: SupportsFloat | ac.Start = ...,
        v_nominal: SupportsFloat | ac.Start = ...,
        tau_nominal: SupportsFloat | ac.Start = ...,
        w_nominal: SupportsFloat | ac.Start = ...,
        resolveInFrame: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        force: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Revolute(PartialTwoFrames):
    """A hinge without friction: ``frame_b`` is turned by ``phi`` [rad] against ``frame_a``."""

    useFlange: ClassVar[ac.Option]
    """whether a flange drives the joint"""
    stateSelect: ClassVar[ac.Option]
    """priority of phi and w as states"""
    flange_a: _rotational.Flange
    support: _rotational.Flange
    phi: ClassVar[ac.Variable]
    """angle from frame_a to frame_b [rad]"""
    w: ClassVar[ac.Variable]
    """angular speed [rad/s]"""
    z: ClassVar[ac.Variable]
    """angular acceleration [rad/s2]"""
    t: ClassVar[ac.Variable]
    """driving torque, = frame_a.t [N.m]"""
    def __init__(
        self,
        *,
        useFlange: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        z: ac.Start | Mapping[str, Any] = ...,
        t: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RigidNoLossPlanetary(_thermal.PartialConditionalHeatPort):
    """A planetary gear of a sun, a planet, a carrier and a ring, each with its inertia."""

    r_s: ClassVar[ac.Parameter]
    """radius of the sun [m]"""
    r_p: ClassVar[ac.Parameter]
    """radius of the planet [m]"""
    r_r: ClassVar[ac.Parameter]
    """radius of the ring [m]"""
    J_s: ClassVar[ac.Parameter]
    """inertia of the sun [kg.m2]"""
    J_p: ClassVar[ac.Parameter]
    """not used, as in Modelica's library [kg.m2]"""
    J_c: ClassVar[ac.Parameter]
    """inertia of the carrier [kg.m2]"""
    J_r: ClassVar[ac.Parameter]
    """inertia of the ring [kg.m2]"""
    connectToMultiBody: ClassVar[ac.Option]
    """whether there is a spatial frame"""
    flange_Sun: _rotational.Flange
    flange_Carrier: _rotational.Flange
    flange_Ring: _rotational.Flange
    frameVisualisation: _planar_multibody.Frame
    fixedTemperature: _thermal.FixedTemperature
    planarWorld: PlanarWorldIn3D
    sun: _rotational.Inertia
    ring: _rotational.Inertia
    carrier: _rotational.Inertia
    planet: Body
    bearing_Sun: Revolute
    bearing_Ring: Revolute
    bearing_Carrier: Revolute
    bearing_Planet: Revolute
    sunPlanet: RigidNoLossExternal
    planetRing: RigidNoLossInternal
    carrierAngle: FixedRotation
    carrierPart: FixedTranslation
    fixed: Fixed
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        r_s: SupportsFloat | ac.Start = ...,
        r_p: SupportsFloat | ac.Start = ...,
        r_r: SupportsFloat | ac.Start = ...,
        J_s: SupportsFloat | ac.Start = ...,
        J_p: SupportsFloat | ac.Start = ...,
        J_c: SupportsFloat | ac.Start = ...,
        J_r: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        connectToMultiBody: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        internalHeatPort: Mapping[str, Any] = ...,
        flange_Sun: Mapping[str, Any] = ...,
        flange_Carrier: Mapping[str, Any] = ...,
        flange_Ring: Mapping[str, Any] = ...,
        frameVisualisation: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class WorldForce(PartialResolving):
    """A force and a torque ``force`` [N, N, N.m] on what is connected to ``frame_b``."""

    resolveInFrame: ClassVar[ac.Option]
    """frame whose axes are used"""
    frame_b: Frame
    force: ClassVar[ac.Input]
    """force along x and y, and torque"""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_b", "frame_resolve"] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        force: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class AbsoluteAcceleration(PartialAbsolute):
    """Acceleration ``a`` [m/s2, m/s2, rad/s2] of ``frame_a`` in the world, along the axes of the chosen frame."""

    v_0: ClassVar[ac.Variable]
    """speed and angular speed, resolved in the world"""
    a: ClassVar[ac.Output]
    """acceleration and angular acceleration"""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        v_0: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class AbsolutePosition(PartialAbsolute):
    """Position and angle ``r`` [m, m, rad] of ``frame_a``; the angle counts from the frame whose axes are used."""

    r: ClassVar[ac.Output]
    """position and angle"""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        r: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class AbsoluteVelocity(PartialAbsolute):
    """Speed ``v`` [m/s, m/s, rad/s] of ``frame_a`` in the world, along the axes of the chosen frame."""

    v: ClassVar[ac.Output]
    """speed and angular speed"""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CutRevolute(Revolute):
    """A hinge that closes a loop, whose other joints all keep their states: nothing is solved by Newton's method."""

    stateSelect: ClassVar[ac.Option]
    """priority of phi and w as states"""
    T: ClassVar[ac.Parameter]
    """time in which a gap closes [s]"""
    gap: ClassVar[ac.Variable]
    """from frame_a to frame_b [m]"""
    rate: ClassVar[ac.Variable]
    """speed of the gap [m/s]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        useFlange: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        z: ac.Start | Mapping[str, Any] = ...,
        t: ac.Start | Mapping[str, Any] = ...,
        gap: ac.Start | Mapping[str, Any] = ...,
        rate: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FixedTranslation(Offset):
    """A rigid rod without mass: ``frame_b`` is ``r`` [m] away from ``frame_a``, at the same angle."""

    r: ClassVar[ac.Parameter]
    """from frame_a to frame_b, resolved in frame_a [m]"""
    def __init__(
        self,
        *,
        r: SupportsFloat | Iterable[Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        r0: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealWheelJoint(PartialWheel):
    """A wheel that rolls without slip, and does not move sideways: ``v = v_long e0``, ``v_long = radius w_roll``."""

    stateSelect: ClassVar[ac.Option]
    """priority of the speeds as states"""
    v_long: ClassVar[ac.Variable]
    """speed along the direction of driving [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration along the direction of driving [m/s2]"""
    def __init__(
        self,
        *,
        radius: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | Iterable[Any] = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        e0: ac.Start | Mapping[str, Any] = ...,
        phi_roll: ac.Start | Mapping[str, Any] = ...,
        w_roll: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        v_long: ac.Start | Mapping[str, Any] = ...,
        f_long: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialCutSensor(PartialRigidSensor):
    """Base of sensors of what goes through a cut; ``positiveSign`` means as it acts at ``frame_a``."""

    positiveSign: ClassVar[ac.Option]
    """whether forces and torques are those at frame_a"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialRelative(PartialResolving, PartialTwoFrames):
    """Measures ``frame_b`` against ``frame_a``."""

    resolveInFrame: ClassVar[ac.Option]
    """frame whose axes are used"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialSlippingWheel(PartialWheel):
    """A wheel that slips: its force is against the speed of the contact, ``v_slip_long``, ``v_slip_lat`` [m/s]."""

    v_lat: ClassVar[ac.Variable]
    """speed to the left of the direction of driving [m/s]"""
    v_slip_long: ClassVar[ac.Variable]
    """speed of the contact, along [m/s]"""
    v_slip_lat: ClassVar[ac.Variable]
    """speed of the contact, sideways [m/s]"""
    v_slip: ClassVar[ac.Variable]
    """size of the contact's speed [m/s]"""
    f: ClassVar[ac.Variable]
    """force against the slip [N]"""
    f_lat: ClassVar[ac.Variable]
    """force to the left, at frame_a [N]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialTwoFramesAndHeat(
    PartialTwoFrames, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Two frames and, with ``useHeatPort``, a heat port; a subclass states ``lossPower``."""
    def __init__(self, **modifiers: Any) -> None: ...

class Power(PartialRigidSensor):
    """Power [W] that enters at ``frame_a`` and leaves at ``frame_b``."""

    power: ClassVar[ac.Output]
    """power into frame_a [W]"""
    def __init__(
        self,
        *,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        power: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Prismatic(Offset):
    """A joint along ``r``, without friction: ``frame_b`` is ``s`` [m] away from ``frame_a``, at the same angle."""

    useFlange: ClassVar[ac.Option]
    """whether a flange drives the joint"""
    stateSelect: ClassVar[ac.Option]
    """priority of s and v as states"""
    r: ClassVar[ac.Parameter]
    """direction, resolved in frame_a [m]"""
    flange_a: _translational.Flange
    support: _translational.Flange
    s: ClassVar[ac.Variable]
    """elongation [m]"""
    v: ClassVar[ac.Variable]
    """speed of elongation [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of elongation [m/s2]"""
    f: ClassVar[ac.Variable]
    """force in the direction of elongation [N]"""
    e0: ClassVar[ac.Variable]
    """unit vector along the joint, resolved in the world"""
    def __init__(
        self,
        *,
        r: SupportsFloat | Iterable[Any] = ...,
        useFlange: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        r0: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        e0: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelativeForce(PartialResolving, PartialTwoFrames):
    """A force and a torque ``force`` [N, N, N.m] on what is connected to ``frame_b``, and against ``frame_a``."""

    resolveInFrame: ClassVar[ac.Option]
    """frame whose axes are used"""
    force: ClassVar[ac.Input]
    """force along x and y, and torque"""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_b", "frame_resolve"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        force: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Spring(PartialSpring):
    """A linear spring along both axes of the world: ``f_x = c_x (s_relx - s_relx0)``, and likewise along y."""
    def __init__(
        self,
        *,
        c_x: SupportsFloat | ac.Start = ...,
        c_y: SupportsFloat | ac.Start = ...,
        c_phi: SupportsFloat | ac.Start = ...,
        s_relx0: SupportsFloat | ac.Start = ...,
        s_rely0: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        s_relx: ac.Start | Mapping[str, Any] = ...,
        s_rely: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        f_x: ac.Start | Mapping[str, Any] = ...,
        f_y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TransformAbsoluteVector(PartialTransform):
    """Resolves a vector along other axes."""

    frame_r_in: ClassVar[ac.Option]
    """frame whose axes r_in has"""
    frame_r_out: ClassVar[ac.Option]
    """frame whose axes r_out has"""
    frame_a: Frame
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_r_in: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_r_out: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        r_in: ac.Start | Mapping[str, Any] = ...,
        r_out: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CutTorque(PartialCutSensor):
    """The cut ``torque`` [N.m]."""

    torque: ClassVar[ac.Output]
    """cut torque [N.m]"""
    def __init__(
        self,
        *,
        positiveSign: bool = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        torque: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Damper(PartialTwoFrames, _thermal.PartialElementaryConditionalHeatPort):
    """A damper along the line between its frames: ``f = -d v`` with ``v = der(length)``."""

    d: ClassVar[ac.Parameter]
    """damping constant [N.s/m]"""
    s_small: ClassVar[ac.Parameter]
    """least distance of the frames [m]"""
    stateSelect: ClassVar[ac.Option]
    """priority of r0 as states"""
    r0: ClassVar[ac.Variable]
    """from frame_a to frame_b [m]"""
    d0: ClassVar[ac.Variable]
    """direction from frame_a to frame_b"""
    length: ClassVar[ac.Variable]
    """distance of the frames [m]"""
    vx: ClassVar[ac.Variable]
    """relative speed along x [m/s]"""
    vy: ClassVar[ac.Variable]
    """relative speed along y [m/s]"""
    v: ClassVar[ac.Variable]
    """speed at which the frames part [m/s]"""
    f: ClassVar[ac.Variable]
    """force along d0 at frame_a [N]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        s_small: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        TheatPort: ac.Start | Mapping[str, Any] = ...,
        r0: ac.Start | Mapping[str, Any] = ...,
        d0: ac.Start | Mapping[str, Any] = ...,
        length: ac.Start | Mapping[str, Any] = ...,
        vx: ac.Start | Mapping[str, Any] = ...,
        vy: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DryFrictionBasedRolling(PartialRolling, _thermal.PartialElementaryConditionalHeatPort):
    """A wheel that slips on the x-axis: ``frame_a.fx = N mu(v_slip)``, ``v_slip = vx + w R``, ``N = -frame_a.fy``."""

    vx: ClassVar[ac.Variable]
    """speed of the hub [m/s]"""
    vAdhesion: ClassVar[ac.Parameter]
    """slip at which friction is greatest [m/s]"""
    vSlide: ClassVar[ac.Parameter]
    """slip from which on friction is that of sliding [m/s]"""
    mu_A: ClassVar[ac.Parameter]
    """coefficient of friction at adhesion"""
    mu_S: ClassVar[ac.Parameter]
    """coefficient of friction of sliding"""
    N: ClassVar[ac.Variable]
    """normal force [N]"""
    v_slip: ClassVar[ac.Variable]
    """speed of the contact [m/s]"""
    def __init__(
        self,
        *,
        vAdhesion: SupportsFloat | ac.Start = ...,
        vSlide: SupportsFloat | ac.Start = ...,
        mu_A: SupportsFloat | ac.Start = ...,
        mu_S: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        R: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        TheatPort: ac.Start | Mapping[str, Any] = ...,
        x: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        z: ac.Start | Mapping[str, Any] = ...,
        vx: ac.Start | Mapping[str, Any] = ...,
        N: ac.Start | Mapping[str, Any] = ...,
        v_slip: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DryFrictionWheelJoint(PartialSlippingWheel):
    """A wheel with dry friction: ``f = N mu(v_slip)``."""

    N: ClassVar[ac.Parameter]
    """normal force [N]"""
    vAdhesion: ClassVar[ac.Parameter]
    """slip at which friction is greatest [m/s]"""
    vSlide: ClassVar[ac.Parameter]
    """slip from which on friction is that of sliding [m/s]"""
    mu_A: ClassVar[ac.Parameter]
    """coefficient of friction at adhesion"""
    mu_S: ClassVar[ac.Parameter]
    """coefficient of friction of sliding"""
    def __init__(
        self,
        *,
        radius: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | Iterable[Any] = ...,
        N: SupportsFloat | ac.Start = ...,
        vAdhesion: SupportsFloat | ac.Start = ...,
        vSlide: SupportsFloat | ac.Start = ...,
        mu_A: SupportsFloat | ac.Start = ...,
        mu_S: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        e0: ac.Start | Mapping[str, Any] = ...,
        phi_roll: ac.Start | Mapping[str, Any] = ...,
        w_roll: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        v_long: ac.Start | Mapping[str, Any] = ...,
        f_long: ac.Start | Mapping[str, Any] = ...,
        v_lat: ac.Start | Mapping[str, Any] = ...,
        v_slip_long: ac.Start | Mapping[str, Any] = ...,
        v_slip_lat: ac.Start | Mapping[str, Any] = ...,
        v_slip: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        f_lat: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialGear(PartialTwoFramesAndHeat):
    """Two gear wheels of radii ``r_a`` and ``r_b`` that mesh without loss, with the force ``F_n`` [N]."""

    r_a: ClassVar[ac.Parameter]
    """radius of gear A [m]"""
    r_b: ClassVar[ac.Parameter]
    """radius of gear B [m]"""
    w_a: ClassVar[ac.Variable]
    """angular speed of gear A [rad/s]"""
    w_b: ClassVar[ac.Variable]
    """angular speed of gear B [rad/s]"""
    w_gear: ClassVar[ac.Variable]
    """angular speed of the line between the axes [rad/s]"""
    F_n: ClassVar[ac.Variable]
    """force in the mesh [N]"""
    v_mesh: ClassVar[ac.Variable]
    """speed in the mesh [m/s]"""
    a_mesh: ClassVar[ac.Variable]
    """acceleration in the mesh [m/s2]"""
    xmesh_a: ClassVar[ac.Variable]
    """way of gear A in the mesh [m]"""
    xmesh_b: ClassVar[ac.Variable]
    """way of gear B in the mesh [m]"""
    phi_gear: ClassVar[ac.Variable]
    """angle of the line between the axes [rad]"""
    def __init__(self, **modifiers: Any) -> None: ...

class RelativePosition(PartialRelative):
    """Position and angle ``r_rel`` [m, m, rad] of ``frame_b`` against ``frame_a``."""

    r_rel: ClassVar[ac.Output]
    """position and angle"""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_b", "frame_resolve"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        r_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelativeVelocity(PartialRelative):
    """Speed ``v_rel`` [m/s, m/s, rad/s] of ``frame_b`` as seen from ``frame_a``, along the axes of the chosen frame."""

    r_a: ClassVar[ac.Variable]
    """position and angle, resolved in frame_a"""
    v_rel: ClassVar[ac.Output]
    """speed and angular speed"""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_b", "frame_resolve"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
        r_a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SlipBasedWheelJoint(PartialSlippingWheel):
    """A wheel whose friction depends on the slip against the speed of its rim: ``f = fN mu(v_slip)``."""

    N: ClassVar[ac.Parameter]
    """normal force without dynamicLoad [N]"""
    vAdhesion_min: ClassVar[ac.Parameter]
    """least slip at which friction is greatest [m/s]"""
    vSlide_min: ClassVar[ac.Parameter]
    """least slip from which on friction is that of sliding [m/s]"""
    sAdhesion: ClassVar[ac.Parameter]
    """slip of greatest friction, over the rim's speed"""
    sSlide: ClassVar[ac.Parameter]
    """slip of sliding, over the rim's speed"""
    mu_A: ClassVar[ac.Parameter]
    """coefficient of friction at adhesion"""
    mu_S: ClassVar[ac.Parameter]
    """coefficient of friction of sliding"""
    dynamicLoad: ClassVar[ac.Input]
    """load in addition to N [N]"""
    fN: ClassVar[ac.Variable]
    """normal force [N]"""
    vAdhesion: ClassVar[ac.Variable]
    """slip at which friction is greatest [m/s]"""
    vSlide: ClassVar[ac.Variable]
    """slip from which on friction is that of sliding [m/s]"""
    def __init__(
        self,
        *,
        radius: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | Iterable[Any] = ...,
        N: SupportsFloat | ac.Start = ...,
        vAdhesion_min: SupportsFloat | ac.Start = ...,
        vSlide_min: SupportsFloat | ac.Start = ...,
        sAdhesion: SupportsFloat | ac.Start = ...,
        sSlide: SupportsFloat | ac.Start = ...,
        mu_A: SupportsFloat | ac.Start = ...,
        mu_S: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        dynamicLoad: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        e0: ac.Start | Mapping[str, Any] = ...,
        phi_roll: ac.Start | Mapping[str, Any] = ...,
        w_roll: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        v_long: ac.Start | Mapping[str, Any] = ...,
        f_long: ac.Start | Mapping[str, Any] = ...,
        v_lat: ac.Start | Mapping[str, Any] = ...,
        v_slip_long: ac.Start | Mapping[str, Any] = ...,
        v_slip_lat: ac.Start | Mapping[str, Any] = ...,
        v_slip: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        f_lat: ac.Start | Mapping[str, Any] = ...,
        fN: ac.Start | Mapping[str, Any] = ...,
        vAdhesion: ac.Start | Mapping[str, Any] = ...,
        vSlide: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TransformRelativeVector(PartialTransform, PartialTwoFrames):
    """Resolves a vector along other axes; the third element stays."""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_r_in: Literal["world", "frame_a", "frame_b", "frame_resolve"] = ...,
        frame_r_out: Literal["world", "frame_a", "frame_b", "frame_resolve"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        r_in: ac.Start | Mapping[str, Any] = ...,
        r_out: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CutForce(PartialResolving, PartialCutSensor):
    """The cut ``force`` [N], along the axes of the chosen frame."""

    force: ClassVar[ac.Output]
    """cut force [N]"""
    def __init__(
        self,
        *,
        positiveSign: bool = ...,
        resolveInFrame: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        force: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelativeAcceleration(RelativeVelocity):
    """The derivative ``a_rel`` [m/s2, m/s2, rad/s2] of the speed that `RelativeVelocity` measures."""

    v_rel: ClassVar[ac.Variable]
    """speed and angular speed"""
    a_rel: ClassVar[ac.Output]
    """acceleration and angular acceleration"""
    def __init__(
        self,
        *,
        resolveInFrame: Literal["world", "frame_a", "frame_b", "frame_resolve"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
        r_a: ac.Start | Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RigidNoLossExternal(PartialGear):
    """Two gear wheels side by side: they turn in opposite directions."""
    def __init__(
        self,
        *,
        r_a: SupportsFloat | ac.Start = ...,
        r_b: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        w_a: ac.Start | Mapping[str, Any] = ...,
        w_b: ac.Start | Mapping[str, Any] = ...,
        w_gear: ac.Start | Mapping[str, Any] = ...,
        F_n: ac.Start | Mapping[str, Any] = ...,
        v_mesh: ac.Start | Mapping[str, Any] = ...,
        a_mesh: ac.Start | Mapping[str, Any] = ...,
        xmesh_a: ac.Start | Mapping[str, Any] = ...,
        xmesh_b: ac.Start | Mapping[str, Any] = ...,
        phi_gear: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RigidNoLossInternal(PartialGear):
    """Gear A within the ring gear B: they turn in the same direction."""
    def __init__(
        self,
        *,
        r_a: SupportsFloat | ac.Start = ...,
        r_b: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        w_a: ac.Start | Mapping[str, Any] = ...,
        w_b: ac.Start | Mapping[str, Any] = ...,
        w_gear: ac.Start | Mapping[str, Any] = ...,
        F_n: ac.Start | Mapping[str, Any] = ...,
        v_mesh: ac.Start | Mapping[str, Any] = ...,
        a_mesh: ac.Start | Mapping[str, Any] = ...,
        xmesh_a: ac.Start | Mapping[str, Any] = ...,
        xmesh_b: ac.Start | Mapping[str, Any] = ...,
        phi_gear: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SpringDamper(PartialSpring, _thermal.PartialElementaryConditionalHeatPort):
    """A linear spring and damper along both axes of the world, and against rotation."""

    d_x: ClassVar[ac.Parameter]
    """damping along the world's x-axis [N.s/m]"""
    d_y: ClassVar[ac.Parameter]
    """damping along the world's y-axis [N.s/m]"""
    d_phi: ClassVar[ac.Parameter]
    """damping against rotation [N.m.s/rad]"""
    v_relx: ClassVar[ac.Variable]
    """relative speed along x [m/s]"""
    v_rely: ClassVar[ac.Variable]
    """relative speed along y [m/s]"""
    w_rel: ClassVar[ac.Variable]
    """relative angular speed [rad/s]"""
    tau: ClassVar[ac.Variable]
    """torque, = frame_b.t [N.m]"""
    def __init__(
        self,
        *,
        c_x: SupportsFloat | ac.Start = ...,
        c_y: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        c_phi: SupportsFloat | ac.Start = ...,
        s_relx0: SupportsFloat | ac.Start = ...,
        s_rely0: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        d_x: SupportsFloat | ac.Start = ...,
        d_y: SupportsFloat | ac.Start = ...,
        d_phi: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        TheatPort: ac.Start | Mapping[str, Any] = ...,
        s_relx: ac.Start | Mapping[str, Any] = ...,
        s_rely: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        f_x: ac.Start | Mapping[str, Any] = ...,
        f_y: ac.Start | Mapping[str, Any] = ...,
        v_relx: ac.Start | Mapping[str, Any] = ...,
        v_rely: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CutForceAndTorque(CutForce, CutTorque):
    """The cut ``force`` [N], along the axes of the chosen frame, and the cut ``torque`` [N.m]."""
    def __init__(
        self,
        *,
        positiveSign: bool = ...,
        resolveInFrame: Literal["world", "frame_a", "frame_resolve"] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        frame_resolve: Mapping[str, Any] = ...,
        torque: ac.Start | Mapping[str, Any] = ...,
        force: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

Frame_a = Frame
Frame_b = Frame
Frame_resolve = Frame
