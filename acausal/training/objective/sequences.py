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
from acausal.training.objective.records import Records, Window

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
        read: the sequences themselves, where the records are not in memory.
    """

    start: Int[Array, " batch"]
    weight: Float[Array, " batch"]
    points: Int[Array, "batch n_points"] | None
    nudge: Float[Array, "batch n_states"] | None = None
    read: Window | None = None

    def without(self, bad: Bool[Array, " batch"]) -> Batch:
        """The batch with some sequences (a mask) replaced by a good one with weight zero.

        The gradients of diverged sequences would be undefined even if multiplied by a weight of zero.
        """
        good = jnp.argmin(bad)

        def replaced(a: Array) -> Array:
            return jnp.where(bad.reshape(bad.shape + (1,) * (a.ndim - 1)), a[good], a)

        healthy = jax.tree.map(replaced, self)
        return eqx.tree_at(lambda b: b.weight, healthy, jnp.where(bad, 0.0, self.weight))

    def compared(self, *columns: Float[Array, "length ..."]) -> tuple[Array, ...]:
        """Of one of the sequences, the rows of some columns that count."""
        return columns if self.points is None else tuple(a[self.points] for a in columns)


class ReadSequences(eqx.Module):
    """The sequences of some updates, which were read before these begin.

    Attributes:
        since: the first of these updates.
        start: the first row of every sequence, among those of all records.
        windows: the sequences.
    """

    since: Int[Array, ""]
    start: Int[Array, "n_updates batch"]
    windows: Window


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
        read: what was drawn and read before, in the place of ``starts``, where the records are not in memory.
    """

    starts: Int[Array, " n_starts"]
    weight: Float[Array, " n_starts"]
    length: int = eqx.field(static=True)
    batch_size: int = eqx.field(static=True)
    points: int | None = eqx.field(static=True)
    whole: bool = eqx.field(static=True)
    side_by_side: bool = eqx.field(static=True, default=False)
    chances: Float[Array, " n_starts"] | None = None
    read: ReadSequences | None = None

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
    def draw(self, key: PRNGKeyArray, update: int | Int[Array, ""] = 0) -> Batch:
        """A batch; the same key gives the same batch. What was read before is found by the number of the update."""
        for_start, for_points = jax.random.split(key)
        points = None
        if (count := self.points) is not None:
            keys = jax.random.split(for_points, self.batch_size)
            points = jax.vmap(lambda k: jax.random.choice(k, self.length, (count,), replace=False))(
                keys
            )
        if (read := self.read) is not None:
            start, windows = jax.tree.map(
                lambda a: a[update - read.since], (read.start, read.windows)
            )
            return Batch(start, jnp.ones(self.batch_size), points, read=windows)
        chosen = self._chosen(for_start)
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
            return any_of(count, key, self.batch_size)
        every = jnp.arange(count)
        if self.batch_size < count:
            every = jax.random.choice(key, every, (self.batch_size,), replace=False)
        return every


def any_of(count: int, key: PRNGKeyArray, batch_size: int) -> Int[Array, " batch"]:
    """Which of so many starts the sequences of a batch have."""
    return jax.random.randint(key, (batch_size,), 0, count)


def whole_records(records: Records, points: int | None = None) -> Sequences:
    """All of every record as one sequence."""
    return Sequences(
        jnp.zeros(1, int), jnp.ones(1), len(records), batch_size=1, points=points, whole=True
    )


