"""The library of an FMU, loaded by ctypes: its functions, its log messages, and how its variables are read and set."""

from __future__ import annotations

import ctypes as C
from collections import deque
from collections.abc import Sequence
from functools import cached_property
from itertools import groupby
from typing import Any

import numpy as np

from acausal.errors import SimulationError, shortened
from acausal.fmu.archive import Folder, binary
from acausal.fmu.description import CLOCK, Description, FMUVariable, Interface

OK, WARNING, DISCARD, ERROR, FATAL = range(5)
BYTES = C.sizeof(C.c_double)

KINDS: dict[str, Any] = {
    "Real": C.c_double, "Float64": C.c_double, "Float32": C.c_float, "Integer": C.c_int,
    "Int8": C.c_int8, "Int16": C.c_int16, "Int32": C.c_int32, "Int64": C.c_int64,
    "UInt8": C.c_uint8, "UInt16": C.c_uint16, "UInt32": C.c_uint32, "UInt64": C.c_uint64, CLOCK: C.c_bool,
}  # fmt: skip
"""The type in C by type of FMI, which is also the word in the names of its functions."""

MESSAGES = 5
"""The last log messages of an FMU are kept for errors."""


class FMUError(SimulationError):
    """An FMU has refused a call."""


class DiscardError(Exception):
    """An FMU cannot compute anything at these values; a shorter step may do."""


class Variables:
    """Variables that are read and written by one call for each type.

    Arguments:
        kinds: of this version of FMI. variables: in order.

    Attributes:
        size: how many numbers there are. blocks: what one call takes, behind the clocks at whose ticks alone it may be
            called, and whether it sets discrete inputs. clocks: places of clocks, which are counts of their ticks, by
            name. starts: start values.
    """

    def __init__(self, version: str, variables: Sequence[FMUVariable]) -> None:
        self.blocks: list[tuple[tuple[str, ...], bool, tuple[str, Any, Any, int, int, int]]] = []
        self.clocks: dict[str, int] = {}
        first = 0
        for (clocks, discrete, word, kind), run in groupby(
            variables, lambda v: (v.clocks, v.is_discrete_input, *kind_of(version, v.type))
        ):
            some = list(run)
            references = (C.c_uint32 * len(some))(*(v.reference for v in some))
            size = sum(v.size for v in some)
            if word == CLOCK:
                self.clocks |= {v.name: first + i for i, v in enumerate(some)}
            else:
                call = word, kind, references, first, size, len(some)
                self.blocks.append((clocks, discrete, call))
            first += size
        self.size = first
        self.starts = np.asarray([s for v in variables for s in v.starts], float).tobytes()


def kind_of(version: str, name: str) -> tuple[str, Any]:
    """The word in the names of functions, and the type in C, of a type of FMI."""
    if name == "Boolean":
        return ("Boolean", C.c_int if version == "2.0" else C.c_bool)
    if name == "Enumeration":
        return ("Integer", C.c_int) if version == "2.0" else ("Int64", C.c_int64)
    return name, KINDS[name]


_MESSAGES: dict[bytes, deque[str]] = {}
"""What instances have logged, by their name: fmpy's proxy calls the logger that was registered last."""


class SharedLibrary:
    """The loaded library of an FMU.

    Attributes:
        messages: the last ones that its instances have logged. instances: how many there are.
        event_mode: whether co-simulation is with event mode.
    """

    instances = 0

    def __init__(self, description: Description, folder: Folder, kind: Interface) -> None:
        self.description, self.folder, self.kind = description, folder, kind
        self.event_mode = description.event_mode
        self.name = description.model.encode()
        self.messages = _MESSAGES.setdefault(self.name, deque(maxlen=MESSAGES))
        path = binary(folder.path, description.library(kind), description.model)
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
        d, resources, steps = self.description, self.folder.path / "resources", self.kind == "cs"
        p, text, boolean = C.c_void_p, C.c_char_p, C.c_int if self.is_2 else C.c_bool
        name, token = (text, self.name), (text, d.token.encode())
        if self.is_2:
            word, place = "", (text, resources.as_uri().encode())
            log = (p, C.addressof(self._log))
            given = [name, (C.c_int, int(steps)), token, place, log, (boolean, 0), (boolean, 1)]
        else:
            word, place = "ModelExchange", (text, f"{resources}/".encode())
            nothing, log = (p, None), (p, C.cast(self._log, p))
            given = [name, token, place, (boolean, False), (boolean, True)]
            if steps:
                word, early = "CoSimulation", (boolean, d.returns_early)
                given += [(boolean, self.event_mode), early, nothing, (C.c_size_t, 0)]
            given += [nothing, log, *([nothing] if steps else [])]
        kinds, values = zip(*given, strict=True)
        made = self.function(f"Instantiate{word}", *kinds, result=p)(*values)
        if not (made or d.clocks or self.instances) and steps and self.event_mode:
            self.event_mode = False  # some say that they have it, and have not
            self.messages.clear()
            return self.instantiate()
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
        found["EnterEventMode"] = self.function("EnterEventMode", p)
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
