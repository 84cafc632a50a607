"""One event: conditions, discrete variables and jumps, repeated until nothing changes any more."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax
from jax.typing import ArrayLike
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import known, without_derivatives
from acausal.codegen import Events, Values, due, guards, holds, jumped, updated
from acausal.errors import InitializationError, listing

STARTS = 10
"""So often initial values and discrete variables are found in turn, if they depend on each other."""

ROUNDS = 20
"""At an event everything is found anew at most so often: what has changed may be the cause of another event."""

PASSES = 30
"""So often all conditions are changed at once that do not agree with the values; after that one by one.

Ideal diodes may circle where all are changed at once. Changing the first alone ends for every network of them whose
currents are determined (Murty's method of least index).
"""

DECREED = 500
"""So often conditions near zero count as changed; after that only their sign does."""

ONE_BY_ONE = 1000
"""So often conditions are changed one by one until an event counts as one without a solution."""


CIRCLE = 10
"""After so many passes what changes is taken to be part of a circle."""

COINCIDE = 1e-12
"""Times that differ by less, relative to their size, are the same instant."""


class After(NamedTuple):
    """What is found at an event.

    Attributes:
        x: states, shape (n_states,). d: discrete variables, shape (n_discrete,).
        settled: whether values were found that agree with each other.
    """

    x: Float[Array, " n_states"]
    d: Float[Array, " n_discrete"]
    settled: Bool[Array, ""]


class Round(NamedTuple):
    """What an event goes through until nothing changes: one round.

    Attributes:
        x: states, shape (n_states,).
        x_before, d_before: states and discrete variables before the round.
        found: discrete variables that agree with them, without derivatives.
    """

    x: Float[Array, " n_states"]
    x_before: Float[Array, " n_states"]
    d_before: Float[Array, " n_discrete"]
    found: Float[Array, " n_discrete"]


class _Going(NamedTuple):
    """How far an event has come.

    ``decreed`` is what conditions are within their ``band``; ``turned``: whether that was looked at again.
    """

    x: Array
    d: Array
    x_before: Array
    d_before: Array
    band: Array
    decreed: Array
    turned: Array
    done: Array
    settled: Array
    rounds: Array


Rates = Callable[[Array, Array], tuple[Array, Array]]
"""The numbers of `guards`, and how fast they grow, for states and discrete variables."""


def happen(
    events: Events,
    at: Values,
    band: Float[Array, " n_guards"],
    rates: Rates | None = None,
    *,
    decreed: Float[Array, " n_guards"] | None = None,
) -> After:
    """What becomes of states and discrete variables at an event; with derivatives in forward mode.

    Arguments:
        events: of the model. at: the values before.
        band: conditions that change in any case have a number >= 0 here: within it of zero, they count as changed,
            whatever rounding makes of them. Others have a negative number.
        rates: how fast the conditions' numbers grow: one at zero that turns back at once, as a ball's height does, is
            then found not to have changed.
        decreed: what they change to, if that is not the opposite of what they are.
    """
    start = _start(events, at, band, decreed)
    one = partial(_round, events, at, rates)
    end = lax.while_loop(_goes_on, lambda g: one(g)[0], start)
    return After(end.x, end.d, end.settled & end.done)


def rounds_of(
    events: Events,
    at: Values,
    band: Float[Array, " n_guards"],
    rates: Rates | None = None,
    *,
    decreed: Float[Array, " n_guards"] | None = None,
) -> tuple[Round, Int[Array, ""], Bool[Array, ""]]:
    """The rounds of an event, with a leading axis, how many there are, and whether nothing changes after them.

    Arguments as for `happen`.
    """
    start = _start(events, at, band, decreed)
    like = Round(start.x, start.x, start.d, start.d)
    room = jax.tree.map(lambda a: jnp.zeros((ROUNDS, *a.shape), a.dtype), like)

    def one(state: tuple[_Going, Round]) -> tuple[_Going, Round]:
        going, rounds = state
        after, this = _round(events, at, rates, going)
        return after, jax.tree.map(lambda a, v: a.at[going.rounds].set(v), rounds, this)

    end, rounds = lax.while_loop(lambda s: _goes_on(s[0]), one, (start, room))
    return rounds, end.rounds, end.settled & end.done


def after_round(events: Events, at: Values, this: Round) -> tuple[Array, Array]:
    """States and discrete variables behind a round; with derivatives in both modes.

    Arguments:
        events: of the model. at: time, inputs and parameters.
        this: the round.
    """
    now = at._replace(x=this.x, d=this.found)
    before = at._replace(x=this.x_before, d=this.d_before)
    smooth = updated(events, now, before, this.found[: events.n_guards])
    d = jnp.where(events.exact, this.found, smooth)
    return jumped(events, now._replace(d=d), before), d


def _start(events: Events, at: Values, band: Array, decreed: Array | None) -> _Going:
    assert at.d is not None
    d, n = at.d, events.n_guards
    if decreed is None:
        decreed = jnp.where(band >= 0, 1 - d[:n], d[:n])
    no, yes = jnp.array(False), jnp.array(True)
    return _Going(at.x, d, at.x, d, band, decreed, no, no, yes, jnp.asarray(0))


def _goes_on(going: _Going) -> Array:
    return ~going.done & going.settled & (going.rounds < ROUNDS)


def _round(events: Events, at: Values, rates: Rates | None, going: _Going) -> tuple[_Going, Round]:
    """One more round.

    A condition that has come true and set what it reads is what its number says from then on.
    """
    now = at._replace(x=going.x, d=going.d)
    before = at._replace(x=going.x_before, d=going.d_before)
    found, settled = settle(events, now, before, going.band, going.decreed)
    this = Round(going.x, going.x_before, going.d_before, found)
    x, d = after_round(events, at, this)
    done = jnp.all(_same(found, going.d_before))
    n, decreed, turned = events.n_guards, going.decreed, going.turned
    has_set = events.resets & (found[:n] > 0.5) & (going.d_before[:n] < 0.5)
    band = jnp.where(has_set, -1.0, going.band)
    if rates is not None and n:
        look = partial(_turned, events, band, decreed, rates, *without_derivatives((x, found)))
        decreed = lax.cond(done & ~turned, look, lambda: decreed)
        turned = turned | done
        done = done & jnp.all(decreed == going.decreed)
    return _Going(x, d, x, d, band, decreed, turned, done, settled, going.rounds + 1), this


def settle(
    events: Events,
    now: Values,
    before: Values,
    band: Float[Array, " n_guards"],
    decreed: Float[Array, " n_guards"],
    initial: ArrayLike = 0.0,
) -> tuple[Float[Array, " n_discrete"], Bool[Array, ""]]:
    """Discrete variables that agree with all values, without derivatives; and whether there are such.

    Arguments:
        events, band: as for `happen`. now: the values, with a first guess of the discrete variables.
        before: the values before the event.
        decreed: what conditions are within their band.
        initial: 1 while initial values are being found.
    """
    now, before, band, decreed = without_derivatives((now, before, band, decreed))
    n = events.n_guards
    assert now.d is not None

    def again(d: Array, k: Array) -> Array:
        at = now._replace(d=d)
        g = guards(events, at, before)
        if events.timed.any():  # one whose time comes with the event is what it is just behind it
            behind = jnp.asarray(at.t) + COINCIDE * jnp.abs(at.t)
            there = guards(events, at._replace(t=behind), before, timed=True)
            g = jnp.where(events.timed, there, g)
        as_decreed = (jnp.abs(g) <= band) & (k < DECREED)
        r = jnp.where(as_decreed, decreed, holds(events, g).astype(d.dtype))
        r = jnp.where(events.ticks & (jnp.asarray(initial) > 0), 0, r)
        differs = r != d[:n]
        first = jnp.arange(n) == jnp.argmax(differs) if n else differs
        r = jnp.where((k >= PASSES) & ~first, d[:n], r)
        return updated(events, at, before, r, initial)

    def goes_on(state: tuple[Array, Array, Array]) -> Array:
        _, k, same = state
        return ~same & (k < PASSES + ONE_BY_ONE)

    def body(state: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
        d, k, _ = state
        new = again(d, k)
        return new, k + 1, jnp.all(_same(new, d))

    first = now.d, jnp.asarray(0), jnp.array(False)
    d, _, same = lax.while_loop(goes_on, body, first)
    return lax.stop_gradient(d), same


def _turned(events: Events, band: Array, decreed: Array, rates: Rates, x: Array, d: Array) -> Array:
    """What conditions within their band are just behind the event: what their rates say."""
    number, rate = lax.stop_gradient(rates(x, d))
    at_zero = (jnp.abs(number) <= band) & (rate != 0) & jnp.isfinite(rate) & ~events.timed
    return jnp.where(at_zero, (rate > 0).astype(decreed.dtype), decreed)


def _same(a: Array, b: Array) -> Array:
    return (a == b) | (jnp.isnan(a) & jnp.isnan(b))


@eqx.filter_jit
def begun(events: Events, at: Values) -> After:
    """Discrete variables that agree with the initial values, as they are before the first event.

    Arguments:
        events: of the model. at: the values at the start, with the discrete variables' start values.
    """
    assert at.d is not None
    none = -jnp.ones(events.n_guards, at.x.dtype)
    d, settled = settle(events, at, at, none, none, 1.0)
    smooth = updated(events, at._replace(d=d), at, d[: events.n_guards], 1.0)
    return After(at.x, jnp.where(events.exact, d, smooth), settled)


@eqx.filter_jit
def happen_at_start(events: Events, at: Values) -> After:
    """What happens at the first time, once initial values are found; with derivatives in both modes.

    A condition whose time it is, but for rounding, has changed.
    """
    fixed = without_derivatives(at)
    band, decreed = -jnp.ones(events.n_guards, at.x.dtype), None
    if events.timed.any():
        when = due(events, fixed)
        apart = COINCIDE * jnp.abs(fixed.t)
        near = jnp.abs(when.t - fixed.t) <= apart
        band = jnp.where(near, 2 * apart * jnp.abs(when.rate), band)
        decreed = (when.rate > 0).astype(at.x.dtype)
    rounds, n, settled = rounds_of(events, fixed, band, decreed=decreed)

    def again(state: tuple[Array, Array], k: Array) -> tuple[tuple[Array, Array], None]:
        x, d = state
        this = Round(x, x, d, rounds.found[k])
        return lax.cond(k < n, lambda: after_round(events, at, this), lambda: (x, d)), None

    assert at.d is not None
    (x, d), _ = lax.scan(again, (at.x, at.d), jnp.arange(ROUNDS))
    return After(x, d, settled)


def restless(events: Events, at: Values, initial: float = 0.0) -> list[int]:
    """Places of discrete variables that change with each pass, where none agree with the values.

    Arguments:
        events: of the model. at: the values, not traced.
        initial: 1 while initial values are being found.
    """
    assert at.d is not None
    n, d = events.n_guards, at.d
    changed = np.zeros(len(d), bool)
    for k in range(2 * CIRCLE):
        found = holds(events, guards(events, at._replace(d=d), at)).astype(d.dtype)
        new = updated(events, at._replace(d=d), at, found[:n], initial)
        if k >= CIRCLE:
            changed |= ~np.asarray(_same(new, d))
        d = new
    return np.flatnonzero(changed).tolist()


def before_events(
    events: Events,
    values: Values,
    start: Float[Array, " n_discrete"],
    initial_state: Callable[[Array], Float[Array, " n_states"]],
) -> tuple[Float[Array, " n_states"], Float[Array, " n_discrete"]]:
    """States and discrete variables that agree, before what happens at the first time.

    Arguments as for `start_of`.
    """
    d = start
    x = initial_state(d)
    for _ in range(STARTS):
        found = begun(events, values._replace(x=x, d=start))
        now, before = (initial_state(found.d), found.d), (x, d)
        x, d = now
        compared = known((now, before))
        if compared is None or all(map(np.array_equal, *compared)):
            break
    return x, d


def start_of(
    events: Events,
    values: Values,
    start: Float[Array, " n_discrete"],
    initial_state: Callable[[Array], Float[Array, " n_states"]],
    describe: Callable[[int], str],
) -> Values:
    """Initial values with the discrete variables that belong to them, behind the events at the first time.

    Arguments:
        events: of the model. values: at the start; their states do not count.
        start: the discrete variables' start values.
        initial_state: finds the states for given discrete variables.
        describe: names the discrete variable at a place.

    Raises:
        InitializationError: if no discrete variables agree with the initial values.
    """
    x, d = before_events(events, values, start, initial_state)
    after = happen_at_start(events, values._replace(x=x, d=d))
    if (settled := known(after.settled)) is not None and not bool(settled):
        circle = listing(map(describe, restless(events, values._replace(x=x, d=d))), 6)
        raise InitializationError(
            f"At the start no discrete variables agree with the initial values: {circle or 'conditions'} change each "
            "other without end; break the circle by pre(...), or give other starts."
        )
    return values._replace(x=after.x, d=after.d)
