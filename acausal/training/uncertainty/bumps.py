"""Laws that may change by small bumps over their networks' arguments in training."""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax.scipy.special import erf
from jaxtyping import Array, Float

from acausal.networks import EnergyLaw, law_of
from acausal.training.objective.regularizers import Network

BUMPS, SIGMAS = 12, 3.0
"""Bumps of each law, evenly over so many sigmas of its inputs to either side."""


class Bumped(eqx.Module):
    """A network whose law may change by bumps of its first argument, ``F(x) + Σ a_k exp(−(x − c_k)²/2w²)``."""

    net: Network
    heights: Float[Array, " n_bumps"]
    centres: Float[Array, " n_bumps"]
    width: Float[Array, ""]

    def __call__(self, *inputs: Float[Array, ""]) -> Float[Array, ""]:
        """The law, or the energy whose derivative it is."""
        shapes = self.areas if isinstance(self.net, EnergyLaw) else self.bumps
        return self.net(*inputs) + jnp.sum(self.heights * shapes(inputs[0]))

    def law(self, *inputs: Float[Array, ""]) -> Float[Array, ""]:
        """The law."""
        return law_of(self.net)(*inputs) + jnp.sum(self.heights * self.bumps(inputs[0]))

    def bumps(self, x: Float[Array, ""]) -> Float[Array, " n_bumps"]:
        """The bumps at x."""
        return jnp.exp(-0.5 * ((x - self.centres) / self.width) ** 2)

    def areas(self, x: Float[Array, ""]) -> Float[Array, " n_bumps"]:
        """The energies whose derivatives the bumps are."""
        z = (x - self.centres) / self.width
        return self.width * jnp.sqrt(jnp.pi / 2) * erf(z / jnp.sqrt(2.0))


def bumped_law(network: Network, seen: Float[np.ndarray, "n_calls n_arguments"]) -> Bumped:
    """A network with bumps of height 0 over the values that its first argument had."""
    first = seen[:, 0]
    spread = float(first.std()) or 1.0
    centres = first.mean() + spread * np.linspace(-SIGMAS, SIGMAS, BUMPS)
    width = jnp.asarray(centres[1] - centres[0])
    return Bumped(network, jnp.zeros(BUMPS), jnp.asarray(centres), width)
