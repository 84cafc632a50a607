"""Hydraulics of one liquid, without heat: tanks, orifices, weirs, pipes, valves, pumps; volumes, tubes, cylinders.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex

import acausal as ac
from acausal.components import translational as _translational

from . import flow as flow, liquid as liquid

__all__ = [
    "Actuator",
    "Boundary",
    "Boundary_pT",
    "DynamicVolume",
    "FixedBoundary",
    "FixedVolume",
    "FluidPort",
    "FluidPort_a",
    "FluidPort_b",
    "LinearResistance",
    "MassFlowRate",
    "MassFlowSource",
    "MassFlowSource_T",
    "OpenTank",
    "Orifice",
    "PartialFlowSensor",
    "PartialTwoPortTransport",
    "PrescribedPump",
    "Pressure",
    "RelativePressure",
    "SpoolValve",
    "SpoolValve2Way",
    "StaticHead",
    "StaticPipe",
    "Tube",
    "TubeSegment",
    "Valve",
    "ValveIncompressible",
    "ValveLinear",
    "VolumeFlowRate",
    "Weir",
    "flow",
    "liquid",
]

class Boundary(ac.Component):
    """An infinite reservoir: ``port.p = p`` [Pa], whatever the flow."""

    use_p_in: ClassVar[ac.Option]
    """whether the pressure is a signal"""
    p: ClassVar[ac.Parameter]
    """pressure [Pa]"""
    p_in: ClassVar[ac.Input]
    """pressure [Pa]"""
    port: FluidPort
    def __init__(
        self,
        *,
        p: SupportsFloat | ac.Start = ...,
        use_p_in: bool = ...,
        port: Mapping[str, Any] = ...,
        p_in: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FluidPort(ac.Connector):
    """Pressure ``p`` [Pa] and mass flow rate ``m_flow`` [kg/s], positive into the component."""

    p: ClassVar[ac.Potential]
    """pressure [Pa]"""
    m_flow: ClassVar[ac.Flow]
    """mass flow rate [kg/s]"""

class MassFlowSource(ac.Component):
    """A given mass flow rate into what is connected, whatever the pressure: ``port.m_flow = -m_flow`` [kg/s]."""

    use_m_flow_in: ClassVar[ac.Option]
    """whether the mass flow rate is a signal"""
    m_flow: ClassVar[ac.Parameter]
    """mass flow rate [kg/s]"""
    m_flow_in: ClassVar[ac.Input]
    """mass flow rate [kg/s]"""
    port: FluidPort
    def __init__(
        self,
        *,
        m_flow: SupportsFloat | ac.Start = ...,
        use_m_flow_in: bool = ...,
        port: Mapping[str, Any] = ...,
        m_flow_in: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OpenTank(ac.Component):
    """A tank that is open to the air, with a port at the bottom and one above the liquid."""

    crossArea: ClassVar[ac.Parameter]
    """cross section of the tank [m2]"""
    rho: ClassVar[ac.Parameter]
    """density of the liquid [kg/m3]"""
    g: ClassVar[ac.Parameter]
    """gravity [m/s2]"""
    p_ambient: ClassVar[ac.Parameter]
    """pressure of the air [Pa]"""
    level: ClassVar[ac.Output]
    """level of the liquid above the bottom [m]"""
    port: FluidPort
    topPort: FluidPort
    def __init__(
        self,
        *,
        crossArea: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        p_ambient: SupportsFloat | ac.Start = ...,
        port: Mapping[str, Any] = ...,
        topPort: Mapping[str, Any] = ...,
        level: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialTwoPortTransport(ac.Component):
    """Two fluid ports with a flow between them, and no storage."""

    port_a: FluidPort
    port_b: FluidPort
    dp: ClassVar[ac.Variable]
    """pressure drop from a to b [Pa]"""
    m_flow: ClassVar[ac.Variable]
    """mass flow rate from a to b [kg/s]"""
    def __init__(self, **modifiers: Any) -> None: ...

class Pressure(ac.Component):
    """Pressure ``p = port.p`` [Pa]."""

    port: FluidPort
    p: ClassVar[ac.Output]
    """pressure at the port [Pa]"""
    def __init__(
        self, *, port: Mapping[str, Any] = ..., p: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class RelativePressure(ac.Component):
    """Pressure drop ``p_rel = port_a.p - port_b.p`` [Pa]."""

    port_a: FluidPort
    port_b: FluidPort
    p_rel: ClassVar[ac.Output]
    """pressure drop from a to b [Pa]"""
    def __init__(
        self,
        *,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        p_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Actuator(ac.Component):
    """A cylinder: a piston of the mass ``m`` between two chambers."""

    fluid: ClassVar[ac.Option]
    """the liquid, a hydraulic.liquid.Liquid"""
    area_a: ClassVar[ac.Parameter]
    """area of the piston in chamber a [m2]"""
    area_b: ClassVar[ac.Parameter]
    """area in chamber b [m2]"""
    length_a: ClassVar[ac.Parameter]
    """length of chamber a where s = 0 [m]"""
    length_b: ClassVar[ac.Parameter]
    """that of chamber b [m]"""
    m: ClassVar[ac.Parameter]
    """mass of the piston [kg]"""
    d: ClassVar[ac.Parameter]
    """damping of the seal [N.s/m]"""
    port_a: FluidPort
    port_b: FluidPort
    flange: _translational.Flange
    chamber_a: DynamicVolume
    chamber_b: DynamicVolume
    piston: _translational.Mass
    seal: _translational.Damper
    housing: _translational.Fixed
    def __init__(
        self,
        *,
        area_a: SupportsFloat | ac.Start = ...,
        length_a: SupportsFloat | ac.Start = ...,
        area_b: SupportsFloat | ac.Start = ...,
        length_b: SupportsFloat | ac.Start = ...,
        m: SupportsFloat | ac.Start = ...,
        d: SupportsFloat | ac.Start = ...,
        fluid: Any = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Boundary_pT(Boundary):
    """A `Boundary`; there is no temperature."""
    def __init__(
        self,
        *,
        p: SupportsFloat | ac.Start = ...,
        use_p_in: bool = ...,
        port: Mapping[str, Any] = ...,
        p_in: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FixedBoundary(Boundary):
    """A `Boundary`."""
    def __init__(
        self,
        *,
        p: SupportsFloat | ac.Start = ...,
        use_p_in: bool = ...,
        port: Mapping[str, Any] = ...,
        p_in: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class LinearResistance(PartialTwoPortTransport):
    """Laminar flow: ``m_flow = k dp``."""

    k: ClassVar[ac.Parameter]
    """hydraulic conductance [kg/(s.Pa)]"""
    def __init__(
        self,
        *,
        k: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MassFlowSource_T(MassFlowSource):
    """A `MassFlowSource`; there is no temperature."""
    def __init__(
        self,
        *,
        m_flow: SupportsFloat | ac.Start = ...,
        use_m_flow_in: bool = ...,
        port: Mapping[str, Any] = ...,
        m_flow_in: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Orifice(PartialTwoPortTransport):
    """A sharp hole, in both directions: ``m_flow = C_d area sqrt(2 rho |dp|) sign(dp)``."""

    area: ClassVar[ac.Parameter]
    """cross section of the hole [m2]"""
    C_d: ClassVar[ac.Parameter]
    """discharge coefficient"""
    rho: ClassVar[ac.Parameter]
    """density of the liquid [kg/m3]"""
    dp_small: ClassVar[ac.Parameter]
    """pressure drop around which flow reverses [Pa]"""
    def __init__(
        self,
        *,
        area: SupportsFloat | ac.Start = ...,
        C_d: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        dp_small: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialFlowSensor(PartialTwoPortTransport):
    """What flow sensors share: the liquid passes without a pressure drop, ``dp = 0``."""
    def __init__(self, **modifiers: Any) -> None: ...

class PrescribedPump(PartialTwoPortTransport):
    """A centrifugal pump: ``head = r**2 (c1 + c2 V/r + c3 (V/r)**2)``, ``r = N/N_nominal``, through three points."""

    V_flow_nominal: ClassVar[ac.Option]
    """three volume flow rates in m3/s"""
    head_nominal: ClassVar[ac.Option]
    """the heads in m there"""
    N_nominal: ClassVar[ac.Parameter]
    """speed there [1/min]"""
    N_const: ClassVar[ac.Parameter]
    """constant speed [1/min]"""
    use_N_in: ClassVar[ac.Option]
    """whether the speed is a signal"""
    N_in: ClassVar[ac.Input]
    """speed [1/min]"""
    rho: ClassVar[ac.Parameter]
    """density of the liquid [kg/m3]"""
    g: ClassVar[ac.Parameter]
    """gravity [m/s2]"""
    head: ClassVar[ac.Variable]
    """head that the pump gives [m]"""
    V_flow: ClassVar[ac.Variable]
    """volume flow rate [m3/s]"""
    def __init__(
        self,
        *,
        N_nominal: SupportsFloat | ac.Start = ...,
        N_const: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        V_flow_nominal: Any = ...,
        head_nominal: Any = ...,
        use_N_in: bool = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        N_in: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
        head: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SpoolValve2Way(ac.Component):
    """A spool between four edges: for ``flange.s > 0`` from ``port_s`` to ``port_a`` and from ``port_b`` to ``port_r``."""

    fluid: ClassVar[ac.Option]
    """the liquid, a hydraulic.liquid.Liquid"""
    width: ClassVar[ac.Parameter]
    """width of the openings [m]"""
    C_d: ClassVar[ac.Parameter]
    """discharge coefficient"""
    overlap: ClassVar[ac.Parameter]
    """way of the spool until an edge opens [m]"""
    area_least: ClassVar[ac.Parameter]
    """area of the leak of a closed edge [m2]"""
    port_s: FluidPort
    port_r: FluidPort
    port_a: FluidPort
    port_b: FluidPort
    flange: _translational.Flange
    supply_a: SpoolValve
    return_b: SpoolValve
    supply_b: SpoolValve
    return_a: SpoolValve
    def __init__(
        self,
        *,
        width: SupportsFloat | ac.Start = ...,
        C_d: SupportsFloat | ac.Start = ...,
        overlap: SupportsFloat | ac.Start = ...,
        area_least: SupportsFloat | ac.Start = ...,
        fluid: Any = ...,
        port_s: Mapping[str, Any] = ...,
        port_r: Mapping[str, Any] = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class StaticHead(PartialTwoPortTransport):
    """A difference in height without friction: ``dp = rho g height_ab``."""

    height_ab: ClassVar[ac.Parameter]
    """height of port_b above port_a [m]"""
    rho: ClassVar[ac.Parameter]
    """density of the liquid [kg/m3]"""
    g: ClassVar[ac.Parameter]
    """gravity [m/s2]"""
    def __init__(
        self,
        *,
        height_ab: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class StaticPipe(PartialTwoPortTransport):
    """Friction at the wall (Darcy and Weisbach, see `hydraulic.flow`) and a difference in height, without storage."""

    length: ClassVar[ac.Parameter]
    """length [m]"""
    diameter: ClassVar[ac.Parameter]
    """inner diameter [m]"""
    height_ab: ClassVar[ac.Parameter]
    """height of port_b above port_a [m]"""
    roughness: ClassVar[ac.Parameter]
    """height of the wall's unevenness [m]"""
    nParallel: ClassVar[ac.Parameter]
    """number of equal pipes in parallel"""
    rho: ClassVar[ac.Parameter]
    """density of the liquid [kg/m3]"""
    mu: ClassVar[ac.Parameter]
    """dynamic viscosity of the liquid [Pa.s]"""
    g: ClassVar[ac.Parameter]
    """gravity [m/s2]"""
    v: ClassVar[ac.Variable]
    """mean velocity from a to b [m/s]"""
    def __init__(
        self,
        *,
        length: SupportsFloat | ac.Start = ...,
        diameter: SupportsFloat | ac.Start = ...,
        height_ab: SupportsFloat | ac.Start = ...,
        roughness: SupportsFloat | ac.Start = ...,
        nParallel: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        mu: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Tube(ac.Component):
    """A tube of ``n`` pieces with friction at the wall, inertia and the liquid's elasticity."""

    fluid: ClassVar[ac.Option]
    """the liquid, a hydraulic.liquid.Liquid"""
    length: ClassVar[ac.Parameter]
    """length [m]"""
    diameter: ClassVar[ac.Parameter]
    """inner diameter [m]"""
    roughness: ClassVar[ac.Parameter]
    """height of the wall's unevenness [m]"""
    n: ClassVar[ac.Option]
    """number of pieces"""
    inertia: ClassVar[ac.Option]
    """whether the liquid's mass counts"""
    port_a: FluidPort
    port_b: FluidPort
    segment: list[TubeSegment]
    volume: list[FixedVolume]
    def __init__(
        self,
        *,
        length: SupportsFloat | ac.Start = ...,
        diameter: SupportsFloat | ac.Start = ...,
        roughness: SupportsFloat | ac.Start = ...,
        fluid: Any = ...,
        n: SupportsIndex = ...,
        inertia: bool = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class ValveIncompressible(PartialTwoPortTransport):
    """``m_flow = opening Av sqrt(rho |dp|) sign(dp)`` with the flow coefficient ``Av`` [m2]."""

    dp_nominal: ClassVar[ac.Parameter]
    """pressure drop where it is fully open [Pa]"""
    m_flow_nominal: ClassVar[ac.Parameter]
    """mass flow rate then [kg/s]"""
    rho: ClassVar[ac.Parameter]
    """density of the liquid [kg/m3]"""
    Av: ClassVar[ac.Parameter]
    """flow coefficient [m2]"""
    dp_small: ClassVar[ac.Parameter]
    """pressure drop around which flow reverses [Pa]"""
    opening: ClassVar[ac.Input]
    """opening, 0 to 1"""
    def __init__(
        self,
        *,
        dp_nominal: SupportsFloat | ac.Start = ...,
        m_flow_nominal: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        Av: SupportsFloat | ac.Start = ...,
        dp_small: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        opening: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ValveLinear(PartialTwoPortTransport):
    """``m_flow = opening m_flow_nominal/dp_nominal dp``."""

    dp_nominal: ClassVar[ac.Parameter]
    """pressure drop where it is fully open [Pa]"""
    m_flow_nominal: ClassVar[ac.Parameter]
    """mass flow rate then [kg/s]"""
    opening: ClassVar[ac.Input]
    """opening, 0 to 1"""
    def __init__(
        self,
        *,
        dp_nominal: SupportsFloat | ac.Start = ...,
        m_flow_nominal: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        opening: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Weir(PartialTwoPortTransport):
    """A rim that liquid flows over (Poleni): ``m_flow = 2/3 C_d width rho sqrt(2 g) h**(3/2)``."""

    height: ClassVar[ac.Parameter]
    """height of the rim above the tank's bottom [m]"""
    width: ClassVar[ac.Parameter]
    """length of the rim that is flown over [m]"""
    C_d: ClassVar[ac.Parameter]
    """discharge coefficient"""
    rho: ClassVar[ac.Parameter]
    """density of the liquid [kg/m3]"""
    g: ClassVar[ac.Parameter]
    """gravity [m/s2]"""
    p_ambient: ClassVar[ac.Parameter]
    """pressure of the air [Pa]"""
    h: ClassVar[ac.Variable]
    """height of the liquid above the rim, or zero [m]"""
    def __init__(
        self,
        *,
        height: SupportsFloat | ac.Start = ...,
        width: SupportsFloat | ac.Start = ...,
        C_d: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        p_ambient: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class DynamicVolume(ac.Component):
    """Liquid behind a piston: ``V = V_dead + area x``, ``x = direction (flange.s - s_0)``; it pushes by ``p area``."""

    fluid: ClassVar[ac.Option]
    """the liquid, a hydraulic.liquid.Liquid"""
    port: FluidPort
    p: ClassVar[ac.Variable]
    """pressure [Pa]"""
    rho: ClassVar[ac.Variable]
    """density [kg/m3]"""
    m: ClassVar[ac.Variable]
    """mass of the liquid [kg]"""
    area: ClassVar[ac.Parameter]
    """area of the piston [m2]"""
    V_dead: ClassVar[ac.Parameter]
    """volume where x = 0 [m3]"""
    s_0: ClassVar[ac.Parameter]
    """position of the piston where x = 0 [m]"""
    direction: ClassVar[ac.Option]
    """whether the volume grows with flange.s"""
    flange: _translational.Flange
    V: ClassVar[ac.Variable]
    """volume [m3]"""
    def __init__(
        self,
        *,
        area: SupportsFloat | ac.Start = ...,
        V_dead: SupportsFloat | ac.Start = ...,
        s_0: SupportsFloat | ac.Start = ...,
        fluid: Any = ...,
        direction: Literal[1, -1] = ...,
        port: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        p: ac.Start | Mapping[str, Any] = ...,
        rho: ac.Start | Mapping[str, Any] = ...,
        m: ac.Start | Mapping[str, Any] = ...,
        V: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FixedVolume(ac.Component):
    """Liquid in a stiff vessel of the volume ``V`` [m3]."""

    fluid: ClassVar[ac.Option]
    """the liquid, a hydraulic.liquid.Liquid"""
    port: FluidPort
    p: ClassVar[ac.Variable]
    """pressure [Pa]"""
    rho: ClassVar[ac.Variable]
    """density [kg/m3]"""
    m: ClassVar[ac.Variable]
    """mass of the liquid [kg]"""
    V: ClassVar[ac.Parameter]
    """volume [m3]"""
    def __init__(
        self,
        *,
        V: SupportsFloat | ac.Start = ...,
        fluid: Any = ...,
        port: Mapping[str, Any] = ...,
        p: ac.Start | Mapping[str, Any] = ...,
        rho: ac.Start | Mapping[str, Any] = ...,
        m: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MassFlowRate(PartialFlowSensor):
    """Mass flow rate ``m_flow`` [kg/s] from ``port_a`` to ``port_b``, without a pressure drop."""

    m_flow: ClassVar[ac.Output]
    """mass flow rate from a to b [kg/s]"""
    def __init__(
        self,
        *,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TubeSegment(PartialTwoPortTransport):
    """A piece of tube without storage: friction at the wall, and with ``inertia`` the liquid's mass."""

    fluid: ClassVar[ac.Option]
    """the liquid, a hydraulic.liquid.Liquid"""
    length: ClassVar[ac.Parameter]
    """length [m]"""
    diameter: ClassVar[ac.Parameter]
    """inner diameter [m]"""
    roughness: ClassVar[ac.Parameter]
    """height of the wall's unevenness [m]"""
    inertia: ClassVar[ac.Option]
    """whether the liquid's mass counts"""
    v: ClassVar[ac.Variable]
    """mean velocity from a to b [m/s]"""
    def __init__(
        self,
        *,
        length: SupportsFloat | ac.Start = ...,
        diameter: SupportsFloat | ac.Start = ...,
        roughness: SupportsFloat | ac.Start = ...,
        fluid: Any = ...,
        inertia: bool = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VolumeFlowRate(PartialFlowSensor):
    """Volume flow rate ``V_flow = m_flow / rho`` [m3/s] from ``port_a`` to ``port_b``, without a pressure drop."""

    rho: ClassVar[ac.Parameter]
    """density of the liquid [kg/m3]"""
    V_flow: ClassVar[ac.Output]
    """volume flow rate from a to b [m3/s]"""
    def __init__(
        self,
        *,
        rho: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SpoolValve(PartialTwoPortTransport):
    """An opening of the ``width`` [m] that a spool clears: ``area = width direction (flange.s - s_0)``."""

    fluid: ClassVar[ac.Option]
    """the liquid, a hydraulic.liquid.Liquid"""
    C_d: ClassVar[ac.Parameter]
    """discharge coefficient"""
    dp_small: ClassVar[ac.Parameter]
    """pressure drop around which flow reverses [Pa]"""
    area_least: ClassVar[ac.Parameter]
    """area of the leak where it is closed [m2]"""
    width: ClassVar[ac.Parameter]
    """width of the opening, the spool's circumference [m]"""
    s_0: ClassVar[ac.Parameter]
    """position of the spool where it opens [m]"""
    direction: ClassVar[ac.Option]
    """whether it opens with flange.s"""
    flange: _translational.Flange
    def __init__(
        self,
        *,
        width: SupportsFloat | ac.Start = ...,
        C_d: SupportsFloat | ac.Start = ...,
        dp_small: SupportsFloat | ac.Start = ...,
        area_least: SupportsFloat | ac.Start = ...,
        s_0: SupportsFloat | ac.Start = ...,
        fluid: Any = ...,
        direction: Literal[1, -1] = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        flange: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Valve(PartialTwoPortTransport):
    """An opening with the ``area`` [m2] as signal."""

    fluid: ClassVar[ac.Option]
    """the liquid, a hydraulic.liquid.Liquid"""
    C_d: ClassVar[ac.Parameter]
    """discharge coefficient"""
    dp_small: ClassVar[ac.Parameter]
    """pressure drop around which flow reverses [Pa]"""
    area_least: ClassVar[ac.Parameter]
    """area of the leak where it is closed [m2]"""
    area: ClassVar[ac.Input]
    """area that is open; closed below zero [m2]"""
    def __init__(
        self,
        *,
        C_d: SupportsFloat | ac.Start = ...,
        dp_small: SupportsFloat | ac.Start = ...,
        area_least: SupportsFloat | ac.Start = ...,
        fluid: Any = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        area: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        m_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

FluidPort_a = FluidPort
FluidPort_b = FluidPort
