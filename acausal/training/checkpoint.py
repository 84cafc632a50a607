"""Checkpoints: a training in a file, from which it continues as if it had never stopped."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Generator, Mapping
from contextlib import closing, contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np

from acausal.data import filled_like, named_arrays, read_arrays, write_arrays
from acausal.errors import DataError, TrainingError, listing, reason, warn
from acausal.files import Lock
from acausal.training.history import LogContent
from acausal.training.member import Best
from acausal.training.optimizers.trainer import State

LOGGER = logging.getLogger(__name__)

KIND = "checkpoint of a training, version 3"

LOG = "log {}: "
"""Prefix of the names of a training log's columns in a file."""


class Snapshot(NamedTuple):
    """Everything that a training needs to continue after an update.

    Attributes:
        segment: of the strategy, by number; ``before``: updates done in the segments before it.
        state: of the segment's trainer.
        bests: of each training.
        evaluated: updates that were done at the last evaluation.
        seconds, compiling, updating: what the training took up to now.
    """

    segment: int
    before: int
    state: State
    bests: tuple[Best, ...]
    evaluated: int
    seconds: float
    compiling: float
    updating: float


Logs = tuple[LogContent, ...]
"""The log of each training."""

Keep = Callable[[Snapshot, Logs], None]
"""Called with a snapshot and the logs between updates."""


class Stored(NamedTuple):
    """A checkpoint that was read.

    Attributes:
        path: where from.
        segment: the segment in which it was written.
        columns: of each training's log.
        arrays: of the snapshot, by name.
    """

    path: Path
    segment: int
    columns: tuple[dict[str, np.ndarray], ...]
    arrays: dict[str, np.ndarray]

    def snapshot(self, like: Snapshot) -> Snapshot:
        """The snapshot; ``like`` is one of the same training in the same segment.

        Raises:
            DataError: if that has other parts.
        """
        return filled_like(like, self.arrays, f"Checkpoint '{self.path}'")


def place(path: str | Path) -> Path:
    """The file of a checkpoint; if a folder is given, a file in it. Folders are created."""
    path = Path(path)
    file = path if path.suffix == ".safetensors" else path / "checkpoint.safetensors"
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise TrainingError(
            f"The folder of checkpoint '{file}' cannot be created: {reason(error)}."
        ) from error
    return file


def read(path: Path, fingerprint: Mapping[str, str]) -> Stored:
    """Read a checkpoint of the training with a fingerprint.

    Raises:
        DataError: if it cannot be read, is damaged, or belongs to another training.
    """
    arrays, about = read_arrays(path)
    if about.get("kind") != KIND:
        raise DataError(
            f"'{path}' is not a {KIND}, but: {about.get('kind', 'it does not say what')}."
        )
    theirs = about["fingerprint"]
    names = [*fingerprint, *(n for n in theirs if n not in fingerprint)]
    differ = [n for n in names if fingerprint.get(n) != theirs.get(n)]
    if differ:
        raise DataError(
            f"Checkpoint '{path}' is of another training: {listing(differ)} differ. "
            "Resume with the arguments it was started with, or name another file."
        )
    prefixes = [LOG.format(k) for k in range(int(about["members"]))]
    columns = tuple(
        {n.removeprefix(prefix): a for n, a in arrays.items() if n.startswith(prefix)}
        for prefix in prefixes
    )
    snapshot = {n: a for n, a in arrays.items() if not n.startswith(tuple(prefixes))}
    return Stored(path, int(about["segment"]), columns, snapshot)


@contextmanager
def keeping(path: Path | None, every: float, fingerprint: Mapping[str, str]) -> Generator[Keep]:
    """Write checkpoints: at once, then at intervals of ``every`` seconds, and at the end, also after an error.

    Raises:
        TrainingError: if another process writes checkpoints there, or the first one cannot be written. If a later one
            cannot, this warns and continues.
    """
    if path is None:
        yield lambda snapshot, logs: None
        return
    with closing(Lock(path)) as lock:
        try:
            lock.hold()
        except OSError as error:
            raise _nothing_trained(path, error) from error
        keeper = _Keeper(path, every, fingerprint, lock)
        try:
            yield keeper.keep
        finally:
            keeper.close()


class _Keeper:
    """Writes the latest snapshot now and then."""

    def __init__(
        self, path: Path, every: float, fingerprint: Mapping[str, str], lock: Lock
    ) -> None:
        self.path, self.every, self.fingerprint, self.lock = path, every, dict(fingerprint), lock
        self.latest: tuple[Snapshot, Logs] | None = None
        self.written: tuple[Snapshot, Logs] | None = None
        self.there: tuple[int, int] | None = None
        self.tried = -np.inf
        self.warned = False

    def keep(self, snapshot: Snapshot, logs: Logs) -> None:
        """Take a snapshot, and write it if it is time."""
        self.latest = (snapshot, logs)
        if self.written is None:
            if error := self._try():
                self.latest = None
                raise _nothing_trained(self.path, error) from error
        elif time.monotonic() - self.tried >= self.every:
            error = self._try()
            if error and not self.warned:
                self.warned = True
                warn(f"{self._cannot_be_written(error)} The training goes on.")

    def close(self) -> None:
        """Write the latest snapshot if that was not done yet."""
        if self.written is None or self.latest is self.written:
            return
        error = self._try()
        if error:
            warn(
                f"{self._cannot_be_written(error)} The training has ended: save its result elsewhere, "
                "ac.save_params(fit.params, ...)."
            )

    def _try(self) -> OSError | None:
        assert self.latest is not None
        snapshot, logs = self.latest
        log = {
            LOG.format(k) + n: a for k, rows in enumerate(logs) for n, a in rows.columns().items()
        }
        about = {
            "kind": KIND, "segment": snapshot.segment, "members": len(logs), "fingerprint": self.fingerprint
        }  # fmt: skip
        try:
            self.lock.hold()
            write_arrays(self.path, {**named_arrays(snapshot), **log}, about)
        except OSError as error:
            return error
        finally:
            self.tried = time.monotonic()
        self.written, self.there = self.latest, _identity(self.path)
        LOGGER.debug("wrote checkpoint %s at epoch %d", self.path, _epochs(logs[0]))
        return None

    def _cannot_be_written(self, error: OSError) -> str:
        assert self.latest is not None
        assert self.written is not None
        now, before = (_epochs(logs[0]) for _, logs in (self.latest, self.written))
        still = "still" if self.there == _identity(self.path) else "no longer"
        return (
            f"Checkpoint '{self.path}' cannot be written at epoch {now}: {reason(error)}; "
            f"that of epoch {before} is {still} there."
        )


def _nothing_trained(path: Path, error: OSError) -> TrainingError:
    return TrainingError(
        f"Checkpoint '{path}' cannot be written: {reason(error)}. Nothing was trained."
    )


def _identity(path: Path) -> tuple[int, int] | None:
    """What distinguishes a file from later ones of the same name; None if there is none."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_ino, found.st_mtime_ns


def _epochs(rows: LogContent) -> int:
    return sum(len(chunk["loss"]) for chunk in rows.chunks)
