"""Bases of components with one or two flow ports: medium, energy balance, friction.

Parameters of `Modelica.Thermal.FluidHeatFlow` that Modelica leaves without a value but proposes zero or
293.15 K for have that as their default here.
"""

from collections.abc import Iterator
from typing import Any

import acausal as ac

from .interfaces import FlowPort
from .media import Medium
from .mixing import M_FLOW_SMALL, enthalpy_flow

__modelica__ = "Modelica.Thermal.FluidHeatFlow.BaseClasses"


class PartialMedium(ac.Component):
    """A component that is filled with a medium, a record of `acausal.components.fluid.media`."""

    __modelica__ = None

    medium = ac.Option(Medium(), doc="medium in the component")

    def modify(self, **modifiers: Any) -> None:
        """As of every component; the medium must be a record of a medium."""
        medium = modifiers.get("medium", self.medium)
        if not isinstance(medium, Medium):
            raise ac.DeclarationError(
                f"{type(self).__name__}: medium={medium!r} is not a medium; give a record such as fluid.Water()"
            )
        super().modify(**modifiers)


class TwoPort(PartialMedium):
    """Two flow ports and a mass ``m`` [kg] of medium between them, fully mixed at temperature ``T`` [K].

    ``dp = flowPort_a.p - flowPort_b.p`` [Pa], ``V_flow = flowPort_a.m_flow / rho`` [m3/s] from a to b,
    ``h = cp T``. The energy balance is ``flowPort_a.H_flow + flowPort_b.H_flow + Q_flow = m cv der(T)``; with
    ``m = 0``, given as a number, ``T`` is not a state. What the ports carry follows from the mixing rule
    `enthalpy_flow`. A subclass states ``Q_flow`` [W], the heat into the medium, and a relation between
    ``dp`` and ``V_flow``.

    ``T`` is the outlet temperature; that of a port, ``T_a`` or ``T_b``, is mixed with what else meets
    there. ``dT`` is the increase in the direction of flow, and ``T_q = T - sign(V_flow) (1 - tapT) dT``
    what a heat port sees: the outlet temperature with ``tapT = 1``, the inlet's with 0.
    """

    m = ac.Parameter(0.0, unit="kg", min=0, doc="mass of the medium")
    T0 = ac.Parameter(293.15, unit="K", doc="initial temperature of the medium")
    T0fixed = ac.Option(False, doc="whether T0 holds initially; else it is a guess")
    tapT = ac.Parameter(1.0, min=0, max=1, doc="where a heat port is, from inlet to outlet")
    rho = ac.Parameter(lambda self: self.medium.rho, unit="kg/m3", doc="density of the medium")
    cp = ac.Parameter(
        lambda self: self.medium.cp, unit="J/(kg.K)", doc="heat capacity at constant pressure"
    )
    cv = ac.Parameter(
        lambda self: self.medium.cv, unit="J/(kg.K)", doc="heat capacity at constant volume"
    )
    m_flow_small = ac.Parameter(M_FLOW_SMALL, unit="kg/s", min=0, doc="exchange at rest")
    dp = ac.Variable(unit="Pa", nominal=1e5, doc="pressure drop from a to b")
    V_flow = ac.Variable(unit="m3/s", doc="volume flow rate from a to b")
    Q_flow = ac.Variable(unit="W", doc="heat flow rate into the medium")
    T = ac.Variable(
        unit="K",
        start="T0",
        fixed="T0fixed",
        nominal=300.0,
        state="prefer",
        doc="outlet temperature",
    )
    T_a = ac.Variable(unit="K", nominal=300.0, doc="temperature at flowPort_a")
    T_b = ac.Variable(unit="K", nominal=300.0, doc="temperature at flowPort_b")
    dT = ac.Variable(unit="K", doc="temperature increase in the direction of flow")
    T_q = ac.Variable(unit="K", nominal=300.0, doc="temperature that a heat port sees")
    h = ac.Variable(unit="J/kg", nominal=1e5, doc="specific enthalpy of the medium")
    flowPort_a = FlowPort()
    flowPort_b = FlowPort()

    def modify(self, **modifiers: Any) -> None:
        """Change modifiers; a mass of zero counts as no mass, so that there is no state."""
        if modifiers.get("m") == 0:
            del modifiers["m"]
            self._node.modifiers.pop("m", None)
        super().modify(**modifiers)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a, b = self.flowPort_a, self.flowPort_b
        yield ac.Eq(self.dp, a.p - b.p)
        yield ac.Eq(self.V_flow, a.m_flow / self.rho)
        yield ac.Eq(self.T_a, a.h / self.cp)
        yield ac.Eq(self.T_b, b.h / self.cp)
        yield ac.Eq(self.dT, ac.where(self.V_flow >= 0, self.T - self.T_a, self.T_b - self.T))
        yield ac.Eq(self.h, self.cp * self.T)
        yield ac.Eq(self.T_q, self.T - ac.sign(self.V_flow) * (1 - self.tapT) * self.dT)
        yield ac.Eq(a.m_flow + b.m_flow, 0)
        yield ac.Eq(a.H_flow + b.H_flow + self.Q_flow, self.m * self.cv * ac.der(self.T))
        for port in (a, b):
            carried = enthalpy_flow(port.m_flow, port.h, self.h, self.m_flow_small)
            yield ac.Eq(port.H_flow, carried)


