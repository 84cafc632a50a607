"""The fluid port, and the base of components that a liquid flows through."""

from collections.abc import Iterator

import acausal as ac


class FluidPort(ac.Connector):
    """Pressure ``p`` [Pa] and mass flow rate ``m_flow`` [kg/s], positive into the component."""

    p = ac.Potential(unit="Pa", nominal=1e5, doc="pressure")
    m_flow = ac.Flow(unit="kg/s", doc="mass flow rate")

    pair = ("port_a", "port_b")
    across = "dp"
    through = "m_flow"
    power = False
    COLOR = "#2f8fd0"


FluidPort_a = FluidPort
FluidPort_b = FluidPort


class PartialTwoPortTransport(ac.Component):
    """Two fluid ports with a flow between them, and no storage.

    ``dp = port_a.p - port_b.p`` [Pa]; ``m_flow`` [kg/s] enters at ``port_a`` and leaves at ``port_b``.
    A subclass states how the two depend on each other.
    """

    port_a = FluidPort()
    port_b = FluidPort()
    dp = ac.Variable(unit="Pa", nominal=1e5, doc="pressure drop from a to b")
    m_flow = ac.Variable(unit="kg/s", doc="mass flow rate from a to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.dp, self.port_a.p - self.port_b.p)
        yield ac.Eq(self.port_a.m_flow, self.m_flow)
        yield ac.Eq(self.port_b.m_flow, -self.m_flow)
