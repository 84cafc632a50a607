"""Make the steps of a problem, by a given method or by one that changes on its way; with derivatives in both modes."""

from __future__ import annotations

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, PyTree

from acausal._jax import known, two_modes
from acausal.codegen import StateJacobian
from acausal.simulation.adaptive.methods import Method, explicit, method_of, stiff
from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.adaptive.replay import reverse
from acausal.simulation.adaptive.search import EXHAUSTED, STIFF, Found, Start, search
from acausal.simulation.solvers import Solver

AUTO = "Tsit5, then BDF"
"""The method that changes on its way."""


class Solved(NamedTuple):
    """A result, the method's name, and the time from which on the model was stiff (NaN where that was not asked)."""

    found: Found
    method: str
    stiff_from: Float[Array, ""]


def solve(
    problem: Problem, solver: Solver | None, jacobian: StateJacobian, *, forward: bool = False
) -> Solved:
    """Solve a problem.

    Arguments:
        problem: what is integrated.
        solver: one with an error estimate; ``None``: Tsit5, and BDF from where the model is stiff.
        jacobian: the model's, for implicit steps.
        forward: allow derivatives in forward mode only, of any order.
    """
    start = Start(problem.begin, problem.x, jnp.asarray(0))
    if solver is None:
        return _automatic(problem, start, jacobian, forward)
    method = method_of(solver, problem, jacobian)
    found = _run(method, problem, start, False, forward)
    return Solved(found, method.name, jnp.asarray(jnp.nan))


def _automatic(problem: Problem, start: Start, jacobian: StateJacobian, forward: bool) -> Solved:
    """Explicit steps, and implicit ones from where the model turns out to be stiff."""
    first = _run(explicit(), problem, start, True, forward)
    why = known(first.why)
    if why is not None and int(why) not in (STIFF, EXHAUSTED):
        return Solved(first, "Tsit5", jnp.full_like(first.t, jnp.inf))
    goes_on = (first.why == STIFF) | (first.why == EXHAUSTED)
    begin = jnp.where(goes_on, first.t, problem.end)  # nothing is left to do where it is not stiff
    rest = _run(stiff(jacobian), problem, Start(begin, first.x, first.next), False, forward)
    earlier = jnp.arange(len(problem.ts)) < first.next
    joined = Found(
        jnp.where(earlier[:, None], first.saved, rest.saved),
        rest.t,
        rest.x,
        rest.next,
        jnp.where(goes_on, rest.why, first.why),
        first.counts.plus(rest.counts),
    )
    return Solved(joined, AUTO, jnp.where(goes_on, first.t, jnp.inf))


@eqx.filter_jit
def _run(method: Method, problem: Problem, start: Start, until_stiff: bool, forward: bool) -> Found:
    arrays, rest = eqx.partition((method, problem, start), eqx.is_array)

    def forwards(arrays: PyTree) -> Found:
        method, problem, start = eqx.combine(arrays, rest)
        return search(method.with_tangents(), problem, start, until_stiff=until_stiff)

    def backwards(arrays: PyTree) -> Found:
        return reverse(*eqx.combine(arrays, rest), until_stiff=until_stiff)

    return forwards(arrays) if forward else two_modes(backwards, forwards)(arrays)
