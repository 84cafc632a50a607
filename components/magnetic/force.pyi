"""Flux tubes whose shape changes with an armature's position, and which therefore pull at it.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, Literal, SupportsFloat

import acausal as ac
from acausal.components import magnetic as _magnetic, translational as _translational

__all__ = [
    "CuboidOrthogonalFlux",
    "CuboidParallelFlux",
    "Force",
    "HollowCylinderAxialFlux",
    "HollowCylinderRadialFlux",
    "LeakageAroundPoles",
]

class Force(_magnetic.Reluctance):
    """Base: ``V_m = Phi R_m``, and the reluctance force ``F_m = V_m**2 dGmBydx/2 = -flange.f`` [N]."""

    useSupport: ClassVar[ac.Option]
    """whether there is a support flange; else fixed at 0"""
    dlBydx: ClassVar[ac.Option]
    """derivative of l by the armature's position"""
    flange: _translational.Flange
    support: _translational.Flange
    F_m: ClassVar[ac.Variable]
    """reluctance force [N]"""
    s: ClassVar[ac.Variable]
    """distance between flange and support [m]"""
    l: ClassVar[ac.Variable]
    """length that varies [m]"""
    dGmBydx: ClassVar[ac.Variable]
    """derivative of the permeance by the armature's position [H/m]"""
    def __init__(
        self,
        *,
        useSupport: bool = ...,
        dlBydx: Literal[1, -1] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        F_m: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        l: ac.Start | Mapping[str, Any] = ...,
        dGmBydx: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LeakageAroundPoles(Force):
    """Leakage around poles at the distance ``l``: ``G_m = mu_0 w/pi log(1 + pi r/l)``."""

    w: ClassVar[ac.Parameter]
    """width; the mean circumference of round poles [m]"""
    r: ClassVar[ac.Parameter]
    """radius of the leakage field [m]"""
    mu_r: ClassVar[ac.Option]
    """without effect: the field is in air"""
    def __init__(
        self,
        *,
        w: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        dlBydx: Literal[1, -1] = ...,
        mu_r: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        F_m: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        l: ac.Start | Mapping[str, Any] = ...,
        dGmBydx: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CuboidOrthogonalFlux(Force):
    """Cuboid with the flux across the motion: ``G_m = mu_0 mu_r A/b``, ``A = a l``, ``B = Phi/A``."""

    mu_r: ClassVar[ac.Parameter]
    """relative permeability"""
    a: ClassVar[ac.Parameter]
    """width of the cross-section [m]"""
    b: ClassVar[ac.Parameter]
    """height, in the direction of flux [m]"""
    B: ClassVar[ac.Variable]
    """flux density [T]"""
    def __init__(
        self,
        *,
        mu_r: SupportsFloat | ac.Start = ...,
        a: SupportsFloat | ac.Start = ...,
        b: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        dlBydx: Literal[1, -1] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        F_m: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        l: ac.Start | Mapping[str, Any] = ...,
        dGmBydx: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CuboidParallelFlux(Force):
    """Cuboid with the flux along the motion: ``G_m = mu_0 mu_r A/l``, ``A = a b``, ``B = Phi/A``."""

    mu_r: ClassVar[ac.Parameter]
    """relative permeability"""
    a: ClassVar[ac.Parameter]
    """width of the cross-section [m]"""
    b: ClassVar[ac.Parameter]
    """height of the cross-section [m]"""
    B: ClassVar[ac.Variable]
    """flux density [T]"""
    def __init__(
        self,
        *,
        mu_r: SupportsFloat | ac.Start = ...,
        a: SupportsFloat | ac.Start = ...,
        b: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        dlBydx: Literal[1, -1] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        F_m: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        l: ac.Start | Mapping[str, Any] = ...,
        dGmBydx: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HollowCylinderAxialFlux(Force):
    """Axial flux in a (hollow) cylinder of the length ``l``: ``G_m = mu_0 mu_r A/l``, ``B = Phi/A``."""

    mu_r: ClassVar[ac.Parameter]
    """relative permeability"""
    r_i: ClassVar[ac.Parameter]
    """inner radius [m]"""
    r_o: ClassVar[ac.Parameter]
    """outer radius [m]"""
    B: ClassVar[ac.Variable]
    """flux density [T]"""
    def __init__(
        self,
        *,
        mu_r: SupportsFloat | ac.Start = ...,
        r_i: SupportsFloat | ac.Start = ...,
        r_o: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        dlBydx: Literal[1, -1] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        F_m: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        l: ac.Start | Mapping[str, Any] = ...,
        dGmBydx: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HollowCylinderRadialFlux(Force):
    """Radial flux in a hollow cylinder of the length ``l``: ``G_m = 2 pi mu_0 mu_r l/log(r_o/r_i)``."""

    mu_r: ClassVar[ac.Parameter]
    """relative permeability"""
    r_i: ClassVar[ac.Parameter]
    """inner radius [m]"""
    r_o: ClassVar[ac.Parameter]
    """outer radius [m]"""
    B_avg: ClassVar[ac.Variable]
    """flux density at the mean radius [T]"""
    def __init__(
        self,
        *,
        mu_r: SupportsFloat | ac.Start = ...,
        r_i: SupportsFloat | ac.Start = ...,
        r_o: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        dlBydx: Literal[1, -1] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        F_m: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        l: ac.Start | Mapping[str, Any] = ...,
        dGmBydx: ac.Start | Mapping[str, Any] = ...,
        B_avg: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
