"""A heat port as signals, to couple a thermal model with a block or with another tool."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import HeatPort

__modelica__ = "Modelica.Thermal.HeatTransfer.Components"


class GeneralHeatFlowToTemperatureAdaptor(ac.Component):
    """A heat port as signals, heat flow in, temperature out: ``f = heatPort.Q_flow``, ``p = heatPort.T``.

    ``pder = der(p)`` exists with ``use_pder``.
    """

    ICON = icons.block("Q → T")

    use_pder = ac.Option(True, doc="whether the rate of the temperature is an output")
    heatPort = HeatPort()
    f = ac.Input(unit="W", doc="heat flow rate into the port")
    p = ac.Output(unit="K", doc="temperature")
    pder = ac.Output(unit="K/s", when="use_pder", doc="rate of the temperature")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p, self.heatPort.T)
        yield ac.Eq(self.f, self.heatPort.Q_flow)
        if self.use_pder:
            yield ac.Eq(self.pder, ac.der(self.p))


class GeneralTemperatureToHeatFlowAdaptor(ac.Component):
    """A heat port as signals, temperature in, heat flow out: ``heatPort.T = p``, ``f = -heatPort.Q_flow``.

    ``f`` [W] heats what is connected to the port. With ``use_pder`` the input ``pder`` is taken for the rate of ``p``
    wherever the model needs it; without, ``p`` is differentiated.
    """

    ICON = icons.block("T → Q")

    use_pder = ac.Option(True, doc="whether the rate of the temperature is an input")
    heatPort = HeatPort()
    p = ac.Input(unit="K", doc="temperature")
    pder = ac.Input(unit="K/s", when="use_pder", doc="rate of the temperature, consistent with p")
    f = ac.Output(unit="W", doc="heat flow rate to what is connected, = -heatPort.Q_flow")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.f, -self.heatPort.Q_flow)
        rates = [self.pder] if self.use_pder else []
        yield ac.Eq(self.heatPort.T, ac.prescribed(self.p, *rates))
