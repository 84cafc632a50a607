"""Parts of the examples (`Modelica.Mechanics.Translational.Examples.Utilities`): elements with signals for flanges.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import translational as _translational

__all__ = [
    "DirectMass",
    "GenerateStribeckFrictionTable",
    "InverseMass",
    "Spring",
    "SpringDamper",
    "SpringDamperNoRelativeStates",
]

class DirectMass(ac.Component):
    """A mass driven by ``fDrive`` that gives its motion and takes the force ``f`` of what it drives."""

    m: ClassVar[ac.Parameter]
    """mass [kg]"""
    fDrive: ClassVar[ac.Input]
    """driving force [N]"""
    f: ClassVar[ac.Input]
    """force that the mass gives on [N]"""
    s: ClassVar[ac.Output]
    """position [m]"""
    v: ClassVar[ac.Output]
    """speed [m/s]"""
    a: ClassVar[ac.Output]
    """acceleration [m/s2]"""
    mass: _translational.Mass
    forceSource: _translational.Force
    forceToPosition: _translational.GeneralForceToPositionAdaptor
    def __init__(
        self,
        *,
        m: SupportsFloat | ac.Start = ...,
        fDrive: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class InverseMass(ac.Component):
    """A mass moved as the signals say, and the force ``f`` that this takes."""

    m: ClassVar[ac.Parameter]
    """mass [kg]"""
    s: ClassVar[ac.Input]
    """position [m]"""
    v: ClassVar[ac.Input]
    """speed, consistent with s [m/s]"""
    a: ClassVar[ac.Input]
    """acceleration, consistent with v [m/s2]"""
    f: ClassVar[ac.Output]
    """force that drives the mass [N]"""
    mass: _translational.Mass
    positionToForce: _translational.GeneralPositionToForceAdaptor
    def __init__(
        self,
        *,
        m: SupportsFloat | ac.Start = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Spring(ac.Component):
    """A spring between two positions, and the forces that these take."""

    c: ClassVar[ac.Parameter]
    """spring constant [N/m]"""
    s_rel0: ClassVar[ac.Parameter]
    """unstretched length [m]"""
    s1: ClassVar[ac.Input]
    """position of the left end [m]"""
    f1: ClassVar[ac.Output]
    """force at the left end [N]"""
    s2: ClassVar[ac.Input]
    """position of the right end [m]"""
    f2: ClassVar[ac.Output]
    """force at the right end [N]"""
    spring: _translational.Spring
    positionToForce1: _translational.GeneralPositionToForceAdaptor
    positionToForce2: _translational.GeneralPositionToForceAdaptor
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        s_rel0: SupportsFloat | ac.Start = ...,
        s1: ac.Start | Mapping[str, Any] = ...,
        s2: ac.Start | Mapping[str, Any] = ...,
        f1: ac.Start | Mapping[str, Any] = ...,
        f2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SpringDamper(ac.Component):
    """Spring and damper between two motions, and the forces that these take."""

    c: ClassVar[ac.Parameter]
    """spring constant [N/m]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.s/m]"""
    s_rel0: ClassVar[ac.Parameter]
    """unstretched length [m]"""
    s1: ClassVar[ac.Input]
    """position of the left end [m]"""
    v1: ClassVar[ac.Input]
    """speed of the left end [m/s]"""
    f1: ClassVar[ac.Output]
    """force at the left end [N]"""
    s2: ClassVar[ac.Input]
    """position of the right end [m]"""
    v2: ClassVar[ac.Input]
    """speed of the right end [m/s]"""
    f2: ClassVar[ac.Output]
    """force at the right end [N]"""
    springDamper: SpringDamperNoRelativeStates
    positionToForce1: _translational.GeneralPositionToForceAdaptor
    positionToForce2: _translational.GeneralPositionToForceAdaptor
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        s_rel0: SupportsFloat | ac.Start = ...,
        s1: ac.Start | Mapping[str, Any] = ...,
        v1: ac.Start | Mapping[str, Any] = ...,
        s2: ac.Start | Mapping[str, Any] = ...,
        v2: ac.Start | Mapping[str, Any] = ...,
        f1: ac.Start | Mapping[str, Any] = ...,
        f2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class SpringDamperNoRelativeStates(_translational.PartialCompliant):
    """Spring and damper side by side, without states of their own: ``f = c (s_rel - s_rel0) + d v_rel``."""

    c: ClassVar[ac.Parameter]
    """spring constant [N/m]"""
    d: ClassVar[ac.Parameter]
    """damping constant [N.s/m]"""
    s_rel0: ClassVar[ac.Parameter]
    """unstretched length [m]"""
    v_rel: ClassVar[ac.Variable]
    """relative speed [m/s]"""
    def __init__(
        self,
        *,
        c: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        s_rel0: SupportsFloat | ac.Start = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        s_rel: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        v_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

def GenerateStribeckFrictionTable(
    F_prop: float,
    F_Coulomb: float,
    F_Stribeck: float,
    fexp: float,
    v_max: float,
    nTable: float = ...,
) -> list[list[float]]: ...
