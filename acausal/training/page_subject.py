"""What the page of a training needs of its result."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

import numpy as np
from jaxtyping import Float

from acausal.reporting import InputStatistics
from acausal.training.auto.verdict import StageResult
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.starts import Starts
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.confidence import Band, Confidence
from acausal.training.uncertainty.residuals import Residuals


class LearnedLaw(NamedTuple):
    """A learned law.

    Attributes:
        band: the law with its standard deviation.
        seen: statistics of the network's arguments.
        samples: some of the values that its first argument had.
        argument, result: names with units of the first argument and of the value.
        factor: by which the network's value was multiplied to give ``result``.
    """

    band: Band
    seen: InputStatistics
    samples: Float[np.ndarray, " n_samples"]
    argument: str = "argument"
    result: str = ""
    factor: float = 1.0


class Trained(TrainedModel, Protocol):
    """The result of a training, as its page needs it besides."""

    @property
    def starts(self) -> Starts | None: ...  # noqa: D102
    @property
    def stages(self) -> tuple[StageResult, ...]: ...  # noqa: D102
    @property
    def problem(self) -> Problem: ...  # noqa: D102
    @property
    def trained(self) -> Trainable: ...  # noqa: D102
    @property
    def arguments(self) -> Mapping[str, Float[np.ndarray, "n_calls n_arguments"]]: ...  # noqa: D102
    def confidence(self) -> Confidence: ...  # noqa: D102
    def residuals(self) -> tuple[Residuals, ...]: ...  # noqa: D102
    def with_bands(self, bands: Mapping[str, Band]) -> dict[str, LearnedLaw]: ...  # noqa: D102
