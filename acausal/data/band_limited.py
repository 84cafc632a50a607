"""Interpolation of band-limited signals, whose samples hold all of their frequencies.

A recorder with an anti-aliasing filter passes no frequency above half its sampling rate. Then the samples determine the
signal at all times (C. E. Shannon: Communication in the presence of noise, Proceedings of the IRE 37, 1949), and linear
interpolation is wrong where frequencies are high.
"""

from __future__ import annotations

from functools import cache

import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float

DEGREE = 7
"""Degree of the polynomial between two samples: exact to 1e-5 at half the sampling rate."""

FRACTIONS = (1 - np.cos(np.pi * np.arange(1, DEGREE) / DEGREE)) / 2
"""Fractions of an interval at which the polynomial interpolates, besides the ends: Chebyshev extrema."""


def between(
    values: Float[Array, " n"], fractions: Float[np.ndarray, " k"]
) -> Float[Array, "n_intervals k"]:
    """A band-limited signal at some fractions of every interval between its equally spaced samples.

    The line through both ends is subtracted, the rest is continued as an odd function about its ends, which leaves
    neither a jump nor a kink, and shifted by multiplying its Fourier transform.
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


def polynomial_coefficients(
    start: Float[Array, ...],
    end: Float[Array, ...],
    inner: Float[Array, "... n_inner"],
    fractions: tuple[float, ...] = tuple(FRACTIONS.tolist()),
) -> Float[Array, "n_inner ..."]:
    """Coefficients of the polynomial through an interval's ends and its values at some fractions of it.

    It is ``start + p (end - start) + p (1 - p) (b0 + b1 p + ...)`` for the fraction p.

    Arguments:
        start, end: values at the ends, any shape.
        inner: values in between, with a last axis of the fractions.
        fractions: of the interval, between 0 and 1.

    Returns:
        The coefficients b, with their axis first: shape (n_inner, ...).
    """
    line = start[..., None] + (end - start)[..., None] * np.asarray(fractions)
    return jnp.moveaxis((inner - line) @ _inverse(fractions).T, -1, 0)


@cache
def _inverse(fractions: tuple[float, ...]) -> Float[np.ndarray, "n_inner n_inner"]:
    """Coefficients from deviations of the line at fractions."""
    p = np.asarray(fractions)
    return np.linalg.inv((p * (1 - p))[:, None] * p[:, None] ** np.arange(len(p)))


def deviation_from_line(
    coefficients: Float[Array, "n_inner ..."], fraction: ArrayLike
) -> Float[Array, ...]:
    """The polynomial less the line between its ends, ``p (1 - p) (b0 + b1 p + ...)``."""
    p, value = jnp.asarray(fraction), coefficients[-1]
    for b in coefficients[-2::-1]:
        value = b + p * value
    return p * (1 - p) * value
