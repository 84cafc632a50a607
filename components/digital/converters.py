"""Converters between digital signals, truth values and numbers."""

from collections.abc import Iterator

import acausal as ac

from .logic import LOGIC, ONE, ZERO, DigitalInput, DigitalOutput, is_one

__modelica__ = "Modelica.Electrical.Digital.Converters"


class LogicToBoolean(ac.Component):
    """1 where ``x`` is ``'1'`` or ``'H'``, else 0, element by element."""

    n = ac.Option(1, doc="number of signals")
    x = DigitalInput(shape="n", doc="digital signals")
    y = ac.Output(shape="n", doc="truth values, 1 or 0")

    def equations(self) -> Iterator[ac.Eq]:
        for x, y in zip(self.x, self.y, strict=True):
            yield ac.Eq(y, ac.where(is_one(x), 1, 0))


class BooleanToLogic(ac.Component):
    """``'1'`` where ``x > 0.5``, else ``'0'``, element by element."""

    n = ac.Option(1, doc="number of signals")
    x = ac.Input(shape="n", doc="truth values")
    y = DigitalOutput(shape="n", doc="digital signals")

    def equations(self) -> Iterator[ac.Eq]:
        for x, y in zip(self.x, self.y, strict=True):
            yield ac.Eq(y, ac.where(x > 0.5, ONE, ZERO))


class LogicToReal(ac.Component):
    """``value_U``, ``value_X``, ``value_0`` ... for the values of ``x``, element by element."""

    n = ac.Option(1, doc="number of signals")
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
