"""Given temperatures and heat flows."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from . import scales
from .interfaces import HeatPort

__modelica__ = "Modelica.Thermal.HeatTransfer.Sources"


class FixedTemperature(scales.Kelvin):
    """A constant temperature, whatever the heat flow: ``port.T = T`` [K]."""

    ICON = icons.marked(icons.TEMPERATURE, "=")

    T = ac.Parameter(unit="K", doc="temperature at the port")
    port = HeatPort()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.port.T, self.to_kelvin(self.T))


class PrescribedTemperature(scales.Kelvin):
    """A temperature signal ``T`` [K], whatever the heat flow: ``port.T = T``."""

    ICON = icons.TEMPERATURE

    T = ac.Input(unit="K", doc="temperature at the port")
    port = HeatPort()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.port.T, self.to_kelvin(self.T))


class _HeatFlow(ac.Component):
    """Base of heat sources: ``port.Q_flow = -Q_flow (1 + alpha (port.T - T_ref))``.

    A positive ``Q_flow`` [W] heats what is connected. A subclass says where it comes from.
    """

    ICON = icons.HEAT_FLOW

    T_ref = ac.Parameter(293.15, unit="K", doc="reference temperature")
    alpha = ac.Parameter(0.0, unit="1/K", doc="temperature coefficient of the heat flow rate")
    port = HeatPort()
    Q_flow: Any

    def equations(self) -> Iterator[ac.Eq]:
        warm = 1 + self.alpha * (self.port.T - self.T_ref)
        yield ac.Eq(self.port.Q_flow, -self.Q_flow * warm)


class FixedHeatFlow(_HeatFlow):
    """A constant heat flow rate into what is connected.

    ``port.Q_flow = -Q_flow (1 + alpha (port.T - T_ref))``: the losses of a machine, for example, that grow
    with its temperature.
    """

    ICON = icons.marked(icons.HEAT_FLOW, "const")

    Q_flow = ac.Parameter(unit="W", doc="heat flow rate at the reference temperature")


class PrescribedHeatFlow(_HeatFlow):
    """A heat flow signal ``Q_flow`` [W] into what is connected.

    ``port.Q_flow = -Q_flow (1 + alpha (port.T - T_ref))``.
    """

    Q_flow = ac.Input(unit="W", doc="heat flow rate at the reference temperature")
