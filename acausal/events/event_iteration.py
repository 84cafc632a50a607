"""Event iteration: conditions, discrete variables and jumps, repeated until nothing changes any more."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jax import lax
from jax.typing import ArrayLike, DTypeLike
from jaxtyping import Array, Bool, Float

from acausal._jax import above_rounding, without_derivatives
from acausal.codegen import Values
from acausal.events.event_formulas import Events
from acausal.events.zero_crossings import guards, holds, jumped, updated

PASSES = 20
"""At an event everything is computed again at most so often: what has changed may be the cause of another event."""

ALL_AT_ONCE = 30
"""So often all conditions are changed at once that do not agree with the values; after that one by one.

Ideal diodes may circle where all are changed at once. Changing the first alone ends for every network of them whose
currents are determined (Murty's method of least index).
"""

FORCED = 500
"""So often conditions within their tolerance band have forced values; after that only their sign counts."""

ONE_BY_ONE = 1000
"""So often conditions are changed one by one until an event counts as one without a solution."""

DOUBTED = 100
"""After so many iterations a condition stays as it is where its number is zero but for rounding.

As of two ideal diodes in parallel, opposite to each other and without current. What counts as rounding grows tenfold
with as many iterations more, from 1e-12 to 1e-7.
"""

COINCIDE, ROUNDINGS = 1e-12, 8.0
"""Times that differ by less, relative to their size or in roundings, are the same instant."""


def coincide(dtype: DTypeLike) -> float:
    """How far times of size 1 may be apart to be the same instant."""
    return above_rounding(COINCIDE, ROUNDINGS, dtype)


class Pass(NamedTuple):
    """One pass of an event iteration.

    Attributes:
        x: states, shape (n_states,). d: discrete variables, before the pass.
        found: discrete variables that agree with the states, without derivatives.
    """

    x: Float[Array, " n_states"]
    d: Float[Array, " n_discrete"]
    found: Float[Array, " n_discrete"]


class After(NamedTuple):
    """What is found at an event.

    Attributes:
        x: states, shape (n_states,). d: discrete variables, shape (n_discrete,).
        converged: whether values were found that agree with each other.
        passes: all of them, with a leading axis, and n: how many there are; None where they are not kept.
    """

    x: Float[Array, " n_states"]
    d: Float[Array, " n_discrete"]
    converged: Bool[Array, ""]
    passes: Any = None
    n: Any = None


class _Going(NamedTuple):
    """How far an event has come.

    ``found`` are the discrete variables of the last pass, which ``d`` repeats with derivatives, and with other rounding
    errors. ``forced`` are the values of conditions within their ``band``; ``looked``: whether it was seen if they
    switch back.
    """

    x: Array
    d: Array
    found: Array
    band: Array
    forced: Array
    looked: Array
    done: Array
    converged: Array
    n: Array


Rates = Callable[[Array, Array], tuple[Array, Array]]
"""The numbers of `guards`, and how fast they grow, for states and discrete variables."""


def fire(
    events: Events,
    at: Values,
    band: Float[Array, " n_guards"],
    rates: Rates | None = None,
    *,
    forced: Float[Array, " n_guards"] | None = None,
    instant: ArrayLike = 0.0,
    keep: bool = False,
) -> After:
    """What becomes of states and discrete variables at an event; with derivatives in forward mode.

    Arguments:
        events: of the model. at: the values before.
        band: the tolerance band of conditions that change in any case, a number >= 0: within it of zero, they have
            forced values, whatever rounding makes of them. Others have a negative number.
        rates: how fast the conditions' numbers grow: one at zero that turns back at once, as a ball's height does, is
            then found not to have changed.
        forced: the values; None: the opposite of what conditions are.
        instant: in seconds; if it is longer than zero, all conditions whose numbers pass zero within it become what
            their rates say, in modes that agree with these rates.
        keep: whether the passes are.
    """
    assert at.d is not None
    n = events.n_guards
    if forced is None:
        forced = jnp.where(band >= 0, 1 - at.d[:n], at.d[:n])
    no, yes = jnp.array(False), jnp.array(True)
    start = _Going(at.x, at.d, at.d, band, forced, no, no, yes, jnp.asarray(0))
    like = Pass(at.x, at.d, at.d) if keep else None
    room = jax.tree.map(lambda a: jnp.zeros((PASSES, *a.shape), a.dtype), like)

    def one(state: tuple[_Going, Pass | None]) -> tuple[_Going, Pass | None]:
        going, passes = state
        after, this = _pass(events, at, rates, instant, going)
        if keep:
            passes = jax.tree.map(lambda a, v: a.at[going.n].set(v), passes, this)
        return after, passes

    def goes_on(state: tuple[_Going, Pass | None]) -> Array:
        going = state[0]
        return ~going.done & going.converged & (going.n < PASSES)

    end, passes = lax.while_loop(goes_on, one, (start, room))
    return After(end.x, end.d, end.converged & end.done, passes, end.n if keep else None)


def after_pass(events: Events, at: Values, this: Pass) -> tuple[Array, Array]:
    """States and discrete variables behind a pass at a time, inputs and parameters; with derivatives in both modes."""
    before = at._replace(x=this.x, d=this.d)
    now = before._replace(d=this.found)

    def smooth(_: ArrayLike, d: Array) -> Array:
        found = updated(events, now._replace(d=d), before, this.found[: events.n_guards])
        return jnp.where(events.exact, this.found, found)

    d = smooth(0, this.found)
    # The values are found; each evaluation more carries derivatives on by way of computed variables.
    if more := min(events.n_through, PASSES):
        d = lax.fori_loop(0, more, smooth, d)
    return jumped(events, now._replace(d=d), before), d


def _pass(
    events: Events, at: Values, rates: Rates | None, instant: ArrayLike, going: _Going
) -> tuple[_Going, Pass]:
    """One more pass.

    A condition that has come true and set what it reads is what its number says from then on.
    """
    before = at._replace(x=going.x, d=going.d)
    found, converged = iterate(events, before, going.band, going.forced)
    this = Pass(going.x, going.d, found)
    x, d = after_pass(events, at, this)
    done = jnp.all(equal(found, going.found))
    n, forced, looked, band = events.n_guards, going.forced, going.looked, going.band
    if len(events.resets):
        condition, edge = events.resets.T
        true = (found > 0.5) & (going.d < 0.5)
        band = band.at[jnp.where(true[condition] & true[edge], condition, n)].set(-1.0, mode="drop")
    if rates is not None and n:
        behind = at._replace(x=x, d=found)
        look = partial(
            _switched, events, *without_derivatives((behind, band, forced)), rates, instant
        )
        forced, band = lax.cond(done & ~looked, look, lambda: (forced, band))
        looked = looked | done
        done = done & jnp.all((forced == going.forced) & equal(band, going.band))
    return _Going(x, d, found, band, forced, looked, done, converged, going.n + 1), this


def iterate(
    events: Events,
    at: Values,
    band: Float[Array, " n_guards"],
    forced: Float[Array, " n_guards"],
    initial: ArrayLike = 0.0,
) -> tuple[Float[Array, " n_discrete"], Bool[Array, ""]]:
    """Discrete variables that agree with all values, without derivatives; and whether there are such.

    Arguments:
        events, band, forced: as for `fire`. at: the values before the event.
        initial: 1 while initial values are being found.
    """
    at, band, forced = without_derivatives((at, band, forced))
    assert at.d is not None

    def goes_on(state: tuple[Array, Array, Array]) -> Array:
        _, k, same = state
        return ~same & (k < ALL_AT_ONCE + ONE_BY_ONE)

    def body(state: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
        d, k, _ = state
        new = once_more(events, at, d, band, forced, k, initial)
        return new, k + 1, jnp.all(equal(new, d))

    d, _, same = lax.while_loop(goes_on, body, (at.d, jnp.asarray(0), jnp.array(False)))
    return lax.stop_gradient(d), same


def once_more(
    events: Events,
    before: Values,
    d: Float[Array, " n_discrete"],
    band: Float[Array, " n_guards"],
    forced: Float[Array, " n_guards"],
    k: ArrayLike = 0,
    initial: ArrayLike = 0.0,
    numbers: Float[Array, " n_guards"] | None = None,
) -> Float[Array, " n_discrete"]:
    """Discrete variables from those of the iteration before, by number ``k``; other arguments as for `iterate`.

    ``numbers`` are those of conditions, where they are known.
    """
    n, at, k = events.n_guards, before._replace(d=d), jnp.asarray(k)
    g = guards(events, at, before) if numbers is None else numbers
    if numbers is None and events.timed.any():
        # one whose time comes with the event is what it is just behind it
        t = jnp.asarray(at.t, g.dtype)
        behind = t + coincide(t.dtype) * jnp.abs(t)
        there = guards(events, at._replace(t=behind), before, timed=True)
        g = jnp.where(events.timed, there, g)
    as_forced = (jnp.abs(g) <= band) & (k < FORCED)
    rounding = jnp.where(k < DOUBTED, -1.0, 10.0 ** (jnp.minimum(k // DOUBTED, 6) - 13.0))
    doubted = ~events.timed & (jnp.abs(g) <= rounding)  # one whose time is known is beyond doubt
    r = jnp.where(doubted, d[:n], holds(events, g).astype(d.dtype))
    r = jnp.where(as_forced, forced, r)
    r = jnp.where(events.ticks & (jnp.asarray(initial) > 0), 0, r)
    differs = r != d[:n]
    first = jnp.arange(n) == jnp.argmax(differs) if n else differs
    r = jnp.where((k >= ALL_AT_ONCE) & ~first, d[:n], r)
    return updated(events, at, before, r, initial)


def _switched(
    events: Events, behind: Values, band: Array, forced: Array, rates: Rates, instant: ArrayLike
) -> tuple[Array, Array]:
    """What conditions within their band are just behind the event: what their rates say; and the band.

    With an ``instant``, modes are found that agree with the rates in these modes, as in `iterate`: they solve a linear
    complementarity problem. Conditions that read what an event resets take no part, as they would slide along zero
    unseen.
    """
    assert behind.d is not None
    n, x, by_rates = events.n_guards, behind.x, jnp.asarray(instant) > 0
    free = by_rates & ~np.isin(np.arange(n), events.resets[:, 0])

    def goes_on(state: tuple[Array, ...]) -> Array:
        _, k, same, *_ = state
        return (k == 0) | (by_rates & ~same & (k < ALL_AT_ONCE + ONE_BY_ONE))

    def body(state: tuple[Array, ...]) -> tuple[Array, ...]:
        d, k, *_ = state
        number, rate = lax.stop_gradient(rates(x, d))
        near = jnp.maximum(band, jnp.where(free, instant * jnp.abs(rate), -1.0))
        at_zero = (jnp.abs(number) <= near) & (rate != 0) & jnp.isfinite(rate) & ~events.timed
        found = jnp.where(at_zero, (rate > 0).astype(forced.dtype), forced)
        wide = jnp.where(at_zero, jnp.inf, band)
        number = jnp.where(events.timed, d[:n] - 0.5, number)  # as it is
        new = once_more(events, behind, d, wide, found, k, numbers=number)
        return new, k + 1, jnp.all(equal(new, d)), found, wide

    start = behind.d, jnp.asarray(0), jnp.array(False), forced, band
    _, _, same, found, wide = lax.while_loop(goes_on, body, start)
    solved = by_rates & same
    return jnp.where(solved | ~by_rates, found, forced), jnp.where(solved, wide, band)


def equal(a: Array, b: Array) -> Array:
    """Where values are equal, or both NaN."""
    return (a == b) | (jnp.isnan(a) & jnp.isnan(b))
