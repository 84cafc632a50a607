"""Instances of an FMU for model exchange, between their events in continuous-time mode."""

from __future__ import annotations

import ctypes as C
from typing import Any, NamedTuple

import numpy as np

from acausal.fmu.instance import Instance
from acausal.fmu.library import BYTES, WARNING, FMUError

PASSES = 100
"""An FMU that asks for so many updates of its discrete states at one instant asks for ever."""


class Info(NamedTuple):
    """What an FMU says of an event: the next time event (infinite: none), and whether its states have jumped."""

    next: float
    jumped: bool


class Exchange(Instance):
    """One instance between its events."""

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
        return self._iterate(time)

    def happen(self, time: float) -> Info:
        """An event at the present values, at a time."""
        self.check(self.library.calls["EnterEventMode"](self.address), "EnterEventMode")
        return self._iterate(time)

    def _iterate(self, time: float) -> Info:
        """Update discrete states until nothing changes any more, and leave event mode."""
        library, jumped = self.library, False
        for _ in range(PASSES):
            flags, after = self._update()
            needed, ends, _, values, defined = flags
            jumped = jumped or values
            if ends:
                self.last = time
            if ends or not needed:
                break
        else:
            raise FMUError(
                f"FMU: '{library.description.model}' finds no discrete states that agree: they change for ever."
            )
        self.check(
            library.calls["EnterContinuousTimeMode"](self.address), "EnterContinuousTimeMode"
        )
        return Info(after if defined else np.inf, jumped)

    def _update(self) -> tuple[list[bool], float]:
        if self.library.is_2:
            info = (C.c_int * 8)()  # five flags, padding, and the time as a double
            update = self.library.function("NewDiscreteStates", C.c_void_p, C.c_void_p)
            self.check(update(self.address, C.addressof(info)), "NewDiscreteStates")
            after = C.c_double.from_address(C.addressof(info) + 24).value
            return [bool(flag) for flag in info[:5]], after
        flags, after = [C.c_bool() for _ in range(5)], C.c_double()
        update = self.library.function("UpdateDiscreteStates", *[C.c_void_p] * 7)
        status = update(self.address, *map(C.addressof, flags), C.addressof(after))
        self.check(status, "UpdateDiscreteStates")
        return [flag.value for flag in flags], after.value

    def move(self, time: float, states: int, inputs: int) -> None:
        """Set time, states and inputs, these by address."""
        self.check_time(time)
        if (status := self._set_time(self.address, time)) > WARNING:
            self.check(status, "SetTime")
        if self.n and (status := self._set_states(self.address, states, self.n)) > WARNING:
            self.check(status, "SetContinuousStates")
        self._write(self._writes, inputs, "an input")

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
