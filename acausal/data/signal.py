"""Sampled signals: values over a time base, interpolated at any time.

A `Signal` is a pure function of time that JAX can trace. It can be a model's input, and it can be a
component's `Module` (``self.table(time)``), which is differentiated like a network.
"""

from __future__ import annotations

import warnings
from typing import Literal, get_args

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike as Scalar
from jaxtyping import Array, Float, Int
from numpy.typing import ArrayLike

from acausal._jax import array, traced
from acausal.data.band_limited import (
    FRACTIONS,
    between,
    deviation_from_line,
    polynomial_coefficients,
)
from acausal.errors import DataError

Interpolation = Literal["linear", "previous", "cubic", "band-limited"]
Extrapolation = Literal["hold", "linear", "periodic"]

UNIFORM = 1e-6
"""A time base is uniform if every sample lies within this fraction of the sample time of its place."""


class Signal(eqx.Module):
    """A signal known at samples, as a function of time.

    Arguments:
        ts: sample times in seconds, shape (n,), strictly increasing, n ≥ 2.
        values: samples, shape (n,).
        interpolation: ``"linear"``; ``"previous"`` holds each sample until the next; ``"cubic"`` is
            a Hermite spline whose derivative at a sample is that of the parabola through it and its neighbours
            (continuous derivative, exact for parabolas); ``"band-limited"`` has no frequency above half the
            sampling rate (`acausal.data.band_limited`), as after an anti-aliasing filter. It needs a uniform time base.
        extrapolation: outside of the samples, ``"hold"`` the end values, continue the ``"linear"``
            secant of the last two, or repeat them as a ``"periodic"`` signal.
        name: of the signal in error messages.

    A uniform time base is indexed by arithmetic, any other by a binary search.

    Raises:
        DataError: for a time base that is not strictly increasing and finite, samples that are not
            finite, lengths that differ, an unknown choice, or a band-limited signal on an uneven time base.
    """

    ts: Float[Array, " n"]
    values: Float[Array, " n"]
    coefficients: Float[Array, "n_coefficients n_intervals"] | None
    interpolation: Interpolation = eqx.field(static=True)
    extrapolation: Extrapolation = eqx.field(static=True)
    uniform: bool = eqx.field(static=True)

    def __init__(
        self,
        ts: ArrayLike,
        values: ArrayLike,
        interpolation: Interpolation = "linear",
        extrapolation: Extrapolation = "hold",
        *,
        name: str = "signal",
    ) -> None:
        _check_choice(name, "interpolation", interpolation, get_args(Interpolation))
        _check_choice(name, "extrapolation", extrapolation, get_args(Extrapolation))
        if not traced(ts):
            check_time_base(np.asarray(ts), f"'{name}'")
        check_samples(values, np.shape(ts), f"'{name}'")
        self.ts = array(ts)
        self.values = array(values)
        self.interpolation = interpolation
        self.extrapolation = extrapolation
        self.uniform = not traced(ts) and is_uniform(np.asarray(ts))
        self.coefficients = self._coefficients(name) if interpolation == "band-limited" else None

    @property
    def bends(self) -> Float[Array, "n_coefficients n_intervals"] | None:
        """Deprecated: `coefficients`."""
        warnings.warn(
            "Signal.bends is called Signal.coefficients now", DeprecationWarning, stacklevel=2
        )
        return self.coefficients

    def __call__(self, t: Scalar) -> Float[Array, ""]:
        """The value at time ``t`` (a scalar, in seconds); use `jax.vmap` for many times."""
        t = jnp.asarray(t, self.ts.dtype)
        first, last = self.ts[0], self.ts[-1]
        if self.extrapolation == "periodic":
            return self._inside(first + (t - first) % (last - first))
        inside = jnp.clip(t, first, last)
        value = self._inside(inside)
        if self.extrapolation == "linear":
            end = jnp.where(t < first, 0, len(self.ts) - 2)
            value = value + self._secant(end) * (t - inside)
        return value

    def _inside(self, t: Array) -> Float[Array, ""]:
        i = self._index(t)
        match self.interpolation:
            case "previous":
                return self.values[i + (t >= self.ts[i + 1])]
            case "linear":
                return self.values[i] + self._secant(i) * (t - self.ts[i])
            case "cubic":
                return self._hermite(i, t)
            case "band-limited":
                assert self.coefficients is not None
                fraction = (t - self.ts[i]) / (self.ts[i + 1] - self.ts[i])
                on_line = self.values[i] + self._secant(i) * (t - self.ts[i])
                return on_line + deviation_from_line(self.coefficients[:, i], fraction)

    def _coefficients(self, name: str) -> Float[Array, "n_coefficients n_intervals"]:
        """Coefficients of the polynomials between the samples, shape (`band_limited.DEGREE` - 1, n - 1)."""
        if not self.uniform:
            raise DataError(
                f"'{name}' is band-limited, which needs equally spaced times; resample it, "
                "or choose another interpolation."
            )
        inner = between(self.values, FRACTIONS)
        return polynomial_coefficients(self.values[:-1], self.values[1:], inner)

    def _index(self, t: Array) -> Int[Array, ""]:
        """The interval that holds ``t``: ``ts[i] <= t <= ts[i + 1]``."""
        n = len(self.ts)
        if self.uniform:
            interval = (self.ts[-1] - self.ts[0]) / (n - 1)
            i = jnp.floor((t - self.ts[0]) / interval).astype(int)
        else:
            i = jnp.searchsorted(self.ts, t, side="right") - 1
        return jnp.clip(i, 0, n - 2)

    def _secant(self, i: Scalar) -> Float[Array, ""]:
        return (self.values[i + 1] - self.values[i]) / (self.ts[i + 1] - self.ts[i])

    def _derivative(self, i: Int[Array, ""]) -> Float[Array, ""]:
        """Derivative at sample ``i`` of the parabola through it and its neighbours (at an end, the next two)."""
        if len(self.ts) == 2:
            return self._secant(0)
        j = jnp.clip(i, 1, len(self.ts) - 2)
        left, right = self._secant(j - 1), self._secant(j)
        second_difference = (right - left) / (self.ts[j + 1] - self.ts[j - 1])
        return left + second_difference * (2 * self.ts[i] - self.ts[j - 1] - self.ts[j])

    def _hermite(self, i: Array, t: Array) -> Float[Array, ""]:
        h = self.ts[i + 1] - self.ts[i]
        s = (t - self.ts[i]) / h
        a, b = self.values[i], self.values[i + 1]
        da, db = h * self._derivative(i), h * self._derivative(i + 1)
        rest = (1 - s) * (a - b + da) + s * (b - a - db)
        return a + s * (b - a) + s * (1 - s) * rest


