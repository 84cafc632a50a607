"""Inputs that jump, and events before them: each step sees its own side. All derivatives here are known exactly."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.simulation import Adaptive, Steps, functions_of_time, integrate_in_steps, solvers
from acausal.simulation.inputs import evaluate_all
from acausal.simulation.sampled_inputs import over_steps
from tests.support.slow import some_slow


class Driven(ac.Component):
    """A condition on time, and one on a held input, change a sum that is integrated; y leads to steps of errors."""

    tw = ac.Parameter(0.3)
    u = ac.Input()
    x, y = ac.Variable(start=0.0, fixed=True), ac.Variable(start=0.0, fixed=True)
    d, e = ac.Discrete(0.0), ac.Discrete(0.0)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.u + self.d + self.e)
        yield ac.Eq(ac.der(self.y), self.d - self.y)
        yield ac.When(ac.time >= self.tw, ac.Eq(self.d, 1.0))
        yield ac.When(self.u > 2.0, ac.Eq(self.e, 5.0))


class TurnsStiff(ac.Component):
    """An event makes a state fast: from there on the implicit method goes on."""

    tw = ac.Parameter(0.3)
    x, z = ac.Variable(start=1.0, fixed=True), ac.Variable(start=0.0, fixed=True)
    d = ac.Discrete(0.0)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), -self.x + self.d * ac.cos(3 * ac.time) + self.z)
        yield ac.Eq(ac.der(self.z), (1 + 1e5 * self.d) * (self.x - self.z))
        yield ac.When(ac.time >= self.tw, ac.Eq(self.d, 1.0))


@functools.cache
def driven() -> ac.System:
    return ac.compile(Driven())


SAMPLES = np.array([0.0, 0.5, 1.0]), np.array([1.0, 3.0, 7.0])
PATHS: dict[str, dict[str, Any]] = {
    "auto": {},
    "tsit5": {"solver": "tsit5"},
    "dopri5": {"solver": "dopri5"},
    "kvaerno5": {"solver": "kvaerno5"},
    "heun": {"solver": "heun", "dt": 0.05},
    "rk4 between": {"solver": "rk4", "dt": 0.04},
    "kvaerno3": {"solver": "kvaerno3", "dt": 0.05},
}


@pytest.mark.parametrize("path", some_slow(PATHS, ["heun"], PATHS.keys() - {"heun"}))
def test_an_event_before_a_jump_has_its_exact_gradient(path: str) -> None:
    """The samples' times do not move with the event: dx(1)/dtw is -1, and -1 by each of the samples' values."""

    def run(tw: Any, values: Any, **how: Any) -> ac.Solution:
        u = ac.Signal(SAMPLES[0], values, "previous")
        options = PATHS[path] | how
        return ac.simulate(
            driven(), 1.0, params={"tw": tw}, inputs={"u": u}, saveat=[0.5, 1.0], **options
        )

    point = 0.3, jnp.asarray(SAMPLES[1])
    found = run(*point)
    np.testing.assert_allclose(found["x"], [0.7, 0.7 + 4 + 0.5], atol=1e-12)
    assert [(e.t, e.condition) for e in found.events] == [
        (0.3, "time >= tw"),
        (0.5, "an input jumps"),
    ]
    by_tw, by_values = jax.grad(lambda *a: run(*a)["x"][-1], (0, 1))(*point)
    np.testing.assert_allclose(by_tw, -1, atol=1e-9)
    np.testing.assert_allclose(by_values, [0.5, 0.5, 0.0], atol=1e-9)
    if path != "heun":
        forward = diffrax.ForwardMode()
        along = jax.jvp(lambda tw: run(tw, point[1], adjoint=forward)["x"], (0.3,), (1.0,))[1]
        np.testing.assert_allclose(along, [-1, -1], atol=1e-9)


ROWS = [(name, kind) for name in ("heun", "rk4", "adaptive") for kind in ("previous", "linear")]


@pytest.mark.parametrize(
    ("name", "kind"),
    some_slow(ROWS, [("heun", "previous")], [r for r in ROWS if r != ("heun", "previous")]),
)
def test_rows_of_a_training_see_their_own_side(name: str, kind: Any) -> None:
    system, n = driven(), 8
    ends = np.linspace(0, 1, n + 1)
    values = SAMPLES[1] if kind == "previous" else SAMPLES[1] / 4  # below the condition's threshold
    signal = ac.Signal(SAMPLES[0], values, kind)
    functions = functions_of_time(system, {"u": signal}, (0.0, 1.0), ends)
    solver = (
        Adaptive() if name == "adaptive" else solvers.for_fixed_steps(solvers.solver_named(name))
    )  # pyright: ignore[reportArgumentType]

    def end(tw: Any) -> Any:
        packed, u = system.pack({"tw": tw}), evaluate_all(functions, jnp.zeros(1))[0]
        start = system.values(0.0, system.initial_state(packed, None, u, 0.0), u, packed)
        steps = Steps(jnp.asarray(ends[:-1]), jnp.asarray(1 / n), over_steps(functions, ends))
        return integrate_in_steps(system, start, steps, solver).end[0]

    value, gradient = jax.value_and_grad(end)(0.3)
    exact = 0.7 + (0.5 + 1.5 + 2.5 if kind == "previous" else 0.25 + 0.625)
    np.testing.assert_allclose([value, gradient], [exact, -1], atol=1e-9)


@pytest.mark.machines
def test_the_order_of_fixed_steps_survives_jumps_between_them() -> None:
    """Beside steps a quarter as long the error of rk4 falls by 4^4, where the input jumps between their ends, too."""
    u = ac.Signal([0.0, 0.33, 0.71, 1.0], [0.5, -1.0, 1.5, 0.2], "previous")
    exact = ac.simulate(
        driven(), 1.0, inputs={"u": u}, saveat=[1.0], solver="dopri8", rtol=1e-13, atol=1e-15
    )["y"][-1]
    errors = [
        abs(ac.simulate(driven(), 1.0, inputs={"u": u}, dt=dt, solver="rk4")["y"][-1] - exact)
        for dt in (0.2, 0.05)
    ]
    assert errors[0] > 100 * errors[1]


@pytest.mark.machines  # "turns stiff" of the gradients is this model, too
@pytest.mark.parametrize("solver", ["auto", "kvaerno5"])
def test_a_method_that_begins_at_an_event_feels_its_time(solver: str) -> None:
    """Reverse beside forward mode: only the first had forgotten where the second method begins."""
    system = ac.compile(TurnsStiff())

    def end(tw: Any, **how: Any) -> Any:
        options: dict[str, Any] = {"solver": solver, "rtol": 1e-9, "atol": 1e-11, "saveat": [1.0]}
        return ac.simulate(system, 1.0, params={"tw": tw}, **options, **how)["x"][-1]

    reverse = jax.grad(end)(0.3)
    forward = jax.jvp(lambda tw: end(tw, adjoint=diffrax.ForwardMode()), (0.3,), (1.0,))[1]
    np.testing.assert_allclose(reverse, forward, rtol=1e-9)
    np.testing.assert_allclose(reverse, -1.1704044, rtol=1e-6)
