"""Confidence: how well the record determines learned laws and parameters.

A law is given the freedom to change by small bumps over what it has seen; parameters may change, too. The sensitivity
of the whole simulation to all of them gives the Fisher information, and its inverse their covariance: a Laplace
approximation in the space of functions, independent of how many weights a network has.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.scipy.special import erf

from acausal.errors import TrainingError
from acausal.networks.scaled import Potential, law_of
from acausal.neural import output_scale
from acausal.training.modifiers import Modifiers
from acausal.training.problem import Problem, Trainable

BUMPS, REACH = 12, 3.0
"""Bumps of each law, evenly over so many sigmas of its inputs to either side."""

POINTS = 201
"""Points of a band."""

ALIKE = 0.98
"""Correlation from which on the data can't tell two parameters apart."""


class Bumped(eqx.Module):
    """A network whose law may change by bumps of its first argument, ``F(x) + Σ a_k exp(−(x − c_k)²/2w²)``."""

    net: Any
    heights: Array
    centres: Array
    width: Array

    def __call__(self, *inputs: Any) -> Array:
        """The law, or the energy whose slope it is."""
        shapes = self.areas if isinstance(self.net, Potential) else self.bumps
        return self.net(*inputs) + jnp.sum(self.heights * shapes(inputs[0]))

    def bumps(self, x: Array) -> Array:
        """The bumps at x, shape (number of bumps,)."""
        return jnp.exp(-0.5 * ((x - self.centres) / self.width) ** 2)

    def areas(self, x: Array) -> Array:
        """The energies whose slopes they are, likewise."""
        z = (x - self.centres) / self.width
        return self.width * jnp.sqrt(jnp.pi / 2) * erf(z / jnp.sqrt(2.0))


@dataclass(frozen=True, eq=False)
class Band:
    """A learned law over its first argument, or a prediction over time, with its standard deviation.

    Attributes:
        x, law, sigma: shape (points,); other arguments of a law are held at their mean.
    """

    x: np.ndarray
    law: np.ndarray
    sigma: np.ndarray


@dataclass(frozen=True, eq=False)
class Confidence:
    """What a record tells of laws and parameters.

    Standard deviations hold if what the model leaves over is white noise; `residuals` tells.

    Attributes:
        laws: by network.
        parameters: standard deviations of the trained parameters, by name: relative to their values, or absolute
            where `Fit.modifiers` is.
        correlation: between the parameters, in their order.
        noise: standard deviation of what is left over, by target.
        modifiers: how the parameters move.
    """

    laws: dict[str, Band]
    parameters: dict[str, float]
    correlation: np.ndarray
    noise: dict[str, float]
    modifiers: Modifiers

    def words(self) -> list[str]:
        """What the parameters' uncertainties mean, one sentence each."""
        names = list(self.parameters)
        told = [
            f"'{n}' is known to ±{self.modifiers.told(n, sigma, '.2g')} (one sigma)."
            for n, sigma in self.parameters.items()
        ]
        told += [
            f"The data can hardly tell '{names[i]}' from '{names[j]}' (correlation {self.correlation[i, j]:+.3f}): "
            "only a combination of the two is known well; fix one, or measure more."
            for i in range(len(names))
            for j in range(i)
            if abs(self.correlation[i, j]) > ALIKE
        ]
        return told

    def __repr__(self) -> str:
        return "\n".join(
            ("Confidence of " + ", ".join((*self.laws, *self.parameters)), *self.words())
        )


def confidence(problem: Problem, trainable: Trainable, seen: dict[str, np.ndarray]) -> Confidence:
    """How well a record determines what was trained on it.

    Arguments:
        problem: what was trained, over the whole record.
        trainable: its result.
        seen: by network, what it was called with over the record, shape (N, number of arguments).

    Raises:
        TrainingError: if the model diverges over the record.
    """
    params = problem.assemble(trainable)
    names, laws = problem.modifiers.names, problem.networks
    bumped = {n: _bumped(params[n], seen[n]) for n in laws}
    kinds = zip(problem.modifiers.kinds, names, strict=True)
    prior = [kind.believed(float(params[n])) for kind, n in kinds]
    believed = np.concatenate([np.full(BUMPS, output_scale(params[n])) for n in laws] + [prior])

    def changed(z: Array) -> dict[str, Any]:
        heights = jnp.split(z[: BUMPS * len(laws)], len(laws)) if laws else []
        nets = {
            n: eqx.tree_at(lambda b: b.heights, bumped[n], h)
            for n, h in zip(laws, heights, strict=True)
        }
        changes = dict(zip(names, z[BUMPS * len(laws) :], strict=True))
        return problem.modifiers.changed({**params, **nets}, changes)

    scale = jnp.asarray(believed)
    left, slopes = _sensitivity(problem, trainable, lambda z: changed(scale * z), len(believed))
    if not (np.isfinite(left).all() and np.isfinite(slopes).all()):
        raise TrainingError(
            "The trained model diverges over the record; nothing can be said of it."
        )
    noise = np.sqrt(np.mean(left**2, axis=0))
    weighted = (slopes / np.maximum(noise, 1e-300)[None, :, None]).reshape(-1, len(believed))
    covariance = np.linalg.inv(weighted.T @ weighted + np.eye(len(believed)))
    covariance *= believed[:, None] * believed[None, :]
    own = covariance[BUMPS * len(laws) :, BUMPS * len(laws) :]
    sigma = np.sqrt(np.diag(own))
    bands = {
        n: _band(params[n], bumped[n], covariance[k : k + BUMPS, k : k + BUMPS], seen[n])
        for n, k in zip(laws, range(0, BUMPS * len(laws), BUMPS), strict=True)
    }
    return Confidence(
        bands,
        dict(zip(names, sigma.tolist(), strict=True)),
        own / np.maximum(np.outer(sigma, sigma), 1e-300),
        dict(zip(problem.targets, noise.tolist(), strict=True)),
        problem.modifiers,
    )


def _bumped(network: Any, seen: np.ndarray) -> Bumped:
    first = seen[:, 0]
    spread = float(first.std()) or 1.0
    centres = first.mean() + spread * np.linspace(-REACH, REACH, BUMPS)
    width = jnp.asarray(centres[1] - centres[0])
    return Bumped(network, jnp.zeros(BUMPS), jnp.asarray(centres), width)


def _sensitivity(
    problem: Problem, trainable: Trainable, params: Any, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """What is left over, shape (N, targets), and the slopes of the predictions, shape (N, targets, count)."""

    @eqx.filter_jit
    def run(problem: Problem, trainable: Trainable) -> tuple[Array, Array]:
        def predicted(z: Array) -> Array:
            return problem.predict(trainable, params(z))

        at, push = jax.linearize(predicted, jnp.zeros(count))
        return problem.record.y - at, jax.vmap(push, out_axes=-1)(jnp.eye(count))

    left, slopes = run(problem, trainable)
    return np.asarray(left), np.asarray(slopes)


def _band(network: Any, bumped: Bumped, covariance: np.ndarray, seen: np.ndarray) -> Band:
    x = np.linspace(float(bumped.centres[0]), float(bumped.centres[-1]), POINTS)
    rest = seen[:, 1:].mean(axis=0)
    law = jax.vmap(lambda v: law_of(network)(v, *rest))(jnp.asarray(x))
    shapes = np.asarray(jax.vmap(bumped.bumps)(jnp.asarray(x)))
    variance = np.einsum("pk,kl,pl->p", shapes, covariance, shapes)
    law = np.asarray(law)
    return Band(x, law if law.ndim == 1 else law[:, 0], np.sqrt(np.maximum(variance, 0.0)))
