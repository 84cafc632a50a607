"""Make the steps of a problem, by a given method or by one that changes on its way; with derivatives in both modes."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, PyTree

from acausal._jax import array, compile_ahead, compiled, either, known, two_modes
from acausal.errors import DataError
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


class FirstRun(NamedTuple):
    """What is run first to solve a problem: the arguments of `_run`."""

    method: Method | OneStep
    problem: Integration
    start: LoopStart


def first_run(
    problem: Integration,
    solver: Solver | OneStep | None,
    *,
    d: Float[Array, " n_discrete"] | None = None,
    log: Log | None = None,
) -> FirstRun:
    """What is run first to solve a problem.

    Arguments:
        problem: what is integrated.
        solver: one with an error estimate, or a method; ``None``: Tsit5, and a stiff method from where the model is
            stiff.
        d: discrete variables at the start. log: the empty log of the run. Both None without events.

    Raises:
        DataError: for a solver that knows more than the state at a step's start, if there are events.
    """
    start = LoopStart(problem.begin, problem.x, array(0, int), d, log)
    if solver is None:
        return FirstRun(explicit(), replace(problem, until_stiff=True), start)
    method = solver if isinstance(solver, OneStep) else method_of(solver, problem)
    if problem.events is not None and not isinstance(method, OneStep):
        raise DataError(
            f"solver {method.name} goes on from steps before an event, which ends them all; choose 'auto', or "
            "'kvaerno5' for stiff models with events"
        )
    return FirstRun(method, problem, start)


def begin_to_compile(first: FirstRun) -> None:
    """Begin to compile a run, whatever the values of its arrays."""
    compile_ahead(_run, *first)


def solve(first: FirstRun) -> Solved:
    """Solve a problem, by the first run and by what follows from it."""
    found, name = _run(*first), first.method.name
    if not first.problem.until_stiff:
        return Solved(found, name, array(np.nan))
    why = known(found.why)
    if why is not None and int(why) not in (STIFF, EXHAUSTED):
        return Solved(found, name, array(np.inf, found.t.dtype))
    return _goes_on(first, found, stiff(first.problem))


def _goes_on(run: FirstRun, first: LoopResult, second: Method) -> Solved:
    """Implicit steps from where the model has turned out to be stiff."""
    problem = run.problem
    goes_on = (first.why == STIFF) | (first.why == EXHAUSTED)
    begin = jnp.where(goes_on, first.t, problem.end)  # nothing is left to do where it is not stiff
    again = LoopStart(begin, first.x, first.next, first.d, first.log)
    rest = _run(second, replace(problem, until_stiff=False), again)
    earlier = (jnp.arange(len(problem.ts)) < first.next)[:, None]
    joined = rest._replace(
        saved=either(earlier, first.saved, rest.saved),
        why=jnp.where(goes_on, rest.why, first.why),
        counts=first.counts.plus(rest.counts),
    )
    name = f"{run.method.name}, then {second.name}"
    return Solved(joined, name, jnp.where(goes_on, first.t, jnp.inf))


@compiled
def _run(method: Method | OneStep, problem: Integration, start: LoopStart) -> LoopResult:
    arrays, rest = eqx.partition((method, problem, start), eqx.is_array)

    def forwards(arrays: PyTree) -> LoopResult:
        method, problem, start = eqx.combine(arrays, rest)
        return search(method, replace(problem, forward=True), start)

    def backwards(arrays: PyTree) -> LoopResult:
        return reverse(*eqx.combine(arrays, rest))

    return forwards(arrays) if problem.forward else two_modes(backwards, forwards)(arrays)
