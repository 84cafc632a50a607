"""The flow port, and how a flow carries enthalpy through it."""

from collections.abc import Iterator
from typing import Any

import acausal as ac

M_FLOW_SMALL = 1e-9
"""Mass flow [kg/s] that neighbours exchange beside the flow itself; see `enthalpy_flow`."""


def enthalpy_flow(m_flow: Any, h_port: Any, h: Any, m_flow_small: Any = M_FLOW_SMALL) -> Any:
    """Enthalpy flow rate [W] into a component through a port: the mixing rule.

    A flow into the component brings the enthalpy of the port, a flow out of it that of the component:
    ``m_flow h_port`` for ``m_flow >= 0``, else ``m_flow h``. The port's enthalpy follows from all
    components that meet there, whose enthalpy flows sum to zero. So that it is defined without a flow
    too, the two exchange ``m_flow_small (h_port - h)`` besides: a port at rest has the mean enthalpy of
    its neighbours. No energy is lost by that.

    Arguments:
        m_flow: mass flow rate into the component [kg/s].
        h_port, h: specific enthalpy at the port and in the component [J/kg].
        m_flow_small: exchange at rest [kg/s].
    """
    carried = ac.where(m_flow >= 0, m_flow * h_port, m_flow * h)
    return carried + m_flow_small * (h_port - h)


class FlowPort(ac.Connector):
    """Where a medium flows: two pairs of variables, one of the flow, one of the heat it carries.

    Pressure ``p`` [Pa] and mass flow rate ``m_flow`` [kg/s]; specific enthalpy ``h`` [J/kg] of what
    meets at the port, fully mixed, and enthalpy flow rate ``H_flow`` [W]. Flows are positive into the
    component. Connected components must have the same medium, which is not checked.
    """

    p = ac.Potential(unit="Pa", nominal=1e5, doc="pressure")
    m_flow = ac.Flow(unit="kg/s", doc="mass flow rate")
    h = ac.Potential(unit="J/kg", nominal=1e5, doc="specific enthalpy, mixed")
    H_flow = ac.Flow(unit="W", doc="enthalpy flow rate")

    pair = ("flowPort_a", "flowPort_b")
    across = "dp"
    through = "m_flow"
    power = False

    @classmethod
    def carried(cls, enters: Any, leaves: Any) -> Iterator[ac.Eq]:
        """A two-port without volume passes the enthalpy on, from the side where the flow comes from."""
        H_flow = enthalpy_flow(enters.m_flow, enters.h, leaves.h)
        yield ac.Eq(enters.H_flow, H_flow)
        yield ac.Eq(leaves.H_flow, -H_flow)


FlowPort_a = FlowPort
FlowPort_b = FlowPort
