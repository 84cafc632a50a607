"""Problems over whole records, as one sequence."""

from __future__ import annotations

from dataclasses import replace

import jax
import numpy as np

from acausal._jax import array
from acausal.errors import TrainingError
from acausal.training.objective.problem import Problem
from acausal.training.objective.sequences import Sequences, whole_records

MEMORY = 2**30
"""Bytes that the Jacobian of predictions may take; all in all a few times as much is needed."""


def over_whole_record(problem: Problem) -> Problem:
    """The same problem with all of every record as one sequence, every point of it."""
    shooting = None if problem.shooting is None else problem.shooting.of_records()
    whole = whole_records(problem.records)
    return replace(problem, sequences=whole, shooting=shooting, mesh=None)


def over_beginnings(problem: Problem, rows: int) -> Problem:
    """The same problem with the first rows of every record as one sequence.

    In a model with events only these rows count, and the others are simulated with them: its program takes long to
    compile, and so it is that of whole records.
    """
    records = problem.records
    if problem.system.events is None:
        return over_whole_record(replace(problem, records=records.beginnings(rows)))
    since = np.arange(len(records)) - np.asarray(records.first)[np.asarray(records.of)]
    weight = records.weight * array(since < rows, float)[:, None]
    return over_whole_record(replace(problem, records=replace(records, weight=weight)))


def over_windows(problem: Problem, rows: int) -> Problem:
    """The same problem with windows of so many rows that lie side by side and start from measured states."""
    records = problem.records
    first, last = np.asarray(records.first), np.asarray(records.last)
    starts = np.concatenate(
        [np.arange(a, b + 2 - rows, rows) for a, b in zip(first, last, strict=True)]
    )
    assert records.x is not None
    starts = starts[np.isfinite(np.asarray(records.x)[starts]).all(axis=1)]
    cut = Sequences(
        array(starts, int),
        array(np.ones(len(starts))),
        rows,
        batch_size=len(starts),
        points=None,
        whole=False,
        side_by_side=True,
    )
    cut = cut if problem.weighting.alike else cut.weighted(records)
    return replace(problem, sequences=cut, shooting=None, mesh=None)


def gauss_newton(problem: Problem) -> Problem:
    """Whole records, if the Jacobian of its predictions fits into memory.

    Raises:
        TrainingError: if not.
    """
    whole = over_whole_record(problem)
    trained = sum(leaf.size for leaf in jax.tree.leaves(whole.start()))
    models = len(problem.parameter_spread.shifts)
    if (size := 8 * trained * models * problem.records.y.size) > MEMORY:
        raise TrainingError(
            f"The Jacobian of all predictions by {trained} weights and parameters takes {size / 2**30:.1f} GB: "
            "take strategy='whole_record' in place of 'gauss_newton', smaller networks, or a coarser record."
        )
    return whole
