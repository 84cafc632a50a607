"""Signal sources; waves, periodic ones, motions and tables come from their own modules."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import SMALL, part_of
from .interfaces import SO, SignalSource

__modelica__ = "Modelica.Blocks.Sources"


class RealExpression(SO):
    """A number or an expression of `acausal.time`: ``RealExpression(y=2 * ac.sin(ac.time))``.

    To read another component's variable, state an equation for ``y`` in the enclosing model's
    `equations` instead and give no expression.
    """

    ICON = icons.EXPRESSION

    def __init__(self, *, y: Any = None, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.expression = y

    def equations(self) -> Iterator[ac.Eq]:
        if self.expression is not None:
            yield ac.Eq(self.y, self.expression)


class Constant(SO):
    """``y = k``."""

    ICON = icons.CONSTANT

    k = ac.Parameter(doc="constant output")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.k)


class ContinuousClock(SignalSource):
    """The time since ``startTime``: ``y = offset + max(time - startTime, 0)``."""

    ICON = icons.CLOCK

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.offset + ac.maximum(ac.time - self.startTime, 0))


class Step(SignalSource):
    """``y = offset``, from ``startTime`` on ``y = offset + height``."""

    ICON = icons.STEP

    height = ac.Parameter(1.0, doc="height of the step")

    def equations(self) -> Iterator[ac.Eq]:
        before = ac.time < self.startTime
        yield ac.Eq(self.y, self.offset + ac.where(before, 0, self.height, events=None))


class Ramp(SignalSource):
    """``y`` rises by ``height`` during ``duration`` [s] and stays there."""

    ICON = icons.RAMP

    height = ac.Parameter(1.0, doc="height of the ramp")
    duration = ac.Parameter(unit="s", min=0, doc="duration of the ramp; 0 gives a step")

    def equations(self) -> Iterator[ac.Eq]:
        t = ac.time - self.startTime
        rise = self.height * part_of(t, self.duration)
        risen = ac.where(t < self.duration, rise, self.height, events=None)
        ramp = ac.where(t < 0, 0, risen, events=None)
        yield ac.Eq(self.y, self.offset + ramp)


class LogFrequencySweep(SO):
    """From ``wMin`` to ``wMax`` during ``duration`` [s], with a logarithm that is linear in time."""

    ICON = icons.CHIRP

    wMin = ac.Parameter(min=0, doc="start frequency")
    wMax = ac.Parameter(min=0, doc="end frequency")
    startTime = ac.Parameter(0.0, unit="s", doc="start of the sweep")
    duration = ac.Parameter(unit="s", min=0, doc="duration of the sweep; 0 gives a step")

    def equations(self) -> Iterator[ac.Eq]:
        share = part_of(ac.time - self.startTime, self.duration)
        low, high = (ac.log(ac.maximum(w, SMALL)) for w in (self.wMin, self.wMax))
        yield ac.Eq(self.y, ac.exp(low + (high - low) * share))
