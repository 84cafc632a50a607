"""The method of Levenberg and Marquardt: steps to the minimum of a quadratic model, shorter where the model is poor.

``python -m benchmarks.optimizers`` finds seven parameters of the quarter vehicle with it and with
`optimistix.LevenbergMarquardt` (0.1.0). Both are within 1e-6 of the lowest loss after 5 to 9 updates, optimistix one or
two later; it ends after 11 to 30 updates, ours after 6 to 9. Besides, optimistix takes residuals and their Jacobian,
where this takes a gradient and a Hessian, which penalties can add to, even where the Hessian is indefinite.
"""

from __future__ import annotations

from functools import cache
from typing import Any, Protocol

import equinox as eqx
import jax
import jax.numpy as jnp
import optax
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Bool, Float, PyTree

from acausal._jax.side_by_side import either


class DescentMethod(optax.GradientTransformationExtraArgs):
    """An optimizer that compares losses of the same data, and goes back from a worse point by itself.

    Its state is a `Descent`.
    """


class Descent(eqx.Module):
    """State of a descent.

    Attributes:
        point, value: the best point up to now, and its loss (infinite before the first update).
        converged: whether no lower loss can be found.
    """

    point: Float[Array, " n"]
    value: Float[Array, ""]
    converged: Bool[Array, ""]


DAMPING = 1e-3
"""The first damping, relative to the scale of the local model."""

GROWTH = 2.0
"""Factor by which damping grows at the first rejected step in a row; it doubles with every further one."""

ENOUGH = 1e-9
"""Relative decrease of the loss, actual or predicted, below which the method has converged."""

LEAST = 1 / 3
"""Lowest factor by which damping falls after an accepted step."""


class LocalModel(Protocol):
    """A quadratic model of a loss near a point; a pytree."""

    @property
    def scale(self) -> Float[Array, ""]:
        """A damping that outweighs what the model says."""
        ...

    def trial(self, damping: Float[Array, ""]) -> tuple[Float[Array, " n"], Float[Array, ""]]:
        """The damped step to the model's minimum, and the decrease of the loss that the model expects of it."""
        ...


class Quadratic(eqx.Module):
    """A model at a point, with a matrix; its scale is the largest entry of the diagonal."""

    gradient: Float[Array, " n"]
    hessian: Float[Array, "n n"]

    @property
    def scale(self) -> Float[Array, ""]:
        """As of `LocalModel`."""
        return jnp.max(jnp.abs(jnp.diag(self.hessian)))

    def trial(self, damping: Float[Array, ""]) -> tuple[Float[Array, " n"], Float[Array, ""]]:
        """As of `LocalModel`."""
        damped = self.hessian + damping * jnp.eye(len(self.gradient))
        step = -jnp.linalg.solve(damped, self.gradient)
        step = jnp.where(jnp.isfinite(step), step, 0.0)
        return step, -(self.gradient @ step + 0.5 * step @ self.hessian @ step)


class Damped(Descent):
    """State of the method.

    Attributes:
        model: a `LocalModel` at the best point.
        step: from there to the trial; ``predicted``: the decrease of the loss that the model expects.
        damping, growth: what the next trial is damped by, and the factor by which it grows if that fails. Before the
            first update the damping is relative to the model's scale.
    """

    model: PyTree
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
        square = jnp.zeros((point.size, point.size), point.dtype)
        return before_trials(point, Quadratic(jnp.zeros_like(point), square))

    def update(updates: Any, state: Any, params: Any = None, **extra: Any) -> Any:
        point, unravel = ravel_pytree(params)
        gradient, _ = ravel_pytree(updates)
        state = after_trial(state, point, extra["value"], Quadratic(gradient, extra["hessian"]))
        return unravel(state.point + state.step - point), state

    return DescentMethod(init, update)


def before_trials(point: Float[Array, " n"], model: LocalModel, damping: float = DAMPING) -> Damped:
    """The state before the first trial, which is the point itself.

    Arguments:
        point: where to begin. model: any of the kind that `after_trial` will get.
        damping: of the first step, relative to the model's scale; 0 for a step of Gauss and Newton.
    """
    zero, none, no = jnp.zeros((), point.dtype), jnp.zeros_like(point), jnp.zeros((), bool)
    return Damped(
        point, jnp.full_like(zero, jnp.inf), no, model, none, zero, zero + damping, zero + GROWTH
    )


def after_trial(
    state: Damped, point: Float[Array, " n"], value: Float[Array, ""], model: LocalModel
) -> Damped:
    """The state after a trial: the next one starts from it where it is better, else it is a shorter step."""
    first = ~jnp.isfinite(state.value)
    better = jnp.isfinite(value) & (first | (value < state.value))
    ratio = (state.value - value) / jnp.where(state.predicted > 0, state.predicted, 1.0)
    relaxed = state.damping * jnp.maximum(LEAST, 1 - (2 * ratio - 1) ** 3)
    growth = jnp.where(better, GROWTH, 2 * state.growth)
    stalled = better & ~first & (state.value - value <= ENOUGH * jnp.abs(value))
    before = state.point, state.value, state.model
    point, value, model = either(better, (point, value, model), before)
    begun = jnp.where(better, state.damping * model.scale, state.damping)
    grown = jnp.where(state.damping > 0, state.growth * state.damping, DAMPING * model.scale)
    damping = jnp.where(first, begun, jnp.where(better, relaxed, grown))
    step, predicted = model.trial(damping)
    converged = stalled | (jnp.isfinite(value) & (jnp.abs(predicted) <= ENOUGH * jnp.abs(value)))
    return Damped(point, value, converged, model, step, predicted, damping, growth)
