"""A trained model: what a training has found, as data, and the figures that follow from it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Bool, Float

from acausal.errors import TrainingError, known_name, need_whole
from acausal.training.history import History
from acausal.training.objective.error_laws import LogLikelihood
from acausal.training.objective.problem import Problem
from acausal.training.objective.timing import delay_of, lag_of
from acausal.training.objective.trainable import Trainable
from acausal.training.record_fit import RecordFit, of_records, residuals_of, rms_of
from acausal.training.starts import Starts
from acausal.training.strategy import StageResult
from acausal.training.uncertainty.confidence import Confidence
from acausal.training.uncertainty.laplace import confidence
from acausal.training.uncertainty.residuals import Residuals

if TYPE_CHECKING:
    from acausal.system import System


OUTSIDE = 0.05
"""A record is outside of the training's range if it leaves it by more than this part of it."""


@dataclass(frozen=True, eq=False)
class Seen:
    """Statistics of a network's arguments over the record, in one simulation with the trained parameters.

    Attributes:
        mean: of every argument.
        sigma: standard deviation of every argument.
    """

    mean: Float[np.ndarray, " n_arguments"]
    sigma: Float[np.ndarray, " n_arguments"]

    def interval(
        self, sigmas: float = 2.0
    ) -> tuple[Float[np.ndarray, " n_arguments"], Float[np.ndarray, " n_arguments"]]:
        """Bounds ``mean ± sigmas · σ`` of every argument; outside of 2σ a network extrapolates."""
        return self.mean - sigmas * self.sigma, self.mean + sigmas * self.sigma


