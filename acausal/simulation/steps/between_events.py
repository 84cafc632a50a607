"""What models with events need in the loop of steps: look for a change of a condition, end there, let it happen."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import above_rounding, cond_any, either, without_derivatives
from acausal.events import (
    POINTS,
    After,
    Bracketing,
    coincide,
    fire,
    guards,
    look,
    no_bracketing,
)
from acausal.simulation.log import Log
from acausal.simulation.steps.one_step import Memory
from acausal.simulation.steps.problem import Attempt, Counts, Integration
from acausal.simulation.steps.rows import (
    EDGE,
    JUMP,
    RESTART,
    STATE,
    TIMED,
    Reach,
    Row,
    rates_at,
    reach,
    restarted,
    values_at,
)
from acausal.simulation.steps.simultaneous_events import follow_in_turn

CHATTERING = 12
"""So many events in sequence, each within `NEAR` of the one before: the model slides, or bounces for ever."""

BY_RATES = 4
"""So many events more are tried before that counts as certain, with conditions at zero decided by their rates."""

NEAR = 1e-10
"""Of the span of a run: what counts as no time between two events."""

LESS = 0.3
"""Of a step in whose change of a condition nobody believes: the next one's length."""

GOLDEN = 0.618
"""Of the numbers of states: their parts beyond whole numbers are as if drawn by chance."""

DEADBAND_GROWTH = 10.0
"""So many times farther must a condition's number go after an event that changed nothing."""

QUIET, ROUNDINGS = 1e-9, 1e3
"""Of a condition's largest number, or in roundings of its terms: it has been no farther from zero between two of its
events, so that rounding and the errors of steps have made them."""


class EventState(NamedTuple):
    """What belongs to events, between two steps.

    Attributes:
        d: discrete variables. log: what has happened.
        chattering: how many of the last events followed the one before at once. last: the time of the last event.
        bracketing: for the instant of the next.
        deadband: how far beyond zero a condition's number must be to count: more than zero where rounding and the
            errors of steps have made an event.
        peeked: whether this step is a shorter one, up to where a condition seemed to change and to change back.
        reach: how far every condition's number has been from zero since its last event.
        largest: and ever; at least what makes the roundings of its terms count as quiet.
    """

    d: Float[Array, " n_discrete"]
    log: Log
    chattering: Int[Array, ""]
    last: Float[Array, ""]
    bracketing: Bracketing
    deadband: Float[Array, " n_guards"]
    peeked: Bool[Array, ""]
    reach: Float[Array, " n_guards"]
    largest: Float[Array, " n_guards"]


class Stop(NamedTuple):
    """Where the next step ends at the latest, or where it has ended.

    Attributes:
        t: time. kind: what it is. which: its number, or that of the condition.
        band: the conditions that change there, see `fire`; None without events.
        times: at which conditions are known to change; None where none has such a time.
        rounding: of their numbers. apart: times so near are the same instant.
    """

    t: Float[Array, ""]
    kind: Int[Array, ""]
    which: Int[Array, ""]
    band: Any = None
    times: Any = None
    rounding: Any = None
    apart: Any = None


class EventsInStep(NamedTuple):
    """What a step has shown.

    Attributes:
        ok: whether it counts. stop: where it ends.
        bracketing: how the search for an instant goes on. grazes: whether the condition hardly changes there.
        doubted: whether the step is made shorter before its change of a condition is believed.
        part: the part of its length that it is made again with, where no search for an instant has begun; 1: none.
        undefined: whether a condition's number is NaN at its end.
        sizes: of the conditions' numbers within it, at most.
    """

    ok: Bool[Array, ""]
    stop: Stop
    bracketing: Bracketing
    grazes: Bool[Array, ""]
    doubted: Bool[Array, ""]
    part: Float[Array, ""]
    undefined: Bool[Array, ""]
    sizes: Float[Array, " n_guards"]


