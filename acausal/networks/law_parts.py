"""Parts of laws: each keeps one promise, whatever network is inside it."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

STEEPEST = 7.0
"""Logarithm of the greatest steepness of dry friction, about 1100."""

START = -2.0
"""Added to a network inside a softplus, so that a law starts small: softplus(-2) = 0.13."""


class Wrapper(eqx.Module):
    """A network around another one, ``net``."""

    net: Callable[..., Array]


class Odd(Wrapper):
    """``½ (F(x, T) − F(−x, T))``: odd in the first input, and as monotone as ``F`` is."""

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        x, *others = inputs
        return 0.5 * (self.net(x, *others) - self.net(-jnp.asarray(x), *others))


class Even(Wrapper):
    """``½ (F(x, T) + F(−x, T))``: even if all first ``inputs`` change sign, and as convex as ``F`` is."""

    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        mirrored = [-jnp.asarray(x) for x in inputs[: self.inputs]]
        return 0.5 * (self.net(*inputs) + self.net(*mirrored, *inputs[self.inputs :]))


class OffsetCorrected(Wrapper):
    """A network less its value at zero: ``F̃(x) = F(x) − F(0)``, the paper's (5); an energy less its value at rest.

    With secondary inputs only the first are set to zero: ``F̃(x, T) = F(x, T) − F(0, T)``.

    Attributes:
        inputs: how many are set to zero.
    """

    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The corrected output for scalar inputs."""
        rest = [jnp.zeros_like(x) for x in inputs[: self.inputs]]
        return self.net(*inputs) - self.net(*rest, *inputs[self.inputs :])


class DryFrictionFactor(eqx.Module):
    """``x + c tanh(k x)`` with trained ``c, k > 0``: it rises through zero, steeply for dry friction."""

    height: Float[Array, ""]
    steepness: Float[Array, ""]

    def __init__(self, height: float = -1.0, steepness: float = 1.5) -> None:
        self.height, self.steepness = jnp.asarray(height, float), jnp.asarray(steepness, float)

    def __call__(self, x: ArrayLike) -> Float[Array, ""]:
        """The output for a scalar input."""
        return jnp.asarray(x) + jax.nn.softplus(self.height) * jnp.tanh(self.k * x)

    @property
    def k(self) -> Float[Array, ""]:
        """How steeply it rises: within about ``1/k`` of zero."""
        return jnp.exp(jnp.clip(self.steepness, -STEEPEST, STEEPEST))


class WithFactor(Wrapper):
    """Base of laws that are a product of a `DryFrictionFactor` of the first input and a network."""

    factor: DryFrictionFactor = eqx.field(default_factory=DryFrictionFactor)


class ThroughZero(WithFactor):
    """``p(x) F(x, T)`` with a `DryFrictionFactor` ``p``: exactly zero at zero, for one evaluation of the network."""

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        return self.factor(inputs[0]) * self.net(*inputs)


class Passive(WithFactor):
    """``p(x) softplus(F(x, T))`` with a `DryFrictionFactor` ``p``: it has the sign of ``x`` for any network ``F``."""

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        return self.factor(inputs[0]) * jax.nn.softplus(self.net(*inputs) + START)


class SameSign(Wrapper):
    """A law that has the sign of its first input apart from rounding; here it has the sign exactly.

    Where the signs differ, the value is subtracted from itself: that leaves zero, and the derivatives as they are.
    """

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        value = self.net(*inputs)
        differ = jnp.sign(value) != jnp.sign(jnp.asarray(inputs[0]))
        return value - jax.lax.stop_gradient(jnp.where(differ, value, jnp.zeros_like(value)))


class Positive(Wrapper):
    """``least + softplus(F)``, never below ``least``."""

    least: float = eqx.field(static=True, default=0.0)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        return self.least + jax.nn.softplus(self.net(*inputs))


class Between(Wrapper):
    """``low + (high − low) σ(F + start)`` with the logistic function σ: between two bounds.

    Attributes:
        start: the argument of σ before training, for ``F = 0``; 2 is near the upper bound.
    """

    low: float = eqx.field(static=True, default=0.0)
    high: float = eqx.field(static=True, default=1.0)
    start: float = eqx.field(static=True, default=0.0)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        share = jax.nn.sigmoid(self.net(*inputs) + self.start)
        return self.low + (self.high - self.low) * share


class BesideLinear(Wrapper):
    """``F(x) + Σ slope_i x_i + offset``: a law beside a linear one.

    Where the network saturates, the law goes on along the linear one.

    Attributes:
        slope: of the first inputs.
        offset: ``None`` where the law vanishes at zero.
    """

    slope: Float[Array, " n"]
    offset: Float[Array, ""] | None = None

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        linear = sum(s * jnp.asarray(x) for s, x in zip(self.slope, inputs, strict=False))
        return self.net(*inputs) + linear + (0.0 if self.offset is None else self.offset)


class WithMinSlope(Wrapper):
    """``F(x, T) + (least + softplus(more)) x``: a monotone law whose derivative is at least ``least``.

    Attributes:
        more: trained; ``None`` omits that term. See `start_at`.
    """

    least: float = eqx.field(static=True)
    more: Array | None = None

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        return self.net(*inputs) + least_and_more(self.least, self.more) * jnp.asarray(inputs[0])


def start_at(value: float) -> Float[Array, ""] | None:
    """The ``more`` for which ``softplus(more)`` is a value; None for zero."""
    return jnp.log(jnp.expm1(jnp.asarray(value, float))) if value else None


def least_and_more(least: float, more: Array | None) -> ArrayLike:
    """The least coefficient, and what is trained beyond it."""
    return least if more is None else least + jax.nn.softplus(more)
