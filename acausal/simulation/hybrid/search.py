"""The loop of steps between events: try a step, look for a change of a condition in it, end it there, let it happen."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Float, Int

from acausal._jax import cond_any, while_any, without_derivatives
from acausal.codegen import Events, due, guards
from acausal.initialization import COINCIDE
from acausal.simulation.adaptive.problem import Attempt, Counts, Problem
from acausal.simulation.adaptive.search import EXHAUSTED, LEFT, REACHED, STIFF, TOO_SHORT
from acausal.simulation.hybrid.coinciding import follow_in_turn
from acausal.simulation.hybrid.locate import POINTS, Hunt, look, no_hunt
from acausal.simulation.hybrid.row import (
    FREE,
    JUMP,
    RESTART,
    STATE,
    STOP,
    TIMED,
    Reach,
    Row,
    follow,
    reach,
    stop_at,
)
from acausal.simulation.log import Log

UNSETTLED, CROWDED = TOO_SHORT + 1, TOO_SHORT + 2
"""Further reasons to stop: an event without solution; events that follow each other without end."""

CROWD = 12
"""So many events in sequence, each within `NEAR` of the one before: the model slides, or bounces for ever."""

NEAR = 1e-10
"""Of the span of a run: what counts as no time between two events."""

DEADER = 10.0
"""So many times farther must a condition's number go after an event that changed nothing."""


class Begin(NamedTuple):
    """Where a loop begins: time, state, discrete variables, the next of the times to save, and the log so far."""

    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    d: Float[Array, " n_discrete"]
    next: Int[Array, ""]
    log: Log


class Reached(NamedTuple):
    """What a loop found.

    Attributes:
        saved, saved_d: states and discrete variables at the times to save; NaN where the loop did not come.
        t, x, d: where it stopped. next: the first of the times to save beyond.
        why: it stopped there. counts: what it cost. log: what happened.
    """

    saved: Float[Array, "n_saved n_states"]
    saved_d: Float[Array, "n_saved n_discrete"]
    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    d: Float[Array, " n_discrete"]
    next: Int[Array, ""]
    why: Int[Array, ""]
    counts: Counts
    log: Log


class Progress(NamedTuple):
    """How far a run has come.

    Attributes:
        t, x, d: where it is. next: the next of the times to save. ahead: the next stop. memory: the method's.
        why: it stopped (-1: it goes on). counts: what it has cost. log: what has happened.
        crowd: how many of the last events followed the one before at once. last: the time of the last event.
        hunt: for the instant of the next.
        dead: how far beyond zero a condition's number must be to count: more than zero where rounding and the errors of
            steps have made an event that changed nothing.
    """

    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    d: Float[Array, " n_discrete"]
    next: Int[Array, ""]
    ahead: Int[Array, ""]
    memory: Any
    why: Int[Array, ""]
    counts: Counts
    log: Log
    crowd: Int[Array, ""]
    last: Float[Array, ""]
    hunt: Hunt
    dead: Float[Array, " n_guards"]


Saved = tuple[Array, Array]


def begin(method: Any, problem: Problem, events: Events, start: Begin) -> tuple[Progress, Saved]:
    """A run before its first step, and what is saved so far."""
    memory, counts = method.begin(problem.held(start.d), start.t, start.x)
    shape, dtype = (len(problem.ts),), start.x.dtype
    saved = jnp.full((*shape, *start.x.shape), jnp.nan, dtype)
    saved_d = jnp.full((*shape, *start.d.shape), jnp.nan, dtype)
    ahead = jnp.searchsorted(problem.breaks, start.t, side="right").astype(jnp.int32)
    zero = jnp.zeros((), jnp.int32)
    why = jnp.where(start.t < problem.end, -1, REACHED).astype(jnp.int32)
    before = jnp.full_like(start.t, -jnp.inf)
    following = start.next.astype(jnp.int32)
    progress = Progress(
        start.t,
        start.x,
        start.d,
        following,
        ahead,
        memory,
        why,
        counts,
        start.log,
        zero,
        before,
        no_hunt(events, start.t),
        jnp.zeros(events.n_guards, dtype),
    )
    return progress, (saved, saved_d)


def search(
    method: Any,
    problem: Problem,
    events: Events,
    start: Begin,
    *,
    until_stiff: bool,
    forward: bool = False,
) -> Reached:
    """Go from a start to the end of a problem.

    Arguments:
        method, problem, events: what is integrated.
        start: where.
        until_stiff: whether to stop where stability limits the steps.
        forward: whether derivatives in forward mode must work.
    """
    first, saved = begin(method, problem, events, start)
    end, saved, _ = advance(
        method, problem, events, first, saved, until_stiff=until_stiff, forward=forward
    )
    return reached(problem, end, saved)


