"""Sensors: a first-order lag, then a delay, of what the model predicts, before it is compared with what is measured.

A lag is integrated exactly for outputs that are linear over each row, so that it is stable whatever its time constant,
and with none it is not there at all. A delay looks at the rows' cubic interpolation, that of `acausal.Signal`. Both
know one record at a time: nothing passes from the end of one to the start of the next.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from acausal.training.objective.intervals import interval
from acausal.training.objective.records import Records, Window
from acausal.training.objective.timing import Timing, delay_of, lag_of

FASTEST = 1 / 700
"""A smaller time constant, relative to a row, leaves nothing of what a row begins with: ``exp(-700)``."""

Times = Mapping[str, Float[Array, ""]]
"""Delays and time constants in seconds, by name."""


class SensorRows(NamedTuple):
    """The rows at which outputs are predicted.

    Attributes:
        t: their times.
        h: how long each is, or all are.
        first, last: of the record of each row, or of all, the first and last row.
    """

    t: Float[Array, " n"]
    h: Float[Array, "*n"]
    first: Int[Array, "*n"]
    last: Int[Array, "*n"]


class Sensors(eqx.Module):
    """What sensors make of targets.

    Attributes:
        delays: the names of delays by column of the targets; ``lags``: those of lags.
    """

    delays: tuple[tuple[int, str], ...] = eqx.field(static=True)
    lags: tuple[tuple[int, str], ...] = eqx.field(static=True)

    @staticmethod
    def of(timing: Timing, targets: Sequence[str]) -> Sensors:
        """Those of the targets."""
        columns = list(enumerate(targets))
        return Sensors(
            tuple((i, delay_of(n)) for i, n in columns if n in timing.delays),
            tuple((i, lag_of(n)) for i, n in columns if n in timing.lags),
        )

    def over_records(
        self, y: Float[Array, "N n_targets"], records: Records, times: Times
    ) -> Float[Array, "N n_targets"]:
        """What is measured at every row of all records, each of which starts at rest."""
        if not (self.delays or self.lags):
            return y
        steps, of = records.steps, records.of
        rows = SensorRows(steps.t, steps.h, records.first[of], records.last[of])
        return self._seen(y, rows, times, y[rows.first])

    def over_window(
        self,
        y: Float[Array, "length n_targets"],
        window: Window,
        records: Records,
        start: Int[Array, ""],
        times: Times,
    ) -> tuple[Float[Array, "length n_targets"], Float[Array, "length n_targets"]]:
        """What is measured over a sequence, and how much it counts.

        Within a record a lag starts with what is measured, where it is, and what a delay brings from before the
        sequence counts for nothing.
        """
        if not (self.delays or self.lags):
            return y, window.weight
        steps, record = window.steps, records.of[start]
        last = jnp.minimum(records.last[record] - start, len(y) - 1)
        rows = SensorRows(steps.t, steps.h, jnp.zeros_like(last), last)
        within = start > records.first[record]
        known = within & (window.weight[0] > 0)
        initial = jnp.where(known, window.y[0], y[0])
        weight = window.weight
        for column, name in self.delays:
            at = steps.t - times[name]
            outside = within & ((at < steps.t[0]) | (at > steps.t[last]))
            weight = weight.at[:, column].set(jnp.where(outside, 0.0, weight[:, column]))
        return self._seen(y, rows, times, jnp.broadcast_to(initial, y.shape)), weight

    def _seen(
        self,
        y: Float[Array, "n n_targets"],
        rows: SensorRows,
        times: Times,
        initial: Float[Array, "n n_targets"],
    ) -> Float[Array, "n n_targets"]:
        for column, name in self.lags:
            lag = lagged(y[:, column], rows, times[name], initial[:, column])
            y = y.at[:, column].set(lag)
        for column, name in self.delays:
            y = y.at[:, column].set(delayed(y[:, column], rows, times[name]))
        return y


def lagged(
    y: Float[Array, " n"], rows: SensorRows, T: Float[Array, ""], initial: Float[Array, " n"]
) -> Float[Array, " n"]:
    """``T dz/dt = y - z`` for a y that is linear over each row, from an initial value at the first row of a record.

    The difference d = z - y falls to ``e d - r (1 - e) (y' - y)`` over a row of length h, with r = T/h and
    e = exp(-1/r).
    """
    h = rows.h if rows.h.ndim == 0 else jnp.concatenate([rows.h[:1], rows.h[:-1]])
    ratio = T / h
    slow = ratio > FASTEST
    inverse = 1 / jnp.where(slow, ratio, 1.0)
    left = jnp.where(slow, jnp.exp(-inverse), 0.0)
    behind = ratio * jnp.where(slow, -jnp.expm1(-inverse), 1.0)
    moved = jnp.diff(y, prepend=y[:1])
    begins = jnp.arange(len(y)) == rows.first
    factor = jnp.where(begins, 0.0, left)
    added = jnp.where(begins, initial - y, -behind * moved)

    def after(
        one: tuple[Array, Array], two: tuple[Array, Array]
    ) -> tuple[Float[Array, " n"], Float[Array, " n"]]:
        return one[0] * two[0], two[0] * one[1] + two[1]

    return y + jax.lax.associative_scan(after, (factor, added))[1]


def delayed(y: Float[Array, " n"], rows: SensorRows, tau: Float[Array, ""]) -> Float[Array, " n"]:
    """``y(t - tau)`` by cubic interpolation; before a record's first row and after its last one y is held."""
    t, h, first, last = rows
    first, last = (jnp.broadcast_to(end, t.shape) for end in (first, last))
    at = jnp.clip(t - tau, t[first], t[last])
    low = interval(t, first, jnp.maximum(last - 1, first), at, h if h.ndim == 0 else None)
    high = jnp.minimum(low + 1, last)
    width = t[high] - t[low]
    p = (at - t[low]) / jnp.where(width > 0, width, 1.0)
    a, b = y[low], y[high]
    da, db = (width * _slope(y, t, i, first, last) for i in (low, high))
    return a + p * (b - a) + p * (1 - p) * ((1 - p) * (a - b + da) + p * (b - a - db))


def _slope(
    y: Float[Array, " n"],
    t: Float[Array, " n"],
    i: Int[Array, " n"],
    first: Int[Array, " n"],
    last: Int[Array, " n"],
) -> Float[Array, " n"]:
    """The derivative at rows of the parabola through each and its neighbours (at an end, the next two)."""
    j = jnp.clip(i, first + 1, jnp.maximum(last - 1, first + 1))
    j = jnp.minimum(j, last)
    before, after = jnp.maximum(j - 1, first), jnp.minimum(j + 1, last)
    left, right = (_secant(y, t, *ends) for ends in ((before, j), (j, after)))
    span = t[after] - t[before]
    bend = jnp.where(after > j, (right - left) / jnp.where(span > 0, span, 1.0), 0.0)
    return left + bend * (2 * t[i] - t[before] - t[j])


def _secant(
    y: Float[Array, " n"], t: Float[Array, " n"], i: Int[Array, " n"], j: Int[Array, " n"]
) -> Float[Array, " n"]:
    width = t[j] - t[i]
    return (y[j] - y[i]) / jnp.where(width > 0, width, 1.0)
