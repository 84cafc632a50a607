"""What has happened in the records of a model with events: how many events, and those that gradients do not pass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int

from acausal.simulation import Log
from acausal.training.objective.records import Records

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True)
class EventChange:
    """A record in which another number of events happens than before.

    Attributes:
        epoch: updates done. since: when it was counted before.
        events: how many there are now. before: how many there were.
        record: the record's name.
    """

    epoch: int
    since: int
    events: int
    before: int
    record: str

    def __str__(self) -> str:
        between = f"epochs {self.since} to {self.epoch}"
        return f"{between}: '{self.record}' has {self.events} events instead of {self.before}"


def events_in(records: Records, log: Log | None) -> tuple[int, ...]:
    """How many conditions have changed in each record, as far as the log goes; nothing for a model without events."""
    if log is None:
        return ()
    happened = _Happened.of(records, log)
    counted = happened.record[happened.which >= 0]
    return tuple(np.bincount(counted, minlength=records.count).tolist())


def grazing(system: System, records: Records, log: Log | None) -> str | None:
    """A clause on the first event whose condition hardly changes at its instant, or None."""
    if log is None or system.events is None:
        return None
    happened = _Happened.of(records, log)
    for i in np.flatnonzero(happened.grazes)[:1].tolist():
        where = f" of '{records.names[happened.record[i]]}'" if records.count > 1 else ""
        condition = system.events.describe(int(happened.which[i]))
        return f"'{condition}' hardly changes at t = {happened.t[i]:.6g} s{where}"
    return None


class _Happened(NamedTuple):
    """Events within records: in which, at which of its times, of which condition, and whether that grazes."""

    record: Int[np.ndarray, " n"]
    t: Float[np.ndarray, " n"]
    which: Int[np.ndarray, " n"]
    grazes: Bool[np.ndarray, " n"]

    @classmethod
    def of(cls, records: Records, log: Log) -> _Happened:
        """The events of a log, whose clock goes on from row to row; not those behind the last sample of a record."""
        n = min(int(log.total), len(log.t))
        clock, which, grazes = (np.asarray(a)[:n] for a in (log.t, log.which, log.grazes))
        steps = records.steps
        lengths = np.broadcast_to(np.asarray(steps.h), len(records))
        starts = np.cumsum(lengths) - lengths
        first, last = starts[np.asarray(records.first)], starts[np.asarray(records.last)]
        record = np.clip(np.searchsorted(first, clock, side="right") - 1, 0, None)
        t = clock - first[record] + np.asarray(steps.t)[np.asarray(records.first)[record]]
        inside = clock <= last[record]
        return cls(*(a[inside] for a in (record, t, which, grazes)))
