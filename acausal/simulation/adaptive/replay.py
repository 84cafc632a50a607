"""Derivatives of a run in reverse mode: its steps are made again, one by one, from the last to the first."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Int

from acausal._jax import room, while_any, with_steps
from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.adaptive.search import (
    Found,
    Progress,
    Rows,
    Start,
    advance,
    begin,
    found,
    row_like,
    saves_start,
    search,
)

Task = tuple[Any, Problem, Start]
"""Method, problem, start."""

MEMORY = 2**20
"""Numbers that the steps of a run may take in memory before it is made part by part again: 8 MB.

All of it is written once for every derivative, which takes longer than the steps of a small model do.
"""

FEWEST = 512
"""Steps that are kept in any case, of however many states."""

MORE_MEMORY, ENOUGH = 2**24, 1536
"""Numbers that this many steps may take where `MEMORY` has no room for the fewest: such a model's steps take longer."""


class Steps(eqx.Module):
    """The steps that a run has made.

    Attributes:
        parts: where each part of the run began, with a leading axis. count: how many parts there are.
        rows: the steps of the last part. n: how many.
    """

    parts: Progress
    count: Int[Array, ""]
    rows: Rows
    n: Int[Array, ""]


def reverse(method: Any, problem: Problem, start: Start, *, until_stiff: bool = False) -> Found:
    """`search`, with derivatives in reverse mode.

    The states of all steps are kept, as far as there is room (`_size`). Of a longer run they are kept part by part:
    the derivative makes each part again from its start.
    """
    return with_steps(
        (method, problem, start),
        lambda task: search(*task, until_stiff=until_stiff),
        lambda task: _kept(task, until_stiff),
        partial(_back, until_stiff),
    )


def _kept(task: Task, until_stiff: bool) -> tuple[Found, Steps]:
    """The result of a run, and its steps."""
    method, problem, start = task
    progress, saved = begin(method, problem, start)
    like = row_like(method, problem, progress)
    numbers = sum(a.size for a in jax.tree.leaves(like))
    size = min(problem.max_steps, _size(numbers))
    most = -(-problem.max_steps // size)
    rows, parts = room(like, size), room(progress, most)

    def one(carry: tuple[Any, ...], runs: Array) -> tuple[Any, ...]:
        i, progress, saved, parts, rows, n = carry
        k = jnp.where(runs, i, most)
        parts = jax.tree.map(lambda a, v: a.at[k].set(v, mode="drop"), parts, progress)
        last, saved, rows = advance(method, problem, progress, saved, rows, until_stiff=until_stiff)
        n = jnp.where(runs, last.counts.steps - progress.counts.steps, n)
        return i + runs, last, saved, parts, rows, n

    zero = jnp.zeros((), jnp.int32)
    state = zero, progress, saved, parts, rows, zero
    state = (
        while_any(lambda s: s[1].why < 0, one, state) if most > 1 else one(state, jnp.array(True))
    )
    count, last, saved, parts, rows, n = state
    return found(last, saved), Steps(parts, count, rows, n)


def _size(numbers: int) -> int:
    """How many steps of so many numbers are kept."""
    small = MEMORY // numbers
    return small if small >= FEWEST else max(min(MORE_MEMORY // numbers, ENOUGH), FEWEST)


def _row(rows: Rows, k: Array) -> Any:
    """One of the rows."""
    return jax.tree.map(lambda a: a[k], rows)


def _back(
    until_stiff: bool,
    of_moved: Callable[[list[Array]], Task],
    own: list[Array],
    kept: Steps,
    to: Found,
) -> list[Array]:
    """The cotangents of what moves."""
    to_saved, to_last = to.saved, to.x
    method, problem, start = of_moved(own)
    size, parts = len(kept.rows.t), kept.parts.t.shape[0]

    def part(carry: tuple[Any, ...]) -> tuple[Any, ...]:
        """One part of the run; ``rows`` are its own only where it is the last."""
        i, rows, n, *sums = carry
        progress = jax.tree.map(lambda a: a[i], kept.parts)
        if parts > 1:

            def again() -> tuple[Rows, Array]:
                made = advance(method, problem, progress, None, rows, until_stiff=until_stiff)[2]
                assert made is not None
                return made, jnp.asarray(size, n.dtype)

            rows, n = lax.cond(i < kept.count - 1, again, lambda: (rows, n))

        def step(carry: tuple[Any, ...]) -> tuple[Any, ...]:
            k, adjoint, totals, to_first = carry
            row, before = _row(rows, k), _row(rows, jnp.maximum(k - 1, 0))
            begin = jnp.where(k > 0, before.x, progress.x)
            if problem.first is not None:
                begin = jnp.where(row.begins >= 0, problem.first[row.begins], begin)
            which = jnp.where(k > 0, before.next, progress.next), row.next
            adjoint, by_own = method.back(of_moved, own, row, begin, adjoint, to_saved, which)
            if to_first is not None:  # where another run began, the one before feels nothing of it
                at_first = jnp.where(row.begins >= 0, method.at_start(adjoint), 0)
                to_first = to_first.at[row.begins].add(at_first)
                adjoint = jnp.where(row.begins >= 0, 0, adjoint)
            totals = [a + b for a, b in zip(totals, by_own, strict=True)]
            return k - 1, adjoint, totals, to_first

        _, *sums = lax.while_loop(lambda c: c[0] >= 0, step, (n - 1, *sums))
        return i - 1, rows, n, *sums

    totals = [jnp.zeros_like(v) for v in own]
    to_first = None if problem.first is None else jnp.zeros_like(problem.first)
    state = kept.count - 1, kept.rows, kept.n, method.adjoint(to_last), totals, to_first
    state = lax.while_loop(lambda s: s[0] >= 0, part, state) if parts > 1 else part(state)
    adjoint, totals, to_first = state[3:]
    to_start = method.at_start(adjoint)
    if len(to_saved):
        to_start = to_start + jnp.where(saves_start(problem, start), to_saved[0], 0)

    def states(some: list[Array]) -> tuple[Array, Array | None]:
        _, problem, start = of_moved(some)
        return start.x, problem.first

    pulled = jax.vjp(states, own)[1]((to_start, to_first))[0]
    return [a + b for a, b in zip(totals, pulled, strict=True)]
