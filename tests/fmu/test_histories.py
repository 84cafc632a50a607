"""What FMUs have gone through: kept as long as it may be needed, in bounded memory."""

from __future__ import annotations

from collections import OrderedDict

import pytest

import acausal as ac
from acausal.fmu import histories
from acausal.fmu.histories import AfterEvent, Histories, PastEvent


class Nothing:
    """An instance that does nothing."""

    due = float("inf")

    def keep(self, key: object) -> bool:
        """It keeps no states."""
        return False

    def free(self) -> None:
        """Give it back."""


def test_the_oldest_events_are_forgotten_and_said_to_be(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(histories, "REMEMBERED", 10)
    after = AfterEvent(0, float("inf"), b"", 0)
    kept = Histories(4, lambda parameters, old: Nothing(), lambda instance, event: after)  # pyright: ignore[reportArgumentType]
    numbers = [0]
    for k in range(25):
        event = PastEvent(numbers[-1], float(k), b"", b"", b"", timed=True)
        numbers.append(kept.after(b"", event).history)
    assert numbers == list(range(26))  # no number comes twice
    assert kept.event(25).time == 24.0
    assert isinstance(kept.instance(b"", 25), Nothing)
    for forgotten in (lambda: kept.event(15), lambda: kept.instance(b"other", 25)):
        with pytest.raises(ac.SimulationError, match="more than 10 events of an FMU since"):
            forgotten()


def test_instances_are_freed_whatever_an_fmu_does_meanwhile() -> None:
    freed: list[int] = []
    instances = OrderedDict[int, object]()

    class Last(Nothing):
        def free(self) -> None:
            freed.append(len(instances))
            instances[9] = self  # as another thread may do

    instances.update({0: Last(), 1: Last()})
    histories._free_all(instances)  # pyright: ignore[reportPrivateUsage, reportArgumentType]
    assert len(freed) == 2
    assert not instances
