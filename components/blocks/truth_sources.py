"""Sources of truth values, 1 or 0, and of integers."""

from collections.abc import Iterator
from typing import Any

import numpy as np

import acausal as ac

from .conventions import truth
from .interfaces import SO
from .interpolation import EXTRAPOLATION, interpolant

__modelica__ = "Modelica.Blocks.Sources"


_ALWAYS = -1e60
"""Time that lies before all others."""


class BooleanConstant(SO):
    """``k`` at all times."""

    k = ac.Option(True, doc="constant truth value")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, int(self.k))


class IntegerConstant(SO):
    """``y = k``, an integer."""

    k = ac.Parameter(doc="constant value")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.k)


class BooleanStep(SO):
    """``startValue`` before ``startTime`` [s], then the opposite."""

    startTime = ac.Parameter(0.0, unit="s", doc="time of the step")
    startValue = ac.Option(False, doc="truth value before")

    def equations(self) -> Iterator[ac.Eq]:
        before, after = int(self.startValue), int(not self.startValue)
        yield ac.Eq(self.y, ac.where(ac.time < self.startTime, before, after))


class IntegerStep(SO):
    """``y = offset`` before ``startTime`` [s], then ``offset + height``."""

    height = ac.Parameter(1.0, doc="height of the step")
    offset = ac.Parameter(0.0, doc="offset of the output")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.offset + ac.where(ac.time < self.startTime, 0, self.height))


class BooleanPulse(SO):
    """True during the first ``width`` percent of every period from ``startTime`` [s] on."""

    width = ac.Parameter(50.0, min=0, max=100, doc="width of a pulse in percent of the period")
    period = ac.Parameter(unit="s", min=0, doc="duration of a period")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the first pulse")

    def equations(self) -> Iterator[ac.Eq]:
        periods = (ac.time - self.startTime) / self.period
        phase = periods - ac.floor(periods)
        on = (ac.time >= self.startTime) & (phase < self.width / 100)
        yield ac.Eq(self.y, truth(on))


class BooleanExpression(SO):
    """A number or an expression of `acausal.time`, 1 or 0: ``BooleanExpression(y=1)``."""

    def __init__(self, *, y: Any = None, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.expression = int(y) if isinstance(y, bool) else y

    def equations(self) -> Iterator[ac.Eq]:
        if self.expression is not None:
            yield ac.Eq(self.y, self.expression)


class IntegerExpression(BooleanExpression):
    """A number or an expression of `acausal.time` whose values are integers."""


class _Table(SO):
    """What tables of steps share: the value holds from its time on, beginning at ``startTime`` [s].

    The times are counted from ``shiftTime`` [s]. The values are a module, ``column``, among the
    model's parameters.
    """

    extrapolation = ac.Option(
        "HoldLastPoint", choices=tuple(EXTRAPOLATION), doc="what holds outside of the table"
    )
    startTime = ac.Parameter(_ALWAYS, unit="s", doc="the output is 0 before")
    shiftTime = ac.Parameter(0.0, unit="s", doc="time of the table's zero")
    column = ac.Module("_column")

    def _points(self) -> np.ndarray:
        """Rows of time and value."""
        raise NotImplementedError

    def _column(self, key: Any) -> ac.Signal:
        return interpolant(self._points(), "ConstantSegments", self.extrapolation, "table", key)

    def equations(self) -> Iterator[ac.Eq]:
        value = self.column(ac.time - self.shiftTime)
        yield ac.Eq(self.y, ac.where(ac.time < self.startTime, 0, value))


class BooleanTable(_Table):
    """``startValue``, which turns into its opposite at every time of ``table`` [s]."""

    table = ac.Option((0.0, 1.0), doc="times at which the output changes")
    startValue = ac.Option(False, doc="truth value before the first time")

    def _points(self) -> np.ndarray:
        times = np.asarray(self.table, dtype=float)
        if times.ndim != 1 or len(times) == 0:
            raise ac.DeclarationError(f"BooleanTable needs table=[t, ...], got {self.table!r}")
        values = (int(self.startValue) + np.arange(len(times) + 1)) % 2
        return np.stack([[np.nextafter(times[0], -np.inf), *times], values], axis=1)


class IntegerTable(_Table):
    """Steps: from each time [s] in ``table``'s rows ``[t, y]`` on the value beside it."""

    table = ac.Option(None, doc="rows of time and value")

    def _points(self) -> np.ndarray:
        if self.table is None or np.ndim(self.table) != 2 or np.shape(self.table)[1] != 2:
            raise ac.DeclarationError(f"IntegerTable needs table=[[t, y], ...], got {self.table!r}")
        return np.asarray(self.table, dtype=float)
