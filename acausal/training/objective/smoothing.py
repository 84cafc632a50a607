"""Smoothing of measured signals, as much as the data themselves justify."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from jaxtyping import Bool, Float
from scipy.interpolate import PchipInterpolator
from scipy.signal import savgol_coeffs, savgol_filter

WINDOWS = (5, 9, 15, 25, 41, 67, 111, 181, 301)
"""Samples of the windows that are tried."""

DEGREE = 3
"""Degree of the polynomials that are fitted to each window's samples."""


SHORT = 10
"""The most samples that may be missing in a row for the gap to be bridged."""

UNEVEN = 1e-6
"""Sample times that differ by less than this part count as evenly spaced."""


def without_noise(
    t: Float[np.ndarray, " N"], signal: Float[np.ndarray, " N"]
) -> Float[np.ndarray, " N"]:
    """A signal whose short gaps are bridged, and `smoothed` where its samples are evenly spaced."""
    steps = np.diff(t)
    column = bridged(signal)
    return smoothed(column) if np.ptp(steps) <= UNEVEN * steps[0] else column


def rate(t: Float[np.ndarray, " N"], signal: Float[np.ndarray, " N"]) -> Float[np.ndarray, " N"]:
    """The derivative by time of what `without_noise` leaves of a signal; NaN in long gaps."""
    column = without_noise(t, signal)
    known = ~np.isnan(column)
    found = np.full_like(column, np.nan)
    if known.sum() > 1:
        found[known] = np.gradient(column[known], t[known])
    return found


def bridged(signal: Float[np.ndarray, " N"]) -> Float[np.ndarray, " N"]:
    """A signal whose short gaps are filled by a monotone cubic through their neighbours; long ones stay NaN."""
    missing = np.isnan(signal)
    known = np.flatnonzero(~missing)
    if not missing.any() or len(known) < 4:
        return signal
    found = signal.copy()
    between = PchipInterpolator(known, signal[known])
    for start, end in _runs(missing):
        if known[0] < start and end <= known[-1] and end - start <= SHORT:
            found[start:end] = between(np.arange(start, end))
    return found


def _runs(mask: Bool[np.ndarray, " N"]) -> Iterator[tuple[int, int]]:
    """First index and end of every run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    yield from zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)


def smoothed(signal: Float[np.ndarray, " N"]) -> Float[np.ndarray, " N"]:
    """A signal with evenly spaced samples, without the part of its noise that can be distinguished from it.

    A cubic polynomial is fitted to the samples around each one (A. Savitzky, M. Golay, 1964). The window is the one
    that predicts samples best from their neighbours (generalized cross-validation: P. Craven, G. Wahba, 1979).
    """
    if np.isnan(signal).any():  # from gap to gap
        pieces = signal.copy()
        for start, end in _runs(~np.isnan(signal)):
            pieces[start:end] = smoothed(signal[start:end])
        return pieces
    best, kept = signal, np.inf
    own = np.std(np.diff(signal, DEGREE + 1)) if len(signal) > DEGREE + 1 else 0.0
    if own == 0.0:
        return signal
    for window in WINDOWS:
        if window > len(signal) // 2:
            break
        centre = savgol_coeffs(window, DEGREE)[window // 2]
        found = np.asarray(savgol_filter(signal, window, DEGREE))
        score = np.mean((signal - found) ** 2) / (1 - centre) ** 2
        if score < kept:
            best, kept = found, score
    return best
