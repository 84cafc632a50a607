"""Laws whose output never opposes their first input: ``F(x) x ≥ 0``."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array
from jax.typing import ArrayLike

from acausal.networks.dry_friction_factor import Passage

START = -2.0
"""What is added to a network inside a softplus, so that a law begins small: softplus(-2) = 0.13."""


class Passive(eqx.Module):
    """``p(x) softplus(F(x, T))`` with a `Passage` ``p``: it has the sign of ``x`` whatever the network says."""

    net: Callable[..., Array]
    passage: Passage = eqx.field(default_factory=Passage)

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for scalar inputs."""
        return self.passage(inputs[0]) * jax.nn.softplus(self.net(*inputs) + START)


class SameSign(eqx.Module):
    """A law that has the sign of its first input but for rounding, and here has it to the last bit.

    Where the signs differ, the value is taken from itself: that leaves zero, and slopes as they are.
    """

    net: Callable[..., Array]

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for scalar inputs."""
        value = self.net(*inputs)
        differ = jnp.sign(value) != jnp.sign(jnp.asarray(inputs[0]))
        return value - jax.lax.stop_gradient(jnp.where(differ, value, jnp.zeros_like(value)))
