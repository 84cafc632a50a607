"""Compute conditions, discrete variables and jumps with JAX."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Bool, Float

from acausal.codegen import (
    DISCRETE,
    ArrayFormula,
    Arrays,
    Program,
    Values,
    compute,
    rates_from,
    run,
)
from acausal.events.event_formulas import Events, Update


def guards(
    events: Events, now: Values, before: Values | None = None, *, timed: bool = False
) -> Float[Array, " n_guards"]:
    """The numbers that are positive where a condition holds.

    Arguments:
        now: the values. before: those before the event; between events the same.
        timed: only those of conditions whose time is known, which need no equation of the model; zero for the others.
    """
    wanted = [g.formula for g in events.guards if g.timed or not timed]
    arrays = arrays_for(events.program, wanted, now, now if before is None else before)
    return _numbers(events, now, arrays, timed)


def guards_and_rates(
    events: Events, now: Values
) -> tuple[Float[Array, " n_guards"], Float[Array, " n_states"]]:
    """The numbers of `guards` between events, and the derivatives of the states; what both read is computed once."""
    program = events.program
    wanted = [g.formula for g in events.guards]
    arrays = arrays_for(program, wanted, now, now, program.rate_sources)
    return _numbers(events, now, arrays), rates_from(program, now, arrays)


def _numbers(
    events: Events, now: Values, arrays: Arrays, timed: bool = False
) -> Float[Array, " n_guards"]:
    numbers = [
        _value(g.formula, now, arrays) if g.timed or not timed else 0.0 for g in events.guards
    ]
    sizes = [g.formula.size for g in events.guards]
    each = [jnp.broadcast_to(n, size) for n, size in zip(numbers, sizes, strict=True)]
    return jnp.concatenate([jnp.zeros(0, now.x.dtype), *each])


def holds(events: Events, values: Float[Array, " n_guards"]) -> Bool[Array, " n_guards"]:
    """Whether the conditions hold, from the numbers of `guards`."""
    return jnp.where(events.strict, values > 0, values >= 0)


class Due(NamedTuple):
    """When conditions come true, or cease to, whose time is known.

    Attributes:
        t: in seconds; infinite for the others. rate: how fast the numbers of `guards` grow then, in 1/s.
    """

    t: Float[Array, " n_guards"]
    rate: Float[Array, " n_guards"]


def due(events: Events, now: Values) -> Due:
    """When conditions change whose time is known: their numbers grow evenly with time."""
    # from now on, not from zero on: seconds of a calendar would leave few digits for the rate
    t = jnp.asarray(now.t)
    here, later = (guards(events, now._replace(t=at), timed=True) for at in (t, t + 1))
    rate = jnp.where(events.timed, later - here, 1.0)
    # Else a number does not change, or is so large that rounding hides it.
    known = events.timed & (rate != 0)
    return Due(jnp.where(known, t - here / jnp.where(known, rate, 1.0), jnp.inf), rate)


def updated(
    events: Events,
    now: Values,
    before: Values,
    conditions: Float[Array, " n_guards"],
    initial: ArrayLike = 0.0,
) -> Float[Array, " n_discrete"]:
    """The discrete variables, once more computed from all values.

    Arguments:
        now: the values, with the discrete variables as they are known so far. before: those before the event.
        conditions: 1 where a condition holds, else 0.
        initial: 1 while initial values are being found.
    """
    arrays = arrays_for(events.program, [u.formula for u in events.updates], now, before)
    assert now.d is not None
    d = jnp.concatenate([conditions.astype(now.d.dtype), now.d[events.n_guards :]])
    for update in events.updates:
        arrays[DISCRETE] = d
        d = _put(d, update, _value(update.formula, now, arrays, initial))
    return d


def jumped(events: Events, now: Values, before: Values) -> Float[Array, " n_states"]:
    """The states, where some jump."""
    arrays = arrays_for(events.program, [jump.formula for jump in events.jumps], now, before)
    x = now.x
    for jump in events.jumps:
        x = _put(x, jump, _value(jump.formula, now, arrays))
    return x


def arrays_for(
    program: Program,
    formulas: Sequence[ArrayFormula],
    now: Values,
    before: Values,
    others: Sequence[int] = (),
) -> list[Any]:
    """What the formulas read, and some other arrays: the program's arrays now, and those before the event."""
    sources = {*others, *(s for f in formulas for s in f.sources)}
    return [
        a
        for k, at in enumerate((now, before))
        for a in run(program, program.in_copy(sources, k), at)
    ]


def _value(formula: ArrayFormula, now: Values, arrays: Arrays, initial: ArrayLike = 0.0) -> Array:
    return compute(formula, now.packed, arrays, now.t, initial).astype(now.x.dtype)


def _put(values: Array, update: Update, value: Array) -> Array:
    """Values with the update's in their places."""
    return values.at[update.places].set((value * update.signs).astype(values.dtype))
