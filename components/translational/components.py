"""Masses, springs, dampers, rods, gears; friction and adaptors come from their own modules."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons
from acausal.components.choices import STATE_SELECT
from acausal.components.laws import contact
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .interfaces import (
    Flange,
    PartialCompliant,
    PartialCompliantWithRelativeStates,
    PartialElementaryTwoFlangesAndSupport2,
    PartialRigid,
)

__modelica__ = "Modelica.Mechanics.Translational.Components"


class Fixed(ac.Component):
    """A flange fixed in space: ``flange.s = s0`` [m]."""

    ICON = icons.FIXED

    s0 = ac.Parameter(0.0, unit="m", doc="fixed position")
    flange = Flange()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.flange.s, self.s0)


class Mass(PartialRigid):
    """A sliding mass: ``m a = flange_a.f + flange_b.f`` with ``v = der(s)``, ``a = der(v)``.

    Its position ``s`` [m] and speed ``v`` [m/s] are preferred as states (Modelica: ``default``).
    """

    ICON = icons.MASS

    m = ac.Parameter(unit="kg", min=0, doc="mass")
    stateSelect = ac.Option("prefer", choices=STATE_SELECT, doc="priority of s and v as states")
    s = ac.Variable(unit="m", state="stateSelect", doc="position of the centre")
    v = ac.Variable(unit="m/s", state="stateSelect", doc="speed")
    a = ac.Variable(unit="m/s2", doc="acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, ac.der(self.s))
        yield ac.Eq(self.a, ac.der(self.v))
        yield ac.Eq(self.m * self.a, self.flange_a.f + self.flange_b.f)


class Rod(PartialRigid):
    """A massless rod of length ``L``: ``0 = flange_a.f + flange_b.f``."""

    ICON = icons.ROD

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(0, self.flange_a.f + self.flange_b.f)


class Spring(PartialCompliant):
    """Linear spring: ``f = c (s_rel - s_rel0)``."""

    ICON = icons.SPRING

    c = ac.Parameter(unit="N/m", min=0, doc="spring constant")
    s_rel0 = ac.Parameter(0.0, unit="m", doc="unstretched length")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.c * (self.s_rel - self.s_rel0))


class Damper(PartialCompliantWithRelativeStates, PartialElementaryConditionalHeatPortWithoutT):
    """Linear damper: ``f = d v_rel``, ``lossPower = f v_rel``."""

    ICON = icons.DAMPER

    d = ac.Parameter(unit="N.s/m", min=0, doc="damping constant")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.d * self.v_rel)
        yield ac.Eq(self.lossPower, self.f * self.v_rel)


class SpringDamper(
    PartialCompliantWithRelativeStates, PartialElementaryConditionalHeatPortWithoutT
):
    """Spring and damper side by side: ``f = c (s_rel - s_rel0) + d v_rel``.

    ``lossPower = d v_rel**2`` is what the damper takes.
    """

    ICON = icons.SPRING_DAMPER

    c = ac.Parameter(unit="N/m", min=0, doc="spring constant")
    d = ac.Parameter(unit="N.s/m", min=0, doc="damping constant")
    s_rel0 = ac.Parameter(0.0, unit="m", doc="unstretched length")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.c * (self.s_rel - self.s_rel0) + self.d * self.v_rel)
        yield ac.Eq(self.lossPower, self.d * self.v_rel**2)


class ElastoGap(PartialCompliantWithRelativeStates, PartialElementaryConditionalHeatPortWithoutT):
    """Spring and damper that lift off: there is a force only while ``s_rel < s_rel0``.

    In contact ``f = f_c + f_d`` with ``f_c = -c |s_rel - s_rel0|**n`` and ``f_d = d v_rel``, bounded
    to ``|f_d| <= |f_c|``; ``lossPower = f_d v_rel``. So the contact never pulls, and the force is
    continuous at touch-down. ``contact`` is 1 in contact, else 0; in models with events, steps end where it changes.
    """

    ICON = icons.GAP

    c = ac.Parameter(unit="N/m", min=0, doc="spring constant")
    d = ac.Parameter(unit="N.s/m", min=0, doc="damping constant")
    s_rel0 = ac.Parameter(0.0, unit="m", doc="length at which contact begins")
    n = ac.Parameter(1.0, min=1, doc="exponent of the spring force")
    contact = ac.Variable(doc="1 in contact, else 0")
    f_c = ac.Variable(unit="N", doc="spring force")
    f_d = ac.Variable(unit="N", doc="damping force")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        f_c, f_d = contact(self.s_rel0 - self.s_rel, -self.v_rel, self.c, self.d, self.n)
        yield ac.Eq(self.contact, ac.where(self.s_rel < self.s_rel0, 1, 0, events=None))
        yield ac.Eq(self.f_c, -f_c)
        yield ac.Eq(self.f_d, -f_d)
        yield ac.Eq(self.f, self.f_c + self.f_d)
        yield ac.Eq(self.lossPower, self.f_d * self.v_rel)


class IdealGear(PartialElementaryTwoFlangesAndSupport2):
    """Ideal lever or gear: ``s_a = ratio s_b``, ``0 = ratio flange_a.f + flange_b.f``.

    ``ratio`` must not be zero (Modelica lets go of both flanges then).
    """

    ICON = icons.GEAR

    __modelica__ = None

    ratio = ac.Parameter(doc="transmission ratio s_a / s_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s_a, self.ratio * self.s_b)
        yield ac.Eq(0, self.ratio * self.flange_a.f + self.flange_b.f)
