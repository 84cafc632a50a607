"""The gradient of a batch's loss, and its Gauss-Newton Hessian where an optimizer needs it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Bool, Float, Int, PRNGKeyArray, PyTree

from acausal._jax import value_and_jacobian

EXPLODED = 1e15
"""The largest change of a loss, against the loss where that is above one, by a change of what is trained: numbers of
about one."""

Scalar = Float[Array, ""]


class Objective(Protocol):
    """What an optimizer can minimise: a pytree with pure functions. A trainable is a pytree of its own.

    `predictions`, `compare` and `curvature` are of whole records, and give the Gauss-Newton Hessian.
    """

    def draw(self, key: PRNGKeyArray, update: Int[Array, ""]) -> PyTree:
        """Of an update, by its key and its number, some sequences with weights and starts, such as a `Batch`."""
        ...

    def losses(self, trainable: PyTree, batch: PyTree) -> Float[Array, " batch"]:
        """The loss of every sequence of a batch."""
        ...

    def weighed(self, loss: Scalar, trainable: PyTree) -> Scalar:
        """A loss, weighed by what is known without data."""
        ...

    def penalties(self, trainable: PyTree) -> dict[str, Scalar]:
        """Terms that are added, by name."""
        ...

    def predictions(self, trainable: PyTree) -> Float[Array, "n_models n_samples n_targets"]:
        """The predictions of every model that counts."""
        ...

    def compare(self, predicted: Float[Array, "n_samples n_targets"]) -> Scalar:
        """The loss of one model's predictions."""
        ...

    def curvature(
        self, predicted: Float[Array, "n_samples n_targets"]
    ) -> Float[Array, "n_samples n_targets"] | None:
        """The second derivative of the loss by each prediction, where the loss gives it."""
        ...


class LossDerivatives(eqx.Module):
    """Losses of a batch, and the derivatives of their mean by what is trained.

    Attributes:
        losses: of every sequence.
        penalties: what is added, by name.
        total: what is minimised: the mean loss and all penalties.
        gradient: of the total, a pytree like what is trained.
        exploded: whether the gradient of a sequence is not finite.
        hessian: of the total, for P trained numbers; ``None`` where the optimizer does not need it.
    """

    losses: Float[Array, " batch"]
    penalties: dict[str, Scalar]
    total: Scalar
    gradient: PyTree
    exploded: Bool[Array, " batch"]
    hessian: Float[Array, "P P"] | None = None


Evaluate = Callable[..., LossDerivatives]
"""(objective, trainable, batch) -> losses and derivatives."""


def total(
    objective: Objective, trainable: PyTree, batch: PyTree
) -> tuple[Scalar, tuple[Float[Array, " batch"], dict[str, Scalar]]]:
    """The total to minimise; and the losses and penalties in it."""
    losses = objective.losses(trainable, batch)
    penalties = objective.penalties(trainable)
    loss = objective.weighed(jnp.average(losses, weights=batch.weight), trainable)
    return loss + _sum(penalties), (losses, penalties)


def with_gradient(objective: Objective, trainable: PyTree, batch: PyTree) -> LossDerivatives:
    """The gradient alone, in reverse mode."""
    evaluate = jax.value_and_grad(
        lambda moved: total(objective, moved[0], replace(batch, nudge=moved[1])), has_aux=True
    )
    (value, (losses, penalties)), found = evaluate((trainable, batch.nudge))
    gradient, by_start = found
    exploded = jnp.zeros(losses.shape, bool)
    if by_start is not None:
        exploded = ~jnp.isfinite(by_start).all(axis=1)
    return LossDerivatives(losses, penalties, value, gradient, exploded)


def with_gauss_newton_hessian(
    objective: Objective, trainable: PyTree, batch: PyTree
) -> LossDerivatives:
    """The gradient, and the Hessian for predictions that are linear in what is trained, in forward mode.

    This is the Hessian of Gauss and Newton. A loss ℓ counts as ½ℓ², over ℓ. For root mean squares this is a sum of
    squares, and a better model of ℓ than its own Hessian, which vanishes towards the minimum. A loss that gives its
    curvature by each prediction, as a likelihood does, has that of a weighted sum of squares.
    """
    flat, unravel = ravel_pytree(trainable)

    def penalty(z: Float[Array, " P"]) -> Scalar:
        return _sum(objective.penalties(unravel(z)))

    predicted, jacobians = value_and_jacobian(
        lambda z: objective.predictions(unravel(z)), flat, axis=1
    )
    loss, gradient, hessian = jax.tree.map(
        lambda each: jnp.mean(each, axis=0),
        jax.vmap(lambda y, jacobian: _of_loss(objective, y, jacobian))(predicted, jacobians),
    )
    mean = loss
    loss, gradient, hessian = _weighed(
        lambda loss, z: objective.weighed(loss, unravel(z)), flat, loss, gradient, hessian
    )
    penalties = objective.penalties(trainable)
    if penalties:
        gradient += jax.grad(penalty)(flat)
        hessian += jax.hessian(penalty)(flat)
    value = loss + _sum(penalties)
    exploded = ~(jnp.max(jnp.abs(gradient)) < EXPLODED * jnp.maximum(value, 1.0))
    gradient = jnp.where(exploded, jnp.nan, gradient)
    return LossDerivatives(mean[None], penalties, value, unravel(gradient), exploded[None], hessian)


def _weighed(
    weigh: Callable[[Scalar, Float[Array, " P"]], Scalar],
    z: Float[Array, " P"],
    loss: Scalar,
    gradient: Float[Array, " P"],
    hessian: Float[Array, "P P"],
) -> tuple[Scalar, Float[Array, " P"], Float[Array, "P P"]]:
    """A loss with its derivatives, after it is weighed by what is known without data."""
    if weigh(loss, z) is loss:
        return loss, gradient, hessian

    def near(step: Float[Array, " P"]) -> Scalar:
        return weigh(loss + gradient @ step + 0.5 * step @ hessian @ step, z + step)

    at = jnp.zeros_like(z)
    return near(at), jax.grad(near)(at), jax.hessian(near)(at)


def _of_loss(
    objective: Objective,
    predicted: Float[Array, "n_samples n_targets"],
    jacobian: Float[Array, "P n_samples n_targets"],
) -> tuple[Scalar, Float[Array, " P"], Float[Array, "P P"]]:
    """The loss of predictions, its gradient and Gauss-Newton Hessian, from the predictions' Jacobian."""
    loss = objective.compare
    value, by_prediction = jax.value_and_grad(loss)(predicted)
    rows = jacobian.reshape(len(jacobian), -1)
    gradient = rows @ by_prediction.ravel()
    if (curvature := objective.curvature(predicted)) is not None:
        return value, gradient, (rows * curvature.ravel()) @ rows.T

    def times_hessian(direction: Float[Array, "n_samples n_targets"]) -> Float[Array, " ..."]:
        half = jax.grad(lambda y: 0.5 * loss(y) ** 2)
        return jax.jvp(half, (predicted,), (direction,))[1]

    products = jax.vmap(times_hessian)(jacobian).reshape(len(jacobian), -1)
    return value, gradient, rows @ products.T / value


def _sum(penalties: dict[str, Scalar]) -> Scalar:
    return sum(penalties.values(), jnp.zeros(()))
