"""Hydraulics with a compressible liquid: volumes, tubes, valves, actuators; pressures count from the ambience."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, translational
from acausal.components.mechanics.translational import Flange_a, Flange_b

from . import flow, liquid
from .interfaces import FluidPort, FluidPort_a, FluidPort_b, PartialTwoPortTransport


class _Filled(ac.Component):
    """A component with a liquid in it."""

    fluid = ac.Option(liquid.WATER, doc="the liquid, a hydraulic.liquid.Liquid")

    def modify(self, **modifiers: Any) -> None:
        """As of every component; the liquid must be a record of one."""
        fluid = modifiers.get("fluid", self.fluid)
        if not isinstance(fluid, liquid.Liquid):
            raise ac.DeclarationError(
                f"{type(self).__name__}: fluid={fluid!r} is no liquid; give hydraulic.liquid.Liquid(...)"
            )
        super().modify(**modifiers)


class _Storage(_Filled):
    """A volume of liquid at one pressure: ``der(m) = port.m_flow``, ``m = rho V``."""

    ICON = icons.TANK

    port = FluidPort()
    p = ac.Variable(unit="Pa", nominal=1e5, state="prefer", doc="pressure")
    rho = ac.Variable(unit="kg/m3", nominal=1e3, doc="density")
    m = ac.Variable(unit="kg", doc="mass of the liquid")

    @property
    def _volume(self) -> Any:
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.p, self.port.p)
        density = self.fluid.density_at(self.p)
        yield ac.Eq(self.rho, density)
        yield ac.Eq(self.m, self.rho * self._volume)
        yield ac.Eq(ac.der(density * self._volume), self.port.m_flow)


class FixedVolume(_Storage):
    """Liquid in a stiff vessel of the volume ``V`` [m3]."""

    ICON = icons.VESSEL

    V = ac.Parameter(unit="m3", min=0, doc="volume")

    @property
    def _volume(self) -> Any:
        return self.V


class DynamicVolume(_Storage):
    """Liquid behind a piston: ``V = V_dead + area x``, ``x = direction (flange.s - s_0)``; it pushes by ``p area``.

    With ``direction=1`` the volume grows with ``flange.s``, with -1 it shrinks.
    """

    ICON = icons.PISTON

    area = ac.Parameter(unit="m2", min=0, doc="area of the piston")
    V_dead = ac.Parameter(0.0, unit="m3", min=0, doc="volume where x = 0")
    s_0 = ac.Parameter(0.0, unit="m", doc="position of the piston where x = 0")
    direction = ac.Option(1, choices=(1, -1), doc="whether the volume grows with flange.s")
    flange = Flange_b()
    V = ac.Variable(unit="m3", doc="volume")

    @property
    def _volume(self) -> Any:
        return self.V

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        x = self.direction * (self.flange.s - self.s_0)
        yield ac.Eq(self.V, self.V_dead + self.area * x)
        yield ac.Eq(self.flange.f, -self.direction * self.area * self.p)


class TubeSegment(PartialTwoPortTransport, _Filled):
    """A piece of tube without storage: friction at the wall, and with ``inertia`` the liquid's mass.

    ``dp = dp_friction + length/A der(m_flow)``; the friction is Darcy's and Weisbach's, see `hydraulic.flow`.
    """

    ICON = icons.marked(icons.PIPE, "1")

    length = ac.Parameter(unit="m", min=0, doc="length")
    diameter = ac.Parameter(unit="m", min=0, doc="inner diameter")
    roughness = ac.Parameter(2.5e-5, unit="m", min=0, doc="height of the wall's unevenness")
    inertia = ac.Option(False, doc="whether the liquid's mass counts")
    v = ac.Variable(unit="m/s", doc="mean velocity from a to b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        area = ac.pi * self.diameter**2 / 4
        rho = self.fluid.density_at((self.port_a.p + self.port_b.p) / 2)
        yield ac.Eq(self.m_flow, rho * area * self.v)
        drop = flow.wall_friction(
            self.v, self.length, self.diameter, rho, self.fluid.viscosity, self.roughness
        )
        inertia = self.length / area * ac.der(self.m_flow) if self.inertia else 0
        yield ac.Eq(self.dp, drop + inertia)


class Tube(_Filled):
    """A tube of ``n`` pieces with friction at the wall, inertia and the liquid's elasticity.

    The parts are ``segment[i]`` (`TubeSegment`) and, at the ends of all pieces, ``volume[i]`` (`FixedVolume`), of which
    those at both ends of the tube have half the volume of a piece. Waves are resolved by ``n`` pieces.
    """

    ICON = icons.marked(icons.PIPE, "n")

    length = ac.Parameter(unit="m", min=0, doc="length")
    diameter = ac.Parameter(unit="m", min=0, doc="inner diameter")
    roughness = ac.Parameter(2.5e-5, unit="m", min=0, doc="height of the wall's unevenness")
    n = ac.Option(1, min=1, doc="number of pieces")
    inertia = ac.Option(True, doc="whether the liquid's mass counts")
    port_a = FluidPort_a()
    port_b = FluidPort_b()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        n = int(self.n)
        piece = self.length / n
        volume = ac.pi * self.diameter**2 / 4 * piece
        shared: dict[str, Any] = {"fluid": self.fluid}
        self.segment: Any = [
            TubeSegment(
                length=piece, diameter=self.diameter, roughness=self.roughness,
                inertia=self.inertia, **shared,
            )
            for _ in range(n)
        ]  # fmt: skip
        self.volume: Any = [
            FixedVolume(V=volume if 0 < i < n else volume / 2, **shared) for i in range(n + 1)
        ]
        self.connect(self.port_a, self.volume[0].port)
        for i, segment in enumerate(self.segment):
            self.connect(self.volume[i].port, segment.port_a)
            self.connect(segment.port_b, self.volume[i + 1].port)
        self.connect(self.volume[n].port, self.port_b)


class _Throttle(PartialTwoPortTransport, _Filled):
    """A sharp opening: ``m_flow = C_d area sqrt(2 rho |dp|) sign(dp)`` with the density upstream."""

    ICON = icons.ORIFICE

    C_d = ac.Parameter(0.61, min=0, doc="discharge coefficient")
    dp_small = ac.Parameter(1e3, unit="Pa", min=0, doc="pressure drop around which flow reverses")
    area_least = ac.Parameter(0.0, unit="m2", min=0, doc="area of the leak where it is closed")

    @property
    def _opening(self) -> Any:
        """The area that is open, or a negative one."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        upstream = self.fluid.density_at(ac.maximum(self.port_a.p, self.port_b.p))
        area = ac.maximum(self._opening, self.area_least)
        root = flow.signed_root(self.dp, self.dp_small)
        yield ac.Eq(self.m_flow, self.C_d * area * ac.sqrt(2 * upstream) * root)


