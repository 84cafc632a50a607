"""Simulation in adaptive steps."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, PyTree

from acausal._jax import cast, known, traced, two_modes
from acausal.errors import SimulationError, StepLimitError
from acausal.simulation import solvers
from acausal.simulation.adaptive.methods import Method, explicit, method_of, stiff
from acausal.simulation.adaptive.problem import Field, Problem
from acausal.simulation.adaptive.replay import reverse
from acausal.simulation.adaptive.search import (
    EXHAUSTED,
    REACHED,
    STIFF,
    Found,
    Start,
    search,
)
from acausal.simulation.adaptive.tolerances import Tolerance
from acausal.simulation.inputs import breaks, evaluate_all
from acausal.simulation.run import Run
from acausal.simulation.solution import Solution
from acausal.simulation.statistics import Statistics

AUTO = "Tsit5, then BDF"
"""The method that changes on its way."""


def simulate_adaptive(
    run: Run,
    saved: Float[np.ndarray, " n"],
    solver: solvers.Solver | None,
    rtol: Tolerance,
    atol: Tolerance,
    max_steps: int,
    dtype: np.dtype[Any],
    *,
    forward: bool = False,
) -> Solution:
    """Simulate in steps whose lengths follow their errors, and that end where an input is known to jump.

    Arguments:
        run: what to simulate.
        saved: times to save.
        solver: a solver with an error estimate; ``None``: Tsit5, and BDF from where the model is stiff.
        rtol: relative tolerance of a step.
        atol: absolute tolerance, in the states' units.
        max_steps: limit of steps.
        dtype: precision of time and states.
        forward: allow derivatives in forward mode only, of any order.

    Raises:
        SimulationError: if the end is not reached.
    """
    ends = breaks(run.inputs, run.begin, run.end)
    constant = run.start._replace(t=None, x=None, u=None)
    problem = Problem(
        Field(constant, run.inputs, run.system),
        run.start.x,
        *map(jnp.asarray, (run.begin, run.end)),
        jnp.asarray(saved),
        *map(jnp.asarray, ends),
        jnp.asarray(rtol, float),
        jnp.asarray(atol, float),
        max_steps,
    )
    problem = cast(problem, dtype)
    start = Start(problem.begin, problem.x, jnp.asarray(0))
    if solver is None:
        found, stiff_from = _automatic(problem, start, forward)
        name = AUTO
    else:
        method = method_of(solver, problem)
        found = _solve(method, problem, start, False, forward)
        name, stiff_from = method.name, jnp.asarray(jnp.nan)
    if (why := known(found.why)) is not None and not traced(found.saved):
        name = _name(name, stiff_from)
        _check(run, saved, found, int(why), max_steps, name, solver is None)
    c = found.counts
    statistics = Statistics(
        name, c.steps, c.rejected, c.rates, c.jacobians, c.corrections, stiff_from
    )
    u = evaluate_all(run.inputs, problem.ts)
    values = cast(run.start, dtype)._replace(t=problem.ts, x=found.saved, u=u)
    return Solution(values, run.system, statistics)


def _automatic(problem: Problem, start: Start, forward: bool) -> tuple[Found, Float[Array, ""]]:
    """Explicit steps, and implicit ones from where the model turns out to be stiff; and the time there."""
    first = _solve(explicit(), problem, start, True, forward)
    why = known(first.why)
    if why is not None and int(why) not in (STIFF, EXHAUSTED):
        return first, jnp.full_like(first.t, jnp.inf)
    goes_on = (first.why == STIFF) | (first.why == EXHAUSTED)
    begin = jnp.where(goes_on, first.t, problem.end)  # nothing is left to do where it is not stiff
    rest = _solve(stiff(problem), problem, Start(begin, first.x, first.next), False, forward)
    earlier = jnp.arange(len(problem.ts)) < first.next
    joined = Found(
        jnp.where(earlier[:, None], first.saved, rest.saved),
        rest.t,
        rest.x,
        rest.next,
        jnp.where(goes_on, rest.why, first.why),
        first.counts.plus(rest.counts),
    )
    return joined, jnp.where(goes_on, first.t, jnp.inf)


@eqx.filter_jit
def _solve(
    method: Method, problem: Problem, start: Start, until_stiff: bool, forward: bool
) -> Found:
    arrays, rest = eqx.partition((method, problem, start), eqx.is_array)

    def forwards(arrays: PyTree) -> Found:
        method, problem, start = eqx.combine(arrays, rest)
        return search(method.with_tangents(), problem, start, until_stiff=until_stiff)

    def backwards(arrays: PyTree) -> Found:
        return reverse(*eqx.combine(arrays, rest), until_stiff=until_stiff)

    return forwards(arrays) if forward else two_modes(backwards, forwards)(arrays)


def _name(name: str, stiff_from: Float[Array, ""]) -> str:
    """The methods that made steps."""
    at = known(stiff_from)
    return "Tsit5" if name == AUTO and at is not None and np.isinf(at) else name


def _check(
    run: Run,
    ts: Float[np.ndarray, " n"],
    found: Found,
    why: int,
    max_steps: int,
    name: str,
    automatic: bool,
) -> None:
    if why == REACHED:
        if (broken := run.broken(found.saved)) is None:
            return
        row, what = broken
        raise SimulationError(
            f"The simulation with {name} broke down before t = {ts[row]:g} s: {what}. "
            "The model may diverge there: check its parameters, initial values and inputs."
        )
    reached = float(found.t)
    where = f"The simulation with {name} stopped at t = {reached:g} s, before {run.end:g} s"
    exhausted = why == EXHAUSTED
    ahead = (run.end - run.begin) / max_steps if exhausted else run.end - reached
    if reason := run.explain(run.at(reached, found.x), ahead):
        raise SimulationError(f"{where}.{reason}")
    if not exhausted:
        raise SimulationError(
            f"{where}: its steps became too small, or its values not finite. "
            "The model may diverge there: check its parameters, initial values and inputs."
        )
    hint = "" if automatic else "it is stiff (choose solver='auto' or 'bdf'), "
    raise StepLimitError(
        f"{where}, after max_steps={max_steps}. Perhaps {hint}it diverges there, "
        "or its inputs are rough (raise max_steps, loosen rtol, or give dt for fixed steps)."
    )
