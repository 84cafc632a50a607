"""Sampled signals: values over a time base, interpolated at any time.

A `Signal` is a pure function of time that JAX can trace. It can be a model's input, and it can be a
component's `Module` (``self.table(time)``), which is differentiated like a network.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import partial
from typing import Literal, get_args

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike as Scalar
from jaxtyping import Array, Float, Int
from numpy.typing import ArrayLike

from acausal._jax import array, is_number, is_real, traced
from acausal.data.band_limited import (
    DEGREE,
    FRACTIONS,
    between,
    deviation_from_line,
    polynomial_coefficients,
)
from acausal.data.by_signal import check_choice
from acausal.data.samples import check_samples, check_time_base, is_uniform
from acausal.data.slopes import SLOPES
from acausal.errors import DataError, need_whole, shown

Interpolation = Literal[
    "linear", "previous", "cubic", "akima", "modified-akima", "monotone", "steffen", "band-limited"
]
Extrapolation = Literal["hold", "linear", "periodic"]
Beyond = Literal["refuse", "hold", "linear", "periodic"]
"""What a signal does beyond one end of its samples; ``"refuse"`` is what it does where nothing is said."""

DERIVATIVES: dict[str, int] = {
    "previous": 0, "linear": 1, **dict.fromkeys(SLOPES, 2), "band-limited": 2,
}  # fmt: skip
"""How often each interpolation can be differentiated. Beyond that, derivatives are impulses or dominated by noise."""

DEGREES: dict[str, int] = {
    "previous": 0, "linear": 1, **dict.fromkeys(SLOPES, 3), "band-limited": DEGREE,
}  # fmt: skip
"""Of the polynomials between two samples, at most."""

SIGHT = 4
"""So many samples of a smooth signal are looked at by one step."""

CLOSE = 1e-14
"""Samples that are so close, relative to the largest time, are a jump."""

ORDINALS = ("first", "second", "third", "higher")


class Signal(eqx.Module):
    """A signal known at samples, as a function of time.

    Arguments:
        ts: sample times in seconds, shape (n,), strictly increasing, n ≥ 2.
        values: samples, shape (n,).
        interpolation: ``"linear"``; ``"previous"`` holds each sample until the next; ``"cubic"`` is
            a Hermite spline whose derivative at a sample is that of the parabola through it and its neighbours
            (continuous derivative, exact for parabolas); ``"akima"`` and ``"modified-akima"`` have Akima's,
            which overshoot less; ``"monotone"`` (Fritsch and Butland) and ``"steffen"`` rise and fall only where
            the samples do (`acausal.data.slopes`); ``"band-limited"`` has no frequency above half the
            sampling rate (`acausal.data.band_limited`), as after an anti-aliasing filter. It needs a uniform time base.
        extrapolation: outside of the samples, ``"hold"`` the end values, continue by a ``"linear"`` one (the
            secant of the last two samples, of cubic ones the tangent), or repeat them as a ``"periodic"`` signal.
        before_start, after_end: the same for one side alone. Where nothing is said, a function call holds the end
            values, but a simulation that reaches beyond the samples refuses the signal as its input.
        name: of the signal in error messages.

    A uniform time base is indexed by arithmetic, any other by a binary search.

    Raises:
        DataError: for a time base that is not strictly increasing and finite, samples that are not
            finite real numbers, lengths that differ, an unknown choice, or a band-limited signal on uneven times.

    Attributes:
        derivative: how often the interpolation is differentiated, see `differentiated`. ``values`` are samples of the
            signal itself.
    """

    ts: Float[Array, " n"]
    values: Float[Array, " n"]
    coefficients: Float[Array, "n_coefficients n_intervals"] | None
    interpolation: Interpolation = eqx.field(static=True)
    before_start: Beyond = eqx.field(static=True)
    after_end: Beyond = eqx.field(static=True)
    derivative: int = eqx.field(static=True)
    uniform: bool = eqx.field(static=True)

    def __init__(
        self,
        ts: ArrayLike,
        values: ArrayLike,
        interpolation: Interpolation = "linear",
        extrapolation: Extrapolation | None = None,
        *,
        before_start: Beyond | None = None,
        after_end: Beyond | None = None,
        name: str = "signal",
    ) -> None:
        if not isinstance(name, str):  # pyright: ignore[reportUnnecessaryIsInstance]
            raise DataError(f"name={shown(name)} is not a name; give a text.")
        check_choice(f"'{name}'", "interpolation", interpolation, get_args(Interpolation))
        if extrapolation is not None:
            check_choice(f"'{name}'", "extrapolation", extrapolation, get_args(Extrapolation))
        if isinstance(ts, jax.Array) and not is_real(ts):  # keys, of which NumPy makes nothing
            raise DataError(f"'{name}' has the times {shown(ts)}; give real numbers.")
        if np.ma.is_masked(ts) or np.ma.is_masked(values):
            raise DataError(
                f"'{name}' is masked; leave out the samples that are, with their times."
            )
        if not traced(ts):
            check_time_base(np.asarray(ts), f"'{name}'")
        check_samples(values, np.shape(ts), f"'{name}'")
        self.ts = array(ts)
        self.values = array(values)
        self.interpolation = interpolation
        self.before_start = before_start or extrapolation or "refuse"
        self.after_end = after_end or extrapolation or "refuse"
        check_choice(f"'{name}'", "before_start", self.before_start, get_args(Beyond))
        check_choice(f"'{name}'", "after_end", self.after_end, get_args(Beyond))
        self.derivative = 0
        self.uniform = not traced(ts) and is_uniform(np.asarray(ts))
        self.coefficients = self._coefficients(name) if interpolation == "band-limited" else None

    @property
    def jumps(self) -> bool:
        """Whether it jumps at its samples."""
        smooth = self.interpolation == "band-limited"
        return self.derivative == DERIVATIVES[self.interpolation] and not smooth

    def differentiated(self, times: int = 1, *, name: str = "signal") -> Signal:
        """The derivative of the interpolation, by time; beyond the samples, where nothing is said, that at the end.

        Raises:
            DataError: where the interpolation has none.
        """
        order = self.derivative + need_whole(times, "differentiated: times", least=0)
        if order > DERIVATIVES[self.interpolation]:
            raise DataError(_no_derivative(name, self.interpolation, order))
        return self._with(derivative=order)

    def delayed(self, seconds: Scalar) -> Signal:
        """The same signal, so many seconds later: ``u(t - seconds)``, exactly, such as with a delay from `Fit.delays`.

        Where its samples then begin late or end early, and nothing else was said, the value there is held.

        Raises:
            DataError: for what is not a number.
        """
        if not is_number(seconds):
            raise DataError(f"A signal cannot be delayed by {shown(seconds)}; give seconds.")
        return self._with(
            ts=self.ts + jnp.asarray(seconds, self.ts.dtype),
            before_start="hold" if self.before_start == "refuse" else self.before_start,
            after_end="hold" if self.after_end == "refuse" else self.after_end,
        )

    def _with(self, **changed: object) -> Signal:
        found = object.__new__(Signal)
        for field in dataclasses.fields(self):
            value = changed.get(field.name, getattr(self, field.name))
            object.__setattr__(found, field.name, value)
        return found

    @property
    def is_line(self) -> bool:
        """Whether it is a line between two samples, or constant."""
        return DEGREES[self.interpolation] <= self.derivative + 1

    def ahead(self, t: Scalar) -> tuple[Array, Array, Array]:
        """What lies beyond a time: the next at which it jumps, or bends, and up to which one step may look.

        A cubic or band-limited signal does neither, but a step that leaps over `SIGHT` samples might miss a peak.
        Infinite where there is nothing. Where two samples are next to each other, it jumps.
        """
        n, first, last = len(self.ts), self.ts[0], self.ts[-1]
        t = jnp.asarray(t, self.ts.dtype)
        period, shift = last - first, jnp.zeros_like(t)
        whole = jnp.floor((t - first) / period) * period
        repeats = jnp.zeros_like(t, dtype=bool)
        for choice, side in ((self.before_start, t < first), (self.after_end, t >= last)):
            if choice == "periodic":
                shift, repeats = jnp.where(side, whole, shift), repeats | side
        begins = self.after_end == "periodic"
        k = jnp.searchsorted(self.ts, t - shift, side="right")
        at = lambda i: jnp.where(i < n, self.ts[jnp.clip(i, 0, n - 1)] + shift, jnp.inf)  # noqa: E731
        following = at(k)
        if DEGREES[self.interpolation] > 1:
            end = (k == n - 1) & (repeats | begins)
            return jnp.where(end, following, jnp.inf), jnp.inf + t, at(k + SIGHT - 1)
        close = at(k + 1) - following <= CLOSE * jnp.maximum(jnp.abs(first), jnp.abs(last))
        ends = (k == n - 1) & (repeats | begins)
        jumps = jnp.array(self.jumps) | close | ends
        return (
            jnp.where(jumps, following, jnp.inf),
            jnp.where(jumps, jnp.inf, following),
            jnp.inf + t,
        )

    def __call__(self, t: Scalar) -> Float[Array, ""]:
        """The value at time ``t`` (a scalar, in seconds); use `jax.vmap` for many times."""
        if not is_real(t):
            raise DataError(f"A signal has no value at t={shown(t)}; give seconds.")
        t = jnp.asarray(t, self.ts.dtype)
        first, last = self.ts[0], self.ts[-1]
        if self.before_start == "periodic" or self.after_end == "periodic":
            repeated = first + (t - first) % (last - first)
            t = jnp.where(t < first, repeated, t) if self.before_start == "periodic" else t
            t = jnp.where(t >= last, repeated, t) if self.after_end == "periodic" else t
        return self.piece(t, t)

    def piece(self, around: Scalar, t: Scalar) -> Float[Array, ""]:
        """The polynomial that the signal is around a time, at a time ``t``; nothing is repeated periodically.

        At a sample two pieces meet, so ``around`` tells which one is meant.
        """
        around, t = (jnp.asarray(v, self.ts.dtype) for v in (around, t))
        first, last = self.ts[0], self.ts[-1]
        inside = _between(first, t, last)
        within = partial(self._within, self._index(_between(first, around, last)))
        value = differentiate(within, self.derivative)(inside)
        for outside, end, choice in (
            (around < first, 0, self.before_start),
            (around > last, len(self.ts) - 1, self.after_end),
        ):
            if self.derivative and choice in ("hold", "linear"):
                straight = choice == "linear" and self.derivative == 1
                value = jnp.where(outside, self._end_slope(end) if straight else 0.0, value)
            elif choice == "linear":
                value = jnp.where(outside, value + self._end_slope(end) * (t - inside), value)
        return value

    def _within(self, i: Int[Array, ""], t: Array) -> Float[Array, ""]:
        """The polynomial between the samples i and i + 1."""
        match self.interpolation:
            case "previous":
                early = t < self.ts[i]  # the interval is found by arithmetic, which rounds
                return self.values[jnp.maximum(i + (t >= self.ts[i + 1]) - early, 0)]
            case "linear":
                return self.values[i] + self._secant(i) * (t - self.ts[i])
            case "band-limited":
                assert self.coefficients is not None
                fraction = (t - self.ts[i]) / (self.ts[i + 1] - self.ts[i])
                on_line = self.values[i] + self._secant(i) * (t - self.ts[i])
                return on_line + deviation_from_line(self.coefficients[:, i], fraction)
            case _:
                return self._hermite(i, t)

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

    def _end_slope(self, i: int) -> Float[Array, ""]:
        if self.interpolation in SLOPES:
            return self._derivative_at(jnp.asarray(i))
        return self._secant(min(i, len(self.ts) - 2))

    def _derivative_at(self, i: Int[Array, ""]) -> Float[Array, ""]:
        """Derivative at sample ``i``, from the secants around it (`acausal.data.slopes`)."""
        n = len(self.ts) - 1
        if n == 1:
            return self._secant(0)
        slopes = SLOPES[self.interpolation]

        def secant(k: Array) -> Array:
            inside = jnp.clip(k, 0, n - 1)
            beyond = self._secant(jnp.minimum(inside, n - 2) + 1) - self._secant(
                jnp.maximum(inside, 1) - 1
            )
            return self._secant(inside) + (k - inside) * beyond * slopes.continued

        left = jnp.where(i == 0, 1, i - 1)  # the parabola at an end is that through the next two
        right = jnp.where(i == n, n - 2, i)
        widths = (self.ts[k + 1] - self.ts[k] for k in (left, right))
        return slopes.rule(*(secant(i + k) for k in (-2, -1, 0, 1)), *widths)

    def _hermite(self, i: Array, t: Array) -> Float[Array, ""]:
        h = self.ts[i + 1] - self.ts[i]
        s = (t - self.ts[i]) / h
        a, b = self.values[i], self.values[i + 1]
        da, db = h * self._derivative_at(i), h * self._derivative_at(i + 1)
        rest = (1 - s) * (a - b + da) + s * (b - a - db)
        return a + s * (b - a) + s * (1 - s) * rest


def differentiate(
    function: Callable[[Array], Array], times: int
) -> Callable[[Array], Float[Array, ""]]:
    """The derivative of a function of time, in forward mode."""
    if times == 0:
        return function
    inner = differentiate(function, times - 1)
    return lambda t: jax.jvp(inner, (t,), (jnp.ones_like(t),))[1]


def _between(low: Array, t: Array, high: Array) -> Array:
    """The nearest time between two; where ``t`` is an end, its derivative is that of ``t``."""
    return jnp.where(t < low, low, jnp.where(t > high, high, t))


def _no_derivative(name: str, interpolation: str, times: int) -> str:
    enough = [f"'{kind}'" for kind, count in DERIVATIVES.items() if count >= times]
    remedy = (
        f"choose interpolation={' or '.join(enough)}, or give the derivative"
        if enough
        else "give the derivative"
    )
    return (
        f"'{name}' has the interpolation '{interpolation}', which has no useful "
        f"{ORDINALS[min(times, len(ORDINALS)) - 1]} derivative; {remedy} as measured."
    )
