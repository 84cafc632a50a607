"""Derivatives of one event in reverse mode: its conditions in turn, each through its passes, last to first."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array

from acausal.events import After, Pass, after_pass, fire
from acausal.simulation.steps import simultaneous_events
from acausal.simulation.steps.loop import LoopStart
from acausal.simulation.steps.problem import Integration
from acausal.simulation.steps.rows import RESTART, Reach, Row, rates_at, restarted, values_at

Task = tuple[Any, Integration, LoopStart]
"""Method, problem, start."""

OfMoved = Callable[[list[Array]], Task]
"""The task, from those of its arrays whose derivatives are needed."""


class Adjoint(NamedTuple):
    """Cotangents of time, states (or of what a method keeps) and discrete variables, and of what moves.

    Those of time and discrete variables are None without events.
    """

    t: Any
    x: Array
    d: Any
    own: list[Array]


def through_event(
    of_moved: OfMoved,
    own: list[Array],
    row: Row,
    end: Reach,
    then: tuple[Array, Array],
    behind: Adjoint,
) -> Adjoint:
    """The cotangents before an event, from those behind it."""
    problem = of_moved(own)[1]
    events = problem.watched

    def event() -> Adjoint:
        if events.n_guards > 1:
            return _through_turns(of_moved, own, row, end, then, behind)
        at = values_at(problem, end.t, end.x, row.d)
        rates = rates_at(problem, end.t, row)
        after = fire(events, at, row.band, rates, instant=row.instant, keep=True)
        return _through_passes(of_moved, own, end.t, after, behind)

    if problem.first is None:
        return event()

    def restart() -> Adjoint:
        return through_restart(of_moved, own, row, behind, behind.x)

    return lax.cond(row.kind == RESTART, restart, event)


def through_restart(
    of_moved: OfMoved, own: list[Array], row: Row, behind: Adjoint, to_first: Array
) -> Adjoint:
    """The cotangents before another run begins: the one before feels nothing of it."""
    pull = jax.vjp(lambda own: restarted(of_moved(own)[1], row.which), own)[1]
    totals = [a + b for a, b in zip(behind.own, pull((to_first, behind.d))[0], strict=True)]
    x, d = jax.tree.map(jnp.zeros_like, (behind.x, behind.d))
    return Adjoint(behind.t, x, d, totals)


def _through_passes(
    of_moved: OfMoved,
    own: list[Array],
    t: Array,
    event: After,
    behind: Adjoint,
) -> Adjoint:
    """The cotangents before the passes of an event, from those behind them: from the last to the first."""

    def step(state: tuple[Array, Adjoint]) -> tuple[Array, Adjoint]:
        k, behind = state
        this = jax.tree.map(lambda a: a[k], event.passes)

        def after(own: list[Array], t: Array, x: Array, d: Array) -> Any:
            problem = of_moved(own)[1]
            at = values_at(problem, t, x, d)
            return after_pass(problem.watched, at, Pass(x, d, this.found))

        by_own, to_t, to_x, to_d = jax.vjp(after, own, t, this.x, this.d)[1]((behind.x, behind.d))
        totals = [a + b for a, b in zip(behind.own, by_own, strict=True)]
        return k - 1, Adjoint(behind.t + to_t, to_x, to_d, totals)

    return lax.while_loop(lambda s: s[0] >= 0, step, (event.n - 1, behind))[1]


class _Turns(NamedTuple):
    """How far the turns of an event have come: up to the last, then back.

    Attributes:
        i: the turn. last: the last one. back: whether it goes back. together: whether all is one turn.
        xs, ds: states and discrete variables before each turn. behind: cotangents.
    """

    i: Array
    last: Array
    back: Array
    together: Array
    xs: Array
    ds: Array
    behind: Adjoint


def _through_turns(
    of_moved: OfMoved,
    own: list[Array],
    row: Row,
    end: Reach,
    then: tuple[Array, Array],
    behind: Adjoint,
) -> Adjoint:
    """The cotangents before an event, from those behind it: of each condition in turn, see `simultaneous_events`."""
    problem = of_moved(own)[1]
    events = problem.watched
    rates = rates_at(problem, end.t, row)
    last = simultaneous_events.count(row) - 1
    most = min(simultaneous_events.MOST, events.n_guards)
    none = jnp.zeros_like(last)

    def one(state: _Turns) -> _Turns:
        i, x, d = state.i, state.xs[state.i], state.ds[state.i]
        turn = simultaneous_events.turn(row, d, i, state.together)
        at = values_at(problem, end.t, x, d)
        given: dict[str, Any] = {"forced": turn.forced, "instant": row.instant, "keep": True}
        event = fire(events, at, row.band, turn.rates(rates), **given)

        def onwards() -> _Turns:
            after = event.x, event.d
            waits = simultaneous_events.still_wait(problem, row, turn, end.t, *after)
            arrived = i == state.last
            fits = event.converged & waits & (~arrived | simultaneous_events.same(after, then))
            following = jnp.where(fits, jnp.minimum(i + 1, state.last), 0)
            is_next = jnp.arange(most) == following
            xs, ds = (
                jnp.where((is_next & fits & ~arrived)[:, None], value, some)
                for some, value in zip((state.xs, state.ds), after, strict=True)
            )
            turns_back = arrived | ~fits
            return _Turns(
                following,
                jnp.where(fits, state.last, 0),
                turns_back,
                ~fits,
                xs,
                ds,
                state.behind,
            )

        def backwards() -> _Turns:
            before = _through_passes(of_moved, own, end.t, event, state.behind)
            previous = jnp.maximum(i - 1, 0)
            guard = simultaneous_events.guard_of(row, i)

            def until(own: list[Array], t: Array, x: Array, d: Array) -> tuple[Array, Array]:
                problem = of_moved(own)[1]
                later = simultaneous_events.until(problem, row, guard, t, x, d)
                return jnp.where(i > 0, later[0], t), jnp.where(i > 0, later[1], x)

            pull = jax.vjp(until, own, end.t, x, d)[1]
            by_own, to_t, to_x, to_d = pull((before.t, before.x))
            totals = [a + b for a, b in zip(before.own, by_own, strict=True)]
            adjoint = Adjoint(to_t, to_x, to_d + before.d, totals)
            return state._replace(i=jnp.where(i > 0, previous, -1), behind=adjoint)

        return lax.cond(state.back, backwards, onwards)

    xs, ds = (jnp.zeros((most, *a.shape), a.dtype).at[0].set(a) for a in (end.x, row.d))
    alone = last == 0
    start = _Turns(none, last, alone, alone, xs, ds, behind)
    return lax.while_loop(lambda s: s.i >= 0, one, start).behind
