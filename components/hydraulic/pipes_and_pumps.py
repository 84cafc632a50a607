"""Pipe, valves, pump and boundaries by the names of `Modelica.Fluid`, for an incompressible liquid without heat."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.nature import g_n

from . import flow
from .interfaces import PartialTwoPortTransport
from .sources import Boundary, MassFlowSource
from .water import RHO


class Boundary_pT(Boundary):  # noqa: N801 (Modelica's name)
    """A `Boundary`; there is no temperature."""

    ICON = icons.marked(icons.AMBIENT, "T")


class FixedBoundary(Boundary):
    """A `Boundary`."""

    ICON = icons.marked(icons.AMBIENT, "=")


class MassFlowSource_T(MassFlowSource):  # noqa: N801 (Modelica's name)
    """A `MassFlowSource`; there is no temperature."""

    ICON = icons.marked(icons.PUMP, "T")


class StaticPipe(PartialTwoPortTransport):
    """Friction at the wall (Darcy and Weisbach, see `hydraulic.flow`) and a difference in height, without storage."""

    ICON = icons.PIPE

    length = ac.Parameter(unit="m", min=0, doc="length")
    diameter = ac.Parameter(unit="m", min=0, doc="inner diameter")
    height_ab = ac.Parameter(0.0, unit="m", doc="height of port_b above port_a")
    roughness = ac.Parameter(2.5e-5, unit="m", min=0, doc="height of the wall's unevenness")
    nParallel = ac.Parameter(1.0, min=0, doc="number of equal pipes in parallel")
    rho = ac.Parameter(RHO, unit="kg/m3", min=0, doc="density of the liquid")
    mu = ac.Parameter(1.0016e-3, unit="Pa.s", min=0, doc="dynamic viscosity of the liquid")
    g = ac.Parameter(g_n, unit="m/s2", min=0, doc="gravity")
    v = ac.Variable(unit="m/s", doc="mean velocity from a to b")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Assert(self.diameter > 0, "a pipe without width carries nothing")
        yield ac.Assert(self.nParallel > 0, "no pipe is there")
        area = self.nParallel * ac.pi * self.diameter**2 / 4
        yield ac.Eq(self.m_flow, self.rho * area * self.v)
        drop = flow.wall_friction(
            self.v, self.length, self.diameter, self.rho, self.mu, self.roughness
        )
        yield ac.Eq(self.dp, drop + self.rho * self.g * self.height_ab)


class ValveLinear(PartialTwoPortTransport):
    """``m_flow = opening m_flow_nominal/dp_nominal dp``."""

    ICON = icons.marked(icons.VALVE, "lin")

    dp_nominal = ac.Parameter(unit="Pa", min=0, doc="pressure drop where it is fully open")
    m_flow_nominal = ac.Parameter(unit="kg/s", min=0, doc="mass flow rate then")
    opening = ac.Input(unit="1", doc="opening, 0 to 1")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.m_flow, self.opening * self.m_flow_nominal / self.dp_nominal * self.dp)


class ValveIncompressible(PartialTwoPortTransport):
    """``m_flow = opening Av sqrt(rho |dp|) sign(dp)`` with the flow coefficient ``Av`` [m2].

    By default ``Av`` follows from ``m_flow_nominal`` at ``dp_nominal`` where it is fully open.
    """

    ICON = icons.marked(icons.VALVE, "√")

    dp_nominal = ac.Parameter(unit="Pa", min=0, doc="pressure drop where it is fully open")
    m_flow_nominal = ac.Parameter(unit="kg/s", min=0, doc="mass flow rate then")
    rho = ac.Parameter(RHO, unit="kg/m3", min=0, doc="density of the liquid")
    Av = ac.Parameter(
        lambda self: self.m_flow_nominal / ac.sqrt(self.rho * self.dp_nominal),
        unit="m2", min=0, doc="flow coefficient",
    )  # fmt: skip
    dp_small = ac.Parameter(
        lambda self: self.dp_nominal / 100,
        unit="Pa", min=0, doc="pressure drop around which flow reverses",
    )  # fmt: skip
    opening = ac.Input(unit="1", doc="opening, 0 to 1")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        root = flow.signed_root(self.dp, self.dp_small)
        yield ac.Eq(self.m_flow, self.opening * self.Av * ac.sqrt(self.rho) * root)


class PrescribedPump(PartialTwoPortTransport):
    """A centrifugal pump: ``head = r**2 (c1 + c2 V/r + c3 (V/r)**2)``, ``r = N/N_nominal``, through three points.

    ``head = (port_b.p - port_a.p)/(rho g)`` over the flow ``V = m_flow/rho`` is ``head_nominal`` at ``V_flow_nominal``
    where the speed is ``N_nominal``, and follows the laws of similarity; below the least of these flows it goes on
    along its tangent. With ``use_N_in`` the speed is the signal ``N_in`` [1/min]. Choose the points where the pump is
    made.
    """

    ICON = icons.PUMP

    V_flow_nominal = ac.Option((0.0, 0.001, 0.0015), doc="three volume flow rates in m3/s")
    head_nominal = ac.Option((60.0, 30.0, 0.0), doc="the heads in m there")
    N_nominal = ac.Parameter(1500.0, unit="1/min", min=0, doc="speed there")
    N_const = ac.Parameter(lambda self: self.N_nominal, unit="1/min", min=0, doc="constant speed")
    use_N_in = ac.Option(False, doc="whether the speed is a signal")
    N_in = ac.Input(unit="1/min", when="use_N_in", doc="speed")
    rho = ac.Parameter(RHO, unit="kg/m3", min=0, doc="density of the liquid")
    g = ac.Parameter(g_n, unit="m/s2", min=0, doc="gravity")
    head = ac.Variable(unit="m", doc="head that the pump gives")
    V_flow = ac.Variable(unit="m3/s", doc="volume flow rate")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        r = (self.N_in if self.use_N_in else self.N_const) / self.N_nominal
        yield ac.Eq(self.m_flow, self.rho * self.V_flow)
        yield ac.Eq(-self.dp, self.rho * self.g * self.head)
        yield ac.Eq(self.head, self._head(r))

    def _head(self, r: Any) -> Any:
        """The head at a relative speed: Lagrange's parabola, with the speed multiplied in so that it may be zero.

        Below the least flow it goes on along its tangent: the parabola would turn, and have a second flow for a head.
        """
        points = [float(v) for v in self.V_flow_nominal]
        if len(set(points)) != 3 or len(self.head_nominal) != 3:
            raise ac.DeclarationError(
                "PrescribedPump needs three different V_flow_nominal and as many head_nominal"
            )
        least = r * min(points)
        flow, below = ac.maximum(self.V_flow, least), ac.minimum(self.V_flow - least, 0)
        total = 0
        for i, height in enumerate(self.head_nominal):
            others = [v for k, v in enumerate(points) if k != i]
            weight = height / ((points[i] - others[0]) * (points[i] - others[1]))
            total += weight * (flow - r * others[0]) * (flow - r * others[1])
            total += weight * (2 * least - r * sum(others)) * below
        return total
