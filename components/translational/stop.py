"""A mass with friction between two stops."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.choices import STATE_SELECT
from acausal.components.laws import coulomb, impact
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .interfaces import PartialFriction, PartialRigid

__modelica__ = "Modelica.Mechanics.Translational.Components"

_STICTION = 1.001
"""The friction that holds the mass at rest over that at which it begins to slide."""


class MassWithStopAndFriction(
    PartialRigid, PartialFriction, PartialElementaryConditionalHeatPortWithoutT
):
    """A sliding mass with Stribeck friction ``f`` [N] between two stops.

    ``m a = flange_a.f + flange_b.f - f``. While it slides, ``f`` is ``F_prop v`` and, with the sign of ``v``,
    ``F_Coulomb + F_Stribeck exp(-fexp |v|)``. At rest it locks, see `PartialFriction`. Where an end reaches the stop
    ``smin`` or ``smax``, the speed jumps to 0. ``stopped`` is -1 at ``smin``, 1 at ``smax``, else 0.
    ``lossPower = f v`` leaves out the impacts. ``s`` and ``v`` must be states: connect masses by springs.

    With ``smooth``, the friction ``(F_Coulomb + F_Stribeck exp(-fexp |v|)) tanh(v/v_small)`` creeps at rest, and the
    stops are stiff: ``m a = flange_a.f + flange_b.f - f - f_stop``, where ``c_stop`` and ``d_stop`` push back what goes
    beyond, but never pull (`acausal.components.laws.impact`); the impact is inelastic but for a rebound slower than
    ``1/d_stop``.
    """

    ICON = icons.STOPPED

    m = ac.Parameter(unit="kg", min=0, doc="mass")
    smax = ac.Parameter(unit="m", doc="right stop for the right end")
    smin = ac.Parameter(unit="m", doc="left stop for the left end")
    F_prop = ac.Parameter(unit="N.s/m", min=0, doc="viscous friction")
    F_Coulomb = ac.Parameter(unit="N", doc="constant friction")
    F_Stribeck = ac.Parameter(unit="N", doc="excess of friction at rest")
    fexp = ac.Parameter(unit="s/m", min=0, doc="decay of the Stribeck effect")
    c_stop = ac.Parameter(1e7, unit="N/m", min=0, doc="stiffness of the stops, with smooth")
    d_stop = ac.Parameter(1e3, unit="s/m", min=0, doc="damping of the stops, with smooth")
    stateSelect = ac.Option("prefer", choices=STATE_SELECT, doc="priority of s and v as states")
    s = ac.Variable(unit="m", state="stateSelect", doc="position of the centre")
    v = ac.Variable(unit="m/s", state="stateSelect", doc="speed")
    a = ac.Variable(unit="m/s2", doc="acceleration")
    f = ac.Variable(unit="N", doc="friction force")
    f_stop = ac.Variable(unit="N", when="smooth", doc="force of the stops, positive at smax")
    stopped = ac.Variable(doc="-1 at smin, 1 at smax, else 0")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Assert(self.smin < self.smax, "the left stop lies to the right of the right one")
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))
        yield ac.Eq(self.lossPower, self.f * self.v)
        yield from self._smooth() if self.smooth else self._exact()

    def _smooth(self) -> Iterator[ac.Eq]:
        right, left = self.flange_b.s - self.smax, self.smin - self.flange_a.s
        push_left = impact(right, self.v, self.c_stop, self.d_stop)
        push_right = impact(left, -self.v, self.c_stop, self.d_stop)
        dry = self.F_Coulomb + self.F_Stribeck * ac.exp(-self.fexp * ac.Abs(self.v))
        yield ac.Eq(self.m * self.a, self.flange_a.f + self.flange_b.f - self.f - self.f_stop)
        yield ac.Eq(self.f, self.F_prop * self.v + coulomb(self.v, dry, 0, self.v_small))
        yield ac.Eq(self.f_stop, push_left - push_right)
        yield ac.Eq(self.stopped, ac.where(right >= 0, 1, ac.where(left >= 0, -1, 0)))

    @property
    def _ends(self) -> tuple[Any, Any]:
        """The positions of the centre at the stops."""
        return self.smin + self.L / 2, self.smax - self.L / 2

    @property
    def _bounds(self) -> tuple[Any, Any]:
        first, last = self._ends
        return self.s < last, self.s > first

    def _exact(self) -> Iterator[Any]:
        first, last = self._ends
        room = 1e-6 * (last - first)
        inside = (self.s >= first - room) & (self.s <= last + room)
        yield ac.Assert(
            inside, "the mass is beyond its stops; let it start between them", "warning"
        )
        ahead, back = self._bounds
        at_rest = self.F_Coulomb + self.F_Stribeck
        frictionless = (at_rest <= 0) & (self.F_prop <= 0)
        yield ac.Eq(self.free, frictionless & ahead & back)
        yield ac.Eq(self.v_relfric, self.v)
        yield ac.Eq(self.a_relfric, self.a)
        yield ac.Eq(self.f0, at_rest)
        yield ac.Eq(self.f0_max, _STICTION * self.f0)
        yield ac.Eq(self.m * self.a, self.flange_a.f + self.flange_b.f - self.f)
        decay = ac.exp(-self.fexp * ac.Abs(self.v))
        starts = self.startForward | self.startBackward
        dry = self.F_Coulomb + self.F_Stribeck * ac.where(starts, 1, decay)
        yield ac.Eq(self.f, self._friction(self.F_prop * self.v + self._direction * dry))
        beside = ac.where(ahead, 0, 1, events=True)
        yield ac.Eq(self.stopped, ac.where(back, beside, -1, events=True))
        stop = ac.where(back, last, first, events=True)
        yield ac.When(~(ahead & back), ac.Reinit(self.s, stop), ac.Reinit(self.v, 0))
