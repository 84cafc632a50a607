"""Pipes, valves, tanks and cylinders."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, nature
from acausal.components.thermal.interfaces import HeatPort
from acausal.components.translational.interfaces import PartialElementaryOneFlangeAndSupport2

from .bases import SimpleFriction, SinglePortBottom, SinglePortLeft, TwoPort

__modelica__ = "Modelica.Thermal.FluidHeatFlow.Components"


_X_SMALL = 1e-5


class Pipe(TwoPort, SimpleFriction):
    """A pipe with friction, a difference in height, and with ``useHeatPort`` heat exchange.

    ``dp = pressureDrop + rho g h_g``, where ``h_g`` [m] is how much higher ``flowPort_b`` lies, and the
    friction is that of `SimpleFriction`. The medium takes ``Q_flow = heatPort.Q_flow + Q_friction``, and
    ``heatPort.T = T_q``. See `TwoPort` for temperatures and the energy balance.

    Heat into a pipe without a flow warms its medium; if that has no mass, without limit.
    """

    ICON = icons.PIPE

    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    h_g = ac.Parameter(0.0, unit="m", doc="height of flowPort_b above flowPort_a")
    g = ac.Parameter(nature.g_n, unit="m/s2", min=0, doc="gravity")
    heatPort = HeatPort(when="useHeatPort")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.volumeFlow, self.V_flow)
        yield ac.Eq(self.dp, self.pressureDrop + self.rho * self.g * self.h_g)
        if self.useHeatPort:
            yield ac.Eq(self.heatPort.T, self.T_q)
            yield ac.Eq(self.Q_flow, self.heatPort.Q_flow + self.Q_friction)
        else:
            yield ac.Eq(self.Q_flow, self.Q_friction)


class _Valve(TwoPort):
    """What valves share: a part of the power lost, ``Q_flow = frictionLoss V_flow dp``, heats the medium."""

    ICON = icons.VALVE

    tapT = 1
    frictionLoss = ac.Parameter(
        0.0, min=0, max=1, doc="part of the friction losses that heats the medium"
    )

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.Q_flow, self.frictionLoss * self.V_flow * self.dp)


class Valve(_Valve):
    """A valve that a signal ``y`` opens, from 0 to ``y1``.

    With the opening ``o = min(max(y, 0), y1) / y1`` its standard flow rate is
    ``Kv = Kv1 (kv0 + (1 - kv0) o)``, or ``Kv = Kv1 kv0 exp(log(1/kv0) o)`` without
    ``LinearCharacteristic``. The pressure drop is ``dp = dp0 rho/rho0 x |x|`` with ``x = V_flow/Kv``; here
    ``|x|`` is ``sqrt(x**2 + 1e-10)``, so that a flow can be computed from a pressure drop of zero.
    """

    LinearCharacteristic = ac.Option(
        True, doc="whether the characteristic is linear; else exponential"
    )
    y1 = ac.Parameter(min=0, doc="greatest opening")
    Kv1 = ac.Parameter(unit="m3/s", min=0, doc="standard flow rate at the greatest opening")
    kv0 = ac.Parameter(min=0, max=1, doc="leakage flow at y = 0, relative to Kv1")
    dp0 = ac.Parameter(unit="Pa", doc="standard pressure drop")
    rho0 = ac.Parameter(unit="kg/m3", doc="standard density")
    Kv = ac.Variable(unit="m3/s", doc="standard flow rate")
    y = ac.Input(doc="opening")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        opening = ac.maximum(ac.minimum(self.y, self.y1), 0) / self.y1
        if self.LinearCharacteristic:
            relative = self.kv0 + (1 - self.kv0) * opening
        else:
            relative = self.kv0 * ac.exp(-ac.log(self.kv0) * opening)
        x = self.V_flow / self.Kv
        yield ac.Eq(self.Kv, self.Kv1 * relative)
        yield ac.Eq(self.dp, self.dp0 * self.rho / self.rho0 * x * ac.sqrt(x**2 + _X_SMALL**2))


class OneWayValve(_Valve):
    """A valve that lets flow pass from ``flowPort_a`` to ``flowPort_b`` only, like an ideal diode.

    Both are linear: forward ``dp / dpForward = V_flow / V_flowNominal``, backward a leakage
    ``V_flow / V_flowBackward = dp / dpNominal``. The common value of both sides is the variable ``s``, whose
    sign tells the direction (Modelica scales it otherwise); ``backward`` is 1 where it is negative, else 0.
    """

    ICON = icons.CHECK_VALVE

    V_flowNominal = ac.Parameter(unit="m3/s", min=0, doc="nominal volume flow, forward")
    dpForward = ac.Parameter(1e-6, unit="Pa", min=0, doc="pressure drop at nominal flow, forward")
    dpNominal = ac.Parameter(unit="Pa", min=0, doc="nominal pressure, backward")
    V_flowBackward = ac.Parameter(unit="m3/s", min=0, doc="leakage at nominal pressure, backward")
    backward = ac.Variable(doc="1 while flow is blocked, else 0")
    s = ac.Variable(doc="position on the characteristic")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        closed = self.s < 0
        yield ac.Eq(self.backward, ac.where(closed, 1, 0))
        yield ac.Eq(self.dp, self.s * ac.where(closed, self.dpNominal, self.dpForward))
        yield ac.Eq(self.V_flow, self.s * ac.where(closed, self.V_flowBackward, self.V_flowNominal))


class OpenTank(SinglePortBottom):
    """A tank under ambient pressure, fully mixed, with its port at the bottom.

    Mass ``m = rho ATank level`` with ``der(m) = flowPort.m_flow``; enthalpy ``H = m h`` with
    ``der(H) = flowPort.H_flow + Q_flow``, where ``Q_flow`` is the heat through the optional heat port;
    ``flowPort.p = pAmbient + m g / ATank``. ``level`` [m] and ``T`` [K] are preferred as states (Modelica
    leaves the choice among these and ``m``, ``H`` to the tool).

    Modelica stops a simulation whose level leaves ``[0, hTank]``; here it goes on, with a warning.
    """

    ICON = icons.TANK

    ATank = ac.Parameter(unit="m2", min=0, doc="cross section of the tank")
    hTank = ac.Parameter(unit="m", min=0, doc="height of the tank")
    pAmbient = ac.Parameter(0.0, unit="Pa", doc="ambient pressure")
    g = ac.Parameter(nature.g_n, unit="m/s2", min=0, doc="gravity")
    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    heatPort = HeatPort(when="useHeatPort")
    m = ac.Variable(unit="kg", doc="mass of the medium")
    H = ac.Variable(unit="J", nominal=1e5, doc="enthalpy of the medium")
    Q_flow = ac.Variable(unit="W", doc="heat flow rate into the medium")
    level = ac.Output(unit="m", state="prefer", doc="level of the medium")
    TTank = ac.Output(unit="K", start=293.15, nominal=300.0, doc="temperature of the medium")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        port, room = self.flowPort, 1e-6 * self.hTank
        yield ac.Assert(
            self.level >= -room, "the tank has run empty, and goes on below its bottom", "warning"
        )
        yield ac.Assert(
            self.level <= self.hTank + room,
            "the tank overflows, and goes on above its rim",
            "warning",
        )
        m = self.rho * self.ATank * self.level
        yield ac.Eq(self.TTank, self.T)
        yield ac.Eq(self.m, m)
        yield ac.Eq(self.H, self.m * self.h)
        yield ac.Eq(ac.der(m), port.m_flow)
        yield ac.Eq(ac.der(m * self.cp * self.T), port.H_flow + self.Q_flow)
        yield ac.Eq(port.p, self.pAmbient + self.m * self.g / self.ATank)
        if self.useHeatPort:
            yield ac.Eq(self.heatPort.T, self.T)
            yield ac.Eq(self.heatPort.Q_flow, self.Q_flow)
        else:
            yield ac.Eq(self.Q_flow, 0)


class Cylinder(SinglePortLeft, PartialElementaryOneFlangeAndSupport2):
    """A cylinder with a massless piston at position ``s`` [m], measured from its bottom.

    ``flowPort.p A = -flange.f``; mass ``m = rho A s`` with ``der(m) = flowPort.m_flow``, enthalpy ``H = m h``
    with ``der(H) = flowPort.H_flow``. Modelica stops a simulation whose piston leaves ``(0, L]``; here it
    goes on, with a warning, but its temperature is undefined at ``s = 0``.
    """

    ICON = icons.CYLINDER

    A = ac.Parameter(unit="m2", min=0, doc="cross section of the piston")
    L = ac.Parameter(unit="m", min=0, doc="length of the cylinder")
    f = ac.Variable(unit="N", doc="force at the piston, = flange.f")
    m = ac.Variable(unit="kg", doc="mass of the medium")
    H = ac.Variable(unit="J", nominal=1e5, doc="enthalpy of the medium")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        port = self.flowPort
        room = 1e-6 * self.L
        yield ac.Assert(
            self.s >= -room, "the piston has passed the bottom of the cylinder", "warning"
        )
        yield ac.Assert(self.s <= self.L + room, "the piston has left the cylinder", "warning")
        m = self.rho * self.A * self.s
        yield ac.Eq(self.f, self.flange.f)
        yield ac.Eq(port.p * self.A, -self.f)
        yield ac.Eq(self.m, m)
        yield ac.Eq(self.H, self.m * self.h)
        yield ac.Eq(ac.der(m), port.m_flow)
        yield ac.Eq(ac.der(m * self.cp * self.T), port.H_flow)
