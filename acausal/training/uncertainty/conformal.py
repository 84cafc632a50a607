"""Conformal bands: how far predictions are off, measured on a record that the training never saw."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from numpy.typing import ArrayLike

from acausal.data import Data, RecordsLike, records_of
from acausal.errors import DataError, listing
from acausal.training.objective.held_out import over
from acausal.training.objective.initial_state import InitialState
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.uncertainty.residuals import correlation_time


@dataclass(frozen=True, eq=False)
class ConformalBand:
    """A target over the time of a record, predicted in one simulation of it.

    Attributes:
        time: of the record's samples.
        low, middle, high: the prediction and the bounds of its band.
    """

    time: Float[np.ndarray, " N"]
    low: Float[np.ndarray, " N"]
    middle: Float[np.ndarray, " N"]
    high: Float[np.ndarray, " N"]


@dataclass(frozen=True, eq=False)
class Conformal:
    """Bands around the predictions of a trained model, as wide as its errors on a record of their own require.

    They need no noise model, and the model may be wrong. On average over time they hold as often as promised, on
    records like the one that they were calibrated on: the same excitation, the same sensors. They are too narrow for a
    rougher record.

    Attributes:
        level: how often a band should hold the measurement.
        width: from a band's middle to its bounds, by target, in its unit.
        independent: how many independent samples the record is worth, by target; neighbouring samples are correlated.
        problem, trained: the trained model.
        records: names of those that the bands were calibrated on.
    """

    level: float
    width: dict[str, float]
    independent: dict[str, float]
    problem: Problem
    trained: Trainable
    records: tuple[str, ...]

    def predict(
        self,
        data: Data | Mapping[str, ArrayLike],
        x0: InitialState = "auto",
    ) -> dict[str, ConformalBand]:
        """The targets over another record, by name; arguments as those of `Fit.conformal`."""
        ((time, y, _),) = predicted(self.problem, self.trained, data, x0)
        return {
            name: ConformalBand(time, y[:, i] - width, y[:, i], y[:, i] + width)
            for i, (name, width) in enumerate(self.width.items())
        }

    def coverage(
        self,
        data: RecordsLike,
        x0: InitialState = "auto",
    ) -> dict[str, float]:
        """How often the bands hold the targets of further records, by name; arguments as those of `Fit.conformal`."""
        found = predicted(self.problem, self.trained, data, x0)
        errors = np.abs(np.concatenate([p.measured - p.y for p in found]))
        return {
            name: float(np.mean(errors[~np.isnan(errors[:, i]), i] <= width))
            for i, (name, width) in enumerate(self.width.items())
        }

    def __repr__(self) -> str:
        count = len(self.records)
        widths = [
            f"  {n}: ±{w:.4g} {self.problem.system.unit(n)}".rstrip()
            + f" (from errors worth {self.independent[n]:.0f} independent samples)"
            for n, w in self.width.items()
        ]
        head = (
            f"Bands that hold {100 * self.level:g} % of all measurements, on average over time, of records like "
            f"the {'one' if count == 1 else count} that they were calibrated on: {listing(self.records, 5)}"
        )
        return "\n".join([head, *widths])


def conformal(
    problem: Problem,
    trained: Trainable,
    data: RecordsLike,
    level: float,
    x0: InitialState,
) -> Conformal:
    """Calibrate bands: the quantile of the errors on other records, with the correction for their finite length.

    Split conformal prediction (V. Vovk, A. Gammerman, G. Shafer: Algorithmic Learning in a Random World, Springer
    2005) assumes exchangeable samples. Those of a record are not; the number of independent samples follows
    from the autocorrelation time of the errors' size, and the quantile is raised as for that number.

    Raises:
        DataError: if the record is too short for the level, or lacks what is needed.
    """
    if not 0 < level < 1:
        raise DataError(f"level={level:g} is not a share of the samples; give a number in (0, 1).")
    records = records_of(data)
    found = predicted(problem, trained, records, x0)
    if not all(np.isfinite(p.y).all() for p in found):
        raise DataError("The trained model diverges over the record; it has no bands.")
    width: dict[str, float] = {}
    independent: dict[str, float] = {}
    for i, name in enumerate(problem.targets):
        columns = [np.abs(p.measured[:, i] - p.y[:, i]) for p in found]
        columns = [c[~np.isnan(c)] for c in columns]
        count = sum(len(c) / correlation_time(c) for c in columns if len(c) > 1)
        column = np.concatenate(columns)
        if not count:
            raise DataError(f"Target '{name}' has no samples in the data.")
        raised = np.ceil((count + 1) * level) / count
        if raised > 1:
            raise DataError(
                f"The record is worth {count:.1f} independent samples of '{name}', too few for level={level:g}: "
                "take a longer one, or a lower level."
            )
        width[name] = float(np.quantile(column, raised, method="inverted_cdf"))
        independent[name] = float(count)
    return Conformal(level, width, independent, problem, trained, tuple(records))


class Predicted(NamedTuple):
    """The targets over one record: its times, and their predicted and measured values."""

    time: Float[np.ndarray, " n"]
    y: Float[np.ndarray, "n n_targets"]
    measured: Float[np.ndarray, "n n_targets"]


def predicted(
    problem: Problem, trained: Trainable, data: RecordsLike, x0: InitialState
) -> list[Predicted]:
    """The targets over other records, each in one simulation."""
    records = {n: d.for_system(problem.system) for n, d in records_of(data).items()}
    other = over(problem, records, x0)
    y = np.asarray(other.simulate(other.over_other_records(trained)).y)
    laid = other.records
    measured = laid.measured
    rows = [laid.rows_of(k) for k in range(laid.count)]
    t = np.asarray(laid.steps.t)
    return [Predicted(t[r], y[r], measured[r]) for r in rows]
