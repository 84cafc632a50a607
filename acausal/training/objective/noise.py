"""The noise of records."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from acausal.data import noise_level
from acausal.training.objective.records import Records


def noise_of(records: Records) -> Float[np.ndarray, " n_targets"]:
    """By target, the standard deviation of white noise in its samples; at most, where there is other noise."""
    measured, of = records.measured, np.asarray(records.of)
    pieces = [measured[of == k] for k in range(records.count)]
    return np.array(
        [noise_level([piece[:, i] for piece in pieces]) for i in range(measured.shape[1])]
    )


def noise_loss(records: Records) -> float:
    """The loss of a model that leaves nothing but this noise, for losses that are root mean squares."""
    return float(np.sqrt(np.sum((noise_of(records) / np.asarray(records.sigma)) ** 2)))
