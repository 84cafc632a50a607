"""Signals from data: tables over time, and samples."""

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any, ClassVar

import numpy as np

import acausal as ac
from acausal.components import icons

from .interfaces import MO, SO
from .interpolation import (
    EXTRAPOLATION,
    SMOOTHNESS,
    SPLINES,
    check_order,
    corners,
    interpolant,
    jumps,
    rows,
)

__modelica__ = "Modelica.Blocks.Sources"


_TIME_EVENTS = ("Always", "AtDiscontinuities", "NoTimeEvents")

_INTERPOLATION = ("linear", "previous", *SPLINES, "band-limited")

_CORNERS = 30
"""Corners of a table with more than these are no events, each of which is a condition; steps end there anyway."""


class TableData(ac.Component):
    """A table that is given by its rows, or lies in a file.

    With ``tableOnFile`` it is read from ``fileName``, when the model is made: a text file with the lines
    ``double tableName(rows,columns)`` before the numbers and ``#1`` at its begin, a file ``.csv`` with ``delimiter``
    after ``nHeaderLines`` lines, or a ``.mat`` file of MATLAB up to version 7.
    """

    ICON = icons.block("data")

    __modelica__ = None

    FORM: ClassVar = ("[[t, y, ...], ...]", (1, 2))
    """How a table is written, and the least shape it has."""

    table = ac.Option(None, doc="rows of the argument and values")
    tableOnFile = ac.Option(False, choices=(False, True), doc="whether the table lies in a file")
    tableName = ac.Option("NoName", doc="name of the table in the file")
    fileName = ac.Option("NoName", doc="path of the file")
    delimiter = ac.Option(",", doc="what separates the numbers in a file .csv")
    nHeaderLines = ac.Option(0, doc="lines at the begin of a file .csv without numbers")
    verboseRead = ac.Option(True, doc="without effect")
    verboseExtrapolation = ac.Option(False, doc="without effect")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        if self.table is not None:
            self._rows()

    def _rows(self) -> np.ndarray:
        table = rows(self)
        check_order(self, table[:, 0], "the first column of table", twice=True)
        return table


class _TimeTable(TableData):
    """What time tables share: ``y = offset`` before ``startTime``, then ``offset`` plus the table.

    The table's first column holds times in units of ``timeScale`` [s], counted from ``shiftTime`` [s]. Steps end at
    jumps and corners. In models with events these are events, if there are no more than 30: those of the first period.
    """

    ICON = icons.TABLE

    timeScale = ac.Parameter(1.0, unit="s", min=0, doc="unit of the table's times")
    startTime = ac.Parameter(0.0, unit="s", doc="the output is the offset before")
    shiftTime = ac.Parameter(lambda self: self.startTime, unit="s", doc="time of the table's zero")
    passed = ac.Variable(when="_has_events", doc="number of jumps and corners that lie behind")

    @property
    def _corners(self) -> Sequence[float]:
        """Times of jumps and corners, in units of the table."""
        return ()

    @property
    def _has_events(self) -> bool:
        return 0 < len(self._corners) <= _CORNERS

    def equations(self) -> Iterator[ac.Eq]:
        if self._has_events:
            since = ac.time - self.shiftTime
            behind = [
                ac.where(since >= corner * self.timeScale, 1, 0, events=None)
                for corner in self._corners
            ]
            yield ac.Eq(self.passed, sum(behind))

    def _equation(self, y: Any, offset: Any, column: Any) -> ac.Eq:
        value = column((ac.time - self.shiftTime) / self.timeScale)
        return ac.Eq(y, offset + ac.where(ac.time < self.startTime, 0, value, events=None))


class TimeTable(SO, _TimeTable):
    """Linear interpolation in rows ``[t, y]``; a repeated time is a jump.

    Outside of its times the table continues through its first and last two points. The values are a module,
    ``column``, among the model's parameters.
    """

    offset = ac.Parameter(0.0, doc="offset of the output")
    column = ac.Module("_column", data=True)

    def _column(self, key: Any) -> ac.Signal:
        return interpolant(self._rows(), "LinearSegments", "LastTwoPoints", "table", key)

    @property
    def _corners(self) -> Sequence[float]:
        return corners(self._rows(), "LinearSegments", "LastTwoPoints")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield self._equation(self.y, self.offset, self.column)


