"""Steps do not leap over what happens: pulses, tables, clipped and rectified waves, with default arguments."""

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, electrical, thermal, translational
from tests.support.parts import Equations, model
from tests.support.slow import some_slow

ON = {"fixed": True}


def integral(source):
    made = model(s=source, i=blocks.Integrator(y_start=0.0))
    made.connect(source.y[0] if hasattr(source, "nout") else source.y, made.i.u)
    return made, "i.y"


def pushed():
    made = model(
        "a.y - add.u1",
        "b.y - add.u2",
        "add.y - f.f",
        "f.flange - m.flange_a",
        a=blocks.Step(height=10.0, startTime=5.0),
        b=blocks.Step(height=-10.0, startTime=5.5),
        add=blocks.Add(),
        f=translational.Force(),
        m=translational.Mass(m=1.0, v=ac.Start(0.0, **ON), s=ac.Start(0.0, **ON)),
    )
    return made, "m.v"


def charged():
    made = model(
        "v.p - r.p",
        "r.n - c.p",
        "c.n - v.n",
        "v.n - g.p",
        v=electrical.PulseVoltage(V=1.0, width=10.0, period=10.0, startTime=5.0),
        r=electrical.Resistor(R=1.0),
        c=electrical.Capacitor(C=1.0, v=ac.Start(0.0, **ON)),
        g=electrical.Ground(),
    )
    return made, "c.v"


def heated():
    made = model(
        "p.y - q.Q_flow",
        "q.port - c.port",
        p=blocks.Pulse(amplitude=100.0, period=3600.0, width=100 / 60, startTime=1800.0),
        q=thermal.PrescribedHeatFlow(),
        c=thermal.HeatCapacitor(C=100.0, T=ac.Start(300.0, **ON)),
    )
    return made, "c.T"


TRIANGLE = [[0, 0], [7, 0], [7.1, 1], [7.2, 0], [10, 0]]
CASES = {
    "pulse": (lambda: integral(blocks.Pulse(period=1.0)), 10.0, 5.0),
    "short pulse": (lambda: integral(blocks.Pulse(period=5.0, width=2.0)), 10.0, 0.2),
    "trapezoid": (
        lambda: integral(
            blocks.Trapezoid(rising=0.1, width=1.2, falling=0.1, period=20.0, startTime=5.0)
        ),
        10.0,
        1.3,
    ),
    "table": (lambda: integral(blocks.TimeTable(table=TRIANGLE)), 10.0, 0.1),
    "smooth table": (
        lambda: integral(blocks.CombiTimeTable(table=TRIANGLE, smoothness="ContinuousDerivative")),
        10.0,
        None,
    ),
    "two steps": (pushed, 10.0, 5.0),
    "pulse of a voltage": (charged, 10.0, (1 - np.exp(-1)) * np.exp(-4)),
    "pulse of heat": (heated, 3600.0, 360.0),
}


@pytest.mark.cases(fast=3)
@pytest.mark.parametrize("solver", ["auto", "stiff"])
@pytest.mark.parametrize("name", CASES)
def test_known_edges(name, solver):
    make, end, exact = CASES[name]
    made, variable = make()
    system = ac.compile(made)
    if exact is None:  # the cubic is integrated by Simpson's rule in each piece
        signal = system.parameters()["s.column[1]"]
        ts = np.array([0, 7, 7.1, 7.2, 10])
        a, m, b = (
            np.array([float(signal(t)) for t in p])
            for p in (ts[:-1], ts[:-1] / 2 + ts[1:] / 2, ts[1:])
        )
        exact = float(np.sum(np.diff(ts) * (a + 4 * m + b) / 6))
    value = float(ac.simulate(system, end, solver=solver)[variable][-1])
    assert value == pytest.approx(exact, rel=2e-5, abs=2e-6)


def test_a_pulse_in_a_function_of_time_is_seen_by_the_look_inside():
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), s.u)], inputs="u"))
    pulse = lambda t: jnp.where((t >= 5) & (t < 5.5), 10.0, 0.0)  # noqa: E731
    sol = ac.simulate(system, 10.0, inputs={"u": pulse}, x0={"x": 0.0})
    assert float(sol["x"][-1]) == pytest.approx(5.0, abs=5e-4)
    assert int(sol.statistics.by_span) > 0


