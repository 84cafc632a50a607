"""Laws whose output never opposes their first input: ``F(x) x ≥ 0``."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal.networks.dry_friction_factor import DryFrictionFactor, WithFactor

START = -2.0
"""Added to a network inside a softplus, so that a law starts small: softplus(-2) = 0.13."""


class Passive(WithFactor):
    """``p(x) softplus(F(x, T))`` with a `DryFrictionFactor` ``p``: it has the sign of ``x`` for any network ``F``."""

    def __init__(
        self,
        net: Callable[..., Array],
        factor: DryFrictionFactor | None = None,
    ) -> None:
        self.net, self.factor = net, factor or DryFrictionFactor()

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        return self.factor(inputs[0]) * jax.nn.softplus(self.net(*inputs) + START)


class SameSign(eqx.Module):
    """A law that has the sign of its first input apart from rounding; here it has the sign exactly.

    Where the signs differ, the value is subtracted from itself: that leaves zero, and the derivatives as they are.
    """

    net: Callable[..., Array]

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        value = self.net(*inputs)
        differ = jnp.sign(value) != jnp.sign(jnp.asarray(inputs[0]))
        return value - jax.lax.stop_gradient(jnp.where(differ, value, jnp.zeros_like(value)))
