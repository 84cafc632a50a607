"""Tanks, resistances, orifices and weirs."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.nature import g_n

from .interfaces import FluidPort, PartialTwoPortTransport
from .water import RHO


class OpenTank(ac.Component):
    """A tank that is open to the air, with a port at the bottom and one above the liquid.

    ``rho crossArea der(level) = port.m_flow + topPort.m_flow``. At the bottom the liquid's weight adds to the air's
    pressure, ``port.p = p_ambient + rho g level``; what enters at the top falls in freely, ``topPort.p = p_ambient``.
    ``level`` [m] is preferred as a state. A rim is a `Weir` at ``port``.
    """

    ICON = icons.TANK

    crossArea = ac.Parameter(unit="m2", min=0, doc="cross section of the tank")
    rho = ac.Parameter(RHO, unit="kg/m3", min=0, doc="density of the liquid")
    g = ac.Parameter(g_n, unit="m/s2", min=0, doc="gravity")
    p_ambient = ac.Parameter(0.0, unit="Pa", doc="pressure of the air")
    level = ac.Output(unit="m", state="prefer", doc="level of the liquid above the bottom")
    port = FluidPort()
    topPort = FluidPort()

    def equations(self) -> Iterator[Any]:
        yield ac.Assert(
            self.level >= -1e-6, "the tank has run empty, and goes on below its bottom", "warning"
        )
        rate = self.rho * self.crossArea * ac.der(self.level)
        yield ac.Eq(rate, self.port.m_flow + self.topPort.m_flow)
        yield ac.Eq(self.port.p, self.p_ambient + self.rho * self.g * self.level)
        yield ac.Eq(self.topPort.p, self.p_ambient)


class LinearResistance(PartialTwoPortTransport):
    """Laminar flow: ``m_flow = k dp``."""

    ICON = icons.marked(icons.ORIFICE, "lin")

    k = ac.Parameter(unit="kg/(s.Pa)", min=0, doc="hydraulic conductance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.m_flow, self.k * self.dp)


class Orifice(PartialTwoPortTransport):
    """A sharp hole, in both directions: ``m_flow = C_d area sqrt(2 rho |dp|) sign(dp)``.

    Bernoulli's law, and Torricelli's where the pressure is that of a tank's bottom. So that its derivative is finite
    without a pressure drop, the root is ``dp / (dp**2 + dp_small**2)**(1/4)``, as in Modelica's
    ``Fluid.Utilities.regRoot``.
    """

    ICON = icons.ORIFICE

    area = ac.Parameter(unit="m2", min=0, doc="cross section of the hole")
    C_d = ac.Parameter(0.61, min=0, doc="discharge coefficient")
    rho = ac.Parameter(RHO, unit="kg/m3", min=0, doc="density of the liquid")
    dp_small = ac.Parameter(1.0, unit="Pa", min=0, doc="pressure drop around which flow reverses")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        root = self.dp / (self.dp**2 + self.dp_small**2) ** 0.25
        yield ac.Eq(self.m_flow, self.C_d * self.area * ac.sqrt(2 * self.rho) * root)


class Weir(PartialTwoPortTransport):
    """A rim that liquid flows over (Poleni): ``m_flow = 2/3 C_d width rho sqrt(2 g) h**(3/2)``.

    ``h = max((port_a.p - p_ambient) / (rho g) - height, 0)`` [m] is how high the liquid stands above the rim, where
    ``port_a`` is connected to the port at a tank's bottom. Behind the rim it falls: the pressure at ``port_b`` does
    not matter, and nothing comes back.
    """

    ICON = icons.WEIR

    height = ac.Parameter(unit="m", doc="height of the rim above the tank's bottom")
    width = ac.Parameter(unit="m", min=0, doc="length of the rim that is flown over")
    C_d = ac.Parameter(0.61, min=0, doc="discharge coefficient")
    rho = ac.Parameter(RHO, unit="kg/m3", min=0, doc="density of the liquid")
    g = ac.Parameter(g_n, unit="m/s2", min=0, doc="gravity")
    p_ambient = ac.Parameter(0.0, unit="Pa", doc="pressure of the air")
    h = ac.Variable(unit="m", doc="height of the liquid above the rim, or zero")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        level = (self.port_a.p - self.p_ambient) / (self.rho * self.g)
        per_width = 2 / 3 * self.C_d * self.rho * ac.sqrt(2 * self.g) * self.h**1.5
        yield ac.Eq(self.h, ac.maximum(level - self.height, 0))
        yield ac.Eq(self.m_flow, self.width * per_width)


class StaticHead(PartialTwoPortTransport):
    """A difference in height without friction: ``dp = rho g height_ab``."""

    ICON = icons.HEAD

    height_ab = ac.Parameter(unit="m", doc="height of port_b above port_a")
    rho = ac.Parameter(RHO, unit="kg/m3", min=0, doc="density of the liquid")
    g = ac.Parameter(g_n, unit="m/s2", min=0, doc="gravity")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.dp, self.rho * self.g * self.height_ab)
