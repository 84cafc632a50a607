"""Simulation in adaptive steps, by diffrax."""

from __future__ import annotations

from typing import Any

import diffrax as dfx
import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal._jax import cast, traced
from acausal.errors import SimulationError, StepLimitError
from acausal.simulation import inputs, solvers
from acausal.simulation.run import Run
from acausal.simulation.solution import Solution

Tolerance = float | Array


def simulate_adaptive(
    run: Run,
    saved: np.ndarray,
    solver: solvers.Solver,
    rtol: Tolerance,
    atol: Tolerance,
    max_steps: int,
    adjoint: dfx.AbstractAdjoint | None,
    dtype: np.dtype[Any],
) -> Solution:
    """Simulate in steps that a PID controller chooses, and that end where an input is known to jump.

    Arguments:
        run: what to simulate.
        saved: times to save.
        solver: a solver with an error estimate.
        rtol: relative tolerance of a step.
        atol: absolute tolerance, in the states' units.
        max_steps: limit of steps.
        adjoint: how to differentiate; ``None`` is diffrax's reverse mode with checkpoints.
        dtype: precision of time and states.

    Raises:
        SimulationError: if the end is not reached.
    """
    solver = solvers.for_adaptive_steps(solver)
    jumps = jnp.asarray(inputs.jumps(run.drive, run.start, run.end))
    run, t, jumps = cast((run, jnp.asarray(saved), jumps), dtype)
    chosen = dfx.RecursiveCheckpointAdjoint() if adjoint is None else adjoint
    x, reached, last, result = _solve(run, t, solver, rtol, atol, jumps, max_steps, chosen)
    if not traced(x, reached):
        _check(run, np.asarray(x), float(reached), np.asarray(last), result, max_steps, solver)
    return Solution(t, x, inputs.evaluate_all(run.drive, t), run.system, run.packed)


@eqx.filter_jit
def _solve(
    run: Run,
    ts: Array,
    solver: solvers.Solver,
    rtol: Tolerance,
    atol: Tolerance,
    jumps: Array,
    max_steps: int,
    adjoint: dfx.AbstractAdjoint,
) -> tuple[Array, Array, Array, Any]:
    arrays, rest = eqx.partition((run.packed, run.drive), eqx.is_array)

    def field(t: Any, x: Array, args: Any) -> Array:
        packed, drive = eqx.combine(args, rest)
        return run.system.vector_field(t, x, inputs.evaluate(drive, t), packed)

    controller: Any = dfx.PIDController(rtol=rtol, atol=atol)
    if jumps.shape[0]:
        controller = dfx.ClipStepSizeController(controller, jump_ts=jumps)
    solution: Any = dfx.diffeqsolve(
        dfx.ODETerm(field),
        solver,
        run.start,
        run.end,
        None,
        run.x0,
        arrays,
        saveat=dfx.SaveAt(subs=[dfx.SubSaveAt(ts=ts), dfx.SubSaveAt(t1=True)]),
        stepsize_controller=controller,
        max_steps=max_steps,
        throw=False,
        adjoint=adjoint,
    )
    return solution.ys[0], solution.ts[1][-1], solution.ys[1][-1], solution.result


def _check(
    run: Run,
    x: np.ndarray,
    reached: float,
    last: np.ndarray,
    result: Any,
    max_steps: int,
    solver: solvers.Solver,
) -> None:
    if bool(result == dfx.RESULTS.successful) and np.isfinite(x).all():
        return
    where = f"The simulation with {type(solver).__name__} stopped at t = {reached:g} s, before {run.end:g} s"
    exhausted = bool(result == dfx.RESULTS.max_steps_reached)
    ahead = (run.end - run.start) / max_steps if exhausted else run.end - reached
    if reason := run.explain(reached, last, ahead):
        raise SimulationError(f"{where}.{reason}")
    if not exhausted:
        raise SimulationError(
            f"{where}: its steps became too small, or its values not finite. "
            "The model may run away there: look at its parameters, initial values and inputs."
        )
    implicit = isinstance(solver, dfx.AbstractImplicitSolver)
    stiff = "" if implicit else "it is stiff (choose solver='kvaerno5'), "
    raise StepLimitError(
        f"{where}, after max_steps={max_steps}. Perhaps {stiff}it runs away there, "
        "or its inputs are rough (raise max_steps, loosen rtol, or give dt for fixed steps)."
    )
