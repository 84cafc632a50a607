"""How a law goes through zero that is a product with its first input."""

from __future__ import annotations

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array
from jax.typing import ArrayLike

STEEPEST = 7.0
"""Logarithm of the greatest steepness, about 1100."""


class Passage(eqx.Module):
    """``x + c tanh(k x)`` with trained ``c, k > 0``: it rises through zero, steeply if it is a dry friction."""

    height: Array
    steepness: Array

    def __init__(self, height: float = -1.0, steepness: float = 1.5) -> None:
        self.height, self.steepness = jnp.asarray(height, float), jnp.asarray(steepness, float)

    def __call__(self, x: ArrayLike) -> Array:
        """The output for a scalar input."""
        k = jnp.exp(jnp.clip(self.steepness, -STEEPEST, STEEPEST))
        return jnp.asarray(x) + jax.nn.softplus(self.height) * jnp.tanh(k * x)
