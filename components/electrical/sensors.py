"""Sensors: electrical quantities as output signals, without an effect on the circuit."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons

from .interfaces import NegativePin, PositivePin

__modelica__ = "Modelica.Electrical.Analog.Sensors"


class PotentialSensor(ac.Component):
    """Potential of a pin: ``phi = p.v`` [V]."""

    ICON = icons.meter("V")

    p = PositivePin()
    phi = ac.Output(unit="V", doc="potential of the pin")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p.i, 0)
        yield ac.Eq(self.phi, self.p.v)


class VoltageSensor(ac.Component):
    """Voltage between two pins: ``v = p.v - n.v`` [V]; no current flows."""

    ICON = icons.meter2("V")

    p = PositivePin()
    n = NegativePin()
    v = ac.Output(unit="V", doc="voltage from p to n")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p.i, 0)
        yield ac.Eq(self.n.i, 0)
        yield ac.Eq(self.v, self.p.v - self.n.v)


class CurrentSensor(ac.Component):
    """Current in a branch: ``i = p.i`` [A]; the voltage is zero."""

    ICON = icons.meter2("A")

    p = PositivePin()
    n = NegativePin()
    i = ac.Output(unit="A", doc="current from p to n")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p.v, self.n.v)
        yield ac.Eq(self.i, self.p.i)
        yield ac.Eq(0, self.p.i + self.n.i)


class PowerSensor(ac.Component):
    """Power: ``power = v i`` [W] with the voltage from ``pv`` to ``nv`` and the current from ``pc`` to ``nc``."""

    ICON = icons.meter2("W")

    pc = PositivePin()
    nc = NegativePin()
    pv = PositivePin()
    nv = NegativePin()
    power = ac.Output(unit="W", doc="instantaneous power")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(0, self.pc.i + self.nc.i)
        yield ac.Eq(self.pc.v, self.nc.v)
        yield ac.Eq(self.pv.i, 0)
        yield ac.Eq(self.nv.i, 0)
        yield ac.Eq(self.power, self._power)

    @property
    def _power(self) -> ac.Eq:
        return (self.pv.v - self.nv.v) * self.pc.i


class MultiSensor(PowerSensor):
    """Voltage ``v`` [V] from ``pv`` to ``nv``, current ``i`` [A] from ``pc`` to ``nc`` and ``power = v i`` [W]."""

    ICON = icons.meters("VA")

    i = ac.Output(unit="A", doc="current")
    v = ac.Output(unit="V", doc="voltage")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i, self.pc.i)
        yield ac.Eq(self.v, self.pv.v - self.nv.v)

    @property
    def _power(self) -> ac.Eq:
        return self.v * self.i