class Landing(NamedTuple):
    """Where a step leads, behind what happens at its end.

    Attributes:
        t, x: time and state. memory: the method's. cost: of what happened.
        d: discrete variables, and converged: whether they agree; None without events.
        within: the interpolation within the step and its length, where they have derivatives of their own.
    """

    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    memory: Any
    cost: Counts
    d: Any = None
    converged: Any = None
    within: tuple[Any, Array] | None = None


def none_yet(
    held: Integration, t: Array, x: Float[Array, " n_states"], d: Array, log: Log
) -> EventState:
    """Before the first event."""
    events, zero, before = held.watched, jnp.zeros((), jnp.int32), jnp.full_like(t, -jnp.inf)
    none = jnp.zeros(events.n_guards, t.dtype)
    return EventState(
        d,
        log,
        zero,
        before,
        no_bracketing(events, t),
        none,
        jnp.array(False),
        none,
        none if events.timed.all() else _least_size(held, t, x),
    )


def _least_size(held: Integration, t: Array, x: Float[Array, " n_states"]) -> Array:
    """What conditions' numbers must be at least, by the terms that they are sums of: states with all sorts of signs."""
    field = without_derivatives(held).field
    t, x = lax.stop_gradient((t, x))
    k = np.arange(len(x))
    signs = jnp.asarray((1 - 2 * (k % 2)) * (1 + k * GOLDEN % 1), x.dtype)
    _, terms = jax.jvp(lambda x: guards(held.watched, field.at(t).values(x)), (x,), (signs * x,))
    least = ROUNDINGS * jnp.finfo(x.dtype).eps / _quiet(x.dtype)
    return least * jnp.where(jnp.isfinite(terms), jnp.abs(terms), 0.0)


def _quiet(dtype: np.dtype[Any]) -> float:
    return above_rounding(QUIET, ROUNDINGS, dtype)


def sooner(held: Integration, t: Array, x: Array, stop: Stop) -> Stop:
    """The time at which a condition is known to change, if that comes before the stop."""
    events, span = held.watched, held.end - held.begin
    band = -jnp.ones(events.n_guards, x.dtype)
    if not events.timed.any():
        return stop._replace(band=band)
    largest = jnp.maximum(jnp.abs(t), jnp.abs(t + held.field.shift(t)))
    apart = coincide(t.dtype) * jnp.maximum(largest, span)
    known = lax.stop_gradient(held.field.due(events, t, x))
    # one that is due so soon that it counts as now has happened, unless its condition is still what it was before
    d = held.field.d
    assert d is not None
    waits = (d[: events.n_guards] > 0.5) != (known.rate > 0)
    ahead = (known.t > t + apart) | (waits & (known.t > t))
    times = jnp.where(ahead, known.t, jnp.inf)
    j = jnp.argmin(times)
    first = times[j] <= stop.t + jnp.where(stop.kind == RESTART, -apart, apart)
    # at an input's jump, conditions see what is behind it, whatever rounding says
    meets = (stop.kind == JUMP) & (times[j] >= stop.t - apart)
    time = jnp.where(meets, jnp.maximum(times[j], stop.t), times[j])
    rounding = 2 * apart * jnp.abs(known.rate)
    return Stop(
        jnp.where(first, time, stop.t),
        jnp.where(first, TIMED, stop.kind).astype(jnp.int32),
        jnp.where(first, j, stop.which).astype(jnp.int32),
        jnp.where(first & (times <= times[j] + apart), rounding, band),
        times,
        rounding,
        apart,
    )


def instant(problem: Integration, state: EventState, t: Array) -> Float[Array, ""]:
    """Within what time conditions at zero are decided by their rates at an event: none, but as one of too many."""
    too_many = _near(problem, state, t) & (state.chattering + 1 >= CHATTERING)
    largest = jnp.maximum(jnp.abs(t), problem.end - problem.begin)
    return lax.stop_gradient(jnp.where(too_many, coincide(t.dtype) * largest, 0.0))


