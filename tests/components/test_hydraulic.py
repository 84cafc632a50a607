"""Hydraulics: declarations, and a bench of tanks with analytic responses."""

import inspect

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, hydraulic as hy
from acausal.flattening.flat_model import flatten

RHO, G, AREA = 1000.0, 9.80665, 0.01
HOLE, C_D, T = 1e-4, 0.61, np.linspace(0.0, 40.0, 401)


def minimal(cls, **given):
    """An instance with the value 1 for all that must be given."""
    declared = cls._declared.items()
    needed = {n: 1.0 for n, d in declared if isinstance(d, ac.Parameter) and d.default is None}
    return cls(**{**needed, **given})


CONCRETE = [n for n in hy.__all__ if n[0].isupper() and not n.startswith(("Partial", "FluidPort"))]


@pytest.mark.parametrize("name", CONCRETE)
def test_every_class_is_documented_and_has_as_many_equations_as_unknowns(name):
    assert inspect.getdoc(getattr(hy, name))
    model = flatten(minimal(getattr(hy, name)))
    assert model.n_equations == model.n_variables - len(model.inputs)


@pytest.mark.parametrize(
    "component", [hy.Boundary(use_p_in=True), hy.MassFlowSource(use_m_flow_in=True)], ids=repr
)
def test_options_keep_the_balance(component):
    model = flatten(component)
    assert len(model.inputs) == 1
    assert model.n_equations == model.n_variables - 1


def tank(level, **given):
    return hy.OpenTank(crossArea=AREA, level=ac.Start(level, fixed=True), **given)


class Bench(ac.Component):
    """Experiments side by side, so that one program simulates all."""

    def __init__(self):
        super().__init__()
        self.ground = hy.Boundary()
        # a tank drains through a hole, under air of 1 bar
        self.torricelli = tank(0.5, p_ambient=1e5)
        self.hole, self.air = hy.Orifice(area=HOLE, dp_small=1e-3), hy.Boundary(p=1e5)
        self.connect(self.torricelli.port, self.hole.port_a)
        self.connect(self.hole.port_b, self.air.port)
        # two tanks exchange water through a pipe with sensors
        self.left, self.right = tank(0.6), tank(0.2)
        self.pipe, self.rate = hy.LinearResistance(k=1e-4), hy.MassFlowRate()
        self.volume, self.drop = hy.VolumeFlowRate(), hy.RelativePressure()
        self.connect(self.left.port, self.pipe.port_a, self.drop.port_a)
        self.connect(self.pipe.port_b, self.rate.port_a, self.drop.port_b)
        self.connect(self.rate.port_b, self.volume.port_a)
        self.connect(self.volume.port_b, self.right.port)
        # a pump fills a tank from above until as much goes over the rim, and half of that into another one
        self.pump, self.full, self.below = hy.MassFlowSource(m_flow=0.2), tank(0.3), tank(0.0)
        self.over, self.past = (hy.Weir(height=0.3, width=0.02) for _ in range(2))
        self.connect(self.pump.port, self.full.topPort)
        self.connect(self.full.port, self.over.port_a, self.past.port_a)
        self.connect(self.over.port_b, self.below.topPort)
        self.connect(self.past.port_b, self.ground.port)
        # a riser between two tanks whose bottoms lie 0.1 m apart
        self.low, self.high = tank(0.4), tank(0.1)
        self.riser, self.hose = hy.StaticHead(height_ab=0.1), hy.LinearResistance(k=1e-3)
        self.gauge = hy.Pressure()
        self.connect(self.low.port, self.riser.port_a, self.gauge.port)
        self.connect(self.riser.port_b, self.hose.port_a)
        self.connect(self.hose.port_b, self.high.port)


@pytest.fixture(scope="module")
def run():
    system = ac.compile(Bench())
    assert set(system.states) == {
        f"{n}.level"
        for n in ("torricelli", "left", "right", "full", "below", "low", "high")
    }  # fmt: skip
    return ac.simulate(system, (0.0, T[-1]), dt=T[1], solver="rk4")


def test_a_tank_drains_as_torricelli_says(run):
    """The root of the level falls linearly with time."""
    rate = C_D * HOLE / AREA * np.sqrt(2 * G)
    expected = (np.sqrt(0.5) - rate * T / 2) ** 2
    np.testing.assert_allclose(run["torricelli.level"], expected, rtol=1e-6)


