"""Gaps: where a signal has missing samples for long."""

from __future__ import annotations

import warnings

import numpy as np
from jaxtyping import Float

from acausal.errors import user_level

LONG = 10
"""An interval without samples is a gap if it is longer than this many median sample times of its signal."""


def warn_of_gaps(ts: Float[np.ndarray, " n"], name: str, interpolation: str) -> None:
    """Warn once of the gaps of a signal that is used as a function of time; the longest is named.

    Arguments:
        ts: times of the samples that exist, in seconds.
        name: of the signal.
        interpolation: what bridges the gaps.
    """
    steps = np.diff(ts)
    median = float(np.median(steps)) if len(steps) else 0.0
    count = int(np.count_nonzero(steps > LONG * median))
    if not count:
        return
    i = int(np.argmax(steps))
    others = f" and {count - 1} more gap{'s' * (count > 2)}" if count > 1 else ""
    warnings.warn(
        f"'{name}' has no samples from {ts[i]:g} to {ts[i + 1]:g} s, {steps[i] / median:.3g} times its median sample "
        f"time{others}; the interpolation '{interpolation}' bridges it. If that is wrong, use the record on both "
        "sides of the gap: data.between(start, end).",
        stacklevel=user_level(),
    )
