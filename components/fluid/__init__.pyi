"""Coolant circuits (`Modelica.Thermal.FluidHeatFlow`): incompressible flow that carries heat.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat

import acausal as ac
from acausal.components import (
    rotational as _rotational,
    thermal as _thermal,
    translational as _translational,
)
from acausal.components.fluid.media import (
    Air_30degC as Air_30degC,
    Air_70degC as Air_70degC,
    Gylcol20_20degC as Gylcol20_20degC,
    Gylcol50_20degC as Gylcol50_20degC,
    Medium as Medium,
    MineralOil as MineralOil,
    Water as Water,
    Water_10degC as Water_10degC,
    Water_90degC as Water_90degC,
)

from . import media as media

__all__ = [
    "AbsolutePressure",
    "AbsoluteSensor",
    "Air_30degC",
    "Air_70degC",
    "Ambient",
    "Cylinder",
    "DoubleRamp",
    "EnthalpyFlowSensor",
    "FlowPort",
    "FlowPort_a",
    "FlowPort_b",
    "FlowSensor",
    "Gylcol20_20degC",
    "Gylcol50_20degC",
    "IdealPump",
    "MassFlowSensor",
    "Medium",
    "MineralOil",
    "OneWayValve",
    "OpenTank",
    "PartialAdiabatic",
    "PartialMedium",
    "PartialSinglePort",
    "Pipe",
    "PressureIncrease",
    "PressureSensor",
    "RelPressureSensor",
    "RelTemperatureSensor",
    "RelativeSensor",
    "SimpleFriction",
    "SinglePortBottom",
    "SinglePortLeft",
    "TemperatureSensor",
    "TwoPort",
    "Valve",
    "VolumeFlow",
    "VolumeFlowSensor",
    "Water",
    "Water_10degC",
    "Water_90degC",
    "media",
]

class DoubleRamp(ac.Component):
    """Two ramps, one after the other: a pump that drops out and comes back."""

    offset: ClassVar[ac.Parameter]
    """offset of the ramps"""
    startTime: ClassVar[ac.Parameter]
    """start of the first ramp [s]"""
    interval: ClassVar[ac.Parameter]
    """time between the ramps [s]"""
    height_1: ClassVar[ac.Parameter]
    """height of the first ramp"""
    duration_1: ClassVar[ac.Parameter]
    """duration of the first ramp [s]"""
    height_2: ClassVar[ac.Parameter]
    """height of the second ramp"""
    duration_2: ClassVar[ac.Parameter]
    """duration of the second ramp [s]"""
    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(
        self,
        *,
        offset: SupportsFloat | ac.Start = ...,
        startTime: SupportsFloat | ac.Start = ...,
        interval: SupportsFloat | ac.Start = ...,
        height_1: SupportsFloat | ac.Start = ...,
        duration_1: SupportsFloat | ac.Start = ...,
        height_2: SupportsFloat | ac.Start = ...,
        duration_2: SupportsFloat | ac.Start = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FlowPort(ac.Connector):
    """Where a medium flows: two pairs of variables, one of the flow, one of the heat it carries."""

    p: ClassVar[ac.Potential]
    """pressure [Pa]"""
    m_flow: ClassVar[ac.Flow]
    """mass flow rate [kg/s]"""
    h: ClassVar[ac.Potential]
    """specific enthalpy, mixed [J/kg]"""
    H_flow: ClassVar[ac.Flow]
    """enthalpy flow rate [W]"""

class PartialMedium(ac.Component):
    """A component that is filled with a medium, a record of `acausal.components.fluid.media`."""

    medium: ClassVar[ac.Option]
    """medium in the component"""
    def __init__(self, **modifiers: Any) -> None: ...

class SimpleFriction(ac.Component):
    """Pressure drop ``pressureDrop`` [Pa] of a flow ``volumeFlow`` [m3/s]: linear, then quadratic."""

    V_flowLaminar: ClassVar[ac.Parameter]
    """volume flow where the linear law ends [m3/s]"""
    dpLaminar: ClassVar[ac.Parameter]
    """pressure drop there [Pa]"""
    V_flowNominal: ClassVar[ac.Parameter]
    """nominal volume flow [m3/s]"""
    dpNominal: ClassVar[ac.Parameter]
    """nominal pressure drop [Pa]"""
    frictionLoss: ClassVar[ac.Parameter]
    """part of the friction losses that heats the medium"""
    pressureDrop: ClassVar[ac.Variable]
    """pressure drop [Pa]"""
    volumeFlow: ClassVar[ac.Variable]
    """volume flow rate [m3/s]"""
    Q_friction: ClassVar[ac.Variable]
    """friction losses into the medium [W]"""
    def __init__(self, **modifiers: Any) -> None: ...

class AbsoluteSensor(PartialMedium):
    """One flow port that is measured without a flow: ``flowPort.m_flow = 0``, ``flowPort.H_flow = 0``."""

    flowPort: FlowPort
    y: ClassVar[ac.Output]
    """measured quantity"""
    def __init__(
        self,
        *,
        medium: Any = ...,
        flowPort: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialSinglePort(PartialMedium):
    """One flow port to a medium at temperature ``T`` [K]: ``h = cp T``, ``T_port = flowPort.h / cp``."""

    cp: ClassVar[ac.Parameter]
    """heat capacity at constant pressure [J/(kg.K)]"""
    m_flow_small: ClassVar[ac.Parameter]
    """exchange at rest [kg/s]"""
    T_port: ClassVar[ac.Variable]
    """temperature at the port [K]"""
    T: ClassVar[ac.Variable]
    """temperature of the medium [K]"""
    h: ClassVar[ac.Variable]
    """specific enthalpy of the medium [J/kg]"""
    flowPort: FlowPort
    def __init__(self, **modifiers: Any) -> None: ...

class RelativeSensor(PartialMedium):
    """Two flow ports between which is measured, without a flow in either."""

    flowPort_a: FlowPort
    flowPort_b: FlowPort
    y: ClassVar[ac.Output]
    """measured quantity"""
    def __init__(
        self,
        *,
        medium: Any = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class TwoPort(PartialMedium):
    """Two flow ports and a mass ``m`` [kg] of medium between them, fully mixed at temperature ``T`` [K]."""

    m: ClassVar[ac.Parameter]
    """mass of the medium [kg]"""
    T0: ClassVar[ac.Parameter]
    """initial temperature of the medium [K]"""
    T0fixed: ClassVar[ac.Option]
    """whether T0 holds initially; else it is a guess"""
    tapT: ClassVar[ac.Parameter]
    """where a heat port is, from inlet to outlet"""
    rho: ClassVar[ac.Parameter]
    """density of the medium [kg/m3]"""
    cp: ClassVar[ac.Parameter]
    """heat capacity at constant pressure [J/(kg.K)]"""
    cv: ClassVar[ac.Parameter]
    """heat capacity at constant volume [J/(kg.K)]"""
    m_flow_small: ClassVar[ac.Parameter]
    """exchange at rest [kg/s]"""
    dp: ClassVar[ac.Variable]
    """pressure drop from a to b [Pa]"""
    V_flow: ClassVar[ac.Variable]
    """volume flow rate from a to b [m3/s]"""
    Q_flow: ClassVar[ac.Variable]
    """heat flow rate into the medium [W]"""
    T: ClassVar[ac.Variable]
    """outlet temperature [K]"""
    T_a: ClassVar[ac.Variable]
    """temperature at flowPort_a [K]"""
    T_b: ClassVar[ac.Variable]
    """temperature at flowPort_b [K]"""
    dT: ClassVar[ac.Variable]
    """temperature increase in the direction of flow [K]"""
    T_q: ClassVar[ac.Variable]
    """temperature that a heat port sees [K]"""
    h: ClassVar[ac.Variable]
    """specific enthalpy of the medium [J/kg]"""
    flowPort_a: FlowPort
    flowPort_b: FlowPort
    def __init__(self, **modifiers: Any) -> None: ...

class AbsolutePressure(PartialSinglePort):
    """Sets the pressure level of a closed circuit, without a flow: ``flowPort.p = p`` [Pa]."""

    p: ClassVar[ac.Parameter]
    """pressure [Pa]"""
    def __init__(
        self,
        *,
        cp: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        p: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        flowPort: Mapping[str, Any] = ...,
        T_port: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Ambient(PartialSinglePort):
    """An infinite reservoir: ``flowPort.p`` [Pa] and ``T`` [K] are given, as constants or signals."""

    usePressureInput: ClassVar[ac.Option]
    """whether the pressure is a signal"""
    constantAmbientPressure: ClassVar[ac.Parameter]
    """ambient pressure [Pa]"""
    useTemperatureInput: ClassVar[ac.Option]
    """whether the temperature is a signal"""
    constantAmbientTemperature: ClassVar[ac.Parameter]
    """ambient temperature [K]"""
    ambientPressure: ClassVar[ac.Input]
    """ambient pressure [Pa]"""
    ambientTemperature: ClassVar[ac.Input]
    """ambient temperature [K]"""
    def __init__(
        self,
        *,
        cp: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        constantAmbientPressure: SupportsFloat | ac.Start = ...,
        constantAmbientTemperature: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        usePressureInput: bool = ...,
        useTemperatureInput: bool = ...,
        flowPort: Mapping[str, Any] = ...,
        ambientPressure: ac.Start | Mapping[str, Any] = ...,
        ambientTemperature: ac.Start | Mapping[str, Any] = ...,
        T_port: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PartialAdiabatic(TwoPort):
    """Two flow ports without heat exchange: ``Q_flow = 0``."""
    def __init__(self, **modifiers: Any) -> None: ...

class PressureSensor(AbsoluteSensor):
    """Absolute pressure: ``y = flowPort.p`` [Pa]."""

    y: ClassVar[ac.Output]
    """pressure [Pa]"""
    def __init__(
        self,
        *,
        medium: Any = ...,
        flowPort: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelPressureSensor(RelativeSensor):
    """Pressure drop: ``y = flowPort_a.p - flowPort_b.p`` [Pa]."""

    y: ClassVar[ac.Output]
    """pressure drop from a to b [Pa]"""
    def __init__(
        self,
        *,
        medium: Any = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class RelTemperatureSensor(RelativeSensor):
    """Temperature difference: ``y = (flowPort_a.h - flowPort_b.h) / cp`` [K]."""

    y: ClassVar[ac.Output]
    """temperature of a relative to b [K]"""
    cp: ClassVar[ac.Parameter]
    """heat capacity at constant pressure [J/(kg.K)]"""
    def __init__(
        self,
        *,
        cp: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SinglePortLeft(PartialSinglePort):
    """One flow port to a volume of medium that starts at temperature ``T0`` [K]."""

    T: ClassVar[ac.Variable]
    """temperature of the medium [K]"""
    T0: ClassVar[ac.Parameter]
    """initial temperature of the medium [K]"""
    T0fixed: ClassVar[ac.Option]
    """whether T0 holds initially; else it is a guess"""
    rho: ClassVar[ac.Parameter]
    """density of the medium [kg/m3]"""
    def __init__(self, **modifiers: Any) -> None: ...

class TemperatureSensor(AbsoluteSensor):
    """Absolute temperature of what is mixed at the port: ``y = flowPort.h / cp`` [K]."""

    y: ClassVar[ac.Output]
    """temperature [K]"""
    cp: ClassVar[ac.Parameter]
    """heat capacity at constant pressure [J/(kg.K)]"""
    def __init__(
        self,
        *,
        cp: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        flowPort: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FlowSensor(PartialAdiabatic):
    """Two flow ports through which flows what is measured: ``dp = 0``, no volume and no heat."""

    T: ClassVar[ac.Variable]
    """outlet temperature [K]"""
    y: ClassVar[ac.Output]
    """measured quantity"""
    def __init__(
        self,
        *,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class IdealPump(PartialAdiabatic):
    """A pump without losses that is driven at its shaft: ``flange_a.tau w = -dp V_flow``."""

    wNominal: ClassVar[ac.Parameter]
    """nominal speed [rad/s]"""
    dp0: ClassVar[ac.Parameter]
    """pressure increase without flow, at nominal speed [Pa]"""
    V_flow0: ClassVar[ac.Parameter]
    """volume flow without pressure, at nominal speed [m3/s]"""
    w: ClassVar[ac.Variable]
    """speed [rad/s]"""
    dp1: ClassVar[ac.Variable]
    """pressure increase without flow [Pa]"""
    V_flow1: ClassVar[ac.Variable]
    """volume flow without pressure [m3/s]"""
    flange_a: _rotational.Flange
    def __init__(
        self,
        *,
        wNominal: SupportsFloat | ac.Start = ...,
        dp0: SupportsFloat | ac.Start = ...,
        V_flow0: SupportsFloat | ac.Start = ...,
        m: SupportsFloat | ac.Start = ...,
        T0: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        T0fixed: bool = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        dp1: ac.Start | Mapping[str, Any] = ...,
        V_flow1: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OneWayValve(TwoPort):
    """A valve that lets flow pass from ``flowPort_a`` to ``flowPort_b`` only, like an ideal diode."""

    frictionLoss: ClassVar[ac.Parameter]
    """part of the friction losses that heats the medium"""
    V_flowNominal: ClassVar[ac.Parameter]
    """nominal volume flow, forward [m3/s]"""
    dpForward: ClassVar[ac.Parameter]
    """pressure drop at nominal flow, forward [Pa]"""
    dpNominal: ClassVar[ac.Parameter]
    """nominal pressure, backward [Pa]"""
    V_flowBackward: ClassVar[ac.Parameter]
    """leakage at nominal pressure, backward [m3/s]"""
    backward: ClassVar[ac.Variable]
    """1 while flow is blocked, else 0"""
    s: ClassVar[ac.Variable]
    """position on the characteristic"""
    def __init__(
        self,
        *,
        V_flowNominal: SupportsFloat | ac.Start = ...,
        dpNominal: SupportsFloat | ac.Start = ...,
        V_flowBackward: SupportsFloat | ac.Start = ...,
        m: SupportsFloat | ac.Start = ...,
        T0: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        frictionLoss: SupportsFloat | ac.Start = ...,
        dpForward: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        T0fixed: bool = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
        backward: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OpenTank(SinglePortLeft):
    """A tank under ambient pressure, fully mixed, with its port at the bottom."""

    ATank: ClassVar[ac.Parameter]
    """cross section of the tank [m2]"""
    hTank: ClassVar[ac.Parameter]
    """height of the tank [m]"""
    pAmbient: ClassVar[ac.Parameter]
    """ambient pressure [Pa]"""
    g: ClassVar[ac.Parameter]
    """gravity [m/s2]"""
    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    heatPort: _thermal.HeatPort
    m: ClassVar[ac.Variable]
    """mass of the medium [kg]"""
    H: ClassVar[ac.Variable]
    """enthalpy of the medium [J]"""
    Q_flow: ClassVar[ac.Variable]
    """heat flow rate into the medium [W]"""
    level: ClassVar[ac.Output]
    """level of the medium [m]"""
    TTank: ClassVar[ac.Output]
    """temperature of the medium [K]"""
    def __init__(
        self,
        *,
        ATank: SupportsFloat | ac.Start = ...,
        hTank: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        T0: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        pAmbient: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        T0fixed: bool = ...,
        useHeatPort: bool = ...,
        flowPort: Mapping[str, Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        level: ac.Start | Mapping[str, Any] = ...,
        TTank: ac.Start | Mapping[str, Any] = ...,
        T_port: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
        m: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Pipe(TwoPort, SimpleFriction):
    """A pipe with friction, a difference in height, and with ``useHeatPort`` heat exchange."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    h_g: ClassVar[ac.Parameter]
    """height of flowPort_b above flowPort_a [m]"""
    g: ClassVar[ac.Parameter]
    """gravity [m/s2]"""
    heatPort: _thermal.HeatPort
    def __init__(
        self,
        *,
        V_flowLaminar: SupportsFloat | ac.Start = ...,
        dpLaminar: SupportsFloat | ac.Start = ...,
        V_flowNominal: SupportsFloat | ac.Start = ...,
        dpNominal: SupportsFloat | ac.Start = ...,
        frictionLoss: SupportsFloat | ac.Start = ...,
        m: SupportsFloat | ac.Start = ...,
        T0: SupportsFloat | ac.Start = ...,
        tapT: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        h_g: SupportsFloat | ac.Start = ...,
        g: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        T0fixed: bool = ...,
        useHeatPort: bool = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        pressureDrop: ac.Start | Mapping[str, Any] = ...,
        volumeFlow: ac.Start | Mapping[str, Any] = ...,
        Q_friction: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PressureIncrease(PartialAdiabatic):
    """A pump with a given pressure increase from a to b, whatever the flow: ``dp = -increase`` [Pa]."""

    usePressureIncreaseInput: ClassVar[ac.Option]
    """whether the pressure increase is a signal"""
    constantPressureIncrease: ClassVar[ac.Parameter]
    """pressure increase [Pa]"""
    pressureIncrease: ClassVar[ac.Input]
    """pressure increase [Pa]"""
    def __init__(
        self,
        *,
        constantPressureIncrease: SupportsFloat | ac.Start = ...,
        m: SupportsFloat | ac.Start = ...,
        T0: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        T0fixed: bool = ...,
        usePressureIncreaseInput: bool = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        pressureIncrease: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Valve(TwoPort):
    """A valve that a signal ``y`` opens, from 0 to ``y1``."""

    frictionLoss: ClassVar[ac.Parameter]
    """part of the friction losses that heats the medium"""
    LinearCharacteristic: ClassVar[ac.Option]
    """whether the characteristic is linear; else exponential"""
    y1: ClassVar[ac.Parameter]
    """greatest opening"""
    Kv1: ClassVar[ac.Parameter]
    """standard flow rate at the greatest opening [m3/s]"""
    kv0: ClassVar[ac.Parameter]
    """leakage flow at y = 0, relative to Kv1"""
    dp0: ClassVar[ac.Parameter]
    """standard pressure drop [Pa]"""
    rho0: ClassVar[ac.Parameter]
    """standard density [kg/m3]"""
    Kv: ClassVar[ac.Variable]
    """standard flow rate [m3/s]"""
    y: ClassVar[ac.Input]
    """opening"""
    def __init__(
        self,
        *,
        y1: SupportsFloat | ac.Start = ...,
        Kv1: SupportsFloat | ac.Start = ...,
        kv0: SupportsFloat | ac.Start = ...,
        dp0: SupportsFloat | ac.Start = ...,
        rho0: SupportsFloat | ac.Start = ...,
        m: SupportsFloat | ac.Start = ...,
        T0: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        frictionLoss: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        T0fixed: bool = ...,
        LinearCharacteristic: bool = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
        Kv: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VolumeFlow(PartialAdiabatic):
    """A pump with a given volume flow from a to b, whatever the pressure: ``V_flow`` [m3/s]."""

    useVolumeFlowInput: ClassVar[ac.Option]
    """whether the volume flow is a signal"""
    constantVolumeFlow: ClassVar[ac.Parameter]
    """volume flow rate [m3/s]"""
    volumeFlow: ClassVar[ac.Input]
    """volume flow rate [m3/s]"""
    def __init__(
        self,
        *,
        constantVolumeFlow: SupportsFloat | ac.Start = ...,
        m: SupportsFloat | ac.Start = ...,
        T0: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        T0fixed: bool = ...,
        useVolumeFlowInput: bool = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        volumeFlow: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Cylinder(SinglePortLeft, _translational.PartialElementaryOneFlangeAndSupport2):
    """A cylinder with a massless piston at position ``s`` [m], measured from its bottom."""

    A: ClassVar[ac.Parameter]
    """cross section of the piston [m2]"""
    L: ClassVar[ac.Parameter]
    """length of the cylinder [m]"""
    f: ClassVar[ac.Variable]
    """force at the piston, = flange.f [N]"""
    m: ClassVar[ac.Variable]
    """mass of the medium [kg]"""
    H: ClassVar[ac.Variable]
    """enthalpy of the medium [J]"""
    def __init__(
        self,
        *,
        A: SupportsFloat | ac.Start = ...,
        L: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        T0: SupportsFloat | ac.Start = ...,
        rho: SupportsFloat | ac.Start = ...,
        useSupport: bool = ...,
        medium: Any = ...,
        T0fixed: bool = ...,
        flange: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        flowPort: Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        T_port: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        m: ac.Start | Mapping[str, Any] = ...,
        H: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class EnthalpyFlowSensor(FlowSensor):
    """Enthalpy flow rate: ``y = flowPort_a.H_flow`` [W]."""

    y: ClassVar[ac.Output]
    """enthalpy flow rate from a to b [W]"""
    def __init__(
        self,
        *,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class MassFlowSensor(FlowSensor):
    """Mass flow rate: ``y = flowPort_a.m_flow`` [kg/s]."""

    y: ClassVar[ac.Output]
    """mass flow rate from a to b [kg/s]"""
    def __init__(
        self,
        *,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class VolumeFlowSensor(FlowSensor):
    """Volume flow rate: ``y = V_flow`` [m3/s]."""

    y: ClassVar[ac.Output]
    """volume flow rate from a to b [m3/s]"""
    def __init__(
        self,
        *,
        rho: SupportsFloat | ac.Start = ...,
        cp: SupportsFloat | ac.Start = ...,
        cv: SupportsFloat | ac.Start = ...,
        m_flow_small: SupportsFloat | ac.Start = ...,
        medium: Any = ...,
        flowPort_a: Mapping[str, Any] = ...,
        flowPort_b: Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        dp: ac.Start | Mapping[str, Any] = ...,
        V_flow: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        T_a: ac.Start | Mapping[str, Any] = ...,
        T_b: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
        T_q: ac.Start | Mapping[str, Any] = ...,
        h: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

FlowPort_a = FlowPort
FlowPort_b = FlowPort
SinglePortBottom = SinglePortLeft
