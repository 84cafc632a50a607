"""`simulate`: integrate a model over time, by fixed steps or adaptively."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.typing import ArrayLike

from acausal import inputs as drives
from acausal import solvers
from acausal.data import Data
from acausal.errors import DataError, SimulationError
from acausal.integrate import Steps, integrate
from acausal.solution import Solution

if TYPE_CHECKING:
    from acausal.system import System

POINTS = 500
"""Points that an adaptive simulation saves unless it is told which."""

WHOLE = 1e-6
"""A time lies on the grid of steps if it is within this fraction of a step of one."""


def simulate(
    system: System,
    t: tuple[float, float],
    *,
    dt: float | None = None,
    saveat: ArrayLike | None = None,
    inputs: Mapping[str, Any] | Data | None = None,
    params: Mapping[str, Any] | None = None,
    x0: Mapping[str, ArrayLike] | ArrayLike | None = None,
    solver: str | solvers.Solver = "auto",
    rtol: float = 1e-6,
    atol: float = 1e-8,
    max_steps: int = 100_000,
    adjoint: dfx.AbstractAdjoint | None = None,
) -> Solution:
    """Simulate a model.

    With ``dt`` in fixed steps, without it adaptively. Both can be differentiated (in reverse mode; by
    parameters, initial values and sampled inputs), compiled with `jax.jit` and mapped with `jax.vmap`.

    Arguments:
        system: a compiled model.
        t: start and end, in seconds.
        dt: fixed step in seconds; it must divide the span.
        saveat: times to save, in seconds. By default every step, or 500 equal points without ``dt``.
        inputs: by name, for every input of the model: a number; an array of samples at the ends of the fixed
            steps; a pair (times, samples), read linearly; a `Signal`; a function of time that JAX can trace. A
            `Data` record gives the inputs it has. Samples that fall on the steps' ends cost nothing.
        params: as `system.parameters` gives them, the default.
        x0: initial values by name, or the whole state; by default the model's start values.
        solver: a name (`acausal.solvers.SOLVERS`) or a diffrax solver. ``"auto"`` is Tsit5; without ``dt``
            it is Kvaerno5 if the Jacobian at the start has damped modes so fast that stability
            would cost Tsit5 more than 5000 steps (not examined while JAX traces, and above 300 states).
        rtol, atol: relative and absolute tolerance of an adaptive step; ``atol`` in the states' units.
        max_steps: limit of adaptive steps.
        adjoint: how diffrax differentiates adaptive steps; by default reverse mode with checkpoints.

    Returns:
        The trajectory, any variable of it by name.

    Raises:
        DataError: for missing, unknown or malformed inputs and times.
        SimulationError: if the solution stops short of the end, with the time reached.
    """
    start, end = _span(t)
    grid = None if dt is None else _grid(start, end, dt)
    drive = drives.read(system.inputs, inputs, grid)
    params = system.parameters() if params is None else params
    packed = system.pack(params)
    u0 = drives.evaluate(drive, start)
    x_start = system.initial_state(params, x0, u0, start)
    run = _Run(system, packed, x_start, drive, start, end)
    if grid is not None:
        return _fixed(run, grid, saveat, solvers.named("tsit5" if solver == "auto" else solver))
    chosen = _choose(run, u0) if solver == "auto" else solvers.named(solver)
    return _adaptive(run, saveat, chosen, rtol, atol, max_steps, adjoint)


class _Run(NamedTuple):
    """What is simulated, whatever the steps."""

    system: System
    packed: Any
    x0: Array
    drive: tuple[drives.Drive, ...]
    start: float
    end: float


# -- fixed steps -----------------------------------------------------------------------------------


def _fixed(run: _Run, grid: np.ndarray, saveat: ArrayLike | None, solver: solvers.Solver) -> Solution:
    rows = slice(None) if saveat is None else _rows(grid, _save_times(run, saveat))
    h = (grid[-1] - grid[0]) / (len(grid) - 1)
    steps = Steps(jnp.asarray(grid[:-1]), jnp.asarray(h), drives.over_steps(run.drive, grid))
    solver = solvers.fixed(solver)
    x = _scan(run.system, run.packed, run.x0, steps, solver)
    if _concrete(x):
        _check_fixed(run, grid, np.asarray(x), solver)
    t, x = jnp.asarray(grid)[rows], x[rows]
    return Solution(t, x, _inputs_at(run.drive, steps, t, rows), run.system, run.packed)


@eqx.filter_jit
def _scan(system: System, packed: Any, x0: Array, steps: Steps, solver: solvers.Solver) -> Array:
    xs, _, end = integrate(system, packed, x0, steps, solver)
    return jnp.concatenate([xs, end[None]])


def _inputs_at(drive: tuple[drives.Drive, ...], steps: Steps, t: Array, rows: Any) -> Array:
    samples = steps.inputs
    if any(f is not None for f in samples.functions):
        return _evaluate_all(drive, t)
    return jnp.concatenate([samples.start, samples.end[-1:]])[rows]


def _grid(start: float, end: float, dt: float) -> np.ndarray:
    if not (np.isfinite(dt) and dt > 0):
        raise DataError(f"dt={dt} is no step; give a positive time in seconds.")
    n = max(round((end - start) / dt), 1)
    if abs((end - start) / dt - n) > WHOLE * n:
        raise DataError(
            f"The steps dt={dt:g} s do not divide the {end - start:g} s from {start:g} to {end:g} s; "
            f"choose dt={(end - start) / n:g}, or end at {start + n * dt:g} s."
        )
    return start + (end - start) / n * np.arange(n + 1)


def _rows(grid: np.ndarray, ts: np.ndarray) -> np.ndarray:
    position = (ts - grid[0]) / (grid[1] - grid[0])
    rows = np.round(position).astype(int)
    off = np.abs(position - rows) > WHOLE * max(len(grid), 1)
    if off.any():
        raise DataError(
            f"saveat has {ts[off][0]:g} s, which is no step's end; "
            "save multiples of dt, or leave dt out for adaptive steps."
        )
    return rows


def _check_fixed(run: _Run, grid: np.ndarray, x: np.ndarray, solver: solvers.Solver) -> None:
    bad = np.flatnonzero(~np.isfinite(x).all(axis=1))
    if not len(bad):
        return
    row = max(int(bad[0]) - 1, 0)
    state = run.system.states[int(np.flatnonzero(~np.isfinite(x[bad[0]]))[0])]
    dt = grid[1] - grid[0]
    fastest = _fastest(run)
    if fastest * dt > solvers.STABILITY / 2:
        mend = (
            f"dt={dt:g} s is too long for the model's fastest mode, {fastest:.3g} 1/s at the start: "
            f"choose dt below {1 / fastest:.1g} s, an implicit solver, or leave dt out."
        )
    else:
        mend = "The model may be unstable there: look at its parameters, initial values and inputs."
    raise SimulationError(f"The simulation broke down after t = {grid[row]:g} s ('{state}' is not finite). {mend}")


# -- adaptive steps --------------------------------------------------------------------------------


def _adaptive(
    run: _Run,
    saveat: ArrayLike | None,
    solver: solvers.Solver,
    rtol: float,
    atol: float,
    max_steps: int,
    adjoint: dfx.AbstractAdjoint | None,
) -> Solution:
    solver = solvers.adaptive(solver)
    ts = np.linspace(run.start, run.end, POINTS) if saveat is None else _save_times(run, saveat)
    jumps = drives.jumps(run.drive, run.start, run.end)
    x, reached, failure = _solve(
        run, jnp.asarray(ts), solver, rtol, atol, jnp.asarray(jumps), max_steps, adjoint
    )
    if _concrete(x, reached):
        _check_adaptive(run, float(reached), failure, max_steps, solver, bool(np.isfinite(x).all()))
    t = jnp.asarray(ts)
    return Solution(t, x, _evaluate_all(run.drive, t), run.system, run.packed)


@eqx.filter_jit
def _solve(
    run: _Run,
    ts: Array,
    solver: solvers.Solver,
    rtol: ArrayLike,
    atol: ArrayLike,
    jumps: Array,
    max_steps: int,
    adjoint: dfx.AbstractAdjoint | None,
) -> tuple[Array, Array, Any]:
    arrays, rest = eqx.partition((run.packed, run.drive), eqx.is_array)

    def field(t: Array, x: Array, args: Any) -> Array:
        packed, drive = eqx.combine(args, rest)
        return run.system.vector_field(t, x, drives.evaluate(drive, t), packed)

    controller: dfx.AbstractStepSizeController = dfx.PIDController(rtol=rtol, atol=atol)
    if jumps.shape[0]:
        controller = dfx.ClipStepSizeController(controller, jump_ts=jumps)
    solution = dfx.diffeqsolve(
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
        adjoint=dfx.RecursiveCheckpointAdjoint() if adjoint is None else adjoint,
    )
    (_, reached), (x, _) = solution.ts, solution.ys
    return x, reached[-1], solution.result


def _check_adaptive(
    run: _Run, reached: float, result: Any, max_steps: int, solver: solvers.Solver, finite: bool
) -> None:
    if bool(result == dfx.RESULTS.successful) and finite:
        return
    where = f"The simulation with {type(solver).__name__} stopped at t = {reached:g} s, before {run.end:g} s"
    if bool(result == dfx.RESULTS.max_steps_reached):
        implicit = isinstance(solver, dfx.AbstractImplicitSolver)
        raise SimulationError(
            f"{where}, after max_steps={max_steps}. "
            + ("" if implicit else "If the model is stiff choose solver='kvaerno5'. ")
            + "Else it may run away there, or its inputs are rough: raise max_steps or loosen rtol."
        )
    raise SimulationError(
        f"{where}: its steps became too small or its values not finite. "
        "The model may run away there: look at its parameters, initial values and inputs."
    )


def _choose(run: _Run, u0: Array) -> solvers.Solver:
    """Tsit5, or Kvaerno5 for a stiff model."""
    if not _concrete(run.x0, run.packed, u0) or not 0 < len(run.x0) <= solvers.EIGENVALUES:
        return solvers.named("tsit5")
    eigenvalues = _eigenvalues(run, u0)
    return solvers.named("kvaerno5" if solvers.stiff(eigenvalues, run.end - run.start) else "tsit5")


def _fastest(run: _Run) -> float:
    """Magnitude of the fastest mode at the start in 1/s; 0 where it is not examined."""
    if not 0 < len(run.x0) <= solvers.EIGENVALUES:
        return 0.0
    return float(np.max(np.abs(_eigenvalues(run, drives.evaluate(run.drive, run.start)))))


def _eigenvalues(run: _Run, u0: Array) -> np.ndarray:
    jacobian = np.asarray(_jacobian(run.system, run.packed, run.start, run.x0, u0))
    return np.linalg.eigvals(jacobian) if np.isfinite(jacobian).all() else np.zeros(1)


@eqx.filter_jit
def _jacobian(system: System, packed: Any, t: ArrayLike, x: Array, u: Array) -> Array:
    return jax.jacfwd(partial(_field, system, packed, t, u))(x)


def _field(system: System, packed: Any, t: ArrayLike, u: Array, x: Array) -> Array:
    return system.vector_field(t, x, u, packed)


# -- both ------------------------------------------------------------------------------------------


def _span(t: tuple[float, float]) -> tuple[float, float]:
    start, end = (float(v) for v in t)
    if not (np.isfinite(start) and np.isfinite(end) and end > start):
        raise DataError(f"t=({start:g}, {end:g}) is no span of time; give (start, end) with start < end.")
    return start, end


def _save_times(run: _Run, saveat: ArrayLike) -> np.ndarray:
    ts = np.atleast_1d(np.asarray(saveat, float))
    outside = ts[(ts < run.start - 1e-12) | (ts > run.end + 1e-12) | ~np.isfinite(ts)]
    if len(outside) or ts.ndim != 1:
        what = f"{outside[0]:g} s" if len(outside) else f"shape {ts.shape}"
        raise DataError(f"saveat has {what}; give times from {run.start:g} to {run.end:g} s.")
    if np.any(np.diff(ts) <= 0):
        raise DataError("saveat does not increase.")
    return ts


@eqx.filter_jit
def _evaluate_all(drive: tuple[drives.Drive, ...], t: Array) -> Array:
    return jax.vmap(partial(drives.evaluate, drive))(t)


def _concrete(*trees: Any) -> bool:
    """Whether values can be looked at: JAX is not tracing them."""
    return not any(isinstance(leaf, jax.core.Tracer) for leaf in jax.tree.leaves(trees))
