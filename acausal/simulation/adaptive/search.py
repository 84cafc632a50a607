"""The loop of adaptive steps: try a step, keep it or take a shorter one, save what lies within it."""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import while_any
from acausal.simulation.adaptive.problem import Counts, Problem

REACHED, STIFF, EXHAUSTED, TOO_SHORT = range(4)
"""Why a loop stopped: at the end; as the model is stiff; at the limit of steps; with steps that became too short."""

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
    """Steps, to be made again.

    Attributes:
        t, h: start and length of each, shape (n,). next: the first of the times to save beyond it.
        own: what the method needs. x: the states at the ends, shape (n, n_states).
        begins: the break at which another run began with the step, or -1.
    """

    t: Float[Array, " n"]
    h: Float[Array, " n"]
    next: Int[Array, " n"]
    own: Any
    x: Float[Array, "n n_states"]
    begins: Int[Array, " n"]


class Progress(NamedTuple):
    """How far a run has come; all that it needs to go on.

    Attributes:
        t, x: time and state. next: the next of the times to save. ahead: the next time at which steps must end.
        memory: the method's. why: it stopped (-1: it goes on). counts: what it has cost.
        begins: the break at which another run has just begun, or -1.
    """

    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    next: Int[Array, ""]
    ahead: Int[Array, ""]
    memory: Any
    why: Int[Array, ""]
    counts: Counts
    begins: Int[Array, ""]


def search(method: Any, problem: Problem, start: Start, *, until_stiff: bool = False) -> Found:
    """Go from a start to the end of a problem.

    Arguments:
        method: of the steps.
        problem: what is integrated.
        start: where.
        until_stiff: whether to stop where stability limits the steps.
    """
    progress, saved = begin(method, problem, start)
    last, saved, _ = advance(method, problem, progress, saved, until_stiff=until_stiff)
    return found(last, saved)


def found(last: Progress, saved: Float[Array, "n_saved n_states"]) -> Found:
    """The result of a run."""
    return Found(saved, last.t, last.x, last.next, last.why, last.counts)


def begin(method: Any, problem: Problem, start: Start) -> tuple[Progress, Array]:
    """A run before its first step, and the states saved so far."""
    memory, counts = method.begin(problem, start.t, start.x)
    saved = jnp.full((len(problem.ts), *start.x.shape), jnp.nan, start.x.dtype)
    following = start.next
    if len(problem.ts):
        is_saved = saves_start(problem, start)
        saved = saved.at[0].set(jnp.where(is_saved, start.x, saved[0]))
        following = following + is_saved
    goes_on = jnp.where(start.t < problem.end, -1, REACHED)
    ahead = jnp.searchsorted(problem.breaks, start.t, side="right")
    following, ahead, goes_on = (n.astype(jnp.int32) for n in (following, ahead, goes_on))
    none = jnp.full((), -1, jnp.int32)
    return Progress(start.t, start.x, following, ahead, memory, goes_on, counts, none), saved


def saves_start(problem: Problem, start: Start) -> Bool[Array, ""]:
    """Whether the first state is among those saved."""
    return (start.next == 0) & (problem.ts[0] <= start.t) if len(problem.ts) else jnp.array(False)


