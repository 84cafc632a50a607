"""Sensors: pressures, temperatures and flows as the output signal ``y``, without a reaction on the flow."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .bases import PartialAdiabatic, PartialMedium
from .interfaces import FlowPort

__modelica__ = "Modelica.Thermal.FluidHeatFlow.Sensors"


class AbsoluteSensor(PartialMedium):
    """One flow port that is measured without a flow: ``flowPort.m_flow = 0``, ``flowPort.H_flow = 0``."""

    ICON = icons.SENSOR

    __modelica__ = "Modelica.Thermal.FluidHeatFlow.Interfaces"

    flowPort = FlowPort()
    y = ac.Output(doc="measured quantity")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flowPort.m_flow, 0)
        yield ac.Eq(self.flowPort.H_flow, 0)


class RelativeSensor(PartialMedium):
    """Two flow ports between which is measured, without a flow in either."""

    ICON = icons.SENSOR2

    __modelica__ = "Modelica.Thermal.FluidHeatFlow.Interfaces"

    flowPort_a = FlowPort()
    flowPort_b = FlowPort()
    y = ac.Output(doc="measured quantity")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        for port in (self.flowPort_a, self.flowPort_b):
            yield ac.Eq(port.m_flow, 0)
            yield ac.Eq(port.H_flow, 0)


class FlowSensor(PartialAdiabatic):
    """Two flow ports through which flows what is measured: ``dp = 0``, no volume and no heat."""

    ICON = icons.SENSOR2

    __modelica__ = "Modelica.Thermal.FluidHeatFlow.Interfaces"

    m = 0
    T0 = 293.15
    T0fixed = False
    T = ac.Variable(unit="K", start=T0, nominal=300.0, doc="outlet temperature")
    y = ac.Output(doc="measured quantity")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.dp, 0)


class PressureSensor(AbsoluteSensor):
    """Absolute pressure: ``y = flowPort.p`` [Pa]."""

    ICON = icons.meter("p")

    y = ac.Output(unit="Pa", doc="pressure")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.y, self.flowPort.p)


class TemperatureSensor(AbsoluteSensor):
    """Absolute temperature of what is mixed at the port: ``y = flowPort.h / cp`` [K]."""

    ICON = icons.meter("T")

    cp = ac.Parameter(
        lambda self: self.medium.cp, unit="J/(kg.K)", doc="heat capacity at constant pressure"
    )
    y = ac.Output(unit="K", doc="temperature")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.cp * self.y, self.flowPort.h)


class RelPressureSensor(RelativeSensor):
    """Pressure drop: ``y = flowPort_a.p - flowPort_b.p`` [Pa]."""

    ICON = icons.meter2("Δp")

    y = ac.Output(unit="Pa", doc="pressure drop from a to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.y, self.flowPort_a.p - self.flowPort_b.p)


class RelTemperatureSensor(RelativeSensor):
    """Temperature difference: ``y = (flowPort_a.h - flowPort_b.h) / cp`` [K]."""

    ICON = icons.meter2("ΔT")

    cp = ac.Parameter(
        lambda self: self.medium.cp, unit="J/(kg.K)", doc="heat capacity at constant pressure"
    )
    y = ac.Output(unit="K", doc="temperature of a relative to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.cp * self.y, self.flowPort_a.h - self.flowPort_b.h)


class MassFlowSensor(FlowSensor):
    """Mass flow rate: ``y = flowPort_a.m_flow`` [kg/s]."""

    ICON = icons.meter2("m")

    y = ac.Output(unit="kg/s", doc="mass flow rate from a to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.y, self.flowPort_a.m_flow)


class VolumeFlowSensor(FlowSensor):
    """Volume flow rate: ``y = V_flow`` [m3/s]."""

    ICON = icons.meter2("V")

    y = ac.Output(unit="m3/s", doc="volume flow rate from a to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.y, self.V_flow)


class EnthalpyFlowSensor(FlowSensor):
    """Enthalpy flow rate: ``y = flowPort_a.H_flow`` [W]."""

    ICON = icons.meter2("H")

    y = ac.Output(unit="W", doc="enthalpy flow rate from a to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.y, self.flowPort_a.H_flow)
