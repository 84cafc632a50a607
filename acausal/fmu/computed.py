"""What computes one FMU of a model in this process: its library, its instances, and its functions by their numbers."""

from __future__ import annotations

import ctypes as C
from threading import RLock
from typing import Any, ClassVar

import numpy as np

from acausal.errors import DeclarationError
from acausal.fmu.archive import read
from acausal.fmu.derivatives import Differentiated
from acausal.fmu.description import STRUCTURAL
from acausal.fmu.histories import KEPT, AfterEvent, Histories, PastEvent
from acausal.fmu.instance import Instance
from acausal.fmu.library import BYTES, DiscardError, SharedLibrary, Variables
from acausal.fmu.part import Part


class Computed:
    """The functions of one part, by address, and their instances.

    The arguments of all are: time, history, states, inputs, parameters; some take more behind them. What they give is a
    pure function of these, so that steps may be tried, repeated and gone through backwards.

    Attributes:
        functions: by name, the number of the function and how many numbers it gives.
    """

    make: ClassVar[type[Instance]]

    def __init__(self, part: Part) -> None:
        digest, folder = read(part.path)
        if digest != part.digest:
            raise DeclarationError(
                f"FMU: '{part.path}' is no longer the file that the model was made of."
            )
        self.part, self.description = part, part.description
        known = self.description.variables
        self._parameters = self._variables(part.parameters)
        self._inputs, self._results = self._variables(part.inputs), self._variables(part.results)
        self._settings = tuple((known[n], v) for n, v in part.settings)
        sizes = tuple(s for s in part.settings if known[s[0]].causality == STRUCTURAL)
        key = part.digest, part.kind, sizes
        if key not in _LIBRARIES:
            _LIBRARIES[key] = SharedLibrary(self.description, folder, part.kind)
        self._library = _LIBRARIES[key]
        self._lock = RLock()
        at_once = 4 * (part.n_parameters + 1) + part.memory * part.n_inputs
        most = 1 if self.description.once else max(KEPT, at_once)
        self._histories = Histories(most, self._first, self._go)
        n, k, m = part.n, part.n_inputs, part.n_parameters
        self._at_states, self._at_inputs = 2 * BYTES, (2 + n) * BYTES
        self._at_parameters, self._behind = (2 + n + k) * BYTES, (2 + n + k + m) * BYTES
        names = (*(self.description.states if n else ()), *part.inputs, *part.parameters)
        each = [[v.nominal] * v.size for v in (known[n] for n in names)]
        self._scales = np.asarray([1.0, 0.0, *(s for sizes in each for s in sizes)])
        self._new().free()  # an FMU that cannot be used says so before it is needed
        self.functions: dict[str, tuple[int, int]] = {}

    def _offer(self, **functions: Differentiated) -> None:
        """Make functions known by name."""
        self.functions |= {n: (f.register(), f.height) for n, f in functions.items()}

    @property
    def numbers(self) -> list[int]:
        """Those of all functions and of their derivatives."""
        return [number + k for number, _ in self.functions.values() for k in range(3)]

    def _variables(self, names: tuple[str, ...]) -> Variables:
        known = self.description.variables
        return Variables(self.description.version, [known[n] for n in names])

    def _new(self) -> Instance:
        return self.make(
            self._library, self._settings, self._parameters, self._inputs, self._results
        )

    def _first(self, parameters: bytes, old: Instance | None) -> Instance:
        """An instance without a history."""
        raise NotImplementedError

    def _go(self, instance: Instance, event: PastEvent) -> AfterEvent:
        """What is behind an event."""
        raise NotImplementedError

    def defaults(self) -> bytes:
        """The parameters as the FMU has them."""
        known = self.description.variables
        starts = [s for name in self.part.parameters for s in known[name].starts]
        return np.asarray(starts, float).tobytes()

    # -- arguments ---------------------------------------------------------------------------------

    def _values_of_inputs(self, at: int) -> bytes:
        return C.string_at(at + self._at_inputs, self._at_parameters - self._at_inputs)

    def _values_of_parameters(self, at: int) -> bytes:
        return C.string_at(at + self._at_parameters, self._behind - self._at_parameters)

    def _history(self, at: int) -> int:
        history = C.c_double.from_address(at + BYTES).value
        if not history >= 0:  # behind a failure there is none
            raise DiscardError
        return int(history)


_LIBRARIES: dict[tuple[str, str, tuple[tuple[str, Any], ...]], SharedLibrary] = {}
