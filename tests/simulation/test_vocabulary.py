"""The words of `simulate` and `Solution`: one end time, any function, rest, stiff, patterns, xarray."""

import functools
import math
import re

import jax
import jax.numpy as jnp
import matplotlib.pyplot as plt
import numpy as np
import pytest

import acausal as ac
from acausal._jax import host_calls
from acausal.components import translational as tl
from acausal.simulation import Solution
from tests.support.hybrid import Ball
from tests.support.oscillator import plain

PUSH = "push.f"


@pytest.fixture(scope="module")
def run() -> Solution:
    return ac.simulate(plain(), 1.0, dt=0.01, inputs={PUSH: 10.0})


def test_one_time_is_the_end(run: Solution) -> None:
    expected = ac.simulate(plain(), (0.0, 1.0), dt=0.01, inputs={PUSH: 10.0})
    np.testing.assert_array_equal(run.t, expected.t)
    np.testing.assert_array_equal(run.x, expected.x)


# -- inputs ----------------------------------------------------------------------------------------


def late(t: float) -> float:
    """A push that JAX cannot trace."""
    return 10 * math.sin(4 * t) if t > 0.25 else 0.0


def traceable(t):
    return jnp.where(t > 0.25, 10 * jnp.sin(4 * t), 0.0)


class Sampled:
    """A callable that cannot be hashed, as interpolants may be."""

    __hash__ = None  # pyright: ignore[reportAssignmentType]

    def __call__(self, t: float) -> float:
        return float(np.interp(t, [0.0, 1.0], [0.0, 10.0]))


@pytest.mark.parametrize("steps", [{"dt": 0.01}, {}])
def test_any_function_is_an_input(steps: dict) -> None:
    simulated = functools.partial(ac.simulate, plain(), 1.0, saveat=[0.0, 0.5, 1.0], **steps)
    found = simulated(inputs={PUSH: late})
    expected = simulated(inputs={PUSH: traceable})
    np.testing.assert_allclose(found.x, expected.x, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found[PUSH], expected[PUSH])


def test_interpolants_of_numpy_and_scipy_are_inputs() -> None:
    spline = pytest.importorskip("scipy.interpolate").CubicSpline([0.0, 0.5, 1.0], [0.0, 5.0, 10.0])
    found = [
        ac.simulate(plain(), 1.0, dt=0.1, inputs={PUSH: f})
        for f in (spline, Sampled(), lambda t: 10.0 * t)
    ]
    np.testing.assert_allclose(found[0].x, found[2].x, rtol=1e-9)
    np.testing.assert_allclose(found[1].x, found[2].x, rtol=1e-9)


def test_any_function_is_called_without_a_callback_of_jax() -> None:
    """It is read where it lies in memory, which takes microseconds; a callback takes some hundred."""

    def last(c: jax.Array) -> jax.Array:
        params = {**plain().parameters(), "spring.c": c}
        return ac.simulate(plain(), 1.0, dt=0.1, inputs={PUSH: late}, params=params).x[-1, 0]

    program = jax.jit(last).lower(100.0).as_text()
    assert set(re.findall(r"custom_call @(\w+)", program)) == {host_calls.NAME}


def test_a_function_that_fails_later_says_why() -> None:
    def fails(t: float) -> float:
        return 1.0 / 0 if float(t) > 0.5 else 0.0

    with pytest.raises(
        jax.errors.JaxRuntimeError, match=r"Input 'push\.f': ZeroDivisionError: .*division by zero"
    ):
        np.asarray(ac.simulate(plain(), 1.0, dt=0.1, inputs={PUSH: fails}).x)


@pytest.mark.slow
def test_gradients_and_batches_go_through_any_function() -> None:
    def last(c, push):
        params = {**plain().parameters(), "spring.c": c}
        return ac.simulate(plain(), 1.0, dt=0.05, inputs={PUSH: push}, params=params).x[-1, 0]

    c = jnp.asarray([90.0, 110.0])
    for transformed in (jax.vmap(last, (0, None)), jax.vmap(jax.grad(last), (0, None))):
        np.testing.assert_allclose(transformed(c, late), transformed(c, traceable), rtol=1e-8)


