"""Truth values: comparisons, logical operations and switches.

A truth value is a real signal, 1 or 0; what comes in counts as true above 0.5. Comparisons are events in models that
have others. Blocks that remember, such as a hysteresis, are in `acausal.components.blocks.memory`.
"""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import TRUE, truth
from .interfaces import SI2SO, SISO

__modelica__ = "Modelica.Blocks.Logical"


class _Operation(SI2SO):
    """A logical operation on ``u1`` and ``u2``."""

    def operation(self, first: Any, second: Any) -> Any:
        """The result, a condition, for two conditions."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.operation(self.u1 > TRUE, self.u2 > TRUE)))


class And(_Operation):
    """1 where ``u1`` and ``u2`` are true."""

    ICON = icons.truths(icons.block("and"), "u1 u2 y")

    def operation(self, first: Any, second: Any) -> Any:
        return first & second


class Or(_Operation):
    """1 where ``u1`` or ``u2`` is true, or both."""

    ICON = icons.truths(icons.block("or"), "u1 u2 y")

    def operation(self, first: Any, second: Any) -> Any:
        return first | second


class Xor(_Operation):
    """1 where either ``u1`` or ``u2`` is true, not both."""

    ICON = icons.truths(icons.block("xor"), "u1 u2 y")

    def operation(self, first: Any, second: Any) -> Any:
        return (first & ~second) | (~first & second)


class Nor(_Operation):
    """1 where neither ``u1`` nor ``u2`` is true."""

    ICON = icons.truths(icons.block("nor"), "u1 u2 y")

    def operation(self, first: Any, second: Any) -> Any:
        return ~(first | second)


class Nand(_Operation):
    """1 unless ``u1`` and ``u2`` are true."""

    ICON = icons.truths(icons.block("nand"), "u1 u2 y")

    def operation(self, first: Any, second: Any) -> Any:
        return ~(first & second)


class Not(SISO):
    """1 where ``u`` is false."""

    ICON = icons.truths(icons.block("not"), "u y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u <= TRUE))


class _Threshold(SISO):
    """A comparison of ``u`` with a number."""

    threshold = ac.Parameter(0.0, doc="value to compare with")


class GreaterThreshold(_Threshold):
    """1 where ``u > threshold``."""

    ICON = icons.truths(icons.block("> k"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u > self.threshold, events=None))


class GreaterEqualThreshold(_Threshold):
    """1 where ``u >= threshold``."""

    ICON = icons.truths(icons.block("≥ k"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u >= self.threshold, events=None))


class LessThreshold(_Threshold):
    """1 where ``u < threshold``."""

    ICON = icons.truths(icons.block("< k"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u < self.threshold, events=None))


class LessEqualThreshold(_Threshold):
    """1 where ``u <= threshold``."""

    ICON = icons.truths(icons.block("≤ k"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u <= self.threshold, events=None))


class Greater(SI2SO):
    """1 where ``u1 > u2``."""

    ICON = icons.truths(icons.block(">"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u1 > self.u2, events=None))


class GreaterEqual(SI2SO):
    """1 where ``u1 >= u2``."""

    ICON = icons.truths(icons.block("≥"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u1 >= self.u2, events=None))


class Less(SI2SO):
    """1 where ``u1 < u2``."""

    ICON = icons.truths(icons.block("<"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u1 < self.u2, events=None))


class LessEqual(SI2SO):
    """1 where ``u1 <= u2``."""

    ICON = icons.truths(icons.block("≤"), "y")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, truth(self.u1 <= self.u2, events=None))


class Switch(ac.Component):
    """``y = u1`` where ``u2`` is true, else ``y = u3``."""

    ICON = icons.truths(icons.SWITCHED, "u2")

    u1 = ac.Input(doc="output where u2 is true")
    u2 = ac.Input(doc="which input is passed: the first above 0.5, else the third")
    u3 = ac.Input(doc="output where u2 is false")
    y = ac.Output(doc="output signal")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.where(self.u2 > TRUE, self.u1, self.u3))


class LogicalSwitch(Switch):
    """A `Switch` for truth values."""

    ICON = icons.truths(icons.SWITCHED, "u1 u2 u3 y")
