"""Delayed inputs: what a record interpolates at shifted times, exactly, with derivatives by the delay.

A signal is a polynomial between two samples, whatever its interpolation. The polynomials of all records lie end to end
in one table, so that a program has the same size however many records there are. Before the first sample of a record
and after the last one, its value there is held.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from acausal.data import FRACTIONS, Signal, deviation_from_line
from acausal.errors import TrainingError
from acausal.simulation import Samples, Steps, TimeFunction, polynomials_over_steps
from acausal.training.objective.intervals import interval
from acausal.training.objective.timing import Timing, delay_of

ASIDE = 1e-6
"""Part of a step by which a time is moved into it, so that of two polynomials the one within the step is taken."""


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
    """

    columns: tuple[int, ...] = eqx.field(static=True)
    names: tuple[str, ...] = eqx.field(static=True)
    pieces: tuple[Pieces, ...]
    fractions: tuple[float, ...] = eqx.field(static=True)

    def __call__(
        self, steps: Steps, record: Int[Array, "*n"], times: Mapping[str, Float[Array, ""]]
    ) -> Steps:
        """The same steps with inputs that come later.

        Arguments:
            steps: of the integration.
            record: of every step, or of all.
            times: the delays in seconds, by name.
        """
        if not self.columns:
            return steps
        samples = steps.inputs
        start, end, coefficients = samples.start, samples.end, samples.coefficients
        if self.fractions and coefficients is None:
            coefficients = jnp.zeros((len(start), len(FRACTIONS), start.shape[1]))
        for column, name, pieces in zip(self.columns, self.names, self.pieces, strict=True):
            begun, aside = steps.t - times[name], ASIDE * steps.h
            ended = begun + steps.h
            ends = pieces(begun + aside, begun, record), pieces(ended - aside, ended, record)
            start, end = start.at[:, column].set(ends[0]), end.at[:, column].set(ends[1])
            if coefficients is None:
                continue
            between = [begun + fraction * steps.h for fraction in self.fractions]
            values = [pieces(t, t, record) for t in between]
            curve = _coefficients(self.fractions, *ends, values)
            coefficients = coefficients.at[:, :, column].set(0.0)
            coefficients = coefficients.at[:, : len(values), column].set(curve)
        return Steps(steps.t, steps.h, Samples(start, end, samples.functions, coefficients))


def _coefficients(
    fractions: tuple[float, ...],
    start: Float[Array, " n"],
    end: Float[Array, " n"],
    values: Sequence[Float[Array, " n"]],
) -> Float[Array, "n n_fractions"]:
    """Coefficients for `deviation_from_line` of the polynomial through both ends and some values in between."""
    if not values:
        return jnp.zeros((len(start), 0))
    p = np.asarray(fractions)
    inverse = np.linalg.inv((p * (1 - p))[:, None] * p[:, None] ** np.arange(len(p)))
    line = start[:, None] + (end - start)[:, None] * p
    return (jnp.stack(values, axis=1) - line) @ inverse.T


NOTHING_DELAYED = DelayedInputs((), (), (), ())
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
    found: dict[int, tuple[str, Pieces]] = {}
    for column, name in enumerate(inputs):
        source = name
        while source not in timing.delays and source.startswith("der("):
            source = source[4:-1]
        if source not in timing.delays:
            continue
        signals = [row[column] for row in functions]
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
    return DelayedInputs(tuple(found), tuple(names), tuple(pieces), fractions)


def _pieces(signals: Sequence[TimeFunction]) -> Pieces:
    """The pieces of one signal in all records."""
    tables = [_table(s) for s in signals]
    counts = np.array([len(ts) for ts, _, _ in tables])
    ends = np.cumsum(counts)
    samples = [s for _, _, s in tables]
    curved = next((s.coefficients for s in samples if s.coefficients is not None), None)
    coefficients = None
    if curved is not None:
        straight = [np.zeros((len(s.start), curved.shape[1], 1)) for s in samples]
        rows = [
            z if s.coefficients is None else s.coefficients
            for s, z in zip(samples, straight, strict=True)
        ]
        coefficients = jnp.concatenate(rows)[:, :, 0].T
    even = all(isinstance(s, Signal) and s.uniform for s in signals)
    return Pieces(
        jnp.asarray(np.concatenate([ts for ts, _, _ in tables])),
        jnp.asarray(np.concatenate([widths for _, widths, _ in tables])),
        jnp.concatenate([s.start[:, 0] for s in samples]),
        jnp.concatenate([s.end[:, 0] for s in samples]),
        coefficients,
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
    before, after = held * inner.start[:1], held * inner.end[-1:]
    coefficients = inner.coefficients
    if coefficients is not None:
        nothing = jnp.zeros_like(coefficients[:1])
        coefficients = jnp.concatenate([nothing, coefficients, nothing])
    return (
        np.concatenate([[ts[0] - widths[0]], ts]),
        np.concatenate([widths[:1], widths, widths[-1:]]),
        Samples(
            jnp.concatenate([before, inner.start, after]),
            jnp.concatenate([before, inner.end, after]),
            (),
            coefficients,
        ),
    )
