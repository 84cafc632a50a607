"""An FMU for model exchange in a model: its rates, outputs and indicators, and what it does at events."""

from __future__ import annotations

import ctypes as C
import math
from collections import OrderedDict
from contextlib import suppress
from typing import Any

import numpy as np
from jaxtyping import Bool

from acausal.errors import warn
from acausal.fmu.computed import Computed
from acausal.fmu.derivatives import STEP, Differentiated, Numbers
from acausal.fmu.description import REAL
from acausal.fmu.event_mode import EventMode, Info
from acausal.fmu.histories import REMEMBERED, AfterEvent, PastEvent
from acausal.fmu.instance import Instance
from acausal.fmu.library import BYTES, WARNING, DiscardError, FMUError
from acausal.fmu.part import Part

LOOKS, DIFFERS = 20, 1e-2
"""So many pairs of events are looked at; their rates differ, beyond what is rounding or solved within the FMU, if they
do so by more than this part of what the difference of the arguments is."""


class Exchange(EventMode):
    """One instance between its events."""

    between = "EnterContinuousTimeMode"

    def __init__(self, *given: Any) -> None:
        super().__init__(*given)
        library = self.library
        self.n = sum(library.description.variables[s].size for s in library.description.states)
        self.n_indicators = library.description.indicators
        call = library.calls
        self._set_time, self._set_states = call["SetTime"], call["SetContinuousStates"]
        self._rates, self._indicators = call["rates"], call["GetEventIndicators"]

    def begin(self, time: float, parameters: int, *, again: bool) -> Info:
        """Find the initial values with some parameters, given by address; see `initialize`."""
        self.initialize(time, parameters, 0, again=again)
        return self.iterate(time, ticks=False)  # the event at the start has inputs

    def happen(self, time: float, inputs: int) -> Info:
        """An event at the present values, at a time, with inputs by address; a step ends there."""
        if self.library.description.completes:
            self._complete(time)
        self.check(self.library.calls["EnterEventMode"](self.address), "EnterEventMode")
        self._write(self._discrete_writes, inputs, "an input")
        return self.iterate(time, inputs)

    def _complete(self, time: float) -> None:
        """Tell an FMU that wants to know it that a step of the integration is completed."""
        boolean = C.c_int if self.library.is_2 else C.c_bool
        event, ends = boolean(), boolean()
        kinds = (C.c_void_p, boolean, C.c_void_p, C.c_void_p)
        completed = self.library.function("CompletedIntegratorStep", *kinds)
        status = completed(self.address, 1, C.addressof(event), C.addressof(ends))
        self.check(status, "CompletedIntegratorStep")
        if ends.value:
            self.last = time

    def move(self, time: float, states: int, inputs: int) -> None:
        """Set time, states and the inputs that are not discrete, these by address."""
        self.check_time(time)
        if (status := self._set_time(self.address, time)) > WARNING:
            self.check(status, "SetTime")
        if self.n and (status := self._set_states(self.address, states, self.n)) > WARNING:
            self.check(status, "SetContinuousStates")
        self._write(self._continuous_writes, inputs, "an input")

    def read(self, into: int) -> None:
        """Rates, results and event indicators, in this order, to an address.

        Results are asked for first: OpenModelica's FMUs compute them only where nothing was computed before.
        """
        rates, into = into, into + BYTES * self.n
        self.read_results(into)
        if self.n and (status := self._rates(self.address, rates, self.n)) > WARNING:
            self.check(status, "computing derivatives")
        if self.n_indicators:
            into += BYTES * self.results.size
            status = self._indicators(self.address, into, self.n_indicators)
            self.check(status, "computing event indicators")

    def states(self, into: int) -> None:
        """The continuous states, to an address."""
        if self.n:
            get = self.library.calls["GetContinuousStates"]
            self.check(get(self.address, into, self.n), "GetContinuousStates")

    def derivative(self, unknowns: Any, known: int, seed: np.ndarray, into: np.ndarray) -> None:
        """The directional derivative of some unknowns, references in an array of C, by one known."""
        reference = C.c_uint32(known)
        seeds, rows = (() if self.library.is_2 else (len(a),) for a in (seed, into))
        status = self.library.directional(
            self.address, unknowns, len(unknowns), C.addressof(reference), 1,
            seed.ctypes.data, *seeds, into.ctypes.data, *rows,
        )  # fmt: skip
        self.check(status, "computing directional derivatives")


NEVER = 1e30
"""The time of an event that never comes [s]."""

MOST_SHIFTS = 40
"""So often an event is shifted, twice as far each time, until the FMU sees the conditions change that have changed."""