def reached(problem: Problem, end: Progress, saved: Saved) -> Reached:
    """The result of a run; what is to be saved at its end is what follows the last event."""
    left = ((jnp.arange(len(problem.ts)) >= end.next) & (end.why == REACHED))[:, None]
    xs, ds = (jnp.where(left, a, b) for a, b in zip((end.x, end.d), saved, strict=True))
    return Reached(xs, ds, end.t, end.x, end.d, end.next, end.why, end.counts, end.log)


def advance(
    method: Any,
    problem: Problem,
    events: Events,
    progress: Progress,
    saved: Saved | None,
    rows: Row | None = None,
    *,
    until_stiff: bool,
    forward: bool = False,
) -> tuple[Progress, Any, Row | None]:
    """Make steps until the end, or until there is no more room for them.

    Arguments:
        method, problem, events, until_stiff, forward: as for `search`.
        progress: so far.
        saved: what is saved so far; ``None``: save nothing.
        rows: room for the steps, with a leading axis, if they are to be made again.

    Returns:
        The progress, what is saved, and the rows filled from the first on.
    """
    before = progress.counts.steps
    kinds = jnp.append(jnp.where(problem.jumps, JUMP, STOP), STOP)
    if problem.restarts is not None:
        kinds = jnp.where(jnp.append(problem.restarts, False), RESTART, kinds)
    span = problem.end - problem.begin

    def has_room(carry: tuple[Progress, Any, Row | None]) -> Array:
        c, _, rows = carry
        running = c.why < 0
        return running if rows is None else running & (c.counts.steps - before < len(rows.t))

    def body(
        carry: tuple[Progress, Any, Row | None], runs: Array
    ) -> tuple[Progress, Any, Row | None]:
        c, saved, rows = carry
        held = problem.held(c.d)
        stop, proposed = stop_at(problem, c.ahead), lax.stop_gradient(c.memory.h)
        kind = kinds[c.ahead]
        which, band = c.ahead, -jnp.ones(events.n_guards, c.x.dtype)
        at_once = None
        if events.timed.any():
            apart = COINCIDE * jnp.maximum(jnp.abs(c.t), span)
            known = lax.stop_gradient(due(events, held.field.at(c.t).values(c.x)))
            times = jnp.where(known.t > c.t + apart, known.t, jnp.inf)
            j = jnp.argmin(times)
            sooner = times[j] <= stop + apart
            stop = jnp.where(sooner, times[j], stop)
            kind, which = jnp.where(sooner, TIMED, kind), jnp.where(sooner, j, which)
            rounding = 2 * apart * jnp.abs(known.rate)
            at_once = rounding, times, apart
            band = jnp.where(sooner & (times <= times[j] + apart), rounding, band)
        left = stop - c.t
        to_stop = proposed * LEFT >= left
        h = jnp.where(to_stop, left, proposed)
        if not events.timed.all():
            h = jnp.where(c.hunt.active, c.hunt.h, h)
            to_stop = to_stop & ~c.hunt.active
        made = method.attempt(held, c.memory, c.t, h)
        ok, hunt, grazes = made.accepted, c.hunt, jnp.array(False)
        if not events.timed.all():
            numbers = _numbers(method, held, events, made, c.t, h)
            found = look(events, hunt, numbers, c.dead, c.d, *lax.stop_gradient((c.t, h)))
            goes_on_hunting = found.hunt.active & (ok | hunt.active)
            is_event, grazes = found.is_event, found.grazes
            hunt = found.hunt._replace(active=goes_on_hunting)
            ok = (ok | is_event) & ~goes_on_hunting
            which = jnp.where(is_event, found.which, which)
            changing = found.band
            if (
                at_once is not None
            ):  # a condition whose time has come with the event would be missed after it
                rounding, times, apart = at_once
                near = jnp.abs(times - (c.t + h)) <= apart
                changing = jnp.where(near, jnp.maximum(changing, rounding), changing)
            band = jnp.where(is_event, changing, band)
            kind = jnp.where(is_event, STATE, jnp.where(to_stop, kind, FREE))
        else:
            kind = jnp.where(to_stop, kind, FREE)
        kind, which = kind.astype(jnp.int32), which.astype(jnp.int32)
        row = Row(c.t, lax.stop_gradient(h), kind, which, band, c.x, c.d, c.next)

        def happens() -> tuple[Array, Array, Array, Any, Counts, Array, Any, Array]:
            end = Reach(jnp.where(to_stop, stop, c.t + h), made.x, h, made.dense)
            if forward:
                end = reach(method, problem, events, row, c.t, c.x, c.d, is_event=True)
            in_turn = follow_in_turn if forward and events.n_guards > 1 else None
            t, after = follow(problem, events, row, end, c.d, in_turn)
            memory, cost = method.begin(problem.held(after.d), t, after.x)
            return t, after.x, after.d, memory, cost, after.settled, end.dense, end.h

        def goes_on() -> tuple[Array, Array, Array, Any, Counts, Array, Any, Array]:
            t = jnp.where(ok, jnp.where(to_stop, stop, c.t + h), c.t)
            x = jnp.where(ok, made.x, c.x)
            memory = jax.tree.map(lambda a, b: jnp.where(hunt.active, a, b), c.memory, made.memory)
            return t, x, c.d, memory, Counts.of(), jnp.array(True), made.dense, h

        happened = ok & (kind >= RESTART) & runs
        t, x, d, memory, cost, settled, dense, length = cond_any(happened, happens, goes_on)
        saved, following = _save(
            method, problem.ts, saved, c.next, dense, c.t, length, t, c.d, happened, runs
        )
        if rows is not None:
            k = jnp.where(ok & runs, c.counts.steps - before, len(rows.t))
            row = row._replace(next=following)
            rows = jax.tree.map(lambda a, v: a.at[k].set(v, mode="drop"), rows, row)
        counts = (
            c.counts.plus(made.counts)
            .plus(cost)
            .plus(Counts.of(steps=ok, rejected=~ok & ~hunt.active))
        )
        moved = jnp.any(d != c.d) | jnp.any(x != made.x) | (kind != STATE)
        dead = jnp.where(band >= 0, jnp.maximum(DEADER * c.dead, band), c.dead)
        dead = lax.stop_gradient(jnp.where(moved, 0.0, dead))
        dead = jnp.where(happened, dead, c.dead)
        happened = happened & moved
        logged = happened & (kind >= JUMP)
        fired = jnp.where(kind == JUMP, -1, which)
        log = c.log.with_event(logged, t, fired, (made.x, c.d), (x, d), grazes & (kind == STATE))
        near = happened & (t - c.last < NEAR * span)
        crowd = jnp.where(happened, jnp.where(near, c.crowd + 1, 0), c.crowd).astype(jnp.int32)
        ahead = c.ahead + (
            ok & to_stop & (t >= stop_at(problem, c.ahead)) & (c.ahead < len(problem.breaks))
        )
        why = jnp.where(counts.steps + counts.rejected >= problem.max_steps, EXHAUSTED, -1)
        why = jnp.where(~ok & ~hunt.active & (c.t + memory.h <= c.t), TOO_SHORT, why)
        why = jnp.where(crowd >= CROWD, CROWDED, why)
        why = jnp.where(settled, why, UNSETTLED)
        if until_stiff:
            why = jnp.where(made.stiff & ~happened, STIFF, why)
        why = jnp.where((t >= problem.end) & settled, REACHED, why).astype(jnp.int32)
        last = jnp.where(happened, lax.stop_gradient(t), c.last)
        following, ahead = following.astype(jnp.int32), ahead.astype(jnp.int32)
        after = Progress(
            t, x, d, following, ahead, memory, why, counts, log, crowd, last, hunt, dead
        )
        unchanged = c._replace(log=log)  # it has no more events where the run is over
        after = jax.tree.map(lambda a, b: jnp.where(runs, a, b), after, unchanged)
        return after, saved, rows

    return while_any(has_room, body, (progress, saved, rows))


