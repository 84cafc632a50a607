"""The history of a training: the report of every update, and the losses over the whole record at intervals."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float, Int

from acausal.errors import DataError, listing
from acausal.training.happened import EventChange
from acausal.training.objective.records import Places
from acausal.training.optimizers.trainer import UpdateLog


@dataclass(frozen=True)
class Divergence:
    """Sequences that diverged in an update and were left out, or an update that was rejected.

    A trial that L-BFGS or Gauss-Newton turns down is none: a search for the best length of a step tries longer ones.

    Attributes:
        epoch: the update.
        time: where the first such sequence starts, in seconds; ``record``: in which record, if there are several.
        count: how many there were; 0 where the gradient was not finite though no sequence diverged.
        exploded: how many of them had a finite loss, but a gradient that exploded: their steps are too long for the
            solver.
        rejected: whether the whole update was rejected.
    """

    epoch: int
    time: float
    count: int
    rejected: bool
    exploded: int = 0
    record: str | None = None

    @property
    def place(self) -> str:
        """Where the sequence starts, in words."""
        of = "" if self.record is None else f" of '{self.record}'"
        return f"t = {self.time:g} s{of}"

    def __str__(self) -> str:
        end = "update rejected" if self.rejected else "left out"
        if self.count == 0:
            return f"epoch {self.epoch}: the gradient is not finite; {end}"
        others = f" and {self.count - 1} more" if self.count > 1 else ""
        what = f"the sequence from {self.place}{others} diverged"
        if self.exploded:
            what += f" ({self.exploded} in its gradient alone)"
        return f"epoch {self.epoch}: {what}; {end}"


@dataclass(frozen=True, eq=False)
class History:
    """A training, update by update.

    Attributes:
        loss: mean loss of each update's batch, before the update. Where an optimizer goes back from trials by itself,
            as L-BFGS and Gauss-Newton do, that of the best point up to then.
        penalties: by regularizer, at the same point.
        modifiers: by parameter, its change there, as of `acausal.Fit.modifiers`.
        seconds: time since the start of the training at the end of each update.
        full_loss: loss over the whole record, (epochs done, loss) in rows.
        validation_loss: loss over the held-out samples, likewise; no rows without validation.
        divergences: what diverged and was left out.
        events: of a model with events, by record, how many conditions change in it, at each evaluation of
            ``full_loss``.
        tried: loss where each update was tried: as ``loss``, but for trials that were turned down, whose loss may be
            of any size or not a number.
        part: of the strategy, to which each update belongs, counted from 0.
    """

    loss: Float[np.ndarray, " epochs"]
    penalties: dict[str, Float[np.ndarray, " epochs"]]
    modifiers: dict[str, Float[np.ndarray, " epochs"]]
    seconds: Float[np.ndarray, " epochs"]
    full_loss: Float[np.ndarray, "k 2"]
    validation_loss: Float[np.ndarray, "k 2"]
    divergences: tuple[Divergence, ...]
    events: dict[str, Int[np.ndarray, " k"]] = field(default_factory=dict[str, np.ndarray])
    tried: Float[np.ndarray, " epochs"] = field(default_factory=lambda: np.zeros(0))
    part: Int[np.ndarray, " epochs"] = field(default_factory=lambda: np.zeros(0, int))

    @property
    def event_changes(self) -> tuple[EventChange, ...]:
        """Where the number of events has changed from one evaluation to the next: there the loss may jump."""
        epochs = self.full_loss[:, 0].astype(int).tolist()
        return tuple(
            EventChange(epochs[i + 1], epochs[i], int(counts[i + 1]), int(counts[i]), record)
            for i in range(len(epochs) - 1)
            for record, counts in self.events.items()
            if counts[i + 1] != counts[i]
        )

    @property
    def epochs(self) -> int:
        """Updates done."""
        return len(self.loss)

    def then(self, later: History, parts: int) -> History:
        """The history of a training that has gone on as another one; this one has so many parts."""

        def joined(one: Any, other: Any) -> np.ndarray:
            return np.concatenate([one, other])

        def by_name(one: Mapping[str, Any], other: Mapping[str, Any]) -> dict[str, np.ndarray]:
            return {name: joined(one[name], other[name]) for name in one}

        n, shift = self.epochs, np.array([self.epochs, 0.0])
        seconds = self.seconds[-1] if n else 0.0
        return History(
            joined(self.loss, later.loss),
            by_name(self.penalties, later.penalties),
            by_name(self.modifiers, later.modifiers),
            joined(self.seconds, seconds + later.seconds),
            joined(self.full_loss, shift + later.full_loss[1:]),
            joined(self.validation_loss, shift + later.validation_loss[1:]),
            (*self.divergences, *(replace(d, epoch=n + d.epoch) for d in later.divergences)),
            by_name(self.events, {name: counts[1:] for name, counts in later.events.items()}),
            joined(self.tried, later.tried),
            joined(self.part, parts + later.part),
        )


class Evaluation(NamedTuple):
    """The losses between two updates.

    Attributes:
        epoch: updates done.
        loss: over the whole record.
        validation: loss over the held-out samples; NaN without validation.
        events: how many there are in each record, in a model with events.
    """

    epoch: int
    loss: float
    validation: float
    events: tuple[int, ...] = ()


class LogContent(NamedTuple):
    """The content of a `TrainingLog`: columns by name of some updates each, and evaluations."""

    chunks: tuple[dict[str, np.ndarray], ...]
    evaluations: tuple[Evaluation, ...]

    def columns(self) -> dict[str, np.ndarray]:
        """All of it as arrays: a column each, of all updates, and the evaluations."""
        joined = {n: np.concatenate([c[n] for c in self.chunks]) for n in self.chunks[0]}
        rows = [(*e[:3], *e.events) for e in self.evaluations]
        width = len(rows[0]) if rows else 3
        return {**joined, EVALUATIONS: np.asarray(rows, float).reshape(len(rows), width)}


EVALUATIONS = "evaluations"


class TrainingLog:
    """Collects a `History` while training runs.

    Arguments:
        places: of every row of the records, its time, and its record's name where there are several.
        penalties, modifiers: names of what updates report.
    """

    def __init__(
        self,
        places: Places,
        penalties: tuple[str, ...],
        modifiers: tuple[str, ...],
    ) -> None:
        self._places, self._penalties, self._modifiers = places, penalties, modifiers
        whole = {n: np.zeros(0, int) for n in ("diverged", "exploded", "first", "part")}
        names = ("loss", "seconds", *map(_penalty, penalties), *map(_modifier, modifiers))
        numbers = {n: np.zeros(0) for n in names}
        flags = {n: np.zeros(0, bool) for n in ("rejected", "turned_down")}
        self._chunks = [{**numbers, **whole, **flags}]
        self._loss = math.nan
        self.evaluations: list[Evaluation] = []
        self.divergences: list[Divergence] = []
        self.epochs = 0

    def add(
        self, entry: UpdateLog, count: int, started: float, ended: float, part: int = 0
    ) -> list[Divergence]:
        """Add the first ``count`` rows of a chunk's log, of a part of the strategy; returns its divergences."""
        reported = {
            "loss": entry.loss,
            "diverged": entry.diverged,
            "exploded": entry.exploded,
            "first": entry.first,
            "rejected": entry.rejected,
            "turned_down": entry.turned_down,
            **{_penalty(n): entry.penalties[n] for n in self._penalties},
            **{_modifier(n): entry.logged[n] for n in self._modifiers},
        }
        seconds = started + (ended - started) * np.arange(1, count + 1) / count
        rows = {n: np.asarray(column)[:count] for n, column in reported.items()}
        return self._append({**rows, "seconds": seconds, "part": np.full(count, part)})

    def _append(self, chunk: dict[str, np.ndarray]) -> list[Divergence]:
        diverged, exploded, first, rejected, turned_down = (
            chunk[n] for n in ("diverged", "exploded", "first", "rejected", "turned_down")
        )
        new = [
            Divergence(
                self.epochs + i,
                self._places.time(first[i]),
                int(diverged[i]),
                bool(rejected[i]),
                int(exploded[i]),
                self._places.record(first[i]),
            )
            for i in np.flatnonzero((rejected | (diverged > 0)) & ~turned_down).tolist()
        ]
        self._chunks.append(chunk)
        if len(kept := chunk["loss"][~turned_down]):
            self._loss = float(kept[-1])
        self.divergences += new
        self.epochs += len(rejected)
        return new

    def evaluated(self, loss: float, validation: float, events: tuple[int, ...] = ()) -> None:
        """Add a loss over the whole record, and over the held-out samples, and the number of events."""
        self.evaluations.append(Evaluation(self.epochs, loss, validation, events))

    @property
    def loss(self) -> float:
        """The loss of the last update that was not turned down."""
        return self._loss

    def rows(self) -> LogContent:
        """What was collected up to now."""
        return LogContent(tuple(self._chunks), tuple(self.evaluations))

    def go_on(self, columns: Mapping[str, np.ndarray]) -> None:
        """Fill this empty log with the content of another one: its ``rows().columns()``.

        Raises:
            DataError: if they are not the columns of such a log.
        """
        chunk = {n: column for n, column in columns.items() if n != EVALUATIONS}
        if EVALUATIONS not in columns or chunk.keys() != self._chunks[0].keys():
            raise DataError(f"The log of the training has other columns: {listing(columns)}.")
        self._append(chunk)
        rows = columns[EVALUATIONS].tolist()
        self.evaluations += [
            Evaluation(int(epoch), loss, validation, tuple(map(int, events)))
            for epoch, loss, validation, *events in rows
        ]

    def history(self) -> History:
        """What was collected."""
        columns = self.rows().columns()
        evaluations = columns[EVALUATIONS]
        rows = np.arange(self.epochs)
        best = np.maximum.accumulate(np.where(columns["turned_down"], 0, rows))
        return History(
            columns["loss"][best],
            {n: columns[_penalty(n)][best] for n in self._penalties},
            {n: columns[_modifier(n)][best] for n in self._modifiers},
            columns["seconds"],
            evaluations[:, :2],
            evaluations[~np.isnan(evaluations[:, 2])][:, [0, 2]],
            tuple(self.divergences),
            dict(zip(self._places.names, evaluations[:, 3:].T.astype(int), strict=False)),
            columns["loss"],
            columns["part"],
        )


def _penalty(name: str) -> str:
    return f"penalty {name}"


def _modifier(name: str) -> str:
    return f"modifier {name}"
