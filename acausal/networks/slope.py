"""Laws with a least slope, and energies with a least curvature."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array
from jax.typing import ArrayLike


class Steeper(eqx.Module):
    """``F(x, T) + (least + softplus(more)) x``: a monotone law with at least the slope ``least``.

    Attributes:
        more: trained; ``None`` leaves that term out. See `start_at`.
    """

    net: Callable[..., Array]
    least: float = eqx.field(static=True)
    more: Array | None = None

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for scalar inputs."""
        return self.net(*inputs) + _slope(self.least, self.more) * jnp.asarray(inputs[0])


class Rounder(eqx.Module):
    """``W(x, T) + ½ (least + softplus(more)) |x|²``: a convex energy with at least the curvature ``least``.

    Attributes:
        more: trained; ``None`` leaves that term out. See `start_at`.
        inputs: how many of the first inputs ``x`` has.
    """

    net: Callable[..., Array]
    least: float = eqx.field(static=True)
    more: Array | None = None
    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for scalar inputs."""
        squares = sum(jnp.asarray(x) ** 2 for x in inputs[: self.inputs])
        return self.net(*inputs) + 0.5 * _slope(self.least, self.more) * squares


def start_at(slope: float) -> Array | None:
    """What makes ``softplus(more)`` a slope; nothing for zero."""
    return jnp.log(jnp.expm1(jnp.asarray(slope, float))) if slope else None


def _slope(least: float, more: Array | None) -> ArrayLike:
    return least if more is None else least + jax.nn.softplus(more)
