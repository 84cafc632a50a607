"""Compressible hydraulics, pipes, valves and pumps: against closed forms."""

from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal.components import blocks, hydraulic as hyd, translational as tl
from acausal.components.hydraulic.liquid import OIL, WATER, Liquid


def number(value: Any) -> float:
    return float(value)


def test_air_makes_a_liquid_soft() -> None:
    liquid = Liquid(density=900.0, bulk_modulus=1e9, air=0.01, n=1.0, p_ambient=1e5)
    assert number(liquid.density_at(0.0)) == pytest.approx(900.0)
    volume = 0.99 * np.exp(-9e5 / 1e9) + 0.01 / 10
    assert number(liquid.density_at(9e5)) == pytest.approx(900 / volume)
    assert number(WATER.density_at(1e7)) == pytest.approx(997 * np.exp(1e7 / 2.09e9))
    with pytest.raises(ac.DeclarationError, match=r"fluid='oil' is no liquid"):
        hyd.FixedVolume(fluid="oil")


class Filling(ac.Component):
    """A vessel that is filled steadily, a pipe and a valve between two pressures, a pump that works on a valve."""

    def __init__(self) -> None:
        super().__init__()
        self.source = hyd.MassFlowSource_T(m_flow=0.01)
        self.vessel = hyd.FixedVolume(V=1e-3, fluid=OIL, p=ac.Start(0.0, fixed=True))
        self.high, self.low = hyd.Boundary_pT(p=2e5), hyd.FixedBoundary()
        pipes: dict[str, Any] = {"length": 10.0, "roughness": 1e-4}
        self.thin = hyd.StaticPipe(diameter=1e-3, **pipes)
        self.wide = hyd.StaticPipe(diameter=0.05, height_ab=5.0, **pipes)
        nominal: dict[str, Any] = {"dp_nominal": 1e5, "m_flow_nominal": 2.0}
        self.linear = hyd.ValveLinear(**nominal)
        self.valve = hyd.ValveIncompressible(**nominal)
        self.half = blocks.Constant(k=0.5)
        self.pump = hyd.PrescribedPump(N_const=750.0)
        self.load = hyd.ValveLinear(dp_nominal=1e5, m_flow_nominal=1.0)
        self.connect(self.source.port, self.vessel.port)
        for part in (self.thin, self.wide, self.linear, self.valve):
            self.connect(self.high.port, part.port_a)
            self.connect(part.port_b, self.low.port)
        for part in (self.linear, self.valve, self.load):
            self.connect(self.half.y, part.opening)
        self.connect(self.low.port, self.pump.port_a, self.load.port_b)
        self.connect(self.pump.port_b, self.load.port_a)


@pytest.mark.slow
def test_filling_pipes_valves_and_a_pump() -> None:
    found = ac.simulate(ac.compile(Filling()), (0, 2), saveat=np.linspace(0, 2, 5))
    mass = number(OIL.density_at(0.0)) * 1e-3 + 0.01 * np.linspace(0, 2, 5)
    for p, m in zip(np.asarray(found["vessel.p"])[1:], mass[1:], strict=True):
        assert number(OIL.density_at(float(p))) * 1e-3 == pytest.approx(m, rel=1e-7)
    mu = 1.0016e-3
    hagen = np.pi * 1e-3**4 / (128 * mu * 10) * 2e5 * 1000
    assert found["thin.m_flow"][-1] == pytest.approx(hagen, rel=1e-6)

    def drop(v: float) -> float:
        reynolds = 1000 * v * 0.05 / mu
        f = (-1.8 * np.log10((1e-4 / 0.05 / 3.7) ** 1.11 + 6.9 / reynolds)) ** -2
        return f * 10 / 0.05 * 1000 * v**2 / 2

    exact = brentq(lambda v: drop(v) - (2e5 - 1000 * 9.80665 * 5), 0.5, 20)
    assert found["wide.v"][-1] == pytest.approx(exact, rel=1e-6)
    assert found["linear.m_flow"][-1] == pytest.approx(0.5 * 2 * 2)
    assert found["valve.m_flow"][-1] == pytest.approx(0.5 * 2 * np.sqrt(2), rel=1e-4)
    flow, head = float(found["pump.V_flow"][-1]), float(found["pump.head"][-1])
    assert 1000 * flow == pytest.approx(0.5 / 1e5 * head * 9806.65, rel=1e-6)
    curve = np.polyfit([0, 0.001, 0.0015], [60, 30, 0], 2)
    assert head == pytest.approx(0.25 * np.polyval(curve, 2 * flow), rel=1e-6)


class Closed(ac.Component):
    """A tube that is closed at one end and open to a reservoir at the other."""

    def __init__(self) -> None:
        super().__init__()
        self.reservoir = hyd.Boundary(p=0.0)
        self.tube = hyd.Tube(length=20.0, diameter=0.02, n=6, roughness=0.0)
        self.connect(self.reservoir.port, self.tube.port_a)


def test_a_closed_tube_has_the_frequency_of_a_quarter_wave() -> None:
    modes = ac.linearize(ac.compile(Closed())).eigenvalues()
    slowest = np.abs(np.imag(modes)[np.abs(np.imag(modes)) > 1]).min()
    assert slowest == pytest.approx(np.pi * np.sqrt(2.09e9 / 997) / (2 * 20.0), rel=1e-2)
    assert (np.real(modes) < 0).all()


class Cylinder(ac.Component):
    """A cylinder that a spool valve moves against a spring."""

    def __init__(self) -> None:
        super().__init__()
        self.supply, self.tank = hyd.Boundary(p=1e7), hyd.Boundary(p=0.0)
        self.valve = hyd.SpoolValve2Way(width=0.01, fluid=OIL)
        self.cylinder = hyd.Actuator(
            area_a=1e-3, area_b=0.5e-3, length_a=0.2, length_b=0.3, m=5.0, d=2000.0, fluid=OIL
        )
        self.spring = tl.Spring(c=5e4)
        self.wall = tl.Fixed()
        self.spool = tl.Position(exact=True)
        self.way = blocks.Constant(k=1e-4)
        self.connect(self.way.y, self.spool.s_ref)
        self.connect(self.spool.flange, self.valve.flange)
        self.connect(self.supply.port, self.valve.port_s)
        self.connect(self.tank.port, self.valve.port_r)
        self.connect(self.valve.port_a, self.cylinder.port_a)
        self.connect(self.valve.port_b, self.cylinder.port_b)
        self.connect(self.cylinder.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.wall.flange)


@pytest.mark.slow
def test_a_cylinder_ends_where_spring_and_pressure_balance() -> None:
    found = ac.simulate(ac.compile(Cylinder()), (0, 30), saveat=[0.0, 0.05, 30.0])
    s, pa, pb = (
        np.asarray(found[f"cylinder.{n}"]) for n in ("piston.s", "chamber_a.p", "chamber_b.p")
    )
    assert s[1] > 0
    np.testing.assert_allclose([pa[-1], pb[-1]], [1e7, 0], atol=1e3)
    assert s[-1] == pytest.approx(1e7 * 1e-3 / 5e4, rel=1e-3)
