"""Make the steps of a problem with events, by a given method or by one that changes on its way."""

from __future__ import annotations

from typing import NamedTuple

import diffrax as dfx
import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, PyTree

from acausal._jax import known, two_modes
from acausal.codegen import Events, StateJacobian
from acausal.errors import SimulationError
from acausal.simulation import solvers
from acausal.simulation.adaptive.methods import explicit, method_of
from acausal.simulation.adaptive.one_step import OneStep
from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.adaptive.search import EXHAUSTED, STIFF
from acausal.simulation.hybrid.paced import Paced
from acausal.simulation.hybrid.replay import reverse
from acausal.simulation.hybrid.search import Begin, Reached, search
from acausal.simulation.log import Log

AUTO = "Tsit5, then Kvaerno5"
"""The method that changes on its way."""


class Solved(NamedTuple):
    """A result, the method's name, and the time from which on the model was stiff (NaN where that was not asked)."""

    found: Reached
    method: str
    stiff_from: Float[Array, ""]


def solve(
    problem: Problem,
    events: Events,
    d: Float[Array, " n_discrete"],
    solver: solvers.Solver | Paced | None,
    jacobian: StateJacobian,
    *,
    forward: bool = False,
    log: Log | None = None,
) -> Solved:
    """Solve a problem with events.

    Arguments:
        problem: what is integrated. events: of the model. d: discrete variables at the start.
        solver: a one-step solver with an error estimate, or a method; ``None``: Tsit5, and Kvaerno5 from where the
            model is stiff.
        jacobian: the model's, for implicit steps.
        forward: allow derivatives in forward mode only.
        log: the empty log of the run; by default with room for one event.

    Raises:
        SimulationError: for a solver that knows more than the state at a step's start.
    """
    log = Log.empty(len(problem.x) + len(d), problem.x.dtype, events=1) if log is None else log
    start = Begin(problem.begin, problem.x, d, jnp.asarray(0), log)
    if solver is None:
        return _automatic(problem, events, start, jacobian, forward)
    method = solver if isinstance(solver, Paced) else method_of(solver, problem, jacobian)
    if not isinstance(method, OneStep | Paced):
        raise SimulationError(
            f"solver {method.name} goes on from steps before an event, which ends them all; choose 'auto', or "
            "'kvaerno5' for stiff models with events"
        )
    return Solved(
        _run(method, problem, events, start, False, forward), method.name, jnp.asarray(jnp.nan)
    )


def _automatic(
    problem: Problem, events: Events, start: Begin, jacobian: StateJacobian, forward: bool
) -> Solved:
    """Explicit steps, and implicit ones from where the model turns out to be stiff."""
    first = _run(explicit(), problem, events, start, True, forward)
    why = known(first.why)
    if why is not None and int(why) not in (STIFF, EXHAUSTED):
        return Solved(first, "Tsit5", jnp.full_like(first.t, jnp.inf))
    goes_on = (first.why == STIFF) | (first.why == EXHAUSTED)
    t = jnp.where(goes_on, first.t, problem.end)
    begin = Begin(t, first.x, first.d, first.next, first.log)
    stiff = method_of(dfx.Kvaerno5(), problem, jacobian)
    assert isinstance(stiff, OneStep)
    rest = _run(stiff, problem, events, begin, False, forward)
    earlier = (jnp.arange(len(problem.ts)) < first.next)[:, None]
    joined = Reached(
        jnp.where(earlier, first.saved, rest.saved),
        jnp.where(earlier, first.saved_d, rest.saved_d),
        rest.t,
        rest.x,
        rest.d,
        rest.next,
        jnp.where(goes_on, rest.why, first.why),
        first.counts.plus(rest.counts),
        rest.log,
    )
    return Solved(joined, AUTO, jnp.where(goes_on, first.t, jnp.inf))


@eqx.filter_jit
def _run(
    method: OneStep | Paced,
    problem: Problem,
    events: Events,
    start: Begin,
    until_stiff: bool,
    forward: bool,
) -> Reached:
    method = method.with_tangents()  # where a step ends follows from its derivative by the length
    arrays, rest = eqx.partition((method, problem, start), eqx.is_array)

    def forwards(arrays: PyTree) -> Reached:
        method, problem, start = eqx.combine(arrays, rest)
        return search(method, problem, events, start, until_stiff=until_stiff, forward=True)

    def backwards(arrays: PyTree) -> Reached:
        method, problem, start = eqx.combine(arrays, rest)
        return reverse(method, problem, events, start, until_stiff=until_stiff)

    return forwards(arrays) if forward else two_modes(backwards, forwards)(arrays)
