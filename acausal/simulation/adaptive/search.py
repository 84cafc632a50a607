"""The loop of adaptive steps: try a step, keep it or take a shorter one, save what lies within it."""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal.simulation.adaptive.problem import Counts, Problem

REACHED, STIFF, EXHAUSTED, TOO_SHORT = range(4)
"""Why a loop stopped: at the end, since the model is stiff, at the limit of steps, or with steps that became too short."""

LEFT = 1.0001
"""A step that would end so near before a time at which steps must end goes up to it."""


class Start(NamedTuple):
    """Where a loop begins: time, state, and which is the next of the times to save."""

    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    next: Int[Array, ""]


class Found(NamedTuple):
    """What a loop found.

    Attributes:
        saved: states at the times to save, shape (n_saved, n_states); NaN where the loop did not come.
        t, x: time and state where it stopped. next: the first of the times to save beyond.
        why: it stopped there. counts: what it cost.
    """

    saved: Float[Array, "n_saved n_states"]
    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    next: Int[Array, ""]
    why: Int[Array, ""]
    counts: Counts


class Rows(NamedTuple):
    """The steps of a run, to be made again.

    Attributes:
        t, h: start and length of each, shape (n,). next: the first of the times to save beyond it.
        own: what the method needs. x: the states at the starts, shape (n, n_states).
    """

    t: Float[Array, " n"]
    h: Float[Array, " n"]
    next: Int[Array, " n"]
    own: Any
    x: Float[Array, "n n_states"]


class _Carry(NamedTuple):
    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    next: Int[Array, ""]
    ahead: Int[Array, ""]
    memory: Any
    saved: Float[Array, "n_saved n_states"]
    rows: Rows | None
    why: Int[Array, ""]
    counts: Counts


def search(
    method: Any, problem: Problem, start: Start, *, until_stiff: bool = False, rows: int = 0
) -> tuple[Found, Rows | None]:
    """Go from a start to the end of a problem.

    Arguments:
        method: of the steps.
        problem: what is integrated.
        start: where.
        until_stiff: whether to stop where stability limits the steps.
        rows: of how many steps to keep what is needed to make them again.
    """
    n_saved, n_breaks = len(problem.ts), len(problem.breaks)
    stops = jnp.append(problem.breaks, problem.end)
    memory, counts = method.begin(problem, start.t, start.x)
    saved = jnp.full((n_saved, *start.x.shape), jnp.nan, start.x.dtype)
    next_one = start.next
    if n_saved:
        first = (next_one == 0) & (problem.ts[0] <= start.t)
        saved = saved.at[0].set(jnp.where(first, start.x, saved[0]))
        next_one = jnp.where(first, 1, next_one)
    none = None if not rows else _empty(method, problem, start, memory, rows)
    ahead = jnp.searchsorted(problem.breaks, start.t, side="right").astype(jnp.int32)
    begun = _Carry(
        start.t,
        start.x,
        next_one.astype(jnp.int32),
        ahead,
        memory,
        saved,
        none,
        jnp.where(start.t < problem.end, -1, REACHED).astype(jnp.int32),
        counts,
    )

    def goes_on(c: _Carry) -> Array:
        return c.why < 0

    def body(c: _Carry) -> _Carry:
        proposed = lax.stop_gradient(c.memory.h)
        stop = stops[c.ahead]
        left = jnp.where(c.ahead < n_breaks, _just_before(stop), stop) - c.t
        to_stop = proposed * LEFT >= left
        h = jnp.where(to_stop, left, proposed)
        made = method.attempt(problem, c.memory, c.t, h)
        ok = made.accepted
        t = jnp.where(ok, jnp.where(to_stop, stop, c.t + h), c.t)
        x = jnp.where(ok, made.x, c.x)
        saved, next_one = _save(method, problem, c, made.dense, c.t, h, t)
        memory, own_counts = made.memory, made.counts
        ahead = c.ahead
        if n_breaks:
            at_break = ok & to_stop & (c.ahead < n_breaks)
            ahead = c.ahead + at_break
            fresh, cost = lax.cond(
                at_break,
                lambda: method.begin(problem, t, x),
                lambda: (memory, Counts.of()),
            )
            memory, own_counts = fresh, own_counts.plus(cost)
        counts = c.counts.plus(own_counts).plus(Counts.of(steps=ok, rejected=~ok))
        kept = c.rows
        if kept is not None:
            k = jnp.where(ok, c.counts.steps, rows)  # beyond the last one: dropped
            put = lambda a, v: a.at[k].set(v, mode="drop")  # noqa: E731
            kept = jax.tree.map(put, kept, Rows(c.t, h, next_one, made.row, c.x))
        exhausted = counts.steps + counts.rejected >= problem.max_steps
        if kept is not None:
            exhausted = exhausted | (counts.steps >= rows)
        why = jnp.where(exhausted, EXHAUSTED, -1)
        too_short = ~ok & (c.t + made.memory.h <= c.t)
        why = jnp.where(too_short, TOO_SHORT, why)
        if until_stiff:
            why = jnp.where(made.stiff, STIFF, why)
        why = jnp.where(t >= problem.end, REACHED, why).astype(jnp.int32)
        return _Carry(t, x, next_one, ahead, memory, saved, kept, why, counts)

    last = lax.while_loop(goes_on, body, begun)
    found = Found(last.saved, last.t, last.x, last.next, last.why, last.counts)
    return found, last.rows


def _just_before(t: Array) -> Array:
    """A time that no rounding moves up to this one."""
    low = jnp.asarray(-jnp.inf, t.dtype)
    return jnp.nextafter(jnp.nextafter(t, low), low)


def _save(
    method: Any, problem: Problem, c: _Carry, dense: Any, t: Array, h: Array, reached: Array
) -> tuple[Array, Array]:
    """The states at the times to save up to the time reached, and the next of these times."""
    ts = problem.ts
    n = len(ts)
    if not n:
        return c.saved, c.next

    def within(state: tuple[Array, Array]) -> Array:
        j = state[1]
        return (j < n) & (ts[jnp.minimum(j, n - 1)] <= reached)

    def one(state: tuple[Array, Array]) -> tuple[Array, Array]:
        saved, j = state
        return saved.at[j].set(method.between(dense, t, h, ts[j])), j + 1

    return lax.while_loop(within, one, (c.saved, c.next))


def _empty(method: Any, problem: Problem, start: Start, memory: Any, n: int) -> Rows:
    """Room for n rows."""
    made = eqx.filter_eval_shape(method.attempt, problem, memory, start.t, memory.h)
    like = Rows(start.t, start.t, start.next, made.row, start.x)
    return jax.tree.map(lambda a: jnp.zeros((n, *a.shape), a.dtype), like)
