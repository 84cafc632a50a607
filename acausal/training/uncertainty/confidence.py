"""Confidence: how well the record determines learned laws and parameters.

A law is given the freedom to change by small bumps over what it has seen; parameters may change, too, and so may the
state at the start where it was trained. The sensitivity of the whole simulation to all of them gives the Fisher
information, and its inverse their covariance: a Laplace approximation in the space of functions, independent of how
many weights a network has. What of a law is narrower than a bump, half a standard deviation of its input, does not
show. Samples whose residuals are alike count for less than one each.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.scipy.special import erf
from scipy.linalg import solve_triangular

from acausal.errors import TrainingError
from acausal.networks import EnergyLaw, law_of, output_scale
from acausal.training.objective.problem import Problem, Trainable, modified
from acausal.training.optimizers.gradients import by_each
from acausal.training.uncertainty.residuals import correlation_time

BUMPS, REACH = 12, 3.0
"""Bumps of each law, evenly over so many sigmas of its inputs to either side."""

POINTS = 201
"""Points of a band."""

ALIKE = 0.98
"""Correlation from which on the data can't tell two parameters apart."""

UNKNOWN = 0.9
"""Part of what was believed before there were data that a standard deviation is where they tell nothing."""

SLOW = 2.0
"""Samples that are alike from which on residuals are called correlated."""

ROUNDING = 1e-12
"""Least noise that is taken for possible, relative to a target's standard deviation."""


class Bumped(eqx.Module):
    """A network whose law may change by bumps of its first argument, ``F(x) + Σ a_k exp(−(x − c_k)²/2w²)``."""

    net: Any
    heights: Array
    centres: Array
    width: Array

    def __call__(self, *inputs: Any) -> Array:
        """The law, or the energy whose slope it is."""
        shapes = self.areas if isinstance(self.net, EnergyLaw) else self.bumps
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

    Attributes:
        laws: by network, the law and its standard deviation.
        parameters: by name, the standard deviation of trained parameters, relative to their values, or absolute
            where `Fit.modifiers` is.
        correlation: between the parameters, in their order, shape (parameters, parameters).
        noise: standard deviation of what is left over, by target.
        alike: by target, how many neighbouring samples of what is left over tell as much as one; 1 for white noise.
        about: what is to be said of the parameters, one sentence each.
    """

    laws: dict[str, Band]
    parameters: dict[str, float]
    correlation: np.ndarray
    noise: dict[str, float]
    alike: dict[str, float]
    about: tuple[str, ...]

    def words(self) -> list[str]:
        """What all this means, sentence by sentence."""
        names = list(self.parameters)
        together = [
            f"The data can hardly tell '{names[i]}' from '{names[j]}' (correlation {self.correlation[i, j]:+.3f}): "
            "only a combination of the two is known well; fix one, or measure more."
            for i in range(len(names))
            for j in range(i)
            if abs(self.correlation[i, j]) > ALIKE
        ]
        slow = [
            f"What is left over of '{n}' is alike over {count:.0f} samples, which count as one here. If the "
            "model lacks something, it is further off than its deviations say: see fit.residuals()."
            for n, count in self.alike.items()
            if count > SLOW
        ]
        return [*self.about, *together, *slow]

    def __repr__(self) -> str:
        return "\n".join(
            ("Confidence of " + ", ".join((*self.laws, *self.parameters)), *self.words())
        )


def confidence(problem: Problem, trainable: Trainable, seen: dict[str, np.ndarray]) -> Confidence:
    """How well a record determines what was trained on it.

    The residuals of a target that are alike over τ neighbouring samples have at low frequencies τ times the spectrum of
    white noise, so that each sample counts 1/τ.

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
    heights = [np.full(BUMPS, output_scale(params[n])) for n in laws]
    prior, moves = _prior(problem, params), np.ones(_moves(trainable))
    believed = np.concatenate([*heights, prior, moves])
    ends = np.cumsum([BUMPS * len(laws), len(names)]).tolist()

    def changed(z: Array) -> tuple[Trainable, dict[str, Any]]:
        bumps, changes, moves = jnp.split(scale * z, ends)
        nets = {
            n: eqx.tree_at(lambda b: b.heights, bumped[n], bumps[k * BUMPS : (k + 1) * BUMPS])
            for k, n in enumerate(laws)
        }
        new = problem.modifiers.changed({**params, **nets}, dict(zip(names, changes, strict=True)))
        return _moved(trainable, moves), new

    scale = jnp.asarray(believed)
    left, slopes = _sensitivity(problem, changed, len(believed))
    if not (np.isfinite(left).all() and np.isfinite(slopes).all()):
        raise TrainingError(
            "The trained model diverges over the record; nothing can be said of it."
        )
    noise = np.sqrt(np.mean(left**2, axis=0))
    alike = np.array([correlation_time(column) for column in left.T])
    least = np.maximum(noise, ROUNDING * np.asarray(problem.record.sigma)) * np.sqrt(alike)
    weighted = (slopes / least[:, None]).reshape(-1, len(believed))
    samples = float(np.sum(len(left) / alike))
    covariance = _covariance(weighted, samples) * np.outer(believed, believed)
    own = covariance[ends[0] : ends[1], ends[0] : ends[1]]
    sigma = np.sqrt(np.diag(own))
    bands = {
        n: _band(params[n], bumped[n], covariance[k : k + BUMPS, k : k + BUMPS], seen[n])
        for n, k in zip(laws, range(0, ends[0], BUMPS), strict=True)
    }
    return Confidence(
        bands,
        dict(zip(names, sigma.tolist(), strict=True)),
        own / np.maximum(np.outer(sigma, sigma), 1e-300),
        dict(zip(problem.targets, noise.tolist(), strict=True)),
        dict(zip(problem.targets, alike.tolist(), strict=True)),
        _about(problem, trainable, sigma, prior),
    )