class PartialAdiabatic(TwoPort):
    """Two flow ports without heat exchange: ``Q_flow = 0``."""

    __modelica__ = None

    tapT = 1

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.Q_flow, 0)


class SimpleFriction(ac.Component):
    """Pressure drop ``pressureDrop`` [Pa] of a flow ``volumeFlow`` [m3/s]: linear, then quadratic.

    ``dpLaminar / V_flowLaminar volumeFlow``, and beyond ``V_flowLaminar`` in addition
    ``k (volumeFlow - V_flowLaminar)**2``, where ``k`` follows from the nominal point ``V_flowNominal``,
    ``dpNominal``; mirrored for negative flows. A part ``frictionLoss`` of the power lost,
    ``Q_friction = frictionLoss volumeFlow pressureDrop`` [W], heats the medium.

    ``V_flowNominal`` must exceed ``V_flowLaminar``, and ``dpNominal`` the linear drop there.
    """

    V_flowLaminar = ac.Parameter(unit="m3/s", min=0, doc="volume flow where the linear law ends")
    dpLaminar = ac.Parameter(unit="Pa", doc="pressure drop there")
    V_flowNominal = ac.Parameter(unit="m3/s", doc="nominal volume flow")
    dpNominal = ac.Parameter(unit="Pa", doc="nominal pressure drop")
    frictionLoss = ac.Parameter(
        0.0, min=0, max=1, doc="part of the friction losses that heats the medium"
    )
    pressureDrop = ac.Variable(unit="Pa", nominal=1e5, doc="pressure drop")
    volumeFlow = ac.Variable(unit="m3/s", doc="volume flow rate")
    Q_friction = ac.Variable(unit="W", doc="friction losses into the medium")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        v, v_l, v_n = self.volumeFlow, self.V_flowLaminar, self.V_flowNominal
        linear = self.dpLaminar / v_l
        k = (self.dpNominal - linear * v_n) / (v_n - v_l) ** 2
        turbulent = ac.where(
            v > v_l, k * (v - v_l) ** 2, ac.where(v < -v_l, -k * (v + v_l) ** 2, 0)
        )
        yield ac.Eq(self.pressureDrop, linear * v + turbulent)
        yield ac.Eq(self.Q_friction, self.frictionLoss * v * self.pressureDrop)


class PartialSinglePort(PartialMedium):
    """One flow port to a medium at temperature ``T`` [K]: ``h = cp T``, ``T_port = flowPort.h / cp``.

    With `Exchange` the port's enthalpy flow follows from the mixing rule `enthalpy_flow`; else the
    medium has the enthalpy of the port.
    """

    __modelica__ = None

    Exchange = True

    cp = ac.Parameter(
        lambda self: self.medium.cp, unit="J/(kg.K)", doc="heat capacity at constant pressure"
    )
    m_flow_small = ac.Parameter(M_FLOW_SMALL, unit="kg/s", min=0, doc="exchange at rest")
    T_port = ac.Variable(unit="K", nominal=300.0, doc="temperature at the port")
    T = ac.Variable(unit="K", start=293.15, nominal=300.0, doc="temperature of the medium")
    h = ac.Variable(unit="J/kg", nominal=1e5, doc="specific enthalpy of the medium")
    flowPort = FlowPort()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        port = self.flowPort
        yield ac.Eq(self.T_port, port.h / self.cp)
        yield ac.Eq(self.h, self.cp * self.T)
        if self.Exchange:
            carried = enthalpy_flow(port.m_flow, port.h, self.h, self.m_flow_small)
            yield ac.Eq(port.H_flow, carried)
        else:
            yield ac.Eq(self.h, port.h)


class SinglePortLeft(PartialSinglePort):
    """One flow port to a volume of medium that starts at temperature ``T0`` [K]."""

    T0 = ac.Parameter(293.15, unit="K", doc="initial temperature of the medium")
    T0fixed = ac.Option(False, doc="whether T0 holds initially; else it is a guess")
    rho = ac.Parameter(lambda self: self.medium.rho, unit="kg/m3", doc="density of the medium")
    T = ac.Variable(
        unit="K",
        start="T0",
        fixed="T0fixed",
        nominal=300.0,
        state="prefer",
        doc="temperature of the medium",
    )


SinglePortBottom = SinglePortLeft
