"""Residuals: whether what a model leaves over is noise, or still holds something to learn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import correlate

LAGS = 50
"""Lags at which correlations are looked at."""

SURE = 4.0
"""Standard deviations of a correlation by chance; among the lags of white noise one in 300 records has a larger one."""


EXACT = 1e-6
"""Share of a target that no measurement resolves."""


@dataclass(frozen=True, eq=False)
class Residuals:
    """What is left over of one target, and what it is correlated with.

    Attributes:
        target: its name.
        values: measured less predicted, shape (N,).
        share: their standard deviation, relative to that of the target.
        own: autocorrelation at the lags 1 to `LAGS` (fewer where N < 4 `LAGS`), shape (lags,).
        inputs: by input that is not constant, the correlation with it at the lags −lags to lags, shape (2 lags + 1,).
        bound: the size of an autocorrelation up to which it is taken for chance.
        bounds: the same for the correlations with the inputs, by input.
    """

    target: str
    values: np.ndarray
    share: float
    own: np.ndarray
    inputs: dict[str, np.ndarray]
    bound: float
    bounds: dict[str, float]

    @property
    def is_white(self) -> bool:
        """Whether no autocorrelation is beyond the bound."""
        return bool(np.max(np.abs(self.own)) <= self.bound)

    @property
    def drivers(self) -> tuple[str, ...]:
        """Inputs that the residuals still follow."""
        return tuple(n for n, c in self.inputs.items() if np.max(np.abs(c)) > self.bounds[n])

    def words(self) -> str:
        """What this means, in a sentence."""
        if self.bound >= 1:
            return f"'{self.target}': {len(self.values)} samples are too few to tell what is left over from noise."
        if self.share < EXACT:
            return f"'{self.target}': what is left over is {100 * self.share:.1g} % of it; no more is to be learned."
        if self.drivers:
            largest = max(float(np.max(np.abs(self.inputs[n]))) for n in self.drivers)
            return (
                f"'{self.target}': what is left over still follows {', '.join(map(repr, self.drivers))}, up to "
                f"a correlation of {largest:.2g}: the model lacks something, or trained too little."
            )
        if self.is_white:
            return f"'{self.target}': what is left over looks like white noise; nothing more is to be learned from it."
        return (
            f"'{self.target}': what is left over is no white noise, up to a correlation of "
            f"{np.max(np.abs(self.own)):.2g}: coloured noise, or something that the model lacks."
        )


def residuals(
    target: str, values: np.ndarray, inputs: dict[str, np.ndarray], sigma: float
) -> Residuals:
    """Correlations of what is left over of a target, shape (N,), with itself and with inputs.

    Arguments:
        target: its name; ``sigma``: its standard deviation.
        values: measured less predicted, shape (N,).
        inputs: by name, of the same shape.

    An autocorrelation of N samples of white noise has the variance 1/N. The correlation with an input that has nothing
    to do with it has ``1/N Σ ρ_k ρ'_k`` over all lags of both autocorrelations (L. Ljung: System Identification,
    Prentice Hall 1999, section 16.6): slow noise and a slow input look alike by chance.
    """
    lags = max(1, min(LAGS, len(values) // 4))
    own = _correlation(values, values, lags)
    chance = SURE / np.sqrt(len(values))

    def bound(u: np.ndarray) -> float:
        return float(chance * np.sqrt(max(1.0, own @ _correlation(u, u, lags))))

    varying = {n: u for n, u in inputs.items() if np.std(u) > 0}
    return Residuals(
        target,
        values,
        float(np.std(values) / sigma),
        own[lags + 1 :],
        {n: _correlation(values, u, lags) for n, u in varying.items()},
        float(chance),
        {n: bound(u) for n, u in varying.items()},
    )


def correlation_time(values: np.ndarray) -> float:
    """How many samples of a signal, shape (N,), tell as much as one independent one; at least 1.

    ``1 + 2 Σ ρ_k``, up to the first autocorrelation that is not positive.
    """
    rho = _correlation(values, values, len(values) - 1)[len(values) :]
    return float(1 + 2 * np.sum(rho * np.cumprod(rho > 0)))


def _correlation(a: np.ndarray, b: np.ndarray, lags: int) -> np.ndarray:
    """The correlation of a with earlier b, at the lags −lags to lags; 0 where one of them is constant."""
    a, b = a - a.mean(), b - b.mean()
    size = np.sqrt((a @ a) * (b @ b)) or 1.0
    first = len(a) - 1 - lags
    return np.asarray(correlate(a, b, method="fft"))[first : first + 2 * lags + 1] / size