def clipped(upper):
    made = model(
        "s.y - d.u",
        "d.y - i.u",
        s=blocks.Sine(amplitude=1.0, f=1.0),
        d=blocks.DeadZone(uMax=upper, uMin=-2.0),
        i=blocks.Integrator(y_start=0.0),
    )
    return ac.compile(made)


@pytest.mark.slow
def test_a_clipped_sine_over_a_hundred_periods():
    angle = np.arcsin(0.9)
    area = (2 * np.cos(angle) - 0.9 * (np.pi - 2 * angle)) / (2 * np.pi)
    sol = ac.simulate(clipped(0.9), 100.0)
    assert float(sol["i.y"][-1]) == pytest.approx(100 * area, rel=2e-3)
    assert int(sol.statistics.by_wave) > 0
    assert "by a sine" in str(sol.statistics)


def rectifier():
    return ac.compile(
        model(
            "v.p - d.p",
            "d.n - c.p",
            "c.n - v.n",
            "v.n - g.p",
            "r.p - c.p",
            "r.n - c.n",
            v=electrical.SineVoltage(V=10.0, f=1.0),
            d=electrical.Diode(),
            r=electrical.Resistor(R=1.0),
            c=electrical.Capacitor(C=1.0, v=ac.Start(0.0, **ON)),
            g=electrical.Ground(),
        )
    )


@pytest.mark.slow
def test_a_rectifier():
    system = rectifier()
    fine = ac.simulate(system, 10.0, rtol=1e-9, atol=1e-11, max_steps=1_000_000)["c.v"]
    for solver in ("auto", "stiff"):
        value = ac.simulate(system, 10.0, solver=solver)["c.v"]
        np.testing.assert_allclose(value, fine, atol=1e-3)


@pytest.fixture(scope="module")
def lag():
    made = model(
        "s.y - f.u",
        s=blocks.Pulse(amplitude=2.0, width=30.0, period=1.3, startTime=0.4),
        f=blocks.FirstOrder(T=0.7, k=1.0, y_start=0.0, initType="InitialState"),
    )
    return ac.compile(made)


@pytest.mark.parametrize("solver", some_slow(["auto", "stiff"], ["stiff"], ["auto"]))
def test_the_gradient_by_the_time_of_an_edge(lag, solver):
    """Exact: each edge at t adds its height times 1 - exp(-(5 - t)/T) to the value at 5 s."""
    own = lag.parameters()

    def exact(p):
        k = jnp.arange(4.0)
        begins = p["s.startTime"] + k * p["s.period"]
        risen = lambda t: 1 - jnp.exp(-jnp.maximum(5.0 - t, 0) / 0.7)  # noqa: E731
        return 2.0 * jnp.sum(risen(begins) - risen(begins + 0.3 * p["s.period"]))

    def value(p, **options):
        tight = {"rtol": 1e-9, "atol": 1e-11, "solver": solver}
        return ac.simulate(lag, 5.0, saveat=[5.0], params=own | p, **tight, **options)["f.y"][-1]

    at = {n: jnp.asarray(own[n]) for n in ("s.period", "s.startTime")}
    expected = jax.grad(exact)(at)
    reverse = jax.grad(value)(at)
    forward = jax.jacfwd(lambda p: value(p, adjoint=diffrax.ForwardMode()))(at)
    for name in at:
        assert float(reverse[name]) == pytest.approx(float(expected[name]), rel=1e-5)
        assert float(forward[name]) == pytest.approx(float(reverse[name]), rel=1e-6)


def test_edges_do_not_count_for_the_limit_of_steps():
    system = ac.compile(integral(blocks.Pulse(period=0.02))[0])
    sol = ac.simulate(system, 10.0, max_steps=400)
    assert float(sol["i.y"][-1]) == pytest.approx(5.0, rel=1e-9)
    assert int(sol.statistics.edges) >= 998 > 400


