"""The instances of one FMU in a model, found by their parameters and by their *history*: what they have gone through.

What an FMU remembers follows from these two. The model keeps the history's number as a discrete variable; where there
is no instance with that history, a new one goes through the same events.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple
from weakref import finalize

from acausal.fmu.instance import Instance
from acausal.fmu.library import FMUError

KEPT = 128
"""Instances of an FMU, for different parameters and histories, that are kept; the least used one goes."""

STATES = 4096
"""States of instances that are kept, so that these can go back."""

REMEMBERED = 262_144
"""Events of an FMU that are kept, and what is behind them; the oldest goes, and its number with it."""


class PastEvent(NamedTuple):
    """An event that an FMU has gone through.

    Attributes:
        before: the history before it. time, states, inputs: what held. signs: which indicators were positive.
        timed: whether its time was known: a time event, or the end of a communication step.
    """

    before: int
    time: float
    states: bytes
    inputs: bytes
    signs: bytes
    timed: bool


START = PastEvent(-1, -float("inf"), b"", b"", b"", False)
"""What stands before the first event."""


class AfterEvent(NamedTuple):
    """What is behind an event: number of the history, next events, numbers; and how often it was shifted.

    Attributes:
        numbers: the states, or the outputs of a communication step. signs: which indicators are positive then.
    """

    history: int
    next: tuple[float, ...]
    numbers: bytes
    shifts: int
    signs: bytes = b""


class Histories:
    """The instances of an FMU, and the events that they have gone through; history 0 has none.

    Arguments:
        most: so many instances are kept.
        begin: a new instance with these parameters; it may be made of one that is no longer needed.
        go: leads an instance through an event.
    """

    def __init__(
        self,
        most: int,
        begin: Callable[[bytes, Instance | None], Instance],
        go: Callable[[Instance, PastEvent], AfterEvent],
    ) -> None:
        self._most, self._begin, self._go = most, begin, go
        self._instances: OrderedDict[tuple[bytes, int], Instance] = OrderedDict()
        self._events: OrderedDict[int, PastEvent] = OrderedDict()
        self._numbers: dict[PastEvent, int] = {}
        self._count = 0
        self._afters: OrderedDict[tuple[bytes, PastEvent], AfterEvent] = OrderedDict()
        self._kept: OrderedDict[tuple[bytes, int], Instance] = OrderedDict()
        finalize(self, _free_all, self._instances)

    def instance(self, parameters: bytes, history: int) -> Instance:
        """The instance with these parameters that has gone through a history."""
        key = parameters, history
        found = self._instances.get(key)
        if found is None:
            found = self._again(parameters, history)
            self._instances[key] = found
        elif len(self._instances) > 1:
            self._instances.move_to_end(key)
        return found

    def event(self, history: int) -> PastEvent:
        """The last event of a history.

        Raises:
            FMUError: for one that was forgotten.
        """
        if history == 0:
            return START
        if history not in self._events:
            raise FMUError(
                f"FMU: a simulation has gone through more than {REMEMBERED:,} events of an FMU since, and what came "
                "before is forgotten; simulate again, over a shorter time."
            )
        return self._events[history]

    def number(self, event: PastEvent) -> int:
        """The number of the history that ends with an event."""
        if event not in self._numbers:
            self._count += 1
            self._numbers[event], self._events[self._count] = self._count, event
            if len(self._events) > REMEMBERED:
                del self._numbers[self._events.popitem(last=False)[1]]
        return self._numbers[event]

    def _again(self, parameters: bytes, history: int) -> Instance:
        """An instance that goes through a history, from where one has come already, or can go back to, if possible."""
        chain: list[PastEvent] = []
        instance = self._back(parameters, history)
        while instance is None and history > 0 and (parameters, history) not in self._instances:
            chain.append(self.event(history))
            history = chain[-1].before
            instance = self._back(parameters, history)
        if instance is None and chain:
            instance = self._instances.pop((parameters, history), None)
        if instance is None:
            again = len(self._instances) >= self._most
            instance = self._begin(
                parameters, self._instances.popitem(last=False)[1] if again else None
            )
            self._keep_state(parameters, 0, instance)
        return self._through(parameters, instance, reversed(chain))[0]

    def _back(self, parameters: bytes, history: int) -> Instance | None:
        """An instance that has gone back to a history, if one can."""
        instance = self._kept.get((parameters, history))
        place = next((k for k, i in self._instances.items() if i is instance), None)
        if instance is None or place is None or not instance.go_back((parameters, history)):
            return None
        return self._instances.pop(place)

    def _keep_state(self, parameters: bytes, history: int, instance: Instance) -> None:
        key = parameters, history
        if instance.keep(key):
            self._kept[key] = instance
            if len(self._kept) > STATES:
                old, last = self._kept.popitem(last=False)
                last.forget(old)

    def _through(
        self, parameters: bytes, instance: Instance, events: Iterable[PastEvent]
    ) -> tuple[Instance, int]:
        """The instance behind some events, and the number of its history; what is behind each of them is kept."""
        history = 0
        try:
            for event in events:
                after = self._go(instance, event)
                instance.next, instance.signs = after.next, after.signs
                history = self.number(event)
                self._keep((parameters, event), after._replace(history=history))
                self._keep_state(parameters, history, instance)
        except BaseException:
            instance.free()
            raise
        return instance, history

    def after(self, parameters: bytes, event: PastEvent) -> AfterEvent:
        """What is behind an event. The instance before it goes through it."""
        key = parameters, event
        if (known := self._afters.get(key)) is not None:
            return known
        last = self.event(event.before)
        instance = self.instance(parameters, event.before)
        same = (last.time, last.inputs) == (event.time, event.inputs)
        if same and event.signs in (last.signs, instance.signs):  # it has gone through this event
            return self._keep(key, AfterEvent(event.before, instance.next, event.states, 0))
        del self._instances[parameters, event.before]
        _, history = self._through(parameters, instance, [event])
        if (old := self._instances.pop((parameters, history), None)) is not None:
            old.free()
        self._instances[parameters, history] = instance
        return self._afters[key]

    def _keep(self, key: tuple[bytes, PastEvent], after: AfterEvent) -> AfterEvent:
        self._afters[key] = after
        if len(self._afters) > REMEMBERED:
            self._afters.popitem(last=False)
        return after


def _free_all(instances: OrderedDict[Any, Instance]) -> None:
    for instance in list(instances.values()):
        instance.free()
    instances.clear()
