"""One step, as it is made again for derivatives; with events, where it ends may depend on what moves."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Float, Int

from acausal._jax import without_derivatives
from acausal.codegen import Values
from acausal.events import Rates, guards, guards_and_rates
from acausal.simulation.steps.problem import Integration

FREE, STOP, BEND, EDGE, RESTART, JUMP, TIMED, STATE = range(8)
"""How a step ends: as long as it was; at a known time; where the right-hand side is known to bend, or to jump; where
another run begins; where inputs jump; at the known time of a condition; where one changes."""

GRAZING = 1e-12
"""A condition that changes more slowly than this, relative to its size and the step, has no time of its own."""


class Row(NamedTuple):
    """A step.

    Attributes:
        t, h: its start and length. end: where it ends, which may differ from ``t + h`` by rounding and lie on the other
            side of a jump. kind: how it ends. which: the number of the stop, or of the condition.
        next: the first of the times to save that does not lie in it, nor in one before.
        ahead: the first of the known times at which steps end that lies behind its start.
        x: the state at its end; with events, which may change it there, that at its start.
        own: what the method needs.
        d: discrete variables at its start. band: the conditions that change at its end, and instant: whether rates
            decide there; see `fire`. None without events.
    """

    t: Float[Array, ""]
    h: Float[Array, ""]
    end: Float[Array, ""]
    kind: Int[Array, ""]
    which: Int[Array, ""]
    next: Int[Array, ""]
    ahead: Int[Array, ""]
    x: Float[Array, " n_states"]
    own: Any = ()
    d: Any = None
    band: Any = None
    instant: Any = None


class Reach(NamedTuple):
    """Where a step leads to, before the event at its end.

    Attributes:
        t, x: behind it. h: its length. dense: for states within it.
    """

    t: Float[Array, ""]
    x: Float[Array, " n_states"]
    h: Float[Array, ""]
    dense: Any


def stop_at(problem: Integration, i: Int[Array, ""]) -> Float[Array, ""]:
    """One of the known times at which steps end: those of breaks, then the end."""
    n = len(problem.breaks)
    if not n:
        return problem.end
    return jnp.where(i < n, problem.breaks[jnp.minimum(i, n - 1)], problem.end)


def next_edge(problem: Integration, t: Float[Array, ""]) -> Float[Array, ""]:
    """The next time at which the right-hand side jumps or bends; infinite if there is none."""
    ahead = problem.ahead(t)
    return jnp.minimum(ahead.jump, ahead.bend)


def reach(
    method: Any,
    problem: Integration,
    row: Row,
    t: Float[Array, ""],
    x: Float[Array, " n_states"],
    d: Float[Array, " n_discrete"],
    *,
    is_event: bool,
) -> Reach:
    """Make a step again, up to the event at its end.

    Arguments:
        method, problem: what is integrated.
        row: the step; its length counts where it does not follow from the rest.
        t, x, d: its start. They equal the row's, and may have derivatives.
        is_event: whether an event, or another run, follows; else the step is FREE or goes to a STOP, BEND or EDGE.
    """
    held, events = problem.held(d, stop_at(problem, row.ahead)), problem.watched
    stop = stop_at(problem, row.which)
    if held.field.has_edges:
        edge = next_edge(held, row.t)
        held = held.sided(row.t, edge)
        stop = jnp.where((row.kind == BEND) | (row.kind == EDGE), edge, stop)
    field = held.field

    def step(h: Array) -> tuple[Array, Any]:
        first = method.first(field, t, h, x, field(t, x))
        made = method.make(field, t, h, x, first)
        return made.x, made.dense

    fixed = lax.stop_gradient(row.h)
    if not is_event:
        to_stop = (row.kind >= STOP) & (row.kind <= EDGE)
        h = jnp.where(to_stop, stop - t, fixed)
        end, dense = step(h)
        return Reach(jnp.where(to_stop, stop, t + h), end, h, dense)

    (end, dense), by_h = jax.jvp(step, (fixed,), (jnp.ones_like(fixed),))

    def condition(t: Array, x: Array) -> Array:
        return chosen(guards(events, field.at(t).values(x)), row.which)

    def where_it_changes() -> Array:
        return fixed + moved_by(row, condition, (t + fixed, end), (jnp.ones_like(fixed), by_h[0]))

    def to_its_time() -> Array:
        return chosen(field.due(events, t, x).t, row.which) - t

    timed = to_its_time if events.timed.any() else lambda: fixed
    changes = where_it_changes if not events.timed.all() else lambda: fixed
    kind = jnp.maximum(row.kind, JUMP) - JUMP
    h = lax.switch(kind, (lambda: stop - t, timed, changes))
    moved = h - lax.stop_gradient(h)  # zero, with derivatives
    end, dense = jax.tree.map(
        lambda v, rate: v + lax.stop_gradient(rate) * moved, (end, dense), by_h
    )
    time = jnp.where(row.kind <= JUMP, stop, t + h)
    return Reach(row.end + (time - lax.stop_gradient(time)), end, h, dense)


def moved_by(
    row: Row,
    number: Callable[[Array, Array], Array],
    at: tuple[Array, Array],
    along: tuple[Array, Array],
) -> Array:
    """By what the instant of a condition moves with its number: zero, with derivatives.

    Arguments:
        number: of the condition, by time and states. at: these. along: how they grow with time.
    """
    g, slope = jax.jvp(number, at, along)
    slope = lax.stop_gradient(slope)
    none = grazes(row, g, slope)
    return jnp.where(none, 0.0, (lax.stop_gradient(g) - g) / jnp.where(none, 1.0, slope))


def grazes(row: Row, number: Array, slope: Array) -> Array:
    """Whether a condition hardly changes at its instant: it has no time of its own then."""
    size = lax.stop_gradient(jnp.abs(number) + jnp.max(row.band, initial=0.0))
    return ~(jnp.abs(slope) * row.h > GRAZING * size) | ~jnp.isfinite(slope)


def chosen(numbers: Float[Array, " n"], which: Int[Array, ""]) -> Float[Array, ""]:
    """One of some numbers.

    Read by its index, its derivative would be a scatter, and XLA would not compile the loop around it as a whole.
    """
    return jnp.sum(jnp.where(jnp.arange(len(numbers)) == which, numbers, 0.0))


def values_at(problem: Integration, t: Array, x: Array, d: Array) -> Values:
    """The values between events."""
    return problem.held(d).field.at(t).values(x)


def rates_at(problem: Integration, t: Array, row: Row) -> Rates:
    """The conditions' numbers at the end of a step, and how fast they grow, for states and discrete variables.

    Without derivatives. Where rates decide, they are those behind it: inputs and known times may bend there.
    """
    problem, t = without_derivatives((problem, t))
    t = t + jnp.where(row.instant > 0, problem.apart(t), 0.0)
    events = problem.watched

    def rates(x: Array, d: Array) -> tuple[Array, Array]:
        field = problem.held(d).field
        both = lambda t, x: guards_and_rates(events, field.at(t).values(x))  # noqa: E731
        (number, rate), change = jax.linearize(both, t, x)
        return number, change(jnp.ones_like(t), rate)[0]

    return rates


def restarted(problem: Integration, which: Int[Array, ""]) -> tuple[Array, Array | None]:
    """States and discrete variables with which another run begins at a break."""
    assert problem.first is not None
    at = jnp.minimum(which, len(problem.breaks) - 1)
    return problem.first[at], None if problem.first_d is None else problem.first_d[at]
