"""Switches: ideal contacts driven by a signal or by the potential of a pin."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import ConditionalHeatPort, IdealSwitch, NegativePin, Pin, PositivePin
from .laws import TRUE, contact

__modelica__ = "Modelica.Electrical.Analog.Ideal"


class IdealOpeningSwitch(IdealSwitch):
    """A contact that the signal ``control`` opens: open where ``control > 0.5``."""

    ICON = icons.OPENING

    control = ac.Input(kind="bool", doc="open above 0.5 (Modelica: true)")

    @property
    def _open(self) -> Any:
        return self.control > TRUE


class IdealClosingSwitch(IdealSwitch):
    """A contact that the signal ``control`` closes: closed where ``control > 0.5``."""

    control = ac.Input(kind="bool", doc="closed above 0.5 (Modelica: true)")

    @property
    def _open(self) -> Any:
        return self.control <= TRUE


class _PinControlled(ac.Component):
    """A switch that the potential of the pin ``control`` drives, which carries no current."""

    level = ac.Parameter(0.5, unit="V", doc="potential of control at which the switch acts")
    control = Pin()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.control.i, 0)


class ControlledIdealOpeningSwitch(_PinControlled, IdealSwitch):
    """A contact that is open where ``control.v > level``."""

    ICON = icons.ruled(icons.OPENING)

    @property
    def _open(self) -> Any:
        return self.control.v > self.level


class ControlledIdealClosingSwitch(_PinControlled, IdealSwitch):
    """A contact that is closed where ``control.v > level``."""

    ICON = icons.ruled(icons.CLOSING)

    @property
    def _open(self) -> Any:
        return self.control.v <= self.level


class _Contacts(ConditionalHeatPort):
    """Several contacts with one ``Ron`` and ``Goff``, in one of two positions."""

    ICON = icons.TWO_WAY

    Ron = ac.Parameter(1e-5, unit="Ohm", min=0, doc="resistance while closed")
    Goff = ac.Parameter(1e-5, unit="S", min=0, doc="conductance while open")

    @property
    def _first(self) -> Any:
        """The condition for the first position."""
        raise NotImplementedError

    @property
    def _second(self) -> Any:
        """The condition for the second position."""
        raise NotImplementedError

    def _contact(self, open_: Any, v: Any, i: Any) -> ac.Eq:
        return contact(open_, v, i, self.Ron, self.Goff)


class _TwoWay(_Contacts):
    """A pin ``p`` that touches ``n1`` in the first position, ``n2`` in the second."""

    p = PositivePin()
    n2 = NegativePin()
    n1 = NegativePin()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        p, n1, n2 = self.p, self.n1, self.n2
        yield ac.Eq(0, p.i + n1.i + n2.i)
        yield self._contact(self._second, p.v - n1.v, -n1.i)
        yield self._contact(self._first, p.v - n2.v, -n2.i)
        yield ac.Eq(self.LossPower, p.i * p.v + n1.i * n1.v + n2.i * n2.v)


class _Intermediate(_Contacts):
    """``p1`` touches ``n1`` and ``p2`` ``n2`` in the first position, crossed in the second."""

    p1 = PositivePin()
    p2 = PositivePin()
    n1 = NegativePin()
    n2 = NegativePin()
    i11 = ac.Variable(unit="A", doc="current from p1 to n1")
    i22 = ac.Variable(unit="A", doc="current from p2 to n2")
    i12 = ac.Variable(unit="A", doc="current from p1 to n2")
    i21 = ac.Variable(unit="A", doc="current from p2 to n1")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        p1, p2, n1, n2 = self.p1, self.p2, self.n1, self.n2
        yield self._contact(self._second, p1.v - n1.v, self.i11)
        yield self._contact(self._second, p2.v - n2.v, self.i22)
        yield self._contact(self._first, p1.v - n2.v, self.i12)
        yield self._contact(self._first, p2.v - n1.v, self.i21)
        yield ac.Eq(p1.i, self.i11 + self.i12)
        yield ac.Eq(p2.i, self.i22 + self.i21)
        yield ac.Eq(n1.i, -self.i11 - self.i21)
        yield ac.Eq(n2.i, -self.i22 - self.i12)
        power = p1.i * p1.v + p2.i * p2.v + n1.i * n1.v + n2.i * n2.v
        yield ac.Eq(self.LossPower, power)


class _BySignal(_Contacts):
    """In the second position where the signal ``control`` is above 0.5."""

    control = ac.Input(kind="bool", doc="second position above 0.5 (Modelica: true)")

    @property
    def _first(self) -> Any:
        return self.control <= TRUE

    @property
    def _second(self) -> Any:
        return self.control > TRUE


class _ByPin(_PinControlled, _Contacts):
    """In the second position where ``control.v > level``."""

    @property
    def _first(self) -> Any:
        return self.control.v <= self.level

    @property
    def _second(self) -> Any:
        return self.control.v > self.level


class IdealTwoWaySwitch(_BySignal, _TwoWay):
    """``p`` is connected with ``n2`` where the signal ``control > 0.5``, else with ``n1``."""

    ICON = icons.TWO_WAY


class ControlledIdealTwoWaySwitch(_ByPin, _TwoWay):
    """``p`` is connected with ``n2`` where ``control.v > level``, else with ``n1``."""

    ICON = icons.ruled(icons.TWO_WAY)


class IdealIntermediateSwitch(_BySignal, _Intermediate):
    """Where the signal ``control > 0.5``, ``p1`` - ``n2`` and ``p2`` - ``n1`` are connected.

    Else ``p1`` - ``n1`` and ``p2`` - ``n2``.
    """

    ICON = icons.INTERMEDIATE


class ControlledIdealIntermediateSwitch(_ByPin, _Intermediate):
    """Where ``control.v > level``, ``p1`` - ``n2`` and ``p2`` - ``n1`` are connected.

    Else ``p1`` - ``n1`` and ``p2`` - ``n2``.
    """

    ICON = icons.ruled(icons.INTERMEDIATE)
