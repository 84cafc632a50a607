"""What the page of a training needs of its result."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from acausal.reporting import LearnedLaw
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.starts import Starts
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.confidence import Band, Confidence
from acausal.training.uncertainty.residuals import Residuals

if TYPE_CHECKING:
    pass


class Trained(TrainedModel, Protocol):
    """The result of a training, as its page needs it besides."""

    @property
    def starts(self) -> Starts | None: ...  # noqa: D102
    @property
    def problem(self) -> Problem: ...  # noqa: D102
    @property
    def trained(self) -> Trainable: ...  # noqa: D102
    def confidence(self) -> Confidence: ...  # noqa: D102
    def residuals(self) -> tuple[Residuals, ...]: ...  # noqa: D102
    def with_bands(self, bands: Mapping[str, Band]) -> dict[str, LearnedLaw]: ...  # noqa: D102
