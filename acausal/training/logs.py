"""Logs: observers that write the reports of a training, for Python's log and for other programs.

A log that is continued after a break replaces the entries of updates that are repeated.
"""

from __future__ import annotations

import csv
import io
import logging
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from acausal.errors import DataError, TrainingError, need_package, reason, warn
from acausal.files import need_path, replace_file
from acausal.training.progress import Progress

LOGGER = logging.getLogger(__name__)

SCALARS: dict[str, Callable[[Progress], float]] = {
    "loss": lambda p: p.loss,
    "best": lambda p: p.best,
    "seconds": lambda p: p.seconds,
    "seconds_per_epoch": lambda p: p.seconds_per_epoch,
    "diverged": lambda p: len(p.divergences),
}
"""The columns: the last update's loss, the lowest loss over the whole record, the time since the start and per update,
and the number of updates since the last report in which something diverged."""


def log_progress(progress: Progress) -> None:
    """An observer that writes what is reported into the log."""
    for divergence in progress.divergences:
        LOGGER.info("%s", divergence)
    LOGGER.debug(
        "epoch %d of %d: loss %.4g, best %.4g, %.3g s",
        progress.epoch,
        progress.epochs,
        progress.loss,
        progress.best,
        progress.seconds,
    )


class CsvLog:
    """An observer that writes a line of a CSV file at every report: ``epoch`` and `SCALARS`.

    A new training replaces the file, a resumed one continues it. If a line cannot be written, or something else writes
    the file meanwhile, this warns once, and the training continues.

    Arguments:
        path: the file; folders are created.

    Raises:
        DataError: if the file exists and is not such a log.
        TrainingError: if the file cannot be written.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = need_path(path, "CsvLog")
        self._size: int | None = None
        self._warned = False
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            before = _lines(self.path)
            with self.path.open("a"):
                pass
        except OSError as error:
            raise TrainingError(f"Log '{self.path}' cannot be written: {reason(error)}.") from error
        if before and before[0] != ["epoch", *SCALARS]:
            raise DataError(f"'{self.path}' is not the log of a training: name another file.")

    def __call__(self, progress: Progress) -> None:
        """Write a line."""
        values = [repr(float(read(progress))) for read in SCALARS.values()]
        try:
            self._begin(progress.epoch)
            if not self.path.exists() or self.path.stat().st_size != self._size:
                self._warn("was changed by something else", progress, ": lines are lost or mixed.")
            with self.path.open("a", newline="") as file:
                file.write(_text([[str(progress.epoch), *values]]))
            self._size = self.path.stat().st_size
        except OSError as error:
            self._warn("cannot be written", progress, f": {reason(error)}. The training goes on.")

    def _warn(self, what: str, progress: Progress, more: str) -> None:
        if not self._warned:
            self._warned = True
            text = f"Log '{self.path}' {what} at epoch {progress.epoch}{more}"
            warn(text)

    def _begin(self, epoch: int) -> None:
        """Keep only the lines of earlier updates, before the first line is written."""
        if self._size is not None:
            return
        whole = [row for row in _lines(self.path)[1:] if len(row) == 1 + len(SCALARS)]
        kept = [row for row in whole if int(row[0]) < epoch]
        replace_file(self.path, _text([["epoch", *SCALARS], *kept]).encode())
        self._size = self.path.stat().st_size


class TensorBoardLog:
    """An observer that writes `SCALARS` for TensorBoard at every report, over the epoch.

    Arguments:
        folder: the folder for ``tensorboard --logdir``; it is created.

    Raises:
        TrainingError: if tensorboardX is not installed (``pip install 'acausal[tensorboard]'``).
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        board = need_package("tensorboardX", "TensorBoardLog", "tensorboard", TrainingError)
        self.folder = need_path(folder, "TensorBoardLog")
        self._open: Callable[[int], Any] = lambda epoch: board.SummaryWriter(
            str(self.folder), purge_step=epoch
        )
        self._writer: Any = None

    def __call__(self, progress: Progress) -> None:
        """Write the scalars."""
        if self._writer is None:
            self._writer = self._open(progress.epoch)
        for name, read in SCALARS.items():
            self._writer.add_scalar(name, float(read(progress)), progress.epoch)
        self._writer.flush()

    def close(self) -> None:
        """Close the file; otherwise Python does so at its end."""
        if self._writer is not None:
            self._writer.close()
            self._writer = None


def _lines(path: Path) -> list[list[str]]:
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8", errors="replace") as file:
        return list(csv.reader(file))


def _text(rows: list[list[str]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()
