"""Folds: each leaves a part of the samples out of the training, and judges the model on it.

What is left out has the weight zero, so that all folds have arrays of the same shapes and share one compiled program.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Literal, NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from acausal.data import Data
from acausal.errors import DataError, is_whole, shown
from acausal.training.objective.held_out import of_others
from acausal.training.objective.initial_state import InitialState, first_states
from acausal.training.objective.problem import Problem
from acausal.training.objective.records import Records
from acausal.training.objective.sequences import whole_records

Folds = Literal["records"] | int
"""Each record in turn, or so many blocks of time."""


class LeftOut(NamedTuple):
    """What a fold leaves out.

    Attributes:
        name: of the record, or which block of time.
        rows: which rows.
        record: whether it is a record.
    """

    name: str
    rows: Bool[np.ndarray, " N"]
    record: bool


def left_out(records: Records, folds: Folds) -> tuple[LeftOut, ...]:
    """What each fold leaves out.

    Raises:
        DataError: for another word or number, or a fold without samples to train on or to be judged on.
    """
    found = tuple(
        _records(records)
        if isinstance(folds, str) and folds == "records"
        else _blocks(records, folds)
    )
    measured = _counts(records.weight)
    for fold in found:
        for rows, what in ((fold.rows, "be judged on"), (~fold.rows, "train on")):
            if not measured[rows].any():
                raise DataError(
                    f"folds={folds!r}: the fold without '{fold.name}' has no samples to {what}; take other folds."
                )
    return found


def _counts(weight: Float[Array, "N n_targets"]) -> Bool[np.ndarray, " N"]:
    """In which rows something is measured that counts."""
    return np.asarray(jnp.any(weight > 0, axis=1))


def _records(records: Records) -> Iterator[LeftOut]:
    if records.count == 1:
        raise DataError(
            "folds='records' leaves out one record at a time, and there is only one: take folds=5."
        )
    for k, name in enumerate(records.names):
        yield LeftOut(name, np.asarray(records.of) == k, True)


def _blocks(records: Records, count: Folds) -> Iterator[LeftOut]:
    """Blocks of equal duration in each record."""
    if not is_whole(count) or int(count) < 2:
        raise DataError(
            f"folds={shown(count)}; give 'records', or a number of blocks of time, at least 2."
        )
    count = int(count)
    t, of = np.asarray(records.steps.t), np.asarray(records.of)
    first, last = (t[np.asarray(rows)][of] for rows in (records.first, records.last))
    block = np.minimum((count * (t - first) / (last - first)).astype(int), count - 1)
    for k in range(count):
        yield LeftOut(f"block {k + 1} of {count}", block == k, False)


def without(problem: Problem, fold: LeftOut) -> Problem:
    """The problem of training without what a fold leaves out."""
    records = problem.records
    weight = jnp.where(fold.rows[:, None], 0.0, records.weight)
    seen = np.zeros(records.count)
    np.maximum.at(seen, np.asarray(records.of), ~fold.rows)
    return replace(
        problem,
        records=replace(records, weight=weight),
        sequences=problem.sequences.among(_counts(weight)),
        per_record=replace(problem.per_record, trained=jnp.asarray(seen)),
    )


def judged_on(
    problem: Problem, fold: LeftOut, data: Mapping[str, Data], x0: InitialState
) -> Problem:
    """The problem of predicting what a fold leaves out, in one simulation of each record.

    A record that is left out starts as ``x0`` says, where that is trained from its measured state, and with the
    parameters that are expected of other records. In blocks of time everything is known from the rest of the record.

    Raises:
        DataError: if a record lacks the state at its start.
    """
    records = problem.records
    weight = jnp.where(fold.rows[:, None], records.weight, 0.0)
    judged = replace(
        problem,
        per_record=without(problem, fold).per_record,
        records=replace(records, weight=weight, known=not fold.record),
        sequences=whole_records(records),
        mesh=None,
    )
    if fold.record:
        starts = first_states(problem.system, data, of_others(x0, data), trained=False)
        begun = problem.first_states
        starts = replace(starts, discrete=begun.discrete, shown=begun.shown)
        judged = replace(judged, first_states=starts, start_prior=None, shooting=None)
    return judged
