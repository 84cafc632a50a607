"""Networks whose output stays within bounds."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
from jax.typing import ArrayLike
from jaxtyping import Array, Float


class Positive(eqx.Module):
    """``least + softplus(F)``, never below ``least``."""

    net: Callable[..., Array]
    least: float = eqx.field(static=True, default=0.0)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        return self.least + jax.nn.softplus(self.net(*inputs))


class Between(eqx.Module):
    """``low + (high − low) σ(F + start)`` with the logistic function σ: between two bounds.

    Attributes:
        start: the argument of σ before training, for ``F = 0``; 2 is near the upper bound.
    """

    net: Callable[..., Array]
    low: float = eqx.field(static=True, default=0.0)
    high: float = eqx.field(static=True, default=1.0)
    start: float = eqx.field(static=True, default=0.0)

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        share = jax.nn.sigmoid(self.net(*inputs) + self.start)
        return self.low + (self.high - self.low) * share