def cut(
    records: Records,
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
    rows, t = last - first + 1, np.asarray(records.steps.t)
    startable = records.x is not None and not lacking and not tiled
    seconds, n, batch_size = batch_sizes(rows, t[last] - t[first], startable, seconds, batch_size)
    if seconds is None and batch_size != 1:
        raise DataError(
            f"batch_size={batch_size} needs a sequence_length in seconds, shorter than the record."
        )
    if seconds is None or (n >= rows.max() and len(rows) == 1):
        return whole_records(records, some(fraction, len(records)))
    if tiled:
        n = int(np.max(rows // np.maximum(1, np.round(rows / n).astype(int))))
        parts = np.maximum(1, np.round(rows / n)).astype(int)
        if parts.max() == 1:
            return whole_records(records, points=some(fraction, len(records)))
        starts = np.concatenate([f + n * np.arange(p) for f, p in zip(first, parts, strict=True)])
        batch_size = min(batch_size, len(starts))
    else:
        starts = _startable(records, n, lacking)
    return Sequences(
        jnp.asarray(starts),
        jnp.ones(len(starts)),
        n,
        batch_size=batch_size,
        points=some(fraction, n),
        whole=False,
        side_by_side=tiled,
    )


def batch_sizes(
    rows: Int[np.ndarray, " R"],
    spans: Float[np.ndarray, " R"],
    startable: bool,
    seconds: float | Literal["auto"] | None,
    batch_size: int | None,
) -> tuple[float | None, int, int]:
    """Of batches: seconds and rows in a sequence, ``None`` and the longest record's for whole records; sequences.

    Arguments:
        rows: of every record; ``spans``: from its first to its last time.
        startable: whether sequences can begin at measured states.
        seconds, batch_size: as of `cut`.
    """
    if seconds == "auto":
        fits = startable and rows.max() >= 2 * SAMPLES
        if batch_size is None:
            batch_size = SEQUENCES if fits else 1
        return (np.inf, SAMPLES, batch_size) if fits else (None, int(rows.max()), batch_size)
    return seconds, _length(rows, spans, seconds), 1 if batch_size is None else batch_size


def _length(rows: np.ndarray, spans: np.ndarray, seconds: float | None) -> int:
    """Rows in a sequence."""
    longest = int(rows.max())
    if seconds is None:
        return longest
    if not np.isfinite(seconds):
        raise DataError(
            f"sequence_length={seconds} is not a length; give seconds, or None for all."
        )
    mean = float(spans.sum() / np.maximum(rows - 1, 1).sum())
    n = round(seconds / mean)
    if not 2 <= n <= longest:
        what = "the record has" if len(rows) == 1 else "the longest record has"
        raise DataError(
            f"sequence_length={seconds:g} s is {n} samples; {what} {longest} at {mean:g} s."
        )
    return n


def some(fraction: float | None, rows: int) -> int | None:
    """A part of the rows; ``None`` for all.

    Raises:
        DataError: for what is not a fraction.
    """
    if fraction is not None and not 0 < fraction <= 1:
        raise DataError(
            f"subsample={fraction:g} is not a fraction of the points; give a number in (0, 1]."
        )
    return None if fraction is None else max(1, round(fraction * rows))


def _startable(records: Records, n: int, lacking: Sequence[str]) -> Int[np.ndarray, " n_starts"]:
    """Rows with measured states from which a sequence fits into the record, or the first such row of a short one."""
    if records.x is None:
        need_starts(0, lacking)
    first, last = np.asarray(records.first), np.asarray(records.last)
    known = np.all(np.isfinite(np.asarray(records.x)), axis=1)
    rows = [a + startable_in(known[a : b + 1], n) for a, b in zip(first, last, strict=True)]
    starts = np.concatenate(rows)
    need_starts(len(starts), ())
    return starts


def startable_in(known: Bool[np.ndarray, " rows"], n: int) -> Int[np.ndarray, " n_starts"]:
    """Rows of a record, where all states are known, from which n rows fit; or the first such row of a short one."""
    rows, latest = np.flatnonzero(known), len(known) - n
    return rows[rows <= latest] if latest >= 0 else rows[:1]


def need_starts(count: int, lacking: Sequence[str]) -> None:
    """Refuse records without a start for sequences.

    Raises:
        DataError: if there are none; it names the states that some record lacks.
    """
    if not count and lacking:
        raise DataError(
            f"The data lack {listing(lacking)}: sequences start from measured states. "
            "Let the training find where they start (x0='fit'), or train on the whole record "
            "(sequence_length=None) with x0='model' or x0={...}."
        )
    if not count:
        raise DataError(
            "No sequence has measured states where it begins: take x0='fit', or sequence_length=None."
        )
