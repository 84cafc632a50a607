"""Sources of truth values, 1 or 0, and of integers."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

import acausal as ac
from acausal.components import icons

from .conventions import SMALL, TRUE, changes, discrete_output, period_at, rises, truth, truth_of
from .interfaces import SO
from .interpolation import EXTRAPOLATION

__modelica__ = "Modelica.Blocks.Sources"


_ALWAYS = -1e60
"""Time that lies before all others."""


class BooleanConstant(SO):
    """``k`` at all times."""

    ICON = icons.truths(icons.CONSTANT, "y")

    k = ac.Option(True, doc="constant truth value")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, int(self.k))


class IntegerConstant(SO):
    """``y = k``, an integer."""

    ICON = icons.integers(icons.CONSTANT, "y")

    k = ac.Parameter(doc="constant value")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.k)


class BooleanStep(SO):
    """``startValue`` before ``startTime`` [s], then the opposite."""

    ICON = icons.truths(icons.STEP, "y")

    startTime = ac.Parameter(0.0, unit="s", doc="time of the step")
    startValue = ac.Option(False, doc="truth value before")

    def equations(self) -> Iterator[ac.Eq]:
        before, after = int(self.startValue), int(not self.startValue)
        yield ac.Eq(self.y, ac.where(ac.time < self.startTime, before, after, events=None))


class IntegerStep(SO):
    """``y = offset`` before ``startTime`` [s], then ``offset + height``."""

    ICON = icons.integers(icons.STEP, "y")

    height = ac.Parameter(1.0, doc="height of the step")
    offset = ac.Parameter(0.0, doc="offset of the output")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Iterator[ac.Eq]:
        rise = ac.where(ac.time < self.startTime, 0, self.height, events=None)
        yield ac.Eq(self.y, self.offset + rise)


class BooleanPulse(SO):
    """True during the first ``width`` percent of every period from ``startTime`` [s] on."""

    ICON = icons.truths(icons.PULSE, "y")

    width = ac.Parameter(50.0, min=0, max=100, doc="width of a pulse in percent of the period")
    period = ac.Parameter(unit="s", min=SMALL, doc="duration of a period")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the first pulse")

    def equations(self) -> Iterator[ac.Eq]:
        elapsed = period_at(self.startTime, self.period).elapsed
        on = (ac.time >= self.startTime) & (elapsed < self.period * self.width / 100)
        yield ac.Eq(self.y, truth(on, events=None))


class BooleanExpression(SO):
    """A number or an expression of `acausal.time`, 1 or 0: ``BooleanExpression(y=1)``."""

    ICON = icons.truths(icons.EXPRESSION, "y")

    def __init__(self, *, y: Any = None, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.expression = int(y) if isinstance(y, bool) else y

    def equations(self) -> Iterator[ac.Eq]:
        if self.expression is not None:
            yield ac.Eq(self.y, self.expression)


class IntegerExpression(BooleanExpression):
    """A number or an expression of `acausal.time` whose values are integers."""

    ICON = icons.integers(icons.EXPRESSION, "y")


class _Table(SO):
    """What tables of steps share: a value holds from its time on, beginning at ``startTime`` [s].

    The times are counted from ``shiftTime`` [s].
    """

    ICON = icons.TABLE

    extrapolation = ac.Option(
        "HoldLastPoint", choices=tuple(EXTRAPOLATION), doc="what holds outside of the table"
    )
    startTime = ac.Parameter(_ALWAYS, unit="s", doc="the output is 0 before")
    shiftTime = ac.Parameter(0.0, unit="s", doc="time of the table's zero")

    def _steps(self) -> tuple[float, Sequence[tuple[float, float]]]:
        """The value before all times, and times with the values from them on."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        first, steps = self._steps()
        if any(later[0] <= earlier[0] for earlier, later in pairwise(steps)):
            raise ac.DeclarationError(
                f"{type(self).__name__}: the times in table={self.table!r} must ascend"
            )
        t: Any = ac.time - self.shiftTime
        if self.extrapolation == "Periodic" and len(steps) > 1:
            (begin, first), (end, _) = steps[0], steps[-1]
            t = begin + period_at(self.shiftTime + begin, end - begin).elapsed
        value: Any = first
        for (time, after), before in zip(steps, (first, *(v for _, v in steps)), strict=False):
            if after != before:
                value = value + ac.where(t >= time, after - before, 0, events=None)
        yield ac.Eq(self.y, ac.where(ac.time < self.startTime, 0, value, events=None))


