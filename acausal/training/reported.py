"""What a running training reports to those who show or log it."""

from __future__ import annotations

from dataclasses import dataclass

from acausal.training.history import Divergence

SHOWN = 5
"""Divergences that are shown one by one; later ones are only counted."""


@dataclass(frozen=True)
class Progress:
    """How far a training is.

    Attributes:
        epoch, epochs: updates done, and planned.
        loss: of the last update's batch.
        best: the lowest loss over the whole record so far, or over what is held out.
        seconds: time since the start.
        seconds_per_epoch: of the latest updates.
        divergences: sequences that diverged since the last report.
        events: how many happen in all records; ``None`` for a model without.
    """

    epoch: int
    epochs: int
    loss: float
    best: float
    seconds: float
    seconds_per_epoch: float
    divergences: tuple[Divergence, ...]
    events: int | None = None


def rate_of(progress: Progress) -> str:
    """The time of an update, in words."""
    seconds = progress.seconds_per_epoch
    return f"{seconds * 1e3:.3g} ms/epoch" if seconds < 1 else f"{seconds:.3g} s/epoch"
