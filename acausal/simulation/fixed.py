"""Simulation in fixed steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float
from numpy.typing import NDArray

from acausal._jax import array, cast, compiled, known, numpy_or_jax, select, traced
from acausal.codegen import Packed, Values
from acausal.errors import SimulationError, warn
from acausal.simulation import solvers
from acausal.simulation.fixed_steps import SIDE, Steps, integrate
from acausal.simulation.inputs import breaks, evaluate_all
from acausal.simulation.run import Run
from acausal.simulation.sampled_inputs import over_steps
from acausal.simulation.solution import Solution
from acausal.simulation.stability import FAR, is_rough, long_steps
from acausal.simulation.step_grid import ON_GRID, rows_of
from acausal.simulation.tableau import tableau_of

if TYPE_CHECKING:
    from acausal.system import System


def simulate_fixed(
    run: Run,
    ends: Float[np.ndarray, " n_ends"],
    saved: Float[np.ndarray, " n_saved"] | None,
    solver: solvers.Solver,
    *,
    dtype: np.dtype[Any],
    direct: bool = False,
) -> Solution:
    """Simulate in equal steps.

    Arguments:
        run: what to simulate.
        ends: the steps' ends, from `step_ends`.
        saved: times to save, all among ``ends``; ``None`` saves all.
        solver: a one-step scheme.
        dtype: precision of the steps.
        direct: whether derivatives in forward mode must work, too.

    Raises:
        DataError: for a time to save that is not the end of a step.
        SimulationError: if a state is not finite, or has run away.
    """
    rows = slice(None) if saved is None else rows_of(ends, saved)
    h = (ends[-1] - ends[0]) / (len(ends) - 1)
    samples = over_steps(run.inputs, ends)
    steps = Steps(array(ends[:-1]), array(h), samples)
    start = run.start._replace(t=array(ends[0]))  # an array: other times need no compilation
    start, steps = cast((start, steps), dtype)
    scheme = solvers.for_fixed_steps(solver)
    # where values are known, `are_split` has seen no edge within a step; those at ends of steps move what is traced
    divided = direct or traced(run.start.packed)
    x = _scan_steps(run.system, start, steps, scheme, direct, divided)
    if not traced(x):
        _check(run, ends, np.asarray(x))
    t = array(ends[rows])
    if any(f is not None for f in samples.functions):
        u = evaluate_all(run.inputs, t)
    else:
        last = evaluate_all(run.inputs, array(ends[-1:]))  # an input that is held has jumped there
        u = array(numpy_or_jax(samples, last).concatenate([samples.start, last])[rows])
    is_explicit = isinstance(solver, solvers.EXPLICIT)
    rough = is_explicit and not traced(x) and is_rough(np.asarray(x))
    x = x if saved is None else select(x, rows)
    if is_explicit and (rough or traced(x)):
        limit = tableau_of(scheme).stability_limit() if rough else FAR
        values = known(start._replace(t=t, x=x, u=u))
        if values is not None and (sentence := long_steps(run.system, values, float(h), limit)):
            warn(sentence)
    t, x, u = cast((t, x, u), dtype)
    return Solution(start._replace(t=t, x=x, u=u), run.system)


def are_split(
    run: Run,
    ends: Float[np.ndarray, " n_ends"],
    adjoint: object,
    solver: solvers.Solver | None,
) -> bool:
    """Whether edges of sources, or jumps of inputs, lie within fixed steps, and divide them.

    Where JAX compiles or maps, that is not known, and `DirectAdjoint` asks for a plain scan: `integrate` divides each
    step at a few of them then.
    """
    packed = known(run.start.packed)
    if packed is None or isinstance(adjoint, dfx.DirectAdjoint):
        return False
    ts, jumps = breaks(run.inputs, run.begin, run.end)
    at = ts[jumps]
    near = ends[
        np.clip(np.searchsorted(ends, at - ON_GRID * (ends[1] - ends[0])), 0, len(ends) - 1)
    ]
    if np.any(np.abs(near - at) > ON_GRID * (ends[1] - ends[0])):
        return True
    if not run.system.edges:
        return False
    # a stage beyond its step would see what lies behind an edge at its end
    if solver is not None and max(tableau_of(solvers.for_fixed_steps(solver)).fractions) > 1:
        return True
    return bool(_off_grid(run.system, packed, jnp.asarray(ends)))


@compiled
def _off_grid(system: System, packed: Packed, ends: Float[Array, " n_ends"]) -> Bool[Array, ""]:
    """Whether an edge is not at the end of a step."""
    last = ends[-1]
    apart = SIDE * jnp.finfo(ends.dtype).eps * jnp.maximum(jnp.abs(last), last - ends[0])

    def following(t: Array) -> Array:
        ahead = system.edges.ahead(packed, t, apart)
        return jnp.minimum(ahead.jump, ahead.bend)

    def is_on(t: Array) -> Array:
        apart = SIDE * jnp.finfo(ends.dtype).eps * jnp.abs(t)  # as the stages of each step are
        i = jnp.clip(jnp.searchsorted(ends, t), 1, len(ends) - 1)
        return jnp.minimum(jnp.abs(ends[i] - t), jnp.abs(ends[i - 1] - t)) <= apart

    goes_on = lambda t: (t < last - apart) & is_on(t)  # noqa: E731
    return jax.lax.while_loop(goes_on, following, ends[0]) < last - apart


@compiled
def _scan_steps(
    system: System,
    start: Values,
    steps: Steps,
    solver: solvers.Scheme,
    direct: bool,
    divided: bool,
) -> Float[Array, "n_ends n_states"]:
    integrated = integrate(system, start, steps, solver, direct=direct, divided=divided)
    return jnp.concatenate([integrated.x, integrated.end[None]])


def _check(
    run: Run, ends: Float[np.ndarray, " n_ends"], x: Float[np.ndarray, "n_ends n_states"]
) -> None:
    broken = run.broken(x)
    if broken is None:
        return
    row, what = broken
    last, dt = max(row - 1, 0), ends[1] - ends[0]
    reason = run.explain(run.at(float(ends[last]), x[last]), dt)
    raise SimulationError(
        f"The simulation broke down after t = {ends[last]:g} s: {what}."
        + (reason or " " + _advice(run.modes(), dt))
    )


def _advice(modes: NDArray[np.complex128], dt: float) -> str:
    growth = float(np.max(modes.real, initial=0.0))
    fastest = float(np.max(np.abs(modes[modes.real <= 0]), initial=0.0))
    if fastest * dt > solvers.STABILITY_LIMIT:
        return (
            f"dt={dt:g} s is too long for the model's fastest mode, {fastest:.3g} 1/s at the start: "
            f"choose dt below {1 / fastest:.1g} s, an implicit solver, or leave dt out."
        )
    if growth > 0:
        return f"The model is unstable: a mode grows by {growth:.3g} 1/s at the start. Check its parameters."
    return (
        "The model may diverge there: check its parameters, initial values and inputs, "
        "or try a smaller dt, an implicit solver (solver='kvaerno5'), or leave dt out."
    )
