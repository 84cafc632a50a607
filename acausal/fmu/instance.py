"""Instances of an FMU for model exchange: its library's functions by ctypes, for FMI 2.0 and 3.0 alike.

Every number goes by its address: what JAX hands over is passed on as it lies in memory.
"""

from __future__ import annotations

import ctypes as C
from collections import deque
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from acausal.errors import SimulationError, shortened
from acausal.fmu.archive import binary
from acausal.fmu.description import Description, FMUVariable

OK, WARNING, DISCARD, ERROR, FATAL = range(5)
BYTES = C.sizeof(C.c_double)

KINDS: dict[str, tuple[str, Any]] = {
    "Real": ("Real", C.c_double),
    "Float64": ("Float64", C.c_double),
    "Float32": ("Float32", C.c_float),
    "Int8": ("Int8", C.c_int8),
    "UInt8": ("UInt8", C.c_uint8),
    "Int16": ("Int16", C.c_int16),
    "UInt16": ("UInt16", C.c_uint16),
    "Int32": ("Int32", C.c_int32),
    "UInt32": ("UInt32", C.c_uint32),
    "Int64": ("Int64", C.c_int64),
    "UInt64": ("UInt64", C.c_uint64),
    "Integer": ("Integer", C.c_int),
}
"""By type of FMI, the word in the names of its functions and the type in C."""

PASSES = 100
"""An FMU that asks for so many updates of its discrete states at one instant asks for ever."""

MESSAGES = 5
"""The last log messages of an FMU are kept for errors."""


class FMUError(SimulationError):
    """An FMU has refused a call."""


class DiscardError(Exception):
    """An FMU cannot compute anything at these values; a shorter step may do."""


class Info(NamedTuple):
    """What an FMU says of an event: the next time event (infinite: none), and whether its states have jumped."""

    next: float
    jumped: bool


class Variables:
    """Variables that are read and written by one call for each type.

    Arguments:
        kinds: of this version of FMI. variables: in order.
    """

    def __init__(self, version: str, variables: Sequence[FMUVariable]) -> None:
        self.size = sum(v.size for v in variables)
        self.blocks: list[tuple[str, Any, Any, int, int, int]] = []
        first = 0
        for v in variables:
            word, kind = _kind(version, v.type)
            last = self.blocks[-1] if self.blocks else None
            if last is not None and last[0] == word:
                references = (*last[2], v.reference)
                self.blocks[-1] = (word, kind, references, last[3], last[4] + v.size, 0)
            else:
                self.blocks.append((word, kind, (v.reference,), first, v.size, 0))
            first += v.size
        self.blocks = [
            (word, kind, (C.c_uint32 * len(r))(*r), start, size, len(r))
            for word, kind, r, start, size, _ in self.blocks
        ]


def _kind(version: str, name: str) -> tuple[str, Any]:
    if name == "Boolean":
        return ("Boolean", C.c_int if version == "2.0" else C.c_bool)
    if name == "Enumeration":
        return ("Integer", C.c_int) if version == "2.0" else ("Int64", C.c_int64)
    return KINDS[name]


_MESSAGES: dict[bytes, deque[str]] = {}
"""What instances have logged, by their name: fmpy's proxy calls the logger that was registered last."""


