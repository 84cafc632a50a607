"""Leakage flux tubes in air, of simple shapes: ``V_m = Phi R_m``, ``R_m = 1/G_m`` (Roters 1941).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import magnetic as _magnetic

__all__ = [
    "CoaxCylindersEndFaces",
    "EighthOfHollowSphere",
    "EighthOfSphere",
    "HalfCylinder",
    "HalfHollowCylinder",
    "Leakage",
    "QuarterCylinder",
    "QuarterHollowCylinder",
    "QuarterHollowSphere",
    "QuarterSphere",
]

class Leakage(_magnetic.Reluctance):
    """Base: ``G_m`` [H] is ``mu_0`` times a length, which a subclass knows."""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class CoaxCylindersEndFaces(Leakage):
    """Between the end planes of a cylinder and a coaxial hollow cylinder around it."""

    r_0: ClassVar[ac.Parameter]
    """radius of the inner cylinder [m]"""
    r_1: ClassVar[ac.Parameter]
    """inner radius of the outer cylinder [m]"""
    r_2: ClassVar[ac.Parameter]
    """outer radius of the outer cylinder [m]"""
    l_g: ClassVar[ac.Parameter]
    """gap, computed [m]"""
    t: ClassVar[ac.Parameter]
    """thickness, computed [m]"""
    def __init__(
        self,
        *,
        r_0: SupportsFloat | ac.Start = ...,
        r_1: SupportsFloat | ac.Start = ...,
        r_2: SupportsFloat | ac.Start = ...,
        l_g: SupportsFloat | ac.Start = ...,
        t: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class EighthOfHollowSphere(Leakage):
    """From an edge to the opposite plane of an eighth of a hollow sphere: ``G_m = 0.5 mu_0 t``."""

    t: ClassVar[ac.Parameter]
    """thickness of the shell [m]"""
    def __init__(
        self,
        *,
        t: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class EighthOfSphere(Leakage):
    """From an edge to the opposite plane of an eighth of a sphere: ``G_m = 0.308 mu_0 r``."""

    r: ClassVar[ac.Parameter]
    """radius [m]"""
    def __init__(
        self,
        *,
        r: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class QuarterHollowSphere(Leakage):
    """Between the edges of a quarter hollow sphere: ``G_m = 0.25 mu_0 t``."""

    t: ClassVar[ac.Parameter]
    """thickness of the shell [m]"""
    def __init__(
        self,
        *,
        t: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class QuarterSphere(Leakage):
    """Between the corners of a quarter sphere: ``G_m = 0.077 mu_0 2 r``."""

    r: ClassVar[ac.Parameter]
    """radius [m]"""
    def __init__(
        self,
        *,
        r: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HalfCylinder(Leakage):
    """Between the edges of a half cylinder: ``G_m = 0.26 mu_0 l``."""

    l: ClassVar[ac.Parameter]
    """axial length, orthogonal to the flux; 2 pi r of a round pole [m]"""
    def __init__(
        self,
        *,
        l: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HalfHollowCylinder(Leakage):
    """Around a half hollow cylinder: ``G_m = mu_0 l log(1 + ratio)/pi``."""

    l: ClassVar[ac.Parameter]
    """axial length, orthogonal to the flux; 2 pi r of a round pole [m]"""
    ratio: ClassVar[ac.Parameter]
    """thickness over inner radius"""
    def __init__(
        self,
        *,
        ratio: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class QuarterCylinder(Leakage):
    """From an edge to the opposite plane through a quarter cylinder: ``G_m = 0.52 mu_0 l``."""

    l: ClassVar[ac.Parameter]
    """axial length, orthogonal to the flux; 2 pi r of a round pole [m]"""
    def __init__(
        self,
        *,
        l: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class QuarterHollowCylinder(Leakage):
    """Around a quarter of a hollow cylinder: ``G_m = 2 mu_0 l log(1 + ratio)/pi``."""

    l: ClassVar[ac.Parameter]
    """axial length, orthogonal to the flux; 2 pi r of a round pole [m]"""
    ratio: ClassVar[ac.Parameter]
    """thickness over inner radius"""
    def __init__(
        self,
        *,
        ratio: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
