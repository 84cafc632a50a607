"""Stiff models, by BDF and by the method that is chosen on the way, against closed forms and SciPy's Radau."""

import functools
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal.components import translational as tl
from tests.support.parts import Equations, model
from tests.support.stiff import Plate


def _robertson(s: Any) -> list[Any]:
    forth, back, sink = s.k1 * s.a, s.k3 * s.b * s.c, s.k2 * s.b**2
    return [
        ac.Eq(ac.der(s.a), back - forth),
        ac.Eq(ac.der(s.b), forth - back - sink),
        ac.Eq(ac.der(s.c), sink),
    ]


@functools.cache
def robertson() -> ac.System:
    return ac.compile(Equations("a b c", _robertson, k1=0.04, k2=3e7, k3=1e4))


def _van_der_pol(s: Any) -> list[Any]:
    return [
        ac.Eq(ac.der(s.x), s.v),
        ac.Eq(ac.der(s.v), s.mu * ((1 - s.x**2) * s.v) - s.x),
    ]


@functools.cache
def van_der_pol() -> ac.System:
    return ac.compile(Equations("x v", _van_der_pol, mu=1000.0))


START = {"a": 1.0, "b": 0.0, "c": 0.0}
TS = np.concatenate([[0.0], np.geomspace(1e-4, 4e4, 30)])


def _radau(system: ac.System, x0: np.ndarray, ts: np.ndarray, atol: float) -> np.ndarray:
    params = system.pack()
    field = jax.jit(lambda t, x: system.vector_field(t, x, None, params))
    found = solve_ivp(
        lambda t, x: np.asarray(field(t, x)),
        (ts[0], ts[-1]),
        x0,
        method="Radau",
        t_eval=ts,
        rtol=1e-10,
        atol=atol,
    )
    return found.y.T


def test_robertson_over_nine_decades():
    system = robertson()
    atol = np.array([1e-8, 1e-12, 1e-8])
    found = ac.simulate(system, (0, 4e4), x0=START, solver="bdf", saveat=TS, rtol=1e-6, atol=atol)
    truth = _radau(system, np.array([1.0, 0, 0]), TS, 1e-14)
    np.testing.assert_allclose(found.x, truth, rtol=2e-4, atol=1e-9)
    np.testing.assert_allclose(found.x.sum(axis=1), 1.0, rtol=1e-9)  # mass is kept
    assert int(found.statistics.steps) < 600
    assert int(found.statistics.factorizations) < 150


@pytest.mark.slow
def test_a_model_that_becomes_stiff_changes_its_method_by_itself():
    """Van der Pol's oscillator with µ = 1000: explicit steps would be a million."""
    system, ts = van_der_pol(), np.linspace(0, 700, 15)
    found = ac.simulate(system, (0, 700), x0={"x": 2.0, "v": 0.0}, saveat=ts, rtol=1e-7, atol=1e-9)
    truth = _radau(system, np.array([2.0, 0.0]), ts, 1e-12)
    np.testing.assert_allclose(found["x"], truth[:, 0], rtol=2e-5)
    assert found.statistics.solver == "Tsit5, then BDF"
    assert 0 < float(found.statistics.stiff_from) < 1
    assert int(found.statistics.steps) < 500
    with pytest.raises(
        ac.SimulationError, match=r"max_steps=2000.*choose solver='auto' or 'stiff'"
    ):
        ac.simulate(system, (0, 700), x0={"x": 2.0, "v": 0.0}, solver="tsit5", max_steps=2000)


def test_a_model_that_is_not_stiff_keeps_explicit_steps():
    mass = model("mass.flange_b - spring.flange_a", mass=tl.Mass(m=1.0), spring=tl.Spring(c=100.0))
    mass.wall = tl.Fixed()
    mass.connect(mass.spring.flange_b, mass.wall.flange)
    found = ac.simulate(ac.compile(mass), (0, 3), x0={"mass.s": 0.1})
    assert str(found.statistics).startswith("Tsit5: ")
    assert np.isinf(float(found.statistics.stiff_from))
    assert int(found.statistics.factorizations) == 0
    np.testing.assert_allclose(found["mass.s"], 0.1 * np.cos(10 * found.t), atol=2e-5)


@pytest.mark.slow
def test_the_choice_is_the_same_where_jax_compiles():
    system = van_der_pol()

    def last(mu: Any) -> Any:
        return ac.simulate(
            system, (0, 100), params={"mu": mu}, x0={"x": 2.0, "v": 0.0}, saveat=[100.0]
        ).x[-1]

    np.testing.assert_allclose(jax.jit(last)(500.0), last(500.0), rtol=1e-7)
    np.testing.assert_allclose(
        jax.vmap(last)(jnp.asarray([1.0, 500.0])), [last(1.0), last(500.0)], rtol=1e-6
    )


def test_tolerances_are_met():
    """An oscillation that is damped fast beside one that is not."""
    s = ac.compile(
        Equations(
            "x y z",
            lambda s: [
                ac.Eq(ac.der(s.x), s.y),
                ac.Eq(ac.der(s.y), -s.x),
                ac.Eq(ac.der(s.z), -1e4 * (s.z - s.x)),
            ],
        )
    )
    errors = []
    for rtol in (1e-4, 1e-6, 1e-8):
        found = ac.simulate(
            s, (0, 10), x0={"x": 1.0, "y": 0.0, "z": 0.0}, solver="bdf", rtol=rtol, atol=rtol
        )
        errors.append(float(np.abs(found["x"] - np.cos(found.t)).max()))
    assert errors[1] < errors[0] / 10
    assert errors[2] < errors[1] / 10
    assert errors[2] < 1e-6