class Library:
    """The loaded library of an FMU.

    Attributes:
        messages: the last ones that its instances have logged. instances: how many there are.
    """

    instances = 0

    def __init__(self, description: Description, folder: Path) -> None:
        self.description, self.folder = description, folder
        self.name = description.model.encode()
        self.messages = _MESSAGES.setdefault(self.name, deque(maxlen=MESSAGES))
        path = binary(folder, description.exchange, description.model)
        try:
            self._library = C.PyDLL(str(path))
        except OSError as error:
            why = str(error).replace(str(path.parent), "").replace(str(path), path.name)
            raise FMUError(
                f"FMU: the library of '{description.model}' does not load: {shortened(why, 200)}; "
                "install what it needs, or export it for this system."
            ) from None
        self.prefix = f"fmi{description.version[0]}"
        self._log = self._logger()

    @property
    def is_2(self) -> bool:
        """Whether it is of FMI 2.0."""
        return self.prefix == "fmi2"

    def function(self, name: str, *kinds: Any, result: Any = C.c_int) -> Any:
        """A function of the library.

        Raises:
            FMUError: where it lacks one.
        """
        try:
            found = self._library[self.prefix + name]
        except AttributeError:
            raise FMUError(
                f"FMU: the library of '{self.description.model}' lacks '{self.prefix}{name}'; export it again."
            ) from None
        found.argtypes, found.restype = kinds, result
        return found

    def _logger(self) -> Any:
        def keep(name: bytes, status: int, message: bytes | None) -> None:
            if status > OK and message and name in _MESSAGES:
                _MESSAGES[name].append(message.decode(errors="replace").strip())

        if not self.is_2:
            kind = C.CFUNCTYPE(None, C.c_void_p, C.c_int, C.c_char_p, C.c_char_p)
            return kind(lambda _, status, __, message: keep(self.name, status, message))
        from fmpy import fmi2

        callbacks = fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(
            lambda _, name, s, __, text: keep(name, s, text)
        )
        callbacks.allocateMemory = fmi2.defaultCallbacks.allocateMemory
        callbacks.freeMemory = fmi2.defaultCallbacks.freeMemory
        try:
            from fmpy.logging import addLoggerProxy

            addLoggerProxy(C.byref(callbacks))
        except (ImportError, OSError):  # messages then lack their numbers
            pass
        return callbacks

    def instantiate(self) -> int:
        """The address of a new instance.

        Raises:
            FMUError: if the FMU refuses, as it does for a wrong GUID.
        """
        d, resources = self.description, self.folder / "resources"
        name, token = self.name, d.token.encode()
        text, boolean = C.c_char_p, C.c_int if self.is_2 else C.c_bool
        if self.is_2:
            make = self.function(
                "Instantiate", text, C.c_int, text, text, C.c_void_p, boolean, boolean, result=C.c_void_p
            )  # fmt: skip
            place = resources.as_uri().encode()
            made = make(name, 0, token, place, C.addressof(self._log), 0, 1)
        else:
            make = self.function(
                "InstantiateModelExchange", text, text, text, boolean, boolean, C.c_void_p, C.c_void_p,
                result=C.c_void_p,
            )  # fmt: skip
            place = f"{resources}/".encode()
            made = make(name, token, place, False, True, None, C.cast(self._log, C.c_void_p))
        if not made:
            raise FMUError(f"FMU: '{d.model}' gives no instance{self.said()}.")
        return int(made)

    def said(self) -> str:
        """The last messages, as a clause."""
        found = "; ".join(dict.fromkeys(self.messages))
        return f": it says '{shortened(' '.join(found.split()), 300)}'" if found else ""

    @cached_property
    def calls(self) -> dict[str, Any]:
        """The functions of model exchange that all steps need."""
        p, n, size = C.c_void_p, C.c_double, C.c_size_t
        rates = "GetDerivatives" if self.is_2 else "GetContinuousStateDerivatives"
        found = {"SetTime": self.function("SetTime", p, n)}
        names = ("SetContinuousStates", "GetContinuousStates", rates, "GetEventIndicators")
        for name in names:
            found[name] = self.function(name, p, p, size)
        found["rates"] = found[rates]
        for name in (
            "EnterEventMode",
            "EnterContinuousTimeMode",
            "ExitInitializationMode",
            "Reset",
        ):
            found[name] = self.function(name, p)
        return found

    @cached_property
    def directional(self) -> Any:
        """``fmi2GetDirectionalDerivative`` and its like."""
        p, size = C.c_void_p, C.c_size_t
        count = () if self.is_2 else (size,)
        kinds = (p, p, size, p, size, p, *count, p, *count)
        return self.function("GetDirectionalDerivative", *kinds)

    def accessor(self, verb: str, word: str) -> Any:
        """``fmi2GetReal`` and its like."""
        p, size = C.c_void_p, C.c_size_t
        count = () if self.is_2 else (size,)
        return self.function(verb + word, p, p, size, p, *count)


