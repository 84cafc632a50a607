"""Magnetic circuits of flux tubes (`Modelica.Magnetic.FluxTubes`).

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import electrical as _electrical
from acausal.components.magnetic.soft_magnetic import (
    AISI_12L14 as AISI_12L14,
    AISI_1008 as AISI_1008,
    DC01 as DC01,
    DC03 as DC03,
    M330_50A as M330_50A,
    M350_50A as M350_50A,
    M530_50A as M530_50A,
    M700_100A as M700_100A,
    M940_100A as M940_100A,
    BaseData as BaseData,
    MuMetall as MuMetall,
    Permenorm3601K3 as Permenorm3601K3,
    RFe80 as RFe80,
    Steel_9SMn28K as Steel_9SMn28K,
    Steel_9SMnPb28 as Steel_9SMnPb28,
    VacoferS2 as VacoferS2,
    Vacoflux50 as Vacoflux50,
    X6Cr17 as X6Cr17,
)

from . import (
    force as force,
    hard_magnetic as hard_magnetic,
    hysteresis_data as hysteresis_data,
    leakage as leakage,
    soft_magnetic as soft_magnetic,
)

__all__ = [
    "AISI_1008",
    "AISI_12L14",
    "BaseData",
    "ConstantMagneticFlux",
    "ConstantMagneticPotentialDifference",
    "ConstantPermeance",
    "ConstantReluctance",
    "Crossing",
    "Cuboid",
    "DC01",
    "DC03",
    "EddyCurrent",
    "ElectroMagneticConverter",
    "ElectroMagneticConverterWithLeakageInductance",
    "FixedShape",
    "GenericFluxTube",
    "GenericHystTellinenEverett",
    "GenericHystTellinenHard",
    "GenericHystTellinenPermanentMagnet",
    "GenericHystTellinenSoft",
    "GenericHystTellinenTable",
    "GenericHysteresis",
    "GenericHysteresisTellinen",
    "GenericLinearPermanentMagnet",
    "Ground",
    "HollowCylinderAxialFlux",
    "HollowCylinderCircumferentialFlux",
    "HollowCylinderRadialFlux",
    "Idle",
    "LeakageWithCoefficient",
    "M330_50A",
    "M350_50A",
    "M530_50A",
    "M700_100A",
    "M940_100A",
    "MagneticFluxSensor",
    "MagneticPort",
    "MagneticPotentialDifferenceSensor",
    "MuMetall",
    "NegativeMagneticPort",
    "Permenorm3601K3",
    "PositiveMagneticPort",
    "RFe80",
    "Reluctance",
    "Short",
    "SignalMagneticFlux",
    "SignalMagneticPotentialDifference",
    "Steel_9SMn28K",
    "Steel_9SMnPb28",
    "Toroid",
    "TwoPort",
    "TwoPortElementary",
    "TwoPortExtended",
    "VacoferS2",
    "Vacoflux50",
    "VariablePermeance",
    "VariableReluctance",
    "X6Cr17",
    "force",
    "hard_magnetic",
    "hysteresis_data",
    "leakage",
    "soft_magnetic",
]

class Crossing(ac.Component):
    """Two branches that cross: ``port_p1`` is joined with ``port_p2``, ``port_n1`` with ``port_n2``."""

    port_p1: MagneticPort
    port_p2: MagneticPort
    port_n1: MagneticPort
    port_n2: MagneticPort
    def __init__(
        self,
        *,
        port_p1: Mapping[str, Any] = ...,
        port_p2: Mapping[str, Any] = ...,
        port_n1: Mapping[str, Any] = ...,
        port_n2: Mapping[str, Any] = ...,
    ) -> None: ...

class Ground(ac.Component):
    """The magnetic potential zero: ``port.V_m = 0``. Every magnetic circuit needs one."""

    port: MagneticPort
    def __init__(self, *, port: Mapping[str, Any] = ...) -> None: ...

class MagneticPort(ac.Connector):
    """Magnetic potential ``V_m`` [A] and flux ``Phi`` [Wb], positive into the component."""

    V_m: ClassVar[ac.Potential]
    """magnetic potential at the port [A]"""
    Phi: ClassVar[ac.Flow]
    """magnetic flux into the port [Wb]"""

class TwoPortElementary(ac.Component):
    """Two magnetic ports, and nothing said about them."""

    port_p: MagneticPort
    port_n: MagneticPort
    def __init__(self, **modifiers: Any) -> None: ...

class MagneticFluxSensor(TwoPortElementary):
    """Flux in a branch: ``Phi = port_p.Phi`` [Wb]; ``port_p.V_m = port_n.V_m``."""

    Phi: ClassVar[ac.Output]
    """magnetic flux from port_p to port_n [Wb]"""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MagneticPotentialDifferenceSensor(TwoPortElementary):
    """Magnetic potential difference: ``V_m = port_p.V_m - port_n.V_m`` [A]; no flux passes."""

    V_m: ClassVar[ac.Output]
    """magnetic potential difference [A]"""
    Phi: ClassVar[ac.Variable]
    """magnetic flux from port_p to port_n, zero [Wb]"""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TwoPortExtended(TwoPortElementary):
    """Two ports with ``V_m = port_p.V_m - port_n.V_m`` [A] and ``Phi = port_p.Phi`` [Wb]."""

    V_m: ClassVar[ac.Variable]
    """magnetic potential difference [A]"""
    Phi: ClassVar[ac.Variable]
    """magnetic flux from port_p to port_n [Wb]"""
    def __init__(self, **modifiers: Any) -> None: ...

class ConstantMagneticFlux(TwoPortElementary):
    """Constant flux from ``port_p`` to ``port_n``: ``Phi = port_p.Phi`` [Wb]."""

    Phi: ClassVar[ac.Parameter]
    """magnetic flux from port_p to port_n [Wb]"""
    V_m: ClassVar[ac.Variable]
    """magnetic potential difference [A]"""
    def __init__(
        self,
        *,
        Phi: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ConstantMagneticPotentialDifference(TwoPortElementary):
    """Constant magnetomotive force: ``V_m = port_p.V_m - port_n.V_m`` [A]."""

    V_m: ClassVar[ac.Parameter]
    """magnetic potential difference [A]"""
    Phi: ClassVar[ac.Variable]
    """magnetic flux from port_p to port_n [Wb]"""
    def __init__(
        self,
        *,
        V_m: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Idle(TwoPortExtended):
    """An interruption: ``Phi = 0`` at both ports."""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SignalMagneticFlux(TwoPortElementary):
    """Flux from a signal ``Phi`` [Wb], from ``port_p`` to ``port_n``: ``Phi = port_p.Phi``."""

    Phi: ClassVar[ac.Input]
    """magnetic flux from port_p to port_n [Wb]"""
    V_m: ClassVar[ac.Variable]
    """magnetic potential difference [A]"""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SignalMagneticPotentialDifference(TwoPortElementary):
    """Magnetomotive force from a signal ``V_m`` [A]: ``V_m = port_p.V_m - port_n.V_m``."""

    V_m: ClassVar[ac.Input]
    """magnetic potential difference [A]"""
    Phi: ClassVar[ac.Variable]
    """magnetic flux from port_p to port_n [Wb]"""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TwoPort(TwoPortExtended):
    """A flux tube: what enters ``port_p`` leaves at ``port_n``. A subclass relates ``V_m`` and ``Phi``."""
    def __init__(self, **modifiers: Any) -> None: ...

class ConstantPermeance(TwoPort):
    """``Phi = G_m V_m``."""

    G_m: ClassVar[ac.Parameter]
    """magnetic permeance [H]"""
    def __init__(
        self,
        *,
        G_m: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ConstantReluctance(TwoPort):
    """``V_m = Phi R_m``."""

    R_m: ClassVar[ac.Parameter]
    """magnetic reluctance [1/H]"""
    def __init__(
        self,
        *,
        R_m: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericLinearPermanentMagnet(TwoPort):
    """Permanent magnet with a straight characteristic: ``B = -B_r + mu_0 mu_r H``."""

    l: ClassVar[ac.Parameter]
    """length in the direction of flux [m]"""
    A: ClassVar[ac.Parameter]
    """cross-section [m2]"""
    mat: ClassVar[ac.Option]
    """hard magnetic material"""
    B_r: ClassVar[ac.Parameter]
    """remanence [T]"""
    mu_r: ClassVar[ac.Parameter]
    """relative permeability"""
    H: ClassVar[ac.Variable]
    """magnetic field strength [A/m]"""
    B: ClassVar[ac.Variable]
    """magnetic flux density [T]"""
    def __init__(
        self,
        *,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        B_r: SupportsFloat | ac.Start = ...,
        mu_r: SupportsFloat | ac.Start = ...,
        mat: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Reluctance(TwoPort):
    """A flux tube with ``V_m = Phi R_m`` and ``R_m = 1/G_m``; a subclass states one of the two."""

    R_m: ClassVar[ac.Variable]
    """magnetic reluctance [1/H]"""
    G_m: ClassVar[ac.Variable]
    """magnetic permeance [H]"""
    def __init__(self, **modifiers: Any) -> None: ...

class Short(TwoPort):
    """A short cut: ``V_m = 0``."""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VariablePermeance(TwoPort):
    """``Phi = G_m V_m`` with the permeance as a signal ``G_m`` [H]."""

    G_m: ClassVar[ac.Input]
    """magnetic permeance [H]"""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VariableReluctance(TwoPort):
    """``V_m = Phi R_m`` with the reluctance as a signal ``R_m`` [1/H]."""

    R_m: ClassVar[ac.Input]
    """magnetic reluctance [1/H]"""
    def __init__(
        self,
        *,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class EddyCurrent(TwoPort, _electrical.ConditionalHeatPort):
    """Eddy current in a conductive flux tube: ``V_m = der(Phi)/R``, ``LossPower = V_m der(Phi)``."""

    T: ClassVar[ac.Parameter]
    """temperature of the device without heat port [K]"""
    useConductance: ClassVar[ac.Option]
    """whether G replaces rho, l and A"""
    G: ClassVar[ac.Parameter]
    """conductance of the path, A/(rho l) [S]"""
    rho: ClassVar[ac.Parameter]
    """resistivity; that of iron at 20 degC [Ohm.m]"""
    l: ClassVar[ac.Parameter]
    """average length of the path [m]"""
    A: ClassVar[ac.Parameter]
    """cross-section of the path [m2]"""
    R: ClassVar[ac.Parameter]
    """resistance of the path, computed [Ohm]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        G: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        R: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        useConductance: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FixedShape(Reluctance):
    """Base: ``V_m = Phi R_m``, ``R_m = 1/G_m``, ``B = Phi/A``, ``H = B/(mu_0 mu_r)``."""

    nonLinearPermeability: ClassVar[ac.Option]
    """whether mu_r depends on B"""
    material: ClassVar[ac.Option]
    """soft magnetic material"""
    mu_rConst: ClassVar[ac.Parameter]
    """relative permeability if it is constant"""
    mu_i: ClassVar[ac.Parameter]
    """relative permeability at B = 0"""
    B_myMax: ClassVar[ac.Parameter]
    """flux density at the greatest permeability [T]"""
    c_a: ClassVar[ac.Parameter]
    """coefficient of mu_r"""
    c_b: ClassVar[ac.Parameter]
    """coefficient of mu_r"""
    n: ClassVar[ac.Parameter]
    """exponent of mu_r"""
    B: ClassVar[ac.Variable]
    """magnetic flux density [T]"""
    A: ClassVar[ac.Variable]
    """cross-section that the flux penetrates [m2]"""
    H: ClassVar[ac.Variable]
    """magnetic field strength [A/m]"""
    mu_r: ClassVar[ac.Variable]
    """relative permeability"""
    def __init__(
        self,
        *,
        mu_rConst: SupportsFloat | ac.Start = ...,
        mu_i: SupportsFloat | ac.Start = ...,
        B_myMax: SupportsFloat | ac.Start = ...,
        c_a: SupportsFloat | ac.Start = ...,
        c_b: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | ac.Start = ...,
        nonLinearPermeability: bool = ...,
        material: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        A: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        mu_r: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericHysteresis(TwoPort, _electrical.ConditionalHeatPort):
    """A prismatic tube whose flux density depends on the past: ``H = V_m/l = Hstat + Heddy``, ``B = Phi/A``."""

    l: ClassVar[ac.Parameter]
    """length in the direction of flux [m]"""
    A: ClassVar[ac.Parameter]
    """cross-section [m2]"""
    includeEddyCurrents: ClassVar[ac.Option]
    """whether there are eddy currents"""
    sigma: ClassVar[ac.Parameter]
    """conductivity of the material [S/m]"""
    d: ClassVar[ac.Parameter]
    """thickness of the sheets [m]"""
    H: ClassVar[ac.Variable]
    """magnetic field strength [A/m]"""
    Hstat: ClassVar[ac.Variable]
    """field strength without eddy currents [A/m]"""
    Heddy: ClassVar[ac.Variable]
    """field strength of eddy currents [A/m]"""
    derHstat: ClassVar[ac.Variable]
    """derivative of Hstat [A/(m.s)]"""
    B: ClassVar[ac.Variable]
    """magnetic flux density [T]"""
    MagRel: ClassVar[ac.Variable]
    """relative magnetization at the start"""
    LossPowerStat: ClassVar[ac.Variable]
    """losses by hysteresis [W]"""
    LossPowerEddy: ClassVar[ac.Variable]
    """losses by eddy currents [W]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        includeEddyCurrents: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        Hstat: ac.Start | Mapping[str, Any] = ...,
        Heddy: ac.Start | Mapping[str, Any] = ...,
        derHstat: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        MagRel: ac.Start | Mapping[str, Any] = ...,
        LossPowerStat: ac.Start | Mapping[str, Any] = ...,
        LossPowerEddy: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LeakageWithCoefficient(Reluctance):
    """Leakage parallel to a useful path: ``(1 - c_usefulFlux) R_m = c_usefulFlux R_mUsefulTot``."""

    c_usefulFlux: ClassVar[ac.Parameter]
    """useful flux over useful and leakage flux"""
    R_mUsefulTot: ClassVar[ac.Input]
    """reluctance of the useful path [1/H]"""
    def __init__(
        self,
        *,
        c_usefulFlux: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        R_mUsefulTot: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Cuboid(FixedShape):
    """Rectangular cross-section: ``A = a b``, ``G_m = mu_0 mu_r A/l``."""

    l: ClassVar[ac.Parameter]
    """length in the direction of flux [m]"""
    a: ClassVar[ac.Parameter]
    """width of the cross-section [m]"""
    b: ClassVar[ac.Parameter]
    """height of the cross-section [m]"""
    def __init__(
        self,
        *,
        mu_rConst: SupportsFloat | ac.Start = ...,
        mu_i: SupportsFloat | ac.Start = ...,
        B_myMax: SupportsFloat | ac.Start = ...,
        c_a: SupportsFloat | ac.Start = ...,
        c_b: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        a: SupportsFloat | ac.Start = ...,
        b: SupportsFloat | ac.Start = ...,
        nonLinearPermeability: bool = ...,
        material: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        A: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        mu_r: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericFluxTube(FixedShape):
    """Any shape: ``A = area``, ``G_m = mu_0 mu_r A/l``."""

    l: ClassVar[ac.Parameter]
    """length in the direction of flux [m]"""
    area: ClassVar[ac.Parameter]
    """cross-section [m2]"""
    def __init__(
        self,
        *,
        mu_rConst: SupportsFloat | ac.Start = ...,
        mu_i: SupportsFloat | ac.Start = ...,
        B_myMax: SupportsFloat | ac.Start = ...,
        c_a: SupportsFloat | ac.Start = ...,
        c_b: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        area: SupportsFloat | ac.Start = ...,
        nonLinearPermeability: bool = ...,
        material: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        A: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        mu_r: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericHysteresisTellinen(GenericHysteresis):
    """Tellinen's model: between the branches ``hystR`` and ``hystF`` of the limiting loop, ``B`` follows their slopes."""

    asc: ClassVar[ac.Discrete]
    """1 while Hstat rises"""
    hystR: ClassVar[ac.Variable]
    """rising branch of the limiting loop [T]"""
    hystF: ClassVar[ac.Variable]
    """falling branch of the limiting loop [T]"""
    diffHyst: ClassVar[ac.Variable]
    """distance of the branches [T]"""
    dHyst: ClassVar[ac.Variable]
    """derivative of the branch's polarization [T/s]"""
    k: ClassVar[ac.Variable]
    """part of it that the flux density follows"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        includeEddyCurrents: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        asc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        Hstat: ac.Start | Mapping[str, Any] = ...,
        Heddy: ac.Start | Mapping[str, Any] = ...,
        derHstat: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        MagRel: ac.Start | Mapping[str, Any] = ...,
        LossPowerStat: ac.Start | Mapping[str, Any] = ...,
        LossPowerEddy: ac.Start | Mapping[str, Any] = ...,
        hystR: ac.Start | Mapping[str, Any] = ...,
        hystF: ac.Start | Mapping[str, Any] = ...,
        diffHyst: ac.Start | Mapping[str, Any] = ...,
        dHyst: ac.Start | Mapping[str, Any] = ...,
        k: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HollowCylinderAxialFlux(FixedShape):
    """Axial flux in a (hollow) cylinder: ``A = pi (r_o**2 - r_i**2)``, ``G_m = mu_0 mu_r A/l``."""

    l: ClassVar[ac.Parameter]
    """axial length [m]"""
    r_i: ClassVar[ac.Parameter]
    """inner radius; zero for a cylinder [m]"""
    r_o: ClassVar[ac.Parameter]
    """outer radius [m]"""
    def __init__(
        self,
        *,
        mu_rConst: SupportsFloat | ac.Start = ...,
        mu_i: SupportsFloat | ac.Start = ...,
        B_myMax: SupportsFloat | ac.Start = ...,
        c_a: SupportsFloat | ac.Start = ...,
        c_b: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        r_i: SupportsFloat | ac.Start = ...,
        r_o: SupportsFloat | ac.Start = ...,
        nonLinearPermeability: bool = ...,
        material: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        A: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        mu_r: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HollowCylinderCircumferentialFlux(FixedShape):
    """Flux around a hollow cylinder: ``A = l (r_o - r_i)``, ``G_m = mu_0 mu_r A/(alpha (r_o + r_i)/2)``."""

    l: ClassVar[ac.Parameter]
    """axial length, orthogonal to the flux [m]"""
    r_i: ClassVar[ac.Parameter]
    """inner radius [m]"""
    r_o: ClassVar[ac.Parameter]
    """outer radius [m]"""
    alpha: ClassVar[ac.Parameter]
    """central angle [rad]"""
    def __init__(
        self,
        *,
        mu_rConst: SupportsFloat | ac.Start = ...,
        mu_i: SupportsFloat | ac.Start = ...,
        B_myMax: SupportsFloat | ac.Start = ...,
        c_a: SupportsFloat | ac.Start = ...,
        c_b: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        r_i: SupportsFloat | ac.Start = ...,
        r_o: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        nonLinearPermeability: bool = ...,
        material: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        A: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        mu_r: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HollowCylinderRadialFlux(FixedShape):
    """Radial flux in a hollow cylinder or a sector of it: ``G_m = mu_0 mu_r alpha l/log(r_o/r_i)``."""

    l: ClassVar[ac.Parameter]
    """axial length, orthogonal to the flux [m]"""
    r_i: ClassVar[ac.Parameter]
    """inner radius [m]"""
    r_o: ClassVar[ac.Parameter]
    """outer radius [m]"""
    alpha: ClassVar[ac.Parameter]
    """central angle [rad]"""
    def __init__(
        self,
        *,
        mu_rConst: SupportsFloat | ac.Start = ...,
        mu_i: SupportsFloat | ac.Start = ...,
        B_myMax: SupportsFloat | ac.Start = ...,
        c_a: SupportsFloat | ac.Start = ...,
        c_b: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        r_i: SupportsFloat | ac.Start = ...,
        r_o: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        nonLinearPermeability: bool = ...,
        material: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        A: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        mu_r: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Toroid(FixedShape):
    """Flux around a toroid with a circular cross-section: ``A = pi d**2/4``, ``G_m = mu_0 mu_r A/(r alpha)``."""

    r: ClassVar[ac.Parameter]
    """mean radius of the toroid [m]"""
    d: ClassVar[ac.Parameter]
    """diameter of the core [m]"""
    alpha: ClassVar[ac.Parameter]
    """central angle [rad]"""
    def __init__(
        self,
        *,
        mu_rConst: SupportsFloat | ac.Start = ...,
        mu_i: SupportsFloat | ac.Start = ...,
        B_myMax: SupportsFloat | ac.Start = ...,
        c_a: SupportsFloat | ac.Start = ...,
        c_b: SupportsFloat | ac.Start = ...,
        n: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        nonLinearPermeability: bool = ...,
        material: Any = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        R_m: ac.Start | Mapping[str, Any] = ...,
        G_m: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        A: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        mu_r: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ElectroMagneticConverter(_electrical.OnePort, TwoPort):
    """Ideal coil of ``N`` turns: ``V_m = N i``, ``N der(Phi) = -v``."""

    i: ClassVar[ac.Variable]
    """current from p to n [A]"""
    N: ClassVar[ac.Parameter]
    """number of turns"""
    Psi: ClassVar[ac.Variable]
    """flux linkage [Wb]"""
    L_stat: ClassVar[ac.Variable]
    """static inductance [H]"""
    def __init__(
        self,
        *,
        N: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        Psi: ac.Start | Mapping[str, Any] = ...,
        L_stat: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ElectroMagneticConverterWithLeakageInductance(_electrical.OnePort, TwoPort):
    """Coil with a leakage path: ``Phi = Phi_ind + Phi_leak``, ``Phi_leak = G_m V_m``."""

    Phi: ClassVar[ac.Variable]
    """whole magnetic flux [Wb]"""
    i: ClassVar[ac.Variable]
    """current from p to n [A]"""
    N: ClassVar[ac.Parameter]
    """number of turns"""
    Psi: ClassVar[ac.Variable]
    """flux linkage [Wb]"""
    L_stat: ClassVar[ac.Variable]
    """static inductance [H]"""
    L: ClassVar[ac.Parameter]
    """length of the leakage path [m]"""
    A: ClassVar[ac.Parameter]
    """cross-section of the leakage path [m2]"""
    mu_rel: ClassVar[ac.Parameter]
    """relative permeability of the leakage path"""
    G_m: ClassVar[ac.Parameter]
    """permeance of the leakage path, computed [H]"""
    Phi_ind: ClassVar[ac.Variable]
    """flux that the coil links [Wb]"""
    Phi_leak: ClassVar[ac.Variable]
    """flux of the leakage path [Wb]"""
    def __init__(
        self,
        *,
        N: SupportsFloat | ac.Start = ...,
        L: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        mu_rel: SupportsFloat | ac.Start = ...,
        G_m: SupportsFloat | ac.Start = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        Psi: ac.Start | Mapping[str, Any] = ...,
        L_stat: ac.Start | Mapping[str, Any] = ...,
        Phi_ind: ac.Start | Mapping[str, Any] = ...,
        Phi_leak: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericHystTellinenEverett(GenericHysteresisTellinen):
    """The limiting loop by the Everett function of a material, see `hysteresis_data.Everett`."""

    sigma: ClassVar[ac.Parameter]
    """conductivity [S/m]"""
    mat: ClassVar[ac.Option]
    """material, a hysteresis_data.Everett"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        includeEddyCurrents: bool = ...,
        mat: Any = ...,
        heatPort: Mapping[str, Any] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        asc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        Hstat: ac.Start | Mapping[str, Any] = ...,
        Heddy: ac.Start | Mapping[str, Any] = ...,
        derHstat: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        MagRel: ac.Start | Mapping[str, Any] = ...,
        LossPowerStat: ac.Start | Mapping[str, Any] = ...,
        LossPowerEddy: ac.Start | Mapping[str, Any] = ...,
        hystR: ac.Start | Mapping[str, Any] = ...,
        hystF: ac.Start | Mapping[str, Any] = ...,
        diffHyst: ac.Start | Mapping[str, Any] = ...,
        dHyst: ac.Start | Mapping[str, Any] = ...,
        k: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericHystTellinenHard(GenericHysteresisTellinen):
    """Hard magnetic: the branches are ``Br tanh(M H -+ H0)``, such that ``B = 0`` at ``H = +-Hc``."""

    Br: ClassVar[ac.Parameter]
    """remanence [T]"""
    Hc: ClassVar[ac.Parameter]
    """coercivity [A/m]"""
    M: ClassVar[ac.Parameter]
    """slope of the branches [m/A]"""
    K: ClassVar[ac.Parameter]
    """slope in saturation over mu_0"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        Br: SupportsFloat | ac.Start = ...,
        Hc: SupportsFloat | ac.Start = ...,
        M: SupportsFloat | ac.Start = ...,
        K: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        includeEddyCurrents: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        asc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        Hstat: ac.Start | Mapping[str, Any] = ...,
        Heddy: ac.Start | Mapping[str, Any] = ...,
        derHstat: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        MagRel: ac.Start | Mapping[str, Any] = ...,
        LossPowerStat: ac.Start | Mapping[str, Any] = ...,
        LossPowerEddy: ac.Start | Mapping[str, Any] = ...,
        hystR: ac.Start | Mapping[str, Any] = ...,
        hystF: ac.Start | Mapping[str, Any] = ...,
        diffHyst: ac.Start | Mapping[str, Any] = ...,
        dHyst: ac.Start | Mapping[str, Any] = ...,
        k: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericHystTellinenSoft(GenericHysteresisTellinen):
    """Soft magnetic: the branches are ``Js tanh((Hstat -+ Hc) H0/Hc)`` with ``tanh(H0) = Br/Js``."""

    Js: ClassVar[ac.Parameter]
    """saturation polarization [T]"""
    Br: ClassVar[ac.Parameter]
    """remanence [T]"""
    Hc: ClassVar[ac.Parameter]
    """coercivity [A/m]"""
    K: ClassVar[ac.Parameter]
    """slope in saturation over mu_0"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        Js: SupportsFloat | ac.Start = ...,
        Br: SupportsFloat | ac.Start = ...,
        Hc: SupportsFloat | ac.Start = ...,
        K: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        includeEddyCurrents: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        asc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        Hstat: ac.Start | Mapping[str, Any] = ...,
        Heddy: ac.Start | Mapping[str, Any] = ...,
        derHstat: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        MagRel: ac.Start | Mapping[str, Any] = ...,
        LossPowerStat: ac.Start | Mapping[str, Any] = ...,
        LossPowerEddy: ac.Start | Mapping[str, Any] = ...,
        hystR: ac.Start | Mapping[str, Any] = ...,
        hystF: ac.Start | Mapping[str, Any] = ...,
        diffHyst: ac.Start | Mapping[str, Any] = ...,
        dHyst: ac.Start | Mapping[str, Any] = ...,
        k: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericHystTellinenTable(GenericHysteresisTellinen):
    """The limiting loop by tables, `hysteresis_data.LoopTable`, interpolated by Akima's splines."""

    sigma: ClassVar[ac.Parameter]
    """conductivity [S/m]"""
    mat: ClassVar[ac.Option]
    """material, a hysteresis_data.LoopTable"""
    K: ClassVar[ac.Parameter]
    """slope in saturation over mu_0"""
    tabris: ClassVar[ac.Module]
    tabfal: ClassVar[ac.Module]
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        K: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        includeEddyCurrents: bool = ...,
        mat: Any = ...,
        tabris: Callable[..., Any] = ...,
        tabfal: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        asc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        Hstat: ac.Start | Mapping[str, Any] = ...,
        Heddy: ac.Start | Mapping[str, Any] = ...,
        derHstat: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        MagRel: ac.Start | Mapping[str, Any] = ...,
        LossPowerStat: ac.Start | Mapping[str, Any] = ...,
        LossPowerEddy: ac.Start | Mapping[str, Any] = ...,
        hystR: ac.Start | Mapping[str, Any] = ...,
        hystF: ac.Start | Mapping[str, Any] = ...,
        diffHyst: ac.Start | Mapping[str, Any] = ...,
        dHyst: ac.Start | Mapping[str, Any] = ...,
        k: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GenericHystTellinenPermanentMagnet(GenericHystTellinenHard):
    """A permanent magnet that can lose its magnetization: it starts with ``MagRel = -1``."""

    MagRel: ClassVar[ac.Variable]
    """relative magnetization at the start"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        l: SupportsFloat | ac.Start = ...,
        A: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        Br: SupportsFloat | ac.Start = ...,
        Hc: SupportsFloat | ac.Start = ...,
        M: SupportsFloat | ac.Start = ...,
        K: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        includeEddyCurrents: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        port_p: Mapping[str, Any] = ...,
        port_n: Mapping[str, Any] = ...,
        asc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        V_m: ac.Start | Mapping[str, Any] = ...,
        Phi: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        Hstat: ac.Start | Mapping[str, Any] = ...,
        Heddy: ac.Start | Mapping[str, Any] = ...,
        derHstat: ac.Start | Mapping[str, Any] = ...,
        B: ac.Start | Mapping[str, Any] = ...,
        MagRel: ac.Start | Mapping[str, Any] = ...,
        LossPowerStat: ac.Start | Mapping[str, Any] = ...,
        LossPowerEddy: ac.Start | Mapping[str, Any] = ...,
        hystR: ac.Start | Mapping[str, Any] = ...,
        hystF: ac.Start | Mapping[str, Any] = ...,
        diffHyst: ac.Start | Mapping[str, Any] = ...,
        dHyst: ac.Start | Mapping[str, Any] = ...,
        k: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

NegativeMagneticPort = MagneticPort
PositiveMagneticPort = MagneticPort
