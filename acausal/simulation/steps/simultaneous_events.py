"""Conditions that change at the same instant, one after another: for derivatives each of them has its own time.

An event changes them together. Where the same comes of it if they change in turn, a derivative takes them so: each at
its own time, with a step of length zero between two, whose length has a derivative. Where it does not, what comes of
them depends on their order, and all are taken to change at the time of the one that was found.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import either
from acausal.events import After, Rates, fire, guards
from acausal.simulation.steps.problem import Integration
from acausal.simulation.steps.rows import Reach, Row, chosen, moved_by, rates_at, values_at

MOST = 8
"""So many conditions of one instant, at most, are taken in turn."""


class Turn(NamedTuple):
    """Which conditions of an event change now.

    Attributes:
        forced: what conditions within their band are. waits: those that change later.
    """

    forced: Float[Array, " n_guards"]
    waits: Bool[Array, " n_guards"]

    def rates(self, rates: Rates) -> Rates:
        """The numbers of conditions, and how fast they grow: zero for those that wait, whatever becomes of them."""

        def masked(x: Array, d: Array) -> tuple[Array, Array]:
            number, rate = rates(x, d)
            return number, jnp.where(self.waits, 0.0, rate)

        return masked


def count(row: Row) -> Int[Array, ""]:
    """How many turns an event has."""
    n = jnp.sum(row.band >= 0)
    return jnp.where((n > 1) & (n <= MOST), n, 1)


def turn(row: Row, d: Float[Array, " n_discrete"], i: Int[Array, ""], together: Any) -> Turn:
    """One turn of an event, or all its conditions together."""
    among, place = _order(row)
    own = d[: len(row.band)]
    now = among & (together | (place == i))
    return Turn(jnp.where(now, 1 - own, own), among & ~together & (place > i))


def guard_of(row: Row, i: Int[Array, ""]) -> Int[Array, ""]:
    """Whose turn it is."""
    among, place = _order(row)
    return jnp.argmax(among & (place == i))


def _order(row: Row) -> tuple[Bool[Array, " n_guards"], Int[Array, " n_guards"]]:
    """Which conditions change, and whose turn comes when: first that of the one that was found."""
    among, places = row.band >= 0, jnp.arange(len(row.band))
    return among, jnp.where(places == row.which, 0, jnp.cumsum(among & (places != row.which)))


def still_wait(
    problem: Integration, row: Row, turn: Turn, t: Array, x: Array, d: Array
) -> Bool[Array, ""]:
    """Whether the conditions that wait are still about to change."""
    numbers = lax.stop_gradient(guards(problem.watched, values_at(problem, t, x, d)))
    return jnp.all(~turn.waits | (jnp.abs(numbers) <= row.band))


def until(
    problem: Integration, row: Row, guard: Int[Array, ""], t: Array, x: Array, d: Array
) -> tuple[Float[Array, ""], Float[Array, " n_states"]]:
    """Time and states where a condition changes: those given, with other derivatives."""
    field, events = problem.held(d).field, problem.watched
    rate = field(t, x)
    fixed = lax.stop_gradient((rate, jnp.ones_like(t)))

    def number(t: Array, x: Array) -> Array:
        return chosen(guards(events, field.at(t).values(x)), guard)

    h = moved_by(row, number, (t, x), (fixed[1], fixed[0]))
    if events.timed.any():
        its_time = chosen(field.due(events, t, x).t, guard)
        h = jnp.where(jnp.asarray(events.timed)[guard], its_time - t, h)
    h = h - lax.stop_gradient(h)
    return t + h, x + fixed[0] * h


def follow_in_turn(
    problem: Integration, row: Row, end: Reach, d: Array
) -> tuple[Float[Array, ""], After]:
    """Time and values behind an event, with derivatives in forward mode."""
    rates = rates_at(problem, end.t, row)
    n = count(row)

    def one(state: tuple[Any, ...]) -> tuple[Any, ...]:
        """All together first; then in turn."""
        k, t, x, d_now, whole, fits = state
        own = turn(row, d_now, k - 1, k == 0)
        later = until(problem, row, guard_of(row, k - 1), t, x, d_now)
        t, x = either(k > 1, later, (t, x))
        at = values_at(problem, t, x, d_now)
        after = fire(
            problem.watched, at, row.band, own.rates(rates), forced=own.forced, instant=row.instant
        )
        fits = fits & still_wait(problem, row, own, t, after.x, after.d)
        first = k == 0
        whole = either(first, after, whole)
        t, x, d_now = either(first, (end.t, end.x, d), (t, after.x, after.d))
        return k + 1, t, x, d_now, whole, fits & after.converged

    def goes_on(state: tuple[Any, ...]) -> Array:
        return (state[0] == 0) | ((n > 1) & (state[0] <= n))

    yes = jnp.array(True)
    start = jnp.asarray(0), end.t, end.x, d, After(end.x, d, yes), yes
    _, t, x, d_end, whole, fits = lax.while_loop(goes_on, one, start)
    apart = fits & (n > 1) & same((x, d_end), (whole.x, whole.d))
    t, x, d_end = either(apart, (t, x, d_end), (end.t, whole.x, whole.d))
    return t, After(x, d_end, whole.converged)


def same(a: tuple[Array, Array], b: tuple[Array, Array]) -> Bool[Array, ""]:
    """Whether two ways lead to the same values, but for rounding."""
    pairs = [(jnp.append(*one)) for one in (a, b)]
    first, second = lax.stop_gradient(pairs)
    return jnp.all(jnp.abs(first - second) <= 1e-8 * (1 + jnp.abs(second)))