@pytest.mark.slow
def test_a_hundred_thousand_edges_and_a_table_of_ten_thousand_points():
    system = ac.compile(integral(blocks.Pulse(period=2e-4))[0])
    assert float(ac.simulate(system, 10.0, saveat=[10.0])["i.y"][-1]) == pytest.approx(
        5.0, rel=1e-8
    )
    ys = np.random.default_rng(0).normal(size=10_001)
    ts = np.linspace(0.0, 10.0, 10_001)
    system = ac.compile(integral(blocks.TimeTable(table=np.stack([ts, ys], axis=1)))[0])
    value = float(ac.simulate(system, 10.0, saveat=[10.0])["i.y"][-1])
    assert value == pytest.approx(float(np.trapezoid(ys, ts)), abs=1e-9)


@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan, "long"])
def test_a_wrong_longest_step_is_refused(lag, wrong):
    with pytest.raises(ac.DataError, match="max_step"):
        ac.simulate(lag, 1.0, max_step=wrong)


def test_a_longest_step_beside_fixed_ones_is_refused(lag):
    with pytest.raises(ac.DataError, match="fixed ones"):
        ac.simulate(lag, 1.0, dt=0.1, max_step=0.01)


def test_the_longest_step_is_a_choice():
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), -s.x)]))
    steps = {
        longest: int(ac.simulate(system, 1.0, x0={"x": 1.0}, max_step=longest).statistics.steps)
        for longest in (np.inf, None, 0.01)
    }
    assert steps[np.inf] < 20 < 50 <= steps[None] < 100 <= steps[0.01]


def test_smooth_bumps_and_steps_of_time_are_seen():
    bumps = {
        "a": lambda t: ac.exp(-(((t - 3.3337) / 1e-3) ** 2)) / (1e-3 * np.sqrt(np.pi)),
        "b": lambda t: 1e3 / (np.pi * (1 + ((t - 7.1) / 1e-3) ** 2)),
        "c": lambda t: (ac.tanh((t - 5.2) / 1e-3) - ac.tanh((t - 5.21) / 1e-3)) / 0.02,
    }

    class Bumps(ac.Component):
        a, b, c = (ac.Variable(start=0.0, fixed=True) for _ in bumps)

        def equations(self):
            yield from (ac.Eq(ac.der(getattr(self, n)), f(ac.time)) for n, f in bumps.items())

    sol = ac.simulate(ac.compile(Bumps()), 10)
    lorentz = (np.arctan(2.9e3) + np.arctan(7.1e3)) / np.pi
    np.testing.assert_allclose([sol[n][-1] for n in "abc"], [1.0, lorentz, 1.0], rtol=1e-5)


class Counters(ac.Component):
    """How often waves have passed a level that no rate depends on; and a lag, which would take few steps."""

    x = ac.Variable(start=0.0, fixed=True)
    phi = ac.Variable(start=0.0, fixed=True)
    by_time = ac.Discrete(0, kind="int")
    by_both = ac.Discrete(0, kind="int")
    by_angle = ac.Discrete(0, kind="int")

    def equations(self) -> Equations:
        t, level = ac.time, 0.9999
        waves = {
            self.by_time: ac.sin(40 * t),
            self.by_both: ac.sin(40 * t + 0.01 * self.x),
            self.by_angle: ac.cos(self.phi),
        }
        yield ac.Eq(ac.der(self.x), 1 - self.x)
        yield ac.Eq(ac.der(self.phi), 20 * (1 + t))  # a shaft that speeds up
        for count, wave in waves.items():
            yield ac.When(wave > level, ac.Eq(count, ac.pre(count) + 1))


@pytest.mark.slow
def test_each_period_of_a_wave_in_a_condition_is_seen():
    sol = ac.simulate(ac.compile(Counters()), (0.0, 4.0))
    phi, rise = 20 * (4 + 8), np.arcsin(0.9999)
    expected = [np.floor((angle - rise) / (2 * np.pi)) + 1 for angle in (160, 160.01)]
    assert [int(sol[n][-1]) for n in ("by_time", "by_both")] == expected
    assert int(sol["by_angle"][-1]) == (phi + np.arccos(0.9999)) // (2 * np.pi)
