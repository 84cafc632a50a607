"""What an FMU does in event mode: its clocks tick, and discrete states are updated until nothing changes any more.

What belongs to clocks can be read and set at their ticks only: there it is read, and kept.
"""

from __future__ import annotations

import ctypes as C
from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, NamedTuple

import numpy as np

from acausal.fmu.description import COUNTDOWN, TRIGGERED, FMUVariable, timed_clocks
from acausal.fmu.instance import Instance
from acausal.fmu.library import BYTES, FMUError

PASSES = 100
"""An FMU that asks for so many updates of its discrete states at one instant asks for ever."""

TOGETHER = 1e-12
"""Ticks that are so close are one instant; relative to the time, at least of 1 s."""

UNKNOWN, UNCHANGED, CHANGED = range(3)
"""What FMI 3.0 says of the interval of a clock."""


def rounding(time: float) -> float:
    """By how much instants at some time may differ and be one."""
    return TOGETHER * max(1.0, abs(time))


class Info(NamedTuple):
    """What an FMU says of an event: when time events and clocks come next, and whether its states have jumped."""

    next: tuple[float, ...]
    jumped: bool


class EventMode(Instance):
    """An instance with event mode, and with the clocks that tick in it.

    Attributes:
        ticks: when clocks tick next, by name. counts: how often they have. held: results, of which those are kept that
            are clocked, as they were at the last tick.
    """

    between: ClassVar[str]
    """The function that leaves event mode."""

    own = (*Instance.own, "ticks", "counts", "held")
    ticks: Mapping[str, float]
    counts: Mapping[str, int]
    held = b""

    def __init__(self, *given: Any) -> None:
        super().__init__(*given)
        clocks, places = self.library.description.clocks, self.inputs.clocks
        self._intervals = {v.name: float(x) for v, x in self.settings if v in clocks}
        self._timed = timed_clocks(self.library.description, self._intervals)
        self._asked = [(v, BYTES * places[v.name]) for v in clocks if v.name in places]
        self._watched = [v for v in clocks if v.causality != "input"]
        self._periods: dict[str, tuple[float, float]] = {}
        self.ticks, self.counts = {}, dict.fromkeys((v.name for v in clocks), 0)

    # -- when clocks tick --------------------------------------------------------------------------

    def find_clocks(self, time: float) -> None:
        """Find when clocks tick first.

        Raises:
            FMUError: for an interval that is not above zero.
        """
        self.held, self.counts = self.results.starts, dict.fromkeys(self.counts, 0)
        ticks = dict[str, float]()
        for v in self._timed:
            if v.clock.is_periodic:
                self._periods[v.name] = interval, first = self._period(v, time)
                if not interval > 0:
                    raise FMUError(
                        f"FMU: the clock '{v.name}' of '{self.library.description.model}' has an interval of "
                        f"{interval:g} s, which must be above zero."
                    )
                ticks[v.name] = first
            else:
                known, interval = self._interval(v)
                ticks[v.name] = time + interval if known else np.inf
        self.ticks = ticks

    def _period(self, v: FMUVariable, time: float) -> tuple[float, float]:
        """The interval of a periodic clock, and its first tick."""
        given = self._intervals.get(v.name)
        if given is None and v.clock.interval is None:
            return self._interval(v)[1], time + self._of_clock("GetShiftDecimal", v)
        if given is not None and v.clock.kind != TRIGGERED:
            self._of_clock("SetIntervalDecimal", v, given)
        return given or v.clock.interval or 0.0, time + v.clock.shift

    def _interval(self, v: FMUVariable) -> tuple[int, float]:
        """What is known of a clock's interval, and the interval."""
        known = C.c_int()
        interval = self._of_clock("GetIntervalDecimal", v, 0.0, C.addressof(known))
        return known.value, interval

    def _of_clock(self, name: str, v: FMUVariable, value: float = 0.0, *more: int) -> float:
        """A number of a clock, asked for or set."""
        reference, number = C.c_uint32(v.reference), C.c_double(value)
        kinds = (C.c_void_p, C.c_void_p, C.c_size_t, C.c_void_p, *[C.c_void_p] * len(more))
        status = self.library.function(name, *kinds)(
            self.address, C.addressof(reference), 1, C.addressof(number), *more
        )
        self.check(status, f"{name} of the clock '{v.name}'")
        return number.value

    def _due(self, time: float) -> list[FMUVariable]:
        until = time + rounding(time)
        return [v for v in self._timed if self.ticks[v.name] <= until]

    def _schedule(self, time: float, active: Iterable[str]) -> None:
        """Find when clocks tick next, behind an update at which some of them have ticked."""
        ticks = dict(self.ticks)
        for v in self._timed:
            ticked, name = v.name in active, v.name
            if v.clock.is_periodic:
                if ticked:
                    interval, first = self._periods[name]
                    ticks[name] = first + self.counts[name] * interval
            elif ticked or v.clock.kind == COUNTDOWN:
                known, interval = self._interval(v)
                if known == CHANGED or (ticked and v.clock.kind != COUNTDOWN):
                    ticks[name] = time + interval
                elif ticked or known == UNKNOWN:
                    ticks[name] = np.inf
        self.ticks = ticks

    # -- an event ----------------------------------------------------------------------------------

    def iterate(self, time: float, inputs: int = 0, *, ticks: bool = True) -> Info:
        """Tick clocks, update discrete states until nothing changes any more, and leave event mode.

        Arguments:
            inputs: address of those that clocks may read; 0 where there are none. ticks: whether clocks tick.

        Raises:
            FMUError: if discrete states change for ever.
        """
        jumped = False
        for _ in range(PASSES):
            active = self._watch(self._tick(time, inputs) if ticks else set())
            flags, after = self._update()
            self._schedule(time, active)
            self._watch(set())
            needed, ends, _, values, defined = flags
            jumped = jumped or values
            if ends:
                self.last = time
            if ends or not (needed or (ticks and self._due(time))):
                break
        else:
            raise FMUError(
                f"FMU: '{self.library.description.model}' finds no discrete states that agree: they change for ever."
            )
        self.call(self.between)
        return Info((after if defined else np.inf, *self.ticks.values()), jumped)

    def _tick(self, time: float, inputs: int) -> set[str]:
        """Tick the clocks that are due, or asked to by inputs; their names."""
        ticking, counts = self._due(time), dict(self.counts)
        for v in ticking:
            counts[v.name] += 1
        for v, place in self._asked if inputs else ():
            count = round(C.c_double.from_address(inputs + place).value)
            if count != counts[v.name]:
                counts[v.name] = count
                ticking.append(v)
        self.counts, active = counts, {v.name for v in ticking}
        if ticking:
            self._clocks("SetClock", ticking, [True] * len(ticking))
            if inputs:
                self._write(_of(active, self._clocked_writes), inputs, "an input")
            if self.library.description.evaluates:
                self.call("EvaluateDiscreteStates")
        return active

    def _watch(self, active: set[str]) -> set[str]:
        """Read which clocks of the FMU tick, and what belongs to all that do; the names of all that tick."""
        asked = [v for v in self._watched if not v.clocks or active & {*v.clocks}]
        ticks = self._clocks("GetClock", asked, [False] * len(asked)) if asked else []
        ticking = {v.name for v, ticks_now in zip(asked, ticks, strict=True) if ticks_now}
        if ticking:
            self.counts = {n: count + (n in ticking) for n, count in self.counts.items()}
        if reads := _of(active | ticking, self._clocked_reads):
            held = np.frombuffer(self.held).copy()
            self._read(reads, held.ctypes.data)
            self.held = held.tobytes()
        return active | ticking

    def _clocks(self, name: str, clocks: list[FMUVariable], ticks: list[bool]) -> list[bool]:
        """Whether clocks tick, asked or told."""
        references = (C.c_uint32 * len(clocks))(*[v.reference for v in clocks])
        values = (C.c_bool * len(clocks))(*ticks)
        kinds = (C.c_void_p, C.c_void_p, C.c_size_t, C.c_void_p)
        status = self.library.function(name, *kinds)(
            self.address, C.addressof(references), len(clocks), C.addressof(values)
        )
        self.check(status, f"{name} of '{clocks[0].name}'")
        return list(values)

    def read_results(self, into: int) -> None:
        """The results, to an address; of what is clocked, those of the last tick."""
        super().read_results(into)
        for _, (*_, start, size, _, _) in self._clocked_reads:
            C.memmove(into + BYTES * start, self.held[BYTES * start :], BYTES * size)
        for name, place in self.results.clocks.items():
            C.c_double.from_address(into + BYTES * place).value = self.counts[name]

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


def _of(ticking: set[str], blocks: Iterable[tuple[tuple[str, ...], Any]]) -> list[Any]:
    """What belongs to clocks of which one ticks."""
    return [block for clocks, block in blocks if ticking & {*clocks}]
