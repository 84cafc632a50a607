"""Follow a path from a guess to a root where Newton's method alone does not find one.

The path is Newton's homotopy ``residual(z) = (1 - s) residual(guess)``: at s = 0 the guess solves it, at s = 1 a
root does. It is followed by its length, so that it may turn back in s on its way.
E. Allgower, K. Georg: Introduction to Numerical Continuation Methods, SIAM 2003, chapters 2 and 6.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

CORRECTIONS = 6
STRIDES = 400
SHORTEST = 1e-7
STRAIGHT = 0.7
"""Cosine of the largest angle between the path's directions at both ends of a stride."""
ON_PATH = 1e-6

Residual = Callable[[Any], Any]
"""From unknowns (m,) to residuals (k,)."""
Solve = Callable[[Any, Any], Any]
"""From a Jacobian (k, m) and residuals (k,) to a step (m,)."""


class _Walk(NamedTuple):
    """A point of the path (m + 1,): scaled unknowns and s; the direction there; the next stride."""

    point: Any
    direction: Any
    stride: Any
    count: Any


def homotopy(residual: Residual, guess: Any, solve: Solve, scale: Any, skipped: Any) -> Any:
    """A point near a root, the start for Newton's method; where the path leads nowhere, its last point.

    Arguments:
        solve: solves linear equations, square ones or as many as the unknowns or less.
        scale: typical magnitude of the unknowns, (m,) or one for all.
        skipped: whether not to walk at all.
    """
    unit = jnp.abs(guess) + scale
    first = residual(guess)

    def off(point: Any) -> Any:
        return residual(point[:-1] * unit) - (1 - point[-1]) * first

    def bordered(point: Any, direction: Any) -> Any:
        return jnp.concatenate([jax.jacfwd(off)(point), direction[None]])

    def corrected(point: Any, direction: Any) -> tuple[Any, Any]:
        def correct(_: int, state: Any) -> Any:
            point, _ = state
            rest = jnp.append(off(point), 0.0)
            step = solve(bordered(point, direction), rest)
            return point - step, jnp.max(jnp.abs(step))

        return jax.lax.fori_loop(0, CORRECTIONS, correct, (point, jnp.inf * point[-1]))

    def turned(point: Any, direction: Any) -> Any:
        ahead = solve(bordered(point, direction), jnp.zeros(len(first) + 1).at[-1].set(1.0))
        return ahead / jnp.sqrt(jnp.sum(ahead**2))

    def walk(w: _Walk) -> _Walk:
        point, last_step = corrected(w.point + w.stride * w.direction, w.direction)
        direction = turned(point, w.direction)
        size = 1 + jnp.max(jnp.abs(point))
        good = (last_step < ON_PATH * size) & (jnp.sum(direction * w.direction) > STRAIGHT)
        return _Walk(
            jnp.where(good, point, w.point),
            jnp.where(good, direction, w.direction),
            jnp.where(good, 1.5 * w.stride, w.stride / 3),
            w.count + 1,
        )

    def on_the_way(w: _Walk) -> Any:
        return (
            jnp.logical_not(skipped)
            & (w.point[-1] < 1)
            & (w.stride > SHORTEST)
            & (w.count < STRIDES)
        )

    start = jnp.append(guess / unit, 0.0)
    onward = jnp.zeros_like(start).at[-1].set(1.0)
    begin = _Walk(start, turned(start, onward), 0.1 + 0 * start[-1], 0)
    end = jax.lax.while_loop(on_the_way, walk, begin)
    return end.point[:-1] * unit