def _near(problem: Integration, state: EventState, t: Array) -> Bool[Array, ""]:
    """Whether no time has gone by since the last event."""
    return t - state.last < NEAR * (problem.end - problem.begin)


def look_within(
    method: Any,
    held: Integration,
    state: EventState,
    made: Attempt,
    t: Array,
    h: Array,
    stop: Stop,
) -> EventsInStep:
    """See whether a condition changes in a step, and whether that ends where it does."""
    events, ok, bracketing = held.watched, made.accepted, state.bracketing
    if events.timed.all():
        no, whole = jnp.array(False), jnp.ones_like(h)
        return EventsInStep(ok, stop, bracketing, no, no, whole, no, state.reach)
    numbers = _numbers(method, held, made, t, h)
    found = look(events, bracketing, numbers, state.deadband, state.d, *lax.stop_gradient((t, h)))
    # a fast mode swings where stability limits the steps, and what depends on it changes to and fro
    doubted = ok & made.limited & found.bracketing.active & ~bracketing.active
    # what changes there and back before what is seen to change
    before = ~found.bracketing.active | (found.peak * h <= found.bracketing.low)
    peeks = ok & ~(bracketing.active | state.peeked | doubted) & method.chooses & before
    part = jnp.where(doubted, LESS, jnp.where(peeks, found.peak, 1.0)).astype(h.dtype)
    searches = found.bracketing.active & (ok | bracketing.active) & (part == 1)
    is_event, changing = found.is_event, found.band
    if stop.times is not None:  # a condition whose time has come would be missed after the event
        near = jnp.abs(stop.times - (t + h)) <= stop.apart
        changing = jnp.where(near, jnp.maximum(changing, stop.rounding), changing)
    return EventsInStep(
        (ok | is_event) & ~searches & (part == 1),
        stop._replace(
            kind=jnp.where(is_event, STATE, stop.kind).astype(jnp.int32),
            which=jnp.where(is_event, found.which, stop.which).astype(jnp.int32),
            band=jnp.where(is_event, changing, stop.band),
        ),
        found.bracketing._replace(active=searches),
        found.grazes,
        doubted,
        lax.stop_gradient(part),
        jnp.any(jnp.isnan(numbers[-1]) & ~events.timed),
        jnp.max(jnp.abs(numbers), axis=0, initial=0.0, where=~jnp.isnan(numbers)),
    )


def land(
    method: Any,
    problem: Integration,
    memory: Memory,
    row: Row,
    made: Attempt,
    h: Array,
    seen: EventsInStep,
    plain: Landing,
    happens: Bool[Array, ""],
) -> Landing:
    """Where a step leads: on, or behind the event at its end.

    Arguments:
        memory: the method's before it. row: the step. h: its length, with derivatives.
        plain: where it leads if nothing happens. happens: whether something does.
    """

    def event() -> Landing:
        end = Reach(plain.t, made.x, h, made.dense)
        if problem.forward:
            end = reach(method, problem, row, row.t, row.x, row.d, is_event=True)
        t, after = _follow(problem, row, end)
        there = (end.dense, end.h) if problem.forward else None
        return plain._replace(t=t, x=after.x, d=after.d, converged=after.converged, within=there)

    def goes_on() -> Landing:
        shorter = memory._replace(
            h=jnp.where(seen.part < 1, seen.part * lax.stop_gradient(h), memory.h),
            limited=memory.limited + seen.doubted,
            free=jnp.where(seen.doubted, 0, memory.free),
        )
        stays = seen.bracketing.active | (seen.part < 1)
        kept = either(stays, shorter, made.memory)
        within = (made.dense, h) if problem.forward else None
        return plain._replace(memory=kept, d=row.d, converged=jnp.array(True), within=within)

    landing, begins = cond_any(happens, event, goes_on), happens
    if problem.field.has_edges:
        begins = begins | (seen.ok & (row.kind == EDGE))

    begun = lambda: begun_again(method, problem.held(landing.d), landing)  # noqa: E731
    kept, cost = cond_any(begins, begun, lambda: (landing.memory, landing.cost))
    return landing._replace(memory=kept, cost=cost)


