"""Derivatives of a run with events in reverse mode: its steps are made again, from the last to the first."""

from __future__ import annotations

from functools import partial
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array

from acausal._jax import room, while_any, with_steps
from acausal.codegen import Events
from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.hybrid.event_adjoint import Adjoint, OfMoved, Task, through_event
from acausal.simulation.hybrid.row import (
    STOP,
    Reach,
    Row,
    reach,
)
from acausal.simulation.hybrid.search import (
    Begin,
    Progress,
    Reached,
    advance,
    begin,
    reached,
    search,
)

MEMORY = 2**16
"""Numbers that the steps of a run may take in memory before it is made part by part again: half a megabyte.

XLA compiles a loop that touches less than a megabyte as a whole: then a step is made again up to ten times faster.
"""

FEWEST = 512
"""Steps that are kept in any case, of however many states."""


class Steps(eqx.Module):
    """The steps that a run has made.

    Attributes:
        parts: where each part of the run began, with a leading axis. count: how many parts there are.
        rows: the steps of the last part. n: how many. left: the first of the times to save behind the last step.
        end: states and discrete variables behind it.
    """

    parts: Progress
    count: Array
    rows: Row
    n: Array
    left: Array
    end: tuple[Array, Array]


def reverse(
    method: Any, problem: Problem, events: Events, start: Begin, *, until_stiff: bool
) -> Reached:
    """`search`, with derivatives in reverse mode."""

    def found(task: Task) -> Reached:
        method, problem, start = task
        return search(method, problem, events, start, until_stiff=until_stiff)

    return with_steps(
        (method, problem, start),
        found,
        lambda task: _kept(task, events, until_stiff),
        partial(_back, events, until_stiff),
    )


