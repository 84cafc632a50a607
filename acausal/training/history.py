"""The record of a training: what every update told, and the losses over the whole record now and then."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import jax
import numpy as np


@dataclass(frozen=True)
class Divergence:
    """Sequences that diverged in an update and were left out, or an update that was rejected.

    Attributes:
        epoch: the update.
        time: where the first such sequence starts in the record, in seconds.
        count: how many there were; 0 where the gradient was not finite though no sequence diverged.
        rejected: whether the whole update was rejected.
    """

    epoch: int
    time: float
    count: int
    rejected: bool

    def __str__(self) -> str:
        end = "update rejected" if self.rejected else "left out"
        if self.count == 0:
            return f"epoch {self.epoch}: the gradient is not finite; {end}"
        others = f" and {self.count - 1} more" if self.count > 1 else ""
        return f"epoch {self.epoch}: the sequence from t = {self.time:g} s{others} diverged; {end}"


@dataclass(frozen=True, eq=False)
class History:
    """A training, update by update.

    Attributes:
        loss: mean loss of each update's batch, before the update, shape (epochs,).
        penalties: by regularizer, shape (epochs,).
        modifiers: by parameter, its relative change p̃/p − 1 before the update, shape (epochs,).
        seconds: time since the start of the training at the end of each update, shape (epochs,).
        full_loss: loss over the whole record, (epochs done, loss) in rows, shape (k, 2).
        divergences: what diverged and was left out.
    """

    loss: np.ndarray
    penalties: dict[str, np.ndarray]
    modifiers: dict[str, np.ndarray]
    seconds: np.ndarray
    full_loss: np.ndarray
    divergences: tuple[Divergence, ...]

    @property
    def epochs(self) -> int:
        """Updates done."""
        return len(self.loss)


class Log:
    """Collects a `History` while training runs."""

    def __init__(
        self, times: np.ndarray, penalties: tuple[str, ...], modifiers: tuple[str, ...]
    ) -> None:
        self._times, self._penalties, self._modifiers = times, penalties, modifiers
        self._entries: list[Any] = []
        self._seconds: list[np.ndarray] = []
        self._full: list[tuple[int, float]] = []
        self.divergences: list[Divergence] = []
        self.epochs = 0

    def add(self, entry: Any, count: int, started: float, ended: float) -> list[Divergence]:
        """Add the first ``count`` rows of a chunk's log; returns its divergences."""
        rows = _rows(entry, count)
        new = [
            Divergence(
                self.epochs + i,
                float(self._times[rows.first[i]]),
                int(rows.diverged[i]),
                bool(rows.rejected[i]),
            )
            for i in np.flatnonzero(rows.rejected | (rows.diverged > 0)).tolist()
        ]
        self._entries.append(rows)
        self._seconds.append(started + (ended - started) * np.arange(1, count + 1) / count)
        self.divergences += new
        self.epochs += count
        return new

    def evaluated(self, loss: float) -> None:
        """Add a loss over the whole record."""
        self._full.append((self.epochs, loss))

    @property
    def loss(self) -> float:
        """The loss of the last update."""
        return float(self._entries[-1].loss[-1]) if self._entries else float("nan")

    def history(self) -> History:
        """What was collected."""
        entries = self._entries

        def join(names: tuple[str, ...], read: Callable[[Any], Mapping[str, np.ndarray]]) -> Any:
            none = np.zeros(0)
            return {n: np.concatenate([none, *(read(e)[n] for e in entries)]) for n in names}

        return History(
            np.concatenate([e.loss for e in entries]) if entries else np.zeros(0),
            join(self._penalties, lambda e: e.penalties),
            join(self._modifiers, lambda e: e.logged),
            np.concatenate(self._seconds) if entries else np.zeros(0),
            np.asarray(self._full).reshape(-1, 2),
            tuple(self.divergences),
        )


def _rows(entry: Any, count: int) -> Any:
    return jax.tree.map(lambda a: np.asarray(a)[:count], entry)
