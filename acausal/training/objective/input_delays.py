"""Delayed inputs: what a record interpolates at shifted times, exactly, with derivatives by the delay.

Where a shifted sample lies within a step, it divides the step: `Steps.parts`. A signal is a polynomial between two
samples, whatever its interpolation. The polynomials of all records lie end to end in one table, so that a program has
the same size however many records there are. Before the first sample of a record and after the last one, its value
there is held.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from acausal._jax import array
from acausal.data import FRACTIONS, Signal, deviation_from_line, polynomial_coefficients
from acausal.errors import TrainingError
from acausal.modeling import antiderivatives
from acausal.simulation import (
    Parts,
    Samples,
    Steps,
    TimeFunction,
    on_curve,
    polynomials_over_steps,
)
from acausal.training.objective.intervals import interval
from acausal.training.objective.timing import Timing, delay_of

ASIDE = 1e-6
"""Part of a step by which a time is moved into it, so that of two polynomials the one within the step is taken."""


MOST = 4
"""Where samples are unevenly spaced and the delay is trained, so many of them, at most, divide a step."""


class Pieces(eqx.Module):
    """A signal of R records as polynomials over M intervals.

    Attributes:
        ts: where each interval begins, in seconds; ``widths``: its length.
        start, end: the signal there.
        coefficients: of its deviation from the line in between; ``None`` where all are lines.
        first, last: of every record, the intervals before its first and after its last sample.
        step: of every record, the interval between samples; ``None`` where it is not the same throughout each.
    """

    ts: Float[Array, " M"]
    widths: Float[Array, " M"]
    start: Float[Array, " M"]
    end: Float[Array, " M"]
    coefficients: Float[Array, "n_coefficients M"] | None
    first: Int[Array, " R"]
    last: Int[Array, " R"]
    step: Float[Array, " R"] | None

    def next_ends(
        self, t: Float[Array, " n"], record: Int[Array, "*n"], count: int
    ) -> list[Float[Array, " n"]]:
        """The first so many times behind others at which one polynomial ends and another begins; or infinite."""
        low, high = self.first[record], self.last[record]
        i = interval(self.ts, low, high, t, None if self.step is None else self.step[record])
        there = [jnp.minimum(i + k, high) for k in range(1, count + 1)]
        return [
            jnp.where(i + k <= high, self.ts[j], jnp.inf)
            for k, j in zip(range(1, count + 1), there, strict=True)
        ]

    def __call__(
        self, around: Float[Array, "*n"], t: Float[Array, "*n"], record: Int[Array, "*n"]
    ) -> Float[Array, "*n"]:
        """The polynomial around a time, at a time, of a record."""
        low, high = self.first[record], self.last[record]
        step = None if self.step is None else self.step[record]
        # before the first sample there is a piece as long as all others, where samples are equally spaced
        i = interval(self.ts, low, high, around, step)
        fraction = (t - self.ts[i]) / self.widths[i]
        value = self.start[i] + fraction * (self.end[i] - self.start[i])
        if self.coefficients is None:
            return value
        return value + deviation_from_line(self.coefficients[:, i], fraction)


class DelayedInputs(eqx.Module):
    """The inputs that are delayed.

    Attributes:
        columns: their places among the model's inputs.
        names: of their delays.
        pieces: their signals.
        fractions: of a step, where its scheme looks at inputs, besides the ends. There a delayed input is exact.
        most: how many samples of one of them lie within a step, at most; those beyond do not divide it.
    """

    columns: tuple[int, ...] = eqx.field(static=True)
    names: tuple[str, ...] = eqx.field(static=True)
    pieces: tuple[Pieces, ...]
    fractions: tuple[float, ...] = eqx.field(static=True)
    most: int = eqx.field(static=True)

    def __call__(
        self, steps: Steps, record: Int[Array, "*n"], times: Mapping[str, Float[Array, ""]]
    ) -> Steps:
        """The same steps, of one record or each of its own, with inputs that come later, by seconds by name."""
        if not self.columns:
            return steps
        samples, n = steps.inputs, len(steps.t)
        whole = jnp.zeros((n, 1)), jnp.ones((n, 1))
        over = self._over(steps, record, times, *whole)
        inputs = jax.tree.map(lambda a: a[:, 0], over)
        cuts = self._cuts(steps, record, times)
        bounds = jnp.concatenate([whole[0], cuts, whole[1]], axis=1)
        parts = Parts(cuts, self._over(steps, record, times, bounds[:, :-1], bounds[:, 1:]))
        return replace(steps, inputs=replace(inputs, functions=samples.functions), parts=parts)

    def _cuts(
        self, steps: Steps, record: Int[Array, "*n"], times: Mapping[str, Float[Array, ""]]
    ) -> Float[Array, "n p"]:
        """The fractions of steps at which a delayed sample lies within, increasing; 1 where there is none."""
        found: list[Array] = []
        for name, pieces in zip(self.names, self.pieces, strict=True):
            begun = steps.t - times[name]
            for end in pieces.next_ends(begun + ASIDE * steps.h, record, self.most):
                fraction = (end - begun) / steps.h
                found.append(jnp.where(fraction < 1 - ASIDE, fraction, 1.0))
        return jnp.sort(jnp.stack(found, axis=1), axis=1)

    def _over(
        self,
        steps: Steps,
        record: Int[Array, "*n"],
        times: Mapping[str, Float[Array, ""]],
        low: Float[Array, "n p"],
        high: Float[Array, "n p"],
    ) -> Samples:
        """All inputs over parts of the steps, from one fraction to another."""
        inputs, h = steps.inputs, jnp.broadcast_to(steps.h, steps.t.shape)[:, None]
        nodes = (0.0, *self.fractions, 1.0)
        aside = ASIDE * (high - low)  # the whole step has other pieces at its ends
        columns: list[list[Array]] = []
        for column in range(inputs.start.shape[1]):
            if column in self.columns:
                k = self.columns.index(column)
                begun = (steps.t - times[self.names[k]])[:, None]
                of = jnp.broadcast_to(record, steps.t.shape)[:, None]
                columns.append([])
                for node in nodes:
                    at = low + node * (high - low)
                    inner = jnp.clip(at, low + aside, high - aside)
                    columns[-1].append(self.pieces[k](begun + h * inner, begun + h * at, of))
            else:
                curve = inputs.coefficients
                curve = None if curve is None else curve[:, :, column].T[:, :, None]
                ends = inputs.start[:, column, None], inputs.end[:, column, None]
                at = [low + node * (high - low) for node in nodes]
                columns.append([on_curve(*ends, curve, s) for s in at])
        start, end = (jnp.stack([c[k] for c in columns], axis=-1) for k in (0, -1))
        if not self.fractions:
            return Samples(start, end)
        inner = jnp.stack([jnp.stack(c[1:-1], axis=-1) for c in columns], axis=-2)
        curves = polynomial_coefficients(start, end, inner, self.fractions)
        return Samples(start, end, (), jnp.moveaxis(curves, 0, -2))


NOTHING_DELAYED = DelayedInputs((), (), (), (), 0)
"""No input is delayed."""


def delayed_inputs(
    inputs: Sequence[str],
    functions: Sequence[Sequence[TimeFunction]],
    timing: Timing,
    fractions: tuple[float, ...] | None,
) -> DelayedInputs:
    """The inputs that are delayed; a derivative of an input comes as late as the input.

    Arguments:
        inputs: names of the model's inputs.
        functions: these, for each record.
        timing: the delays.
        fractions: of a step, where its scheme looks at inputs, besides the ends, if it says; where these are too many,
            a delayed input is the polynomial through as many points as others.

    Raises:
        TrainingError: if an input jumps, so that the loss has no gradient by its delay.
    """
    functions_of = list(zip(*functions, strict=True))
    found: dict[int, tuple[str, Pieces]] = {}
    for column, name in enumerate(inputs):
        source = next((form for form in antiderivatives(name) if form in timing.delays), None)
        if source is None:
            continue
        signals = functions_of[column]
        if delay_of(source) in timing.trained and any(
            isinstance(s, Signal) and s.jumps for s in signals
        ):
            better = "cubic" if source != name else "linear"
            raise TrainingError(
                f"The delay of '{source}' cannot be trained: '{name}' jumps from sample to sample, and a jump has no "
                f"slope; say interpolation='{better}' in ac.Data, or fix the delay by a number."
            )
        found[column] = delay_of(source), _pieces(signals)
    if not found:
        return NOTHING_DELAYED
    names, pieces = [n for n, _ in found.values()], [p for _, p in found.values()]
    if fractions is None or len(fractions) > len(FRACTIONS):
        fractions = tuple(FRACTIONS.tolist())
    most = max(
        _most_within(functions_of[column], timing, name)
        for column, name in zip(found, names, strict=True)
    )
    return DelayedInputs(tuple(found), tuple(names), tuple(pieces), fractions, most)


def _most_within(signals: Sequence[TimeFunction], timing: Timing, name: str) -> int:
    """How many samples of a signal lie within a step, at most, once they are delayed; steps begin at samples."""
    found = 1
    for signal in signals:
        assert isinstance(signal, Signal)
        if signal.uniform:
            continue
        ts = np.asarray(signal.ts)
        if name in timing.trained:
            behind = np.searchsorted(ts, ts + np.diff(ts).max(), side="right")
            found = max(found, min(int((behind - np.arange(len(ts))).max()), MOST))
        else:
            at = np.searchsorted(ts, ts + float(timing.values[name]))
            found = max(found, int(np.bincount(at).max()))
    return found


def _pieces(signals: Sequence[TimeFunction]) -> Pieces:
    """The pieces of one signal in all records."""
    tables = [_table(s) for s in signals]
    counts = np.array([len(ts) for ts, _, _ in tables])
    ends = np.cumsum(counts)
    samples = end_to_end([s for _, _, s in tables])
    curves = samples.coefficients
    even = all(isinstance(s, Signal) and s.uniform for s in signals)
    return Pieces(
        jnp.asarray(np.concatenate([ts for ts, _, _ in tables])),
        jnp.asarray(np.concatenate([widths for _, widths, _ in tables])),
        samples.start[:, 0],
        samples.end[:, 0],
        None if curves is None else curves[:, :, 0].T,
        jnp.asarray(ends - counts),
        jnp.asarray(ends - 1),
        jnp.asarray([widths[1] for _, widths, _ in tables]) if even else None,
    )


def _table(function: TimeFunction) -> tuple[np.ndarray, np.ndarray, Samples]:
    """Where one record's pieces begin, how long they are, and the signal over them; the first and last are held."""
    assert isinstance(function, Signal)
    ts = np.asarray(function.ts)
    inner = polynomials_over_steps((function,), ts)
    widths = np.diff(ts)
    if function.uniform:
        widths = np.full(len(widths), (ts[-1] - ts[0]) / len(widths))
    held = 0.0 if function.derivative else 1.0
    # what a held input has at its last sample is no part of the interval before
    before, after = held * inner.start[:1], held * jnp.reshape(function(ts[-1]), (1, 1))
    return (
        np.concatenate([[ts[0] - widths[0]], ts]),
        np.concatenate([widths[:1], widths, widths[-1:]]),
        end_to_end([Samples(before, before), inner, Samples(after, after)]),
    )


def end_to_end(parts: Sequence[Samples]) -> Samples:
    """Inputs over steps that follow each other; where some are curved, the others are lines."""
    if len(parts) == 1:
        return parts[0]
    start, end = (
        array(np.concatenate(sides))
        for sides in zip(*((p.start, p.end) for p in parts), strict=True)
    )
    curved = next((p.coefficients for p in parts if p.coefficients is not None), None)
    if curved is None:
        return Samples(start, end)
    filled = [
        np.zeros((len(p.start), *curved.shape[1:])) if p.coefficients is None else p.coefficients
        for p in parts
    ]
    return Samples(start, end, (), array(np.concatenate(filled)))