def test_held_inputs_begin_anew_where_they_jump():
    s = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), 1000 * (s.u - s.x))], inputs="u"))
    held = ac.Signal([0.0, 1.0, 2.0], [1.0, 3.0, 3.0], "previous")
    found = ac.simulate(
        s, (0, 2), x0={"x": 0.0}, inputs={"u": held}, solver="bdf", rtol=1e-9, atol=1e-11
    )
    t = np.asarray(found.t)
    exact = np.where(
        t < 1,
        1 - np.exp(-1000 * t),
        3 - (2 + np.exp(-1000.0)) * np.exp(-1000 * np.maximum(t - 1, 0)),
    )
    np.testing.assert_allclose(found["x"], exact, atol=1e-7)


def test_an_input_may_be_a_function():
    s = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), 1000 * (s.u - s.x))], inputs="u"))
    found = ac.simulate(
        s, (0, 2), x0={"x": 0.0}, inputs={"u": lambda t: 2.0 * t}, rtol=1e-8, atol=1e-10
    )
    t = np.asarray(found.t)
    exact = 2 * t - 2e-3 * (1 - np.exp(-1000 * t))
    np.testing.assert_allclose(found["x"], exact, atol=1e-6)
    assert int(found.statistics.factorizations) > 0


@pytest.fixture(scope="module")
def plate() -> ac.System:
    return ac.compile(Plate(11))


@pytest.mark.slow
def test_a_sparse_plate_keeps_its_energy(plate: ac.System):
    found = ac.simulate(plate, (0, 50), saveat=np.linspace(0, 50, 6), rtol=1e-8, atol=1e-8)
    capacity = np.array([1.0 + i % 7 for i in range(121)])
    energy = np.asarray(found.x) @ capacity
    np.testing.assert_allclose(energy - energy[0], 50 * np.asarray(found.t), atol=1e-2)
    assert int(found.statistics.factorizations) > 0


def test_what_bdf_cannot_do_is_refused():
    with pytest.raises(ac.DataError, match="BDF is not a one-step scheme for fixed steps"):
        ac.simulate(robertson(), (0, 1), dt=0.1, x0=START, solver="bdf")
    with pytest.raises(ac.DataError, match="Euler has no error estimate"):
        ac.simulate(robertson(), (0, 1), x0=START, solver="euler")


def test_a_stiff_run_that_stops_says_where_and_why():
    broken = ac.compile(
        Equations(
            "x t",
            lambda s: [
                ac.Eq(ac.der(s.x), -1e3 * s.x + ac.log(1 - s.t)),
                ac.Eq(ac.der(s.t), 1.0),
            ],
        )
    )
    with pytest.raises(ac.SimulationError, match=r"BDF stopped at t = (1|0\.99)"):
        ac.simulate(broken, (0, 2), x0={"x": 0.0, "t": 0.0}, solver="bdf")


def _half_wave(s: Any) -> list[Any]:
    conducts = 0.04 * ac.log(1 + ac.maximum(s.i, 0) / 1e-6)
    return [
        ac.Eq(2e-3 * ac.der(s.i), 20 * ac.sin(100 * ac.pi * ac.time) - s.u - s.v),
        ac.Eq(5e-4 * ac.der(s.v), s.i - s.v / 30),
        ac.Eq(s.u, ac.where(s.i > 0, conducts, 1e8 * s.i)),
    ]


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("solver", ["bdf", "auto"])
def test_a_diode_that_blocks_hard_opens_in_time(solver: str) -> None:
    """With the derivatives of the blocking branch, 5e10 1/s, corrections are tiny on the other one, too."""
    component = Equations("i v u", _half_wave)
    component.modify(i=ac.Start(0.0, fixed=True), v=ac.Start(0.0, fixed=True))
    system, ts = ac.compile(component), np.linspace(0, 0.1, 251)

    def by_hand(t: float, x: Any) -> list[float]:
        u = 0.04 * np.log1p(x[0] / 1e-6) if x[0] > 0 else 1e8 * x[0]
        return [(20 * np.sin(100 * np.pi * t) - u - x[1]) / 2e-3, (x[0] - x[1] / 30) / 5e-4]

    exact = solve_ivp(by_hand, (0, 0.1), [0, 0], "Radau", ts, rtol=1e-9, atol=1e-12, max_step=1e-4)
    for rtol in (1e-6, 1e-7, 1e-8):
        found = ac.simulate(system, 0.1, saveat=ts, solver=solver, rtol=rtol)
        assert np.max(np.abs(found["v"] - exact.y[1])) < 1e3 * rtol


@pytest.mark.parametrize(("rtol", "dtype"), [(1e-12, None), (1e-5, "float32")])
def test_rounding_is_not_taken_for_another_branch(rtol: float, dtype: Any) -> None:
    fast = Equations("x", lambda s: [ac.Eq(ac.der(s.x), 1e10 * (ac.cos(ac.time) - ac.Abs(s.x)))])
    fast.modify(x=ac.Start(1.0, fixed=True))
    run = ac.simulate(ac.compile(fast), 1.0, solver="bdf", rtol=rtol, dtype=dtype)
    assert run.statistics is not None
    assert int(run.statistics.rejected) < 50
