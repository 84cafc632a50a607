"""One-dimensional translational mechanics (`Modelica.Mechanics.Translational`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Literal, SupportsFloat

import acausal as ac
from acausal.components import blocks as _blocks, rotational as _rotational, thermal as _thermal
from acausal.components.mechanics.rolling import (
    IdealGearR2T as IdealGearR2T,
    IdealRollingWheel as IdealRollingWheel,
    PartialElementaryRotationalToTranslational as PartialElementaryRotationalToTranslational,
)
from acausal.components.mechanics.translational import (
    Flange as Flange,
    Flange as Flange_a,
    Flange as Flange_b,
    Flange as Support,
)

from . import utilities as utilities

__all__ = [
    "AccSensor",
    "Accelerate",
    "Brake",
    "ConstantForce",
    "ConstantSpeed",
    "Damper",
    "EddyCurrentForce",
    "ElastoGap",
    "Fixed",
    "Flange",
    "Flange_a",
    "Flange_b",
    "Force",
    "Force2",
    "ForceSensor",
    "ForceStep",
    "GeneralForceToPositionAdaptor",
    "GeneralPositionToForceAdaptor",
    "IdealGear",
    "IdealGearR2T",
    "IdealRollingWheel",
    "InitializeFlange",
    "InverseSpeedDependentForce",
    "LinearSpeedDependentForce",
    "Mass",
    "MassWithStopAndFriction",
    "Move",
    "MultiSensor",
    "PartialAbsoluteSensor",
    "PartialCompliant",
    "PartialCompliantWithRelativeStates",
    "PartialElementaryOneFlangeAndSupport2",
    "PartialElementaryRotationalToTranslational",
    "PartialElementaryTwoFlangesAndSupport2",
    "PartialForce",
    "PartialFriction",
    "PartialRelativeSensor",
    "PartialRigid",
    "PartialSpeedDependentForce",
    "PartialSupportFriction",
    "PartialTwoFlanges",
    "Position",
    "PositionSensor",
    "PowerSensor",
    "QuadraticSpeedDependentForce",
    "RelAccSensor",
    "RelPositionSensor",
    "RelSpeedSensor",
    "RelativeStates",
    "Rod",
    "RollingResistance",
    "SignForce",
    "Speed",
    "SpeedSensor",
    "Spring",
    "SpringDamper",
    "Support",
    "SupportFriction",
    "Vehicle",
    "utilities",
]

class Fixed(ac.Component):
    """A flange fixed in space: ``flange.s = s0`` [m]."""

    s0: ClassVar[ac.Parameter]
    """fixed position [m]"""
    flange: Flange
    def __init__(
        self, *, s0: SupportsFloat | ac.Start = ..., flange: Mapping[str, Any] = ...
    ) -> None: ...

class GeneralForceToPositionAdaptor(ac.Component):
    """A flange as signals, force in, motion out: ``f = flange.f``, ``p = flange.s``."""

    use_pder: ClassVar[ac.Option]
    """whether the speed is an output"""
    use_pder2: ClassVar[ac.Option]
    """whether the acceleration is an output (needs use_pder)"""
    flange: Flange
    f: ClassVar[ac.Input]
    """force [N]"""
    p: ClassVar[ac.Output]
    """position [m]"""
    pder: ClassVar[ac.Output]
    """speed [m/s]"""
    pder2: ClassVar[ac.Output]
    """acceleration [m/s2]"""
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

class GeneralPositionToForceAdaptor(ac.Component):
    """A flange as signals, motion in, force out: ``flange.s = p``, ``f = -flange.f``."""

    use_pder: ClassVar[ac.Option]
    """whether the speed is an input"""
    use_pder2: ClassVar[ac.Option]
    """whether the acceleration is an input (needs use_pder)"""
    flange: Flange
    p: ClassVar[ac.Input]
    """position [m]"""
    pder: ClassVar[ac.Input]
    """speed, consistent with p [m/s]"""
    pder2: ClassVar[ac.Input]
    """acceleration, consistent with pder [m/s2]"""
    f: ClassVar[ac.Output]
    """force that drives what is connected, = -flange.f [N]"""
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

class InitializeFlange(ac.Component):
    """Starts a flange from signals: at the initial time ``s = s_start``, ``v = v_start``, ``a = a_start``."""

    use_s_start: ClassVar[ac.Option]
    """whether the initial position is given"""
    use_v_start: ClassVar[ac.Option]
    """whether the initial speed is given"""
    use_a_start: ClassVar[ac.Option]
    """whether the initial acceleration is given"""
    stateSelect: ClassVar[ac.Option]
    """priority of the flange's states"""
    s_start: ClassVar[ac.Input]
    """initial position of the flange [m]"""
    v_start: ClassVar[ac.Input]
    """initial speed of the flange [m/s]"""
    a_start: ClassVar[ac.Input]
    """initial acceleration of the flange [m/s2]"""
    flange: Flange
    s_flange: ClassVar[ac.Variable]
    """position of the flange [m]"""
    v_flange: ClassVar[ac.Variable]
    """speed of the flange [m/s]"""
    a_flange: ClassVar[ac.Variable]
    """acceleration of the flange [m/s2]"""
    def __init__(
        self,
        *,
        use_s_start: bool = ...,
        use_v_start: bool = ...,
        use_a_start: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        flange: Mapping[str, Any] = ...,
        s_start: ac.Start | Mapping[str, Any] = ...,
        v_start: ac.Start | Mapping[str, Any] = ...,
        a_start: ac.Start | Mapping[str, Any] = ...,
        s_flange: ac.Start | Mapping[str, Any] = ...,
        v_flange: ac.Start | Mapping[str, Any] = ...,
        a_flange: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialAbsoluteSensor(ac.Component):
    """One flange that is measured without a force: ``flange.f = 0``."""

    flange: Flange
    def __init__(self, **modifiers: Any) -> None: ...

class PartialElementaryOneFlangeAndSupport2(ac.Component):
    """One flange that works against a support, or against the ground without ``useSupport``."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed to the ground"""
    flange: Flange
    support: Flange
    s: ClassVar[ac.Variable]
    """position of the flange relative to the support [m]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialTwoFlanges(ac.Component):
    """Two flanges without equations."""

    flange_a: Flange
    flange_b: Flange
    def __init__(self, **modifiers: Any) -> None: ...

class Vehicle(ac.Component):
    """A vehicle of mass ``m`` on wheels of radius ``R``, driven at ``flangeR``, coupled at ``flangeT``."""

    m: ClassVar[ac.Parameter]
    """total mass [kg]"""
    g: ClassVar[ac.Parameter]
    """acceleration of gravity [m/s2]"""
    J: ClassVar[ac.Parameter]
    """inertia of the drive train, seen at the wheels [kg.m2]"""
    R: ClassVar[ac.Parameter]
    """radius of the wheels [m]"""
    A: ClassVar[ac.Parameter]
    """cross section [m2]"""
    Cd: ClassVar[ac.Parameter]
    """drag coefficient"""
    rho: ClassVar[ac.Parameter]
    """density of air [kg/m3]"""
    useWindInput: ClassVar[ac.Option]
    """whether vWind is an input"""
    vWindConstant: ClassVar[ac.Parameter]
    """speed of the wind without input [m/s]"""
    useCrInput: ClassVar[ac.Option]
    """whether cr is an input"""
    CrConstant: ClassVar[ac.Parameter]
    """coefficient of rolling resistance without input"""
    vReg: ClassVar[ac.Parameter]
    """speed below which the sign is smoothed [m/s]"""
    useInclinationInput: ClassVar[ac.Option]
    """whether inclination is an input"""
    inclinationConstant: ClassVar[ac.Parameter]
    """inclination without input, = tan(angle)"""
    flangeR: _rotational.Flange
    flangeT: Flange
    inclination: ClassVar[ac.Input]
    """inclination, = tan(angle)"""
    cr: ClassVar[ac.Input]
    """coefficient of rolling resistance"""
    vWind: ClassVar[ac.Input]
    """speed of the wind [m/s]"""
    s: ClassVar[ac.Variable]
    """position [m]"""
    v: ClassVar[ac.Variable]
    """speed [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration [m/s2]"""
    inertia: _rotational.Inertia
    idealRollingWheel: IdealRollingWheel
    mass: Mass
    fDrag: QuadraticSpeedDependentForce
    fRoll: RollingResistance
    fGrav: Force
    gravForceGain: _blocks.Gain
    atan: _blocks.Atan
    sin: _blocks.Sin
    windSpeed: Speed
    constInclination: _blocks.Constant
    constWindSpeed: _blocks.Constant
    def __init__(
        self,
        *,
        m: SupportsFloat | ac.Start = ...,
        J: SupportsFloat | ac.Start = ...,
        R: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        Cd: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        vWindConstant: SupportsFloat | ac.Start = ...,
        CrConstant: SupportsFloat | ac.Start = ...,
        vReg: SupportsFloat | ac.Start = ...,
        inclinationConstant: SupportsFloat | ac.Start = ...,
        useWindInput: bool = ...,
        useCrInput: bool = ...,
        useInclinationInput: bool = ...,
        flangeR: Mapping[str, Any] = ...,
        flangeT: Mapping[str, Any] = ...,
        inclination: ac.Start | Mapping[str, Any] = ...,
        cr: ac.Start | Mapping[str, Any] = ...,
        vWind: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class AccSensor(PartialAbsoluteSensor):
    """Absolute acceleration: ``a = der(v)`` [m/s2] with ``v = der(flange.s)``."""

    v: ClassVar[ac.Variable]
    """absolute speed of the flange [m/s]"""
    a: ClassVar[ac.Output]
    """absolute acceleration of the flange [m/s2]"""
    def __init__(
        self,
        *,
        flange: Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Accelerate(PartialElementaryOneFlangeAndSupport2):
    """The flange follows an acceleration signal ``a_ref`` [m/s2]; ``s`` and ``v`` start at 0."""

    s: ClassVar[ac.Variable]
    """position of the flange relative to the support [m]"""
    a_ref: ClassVar[ac.Input]
    """reference acceleration [m/s2]"""
    v: ClassVar[ac.Variable]
    """speed of the flange [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flange [m/s2]"""
    def __init__(
        self,
        *,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        a_ref: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Force(PartialElementaryOneFlangeAndSupport2):
    """A force signal ``f`` [N] that drives what is connected: ``flange.f = -f``."""

    f: ClassVar[ac.Input]
    """driving force [N]"""
    def __init__(
        self,
        *,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Force2(PartialTwoFlanges):
    """A force signal ``f`` [N] between two flanges: ``flange_a.f = f``, ``flange_b.f = -f``."""

    f: ClassVar[ac.Input]
    """driving force [N]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Move(PartialElementaryOneFlangeAndSupport2):
    """The flange follows ``u = [s, v, a]``: position [m], speed [m/s] and acceleration [m/s2]."""

    u: ClassVar[ac.Input]
    """position, speed and acceleration of the flange"""
    def __init__(
        self,
        *,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialCompliant(PartialTwoFlanges):
    """A massless element with a force ``f`` [N] over a distance ``s_rel`` [m]."""

    s_rel: ClassVar[ac.Variable]
    """distance from flange_a to flange_b [m]"""
    f: ClassVar[ac.Variable]
    """force between the flanges, = flange_b.f [N]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialElementaryTwoFlangesAndSupport2(PartialTwoFlanges):
    """Two flanges that work against a support, or against the ground without ``useSupport``."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed to the ground"""
    support: Flange
    s_a: ClassVar[ac.Variable]
    """position of flange_a relative to the support [m]"""
    s_b: ClassVar[ac.Variable]
    """position of flange_b relative to the support [m]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialForce(PartialElementaryOneFlangeAndSupport2):
    """A force ``f = flange.f`` [N] on the flange; negative values push what is connected forward."""

    f: ClassVar[ac.Variable]
    """force at the flange, = flange.f [N]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialRelativeSensor(PartialTwoFlanges):
    """Two flanges between which is measured, without inertia: ``flange_a.f + flange_b.f = 0``."""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialRigid(PartialTwoFlanges):
    """Two flanges held at distance ``L``: ``flange_a.s = s - L/2``, ``flange_b.s = s + L/2``."""

    L: ClassVar[ac.Parameter]
    """length from left flange to right flange [m]"""
    s: ClassVar[ac.Variable]
    """position of the centre [m]"""
    def __init__(self, **modifiers: Any) -> None: ...

class Position(PartialElementaryOneFlangeAndSupport2):
    """The flange follows a position signal ``s_ref`` [m]."""

    s: ClassVar[ac.Variable]
    """position of the flange relative to the support [m]"""
    exact: ClassVar[ac.Option]
    """whether to follow the signal exactly; else filtered"""
    f_crit: ClassVar[ac.Parameter]
    """critical frequency of the filter [Hz]"""
    s_ref: ClassVar[ac.Input]
    """reference position [m]"""
    v: ClassVar[ac.Variable]
    """speed of the flange; 0 if exact [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flange; 0 if exact [m/s2]"""
    def __init__(
        self,
        *,
        f_crit: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        exact: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s_ref: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PositionSensor(PartialAbsoluteSensor):
    """Absolute position: ``s = flange.s`` [m]."""

    s: ClassVar[ac.Output]
    """absolute position of the flange [m]"""
    def __init__(
        self, *, flange: Mapping[str, Any] = ..., s: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class RelativeStates(PartialTwoFlanges):
    """Makes the distance ``s_rel`` and the relative speed ``v_rel`` of two flanges states."""

    stateSelect: ClassVar[ac.Option]
    """priority of s_rel, v_rel as states"""
    s_rel: ClassVar[ac.Variable]
    """distance, used as a state [m]"""
    v_rel: ClassVar[ac.Variable]
    """relative speed, used as a state [m/s]"""
    a_rel: ClassVar[ac.Variable]
    """relative acceleration [m/s2]"""
    def __init__(
        self,
        *,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Speed(PartialElementaryOneFlangeAndSupport2):
    """The flange follows a speed signal ``v_ref`` [m/s]; ``v = der(s)``, ``s`` starts at 0."""

    s: ClassVar[ac.Variable]
    """position of the flange relative to the support [m]"""
    exact: ClassVar[ac.Option]
    """whether to follow the signal exactly; else filtered"""
    f_crit: ClassVar[ac.Parameter]
    """critical frequency of the filter [Hz]"""
    v_ref: ClassVar[ac.Input]
    """reference speed [m/s]"""
    v: ClassVar[ac.Variable]
    """speed of the flange [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flange; 0 if exact [m/s2]"""
    def __init__(
        self,
        *,
        f_crit: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        exact: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        v_ref: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SpeedSensor(PartialAbsoluteSensor):
    """Absolute speed: ``v = der(flange.s)`` [m/s]."""

    v: ClassVar[ac.Output]
    """absolute speed of the flange [m/s]"""
    def __init__(
        self, *, flange: Mapping[str, Any] = ..., v: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class ConstantForce(PartialForce):
    """Constant force: ``f = -f_constant``; a positive ``f_constant`` [N] drives forward."""

    f_constant: ClassVar[ac.Parameter]
    """driving force; a load if negative [N]"""
    def __init__(
        self,
        *,
        f_constant: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ForceStep(PartialForce):
    """Step: ``f = -offsetForce``, from ``startTime`` on ``f = -offsetForce - stepForce``."""

    stepForce: ClassVar[ac.Parameter]
    """height of the step; a load if negative [N]"""
    offsetForce: ClassVar[ac.Parameter]
    """offset of the force [N]"""
    startTime: ClassVar[ac.Parameter]
    """time of the step [s]"""
    def __init__(
        self,
        *,
        stepForce: SupportsFloat | ac.Start = ...,
        offsetForce: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealGear(PartialElementaryTwoFlangesAndSupport2):
    """Ideal lever or gear: ``s_a = ratio s_b``, ``0 = ratio flange_a.f + flange_b.f``."""

    ratio: ClassVar[ac.Parameter]
    """transmission ratio s_a / s_b"""
    def __init__(
        self,
        *,
        ratio: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s_a: ac.Start | Mapping[str, Any] = ...,
        s_b: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Mass(PartialRigid):
    """A sliding mass: ``m a = flange_a.f + flange_b.f`` with ``v = der(s)``, ``a = der(v)``."""

    s: ClassVar[ac.Variable]
    """position of the centre [m]"""
    m: ClassVar[ac.Parameter]
    """mass [kg]"""
    stateSelect: ClassVar[ac.Option]
    """priority of s and v as states"""
    v: ClassVar[ac.Variable]
    """speed [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration [m/s2]"""
    def __init__(
        self,
        *,
        m: SupportsFloat | ac.Start = ...,
        L: SupportsFloat | ac.Start = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialCompliantWithRelativeStates(PartialCompliant):
    """A compliant element that also knows the relative speed ``v_rel = der(s_rel)`` [m/s]."""

    s_rel: ClassVar[ac.Variable]
    """distance from flange_a to flange_b [m]"""
    stateSelect: ClassVar[ac.Option]
    """priority of s_rel, v_rel as states"""
    s_nominal: ClassVar[ac.Option]
    """nominal value of s_rel"""
    v_rel: ClassVar[ac.Variable]
    """relative speed [m/s]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialSpeedDependentForce(PartialForce):
    """A force that depends on the flange's speed ``v = der(s)`` [m/s] against the support."""

    v: ClassVar[ac.Variable]
    """speed of the flange relative to the support [m/s]"""
    def __init__(self, **modifiers: Any) -> None: ...

class RelAccSensor(PartialRelativeSensor):
    """Relative acceleration: ``a_rel = der(v_rel)`` [m/s2] with ``v_rel = der(s_rel)``."""

    s_rel: ClassVar[ac.Variable]
    """distance from flange_a to flange_b [m]"""
    v_rel: ClassVar[ac.Variable]
    """relative speed [m/s]"""
    a_rel: ClassVar[ac.Output]
    """relative acceleration [m/s2]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        a_rel: ac.Start | Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelPositionSensor(PartialRelativeSensor):
    """Distance: ``s_rel = flange_b.s - flange_a.s`` [m]."""

    s_rel: ClassVar[ac.Output]
    """distance from flange_a to flange_b [m]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelSpeedSensor(PartialRelativeSensor):
    """Relative speed: ``v_rel = der(s_rel)`` [m/s] with ``s_rel = flange_b.s - flange_a.s``."""

    s_rel: ClassVar[ac.Variable]
    """distance from flange_a to flange_b [m]"""
    v_rel: ClassVar[ac.Output]
    """relative speed [m/s]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Rod(PartialRigid):
    """A massless rod of length ``L``: ``0 = flange_a.f + flange_b.f``."""
    def __init__(
        self,
        *,
        L: SupportsFloat | ac.Start = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Spring(PartialCompliant):
    """Linear spring: ``f = c (s_rel - s_rel0)``."""

    c: ClassVar[ac.Parameter]
    """spring constant [N/m]"""
    s_rel0: ClassVar[ac.Parameter]
    """unstretched length [m]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        s_rel0: SupportsFloat | ac.Start = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ConstantSpeed(PartialSpeedDependentForce):
    """The flange moves with constant speed ``v_fixed`` [m/s], whatever the force."""

    v_fixed: ClassVar[ac.Parameter]
    """speed [m/s]"""
    def __init__(
        self,
        *,
        v_fixed: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class EddyCurrentForce(
    PartialElementaryOneFlangeAndSupport2, _thermal.PartialElementaryConditionalHeatPort
):
    """Eddy current brake (Kloss): ``f = 2 f_max r/(1 + r**2)``, always against the motion."""

    useExcitationInput: ClassVar[ac.Option]
    """whether excitation is an input"""
    constantExcitation: ClassVar[ac.Parameter]
    """relative excitation without input"""
    f_nominal: ClassVar[ac.Parameter]
    """greatest force at full excitation [N]"""
    v_nominal: ClassVar[ac.Parameter]
    """speed of the greatest force at TRef [m/s]"""
    TRef: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha20: ClassVar[ac.Parameter]
    """temperature coefficient of the material at 20 degC [1/K]"""
    excitation: ClassVar[ac.Input]
    """relative excitation; 1 for f_nominal"""
    f: ClassVar[ac.Variable]
    """braking force, = flange.f [N]"""
    v: ClassVar[ac.Variable]
    """speed of the flange relative to the support [m/s]"""
    v_normalized: ClassVar[ac.Variable]
    """speed over that of the greatest force"""
    def __init__(
        self,
        *,
        f_nominal: SupportsFloat | ac.Start = ...,
        v_nominal: SupportsFloat | ac.Start = ...,
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
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        v_normalized: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ForceSensor(PartialRelativeSensor):
    """Cut force: ``f = flange_a.f`` [N]."""

    f: ClassVar[ac.Output]
    """force in flange_a, = -flange_b.f [N]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MultiSensor(PartialRelativeSensor):
    """Speed ``v`` [m/s], cut force ``f`` [N] and ``power = f v`` [W] at once."""

    power: ClassVar[ac.Output]
    """power into flange_a [W]"""
    f: ClassVar[ac.Output]
    """force in flange_a, = -flange_b.f [N]"""
    v: ClassVar[ac.Output]
    """absolute speed of the flanges [m/s]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        power: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
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
    v_small: ClassVar[ac.Parameter]
    """a sliding contact turns back where Reinit gives it more speed against its direction; with smooth the speed below which friction is smoothed [m/s]"""
    v_relfric: ClassVar[ac.Variable]
    """speed of the surfaces [m/s]"""
    a_relfric: ClassVar[ac.Variable]
    """acceleration of the surfaces [m/s2]"""
    f0: ClassVar[ac.Variable]
    """friction at rest, sliding forward [N]"""
    f0_max: ClassVar[ac.Variable]
    """greatest friction while locked [N]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PowerSensor(PartialRelativeSensor):
    """Power through the cut: ``power = flange_a.f der(flange_a.s)`` [W]."""

    power: ClassVar[ac.Output]
    """power into flange_a [W]"""
    def __init__(
        self,
        *,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        power: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RollingResistance(PartialSpeedDependentForce):
    """Rolling resistance of a wheel on a slope: ``f = cr fWeight cos(atan(inclination)) sign(v)``."""

    fWeight: ClassVar[ac.Parameter]
    """load of the wheel by gravity [N]"""
    useCrInput: ClassVar[ac.Option]
    """whether cr is an input"""
    CrConstant: ClassVar[ac.Parameter]
    """coefficient of rolling resistance without input"""
    useInclinationInput: ClassVar[ac.Option]
    """whether inclination is an input"""
    inclinationConstant: ClassVar[ac.Parameter]
    """inclination without input, = tan(angle)"""
    reg: ClassVar[ac.Option]
    """how the sign of v is smoothed"""
    v0: ClassVar[ac.Parameter]
    """speed below which the sign is smoothed [m/s]"""
    inclination: ClassVar[ac.Input]
    """inclination, = tan(angle)"""
    cr: ClassVar[ac.Input]
    """coefficient of rolling resistance"""
    f_nominal: ClassVar[ac.Variable]
    """resistance without smoothing, negative [N]"""
    def __init__(
        self,
        *,
        fWeight: SupportsFloat | ac.Start = ...,
        CrConstant: SupportsFloat | ac.Start = ...,
        inclinationConstant: SupportsFloat | ac.Start = ...,
        v0: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        useCrInput: bool = ...,
        useInclinationInput: bool = ...,
        reg: Literal["Exp", "Sine", "Linear", "CoSine"] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        inclination: ac.Start | Mapping[str, Any] = ...,
        cr: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        f_nominal: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SignForce(PartialSpeedDependentForce):
    """Constant force with the sign of the speed: ``f = -f_nominal sign(v)``."""

    f_nominal: ClassVar[ac.Parameter]
    """nominal driving force; a load if negative [N]"""
    reg: ClassVar[ac.Option]
    """how the sign of v is smoothed"""
    v0: ClassVar[ac.Parameter]
    """speed below which the sign is smoothed [m/s]"""
    def __init__(
        self,
        *,
        f_nominal: SupportsFloat | ac.Start = ...,
        v0: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        reg: Literal["Exp", "Sine", "Linear", "CoSine"] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Damper(
    PartialCompliantWithRelativeStates, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Linear damper: ``f = d v_rel``, ``lossPower = f v_rel``."""

    d: ClassVar[ac.Parameter]
    """damping constant [N.s/m]"""
    def __init__(
        self,
        *,
        d: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        s_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ElastoGap(
    PartialCompliantWithRelativeStates, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Spring and damper that lift off: there is a force only while ``s_rel < s_rel0``."""

    c: ClassVar[ac.Parameter]
    """spring constant [N/m]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.s/m]"""
    s_rel0: ClassVar[ac.Parameter]
    """length at which contact begins [m]"""
    n: ClassVar[ac.Parameter]
    """exponent of the spring force"""
    contact: ClassVar[ac.Variable]
    """1 in contact, else 0"""
    f_c: ClassVar[ac.Variable]
    """spring force [N]"""
    f_d: ClassVar[ac.Variable]
    """damping force [N]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        s_rel0: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        s_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
        contact: ac.Start | Mapping[str, Any] = ...,
        f_c: ac.Start | Mapping[str, Any] = ...,
        f_d: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class InverseSpeedDependentForce(PartialSpeedDependentForce):
    """Force inverse to speed: ``f = -f_nominal v_nominal/|v|``, constant for ``|v| < v0``."""

    f_nominal: ClassVar[ac.Parameter]
    """nominal driving force; a load if negative [N]"""
    ForceDirection: ClassVar[ac.Option]
    """whether the direction is that of forward motion always"""
    v_nominal: ClassVar[ac.Parameter]
    """nominal speed [m/s]"""
    v0: ClassVar[ac.Parameter]
    """speed below which the force is bounded [m/s]"""
    def __init__(
        self,
        *,
        f_nominal: SupportsFloat | ac.Start = ...,
        v_nominal: SupportsFloat | ac.Start = ...,
        v0: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        ForceDirection: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LinearSpeedDependentForce(PartialSpeedDependentForce):
    """Force linear in speed: ``f = -f_nominal |v/v_nominal|``."""

    f_nominal: ClassVar[ac.Parameter]
    """nominal driving force; a load if negative [N]"""
    ForceDirection: ClassVar[ac.Option]
    """whether the direction is that of forward motion always"""
    v_nominal: ClassVar[ac.Parameter]
    """nominal speed [m/s]"""
    def __init__(
        self,
        *,
        f_nominal: SupportsFloat | ac.Start = ...,
        v_nominal: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        ForceDirection: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class QuadraticSpeedDependentForce(PartialSpeedDependentForce):
    """Force quadratic in speed: ``f = -f_nominal (v/v_nominal)**2``."""

    f_nominal: ClassVar[ac.Parameter]
    """nominal driving force; a load if negative [N]"""
    ForceDirection: ClassVar[ac.Option]
    """whether the direction is that of forward motion always"""
    v_nominal: ClassVar[ac.Parameter]
    """nominal speed [m/s]"""
    def __init__(
        self,
        *,
        f_nominal: SupportsFloat | ac.Start = ...,
        v_nominal: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        ForceDirection: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SpringDamper(
    PartialCompliantWithRelativeStates, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """Spring and damper side by side: ``f = c (s_rel - s_rel0) + d v_rel``."""

    c: ClassVar[ac.Parameter]
    """spring constant [N/m]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.s/m]"""
    s_rel0: ClassVar[ac.Parameter]
    """unstretched length [m]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        s_rel0: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        s_nominal: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MassWithStopAndFriction(
    PartialRigid, PartialFriction, _thermal.PartialElementaryConditionalHeatPortWithoutT
):
    """A sliding mass with Stribeck friction ``f`` [N] between two stops."""

    s: ClassVar[ac.Variable]
    """position of the centre [m]"""
    m: ClassVar[ac.Parameter]
    """mass [kg]"""
    smax: ClassVar[ac.Parameter]
    """right stop for the right end [m]"""
    smin: ClassVar[ac.Parameter]
    """left stop for the left end [m]"""
    F_prop: ClassVar[ac.Parameter]
    """viscous friction [N.s/m]"""
    F_Coulomb: ClassVar[ac.Parameter]
    """constant friction [N]"""
    F_Stribeck: ClassVar[ac.Parameter]
    """excess of friction at rest [N]"""
    fexp: ClassVar[ac.Parameter]
    """decay of the Stribeck effect [s/m]"""
    c_stop: ClassVar[ac.Parameter]
    """stiffness of the stops, with smooth [N/m]"""
    d_stop: ClassVar[ac.Parameter]
    """damping of the stops, with smooth [s/m]"""
    stateSelect: ClassVar[ac.Option]
    """priority of s and v as states"""
    v: ClassVar[ac.Variable]
    """speed [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration [m/s2]"""
    f: ClassVar[ac.Variable]
    """friction force [N]"""
    f_stop: ClassVar[ac.Variable]
    """force of the stops, positive at smax [N]"""
    stopped: ClassVar[ac.Variable]
    """-1 at smin, 1 at smax, else 0"""
    def __init__(
        self,
        *,
        m: SupportsFloat | ac.Start = ...,
        smax: SupportsFloat | ac.Start = ...,
        smin: SupportsFloat | ac.Start = ...,
        F_prop: SupportsFloat | ac.Start = ...,
        F_Coulomb: SupportsFloat | ac.Start = ...,
        F_Stribeck: SupportsFloat | ac.Start = ...,
        fexp: SupportsFloat | ac.Start = ...,
        v_small: SupportsFloat | ac.Start = ...,
        L: SupportsFloat | ac.Start = ...,
        c_stop: SupportsFloat | ac.Start = ...,
        d_stop: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        smooth: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        startForward: ac.Start | Mapping[str, Any] = ...,
        locked: ac.Start | Mapping[str, Any] = ...,
        startBackward: ac.Start | Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        free: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        sa: ac.Start | Mapping[str, Any] = ...,
        v_relfric: ac.Start | Mapping[str, Any] = ...,
        a_relfric: ac.Start | Mapping[str, Any] = ...,
        f0: ac.Start | Mapping[str, Any] = ...,
        f0_max: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        f_stop: ac.Start | Mapping[str, Any] = ...,
        stopped: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Brake(
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
    _thermal.PartialElementaryConditionalHeatPortWithoutT,
):
    """Friction brake, pressed by ``fn = fn_max f_normalized`` [N]; ``mu_pos`` holds ``[v, mu]``."""

    peak: ClassVar[ac.Parameter]
    """static over sliding friction at v = 0"""
    s: ClassVar[ac.Variable]
    """position of the flanges relative to the support [m]"""
    v: ClassVar[ac.Variable]
    """speed of the flanges relative to the support [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flanges [m/s2]"""
    f: ClassVar[ac.Variable]
    """friction force [N]"""
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
    """friction coefficient, with the sign of v"""
    fn: ClassVar[ac.Variable]
    """normal force [N]"""
    def __init__(
        self,
        *,
        fn_max: SupportsFloat | ac.Start = ...,
        v_small: SupportsFloat | ac.Start = ...,
        peak: SupportsFloat | ac.Start = ...,
        mu_pos: SupportsFloat | Iterable[Any] = ...,
        cgeo: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        smooth: bool = ...,
        useSupport: bool = ...,
        smoothness: Literal["LinearSegments", "ConstantSegments"] = ...,
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
        sa: ac.Start | Mapping[str, Any] = ...,
        v_relfric: ac.Start | Mapping[str, Any] = ...,
        a_relfric: ac.Start | Mapping[str, Any] = ...,
        f0: ac.Start | Mapping[str, Any] = ...,
        f0_max: ac.Start | Mapping[str, Any] = ...,
        s_a: ac.Start | Mapping[str, Any] = ...,
        s_b: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        mu: ac.Start | Mapping[str, Any] = ...,
        fn: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialSupportFriction(
    PartialElementaryTwoFlangesAndSupport2,
    PartialFriction,
    _thermal.PartialElementaryConditionalHeatPortWithoutT,
):
    """Friction on the support by a curve ``f`` over ``v >= 0``, which a subclass states."""

    peak: ClassVar[ac.Parameter]
    """static over sliding friction at v = 0"""
    s: ClassVar[ac.Variable]
    """position of the flanges relative to the support [m]"""
    v: ClassVar[ac.Variable]
    """speed of the flanges relative to the support [m/s]"""
    a: ClassVar[ac.Variable]
    """acceleration of the flanges [m/s2]"""
    f: ClassVar[ac.Variable]
    """friction force [N]"""
    def __init__(self, **modifiers: Any) -> None: ...

class SupportFriction(PartialSupportFriction):
    """Coulomb friction on the support, by a table ``f_pos`` of ``[v, f]`` [m/s, N] for ``v >= 0``."""

    smoothness: ClassVar[ac.Option]
    """interpolation of the table"""
    f_pos: ClassVar[ac.Parameter]
    """rows of speed and friction force"""
    def __init__(
        self,
        *,
        v_small: SupportsFloat | ac.Start = ...,
        peak: SupportsFloat | ac.Start = ...,
        f_pos: SupportsFloat | Iterable[Any] = ...,
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
        v_relfric: ac.Start | Mapping[str, Any] = ...,
        a_relfric: ac.Start | Mapping[str, Any] = ...,
        f0: ac.Start | Mapping[str, Any] = ...,
        f0_max: ac.Start | Mapping[str, Any] = ...,
        s_a: ac.Start | Mapping[str, Any] = ...,
        s_b: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
