"""Sensors: pressures and flows as output signals, without a reaction on the flow; a tank's level is its own output."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import FluidPort, PartialTwoPortTransport
from .water import RHO


class Pressure(ac.Component):
    """Pressure ``p = port.p`` [Pa]."""

    ICON = icons.meter("p")

    port = FluidPort()
    p = ac.Output(unit="Pa", doc="pressure at the port")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p, self.port.p)
        yield ac.Eq(self.port.m_flow, 0)


class RelativePressure(ac.Component):
    """Pressure drop ``p_rel = port_a.p - port_b.p`` [Pa]."""

    ICON = icons.meter2("Δp")

    port_a = FluidPort()
    port_b = FluidPort()
    p_rel = ac.Output(unit="Pa", doc="pressure drop from a to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p_rel, self.port_a.p - self.port_b.p)
        yield ac.Eq(self.port_a.m_flow, 0)
        yield ac.Eq(self.port_b.m_flow, 0)


class PartialFlowSensor(PartialTwoPortTransport):
    """What flow sensors share: the liquid passes without a pressure drop, ``dp = 0``."""

    ICON = icons.SENSOR2

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.dp, 0)


class MassFlowRate(PartialFlowSensor):
    """Mass flow rate ``m_flow`` [kg/s] from ``port_a`` to ``port_b``, without a pressure drop."""

    ICON = icons.meter2("m")

    m_flow = ac.Output(unit="kg/s", doc="mass flow rate from a to b")


class VolumeFlowRate(PartialFlowSensor):
    """Volume flow rate ``V_flow = m_flow / rho`` [m3/s] from ``port_a`` to ``port_b``, without a pressure drop."""

    ICON = icons.meter2("V")

    rho = ac.Parameter(RHO, unit="kg/m3", min=0, doc="density of the liquid")
    V_flow = ac.Output(unit="m3/s", doc="volume flow rate from a to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.rho * self.V_flow, self.m_flow)
