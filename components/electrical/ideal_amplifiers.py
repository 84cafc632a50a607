"""Ideal and idealized operational amplifiers."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.blocks.conventions import LIMITER_HOMOTOPY

from .interfaces import NegativePin, PositivePin, TwoPort

__modelica__ = "Modelica.Electrical.Analog.Ideal"


class IdealOpAmp(TwoPort):
    """Nullator and norator: ``v1 = 0`` and ``i1 = 0``; ``v2`` and ``i2`` are what the circuit asks for."""

    ICON = icons.OP_AMP_OF_PAIRS

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v1, 0)
        yield ac.Eq(self.i1, 0)


class _ThreePins(ac.Component):
    """Two inputs without current and an output that gives any current."""

    ICON = icons.OP_AMP

    in_p = PositivePin()
    in_n = NegativePin()
    out = PositivePin()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.in_p.i, 0)
        yield ac.Eq(self.in_n.i, 0)


class IdealOpAmp3Pin(_ThreePins):
    """Nullator and norator with three pins: ``in_p.v = in_n.v``, no current in; the output is free."""

    ICON = replace(icons.OP_AMP, text="∞")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.in_p.v, self.in_n.v)


_TRIED = 1e-3
"""So far within a limit, relative to the range, an amplifier is tried that is to leave it."""


_ROOM = 1e-9
"""So far beyond a limit, relative to the range, an output comes to it: further than by what rounding does."""


class _Limited(_ThreePins):
    """An output between two limits, with a memory of the limit that it is at.

    A loop with positive feedback has several solutions. The amplifier stays at its limit while that is one; then its
    output is tried a little within, and goes back to the limit's side of the range or runs away to the other limit.
    """

    mode = ac.Discrete(
        "_first_mode",
        kind="int",
        doc="1 at the upper limit, -1 at the lower limit, 0 between, 2 or -2 while it is tried to leave one",
    )
    pull = ac.Discrete(
        doc="at a limit, how much the input asked for a higher output at the last event"
    )
    push = ac.Variable(
        start=1.0, doc="while leaving is tried: above zero if it leads to the middle"
    )

    @property
    def _first_mode(self) -> int:
        """The mode before the first event."""
        return 0

    def _output(self, low: Any, high: Any, between: Any) -> Any:
        """The output; ``between`` is what it is within the limits."""
        m, step = ac.pre(self.mode), _TRIED * (high - low)
        upper = ac.where(m > 1.5, high - step, ac.where(m > 0.5, high, between))
        return ac.where(m < -1.5, low + step, ac.where(m < -0.5, low, upper))

    def _changes(self, above: Any, below: Any, pull: Any) -> Iterator[ac.Eq]:
        """The mode, from whether the input asks for more or less than the limits, and by how much."""
        m, rise = ac.pre(self.mode), pull - ac.pre(self.pull)
        yield ac.Eq(self.pull, ac.where((m > 0.5) | (m < -0.5), pull, 0))
        yield ac.Eq(self.push, ac.where(m > 1.5, rise, ac.where(m < -1.5, -rise, 1)))
        away = self.push > 0
        upper = ac.where(m > 1.5, ac.where(away, 0, -1), ac.where(above, 1, 2))
        lower = ac.where(m < -1.5, ac.where(away, 0, 1), ac.where(below, -1, -2))
        middle = ac.where(above, 1, ac.where(below, -1, 0))
        yield ac.Eq(self.mode, ac.where(m > 0.5, upper, ac.where(m < -0.5, lower, middle)))


class IdealOpAmpLimited(_Limited):
    """Ideal amplifier whose output stays between the potentials of ``VMin`` and ``VMax``.

    ``vin = in_p.v - in_n.v`` is zero while the output is within; below zero ``out.v = VMin.v``, above
    zero ``out.v = VMax.v``. Steps end where it comes to a limit or leaves it.
    """

    ICON = icons.marked(icons.OP_AMP, "lim")

    VMax = PositivePin()
    VMin = NegativePin()
    vin = ac.Variable(unit="V", doc="input voltage")
    s = ac.Variable(doc="position on the characteristic; the limits are at -1 and 1")

    @property
    def _first_mode(self) -> int:
        return 1  # without feedback there is no solution between the limits

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.VMax.i, 0)
        yield ac.Eq(self.VMin.i, 0)
        low, high, m = self.VMin.v, self.VMax.v, ac.pre(self.mode)
        yield ac.Eq(self.vin, self.in_p.v - self.in_n.v)
        excess = ac.where(m > 0.5, self.s - 1, ac.where(m < -0.5, self.s + 1, 0))
        yield ac.Eq(self.vin, excess)
        between = (high + low) / 2 + (high - low) / 2 * self.s
        yield ac.Eq(self.out.v, self._output(low, high, between))
        yield from self._changes(self.s > 1, self.s < -1, self.vin)


class IdealizedOpAmpLimited(_Limited):
    """Amplifier with the gain ``V0``: ``v_out = V0 v_in``, bounded to the supply ``vns`` ... ``vps``.

    The supply is ``Vps`` and ``Vns`` [V], or with ``useSupply`` the potentials of the pins ``s_p`` and
    ``s_n``, between which the power for the output is taken: ``i_s = p_s/(vps - vns)``. Steps end where the output
    comes to a limit or leaves it. With positive feedback it stays at a limit as long as it can (Schmitt trigger);
    ``homotopyType`` says where it begins: at the limit of ``"UpperLimit"`` or ``"LowerLimit"`` if that is a solution.
    ``strict`` has no effect.
    """

    ICON = replace(icons.OP_AMP, text="lim")

    V0 = ac.Parameter(15000.0, doc="no-load gain")
    useSupply = ac.Option(False, doc="whether there are supply pins")
    Vps = ac.Parameter(15.0, unit="V", doc="positive supply without pins")
    Vns = ac.Parameter(-15.0, unit="V", doc="negative supply without pins")
    strict = ac.Option(True, doc="without effect")
    homotopyType = ac.Option(
        "NoHomotopy", choices=LIMITER_HOMOTOPY, doc="where the output begins, if there is a choice"
    )
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

    @property
    def _first_mode(self) -> int:
        return {"UpperLimit": 1, "LowerLimit": -1}.get(self.homotopyType, 0)

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        if not self.useSupply:
            yield ac.Assert(self.Vns < self.Vps, "the negative supply lies above the positive one")
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
        wanted, room = self.V0 * self.v_in, _ROOM * (self.vps - self.vns)
        above, below = wanted > self.vps + room, wanted < self.vns - room
        yield ac.Eq(self.v_out, self._output(self.vns, self.vps, wanted))
        yield from self._changes(above, below, wanted - self.v_out)
