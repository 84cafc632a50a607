"""Ideal and idealized operational amplifiers."""

from collections.abc import Iterator
from typing import Any

import acausal as ac

from .interfaces import NegativePin, PositivePin, TwoPort

__modelica__ = "Modelica.Electrical.Analog.Ideal"


_LIMITER_HOMOTOPY = ("NoHomotopy", "Linear", "UpperLimit", "LowerLimit")


class IdealOpAmp(TwoPort):
    """Nullator and norator: ``v1 = 0`` and ``i1 = 0``; ``v2`` and ``i2`` are what the circuit asks for."""

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v1, 0)
        yield ac.Eq(self.i1, 0)


class _ThreePins(ac.Component):
    """Two inputs without current and an output that gives any current."""

    in_p = PositivePin()
    in_n = NegativePin()
    out = PositivePin()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.in_p.i, 0)
        yield ac.Eq(self.in_n.i, 0)


class IdealOpAmp3Pin(_ThreePins):
    """Nullator and norator with three pins: ``in_p.v = in_n.v``, no current in; the output is free."""

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.in_p.v, self.in_n.v)


class _Limited(_ThreePins):
    """An output between two limits, along whose characteristic the variable ``s`` runs, from -1 to 1 inside.

    Stated in ``s`` the law is as steep inside as outside, so that Newton's method finds the way.
    """

    s = ac.Variable(doc="position on the characteristic; the limits are at -1 and 1")

    def _characteristic(self, low: Any, high: Any) -> tuple[Any, Any]:
        """The output, and by how much the input is beyond what gives that output."""
        inside = ac.maximum(ac.minimum(self.s, 1), -1)
        middle, half = (high + low) / 2, (high - low) / 2
        return middle + half * inside, half * (self.s - inside)


class IdealOpAmpLimited(_Limited):
    """Ideal amplifier whose output stays between the potentials of ``VMin`` and ``VMax``.

    ``vin = in_p.v - in_n.v`` is zero while the output is within; below zero ``out.v = VMin.v``, above
    zero ``out.v = VMax.v``.
    """

    VMax = PositivePin()
    VMin = NegativePin()
    vin = ac.Variable(unit="V", doc="input voltage")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.VMax.i, 0)
        yield ac.Eq(self.VMin.i, 0)
        output, excess = self._characteristic(self.VMin.v, self.VMax.v)
        yield ac.Eq(self.vin, self.in_p.v - self.in_n.v)
        yield ac.Eq(self.vin, excess)
        yield ac.Eq(self.out.v, output)


class IdealizedOpAmpLimited(_Limited):
    """Amplifier with the gain ``V0``: ``v_out = V0 v_in``, bounded to the supply ``vns`` ... ``vps``.

    The supply is ``Vps`` and ``Vns`` [V], or with ``useSupply`` the potentials of the pins ``s_p`` and
    ``s_n``, between which the power for the output is taken: ``i_s = p_s/(vps - vns)``. ``strict`` and
    ``homotopyType`` have no effect. The law has no memory: a Schmitt trigger, which is in one of two states
    by its past, cannot be made of it.
    """

    V0 = ac.Parameter(15000.0, doc="no-load gain")
    useSupply = ac.Option(False, doc="whether there are supply pins")
    Vps = ac.Parameter(15.0, unit="V", doc="positive supply without pins")
    Vns = ac.Parameter(-15.0, unit="V", doc="negative supply without pins")
    strict = ac.Option(True, doc="without effect")
    homotopyType = ac.Option("NoHomotopy", choices=_LIMITER_HOMOTOPY, doc="without effect")
    s_p = PositivePin(when="useSupply")
    s_n = NegativePin(when="useSupply")
    vps = ac.Variable(unit="V", doc="positive supply")
    vns = ac.Variable(unit="V", doc="negative supply")
    v_in = ac.Variable(unit="V", doc="input voltage")
    v_out = ac.Variable(unit="V", doc="potential of the output")
    p_in = ac.Variable(unit="W", doc="power into the inputs")
    p_out = ac.Variable(unit="W", doc="power into the output")
    p_s = ac.Variable(unit="W", doc="power from the supply")
    i_s = ac.Variable(unit="A", doc="current from the supply")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v_in, self.in_p.v - self.in_n.v)
        yield ac.Eq(self.v_out, self.out.v)
        yield ac.Eq(self.p_in, self.in_p.v * self.in_p.i + self.in_n.v * self.in_n.i)
        yield ac.Eq(self.p_out, self.out.v * self.out.i)
        yield ac.Eq(self.p_s, -(self.p_in + self.p_out))
        yield ac.Eq(self.i_s, self.p_s / (self.vps - self.vns))
        yield ac.Eq(self.vps, self.s_p.v if self.useSupply else self.Vps)
        yield ac.Eq(self.vns, self.s_n.v if self.useSupply else self.Vns)
        if self.useSupply:
            yield ac.Eq(self.s_p.i, self.i_s)
            yield ac.Eq(self.s_n.i, -self.i_s)
        output, excess = self._characteristic(self.vns, self.vps)
        yield ac.Eq(self.v_out, output)
        yield ac.Eq(self.v_in, output / self.V0 + excess)
