"""Laws that may change by small bumps over their networks' arguments in training."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.scipy.special import erf
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import compiled
from acausal.networks import EnergyLaw, WithLaw, kept_promises, law_of, rise_of
from acausal.training.objective.problem import Problem
from acausal.training.objective.regularizers import Network

BUMPS, SIGMAS = 12, 3.0
"""Bumps of each law, evenly over so many sigmas of its inputs to either side."""


class Bumped(WithLaw):
    """A network whose law may change by bumps of its first argument, ``F(x) + Σ a_k φ_k(x)``, and keeps its promises.

    A bump is ``exp(−(x − c_k)²/2w²)``. Where the law is zero at zero it is multiplied with ``1 − exp(−x²/2h²)``; where
    the law is odd or even, its mirror image is subtracted or added.

    Attributes:
        net: the network.
        heights: of the bumps.
        centres: of the bumps; ``width``: of all.
        hole: the width h; ``None`` where the law need not be zero at zero.
        mirrored: −1 for an odd law, 1 for an even one, else 0.
    """

    net: Network
    heights: Float[Array, " n_bumps"]
    centres: Float[Array, " n_bumps"]
    width: Float[Array, ""]
    hole: Float[Array, ""] | None = None
    mirrored: int = eqx.field(static=True, default=0)

    def __call__(self, *inputs: Float[Array, ""]) -> Float[Array, ""]:
        """The law, or the energy whose derivative it is."""
        shapes = self.areas if isinstance(self.net, EnergyLaw) else self.bumps
        return self.net(*inputs) + jnp.sum(self.heights * shapes(inputs[0]))

    def law(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The law."""
        bumps = self.bumps(jnp.asarray(inputs[0]))
        return law_of(self.net)(*inputs) + jnp.sum(self.heights * bumps)

    def bumps(self, x: Float[Array, ""]) -> Float[Array, " n_bumps"]:
        """The bumps at x."""
        found = self._one_side(x, _bump)
        return found + self.mirrored * self._one_side(-x, _bump) if self.mirrored else found

    def areas(self, x: Float[Array, ""]) -> Float[Array, " n_bumps"]:
        """The energies whose derivatives the bumps are."""
        found = self._one_side(x, _area)
        return found - self.mirrored * self._one_side(-x, _area) if self.mirrored else found

    def _one_side(self, x: Float[Array, ""], shape: Shape) -> Float[Array, " n_bumps"]:
        """A bump less its product with the bump at zero, which is a bump again, or the areas of both."""
        whole = shape(x, self.centres, self.width)
        if self.hole is None:
            return whole
        both = self.width**2 + self.hole**2
        share, narrow = self.hole**2 / both, self.width * self.hole / jnp.sqrt(both)
        product = jnp.exp(-0.5 * self.centres**2 / both)
        return whole - product * shape(x, share * self.centres, narrow)


Shape = Callable[[Array, Array, Array], Array]


def _bump(
    x: Float[Array, ""], centres: Float[Array, " n"], width: Float[Array, ""]
) -> Float[Array, " n"]:
    return jnp.exp(-0.5 * ((x - centres) / width) ** 2)


def _area(
    x: Float[Array, ""], centres: Float[Array, " n"], width: Float[Array, ""]
) -> Float[Array, " n"]:
    return width * jnp.sqrt(jnp.pi / 2) * erf((x - centres) / width / jnp.sqrt(2.0))


def bumped_law(network: Network, seen: Float[np.ndarray, "n_calls n_arguments"]) -> Bumped:
    """A network with bumps of height 0 over the values that its first argument had."""
    first, kept = seen[:, 0], kept_promises(network)
    spread = float(first.std()) or 1.0
    centres = first.mean() + spread * np.linspace(-SIGMAS, SIGMAS, BUMPS)
    width = jnp.asarray(centres[1] - centres[0])
    mirrored = -1 if "odd" in kept else 1 if "even" in kept else 0
    hole = jnp.minimum(width, rise_of(network)) if "zero" in kept and mirrored >= 0 else None
    return Bumped(network, jnp.zeros(BUMPS), jnp.asarray(centres), width, hole, mirrored)


@compiled
def bumps_at(law: Bumped, points: Float[ArrayLike, " points"]) -> Float[Array, "points n_bumps"]:
    """The bumps of a law at some points."""
    return jax.vmap(law.bumps)(jnp.asarray(points))


def with_changes(
    problem: Problem,
    params: Mapping[str, Any],
    bumped: Mapping[str, Bumped],
    changes: Float[Array, " n"],
) -> dict[str, Any]:
    """Parameters after changes: heights of the bumps of all laws, then the changes of trained parameters."""
    laws = {
        name: replace(law, heights=changes[k * BUMPS : (k + 1) * BUMPS])
        for k, (name, law) in enumerate(bumped.items())
    }
    moved = dict(zip(problem.modifiers.names, changes[BUMPS * len(laws) :], strict=True))
    return problem.modifiers.changed({**params, **laws}, moved)
