"""`simulate`: integrate a model over time, by fixed steps or adaptively."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, cast
from weakref import WeakSet

import diffrax as dfx
import numpy as np
from jax.typing import DTypeLike
from jaxtyping import Float
from numpy.typing import ArrayLike

from acausal._jax import (
    array,
    differentiated,
    is_real,
    need_double_precision,
    precision,
    select,
    traced,
)
from acausal.codegen import Packed
from acausal.data import Data, Signal, check_resolution
from acausal.errors import DataError, need_compiled, need_whole, shown
from acausal.simulation import solvers
from acausal.simulation.fixed import are_split, simulate_fixed
from acausal.simulation.inputs import (
    TimeFunction,
    announce_inputs,
    evaluate_all,
    functions_of_time,
    inputs_by_name,
)
from acausal.simulation.result_checks import check_result, warn_of_few_points
from acausal.simulation.run import Run
from acausal.simulation.small_states import ATOL, sizes_at_start, with_small_states
from acausal.simulation.solution import Solution
from acausal.simulation.step_grid import step_ends
from acausal.simulation.steps import InSteps, Tolerance, check_tolerances

if TYPE_CHECKING:
    from acausal.system import System

LOGGER = logging.getLogger(__name__)

SHARE = 50
"""Adaptive steps are not longer than this part of the span."""

POINTS = 500
"""Points that an adaptive simulation saves by default."""

RTOL = {"float64": 1e-6, "float32": 1e-5}
"""The usual relative tolerance by precision."""

_SIMULATED: WeakSet[System] = WeakSet()
"""Models whose first simulation has begun: the next one finds how to start it compiled already."""


def simulate(
    system: System,
    t: float | tuple[float, float],
    *,
    dt: float | None = None,
    saveat: ArrayLike | None = None,
    inputs: Mapping[str, Any] | Data | None = None,
    params: Mapping[str, Any] | None = None,
    x0: Mapping[str, ArrayLike] | ArrayLike | Literal["steady"] | None = None,
    solver: str | solvers.Solver = "auto",
    rtol: Tolerance | None = None,
    atol: Tolerance | None = None,
    max_steps: int = 100_000,
    max_step: float | None = None,
    adjoint: dfx.AbstractAdjoint | None = None,
    dtype: DTypeLike = np.float64,
) -> Solution:
    """Simulate a model.

    With ``dt`` in fixed steps, without it adaptively. Both can be differentiated (by parameters, initial values and
    sampled inputs; in reverse mode, and adaptive steps in forward mode, too), compiled with `jax.jit` and mapped with
    `jax.vmap`.

    Arguments:
        system: a compiled model.
        t: start and end, in seconds; one number is the end of a simulation that starts at 0.
        dt: fixed step in seconds; it must divide the span. A jump or bend of a source within a step divides it, where
            its time is known and JAX does not compile or map the whole.
        saveat: times to save, in seconds. By default every step, or 500 equal points without ``dt``.
        inputs: by name, for every input of the model: a number; an array of samples at the ends of the fixed
            steps; a pair (times, samples), or a pandas Series with the times as its index, interpolated linearly; a
            `Signal`; a function of time. One that JAX can trace is fast; any other is called back from the steps, and
            differentiated by difference quotients. Or a `Data` record or pandas DataFrame that holds the inputs.
            Samples that fall on the steps' ends cost nothing. They must reach from start to end, unless a `Signal` or
            `Data` says what comes before or after them. A derivative of an input, ``der(...)``, can be left out: it is
            that of the function, or of the interpolation, which is then cubic by default.
        params: as `system.parameters` gives them, the default.
        x0: initial values by name, also of discrete variables that events remember, or the whole state; by default
            the model's start values. ``"steady"`` starts at rest, with the inputs as they are then; fixed starts stay
            as they are, and must be those of rest.
        solver: a name (`acausal.simulation.solvers.SOLVERS`) or a diffrax solver. ``"auto"`` is Tsit5; without ``dt``
            it goes on with BDF from where stability, and not accuracy, limits the steps: where the model is stiff.
            ``"stiff"`` is implicit from the start: BDF, Kvaerno5 with events, and Kvaerno3 in fixed steps.
        rtol: relative tolerance of an adaptive step, one for all or an array with one each; 0 leaves ``atol`` alone.
            By default 1e-6, and 1e-5 in single precision, where less is below rounding.
        atol: absolute tolerance of an adaptive step, in the states' units, above 0, one for all or an array; by default
            1e-8. Where all states of a unit stay below 1e-4 it is 1e-8 of the largest, and where the model or ``x0``
            says that a state begins below 1e-4, but not at zero, 1e-8 of that: then the simulation is made again. Where
            JAX traces it, as in `jax.jit` and `jax.grad`, that cannot be seen: give ``atol`` there.
        max_steps: limit of adaptive steps. Each edge of a source, and each jump or kink of an input, allows eight more.
        max_step: the longest adaptive step, in seconds; by default a fiftieth of the span, ``inf`` for none. Steps end
            where sources and tables jump or bend, take at most an eighth of the period of a sine of time, and are
            checked at two points within. What is shorter than 0.4 % of the span and known to none of these, as in a
            function of time, may still be leapt over: give a shorter ``max_step`` then. Not beside ``dt``.
        adjoint: ``diffrax.ForwardMode()`` allows derivatives in forward mode (`jax.jvp`, `jax.jacfwd`) for fixed steps,
            and second ones for adaptive steps, which have first ones in both modes without it. Others change
            nothing in adaptive steps.
        dtype: precision of time, states and parameters in the steps, float64 or float32. Single precision takes
            half the time in large batches.

    Returns:
        The trajectory, any variable of it by name.

    Raises:
        ModelError: for a model that is not compiled.
        DataError: for missing, unknown or malformed inputs and times.
        SimulationError: if the solution stops short of the end, with the time reached, or runs away; where an assertion
            of the model (`Assert`) does not hold at a point of the result.

    Warns:
        UserWarning: if fixed steps are too long for an explicit solver, and states are rough; if derivatives are taken,
            outside of `jax.jit` and `jax.vmap`, through steps that are far too long; if the points of the output hide a
            source's period; if positions that equations of several solutions give, as in a linkage, jump from one to
            another.
    """
    need_compiled(system, "simulate")
    need_double_precision()
    if not solvers.is_bdf(solver) and any(map(_has_traced, (params, x0, inputs))):
        system = system.watching()
    n_states = len(system.states)
    kind = precision(dtype)
    rtol = RTOL[kind.name] if rtol is None else rtol
    check_tolerances(rtol, ATOL if atol is None else atol, n_states)
    start, end = _span(t)
    saved = None if saveat is None else _save_times(saveat, start, end)
    max_steps = need_whole(max_steps, "max_steps", DataError, 1)
    longest = _longest(max_step, end - start)
    if dt is not None and max_step is not None:
        raise DataError(
            f"max_step={shown(max_step)} bounds adaptive steps, but dt={shown(dt)} makes fixed ones: give one of them."
        )
    _check_adjoint(adjoint)
    width = 2 + n_states + 3 * len(system.inputs)
    ends = None if dt is None else step_ends(start, end, dt, width)
    given = inputs_by_name(system, inputs)
    functions = functions_of_time(system, given, (start, end), ends)
    _check_times(kind, ends, saved, functions)
    announce_inputs(system, given)
    packed = system.pack(params)
    system.check(packed)
    u_start = select(evaluate_all(functions, array([start])), 0)
    steady = isinstance(x0, str) and x0 == "steady"
    steps = "adaptive steps" if ends is None else f"{len(ends) - 1} steps"
    LOGGER.info("simulating %s from %g to %g s in %s", system.flat.name, start, end, steps)
    forward = isinstance(adjoint, dfx.ForwardMode)
    chosen = None
    if not isinstance(solver, str) or solver != "auto":
        with_events = system.events is not None
        chosen = solvers.solver_named(solver, fixed=ends is not None, events=with_events)
    times = saved
    if times is None:
        times = np.linspace(start, end, POINTS) if ends is None else ends
    first: Any = np.full(n_states, ATOL) if atol is None else atol
    in_steps = InSteps(times, chosen, rtol, first, max_steps, kind, ends, forward, longest)
    # with events, what finds the start takes as long to compile as a third of the steps: both at the same time
    if system.events is not None and not traced(packed, x0, u_start) and system not in _SIMULATED:
        _SIMULATED.add(system)
        at = system.blank(packed, start, u_start)._replace(t=start)
        in_steps.begin_to_compile(Run(system, at, functions, end))
    if steady:
        system.warn_of_sampled("x0='steady'")
    values = system.start_values(packed, None if steady else x0, u_start, start, steady=steady)
    run = Run(system, values, functions, end)
    run.check_start()
    if ends is not None and system.events is None and not are_split(run, ends, adjoint, chosen):
        scheme = solvers.solver_named("tsit5", fixed=True) if chosen is None else chosen
        direct = forward or isinstance(adjoint, dfx.DirectAdjoint)
        solution = simulate_fixed(run, ends, saved, scheme, dtype=kind, direct=direct)
    elif atol is None and ends is None:
        solution = with_small_states(
            lambda a: replace(in_steps, atol=a).simulate(run),
            n_states,
            lambda _: _sizes_at_start(run, x0),
        )
    else:
        solution = in_steps.simulate(run)
    if saveat is None and ends is None:
        warn_of_few_points(solution, end - start)
    check_result(solution)
    return solution


def _has_traced(given: object) -> bool:
    """Whether derivatives by some of what is given by name, or in a row, may be wanted."""
    values = given.values() if isinstance(given, Mapping) else (given,)
    return not isinstance(given, Packed) and any(map(differentiated, values))


def _need_known_times(what: str, given: object) -> None:
    if traced(given):
        raise DataError(
            f"The times of a simulation must be known numbers, but JAX traces {what}. The derivative of x with respect "
            "to the end time is der(x) there: let the model have a variable that is der(x), and read it at the end."
        )


def _sizes_at_start(run: Run, x0: Any) -> Float[np.ndarray, " n_states"]:
    """The sizes of states that are said to begin small; of a whole state, as at the end of another run, nothing is."""
    named = {} if x0 is None or isinstance(x0, str) else x0
    if not isinstance(named, Mapping) or len(named) >= len(run.system.states) > 1:
        return np.ones(len(run.system.states))
    return sizes_at_start(run.system, run.start.packed, named, run.start.x)


def _span(t: float | tuple[float, float]) -> tuple[float, float]:
    _need_known_times("t", t)
    try:
        if not is_real(t):
            raise TypeError
        both = (0.0, t) if np.ndim(t) == 0 else t
        start, end = (float(v) for v in cast(tuple[float, float], both))
    except (TypeError, ValueError):
        raise DataError(
            f"t={shown(t)} is not a span of time; give (start, end) in seconds, or the end, "
            "and times to save as saveat=..."
        ) from None
    if not (np.isfinite(start) and np.isfinite(end) and end > start):
        raise DataError(
            f"t=({start:g}, {end:g}) is not a span of time; give (start, end), start < end."
        )
    return start, end


def _longest(max_step: object, span: float) -> float | None:
    """The longest step; None: no limit."""
    if max_step is None:
        return span / SHARE
    if not is_real(max_step) or np.ndim(max_step) or traced(max_step) or not float(max_step) > 0:  # pyright: ignore[reportArgumentType]
        raise DataError(
            f"max_step={shown(max_step)} is not a length of steps; give seconds, or inf for no limit."
        )
    return None if np.isinf(float(max_step)) else float(max_step)  # pyright: ignore[reportArgumentType]


def _check_adjoint(adjoint: object) -> None:
    if not (adjoint is None or isinstance(adjoint, dfx.AbstractAdjoint)):
        raise DataError(
            f"adjoint={shown(adjoint)} is not a way to differentiate; leave it out, or give one of diffrax's, such as "
            "diffrax.DirectAdjoint()."
        )


def _save_times(saveat: ArrayLike, start: float, end: float) -> Float[np.ndarray, " n_saved"]:
    _need_known_times("saveat", saveat)
    if not is_real(saveat):
        raise DataError(f"saveat={shown(saveat)} are not times; give seconds.")
    ts = np.atleast_1d(np.asarray(saveat, float))
    if not ts.size:
        raise DataError("saveat is empty; give the times to save, or leave it out.")
    if ts.ndim != 1 or np.any(~(np.diff(ts) > 0)):
        raise DataError("saveat does not increase; give times in seconds, one after the other.")
    own = np.asarray(saveat).dtype
    near = 4 * float(np.finfo(own if own.kind == "f" else float).eps) * max(abs(start), abs(end))
    inside = np.clip(ts, start, end)  # as sums of steps may be beyond by rounding
    outside = ts[~(np.abs(ts - inside) <= near)]
    if len(outside):
        raise DataError(f"saveat has {outside[0]:g} s; give times from {start:g} to {end:g} s.")
    return inside


def _check_times(
    dtype: np.dtype[Any],
    ends: Float[np.ndarray, " n_ends"] | None,
    saved: Float[np.ndarray, " n_saved"] | None,
    functions: tuple[TimeFunction, ...],
) -> None:
    """Refuse times that the precision of the steps cannot tell apart."""
    if ends is not None:
        for outermost in (ends[:2], ends[-2:]):  # the closest, relative to their size
            check_resolution(outermost, dtype, "The steps")
    if dtype == np.float64:
        return
    if saved is not None:
        check_resolution(saved, dtype, "saveat")
    for function in functions:
        if isinstance(function, Signal) and not traced(function.ts):
            check_resolution(np.asarray(function.ts), dtype, "An input")
