"""Periodic laws, such as the cogging of a motor over its angle or the error of a screw over its turns."""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import is_number
from acausal.errors import DeclarationError, need_whole, shown
from acausal.networks.mlp import check_inputs


class Fourier(eqx.Module):
    """``output_scale Σ_k a_k sin(2πkx/period) + b_k cos(2πkx/period)``, ``k = 1 … harmonics``: it starts as zero.

    Its mean over a period is zero for any coefficients, so that a law of position alone is conservative.

    Raises:
        DeclarationError: for a period or a number of harmonics that is not positive.
    """

    sines: Array
    cosines: Array
    period: float = eqx.field(static=True)
    output_scale: float = eqx.field(static=True, default=1.0)

    def __init__(self, period: float, harmonics: int = 4, output_scale: float = 1.0) -> None:
        harmonics = need_whole(harmonics, "Fourier: harmonics", DeclarationError, 1)
        if not (is_number(period) and period > 0):
            raise DeclarationError(f"Fourier: period={shown(period)}; give a positive number.")
        if not is_number(output_scale):
            raise DeclarationError(f"Fourier: output_scale={shown(output_scale)}; give a number.")
        self.sines, self.cosines = jnp.zeros(harmonics), jnp.zeros(harmonics)
        self.period, self.output_scale = float(period), output_scale

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The output for a scalar input."""
        check_inputs(self, inputs, 1)
        orders = jnp.arange(1, len(self.sines) + 1)
        angles = 2 * jnp.pi / self.period * orders * jnp.asarray(inputs[0])
        waves = self.sines * jnp.sin(angles) + self.cosines * jnp.cos(angles)
        return self.output_scale * jnp.sum(waves)
