"""Records laid out for training: the rows of all of them end to end, as arrays on the device.

A row is a step of the integration. Most rows hold samples of targets; what was not measured there has the weight zero,
so that gaps, several rates and unequal records are nothing special. Because the rows of all records form one table, a
program has the same size however many there are.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import numpy_or_jax
from acausal.simulation import Steps
from acausal.training.objective.input_delays import NOTHING_DELAYED, DelayedInputs


class Places(NamedTuple):
    """Where the rows of records are.

    Attributes:
        times: of every row, or of those in ``rows``.
        of: the record of each of them.
        names: of the records.
        rows: some rows, among them the first and the last of every record; ``None`` for all.
    """

    times: Float[np.ndarray, " N"]
    of: Int[np.ndarray, " N"]
    names: tuple[str, ...]
    rows: Int[np.ndarray, " N"] | None = None

    def time(self, row: int) -> float:
        """The time of a row, between known ones by interpolation."""
        return float(
            self.times[row] if self.rows is None else np.interp(row, self.rows, self.times)
        )

    def record(self, row: int) -> str | None:
        """The record of a row; ``None`` where there is only one."""
        if len(self.names) == 1:
            return None
        known = row if self.rows is None else np.searchsorted(self.rows, row, side="right") - 1
        return self.names[self.of[known]]


class Window(eqx.Module):
    """Some rows of one record, in which a sequence is compared.

    Attributes:
        steps: with the inputs.
        y: targets.
        weight: how much each of them counts.
        x: the measured state at the first row; ``None`` where no record has one.
        of: the record.
    """

    steps: Steps
    y: Float[Array, "length n_targets"]
    weight: Float[Array, "length n_targets"]
    x: Float[Array, " n_states"] | None
    of: Int[Array, ""]


class Records(eqx.Module):
    """R records, N rows in all. A step begins at every row; that of a record's last row is not used.

    Attributes:
        steps: N steps with the inputs.
        y: targets; zero where they are not measured.
        weight: how much each counts; zero where it is not measured.
        sigma: standard deviations of the targets over all records; ``scale``: the deviations by which the loss counts
            them, which are the same, or in proportion to their noise.
        x: states where all of them are measured, else NaN; ``None`` where that is never so. Where the training chooses
            its stages, speeds that no record has are the rates of positions without most of their noise.
        of: the record of every row.
        first, last: of every record, its first and its last row.
        sampled: the rows that hold samples; the others only shorten steps.
        names: of the records.
        known: whether these are the records of the training.
        delayed: the inputs that come later than ``steps`` says.
    """

    steps: Steps
    y: Float[Array, "N n_targets"]
    weight: Float[Array, "N n_targets"]
    sigma: Float[Array, " n_targets"]
    scale: Float[Array, " n_targets"]
    x: Float[Array, "N n_states"] | None
    of: Int[Array, " N"]
    first: Int[Array, " R"]
    last: Int[Array, " R"]
    sampled: Bool[Array, " N"]
    names: tuple[str, ...] = eqx.field(static=True)
    known: bool = eqx.field(static=True, default=True)
    delayed: DelayedInputs = NOTHING_DELAYED

    def __len__(self) -> int:
        """How many rows there are."""
        return self.y.shape[0]

    @property
    def count(self) -> int:
        """How many records there are."""
        return len(self.names)

    @property
    def places(self) -> Places:
        """Where the rows are."""
        return Places(np.asarray(self.steps.t), np.asarray(self.of), self.names)

    @property
    def measured(self) -> Float[np.ndarray, "N n_targets"]:
        """The targets; NaN where they are not measured."""
        return np.where(np.asarray(self.weight) > 0, np.asarray(self.y), np.nan)

    @property
    def begins(self) -> Bool[Array, " N"]:
        """Whether a record begins at a row."""
        return jnp.zeros(len(self), bool).at[self.first].set(True)

    def window(self, start: Int[Array | np.ndarray, "*n"], length: int) -> Window:
        """The ``length`` rows from ``start`` on; beyond the record's end its last row is repeated, with no weight.

        Several starts give windows with a leading axis, but for what is the same at every row.
        """
        xp = numpy_or_jax(start, self.y)
        x, of = None if self.x is None else self.x[start], self.of[start]
        if self.count == 1 and start.ndim == 0:

            def cut(a: Array) -> Array:
                return lax.dynamic_slice_in_dim(a, start, length) if a.ndim else a

            return Window(jax.tree.map(cut, self.steps), cut(self.y), cut(self.weight), x, of)
        rows = start[..., None] + xp.arange(length)
        last = self.last[of][..., None]
        inside = (rows <= last)[..., None]
        rows = xp.minimum(rows, last)
        steps, y, weight = jax.tree.map(
            lambda a: a[rows] if a.ndim else a, (self.steps, self.y, self.weight)
        )
        return Window(steps, y, xp.where(inside, weight, 0.0), x, of)

    def beginnings(self, rows: int) -> Records:
        """The same with so many rows of each record at most, the first ones."""
        first, last = np.asarray(self.first), np.asarray(self.last)
        counts = np.minimum(last - first + 1, rows)
        chosen = np.concatenate([a + np.arange(n) for a, n in zip(first, counts, strict=True)])

        rows_each = ("steps", "y", "weight", "x", "of", "sampled")
        parts = {name: getattr(self, name) for name in rows_each}
        parts = jax.tree.map(lambda a: a[chosen] if a.ndim else a, parts)
        ends = jnp.asarray(np.cumsum(counts) - 1)
        return replace(self, **parts, first=ends - counts + 1, last=ends)

    def rows_of(self, record: int) -> Int[np.ndarray, " n"]:
        """The rows of a record that hold samples."""
        first, last = (int(np.asarray(side)[record]) for side in (self.first, self.last))
        return first + np.flatnonzero(np.asarray(self.sampled)[first : last + 1])
