"""The method of Levenberg and Marquardt: steps to the minimum of a quadratic model, shorter where it is a bad one."""

from __future__ import annotations

from functools import cache
from typing import Any

import jax
import jax.numpy as jnp
from jax import Array
from jax.flatten_util import ravel_pytree

from acausal.training.optimizers.descent import Descent, DescentMethod

DAMPING = 1e-3
"""The first damping, relative to the largest curvature."""

GROWTH = 2.0
"""By how much damping grows at the first step in a row that did not help; at the next ones ever more."""

ENOUGH = 1e-9
"""Relative decrease of the loss, made or foreseen, below which the method is at its end."""

LEAST = 1 / 3
"""By how much it falls at most after a step that did."""


class Damped(Descent):
    """Where the method is.

    Attributes:
        curvature: at the best point, shape (P, P).
        step: from there to the trial; ``foreseen``: by how much it should lower the loss.
        damping, growth: what is added to the curvature in all directions, and by how much it grows if the step fails.
    """

    curvature: Array
    step: Array
    foreseen: Array
    damping: Array
    growth: Array


@cache
def levenberg_marquardt() -> DescentMethod:
    """Steps along ``(C + λ)⁻¹ g`` with damping λ by the ratio of the loss's decrease to the foreseen one.

    An update takes the loss (`value=...`), the gradient and the curvature (`curvature=...`) at one point. A point
    that lowers the loss is the new best; else the next trial is a shorter step from the best. So parameters between
    two updates may be worse than the best up to now. An infinite loss is taken for too long a step.

    D. Marquardt: An algorithm for least-squares estimation of nonlinear parameters, SIAM Journal 11, 1963; the damping
    is that of H. B. Nielsen: Damping parameter in Marquardt's method, Technical University of Denmark, 1999.
    """

    def init(params: Any) -> Any:
        point, _ = ravel_pytree(params)
        zero, none = jnp.zeros((), point.dtype), jnp.zeros_like(point)
        square = jnp.zeros((point.size, point.size), point.dtype)
        no = jnp.zeros((), bool)
        return Damped(
            point, jnp.full_like(zero, jnp.inf), none, no, square, none, zero, zero, zero + GROWTH
        )

    def update(updates: Any, state: Any, params: Any = None, **told: Any) -> Any:
        point, unravel = ravel_pytree(params)
        gradient, _ = ravel_pytree(updates)
        state = _judge(state, point, told["value"], gradient, told["curvature"])
        return unravel(state.point + state.step - point), state

    return DescentMethod(init, update)


def _judge(state: Damped, point: Array, value: Array, gradient: Array, curvature: Array) -> Damped:
    """The next trial: from a point that is better, or a shorter step from the best one."""
    first = ~jnp.isfinite(state.value)
    better = jnp.isfinite(value) & (first | (value < state.value))
    ratio = (state.value - value) / jnp.where(state.foreseen > 0, state.foreseen, 1.0)
    relaxed = state.damping * jnp.maximum(LEAST, 1 - (2 * ratio - 1) ** 3)
    begun = DAMPING * jnp.max(jnp.abs(jnp.diag(curvature)))
    damping = jnp.where(first, begun, jnp.where(better, relaxed, state.growth * state.damping))
    growth = jnp.where(better, GROWTH, 2 * state.growth)
    stalled = better & ~first & (state.value - value <= ENOUGH * jnp.abs(value))
    point, value, gradient, curvature = jax.tree.map(
        lambda new, old: jnp.where(better, new, old),
        (point, value, gradient, curvature),
        (state.point, state.value, state.gradient, state.curvature),
    )
    step = -jnp.linalg.solve(curvature + damping * jnp.eye(len(point)), gradient)
    step = jnp.where(jnp.isfinite(step), step, 0.0)
    foreseen = -(gradient @ step + 0.5 * step @ curvature @ step)
    converged = stalled | (jnp.isfinite(value) & (jnp.abs(foreseen) <= ENOUGH * jnp.abs(value)))
    return Damped(point, value, gradient, converged, curvature, step, foreseen, damping, growth)
