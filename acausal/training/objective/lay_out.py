"""Lay out records: the rows of a training from measured data."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from jaxtyping import Float

from acausal._jax import array, is_number
from acausal.data import Data, Signal
from acausal.errors import DataError, TrainingError, known_name, listing, shown
from acausal.simulation import (
    Adaptive,
    Samples,
    Scheme,
    Steps,
    TimeFunction,
    evaluate_all,
    functions_of_time,
    inner_fractions,
    polynomials_over_steps,
)
from acausal.training.objective.input_delays import delayed_inputs, end_to_end
from acausal.training.objective.records import Records
from acausal.training.objective.smoothing import rate
from acausal.training.objective.timing import Timing

if TYPE_CHECKING:
    from acausal.system import System

ALIKE = 1e-6
"""Sample times that differ by less than this part count as equal."""


class Grid(NamedTuple):
    """The times of the rows of a record, where its steps begin, and which rows hold samples."""

    t: Float[np.ndarray, " n"]
    sampled: np.ndarray


def lay_out(
    system: System,
    data: Mapping[str, Data],
    targets: tuple[str, ...],
    longest: float | None,
    solver: Scheme | Adaptive,
    timing: Timing,
    *,
    states: bool = True,
    measured: bool = True,
    differentiated: bool = False,
    even: float | None,
) -> tuple[Records, int]:
    """`Records` of some signals of the data, in the model's units; and how many steps there are from row to row.

    Rows are samples where these are evenly spaced; otherwise rows are added until no step is too long.

    Arguments:
        system: the model, whose states may be missing in some records.
        data: by name.
        targets: names of signals.
        longest: step in seconds; ``None`` for steps from sample to sample.
        solver: of the steps; ``timing``: the delays of inputs.
        states: whether measured states are laid out, too.
        measured: whether every record needs samples of a target, and every target in some record.
        differentiated: whether a speed that no record has is the rate of a position.
        even: the sample time that all have in common, as of `sample_time`.

    Raises:
        DataError: for a signal that is missing.
        TrainingError: if an input's delay cannot be trained.
    """
    substeps = 1 if longest is None or even is None else parts(even, longest)
    if measured:
        _need_targets(data, targets, system.inputs)
    grids = [_grid(d.time, longest if even is None else None) for d in data.values()]
    present = {n for d in data.values() for n in d.signals}
    rates = _rates(system) if differentiated else {}
    lacking = {n: of for n, of in rates.items() if n not in present}
    rows = [
        _rows(system, d, g, targets, states, lacking)
        for d, g in zip(data.values(), grids, strict=True)
    ]
    counts = np.array([len(g.t) for g in grids])
    ends = np.cumsum(counts)
    y = np.concatenate([r.y for r in rows])
    x = np.concatenate([r.x for r in rows])
    lengths = [np.append(np.diff(g.t), g.t[-1] - g.t[-2]) for g in grids]
    steps = Steps(
        array(np.concatenate([g.t for g in grids])),
        array(np.concatenate(lengths) if even is None else even),
        end_to_end([r.inputs for r in rows]),
    )
    missing = np.isnan(y)
    empty = [n for n, column in zip(targets, missing.T, strict=True) if column.all()]
    if empty and measured:
        raise DataError(f"Target '{empty[0]}' has no samples in the data.")
    sigma = array(np.ones(len(targets)) if empty else np.std(y, axis=0, where=~missing))
    records = Records(
        steps=steps,
        y=array(np.where(missing, 0.0, y)),
        weight=array(np.where(missing, 0.0, 1.0)),
        sigma=sigma,
        scale=sigma,
        x=None if np.isnan(x).any(axis=1).all() else array(x),
        of=array(np.repeat(np.arange(len(rows)), counts), int),
        first=array(ends - counts, int),
        last=array(ends - 1, int),
        sampled=array(np.concatenate([g.sampled for g in grids]), bool),
        names=tuple(data),
    )
    functions = [r.functions for r in rows]
    late = delayed_inputs(system.inputs, functions, timing, inner_fractions(solver, substeps))
    return replace(records, delayed=late), substeps


def _need_targets(
    data: Mapping[str, Data], targets: tuple[str, ...], inputs: Collection[str]
) -> None:
    """Refuse targets that no record has, and records that have none."""
    present = {n: None for d in data.values() for n in d.signals if n not in inputs or n in targets}
    for name in targets:
        known_name(name, present, "The data lack", then=", a target of the training:")
    for record, d in data.items():
        if d.signals.keys().isdisjoint(targets):
            raise DataError(
                f"'{record}' lacks {listing(targets)}, so there is nothing to compare in it: leave this record out."
            )


def _rates(system: System) -> dict[str, tuple[str, int]]:
    """By state that is the derivative of another one, that other one, and 1 or -1: of speeds the positions."""
    reduced = system.reduced
    places = {int(node): name for node, name in zip(reduced.states, system.states, strict=True)}
    found: dict[str, tuple[str, int]] = {}
    for node, name in places.items():
        rate = reduced.resolve_derivative(node, 1)
        if rate is not None and rate[0] in places:
            found[places[rate[0]]] = name, rate[1]
    return found


class _RecordRows(NamedTuple):
    """The rows of one record; NaN where nothing is measured."""

    y: Float[np.ndarray, "n n_targets"]
    x: Float[np.ndarray, "n n_states"]
    inputs: Samples
    functions: tuple[TimeFunction, ...]


def _rows(
    system: System,
    data: Data,
    grid: Grid,
    targets: tuple[str, ...],
    states: bool,
    rates: Mapping[str, tuple[str, int]],
) -> _RecordRows:
    def at_rows(columns: Float[np.ndarray, "n_samples n_names"]) -> Float[np.ndarray, "n n_names"]:
        rows = np.full((len(grid.t), columns.shape[1]), np.nan)
        rows[grid.sampled] = columns
        return rows

    span = float(grid.t[0]), float(grid.t[-1])
    functions = functions_of_time(system, data, span)
    inner = polynomials_over_steps(functions, grid.t)
    names = system.states[: system.reduced.n_independent] if states else ()
    nothing = np.full(len(data), np.nan)

    def state(name: str) -> Float[np.ndarray, " n_samples"]:
        if name in rates:
            position, sign = rates[name]
            return sign * rate(data.time, data.signals.get(position, nothing))
        return data.signals.get(name, nothing)

    x = [state(n) for n in names] or [nothing]
    y = np.stack([data.signals.get(n, nothing) for n in targets], axis=1)
    return _RecordRows(
        at_rows(y),
        at_rows(np.stack(x, axis=1)),
        _with_last(inner, functions, grid.t[-1:]),
        functions,
    )


def _with_last(
    inner: Samples, functions: tuple[TimeFunction, ...], until: Float[np.ndarray, " 1"]
) -> Samples:
    """The inputs with one more step at the end, over which they stay as they are there; those that are held jump."""
    jump = np.array([isinstance(f, Signal) and f.jumps for f in functions], bool)
    last = np.asarray(inner.end)[-1:]
    if jump.any():
        last = np.where(jump, np.asarray(evaluate_all(functions, array(until))), last)
    return end_to_end([inner, Samples(array(last), array(last))])


def _grid(samples: Float[np.ndarray, " n"], longest: float | None) -> Grid:
    """The samples' times, and between them as many others as keep steps from being longer."""
    if longest is None:
        return Grid(samples, np.ones(len(samples), bool))
    h = np.diff(samples)
    counts = np.maximum(1, np.ceil(h / longest - ALIKE)).astype(int)
    ends = np.cumsum(np.append(0, counts))
    before = np.repeat(np.arange(len(h)), counts)
    fraction = (np.arange(ends[-1]) - ends[before]) / counts[before]
    t = np.append(samples[before] + fraction * h[before], samples[-1])
    sampled = np.zeros(len(t), bool)
    sampled[ends] = True
    return Grid(t, sampled)


def sample_time(data: Iterable[Data]) -> float | None:
    """The sample time that all records have in common, if samples are evenly spaced."""
    records = list(data)
    if not all(d.uniform for d in records):
        return None
    return common(np.array([d.sample_time for d in records]))


def common(times: Float[np.ndarray, " R"]) -> float | None:
    """The number that all of some times are, if they are alike."""
    return float(times[0]) if np.ptp(times) <= ALIKE * times[0] else None


def parts(step: float, longest: float) -> int:
    """How many equal parts of a step are not too long."""
    return max(1, int(np.ceil(step / longest - ALIKE)))


def check_step(even: float | None, dt: float | None) -> None:
    """Check a user's step of the integration, where samples have a time in common.

    Raises:
        TrainingError: for what is not a step, or does not divide evenly spaced samples.
    """
    if dt is None:
        return
    if not (is_number(dt) and dt > 0):
        raise TrainingError(f"dt={shown(dt)} is not a step; give a positive time in seconds.")
    if even is None:
        return
    n = max(1, round(even / dt))
    if abs(even / dt - n) > ALIKE * n:
        raise TrainingError(
            f"dt={dt:g} s does not divide the data's sample time, {even:g} s: "
            f"choose {even / n:g} s, or resample the data."
        )
