"""Sequences: how batches are drawn from records."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int, PRNGKeyArray

from acausal._jax import compiled
from acausal.errors import DataError, listing
from acausal.training.objective.records import Records

LEAST_WEIGHT = 1e-9
"""Weight of a sequence none of whose samples count, relative to the mean."""


SAMPLES, SEQUENCES = 50, 16
"""Length of sequences, in samples, and how many of them are in a batch, where the user does not say."""


class Batch(eqx.Module):
    """Some sequences of records.

    Attributes:
        start: each one's first row.
        weight: of its record, or 0 for a sequence that is left out.
        points: which of its rows count, or ``None`` for all.
        nudge: zeros that are added to the state at each one's start: the derivatives by them show whose gradient
            explodes. ``None`` where nothing is integrated.
    """

    start: Int[Array, " batch"]
    weight: Float[Array, " batch"]
    points: Int[Array, "batch n_points"] | None
    nudge: Float[Array, "batch n_states"] | None = None

    def nudged(self, nudge: Float[Array, "batch n_states"] | None) -> Batch:
        """The batch with other starts."""
        return replace(self, nudge=nudge)

    def without(self, bad: Bool[Array, " batch"]) -> Batch:
        """The batch with some sequences (a mask) replaced by a good one with weight zero.

        The gradients of diverged sequences would be undefined even if multiplied by a weight of zero.
        """
        good = jnp.argmin(bad)
        replaced = jax.tree.map(lambda a: jnp.where(_column(bad, a), a[good], a), self)
        return eqx.tree_at(lambda b: b.weight, replaced, jnp.where(bad, 0.0, self.weight))


def _column(mask: Bool[Array, " batch"], like: Array) -> Array:
    return mask.reshape(mask.shape + (1,) * (like.ndim - 1))


class Sequences(eqx.Module):
    """Draws sequences of records at random, and a random part of their points.

    Attributes:
        starts: the rows at which sequences may begin.
        weight: of each in the mean over a batch.
        length: rows in a sequence; a record that is shorter is taken as a whole.
        batch_size: sequences in a batch.
        points: rows that count in each sequence, or ``None`` for all.
        whole: whether the one sequence is all of every record.
        side_by_side: whether sequences begin where others end; else they begin at any row.
        chances: running sums of the probabilities of ``starts``; ``None`` where all are alike.
    """

    starts: Int[Array, " n_starts"]
    weight: Float[Array, " n_starts"]
    length: int = eqx.field(static=True)
    batch_size: int = eqx.field(static=True)
    points: int | None = eqx.field(static=True)
    whole: bool = eqx.field(static=True)
    side_by_side: bool = eqx.field(static=True, default=False)
    chances: Float[Array, " n_starts"] | None = None

    @property
    def always_alike(self) -> bool:
        """Whether all batches are equal."""
        complete = self.whole or (self.side_by_side and self.batch_size == len(self.starts))
        return complete and self.points is None

    def among(self, counts: Bool[np.ndarray, " N"]) -> Sequences:
        """Those in which some row counts; others take their places, so that programs stay the same."""
        if self.whole:
            return self
        before = np.append(0, np.cumsum(counts))
        first = np.asarray(self.starts)
        some = before[np.minimum(first + self.length, len(counts))] > before[first]
        chosen = np.resize(np.flatnonzero(some), len(first))
        weight = np.asarray(self.weight)[chosen]
        if self.side_by_side and self.batch_size == len(first):
            weight[some.sum() :] = 0.0  # each once
        return replace(self, starts=self.starts[chosen], weight=jnp.asarray(weight))

    @compiled
    def draw(self, key: PRNGKeyArray) -> Batch:
        """A batch; the same key gives the same batch."""
        for_start, for_points = jax.random.split(key)
        chosen = self._chosen(for_start)
        points = None
        if (count := self.points) is not None:
            keys = jax.random.split(for_points, self.batch_size)
            points = jax.vmap(lambda k: jax.random.choice(k, self.length, (count,), replace=False))(
                keys
            )
        return Batch(self.starts[chosen], self.weight[chosen], points)

    def weighted(self, records: Records) -> Sequences:
        """The same where sequences count by the weights of their samples.

        Sequences at any row are drawn as often as they count; those side by side, all of which are drawn, have weights.
        """
        if self.whole:
            return self
        sums = np.append(0.0, np.cumsum(np.asarray(records.weight).sum(axis=1)))
        starts = np.asarray(self.starts)
        last = np.asarray(records.last)[np.asarray(records.of)[starts]]
        counts = sums[np.minimum(starts + self.length - 1, last) + 1] - sums[starts]
        weight = jnp.asarray(np.maximum(counts / counts.mean(), LEAST_WEIGHT))
        if self.side_by_side:
            return replace(self, weight=weight)
        return replace(self, chances=jnp.cumsum(weight))

    def _chosen(self, key: PRNGKeyArray) -> Int[Array, " batch"]:
        count = len(self.starts)
        if self.chances is not None:
            where = jax.random.uniform(key, (self.batch_size,)) * self.chances[-1]
            return jnp.minimum(jnp.searchsorted(self.chances, where, side="right"), count - 1)
        if not self.side_by_side:
            return jax.random.randint(key, (self.batch_size,), 0, count)
        every = jnp.arange(count)
        if self.batch_size < count:
            every = jax.random.choice(key, every, (self.batch_size,), replace=False)
        return every


def whole_records(records: Records, points: int | None = None) -> Sequences:
    """All of every record as one sequence."""
    return Sequences(
        jnp.zeros(1, int), jnp.ones(1), len(records), batch_size=1, points=points, whole=True
    )


def cut(
    records: Records,
    weights: Float[np.ndarray, " R"],
    seconds: float | Literal["auto"] | None,
    batch_size: int | None,
    fraction: float | None,
    *,
    tiled: bool,
    lacking: Sequence[str] = (),
) -> Sequences:
    """How to cut records.

    Arguments:
        records: the records.
        weights: of the records.
        seconds: length of a sequence; ``None`` takes all of every record, and so does ``"auto"`` where sequences of
            `SAMPLES` could not begin at measured states, or would be longer than half of a record.
        batch_size: sequences in a batch; ``None`` for 1, or `SEQUENCES` of that length.
        fraction: part of each sequence's rows that counts; ``None`` takes all.
        tiled: whether sequences lie side by side, a little longer where a record would not be filled otherwise;
            else they begin wherever all states are measured.
        lacking: states that are not measured in some record, for an error.

    Raises:
        DataError: for a length, size or fraction that does not fit the records.
    """
    first, last = np.asarray(records.first), np.asarray(records.last)
    rows = last - first + 1
    if seconds == "auto":
        fits = records.x is not None and not lacking and not tiled and rows.max() >= 2 * SAMPLES
        seconds, n = (np.inf, SAMPLES) if fits else (None, int(rows.max()))
        batch_size = (SEQUENCES if fits else 1) if batch_size is None else batch_size
    else:
        n = _length(records, seconds, rows)
    batch_size = 1 if batch_size is None else batch_size
    if seconds is None and batch_size != 1:
        raise DataError(
            f"batch_size={batch_size} needs a sequence_length in seconds, shorter than the record."
        )
    if fraction is not None and not 0 < fraction <= 1:
        raise DataError(
            f"subsample={fraction:g} is not a fraction of the points; give a number in (0, 1]."
        )
    if seconds is None or (n >= rows.max() and len(rows) == 1):
        return whole_records(records, _some(fraction, len(records)))
    if tiled:
        n = int(np.max(rows // np.maximum(1, np.round(rows / n).astype(int))))
        parts = np.maximum(1, np.round(rows / n)).astype(int)
        if parts.max() == 1:
            return whole_records(records, points=_some(fraction, len(records)))
        starts = np.concatenate([f + n * np.arange(p) for f, p in zip(first, parts, strict=True)])
        batch_size = min(batch_size, len(starts))
    else:
        starts = _startable(records, n, lacking)
    weight = weights[np.asarray(records.of)[starts]]
    return Sequences(
        jnp.asarray(starts),
        jnp.asarray(weight),
        n,
        batch_size=batch_size,
        points=_some(fraction, n),
        whole=False,
        side_by_side=tiled,
    )


def _length(records: Records, seconds: float | None, rows: np.ndarray) -> int:
    """Rows in a sequence."""
    longest = int(rows.max())
    if seconds is None:
        return longest
    if not np.isfinite(seconds):
        raise DataError(
            f"sequence_length={seconds} is not a length; give seconds, or None for all."
        )
    t = np.asarray(records.steps.t)
    spans = t[np.asarray(records.last)] - t[np.asarray(records.first)]
    mean = float(spans.sum() / np.maximum(rows - 1, 1).sum())
    n = round(seconds / mean)
    if not 2 <= n <= longest:
        what = "the record has" if len(rows) == 1 else "the longest record has"
        raise DataError(
            f"sequence_length={seconds:g} s is {n} samples; {what} {longest} at {mean:g} s."
        )
    return n


def _some(fraction: float | None, rows: int) -> int | None:
    """A part of the rows; ``None`` for all."""
    return None if fraction is None else max(1, round(fraction * rows))


def _startable(records: Records, n: int, lacking: Sequence[str]) -> Int[np.ndarray, " n_starts"]:
    """Rows with measured states from which a sequence fits into the record, or the first such row of a short one.

    Raises:
        DataError: if there are none.
    """
    if records.x is None:
        raise DataError(
            f"The data lack {listing(lacking)}: sequences start from measured states. "
            "Let the training find where they start (x0='fit'), or train on the whole record "
            "(sequence_length=None) with x0='model' or x0={...}."
        )
    first, last = np.asarray(records.first), np.asarray(records.last)
    known = np.all(np.isfinite(np.asarray(records.x)), axis=1)
    found = []
    for a, b in zip(first, last, strict=True):
        rows = a + np.flatnonzero(known[a : b + 1])
        found.append(rows[rows <= b + 1 - n] if b + 1 - n >= a else rows[:1])
    starts = np.concatenate(found)
    if not len(starts):
        raise DataError(
            "No sequence has measured states where it begins: take x0='fit', or sequence_length=None."
        )
    return starts
