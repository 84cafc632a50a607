"""What the model card and the page of a training read of its result."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

from acausal.training.history import History
from acausal.training.record_fit import RecordFit

if TYPE_CHECKING:
    from acausal.system import System


class TrainedModel(Protocol):
    """The result of a training, as what tells of it reads it; see `Fit`."""

    @property
    def system(self) -> System: ...  # noqa: D102
    @property
    def params(self) -> dict[str, Any]: ...  # noqa: D102
    @property
    def loss(self) -> float: ...  # noqa: D102
    @property
    def loss_before(self) -> float: ...  # noqa: D102
    @property
    def validation_loss(self) -> float | None: ...  # noqa: D102
    @property
    def best_epoch(self) -> int: ...  # noqa: D102
    @property
    def records(self) -> dict[str, RecordFit]: ...  # noqa: D102
    @property
    def held_out(self) -> dict[str, RecordFit]: ...  # noqa: D102
    @property
    def modifiers(self) -> dict[str, float]: ...  # noqa: D102
    @property
    def delays(self) -> dict[str, float]: ...  # noqa: D102
    @property
    def lags(self) -> dict[str, float]: ...  # noqa: D102
    @property
    def ranges(self) -> dict[str, tuple[tuple[float, float], ...]]: ...  # noqa: D102
    @property
    def seen(self) -> Mapping[str, Any]: ...  # noqa: D102
    @property
    def rms(self) -> dict[str, float]: ...  # noqa: D102
    @property
    def history(self) -> History: ...  # noqa: D102
    @property
    def seconds(self) -> float: ...  # noqa: D102
    @property
    def interrupted(self) -> bool: ...  # noqa: D102
    @property
    def settings(self) -> Mapping[str, str]: ...  # noqa: D102
