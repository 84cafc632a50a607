"""Losses: how far a predicted sequence is from the measured one."""

from __future__ import annotations

from collections.abc import Callable

import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal.errors import TrainingError, nearest

Loss = Callable[
    [Float[Array, "M k"], Float[Array, "M k"], Float[Array, " k"]],
    Float[Array, ""],
]
"""(predicted, measured, sigma) -> scalar, for M points of k targets."""


def nrmse(
    predicted: Float[Array, "M k"], measured: Float[Array, "M k"], sigma: Float[Array, " k"]
) -> Float[Array, ""]:
    """Normalised root mean square error, the paper's (21): ``sqrt(1/M Σ_i Σ_j ((q_ij − q̂_ij)/σ_j)²)``.

    It sums over the targets: a prediction of the mean alone has the loss √k for k targets.
    """
    squares = jnp.sum(((predicted - measured) / sigma) ** 2, axis=1)
    return jnp.sqrt(jnp.maximum(jnp.mean(squares), jnp.finfo(squares.dtype).tiny))


def number(what: str, function: Callable[..., object], *arguments: object) -> Float[Array, ""]:
    """The number that a user's function gives.

    Raises:
        TrainingError: if it cannot be computed so, or is something else.
    """
    try:
        value = jnp.asarray(function(*arguments))
    except (TypeError, ValueError) as error:
        reason = str(error).partition("\n")[0]
        raise TrainingError(f"{what} cannot be computed: {reason}") from error
    if value.shape:
        raise TrainingError(f"{what} has the shape {value.shape}; a single number is needed.")
    return value


LOSSES: dict[str, Loss] = {"nrmse": nrmse}


def named(loss: str | Loss) -> Loss:
    """A loss from its name, or the user's own function as it is.

    Raises:
        TrainingError: for a name that is not known.
    """
    if callable(loss):
        return loss
    if loss not in LOSSES:
        raise TrainingError(f"No loss '{loss}': {nearest(loss, LOSSES)}")
    return LOSSES[loss]
