"""Conversions between real, integer and truth signals, which are all real numbers here."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .conventions import TRUE, truth
from .interfaces import SISO

__modelica__ = "Modelica.Blocks.Math"


class RealToInteger(SISO):
    """The nearest integer; halves are rounded away from zero."""

    ICON = icons.integers(icons.block("R → I"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        up, down = (ac.floor(0.5 + u, events=None) for u in (self.u, -self.u))
        rounded = ac.where(self.u > 0, up, -down)
        yield ac.Eq(self.y, rounded)


class IntegerToReal(SISO):
    """``y = u``."""

    ICON = icons.integers(icons.block("I → R"), "u")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.u)


class BooleanToReal(SISO):
    """``realTrue`` where ``u`` is true, else ``realFalse``."""

    ICON = icons.truths(icons.block("B → R"), "u")

    realTrue = ac.Parameter(1.0, doc="output where the input is true")
    realFalse = ac.Parameter(0.0, doc="output where the input is false")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.where(self.u > TRUE, self.realTrue, self.realFalse))


class BooleanToInteger(SISO):
    """``integerTrue`` where ``u`` is true, else ``integerFalse``."""

    ICON = icons.truths(icons.block("B → I"), "u")

    integerTrue = ac.Parameter(1.0, doc="output where the input is true")
    integerFalse = ac.Parameter(0.0, doc="output where the input is false")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.where(self.u > TRUE, self.integerTrue, self.integerFalse))


class RealToBoolean(SISO):
    """1 where ``u >= threshold``, else 0."""

    ICON = icons.truths(icons.block("R → B"), "y")

    threshold = ac.Parameter(0.5, doc="value from which on the output is true")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u >= self.threshold, events=None))


class IntegerToBoolean(SISO):
    """1 where ``u >= threshold``, else 0."""

    ICON = icons.truths(icons.block("I → B"), "y")

    threshold = ac.Parameter(1.0, doc="value from which on the output is true")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u >= self.threshold))
