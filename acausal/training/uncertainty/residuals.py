"""Residuals: are they noise, or is there more to learn from them?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from scipy.signal import correlate

from acausal.data import noise_level
from acausal.errors import percent

LAGS = 50
"""The largest lag at which correlations are computed."""

CHANCE = 4.0
"""Standard deviations that a correlation may reach by chance; in one of 300 records of white noise a lag has more."""

NEGLIGIBLE = 1e-6
"""Residuals of a smaller share of the target count as none: no measurement resolves them."""


LITTLE, MUCH = 0.01, 0.3
"""Parts of a target's deviation that are little, and much, to leave unexplained."""


@dataclass(frozen=True, eq=False)
class Residuals:
    """The residuals of one target, and what they are correlated with.

    Attributes:
        target: its name.
        values: measured less predicted.
        share: their standard deviation, relative to that of the target.
        own: autocorrelation at the lags 1 to `LAGS` (fewer where N < 4 `LAGS`).
        inputs: by input that is not constant, the correlation with it at the lags −lags to lags.
        bound: the largest autocorrelation that can be due to chance.
        bounds: the same for the correlations with the inputs, by input.
        noise: the standard deviation of white noise among them, relative to that of the target.
    """

    target: str
    values: Float[np.ndarray, " N"]
    share: float
    own: Float[np.ndarray, " lags"]
    inputs: dict[str, Float[np.ndarray, " 2*lags+1"]]
    bound: float
    bounds: dict[str, float]
    noise: float

    @property
    def is_white(self) -> bool:
        """Whether no autocorrelation exceeds the bound."""
        return bool(np.max(np.abs(self.own)) <= self.bound)

    @property
    def drivers(self) -> tuple[str, ...]:
        """Inputs that the residuals still follow."""
        return tuple(n for n, c in self.inputs.items() if np.max(np.abs(c)) > self.bounds[n])

    def summary(self) -> str:
        """What this means, in a sentence."""
        if self.bound >= 1:
            return f"'{self.target}': {len(self.values)} samples are too few to tell residuals from noise."
        if self.share < NEGLIGIBLE:
            return f"'{self.target}': the residuals are {100 * self.share:.1g} % of it; there is nothing more to learn."
        if self.drivers:
            largest = max(float(np.max(np.abs(self.inputs[n]))) for n in self.drivers)
            return (
                f"'{self.target}': the residuals still follow {', '.join(map(repr, self.drivers))}, up to "
                f"a correlation of {largest:.2g}: {self._grade('the model lacks something, or trained too little')}"
            )
        if self.is_white:
            return f"'{self.target}': the residuals look like white noise; there is nothing more to learn from them."
        return (
            f"'{self.target}': the residuals are not white noise, up to a correlation of "
            f"{np.max(np.abs(self.own)):.2g}: {self._grade('coloured noise, or something that the model lacks')}"
        )

    @property
    def unexplained(self) -> float:
        """The part of the target's deviation that is left beside white noise: what a better model could explain."""
        return float(np.sqrt(max(self.share**2 - self.noise**2, 0.0)))

    def __repr__(self) -> str:
        return f"Residuals of {self.summary()}"

    def _grade(self, why: str) -> str:
        """How much is left to explain, and what to make of it."""
        left = f"{percent(self.unexplained)} of it"
        if self.unexplained < max(LITTLE, self.noise / 2):
            return f"{left} could still be explained, which is little."
        if self.unexplained < MUCH:
            return f"{left} could still be explained: {why}."
        return f"{left} is not explained: do not use the model before you know why."


class Piece(NamedTuple):
    """The residuals of a target over one record, measured less predicted, and inputs by name at the same samples."""

    values: Float[np.ndarray, " n"]
    inputs: Mapping[str, Float[np.ndarray, " n"]]


def residuals(target: str, pieces: Sequence[Piece], sigma: float) -> Residuals:
    """Correlations of a target's residuals with themselves and with inputs, over all records together.

    Arguments:
        target: its name; ``sigma``: its standard deviation.
        pieces: of every record.

    An autocorrelation of N samples of white noise has the variance 1/N. The correlation with an unrelated input has the
    variance ``1/N Σ ρ_k ρ'_k`` over all lags of both autocorrelations (L. Ljung: System Identification, Prentice Hall
    1999, section 16.6): slow noise and a slow input look similar by chance.
    """
    values = [piece.values for piece in pieces]
    count = sum(map(len, values))
    lags = max(1, min(LAGS, max(map(len, values)) // 4))
    own = _together(values, values, lags)
    chance = CHANCE / np.sqrt(count)
    inputs = {n: [piece.inputs[n] for piece in pieces] for n in pieces[0].inputs}
    varying = {n: us for n, us in inputs.items() if any(np.std(u) > 0 for u in us)}

    def bound(us: list[Float[np.ndarray, " n"]]) -> float:
        return float(chance * np.sqrt(max(1.0, own @ _together(us, us, lags))))

    return Residuals(
        target,
        np.concatenate(values),
        float(np.std(np.concatenate(values)) / sigma),
        own[lags + 1 :],
        {n: _together(values, us, lags) for n, us in varying.items()},
        float(chance),
        {n: bound(us) for n, us in varying.items()},
        noise_level(values) / sigma,
    )


def unexplained(pieces: Sequence[Float[np.ndarray, " n"]], sigma: float) -> float:
    """What residuals, NaN where nothing is measured, have beside white noise, relative to the target's deviation."""
    values = np.concatenate(pieces)
    return float(np.sqrt(max(np.nanvar(values) - noise_level(pieces) ** 2, 0.0)) / sigma)


def correlation_time(values: Float[np.ndarray, " N"]) -> float:
    """How many samples of a signal are worth one independent sample; at least 1.

    ``1 + 2 Σ ρ_k``, up to the first autocorrelation that is not positive.
    """
    rho = _together([values], [values], len(values) - 1)[len(values) :]
    return float(1 + 2 * np.sum(rho * np.cumprod(rho > 0)))


def _together(
    a: Sequence[Float[np.ndarray, " n"]], b: Sequence[Float[np.ndarray, " n"]], lags: int
) -> Float[np.ndarray, " 2*lags+1"]:
    """The correlation of a with earlier b at the lags −lags to lags, over records, each about its own mean.

    It is 0 where one of them is constant.
    """
    total, squares = np.zeros(2 * lags + 1), np.zeros(2)
    for left, right in zip(a, b, strict=True):
        left, right = left - left.mean(), right - right.mean()
        squares += left @ left, right @ right
        reach = min(lags, len(left) - 1)
        first = len(left) - 1 - reach
        found = np.asarray(correlate(left, right, method="fft"))[first : first + 2 * reach + 1]
        total[lags - reach : lags + reach + 1] += found
    return total / (np.sqrt(squares.prod()) or 1.0)
