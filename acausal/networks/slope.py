"""Laws and energies with a least slope or curvature, and how they go on beyond what is known."""

from __future__ import annotations

from collections.abc import Callable, Sequence

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


class Continued(eqx.Module):
    """A function of ``x`` within limits, and beyond each of them its Taylor polynomial about that limit.

    Of order 0 it is held, of order 1 it goes on along its tangent, of order 2 (for an energy) its slope does. What is
    odd, even, monotone or convex within symmetric limits is so everywhere.

    Attributes:
        low, high: the limits of the first input.
        order: of the polynomial, up to 2.
        rising: whether a tangent that falls is replaced by a level line, which keeps a passive law passive.
    """

    net: Callable[..., Array]
    low: float = eqx.field(static=True)
    high: float = eqx.field(static=True)
    order: int = eqx.field(static=True)
    rising: bool = eqx.field(static=True, default=False)

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for scalar inputs."""
        x = jnp.asarray(inputs[0])
        near = jnp.clip(x, self.low, self.high)
        value, *slopes = _derivatives(lambda y: self.net(y, *inputs[1:]), near, self.order)
        if slopes and self.rising:
            slopes[0] = jnp.maximum(slopes[0], 0)
        beyond, power = x - near, 1.0
        for n, slope in enumerate(slopes, start=1):
            power = power * beyond / n
            value = value + slope * power
        return value


def _derivatives(function: Callable[[Array], Array], x: Array, order: int) -> Sequence[Array]:
    """The value and the first derivatives at a point."""
    if order == 0:
        return [function(x)]

    def lower(y: Array) -> Sequence[Array]:
        return _derivatives(function, y, order - 1)

    values, slopes = jax.jvp(lower, (x,), (jnp.ones_like(x),))
    return [*values, slopes[-1]]
