"""Losses: how far predicted samples are from the measured ones."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.data import noise_level
from acausal.errors import TrainingError, known_name
from acausal.training.objective.error_laws import LAWS, ErrorLaw
from acausal.training.objective.records import Records

Loss = Callable[..., Float[Array, ""]]
"""(predicted, measured, sigma, weight) -> scalar, for M points of k targets; a user's own may leave out the weight."""

LEAST = 1e-3
"""The least noise of a target that is reckoned with, relative to its standard deviation."""


def nrmse(
    predicted: Float[Array, "M k"],
    measured: Float[Array, "M k"],
    sigma: Float[Array, " k"],
    weight: Float[Array, "M k"] | None = None,
) -> Float[Array, ""]:
    """Normalised root mean square error, the paper's (21): ``sqrt(1/M Σ_i Σ_j ((q_ij − q̂_ij)/σ_j)²)``.

    It sums over the targets: a prediction of the mean alone has the loss √k for k targets. Of each target only the
    samples that are measured count.
    """
    squares = ((predicted - measured) / sigma) ** 2
    if weight is None:
        weight = jnp.ones_like(squares)
    return root(jnp.sum(mean_of(squares, weight)))


def mean_of(terms: Float[Array, "M k"], weight: Float[Array, "M k"]) -> Float[Array, " k"]:
    """The weighted mean over the points, by target; zero for one without any.

    Only the ratios of all weights matter: a target with twice the weights of the others counts twice.
    """
    counts = jnp.sum(weight > 0, axis=0)
    total = counts * (jnp.sum(weight) / jnp.maximum(jnp.sum(counts), 1))
    return jnp.sum(terms * weight, axis=0) / jnp.where(total > 0, total, 1.0)


def root(square: Float[Array, ""]) -> Float[Array, ""]:
    """A square root whose derivative at zero is finite."""
    return jnp.sqrt(jnp.maximum(square, jnp.finfo(square.dtype).tiny))


def noise_of(
    records: Records, predicted: Float[Array, "N n_targets"] | None = None
) -> Float[np.ndarray, " n_targets"]:
    """By target, the standard deviation of white noise in its samples; at most, where there is other noise.

    Jumps and kinks of a target look like noise. With the predictions of a model, the residuals count where they have
    less of it: they lack the jumps that the model explains.
    """
    measured, of = records.measured, np.asarray(records.of)
    rows = [of == k for k in range(records.count)]
    times = [np.asarray(records.steps.t)[own] for own in rows]

    def level(signal: Float[np.ndarray, " N"]) -> float:
        return noise_level([signal[own] for own in rows], times)

    found = np.array([level(signal) for signal in measured.T])
    if predicted is None or not np.isfinite(np.asarray(predicted)).all():
        return found
    return np.minimum(found, [level(left) for left in (measured - np.asarray(predicted)).T])


def noise_loss(records: Records, predicted: Float[Array, "N n_targets"] | None = None) -> float:
    """The loss of a model that leaves nothing but this noise, for losses that are root mean squares.

    Records without noise, as simulated ones, count as if they had a little: to explain more of them is worth no time.
    """
    noise = noise_of(records, predicted) / np.asarray(records.sigma)
    return float(max(np.sqrt(np.sum(noise**2)), LEAST * np.sqrt(len(noise))))


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


def named(loss: str | Loss | ErrorLaw, targets: Sequence[str]) -> Loss:
    """The loss of some targets, from its name, a law of errors, or the user's own function.

    Raises:
        TrainingError: for a name that is not known, or a level of noise of no target.
    """
    if isinstance(loss, ErrorLaw):
        return loss.of(targets)
    if callable(loss):
        return loss if _takes_weights(loss) else WithoutWeights(loss)
    if loss in LAWS:
        return LAWS[loss]().of(targets)
    return LOSSES[known_name(loss, (*LOSSES, *LAWS), "No loss", TrainingError)]


@dataclass(frozen=True)
class WithoutWeights:
    """A user's loss of (predicted, measured, sigma): what is not measured counts as predicted without error."""

    loss: Callable[..., Any]

    def __call__(
        self,
        predicted: Float[Array, "M k"],
        measured: Float[Array, "M k"],
        sigma: Float[Array, " k"],
        weight: Float[Array, "M k"],
    ) -> Any:
        """The loss."""
        return self.loss(predicted, jnp.where(weight > 0, measured, predicted), sigma)


def _takes_weights(loss: Callable[..., Any]) -> bool:
    try:
        parameters = inspect.signature(loss).parameters.values()
    except (TypeError, ValueError):
        return False
    if any(p.kind is p.VAR_POSITIONAL for p in parameters):
        return True
    return sum(p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD) for p in parameters) > 3
