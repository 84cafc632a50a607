"""Sensors: temperatures and heat flows as output signals, without a reaction on the ports."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from . import scales
from .interfaces import HeatPort

__modelica__ = "Modelica.Thermal.HeatTransfer.Sensors"


class TemperatureSensor(scales.Kelvin):
    """Absolute temperature: ``T = port.T`` [K]."""

    ICON = icons.meter("T")

    T = ac.Output(unit="K", doc="absolute temperature of the port")
    port = HeatPort()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.T, self.from_kelvin(self.port.T))
        yield ac.Eq(self.port.Q_flow, 0)


class RelTemperatureSensor(ac.Component):
    """Temperature difference: ``T_rel = port_a.T - port_b.T`` [K]."""

    ICON = icons.meter2("T")

    port_a = HeatPort()
    port_b = HeatPort()
    T_rel = ac.Output(unit="K", doc="temperature of port_a relative to port_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.T_rel, self.port_a.T - self.port_b.T)
        yield ac.Eq(self.port_a.Q_flow, 0)
        yield ac.Eq(self.port_b.Q_flow, 0)


class HeatFlowSensor(ac.Component):
    """Heat flow rate: ``Q_flow = port_a.Q_flow`` [W] from ``port_a`` to ``port_b``, which are equally warm."""

    ICON = icons.meter2("Q")

    port_a = HeatPort()
    port_b = HeatPort()
    Q_flow = ac.Output(unit="W", doc="heat flow rate from port_a to port_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.port_a.T, self.port_b.T)
        yield ac.Eq(self.port_a.Q_flow + self.port_b.Q_flow, 0)
        yield ac.Eq(self.Q_flow, self.port_a.Q_flow)


class ConditionalFixedHeatFlowSensor(ac.Component):
    """A heat flow sensor for ports that may be absent.

    ``Q_flow = -port_b.Q_flow`` [W], ``port_a.T = port_b.T``; with ``useFixedTemperature`` both are held
    at ``T`` = 293.15 K, so that the model is not singular with nothing connected. Else
    ``port_a.Q_flow + port_b.Q_flow = 0``, as of a `HeatFlowSensor`.
    """

    ICON = icons.marked(icons.meter2("Q"), "0")

    useFixedTemperature = ac.Option(False, doc="whether the temperature of the ports is fixed")
    T = ac.Parameter(293.15, unit="K", when="useFixedTemperature", doc="fixed temperature")
    port_a = HeatPort()
    port_b = HeatPort()
    Q_flow = ac.Output(unit="W", doc="heat flow rate from port_a to port_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.port_a.T, self.port_b.T)
        yield ac.Eq(self.Q_flow, -self.port_b.Q_flow)
        if self.useFixedTemperature:
            yield ac.Eq(self.port_a.T, self.T)
        else:
            yield ac.Eq(self.port_a.Q_flow + self.port_b.Q_flow, 0)