class PartialColumns(TableData):
    """What tables with several columns of values share.

    ``smoothness``: ``LinearSegments``, ``ConstantSegments``, or a cubic Hermite spline: ``ContinuousDerivative``
    (Akima), ``ModifiedContinuousDerivative`` (Akima, modified), and, such that it rises and falls only where the
    table does, ``MonotoneContinuousDerivative1`` (Fritsch and Butland) or ``MonotoneContinuousDerivative2`` (Steffen).
    ``extrapolation``: ``HoldLastPoint``, ``LastTwoPoints`` (of splines, the tangent), ``Periodic``, or
    ``NoExtrapolation``, which holds the last point too (Modelica stops there). ``columns`` counts from 1,
    the column of times or arguments; by default all others are outputs. A repeated time or argument is a
    jump. The values are modules, ``column[i]``, among the model's parameters. `TableData` reads files.
    """

    __modelica__ = None

    columns = ac.Option(None, doc="columns of the table that are outputs, counted from 1")
    smoothness = ac.Option("LinearSegments", choices=tuple(SMOOTHNESS), doc="kind of interpolation")
    extrapolation = ac.Option(
        "LastTwoPoints", choices=tuple(EXTRAPOLATION), doc="what holds outside of the table"
    )

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.column: Any = [
            ac.Module(partial(self._column, i), data=True) for i in range(len(self._columns))
        ]

    @property
    def _columns(self) -> Sequence[int]:
        width = self._rows().shape[1]
        columns = range(2, width + 1) if self.columns is None else [int(c) for c in self.columns]
        for column in columns:
            if not 2 <= column <= width:
                raise ac.DeclarationError(
                    f"columns={self.columns}: the table has columns 2 to {width}"
                )
        return columns

    def _column(self, i: int, key: Any) -> ac.Signal:
        points = self._rows()[:, [0, self._columns[i] - 1]]
        what = f"column {self._columns[i]} of the table"
        return interpolant(points, self.smoothness, self.extrapolation, what, key)


class CombiTimeTable(PartialColumns, MO, _TimeTable):
    """Interpolation in rows ``[t, y2, y3, ...]``: output ``y[i]`` is column ``columns[i]``.

    See `PartialColumns` for the kinds of interpolation and extrapolation.
    """

    ICON = icons.marked(icons.TABLE, "n")

    timeEvents = ac.Option(
        "Always", choices=_TIME_EVENTS, doc="where steps end in models with events"
    )
    offset = ac.Parameter([0.0], shape=":", doc="offsets of the outputs, or one for all")

    @property
    def nout(self) -> int:
        """Number of outputs."""
        return len(self._columns)

    @property
    def _corners(self) -> Sequence[float]:
        if self.timeEvents == "NoTimeEvents":
            return ()
        chosen = self._rows()[:, [0, *(c - 1 for c in self._columns)]]
        if self.timeEvents == "AtDiscontinuities":
            return jumps(chosen)
        return corners(chosen, self.smoothness, self.extrapolation)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        offsets = np.broadcast_to(self.offset, self.nout)
        for y, offset, column in zip(self.y, offsets, self.column, strict=True):
            yield self._equation(y, offset, column)


class SampledSignal(SO):
    """Measured samples as a signal: ``y = signal(time)``.

    Arguments:
        values: the samples. ts: their times [s], or ``dt``: the sample time [s], from ``startTime`` on.
        interpolation: ``"linear"``, ``"previous"`` (each sample holds until the next), ``"cubic"``,
            ``"band-limited"``, or another of `acausal.Signal`.
        extrapolation: ``"hold"``, ``"linear"`` or ``"periodic"``.

    The samples are a module, ``signal``, among the model's parameters.
    """

    ICON = icons.SAMPLES

    __modelica__ = None

    values = ac.Option(None, doc="samples")
    ts = ac.Option(None, doc="times of the samples")
    dt = ac.Option(None, doc="sample time, instead of ts")
    startTime = ac.Option(0.0, doc="time of the first sample, with dt")
    interpolation = ac.Option("linear", choices=_INTERPOLATION)
    extrapolation = ac.Option("hold", choices=("hold", "linear", "periodic"))
    signal = ac.Module("_signal", data=True)

    def _signal(self, key: Any) -> ac.Signal:
        if self.values is None or (self.ts is None) == (self.dt is None):
            raise ac.DeclarationError(
                "SampledSignal needs values=[...] and either ts=[...] or dt=..."
            )
        if self.ts is None:
            ts = self.startTime + self.dt * np.arange(len(self.values))
        else:
            ts = np.asarray(self.ts, dtype=float)
        return ac.Signal(ts, self.values, self.interpolation, self.extrapolation, name="values")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.signal(ac.time))
