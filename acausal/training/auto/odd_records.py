"""A record unlike the others: another load, a wrong sign or unit."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from acausal.errors import percent
from acausal.training.auto.sensitive import whole_record
from acausal.training.record_fit import RecordFit, rms_of
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.residuals import unexplained

ODD = 1.4
"""A record that leaves so many times what any other does is named."""


def odd_records(fit: TrainedModel) -> Iterator[str]:
    """A record that is explained far worse than the others; pieces of a record count as one."""
    records = defaultdict[str, list[RecordFit]](list)
    for name, record in fit.records.items():
        records[whole_record(name) if fit.pieces else name].append(record)
    left: dict[str, float] = {}
    for name, pieces in records.items():
        sigma = pieces[0].sigma
        known = [error / size for error, size in zip(rms_of(pieces).values(), sigma, strict=True)]
        known = [share for share in known if np.isfinite(share)]
        left |= {name: float(np.linalg.norm(known) / np.sqrt(len(known)))} if known else {}
    if len(left) < 2:
        return
    *others, worst = sorted(left, key=left.__getitem__)
    beside_noise: list[float] = []
    for i, size in enumerate(records[worst][0].sigma.tolist()):
        errors = [piece.errors[:, i] for piece in records[worst]]
        if any(np.isfinite(one).any() for one in errors):
            beside_noise.append(unexplained(errors, size))
    if left[worst] > ODD * left[others[-1]] > 0 and max(beside_noise) > left[worst] / 2:
        yield (
            f"Of '{worst}' it leaves {percent(left[worst])}, of each other record {percent(left[others[-1]])} at most: "
            "look at that one first (a sign, a unit, another load)."
        )