class Valve(_Throttle):
    """An opening with the ``area`` [m2] as signal."""

    ICON = icons.VALVE

    area = ac.Input(unit="m2", doc="area that is open; closed below zero")

    @property
    def _opening(self) -> Any:
        return self.area


class SpoolValve(_Throttle):
    """An opening of the ``width`` [m] that a spool clears: ``area = width direction (flange.s - s_0)``."""

    ICON = icons.SPOOL

    width = ac.Parameter(unit="m", min=0, doc="width of the opening, the spool's circumference")
    s_0 = ac.Parameter(0.0, unit="m", doc="position of the spool where it opens")
    direction = ac.Option(1, choices=(1, -1), doc="whether it opens with flange.s")
    flange = Flange_a()

    @property
    def _opening(self) -> Any:
        return self.width * self.direction * (self.flange.s - self.s_0)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange.f, 0)


class SpoolValve2Way(_Filled):
    """A spool between four edges: for ``flange.s > 0`` from ``port_s`` to ``port_a`` and from ``port_b`` to ``port_r``.

    For ``flange.s < 0`` it is from ``port_s`` to ``port_b`` and from ``port_a`` to ``port_r``. The edges are the parts
    ``supply_a``, ``supply_b``, ``return_a`` and ``return_b``, each a `SpoolValve`.
    """

    ICON = icons.SPOOL_4

    width = ac.Parameter(unit="m", min=0, doc="width of the openings")
    C_d = ac.Parameter(0.61, min=0, doc="discharge coefficient")
    overlap = ac.Parameter(0.0, unit="m", doc="way of the spool until an edge opens")
    area_least = ac.Parameter(0.0, unit="m2", min=0, doc="area of the leak of a closed edge")
    port_s = FluidPort()
    port_r = FluidPort()
    port_a = FluidPort_a()
    port_b = FluidPort_b()
    flange = Flange_a()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)

        def edge(direction: int) -> SpoolValve:
            return SpoolValve(
                width=self.width, C_d=self.C_d, s_0=direction * self.overlap, direction=direction,
                area_least=self.area_least, fluid=self.fluid,
            )  # fmt: skip

        self.supply_a, self.return_b = edge(1), edge(1)
        self.supply_b, self.return_a = edge(-1), edge(-1)
        self.connect(self.port_s, self.supply_a.port_a, self.supply_b.port_a)
        self.connect(self.port_a, self.supply_a.port_b, self.return_a.port_a)
        self.connect(self.port_b, self.supply_b.port_b, self.return_b.port_a)
        self.connect(self.port_r, self.return_a.port_b, self.return_b.port_b)
        edges = (self.supply_a, self.supply_b, self.return_a, self.return_b)
        self.connect(self.flange, *(one.flange for one in edges))


