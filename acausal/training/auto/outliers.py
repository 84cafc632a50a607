"""Samples that no model should follow: outliers, and times at which a sensor gave something else."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from acausal.data import noise_level
from acausal.errors import percent
from acausal.training.objective.losses import LEAST
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Simulated

FAR = 6.0
"""A sample is far off by so many usual deviations."""

USUAL = 1.4826
"""The standard deviation of normal numbers, in medians of their sizes."""

FEW, MOST = 0.1, 0.5
"""Outliers are less than this part of all, and make more than this part of what is left."""

JUMP, SMOOTH, NEAR = 0.5, 0.3, 3
"""A record jumps to outliers, or back, by this part of what they are off. Predictions jump by less than the second
part, up to so many samples from there: where they do, an event came early or late."""

STUCK, OFTEN, OVER = 0.01, 10.0, 0.02
"""A sensor is at its limit if more than this part of the samples are, so many times as many as have another value, and
predictions go beyond by the third part of the target's deviation."""

RUN = 5
"""A sensor at its limit stays there over so many samples, twice at least."""

LEAVE = "leave them out (nan, missing='nan')"
"""What to do about wrong samples."""


class _Series(NamedTuple):
    """The samples of a target in a record."""

    t: Float[np.ndarray, " n"]
    measured: Float[np.ndarray, " n"]
    predicted: Float[np.ndarray, " n"]

    def outliers(self, far: float) -> Bool[np.ndarray, " n"]:
        """Which samples are farther off than that, and are no events at other times."""
        left = np.abs(self.measured - self.predicted)
        found = left > far
        jumps = np.abs(np.diff(self.measured, prepend=np.nan, append=np.nan))
        slopes = np.abs(np.diff(self.predicted, prepend=np.nan, append=np.nan))
        edges = np.flatnonzero(np.diff(found, prepend=False, append=False))
        for begin, end in edges.reshape(-1, 2):
            off = left[begin:end].max()
            near = [slopes[max(e - NEAR, 0) : e + NEAR + 1] for e in (begin, end)]
            smooth = np.nanmax(np.append(np.concatenate(near), 0.0)) < SMOOTH * off
            jump = np.nanmax(np.append(jumps[[begin, end]], 0.0))
            found[begin:end] = smooth and jump > JUMP * off
        return found

    def runs(self, mask: Bool[np.ndarray, " n"]) -> Iterator[_Series]:
        """The parts over which a mask stays as it is."""
        ends = np.flatnonzero(np.diff(mask)) + 1
        for own in np.split(np.arange(len(mask)), ends) if len(mask) else ():
            yield _Series(self.t[own], self.measured[own], self.predicted[own])


def _series(problem: Problem, simulated: Simulated) -> Iterator[tuple[str, list[_Series]]]:
    """By target, what was measured in each record, and predicted."""
    records = problem.records
    rows = [records.rows_of(i) for i in range(records.count)]
    counts = np.asarray(records.weight) > 0
    t, measured, predicted = map(np.asarray, (records.steps.t, records.y, simulated.y))
    for k, name in enumerate(problem.targets):
        kept = [own[counts[own, k]] for own in rows]
        yield name, [_Series(t[own], measured[own, k], predicted[own, k]) for own in kept]


def outliers(problem: Problem, simulated: Simulated) -> Iterator[str]:
    """A sentence on each target of which a few samples make most of what is left."""
    for name, series in _series(problem, simulated):
        left = np.concatenate([one.measured - one.predicted for one in series])
        if not len(left) or not np.isfinite(left).all():
            continue
        far = FAR * USUAL * float(np.median(np.abs(left)))
        outlying = np.concatenate([one.outliers(far) for one in series])
        share = np.sum(left[outlying] ** 2) / np.sum(left**2) if outlying.any() else 0.0
        if np.mean(outlying) < FEW and share > MOST:
            at = np.concatenate([one.t for one in series])[outlying]
            when = ", ".join(f"{one:.4g}" for one in at[:NEAR])
            yield (
                f"{np.sum(outlying)} of {len(outlying)} samples of {name} lie far from the others (at {when}"
                f"{', ...' * (len(at) > NEAR)} s) and make {percent(share)} of what is left: {LEAVE} if "
                "they are wrong, and not what the model lacks, or let them count less (loss='huber')."
            )


def at_limits(problem: Problem, simulated: Simulated) -> Iterator[str]:
    """A sentence on each target that stays at its least or largest value where predictions go beyond.

    Not where a record begins so, at rest, nor where other values are as frequent, as of a sensor with few digits. What
    is trained may itself stay near the limit, as by a law that is steep there: then the samples show it, see `_is_cut`.
    """
    for name, series in _series(problem, simulated):
        t, measured, predicted = map(np.concatenate, zip(*series, strict=True))
        counts = np.unique(measured, return_counts=True)[1]
        usual = float(np.median(counts)) if len(counts) else 0.0
        begins = {float(one.measured[0]) for one in series if len(one.measured)}
        for which, sign in (("largest", 1), ("least", -1)):
            limit = sign * float((sign * measured).max(initial=-np.inf))
            there = measured == limit
            if limit in begins or there.sum() <= max(STUCK * len(t), OFTEN * usual):
                continue
            beyond = float(np.mean(sign * (predicted[there] - limit)))
            if beyond > OVER * float(np.std(measured)):
                why = "where predictions go beyond"
            elif _is_cut(series, limit):
                why = "without the noise of the others"
            else:
                continue
            yield (
                f"{np.sum(there)} of {len(t)} samples of {name} have its {which} value, {limit:.4g}, {why}: {LEAVE} if "
                "a sensor is at its limit there."
            )


def _is_cut(series: Sequence[_Series], limit: float) -> bool:
    """Whether noisy samples come back to exactly the same value, other than zero, at which predictions do not rest.

    At rest a sensor has its noise, or reads zero; one that holds its value comes back to another. Digits are no noise.
    """
    if limit == 0:
        return False
    there, others = list[_Series](), list[_Series]()
    for one in series:
        for run in one.runs(one.measured == limit):
            (there if run.measured[0] == limit else others).append(run)
    if sum(len(run.t) >= RUN for run in there) < 2 or not others:
        return False
    values = np.concatenate([run.measured for run in others])
    noise = noise_level([run.measured for run in others], [run.t for run in others])
    digit = float(np.min(np.diff(np.unique(values)), initial=np.inf))
    off = np.concatenate([run.predicted for run in there]) - limit
    return max(digit, LEAST * float(np.std(values))) < noise < float(np.sqrt(np.mean(off**2)))
