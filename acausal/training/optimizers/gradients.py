"""Slopes: the gradient of a batch's loss, and its curvature where an optimizer asks for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array
from jax.flatten_util import ravel_pytree


class Slope(eqx.Module):
    """Losses of a batch, and how their mean changes with what is trained.

    Attributes:
        losses: of every sequence, shape (B,).
        penalties: what is added, by name.
        total: what is minimised: the mean loss and all penalties.
        gradient: of the total, a pytree like what is trained.
        curvature: of the total, shape (P, P) for P numbers that are trained; ``None`` where nobody asks for it.
    """

    losses: Array
    penalties: dict[str, Array]
    total: Array
    gradient: Any
    curvature: Array | None = None


Slopes = Callable[[Any, Any, Any], Slope]
"""(problem, trainable, batch) -> slope."""


def total(problem: Any, trainable: Any, batch: Any) -> tuple[Array, tuple[Array, dict[str, Array]]]:
    """What is minimised; the losses and penalties that it is made of."""
    losses = problem.losses(trainable, batch)
    penalties = problem.penalties(trainable)
    return jnp.average(losses, weights=batch.weight) + _sum(penalties), (losses, penalties)


def gradients(problem: Any, trainable: Any, batch: Any) -> Slope:
    """The gradient alone, in reverse mode."""
    evaluate = jax.value_and_grad(lambda tree: total(problem, tree, batch), has_aux=True)
    (value, (losses, penalties)), gradient = evaluate(trainable)
    return Slope(losses, penalties, value, gradient)


def by_each(function: Callable[[Array], Array], at: Array, axis: int) -> tuple[Array, Array]:
    """A function's value, and its slopes by each of the numbers that it is of, in forward mode; ``axis`` is theirs."""

    def push(direction: Array) -> tuple[Array, Array]:
        return jax.jvp(function, (at,), (direction,))

    return jax.vmap(push, out_axes=(None, axis))(jnp.eye(len(at)))


def curvatures(problem: Any, trainable: Any, batch: Any) -> Slope:
    """The gradient, and the curvature that the loss has by the slopes of the predictions alone, in forward mode.

    That is the matrix of Gauss and Newton: predictions are taken to be linear in what is trained. A loss ℓ counts as
    ½ℓ², over ℓ. For root mean squares this is a sum of squares, and a better model of ℓ than its own curvature,
    which vanishes towards the minimum.
    """
    flat, unravel = ravel_pytree(trainable)

    def penalty(z: Array) -> Array:
        return _sum(problem.penalties(unravel(z)))

    predicted, rows = by_each(lambda z: problem.predictions(unravel(z)), flat, axis=1)
    loss, gradient, curvature = jax.tree.map(
        lambda each: jnp.mean(each, axis=0),
        jax.vmap(lambda y, slopes: _of_loss(problem.compare, y, slopes))(predicted, rows),
    )
    penalties = problem.penalties(trainable)
    if penalties:
        gradient += jax.grad(penalty)(flat)
        curvature += jax.hessian(penalty)(flat)
    return Slope(loss[None], penalties, loss + _sum(penalties), unravel(gradient), curvature)


def _of_loss(
    loss: Callable[[Array], Array], predicted: Array, slopes: Array
) -> tuple[Array, Array, Array]:
    """The loss of predictions, its gradient and curvature by what has these slopes of them in its leading axis."""
    value, by_prediction = jax.value_and_grad(loss)(predicted)

    def bend(direction: Array) -> Array:
        half = jax.grad(lambda y: 0.5 * loss(y) ** 2)
        return jax.jvp(half, (predicted,), (direction,))[1]

    rows = slopes.reshape(len(slopes), -1)
    bends = jax.vmap(bend)(slopes).reshape(len(slopes), -1)
    return value, rows @ by_prediction.ravel(), rows @ bends.T / value


def _sum(penalties: dict[str, Array]) -> Array:
    return sum(penalties.values(), jnp.zeros(()))
