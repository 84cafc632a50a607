"""A record laid out for training: arrays on the device, cut into sequences."""

from __future__ import annotations

from dataclasses import replace

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax
from jaxtyping import Array, Bool, Float, Int, PRNGKeyArray

from acausal.data import Data
from acausal.errors import DataError
from acausal.simulation import Samples, Steps, functions_of_time, over_steps


class Record(eqx.Module):
    """N samples of a model's inputs, targets and states. A step begins at every sample; the last step is not used.

    Attributes:
        steps: N steps with the inputs.
        y: targets.
        sigma: their standard deviations.
        x: states, or ``None`` where they are not all measured.
    """

    steps: Steps
    y: Float[Array, "n_samples n_targets"]
    sigma: Float[Array, " n_targets"]
    x: Float[Array, "n_samples n_states"] | None

    def __len__(self) -> int:
        return self.y.shape[0]

    def window(
        self, start: Int[Array, ""], length: int
    ) -> tuple[Steps, Float[Array, "length n_targets"]]:
        """Steps and targets of the ``length`` samples from ``start`` on."""

        def cut(a: Array) -> Array:
            return lax.dynamic_slice_in_dim(a, start, length) if a.ndim else a

        return jax.tree.map(cut, self.steps), cut(self.y)


def lay_out(
    data: Data, inputs: tuple[str, ...], targets: tuple[str, ...], states: tuple[str, ...] | None
) -> Record:
    """A `Record` of some signals of the data, in the model's units.

    Raises:
        DataError: for a signal that is missing.
    """
    samples = _samples(data, inputs)
    y = data.columns(targets, "a target of the training")
    x = None if states is None else jnp.asarray(data.columns(states, "a state of the model"))
    h = np.diff(data.time)
    lengths = jnp.asarray(data.sample_time) if data.uniform else jnp.asarray(np.append(h, h[-1]))
    steps = Steps(jnp.asarray(data.time), lengths, samples)
    return Record(steps, jnp.asarray(y), jnp.asarray(y.std(axis=0)), x)


def _samples(data: Data, inputs: tuple[str, ...]) -> Samples:
    """The inputs over the steps from every sample; over the last one they stay as they are."""
    span = float(data.time[0]), float(data.time[-1])
    inner = over_steps(functions_of_time(inputs, data, span), data.time)
    last = inner.end[-1:]
    coefficients = inner.coefficients
    if coefficients is not None:
        coefficients = jnp.concatenate([coefficients, jnp.zeros_like(coefficients[:1])])
    start, end = (jnp.concatenate([side, last]) for side in (inner.start, inner.end))
    return Samples(start, end, (), coefficients)


class Batch(eqx.Module):
    """Some sequences of a record.

    Attributes:
        start: index of each one's first sample.
        weight: 1, or 0 for a sequence that is left out.
        points: which of its samples count, or ``None`` for all.
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
    """Draws random sequences of a record, and a random part of their points.

    Attributes:
        record_length: samples in the record.
        length: samples in a sequence.
        batch_size: sequences in a batch.
        points: samples that count in each sequence, or ``None`` for all.
        side_by_side: whether sequences begin where others end; else they begin at any sample.
    """

    record_length: int = eqx.field(static=True)
    length: int = eqx.field(static=True)
    batch_size: int = eqx.field(static=True)
    points: int | None = eqx.field(static=True)
    side_by_side: bool = eqx.field(static=True, default=False)

    @property
    def whole(self) -> bool:
        """Whether the one sequence is the whole record."""
        return self.length == self.record_length

    @property
    def parts(self) -> int:
        """How many sequences lie side by side in the record."""
        return self.record_length // self.length

    @property
    def always_alike(self) -> bool:
        """Whether all batches are equal."""
        complete = self.whole or (self.side_by_side and self.batch_size == self.parts)
        return complete and self.points is None

    def tile(self) -> Sequences:
        """Sequences side by side, a little longer where the record would not be filled otherwise."""
        parts = max(1, round(self.record_length / self.length))
        length = self.record_length // parts
        return Sequences(
            self.record_length, length, min(self.batch_size, parts), self.points, side_by_side=True
        )

    def draw(self, key: PRNGKeyArray) -> Batch:
        """A batch; the same key gives the same batch."""
        for_start, for_points = jax.random.split(key)
        start = self._starts(for_start)
        points = None
        if (count := self.points) is not None:
            keys = jax.random.split(for_points, self.batch_size)
            points = jax.vmap(lambda k: jax.random.choice(k, self.length, (count,), replace=False))(
                keys
            )
        return Batch(start, jnp.ones(self.batch_size), points)

    def _starts(self, key: PRNGKeyArray) -> Int[Array, " batch"]:
        if not self.side_by_side:
            last = self.record_length - self.length
            return jax.random.randint(key, (self.batch_size,), 0, last + 1)
        part = jnp.arange(self.parts)
        if self.batch_size < self.parts:
            part = jax.random.choice(key, part, (self.batch_size,), replace=False)
        return part * self.length


def sequences(
    data: Data, seconds: float | None, batch_size: int, fraction: float | None
) -> Sequences:
    """How to cut a record.

    Arguments:
        data: the record.
        seconds: length of a sequence; ``None`` takes the whole record.
        batch_size: sequences in a batch.
        fraction: part of each sequence's points that counts; ``None`` takes all.

    Raises:
        DataError: for a length, size or fraction that does not fit the record.
    """
    if seconds is not None and not np.isfinite(seconds):
        raise DataError(
            f"sequence_length={seconds} is not a length; give seconds, or None for all."
        )
    n = len(data) if seconds is None else round(seconds / data.sample_time)
    if not 2 <= n <= len(data):
        raise DataError(
            f"sequence_length={seconds:g} s is {n} samples; the record has {len(data)} at {data.sample_time:g} s."
        )
    if batch_size != int(batch_size):
        raise DataError(f"batch_size={batch_size}; give a whole number of sequences.")
    if batch_size < 1 or (seconds is None and batch_size != 1):
        raise DataError(
            f"batch_size={batch_size} needs a sequence_length in seconds, shorter than the record."
        )
    if fraction is None:
        return Sequences(len(data), n, batch_size, None)
    if not 0 < fraction <= 1:
        raise DataError(
            f"subsample={fraction:g} is not a fraction of the points; give a number in (0, 1]."
        )
    return Sequences(len(data), n, batch_size, max(1, round(fraction * n)))
