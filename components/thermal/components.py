"""Storage, conduction, convection and radiation; adaptors to signals come from their own module."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import Element1D, HeatPort

__modelica__ = "Modelica.Thermal.HeatTransfer.Components"


class HeatCapacitor(ac.Component):
    """Heat storage at one temperature: ``C der(T) = port.Q_flow``, ``T = port.T``, ``der_T = der(T)``.

    ``T`` [K] is preferred as a state; its start value is a guess unless it is given as fixed.
    """

    ICON = icons.HEAT_CAPACITY

    C = ac.Parameter(unit="J/K", min=0, doc="heat capacity")
    T = ac.Variable(unit="K", start=293.15, nominal=300.0, state="prefer", doc="temperature")
    der_T = ac.Variable(unit="K/s", doc="rate of the temperature")
    port = HeatPort()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.T, self.port.T)
        yield ac.Eq(self.der_T, ac.der(self.T))
        yield ac.Eq(self.C * ac.der(self.T), self.port.Q_flow)


class ThermalConductor(Element1D):
    """Heat conduction: ``Q_flow = G dT``."""

    ICON = icons.CONDUCTION

    G = ac.Parameter(unit="W/K", doc="thermal conductance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.Q_flow, self.G * self.dT)


class ThermalResistor(Element1D):
    """Heat conduction by a resistance, which may be zero: ``dT = R Q_flow``."""

    ICON = icons.marked(icons.CONDUCTION, "R")

    R = ac.Parameter(unit="K/W", doc="thermal resistance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.dT, self.R * self.Q_flow)


class BodyRadiation(Element1D):
    """Heat radiation between two bodies: ``Q_flow = Gr sigma (port_a.T**4 - port_b.T**4)``.

    For a small convex body in a large enclosure ``Gr`` is its emissivity times its surface.
    """

    ICON = icons.RADIATION

    Gr = ac.Parameter(unit="m2", doc="net radiation conductance")
    sigma = ac.Parameter(5.670374419184429e-8, unit="W/(m2.K4)", doc="Stefan-Boltzmann constant")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.Q_flow, self.Gr * self.sigma * (self.port_a.T**4 - self.port_b.T**4))


class _Convection(ac.Component):
    """What convective elements share: heat flows from ``solid`` to ``fluid``.

    ``dT = solid.T - fluid.T`` [K], ``solid.Q_flow = Q_flow``, ``fluid.Q_flow = -Q_flow`` [W].
    """

    ICON = icons.CONVECTION

    solid = HeatPort()
    fluid = HeatPort()
    Q_flow = ac.Variable(unit="W", doc="heat flow rate from solid to fluid")
    dT = ac.Variable(unit="K", doc="solid.T - fluid.T")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.dT, self.solid.T - self.fluid.T)
        yield ac.Eq(self.solid.Q_flow, self.Q_flow)
        yield ac.Eq(self.fluid.Q_flow, -self.Q_flow)


class Convection(_Convection):
    """Heat convection with a conductance that is a signal: ``Q_flow = Gc dT``."""

    Gc = ac.Input(unit="W/K", doc="convective thermal conductance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.Q_flow, self.Gc * self.dT)


class ConvectiveResistor(_Convection):
    """Heat convection with a resistance that is a signal, and may be zero: ``dT = Rc Q_flow``."""

    ICON = icons.marked(icons.CONVECTION, "R")

    Rc = ac.Input(unit="K/W", doc="convective thermal resistance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.dT, self.Rc * self.Q_flow)


class _Collector(ac.Component):
    """What collectors share: ``port_b`` carries the heat of all ports ``port_a`` at one temperature."""

    port_b = HeatPort()

    def __init__(self, n: int, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.port_a = [HeatPort() for _ in range(n)]

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.port_b.Q_flow + sum(port.Q_flow for port in self.port_a), 0)
        for port in self.port_a:
            yield ac.Eq(port.T, self.port_b.T)


class ThermalCollector(_Collector):
    """Joins ``m`` heat ports ``port_a[1]`` to ``port_a[m]`` with ``port_b``.

    All have one temperature, and ``port_b.Q_flow + sum(port_a.Q_flow) = 0``.
    """

    ICON = icons.TEE

    m = ac.Option(3, min=1, doc="number of heat ports that are collected")

    def __init__(self, *, m: int = 3, **modifiers: Any) -> None:
        super().__init__(m, m=m, **modifiers)


class ThermalCollectorMatrix(_Collector):
    """Joins ``Ns`` rows of ``Np`` heat ports with ``port_b``, as `ThermalCollector` does.

    The ports are numbered row by row: Modelica's ``port_a[i,j]`` is ``port_a[(i - 1) Np + j]`` here.
    """

    ICON = icons.marked(icons.TEE, "n×m")

    Ns = ac.Option(None, doc="number of rows")
    Np = ac.Option(None, doc="number of columns")

    def __init__(self, *, Ns: int, Np: int, **modifiers: Any) -> None:
        super().__init__(Ns * Np, Ns=Ns, Np=Np, **modifiers)