class Instance:
    """One instance between its events, in continuous-time mode.

    Arguments:
        library: of the FMU. settings: values that are no real parameters, by name.
        parameters: what is set before initialization, in the order of ``values``.
        inputs, results: what is set, and read, at each evaluation.
    """

    def __init__(
        self,
        library: Library,
        settings: tuple[tuple[FMUVariable, Any], ...],
        parameters: Variables,
        inputs: Variables,
        results: Variables,
    ) -> None:
        self.library, self.settings = library, settings
        self.parameters, self.inputs, self.results = parameters, inputs, results
        self.n = sum(library.description.variables[s].size for s in library.description.states)
        self.n_indicators = library.description.indicators
        call = library.calls
        self._set_time, self._set_states = call["SetTime"], call["SetContinuousStates"]
        self._rates, self._indicators = call["rates"], call["GetEventIndicators"]
        self._reads = self._calls("Get", results)
        self._writes = self._calls("Set", inputs)
        self._sets = self._calls("Set", parameters)
        if library.description.once and library.instances:
            raise FMUError(
                f"FMU: '{library.description.model}' can be in a process only once; a model may have one of it, with "
                "one choice of values."
            )
        self.address = library.instantiate()
        library.instances += 1

    def _calls(self, verb: str, variables: Variables) -> list[tuple[Any, ...]]:
        """For each type, the function, and what it is called with."""
        return [
            (self.library.accessor(verb, word), kind, references, start, size, count,
             () if self.library.is_2 else (size,))
            for word, kind, references, start, size, count in variables.blocks
        ]  # fmt: skip

    def free(self) -> None:
        """Give it back."""
        if self.address:
            free = self.library.function("FreeInstance", C.c_void_p, result=None)
            address, self.address = self.address, 0
            self.library.instances -= 1
            free(address)

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

    # -- initialization and events -----------------------------------------------------------------

    def initialize(self, time: float, parameters: int, inputs: int, *, again: bool) -> Info:
        """Set parameters and inputs at the initial time, and find the initial values.

        Arguments:
            parameters, inputs: addresses of their values; 0 keeps the FMU's own inputs.
            again: whether the instance has been used before.
        """
        library, address = self.library, self.address
        yes, number = C.c_int if library.is_2 else C.c_bool, C.c_double
        if again:
            self.check(library.calls["Reset"](address), "Reset")
        for variable, value in self.settings:
            self._set_setting(variable, value)
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
        self.check(library.calls["ExitInitializationMode"](address), "ExitInitializationMode")
        return self._iterate()

    def happen(self) -> Info:
        """An event at the present values."""
        self.check(self.library.calls["EnterEventMode"](self.address), "EnterEventMode")
        return self._iterate()

    def _iterate(self) -> Info:
        """Update discrete states until nothing changes any more, and leave event mode."""
        library, jumped = self.library, False
        for _ in range(PASSES):
            flags, after = self._update()
            needed, ends, _, values, defined = flags
            jumped = jumped or values
            if ends:
                raise FMUError(
                    f"FMU: '{library.description.model}' asks to end the simulation{library.said()}; end it earlier."
                )
            if not needed:
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

    def _set_setting(self, variable: FMUVariable, value: Any) -> None:
        reference = C.c_uint32(variable.reference)
        if variable.type == "String":
            word, kind = "String", C.c_char_p
            values = (kind * variable.size)(*[str(v).encode() for v in np.ravel(value)])
        else:
            word, kind = _kind(self.library.description.version, variable.type)
            whole = kind not in (C.c_double, C.c_float)
            numbers = [int(v) if whole else float(v) for v in np.ravel(value)]
            values = (kind * variable.size)(*numbers)
        count = () if self.library.is_2 else (variable.size,)
        set_value = self.library.accessor("Set", word)
        status = set_value(self.address, C.addressof(reference), 1, C.addressof(values), *count)
        self.check(status, f"setting '{variable.name}'")

    # -- between events ----------------------------------------------------------------------------

    def move(self, time: float, states: int, inputs: int) -> None:
        """Set time, states and inputs, these by address."""
        if (status := self._set_time(self.address, time)) > WARNING:
            self.check(status, "SetTime")
        if self.n and (status := self._set_states(self.address, states, self.n)) > WARNING:
            self.check(status, "SetContinuousStates")
        self._write(self._writes, inputs, "an input")

    def _write(self, blocks: Any, at: int, what: str) -> None:
        for write, kind, references, start, size, count, sizes in blocks:
            place = at + BYTES * start
            if kind is not C.c_double:
                numbers = (C.c_double * size).from_address(place)
                values = (kind * size)(*[v if kind is C.c_float else round(v) for v in numbers])
                place = C.addressof(values)
            if (status := write(self.address, references, count, place, *sizes)) > WARNING:
                self.check(status, f"setting {what}")

    def read(self, into: int) -> None:
        """Rates, results and event indicators, in this order, to an address.

        Results are asked for first: OpenModelica's FMUs compute them only where nothing was computed before.
        """
        rates, into = into, into + BYTES * self.n
        for get, kind, references, start, size, count, sizes in self._reads:
            place = into + BYTES * start
            if kind is C.c_double:
                status = get(self.address, references, count, place, *sizes)
            else:
                values = (kind * size)()
                status = get(self.address, references, count, C.addressof(values), *sizes)
                (C.c_double * size).from_address(place)[:] = list(values)
            if status > WARNING:
                self.check(status, "computing outputs")
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
