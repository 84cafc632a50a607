"""Simulation in adaptive steps, by diffrax."""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import diffrax as dfx
import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float, PyTree

from acausal._jax import cast, is_real, traced, two_modes
from acausal.errors import DataError, SimulationError, StepLimitError, shown
from acausal.simulation import solvers
from acausal.simulation.inputs import evaluate, evaluate_all, jumps
from acausal.simulation.run import Run
from acausal.simulation.solution import Solution

Tolerance = float | Array

SHORTEST = 1e-30
"""The shortest step, as a fraction of the span: only a model without finite values leads there."""


def check_tolerances(rtol: Tolerance, atol: Tolerance, n_states: int) -> None:
    """Refuse tolerances with which no step can be accepted.

    Raises:
        DataError: for one that is negative or not a finite number, nor one such number for each state; or if all
            are zero.
    """
    for name, given in {"rtol": rtol, "atol": atol}.items():
        if not _is_tolerance(given, n_states):
            raise DataError(
                f"{name}={shown(given)} is not a tolerance; give a positive number, such as {name}=1e-6, or an array "
                "of one for each state."
            )
    if traced(rtol, atol):
        return
    if not (np.any(rtol) or np.any(atol)):
        raise DataError("rtol and atol are both zero; give rtol=1e-6, say.")


def _is_tolerance(given: Tolerance, n_states: int) -> bool:
    """Whether this is a finite number, or an array of these, none below zero where they are known."""
    if not is_real(given) or isinstance(given, list | tuple):
        return False
    if np.shape(given) not in ((), (n_states,)):
        return False
    return traced(given) or bool((np.isfinite(given) & (np.asarray(given) >= 0)).all())


class Solved(NamedTuple):
    """The result of diffrax.

    Attributes:
        x: states at the saved times, shape (n, n_states).
        reached: the last time. ``last``: the state there.
        result: whether and why it stopped.
    """

    x: Float[Array, "n n_states"]
    reached: Float[Array, ""]
    last: Float[Array, " n_states"]
    result: dfx.RESULTS


def simulate_adaptive(
    run: Run,
    saved: Float[np.ndarray, " n"],
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
        adjoint: how to differentiate; ``None``: in reverse mode with checkpoints, and in forward mode.
        dtype: precision of time and states.

    Raises:
        SimulationError: if the end is not reached.
    """
    solver = solvers.for_adaptive_steps(solver)
    jump_times = jnp.asarray(jumps(run.inputs, run.begin, run.end))
    run, t, jump_times = cast((run, jnp.asarray(saved), jump_times), dtype)
    solved = _solve(_Task(run, t, solver, rtol, atol, jump_times, max_steps), adjoint)
    if not traced(solved.x, solved.reached):
        _check(run, saved, solved, max_steps, solver)
    u = evaluate_all(run.inputs, t)
    return Solution(run.start._replace(t=t, x=solved.x, u=u), run.system)


class _Task(NamedTuple):
    """What is asked of diffrax, whatever the way in which it is differentiated."""

    run: Run
    ts: Float[Array, " n"]
    solver: solvers.Solver
    rtol: Tolerance
    atol: Tolerance
    jump_times: Float[Array, " n_jumps"]
    max_steps: int


@eqx.filter_jit
def _solve(task: _Task, adjoint: dfx.AbstractAdjoint | None) -> Solved:
    if adjoint is not None:
        return _diffeqsolve(task, adjoint)
    arrays, rest = eqx.partition(task, eqx.is_array)

    def solve(arrays: PyTree, adjoint: dfx.AbstractAdjoint) -> Solved:
        return _diffeqsolve(eqx.combine(arrays, rest), adjoint)

    reverse, forward = dfx.RecursiveCheckpointAdjoint(), dfx.ForwardMode()
    return two_modes(partial(solve, adjoint=reverse), partial(solve, adjoint=forward))(arrays)


def _diffeqsolve(task: _Task, adjoint: dfx.AbstractAdjoint) -> Solved:
    run, ts, solver, rtol, atol, jump_times, max_steps = task
    constant = run.start._replace(t=None, x=None, u=None)
    arrays, rest = eqx.partition((constant, run.inputs), eqx.is_array)

    def field(t: ArrayLike, x: Array, args: PyTree) -> Array:
        values, inputs = eqx.combine(args, rest)
        return run.system.rates(values._replace(t=t, x=x, u=evaluate(inputs, t)))

    controller: dfx.AbstractStepSizeController[Any, Any] = dfx.PIDController(
        rtol=rtol, atol=atol, dtmin=SHORTEST * (run.end - run.begin), force_dtmin=False
    )
    if jump_times.shape[0]:
        controller = dfx.ClipStepSizeController(controller, jump_ts=jump_times)
    solution: Any = dfx.diffeqsolve(
        dfx.ODETerm(field),
        solver,
        run.begin,
        run.end,
        None,
        run.start.x,
        arrays,
        saveat=dfx.SaveAt(subs=[dfx.SubSaveAt(ts=ts), dfx.SubSaveAt(t1=True)]),
        stepsize_controller=controller,
        max_steps=max_steps,
        throw=False,
        adjoint=adjoint,
    )
    return Solved(solution.ys[0], solution.ts[1][-1], solution.ys[1][-1], solution.result)


def _check(
    run: Run, ts: Float[np.ndarray, " n"], solved: Solved, max_steps: int, solver: solvers.Solver
) -> None:
    if bool(solved.result == dfx.RESULTS.successful):
        if (broken := run.broken(solved.x)) is None:
            return
        row, what = broken
        raise SimulationError(
            f"The simulation with {type(solver).__name__} broke down before t = {ts[row]:g} s: {what}. "
            "The model may diverge there: check its parameters, initial values and inputs."
        )
    reached = float(solved.reached)
    where = f"The simulation with {type(solver).__name__} stopped at t = {reached:g} s, before {run.end:g} s"
    exhausted = bool(solved.result == dfx.RESULTS.max_steps_reached)
    ahead = (run.end - run.begin) / max_steps if exhausted else run.end - reached
    if reason := run.explain(run.at(reached, solved.last), ahead):
        raise SimulationError(f"{where}.{reason}")
    if not exhausted:
        raise SimulationError(
            f"{where}: its steps became too small, or its values not finite. "
            "The model may diverge there: check its parameters, initial values and inputs."
        )
    implicit = isinstance(solver, dfx.AbstractImplicitSolver)
    stiff = "" if implicit else "it is stiff (choose solver='kvaerno5'), "
    raise StepLimitError(
        f"{where}, after max_steps={max_steps}. Perhaps {stiff}it diverges there, "
        "or its inputs are rough (raise max_steps, loosen rtol, or give dt for fixed steps)."
    )
