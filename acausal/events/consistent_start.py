"""Consistent start: discrete variables that agree with the initial values, and what happens at the first time."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import jax.numpy as jnp
import numpy as np
from jax import lax
from jaxtyping import Array, Float

from acausal._jax import compiled, known, traced, without_derivatives
from acausal.codegen import Values
from acausal.errors import InitializationError, listing
from acausal.events.event_formulas import Events
from acausal.events.event_iteration import (
    ALL_AT_ONCE,
    ONE_BY_ONE,
    PASSES,
    After,
    Pass,
    after_pass,
    coincide,
    equal,
    fire,
    iterate,
    once_more,
)
from acausal.events.zero_crossings import due, updated

STARTS = 10
"""So often initial values and discrete variables are found in turn, if they depend on each other."""

CIRCLE = 10
"""After so many iterations what changes is taken to be part of a circle."""


@compiled
def _begun(events: Events, at: Values) -> Float[Array, " n_discrete"]:
    """Discrete variables that agree with the initial values, as they are before the first event, from their starts."""
    none = -jnp.ones(events.n_guards, at.x.dtype)
    d, _ = iterate(events, at, none, none, 1.0)
    smooth = updated(events, at._replace(d=d), at, d[: events.n_guards], 1.0)
    return jnp.where(events.exact, d, smooth)


@compiled
def _fire_at_start(events: Events, at: Values, differentiable: bool, ticks: bool) -> After:
    """What happens at the first time, once initial values are found; on demand with derivatives in both modes.

    A condition whose time it is, but for rounding, has changed if it ``ticks``; else it is what it was.
    """
    fixed = without_derivatives(at)
    band, forced = -jnp.ones(events.n_guards, at.x.dtype), None
    if events.timed.any():
        when = due(events, fixed)
        apart = coincide(at.x.dtype) * jnp.abs(fixed.t)
        near = jnp.abs(when.t - fixed.t) <= apart
        band = jnp.where(near, 2 * apart * jnp.abs(when.rate), band)
        assert fixed.d is not None
        forced = when.rate > 0 if ticks else fixed.d[: events.n_guards]
        forced = forced.astype(at.x.dtype)
    after = fire(events, fixed, band, forced=forced, keep=differentiable)
    if not differentiable:
        return after
    assert at.d is not None

    def again(state: tuple[Array, Array], k: Array) -> tuple[tuple[Array, Array], None]:
        this = Pass(*state, after.passes.found[k])
        return lax.cond(k < after.n, lambda: after_pass(events, at, this), lambda: state), None

    (x, d), _ = lax.scan(again, (at.x, at.d), jnp.arange(PASSES))
    return After(x, d, after.converged)


def non_converged(events: Events, at: Values) -> list[int]:
    """Places of discrete variables that change with each iteration, where none agree with the known values."""
    assert at.d is not None
    d, none = at.d, -jnp.ones(events.n_guards, at.x.dtype)
    changed = np.zeros(len(d), bool)
    for k in range(2 * CIRCLE):
        new = once_more(events, at, d, none, none, ALL_AT_ONCE + ONE_BY_ONE)
        if k >= CIRCLE:
            changed |= ~np.asarray(equal(new, d))
        d = new
    return np.flatnonzero(changed).tolist()


def before_events(
    events: Events,
    start: Values,
    initial_state: Callable[[Array], Float[Array, " n_states"]],
    describe: Callable[[int], str],
) -> tuple[Float[Array, " n_states"], Float[Array, " n_discrete"]]:
    """States and discrete variables that agree, before what happens at the first time.

    Arguments and errors as for `start_of`.
    """
    assert start.d is not None
    d = _begun(events, start)
    try:
        now = before = initial_state(d), d
    except InitializationError:  # there may be initial values in the modes that are declared
        now = before = initial_state(start.d), start.d
    for _ in range(STARTS):
        found = _begun(events, start._replace(x=now[0]))
        now, before = (initial_state(found), found), now
        compared = known((now, before))
        if compared is None or all(map(np.array_equal, *compared)):
            return now
    changed = np.asarray(~equal(now[1], before[1]))
    if not changed.any():  # the states creep by rounding
        return now
    raise _no_start(map(describe, np.flatnonzero(changed).tolist()))


def _no_start(circle: Iterable[str]) -> InitializationError:
    return InitializationError(
        f"At the start no discrete variables agree with the initial values: {listing([*circle], 6) or 'conditions'} "
        "change each other without end; break the circle by pre(...), or give other starts."
    )


def start_of(
    events: Events,
    start: Values,
    initial_state: Callable[[Array], Float[Array, " n_states"]],
    describe: Callable[[int], str],
    *,
    ticks: bool = True,
) -> Values:
    """Initial values with the discrete variables that belong to them, behind the events at the first time.

    Arguments:
        events: of the model.
        start: the values at the start, with the start values of discrete variables, and of states those from which
            they are looked for.
        initial_state: finds the states for given discrete variables.
        describe: names the discrete variable at a place.
        ticks: whether what is due at the first time happens, as the tick of a clock.

    Raises:
        InitializationError: if no discrete variables agree with the initial values.
    """
    x, d = before_events(events, start, initial_state, describe)
    at = start._replace(x=x, d=d)
    after = _fire_at_start(events, at, traced(at), ticks)
    if (converged := known(after.converged)) is not None and not bool(converged):
        raise _no_start(map(describe, non_converged(events, at)))
    return start._replace(x=after.x, d=after.d)
