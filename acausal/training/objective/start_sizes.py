"""Sizes of states whose start is not measured, and which starts a training finds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import jax.numpy as jnp
import numpy as np
from jaxtyping import Bool

from acausal.errors import listing
from acausal.training.objective.problem import Problem
from acausal.training.objective.start_prior import StartPrior
from acausal.training.objective.trainable import Trainable

FOLLOWS = 10.0
"""A model before training tells how large its states are as long as its targets are not so many deviations off."""


def found_starts(problem: Problem, records: slice = slice(None)) -> str:
    """A clause on the states whose starts were found for some records, and near what; empty where there are none.

    It says, too, with what discrete variables begin that decide on what follows, unless that is measured or given.
    """
    begins = list(_modes(problem, records))
    if problem.start_prior is None:
        return "".join(begins)
    found = np.asarray(problem.start_prior.scale)[records] > 0
    measured = np.isfinite(np.asarray(problem.first_states.given)[records])
    clauses: list[str] = []
    for rows, where in ((found & measured, "measured"), (found & ~measured, "model's")):
        states = [problem.system.states[i] for i in np.unique(np.nonzero(rows)[1])]
        clauses += [f"{listing(states)} near the {where} start"] if states else []
    return "; ".join([*clauses, *begins])


def _modes(problem: Problem, records: slice) -> Iterator[str]:
    """Clauses on the discrete variables that begin as the model starts, or as first samples show."""
    first, system = problem.first_states, problem.system
    count = len(np.asarray(first.kind)[records])
    begins = np.full((count, len(system.reduced.discrete)), np.nan)
    shown = np.zeros(begins.shape, bool)
    if first.discrete is not None and first.shown is not None:
        begins, shown = (np.asarray(a)[records] for a in (first.discrete, first.shown))
    as_model = list[str]()
    for name in system.remembered:
        place, _ = system.discrete[name]
        values = np.unique(begins[shown[:, place], place]).tolist()
        for value in values:
            which = (
                f" in {np.sum(begins[:, place] == value)} of {count} records" if count > 1 else ""
            )
            yield f"'{name}' begins with {value:g}{which}, as first samples show"
        if not values and np.isnan(begins[:, place]).any():
            as_model.append(name)
    if as_model:
        yield f"{listing(as_model, 3)} as the model starts"


def with_sizes(problem: Problem, trainable: Trainable | None = None) -> Problem:
    """The same problem with sizes of the states that are not measured, in the place of NaN.

    A size is half of the range that the state passes before training (or with what was trained), as long as the model
    follows its records somehow; its nominal value where it does not move.
    """
    prior = problem.start_prior
    if prior is None or not (unknown := np.isnan(np.asarray(prior.scale))).any():
        return problem
    known = replace(problem, start_prior=StartPrior(jnp.where(unknown, 1.0, prior.scale)))
    return _sized(known, known.start() if trainable is None else trainable, unknown)


def resized(problem: Problem, trainable: Trainable) -> tuple[Problem, Trainable]:
    """The same problem with the sizes of states, at starts that are found and not measured, where it has come to."""
    prior, moves = problem.start_prior, trainable.starts
    if prior is None or moves is None:
        return problem, trainable
    unknown = np.isnan(np.asarray(problem.first_states.given)) & (np.asarray(prior.scale) > 0)
    if not unknown.any():
        return problem, trainable
    sized = _sized(problem, trainable, unknown)
    assert sized.start_prior is not None
    shrunk = jnp.where(unknown, prior.scale / sized.start_prior.scale, 1.0)
    return sized, replace(trainable, starts=moves * shrunk)


def _sized(problem: Problem, trainable: Trainable, unknown: Bool[np.ndarray, "R n"]) -> Problem:
    """The same problem with sizes from a simulation, in the place of those that are unknown."""
    assert problem.start_prior is not None
    simulated, records = problem.simulate(trainable), problem.records
    x, y = np.asarray(simulated.x), np.asarray(simulated.y)
    with np.errstate(all="ignore"):
        far = np.abs(y - np.asarray(records.y)) > FOLLOWS * np.asarray(records.sigma)
        off = (far & (np.asarray(records.weight) > 0)) | ~np.isfinite(y)
        lost = np.atleast_1d(off.any(axis=1))
    scale = np.array(problem.start_prior.scale)
    for k in range(records.count):
        rows = np.arange(len(x))[records.rows_of(k)]
        end = rows[0] + 1 + int(np.argmax(np.append(lost[rows], True)))
        passed = x[rows[0] : end]
        passed = passed[np.isfinite(passed).all(axis=1)]
        half = np.ptp(passed, axis=0) / 2 if len(passed) else np.zeros(len(scale[k]))
        size = np.where(half > 0, half, problem.system.nominal)
        scale[k] = np.where(unknown[k], size, scale[k])
    return replace(problem, start_prior=StartPrior(jnp.asarray(scale)))
