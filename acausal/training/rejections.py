"""Rejected updates: when there are too many, a training ends with what is wrong and what helps."""

from __future__ import annotations

from acausal.errors import TrainingError
from acausal.training.history import Log

SHORTER_STEPS = (
    "Its steps are too long for the solver to be stable: "
    "take a smaller dt, an implicit solver (solver='kvaerno3'), or shorter sequences."
)
"""What helps where gradients explode."""

REJECTIONS = 50
"""A training ends after this many rejected updates in a row."""


def check_rejections(log: Log, rejected: int) -> None:
    """Check how many updates were rejected in a row.

    Raises:
        TrainingError: if there are too many.
    """
    if rejected < REJECTIONS:
        return
    first = log.epochs - rejected
    sequences = [d for d in log.divergences if d.epoch >= first and d.count]
    if sequences:
        what = f"the sequence from {sequences[0].place} diverges"
        mend = "Start from smaller networks or better parameters, take shorter sequences, or a smaller dt."
        if sequences[0].exploded:
            what = f"the gradient of the sequence from {sequences[0].place} explodes"
            mend = SHORTER_STEPS
    else:
        what = "the gradient is not finite"
        mend = "Lower the optimizer's rate, or clip the gradient."
    raise TrainingError(
        f"{rejected} updates in a row were rejected from epoch {first} on: {what}. {mend}"
    )
