"""Periodic sources: pulse, saw tooth, trapezoid."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import SMALL, part_of, period_at
from .interfaces import SignalSource

__modelica__ = "Modelica.Blocks.Sources"


class _Periodic(SignalSource):
    """A shape that repeats with ``period`` [s], ``nperiod`` times, or for ever if that is negative."""

    amplitude = ac.Parameter(1.0, doc="amplitude")
    period = ac.Parameter(unit="s", min=SMALL, doc="duration of one period")
    nperiod = ac.Option(-1, doc="number of periods; endless if negative")
    count = ac.Variable(doc="number of the present period, from 0")
    T_start = ac.Variable(unit="s", doc="when it began")

    def _curve(self, t: Any) -> Any:
        """The shape as a function of the time since its period began."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        now = period_at(self.startTime, self.period)
        yield ac.Eq(self.count, now.count)
        yield ac.Eq(self.T_start, now.begin)
        shape = self._curve(now.elapsed)
        if self.nperiod >= 0:
            shape = ac.where(now.count < self.nperiod, shape, 0, events=None)
        before = ac.time < self.startTime
        yield ac.Eq(self.y, self.offset + ac.where(before, 0, shape, events=None))


class Pulse(_Periodic):
    """``amplitude`` for the first ``width`` per cent of each period, else 0, plus ``offset``."""

    ICON = icons.PULSE

    width = ac.Parameter(50.0, min=0, max=100, doc="width of the pulse in per cent of the period")

    def _curve(self, t: Any) -> Any:
        return ac.where(t < self.period * self.width / 100, self.amplitude, 0, events=None)


class SawTooth(_Periodic):
    """Rises from 0 to ``amplitude`` in each period, plus ``offset``."""

    ICON = icons.SAWTOOTH

    def _curve(self, t: Any) -> Any:
        return self.amplitude * t / self.period


class Trapezoid(_Periodic):
    """In each period: ``rising``, at ``amplitude`` for ``width``, ``falling`` [s], then 0."""

    ICON = icons.TRAPEZOID

    rising = ac.Parameter(0.0, unit="s", min=0, doc="duration of the rise")
    width = ac.Parameter(0.5, unit="s", min=0, doc="duration at the amplitude")
    falling = ac.Parameter(0.0, unit="s", min=0, doc="duration of the fall")

    def _curve(self, t: Any) -> Any:
        top, fall = self.rising, self.rising + self.width
        end = fall + self.falling
        up = self.amplitude * part_of(t, self.rising)
        down = self.amplitude * part_of(end - t, self.falling)
        falling = ac.where(t < end, down, 0, events=None)
        high = ac.where(t < fall, self.amplitude, falling, events=None)
        return ac.where(t < top, up, high, events=None)
