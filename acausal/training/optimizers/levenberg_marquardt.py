"""The method of Levenberg and Marquardt: steps to the minimum of a quadratic model, shorter where the model is poor.

``python -m benchmarks.optimizers`` finds seven parameters of the quarter vehicle with it and with
`optimistix.LevenbergMarquardt` (0.1.0). Both are within 1e-6 of the lowest loss after 5 to 9 updates, optimistix one or
two later; it ends after 11 to 30 updates, ours after 6 to 9. Besides, optimistix takes residuals and their Jacobian,
where this takes a gradient and a Hessian, which penalties can add to, even where the Hessian is indefinite.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import jax
import jax.numpy as jnp
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Float

from acausal.training.optimizers.descent import Descent, DescentMethod

DAMPING = 1e-3
"""The first damping, relative to the largest entry of the Hessian's diagonal."""

GROWTH = 2.0
"""Factor by which damping grows at the first rejected step in a row; it doubles with every further one."""

ENOUGH = 1e-9
"""Relative decrease of the loss, actual or predicted, below which the method has converged."""

LEAST = 1 / 3
"""Lowest factor by which damping falls after an accepted step."""


class Damped(Descent):
    """State of the method.

    Attributes:
        hessian: at the best point.
        step: from there to the trial; ``predicted``: the decrease of the loss that the quadratic model expects.
        damping, growth: what is added to the Hessian's diagonal, and the factor by which it grows if the step fails.
    """

    hessian: Float[Array, "n n"]
    step: Float[Array, " n"]
    predicted: Float[Array, ""]
    damping: Float[Array, ""]
    growth: Float[Array, ""]


@cache
def levenberg_marquardt() -> DescentMethod:
    """Steps ``-(H + λ)⁻¹ g`` with a damping λ that follows the ratio of the actual to the predicted decrease.

    An update takes the loss (`value=...`), the gradient and an approximate Hessian (`hessian=...`) at one point. A
    point that lowers the loss becomes the best; otherwise the next trial is a shorter step from the best point. So the
    parameters between two updates may be worse than the best up to now. An infinite loss counts as too long a step.

    D. Marquardt: An algorithm for least-squares estimation of nonlinear parameters, SIAM Journal 11, 1963; the damping
    is that of H. B. Nielsen: Damping parameter in Marquardt's method, Technical University of Denmark, 1999.
    """

    @jax.jit
    def init(params: Any) -> Any:
        point, _ = ravel_pytree(params)
        zero, none = jnp.zeros((), point.dtype), jnp.zeros_like(point)
        square = jnp.zeros((point.size, point.size), point.dtype)
        no = jnp.zeros((), bool)
        return Damped(
            point, jnp.full_like(zero, jnp.inf), none, no, square, none, zero, zero, zero + GROWTH
        )

    def update(updates: Any, state: Any, params: Any = None, **extra: Any) -> Any:
        point, unravel = ravel_pytree(params)
        gradient, _ = ravel_pytree(updates)
        state = _after_trial(state, point, extra["value"], gradient, extra["hessian"])
        return unravel(state.point + state.step - point), state

    return DescentMethod(init, update)


def _after_trial(
    state: Damped,
    point: Float[Array, " n"],
    value: Float[Array, ""],
    gradient: Float[Array, " n"],
    hessian: Float[Array, "n n"],
) -> Damped:
    """The state after a trial: the next one starts from it where it is better, else it is a shorter step."""
    first = ~jnp.isfinite(state.value)
    better = jnp.isfinite(value) & (first | (value < state.value))
    ratio = (state.value - value) / jnp.where(state.predicted > 0, state.predicted, 1.0)
    relaxed = state.damping * jnp.maximum(LEAST, 1 - (2 * ratio - 1) ** 3)
    begun = DAMPING * jnp.max(jnp.abs(jnp.diag(hessian)))
    damping = jnp.where(first, begun, jnp.where(better, relaxed, state.growth * state.damping))
    growth = jnp.where(better, GROWTH, 2 * state.growth)
    stalled = better & ~first & (state.value - value <= ENOUGH * jnp.abs(value))
    point, value, gradient, hessian = jax.tree.map(
        lambda new, old: jnp.where(better, new, old),
        (point, value, gradient, hessian),
        (state.point, state.value, state.gradient, state.hessian),
    )
    step = -jnp.linalg.solve(hessian + damping * jnp.eye(len(point)), gradient)
    step = jnp.where(jnp.isfinite(step), step, 0.0)
    predicted = -(gradient @ step + 0.5 * step @ hessian @ step)
    converged = stalled | (jnp.isfinite(value) & (jnp.abs(predicted) <= ENOUGH * jnp.abs(value)))
    return Damped(point, value, gradient, converged, hessian, step, predicted, damping, growth)
