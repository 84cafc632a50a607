"""Converters between digital signals, truth values and numbers."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .logic import (
    LOGIC,
    ONE,
    ZERO,
    DigitalInput,
    DigitalOutput,
    U,
    X,
    is_one,
    is_uninitialized,
    is_zero,
    signal,
)

__modelica__ = "Modelica.Electrical.Digital.Converters"


class LogicToBoolean(ac.Component):
    """1 where ``x`` is ``'1'`` or ``'H'``, else 0, element by element."""

    ICON = icons.block("L → B")

    n = ac.Option(1, min=1, doc="number of signals")
    x = DigitalInput(shape="n", doc="digital signals")
    y = ac.Output(shape="n", doc="truth values, 1 or 0")

    def equations(self) -> Iterator[ac.Eq]:
        for x, y in zip(self.x, self.y, strict=True):
            yield ac.Eq(y, ac.where(is_one(x), 1, 0))


class BooleanToLogic(ac.Component):
    """``'1'`` where ``x > 0.5``, else ``'0'``, element by element."""

    ICON = icons.block("B → L")

    n = ac.Option(1, min=1, doc="number of signals")
    x = ac.Input(shape="n", doc="truth values")
    y = DigitalOutput(shape="n", doc="digital signals")

    def equations(self) -> Iterator[ac.Eq]:
        for x, y in zip(self.x, self.y, strict=True):
            yield ac.Eq(y, ac.where(x > 0.5, ONE, ZERO))


class LogicToReal(ac.Component):
    """``value_U``, ``value_X``, ``value_0`` ... for the values of ``x``, element by element."""

    ICON = icons.block("L → R")

    n = ac.Option(1, min=1, doc="number of signals")
    x = DigitalInput(shape="n", doc="digital signals")
    y = ac.Output(shape="n", doc="numbers")
    value_U = ac.Parameter(0.5, doc="for 'U'")
    value_X = ac.Parameter(0.5, doc="for 'X'")
    value_0 = ac.Parameter(0.0, doc="for '0'")
    value_1 = ac.Parameter(1.0, doc="for '1'")
    value_Z = ac.Parameter(0.5, doc="for 'Z'")
    value_W = ac.Parameter(0.5, doc="for 'W'")
    value_L = ac.Parameter(0.0, doc="for 'L'")
    value_H = ac.Parameter(1.0, doc="for 'H'")
    value_m = ac.Parameter(0.5, doc="for '-'")

    def equations(self) -> Iterator[ac.Eq]:
        values = [getattr(self, f"value_{v[1].replace('-', 'm')}") for v in LOGIC]
        for x, y in zip(self.x, self.y, strict=True):
            number = values[-1]
            for code in range(len(values) - 1, 0, -1):
                number = ac.where(x < code + 0.5, values[code - 1], number)
            yield ac.Eq(y, number)


class _Stripped(ac.Component):
    """What strips strength off signals: 0 for a weak 0, 1 for a weak 1."""

    n = ac.Option(1, min=1, doc="number of signals")
    x = DigitalInput(shape="n", doc="digital signals")
    y = DigitalOutput(shape="n", doc="digital signals of fewer values")

    def _rest(self, x: Any) -> Any:
        """What becomes of the other values."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        for x, y in zip(self.x, self.y, strict=True):
            known = ac.where(is_one(x), ONE, self._rest(x))
            yield ac.Eq(y, ac.where(is_zero(x), ZERO, known))


class LogicToX01(_Stripped):
    """``'0'``, ``'1'``, or ``'X'`` for what is neither, element by element."""

    ICON = icons.block("X01")

    def _rest(self, x: Any) -> Any:
        return X


class LogicToX01Z(_Stripped):
    """``'0'``, ``'1'``, ``'Z'``, or ``'X'`` for the rest, element by element."""

    ICON = icons.block("X01Z")

    def _rest(self, x: Any) -> Any:
        high_impedance = signal("'Z'")
        return ac.where(abs(x - high_impedance) < 0.5, high_impedance, X)


class LogicToUX01(_Stripped):
    """``'U'``, ``'0'``, ``'1'``, or ``'X'`` for the rest, element by element."""

    ICON = icons.block("UX01")

    def _rest(self, x: Any) -> Any:
        return ac.where(is_uninitialized(x), U, X)


class RealToLogic(ac.Component):
    """``upper_value`` above ``upper_limit``, ``lower_value`` below ``lower_limit``, else ``middle_value``."""

    ICON = icons.block("R → L")

    n = ac.Option(1, min=1, doc="number of signals")
    x = ac.Input(shape="n", doc="numbers")
    y = DigitalOutput(shape="n", doc="digital signals")
    upper_limit = ac.Parameter(1.0, doc="above it: upper_value")
    lower_limit = ac.Parameter(0.0, doc="below it: lower_value")
    upper_value = ac.Option("'1'", choices=LOGIC, doc="above upper_limit")
    lower_value = ac.Option("'0'", choices=LOGIC, doc="below lower_limit")
    middle_value = ac.Option("'X'", choices=LOGIC, doc="between the limits")

    def equations(self) -> Iterator[ac.Eq]:
        high, low, middle = map(signal, (self.upper_value, self.lower_value, self.middle_value))
        for x, y in zip(self.x, self.y, strict=True):
            below = ac.where(x < self.lower_limit, low, middle, events=True)
            yield ac.Eq(y, ac.where(x > self.upper_limit, high, below, events=True))