# -- start and solver ------------------------------------------------------------------------------


class Free(ac.Component):
    """An oscillator whose start nothing fixes."""

    def __init__(self) -> None:
        super().__init__()
        self.wall, self.push = tl.Fixed(), tl.Force()
        self.spring, self.mass = tl.SpringDamper(c=50.0, d=1.0), tl.Mass(m=2.0)
        self.connect(self.wall.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.push.flange)


def test_a_simulation_starts_at_rest() -> None:
    system = ac.compile(Free())
    run = ac.simulate(system, 1.0, dt=0.1, inputs={PUSH: lambda t: 5.0 + t}, x0="steady")
    np.testing.assert_allclose(run.x[0], [0.1, 0.0], atol=1e-12)
    for same in (
        system.initial_state(x0="steady", inputs={PUSH: 5.0}),
        system.initialize(x0="steady", inputs=[5.0]).x,
        system.initialize(inputs={PUSH: lambda t: 2.5 * t}, t0=2.0, steady=True).x,
    ):
        np.testing.assert_allclose(run.x[0], same, atol=1e-12)


@pytest.mark.slow
def test_stiff_is_a_solver() -> None:
    inputs = {PUSH: 10.0}
    by_name = ac.simulate(plain(), 1.0, inputs=inputs, solver="stiff")
    assert by_name.statistics is not None
    assert by_name.statistics.solver == "BDF"
    fixed = ac.simulate(plain(), 1.0, dt=0.01, inputs=inputs, solver="stiff")
    same = ac.simulate(plain(), 1.0, dt=0.01, inputs=inputs, solver="kvaerno3")
    np.testing.assert_array_equal(fixed.x, same.x)
    with_events = ac.simulate(ac.compile(Ball()), 0.5, solver="stiff")
    assert with_events.statistics is not None
    assert "Kvaerno5" in with_events.statistics.solver
    with pytest.raises(ac.DataError, match="did you mean 'stiff'"):
        ac.simulate(plain(), 1.0, inputs=inputs, solver="stif")


# -- names -----------------------------------------------------------------------------------------


def test_patterns_name_variables(run: Solution) -> None:
    assert set(run.to_dict(["mass.*"])) == {"time", "mass.s", "mass.v", "mass.a"} | {
        n for n in run.names if n.startswith("mass.") and n.count(".") == 1
    }
    everything = {n for n in run.names if n.startswith("mass.")}
    assert set(run.to_dict("mass.**")) == {"time"} | everything
    assert list(run.to_dict(["spring.f", "mass.?", "mass.s"]))[:2] == ["time", "spring.f"]
    with pytest.raises(ac.DataError, match=r"No variable is called 'mas\.\*'"):
        run.to_dict("mas.*")


def test_plots_take_lists_and_patterns(run: Solution) -> None:
    def labels(*names):
        figure = run.plot(*names)
        return [line.get_label() for ax in figure.axes for line in ax.lines]

    try:
        assert labels(["mass.s", "mass.v"]) == labels("mass.s", "mass.v") == ["mass.s", "mass.v"]
        assert labels("mass.?") == [n for n in run.to_dict("mass.?") if n != "time"]
        assert labels(["mass.s"], "spring.f") == ["mass.s", "spring.f"]
        assert labels() == ["mass.s", "mass.v"]
    finally:
        plt.close("all")


def test_a_dataset_has_units(run: Solution) -> None:
    pytest.importorskip("xarray")
    dataset = run.to_xarray(["mass.s", "spring.f"])
    assert dict(dataset.sizes) == {"time": 101}
    assert dataset["mass.s"].attrs == {"units": "m"}
    assert dataset["time"].attrs == {"units": "s"}
    np.testing.assert_array_equal(dataset["spring.f"].values, np.asarray(run["spring.f"]))
    assert set(run.to_xarray().data_vars) == set(run.names)


def test_without_xarray_the_message_names_the_extra(
    run: Solution, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(ac.DataError, match=r"needs xarray: pip install 'acausal\[xarray\]'"):
        run.to_xarray()
