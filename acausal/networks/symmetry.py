"""Odd and even laws."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float


class Odd(eqx.Module):
    """``½ (F(x, T) − F(−x, T))``: odd in the first input, and as monotone as ``F`` is."""

    net: Callable[..., Array]

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        x, *others = inputs
        return 0.5 * (self.net(x, *others) - self.net(-jnp.asarray(x), *others))


class Even(eqx.Module):
    """``½ (F(x, T) + F(−x, T))``: even if all first inputs change sign, and as convex as ``F`` is.

    Attributes:
        inputs: how many change their sign.
    """

    net: Callable[..., Array]
    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        mirrored = [-jnp.asarray(x) for x in inputs[: self.inputs]]
        return 0.5 * (self.net(*inputs) + self.net(*mirrored, *inputs[self.inputs :]))
