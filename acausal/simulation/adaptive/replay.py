"""Derivatives of a run in reverse mode: its steps are made again, one by one, from the last to the first."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jax.custom_derivatives import SymbolicZero
from jaxtyping import Array, Bool, Float, Int, PyTree

from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.adaptive.search import Found, Rows, Start, search

Task = tuple[Any, Problem, Start]
"""Method, problem, start."""


class Kept(eqx.Module):
    """What the derivative needs.

    Attributes:
        values: all arrays of the task. moved: those whose derivatives are needed.
        rows: the steps. n: how many. last: the state after them.
        is_saved: whether the first state is among those saved.
    """

    values: list[Array]
    rows: Rows
    n: Int[Array, ""]
    last: Float[Array, " n_states"]
    is_saved: Bool[Array, ""]
    moved: tuple[bool, ...] = eqx.field(static=True)


def reverse(
    method: Any, problem: Problem, start: Start, *, until_stiff: bool = False
) -> Found:
    """`search`, with derivatives in reverse mode."""
    arrays, fixed = eqx.partition((method, problem, start), eqx.is_array)
    leaves, tree = jax.tree.flatten(arrays)

    def given(leaves: list[Array]) -> Task:
        return eqx.combine(jax.tree.unflatten(tree, leaves), fixed)

    @jax.custom_vjp
    def run(leaves: list[Array]) -> Found:
        return search(*given(leaves), until_stiff=until_stiff)[0]

    def keep(leaves: list[Any]) -> tuple[Found, Kept]:
        values = [leaf.value for leaf in leaves]
        moved = tuple(
            bool(leaf.perturbed) and jnp.issubdtype(leaf.value.dtype, jnp.inexact)
            for leaf in leaves
        )
        method, problem, start = given(values)
        found, rows = search(
            method, problem, start, until_stiff=until_stiff, rows=problem.max_steps
        )
        assert rows is not None
        saved = (
            (start.next == 0) & (problem.ts[0] <= start.t)
            if len(problem.ts)
            else jnp.array(False)
        )
        return found, Kept(values, rows, found.counts.steps, found.x, saved, moved)

    def back(kept: Kept, cotangents: Found) -> tuple[list[Array | None]]:
        def of_moved(some: list[Array]) -> Task:
            filled = iter(some)
            return given(
                [next(filled) if m else v for v, m in zip(kept.values, kept.moved, strict=True)]
            )

        found = iter(_back(of_moved, kept, _filled(cotangents.saved), _filled(cotangents.x)))
        return ([next(found) if m else None for m in kept.moved],)

    run.defvjp(keep, back, symbolic_zeros=True)
    return run(leaves)


def _filled(cotangent: Any) -> Array:
    if isinstance(cotangent, SymbolicZero):
        return jnp.zeros(cotangent.shape, cotangent.dtype)
    return cotangent


def _back(
    of_moved: Callable[[list[Array]], Task],
    kept: Kept,
    to_saved: Float[Array, "n_saved n_states"],
    to_last: Float[Array, " n_states"],
) -> list[Array]:
    """The cotangents of what moves."""
    own = [v for v, m in zip(kept.values, kept.moved, strict=True) if m]
    method, _, start = of_moved(own)
    rows = kept.rows
    begin = start.next + kept.is_saved

    def body(carry: tuple[Array, PyTree, list[Array]]) -> tuple[Array, PyTree, list[Array]]:
        k, adjoint, totals = carry
        first = jnp.where(k > 0, rows.next[jnp.maximum(k - 1, 0)], begin)
        which = first, rows.next[k]
        end = jnp.where(k + 1 < kept.n, rows.x[jnp.minimum(k + 1, len(rows.t) - 1)], kept.last)
        row = jax.tree.map(lambda a: a[k], rows)
        adjoint, by_own = method.back(of_moved, own, row, end, adjoint, to_saved, which)
        return k - 1, adjoint, [a + b for a, b in zip(totals, by_own, strict=True)]

    totals = [jnp.zeros_like(v) for v in own]
    begun = kept.n - 1, method.adjoint(to_last), totals
    _, adjoint, totals = lax.while_loop(lambda c: c[0] >= 0, body, begun)
    to_start = method.at_start(adjoint)
    if len(to_saved):
        to_start = to_start + jnp.where(kept.is_saved, to_saved[0], 0)
    _, pull = jax.vjp(lambda some: of_moved(some)[2].x, own)
    return [a + b for a, b in zip(totals, pull(to_start)[0], strict=True)]
