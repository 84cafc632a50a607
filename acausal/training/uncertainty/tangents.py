"""What a network's own weights can add to its law: the directions of functions that they produce at visited points.

Unlike bumps, these functions keep what the network promises: those of an odd law are odd.
"""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Float

from acausal.networks import law_of, output_scale
from acausal.training.objective.regularizers import Network

DIRECTIONS = 16
"""The most directions of a law."""

POINTS = 400
"""At most so many visited points are looked at."""

NONE = 1e-6
"""Functions of a smaller share of the largest one are left out."""

Move = Callable[[Float[Array, " n_directions"]], Network]


def law_directions(
    network: Network, seen: Float[np.ndarray, "n_calls n_arguments"]
) -> tuple[int, Move]:
    """How many directions there are, and the network moved along them; each adds a function of the output's scale.

    They are the principal components of the derivatives by all weights, at points that were visited.
    """
    arrays, rest = eqx.partition(network, eqx.is_inexact_array)
    weights, unravel = ravel_pytree(arrays)

    def with_weights(flat: Float[Array, " n_weights"]) -> Network:
        return eqx.combine(unravel(flat), rest)

    def law(flat: Float[Array, " n_weights"], point: Float[Array, " n_arguments"]) -> Array:
        return jnp.atleast_1d(law_of(with_weights(flat))(*point))

    points = jnp.asarray(seen[:: max(1, len(seen) // POINTS)])
    derivatives = jax.jit(jax.vmap(jax.jacrev(law), (None, 0)))(weights, points)
    features = np.asarray(derivatives, float).reshape(-1, weights.size)
    _, sizes, directions = np.linalg.svd(features, full_matrices=False)
    count = int(np.sum(sizes[:DIRECTIONS] > NONE * sizes[0]))
    each = output_scale(network) * np.sqrt(len(features)) / sizes[:count]
    along = jnp.asarray(directions[:count] * each[:, None], weights.dtype)
    return count, lambda z: with_weights(weights + z @ along)


def correlation_with(one: Float[np.ndarray, " rows"], others: Float[np.ndarray, "rows n"]) -> float:
    """The multiple correlation, from 0 to 1: 1 where the columns can produce the one exactly.

    Effects are in standard deviations of the noise. Of an effect below it all, the data say nothing: 0.
    """
    size = float(np.linalg.norm(one))
    if size < 1 or not others.size:
        return 0.0
    scaled = others / np.maximum(np.linalg.norm(others, axis=0), 1e-300)
    left = one - scaled @ np.linalg.lstsq(scaled, one, rcond=NONE)[0]
    return float(np.sqrt(max(0.0, 1 - (np.linalg.norm(left) / size) ** 2)))
