"""Simulation in fixed steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal._jax import cast, traced
from acausal.errors import DataError, SimulationError
from acausal.simulation import inputs, solvers
from acausal.simulation.fixed_steps import Steps, integrate
from acausal.simulation.run import Run
from acausal.simulation.solution import Solution

if TYPE_CHECKING:
    from acausal.system import System

ON_GRID = 1e-6
"""A time lies on the grid if it is within this fraction of a step of a step's end."""

STABILITY = 2.0
"""Reach of the explicit schemes' stability regions, about, in units of 1/step."""


def grid(start: float, end: float, dt: float) -> np.ndarray:
    """The ends of equal steps ``dt`` from start to end, shape (n + 1,).

    Raises:
        DataError: if they do not divide the span.
    """
    if not (isinstance(dt, float | int | np.number) and np.isfinite(dt) and dt > 0):
        raise DataError(f"dt={dt!r} is no step; give a positive time in seconds.")
    span = end - start
    n = max(round(span / dt), 1)
    if abs(span / dt - n) > ON_GRID * n:
        raise DataError(
            f"Steps of dt={dt:g} s do not divide the {span:g} s from {start:g} to {end:g} s; "
            f"choose dt={span:g}/{n}, or end at {start + n * dt:g} s."
        )
    return start + span / n * np.arange(n + 1)


def simulate_fixed(
    run: Run,
    ends: np.ndarray,
    saved: np.ndarray | None,
    solver: solvers.Solver,
    *,
    dtype: np.dtype[Any],
    direct: bool = False,
) -> Solution:
    """Simulate in equal steps.

    Arguments:
        run: what to simulate.
        ends: the steps' ends, from `grid`.
        saved: times to save, all among ``ends``; ``None`` saves all.
        solver: a one-step scheme.
        dtype: precision of the steps.
        direct: whether derivatives in forward mode must work, too.

    Raises:
        DataError: for a time to save that is no step's end.
        SimulationError: if a value is not finite.
    """
    rows = slice(None) if saved is None else _rows(ends, saved)
    h = (ends[-1] - ends[0]) / (len(ends) - 1)
    samples = inputs.over_steps(run.drive, ends)
    steps = Steps(jnp.asarray(ends[:-1]), jnp.asarray(h), samples)
    packed, x0, steps = cast((run.packed, run.x0, steps), dtype)
    x = _scan(run.system, packed, x0, steps, solvers.for_fixed_steps(solver, dtype), direct)
    if not traced(x):
        _check(run, ends, np.asarray(x))
    t = jnp.asarray(ends)[rows]
    if any(f is not None for f in samples.functions):
        u = inputs.evaluate_all(run.drive, t)
    else:
        u = jnp.concatenate([samples.start, samples.end[-1:]])[rows]
    return Solution(*cast((t, x[rows], u), dtype), run.system, packed)


@eqx.filter_jit
def _scan(
    system: System, packed: Any, x0: Array, steps: Steps, solver: solvers.Solver, direct: bool
) -> Array:
    xs, _, end = integrate(system, packed, x0, steps, solver, direct=direct)
    return jnp.concatenate([xs, end[None]])


def _rows(ends: np.ndarray, ts: np.ndarray) -> np.ndarray:
    position = (ts - ends[0]) / (ends[1] - ends[0])
    rows = np.round(position).astype(int)
    off = np.abs(position - rows) > ON_GRID * len(ends)
    if off.any():
        raise DataError(
            f"saveat has {ts[off][0]:g} s, which is no step's end; "
            "save multiples of dt, or leave dt out for adaptive steps."
        )
    return rows


def _check(run: Run, ends: np.ndarray, x: np.ndarray) -> None:
    bad = np.flatnonzero(~np.isfinite(x).all(axis=1))
    if not len(bad):
        return
    state = run.system.states[int(np.flatnonzero(~np.isfinite(x[bad[0]]))[0])]
    last, dt = max(int(bad[0]) - 1, 0), ends[1] - ends[0]
    reason = run.explain(float(ends[last]), x[last], dt)
    raise SimulationError(
        f"The simulation broke down after t = {ends[last]:g} s: '{state}' is not finite."
        + (reason or " " + _mend(run.modes(), dt))
    )


def _mend(modes: Any, dt: float) -> str:
    growth = float(np.max(modes.real, initial=0.0))
    fastest = float(np.max(np.abs(modes[modes.real <= 0]), initial=0.0))
    if fastest * dt > STABILITY:
        return (
            f"dt={dt:g} s is too long for the model's fastest mode, {fastest:.3g} 1/s at the start: "
            f"choose dt below {1 / fastest:.1g} s, an implicit solver, or leave dt out."
        )
    if growth > 0:
        return f"The model is unstable: a mode grows by {growth:.3g} 1/s at the start. Look at its parameters."
    return "It may run away there: look at its parameters, initial values and inputs, or try a smaller dt."
