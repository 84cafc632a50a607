"""Weights: how much records, targets and times count in the loss."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import jax.numpy as jnp
import numpy as np

from acausal._jax import is_number
from acausal.errors import TrainingError, known_name, shown
from acausal.training.objective.losses import Loss, WithoutWeights
from acausal.training.objective.records import Records

RecordWeights = str | Mapping[str, float]
"""``"samples"``, ``"records"``, or factors by name."""

Weight = float | Callable[[float], float]
"""A factor, or a function of time that gives it."""


@dataclass(frozen=True)
class Weighting:
    """How much records, targets and times count.

    Attributes:
        records: of each record's samples: ``"samples"`` all alike, ``"records"`` so that every record counts alike, or
            factors by name.
        samples: by index of a target.
    """

    records: str | tuple[tuple[str, float], ...]
    samples: tuple[tuple[int, Weight], ...]

    @property
    def alike(self) -> bool:
        """Whether all samples count alike."""
        return isinstance(self.records, str) and self.records == "samples" and not self.samples

    def apply(self, records: Records) -> Records:
        """The records with their weights; a record without a factor of its own has 1."""
        if self.alike:
            return records
        weight, of = np.array(records.weight), np.asarray(records.of)
        t = np.asarray(records.steps.t)
        for i, given in self.samples:
            rows = np.flatnonzero(weight[:, i])
            weight[rows, i] = [_at(given, time) for time in t[rows].tolist()]
        if not isinstance(self.records, str):
            factors = dict(self.records)
            factor = np.array([factors.get(n, 1.0) for n in records.names])
        elif self.records == "records":
            sums = np.bincount(of, weight.sum(axis=1), records.count)
            factor = sums.mean() / np.where(sums > 0, sums, 1.0)
        else:
            factor = np.ones(records.count)
        return replace(records, weight=jnp.asarray(weight * factor[of][:, None]))


def _at(given: Weight, time: float) -> float:
    value: Any = given(time) if callable(given) else given
    if not (np.ndim(value) == 0 and np.isfinite(value) and value >= 0):
        raise TrainingError(
            f"sample_weights: {shown(value)} at t = {time:g} s is not a weight; give a number of 0 or more."
        )
    return float(value)


def weighting(
    record_weights: RecordWeights,
    sample_weights: Mapping[str, Weight] | None,
    names: Sequence[str],
    targets: Sequence[str],
    loss: Loss,
) -> Weighting:
    """Check a user's choice for records and samples.

    Raises:
        TrainingError: for what is not a record, target or weight, or if the loss takes no weights.
    """
    if isinstance(record_weights, str) and record_weights not in ("samples", "records"):
        raise TrainingError(
            f"record_weights='{record_weights}': give 'samples', 'records', or factors by name of a record."
        )
    if isinstance(record_weights, Mapping):
        for name, value in record_weights.items():
            known_name(name, names, "record_weights: there is no record", TrainingError)
            if not (is_number(value) and value > 0):
                raise TrainingError(
                    f"record_weights: '{name}' has the weight {shown(value)}; give a positive number, or leave "
                    "the record out."
                )
    for name, value in (sample_weights or {}).items():
        known_name(name, targets, "sample_weights:", TrainingError, " is not a target:")
        if not (callable(value) or (is_number(value) and value > 0)):
            raise TrainingError(
                f"sample_weights: '{name}' has the weight {shown(value)}; give a positive number, or a function "
                "of time."
            )
    pairs = tuple((list(targets).index(n), w) for n, w in (sample_weights or {}).items())
    chosen = record_weights
    if not isinstance(chosen, str):
        chosen = tuple((name, float(factor)) for name, factor in chosen.items())
    found = Weighting(chosen, pairs)
    if isinstance(loss, WithoutWeights) and not found.alike:
        raise TrainingError(
            "record_weights and sample_weights need a loss that takes weights: "
            "let it have the arguments (predicted, measured, sigma, weight)."
        )
    return found