def check_time_base(ts: np.ndarray, what: str) -> None:
    """Refuse a time base that is not a strictly increasing, finite vector of two samples or more."""
    if ts.ndim != 1 or len(ts) < 2:
        raise DataError(f"{what} needs a time base of at least two samples, got shape {ts.shape}.")
    if not np.issubdtype(ts.dtype, np.number):
        raise DataError(f"{what} has a time base of {ts.dtype}; seconds are needed.")
    bad = np.flatnonzero(~np.isfinite(ts))
    if len(bad):
        raise DataError(f"{what} has a time that is {ts[bad[0]]} at sample {bad[0]}.")
    back = np.flatnonzero(np.diff(ts) <= 0)
    if len(back):
        i = int(back[0])
        raise DataError(
            f"{what} has a time base that does not increase: "
            f"{ts[i]:g} s at sample {i} is followed by {ts[i + 1]:g} s."
        )


def check_samples(values: ArrayLike, shape: tuple[int, ...], what: str) -> None:
    """Refuse samples of another length than their time base, or that are not finite numbers."""
    if np.shape(values) != shape:
        raise DataError(f"{what} has {_count(values)} for {shape[0]} times.")
    if traced(values):
        return
    samples = np.asarray(values)
    if not np.issubdtype(samples.dtype, np.number) and samples.dtype != bool:
        raise DataError(f"{what} holds {samples.dtype}; numbers are needed.")
    bad = np.flatnonzero(~np.isfinite(samples))
    if len(bad):
        more = f" and {len(bad) - 1} more" if len(bad) > 1 else ""
        raise DataError(
            f"{what} is {samples[bad[0]]} at sample {bad[0]}{more}; leave such samples out, or fill the gap."
        )


def is_uniform(ts: Float[np.ndarray, " n"]) -> bool:
    """Whether the samples are equally spaced."""
    interval = (ts[-1] - ts[0]) / (len(ts) - 1)
    places = ts[0] + interval * np.arange(len(ts))
    return bool(np.max(np.abs(ts - places)) <= UNIFORM * interval)


def _count(values: ArrayLike) -> str:
    shape = np.shape(values)
    return f"{shape[0]} samples" if len(shape) == 1 else f"values of shape {shape}"


def _check_choice(name: str, what: str, value: str, choices: tuple[str, ...]) -> None:
    if value not in choices:
        raise DataError(f"'{name}' has {what}={value!r}; choose one of {', '.join(choices)}.")
