"""The loop of steps: try one, keep it or take a shorter one, save what lies within it; then what happens at its end.

Models without events go through it, too: what belongs to events is `None` in their state then, and costs nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import cond_any, either, while_any, without_derivatives
from acausal.events import Ahead
from acausal.simulation.log import Log
from acausal.simulation.steps import between_events
from acausal.simulation.steps.between_events import EventState, Landing
from acausal.simulation.steps.problem import EDGE_STEPS, Attempt, Counts, Integration
from acausal.simulation.steps.rows import (
    BEND,
    EDGE,
    FREE,
    JUMP,
    RESTART,
    STOP,
    Row,
    restarted,
    stop_at,
)

REACHED, STIFF, EXHAUSTED, TOO_SHORT, NOT_CONVERGED, CHATTERS = range(6)
"""Why a loop stopped: at the end; as the model is stiff; at the limit of steps; with steps that became too short; at an
event without solution; as events follow each other without end."""

LEFT = 1.0001
"""A step that would end so near before a time at which steps must end goes up to it."""

Saved = tuple[Array, Any]
"""States, and discrete variables if there are events, at the times to save."""


class LoopStart(NamedTuple):
    """Where a loop begins.

    Attributes:
        t, x: time and state. next: which is the next of the times to save.
        d: discrete variables. log: the events so far. Both None without events.
    """

    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    next: Int[Array, ""]
    d: Float[Array, " n_discrete"] | None = None
    log: Log | None = None


class LoopResult(NamedTuple):
    """What a loop found.

    Attributes:
        saved: states at the times to save, shape (n_saved, n_states), and discrete variables (None without events); NaN
            where the loop did not come.
        t, x, d: where it stopped. next: the first of the times to save beyond.
        why: it stopped there. counts: what it cost. log: what happened.
    """

    saved: Saved
    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    d: Any
    next: Int[Array, ""]
    why: Int[Array, ""]
    counts: Counts
    log: Log | None


class LoopState(NamedTuple):
    """How far a run has come; all that it needs to go on.

    Attributes:
        t, x: time and state. next: the next of the times to save. ahead: the next time at which steps must end.
        memory: the method's. why: it stopped (-1: it goes on). counts: what it has cost.
        events: what belongs to events; None for a model without.
    """

    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    next: Int[Array, ""]
    ahead: Int[Array, ""]
    memory: Any
    why: Int[Array, ""]
    counts: Counts
    events: EventState | None

    @property
    def d(self) -> Float[Array, " n_discrete"] | None:
        """Discrete variables; None without events."""
        return None if self.events is None else self.events.d

    def short(self) -> LoopState:
        """The same with room for one event, for what does not read the log."""
        if self.events is None:
            return self
        return self._replace(events=self.events._replace(log=self.events.log.short()))


def search(method: Any, problem: Integration, start: LoopStart) -> LoopResult:
    """Go from a start to the end of a problem by the steps of a method."""
    progress, saved = begin(method, problem, start)
    last, saved, _ = advance(method, problem, progress, saved)
    return found(problem, last, saved)


def found(problem: Integration, last: LoopState, saved: Saved) -> LoopResult:
    """The result of a run; with events, what is to be saved at its end is what follows the last of them.

    In forward mode, ``last`` may have reached the end at a time that moves.
    """
    log, x = None, last.x
    if last.events is not None:
        reached = last.why == REACHED
        left = ((jnp.arange(len(problem.ts)) >= last.next) & reached)[:, None]
        if problem.forward:
            rest = rates_behind(problem, last.t, x, last.events.d) * (problem.end - last.t)
            x = x + jnp.where(reached, rest, 0.0)
        at_end = x, last.events.d
        saved = either(left, at_end, saved)
        log = last.events.log
    return LoopResult(saved, last.t, x, last.d, last.next, last.why, last.counts, log)


def rates_behind(problem: Integration, t: Array, x: Array, d: Array) -> Float[Array, " n_states"]:
    """The rates behind an event, without derivatives; zero where they are not finite.

    An event at the end of a run moves: up to the end itself, the state goes on with these rates.
    """
    behind = without_derivatives(problem.held(d).behind(t))
    rates = behind.field(*lax.stop_gradient((t, x)))
    return jnp.where(jnp.isfinite(rates), rates, 0.0)


def begin(method: Any, problem: Integration, start: LoopStart) -> tuple[LoopState, Saved]:
    """A run before its first step, and what is saved so far: nothing."""
    memory, counts = method.begin(problem.held(start.d), start.t, start.x)
    nothing = jax.tree.map(
        lambda a: jnp.full((len(problem.ts), *a.shape), jnp.nan, start.x.dtype), (start.x, start.d)
    )
    ahead = jnp.searchsorted(problem.breaks, start.t, side="right")
    why = jnp.where(start.t < problem.end, -1, REACHED)
    following, ahead, why = (n.astype(jnp.int32) for n in (start.next, ahead, why))
    events = None
    if start.d is not None:
        assert start.log is not None
        events = between_events.none_yet(
            problem.held(start.d), start.t, start.x, start.d, start.log
        )
    return LoopState(start.t, start.x, following, ahead, memory, why, counts, events), nothing


def advance(
    method: Any,
    problem: Integration,
    progress: LoopState,
    saved: Saved | None,
    rows: Row | None = None,
) -> tuple[LoopState, Any, Row | None]:
    """Make steps until the end, or until there is no more room for them.

    Arguments:
        method, problem: as for `search`.
        progress: so far.
        saved: what is saved so far; ``None``: save nothing.
        rows: room for what is needed to make these steps again, with a leading axis, if it is asked for.

    Returns:
        The progress, what is saved, and the rows filled from the first on.
    """
    before = progress.counts.steps
    kinds = _kinds(problem)

    def goes_on(carry: tuple[LoopState, Any, Row | None]) -> Array:
        c, _, rows = carry
        running = c.why < 0
        return running if rows is None else running & (c.counts.steps - before < len(rows.t))

    def body(
        carry: tuple[LoopState, Any, Row | None], runs: Array
    ) -> tuple[LoopState, Any, Row | None]:
        c, saved, rows = carry
        aim = _aimed(method, problem, c, kinds[c.ahead])
        made: Attempt = method.attempt(aim.held, c.memory, c.t, aim.h)
        ok, stop, seen = made.accepted, aim.stop, None
        if c.events is not None:
            seen = between_events.look_within(method, aim.held, c.events, made, c.t, aim.h, stop)
            ok, stop = seen.ok, seen.stop
        t = jnp.where(ok, jnp.where(aim.to_stop, stop.t, c.t + aim.h), c.t)
        h, end = lax.stop_gradient((aim.h, t))
        row = Row(c.t, h, end, stop.kind, stop.which, c.next, c.ahead, made.x, made.row)
        begins = RESTART if seen is not None else EDGE
        happens = ok & (stop.kind >= begins) & runs
        if c.events is not None:
            instant = between_events.instant(problem, c.events, t)
            row = row._replace(x=c.x, d=c.events.d, band=stop.band, instant=instant)
        landing = Landing(t, jnp.where(ok, made.x, c.x), made.memory, Counts.of())
        if seen is not None:
            landing = between_events.land(
                method, problem, c.memory, row, made, aim.h, seen, landing, happens
            )
        elif len(problem.breaks) or problem.field.has_edges:
            begun = partial(_begun_again, method, problem, row, landing, aim.moved)
            landing = cond_any(happens, begun, lambda: landing)
        dense, length = landing.within or (made.dense, aim.h)
        between = partial(method.between, dense, c.t, length)
        until = landing.t
        if seen is not None:  # what is saved at the time of an event, but for rounding, follows it
            near = problem.apart(until + problem.field.shift(until))
            until = jnp.where(happens & (stop.kind > JUMP), until - near, until)
        saved, following = _save(between, problem.ts, saved, c, until, happens, ok & runs)
        if rows is not None:
            k = jnp.where(ok & runs, c.counts.steps - before, len(rows.t))  # beyond: dropped
            row = row._replace(next=following)
            rows = jax.tree.map(lambda a, v: a.at[k].set(v, mode="drop"), rows, row)
        # behind an event, no step as short as rounding leads on to where nothing happens: its rates would be noise
        early = jnp.where(kinds[c.ahead] == STOP, problem.apart(landing.t), 0.0)
        at_break = ok & aim.to_stop & (landing.t >= stop_at(problem, c.ahead) - early)
        ahead = (c.ahead + (at_break & (c.ahead < len(problem.breaks)))).astype(jnp.int32)
        searching = jnp.array(False) if seen is None else seen.bracketing.active
        counts = _counted(problem, c.counts, aim, made, landing, row, ok, seen)
        why = _why(problem, c, counts, ok | searching, landing)
        reached, events = landing.t >= problem.end, None
        if c.events is not None and seen is not None:
            events = between_events.after(problem, c.events, row, made, seen, landing, happens)
            without_end = between_events.CHATTERING + between_events.BY_RATES
            why = jnp.where(events.chattering >= without_end, CHATTERS, why)
            why = jnp.where(landing.converged, why, NOT_CONVERGED)
            reached = reached & landing.converged
        if problem.until_stiff:
            is_stiff = made.stiff if seen is None else made.stiff & ~happens
            why = jnp.where(is_stiff, STIFF, why)
        why = jnp.where(reached, REACHED, why).astype(jnp.int32)
        after = LoopState(
            landing.t, landing.x, following, ahead, landing.memory, why, counts, events
        )
        unchanged = c
        if c.events is not None and events is not None:  # the log does not grow where a run is over
            unchanged = c._replace(events=c.events._replace(log=events.log))
        after = either(runs, after, unchanged)
        return after, saved, rows

    return while_any(goes_on, body, (progress, saved, rows))


class Aim(NamedTuple):
    """What the next step is to be.

    Attributes:
        held: the problem up to where the step ends. stop: where it ends, and why there.
        h: its length. to_stop: whether it goes up to a time at which steps must end.
        by_wave, by_span: whether a sine of time, or `max_step`, makes it shorter than its error would.
        moved: zero, with the derivative of an edge's time, at which the step ends; None where nobody asks for it.
    """

    held: Integration
    stop: between_events.Stop
    h: Float[Array, ""]
    to_stop: Bool[Array, ""]
    by_wave: Bool[Array, ""]
    by_span: Bool[Array, ""]
    moved: Array | None


def _aimed(method: Any, problem: Integration, c: LoopState, kind: Array) -> Aim:
    """The next step: as long as its error, edges, breaks, known events and the search for one allow."""
    stop = between_events.Stop(stop_at(problem, c.ahead), kind, c.ahead)
    held = problem.held(c.d, stop.t)
    if c.events is not None:
        stop = between_events.sooner(held, c.t, c.x, stop)
    proposed, longest, moved = lax.stop_gradient(c.memory.h), jnp.inf, None
    has_edges = problem.field.has_edges
    if has_edges:
        known = held.ahead(c.t)
        held = held.sided(c.t, jnp.minimum(known.jump, known.bend))
        stop, longest = _edge(held, known, stop), known.longest
    if has_edges and c.events is None:  # the steps stay where they are: see `_begun_again`
        at_edge = (stop.kind == BEND) | (stop.kind == EDGE)
        fixed = jnp.where(at_edge, lax.stop_gradient(stop.t), stop.t)
        moved, stop = stop.t - fixed if problem.forward else None, stop._replace(t=fixed)
    by_wave, by_span = jnp.array(False), jnp.array(False)
    has_turns = c.events is not None and method.chooses and problem.field.has_turns
    if has_turns:
        turn = lax.stop_gradient(held.field.turn(*lax.stop_gradient((c.t, c.x))))
        longest = jnp.minimum(longest, turn)
    if problem.max_step is not None:
        by_span = (problem.max_step < proposed) & (problem.max_step < longest)
        longest = jnp.minimum(longest, problem.max_step)
    if has_edges or has_turns or problem.max_step is not None:
        by_wave = (longest < proposed) & ~by_span
        shorter = jnp.minimum(proposed, longest).astype(proposed.dtype)
        proposed = lax.stop_gradient(shorter if method.chooses else proposed)
    left = stop.t - c.t
    to_stop = proposed * LEFT >= left
    if c.events is not None:  # from an end so near by rounding the instant would count as gone
        to_stop = to_stop | (left - proposed <= problem.apart(stop.t))
    h = jnp.where(to_stop, left, proposed)
    if c.events is not None and not problem.watched.timed.all():
        bracketing = c.events.bracketing
        h, to_stop = jnp.where(bracketing.active, bracketing.h, h), to_stop & ~bracketing.active
    stop = stop._replace(kind=jnp.where(to_stop, stop.kind, FREE))
    return Aim(held, stop, h, to_stop, by_wave, by_span, moved)


def _counted(
    problem: Integration,
    counts: Counts,
    aim: Aim,
    made: Attempt,
    landing: Landing,
    row: Row,
    ok: Array,
    seen: between_events.EventsInStep | None,
) -> Counts:
    """What the run has cost with this step."""
    searching = jnp.array(False) if seen is None else seen.bracketing.active
    counts = counts.plus(made.counts).plus(landing.cost)
    counts = counts.plus(Counts.of(steps=ok, rejected=~ok & ~searching, searches=~ok & searching))
    if seen is not None:
        counts = counts.plus(Counts.of(undefined=ok & seen.undefined))
    if problem.field.has_edges:
        counts = counts.plus(Counts.of(edges=ok & ((row.kind == BEND) | (row.kind == EDGE))))
    has_bound = problem.field.has_edges or problem.field.has_turns
    if has_bound or problem.max_step is not None:
        free = ok & ~aim.to_stop
        counts = counts.plus(Counts.of(by_wave=free & aim.by_wave, by_span=free & aim.by_span))
    return counts


def _why(
    problem: Integration, c: LoopState, counts: Counts, goes_on: Array, landing: Landing
) -> Int[Array, ""]:
    """Why a run would stop behind a step: it has made too many, or they are too short; -1 if it goes on."""
    made = counts.steps + counts.rejected
    if problem.field.has_edges:
        made = jnp.maximum(made - EDGE_STEPS * counts.edges, made // EDGE_STEPS)
    why = jnp.where(made >= problem.max_steps, EXHAUSTED, -1)
    if problem.max_tries is not None:
        tries = counts.steps + counts.rejected + counts.searches
        why = jnp.where(tries >= problem.max_tries, EXHAUSTED, why)
    return jnp.where(~goes_on & (c.t + landing.memory.h <= c.t), TOO_SHORT, why)


def row_like(method: Any, problem: Integration, progress: LoopState) -> Row:
    """What one row looks like: something with its shapes and types."""
    p = progress
    made = eqx.filter_eval_shape(method.attempt, problem.held(p.d), p.memory, p.t, p.memory.h)
    band = None if problem.events is None else jnp.zeros(problem.events.n_guards, p.t.dtype)
    instant = None if band is None else p.t
    return Row(p.t, p.t, p.t, p.next, p.next, p.next, p.ahead, p.x, made.row, p.d, band, instant)


def _kinds(problem: Integration) -> Int[Array, " n_breaks_1"]:
    """How steps end that end at breaks, or at the end."""
    kinds = jnp.append(jnp.where(problem.jumps, JUMP, STOP), STOP)
    if problem.restarts is not None:
        kinds = jnp.where(jnp.append(problem.restarts, False), RESTART, kinds)
    return kinds.astype(jnp.int32)


def _edge(problem: Integration, ahead: Ahead, stop: between_events.Stop) -> between_events.Stop:
    """The next edge of the right-hand side, if it comes before the stop."""
    edge, apart = jnp.minimum(ahead.jump, ahead.bend), problem.apart(stop.t)
    sooner = edge < stop.t - apart
    kind = jnp.where(ahead.jump <= ahead.bend + apart, EDGE, BEND)
    there = sooner | ((edge <= stop.t + apart) & (stop.kind == STOP))
    moved = jnp.where(there, edge, 0.0)  # one that falls on the stop moves it
    moved = moved - lax.stop_gradient(moved)  # zero, with derivatives
    stop = stop._replace(
        t=jnp.where(sooner, edge, stop.t + moved),
        kind=jnp.where(there, kind, stop.kind).astype(jnp.int32),
    )
    if stop.band is None:
        return stop
    return stop._replace(band=jnp.where(sooner, -1.0, stop.band).astype(stop.band.dtype))


def _begun_again(
    method: Any, problem: Integration, row: Row, landing: Landing, moved: Array | None
) -> Landing:
    """The method begins again behind a jump of the right-hand side, and where another run begins.

    ``moved`` is zero and has the derivative of an edge's time: the state behind it moves by the difference of both
    sides. None where derivatives in forward mode are not wanted.
    """
    x, t = landing.x, landing.t
    if moved is not None:
        sides = without_derivatives(problem).field, lax.stop_gradient(x), 2 * problem.apart(t)
        field, there, apart = sides
        change = field(t - apart, there) - field(t + apart, there)
        x = x + jnp.where(row.kind == EDGE, moved, 0.0) * lax.stop_gradient(change)
    if problem.first is not None:
        x = jnp.where(row.kind == RESTART, restarted(problem, row.which)[0], x)
    landing = landing._replace(x=x)
    memory, cost = between_events.begun_again(method, problem, landing)
    return landing._replace(memory=memory, cost=cost)


def _save(
    between: Callable[[Array], Array],
    ts: Array,
    saved: Saved | None,
    c: LoopState,
    reached: Array,
    happens: Bool[Array, ""],
    counts: Array,
) -> tuple[Saved | None, Array]:
    """What is saved up to the time reached, and the next of the times to save; nothing where the step does not count.

    At the time of an event that is what follows it.
    """
    with_events = c.events is not None
    if saved is None:
        following = jnp.searchsorted(ts, reached, side="right")
        if with_events:
            left = jnp.searchsorted(ts, reached, side="left")
            following = jnp.maximum(jnp.where(happens, left, following), c.next)
        return None, jnp.where(counts, following, c.next).astype(jnp.int32)
    if not len(ts):
        return saved, c.next

    def is_within(state: tuple[Saved, Array]) -> Array:
        j = state[1]
        at = ts[jnp.minimum(j, len(ts) - 1)]
        here = (at < reached) | ((at == reached) & ~happens) if with_events else at <= reached
        return counts & (j < len(ts)) & here

    def one(state: tuple[Saved, Array], within: Array) -> tuple[Saved, Array]:
        saved, j = state
        x = between(ts[jnp.minimum(j, len(ts) - 1)])
        k = jnp.where(within, j, len(ts))
        saved = jax.tree.map(lambda a, v: a.at[k].set(v, mode="drop"), saved, (x, c.d))
        return saved, j + within

    return while_any(is_within, one, (saved, c.next))