class BooleanTable(_Table):
    """``startValue``, which turns into its opposite at every time of ``table`` [s]."""

    ICON = icons.truths(icons.TABLE, "y")

    table = ac.Option((0.0, 1.0), doc="times at which the output changes")
    startValue = ac.Option(False, doc="truth value before the first time")

    def _steps(self) -> tuple[float, Sequence[tuple[float, float]]]:
        times = np.asarray(self.table, dtype=float)
        if times.ndim != 1:
            raise ac.DeclarationError(f"BooleanTable needs table=[t, ...], got {self.table!r}")
        first = int(self.startValue)
        return first, [(float(t), (first + i + 1) % 2) for i, t in enumerate(times)]


class IntegerTable(_Table):
    """Steps: from each time [s] in ``table``'s rows ``[t, y]`` on the value beside it."""

    ICON = icons.integers(icons.TABLE, "y")

    table = ac.Option(None, doc="rows of time and value")

    def _steps(self) -> tuple[float, Sequence[tuple[float, float]]]:
        if self.table is None or np.ndim(self.table) != 2 or np.shape(self.table)[1] != 2:
            raise ac.DeclarationError(f"IntegerTable needs table=[[t, y], ...], got {self.table!r}")
        rows = np.asarray(self.table, dtype=float).tolist()
        return rows[0][1], [(t, y) for t, y in rows]


class SampleTrigger(SO):
    """True at ``startTime + k period`` [s], k = 0, 1, ..., and false otherwise."""

    ICON = icons.truths(icons.SPIKES, "y")

    period = ac.Parameter(unit="s", min=SMALL, doc="sample period, greater than zero")
    startTime = ac.Parameter(0.0, unit="s", doc="first sample time")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.sample(self.startTime, self.period))


class RadioButtonSource(ac.Component):
    """A button: ``on`` turns true at every time of ``buttonTimeTable`` [s], false where one in ``reset`` turns true.

    Where both happen at once, it is on. ``reset`` is a list of truth values, or equations of the enclosing model state
    its ``nReset`` elements, such as the ``on`` of other buttons.
    """

    ICON = icons.block("on")

    nReset = ac.Option(1, doc="number of elements of reset")
    reset = ac.Variable(shape="nReset", doc="truth values that turn the button off")

    buttonTimeTable = ac.Option((0.0, 1.0), doc="times at which the button is pressed")
    on = discrete_output(kind="bool", doc="whether the button is on, 1 or 0")
    resetting = ac.Discrete(
        kind="bool", shape="nReset", doc="whether an expression in reset is true"
    )
    pre_reset = ac.Discrete(kind="bool", shape="nReset", doc="whether it was so just before")
    pressed = ac.Discrete(kind="bool", doc="changes where the button is pressed")

    def __init__(self, *, reset: Sequence[Any] | None = None, **modifiers: Any) -> None:
        super().__init__(**({} if reset is None else {"nReset": len(reset)}) | modifiers)
        self.given = reset
        self.table = BooleanTable(table=self.buttonTimeTable)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.pressed, truth(self.table.y > TRUE))
        for resetting, before, reset in zip(
            self.resetting, self.pre_reset, self.reset, strict=True
        ):
            yield ac.Eq(resetting, truth(reset > TRUE))
            yield ac.Eq(before, ac.pre(resetting))
        for reset, given in zip(self.reset, self.given or (), strict=False):
            yield ac.Eq(reset, truth_of(given))
        on = ac.pre(self.on)
        for before in self.pre_reset:
            on = ac.where(rises(before), 0, on)
        yield ac.Eq(self.on, ac.where(changes(self.pressed), 1, on))
