"""Derivatives in reverse mode of a run whose steps are kept, and made again from the last to the first."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array

from acausal._jax.differentiation import is_zero, merged, picked, scattered
from acausal._jax.side_by_side import one_by_one

Task = TypeVar("Task")
Result = TypeVar("Result")
Steps = TypeVar("Steps")
Tree = TypeVar("Tree")


class Kept(eqx.Module):
    """What the derivative needs.

    Attributes:
        values: all arrays of the task. steps: those of the run. moved: which of the arrays have derivatives.
    """

    values: list[Array]
    steps: Any
    moved: tuple[bool, ...] = eqx.field(static=True)


def room(like: Tree, n: int) -> Tree:
    """Room for n of these, side by side."""
    return jax.tree.map(lambda a: jnp.zeros((n, *a.shape), a.dtype), like)


def with_steps(
    task: Task,
    search: Callable[[Task], Result],
    keep: Callable[[Task], tuple[Result, Steps]],
    back: Callable[[Callable[[list[Array]], Task], list[Array], Steps, Result], list[Array]],
) -> Result:
    """The result of a task, with derivatives in reverse mode. Mapped, tasks are run `one_by_one`.

    Arguments:
        task: a pytree. search: its result. keep: its result, and the steps that led to it.
        back: the cotangents of what moves, by the task as a function of that, its values, the steps, and the
            cotangents of the result.
    """
    arrays, fixed = eqx.partition(task, eqx.is_array)
    leaves, tree = jax.tree.flatten(arrays)

    def given(leaves: list[Array]) -> Task:
        return eqx.combine(jax.tree.unflatten(tree, leaves), fixed)

    @jax.custom_vjp
    def run(leaves: list[Array]) -> Result:
        return one_by_one(lambda leaves: search(given(leaves)))(leaves)

    def forward(leaves: list[Any]) -> tuple[Result, Kept]:
        values = [leaf.value for leaf in leaves]
        moved = tuple(
            bool(leaf.perturbed) and jnp.issubdtype(leaf.value.dtype, jnp.inexact)
            for leaf in leaves
        )
        result, steps = one_by_one(lambda values: keep(given(values)))(values)
        return result, Kept(values, steps, moved)

    def backward(kept: Kept, cotangents: Result) -> tuple[list[Array | None]]:
        @one_by_one
        def one(values: list[Array], steps: Steps, to: Result) -> list[Array]:
            def of_moved(some: list[Array]) -> Task:
                return given(merged(values, kept.moved, some))

            return back(of_moved, picked(values, kept.moved), steps, to)

        to = jax.tree.map(_filled, cotangents, is_leaf=is_zero)
        return (scattered(kept.moved, one(kept.values, kept.steps, to)),)

    run.defvjp(forward, backward, symbolic_zeros=True)
    return run(leaves)


def _filled(cotangent: Any) -> Any:
    """A cotangent, where it is zero, too."""
    if not is_zero(cotangent):
        return cotangent
    return jnp.zeros(cotangent.shape, cotangent.dtype)
