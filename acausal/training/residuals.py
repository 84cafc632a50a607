"""Residuals: whether what a model leaves over is noise, or still holds something to learn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import correlate

LAGS = 50
"""Lags at which correlations are looked at."""

SURE = 4.0
"""Standard deviations of a correlation of white noise beyond which it is none."""


@dataclass(frozen=True, eq=False)
class Residuals:
    """What is left over of one target, and what it is correlated with.

    Attributes:
        target: its name.
        values: measured less predicted, shape (N,).
        own: autocorrelation at the lags 1 to `LAGS`.
        inputs: by input, the correlation with the input at the lags −`LAGS` to `LAGS`.
        bound: the size of a correlation up to which it is taken for chance.
    """

    target: str
    values: np.ndarray
    own: np.ndarray
    inputs: dict[str, np.ndarray]
    bound: float

    @property
    def is_white(self) -> bool:
        """Whether not more than a twentieth of the autocorrelation is beyond the bound."""
        return float(np.mean(np.abs(self.own) > self.bound)) <= 0.05

    @property
    def drivers(self) -> tuple[str, ...]:
        """Inputs that the residuals still follow."""
        return tuple(
            n for n, c in self.inputs.items() if float(np.mean(np.abs(c) > self.bound)) > 0.05
        )

    def words(self) -> str:
        """What this means, in a sentence."""
        if self.is_white and not self.drivers:
            return f"'{self.target}': what is left over looks like white noise; nothing more is to be learned from it."
        if self.drivers:
            largest = max(float(np.max(np.abs(self.inputs[n]))) for n in self.drivers)
            return (
                f"'{self.target}': what is left over still follows {', '.join(map(repr, self.drivers))}, up to "
                f"a correlation of {largest:.2g}: the model lacks something, or trained too little."
            )
        return (
            f"'{self.target}': what is left over is no white noise, up to a correlation of "
            f"{np.max(np.abs(self.own)):.2g}: coloured noise, or something that the model lacks."
        )


def residuals(target: str, values: np.ndarray, inputs: dict[str, np.ndarray]) -> Residuals:
    """Correlations of what is left over of a target, shape (N,), with itself and with inputs."""
    lags = min(LAGS, len(values) // 4)
    whole = _correlation(values, values, lags)
    return Residuals(
        target,
        values,
        whole[lags + 1 :],
        {n: _correlation(values, u, lags) for n, u in inputs.items() if np.std(u) > 0},
        SURE / np.sqrt(len(values)),
    )


def _correlation(a: np.ndarray, b: np.ndarray, lags: int) -> np.ndarray:
    a, b = a - a.mean(), b - b.mean()
    size = np.sqrt((a @ a) * (b @ b)) or 1.0
    first = len(a) - 1 - lags
    return np.asarray(correlate(a, b, method="fft"))[first : first + 2 * lags + 1] / size