def advance(
    method: Any,
    problem: Problem,
    progress: Progress,
    saved: Float[Array, "n_saved n_states"] | None,
    rows: Rows | None = None,
    *,
    until_stiff: bool = False,
) -> tuple[Progress, Any, Rows | None]:
    """Make steps until the end, or until there is no more room for them.

    Arguments:
        method, problem: what is done.
        progress: so far.
        saved: the states saved so far; ``None``: save none.
        rows: room for what is needed to make these steps again, if it is asked for.
        until_stiff: whether to stop where stability limits the steps.

    Returns:
        The progress, the states saved, and the rows filled from the first on.
    """
    n_breaks, before = len(problem.breaks), progress.counts.steps
    stops, jumps = jnp.append(problem.breaks, problem.end), jnp.append(problem.jumps, False)

    def goes_on(carry: tuple[Progress, Any, Rows | None]) -> Array:
        c, _, rows = carry
        running = c.why < 0
        return running if rows is None else running & (c.counts.steps - before < len(rows.t))

    def body(
        carry: tuple[Progress, Any, Rows | None], runs: Array
    ) -> tuple[Progress, Any, Rows | None]:
        c, saved, rows = carry
        stop, proposed = stops[c.ahead], lax.stop_gradient(c.memory.h)
        left = jnp.where(jumps[c.ahead], _just_before(stop), stop) - c.t
        to_stop = proposed * LEFT >= left
        h = jnp.where(to_stop, left, proposed)
        made = method.attempt(problem, c.memory, c.t, h)
        ok = made.accepted
        t = jnp.where(ok, jnp.where(to_stop, stop, c.t + h), c.t)
        x = jnp.where(ok, made.x, c.x)
        saved, following = _save(method, problem.ts, saved, c.next, made.dense, c.t, h, t, runs)
        memory, ahead, counts = made.memory, c.ahead, c.counts.plus(made.counts)
        begins = jnp.where(ok, -1, c.begins)
        if n_breaks:
            at_break = ok & to_stop & (c.ahead < n_breaks)
            ahead = c.ahead + at_break
            if problem.restarts is not None and problem.first is not None:
                at = jnp.minimum(c.ahead, n_breaks - 1)
                again = at_break & problem.restarts[at]
                x = jnp.where(again, problem.first[at], x)
                begins = jnp.where(again, at, begins).astype(jnp.int32)
            memory, cost = lax.cond(
                at_break & jumps[c.ahead],
                lambda: method.begin(problem, t, x),
                lambda: (made.memory, Counts.of()),
            )
            counts = counts.plus(cost)
        if rows is not None:
            k = jnp.where(ok & runs, c.counts.steps - before, len(rows.t))  # beyond: dropped
            row = Rows(c.t, h, following, made.row, made.x, c.begins)
            rows = jax.tree.map(lambda a, v: a.at[k].set(v, mode="drop"), rows, row)
        counts = counts.plus(Counts.of(steps=ok, rejected=~ok))
        why = jnp.where(counts.steps + counts.rejected >= problem.max_steps, EXHAUSTED, -1)
        why = jnp.where(~ok & (c.t + memory.h <= c.t), TOO_SHORT, why)
        if until_stiff:
            why = jnp.where(made.stiff, STIFF, why)
        why = jnp.where(t >= problem.end, REACHED, why).astype(jnp.int32)
        after = Progress(t, x, following, ahead, memory, why, counts, begins)
        return jax.tree.map(lambda a, b: jnp.where(runs, a, b), after, c), saved, rows

    return while_any(goes_on, body, (progress, saved, rows))


def row_like(method: Any, problem: Problem, progress: Progress) -> Rows:
    """What one row looks like: something with its shapes and types."""
    p = progress
    made = eqx.filter_eval_shape(method.attempt, problem, p.memory, p.t, p.memory.h)
    return Rows(p.t, p.t, p.next, made.row, p.x, p.begins)


def _just_before(t: Array) -> Array:
    """A time that no rounding moves up to this one."""
    low = jnp.asarray(-jnp.inf, t.dtype)
    before = lax.stop_gradient(t)
    return t + (jnp.nextafter(jnp.nextafter(before, low), low) - before)


def _save(
    method: Any,
    ts: Array,
    saved: Array | None,
    following: Array,
    dense: Any,
    t: Array,
    h: Array,
    reached: Array,
    runs: Array,
) -> tuple[Array | None, Array]:
    """The states at the times to save up to the time reached, and the next of these times."""
    if saved is None:
        return None, jnp.searchsorted(ts, reached, side="right").astype(jnp.int32)
    if not len(ts):
        return saved, following

    def within(state: tuple[Array, Array]) -> Array:
        j = state[1]
        return runs & (j < len(ts)) & (ts[jnp.minimum(j, len(ts) - 1)] <= reached)

    def one(state: tuple[Array, Array], inside: Array) -> tuple[Array, Array]:
        saved, j = state
        x = method.between(dense, t, h, ts[jnp.minimum(j, len(ts) - 1)])
        k = jnp.where(inside, j, len(ts))
        return saved.at[k].set(x, mode="drop"), j + inside

    return while_any(within, one, (saved, following))