def _about(
    problem: Problem, trainable: Trainable, sigma: np.ndarray, prior: np.ndarray
) -> tuple[str, ...]:
    """How well each parameter is known, one sentence each."""
    at_limit = problem.modifiers.at_limit(modified(problem, trainable), problem.system.unit)

    def one(name: str, sigma: float, prior: float) -> str:
        if name in at_limit:
            return f"{at_limit[name]} How well it is known cannot be said."
        if sigma > UNKNOWN * prior:
            return f"The data tell nothing of '{name}'; leave it as it was, or measure what depends on it."
        told = problem.modifiers.told(name, sigma, ".2g", problem.system.unit(name))
        return f"'{name}' is known to ±{told} (one sigma)."

    rows = zip(problem.modifiers.names, sigma.tolist(), prior.tolist(), strict=True)
    return tuple(one(*row) for row in rows)


def _prior(problem: Problem, params: dict[str, Any]) -> np.ndarray:
    """By how much parameters are believed to be off: as seen from where they began or came to, whichever is more."""
    rows = zip(
        problem.modifiers.names, problem.modifiers.kinds, problem.modifiers.values, strict=True
    )
    return np.array(
        [max(kind.believed(float(v)) for v in (start, params[n])) for n, kind, start in rows]
    )


def _moves(trainable: Trainable) -> int:
    """How many numbers say where the record starts."""
    return 0 if trainable.states is None else trainable.states.shape[1]


def _moved(trainable: Trainable, moves: Array) -> Trainable:
    """The same with another state at the record's start."""
    if trainable.states is None:
        return trainable
    return replace(trainable, states=trainable.states.at[0].add(moves))


def _covariance(slopes: np.ndarray, samples: float) -> np.ndarray:
    """The covariance of n numbers with a standard deviation of 1 before there were data, shape (n, n).

    Residuals are smaller than the noise by what so many numbers have followed of it: as many as the data determine.

    Arguments:
        slopes: of all predictions, in standard deviations of what is left over, shape (rows, n).
        samples: how many independent ones these are.
    """
    determined = slopes.shape[1] - float(np.trace(_inverse(slopes)))
    grown = samples / max(samples - determined, 1.0)
    return _inverse(slopes / np.sqrt(max(grown, 1.0)))


def _inverse(slopes: np.ndarray) -> np.ndarray:
    """``(JᵀJ + 1)⁻¹`` for slopes J, by QR decomposition: JᵀJ would lose twice as many digits."""
    count = slopes.shape[1]
    triangle = np.linalg.qr(np.concatenate([slopes, np.eye(count)]), mode="r")
    inverse = solve_triangular(triangle, np.eye(count))
    return inverse @ inverse.T


def _bumped(network: Any, seen: np.ndarray) -> Bumped:
    first = seen[:, 0]
    spread = float(first.std()) or 1.0
    centres = first.mean() + spread * np.linspace(-REACH, REACH, BUMPS)
    width = jnp.asarray(centres[1] - centres[0])
    return Bumped(network, jnp.zeros(BUMPS), jnp.asarray(centres), width)


def _sensitivity(
    problem: Problem, changed: Callable[[Array], tuple[Trainable, dict[str, Any]]], count: int
) -> tuple[np.ndarray, np.ndarray]:
    """What is left over, shape (N, targets), and the slopes of the predictions, shape (N, targets, count)."""

    @eqx.filter_jit
    def run(problem: Problem) -> tuple[Array, Array]:
        def predicted(z: Array) -> Array:
            return problem.predict(*changed(z))

        at, slopes = by_each(predicted, jnp.zeros(count), axis=-1)
        return problem.record.y - at, slopes

    left, slopes = run(problem)
    return np.asarray(left), np.asarray(slopes)


def _band(network: Any, bumped: Bumped, covariance: np.ndarray, seen: np.ndarray) -> Band:
    x = np.linspace(float(bumped.centres[0]), float(bumped.centres[-1]), POINTS)
    rest = seen[:, 1:].mean(axis=0)
    law = jax.vmap(lambda v: law_of(network)(v, *rest))(jnp.asarray(x))
    shapes = np.asarray(jax.vmap(bumped.bumps)(jnp.asarray(x)))
    variance = np.einsum("pk,kl,pl->p", shapes, covariance, shapes)
    law = np.asarray(law)
    return Band(x, law if law.ndim == 1 else law[:, 0], np.sqrt(np.maximum(variance, 0.0)))
