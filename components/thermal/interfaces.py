"""The heat port, and the bases of components that conduct, store or dissipate heat."""

from collections.abc import Iterator

import acausal as ac

__modelica__ = "Modelica.Thermal.HeatTransfer.Interfaces"


class HeatPort(ac.Connector):
    """Temperature ``T`` [K] and heat flow rate ``Q_flow`` [W], positive into the component."""

    T = ac.Potential(unit="K", start=288.15, nominal=300.0)
    Q_flow = ac.Flow(unit="W")

    pair = ("port_a", "port_b")
    across = "dT"
    through = "Q_flow"
    power = False
    COLOR = "#d2564b"


HeatPort_a = HeatPort
HeatPort_b = HeatPort


class Element1D(ac.Component):
    """Two heat ports with a heat flow between them, and no storage.

    ``dT = port_a.T - port_b.T`` [K]; ``Q_flow`` [W] enters at ``port_a`` and leaves at ``port_b``.
    A subclass states how the two depend on each other.
    """

    port_a = HeatPort()
    port_b = HeatPort()
    Q_flow = ac.Variable(unit="W", doc="heat flow rate from port_a to port_b")
    dT = ac.Variable(unit="K", doc="port_a.T - port_b.T")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.dT, self.port_a.T - self.port_b.T)
        yield ac.Eq(self.port_a.Q_flow, self.Q_flow)
        yield ac.Eq(self.port_b.Q_flow, -self.Q_flow)


class PartialElementaryConditionalHeatPortWithoutT(ac.Component):
    """Base of a component that dissipates ``lossPower`` and may hand it to a heat port.

    With ``useHeatPort`` the component has a connector ``heatPort``, and
    ``heatPort.Q_flow = -lossPower``. A subclass states ``lossPower`` [W].
    """

    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    heatPort = HeatPort(when="useHeatPort")
    lossPower = ac.Variable(unit="W", doc="power that leaves as heat")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self.useHeatPort:
            yield ac.Eq(self.heatPort.Q_flow, -self.lossPower)


class PartialElementaryConditionalHeatPort(PartialElementaryConditionalHeatPortWithoutT):
    """The same for a component that depends on its temperature.

    ``TheatPort`` [K] is the temperature of the heat port, or ``T`` where there is none.
    """

    T = ac.Parameter(293.15, unit="K", doc="temperature of the device without heat port")
    TheatPort = ac.Variable(unit="K", start=288.15, nominal=300.0, doc="temperature of the device")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.TheatPort, self.heatPort.T if self.useHeatPort else self.T)
