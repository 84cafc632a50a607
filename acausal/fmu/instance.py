"""Instances of an FMU, for FMI 2.0 and 3.0 alike: made, initialized, read and written.

Every number goes by its address: what JAX hands over is passed on as it lies in memory.
"""

from __future__ import annotations

import ctypes as C
from collections.abc import Iterable, Sequence
from typing import Any, ClassVar, TypeAlias

import numpy as np

from acausal.fmu.description import CLOCK, STRUCTURAL, FMUVariable
from acausal.fmu.library import (
    BYTES,
    DISCARD,
    FATAL,
    WARNING,
    DiscardError,
    FMUError,
    SharedLibrary,
    Variables,
    kind_of,
)

_Call: TypeAlias = tuple[tuple[str, ...], bool, Any]

Settings = Sequence[tuple[FMUVariable, Any]]
"""Variables with values that are fixed when an FMU is made."""


class Instance:
    """One instance of an FMU.

    Arguments:
        library: of the FMU. settings: values that are no real parameters, by name.
        parameters: what is set before initialization, in the order of ``values``.
        inputs, results: what is set, and read, at each evaluation.

    Attributes:
        next, signs: when its time events and its clocks come next, and which indicators were positive behind the last
            event; whoever leads it through events keeps them.
        last: the time at which it has asked to end the simulation. Its values can still be read there.
    """

    next: tuple[float, ...] = (float("inf"),)
    last = float("inf")
    signs = b""

    own: ClassVar[tuple[str, ...]] = ("next", "signs", "last")
    """Attributes that belong to its state."""

    @property
    def due(self) -> float:
        """The next of its events whose time is known."""
        return min(self.next)

    def __init__(
        self,
        library: SharedLibrary,
        settings: Settings,
        parameters: Variables,
        inputs: Variables,
        results: Variables,
    ) -> None:
        self.library, self.settings = library, settings
        self.parameters, self.inputs, self.results = parameters, inputs, results
        reads, writes = self._calls("Get", results), self._calls("Set", inputs)
        self._reads, self._clocked_reads = _free(reads), _clocked(reads)
        self._continuous_writes = _free(w for w in writes if not w[1])
        self._discrete_writes = _free(w for w in writes if w[1])
        self._writes = [*self._continuous_writes, *self._discrete_writes]
        self._clocked_writes = _clocked(writes)
        self._sets = _free(self._calls("Set", parameters))
        self._kept: dict[Any, tuple[int, list[Any]]] = {}
        self.make()

    def make(self) -> None:
        """Instantiate it.

        Raises:
            FMUError: if the FMU refuses.
        """
        library = self.library
        if library.description.once and library.instances:
            raise FMUError(
                f"FMU: '{library.description.model}' can be in a process only once; a model may have one of it, with "
                "one choice of values."
            )
        self.address = library.instantiate()
        library.instances += 1

    def _calls(self, verb: str, variables: Variables) -> list[_Call]:
        """For each block of variables, its clocks, whether it is discrete, the function, and what it is called with."""
        return [
            (clocks, discrete, (self.library.accessor(verb, word), kind, references, start, size, count,
             () if self.library.is_2 else (size,)))
            for clocks, discrete, (word, kind, references, start, size, count) in variables.blocks
        ]  # fmt: skip

    def free(self) -> None:
        """Give it back."""
        if self.address:
            for key in list(self._kept):
                self.forget(key)
            free = self.library.function("FreeInstance", C.c_void_p, result=None)
            address, self.address = self.address, 0
            self.library.instances -= 1
            free(address)

    def keep(self, key: Any) -> bool:
        """Keep the present state under some name, if the FMU can; whether it was kept."""
        if not self.library.description.keeps_state or key in self._kept:
            return False
        state = C.c_void_p()
        keep = self.library.function(self._state("Get"), C.c_void_p, C.c_void_p)
        if keep(self.address, C.addressof(state)) > WARNING:
            return False
        self._kept[key] = state.value or 0, [getattr(self, name) for name in self.own]
        return True

    def go_back(self, key: Any) -> bool:
        """Go back to a state that was kept; whether there is one of that name."""
        if key not in self._kept:
            return False
        state, values = self._kept[key]
        go_back = self.library.function(self._state("Set"), C.c_void_p, C.c_void_p)
        self.check(go_back(self.address, state), "going back to a state")
        for name, value in zip(self.own, values, strict=True):
            setattr(self, name, value)
        return True

    def forget(self, key: Any) -> None:
        """Give a state back."""
        if key in self._kept:
            state = C.c_void_p(self._kept.pop(key)[0])
            forget = self.library.function(self._state("Free"), C.c_void_p, C.c_void_p)
            forget(self.address, C.addressof(state))

    def _state(self, verb: str) -> str:
        return f"{verb}FMU{'state' if self.library.is_2 else 'State'}"

    def check(self, status: int, what: str) -> None:
        """Refuse a status.

        Raises:
            DiscardError: where the FMU cannot compute anything here. FMUError: for an error.
        """
        if status <= WARNING:
            return
        if status == DISCARD:
            raise DiscardError
        if status >= FATAL:
            self.address = 0  # nothing may be done with it any more
        raise FMUError(
            f"FMU: '{self.library.description.model}' fails in {what}{self.library.said()}."
        )

    def check_time(self, time: float) -> None:
        """Refuse a time behind the end that the FMU has asked for.

        Raises:
            FMUError: there.
        """
        if time > self.last + 1e-9 * abs(self.last):
            raise FMUError(
                f"FMU: '{self.library.description.model}' asks to end the simulation at {self.last:g} s"
                f"{self.library.said()}; end it there."
            )

    def call(self, name: str) -> None:
        """A function that takes nothing but the instance."""
        self.check(self.library.function(name, C.c_void_p)(self.address), name)

    def initialize(self, time: float, parameters: int, inputs: int, *, again: bool) -> None:
        """Set parameters and inputs at the initial time, and find the initial values.

        Arguments:
            parameters, inputs: addresses of their values; 0 keeps the FMU's own inputs.
            again: whether the instance has been used before.
        """
        library, address = self.library, self.address
        yes, number = C.c_int if library.is_2 else C.c_bool, C.c_double
        self.last = np.inf
        if again:
            for key in list(self._kept):
                self.forget(key)
            self.call("Reset")
        structural = [s for s in self.settings if s[0].causality == STRUCTURAL]
        if structural:
            self.call("EnterConfigurationMode")
            self._set_all(structural)
            self.call("ExitConfigurationMode")
        self._set_all(
            [s for s in self.settings if s[0].causality != STRUCTURAL and s[0].type != CLOCK]
        )
        self._write(self._sets, parameters, "a parameter")
        experiment = (C.c_void_p, yes, number, number, yes, number)
        if library.is_2:
            setup = library.function("SetupExperiment", *experiment)
            self.check(setup(address, 0, 0.0, time, 0, 0.0), "SetupExperiment")
            begin = library.function("EnterInitializationMode", C.c_void_p)
            status = begin(address)
        else:
            begin = library.function("EnterInitializationMode", *experiment)
            status = begin(address, False, 0.0, time, False, 0.0)
        self.check(status, "EnterInitializationMode")
        if inputs:
            self._write(self._writes, inputs, "an input")
        self.find_clocks(time)
        self.call("ExitInitializationMode")

    def find_clocks(self, time: float) -> None:
        """Find when clocks tick first; here there are none."""

    def _set_all(self, settings: Settings) -> None:
        for variable, value in settings:
            self._set_setting(variable, value)

    def _set_setting(self, variable: FMUVariable, value: Any) -> None:
        reference = C.c_uint32(variable.reference)
        if variable.type == "String":
            word, kind = "String", C.c_char_p
            values = (kind * variable.size)(*[str(v).encode() for v in np.ravel(value)])
        else:
            word, kind = kind_of(self.library.description.version, variable.type)
            whole = kind not in (C.c_double, C.c_float)
            numbers = [int(v) if whole else float(v) for v in np.ravel(value)]
            values = (kind * variable.size)(*numbers)
        count = () if self.library.is_2 else (variable.size,)
        set_value = self.library.accessor("Set", word)
        status = set_value(self.address, C.addressof(reference), 1, C.addressof(values), *count)
        self.check(status, f"setting '{variable.name}'")

    def _write(self, blocks: Any, at: int, what: str) -> None:
        for write, kind, references, start, size, count, sizes in blocks:
            place = at + BYTES * start
            if kind is not C.c_double:
                numbers = (C.c_double * size).from_address(place)
                values = (kind * size)(*[v if kind is C.c_float else round(v) for v in numbers])
                place = C.addressof(values)
            if (status := write(self.address, references, count, place, *sizes)) > WARNING:
                self.check(status, f"setting {what}")

    def read_results(self, into: int) -> None:
        """The results, to an address."""
        self._read(self._reads, into)

    def _read(self, blocks: Any, into: int) -> None:
        for get, kind, references, start, size, count, sizes in blocks:
            place = into + BYTES * start
            if kind is C.c_double:
                status = get(self.address, references, count, place, *sizes)
            else:
                values = (kind * size)()
                status = get(self.address, references, count, C.addressof(values), *sizes)
                (C.c_double * size).from_address(place)[:] = list(values)
            if status > WARNING:
                self.check(status, "computing outputs")


def _free(calls: Iterable[_Call]) -> list[Any]:
    """Those that need no clock."""
    return [call for clocks, _, call in calls if not clocks]


def _clocked(calls: Iterable[_Call]) -> list[tuple[tuple[str, ...], Any]]:
    """The others, behind their clocks."""
    return [(clocks, call) for clocks, _, call in calls if clocks]
