"""Parts of the examples (`Modelica.Mechanics.Rotational.Examples.Utilities`): elements with signals for flanges.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import rotational as _rotational

__all__ = [
    "DirectInertia",
    "InverseInertia",
    "Spring",
    "SpringDamper",
    "SpringDamperNoRelativeStates",
]

class DirectInertia(ac.Component):
    """An inertia driven by ``tauDrive`` that gives its motion and takes the torque ``tau`` of what it drives."""

    J: ClassVar[ac.Parameter]
    """moment of inertia [kg.m2]"""
    tauDrive: ClassVar[ac.Input]
    """driving torque [N.m]"""
    tau: ClassVar[ac.Input]
    """torque that the inertia gives on [N.m]"""
    phi: ClassVar[ac.Output]
    """angle [rad]"""
    w: ClassVar[ac.Output]
    """speed [rad/s]"""
    a: ClassVar[ac.Output]
    """acceleration [rad/s2]"""
    inertia: _rotational.Inertia
    torqueSource: _rotational.Torque
    torqueToAngle: _rotational.GeneralTorqueToAngleAdaptor
    def __init__(
        self,
        *,
        J: SupportsFloat | ac.Start = ...,
        tauDrive: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class InverseInertia(ac.Component):
    """An inertia moved as the signals say, and the torque ``tau`` that this takes."""

    J: ClassVar[ac.Parameter]
    """moment of inertia [kg.m2]"""
    phi: ClassVar[ac.Input]
    """angle [rad]"""
    w: ClassVar[ac.Input]
    """speed, consistent with phi [rad/s]"""
    a: ClassVar[ac.Input]
    """acceleration, consistent with w [rad/s2]"""
    tau: ClassVar[ac.Output]
    """torque that drives the inertia [N.m]"""
    inertia: _rotational.Inertia
    angleToTorque: _rotational.GeneralAngleToTorqueAdaptor
    def __init__(
        self,
        *,
        J: SupportsFloat | ac.Start = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Spring(ac.Component):
    """A spring between two angles, and the torques that these take."""

    c: ClassVar[ac.Parameter]
    """spring constant [N.m/rad]"""
    phi_rel0: ClassVar[ac.Parameter]
    """unstretched angle [rad]"""
    phi1: ClassVar[ac.Input]
    """angle of the left end [rad]"""
    tau1: ClassVar[ac.Output]
    """torque at the left end [N.m]"""
    phi2: ClassVar[ac.Input]
    """angle of the right end [rad]"""
    tau2: ClassVar[ac.Output]
    """torque at the right end [N.m]"""
    spring: _rotational.Spring
    angleToTorque1: _rotational.GeneralAngleToTorqueAdaptor
    angleToTorque2: _rotational.GeneralAngleToTorqueAdaptor
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        phi1: ac.Start | Mapping[str, Any] = ...,
        phi2: ac.Start | Mapping[str, Any] = ...,
        tau1: ac.Start | Mapping[str, Any] = ...,
        tau2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SpringDamper(ac.Component):
    """Spring and damper between two motions, and the torques that these take."""

    c: ClassVar[ac.Parameter]
    """spring constant [N.m/rad]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.m.s/rad]"""
    phi_rel0: ClassVar[ac.Parameter]
    """unstretched angle [rad]"""
    phi1: ClassVar[ac.Input]
    """angle of the left end [rad]"""
    w1: ClassVar[ac.Input]
    """speed of the left end [rad/s]"""
    tau1: ClassVar[ac.Output]
    """torque at the left end [N.m]"""
    phi2: ClassVar[ac.Input]
    """angle of the right end [rad]"""
    w2: ClassVar[ac.Input]
    """speed of the right end [rad/s]"""
    tau2: ClassVar[ac.Output]
    """torque at the right end [N.m]"""
    springDamper: SpringDamperNoRelativeStates
    angleToTorque1: _rotational.GeneralAngleToTorqueAdaptor
    angleToTorque2: _rotational.GeneralAngleToTorqueAdaptor
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        phi1: ac.Start | Mapping[str, Any] = ...,
        w1: ac.Start | Mapping[str, Any] = ...,
        phi2: ac.Start | Mapping[str, Any] = ...,
        w2: ac.Start | Mapping[str, Any] = ...,
        tau1: ac.Start | Mapping[str, Any] = ...,
        tau2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SpringDamperNoRelativeStates(_rotational.PartialCompliant):
    """Spring and damper side by side, without states of their own: ``tau = c (phi_rel - phi_rel0) + d w_rel``."""

    c: ClassVar[ac.Parameter]
    """spring constant [N.m/rad]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.m.s/rad]"""
    phi_rel0: ClassVar[ac.Parameter]
    """unstretched angle [rad]"""
    w_rel: ClassVar[ac.Variable]
    """relative speed [rad/s]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
