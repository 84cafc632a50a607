"""An FMU for co-simulation in a model: it goes from one communication point to the next by itself.

Its inputs are set at these points and held; its outputs are read there. A step, and the setting of inputs behind it,
are events of its history, so that a step that is tried again, or another simulation, finds an instance of its own.
"""

from __future__ import annotations

import ctypes as C
from collections import OrderedDict
from collections.abc import Sequence
from typing import Any

import numpy as np

from acausal._jax import HostError
from acausal.fmu.computed import Computed
from acausal.fmu.derivatives import STEP, Differentiated, Numbers
from acausal.fmu.description import REAL
from acausal.fmu.event_mode import EventMode, rounding
from acausal.fmu.histories import REMEMBERED, AfterEvent, PastEvent
from acausal.fmu.instance import Instance
from acausal.fmu.library import BYTES, DISCARD, FATAL, FMUError
from acausal.fmu.part import Part

EXPLODED = 1e30
"""An output of this size, in units of its nominal value, is no result."""

RETURNS = 10_000
"""So many early returns within one step are endless."""

LAST_SUCCESSFUL_TIME, TERMINATED = 2, 3
"""What FMI 2.0 calls these when a step has failed."""


class Slave(EventMode):
    """An instance at a communication point.

    Attributes:
        values: its parameters. time: where it is. steps: how many it has gone. started: whether it is initialized.
        given: the inputs that hold.
    """

    between = "EnterStepMode"
    own = (*EventMode.own, "time", "steps", "started")
    values = given = b""
    time = 0.0
    steps = 0
    started = False

    def free(self) -> None:
        """End its simulation, and give it back."""
        if self.address and self.started:
            self.library.function("Terminate", C.c_void_p)(self.address)
        super().free()
        self.started = False

    def start(self, time: float, parameters: bytes, inputs: bytes) -> None:
        """Begin a simulation; without inputs the FMU's own hold at the start."""
        held, given = (np.frombuffer(b).copy() for b in (parameters, inputs))
        place = given.ctypes.data if inputs else 0
        self.initialize(time, held.ctypes.data, place, again=False)
        self.time, self.started, self.given = time, True, inputs
        if self.library.event_mode:
            self.next = self.iterate(time, place, ticks=bool(inputs)).next

    def take(self, inputs: bytes) -> None:
        """Set the inputs that hold from now on: at an event, where the FMU has some."""
        self.given = inputs
        self._happen(self._writes)

    def _happen(self, writes: Sequence[Any] = (), *, ticks: bool = True) -> None:
        """An event, at which inputs may be set."""
        has_events, given = self.library.event_mode, np.frombuffer(self.given).copy()
        place = given.ctypes.data if self.given else 0
        if has_events:
            self.call("EnterEventMode")
        self._write(writes, place, "an input")
        if has_events:
            self.next = self.iterate(self.time, place, ticks=ticks).next

    def advance(self, end: float) -> None:
        """Go to the next communication point. Clocks that tick there do so with the inputs that are taken there.

        Raises:
            FMUError: where the FMU does not get there.
        """
        step = self._step_2 if self.library.is_2 else self._step_3
        before = end - rounding(end)
        for _ in range(RETURNS):
            self.check_time(end)
            target = self.due if self.time < self.due < before else end
            self.time, event = step(self.time, target - self.time)
            if not self.time < target - 1e-9 * abs(target):
                self.time = target
            if event or self.time >= self.due - rounding(self.due):
                self._happen(ticks=self.time < end)
            if self.time == end:
                self.steps += 1
                return
        raise self._failure(end, "returns early for ever")

    def _failure(self, time: float, what: str) -> FMUError:
        said = self.library.said()
        return FMUError(
            f"FMU: '{self.library.description.model}' {what} at {time:g} s{said}; try a smaller step=."
        )

    def _step_2(self, time: float, size: float) -> tuple[float, bool]:
        step = self.library.function("DoStep", C.c_void_p, C.c_double, C.c_double, C.c_int)
        status = step(self.address, time, size, 1)
        if status == DISCARD:
            ended, last = C.c_int(), C.c_double(time)
            kinds = (C.c_void_p, C.c_int, C.c_void_p)
            ask = self.library.function
            ask("GetBooleanStatus", *kinds)(self.address, TERMINATED, C.addressof(ended))
            ask("GetRealStatus", *kinds)(self.address, LAST_SUCCESSFUL_TIME, C.addressof(last))
            if ended.value:
                self.last = last.value
            elif not last.value > time:
                raise self._failure(time, "refuses the step")
            return last.value, False
        if status > FATAL:
            raise self._failure(time, "computes a step in the background, which is not supported,")
        self.check(status, f"the step at {time:g} s")
        return time + size, False

    def _step_3(self, time: float, size: float) -> tuple[float, bool]:
        flags, last = [C.c_bool() for _ in range(3)], C.c_double(time + size)
        kinds = (C.c_void_p, C.c_double, C.c_double, C.c_bool, *[C.c_void_p] * 4)
        step = self.library.function("DoStep", *kinds)
        status = step(
            self.address, time, size, True, *map(C.addressof, flags), C.addressof(last)
        )  # fmt: skip
        event, ended, early = (flag.value for flag in flags)
        if ended:
            self.last = last.value
            return last.value, False
        if status == DISCARD:
            raise self._failure(time, "refuses the step")
        self.check(status, f"the step at {time:g} s")
        return last.value if early else time + size, event


