"""The nonlinear equations of implicit steps: tolerances in the state's units, gradients, sparse matrices, damping."""

from functools import partial
from typing import Any

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.codegen.iteration_matrix import SparseIterationMatrix
from acausal.components import thermal as th
from tests.support.parts import Equations
from tests.support.stiff import Plate

CAPACITY = 1e-7


def clamped() -> ac.System:
    """A capacitor of 0.1 uF behind 20 Ohm and a sine, clamped by an exponential characteristic."""

    def stated(s: Any) -> Any:
        through = (10 * ac.sin(30 * ac.time) - s.v) / 20
        return [ac.Eq(s.C * ac.der(s.v), through - 1e-3 * ac.exp((s.v - s.knee) / 0.05))]

    return ac.compile(Equations("v", stated, C=CAPACITY, knee=5.0))


def left(v: float, t: float = 0.05) -> float:
    """The current into the capacitor: all but none, as it follows at once."""
    return (10 * np.sin(30 * t) - v) / 20 - 1e-3 * np.exp((v - 5.0) / 0.05)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["kvaerno3", "kvaerno5"])
def test_tight_tolerances_cost_few_steps_where_modes_are_fast(name: str) -> None:
    found = ac.simulate(clamped(), 0.05, x0={"v": 0.0}, solver=name, rtol=1e-7, atol=1e-9)
    assert found.statistics is not None
    assert found.statistics.steps < 1500
    assert abs(left(float(found["v"][-1]))) < 1e-3 * 10 / 20


@pytest.mark.slow
def test_gradients_go_through_implicit_steps() -> None:
    system = clamped()

    def end(knee: Any) -> Any:
        how = {"solver": "kvaerno5", "rtol": 1e-7, "atol": 1e-9, "x0": {"v": 0.0}}
        return ac.simulate(system, 0.05, params={"knee": knee}, saveat=[0.05], **how).x[-1, 0]

    derivative = float(jax.grad(end)(5.0))
    difference = float(end(5.001) - end(4.999)) / 0.002
    assert derivative == pytest.approx(difference, rel=1e-4)


@pytest.mark.parametrize("name", ["implicit_euler", "kvaerno3"])
def test_fixed_steps_far_beyond_the_fastest_mode_are_found(name: str) -> None:
    """With steps of 1 ms the derivatives reach 1e7; the state is found to its tolerance all the same."""
    found = ac.simulate(clamped(), 0.05, dt=1e-3, x0={"v": 0.0}, solver=name)
    assert abs(left(float(found["v"][-1]))) < 1e-3 * 10 / 20


def test_fixed_steps_are_damped_where_newtons_method_runs_around_the_solution() -> None:
    """Of ``x = 10 - 100 atan(x)`` whole corrections go from 160 to -160 and back for ever."""
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), -100 * ac.atan(s.x))]))
    (x,) = ac.simulate(system, 1.0, dt=1.0, x0={"x": 10.0}, solver="implicit_euler").x[-1]
    assert float(x) == pytest.approx(10 - 100 * np.arctan(x), abs=1e-9)


@pytest.mark.slow
def test_second_derivatives_go_through_multistep_and_one_step_methods() -> None:
    """``x' = -k x^3`` is at ``(1 + 2 k t)^-1/2``."""
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), -s.k * s.x**3)], k=2.0))

    def end(k: Any, solver: str) -> Any:
        how = {"adjoint": dfx.ForwardMode(), "solver": solver, "saveat": [0.5], "rtol": 1e-8}
        return ac.simulate(system, 0.5, params={"k": k}, x0={"x": 1.0}, **how).x[-1, 0]

    for solver in ("bdf", "kvaerno5"):
        second = jax.jacfwd(jax.jacfwd(lambda k, s=solver: end(k, s)))(2.0)
        assert float(second) == pytest.approx(0.75 * 3.0**-2.5, rel=1e-4)


class Thermostat(Plate):
    """A plate that is heated at its first capacity until that is hot."""

    def __init__(self, n: int) -> None:
        super().__init__(n)
        self.heater = th.PrescribedHeatFlow()
        self.on = ac.Discrete(1, kind="bool")
        self.heat, self.flow = ac.Variable(unit="J", start=0.0, fixed=True), ac.Output(unit="W")
        self.connect(self.flow, self.heater.Q_flow)
        self.connect(self.heater.port, self.capacity[0].port)

    def equations(self) -> Any:
        first = self.capacity[0].T
        yield ac.Eq(self.flow, ac.where(self.on, 400.0, 0.0))
        yield ac.Eq(ac.der(self.heat), self.flow + 50.0)
        cold = ac.where(first < 315.0, 1, ac.pre(self.on))
        yield ac.Eq(self.on, ac.where(first > 320.0, 0, cold))


