"""One-dimensional rotational mechanics (`Modelica.Mechanics.Rotational`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Literal, SupportsFloat

import acausal as ac
from acausal.components import thermal as _thermal
from acausal.components.mechanics.rolling import (
    IdealGearR2T as IdealGearR2T,
    IdealRollingWheel as IdealRollingWheel,
    PartialElementaryRotationalToTranslational as PartialElementaryRotationalToTranslational,
)
from acausal.components.mechanics.rotational import (
    Flange as Flange,
    Flange as Flange_a,
    Flange as Flange_b,
    Flange as Support,
)

from . import utilities as utilities

__all__ = [
    "AccSensor",
    "Accelerate",
    "AngleSensor",
    "AngleToTorqueAdaptor",
    "BearingFriction",
    "Brake",
    "Clutch",
    "ConstantSpeed",
    "ConstantTorque",
    "Coupling",
    "Damper",
    "Disc",
    "EddyCurrentTorque",
    "ElastoBacklash",
    "ElastoBacklash2",
    "Fixed",
    "Flange",
    "Flange_a",
    "Flange_b",
    "Gearbox",
    "GeneralAngleToTorqueAdaptor",
    "GeneralTorqueToAngleAdaptor",
    "IdealGear",
    "IdealGearR2T",
    "IdealPlanetary",
    "IdealRollingWheel",
    "Inertia",
    "InitializeFlange",
    "InverseSpeedDependentTorque",
    "LinearSpeedDependentTorque",
    "LossyGear",
    "Move",
    "MultiSensor",
    "OneWayClutch",
    "PartialAbsoluteSensor",
    "PartialBearingFriction",
    "PartialCompliant",
    "PartialCompliantWithRelativeStates",
    "PartialElementaryOneFlangeAndSupport2",
    "PartialElementaryRotationalToTranslational",
    "PartialElementaryTwoFlangesAndSupport2",
    "PartialFriction",
    "PartialOneFlangeAndSupport",
    "PartialRelativeSensor",
    "PartialTorque",
    "PartialTwoFlanges",
    "PartialTwoFlangesAndSupport",
    "Position",
    "PowerSensor",
    "QuadraticSpeedDependentTorque",
    "RelAccSensor",
    "RelAngleSensor",
    "RelSpeedSensor",
    "RelativeStates",
    "SignTorque",
    "Speed",
    "SpeedSensor",
    "Spring",
    "SpringDamper",
    "Support",
    "Torque",
    "Torque2",
    "TorqueSensor",
    "TorqueStep",
    "TorqueToAngleAdaptor",
    "utilities",
]

class AngleToTorqueAdaptor(ac.Component):
    """A flange as signals, motion in, torque out: ``flange.phi = phi``, ``tau = -flange.tau``."""

    use_w: ClassVar[ac.Option]
    """whether the speed is an input"""
    use_a: ClassVar[ac.Option]
    """whether the acceleration is an input"""
    flange: Flange
    phi: ClassVar[ac.Input]
    """angle of the flange [rad]"""
    w: ClassVar[ac.Input]
    """speed of the flange, consistent with phi [rad/s]"""
    a: ClassVar[ac.Input]
    """acceleration of the flange, consistent with w [rad/s2]"""
    tau: ClassVar[ac.Output]
    """torque that drives what is connected, = -flange.tau [N.m]"""
    def __init__(
        self,
        *,
        use_w: bool = ...,
        use_a: bool = ...,
        flange: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Fixed(ac.Component):
    """A flange fixed in the housing: ``flange.phi = phi0`` [rad]."""

    phi0: ClassVar[ac.Parameter]
    """fixed angle [rad]"""
    flange: Flange
    def __init__(
        self, *, phi0: SupportsFloat | ac.Start = ..., flange: Mapping[str, Any] = ...
    ) -> None: ...

class GeneralAngleToTorqueAdaptor(ac.Component):
    """A flange as signals, motion in, torque out: ``flange.phi = p``, ``f = -flange.tau``."""

    use_pder: ClassVar[ac.Option]
    """whether the speed is an input"""
    use_pder2: ClassVar[ac.Option]
    """whether the acceleration is an input (needs use_pder)"""
    flange: Flange
    p: ClassVar[ac.Input]
    """angle [rad]"""
    pder: ClassVar[ac.Input]
    """speed, consistent with p [rad/s]"""
    pder2: ClassVar[ac.Input]
    """acceleration, consistent with pder [rad/s2]"""
    f: ClassVar[ac.Output]
    """torque that drives what is connected, = -flange.tau [N.m]"""
    def __init__(
        self,
        *,
        use_pder: bool = ...,
        use_pder2: bool = ...,
        flange: Mapping[str, Any] = ...,
        p: ac.Start | Mapping[str, Any] = ...,
        pder: ac.Start | Mapping[str, Any] = ...,
        pder2: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GeneralTorqueToAngleAdaptor(ac.Component):
    """A flange as signals, torque in, motion out: ``flange.tau = f``, ``p = flange.phi``."""

    use_pder: ClassVar[ac.Option]
    """whether the speed is an output"""
    use_pder2: ClassVar[ac.Option]
    """whether the acceleration is an output (needs use_pder)"""
    flange: Flange
    f: ClassVar[ac.Input]
    """torque into the flange [N.m]"""
    p: ClassVar[ac.Output]
    """angle [rad]"""
    pder: ClassVar[ac.Output]
    """speed [rad/s]"""
    pder2: ClassVar[ac.Output]
    """acceleration [rad/s2]"""
    def __init__(
        self,
        *,
        use_pder: bool = ...,
        use_pder2: bool = ...,
        flange: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        p: ac.Start | Mapping[str, Any] = ...,
        pder: ac.Start | Mapping[str, Any] = ...,
        pder2: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealPlanetary(ac.Component):
    """Ideal planetary gear of sun, carrier and ring."""

    ratio: ClassVar[ac.Parameter]
    """teeth of the ring over teeth of the sun"""
    sun: Flange
    carrier: Flange
    ring: Flange
    def __init__(
        self,
        *,
        ratio: SupportsFloat | ac.Start = ...,
        sun: Mapping[str, Any] = ...,
        carrier: Mapping[str, Any] = ...,
        ring: Mapping[str, Any] = ...,
    ) -> None: ...

class InitializeFlange(ac.Component):
    """Starts a flange from signals: at the initial time ``phi = phi_start``, ``w = w_start``, ``a = a_start``."""

    use_phi_start: ClassVar[ac.Option]
    """whether the initial angle is given"""
    use_w_start: ClassVar[ac.Option]
    """whether the initial speed is given"""
    use_a_start: ClassVar[ac.Option]
    """whether the initial acceleration is given"""
    stateSelect: ClassVar[ac.Option]
    """priority of the flange's states"""
    phi_start: ClassVar[ac.Input]
    """initial angle of the flange [rad]"""
    w_start: ClassVar[ac.Input]
    """initial speed of the flange [rad/s]"""
    a_start: ClassVar[ac.Input]
    """initial acceleration of the flange [rad/s2]"""
    flange: Flange
    phi_flange: ClassVar[ac.Variable]
    """angle of the flange [rad]"""
    w_flange: ClassVar[ac.Variable]
    """speed of the flange [rad/s]"""
    a_flange: ClassVar[ac.Variable]
    """acceleration of the flange [rad/s2]"""
    def __init__(
        self,
        *,
        use_phi_start: bool = ...,
        use_w_start: bool = ...,
        use_a_start: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        flange: Mapping[str, Any] = ...,
        phi_start: ac.Start | Mapping[str, Any] = ...,
        w_start: ac.Start | Mapping[str, Any] = ...,
        a_start: ac.Start | Mapping[str, Any] = ...,
        phi_flange: ac.Start | Mapping[str, Any] = ...,
        w_flange: ac.Start | Mapping[str, Any] = ...,
        a_flange: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialAbsoluteSensor(ac.Component):
    """One flange that is measured without a torque: ``flange.tau = 0``."""

    flange: Flange
    def __init__(self, **modifiers: Any) -> None: ...

class PartialElementaryOneFlangeAndSupport2(ac.Component):
    """One flange that works against a support, or against the ground without ``useSupport``."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed to the ground"""
    flange: Flange
    support: Flange
    phi: ClassVar[ac.Variable]
    """angle of the flange relative to the support [rad]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialOneFlangeAndSupport(ac.Component):
    """A flange and, with ``useSupport``, a support; for components put together from parts."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed to the ground"""
    flange: Flange
    support: Flange
    def __init__(self, **modifiers: Any) -> None: ...

class PartialTwoFlanges(ac.Component):
    """Two flanges without equations."""

    flange_a: Flange
    flange_b: Flange
    def __init__(self, **modifiers: Any) -> None: ...

class TorqueToAngleAdaptor(ac.Component):
    """A flange as signals, torque in, motion out: ``flange.tau = tau``, ``phi = flange.phi``."""

    use_w: ClassVar[ac.Option]
    """whether the speed is an output"""
    use_a: ClassVar[ac.Option]
    """whether the acceleration is an output"""
    flange: Flange
    phi: ClassVar[ac.Output]
    """angle of the flange [rad]"""
    w: ClassVar[ac.Output]
    """speed of the flange [rad/s]"""
    a: ClassVar[ac.Output]
    """acceleration of the flange [rad/s2]"""
    tau: ClassVar[ac.Input]
    """torque into the flange [N.m]"""
    def __init__(
        self,
        *,
        use_w: bool = ...,
        use_a: bool = ...,
        flange: Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class AccSensor(PartialAbsoluteSensor):
    """Absolute acceleration: ``a = der(w)`` [rad/s2] with ``w = der(flange.phi)``."""

    w: ClassVar[ac.Variable]
    """absolute speed of the flange [rad/s]"""
    a: ClassVar[ac.Output]
    """absolute acceleration of the flange [rad/s2]"""
    def __init__(
        self,
        *,
        flange: Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Accelerate(PartialElementaryOneFlangeAndSupport2):
    """The flange follows an acceleration signal ``a_ref`` [rad/s2]; ``phi`` and ``w`` start at 0."""

    phi: ClassVar[ac.Variable]
    """angle of the flange relative to the support [rad]"""
    a_ref: ClassVar[ac.Input]
    """reference acceleration [rad/s2]"""
    w: ClassVar[ac.Variable]
    """speed of the flange [rad/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flange [rad/s2]"""
    def __init__(
        self,
        *,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        a_ref: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class AngleSensor(PartialAbsoluteSensor):
    """Absolute angle: ``phi = flange.phi`` [rad]."""

    phi: ClassVar[ac.Output]
    """absolute angle of the flange [rad]"""
    def __init__(
        self, *, flange: Mapping[str, Any] = ..., phi: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class ConstantSpeed(PartialElementaryOneFlangeAndSupport2):
    """The flange turns with constant speed ``w_fixed`` [rad/s], whatever the torque."""

    w_fixed: ClassVar[ac.Parameter]
    """speed [rad/s]"""
    w: ClassVar[ac.Variable]
    """speed of the flange relative to the support [rad/s]"""
    def __init__(
        self,
        *,
        w_fixed: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Coupling(PartialTwoFlanges):
    """Ideal coupling of two shafts face to face: ``flange_a.phi + flange_b.phi = 0``."""

    w: ClassVar[ac.Variable]
    """speed of flange_a [rad/s]"""
    tau: ClassVar[ac.Variable]
    """torque of both flanges [N.m]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Disc(PartialTwoFlanges):
    """Two flanges, rigid and without inertia, turned by ``deltaPhi`` against each other."""

    deltaPhi: ClassVar[ac.Parameter]
    """fixed angle, = flange_b.phi - flange_a.phi [rad]"""
    phi: ClassVar[ac.Variable]
    """angle of the centre [rad]"""
    def __init__(
        self,
        *,
        deltaPhi: SupportsFloat | ac.Start = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Inertia(PartialTwoFlanges):
    """A rotating inertia: ``J a = flange_a.tau + flange_b.tau`` with ``w = der(phi)``, ``a = der(w)``."""

    J: ClassVar[ac.Parameter]
    """moment of inertia [kg.m2]"""
    stateSelect: ClassVar[ac.Option]
    """priority of phi and w as states"""
    phi: ClassVar[ac.Variable]
    """angle [rad]"""
    w: ClassVar[ac.Variable]
    """speed [rad/s]"""
    a: ClassVar[ac.Variable]
    """acceleration [rad/s2]"""
    def __init__(
        self,
        *,
        J: SupportsFloat | ac.Start = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Move(PartialElementaryOneFlangeAndSupport2):
    """The flange follows ``u = [phi, w, a]``: angle [rad], speed [rad/s] and acceleration [rad/s2]."""

    u: ClassVar[ac.Input]
    """angle, speed and acceleration of the flange"""
    def __init__(
        self,
        *,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialCompliant(PartialTwoFlanges):
    """An element without inertia, with a torque ``tau`` [N.m] over an angle ``phi_rel`` [rad]."""

    phi_rel: ClassVar[ac.Variable]
    """angle from flange_a to flange_b [rad]"""
    tau: ClassVar[ac.Variable]
    """torque between the flanges, = flange_b.tau [N.m]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialElementaryTwoFlangesAndSupport2(PartialTwoFlanges):
    """Two flanges that work against a support, or against the ground without ``useSupport``."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed to the ground"""
    support: Flange
    phi_a: ClassVar[ac.Variable]
    """angle of flange_a relative to the support [rad]"""
    phi_b: ClassVar[ac.Variable]
    """angle of flange_b relative to the support [rad]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialRelativeSensor(PartialTwoFlanges):
    """Two flanges between which is measured, without inertia: ``flange_a.tau + flange_b.tau = 0``."""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialTorque(PartialElementaryOneFlangeAndSupport2):
    """A torque ``tau = -flange.tau`` [N.m] that drives what is connected to the flange."""

    tau: ClassVar[ac.Variable]
    """driving torque, = -flange.tau [N.m]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialTwoFlangesAndSupport(PartialTwoFlanges):
    """Two flanges and, with ``useSupport``, a support; for components put together from parts."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed to the ground"""
    support: Flange
    def __init__(self, **modifiers: Any) -> None: ...

class Position(PartialElementaryOneFlangeAndSupport2):
    """The flange follows an angle signal ``phi_ref`` [rad]."""

    phi: ClassVar[ac.Variable]
    """angle of the flange relative to the support [rad]"""
    exact: ClassVar[ac.Option]
    """whether to follow the signal exactly; else filtered"""
    f_crit: ClassVar[ac.Parameter]
    """critical frequency of the filter [Hz]"""
    phi_ref: ClassVar[ac.Input]
    """reference angle [rad]"""
    w: ClassVar[ac.Variable]
    """speed of the flange; 0 if exact [rad/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flange; 0 if exact [rad/s2]"""
    def __init__(
        self,
        *,
        f_crit: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        exact: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi_ref: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelativeStates(PartialTwoFlanges):
    """Makes the relative angle ``phi_rel`` and the relative speed ``w_rel`` of two flanges states."""

    stateSelect: ClassVar[ac.Option]
    """priority of phi_rel, w_rel as states"""
    phi_nominal: ClassVar[ac.Option]
    """nominal value of phi_rel"""
    phi_rel: ClassVar[ac.Variable]
    """relative angle, used as a state [rad]"""
    w_rel: ClassVar[ac.Variable]
    """relative speed, used as a state [rad/s]"""
    a_rel: ClassVar[ac.Variable]
    """relative acceleration [rad/s2]"""
    def __init__(
        self,
        *,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        phi_nominal: Any = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Speed(PartialElementaryOneFlangeAndSupport2):
    """The flange follows a speed signal ``w_ref`` [rad/s]; ``w = der(phi)``, ``phi`` starts at 0."""

    phi: ClassVar[ac.Variable]
    """angle of the flange relative to the support [rad]"""
    exact: ClassVar[ac.Option]
    """whether to follow the signal exactly; else filtered"""
    f_crit: ClassVar[ac.Parameter]
    """critical frequency of the filter [Hz]"""
    w_ref: ClassVar[ac.Input]
    """reference speed [rad/s]"""
    w: ClassVar[ac.Variable]
    """speed of the flange [rad/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flange; 0 if exact [rad/s2]"""
    def __init__(
        self,
        *,
        f_crit: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        exact: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        w_ref: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SpeedSensor(PartialAbsoluteSensor):
    """Absolute speed: ``w = der(flange.phi)`` [rad/s]."""

    w: ClassVar[ac.Output]
    """absolute speed of the flange [rad/s]"""
    def __init__(
        self, *, flange: Mapping[str, Any] = ..., w: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class Torque(PartialElementaryOneFlangeAndSupport2):
    """A torque signal ``tau`` [N.m] that drives what is connected: ``flange.tau = -tau``."""

    tau: ClassVar[ac.Input]
    """driving torque [N.m]"""
    def __init__(
        self,
        *,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Torque2(PartialTwoFlanges):
    """A torque signal ``tau`` [N.m] between two flanges: ``flange_a.tau = tau``, ``flange_b.tau = -tau``."""

    tau: ClassVar[ac.Input]
    """driving torque [N.m]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealGear(PartialElementaryTwoFlangesAndSupport2):
    """Ideal gear: ``phi_a = ratio phi_b``, ``0 = ratio flange_a.tau + flange_b.tau``."""

    ratio: ClassVar[ac.Parameter]
    """transmission ratio phi_a / phi_b"""
    def __init__(
        self,
        *,
        ratio: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi_a: ac.Start | Mapping[str, Any] = ...,
        phi_b: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialCompliantWithRelativeStates(PartialCompliant):
    """A compliant element that also knows ``w_rel = der(phi_rel)`` and ``a_rel = der(w_rel)``."""

    phi_rel: ClassVar[ac.Variable]
    """angle from flange_a to flange_b [rad]"""
    stateSelect: ClassVar[ac.Option]
    """priority of phi_rel, w_rel as states"""
    phi_nominal: ClassVar[ac.Option]
    """nominal value of phi_rel"""
    w_rel: ClassVar[ac.Variable]
    """relative speed [rad/s]"""
    a_rel: ClassVar[ac.Variable]
    """relative acceleration [rad/s2]"""
    def __init__(self, **modifiers: Any) -> None: ...

class RelAccSensor(PartialRelativeSensor):
    """Relative acceleration: ``a_rel = der(w_rel)`` [rad/s2] with ``w_rel = der(phi_rel)``."""

    phi_rel: ClassVar[ac.Variable]
    """angle from flange_a to flange_b [rad]"""
    w_rel: ClassVar[ac.Variable]
    """relative speed [rad/s]"""
    a_rel: ClassVar[ac.Output]
    """relative acceleration [rad/s2]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelAngleSensor(PartialRelativeSensor):
    """Relative angle: ``phi_rel = flange_b.phi - flange_a.phi`` [rad]."""

    phi_rel: ClassVar[ac.Output]
    """angle from flange_a to flange_b [rad]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelSpeedSensor(PartialRelativeSensor):
    """Relative speed: ``w_rel = der(phi_rel)`` [rad/s], ``phi_rel = flange_b.phi - flange_a.phi``."""

    phi_rel: ClassVar[ac.Variable]
    """angle from flange_a to flange_b [rad]"""
    w_rel: ClassVar[ac.Output]
    """relative speed [rad/s]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Spring(PartialCompliant):
    """Linear spring: ``tau = c (phi_rel - phi_rel0)``."""

    c: ClassVar[ac.Parameter]
    """spring constant [N.m/rad]"""
    phi_rel0: ClassVar[ac.Parameter]
    """angle of the unstretched spring [rad]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TorqueStep(PartialTorque):
    """Step: ``tau = offsetTorque``, from ``startTime`` on ``tau = offsetTorque + stepTorque``."""

    stepTorque: ClassVar[ac.Parameter]
    """height of the step; a load if negative [N.m]"""
    offsetTorque: ClassVar[ac.Parameter]
    """offset of the torque [N.m]"""
    startTime: ClassVar[ac.Parameter]
    """time of the step [s]"""
    def __init__(
        self,
        *,
        stepTorque: SupportsFloat | ac.Start = ...,
        offsetTorque: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ConstantTorque(PartialTorque):
    """Constant torque: ``tau = tau_constant`` [N.m]; ``w = der(phi)`` is its speed."""

    w: ClassVar[ac.Variable]
    """speed of the flange relative to the support [rad/s]"""
    tau_constant: ClassVar[ac.Parameter]
    """driving torque; a load if negative [N.m]"""
    def __init__(
        self,
        *,
        tau_constant: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class EddyCurrentTorque(
    PartialElementaryOneFlangeAndSupport2, _thermal.PartialElementaryConditionalHeatPort
):
    """Eddy current brake (Kloss): ``tau = 2 tau_max r/(1 + r**2)``, always against the motion."""

    useExcitationInput: ClassVar[ac.Option]
    """whether excitation is an input"""
    constantExcitation: ClassVar[ac.Parameter]
    """relative excitation without input"""
    tau_nominal: ClassVar[ac.Parameter]
    """greatest torque at full excitation [N.m]"""
    w_nominal: ClassVar[ac.Parameter]
    """speed of the greatest torque at TRef [rad/s]"""
    TRef: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha20: ClassVar[ac.Parameter]
    """temperature coefficient of the material at 20 degC [1/K]"""
    excitation: ClassVar[ac.Input]
    """relative excitation; 1 for tau_nominal"""
    tau: ClassVar[ac.Variable]
    """braking torque, = flange.tau [N.m]"""
    w: ClassVar[ac.Variable]
    """speed of the flange relative to the support [rad/s]"""
    w_normalized: ClassVar[ac.Variable]
    """speed over that of the greatest torque"""
    def __init__(
        self,
        *,
        tau_nominal: SupportsFloat | ac.Start = ...,
        w_nominal: SupportsFloat | ac.Start = ...,
        TRef: SupportsFloat | ac.Start = ...,
        alpha20: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        constantExcitation: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        useSupport: bool = ...,
        useExcitationInput: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        excitation: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        TheatPort: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        w_normalized: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Gearbox(PartialTwoFlangesAndSupport):
    """A gear with losses (`LossyGear`), then elasticity and backlash (`ElastoBacklash`)."""

    ratio: ClassVar[ac.Parameter]
    """transmission ratio flange_a.phi / flange_b.phi"""
    lossTable: ClassVar[ac.Parameter]
    """rows of speed, two efficiencies, two bearing torques"""
    ideal: ClassVar[ac.Option]
    """whether there are no losses: no lossTable, or one without"""
    c: ClassVar[ac.Parameter]
    """elasticity of the gear [N.m/rad]"""
    d: ClassVar[ac.Parameter]
    """damping of the gear [N.m.s/rad]"""
    b: ClassVar[ac.Parameter]
    """total backlash [rad]"""
    stateSelect: ClassVar[ac.Option]
    """priority of phi_rel, w_rel as states"""
    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    smooth: ClassVar[ac.Option]
    """whether the losses are smooth at rest, see LossyGear"""
    heatPort: _thermal.HeatPort
    phi_rel: ClassVar[ac.Variable]
    """angle over the elasticity [rad]"""
    w_rel: ClassVar[ac.Variable]
    """speed over the elasticity [rad/s]"""
    a_rel: ClassVar[ac.Variable]
    """acceleration over the elasticity [rad/s2]"""
    lossyGear: LossyGear
    elastoBacklash: ElastoBacklash
    def __init__(
        self,
        *,
        ratio: SupportsFloat | ac.Start = ...,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        lossTable: SupportsFloat | Iterable[Any] = ...,
        b: SupportsFloat | ac.Start = ...,
        ideal: bool = ...,
        useSupport: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        useHeatPort: bool = ...,
        smooth: bool = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class MultiSensor(PartialRelativeSensor):
    """Speed ``w`` [rad/s], cut torque ``tau`` [N.m] and ``power = tau w`` [W] at once."""

    power: ClassVar[ac.Output]
    """power into flange_a [W]"""
    w: ClassVar[ac.Output]
    """absolute speed of the flanges [rad/s]"""
    tau: ClassVar[ac.Output]
    """torque in flange_a, = -flange_b.tau [N.m]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        power: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialFriction(ac.Component):
    """What friction elements share: a contact that slides or is stuck, as ``mode`` says."""

    smooth: ClassVar[ac.Option]
    """whether a smooth law creeps at rest instead of locking"""
    sa: ClassVar[ac.Variable]
    """path parameter: friction while locked, else acceleration"""
    startForward: ClassVar[ac.Discrete]
    """1 where forward sliding begins"""
    locked: ClassVar[ac.Discrete]
    """1 where the contact does not slide"""
    startBackward: ClassVar[ac.Discrete]
    """1 where backward sliding begins"""
    mode: ClassVar[ac.Discrete]
    """-1 sliding backward, 0 stuck, 1 sliding forward, 2 free, 3 unknown"""
    free: ClassVar[ac.Discrete]
    """1 where nothing presses the contact"""
    w_small: ClassVar[ac.Parameter]
    """a sliding contact turns back where Reinit gives it more speed against its direction; with smooth the speed below which friction is smoothed, 1e-4 rad/s unless it is given [rad/s]"""
    w_relfric: ClassVar[ac.Variable]
    """speed of the surfaces [rad/s]"""
    a_relfric: ClassVar[ac.Variable]
    """acceleration of the surfaces [rad/s2]"""
    tau0: ClassVar[ac.Variable]
    """friction at rest, sliding forward [N.m]"""
    tau0_max: ClassVar[ac.Variable]
    """greatest friction while locked [N.m]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PowerSensor(PartialRelativeSensor):
    """Power through the cut: ``power = flange_a.tau der(flange_a.phi)`` [W]."""

    power: ClassVar[ac.Output]
    """power into flange_a [W]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        power: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SignTorque(PartialTorque):
    """Constant torque with the sign of the speed: ``tau = tau_nominal sign(w)``."""

    w: ClassVar[ac.Variable]
    """speed of the flange relative to the support [rad/s]"""
    tau_nominal: ClassVar[ac.Parameter]
    """nominal driving torque; a load if negative [N.m]"""
    reg: ClassVar[ac.Option]
    """how the sign of w is smoothed"""
    w0: ClassVar[ac.Parameter]
    """speed below which the sign is smoothed [rad/s]"""
    def __init__(
        self,
        *,
        tau_nominal: SupportsFloat | ac.Start = ...,
        w0: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        reg: Literal["Exp", "Sine", "Linear", "CoSine"] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TorqueSensor(PartialRelativeSensor):
    """Cut torque: ``tau = flange_a.tau`` [N.m]."""

    tau: ClassVar[ac.Output]
    """torque in flange_a, = -flange_b.tau [N.m]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Damper(
    PartialCompliantWithRelativeStates, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Linear damper: ``tau = d w_rel``, ``lossPower = tau w_rel``."""

    d: ClassVar[ac.Parameter]
    """damping constant [N.m.s/rad]"""
    def __init__(
        self,
        *,
        d: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        phi_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class InverseSpeedDependentTorque(PartialTorque):
    """Torque inverse to speed: ``tau = tau_nominal w_nominal/|w|``, constant for ``|w| < w0``."""

    w: ClassVar[ac.Variable]
    """speed of the flange relative to the support [rad/s]"""
    tau_nominal: ClassVar[ac.Parameter]
    """nominal driving torque; a load if negative [N.m]"""
    TorqueDirection: ClassVar[ac.Option]
    """whether the direction is that of forward motion always"""
    w_nominal: ClassVar[ac.Parameter]
    """nominal speed [rad/s]"""
    w0: ClassVar[ac.Parameter]
    """speed below which the torque is bounded [rad/s]"""
    def __init__(
        self,
        *,
        tau_nominal: SupportsFloat | ac.Start = ...,
        w_nominal: SupportsFloat | ac.Start = ...,
        w0: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        TorqueDirection: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LinearSpeedDependentTorque(PartialTorque):
    """Torque linear in speed: ``tau = tau_nominal |w/w_nominal|``."""

    w: ClassVar[ac.Variable]
    """speed of the flange relative to the support [rad/s]"""
    tau_nominal: ClassVar[ac.Parameter]
    """nominal driving torque; a load if negative [N.m]"""
    TorqueDirection: ClassVar[ac.Option]
    """whether the direction is that of forward motion always"""
    w_nominal: ClassVar[ac.Parameter]
    """nominal speed [rad/s]"""
    def __init__(
        self,
        *,
        tau_nominal: SupportsFloat | ac.Start = ...,
        w_nominal: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        TorqueDirection: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class QuadraticSpeedDependentTorque(PartialTorque):
    """Torque quadratic in speed: ``tau = tau_nominal (w/w_nominal)**2``."""

    w: ClassVar[ac.Variable]
    """speed of the flange relative to the support [rad/s]"""
    tau_nominal: ClassVar[ac.Parameter]
    """nominal driving torque; a load if negative [N.m]"""
    TorqueDirection: ClassVar[ac.Option]
    """whether the direction is that of forward motion always"""
    w_nominal: ClassVar[ac.Parameter]
    """nominal speed [rad/s]"""
    def __init__(
        self,
        *,
        tau_nominal: SupportsFloat | ac.Start = ...,
        w_nominal: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        TorqueDirection: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SpringDamper(
    PartialCompliantWithRelativeStates, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Spring and damper side by side: ``tau = c (phi_rel - phi_rel0) + d w_rel``."""

    c: ClassVar[ac.Parameter]
    """spring constant [N.m/rad]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.m.s/rad]"""
    phi_rel0: ClassVar[ac.Parameter]
    """angle of the unstretched spring [rad]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        phi_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ElastoBacklash(
    PartialCompliantWithRelativeStates, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Spring and damper behind a backlash; the torque never pulls, and is continuous at contact."""

    c: ClassVar[ac.Parameter]
    """spring constant [N.m/rad]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.m.s/rad]"""
    b: ClassVar[ac.Parameter]
    """total backlash [rad]"""
    phi_rel0: ClassVar[ac.Parameter]
    """angle of the unstretched spring [rad]"""
    tau_c: ClassVar[ac.Variable]
    """spring torque [N.m]"""
    tau_d: ClassVar[ac.Variable]
    """damping torque, if it counted fully [N.m]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        b: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        phi_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
        tau_c: ac.Start | Mapping[str, Any] = ...,
        tau_d: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ElastoBacklash2(
    PartialCompliantWithRelativeStates, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Spring and damper behind a backlash; the torque never pulls, and jumps at contact."""

    c: ClassVar[ac.Parameter]
    """spring constant [N.m/rad]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.m.s/rad]"""
    b: ClassVar[ac.Parameter]
    """total backlash [rad]"""
    phi_rel0: ClassVar[ac.Parameter]
    """angle of the unstretched spring [rad]"""
    tau_c: ClassVar[ac.Variable]
    """spring torque [N.m]"""
    tau_d: ClassVar[ac.Variable]
    """damping torque, if it counted fully [N.m]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        b: SupportsFloat | ac.Start = ...,
        phi_rel0: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        phi_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
        tau_c: ac.Start | Mapping[str, Any] = ...,
        tau_d: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LossyGear(
    PartialElementaryTwoFlangesAndSupport2, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Gear with friction between the teeth and in the bearings."""

    ratio: ClassVar[ac.Parameter]
    """transmission ratio flange_a.phi / flange_b.phi"""
    lossTable: ClassVar[ac.Parameter]
    """rows of speed, two efficiencies, two bearing torques"""
    ideal: ClassVar[ac.Option]
    """whether there are no losses: no lossTable, or one without"""
    smooth: ClassVar[ac.Option]
    """whether a smooth law creeps at rest instead of locking"""
    sa: ClassVar[ac.Variable]
    """path parameter: friction while locked, else acceleration"""
    startForward: ClassVar[ac.Discrete]
    """1 where forward sliding begins"""
    locked: ClassVar[ac.Discrete]
    """1 where the contact does not slide"""
    startBackward: ClassVar[ac.Discrete]
    """1 where backward sliding begins"""
    mode: ClassVar[ac.Discrete]
    """-1 rolling backward, 0 stuck, 1 rolling forward"""
    smoothness: ClassVar[ac.Option]
    """interpolation of the table"""
    w_small: ClassVar[ac.Parameter]
    """speed below which losses are smoothed, with smooth [rad/s]"""
    w_a: ClassVar[ac.Variable]
    """speed of flange_a relative to the support [rad/s]"""
    a_a: ClassVar[ac.Variable]
    """acceleration of flange_a relative to the support [rad/s2]"""
    eta_mf1: ClassVar[ac.Variable]
    """efficiency of the teeth, flange_a drives"""
    eta_mf2: ClassVar[ac.Variable]
    """efficiency of the teeth, flange_b drives"""
    tau_bf1: ClassVar[ac.Variable]
    """bearing torque, flange_a drives [N.m]"""
    tau_bf2: ClassVar[ac.Variable]
    """bearing torque, flange_b drives [N.m]"""
    tauLossMax: ClassVar[ac.Variable]
    """loss while rolling forward [N.m]"""
    tauLossMin: ClassVar[ac.Variable]
    """loss while rolling backward [N.m]"""
    tauLoss: ClassVar[ac.Variable]
    """torque lost, at flange_a [N.m]"""
    tau_bf_a: ClassVar[ac.Variable]
    """bearing torque at flange_a [N.m]"""
    tau_eta: ClassVar[ac.Variable]
    """torque whose sign says which side drives [N.m]"""
    tauLossMax_p: ClassVar[ac.Variable]
    """loss where it starts forward [N.m]"""
    tauLossMin_m: ClassVar[ac.Variable]
    """loss where it starts backward [N.m]"""
    tau_etaPos: ClassVar[ac.Discrete]
    """1 where tau_eta >= 0"""
    tau_aPos: ClassVar[ac.Discrete]
    """tau_etaPos"""
    def __init__(
        self,
        *,
        ratio: SupportsFloat | ac.Start = ...,
        lossTable: SupportsFloat | Iterable[Any] = ...,
        w_small: SupportsFloat | ac.Start = ...,
        ideal: bool = ...,
        useHeatPort: bool = ...,
        smooth: bool = ...,
        useSupport: bool = ...,
        smoothness: Literal["LinearSegments", "ConstantSegments"] = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        startForward: ac.Start | Mapping[str, Any] = ...,
        locked: ac.Start | Mapping[str, Any] = ...,
        startBackward: ac.Start | Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        tau_etaPos: ac.Start | Mapping[str, Any] = ...,
        tau_aPos: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        sa: ac.Start | Mapping[str, Any] = ...,
        phi_a: ac.Start | Mapping[str, Any] = ...,
        phi_b: ac.Start | Mapping[str, Any] = ...,
        w_a: ac.Start | Mapping[str, Any] = ...,
        a_a: ac.Start | Mapping[str, Any] = ...,
        eta_mf1: ac.Start | Mapping[str, Any] = ...,
        eta_mf2: ac.Start | Mapping[str, Any] = ...,
        tau_bf1: ac.Start | Mapping[str, Any] = ...,
        tau_bf2: ac.Start | Mapping[str, Any] = ...,
        tauLossMax: ac.Start | Mapping[str, Any] = ...,
        tauLossMin: ac.Start | Mapping[str, Any] = ...,
        tauLoss: ac.Start | Mapping[str, Any] = ...,
        tau_bf_a: ac.Start | Mapping[str, Any] = ...,
        tau_eta: ac.Start | Mapping[str, Any] = ...,
        tauLossMax_p: ac.Start | Mapping[str, Any] = ...,
        tauLossMin_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OneWayClutch(
    PartialCompliantWithRelativeStates, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """A clutch and, in parallel, a free wheel that lets ``flange_b`` run ahead of ``flange_a`` only."""

    smooth: ClassVar[ac.Option]
    """whether a smooth law creeps at rest instead of locking"""
    sa: ClassVar[ac.Variable]
    """path parameter: friction while locked, else acceleration"""
    startForward: ClassVar[ac.Discrete]
    """1 where forward sliding begins"""
    locked: ClassVar[ac.Discrete]
    """1 where the contact does not slide"""
    peak: ClassVar[ac.Parameter]
    """static over sliding friction at w = 0"""
    smoothness: ClassVar[ac.Option]
    """interpolation of the table"""
    mu_pos: ClassVar[ac.Parameter]
    """rows of speed and friction coefficient"""
    cgeo: ClassVar[ac.Parameter]
    """geometry constant of the friction pairing"""
    fn_max: ClassVar[ac.Parameter]
    """greatest normal force [N]"""
    f_normalized: ClassVar[ac.Input]
    """normal force as a fraction of fn_max"""
    mu: ClassVar[ac.Variable]
    """friction coefficient, with the sign of the speed"""
    fn: ClassVar[ac.Variable]
    """normal force [N]"""
    w_small: ClassVar[ac.Parameter]
    """as for PartialFriction, where Reinit changes w_rel [rad/s]"""
    d_lock: ClassVar[ac.Parameter]
    """damping against turning back, with smooth [N.m.s/rad]"""
    tau0: ClassVar[ac.Variable]
    """friction at rest, sliding [N.m]"""
    tau0_max: ClassVar[ac.Variable]
    """greatest friction while locked [N.m]"""
    free: ClassVar[ac.Discrete]
    """1 where nothing presses the clutch"""
    stuck: ClassVar[ac.Discrete]
    """1 where w_rel = 0"""
    def __init__(
        self,
        *,
        fn_max: SupportsFloat | ac.Start = ...,
        peak: SupportsFloat | ac.Start = ...,
        mu_pos: SupportsFloat | Iterable[Any] = ...,
        cgeo: SupportsFloat | ac.Start = ...,
        w_small: SupportsFloat | ac.Start = ...,
        d_lock: SupportsFloat | ac.Start = ...,
        smooth: bool = ...,
        useHeatPort: bool = ...,
        smoothness: Literal["LinearSegments", "ConstantSegments"] = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        phi_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        f_normalized: ac.Start | Mapping[str, Any] = ...,
        startForward: ac.Start | Mapping[str, Any] = ...,
        locked: ac.Start | Mapping[str, Any] = ...,
        free: ac.Start | Mapping[str, Any] = ...,
        stuck: ac.Start | Mapping[str, Any] = ...,
        sa: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        mu: ac.Start | Mapping[str, Any] = ...,
        fn: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
        tau0: ac.Start | Mapping[str, Any] = ...,
        tau0_max: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialBearingFriction(
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
    _thermal.PartialElementaryConditionalHeatPortWithoutT,
):
    """Friction in the support by a curve ``tau`` over ``w >= 0``, which a subclass states."""

    peak: ClassVar[ac.Parameter]
    """static over sliding friction at w = 0"""
    phi: ClassVar[ac.Variable]
    """angle of the flanges relative to the support [rad]"""
    w: ClassVar[ac.Variable]
    """speed of the flanges relative to the support [rad/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flanges [rad/s2]"""
    tau: ClassVar[ac.Variable]
    """friction torque [N.m]"""
    def __init__(self, **modifiers: Any) -> None: ...

class BearingFriction(PartialBearingFriction):
    """Coulomb friction in the support, by a table ``tau_pos`` of ``[w, tau]`` [rad/s, N.m] for ``w >= 0``."""

    smoothness: ClassVar[ac.Option]
    """interpolation of the table"""
    tau_pos: ClassVar[ac.Parameter]
    """rows of speed and friction torque"""
    def __init__(
        self,
        *,
        peak: SupportsFloat | ac.Start = ...,
        w_small: SupportsFloat | ac.Start = ...,
        tau_pos: SupportsFloat | Iterable[Any] = ...,
        useHeatPort: bool = ...,
        smooth: bool = ...,
        useSupport: bool = ...,
        smoothness: Literal["LinearSegments", "ConstantSegments"] = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        startForward: ac.Start | Mapping[str, Any] = ...,
        locked: ac.Start | Mapping[str, Any] = ...,
        startBackward: ac.Start | Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        free: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        sa: ac.Start | Mapping[str, Any] = ...,
        w_relfric: ac.Start | Mapping[str, Any] = ...,
        a_relfric: ac.Start | Mapping[str, Any] = ...,
        tau0: ac.Start | Mapping[str, Any] = ...,
        tau0_max: ac.Start | Mapping[str, Any] = ...,
        phi_a: ac.Start | Mapping[str, Any] = ...,
        phi_b: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Brake(
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
    _thermal.PartialElementaryConditionalHeatPortWithoutT,
):
    """Friction brake, pressed by ``fn = fn_max f_normalized`` [N]; ``mu_pos`` holds ``[w, mu]``."""

    peak: ClassVar[ac.Parameter]
    """static over sliding friction at w = 0"""
    smoothness: ClassVar[ac.Option]
    """interpolation of the table"""
    mu_pos: ClassVar[ac.Parameter]
    """rows of speed and friction coefficient"""
    cgeo: ClassVar[ac.Parameter]
    """geometry constant of the friction pairing"""
    fn_max: ClassVar[ac.Parameter]
    """greatest normal force [N]"""
    f_normalized: ClassVar[ac.Input]
    """normal force as a fraction of fn_max"""
    mu: ClassVar[ac.Variable]
    """friction coefficient, with the sign of the speed"""
    fn: ClassVar[ac.Variable]
    """normal force [N]"""
    phi: ClassVar[ac.Variable]
    """angle of the flanges relative to the support [rad]"""
    w: ClassVar[ac.Variable]
    """speed of the flanges relative to the support [rad/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flanges [rad/s2]"""
    tau: ClassVar[ac.Variable]
    """friction torque [N.m]"""
    def __init__(
        self,
        *,
        fn_max: SupportsFloat | ac.Start = ...,
        peak: SupportsFloat | ac.Start = ...,
        mu_pos: SupportsFloat | Iterable[Any] = ...,
        cgeo: SupportsFloat | ac.Start = ...,
        w_small: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        smoothness: Literal["LinearSegments", "ConstantSegments"] = ...,
        smooth: bool = ...,
        useSupport: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        f_normalized: ac.Start | Mapping[str, Any] = ...,
        startForward: ac.Start | Mapping[str, Any] = ...,
        locked: ac.Start | Mapping[str, Any] = ...,
        startBackward: ac.Start | Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        free: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        mu: ac.Start | Mapping[str, Any] = ...,
        fn: ac.Start | Mapping[str, Any] = ...,
        sa: ac.Start | Mapping[str, Any] = ...,
        w_relfric: ac.Start | Mapping[str, Any] = ...,
        a_relfric: ac.Start | Mapping[str, Any] = ...,
        tau0: ac.Start | Mapping[str, Any] = ...,
        tau0_max: ac.Start | Mapping[str, Any] = ...,
        phi_a: ac.Start | Mapping[str, Any] = ...,
        phi_b: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Clutch(
    PartialCompliantWithRelativeStates,
    PartialFriction,
    _thermal.PartialElementaryConditionalHeatPortWithoutT,
):
    """Friction clutch between its flanges, pressed by ``fn = fn_max f_normalized`` [N]."""

    peak: ClassVar[ac.Parameter]
    """static over sliding friction at w = 0"""
    smoothness: ClassVar[ac.Option]
    """interpolation of the table"""
    mu_pos: ClassVar[ac.Parameter]
    """rows of speed and friction coefficient"""
    cgeo: ClassVar[ac.Parameter]
    """geometry constant of the friction pairing"""
    fn_max: ClassVar[ac.Parameter]
    """greatest normal force [N]"""
    f_normalized: ClassVar[ac.Input]
    """normal force as a fraction of fn_max"""
    mu: ClassVar[ac.Variable]
    """friction coefficient, with the sign of the speed"""
    fn: ClassVar[ac.Variable]
    """normal force [N]"""
    def __init__(
        self,
        *,
        fn_max: SupportsFloat | ac.Start = ...,
        peak: SupportsFloat | ac.Start = ...,
        mu_pos: SupportsFloat | Iterable[Any] = ...,
        cgeo: SupportsFloat | ac.Start = ...,
        w_small: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        smoothness: Literal["LinearSegments", "ConstantSegments"] = ...,
        smooth: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        phi_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        f_normalized: ac.Start | Mapping[str, Any] = ...,
        startForward: ac.Start | Mapping[str, Any] = ...,
        locked: ac.Start | Mapping[str, Any] = ...,
        startBackward: ac.Start | Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        free: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        mu: ac.Start | Mapping[str, Any] = ...,
        fn: ac.Start | Mapping[str, Any] = ...,
        sa: ac.Start | Mapping[str, Any] = ...,
        w_relfric: ac.Start | Mapping[str, Any] = ...,
        a_relfric: ac.Start | Mapping[str, Any] = ...,
        tau0: ac.Start | Mapping[str, Any] = ...,
        tau0_max: ac.Start | Mapping[str, Any] = ...,
        phi_rel: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
        w_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