def _follow(problem: Integration, row: Row, end: Reach) -> tuple[Float[Array, ""], After]:
    """Time and values behind a step that ends with an event, or where another run begins; ``end``: before the event."""

    def event() -> tuple[Array, After]:
        if problem.forward and problem.watched.n_guards > 1:
            return follow_in_turn(problem, row, end, row.d)
        at = values_at(problem, end.t, end.x, row.d)
        rates = rates_at(problem, end.t, row)
        return end.t, fire(problem.watched, at, row.band, rates, instant=row.instant)

    if problem.first is None:
        return event()

    def restart() -> tuple[Array, After]:
        x, d = restarted(problem, row.which)
        assert d is not None
        return end.t, After(x, d, jnp.array(True))

    return lax.cond(row.kind == RESTART, restart, event)


def begun_again(method: Any, problem: Integration, landing: Landing) -> tuple[Any, Counts]:
    """What a method knows where it begins again, and what that cost."""
    memory, cost = method.begin(problem.behind(landing.t), landing.t, landing.x)
    return method.resumed(memory, landing.memory), cost


def after(
    problem: Integration,
    state: EventState,
    row: Row,
    made: Attempt,
    seen: EventsInStep,
    landing: Landing,
    happened: Bool[Array, ""],
) -> EventState:
    """What belongs to events behind a step."""
    d, t = landing.d, landing.t
    moved = jnp.any(d != state.d) | jnp.any(landing.x != made.x) | (row.kind != STATE)
    near = happened & moved & _near(problem, state, t)
    reach, largest = (
        jnp.where(seen.ok, jnp.maximum(a, seen.sizes), a) for a in (state.reach, state.largest)
    )
    own = happened & (row.kind == STATE) & (jnp.arange(len(reach)) == row.which)
    grown = DEADBAND_GROWTH * state.deadband
    quiet = (reach <= _quiet(reach.dtype) * largest) & jnp.all(landing.x == made.x) & ~near
    kept = jnp.where(quiet, jnp.where(own, jnp.maximum(grown, reach), state.deadband), 0.0)
    wider = jnp.where(row.band >= 0, jnp.maximum(grown, row.band), state.deadband)
    deadband = lax.stop_gradient(jnp.where(moved, kept, wider))
    deadband = jnp.where(happened, deadband, state.deadband)
    reach, largest = lax.stop_gradient((jnp.where(own, 0.0, reach), largest))
    happened = happened & moved
    fired = jnp.where(row.kind == JUMP, -1, row.which)
    log = state.log.with_event(
        happened & (row.kind >= JUMP),
        t,
        fired,
        (made.x, state.d),
        (landing.x, d),
        seen.grazes & (row.kind == STATE),
    )
    chattering = jnp.where(happened, jnp.where(near, state.chattering + 1, 0), state.chattering)
    last = jnp.where(happened, lax.stop_gradient(t), state.last)
    peeked = (seen.part < 1) & ~seen.doubted | (state.peeked & ~seen.ok)
    chattering = chattering.astype(jnp.int32)
    return EventState(d, log, chattering, last, seen.bracketing, deadband, peeked, reach, largest)


def _numbers(
    method: Any, held: Integration, made: Attempt, t: Array, h: Array
) -> Float[Array, "n_points n_guards"]:
    """The conditions' numbers at some points of a step; without derivatives."""
    dense, t, h, end = lax.stop_gradient((made.dense, t, h, made.x))
    field = without_derivatives(held).field

    def at(fraction: Array) -> Array:
        time = t + fraction * h
        x = jnp.where(fraction == 1, end, method.between(dense, t, h, time))
        return guards(held.watched, field.at(time).values(x))

    return jax.vmap(at)(jnp.asarray(POINTS, h.dtype))
