"""Multiple shooting: the states at which sequences begin are trained, and tied by continuity."""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

CONTINUITY = 10.0
"""Weight of the gaps between sequences whose initial states are trained."""

CONSTANT = 1e-9
"""A state that varies by less, relative to its size, counts as constant."""


class ShootingStates(eqx.Module):
    """The states at which the parts of records begin; each part should end where the next one begins.

    One part a record is single shooting, several parts are multiple shooting.

    Attributes:
        start: where training starts.
        scale: typical magnitudes of the states.
        continuity: weight of the gaps between parts.
        rows: the first row of every part.
        first: the first part of every record.
        ends: the parts with which a record ends.
        parts: which ones these are of all parts.
    """

    start: Float[Array, "n_parts n_states"]
    scale: Float[Array, " n_states"]
    continuity: Float[Array, ""]
    rows: Int[Array, " n_parts"]
    first: Int[Array, " R"]
    ends: Bool[Array, " n_parts"]
    parts: Int[Array, " n_parts"]

    def states(
        self, moves: Float[Array, "n_parts n_states"] | None
    ) -> Float[Array, "n_parts n_states"]:
        """The state at which every part begins; ``moves`` are distances from ``start`` in units of ``scale``."""
        assert moves is not None
        return self.start + self.scale * moves

    def of_first(
        self, moves: Float[Array, "n_parts n_states"] | None
    ) -> Float[Array, "R n_states"]:
        """The state at which every record begins; ``moves`` of all parts, or of the first ones alone."""
        assert moves is not None
        own = moves if len(moves) == len(self.first) else moves[self.first]
        return self.start[self.first] + self.scale * own

    def part(self, row: Int[Array, ""]) -> Int[Array, ""]:
        """The part that begins at a row."""
        return jnp.searchsorted(self.rows, row)

    def gap(
        self,
        states: Float[Array, "n_parts n_states"],
        part: Int[Array, ""],
        end: Float[Array, " n_states"],
    ) -> Float[Array, ""]:
        """The penalty for a part that ends elsewhere than the next one begins; 0 for the last of a record."""
        miss = (end - states[jnp.minimum(part + 1, len(states) - 1)]) / self.scale
        return jnp.where(self.ends[part], 0.0, self.continuity * jnp.mean(miss**2))

    def of_records(self) -> ShootingStates:
        """The first part of every record alone: single shooting."""
        count = len(self.first)
        return ShootingStates(
            self.start[self.first],
            self.scale,
            self.continuity,
            self.rows[self.first],
            jnp.arange(count),
            jnp.ones(count, bool),
            self.first,
        )


def shooting_states(
    trajectory: Float[np.ndarray, "N n_states"],
    rows: Int[np.ndarray, " n_parts"],
    of: Int[np.ndarray, " N"],
) -> ShootingStates:
    """Initial states of parts, which begin at some rows of trajectories; deviations along these are their scales."""
    deviation = trajectory.std(axis=0)
    largest = np.abs(trajectory).max(axis=0)
    scale = np.where(deviation > CONSTANT * largest, deviation, np.where(largest > 0, largest, 1.0))
    records = of[rows]
    changes = np.flatnonzero(np.diff(records))
    return ShootingStates(
        jnp.asarray(trajectory[rows]),
        jnp.asarray(scale),
        jnp.asarray(CONTINUITY),
        jnp.asarray(rows),
        jnp.asarray(np.append(0, changes + 1)),
        jnp.asarray(np.append(np.diff(records) > 0, True)),
        jnp.arange(len(rows)),
    )
