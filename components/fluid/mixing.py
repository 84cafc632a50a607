"""How a flow carries enthalpy through a port."""

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
