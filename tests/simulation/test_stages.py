"""The nonlinear equations of implicit steps: tolerances in the state's units, gradients."""

from typing import Any

import diffrax as dfx
import jax
import jax.numpy as jnp
import pytest

import acausal as ac
from acausal.simulation import solvers
from tests.support.parts import Equations

CAPACITY = 1e-7


def clamped(t: Any, v: Any, knee: Any) -> Any:
    """A capacitor of 0.1 uF behind 20 Ohm and a sine, clamped by an exponential characteristic."""
    return ((10 * jnp.sin(30 * t) - v) / 20 - 1e-3 * jnp.exp((v - knee) / 0.05)) / CAPACITY


def solve(solver: Any, knee: Any, rtol: float, steps: int = 1500) -> Any:
    return dfx.diffeqsolve(
        dfx.ODETerm(clamped),
        solver,
        0.0,
        0.05,
        None,
        jnp.zeros(1),
        knee,
        stepsize_controller=dfx.PIDController(rtol=rtol, atol=1e-2 * rtol),
        max_steps=steps,
        throw=False,
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", ["kvaerno3", "kvaerno5"])
def test_tight_tolerances_cost_few_steps_where_modes_are_fast(name: str) -> None:
    found = solve(solvers.solver_named(name), 5.0, 1e-7)
    assert bool(found.result == dfx.RESULTS.successful)
    v, t = float(found.ys[-1, 0]), 0.05
    assert abs(float(clamped(t, v, 5.0))) < 1e-3 * 10 / 20 / CAPACITY  # all but at rest
    theirs = solve(dfx.Kvaerno5(), 5.0, 1e-7)  # tolerances of the derivative, below its rounding
    assert not bool(theirs.result == dfx.RESULTS.successful)


@pytest.mark.slow
def test_gradients_go_through_implicit_steps() -> None:
    def end(knee: Any) -> Any:
        return solve(solvers.solver_named("kvaerno5"), knee, 1e-7).ys[-1, 0]

    derivative = float(jax.grad(end)(5.0))
    difference = float(end(5.001) - end(4.999)) / 0.002
    assert derivative == pytest.approx(difference, rel=1e-4)


@pytest.mark.parametrize("name", ["implicit_euler", "kvaerno3"])
def test_fixed_steps_far_beyond_the_fastest_mode_are_found(name: str) -> None:
    """With steps of 1 ms the derivatives reach 1e7; the state is found to its tolerance all the same."""
    found = dfx.diffeqsolve(
        dfx.ODETerm(clamped),
        solvers.for_fixed_steps(solvers.solver_named(name)),
        0.0,
        0.05,
        1e-3,
        jnp.zeros(1),
        5.0,
    )
    assert found.ys is not None
    assert abs(float(clamped(0.05, found.ys[-1, 0], 5.0))) < 1e-3 * 10 / 20 / CAPACITY


def test_fixed_implicit_steps_are_differentiated_in_both_modes() -> None:
    system = ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), -s.k * s.x**3)], k=2.0))

    def end(k: Any, adjoint: Any) -> Any:
        how = {"dt": 0.25, "solver": "kvaerno3", "adjoint": adjoint}
        return ac.simulate(system, (0.0, 0.5), params={"k": k}, x0={"x": 1.0}, **how).x[-1, 0]

    forward = jax.jit(jax.jacfwd(lambda k: end(k, dfx.ForwardMode())))(2.0)
    assert float(forward) == pytest.approx(float(jax.jit(jax.grad(lambda k: end(k, None)))(2.0)))


@pytest.mark.cases(fast=1)
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
