"""With which truth values records begin that nobody measures: those that explain their first samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float, Int

from acausal.data import Data
from acausal.training.objective.initial_state import (
    FirstStates,
    InitialState,
    by_record,
    first_states,
)
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable

MOST = 3
"""Where more truth values are open none is tried: each combination costs a simulation."""

FEWEST, PART = 12, 0.1
"""A record's first samples: at least so many, or this part of them."""

BETTER = 0.5
"""Other values are taken if they leave less than this part of the squares that the model's own start leaves."""

ALIKE = 1e-6
"""Values that leave fewer squares by less than this part are no better than others that change less."""


def with_start_modes(
    problem: Problem,
    trainable: Trainable,
    data: Mapping[str, Data],
    x0: InitialState,
    *,
    trained: bool = False,
) -> Problem:
    """The same problem with the truth values that events remember as the first samples of each record have them.

    Those that are measured or given stay, and those of records that start exactly as measured or as the model does.
    Records of a stream begin as the model does. Parameters that are not ``trained`` may be off by as much as a mode
    changes: then the model's own start is left only where it explains less than that nothing moves, and others more.
    """
    system, own = problem.system, problem.first_states
    kinds = system.wholes
    places = {system.discrete[n][0] for n in system.remembered if kinds.get(n) == "bool"}
    if problem.streamed is not None or not places:
        return problem
    shape = len(own.kind), len(system.reduced.discrete)
    given = np.full(shape, np.nan) if own.discrete is None else np.asarray(own.discrete)
    is_open = np.isnan(given)
    is_open[[of in ("model", "steady", "data") for of in by_record(data, x0)]] = False
    rows = _first_rows(problem)
    weight = np.asarray(problem.records.weight)
    is_open[[not weight[of_record].any() for of_record in rows]] = False
    free = sorted(place for place in places if is_open[:, place].any())
    if not 0 < len(free) <= MOST:
        return problem

    # states as measured, or as the model starts: what a training finds is not known yet
    measured = first_states(system, data, x0, trained=False)
    alone = replace(problem, start_prior=None, shooting=None)
    begun = replace(trainable, starts=None, states=None)

    def squares(discrete: Float[np.ndarray, "R n_discrete"]) -> Float[np.ndarray, " R"]:
        states = _beginning(measured, discrete)
        y = replace(alone, first_states=states).simulate(begun).y
        return _squares(problem, np.asarray(y), rows)

    packed = alone.pack(alone.assemble(begun), begun)
    states = _beginning(measured, np.full(shape, np.nan))
    usual = np.asarray(replace(alone, first_states=states).discrete_starts(packed))
    best = given.copy()
    own_squares = squares(given)
    least = BETTER * own_squares
    if not trained:
        still = _squares(problem, _at_rest(problem, rows), rows)
        least = np.where(own_squares > still, np.minimum(least, still), 0.0)
    flips = sorted(product((False, True), repeat=len(free)), key=sum)
    for flip in flips[1:]:
        tried, which = given.copy(), np.zeros(shape, bool)
        which[:, free] = np.asarray(flip) & is_open[:, free]
        tried[which] = 1 - usual[which]
        left = squares(tried)
        better = left < least * (1 - ALIKE)
        best[better], least[better] = tried[better], left[better]
    found = is_open & np.isfinite(best)
    return replace(problem, first_states=replace(_beginning(own, best), shown=jnp.asarray(found)))


def _beginning(first: FirstStates, discrete: Float[np.ndarray, "R n_discrete"]) -> FirstStates:
    values = jnp.asarray(discrete)
    return replace(first, discrete=values, shown=jnp.zeros(values.shape, bool))


def _first_rows(problem: Problem) -> list[Int[np.ndarray, " m"]]:
    """The rows of each record's first samples."""
    records = problem.records
    every = (np.arange(len(records))[records.rows_of(k)] for k in range(records.count))
    return [rows[: max(FEWEST, int(PART * len(rows)))] for rows in every]


def _at_rest(
    problem: Problem, rows: list[Int[np.ndarray, " m"]]
) -> Float[np.ndarray, "N n_targets"]:
    """Each target as it is measured first in each record."""
    y, counts = np.array(problem.records.y), np.asarray(problem.records.weight) > 0
    for of_record in rows:
        first = of_record[np.argmax(counts[of_record], axis=0)]
        y[of_record] = y[first, np.arange(y.shape[1])]
    return y


def _squares(
    problem: Problem, y: Float[np.ndarray, "N n_targets"], rows: list[Int[np.ndarray, " m"]]
) -> Float[np.ndarray, " R"]:
    """The squares of each record's errors in some rows, for what targets are predicted to be."""
    records = problem.records
    errors = np.nan_to_num((y - np.asarray(records.y)) / np.asarray(records.sigma), nan=np.inf)
    errors = np.where(np.asarray(records.weight) > 0, errors, 0.0)
    return np.array([np.sum(errors[of_record] ** 2) for of_record in rows])
