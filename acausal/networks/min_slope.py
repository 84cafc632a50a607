"""Laws with a minimum derivative, and energies with a minimum curvature."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float


class WithMinSlope(eqx.Module):
    """``F(x, T) + (least + softplus(more)) x``: a monotone law whose derivative is at least ``least``.

    Attributes:
        more: trained; ``None`` omits that term. See `start_at`.
    """

    net: Callable[..., Array]
    least: float = eqx.field(static=True)
    more: Array | None = None

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        return self.net(*inputs) + _coefficient(self.least, self.more) * jnp.asarray(inputs[0])


class WithMinCurvature(eqx.Module):
    """``W(x, T) + ½ (least + softplus(more)) |x|²``: a convex energy whose curvature is at least ``least``.

    Attributes:
        more: trained; ``None`` omits that term. See `start_at`.
        inputs: how many of the first inputs ``x`` has.
    """

    net: Callable[..., Array]
    least: float = eqx.field(static=True)
    more: Array | None = None
    inputs: int = eqx.field(static=True, default=1)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        squares = sum(jnp.asarray(x) ** 2 for x in inputs[: self.inputs])
        return self.net(*inputs) + 0.5 * _coefficient(self.least, self.more) * squares


def start_at(value: float) -> Float[Array, ""] | None:
    """The ``more`` for which ``softplus(more)`` is a value; None for zero."""
    return jnp.log(jnp.expm1(jnp.asarray(value, float))) if value else None


def _coefficient(least: float, more: Array | None) -> ArrayLike:
    return least if more is None else least + jax.nn.softplus(more)
