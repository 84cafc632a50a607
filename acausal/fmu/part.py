"""One FMU in a model: which of its variables are known, and the instances that compute it.

What is computed is a pure function of its arguments, so that steps may be tried, repeated and gone through backwards.
Whatever an FMU remembers follows from its parameters and from its *history*: the events that it has gone through. The
model keeps the history's number as a discrete variable; an instance is found by parameters and history, and where none
is there, a new one goes through the same events. A parameter that is a little larger is another instance.
"""

from __future__ import annotations

import ctypes as C
import math
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from threading import RLock
from typing import Any, NamedTuple
from weakref import finalize

import numpy as np

from acausal.errors import AcausalError, DeclarationError
from acausal.fmu.archive import read
from acausal.fmu.description import REAL, Description
from acausal.fmu.handlers import register
from acausal.fmu.instance import BYTES, DiscardError, FMUError, Instance, Library, Variables

NEVER = 1e30
"""The time of an event that never comes [s]."""

KEPT = 128
"""Instances of an FMU, for different parameters and histories, that are kept; the least used one goes."""

STEP = 1e-7
"""Of a difference quotient, relative to the nominal value or the value, whichever is larger."""

SECOND_STEP = 1e-4
"""The same for the derivatives of derivatives, which are less exact than values."""

NUDGES = 40
"""So often an event is shifted, twice as far each time, until the FMU sees the conditions change that have changed."""

NUDGE = 1e-14
"""The first shift, relative to the time, at least of 1 s."""

Numbers = np.ndarray[Any, np.dtype[np.float64]]

Function = Callable[[int, int], int]
"""A function of two addresses, which returns how far an event had to be shifted."""

Fast = Callable[[Numbers, list[int], Numbers], dict[int, int]]
"""Fills rows of some columns of a Jacobian without difference quotients; by column, how many, from the first."""


class Event(NamedTuple):
    """An event that an FMU has gone through.

    Attributes:
        before: the history before it. time, states, inputs: what held. signs: which indicators were positive.
        timed: whether a time event was due.
    """

    before: int
    time: float
    states: bytes
    inputs: bytes
    signs: bytes
    timed: bool


class After(NamedTuple):
    """What is behind an event: number of the history, next time event, states; and how often it was shifted."""

    history: int
    next: float
    states: bytes
    nudges: int


