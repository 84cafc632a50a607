"""Derivatives of a run in reverse mode: its steps are made again, one by one, from the last to the first."""

from __future__ import annotations

from functools import partial
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Int

from acausal._jax import either, room, while_any, with_steps, without_derivatives
from acausal.simulation.steps.event_adjoint import (
    Adjoint,
    OfMoved,
    Task,
    through_event,
    through_restart,
)
from acausal.simulation.steps.loop import (
    REACHED,
    LoopResult,
    LoopStart,
    LoopState,
    advance,
    begin,
    found,
    rates_behind,
    row_like,
    search,
)
from acausal.simulation.steps.problem import EDGE_STEPS, Integration
from acausal.simulation.steps.rows import (
    EDGE,
    RESTART,
    Reach,
    Row,
    next_edge,
    reach,
    restarted,
    stop_at,
)

MEMORY = 2**20
"""Numbers that the steps of a run may take in memory before it is made part by part again: 8 MB.

All of it is written once for every derivative, which takes longer than the steps of a small model do.
"""

EVENT_MEMORY = 2**16
"""The same with events: half a megabyte.

XLA compiles a loop that touches less than a megabyte as a whole: then a step is made again up to ten times faster.
"""

FEWEST = 512
"""Steps that are kept in any case, of however many states."""

MORE_MEMORY, ENOUGH = 2**24, 1536
"""Numbers that this many steps may take where `MEMORY` has no room for the fewest: such a model's steps take longer."""


class RecordedSteps(eqx.Module):
    """The steps that a run has made.

    Attributes:
        parts: where each part of the run began, with a leading axis. count: how many parts there are.
        rows: the steps of the last part. n: how many.
        end: what the run found, but for what it saved.
    """

    parts: LoopState
    count: Int[Array, ""]
    rows: Row
    n: Int[Array, ""]
    end: tuple[Any, ...]


def reverse(method: Any, problem: Integration, start: LoopStart) -> LoopResult:
    """`search`, with derivatives in reverse mode.

    The states of all steps are kept, as far as there is room (`_size`). Of a longer run they are kept part by part:
    the derivative makes each part again from its start.
    """
    return with_steps((method, problem, start), lambda task: search(*task), _kept, _back)


