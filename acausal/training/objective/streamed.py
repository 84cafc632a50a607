"""Records that do not fit in memory: one look at each, before a training that reads their sequences in batches."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Bool, Float, Int

from acausal._jax import precision
from acausal.data import Data, Stream, check_resolution
from acausal.errors import DataError
from acausal.training.objective.lay_out import common, lay_out
from acausal.training.objective.records import Places, Window
from acausal.training.objective.sequences import (
    Sequences,
    batch_sizes,
    need_starts,
    some,
    startable_in,
)
from acausal.training.objective.simulator import Simulator

if TYPE_CHECKING:
    from acausal.system import System

LOGGER = logging.getLogger(__name__)

SAMPLES_IN_MEMORY = 2**18
"""Samples that stay in memory, as many of each record's beginning: over them a training is evaluated."""


@dataclass(frozen=True, eq=False)
class Streamed:
    """What a training knows of records of which only the beginnings are in memory.

    Attributes:
        stream: reads them.
        names: of the records, in the order of their numbers.
        rows: samples of each; ``ends``: times of its first and its last one, in seconds.
        known: by record, whether all states are measured in a row, as bits; ``None`` for always.
        even: the sample time that all have in common, if there is one.
        sigma: standard deviations of the targets over all records; ``samples``: how many samples of targets there are.
    """

    stream: Stream
    names: tuple[str, ...]
    rows: Int[np.ndarray, " R"]
    ends: Float[np.ndarray, "R 2"]
    known: tuple[Int[np.ndarray, " bytes"] | None, ...]
    even: float | None
    sigma: Float[np.ndarray, " n_targets"]
    samples: int

    @property
    def first(self) -> Int[np.ndarray, " R"]:
        """The first row of each record, among those of all."""
        return np.cumsum(self.rows) - self.rows

    @property
    def places(self) -> Places:
        """Where rows are."""
        rows = np.stack([self.first, self.first + self.rows - 1], axis=1)
        of = np.repeat(np.arange(len(self.names)), 2)
        return Places(self.ends.ravel(), of, self.names, rows.ravel())

    def starts(self, record: int, length: int) -> Int[np.ndarray, " n_starts"]:
        """The rows of a record at which sequences of so many rows may begin, counted from its first."""
        bits, count = self.known[record], int(self.rows[record])
        known = np.ones(count, bool) if bits is None else np.unpackbits(bits, count=count) > 0
        return startable_in(known, length)

    def counts(self, length: int) -> Int[np.ndarray, " R"]:
        """How many starts each record has."""
        short = np.minimum(self.rows, 1)
        counts = np.where(self.rows >= length, self.rows - length + 1, short)
        for k in (k for k, bits in enumerate(self.known) if bits is not None):
            counts[k] = len(self.starts(k, length))
        return counts

    def cut(
        self,
        seconds: float | Literal["auto"] | None,
        batch_size: int | None,
        fraction: float | None,
        lacking: Sequence[str],
    ) -> Sequences:
        """How sequences are drawn; arguments and errors as of `acausal.training.objective.sequences.cut`."""
        spans = self.ends[:, 1] - self.ends[:, 0]
        seconds, n, batch_size = batch_sizes(self.rows, spans, not lacking, seconds, batch_size)
        if seconds is None:
            raise DataError(
                "The records of a stream are trained in sequences: give their sequence_length= in seconds."
            )
        need_starts(int(self.counts(n).sum()), lacking)
        points = some(fraction, n)
        return Sequences(jnp.zeros(1, int), jnp.ones(1), n, batch_size, points, whole=False)

    def windows(
        self, training: Simulator, record: int, first: Int[np.ndarray, " m"], length: int
    ) -> Window:
        """Sequences of a record from some of its rows, stacked.

        Raises:
            DataError: if it can be read no more, or has changed.
        """
        system, name = training.system, self.names[record]
        data = {name: self.stream[name].for_system(system)}
        if len(data[name]) != self.rows[record]:
            raise DataError(f"'{name}' has changed since the training began; start it again.")
        laid, _ = lay_out(
            system, data, training.targets, None, training.solver, training.timing, even=self.even
        )
        # JAX would compile a program for every number of sequences
        found: Any = jax.tree.map(np.asarray, laid).window(first, length)
        steps, of = found.steps, np.full(len(first), record)
        alike = np.ndim(steps.h) == 0
        steps = replace(steps, h=np.full(len(first), steps.h)) if alike else steps
        return replace(found, steps=steps, of=of)


class Moments:
    """Counts, means and sums of squared deviations of targets, joined record by record (Chan et al., 1983)."""

    def __init__(self, size: int) -> None:
        self.count, self.mean, self.squares = np.zeros((3, size))

    def add(self, y: Float[np.ndarray, "n n_targets"]) -> None:
        """Add the samples of a record; NaN where there is none."""
        known = ~np.isnan(y)
        count = known.sum(axis=0)
        mean = np.sum(y, axis=0, where=known) / np.maximum(count, 1)
        total, away = np.maximum(self.count + count, 1), mean - self.mean
        self.squares += np.sum((y - mean) ** 2, axis=0, where=known)
        self.squares += away**2 * self.count * count / total
        self.mean += away * count / total
        self.count += count

    @property
    def deviation(self) -> Float[np.ndarray, " n_targets"]:
        """The standard deviations."""
        return np.sqrt(self.squares / np.maximum(self.count, 1))


def survey(
    system: System, stream: Stream, targets: Sequence[str], dtype: Any
) -> tuple[dict[str, Data], Streamed]:
    """Read every record once; returns their beginnings, in the model's units, and what is to be known of the rest.

    Raises:
        DataError: for a record that cannot be read, is too short, or lacks a target.
    """
    states = system.states[: system.reduced.n_independent]
    most = max(2, SAMPLES_IN_MEMORY // max(1, len(stream)))
    beginnings: dict[str, Data] = {}
    moments, known, times, uneven = Moments(len(targets)), [], [], False
    for name in stream:
        try:
            record = stream[name].for_system(system)
        except DataError as error:
            raise DataError(f"'{name}': {error}") from None
        if len(record) < 2:
            raise DataError(f"The record '{name}' has fewer than two samples.")
        check_resolution(record.time, precision(dtype), f"The record '{name}'")
        moments.add(record.columns(targets, f"a target of the training, in '{name}'"))
        known.append(_known(record, states))
        times.append((len(record), record.time[0], record.time[-1], record.sample_time))
        uneven |= not record.uniform
        whole = len(record) <= most
        beginnings[name] = record if whole else record.between(*record.time[[0, most - 1]])
    rows, first, last, step = np.array(times).T
    LOGGER.info("%d records of %d samples in all are read in sequences", len(rows), int(rows.sum()))
    return beginnings, Streamed(
        stream,
        tuple(beginnings),
        rows.astype(int),
        np.stack([first, last], axis=1),
        tuple(known),
        None if uneven else common(step),
        moments.deviation,
        int(moments.count.sum()),
    )


def _known(record: Data, states: Sequence[str]) -> Int[np.ndarray, " bytes"] | None:
    known: Bool[np.ndarray, " n"] = np.ones(len(record), bool)
    for name in states:
        known &= np.isfinite(record.signals[name]) if name in record.signals else False
    return None if known.all() else np.packbits(known)
