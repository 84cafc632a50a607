"""How models are judged: free simulation from a state that a few samples tell, and the error of the others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.optimize import least_squares

import acausal as ac


def simulate(
    system: ac.System,
    params: Mapping[str, Any] | None,
    record: ac.Data,
    target: str,
    *,
    known: int,
    solver: str,
    dt: float | None = None,
    given: Mapping[str, float] | None = None,
    guess: Mapping[str, float] | None = None,
) -> ac.Solution:
    """A simulation of a whole record that sees no more of its output than the first ``known`` samples.

    From these comes the state at the start, by least squares from a ``guess``, but for states that are ``given``. By
    default the guess is what is measured, or zero. ``dt`` is the step, by default the sample time.
    """
    h = record.sample_time
    known_states = dict(given or {})
    free = [n for n in system.states if n not in known_states]
    begin = record.between(record.time[0], record.time[0] + (known - 0.5) * h)

    def run(part: ac.Data, x0: np.ndarray) -> ac.Solution:
        start = {**known_states, **dict(zip(free, x0, strict=True))}
        return follow(system, params, part, start, solver=solver, dt=dt or h)

    def errors(x0: np.ndarray) -> np.ndarray:
        return np.asarray(run(begin, x0)[target]) - begin[target]

    measured = {n: float(record[n][0]) for n in free if n in record.signals}
    begun = {**dict.fromkeys(free, 0.0), **measured, **(guess or {})}
    return run(record, least_squares(errors, [begun[n] for n in free], x_scale="jac").x)


def follow(
    system: ac.System,
    params: Mapping[str, Any] | None,
    record: ac.Data,
    start: Mapping[str, float],
    *,
    solver: str,
    dt: float,
) -> ac.Solution:
    """A simulation with a record's inputs, from a state that is known, at the record's times."""
    inputs = {name: record.signal(name) for name in system.inputs}
    span = (record.time[0], record.time[-1])
    return ac.simulate(
        system,
        span,
        dt=dt,
        inputs=inputs,
        params=params,
        x0=start,
        solver=solver,
        saveat=record.time,
    )


def rms(solution: ac.Solution, record: ac.Data, target: str, *, known: int) -> float:
    """Root mean square of the errors after the first ``known`` samples, in the record's unit."""
    error = np.asarray(solution[target]) - record[target]
    return float(np.sqrt(np.mean(error[known:] ** 2)))


def spread(rows: Sequence[Mapping[str, float]]) -> tuple[dict[str, float], dict[str, float]]:
    """Means and standard deviations over seeds, by name."""
    values = {name: [row[name] for row in rows] for name in rows[0]}
    deviation = {n: float(np.std(v, ddof=1)) if len(v) > 1 else 0.0 for n, v in values.items()}
    return {n: float(np.mean(v)) for n, v in values.items()}, deviation
