"""Switches with an arc: what opens under current goes on to conduct until the arc is quenched."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import ConditionalHeatPort, OnePort
from .laws import TRUE
from .switches import _PinControlled

__modelica__ = "Modelica.Electrical.Analog.Ideal"


_NEVER = -1e30
"""Time [s] that lies before all others."""


class IdealSwitchWithArc(OnePort, ConditionalHeatPort):
    """A switch with an arc: it opens (``off``) at ``tSwitch``, but conducts until the arc is ``quenched``.

    Closed ``v = Ron i``. Open ``v = sign(i) min(Vmax, V0 + dVdt (time - tSwitch))`` until ``|i| <= Goff |v|``,
    from then on ``i = Goff v``. A subclass says when it is open. ``LossPower = v i``.
    """

    ICON = icons.arced(icons.CLOSING)

    __modelica__ = "Modelica.Electrical.Analog.Interfaces"

    Ron = ac.Parameter(1e-5, unit="Ohm", doc="resistance while closed")
    Goff = ac.Parameter(1e-5, unit="S", doc="conductance while open")
    V0 = ac.Parameter(unit="V", doc="voltage of the arc when it begins")
    dVdt = ac.Parameter(unit="V/s", doc="rate of the arc's voltage")
    Vmax = ac.Parameter(unit="V", doc="greatest voltage of the arc")
    off = ac.Discrete(True, kind="bool", doc="1 while open, quenched or not, else 0")
    quenched = ac.Discrete(True, kind="bool", doc="1 while open without an arc, else 0")
    tSwitch = ac.Discrete(_NEVER, unit="s", doc="when it opened last")

    margin = ac.Variable(unit="A", doc="below zero while the current is too strong to be quenched")

    @property
    def _open(self) -> Any:
        """The condition for being open."""
        raise NotImplementedError

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        v, i = self.v, self.i
        yield ac.Eq(self.off, ac.where(self._open, 1, 0))
        yield ac.When(ac.edge(self.off), ac.Eq(self.tSwitch, ac.time))
        quenched = (self.off > TRUE) & ((self.margin >= 0) | (ac.pre(self.quenched) > TRUE))
        yield ac.Eq(self.quenched, ac.where(quenched, 1, 0))
        growing = self.V0 + self.dVdt * (ac.time - self.tSwitch)
        arc = ac.where(growing < self.Vmax, growing, self.Vmax, events=True)
        arc = arc * ac.where(i < 0, -1, 1, events=True)
        burning = (self.off > TRUE) & (self.quenched <= TRUE)
        resistance = ac.where(self.quenched, 1, ac.where(self.off, 0, self.Ron))
        yield ac.Eq(
            v * ac.where(self.quenched, self.Goff, 1), i * resistance + ac.where(burning, arc, 0)
        )
        margin = abs(v) * self.Goff - abs(i)
        margin = ac.where(ac.pre(self.quenched), 1, margin)
        yield ac.Eq(self.margin, ac.where(self.off, margin, -1))
        yield ac.Eq(self.LossPower, v * i)


class OpenerWithArc(IdealSwitchWithArc):
    """A contact with an arc that the signal ``control`` opens: open where ``control > 0.5``."""

    ICON = icons.arced(icons.OPENING)

    control = ac.Input(kind="bool", doc="open above 0.5 (Modelica: true)")

    @property
    def _open(self) -> Any:
        return self.control > TRUE


class CloserWithArc(IdealSwitchWithArc):
    """A contact with an arc that the signal ``control`` closes: closed where ``control > 0.5``."""

    ICON = icons.arced(icons.CLOSING)

    control = ac.Input(kind="bool", doc="closed above 0.5 (Modelica: true)")

    @property
    def _open(self) -> Any:
        return self.control <= TRUE


class ControlledOpenerWithArc(_PinControlled, IdealSwitchWithArc):
    """A contact with an arc that is open where ``control.v > level``."""

    ICON = icons.ruled(icons.arced(icons.OPENING))

    @property
    def _open(self) -> Any:
        return self.control.v > self.level


class ControlledCloserWithArc(_PinControlled, IdealSwitchWithArc):
    """A contact with an arc that is closed where ``control.v >= level``."""

    ICON = icons.ruled(icons.arced(icons.CLOSING))

    @property
    def _open(self) -> Any:
        return self.control.v < self.level
