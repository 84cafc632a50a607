"""The optional heat port of a component that is composed of others."""

from typing import Any

import acausal as ac

from .interfaces import HeatPort
from .sources import FixedTemperature

__modelica__ = "Modelica.Thermal.HeatTransfer.Interfaces"


class PartialConditionalHeatPort(ac.Component):
    """Base of a composite component that may have a heat port.

    A subclass connects the heat ports of its parts with ``internalHeatPort``. That is the connector
    ``heatPort`` with ``useHeatPort``, else a fixed temperature ``T`` [K].
    """

    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    T = ac.Parameter(293.15, unit="K", doc="temperature of the device without heat port")
    heatPort = HeatPort(when="useHeatPort")
    internalHeatPort = HeatPort()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        if self.useHeatPort:
            self.connect(self.heatPort, self.internalHeatPort)
        else:
            self.fixedTemperature = FixedTemperature(T=self.T)
            self.connect(self.fixedTemperature.port, self.internalHeatPort)
