"""Instances of an FMU for model exchange, between their events in continuous-time mode."""

from __future__ import annotations

import ctypes as C
from typing import Any

import numpy as np

from acausal.fmu.instance import Info, Instance
from acausal.fmu.library import BYTES, WARNING


class Exchange(Instance):
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
        return self.iterate(time)

    def happen(self, time: float) -> Info:
        """An event at the present values, at a time; a step ends there."""
        if self.library.description.completes:
            self._complete(time)
        self.check(self.library.calls["EnterEventMode"](self.address), "EnterEventMode")
        return self.iterate(time)

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
