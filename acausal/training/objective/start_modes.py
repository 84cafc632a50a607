"""With which truth values records begin that nobody measures: those that explain their first samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.data import Data
from acausal.training.objective.initial_state import InitialState, by_record
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable

MOST = 3
"""Of more truth values not all combinations are tried: each costs a simulation."""

FEWEST, PART = 12, 0.1
"""A record's first samples: at least so many, or this part of them."""

BETTER = 0.5
"""A combination is taken if it leaves less than this part of the squares that the model's own start leaves."""


def with_start_modes(
    problem: Problem, trainable: Trainable, data: Mapping[str, Data], x0: InitialState
) -> Problem:
    """The same problem with the truth values that events remember as the first samples of each record have them.

    Those that are measured or given stay, and those of records that start exactly as measured or as the model does.
    """
    system, first = problem.system, problem.first_states
    kinds = system.wholes
    places = {system.discrete[n][0] for n in system.remembered if kinds.get(n) == "bool"}
    shape = len(first.kind), len(system.reduced.discrete)
    given = np.full(shape, np.nan) if first.discrete is None else np.asarray(first.discrete)
    is_open = np.isnan(given)
    is_open[[of in ("model", "steady", "data") for of in by_record(data, x0)]] = False
    free = sorted(place for place in places if is_open[:, place].any())
    if problem.streamed is not None or not 0 < len(free) <= MOST:
        return problem

    def starting(discrete: Float[np.ndarray, "R n_discrete"]) -> Problem:
        return replace(problem, first_states=replace(first, discrete=jnp.asarray(discrete)))

    best = given.copy()
    least = BETTER * _first_squares(starting(given), trainable)
    for values in product((0.0, 1.0), repeat=len(free)):
        tried = given.copy()
        tried[:, free] = np.where(is_open[:, free], values, given[:, free])
        squares = _first_squares(starting(tried), trainable)
        better = squares < least
        best[better], least[better] = tried[better], squares[better]
    found = is_open & np.isfinite(best)
    if not found.any():
        return problem
    chosen = starting(best)
    return replace(chosen, first_states=replace(chosen.first_states, told=jnp.asarray(found)))


def _first_squares(problem: Problem, trainable: Trainable) -> Float[np.ndarray, " R"]:
    """The weighted squares of each record's errors over its first samples."""
    records = problem.records
    y: Array = problem.simulate(trainable).y
    errors = np.where(
        np.asarray(records.weight) > 0,
        np.nan_to_num(np.asarray((y - records.y) / records.sigma), nan=np.inf),
        0.0,
    )
    rows = [np.arange(len(errors))[records.rows_of(k)] for k in range(records.count)]
    return np.array([np.sum(errors[r[: max(FEWEST, int(PART * len(r)))]] ** 2) for r in rows])
