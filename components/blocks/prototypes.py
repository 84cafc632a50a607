"""Low passes with the cut-off 1 rad/s: the prototypes of all analog filters.

Every characteristic is a set of poles with a gain of 1 at zero frequency. Formulas: U. Tietze,
Ch. Schenk, Halbleiter-Schaltungstechnik.
"""

from math import factorial
from typing import Literal

import numpy as np

Characteristic = Literal["CriticalDamping", "Bessel", "Butterworth", "ChebyshevI"]
CHARACTERISTICS: tuple[Characteristic, ...] = (
    "CriticalDamping",
    "Bessel",
    "Butterworth",
    "ChebyshevI",
)

CUT_OFF = 10 ** (-3 / 20)
"""Amplitude at the cut-off frequency of a normalized filter: -3 dB."""


def poles(
    characteristic: Characteristic, order: int, *, normalized: bool, ripple: float
) -> tuple[list[float], list[complex]]:
    """Real poles, and those of each conjugate pair that have a positive imaginary part.

    Arguments:
        characteristic: kind of filter.
        order: number of poles.
        normalized: whether the amplitude is -3 dB at 1 rad/s; else the textbook's own cut-off.
        ripple: of the pass band of `ChebyshevI`, in dB.
    """
    found = _poles(characteristic, order, ripple)
    if normalized and characteristic != "Butterworth":
        found = found / _cut_off(found)
    real = [float(p.real) for p in found if abs(p.imag) < 1e-9 * abs(p)]
    pairs = [complex(p) for p in found if p.imag >= 1e-9 * abs(p)]
    return real, pairs


def _poles(characteristic: Characteristic, order: int, ripple: float) -> np.ndarray:
    angles = np.pi * (0.5 + (np.arange(order) + 0.5) / order)
    match characteristic:
        case "CriticalDamping":
            return np.full(order, -1.0 + 0j)
        case "Butterworth":
            return np.exp(1j * angles)
        case "ChebyshevI":
            width = np.arcsinh(1 / np.sqrt(10 ** (ripple / 10) - 1)) / order
            return np.sinh(width) * np.cos(angles) + 1j * np.cosh(width) * np.sin(angles)
        case "Bessel":
            return np.roots([_bessel(order, k) for k in range(order, -1, -1)])


def _bessel(order: int, k: int) -> float:
    """Coefficient of ``s**k`` of the reverse Bessel polynomial."""
    above = factorial(2 * order - k)
    return above / (2 ** (order - k) * factorial(k) * factorial(order - k))


def _cut_off(poles: np.ndarray) -> float:
    """Angular frequency at which the amplitude has fallen to -3 dB."""

    def amplitude(w: float) -> float:
        return float(np.abs(np.prod(poles / (1j * w - poles))))

    low, high = 0.0, 1.0
    while amplitude(high) > CUT_OFF:
        low, high = high, 2 * high
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if amplitude(middle) > CUT_OFF else (low, middle)
    return (low + high) / 2
