"""Given pressures and flows."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import FluidPort


class Boundary(ac.Component):
    """An infinite reservoir: ``port.p = p`` [Pa], whatever the flow.

    With ``use_p_in`` the pressure is the signal ``p_in``.
    """

    ICON = icons.AMBIENT

    use_p_in = ac.Option(False, doc="whether the pressure is a signal")
    p = ac.Parameter(0.0, unit="Pa", when="not use_p_in", doc="pressure")
    p_in = ac.Input(unit="Pa", when="use_p_in", doc="pressure")
    port = FluidPort()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.port.p, self.p_in if self.use_p_in else self.p)


class MassFlowSource(ac.Component):
    """A given mass flow rate into what is connected, whatever the pressure: ``port.m_flow = -m_flow`` [kg/s].

    A pump from a reservoir, say. With ``use_m_flow_in`` the flow is the signal ``m_flow_in``.
    """

    ICON = icons.marked(icons.PUMP, "m")

    use_m_flow_in = ac.Option(False, doc="whether the mass flow rate is a signal")
    m_flow = ac.Parameter(unit="kg/s", when="not use_m_flow_in", doc="mass flow rate")
    m_flow_in = ac.Input(unit="kg/s", when="use_m_flow_in", doc="mass flow rate")
    port = FluidPort()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.port.m_flow, -(self.m_flow_in if self.use_m_flow_in else self.m_flow))
