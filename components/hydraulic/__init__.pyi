"""Hydraulics of one incompressible liquid, without heat: tanks, orifices, weirs, pumps.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac

__all__ = [
    "Boundary",
    "FluidPort",
    "FluidPort_a",
    "FluidPort_b",
    "LinearResistance",
    "MassFlowRate",
    "MassFlowSource",
    "OpenTank",
    "Orifice",
    "PartialFlowSensor",
    "PartialTwoPortTransport",
    "Pressure",
    "RelativePressure",
    "StaticHead",
    "VolumeFlowRate",
    "Weir",
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

FluidPort_a = FluidPort
FluidPort_b = FluidPort
