"""Delays of digital signals: a change that does not last is not passed on."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .logic import LOGIC, DigitalInput, DigitalOutput, is_one, is_zero, signal

__modelica__ = "Modelica.Electrical.Digital.Delay"


class _Inertial(ac.Component):
    """What inertial delays share: ``y`` follows ``x`` when that has kept its value for as long as the delay.

    ``y0`` is the output before the start. ``t_next`` [s] is when the next change is due.
    """

    y0 = ac.Option("'U'", choices=LOGIC, doc="output before the start")
    x = DigitalInput(doc="input")
    y = DigitalOutput(doc="output")
    held = ac.Discrete("_before", kind="int", doc="the input")
    passed = ac.Discrete("_before", kind="int", doc="the output")
    t_next = ac.Discrete(unit="s", doc="when the next change is due")

    @property
    def _before(self) -> int:
        return signal(self.y0)

    def _delay(self) -> Any:
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq | ac.When]:
        delay = self._delay()
        now = ac.where(delay > 0, ac.pre(self.passed), self.held)
        yield ac.Eq(self.held, self.x)
        yield ac.When(
            (ac.initial(), ac.change(self.held)),
            ac.Eq(self.t_next, ac.time + delay),
            ac.Eq(self.passed, now),
            otherwise=ac.When(ac.time >= self.t_next, ac.Eq(self.passed, self.held)),
        )
        yield ac.Eq(self.y, self.passed)


class InertialDelay(_Inertial):
    """``y`` is ``x`` once that has kept its value for ``delayTime`` [s]."""

    ICON = icons.block("t ≥")

    delayTime = ac.Parameter(0.0, unit="s", min=0, doc="delay")

    def _delay(self) -> Any:
        return self.delayTime


class InertialDelaySensitive(_Inertial):
    """``y`` is ``x`` once that has kept its value for the delay of this change.

    It is ``tLH`` [s] for changes that rise: to 1 from what is not 1, and from 0 to what is neither. It is ``tHL`` [s]
    for those that fall. All others pass at once; weak values count as strong ones.
    """

    ICON = icons.block("t ≥ ↑↓")

    tLH = ac.Parameter(0.0, unit="s", min=0, doc="delay of rising changes")
    tHL = ac.Parameter(0.0, unit="s", min=0, doc="delay of falling changes")

    def _delay(self) -> Any:
        before, after = (
            ac.where(is_one(v), 1, ac.where(is_zero(v), -1, 0))
            for v in (ac.pre(self.passed), self.held)
        )
        falls = ac.where(after < before, self.tHL, 0)
        return ac.where(after > before, self.tLH, falls)
