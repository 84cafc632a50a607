"""What a user gives for a record, as columns over one time base in which a missing sample is NaN."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal, TypeAlias, get_args

import numpy as np
from jaxtyping import Float, Int
from numpy.typing import ArrayLike

from acausal._jax import need_known
from acausal.data.readers import SignalTable, is_data_frame, need_unique, seconds
from acausal.data.samples import Place, check_samples, check_time_base, sample
from acausal.errors import DataError, known_name, listing, shown
from acausal.modeling import by_name, names_in

Missing = Literal["refuse", "nan"]
"""What a NaN among samples is: a mistake, or a missing sample."""

Columns: TypeAlias = dict[str, Float[np.ndarray, " n"]]


@dataclass(frozen=True)
class GivenSignal:
    """A signal as measured: samples at times of its own, or (``times`` is None) at those of the record."""

    times: Float[np.ndarray, " n"] | None
    samples: Any


def columns_of(
    time: ArrayLike | None, signals: object, missing: Missing, mask: object, unit: str
) -> tuple[Float[np.ndarray, " n"], Columns, Missing]:
    """The time base, the signals as columns over it, and whether samples are missing.

    Arguments:
        time: of the signals that have no times of their own; None where all have.
        signals: by name, samples or a pair (times, samples).
        missing: what a NaN is.
        mask: by name, which samples count.
        unit: of time, for messages.

    Raises:
        DataError: for anything that is not this, with the signal and its first wrong sample.
    """
    if not isinstance(missing, str) or missing not in get_args(Missing):
        raise DataError(f"missing={shown(missing)}; choose one of refuse, nan.")
    columns = None if is_data_frame(signals) else signals
    need_known("acausal.Data", time, columns, mask, computes=False)
    ts = None if time is None else _times(time, "The record", unit)
    measured = {name: _measured(name, value, unit) for name, value in _by_name(signals).items()}
    _check_times(ts, measured)
    masks = _masks(mask, measured)
    checked: Columns = {}
    for name, given in measured.items():
        own = ts if given.times is None else given.times
        assert own is not None
        present = _present(name, given.samples, masks.get(name))
        place = partial(_place, ts=own, unit=unit)
        _check(name, present, own, place, "nan" if name in masks else missing)
        checked[name] = np.asarray(present, float)
    own_times = {name: given.times for name, given in measured.items() if given.times is not None}
    bases = ([] if ts is None else [ts]) + list(own_times.values())
    merged, rows = union(bases)
    rows_of = dict(zip(own_times, rows if ts is None else rows[1:], strict=True))
    columns = {
        name: _copied(on_rows(values, rows_of.get(name, rows[0]), len(merged)), values)
        for name, values in checked.items()
    }
    merged = _copied(merged, *bases)
    with_gaps = missing == "nan" or masks or any(r is not None for r in rows)
    return merged, columns, "nan" if with_gaps else "refuse"


def check_table(table: SignalTable, missing: Missing) -> None:
    """Refuse samples of a file as `columns_of` does, but name their lines.

    Raises:
        DataError: for the first wrong sample.
    """
    if table.time is None:
        return
    check_time_base(table.time, "The record", table.place)
    for name, samples in table.signals.items():
        _check(name, samples, table.time, table.place, missing)


def _by_name(signals: object) -> Mapping[str, Any]:
    """What is given for each signal.

    Raises:
        DataError: for what has no names, and for a name that is not text, or that occurs twice.
    """
    if is_data_frame(signals):
        need_unique(signals, "The data frame")
        return {n: signals[n].to_numpy() for n in names_in(signals.columns, "signals")}
    if not isinstance(signals, Mapping):
        shape = getattr(signals, "shape", None)
        raise DataError(
            "The signals of a record have names: give ac.Data(time, {'mass.s': samples}), "
            f"not {shown(signals) if shape is None else f'an array of shape {shape}'}."
        )
    return {name: signals[name] for name in names_in(signals, "signals")}


def _times(given: ArrayLike, what: str, unit: str) -> Float[np.ndarray, " n"]:
    """Times as numbers; durations as seconds.

    Raises:
        DataError: for what is no time base.
    """
    if np.ma.is_masked(given):
        raise DataError(f"{what} has masked times; leave these samples out.")
    try:
        ts = np.asarray(given)
    except TypeError:  # keys of JAX
        raise DataError(f"{what} has times that are not numbers: {shown(given)}.") from None
    if ts.dtype.kind == "m" and unit == "s":
        ts = seconds(ts)
    check_time_base(ts, what)
    if ts.dtype.kind in "iu" and not np.array_equal(ts.astype(float).astype(ts.dtype), ts):
        raise DataError(f"{what} has times that are too large for float64; subtract the first.")
    return ts.astype(float, copy=False)


def _copied(made: np.ndarray, *given: np.ndarray) -> np.ndarray:
    """An array that does not change with the user's."""
    return np.array(made) if any(np.may_share_memory(made, a) for a in given) else made