FIRST_SHIFT = 1e-14
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
        self._looks = 0
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
            event=Differentiated(
                self._event, width + indicators + 1, 1 + part.n_next + n, **common, look=self._look_behind
            ),
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
        instance.next = _limited(first)
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
        shifts = self._shift(instance, time, states, inputs, wanted)
        found = instance.happen(time, inputs.ctypes.data)
        if found.jumped:
            instance.states(states.ctypes.data)
        signs = self._signs(instance, len(wanted))[0].astype(float).tobytes()
        return AfterEvent(0, _limited(found), states.tobytes(), shifts, signs)

    def _shift(
        self,
        instance: Exchange,
        time: float,
        states: Numbers,
        inputs: Numbers,
        wanted: Bool[np.ndarray, " n"],
    ) -> int:
        """Move an instance to an event, or a little beyond until its indicators have the signs; how often it was moved.

        What they wait for may be the time, a state, or an input: which way one moves is not known, so both are tried.
        """
        instance.move(time, states.ctypes.data, inputs.ctypes.data)
        signs, rates = self._signs(instance, len(wanted))
        if (signs == wanted).all():
            return 0
        sizes = np.diag(np.maximum(abs(inputs), 1.0))
        ways = [np.zeros_like(inputs), *sizes, *-sizes]
        for shifts in range(1, MOST_SHIFTS + 1):
            shift = FIRST_SHIFT * 2 ** (shifts - 1)
            later = shift * max(1.0, abs(time))
            moved = states + later * rates
            for way in ways:
                given = inputs + shift * way
                instance.move(time + later, moved.ctypes.data, given.ctypes.data)
                if (self._signs(instance, len(wanted))[0] == wanted).all():
                    return shifts
        instance.move(time, states.ctypes.data, inputs.ctypes.data)
        return MOST_SHIFTS

    def _signs(self, instance: Exchange, n: int) -> tuple[Bool[np.ndarray, " n"], Numbers]:
        """Which indicators are positive, and the rates of the states."""
        values = np.zeros(self.part.n_values)
        if n:
            instance.read(values.ctypes.data)
        return values[len(values) - n :] > 0, values[: self.part.n]

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
        """The number of the history behind an event, the next events whose time is known, and the states."""
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
            behind = np.array([after.history, *after.next]).tobytes() + after.numbers
            C.memmove(into, behind, len(behind))
            return after.shifts

    def _look_behind(self, given: Numbers, first: Numbers, there: Numbers) -> None:
        """Warn, once, if an event keeps a number inside that depends on its arguments, and that the rates depend on.

        Then the same states, inputs and parameters have other rates behind an event whose arguments were close by.
        """
        part, width = self.part, self._behind // BYTES
        if self._looks >= LOOKS or part.open_loop or first[0] == there[0]:
            return
        self._looks += 1
        at, values = given[:width].copy(), np.zeros((2, part.n_values))
        at[2 : 2 + part.n] = first[1 + part.n_next :]
        with suppress(DiscardError):
            for row, found in zip(values, (first, there), strict=True):
                at[1] = found[0]
                self._evaluate(at.ctypes.data, row.ctypes.data)
        one, other = values[:, : part.n]
        if (abs(one - other) > DIFFERS * STEP * np.maximum(abs(one), abs(other))).any():
            self._looks = LOOKS
            warn(
                f"The gradient is wrong: the FMU '{self.description.model}' samples a number at an event and keeps it "
                "inside, where it has no derivative, and its states follow it. Build what samples of our components; "
                "or, if its effect is meant to be left out, ac.FMU(..., open_loop=True)."
            )

    def _fast_columns(self, given: Numbers, wanted: list[int], matrix: Numbers) -> dict[int, int]:
        """Rates and results by states and inputs, by the FMU's directional derivatives, where it has them."""
        known = self.description.variables
        if not self.description.directional:
            return {}
        part, at = self.part, given.ctypes.data
        instance = self._at(self._values_of_parameters(at), int(given[1]))
        instance.move(given[0], at + self._at_states, at + self._at_inputs)
        rows = [known[n] for n in (*self.description.rates, *part.results)]
        if not all(r.type in REAL[:2] and not r.is_clocked for r in rows):
            return {}
        size = sum(r.size for r in rows)
        unknowns = (C.c_uint32 * len(rows))(*[r.reference for r in rows])
        column, done = 2, dict[int, int]()
        for name in (*self.description.states, *part.inputs):
            variable = known[name]
            if variable.type not in REAL[:2] or variable.is_clocked:
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


def _limited(found: Info) -> tuple[float, ...]:
    return tuple(min(time, NEVER) for time in found.next)
