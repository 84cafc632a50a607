"""Make the steps of a problem, by a given method or by one that changes on its way; with derivatives in both modes."""

from __future__ import annotations

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, PyTree

from acausal._jax import array, compiled, known, two_modes
from acausal.codegen import StateJacobian
from acausal.errors import SimulationError
from acausal.simulation.log import Log
from acausal.simulation.solvers import Solver
from acausal.simulation.steps.loop import EXHAUSTED, STIFF, LoopResult, LoopStart, search
from acausal.simulation.steps.methods import Method, explicit, method_of, stiff
from acausal.simulation.steps.one_step import OneStep
from acausal.simulation.steps.problem import Integration
from acausal.simulation.steps.replay import reverse


class Solved(NamedTuple):
    """A result, the method's name, and the time from which on the model was stiff (NaN where that was not asked)."""

    found: LoopResult
    method: str
    stiff_from: Float[Array, ""]


def solve(
    problem: Integration,
    solver: Solver | OneStep | None,
    jacobian: StateJacobian,
    *,
    d: Float[Array, " n_discrete"] | None = None,
    log: Log | None = None,
    forward: bool = False,
) -> Solved:
    """Solve a problem.

    Arguments:
        problem: what is integrated.
        solver: one with an error estimate, or a method; ``None``: Tsit5, and a stiff method from where the model is
            stiff.
        jacobian: the model's, for implicit steps.
        d: discrete variables at the start. log: the empty log of the run. Both None without events.
        forward: allow derivatives in forward mode only, of any order.

    Raises:
        SimulationError: for a solver that knows more than the state at a step's start, if there are events.
    """
    start = LoopStart(problem.begin, problem.x, array(0, int), d, log)
    if solver is None:
        return _automatic(problem, start, jacobian, forward)
    method = solver if isinstance(solver, OneStep) else method_of(solver, problem, jacobian)
    if problem.events is not None and not isinstance(method, OneStep):
        raise SimulationError(
            f"solver {method.name} goes on from steps before an event, which ends them all; choose 'auto', or "
            "'kvaerno5' for stiff models with events"
        )
    found = _run(method, problem, start, False, forward)
    return Solved(found, method.name, array(np.nan))


def _automatic(
    problem: Integration, start: LoopStart, jacobian: StateJacobian, forward: bool
) -> Solved:
    """Explicit steps, and implicit ones from where the model turns out to be stiff."""
    method, second = explicit(), stiff(problem, jacobian)
    first = _run(method, problem, start, True, forward)
    why = known(first.why)
    if why is not None and int(why) not in (STIFF, EXHAUSTED):
        return Solved(first, method.name, array(np.inf, first.t.dtype))
    goes_on = (first.why == STIFF) | (first.why == EXHAUSTED)
    begin = jnp.where(goes_on, first.t, problem.end)  # nothing is left to do where it is not stiff
    again = LoopStart(begin, first.x, first.next, first.d, first.log)
    rest = _run(second, problem, again, False, forward)
    earlier = (jnp.arange(len(problem.ts)) < first.next)[:, None]
    joined = rest._replace(
        saved=jax.tree.map(lambda a, b: jnp.where(earlier, a, b), first.saved, rest.saved),
        why=jnp.where(goes_on, rest.why, first.why),
        counts=first.counts.plus(rest.counts),
    )
    name = f"{method.name}, then {second.name}"
    return Solved(joined, name, jnp.where(goes_on, first.t, jnp.inf))


@compiled
def _run(
    method: Method | OneStep,
    problem: Integration,
    start: LoopStart,
    until_stiff: bool,
    forward: bool,
) -> LoopResult:
    arrays, rest = eqx.partition((method, problem, start), eqx.is_array)

    def forwards(arrays: PyTree) -> LoopResult:
        method, problem, start = eqx.combine(arrays, rest)
        return search(method, problem, start, until_stiff=until_stiff, forward=True)

    def backwards(arrays: PyTree) -> LoopResult:
        return reverse(*eqx.combine(arrays, rest), until_stiff=until_stiff)

    return forwards(arrays) if forward else two_modes(backwards, forwards)(arrays)