def _measured(name: str, given: Any, unit: str) -> GivenSignal:
    """Samples, or a pair (times, samples), as arrays where they can be."""
    if not (isinstance(given, tuple) and len(given) == 2 and all(map(_is_vector, given))):
        return GivenSignal(None, _array(given))
    return GivenSignal(_times(given[0], f"'{name}'", unit), _array(given[1]))


def _is_vector(given: Any) -> bool:
    return getattr(_array(given), "ndim", 0) == 1


def _array(given: Any) -> Any:
    """An array; what cannot be one stays as it is, and is refused with the other samples."""
    if given is None or isinstance(given, str | dict) or hasattr(given, "dtype"):
        return given
    try:
        return np.asarray(given)
    except ValueError:  # rows of different lengths
        return given


def _check_times(ts: object, measured: Mapping[str, GivenSignal]) -> None:
    """Refuse signals without times, and times without signals."""
    without = [name for name, given in measured.items() if given.times is None]
    if ts is None and (without or not measured):
        which = f": {listing(without)} have none" if without else ""
        raise DataError(
            f"A record needs times{which}; give ac.Data(time, signals), or a pair (times, samples) for a signal."
        )
    if ts is not None and measured and not without:
        raise DataError("All signals have times of their own; leave out those of the record.")


def _masks(given: object, measured: Mapping[str, GivenSignal]) -> Mapping[str, np.ndarray]:
    """Which samples count, by the name of a signal.

    Raises:
        DataError: for what is not an array of truth values of the signal's length.
    """
    masks: dict[str, np.ndarray] = {}
    for name, own in by_name(given, "mask", "{'mass.s': samples_that_count}").items():
        known_name(name, measured, "There is a mask for", then=" but no such signal:")
        mask, shape = _array(own), np.shape(measured[name].samples)
        if getattr(mask, "dtype", None) != np.dtype(bool):
            raise DataError(
                f"mask: '{name}' has {shown(own)}; give True for a sample that counts, else False."
            )
        if mask.shape != shape:
            raise DataError(f"mask: '{name}' has shape {mask.shape} for samples of {shape}.")
        masks[name] = np.asarray(mask)
    return masks


def _present(name: str, samples: Any, mask: np.ndarray | None) -> Any:
    """Samples with NaN for those that do not count."""
    if np.ma.is_masked(samples):
        raise DataError(
            f"'{name}' is a masked array; give its data, and mask={{'{name}': ~samples.mask}}."
        )
    return samples if mask is None else np.where(mask, samples, np.nan)


def _check(name: str, samples: Any, ts: np.ndarray, place: Place, missing: Missing) -> None:
    check_samples(
        samples,
        ts.shape,
        f"'{name}'",
        missing=missing == "nan",
        place=place,
        remedy="if such samples are missing, say missing='nan'",
    )


def _place(i: int, ts: np.ndarray, unit: str) -> str:
    return f"{sample(i)} ({ts[i]:g} {unit})"


Times: TypeAlias = Float[np.ndarray, " n"]
Rows: TypeAlias = Int[np.ndarray, " n"]

SAME = 1e-6
"""Times of two bases are one if they differ by less than this fraction of the local sample time."""


def union(bases: Sequence[Times]) -> tuple[Times, list[Rows | None]]:
    """The sorted times of all bases, and by base the rows of its samples there; ``None`` means all rows.

    Each base increases strictly. The local sample time is the shortest interval beside a sample; of times that are
    one, the earliest is kept. Equal bases cost one.
    """
    unlike, which = _unlike(bases)
    if len(unlike) == 1:
        return unlike[0], [None for _ in bases]
    everything = np.concatenate(unlike)
    order = np.argsort(everything, kind="stable")
    ts = everything[order]
    local = np.concatenate([_local_sample_time(base) for base in unlike])[order]
    is_new = np.ones(len(ts), bool)
    is_new[1:] = np.diff(ts) >= SAME * np.minimum(local[1:], local[:-1])
    rows = np.empty(len(ts), int)
    rows[order] = np.cumsum(is_new) - 1
    ends = np.cumsum([len(base) for base in unlike])[:-1]
    rows_of = np.split(rows, ends)
    merged = ts[is_new]
    return merged, [rows_of[i] if len(rows_of[i]) < len(merged) else None for i in which]


def on_rows(values: Float[np.ndarray, " n"], rows: Rows | None, length: int) -> Times:
    """Samples at their rows of a union of ``length`` times, and NaN elsewhere."""
    if rows is None:
        return values
    column = np.full(length, np.nan)
    column[rows] = values
    return column


def _unlike(bases: Sequence[Times]) -> tuple[list[Times], list[int]]:
    """The bases that differ, and by base which of them it is."""
    unlike: list[Times] = []
    which: list[int] = []
    for base in bases:
        places = (i for i, u in enumerate(unlike) if u is base or np.array_equal(u, base))
        place = next(places, len(unlike))
        unlike += [base] if place == len(unlike) else []
        which.append(place)
    return unlike, which


def _local_sample_time(ts: Times) -> Times:
    """The shorter of the two intervals beside each time."""
    steps = np.diff(ts)
    return np.minimum(np.concatenate([steps[:1], steps]), np.concatenate([steps, steps[-1:]]))
