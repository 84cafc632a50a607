"""Find where in a step a condition changes first: shorter steps from the same start, until one ends there."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import either
from acausal.events.event_formulas import Events

POINTS = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Where a step is looked at: a condition may change twice within it."""

BETWEEN = np.delete(np.arange(1, 32) / 32, [7, 15, 23])
"""Where else numbers are estimated: a condition may change and change back between two of these points."""

QUARTIC = np.linalg.solve(np.vander(POINTS).T, np.vander(BETWEEN, len(POINTS)).T).T
"""Times the numbers at the `POINTS`: those of the polynomial through them, at the places `BETWEEN`."""

PEAK = 1e-5
"""Of a condition's change over the step: an estimated number beyond zero must be larger to be looked for."""

TRIES = 80
"""Steps, at most, until an instant is found."""

HALVES = 12
"""After so many steps the interval is halved each time: where the number jumps, no line through two of it helps."""

CLOSE = 1e-13
"""Of a condition's change over the step: a number so small is zero."""

RATE = (3.0, -16.0, 36.0, -48.0, 25.0)
"""Three times the rate at the last of the `POINTS`, over the step: exact for polynomials of fourth order."""

GRAZES = 5e-3
"""A condition whose number is so much slower at its instant than over the step grazes: it nearly turns back."""

BAND = 1e-9
"""The same: conditions whose numbers are so small change at the same event."""


class Bracketing(NamedTuple):
    """The search for an instant, between two steps.

    Attributes:
        active: whether there is one. h: the length of the next step.
        low, high: lengths between which the instant lies. off_low, off_high: how far conditions are from changing
            there: negative where none has changed.
        scale: how much the conditions' numbers change over the whole step. later: those that have changed in it.
        tries: how many steps have been made. above: whether the last ended behind the instant.
        away: whether a condition was away from zero before it: else a number near zero is that of the event before.
    """

    active: Bool[Array, ""]
    h: Float[Array, ""]
    low: Float[Array, ""]
    high: Float[Array, ""]
    off_low: Float[Array, ""]
    off_high: Float[Array, ""]
    scale: Float[Array, " n_guards"]
    later: Bool[Array, " n_guards"]
    tries: Int[Array, ""]
    above: Bool[Array, ""]
    away: Bool[Array, ""]


class Found(NamedTuple):
    """What a step has shown.

    Attributes:
        bracketing: how the search goes on, if it does.
        is_event: whether the step ends where a condition changes. which: the one. band: see `fire`.
        grazes: whether that one hardly changes there, so that its instant has no derivative, or a huge one.
        peak: the part of the step at whose end a condition seems to have changed, although it has not at any of the
            `POINTS`; 1 where none does.
    """

    bracketing: Bracketing
    is_event: Bool[Array, ""]
    which: Int[Array, ""]
    band: Float[Array, " n_guards"]
    grazes: Bool[Array, ""]
    peak: Float[Array, ""]


def no_bracketing(events: Events, like: Float[Array, ""]) -> Bracketing:
    """None is going on."""
    zero = jnp.zeros_like(like)
    n = events.n_guards
    no = jnp.array(False)
    scale = jnp.zeros(n, like.dtype)
    return Bracketing(
        no, zero, zero, zero, zero, zero, scale, jnp.zeros(n, bool), jnp.asarray(0), no, no
    )