@dataclass(frozen=True, eq=False)
class TrainedModel:
    """What a training has found: attributes as of `Fit`, which answers further questions. Pages and cards read it."""

    system: System
    params: dict[str, Any]
    loss: float
    loss_before: float
    validation_loss: float | None
    best_epoch: int
    records: dict[str, RecordFit]
    held_out: dict[str, RecordFit]
    modifiers: dict[str, float]
    arguments: dict[str, Float[np.ndarray, "n_calls n_arguments"]]
    seen: dict[str, Seen]
    history: History
    seconds: float
    prepare_seconds: float
    compile_seconds: float
    seconds_per_epoch: float
    interrupted: bool
    problem: Problem
    trained: Trainable
    starts: Starts | None = None
    settings: Mapping[str, str] = field(default_factory=dict[str, str])
    stages: tuple[StageResult, ...] = ()
    step_error: float | None = None
    not_laws: tuple[str, ...] = ()
    without_constant: tuple[str, ...] = ()
    pieces: int = 0
    misread: tuple[str, ...] = ()

    @property
    def x0(self) -> dict[str, float]:
        """The state at the start of the only record, by name."""
        return self._only("x0").x0

    @property
    def predicted(self) -> Float[np.ndarray, "N n_targets"]:
        """The targets in one simulation of the only record."""
        return self._only("predicted").predicted

    @property
    def time(self) -> Float[np.ndarray, " N"]:
        """The times of the only record, in seconds."""
        return self._only("time").time

    @property
    def samples_trained(self) -> int:
        """How many samples the training's records have."""
        streamed = self.problem.streamed
        return self._samples_in_memory if streamed is None else int(streamed.rows.sum())

    @property
    def evaluated(self) -> str:
        """What of a stream is in memory, over which losses and errors are; empty where all is."""
        some, every = self._samples_in_memory, self.samples_trained
        return f"the first {some} of {every} samples" if some < every else ""

    @property
    def _samples_in_memory(self) -> int:
        return sum(len(record.time) for record in self.records.values())

    def _only(self, what: str) -> RecordFit:
        """The only record.

        Raises:
            TrainingError: if there are several.
        """
        first, *others = self.records.values()
        if others:
            raise TrainingError(
                f"There are {len(self.records)} records: ask one of them, fit.records['{first.name}'].{what}."
            )
        return first

    @property
    def rms(self) -> dict[str, float]:
        """By target, the root mean square error over all records, in the target's unit."""
        return rms_of(self.records.values())

    @cached_property
    def noise(self) -> dict[str, float]:
        """By target, the level of its noise in its unit: as given to the loss, or as estimated from all records.

        For losses that know of no noise it is the root mean square error.
        """
        problem, records = self.problem, self.problem.records
        if not isinstance(problem.loss, LogLikelihood):
            return self.rms
        predicted = problem.simulate(self.trained).y
        levels = problem.loss.levels(predicted, records.y, records.sigma, records.weight)
        return dict(zip(problem.targets, levels.tolist(), strict=True))

    @property
    def delays(self) -> dict[str, float]:
        """The delays of inputs and targets in seconds, trained or given."""
        found = self.problem.assemble(self.trained)
        return {n: float(found[delay_of(n)]) for n in self.problem.timing.delays}

    @property
    def lags(self) -> dict[str, float]:
        """The time constants of targets' sensors in seconds, trained or given."""
        found = self.problem.assemble(self.trained)
        return {n: float(found[lag_of(n)]) for n in self.problem.timing.lags}

    @property
    def score(self) -> float:
        """The loss by which the best was chosen: over the held-out samples, else over the whole record."""
        return self.loss if self.validation_loss is None else self.validation_loss

    def confidence(self, record: str | None = None) -> Confidence:
        """How well the records determine the learned laws and the trained parameters; computed when first asked for.

        Arguments:
            record: what this record alone determines; by default all together.

        Raises:
            TrainingError: for a name that is not a record, or if the model diverges over a record.
        """
        if record is not None:
            known_name(record, self.problem.records.names, "There is no record", TrainingError)
        if record not in self._confidences:
            problem = self.problem if record is None else self._alone(record)
            self._confidences[record] = confidence(problem, self.trained, self.arguments)
        return self._confidences[record]

    @cached_property
    def _confidences(self) -> dict[str | None, Confidence]:
        return {}

    def _alone(self, record: str) -> Problem:
        """The problem in which one record alone counts."""
        known = self.problem.records
        counts = (known.of == known.names.index(record))[:, None]
        return replace(
            self.problem,
            records=replace(known, weight=jnp.where(counts, known.weight, 0.0)),
            prior=None,
        )

    def residuals(self, record: str | None = None) -> tuple[Residuals, ...]:
        """The residuals of every target: over one record, or over all of them.

        Raises:
            TrainingError: for a name that is not a record.
        """
        names = (
            self.records
            if record is None
            else (known_name(record, self.records, "There is no record", TrainingError),)
        )
        return residuals_of([self.records[name] for name in names])

    @cached_property
    def before(self) -> dict[str, RecordFit]:
        """The records before training, as `records`."""
        start = self.problem.start()
        return of_records(self.problem, start, self.problem.simulate(start))

    def samples(self, network: str, most: int = 400) -> Float[np.ndarray, " n_samples"]:
        """Some of the values that a network's first argument had over the record, at most so many."""
        values = self.arguments[self.need_network(network)][:, 0]
        return values[:: max(1, len(values) // need_whole(most, "most", least=1))]

    def need_network(self, network: str) -> str:
        """The name of a trained network.

        Raises:
            TrainingError: for any other name.
        """
        return known_name(network, self.seen, "There is no trained network", TrainingError)

    @property
    def ranges(self) -> dict[str, tuple[tuple[float, float], ...]]:
        """By network, the least and the greatest value of each argument in one simulation of every record.

        `export` takes them as ``ranges``. A network that was called with values that are not finite has none.
        """
        return {
            name: tuple(zip(seen.min(axis=0).tolist(), seen.max(axis=0).tolist(), strict=True))
            for name, seen in self.arguments.items()
            if np.isfinite(seen).all()
        }


def out_of_range(record: RecordFit, model: TrainedModel) -> str:
    """A sentence on what of a predicted record is outside of what a model was trained on; empty where nothing is.

    Inputs, targets and the arguments of networks count, at samples where a target is measured, from `OUTSIDE` of the
    range in training on; so do two arguments of a network that are not related as they were.
    """
    seen = [_measured(r) for r in model.records.values()]
    found: list[str] = []
    for name, values in _measured(record).items():
        known = np.concatenate([columns[name] for columns in seen])
        if not (len(values) and len(known)):
            continue
        low, high, least, most = known.min(), known.max(), values.min(), values.max()
        if max(low - least, most - high) > OUTSIDE * (high - low):
            plain = name in (*record.inputs, *record.targets)
            what, unit = (f"'{name}'", model.system.unit(name)) if plain else (name, "")
            found.append(
                f"{what} is from {least:.4g} to {most:.4g} {unit}".rstrip()
                + f" (in training {low:.4g} to {high:.4g})"
            )
    found = found or list(_unlike(record, model))
    if not found:
        return ""
    return f"'{record.name}' is outside of the training's range: {', '.join(found)}. There the model extrapolates."


def _unlike(record: RecordFit, model: TrainedModel) -> Iterator[str]:
    """Which arguments of networks are together what they were not in training: by their sums and differences."""
    for name, seen in model.arguments.items():
        calls, counts, spread = record.arguments.get(name), _counting(record), seen.std(axis=0)
        if calls is None or not (np.isfinite(seen).all() and np.isfinite(calls).all()):
            continue
        now = calls.reshape(len(counts), -1, calls.shape[1])[counts].reshape(-1, calls.shape[1])
        then, now = (
            (a - seen.mean(axis=0)) / np.where(spread > 0, spread, 1.0) for a in (seen, now)
        )
        margin = 2 * OUTSIDE * np.ptp(then, axis=0)
        for i, j in combinations(range(seen.shape[1]), 2):
            for sign in (1, -1):
                known, values = (a[:, i] + sign * a[:, j] for a in (then, now))
                beyond = max(known.min() - values.min(), values.max() - known.max())
                if beyond > margin[i] + margin[j]:
                    yield (
                        f"arguments {i + 1} and {j + 1} of '{name}' have values together that they never had in "
                        "training"
                    )
                    break


def _counting(record: RecordFit) -> Bool[np.ndarray, " n"]:
    """Where some target is measured; everywhere if none is."""
    counts = np.atleast_1d(np.isfinite(record.measured).any(axis=1))
    return counts if counts.any() else np.ones_like(counts)


def _measured(record: RecordFit) -> dict[str, Float[np.ndarray, " m"]]:
    """Inputs, targets and arguments of networks, by name, where some target is measured; everywhere if none is."""
    counts = _counting(record)
    columns = {
        **record.inputs,
        **{n: record.measured[:, i] for i, n in enumerate(record.targets)},
    }
    for name, calls in record.arguments.items():
        at_samples = calls.reshape(len(counts), -1, calls.shape[1])
        for i in range(calls.shape[1]):
            which = f"argument {i + 1}" if calls.shape[1] > 1 else "the argument"
            columns[f"{which} of '{name}'"] = at_samples[:, :, i]
    rows = {n: c[counts] for n, c in columns.items()}
    return {n: c[np.isfinite(c)] for n, c in rows.items()}