def _kept(task: Task) -> tuple[LoopResult, RecordedSteps]:
    """The result of a run, and its steps."""
    method, problem, start = task
    progress, saved = begin(method, problem, start)
    like = row_like(method, problem, progress)
    numbers = sum(a.size for a in jax.tree.leaves(like))
    size = min(problem.max_steps, _size(numbers, problem))
    most_steps = problem.max_steps * (EDGE_STEPS if problem.field.has_edges else 1)
    most = -(-most_steps // size)
    rows, parts = room(like, size), room(progress.short(), most)

    def one(carry: tuple[Any, ...], runs: Array) -> tuple[Any, ...]:
        i, progress, saved, parts, rows, n = carry
        k = jnp.where(runs, i, most)
        parts = jax.tree.map(lambda a, v: a.at[k].set(v, mode="drop"), parts, progress.short())
        last, saved, rows = advance(method, problem, progress, saved, rows)
        n = jnp.where(runs, last.counts.steps - progress.counts.steps, n)
        return i + runs, last, saved, parts, rows, n

    zero = jnp.zeros((), jnp.int32)
    state = zero, progress, saved, parts, rows, zero
    state = (
        while_any(lambda s: s[1].why < 0, one, state) if most > 1 else one(state, jnp.array(True))
    )
    count, last, saved, parts, rows, n = state
    return found(problem, last, saved), RecordedSteps(
        parts, count, rows, n, (last.next, last.why == REACHED, last.t, last.x, last.d)
    )


def _size(numbers: int, problem: Integration) -> int:
    """How many steps of so many numbers are kept."""
    if problem.events is not None:
        return max(EVENT_MEMORY // numbers, FEWEST)
    small = MEMORY // numbers
    return small if small >= FEWEST else max(min(MORE_MEMORY // numbers, ENOUGH), FEWEST)


def _back(of_moved: OfMoved, own: list[Array], kept: RecordedSteps, to: LoopResult) -> list[Array]:
    """The cotangents of what moves."""
    method, problem, _ = of_moved(own)
    size, parts = len(kept.rows.t), kept.parts.t.shape[0]
    saved_behind, reached, end_t, *end = kept.end
    totals = [jnp.zeros_like(v) for v in own]
    if problem.events is None:
        last = Adjoint(None, method.adjoint(to.x), None, totals)
    else:
        left = (jnp.arange(len(problem.ts)) >= saved_behind)[:, None]
        at_end = (jnp.sum(jnp.where(left, a, 0), axis=0) for a in to.saved)
        to_x, to_d = (a + b for a, b in zip((to.x, to.d), at_end, strict=True))
        # of the state at the end, with respect to the time from the last event to there
        rest = jnp.where(reached, rates_behind(problem, end_t, *end) @ to_x, 0.0)
        totals = jax.vjp(lambda some: of_moved(some)[1].end, own)[1](rest)[0]
        last = Adjoint(to.t - rest, to_x, to_d, totals)

    def part(carry: tuple[Any, ...]) -> tuple[Any, ...]:
        """One part of the run; ``rows`` are its own only where it is the last."""
        i, rows, n, behind = carry
        progress = jax.tree.map(lambda a: a[i], kept.parts)
        then = tuple(end)
        if parts > 1:

            def again() -> tuple[Row, Array]:
                made = advance(method, problem, progress, None, rows)[2]
                assert made is not None
                return made, jnp.asarray(size, n.dtype)

            is_last = i >= kept.count - 1
            if problem.events is not None:
                following = jax.tree.map(lambda a: a[jnp.minimum(i + 1, parts - 1)], kept.parts)
                pairs = zip((following.x, following.d), end, strict=True)
                then = tuple(jnp.where(is_last, b, a) for a, b in pairs)
            rows, n = lax.cond(is_last, lambda: (rows, n), again)

        def step(carry: tuple[Array, Adjoint]) -> tuple[Array, Adjoint]:
            k, behind = carry
            row, before = (_row(rows, i) for i in (k, jnp.maximum(k - 1, 0)))
            which = jnp.where(k > 0, before.next, progress.next), row.next
            if problem.events is None:
                begin = jnp.where(k > 0, before.x, progress.x)
                if problem.first is not None:
                    again = (k > 0) & (before.kind == RESTART)
                    begin = jnp.where(again, restarted(problem, before.which)[0], begin)
                return k - 1, _through_step(of_moved, own, row, begin, to, which, behind)
            after = _row(rows, jnp.minimum(k + 1, size - 1))
            values: Any = either(k < n - 1, (after.x, after.d), then)
            through = partial(_through_event, of_moved, own, row, to, which, values)
            plain, event = (partial(through, is_event=b) for b in (False, True))
            return k - 1, lax.cond(row.kind > EDGE, event, plain, behind)

        _, before = lax.while_loop(lambda c: c[0] >= 0, step, (n - 1, behind))
        return i - 1, rows, n, before

    state = kept.count - 1, kept.rows, kept.n, last
    state = lax.while_loop(lambda s: s[0] >= 0, part, state) if parts > 1 else part(state)
    first: Adjoint = state[3]
    to_start = first.x if problem.events is not None else method.at_start(first.x)

    def begins(some: list[Array]) -> tuple[Array | None, Array, Array | None]:
        start = of_moved(some)[2]
        return None if problem.events is None else start.t, start.x, start.d

    pulled = jax.vjp(begins, own)[1]((first.t, to_start, first.d))[0]
    return [a + b for a, b in zip(first.own, pulled, strict=True)]


def _row(rows: Row, k: Array) -> Row:
    """One of the rows."""
    return jax.tree.map(lambda a: a[k], rows)


def _through_step(
    of_moved: OfMoved,
    own: list[Array],
    row: Row,
    begin: Array,
    to: LoopResult,
    which: tuple[Array, Array],
    behind: Adjoint,
) -> Adjoint:
    """The cotangents before a step of a model without events: the method knows how it has made it."""
    method, problem, _ = of_moved(own)
    if problem.first is not None:

        def restart() -> Adjoint:
            return through_restart(of_moved, own, row, behind, method.at_start(behind.x))

        behind = lax.cond(row.kind == RESTART, restart, lambda: behind)
    if problem.field.has_edges:
        behind = _through_edge(of_moved, own, row, method.at_start(behind.x), behind)

    def held(some: list[Array]) -> Task:
        method, problem, start = of_moved(some)
        there = problem.held(None, stop_at(problem, row.ahead))
        if problem.field.has_edges:
            there = there.sided(row.t, next_edge(there, row.t))
        return method, there, start

    x, by_own = method.back(held, own, row, begin, behind.x, to.saved[0], which)
    return behind._replace(x=x, own=[a + b for a, b in zip(behind.own, by_own, strict=True)])


def _through_edge(
    of_moved: OfMoved, own: list[Array], row: Row, to_x: Array, behind: Adjoint
) -> Adjoint:
    """What the time of a jump of the right-hand side moves: the state behind it, by the difference of both sides."""
    _, problem, _ = of_moved(own)
    fixed, end = without_derivatives(problem), row.t + row.h
    apart = fixed.apart(end)

    def jump() -> list[Array]:
        before, after = (fixed.field(end + side * apart, row.x) for side in (-2.0, 2.0))

        def instant(some: list[Array]) -> Array:
            return next_edge(of_moved(some)[1], row.t)

        return jax.vjp(instant, own)[1](to_x @ (before - after))[0]

    nothing = lambda: [jnp.zeros_like(v) for v in own]  # noqa: E731
    by_own = lax.cond(row.kind == EDGE, jump, nothing)
    return behind._replace(own=[a + b for a, b in zip(behind.own, by_own, strict=True)])


def _through_event(
    of_moved: OfMoved,
    own: list[Array],
    row: Row,
    to: LoopResult,
    which: tuple[Array, Array],
    then: tuple[Array, Array],
    behind: Adjoint,
    *,
    is_event: bool,
) -> Adjoint:
    """The cotangents before a step whose ends may move, from those behind it.

    ``which`` of the states saved lie in it; ``then`` are the values behind the event at its end.
    """

    def again(own: list[Array], t: Array, x: Array, d: Array) -> tuple[Any, ...]:
        method, problem, _ = of_moved(own)
        end = reach(method, problem, row, t, x, d, is_event=is_event)
        return end.t, end.x, end.dense, t, end.h

    (stop, end, dense, t, h), pull = jax.vjp(again, own, row.t, row.x, row.d)
    if is_event:
        behind = through_event(of_moved, own, row, Reach(stop, end, h, dense), then, behind)
    method, problem, _ = of_moved(own)

    def add(state: tuple[Any, ...]) -> tuple[Any, ...]:
        j, total, of_d = state
        inside = lambda dense, t, h: method.between(dense, t, h, problem.ts[j])  # noqa: E731
        pulled = jax.vjp(inside, dense, t, h)[1](to.saved[0][j])
        return j + 1, jax.tree.map(jnp.add, total, pulled), of_d + to.saved[1][j]

    state = which[0], *jax.tree.map(jnp.zeros_like, ((dense, t, h), behind.d))
    if len(problem.ts):
        state = lax.while_loop(lambda s: s[0] < which[1], add, state)
    _, (to_dense, to_begin, to_h), saved_d = state
    by_own, to_t, to_x, to_d = pull((behind.t, behind.x, to_dense, to_begin, to_h))
    totals = [a + b for a, b in zip(behind.own, by_own, strict=True)]
    return Adjoint(to_t, to_x, to_d + behind.d + saved_d, totals)
