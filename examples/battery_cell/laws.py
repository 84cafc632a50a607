"""The network of the open-circuit voltage: steps that may be steep near empty."""

from __future__ import annotations

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

STEEP, FLAT = 20.0, 6.0
"""Where there is little charge, and elsewhere: how steep a step of the curve starts [1]."""


class RisingSteps(eqx.Module):
    """``U = b + s(a) q + Σ s(A_i) tanh(e^{k_i} (q - c_i))`` with ``s = softplus``: rises for all weights.

    Half of the steps lie near empty, where the voltage of a cell falls steeply.

    Arguments:
        steps: how many.
        voltage: at the start of training, at half charge.
        key: of the steps' places.
    """

    place: Float[Array, " n"]
    steepness: Float[Array, " n"]
    height: Float[Array, " n"]
    slope: Float[Array, ""]
    offset: Float[Array, ""]

    def __init__(self, steps: int = 14, *, key: Array) -> None:
        low = steps // 2 - 1
        first = np.concatenate(
            [np.linspace(-0.08, 0.1, low), np.linspace(0.2, 1.05, steps - low)]
        )
        moved = 0.01 * jax.random.normal(key, (steps,))
        self.place = jnp.asarray(first) + jnp.where(first < 0.12, 0.3, 1.0) * moved
        self.steepness = jnp.log(jnp.where(first < 0.12, STEEP, FLAT))
        self.height = jnp.full(steps, -3.0)
        self.slope = jnp.asarray(-0.5)
        self.offset = jnp.asarray(-0.3)

    def __call__(self, soc: Float[Array, ""]) -> Float[Array, ""]:
        """The voltage above the nominal one, at a state of charge."""
        steps = jnp.tanh(jnp.exp(self.steepness) * (soc - self.place))
        line = self.offset + jax.nn.softplus(self.slope) * soc
        return line + jax.nn.softplus(self.height) @ steps
