"""An FMU for model exchange in a model: its rates, outputs and indicators, and what it does at events."""

from __future__ import annotations

import ctypes as C
import math
from collections import OrderedDict
from typing import Any

import numpy as np

from acausal.fmu.computed import Computed
from acausal.fmu.derivatives import Differentiated, Numbers
from acausal.fmu.description import REAL
from acausal.fmu.exchange import Exchange
from acausal.fmu.histories import REMEMBERED, AfterEvent, PastEvent
from acausal.fmu.instance import Instance
from acausal.fmu.library import BYTES, DiscardError, FMUError
from acausal.fmu.part import Part

NEVER = 1e30
"""The time of an event that never comes [s]."""

NUDGES = 40
"""So often an event is shifted, twice as far each time, until the FMU sees the conditions change that have changed."""

NUDGE = 1e-14
"""The first shift, relative to the time, at least of 1 s."""


class Evaluated(Computed):
    """The functions of model exchange. `event` takes what the indicators' signs are, and whether a time event is due.

    Attributes:
        first_event, first_states: the first time event and the states at the start, with the FMU's own parameters.
        evaluate, event, begin: numbers of the functions; the next two are those of its first and second derivatives.
    """

    make = Exchange

    def __init__(self, part: Part) -> None:
        super().__init__(part)
        self._firsts: OrderedDict[bytes, tuple[float, bytes]] = OrderedDict()
        self._given = C.c_double * (self._behind // BYTES)
        n, indicators = part.n, self.description.indicators
        width = 2 + n + part.n_inputs + part.n_parameters
        common: dict[str, Any] = {
            "columns": (0, *range(2, width)),
            "scales": self._scales,
            "lock": self._lock,
        }
        self._offer(
            evaluate=Differentiated(
                self._evaluate, width, part.n_values, **common, fast=self._fast_columns, central=indicators > 0
            ),
            event=Differentiated(self._event, width + indicators + 1, 2 + n, **common),
            begin=Differentiated(self._begin, width, 1 + n, **common),
        )  # fmt: skip
        self.first_event, self.first_states = NEVER, [0.0] * n
        try:
            self._at(self.defaults(), 0)
        except (FMUError, DiscardError):  # these cannot be found with these parameters
            return
        self.first_event, states = self._firsts[self.defaults()]
        self.first_states = np.frombuffer(states).tolist()

    # -- instances ---------------------------------------------------------------------------------

    def _at(self, parameters: bytes, history: int) -> Exchange:
        found = self._histories.instance(parameters, history)
        assert isinstance(found, Exchange)
        return found

    def _first(self, parameters: bytes, old: Instance | None) -> Exchange:
        """An instance with its initial values."""
        instance = old or self._new()
        assert isinstance(instance, Exchange)
        try:
            held, states = np.frombuffer(parameters).copy(), np.zeros(self.part.n)
            first = instance.begin(0.0, held.ctypes.data, again=old is not None)
            instance.states(states.ctypes.data)
        except BaseException:
            instance.free()
            raise
        instance.due = min(first.next, NEVER)
        self._firsts[parameters] = instance.due, states.tobytes()
        if len(self._firsts) > REMEMBERED:
            self._firsts.popitem(last=False)
        return instance

    def _go(self, instance: Instance, event: PastEvent) -> AfterEvent:
        """An event, shifted until the indicators have the signs that it is for."""
        assert isinstance(instance, Exchange)
        due = instance.due
        time = max(event.time, due) if event.timed and due < NEVER else event.time
        states, inputs = (np.frombuffer(b).copy() for b in (event.states, event.inputs))
        wanted = np.frombuffer(event.signs) > 0.5
        values = np.zeros(self.part.n_values)
        shift, start, nudges, rates = NUDGE * max(1.0, abs(time)), time, 0, states
        instance.move(time, states.ctypes.data, inputs.ctypes.data)
        while len(wanted) and nudges < NUDGES:
            instance.read(values.ctypes.data)
            if ((values[-len(wanted) :] > 0) == wanted).all():
                break
            rates = values[: len(states)].copy() if nudges == 0 else rates
            shifted = states + shift * rates
            instance.move(start + shift, shifted.ctypes.data, inputs.ctypes.data)
            shift, nudges = 2 * shift, nudges + 1
        else:
            if nudges:
                instance.move(time, states.ctypes.data, inputs.ctypes.data)
        found = instance.happen(time)
        if found.jumped:
            instance.states(states.ctypes.data)
        return AfterEvent(0, min(found.next, NEVER), states.tobytes(), nudges)

    # -- functions ---------------------------------------------------------------------------------

    def _evaluate(self, at: int, into: int) -> int:
        if not math.isfinite(sum(self._given.from_address(at))):
            raise DiscardError  # many an FMU prints its complaints
        with self._lock:
            instance = self._at(self._values_of_parameters(at), self._history(at))
            time = C.c_double.from_address(at).value
            instance.move(time, at + self._at_states, at + self._at_inputs)
            instance.read(into)
        return 0

    def _begin(self, at: int, into: int) -> int:
        """The first time event, and the states at the start."""
        with self._lock:
            parameters = self._values_of_parameters(at)
            if parameters not in self._firsts:
                self._at(parameters, 0)
            if parameters not in self._firsts:  # they were forgotten, but not the instance
                self._first(parameters, None).free()
            due, states = self._firsts[parameters]
            C.c_double.from_address(into).value = due
            C.memmove(into + BYTES, states, len(states))
        return 0

    def _event(self, at: int, into: int) -> int:
        """The number of the history behind an event, the next time event, and the states."""
        number = C.c_double.from_address
        n, signs = self.part.n, self.description.indicators * BYTES
        with self._lock:
            event = PastEvent(
                self._history(at),
                number(at).value,
                C.string_at(at + self._at_states, n * BYTES),
                self._values_of_inputs(at),
                C.string_at(at + self._behind, signs),
                number(at + self._behind + signs).value > 0.5,
            )
            after = self._histories.after(self._values_of_parameters(at), event)
            number(into).value, number(into + BYTES).value = after.history, after.next
            C.memmove(into + 2 * BYTES, after.numbers, n * BYTES)
            return after.nudges

    def _fast_columns(self, given: Numbers, wanted: list[int], matrix: Numbers) -> dict[int, int]:
        """Rates and results by states and inputs, by the FMU's directional derivatives, where it has them."""
        known = self.description.variables
        if not self.description.directional:
            return {}
        part, at = self.part, given.ctypes.data
        instance = self._at(self._values_of_parameters(at), int(given[1]))
        instance.move(given[0], at + self._at_states, at + self._at_inputs)
        rows = [known[n] for n in (*self.description.rates, *part.results)]
        if not all(r.type in REAL[:2] for r in rows):
            return {}
        size = sum(r.size for r in rows)
        unknowns = (C.c_uint32 * len(rows))(*[r.reference for r in rows])
        column, done = 2, dict[int, int]()
        for name in (*self.description.states, *part.inputs):
            variable = known[name]
            if variable.type not in REAL[:2]:
                column += variable.size
                continue
            for seed in np.eye(variable.size):
                if column in wanted:
                    found = np.zeros(size)
                    instance.derivative(unknowns, variable.reference, seed, found)
                    matrix[:size, column] = found
                    done[column] = size
                column += 1
        return done
