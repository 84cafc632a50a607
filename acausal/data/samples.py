"""What measured samples must be: a time base that increases, finite real numbers where they are not missing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from jaxtyping import Float
from numpy.typing import ArrayLike

from acausal._jax import is_real, traced
from acausal.errors import DataError

UNIFORM = 1e-6
"""A time base is uniform if every sample lies within this fraction of the sample time of its place."""

LEAVE_OUT = "leave such samples out, or fill the gap"

TWICE = (
    " Leave out one of the two; for a jump of an input, say interpolation='previous', or put a "
    "blocks.CombiTimeTable into the model, which takes a time twice."
)

TEXTS = ": make numbers of texts by np.asarray(t, float)"

Place: TypeAlias = Callable[[int], str]
"""How a message names a sample by its index: ``"sample 3"``, or ``"line 5"`` of a file."""


def sample(index: int) -> str:
    """The place of a sample in an array."""
    return f"sample {index}"


def check_time_base(ts: np.ndarray, what: str, place: Place = sample) -> None:
    """Refuse a time base that is not a strictly increasing, finite vector of two samples or more."""
    if ts.ndim != 1 or len(ts) < 2:
        raise DataError(f"{what} needs a time base of at least two samples, got shape {ts.shape}.")
    if not is_real(ts) or ts.dtype == bool:
        remedy = {"M": ": give (t - t[0]) / np.timedelta64(1, 's')"} | dict.fromkeys("OUS", TEXTS)
        raise DataError(
            f"{what} has a time base of {ts.dtype}; seconds are needed{remedy.get(ts.dtype.kind, '')}."
        )
    i = _first(~np.isfinite(ts))
    if i is not None:
        raise DataError(f"{what} has a time that is {ts[i]} at {place(i)}.")
    i = _first(~(ts[1:] > ts[:-1]))
    if i is not None:
        coarse = np.issubdtype(ts.dtype, np.floating) and ts.dtype.itemsize < 8
        equal = f" Times in {ts.dtype} are too coarse for this: give float64." if coarse else TWICE
        raise DataError(
            f"{what} has a time base that does not increase: "
            f"{ts[i]:.9g} s at {place(i)} is followed by {ts[i + 1]:.9g} s."
            + (equal if ts[i] == ts[i + 1] else "")
        )


def check_resolution(ts: np.ndarray, dtype: np.dtype[Any], what: str) -> None:
    """Refuse times that a precision cannot tell apart."""
    spacing = np.spacing(np.maximum(np.abs(ts[:-1]), np.abs(ts[1:])).astype(dtype))
    i = _first(np.diff(ts) < spacing)
    if i is not None:
        raise DataError(
            f"{what}: {ts[i]:.17g} s and {ts[i + 1]:.17g} s are too close for {dtype.name}; "
            "let time start at zero, or compute in float64."
        )


def check_samples(
    values: ArrayLike,
    shape: tuple[int, ...],
    what: str,
    *,
    missing: bool = False,
    place: Place = sample,
    remedy: str = LEAVE_OUT,
) -> None:
    """Refuse samples of another length than their time base, or that are not finite real numbers.

    Arguments:
        values: the samples.
        shape: of their time base.
        what: names them in the error.
        missing: whether NaN is a missing sample; then some sample must exist.
        place: names a sample in the error.
        remedy: of a NaN.
    """
    if not is_real(values):
        raise DataError(f"{what} holds {_kind(values)}; real numbers are needed.")
    if np.shape(values) != shape:
        own = np.shape(values)
        count = f"{own[0]} samples" if len(own) == 1 else f"values of shape {own}"
        raise DataError(f"{what} has {count} for {shape[0]} times.")
    if traced(values):
        return
    samples = np.asarray(values)
    bad = np.isinf(samples) if missing else ~np.isfinite(samples)
    i = _first(bad)
    if i is not None:
        count = int(np.count_nonzero(bad))
        more = f" and {count - 1} more" if count > 1 else ""
        raise DataError(
            f"{what} is {samples[i]} at {place(i)}{more}; {remedy if np.isnan(samples[i]) else LEAVE_OUT}."
        )
    if missing and len(samples) and bool(np.isnan(samples).all()):
        raise DataError(f"{what} is missing at all times; leave it out.")


def is_uniform(ts: Float[np.ndarray, " n"]) -> bool:
    """Whether the samples are equally spaced."""
    interval = (ts[-1] - ts[0]) / (len(ts) - 1)
    distance = interval * np.arange(len(ts))
    distance += ts[0]
    distance -= ts
    return bool(np.max(np.abs(distance, out=distance)) <= UNIFORM * interval)


def _first(condition: np.ndarray) -> int | None:
    """Index of the first sample for which a condition holds."""
    i = int(np.argmax(condition)) if len(condition) else 0
    return i if len(condition) and condition[i] else None


def _kind(values: Any) -> str:
    """The type of samples, for a message."""
    if values is None:
        return "None"
    if isinstance(values, str | dict):
        return f"a {type(values).__name__}"
    try:
        return str(values.dtype if hasattr(values, "dtype") else np.asarray(values).dtype)
    except ValueError:
        return "rows of different lengths"
