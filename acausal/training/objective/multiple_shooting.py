"""Multiple shooting: the states at which sequences begin are trained, and tied by continuity."""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

CONTINUITY = 10.0
"""Weight of the gaps between sequences whose initial states are trained."""

CONSTANT = 1e-9
"""A state that varies by less, relative to its size, counts as constant."""


class ShootingStates(eqx.Module):
    """The states at which the parts of a record begin; each part should end where the next one begins.

    One part is single shooting, several parts are multiple shooting.

    Attributes:
        start: where training starts.
        scale: typical magnitudes of the states.
        continuity: weight of the gaps between parts.
        length: samples in a part.
    """

    start: Float[Array, "n_parts n_states"]
    scale: Float[Array, " n_states"]
    continuity: Float[Array, ""]
    length: int = eqx.field(static=True)

    def state(
        self, moves: Float[Array, "n_parts n_states"] | None, part: Int[Array, ""] | int
    ) -> Float[Array, " n_states"]:
        """The state at which a part begins; ``moves`` are distances from ``start`` in units of ``scale``."""
        assert moves is not None
        return self.start[part] + self.scale * moves[part]

    def gap(
        self,
        moves: Float[Array, "n_parts n_states"] | None,
        part: Int[Array, ""],
        end: Float[Array, " n_states"],
    ) -> Float[Array, ""]:
        """The penalty for a part that ends elsewhere than the next one begins; 0 for the last."""
        last = len(self.start) - 1
        miss = (end - self.state(moves, jnp.minimum(part + 1, last))) / self.scale
        return jnp.where(part < last, self.continuity * jnp.mean(miss**2), 0.0)

    def first(self, length: int) -> ShootingStates:
        """The first part alone, with another length: single shooting."""
        return ShootingStates(self.start[:1], self.scale, self.continuity, length)


def shooting_states(
    trajectory: Float[np.ndarray, "n_samples n_states"], parts: int, length: int
) -> ShootingStates:
    """Initial states of all parts on a trajectory; the states' deviations along it are their scales."""
    deviation = trajectory.std(axis=0)
    largest = np.abs(trajectory).max(axis=0)
    scale = np.where(deviation > CONSTANT * largest, deviation, np.where(largest > 0, largest, 1.0))
    starts = trajectory[: parts * length : length]
    return ShootingStates(jnp.asarray(starts), jnp.asarray(scale), jnp.asarray(CONTINUITY), length)
