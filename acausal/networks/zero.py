"""Laws that vanish where their first input does."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax.numpy as jnp
from jax import Array
from jax.typing import ArrayLike

from acausal.networks.dry_friction_factor import Passage


class OffsetCorrected(eqx.Module):
    """A network less its value at zero: ``F̃(x) = F(x) − F(0)``, the paper's (5).

    With secondary inputs only the first is set to zero: ``F̃(x, T) = F(x, T) − F(0, T)``.
    """

    net: Callable[..., Array]

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The corrected output for scalar inputs."""
        return self.net(*inputs) - self.net(jnp.zeros_like(inputs[0]), *inputs[1:])


class ThroughZero(eqx.Module):
    """``p(x) F(x, T)`` with a `Passage` ``p``: zero at zero to the last bit, for one evaluation of the network."""

    net: Callable[..., Array]
    passage: Passage = eqx.field(default_factory=Passage)

    def __call__(self, *inputs: ArrayLike) -> Array:
        """The output for scalar inputs."""
        return self.passage(inputs[0]) * self.net(*inputs)
