"""Logical blocks that remember: edges, hysteresis, timers, delays, a flip-flop."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import CROSSED, INSTANT, TRUE, changes, discrete_output, truth, truth_of
from .interfaces import SISO
from .logical import Nor

__modelica__ = "Modelica.Blocks.Logical"


class _Remembering(SISO):
    """What blocks share that know their input just before an event."""

    pre_u_start = ac.Option(False, doc="truth value of the input just before the start")
    held = ac.Discrete("pre_u_start", kind="bool", doc="whether the input is true")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.held, truth(self.u > TRUE))


class Pre(_Remembering):
    """The input just before an event, ``pre(u)``: it breaks loops of logical blocks."""

    ICON = icons.truths(icons.block("pre"), "u y")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Eq(self.y, ac.pre(self.held))


class Edge(_Remembering):
    """True at the moment the input turns true."""

    ICON = icons.truths(icons.block("↑"), "u y")

    __modelica__ = ("Modelica.Blocks.Logical", "Modelica.Blocks.Math")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Eq(self.y, truth(ac.edge(self.held)))


class FallingEdge(_Remembering):
    """True at the moment the input turns false."""

    ICON = icons.truths(icons.block("↓"), "u y")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Eq(self.y, truth((self.held <= TRUE) & (ac.pre(self.held) > TRUE)))


class Change(_Remembering):
    """True at the moment the input changes."""

    ICON = icons.truths(icons.block("↕"), "u y")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Eq(self.y, truth(ac.change(self.held)))


class BooleanChange(Change):
    """True at the moment the input changes."""

    ICON = icons.truths(icons.block("change"), "u y")

    __modelica__ = "Modelica.Blocks.Math"


class IntegerChange(SISO):
    """True at the moment the input, an integer, changes."""

    ICON = icons.truths(icons.block("Δi"), "y")

    __modelica__ = "Modelica.Blocks.Math"

    held = ac.Discrete(kind="int", doc="the input")

    def equations(self) -> Iterator[Any]:
        nearest = ac.floor(self.u + 0.5, events=True)
        yield ac.Eq(self.held, nearest)
        yield ac.Eq(self.y, truth(ac.change(self.held)))


class ZeroCrossing(SISO):
    """True at the moment the input crosses zero while ``enable`` is true, unless that changes just then."""

    ICON = icons.truths(icons.CROSSING, "y enable")

    enable = ac.Input(doc="whether crossings are looked for")
    enabled = ac.Discrete(kind="bool", doc="whether enable is true")
    u_pos = ac.Discrete(kind="bool", doc="whether the input is positive or zero, and enabled")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.enabled, truth(self.enable > TRUE))
        yield ac.Eq(self.u_pos, truth((self.enabled > TRUE) & (self.u >= 0)))
        yield ac.Eq(self.y, truth(ac.change(self.u_pos) & ~ac.change(self.enabled)))


class _TwoPoint(ac.Component):
    """What blocks share whose output switches on at one level and off at another."""

    ICON = icons.HYSTERESIS

    pre_y_start = ac.Option(False, doc="truth value of the output just before the start")
    y = discrete_output("pre_y_start", kind="bool", doc="output signal, 1 or 0")

    def _switched(self, on: Any, stays: Any) -> ac.Eq:
        """On where a condition holds; once on, it stays so as long as another does."""
        was = ac.pre(self.y) > TRUE
        return ac.Eq(self.y, truth((~was & on) | (was & stays)))


class Hysteresis(_TwoPoint):
    """Switches on where ``u > uHigh`` and off where ``u < uLow``."""

    uLow = ac.Parameter(doc="off below this")
    uHigh = ac.Parameter(doc="on above this; greater than uLow")
    u = ac.Input(doc="input signal")

    def equations(self) -> Iterator[Any]:
        yield ac.Assert(self.uLow <= self.uHigh, CROSSED)
        yield self._switched(self.u > self.uHigh, self.u >= self.uLow)


class OnOffController(_TwoPoint):
    """On where ``u`` falls below ``reference - bandwidth/2``, off where it rises above ``reference + bandwidth/2``."""

    ICON = icons.marked(icons.HYSTERESIS, "r")

    bandwidth = ac.Parameter(doc="distance of the two levels")
    reference = ac.Input(doc="set point")
    u = ac.Input(doc="measurement")

    def equations(self) -> Iterator[Any]:
        below = self.u < self.reference - self.bandwidth / 2
        within = self.u < self.reference + self.bandwidth / 2
        yield self._switched(below, within | below)


class TriggeredTrapezoid(ac.Component):
    """Rises to ``offset + amplitude`` during ``rising`` [s] where ``u`` turns true, and back during ``falling`` [s].

    An edge before the end of the rise or fall starts from the value reached.
    """

    ICON = icons.truths(icons.marked(icons.TRAPEZOID, "trig"), "u")

    amplitude = ac.Parameter(1.0, doc="height of the trapezoid")
    rising = ac.Parameter(0.0, unit="s", min=0, doc="duration of the rise")
    falling = ac.Parameter(lambda self: self.rising, unit="s", min=0, doc="duration of the fall")
    offset = ac.Parameter(0.0, doc="offset of the output")
    u = ac.Input(doc="whether the output is high, 1 or 0")
    y = ac.Output(doc="output signal")
    held = ac.Discrete(kind="bool", doc="whether the input is true")
    endValue = ac.Discrete(doc="output at the end of the present rise or fall")
    rate = ac.Discrete(doc="slope of the present rise or fall")
    T = ac.Discrete(unit="s", doc="end of the present rise or fall")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.held, truth(self.u > TRUE))
        ramp = self.endValue - (self.T - ac.time) * self.rate
        yield ac.Eq(self.y, ac.where(ac.time < self.T, ramp, self.endValue, events=True))
        up, first = self.held > TRUE, ac.initial() > TRUE
        new = first | changes(self.held)
        end = ac.where(up, self.offset + self.amplitude, self.offset)
        rate = ac.where(
            up & (self.rising > 0),
            self.amplitude / ac.maximum(self.rising, INSTANT),
            ac.where(
                ~up & (self.falling > 0), -self.amplitude / ac.maximum(self.falling, INSTANT), 0
            ),
        )
        sudden = (
            (up & (self.rising <= 0)) | (~up & (self.falling <= 0)) | ~(ac.Abs(self.amplitude) > 0)
        )
        slope = ac.where(ac.Abs(self.rate) > 0, self.rate, 1)
        reached = ac.time + (self.endValue - ac.pre(self.y)) / slope
        for variable, value in (
            (self.endValue, end),
            (self.rate, rate),
            (self.T, ac.where(first | sudden, ac.time, reached)),
        ):
            yield ac.Eq(variable, ac.where(new, value, ac.pre(variable)))


class Timer(SISO):
    """The time since the input turned true, 0 while it is false."""

    ICON = icons.truths(icons.block("timer"), "u")

    entryTime = ac.Discrete(unit="s", doc="when the input turned true")
    y = ac.Output(unit="s", doc="time since then")

    def equations(self) -> Iterator[Any]:
        yield ac.When(self.u > TRUE, ac.Eq(self.entryTime, ac.time))
        yield ac.Eq(self.y, ac.where(self.u > TRUE, ac.time - self.entryTime, 0))


class LogicalDelay(ac.Component):
    """The input with a delay: ``y1`` turns false, ``y2`` true only ``delayTime`` [s] after it."""

    ICON = icons.truths(icons.block("t"), "u y1 y2")

    delayTime = ac.Parameter(0.0, unit="s", min=0, doc="delay")
    u = ac.Input(doc="input signal")
    y1 = ac.Output(doc="turns true at once, false after the delay")
    y2 = ac.Output(doc="turns true after the delay, false at once")
    held = ac.Discrete(kind="bool", doc="whether the input is true")
    tSwitch = ac.Discrete(unit="s", doc="when the input changed last")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.held, truth(self.u > TRUE))
        since = ac.where(changes(self.held), ac.time, ac.pre(self.tSwitch))
        start = ac.time - 2 * self.delayTime
        yield ac.Eq(self.tSwitch, ac.where(ac.initial(), start, since))
        late = ac.time >= self.tSwitch + self.delayTime
        on = self.held > TRUE
        yield ac.Eq(self.y1, truth(on | ~late, events=True))
        yield ac.Eq(self.y2, truth(on & late, events=True))


class RSFlipFlop(ac.Component):
    """Memory: ``Q`` turns true where ``S`` is, false where ``R`` is; ``QI`` is its opposite."""

    ICON = icons.truths(icons.block("RS"), "S R Q QI")

    Qini = ac.Option(False, doc="truth value of Q at the start")
    S = ac.Input(doc="sets")
    R = ac.Input(doc="resets")
    Q = ac.Output(doc="what is remembered")
    QI = ac.Output(doc="its opposite")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.nor, self.nor1 = Nor(), Nor()
        self.pre = Pre(pre_u_start=not self.Qini)
        self.connect(self.nor1.y, self.nor.u2)
        self.connect(self.nor1.y, self.Q)
        self.connect(self.nor.y, self.pre.u)
        self.connect(self.pre.y, self.nor1.u1)
        self.connect(self.pre.y, self.QI)
        self.connect(self.S, self.nor.u1)
        self.connect(self.R, self.nor1.u2)


class TerminateSimulation(ac.Component):
    """Tells that a condition has come true: ``terminated`` is 1 from then on.

    A simulation goes on to its end (Modelica's stops): cut the result there. ``condition`` is an expression, or
    stated by an equation of the enclosing model.
    """

    ICON = icons.truths(icons.block("stop"), "u")

    terminationText = ac.Option("... End condition reached", doc="without effect")
    condition = ac.Output(doc="when the simulation should end, 1 or 0")
    terminated = ac.Discrete(kind="bool", doc="whether the condition has come true")

    def __init__(self, *, condition: Any = None, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.expression = condition

    def equations(self) -> Iterator[Any]:
        if self.expression is not None:
            yield ac.Eq(self.condition, truth_of(self.expression))
        yield ac.When(self.condition > TRUE, ac.Eq(self.terminated, 1))


class AssertCondition(ac.Component):
    """Tells that its input has been false: ``failed`` is 1 from then on.

    A simulation goes on (Modelica's stops, or warns): look at ``failed`` where ``message`` matters to you.
    """

    ICON = icons.block("!")

    message = ac.Option("Assert block failed", doc="what it means if the input is false")
    assertionLevel = ac.Option("error", choices=("error", "warning"), doc="without effect")
    u = ac.Input(doc="what should be true, 1 or 0")
    failed = ac.Discrete(kind="bool", doc="whether the input has been false")

    def equations(self) -> Iterator[Any]:
        wrong = ac.maximum(ac.pre(self.failed), truth(self.u <= TRUE))
        yield ac.Eq(self.failed, wrong)