@dataclass(frozen=True)
class Part:
    """An FMU with what a model fixes of it.

    Attributes:
        path: of the archive, as the user gave it. digest: of its content. description: of the FMU.
        settings: values that are fixed and no real parameters, by name.
        parameters, inputs, results: names of what a model gives, and of what it reads.
    """

    path: str
    digest: str
    description: Description
    settings: tuple[tuple[str, Any], ...]
    parameters: tuple[str, ...]
    inputs: tuple[str, ...]
    results: tuple[str, ...]

    # -- sizes -----------------------------------------------------------------------------------

    def elements(self, names: tuple[str, ...]) -> list[str]:
        """The elements of some variables."""
        return [e for n in names for e in self.description.variables[n].names]

    @cached_property
    def n(self) -> int:
        """How many states there are."""
        return len(self.elements(self.description.states))

    @cached_property
    def n_inputs(self) -> int:
        """How many inputs there are."""
        return len(self.elements(self.inputs))

    @cached_property
    def n_parameters(self) -> int:
        """How many parameters there are."""
        return len(self.elements(self.parameters))

    @cached_property
    def n_values(self) -> int:
        """How many numbers an evaluation gives: rates, results, indicators."""
        return self.n + len(self.elements(self.results)) + self.description.indicators

    def has_events(self) -> bool:
        """Whether there are events: nobody but the FMU itself knows of its time events."""
        known = self.description.variables.values()
        changes = any(
            v.variability == "discrete" and v.causality in ("local", "output") for v in known
        )
        try:
            return changes or self.description.indicators > 0 or self.computed.first_event < NEVER
        except AcausalError:
            return False  # it cannot be used here, but it can be looked at

    def first_states(self) -> list[float]:
        """The states at the start of an FMU without parameters; zeros where it cannot be used here."""
        try:
            return self.computed.first_states
        except AcausalError:
            return [0.0] * self.n

    @property
    def computed(self) -> Computed:
        """What computes it in this process."""
        found = _COMPUTED.get(self.key)
        if found is None:
            found = _COMPUTED[self.key] = Computed(self)
        return found

    @cached_property
    def key(self) -> str:
        """It stands for all that the part is."""
        of = self.digest, self.settings, self.parameters, self.inputs, self.results
        return sha256(repr(of).encode()).hexdigest()

    def __getstate__(self) -> dict[str, Any]:
        """Without what was computed."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}


_COMPUTED: dict[str, Computed] = {}


class Computed:
    """The functions of one part, by address, and their instances.

    The arguments of all are: time, history, states, inputs, parameters; of `event` also what the indicators' signs are.

    Attributes:
        first_event, first_states: the first time event and the states at the start, with the FMU's own parameters.
        evaluate, event, begin: numbers of the functions; the next two are those of its first and second derivatives.
        numbers: all of them.
    """

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
        self._library = _library(part.digest, self.description, folder)
        self._lock = RLock()
        self._instances: OrderedDict[tuple[bytes, int], Instance] = OrderedDict()
        self._events: list[Event] = [Event(-1, -np.inf, b"", b"", b"", False)]
        self._numbers: dict[Event, int] = {}
        self._afters: OrderedDict[tuple[bytes, Event], After] = OrderedDict()
        self._firsts: dict[bytes, tuple[float, bytes]] = {}
        self._dues: dict[tuple[bytes, int], float] = {}
        n, k, m = part.n, part.n_inputs, part.n_parameters
        self._at_states, self._at_inputs = 2 * BYTES, (2 + n) * BYTES
        self._at_parameters, self._at_signs = (2 + n + k) * BYTES, (2 + n + k + m) * BYTES
        self._scales = self._nominal()
        width = 2 + n + k + m
        self.evaluate = self._with_derivatives(
            self._evaluate, width, part.n_values, self._fast_columns
        )
        self.event = self._with_derivatives(
            self._event, width + self.description.indicators + 1, 2 + n, self._no_columns
        )
        self.begin = self._with_derivatives(self._begin, width, 1 + n, self._no_columns)
        self.numbers = tuple(range(self.evaluate, self.begin + 3))
        finalize(self, _free_all, self._instances)
        self._make().free()  # an FMU that cannot be used says so before it is needed
        self.first_event, self.first_states = self._first(self._defaults())

    def _first(self, parameters: bytes) -> tuple[float, list[float]]:
        """The first time event and the states at the start, where they can be found with these parameters."""
        try:
            self._instance(parameters, 0)
        except (FMUError, DiscardError):
            return NEVER, [0.0] * self.part.n
        due, states = self._firsts[parameters]
        return due, np.frombuffer(states).tolist()

    def _variables(self, names: tuple[str, ...]) -> Variables:
        known = self.description.variables
        return Variables(self.description.version, [known[n] for n in names])

    def _nominal(self) -> Numbers:
        known, part = self.description.variables, self.part
        names = (*self.description.states, *part.inputs, *part.parameters)
        each = [[v.nominal] * v.size for v in (known[n] for n in names)]
        return np.asarray([1.0, 0.0, *(s for sizes in each for s in sizes)])

    def _defaults(self) -> bytes:
        """The parameters as the FMU has them."""
        known = self.description.variables
        starts = [s for name in self.part.parameters for s in known[name].starts]
        return np.asarray(starts, float).tobytes()

    # -- instances -----------------------------------------------------------------------------------

    def _instance(self, parameters: bytes, history: int) -> Instance:
        key = parameters, history
        found = self._instances.get(key)
        if found is None:
            found = self._again(parameters, history)
            self._instances[key] = found
        elif len(self._instances) > 1:
            self._instances.move_to_end(key)
        return found

    def _again(self, parameters: bytes, history: int) -> Instance:
        """An instance that goes through a history, from where one has come already if possible."""
        chain: list[Event] = []
        while history > 0 and (parameters, history) not in self._instances:
            chain.append(self._events[history])
            history = self._events[history].before
        instance = self._instances.pop((parameters, history), None) if chain else None
        if instance is None:
            instance = self._new(parameters)
        due = self._dues.get((parameters, history), self._firsts[parameters][0])
        try:
            for event in reversed(chain):
                due = self._go_through(instance, event, due).next
        except BaseException:
            instance.free()
            raise
        if chain:
            self._dues[parameters, self._numbers[chain[0]]] = due
        return instance

    def _make(self) -> Instance:
        return Instance(
            self._library, self._settings, self._parameters, self._inputs, self._results
        )

    def _new(self, parameters: bytes) -> Instance:
        """An instance with its initial values; if there are many, the one that was not used for longest."""
        most = 1 if self.description.once else max(KEPT, 4 * (self.part.n_parameters + 1))
        again = len(self._instances) >= most
        if again:
            _, instance = self._instances.popitem(last=False)
        else:
            instance = self._make()
        try:
            held, states = np.frombuffer(parameters).copy(), np.zeros(self.part.n)
            first = instance.initialize(0.0, held.ctypes.data, 0, again=again)
            instance.states(states.ctypes.data)
        except BaseException:
            instance.free()
            raise
        self._firsts[parameters] = min(first.next, NEVER), states.tobytes()
        return instance

    def _go_through(self, instance: Instance, event: Event, due: float) -> After:
        """An event, shifted until the indicators have the signs that it is for."""
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
        found = instance.happen()
        if found.jumped:
            instance.states(states.ctypes.data)
        return After(0, min(found.next, NEVER), states.tobytes(), nudges)

    # -- functions ---------------------------------------------------------------------------------

    def _evaluate(self, at: int, into: int) -> int:
        number = C.c_double.from_address
        with self._lock:
            parameters = C.string_at(at + self._at_parameters, self._at_signs - self._at_parameters)
            instance = self._instance(parameters, int(number(at + BYTES).value))
            instance.move(number(at).value, at + self._at_states, at + self._at_inputs)
            instance.read(into)
        return 0

    def _begin(self, at: int, into: int) -> int:
        """The first time event, and the states at the start."""
        with self._lock:
            parameters = C.string_at(at + self._at_parameters, self._at_signs - self._at_parameters)
            if parameters not in self._firsts:
                self._instance(parameters, 0)
            due, states = self._firsts[parameters]
            C.c_double.from_address(into).value = due
            C.memmove(into + BYTES, states, len(states))
        return 0

    def _event(self, at: int, into: int) -> int:
        """The number of the history behind an event, the next time event, and the states."""
        number = C.c_double.from_address
        n, signs = self.part.n, self.description.indicators * BYTES
        with self._lock:
            parameters = C.string_at(at + self._at_parameters, self._at_signs - self._at_parameters)
            event = Event(
                int(number(at + BYTES).value),
                number(at).value,
                C.string_at(at + self._at_states, n * BYTES),
                C.string_at(at + self._at_inputs, self._at_parameters - self._at_inputs),
                C.string_at(at + self._at_signs, signs),
                number(at + self._at_signs + signs).value > 0.5,
            )
            after = self._after(parameters, event)
            number(into).value, number(into + BYTES).value = after.history, after.next
            C.memmove(into + 2 * BYTES, after.states, n * BYTES)
            return after.nudges

    def _after(self, parameters: bytes, event: Event) -> After:
        key = parameters, event
        if (known := self._afters.get(key)) is not None:
            return known
        last = self._events[event.before]
        same = (last.time, last.inputs, last.signs) == (event.time, event.inputs, event.signs)
        instance = self._instance(parameters, event.before)
        due = self._dues.get((parameters, event.before), self._firsts[parameters][0])
        if same:  # it has gone through this event
            return self._keep(key, After(event.before, due, event.states, 0))
        del self._instances[parameters, event.before]
        try:
            after = self._go_through(instance, event, due)
        except BaseException:
            instance.free()
            raise
        history = self._numbers.setdefault(event, len(self._events))
        if history == len(self._events):
            self._events.append(event)
        if (old := self._instances.pop((parameters, history), None)) is not None:
            old.free()
        self._instances[parameters, history] = instance
        self._dues[parameters, history] = after.next
        return self._keep(key, after._replace(history=history))

    def _keep(self, key: tuple[bytes, Event], after: After) -> After:
        self._afters[key] = after
        if len(self._afters) > 4096:
            self._afters.popitem(last=False)
        return after

    # -- derivatives -------------------------------------------------------------------------------

    def _with_derivatives(self, function: Function, width: int, height: int, fast: Fast) -> int:
        """Register a function and, behind it, its Jacobian and its second derivatives.

        These two take, before the arguments, which of them derivatives are wanted for: the other columns are zero.
        """
        columns = [0, *range(2, self._at_signs // BYTES)]

        def jacobian(at: int, into: int) -> None:
            (marks, given), matrix = _array(at, 2, width).copy(), _array(into, height, width)
            wanted = [column for column in columns if marks[column]]
            matrix[:] = 0.0
            with self._lock:
                first = np.zeros(height)
                nudges = function(given.ctypes.data, first.ctypes.data)
                done = fast(given, wanted, matrix)
                for column in wanted:
                    rows = slice(done.get(column, 0), height)
                    if rows.start < height:
                        found = self._quotient(function, given, first, column, nudges)
                        matrix[rows, column] = found[rows]

        def second(at: int, into: int) -> None:
            both, found = _array(at, 2, width).copy(), _array(into, height, width, width)
            given, place = both[1], both.ctypes.data
            first, there = np.zeros((height, width)), np.zeros((height, width))
            found[:] = 0.0
            jacobian(place, first.ctypes.data)
            for column in columns:
                value = given[column]
                given[column] += SECOND_STEP * max(self._scales[column], abs(value))
                jacobian(place, there.ctypes.data)
                found[:, :, column] = (there - first) / (given[column] - value)
                given[column] = value

        number = register(function)
        register(jacobian)
        register(second)
        return number

    def _quotient(
        self, function: Function, given: Numbers, first: Numbers, column: int, nudges: int
    ) -> Numbers:
        """The derivative by one argument: to the side on which an event need not be shifted farther.

        Between events of an FMU with indicators it is central: an indicator may jump where it changes its sign, and
        whether that is before or behind the present values is chance. The instant's derivative is the ratio of two.
        """
        value, step = given[column], STEP * max(self._scales[column], abs(given[column]))
        found: list[tuple[int, float, Numbers]] = []
        for h in (step, -step):
            given[column] = value + h
            with suppress(DiscardError):
                there = np.zeros(len(first))
                shifted = function(given.ctypes.data, there.ctypes.data)
                found.append((shifted, given[column], there))
            if found and found[0][0] <= nudges and not self._is_central(function):
                break
        given[column] = value
        if not found:
            return np.full(len(first), np.nan)
        if len(found) == 2 and self._is_central(function):
            (_, high, above), (_, low, below) = found
            return (above - below) / (high - low)
        _, place, there = min(found, key=lambda f: f[0])
        return (there - first) / (place - value)

    def _is_central(self, function: Function) -> bool:
        return function == self._evaluate and self.description.indicators > 0

    def _no_columns(self, given: Numbers, wanted: list[int], matrix: Numbers) -> dict[int, int]:
        return {}

    def _fast_columns(self, given: Numbers, wanted: list[int], matrix: Numbers) -> dict[int, int]:
        """Rates and results by states and inputs, by the FMU's directional derivatives, where it has them."""
        known = self.description.variables
        if not self.description.directional:
            return {}
        part, at = self.part, given.ctypes.data
        instance = self._instance(
            C.string_at(at + self._at_parameters, self._at_signs - self._at_parameters),
            int(given[1]),
        )
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


def _array(address: int, *shape: int) -> Numbers:
    """The numbers at an address."""
    return np.ctypeslib.as_array((C.c_double * math.prod(shape)).from_address(address)).reshape(
        shape
    )


def _free_all(instances: OrderedDict[Any, Instance]) -> None:
    for instance in instances.values():
        instance.free()
    instances.clear()


_LIBRARIES: dict[str, Library] = {}


def _library(digest: str, description: Description, folder: Path) -> Library:
    if digest not in _LIBRARIES:
        _LIBRARIES[digest] = Library(description, folder)
    return _LIBRARIES[digest]