def _kept(task: Task, events: Events, until_stiff: bool) -> tuple[Reached, Steps]:
    """The result of a run, and its steps."""
    method, problem, start = task
    progress, saved = begin(method, problem, events, start)
    t, whole = start.t, jnp.zeros((), jnp.int32)
    like = Row(t, t, whole, whole, jnp.zeros(events.n_guards, t.dtype), start.x, start.d, whole)
    numbers = sum(a.size for a in jax.tree.leaves(like))
    size = min(problem.max_steps, max(MEMORY // numbers, FEWEST))
    most = -(-problem.max_steps // size)
    rows, parts = room(like, size), room(_without_log(progress), most)

    def one(carry: tuple[Any, ...], runs: Array) -> tuple[Any, ...]:
        i, progress, saved, parts, rows, n = carry
        k = jnp.where(runs, i, most)
        parts = jax.tree.map(
            lambda a, v: a.at[k].set(v, mode="drop"), parts, _without_log(progress)
        )
        last, saved, rows = advance(
            method, problem, events, progress, saved, rows, until_stiff=until_stiff
        )
        n = jnp.where(runs, last.counts.steps - progress.counts.steps, n)
        return i + runs, last, saved, parts, rows, n

    state = whole, progress, saved, parts, rows, whole
    state = (
        while_any(lambda s: s[1].why < 0, one, state) if most > 1 else one(state, jnp.array(True))
    )
    count, last, saved, parts, rows, n = state
    found = reached(problem, last, saved)
    return found, Steps(parts, count, rows, n, found.next, (found.x, found.d))


def _without_log(progress: Progress) -> Progress:
    """The progress with room for one event: where steps are made again, the log is not read."""
    return progress._replace(log=progress.log.short())


def _back(
    events: Events,
    until_stiff: bool,
    of_moved: OfMoved,
    own: list[Array],
    kept: Steps,
    to: Reached,
) -> list[Array]:
    """The cotangents of what moves."""
    method, problem, _ = of_moved(own)
    size, parts = len(kept.rows.t), kept.parts.t.shape[0]
    left = (jnp.arange(len(problem.ts)) >= kept.left)[:, None]
    to_x = to.x + jnp.sum(jnp.where(left, to.saved, 0), axis=0)
    to_d = to.d + jnp.sum(jnp.where(left, to.saved_d, 0), axis=0)
    last = Adjoint(to.t, to_x, to_d, [jnp.zeros_like(v) for v in own])

    def part(carry: tuple[Any, ...]) -> tuple[Any, ...]:
        """One part of the run; ``rows`` are its own only where it is the last."""
        i, rows, n, behind = carry
        progress = jax.tree.map(lambda a: a[i], kept.parts)
        end = kept.end
        if parts > 1:
            after = jnp.minimum(i + 1, parts - 1)
            end = tuple(
                jnp.where(i < kept.count - 1, some[after], last)
                for some, last in zip((kept.parts.x, kept.parts.d), end, strict=True)
            )

            def again() -> tuple[Row, Array]:
                made = advance(
                    method, problem, events, progress, None, rows, until_stiff=until_stiff
                )[2]
                assert made is not None
                return made, jnp.asarray(size, n.dtype)

            rows, n = lax.cond(i < kept.count - 1, again, lambda: (rows, n))

        def step(carry: tuple[Array, Adjoint]) -> tuple[Array, Adjoint]:
            k, behind = carry
            row = jax.tree.map(lambda a: a[k], rows)
            first = jnp.where(k > 0, rows.next[jnp.maximum(k - 1, 0)], progress.next)
            following = jnp.minimum(k + 1, size - 1)
            then = (
                jnp.where(k < n - 1, rows.x[following], end[0]),
                jnp.where(k < n - 1, rows.d[following], end[1]),
            )
            through = partial(_through, of_moved, events, own, row, first, to, then)
            plain, event = (partial(through, is_event=b) for b in (False, True))
            return k - 1, lax.cond(row.kind > STOP, event, plain, behind)

        _, before = lax.while_loop(lambda c: c[0] >= 0, step, (n - 1, behind))
        return i - 1, rows, n, before

    state = kept.count - 1, kept.rows, kept.n, last
    state = lax.while_loop(lambda s: s[0] >= 0, part, state) if parts > 1 else part(state)
    first = state[3]

    def begins(some: list[Array]) -> tuple[Array, Array]:
        start = of_moved(some)[2]
        return start.x, start.d

    pulled = jax.vjp(begins, own)[1]((first.x, first.d))[0]
    return [a + b for a, b in zip(first.own, pulled, strict=True)]


def _through(
    of_moved: OfMoved,
    events: Events,
    own: list[Array],
    row: Row,
    first: Array,
    to: Reached,
    then: tuple[Array, Array],
    behind: Adjoint,
    *,
    is_event: bool,
) -> Adjoint:
    """The cotangents before a step, from those behind it.

    ``first`` is the first of the times to save within it; ``then`` are the values behind the event at its end.
    """

    def again(own: list[Array], t: Array, x: Array, d: Array) -> tuple[Any, ...]:
        method, problem, _ = of_moved(own)
        end = reach(method, problem, events, row, t, x, d, is_event=is_event)
        return end.t, end.x, end.dense, t, end.h

    (stop, end, dense, t, h), pull = jax.vjp(again, own, row.t, row.x, row.d)
    if is_event:
        ahead = Reach(stop, end, h, dense)
        behind = through_event(of_moved, events, own, row, ahead, then, behind)
    method, problem, _ = of_moved(own)

    def add(state: tuple[Any, ...]) -> tuple[Any, ...]:
        j, total, of_d = state
        inside = lambda dense, t, h: method.between(dense, t, h, problem.ts[j])  # noqa: E731
        pulled = jax.vjp(inside, dense, t, h)[1](to.saved[j])
        return j + 1, jax.tree.map(jnp.add, total, pulled), of_d + to.saved_d[j]

    nothing = jax.tree.map(jnp.zeros_like, ((dense, t, h), behind.d))
    state = first, *nothing
    if len(problem.ts):
        state = lax.while_loop(lambda s: s[0] < row.next, add, state)
    _, (to_dense, to_begin, to_h), saved_d = state
    by_own, to_t, to_x, to_d = pull((behind.t, behind.x, to_dense, to_begin, to_h))
    totals = [a + b for a, b in zip(behind.own, by_own, strict=True)]
    return Adjoint(to_t, to_x, to_d + behind.d + saved_d, totals)
