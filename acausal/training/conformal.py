"""Conformal bands: how far predictions are off, measured on a record that the training never saw."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from acausal._jax import is_number
from acausal.errors import DataError, listing, shown
from acausal.training.record_fit import RecordFit
from acausal.training.uncertainty.residuals import correlation_time


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
        units: of the targets.
        records: names of those that the bands were calibrated on.
    """

    level: float
    width: dict[str, float]
    independent: dict[str, float]
    units: Mapping[str, str]
    records: tuple[str, ...]

    def __repr__(self) -> str:
        count = len(self.records)
        widths = [
            f"  {n}: ±{w:.4g} {self.units[n]}".rstrip()
            + f" (from errors worth {self.independent[n]:.0f} independent samples)"
            for n, w in self.width.items()
        ]
        head = (
            f"Bands that hold {100 * self.level:g} % of all measurements, on average over time, of records like "
            f"the {'one' if count == 1 else count} that they were calibrated on: {listing(self.records, 5)}"
        )
        return "\n".join([head, *widths])


def conformal(
    records: Mapping[str, RecordFit], units: Mapping[str, str], level: float
) -> Conformal:
    """Calibrate bands: the quantile of the errors on other records, with the correction for their finite length.

    Split conformal prediction (V. Vovk, A. Gammerman, G. Shafer: Algorithmic Learning in a Random World, Springer
    2005) assumes exchangeable samples. Those of a record are not; the number of independent samples follows
    from the autocorrelation time of the errors' size, and the quantile is raised as for that number.

    Raises:
        DataError: if the record is too short for the level, or lacks what is needed.
    """
    if not (is_number(level) and 0 < level < 1):
        raise DataError(
            f"level={shown(level)} is not a share of the samples; give a number in (0, 1)."
        )
    found = list(records.values())
    if not all(np.isfinite(one.predicted).all() for one in found):
        raise DataError("The trained model diverges over the record; it has no bands.")
    width: dict[str, float] = {}
    independent: dict[str, float] = {}
    for i, name in enumerate(found[0].targets):
        columns = [np.abs(one.errors[:, i]) for one in found]
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
    return Conformal(level, width, independent, units, tuple(records))
