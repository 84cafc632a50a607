"""Smoothing of measured signals, as much as the data themselves justify."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import label
from scipy.signal import savgol_coeffs, savgol_filter

WINDOWS = (5, 9, 15, 25, 41, 67, 111, 181, 301)
"""Samples of the windows that are tried."""

DEGREE = 3
"""Degree of the polynomials that are fitted to each window's samples."""


SHORT = 10
"""The most samples that may be missing in a row for the gap to be bridged."""


def bridged(signal: Float[np.ndarray, " N"]) -> Float[np.ndarray, " N"]:
    """A signal whose short gaps are filled by a monotone cubic through their neighbours; long ones stay NaN."""
    missing = np.isnan(signal)
    known = np.flatnonzero(~missing)
    if not missing.any() or len(known) < 4:
        return signal
    inner = slice(known[0], known[-1] + 1)
    labels, count = label(missing[inner])
    lengths = np.bincount(labels, minlength=count + 1)
    short = missing[inner] & (lengths[labels] <= SHORT)
    found = signal.copy()
    at = known[0] + np.flatnonzero(short)
    found[at] = PchipInterpolator(known, signal[known])(at)
    return found


def smoothed(signal: Float[np.ndarray, " N"]) -> Float[np.ndarray, " N"]:
    """A signal with evenly spaced samples, without the part of its noise that can be distinguished from it.

    A cubic polynomial is fitted to the samples around each one (A. Savitzky, M. Golay, 1964). The window is the one
    that predicts samples best from their neighbours (generalized cross-validation: P. Craven, G. Wahba, 1979).
    """
    if np.isnan(signal).any():
        return _in_pieces(signal)
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


def _in_pieces(signal: Float[np.ndarray, " N"]) -> Float[np.ndarray, " N"]:
    """A signal with gaps, smoothed from gap to gap."""
    labels, count = label(~np.isnan(signal))
    found = signal.copy()
    for piece in range(1, count + 1):
        rows = labels == piece
        found[rows] = smoothed(signal[rows])
    return found
