"""Nodes: initial states of sequences that nobody measured, found along with the networks."""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
from jax import Array


class Nodes(eqx.Module):
    """The states at which the parts of a record begin; each part should end where the next one begins.

    With one part this is single, with several it is multiple shooting.

    Attributes:
        start: where training starts, shape (parts, number of states).
        scale: typical magnitudes of the states, shape (number of states,).
        continuity: weight of the gaps between parts.
        length: samples in a part.
    """

    start: Array
    scale: Array
    continuity: Array
    length: int = eqx.field(static=True)

    def state(self, moves: Array | None, part: Array | int) -> Array:
        """The state at which a part begins; ``moves`` are distances from ``start`` in units of ``scale``."""
        assert moves is not None
        return self.start[part] + self.scale * moves[part]

    def gap(self, moves: Array | None, part: Array, end: Array) -> Array:
        """What the loss counts for a part that ends elsewhere than the next one begins; 0 for the last."""
        last = len(self.start) - 1
        miss = (end - self.state(moves, jnp.minimum(part + 1, last))) / self.scale
        return jnp.where(part < last, self.continuity * jnp.mean(miss**2), 0.0)
