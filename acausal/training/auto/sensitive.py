"""Models so sensitive that no law follows a whole record, such as chaotic ones; and the pieces that one can follow."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise

import jax.numpy as jnp
import numpy as np

from acausal.data import Data
from acausal.training.auto.step_choice import difference
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Simulated, Trainable

OFF, SENSITIVE = 1e-3, 20.0
"""Starts are moved by this part of the states' deviations; a model is sensitive if so many times as much changes."""

GROWN = 10.0
"""Over a piece, what a start is off by grows about so many times."""

HALF, QUARTER = 1 / 2, 1 / 4
"""Pieces are this part of a record at most; and this part of pieces that were still too long."""

LEAST, USUAL = 40, 200
"""Samples of a piece: about so many at least; and so many where nothing can be simulated."""


def sensitivity(problem: Problem, trainable: Trainable, simulated: Simulated) -> float:
    """How much starts that are off by a thousandth of each state's deviation change the predictions, by as much.

    As the loss counts it; zero where starts are not found by the training. Of a model that forgets its start it is
    one at most, of a chaotic one very large: neither steps nor laws can be known well enough to follow a whole record.
    """
    moved = _moved(problem, trainable, simulated)
    if moved is None:
        return 0.0
    change = difference(problem, np.asarray(simulated.y), np.asarray(moved.y))
    return change / OFF / float(np.sqrt(len(problem.targets)))


def sensitivity_of_each(
    problem: Problem, trainable: Trainable, simulated: Simulated
) -> list[float]:
    """The same of each record alone."""
    moved = _moved(problem, trainable, simulated)
    if moved is None:
        return [0.0] * problem.records.count
    rows = [problem.records.rows_of(k) for k in range(problem.records.count)]
    with np.errstate(all="ignore"):
        change = (np.asarray(moved.y) - np.asarray(simulated.y)) / np.asarray(problem.records.sigma)
        return [float(np.sqrt(np.mean(change[own] ** 2))) / OFF for own in rows]


def is_sensitive(problem: Problem, trainable: Trainable, simulated: Simulated) -> bool:
    """Whether `sensitivity` is so large that no steps and no law follow a whole record."""
    return sensitivity(problem, trainable, simulated) > SENSITIVE


def length_of_pieces(
    problem: Problem, trainable: Trainable, simulated: Simulated, part: float
) -> float:
    """In seconds, how long a model is about insensitive to its start, by the fastest growth in one of its records.

    It is at most this part of the longest record; infinite where the records are too short.
    """
    records = problem.records
    rows, times = [records.rows_of(i) for i in range(records.count)], np.asarray(records.steps.t)
    sample = float(np.median(np.concatenate([np.diff(times[own]) for own in rows])))
    longest = max(float(np.ptp(times[own])) for own in rows)
    moved, found = _moved(problem, trainable, simulated), USUAL * sample
    if moved is not None and np.isfinite(simulated.loss):
        sizes = np.maximum(np.std(np.asarray(simulated.x), axis=0), 1e-300)
        apart = np.abs(np.asarray(moved.x - simulated.x) / sizes).max(axis=1) / OFF
        growths = [_growth(times[own] - times[own[0]], apart[own]) for own in rows]
        found = np.log(GROWN) / max(growths) if max(growths) > 0 else np.inf
    least = LEAST * sample
    return float(np.clip(found, least, part * longest)) if part * longest >= least else np.inf


def in_pieces(
    records: Mapping[str, Data], length: float, begin: tuple[str, ...], *, again: bool = False
) -> dict[str, Data] | None:
    """Records in pieces of equal lengths, up to so long; ``None`` where that divides none.

    Arguments:
        records: by name. length: in seconds.
        begin: signals that are measured where a piece begins.
        again: whether these are pieces already, which lose the end of their names.
    """
    found: dict[str, Data] = {}
    for name, data in records.items():
        t = data.time
        whole = whole_record(name) if again else name
        ends = np.linspace(t[0], t[-1], 1 + int(np.ceil((t[-1] - t[0]) / length)))
        known = np.all([np.isfinite(data[n]) for n in begin], axis=0) | np.zeros(len(t), bool)
        if len(ends) == 2:
            found[name] = data
            continue
        for first, last in pairwise(ends):
            inside = (t >= first) & ((t < last) | (last == t[-1]))
            own = t[inside][np.argmax(known[inside]) :] if known[inside].any() else t[:0]
            if len(own) >= LEAST // 2:
                found[f"{whole} from {own[0]:.12g} s"] = data.between(own[0], own[-1])
    return found if len(found) > len(records) else None


def whole_record(name: str) -> str:
    """The record of a piece, by their names."""
    return re.sub(r" from [^ ]+ s$", "", name)


def _moved(problem: Problem, trainable: Trainable, simulated: Simulated) -> Simulated | None:
    """The same from starts that are a little off; ``None`` where the training finds none."""
    off, prior, shooting = OFF * jnp.std(simulated.x, axis=0), problem.start_prior, problem.shooting
    if shooting is not None and trainable.states is not None:
        return problem.simulate(replace(trainable, states=trainable.states + off / shooting.scale))
    if prior is None or trainable.starts is None:
        return None
    moves = jnp.where(prior.scale > 0, off / jnp.where(prior.scale > 0, prior.scale, 1.0), 0.0)
    return problem.simulate(replace(trainable, starts=trainable.starts + moves))


def _growth(t: np.ndarray, apart: np.ndarray) -> float:
    """The rate [1/s] at which two motions have parted until they were half as far apart as they ever are."""
    far = np.maximum.accumulate(np.where(np.isfinite(apart), apart, 0.0))
    k = int(np.argmax(far >= far[-1] / 2))
    return float(np.log(max(far[k], 1.0)) / t[k]) if t[k] > 0 else 0.0
