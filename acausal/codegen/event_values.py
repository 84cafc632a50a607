"""Compute conditions, discrete variables and jumps with JAX."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np
import sympy as sp
from jax.typing import ArrayLike
from jaxtyping import Array, Bool, Float

from acausal.codegen.events import Events, Formula
from acausal.codegen.interpreter import run
from acausal.codegen.lower import evaluate
from acausal.codegen.program import DISCRETE
from acausal.codegen.reading import Arrays, chosen_module, read_elements, read_parameters
from acausal.codegen.values import Values
from acausal.modeling import INITIAL, time


def guards(
    events: Events, now: Values, before: Values | None = None, *, timed: bool = False
) -> Float[Array, " n_guards"]:
    """The numbers that are positive where a condition holds.

    Arguments:
        now: the values. before: those before the event; between events the same.
        timed: only those of conditions whose time is known, which need no equation of the model; zero for the others.
    """
    wanted = [g.formula for g in events.guards if g.timed or not timed]
    arrays, earlier = _arrays(events, wanted, now, now if before is None else before)
    numbers = [
        _value(events, g.formula, now, arrays, earlier, 0.0)
        if g.timed or not timed
        else jnp.zeros(g.formula.size, now.x.dtype)
        for g in events.guards
    ]
    return jnp.concatenate([jnp.zeros(0, now.x.dtype), *numbers])


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
    """When conditions change whose time is known."""
    at_zero, at_one = (
        guards(events, now._replace(t=jnp.full_like(now.t, t)), timed=True) for t in (0.0, 1.0)
    )
    rate = jnp.where(events.timed, at_one - at_zero, 1.0)
    known = events.timed & (
        rate != 0
    )  # else a number does not change, or is so large that rounding hides it
    return Due(jnp.where(known, -at_zero / jnp.where(known, rate, 1.0), jnp.inf), rate)


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
    arrays, earlier = _arrays(events, events.updates, now, before)
    assert now.d is not None
    d = jnp.concatenate([conditions.astype(now.d.dtype), now.d[events.n_guards :]])
    for formula in events.updates:
        arrays[DISCRETE] = d
        value = _value(events, formula, now, arrays, earlier, initial)
        d = d.at[formula.places].set((value * formula.signs).astype(d.dtype))
    return d


def jumped(events: Events, now: Values, before: Values) -> Float[Array, " n_states"]:
    """The states, where some jump."""
    arrays, earlier = _arrays(events, events.jumps, now, before)
    x = now.x
    for formula in events.jumps:
        value = _value(events, formula, now, arrays, earlier, 0.0)
        x = x.at[formula.places].set((value * formula.signs).astype(x.dtype))
    return x


def _arrays(
    events: Events, formulas: Sequence[Formula], now: Values, before: Values
) -> tuple[list[Any], list[Any]]:
    """What the formulas read: the values now, and those before the event."""
    program = events.program
    return (
        run(program, events.sources(formulas, previous=False), now),
        run(program, events.sources(formulas, previous=True), before),
    )


def _value(
    events: Events,
    formula: Formula,
    now: Values,
    arrays: Arrays,
    earlier: Arrays,
    initial: ArrayLike,
) -> Array:
    filled: dict[sp.Symbol, Any] = {time: now.t, INITIAL: initial}
    for slot in formula.slots:
        value = read_elements(slot.values, earlier if slot.previous else arrays)
        filled[slot.symbol] = value if (slot.signs == 1).all() else value * slot.signs
    for symbol, read in formula.parameters:
        filled[symbol] = (
            read_parameters(events.layout, read, now.packed)
            if isinstance(read, np.ndarray)
            else read_elements(read, [now.packed.values])
        )
    for symbol, chosen in formula.modules:
        filled[symbol] = chosen_module(now.packed, chosen)
    value = jnp.asarray(evaluate(formula.expression, filled), now.x.dtype)
    return jnp.broadcast_to(value, (formula.size,))
