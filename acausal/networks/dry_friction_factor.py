"""A factor that rises through zero, as dry friction does, for laws that are products with it."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

STEEPEST = 7.0
"""Logarithm of the greatest steepness, about 1100."""


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


class WithFactor(eqx.Module):
    """Base of laws that are a product of a `DryFrictionFactor` of the first input and a network."""

    net: Callable[..., Array]
    factor: DryFrictionFactor
