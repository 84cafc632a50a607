"""What is known of the states at which records start: measured ones within their noise, others within their size."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.data import Data
from acausal.errors import listing
from acausal.training.objective.initial_state import InitialState, by_record
from acausal.training.objective.noise import noise_level

if TYPE_CHECKING:
    from acausal.training.objective.problem import Problem

EXACT = 1e-5
"""A start is taken as it is measured where the noise is less than this part of the state's deviation."""

FOLLOWS = 10.0
"""A model before training tells how large its states are as long as its targets are not so many deviations off."""


class StartPrior(eqx.Module):
    """Independent normal distributions of the states at which R records start, around those of `FirstStates`.

    Attributes:
        scale: standard deviations, in the states' units; 0 where a start is not found by the training.
    """

    scale: Float[Array, "R n_states"]

    def moved(
        self, states: Float[Array, "R n_states"], moves: Float[Array, "R n_states"] | None
    ) -> Float[Array, "R n_states"]:
        """The states after moves in standard deviations; as they are where nothing is known of moves."""
        return states if moves is None else states + self.scale * moves

    def log_prior(self, moves: Float[Array, "R n_states"] | None) -> Float[Array, ""]:
        """Minus the logarithm of the density, up to a constant."""
        return jnp.zeros(()) if moves is None else 0.5 * jnp.sum(moves**2)


def start_prior(
    states: tuple[str, ...], data: Mapping[str, Data], x0: InitialState
) -> StartPrior | None:
    """What is known of the starts of records; NaN for states that are not measured; ``None`` where all are exact.

    Arguments:
        states: names of the model's states.
        data: records by name.
        x0: where records start. ``"auto"`` takes what is measured within its noise. Values by name are exact, and so is
            what is measured beside them.
    """

    def scale(record: Data, name: str, given: Mapping[str, float] | None) -> float:
        signal = record.signals.get(name)
        if given is not None and name in given:
            return 0.0
        if signal is None or np.isnan(signal[0]):
            return np.nan if signal is None or np.isnan(signal).all() else float(np.nanstd(signal))
        with np.errstate(over="ignore"):
            noise, deviation = noise_level([np.asarray(signal)]), np.nanstd(signal)
        return noise if given is None and EXACT * deviation < noise < np.inf else 0.0

    rows: list[list[float]] = []
    for record, of in zip(data.values(), by_record(data, x0), strict=True):
        if isinstance(of, str) and of != "auto":
            rows.append([0.0] * len(states))
        else:
            rows.append([scale(record, n, None if isinstance(of, str) else of) for n in states])
    found = np.asarray(rows, float)
    return StartPrior(jnp.asarray(found)) if found.any() else None


def found_starts(problem: Problem) -> str:
    """A clause on the states whose starts the training has found, and near what; empty where there are none."""
    if problem.start_prior is None:
        return ""
    found = np.asarray(problem.start_prior.scale) > 0
    measured = np.isfinite(np.asarray(problem.first_states.given))
    clauses: list[str] = []
    for rows, where in ((found & measured, "measured"), (found & ~measured, "model's")):
        states = [problem.system.states[i] for i in np.unique(np.nonzero(rows)[1])]
        clauses += [f"{listing(states)} near the {where} start"] if states else []
    return "; ".join(clauses)


def with_sizes(problem: Problem) -> Problem:
    """The same problem with sizes of the states that are not measured, in the place of NaN.

    A size is half of the range that the state passes before training, as long as the model follows its records
    somehow; its nominal value where it does not move.
    """
    prior = problem.start_prior
    if prior is None or not np.isnan(np.asarray(prior.scale)).any():
        return problem
    known = replace(
        problem, start_prior=StartPrior(jnp.where(jnp.isnan(prior.scale), 1.0, prior.scale))
    )
    simulated, records = known.simulate(known.start()), problem.records
    x, y = np.asarray(simulated.x), np.asarray(simulated.y)
    with np.errstate(all="ignore"):
        far = np.abs(y - np.asarray(records.y)) > FOLLOWS * np.asarray(records.sigma)
        off = (far & (np.asarray(records.weight) > 0)) | ~np.isfinite(y)
        lost = np.atleast_1d(off.any(axis=1))
    scale = np.array(prior.scale)
    for k in range(records.count):
        rows = np.arange(len(x))[records.rows_of(k)]
        end = rows[0] + 1 + int(np.argmax(np.append(lost[rows], True)))
        passed = x[rows[0] : end]
        passed = passed[np.isfinite(passed).all(axis=1)]
        half = np.ptp(passed, axis=0) / 2 if len(passed) else np.zeros(len(scale[k]))
        size = np.where(half > 0, half, problem.system.nominal)
        scale[k] = np.where(np.isnan(scale[k]), size, scale[k])
    return replace(problem, start_prior=StartPrior(jnp.asarray(scale)))
