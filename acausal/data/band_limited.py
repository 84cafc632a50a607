"""Band-limited signals: what lies between samples that hold all of a signal's frequencies.

A recorder with an anti-aliasing filter leaves nothing above half its sampling rate. Then the samples determine the
signal at all times (C. E. Shannon: Communication in the presence of noise, Proceedings of the IRE 37, 1949), and a line
between them is wrong where frequencies are high.
"""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.typing import ArrayLike

DEGREE = 7
"""Of the polynomial that stands for a signal between two samples: exact to 1e-5 at half the sampling rate."""

FRACTIONS = (1 - np.cos(np.pi * np.arange(1, DEGREE) / DEGREE)) / 2
"""Where within an interval the polynomial is fixed beside its ends: Chebyshev's extrema."""

_BASIS = (FRACTIONS * (1 - FRACTIONS))[:, None] * FRACTIONS[:, None] ** np.arange(DEGREE - 1)
_INVERSE = np.linalg.inv(_BASIS)


def between(values: Array, fractions: np.ndarray) -> Array:
    """A band-limited signal between its equally spaced samples.

    The signal is continued beyond both ends by reflection in its end points, less the line through them, which
    leaves neither jump nor kink, and shifted by multiplication of its Fourier transform.

    Arguments:
        values: samples, shape (n,).
        fractions: of an interval, shape (k,).

    Returns:
        The values at these fractions of every interval, shape (n - 1, k).
    """
    n = len(values) - 1
    place = np.arange(n + 1) / n
    line = values[0] + (values[-1] - values[0]) * place
    rest = values - line
    spectrum = jnp.fft.rfft(jnp.concatenate([rest[:-1], -rest[:0:-1]]))
    turn = jnp.exp(1j * np.pi / n * np.arange(n + 1) * fractions[:, None])
    moved = jnp.fft.irfft(spectrum * turn, 2 * n)[:, :n]
    on_line = line[:-1, None] + (line[1:] - line[:-1])[:, None] * fractions
    return moved.T + on_line


def bends(start: Array, end: Array, inner: Array) -> Array:
    """Coefficients of the polynomial through an interval's ends and its values at `FRACTIONS`.

    It is ``start + p (end - start) + p (1 - p) (b0 + b1 p + ...)`` for the fraction p.

    Arguments:
        start, end: values at the ends, any shape.
        inner: values in between, with a last axis of ``DEGREE - 1``.

    Returns:
        The coefficients b, the last axis first: shape (DEGREE - 1, ...).
    """
    line = start[..., None] + (end - start)[..., None] * FRACTIONS
    return jnp.moveaxis((inner - line) @ _INVERSE.T, -1, 0)


def bow(bends: Array, fraction: ArrayLike) -> Array:
    """How far the polynomial is from the line between its ends: ``p (1 - p) (b0 + b1 p + ...)``."""
    p, value = jnp.asarray(fraction), bends[-1]
    for b in bends[-2::-1]:
        value = b + p * value
    return p * (1 - p) * value