class Stepped(Computed):
    """The functions of co-simulation: ``step`` to a communication point, and ``take`` the inputs that hold from there.

    Attributes:
        step, take: numbers of the functions; `step` has derivatives with respect to parameters behind it.
    """

    make = Slave

    def __init__(self, part: Part) -> None:
        super().__init__(part)
        known = self.description.variables
        nominal = [[known[n].nominal] * known[n].size for n in part.results]
        self._sizes = np.asarray([s for sizes in nominal for s in sizes])
        self._moves: OrderedDict[tuple[int, int, int], tuple[int, float]] = OrderedDict()
        self._changeable = [
            known[n].type in REAL for n in part.inputs for _ in range(known[n].size)
        ]
        first = 2 + part.n_inputs
        width = first + part.n_parameters
        scales = np.append(self._scales, np.tile(self._scales[2:first], part.memory))
        behind = range(first, width) if any(part.behind) else ()
        self._offer(
            step=Differentiated(
                self._step, len(scales), 1 + part.n_values, range(first, len(scales)), scales, self._lock,
                fast=self._by_inputs,
            ),
            take=Differentiated(
                self._take, width, 1 + bool(behind) * part.n_values, behind, self._scales, self._lock
            ),
        )  # fmt: skip

    def _first(self, parameters: bytes, old: Instance | None) -> Slave:
        """A new instance: FMUs that are reset have been seen to keep what they knew."""
        if old is not None:
            old.free()
        made = self._new()
        assert isinstance(made, Slave)
        made.values = parameters
        return made

    def _go(self, instance: Instance, event: PastEvent) -> AfterEvent:
        """A communication step, or new inputs; those of the start are initial values, too."""
        assert isinstance(instance, Slave)
        if not event.timed:
            if instance.steps or not event.inputs:
                instance.take(event.inputs)
            else:
                instance.free()
                instance.make()
                instance.start(event.time, instance.values, event.inputs)
            return AfterEvent(0, instance.next, b"", 0)
        if instance.started:
            instance.advance(event.time)
        else:
            instance.start(event.time, instance.values, b"")
        outputs = self._outputs(instance, event.time)
        return AfterEvent(0, instance.next, outputs.tobytes(), 0)

    def _outputs(self, instance: Slave, time: float) -> Any:
        found = np.zeros(self._results.size)
        instance.read_results(found.ctypes.data)
        bad = ~(np.abs(found) < EXPLODED * self._sizes)
        if bad.any():
            name = self.part.elements(self.part.results)[int(np.argmax(bad))]
            other = " or kind='me', which has our steps" if self.description.exchange else ""
            raise FMUError(
                f"FMU: the co-simulation of '{self.description.model}' explodes: '{name}' is "
                f"{found[bad][0]:g} at {time:g} s; use a smaller step= than {self.part.step:g} s{other}."
            )
        return found

    # -- functions ---------------------------------------------------------------------------------

    def _step(self, at: int, into: int) -> int:
        """The number of the history behind the step, and the outputs."""
        with self._lock:
            before, event = self._history(at), self._step_at(at)
            after = self._histories.after(self._values_of_parameters(at), event)
            history = after.history if event.before == before else before
            outputs = after.numbers
            C.c_double.from_address(into).value = history
            C.memmove(into + BYTES, outputs, len(outputs))
        return 0

    def _step_at(self, at: int) -> PastEvent:
        """The step to the time of some arguments; if that is the last communication point, the one that led there."""
        before, time = self._history(at), C.c_double.from_address(at).value
        known = self._histories.event
        if known(before).time != time:
            return PastEvent(before, time, b"", b"", b"", timed=True)
        event = known(before)
        while not event.timed:
            event = known(event.before)
        return event

    def _by_inputs(self, given: Numbers, wanted: list[int], matrix: Numbers) -> dict[int, int]:
        """Outputs by earlier inputs: those of instances that have gone through inputs a little larger."""
        part, rows = self.part, len(matrix)
        first = 2 + part.n_inputs + part.n_parameters
        columns = [c for c in wanted if c >= first]
        if not columns:
            return {}
        at = given.ctypes.data
        event, parameters = self._step_at(at), self._values_of_parameters(at)
        self._need_memory(event.before)
        outputs = np.frombuffer(self._histories.after(parameters, event).numbers)
        for column in columns:
            age, place = divmod(column - first, part.n_inputs)
            moved, change = self._moved(event.before, age, place)
            if change:
                there = self._histories.after(parameters, event._replace(before=moved)).numbers
                matrix[1:, column] = (np.frombuffer(there) - outputs) / change
        return dict.fromkeys(columns, rows)

    def _need_memory(self, history: int) -> None:
        """Refuse a history of more steps than the model remembers the inputs of."""
        steps, first = 0, history
        while first > 0:
            event = self._histories.event(first)
            steps, first = steps + event.timed, event.before
        if steps > self.part.memory:
            raise HostError(
                f"FMU: a gradient goes through the inputs of '{self.description.model}' over {steps} communication "
                f"steps, and memory= is {self.part.memory}; give that of the whole simulation."
            )

    def _moved(self, history: int, age: int, place: int) -> tuple[int, float]:
        """The history with one input a little larger, ``age`` communication points before its last; and by how much."""
        known, moves, later = self._histories, self._moves, list[tuple[Any, PastEvent, PastEvent]]()
        while (key := (history, age, place)) not in moves:
            take = known.event(history)
            if age == 0 or history == 0:
                moves[key] = self._larger(history, take, place)
                break
            step = known.event(take.before)
            while not step.timed:  # inputs that were replaced at once
                step = known.event(step.before)
            later.append((key, take, step))
            history, age = step.before, age - 1
        moved, change = moves[key]
        for key, take, step in reversed(later):
            if change:
                moved = known.number(
                    take._replace(before=known.number(step._replace(before=moved)))
                )
            moves[key] = moved, change
        while len(moves) > REMEMBERED:
            moves.popitem(last=False)
        return moved, change

    def _larger(self, history: int, take: PastEvent, place: int) -> tuple[int, float]:
        if history == 0 or not self._changeable[place]:
            return history, 0.0
        inputs = np.frombuffer(take.inputs).copy()
        before = inputs[place]
        inputs[place] += STEP * max(self._scales[2 + place], abs(before))
        moved = self._histories.number(take._replace(inputs=inputs.tobytes()))
        return moved, float(inputs[place] - before)

    def _take(self, at: int, into: int) -> int:
        """The number of the history behind new inputs; and the outputs there, if clocks tick."""
        with self._lock:
            before, time = self._history(at), C.c_double.from_address(at).value
            event = PastEvent(before, time, b"", self._values_of_inputs(at), b"", timed=False)
            after = self._histories.after(self._values_of_parameters(at), event)
            C.c_double.from_address(into).value = after.history
            if any(self.part.behind):
                instance = self._histories.instance(self._values_of_parameters(at), after.history)
                assert isinstance(instance, Slave)
                outputs = self._outputs(instance, time).tobytes()
                C.memmove(into + BYTES, outputs, len(outputs))
        return 0
