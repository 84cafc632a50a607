"""Sources of digital signals; steps end where they change."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .logic import LOGIC, ONE, ZERO, DigitalOutput, signal

__modelica__ = "Modelica.Electrical.Digital.Sources"


class Set(ac.Component):
    """``x`` at all times."""

    ICON = icons.CONSTANT

    x = ac.Option("'1'", choices=LOGIC, doc="value")
    y = DigitalOutput(doc="output")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, signal(self.x))


class Step(ac.Component):
    """``before`` until ``stepTime`` [s], then ``after``."""

    ICON = icons.STEP

    before = ac.Option("'0'", choices=LOGIC, doc="value before the step")
    after = ac.Option("'1'", choices=LOGIC, doc="value after the step")
    stepTime = ac.Parameter(1.0, unit="s", doc="time of the step")
    y = DigitalOutput(doc="output")

    def equations(self) -> Iterator[ac.Eq]:
        after = ac.time >= self.stepTime
        y = ac.where(after, signal(self.after), signal(self.before), events=True)
        yield ac.Eq(self.y, y)


class Table(ac.Component):
    """``y0``, from each time [s] of ``t`` on the value of ``x`` beside it."""

    ICON = icons.TABLE

    x = ac.Option(("'1'",), doc="values")
    t = ac.Option((1.0,), doc="times from which they hold, ascending")
    y0 = ac.Option("'U'", choices=LOGIC, doc="value before the first time")
    y = DigitalOutput(doc="output")

    def equations(self) -> Iterator[ac.Eq]:
        if len(self.x) != len(self.t):
            raise ac.DeclarationError(
                f"Table has {len(self.x)} values x, but {len(self.t)} times t"
            )
        y: Any = signal(self.y0)
        for time, value in zip(self.t, self.x, strict=True):
            y = ac.where(ac.time >= float(time), signal(value), y, events=True)
        yield ac.Eq(self.y, y)


class Pulse(ac.Component):
    """``pulse`` during the first ``width`` percent of each period from ``startTime`` [s] on, else ``quiet``.

    ``T0`` is where the present period began, ``np`` the number of the periods, if it is limited: after
    ``nperiod`` of them (if it is not negative) the output is ``quiet``.
    """

    ICON = icons.PULSE

    width = ac.Parameter(50.0, min=0, max=100, doc="width of a pulse in percent of the period")
    period = ac.Parameter(1.0, unit="s", min=0, doc="duration of a period")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the first pulse")
    pulse = ac.Option("'0'", choices=LOGIC, doc="value during a pulse")
    quiet = ac.Option("'1'", choices=LOGIC, doc="value between pulses")
    nperiod = ac.Parameter(-1.0, doc="number of periods; without limit if negative")
    T0 = ac.Discrete("startTime", unit="s", doc="start of the present period")
    np = ac.Discrete(0, kind="int", doc="number of periods begun, if they are limited")
    sampling = ac.Discrete(False, kind="bool", doc="1 while there are pulses")
    y = DigitalOutput(doc="output")

    def equations(self) -> Iterator[Any]:
        some, limited = abs(self.nperiod) > 0.5, self.nperiod > 0.5
        more = self.nperiod > ac.pre(self.np) - 0.5
        yield ac.Eq(self.sampling, ac.where(some & (~limited | more), 1, 0))
        yield ac.When(
            (self.sampling > 0.5) & (ac.sample(self.startTime, self.period) > 0.5),
            ac.Eq(self.T0, ac.time),
            ac.Eq(self.np, ac.pre(self.np) + ac.where(limited, 1, 0)),
        )
        end = self.T0 + self.width * self.period / 100
        on = (self.sampling > 0.5) & (ac.time >= self.startTime) & (ac.time < end)
        yield ac.Eq(self.y, ac.where(on, signal(self.pulse), signal(self.quiet), events=True))


class Clock(ac.Component):
    """1 during the first ``width`` percent of each period from ``startTime`` [s] on, else 0."""

    ICON = icons.SPIKES

    startTime = ac.Parameter(0.0, unit="s", doc="time of the first pulse")
    period = ac.Parameter(1.0, unit="s", min=0, doc="duration of a period")
    width = ac.Parameter(50.0, min=0, max=100, doc="width of a pulse in percent of the period")
    t_i = ac.Discrete("startTime", unit="s", doc="start of the present period")
    y = DigitalOutput(doc="output")

    def equations(self) -> Iterator[Any]:
        yield ac.When(ac.sample(self.startTime, self.period), ac.Eq(self.t_i, ac.time))
        end = self.t_i + self.period * self.width / 100
        on = (ac.time >= self.startTime) & (ac.time < end)
        yield ac.Eq(self.y, ac.where(on, ONE, ZERO, events=True))
