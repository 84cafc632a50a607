"""The result of a training for one of its records."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from acausal.data import RecordsLike, records_of
from acausal.training.objective.held_out import over
from acausal.training.objective.initial_state import InitialState
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Simulated, Trainable
from acausal.training.uncertainty.residuals import Piece, Residuals, residuals


@dataclass(frozen=True, eq=False)
class RecordFit:
    """How a trained model follows one of the records.

    Attributes:
        name: of the record.
        targets: names of the columns of ``measured`` and ``predicted``.
        time: of its samples, in seconds.
        measured: the targets; NaN where they are not measured.
        predicted: the targets in one simulation of the record.
        inputs: by name, the model's inputs at the samples.
        sigma: standard deviations of the targets over all records.
        x0: the state at the record's start, by name.
        parameters: the values of the parameters that differ between records, by name.
        arguments: by network, what it was called with at the samples, sample by sample.
    """

    name: str
    targets: tuple[str, ...]
    time: Float[np.ndarray, " n"]
    measured: Float[np.ndarray, "n n_targets"]
    predicted: Float[np.ndarray, "n n_targets"]
    inputs: Mapping[str, Float[np.ndarray, " n"]]
    sigma: Float[np.ndarray, " n_targets"]
    x0: dict[str, float]
    parameters: dict[str, float]
    arguments: Mapping[str, Float[np.ndarray, "n_calls n_arguments"]]

    @property
    def errors(self) -> Float[np.ndarray, "n n_targets"]:
        """Measured less predicted; NaN where nothing is measured."""
        return self.measured - self.predicted

    @property
    def rms(self) -> dict[str, float]:
        """By target, the root mean square error in the target's unit; NaN for one that is not measured."""
        return rms_of([self])

    def residuals(self) -> tuple[Residuals, ...]:
        """The residuals of every target that is measured."""
        return residuals_of([self])

    def __repr__(self) -> str:
        errors = ", ".join(f"{n} {value:.4g}" for n, value in self.rms.items())
        return f"RecordFit('{self.name}', {len(self.time)} samples, RMS error: {errors})"


def rms_of(records: Iterable[RecordFit]) -> dict[str, float]:
    """By target, the root mean square error over records in the target's unit; NaN for one that is not measured."""
    every = list(records)
    with np.errstate(over="ignore"):  # of a prediction that diverges
        squares = np.concatenate([record.errors for record in every]) ** 2
    counts = (~np.isnan(squares)).sum(axis=0)
    means = np.nansum(squares, axis=0) / np.where(counts > 0, counts, np.nan)
    return dict(zip(every[0].targets, np.sqrt(means).tolist(), strict=True))


def residuals_of(records: Sequence[RecordFit]) -> tuple[Residuals, ...]:
    """The residuals of every target over some records together, at the samples that are measured."""
    found: list[Residuals] = []
    for i, name in enumerate(records[0].targets):
        pieces: list[Piece] = []
        for record in records:
            error = record.errors[:, i]
            known = ~np.isnan(error)
            if known.sum() > 1:
                pieces.append(Piece(error[known], {n: u[known] for n, u in record.inputs.items()}))
        if pieces:
            found.append(residuals(name, pieces, float(records[0].sigma[i])))
    return tuple(found)


def of_other_records(
    problem: Problem, trained: Trainable, data: RecordsLike, x0: InitialState
) -> dict[str, RecordFit]:
    """The results of a training for other records, each in one simulation; errors as of `over`."""
    records = {n: d.for_system(problem.system) for n, d in records_of(data).items()}
    other = over(problem, records, x0)
    known = other.over_other_records(trained)
    return of_records(other, known, other.simulate(known))


def of_records(
    problem: Problem, trainable: Trainable, simulated: Simulated
) -> dict[str, RecordFit]:
    """The results for all records, by name, for some state of the training and its simulation."""
    records = problem.records
    t, x, y, u = (
        np.asarray(a) for a in (records.steps.t, simulated.x, simulated.y, problem.inputs)
    )
    measured = records.measured
    seen = problem.seen(trainable, simulated.x, simulated.d) if problem.networks else {}
    calls = {n: np.asarray(a).reshape(len(x), -1, a.shape[-1]) for n, a in seen.items()}
    own = problem.per_record.values(problem.assemble(trainable), trainable.per_record)

    def one(k: int, name: str) -> RecordFit:
        rows = records.rows_of(k)
        return RecordFit(
            name,
            problem.targets,
            t[rows],
            measured[rows],
            y[rows],
            {n: u[rows, i] for i, n in enumerate(problem.system.inputs)},
            np.asarray(records.sigma),
            dict(zip(problem.system.states, x[rows[0]].tolist(), strict=True)),
            {n: float(values[k]) for n, values in own.items()},
            {n: a[rows].reshape(-1, a.shape[-1]) for n, a in calls.items()},
        )

    return {name: one(k, name) for k, name in enumerate(records.names)}