def test_levels_meet_and_no_water_is_lost(run):
    left, right = np.asarray(run["left.level"]), np.asarray(run["right.level"])
    fades = 2 * 1e-4 * G / AREA
    np.testing.assert_allclose(left - right, 0.4 * np.exp(-fades * T), rtol=1e-5)
    np.testing.assert_allclose(left + right, 0.8, rtol=1e-12)
    flow = 1e-4 * RHO * G * (left - right)
    np.testing.assert_allclose(run["rate.m_flow"], flow)
    np.testing.assert_allclose(run["volume.V_flow"], flow / RHO)
    np.testing.assert_allclose(run["drop.p_rel"], RHO * G * (left - right))


def test_what_a_pump_brings_goes_over_the_rim(run):
    over, past = np.asarray(run["over.m_flow"]), np.asarray(run["past.m_flow"])
    np.testing.assert_allclose(over, past)
    assert over[0] == pytest.approx(0, abs=1e-12)
    assert over[-1] + past[-1] == pytest.approx(0.2, rel=1e-3)
    head = (0.2 / (2 / 3 * C_D * 0.04 * RHO * np.sqrt(2 * G))) ** (2 / 3)
    assert float(run["full.level"][-1]) == pytest.approx(0.3 + head, rel=1e-3)
    stored = RHO * AREA * (np.asarray(run["full.level"]) - 0.3 + np.asarray(run["below.level"]))
    lost = np.concatenate([[0], np.cumsum((past[1:] + past[:-1]) / 2) * T[1]])
    np.testing.assert_allclose(stored + lost, 0.2 * T, atol=2e-3)


def test_a_head_keeps_levels_apart(run):
    assert float(run["low.level"][-1]) == pytest.approx(0.3, abs=1e-3)
    assert float(run["high.level"][-1]) == pytest.approx(0.2, abs=1e-3)
    np.testing.assert_allclose(run["gauge.p"], RHO * G * np.asarray(run["low.level"]))


def test_an_orifice_lets_flow_pass_in_both_directions():
    """The same law mirrored, and with a finite derivative at rest."""

    class Hole(ac.Component):
        def __init__(self):
            super().__init__()
            self.hole = hy.Orifice(area=HOLE)
            self.source, self.drain = hy.Boundary(use_p_in=True), hy.Boundary()
            self.connect(self.source.port, self.hole.port_a)
            self.connect(self.hole.port_b, self.drain.port)

    system = ac.compile(Hole())
    at = {
        p: float(system.observe("hole.m_flow", 0.0, np.zeros(0), np.array([p]), system.parameters()))
        for p in (-1e4, 0.0, 1e-3, 1e4)
    }  # fmt: skip
    assert at[1e4] == -at[-1e4] == pytest.approx(C_D * HOLE * np.sqrt(2 * RHO * 1e4))
    assert at[0.0] == 0
    assert at[1e-3] == pytest.approx(C_D * HOLE * np.sqrt(2 * RHO) * 1e-3, rel=1e-5)


class Lift(ac.Component):
    """A pump that fills a tank through a valve, beside one that is closed."""

    def __init__(self):
        super().__init__()
        self.well, self.pump, self.top, self.other = (
            hy.Boundary(p=0.0),
            hy.PrescribedPump(),
            tank(3.0),
            tank(0.1),
        )
        self.open, self.closed = (
            hy.ValveIncompressible(dp_nominal=1e5, m_flow_nominal=1.0) for _ in range(2)
        )
        self.opening = [blocks.Constant(k=k) for k in (1.0, 0.0)]
        self.connect(self.well.port, self.pump.port_a)
        self.connect(self.pump.port_b, self.open.port_a, self.closed.port_a)
        self.connect(self.open.port_b, self.top.port)
        self.connect(self.closed.port_b, self.other.port)
        self.connect(self.opening[0].y, self.open.opening)
        self.connect(self.opening[1].y, self.closed.opening)


@pytest.mark.slow
def test_a_pump_has_one_flow_for_a_head():
    """The parabola through its points has another one for this head, which is negative."""
    run = ac.simulate(ac.compile(Lift()), 1e-3)
    flow, head = float(run["pump.V_flow"][0]), float(run["pump.head"][0])
    assert 0.001 < flow < 0.0015
    assert RHO * flow == pytest.approx(np.sqrt((head - 3.0) * RHO * G / 1e5), rel=1e-4)