class Actuator(_Filled):
    """A cylinder: a piston of the mass ``m`` between two chambers.

    Pressure at ``port_a`` pushes to greater ``flange.s``. The parts are ``chamber_a`` and ``chamber_b``
    (`DynamicVolume`), ``piston`` (a `Mass`) and ``seal`` (a `Damper`). At ``s = 0`` the chambers have the lengths
    ``length_a`` and ``length_b``.
    """

    ICON = icons.CYLINDER

    area_a = ac.Parameter(unit="m2", min=0, doc="area of the piston in chamber a")
    area_b = ac.Parameter(lambda self: self.area_a, unit="m2", min=0, doc="area in chamber b")
    length_a = ac.Parameter(unit="m", min=0, doc="length of chamber a where s = 0")
    length_b = ac.Parameter(lambda self: self.length_a, unit="m", min=0, doc="that of chamber b")
    m = ac.Parameter(1.0, unit="kg", min=0, doc="mass of the piston")
    d = ac.Parameter(0.0, unit="N.s/m", min=0, doc="damping of the seal")
    port_a = FluidPort_a()
    port_b = FluidPort_b()
    flange = Flange_b()

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.chamber_a = DynamicVolume(
            area=self.area_a, V_dead=self.area_a * self.length_a, fluid=self.fluid
        )
        self.chamber_b = DynamicVolume(
            area=self.area_b, V_dead=self.area_b * self.length_b, direction=-1, fluid=self.fluid
        )
        self.piston = translational.Mass(m=self.m)
        self.seal = translational.Damper(d=self.d)
        self.housing = translational.Fixed()
        self.connect(self.port_a, self.chamber_a.port)
        self.connect(self.port_b, self.chamber_b.port)
        self.connect(self.piston.flange_a, self.chamber_a.flange, self.chamber_b.flange)
        self.connect(self.piston.flange_a, self.seal.flange_b)
        self.connect(self.seal.flange_a, self.housing.flange)
        self.connect(self.piston.flange_b, self.flange)

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        s = self.piston.s
        yield ac.Assert(
            s >= -self.length_a, "the piston has passed the end of chamber a", "warning"
        )
        yield ac.Assert(s <= self.length_b, "the piston has passed the end of chamber b", "warning")
