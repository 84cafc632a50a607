"""Laws that vanish where their first input does."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal.networks.dry_friction_factor import DryFrictionFactor, WithFactor


class OffsetCorrected(eqx.Module):
    """A network less its value at zero: ``F̃(x) = F(x) − F(0)``, the paper's (5).

    With secondary inputs only the first is set to zero: ``F̃(x, T) = F(x, T) − F(0, T)``.
    """

    net: Callable[..., Array]

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The corrected output for scalar inputs."""
        return self.net(*inputs) - self.net(jnp.zeros_like(inputs[0]), *inputs[1:])


class ThroughZero(WithFactor):
    """``p(x) F(x, T)`` with a `DryFrictionFactor` ``p``: exactly zero at zero, for one evaluation of the network."""

    def __init__(
        self,
        net: Callable[..., Array],
        factor: DryFrictionFactor | None = None,
    ) -> None:
        self.net, self.factor = net, factor or DryFrictionFactor()

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for scalar inputs."""
        return self.factor(inputs[0]) * self.net(*inputs)