def look(
    events: Events,
    bracketing: Bracketing,
    numbers: Float[Array, "n_points n_guards"],
    deadband: Float[Array, " n_guards"],
    d: Float[Array, " n_discrete"],
    t: Float[Array, ""],
    h: Float[Array, ""],
) -> Found:
    """See whether conditions, whose time is not known, change in a step.

    Arguments:
        events: of the model. bracketing: the search so far.
        numbers: those of `guards` at the `POINTS` of the step. deadband: how far beyond zero they must be to count.
        d: discrete variables. t, h: the step's start and length.
    """
    tiny = jnp.finfo(h.dtype).tiny
    holds = d[: events.n_guards] > 0.5
    # Positive where a condition is no longer what it was.
    over = jnp.where(holds, -numbers, numbers) - deadband
    touches = (over == 0) & (holds == events.strict)
    over = jnp.where(touches, tiny, over)
    whole = jnp.abs(over[0]) + jnp.abs(over[-1]) + tiny
    scale = jnp.where(bracketing.active, bracketing.scale, whole)
    is_left = (over[0] > 0) & (over[0] <= BAND * scale) & ~touches[0]
    over = over - jnp.where(is_left, over[0], 0.0)  # what rounding has left of the event before
    last = over[-1]
    later = jnp.any(over[1:] > 0, axis=0) & ~events.timed
    later = later | (bracketing.active & bracketing.later)  # some change there and back
    share = jnp.where(touches, CLOSE, over / scale)  # tiny over another number may be zero
    share = jnp.where(later, share, -jnp.inf)
    off = jnp.max(share, axis=1, initial=-jnp.inf)
    begun = _begin(bracketing, off, later, scale, h)
    gone_on = _go_on(bracketing._replace(later=later), off[-1], h)
    width = 4 * jnp.finfo(h.dtype).eps * jnp.maximum(jnp.abs(t), h)
    narrow = (gone_on.high - gone_on.low <= width) | (gone_on.tries >= TRIES)
    # A number may be zero long before it changes; and it may jump: before it does, nothing has changed.
    close = (jnp.abs(off[-1]) <= CLOSE) & (off[-1] != 0) & bracketing.away
    # A change that a longer step has shown may not be there in a shorter one.
    tried = h >= bracketing.high
    there = close | (narrow & ((off[-1] > 0) | tried)) | (gone_on.tries >= TRIES + 2)
    gone_on = gone_on._replace(h=jnp.where(narrow, gone_on.high, gone_on.h))
    is_event = bracketing.active & there
    which = jnp.argmax(share[-1])
    is_near = later & (last >= -BAND * scale)
    band = jnp.where(is_near | (jnp.arange(len(last)) == which), BAND * scale, -1.0)
    going = either(bracketing.active, gone_on, begun)
    return Found(
        going._replace(active=going.active & ~is_event),
        is_event,
        which.astype(jnp.int32),
        band,
        is_event & _grazes(numbers[:, which]),
        _peak(over / scale, ~(later | events.timed | jnp.any(touches, axis=0))),
    )


def _peak(share: Float[Array, "n_points n"], watched: Bool[Array, " n"]) -> Float[Array, ""]:
    """Where between the `POINTS` a number is first largest by the polynomial through them, and beyond zero."""
    between = jnp.asarray(QUARTIC, share.dtype) @ jnp.where(watched, share, -1.0)
    places = jnp.asarray(BETWEEN, share.dtype)[jnp.argmax(between, axis=0)]
    return jnp.min(jnp.where(jnp.max(between, axis=0) > PEAK, places, 1.0), initial=1.0)


def _grazes(number: Float[Array, " n_points"]) -> Bool[Array, ""]:
    """Whether a condition's number hardly changes at the end of a step, by its values at the `POINTS`."""
    rate = jnp.asarray(RATE, number.dtype) @ number / 3
    size = jnp.max(number) - jnp.min(number)
    return (jnp.abs(rate) <= GRAZES * size) & (size > 0)


def _begin(
    bracketing: Bracketing, off: Array, changed: Array, scale: Array, h: Array
) -> Bracketing:
    """A search, if a condition has changed somewhere in the step."""
    behind = off[1:] > 0
    i = jnp.argmax(behind)
    points = jnp.asarray(POINTS, h.dtype) * h
    low, high = points[i], points[i + 1]
    off_low, off_high = jnp.minimum(off[i], 0.0), off[i + 1]
    none = jnp.zeros_like(bracketing.tries)
    length = _next(low, high, off_low, off_high, none)
    away = off_low < -CLOSE
    return Bracketing(
        jnp.any(behind), length, low, high, off_low, off_high, scale, changed, none, none < 0, away
    )


def _go_on(bracketing: Bracketing, value: Array, h: Array) -> Bracketing:
    """The search behind one more step, by false position; an end that stays twice counts half (Illinois)."""
    above = value > 0
    stays = jnp.where((above == bracketing.above) & (bracketing.tries > 0), 0.5, 1.0)
    low, high = jnp.where(above, bracketing.low, h), jnp.where(above, h, bracketing.high)
    off_low = jnp.where(above, bracketing.off_low * stays, value)
    off_high = jnp.where(above, value, bracketing.off_high * stays)
    tries = bracketing.tries + 1
    length = _next(low, high, off_low, off_high, tries)
    return bracketing._replace(
        h=length,
        low=low,
        high=high,
        off_low=off_low,
        off_high=off_high,
        tries=tries,
        above=above,
        away=bracketing.away | (value < -CLOSE),
    )


def _next(low: Array, high: Array, off_low: Array, off_high: Array, tries: Array) -> Array:
    """Where the next step ends; sometimes in the middle, as conditions may jump."""
    share = off_low / (off_low - off_high)
    usable = jnp.isfinite(share) & (tries % jnp.where(off_low >= -CLOSE, 2, 6) != 1)
    usable = usable & (tries < HALVES)
    share = jnp.where(usable, jnp.clip(share, 1e-9, 1 - 1e-9), 0.5)
    return low + share * (high - low)
