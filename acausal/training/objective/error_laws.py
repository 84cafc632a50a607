"""Likelihood losses: the laws of measurement errors, normal ones or such with outliers, and their levels.

The level of a target, the standard deviation of its errors, is given or estimated. An estimated one is where the loss
is least for the residuals at hand, in closed form for normal errors, else by a few iterations. Because the loss is
stationary there, its gradient is that of a fixed level, and nothing more needs to be trained: this holds for whole
records, Gauss-Newton steps and sequences alike. Every sequence has its own levels, as it has its own root mean square.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any

import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float

from acausal._jax import is_number
from acausal.errors import TrainingError, known_name, shown

LEAST = 1e-6
"""The smallest level that is estimated, relative to a target's standard deviation."""

ITERATIONS = 40
"""Iterations for a level; each leaves about half of what is missing in its logarithm."""

Levels = Mapping[str, float]
"""Standard deviations by target, in its unit; those of other targets are estimated."""


@dataclass(frozen=True)
class ErrorLaw(ABC):
    """How measurement errors are distributed about the model's predictions: a loss for `acausal.fit`.

    The loss is minus the log likelihood of a sample, up to a constant, of errors in standard deviations of their
    target. For one target with normal errors of unknown size it is the logarithm of the root mean square error.

    Attributes:
        noise: levels by target, in its unit; those of other targets are estimated.
    """

    noise: Levels = field(default_factory=dict[str, float], hash=False, kw_only=True)

    def __post_init__(self) -> None:
        """Check the levels, and the numbers of the law.

        Raises:
            TrainingError: for what is not a positive number.
        """
        name = type(self).__name__
        given: Any = self.noise
        if not isinstance(given, Mapping):
            raise TrainingError(
                f"{name}: noise={shown(given)}; give levels by target, such as {{'mass.a': 0.02}}."
            )
        for target, level in self.noise.items():
            if not (is_number(level) and level > 0):
                raise TrainingError(
                    f"{name}: the noise of '{target}' is {shown(level)}; "
                    "give its positive standard deviation, in the target's unit."
                )
        for each in fields(self):
            value, mend = getattr(self, each.name), each.metadata.get("mend")
            if mend and not (is_number(value) and value > 0):
                raise TrainingError(f"{name}: {each.name}={shown(value)}; {mend}")

    @abstractmethod
    def penalty(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """ρ: minus the log density of errors in units of their level; zero at zero."""

    @abstractmethod
    def weight(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """``ρ'(z)/z``: how much an error counts, compared with a small one."""

    @abstractmethod
    def balance(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """Where its mean is 1, the level is right; it grows with z, at most as z²."""

    def loss(
        self, penalty: Float[Array, " k"], given: Bool[Array, " k"]
    ) -> tuple[Float[Array, " k"], Float[Array, " k"]]:
        """The loss of a target less the logarithm of its level, from its mean penalty; and the derivative."""
        return penalty - 0.5, jnp.ones_like(penalty)

    def of(self, targets: Sequence[str]) -> LogLikelihood:
        """The loss of some targets.

        Raises:
            TrainingError: for a level of something else.
        """
        of = f"{type(self).__name__}: noise of"
        for name in self.noise:
            known_name(name, targets, of, TrainingError, ", which is not a target:")
        noise = tuple(float(self.noise[n]) if n in self.noise else None for n in targets)
        return LogLikelihood(replace(self, noise={}), noise)


@dataclass(frozen=True)
class Likelihood(ErrorLaw):
    """Normal errors: the loss of maximum likelihood, in which every sensor counts by its own noise.

    Attributes:
        noise: levels by target, in its unit; those of other targets are estimated.
    """

    def penalty(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """``z²/2``."""
        return 0.5 * z**2

    def weight(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """All count alike."""
        return jnp.ones_like(z)

    def balance(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """``z²``."""
        return z**2


@dataclass(frozen=True)
class Huber(ErrorLaw):
    """Normal errors with some outliers, which count by their size, not by its square.

    The level is the standard deviation of the errors without the outliers, estimated jointly with the rest as in P.
    Huber, E. Ronchetti: Robust Statistics, Wiley 2009, section 7.7.

    Attributes:
        delta: errors of more levels than this count as outliers; with 1.345, normal errors alone lose 5 % of their
            information.
        noise: levels by target, in its unit; those of other targets are estimated.
    """

    delta: float = field(default=1.345, metadata={"mend": "give a positive number of levels."})

    def penalty(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """``z²/2``, and ``δ|z| − δ²/2`` beyond δ."""
        inside = jnp.clip(z, -self.delta, self.delta)
        return inside * (z - 0.5 * inside)

    def weight(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """``δ/|z|`` beyond δ."""
        return self.delta / jnp.maximum(jnp.abs(z), self.delta)

    def balance(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """The square of the clipped error, relative to what it is for normal errors."""
        return jnp.clip(z, -self.delta, self.delta) ** 2 / self._expected

    def loss(
        self, penalty: Float[Array, " k"], given: Bool[Array, " k"]
    ) -> tuple[Float[Array, " k"], Float[Array, " k"]]:
        """The logarithm of Huber's joint criterion ``s (mean ρ + β/2)`` where the level s is estimated."""
        joint = penalty + 0.5 * self._expected
        value = jnp.where(given, penalty - 0.5 * self._expected, jnp.log(joint / self._expected))
        return value, jnp.where(given, 1.0, 1 / joint)

    @property
    def _expected(self) -> float:
        """β: the mean square of clipped normal errors."""
        d = float(self.delta)
        outside = math.erfc(d / math.sqrt(2))
        return 1 - outside - 2 * d * math.exp(-d * d / 2) / math.sqrt(2 * math.pi) + d * d * outside


@dataclass(frozen=True)
class Student(ErrorLaw):
    """Student's errors, of which the large ones hardly count.

    Attributes:
        nu: degrees of freedom; the fewer, the more outliers. With many, errors are normal ones.
        noise: levels by target, in its unit; those of other targets are estimated. The level is Student's scale: of
            normal errors alone, 0.8 of their standard deviation with four degrees of freedom.
    """

    nu: float = field(default=4.0, metadata={"mend": "give positive degrees of freedom."})

    def penalty(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """``(ν + 1)/2 log(1 + z²/ν)``."""
        return 0.5 * (self.nu + 1) * jnp.log1p(z**2 / self.nu)

    def weight(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """``(ν + 1)/(ν + z²)``."""
        return (self.nu + 1) / (self.nu + z**2)

    def balance(self, z: Float[Array, "M k"]) -> Float[Array, "M k"]:
        """``z² (ν + 1)/(ν + z²)``."""
        return self.weight(z) * z**2


@dataclass(frozen=True)
class LogLikelihood:
    """A law of errors as the loss of some targets.

    Attributes:
        law: without levels.
        noise: the level of every target, in its unit; ``None`` where it is estimated.
    """

    law: ErrorLaw
    noise: tuple[float | None, ...]

    def __call__(
        self,
        predicted: Float[Array, "M k"],
        measured: Float[Array, "M k"],
        sigma: Float[Array, " k"],
        weight: Float[Array, "M k"],
    ) -> Float[Array, ""]:
        """The loss."""
        levels = self.levels(predicted, measured, sigma, weight)
        penalty = self.law.penalty((predicted - measured) / levels)
        each, _ = self.law.loss(_mean(penalty, weight), self._given)
        return jnp.sum((each + jnp.log(levels / sigma)) * _shares(weight))

    def levels(
        self,
        predicted: Float[Array, "M k"],
        measured: Float[Array, "M k"],
        sigma: Float[Array, " k"],
        weight: Float[Array, "M k"],
    ) -> Float[Array, " k"]:
        """The level of every target, in its unit; derivatives see a constant."""
        given = jnp.asarray([1.0 if n is None else n for n in self.noise])
        if None not in self.noise:
            return given
        error = lax.stop_gradient((predicted - measured) / sigma)
        square = jnp.maximum(_mean(error**2, weight), LEAST**2)
        if not isinstance(self.law, Likelihood):

            def closer(_: int, square: Float[Array, " k"]) -> Float[Array, " k"]:
                mean = _mean(self.law.balance(error / jnp.sqrt(square)), weight)
                return jnp.maximum(square * mean, LEAST**2)

            square = lax.fori_loop(0, ITERATIONS, closer, square)
        return jnp.where(self._given, given, jnp.sqrt(square) * sigma)

    def curvature(
        self,
        predicted: Float[Array, "M k"],
        measured: Float[Array, "M k"],
        sigma: Float[Array, " k"],
        weight: Float[Array, "M k"],
    ) -> Float[Array, "M k"]:
        """The second derivative of the loss by each prediction: that of a parabola above it, never negative."""
        levels = self.levels(predicted, measured, sigma, weight)
        z = (predicted - measured) / levels
        _, slope = self.law.loss(_mean(self.law.penalty(z), weight), self._given)
        part = _shares(weight) * slope / (_total(weight) * levels**2)
        return self.law.weight(z) * weight * part

    @property
    def _given(self) -> Bool[Array, " k"]:
        return jnp.asarray([n is not None for n in self.noise])


def _total(weight: Float[Array, "M k"]) -> Float[Array, " k"]:
    total = jnp.sum(weight, axis=0)
    return jnp.where(total > 0, total, 1.0)


def _mean(terms: Float[Array, "M k"], weight: Float[Array, "M k"]) -> Float[Array, " k"]:
    """The weighted mean over the points, by target; zero for one without any."""
    return jnp.sum(terms * weight, axis=0) / _total(weight)


def _shares(weight: Float[Array, "M k"]) -> Float[Array, " k"]:
    """The part of all weights that each target has."""
    total = jnp.sum(weight, axis=0)
    return total / jnp.where(jnp.any(total > 0), jnp.sum(total), 1.0)


LAWS: dict[str, type[ErrorLaw]] = {"likelihood": Likelihood, "huber": Huber, "student": Student}
"""Laws that have a name."""