@pytest.mark.parametrize("name", ["implicit_euler", "kvaerno4"])
def test_implicit_schemes_choose_their_steps(name: str) -> None:
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), -50 * (s.x - 1))]))
    saved = np.linspace(0.0, 1.0, 11)
    found = ac.simulate(system, 1.0, x0={"x": 0.0}, solver=name, saveat=saved, rtol=1e-5)
    np.testing.assert_allclose(found["x"], 1 - np.exp(-50 * saved), atol=2e-3)


@pytest.mark.slow
def test_stiff_models_with_events_have_sparse_steps() -> None:
    system = ac.compile(Thermostat(11))
    assert isinstance(system.state_jacobian.iteration_matrix, SparseIterationMatrix)
    found = ac.simulate(system, 20.0, solver="stiff", saveat=[0.0, 20.0], rtol=1e-8, atol=1e-8)
    assert len(found.events) >= 2
    values = system.parameters()
    parts = (f"capacity[{i}]" for i in range(1, 122))
    stored = sum(values[f"{part}.C"] * np.diff(found[f"{part}.T"])[0] for part in parts)
    assert stored == pytest.approx(float(found["heat"][-1]), rel=1e-6)


@pytest.mark.slow
def test_fixed_implicit_steps_are_differentiated_in_both_modes() -> None:
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), -s.k * s.x**3)], k=2.0))

    def end(k: Any, adjoint: Any) -> Any:
        how = {"dt": 0.25, "solver": "kvaerno3", "adjoint": adjoint}
        return ac.simulate(system, (0.0, 0.5), params={"k": k}, x0={"x": 1.0}, **how).x[-1, 0]

    forward = jax.jit(jax.jacfwd(lambda k: end(k, dfx.ForwardMode())))(2.0)
    assert float(forward) == pytest.approx(float(jax.jit(jax.grad(lambda k: end(k, None)))(2.0)))


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("name", ["implicit_euler", "kvaerno3"])
def test_where_a_stage_has_no_solution_the_step_and_its_derivatives_are_not_numbers(name: str):
    """A training rejects such a trial; it must not end the program."""
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), s.k * (1 + s.x**2))], k=1.0))

    def end(k: Any, adjoint: Any = None) -> Any:
        how = {"dt": 0.25, "solver": name, "adjoint": adjoint}
        return ac.simulate(system, (0.0, 1.0), params={"k": k}, x0={"x": 0.0}, **how).x[-1, 0]

    gradient = jax.jit(jax.value_and_grad(end))
    assert all(bool(jnp.isnan(v)) for v in gradient(8.0))
    _, slope = gradient(0.5)
    difference = (end(0.5 + 1e-5) - end(0.5 - 1e-5)) / 2e-5
    assert float(slope) == pytest.approx(float(difference), rel=1e-6)
    forward = jax.jit(jax.jacfwd(lambda k: end(k, dfx.ForwardMode())))
    assert float(forward(0.5)) == pytest.approx(float(slope), rel=1e-12)


def test_a_first_step_whose_stages_have_no_solution_leaves_no_trace_at_the_start() -> None:
    """Robertson's reaction from its usual start: the first step that is tried is far too long for Newton's method."""

    def stated(s: Any) -> Any:
        back, fast = 1e4 * s.b * (1 - s.a - s.b), 3e7 * s.b**2
        yield ac.Eq(ac.der(s.a), -0.04 * s.a + back)
        yield ac.Eq(ac.der(s.b), 0.04 * s.a - back - fast)

    system = ac.compile(Equations("a b", stated))
    found = ac.simulate(system, 40.0, x0={"a": 1.0, "b": 0.0}, solver="kvaerno5", saveat=[0, 40.0])
    np.testing.assert_array_equal(found.x[0], [1.0, 0.0])
    np.testing.assert_allclose(found.x[1], [0.7158271, 9.185535e-6], rtol=2e-6)  # Hairer and Wanner


def test_the_right_side_with_a_loop_is_written_once_for_all_stages_of_a_fixed_step() -> None:
    component = Equations("x y", lambda s: [ac.Eq(ac.der(s.x), -s.y), ac.Eq(s.y + s.y**3, s.x)])
    component.modify(x=ac.Start(1.0, fixed=True))
    system = ac.compile(component)

    def end(x0: Any, solver: str) -> Any:
        return ac.simulate(system, 1.0, x0={"x": x0}, dt=0.1, solver=solver)["x"][-1]

    heun, rk4 = (str(jax.make_jaxpr(partial(end, solver=s))(1.0)) for s in ("heun", "rk4"))
    assert rk4.count("while[") == heun.count("while[")
    # with x = y + y³, dt = -(1/y + 3 y) dy
    y0, y1 = 0.6823278038280193, ac.simulate(system, 1.0, dt=0.1, solver="rk4")["y"][-1]
    assert np.log(y0 / y1) + 1.5 * (y0**2 - y1**2) == pytest.approx(1.0, abs=1e-6)
