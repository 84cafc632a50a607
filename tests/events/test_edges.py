"""Edges: the times at which a right-hand side jumps or bends are read from its formulas."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, electrical
from acausal.events import Edges
from tests.support.parts import Equations, model

SPAN, PI = 10.0, np.pi
APART = 16 * np.finfo(float).eps * SPAN


def edges_of(system):
    return Edges(system.program)


def over(s):
    """The state grows while a signal is above a level."""
    return [ac.Eq(ac.der(s.x), ac.where(s.u > s.level, 1, 0, events=None))]


def driven(source):
    y = source.y[0] if hasattr(source, "nout") else source.y
    made = model(s=source, i=blocks.Integrator())
    made.connect(y, made.i.u)
    return ac.compile(made)


def by_formula(formula, **parameters):
    """A state whose derivative is a formula of the component, among others of time."""
    return ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), formula(s))], **parameters))


def walked(system, params=None, n=24, begin=0.0):
    """All edges up to the end: times, and whether they are jumps."""
    edges = edges_of(system)

    def following(t, _):
        ahead = edges.ahead(packed, t, APART)
        edge = jnp.minimum(ahead.jump, ahead.bend)
        return edge, (edge, ahead.jump <= ahead.bend)

    packed = system.pack(params)
    _, (ts, jumps) = jax.jit(lambda: jax.lax.scan(following, jnp.asarray(begin), length=n))()
    inside = np.asarray(ts) < SPAN
    assert not inside[-1], "more edges than looked for"
    return np.asarray(ts)[inside], np.asarray(jumps)[inside]


BLOCKS = {
    "step": (blocks.Step(startTime=5.0), [5.0], []),
    "ramp": (blocks.Ramp(startTime=5.0, duration=2.0), [5.0, 7.0], []),
    "pulse": (
        blocks.Pulse(period=4.0, width=25.0, startTime=1.5),
        [1.5, 2.5, 5.5, 6.5, 9.5],
        [],
    ),
    "pulse, finite": (
        blocks.Pulse(period=2.0, width=25.0, nperiod=2),
        [0.5, 2.0, 2.5, 4.0, 6.0, 8.0],
        [],
    ),
    "saw tooth": (blocks.SawTooth(period=3.0, startTime=0.5), [0.5, 3.5, 6.5, 9.5], []),
    "trapezoid": (
        blocks.Trapezoid(rising=1.0, width=1.0, falling=1.0, period=4.0),
        [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
        [],
    ),
    "clock": (blocks.ContinuousClock(startTime=2.0), [], [2.0]),
    "sweep": (
        blocks.LogFrequencySweep(wMin=1.0, wMax=10.0, startTime=2.0, duration=3.0),
        [],
        [2.0, 5.0],
    ),
    "table": (
        blocks.TimeTable(table=[[0, 0], [7, 0], [7.1, 1], [7.2, 0], [7.2, 3], [8, 3]]),
        [7.2],
        [7.0, 7.1, 8.0],
    ),
    "table, shifted": (
        blocks.TimeTable(table=[[0, 0], [1, 2], [2, 0]], shiftTime=3.0, timeScale=2.0),
        [],
        [3.0, 5.0, 7.0],
    ),
    "table, periodic": (
        blocks.CombiTimeTable(table=[[0, 0], [1, 2], [4, 1]], extrapolation="Periodic"),
        [4.0, 8.0],
        [1.0, 5.0, 9.0],
    ),
    "table, held": (
        blocks.CombiTimeTable(table=[[1, 0], [3, 2], [6, 1]], smoothness="ConstantSegments"),
        [1.0, 3.0, 6.0],
        [],
    ),
    "truth values": (
        blocks.BooleanPulse(period=4.0, width=50.0, startTime=1.0),
        [1.0, 3.0, 5.0, 7.0, 9.0],
        [],
    ),
    "integers": (blocks.IntegerTable(table=[[0, 1], [2, 3], [6, 2]]), [2.0, 6.0], []),
}


@pytest.mark.parametrize("name", BLOCKS)
def test_sources_and_tables(name):
    source, jumps, bends = BLOCKS[name]
    ts, are_jumps = walked(driven(source))
    np.testing.assert_allclose(ts[are_jumps], jumps, rtol=1e-14)
    np.testing.assert_allclose(ts[~are_jumps], bends, rtol=1e-14)


FORMULAS = {
    "floor": (lambda s: ac.floor(0.5 * ac.time + 0.25), [1.5, 3.5, 5.5, 7.5, 9.5], []),
    "falling floor": (lambda s: ac.floor(3.5 - 0.5 * ac.time), [1.0, 3.0, 5.0, 7.0, 9.0], []),
    "remainder": (lambda s: (ac.time + 1) % 4, [3.0, 7.0], []),
    "maximum": (lambda s: ac.maximum(ac.time - 4, 3 - ac.time / 4, 0), [], [4.0, 5.6]),
    "absolute": (lambda s: ac.Abs(ac.time - 4), [], [4.0]),
    "sign": (lambda s: ac.sign(6 - 2 * ac.time), [3.0], []),
    "of a variable": (lambda s: s.x * ac.where(ac.time < 3, 1, 2, events=None), [3.0], []),
    "in a case that does not hold": (
        lambda s: ac.where(ac.time < 6, 1, ac.where(ac.time < 4, 2, 3, events=None), events=None),
        [6.0],
        [],
    ),
    "in either case of a variable": (
        lambda s: ac.where(s.x < 6, 1, ac.where(ac.time < 4, 2, 3, events=None), events=None),
        [4.0],
        [],
    ),
    "of a parameter": (lambda s: ac.maximum(s.p * ac.time - 5, 0), [], [2.5]),
    "of a ramp": (
        lambda s: ac.where(ac.maximum(ac.time - 2, 0) * 2 > 6, 1, 0, events=None),
        [5.0],
        [2.0],
    ),
    "of a triangle": (
        lambda s: ac.where(ac.Abs((ac.time + 2) % 4 - 2) < 1, 1, 0, events=None),
        [1.0, 2.0, 3.0, 5.0, 6.0, 7.0, 9.0],
        [4.0, 8.0],
    ),
    "of a sine": (
        lambda s: ac.where(ac.sin(PI * ac.time / 2) > 0.5, 1, 0, events=None),
        [1 / 3, 5 / 3, 13 / 3, 17 / 3, 25 / 3, 29 / 3],
        [],
    ),
    "of a cosine that runs backwards": (
        lambda s: ac.where(1 - s.p * ac.cos(PI * (1 - ac.time / 2)) < 2, 1, 0, events=None),
        [2 / 3, 10 / 3, 14 / 3, 22 / 3, 26 / 3],
        [],
    ),
    "of a tangent": (
        lambda s: ac.where(ac.tan(PI * ac.time / 8) > 1, 1, 0, events=None),
        [2.0, 4.0],
        [],
    ),
    "of a level that a sine does not reach": (
        lambda s: ac.where(ac.sin(ac.time) > s.p, 1, 0, events=None),
        [],
        [],
    ),
    "sign of a cosine": (lambda s: ac.sign(ac.cos(PI * ac.time / 4)), [2.0, 6.0], []),
    "a sine that is rectified": (lambda s: ac.Abs(ac.sin(PI * ac.time / 4)), [], [4.0, 8.0]),
    "of the size of a sine": (
        lambda s: ac.where(ac.Abs(ac.sin(PI * ac.time / 6)) > 0.5, 1, 0, events=None),
        [1.0, 5.0, 7.0],
        [6.0],
    ),
    "a sine that is clipped": (
        lambda s: ac.minimum(ac.sin(PI * ac.time / 6), 0.5),
        [],
        [1.0, 5.0],
    ),
    "a sine that is clipped on both sides": (
        lambda s: ac.maximum(ac.minimum(ac.sin(PI * ac.time / 6), 0.5), -0.5),
        [],
        [1.0, 5.0, 7.0],
    ),
}


@pytest.mark.parametrize("name", FORMULAS)
def test_formulas(name):
    formula, jumps, bends = FORMULAS[name]
    ts, are_jumps = walked(by_formula(formula, p=2.0))
    np.testing.assert_allclose(ts[are_jumps], jumps, rtol=1e-14)
    np.testing.assert_allclose(ts[~are_jumps], bends, rtol=1e-14)


@pytest.mark.slow
def test_pulses_of_sines_that_come_through_variables_are_seen():
    high, low = (Equations("x", over, "u", level=v) for v in (0.9999, -2.0004))
    sine = blocks.Sine(f=1.0, startTime=0.5)
    cosine = blocks.Cosine(f=0.5, offset=3.0, amplitude=-2.0)
    parts = {"sine": sine, "cosine": cosine, "gain": blocks.Gain(k=-2.0), "high": high, "low": low}
    system = ac.compile(model("sine.y - high.u", "cosine.y - gain.u", "gain.y - low.u", **parts))

    def ends(params):
        sol = ac.simulate(system, SPAN, params=params)
        return jnp.stack([sol["high.x"][-1], sol["low.x"][-1]])

    # ten peaks of each; the second is -6 + 4 cos(pi t)
    level, params = 0.9999, {"high.level": 0.9999, "low.level": -2.0004}
    np.testing.assert_allclose(ends(params), SPAN * np.arccos(level) / PI, rtol=1e-8)
    slopes = jax.jacobian(ends)(params)
    slope = -SPAN / PI / np.sqrt(1 - level**2)
    np.testing.assert_allclose(slopes["high.level"], [slope, 0.0], rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(slopes["low.level"], [0.0, slope / 4], rtol=1e-6, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("level", [0.9999, 0.3, -0.2])
def test_pulses_of_a_sine_are_seen_however_short_they_are(level):
    system = by_formula(lambda s: ac.where(ac.sin(2 * PI * ac.time) > s.p, 1, 0), p=level)

    def end(p):
        return ac.simulate(system, SPAN, params={"p": p})["x"][-1]

    np.testing.assert_allclose(end(level), SPAN * np.arccos(level) / PI, rtol=1e-9)
    slope = -SPAN / PI / np.sqrt(1 - level**2)
    np.testing.assert_allclose(jax.grad(end)(level), slope, rtol=1e-6)


def test_a_threshold_behind_a_ramp_and_a_sum_is_found():
    system = ac.compile(
        Equations(
            "x ramp sum over",
            lambda s: [
                ac.Eq(s.ramp, ac.where(ac.time < 1, 0, 2 * (ac.time - 1), events=None)),
                ac.Eq(s.sum, s.ramp + ac.time),
                ac.Eq(s.over, ac.where(s.sum > 7, 1, 0, events=None)),
                ac.Eq(ac.der(s.x), s.over - s.x),
            ],
        )
    )
    np.testing.assert_allclose(walked(system)[0], [1.0, 3.0], rtol=1e-14)


def test_instances_of_one_formula_have_their_own_edges():
    made = model(**{f"s{i}": blocks.Step(startTime=t) for i, t in enumerate((6.0, 2.0, 4.0))})
    made.i = [blocks.Integrator() for _ in range(3)]
    for i, integrator in enumerate(made.i):
        made.connect(getattr(made, f"s{i}").y, integrator.u)
    np.testing.assert_allclose(walked(ac.compile(made))[0], [2.0, 4.0, 6.0])


def test_time_within_a_nonlinear_loop():
    made = model(
        "v.p - r.p",
        "r.n - d.p",
        "d.n - c.p",
        "c.n - v.n",
        "v.n - g.p",
        v=electrical.StepVoltage(V=5.0, startTime=3.0),
        r=electrical.Resistor(R=1.0),
        d=electrical.Diode(),
        c=electrical.Capacitor(C=1.0, v=ac.Start(0.0, fixed=True)),
        g=electrical.Ground(),
    )
    system = ac.compile(made)
    assert any(hasattr(i, "tears") for i in system.program.instructions)
    np.testing.assert_allclose(walked(system)[0], [3.0])


def test_the_longest_step_is_an_eighth_of_a_period():
    system = driven(blocks.Sine(f=50.0, startTime=1.0))
    ahead = jax.jit(lambda t: edges_of(system).ahead(system.pack(), t, APART))
    assert np.isinf(ahead(0.0).longest)
    assert float(ahead(2.0).longest) == pytest.approx(0.02 / 8)


def test_of_a_chirp_it_shortens():
    system = by_formula(lambda s: ac.sin(3 * ac.time**2))
    ahead = jax.jit(lambda t: edges_of(system).ahead(system.pack(), t, APART))
    assert float(ahead(4.0).longest) == pytest.approx(2 * np.pi / 24 / 8)


@pytest.mark.slow
def test_a_step_does_not_leap_over_the_samples_of_a_smooth_table():
    rows = [[t, float(t == 7)] for t in range(11)]
    system = driven(blocks.CombiTimeTable(table=rows, smoothness="ContinuousDerivative"))
    ahead = edges_of(system).ahead(system.pack(), 2.5, APART)
    assert float(ahead.longest) == pytest.approx(6.0 - 2.5)


def test_traced_parameters_under_vmap_with_derivatives():
    system = driven(blocks.Pulse(period=4.0, width=25.0, startTime=1.5))
    edges, own = edges_of(system), system.parameters()

    def next_jump(period, width):
        params = own | {"s.period": period, "s.width": width}
        return edges.ahead(system.pack(params), 6.0, APART).jump

    both = jax.vmap(jax.value_and_grad(next_jump, argnums=(0, 1)))
    value, slopes = jax.jit(both)(jnp.array([4.0, 3.0]), jnp.array([25.0, 25.0]))
    np.testing.assert_allclose(value, [1.5 + 4 + 1, 1.5 + 6], rtol=1e-14)
    np.testing.assert_allclose(slopes[0], [1.25, 2.0], rtol=1e-14)
    np.testing.assert_allclose(slopes[1], [0.04, 0.0], atol=1e-14)


def test_what_is_held_at_events_is_known():
    class Timer(ac.Component):
        x = ac.Variable(start=0.0, fixed=True)
        begun = ac.Discrete(1.0)

        def equations(self):
            yield ac.When(ac.time > 1.0, ac.Eq(self.begun, 4.0))
            yield ac.Eq(ac.der(self.x), ac.where(ac.time < self.begun + 2, 1, 0, events=False))

    system = ac.compile(Timer())
    places = system.discrete["begun"][0]
    d = jnp.asarray(system.program.discrete_start).at[places].set(4.0)
    assert float(edges_of(system).ahead(system.pack(), 1.5, APART).jump) == 3.0
    assert float(edges_of(system).ahead(system.pack(), 1.5, APART, d).jump) == 6.0


def test_a_model_without_sources_has_none_and_costs_nothing():
    system = by_formula(lambda s: -ac.maximum(s.x, 0))
    assert not edges_of(system)
    assert edges_of(system).bends


@pytest.mark.parametrize(
    ("formula", "bends"),
    [
        (lambda s: -s.x, False),
        (lambda s: ac.where(ac.time < 3, s.x, 2 * s.x, events=None), False),
        (lambda s: ac.where(s.x < 3, 1, 2, events=None), True),
        (lambda s: ac.Abs(s.x), True),
        (lambda s: ac.Abs(ac.sin(ac.time)), False),
        (lambda s: ac.Abs(ac.sin(ac.time) + ac.sin(2 * ac.time)), True),
        (lambda s: ac.where(ac.cos(s.x) < 0.5, 1, 2, events=None), True),
    ],
)
def test_bends_that_depend_on_variables(formula, bends):
    assert edges_of(by_formula(formula)).bends == bends


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        (lambda: blocks.Sine(f=2.0, startTime=0.5), True),
        (lambda: blocks.Trapezoid(period=1.0, rising=0.2), False),
        (lambda: blocks.Ramp(duration=2.0), False),
    ],
    ids=["sine", "trapezoid", "ramp"],
)
def test_a_limiter_bends_curves_at_times_that_are_not_known_ahead(source, expected):
    source = source()
    made = model(
        "s.y - l.u", "l.y - i.u", s=source, l=blocks.Limiter(uMax=0.5), i=blocks.Integrator()
    )
    assert edges_of(ac.compile(made)).bends == expected
