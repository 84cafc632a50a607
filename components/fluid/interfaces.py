"""The flow port."""

from collections.abc import Iterator
from typing import Any

import acausal as ac

from .mixing import enthalpy_flow

__modelica__ = "Modelica.Thermal.FluidHeatFlow.Interfaces"


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
    COLOR = "#2f8fd0"

    @classmethod
    def carried(cls, enters: Any, leaves: Any) -> Iterator[ac.Eq]:
        """A two-port without volume passes the enthalpy on, from the side where the flow comes from."""
        H_flow = enthalpy_flow(enters.m_flow, enters.h, leaves.h)
        yield ac.Eq(enters.H_flow, H_flow)
        yield ac.Eq(leaves.H_flow, -H_flow)


FlowPort_a = FlowPort
FlowPort_b = FlowPort