def _numbers(
    method: Any, held: Problem, events: Events, made: Attempt, t: Array, h: Array
) -> Float[Array, "n_points n_guards"]:
    """The conditions' numbers at some points of a step; without derivatives."""
    dense, t, h, end = lax.stop_gradient((made.dense, t, h, made.x))
    field = without_derivatives(held).field

    def at(fraction: Array) -> Array:
        time = t + fraction * h
        x = jnp.where(fraction == 1, end, method.between(dense, t, h, time))
        return guards(events, field.at(time).values(x))

    return jax.vmap(at)(jnp.asarray(POINTS, h.dtype))


def _save(
    method: Any,
    ts: Array,
    saved: Saved | None,
    following: Array,
    dense: Any,
    t: Array,
    h: Array,
    reached: Array,
    d: Array,
    before: Array,
    runs: Array,
) -> tuple[Saved | None, Array]:
    """What is saved up to a time, or up to just before it; and the next of the times to save."""
    if saved is None:
        left, right = (jnp.searchsorted(ts, reached, side=side) for side in ("left", "right"))
        return None, jnp.maximum(jnp.where(before, left, right).astype(jnp.int32), following)
    if not len(ts):
        return saved, following

    def within(state: tuple[Saved, Array]) -> Array:
        j = state[1]
        at = ts[jnp.minimum(j, len(ts) - 1)]
        return runs & (j < len(ts)) & ((at < reached) | ((at == reached) & ~before))

    def one(state: tuple[Saved, Array], inside: Array) -> tuple[Saved, Array]:
        (xs, ds), j = state
        x = method.between(dense, t, h, ts[jnp.minimum(j, len(ts) - 1)])
        k = jnp.where(inside, j, len(ts))
        saved = xs.at[k].set(x, mode="drop"), ds.at[k].set(d, mode="drop")
        return saved, j + inside

    return while_any(within, one, (saved, following))
