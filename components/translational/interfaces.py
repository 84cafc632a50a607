"""Bases that components and users' own elements extend; for the flange see `acausal.components.mechanics`."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.choices import STATE_SELECT
from acausal.components.mechanics.friction import Contact
from acausal.components.mechanics.translational import Flange, Support

__modelica__ = "Modelica.Mechanics.Translational.Interfaces"


class PartialTwoFlanges(ac.Component):
    """Two flanges without equations."""

    flange_a = Flange()
    flange_b = Flange()


class PartialRigid(PartialTwoFlanges):
    """Two flanges held at distance ``L``: ``flange_a.s = s - L/2``, ``flange_b.s = s + L/2``.

    ``s`` [m] is the position of the centre.
    """

    L = ac.Parameter(0.0, unit="m", doc="length from left flange to right flange")
    s = ac.Variable(unit="m", doc="position of the centre")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.s, self.s - self.L / 2)
        yield ac.Eq(self.flange_b.s, self.s + self.L / 2)


class PartialCompliant(PartialTwoFlanges):
    """A massless element with a force ``f`` [N] over a distance ``s_rel`` [m].

    ``s_rel = flange_b.s - flange_a.s``, ``flange_b.f = f``, ``flange_a.f = -f``.
    A subclass states ``f``; it is positive where it pulls the flanges together.
    """

    s_rel = ac.Variable(unit="m", doc="distance from flange_a to flange_b")
    f = ac.Variable(unit="N", doc="force between the flanges, = flange_b.f")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s_rel, self.flange_b.s - self.flange_a.s)
        yield ac.Eq(self.flange_b.f, self.f)
        yield ac.Eq(self.flange_a.f, -self.f)


class PartialCompliantWithRelativeStates(PartialCompliant):
    """A compliant element that also knows the relative speed ``v_rel = der(s_rel)`` [m/s].

    Absolute positions and speeds of masses are preferred as states, so ``stateSelect`` is
    ``"default"`` here (Modelica: ``"prefer"``); with ``"prefer"`` an element's ``s_rel`` and
    ``v_rel`` become states. ``s_nominal`` [m] is the magnitude of ``s_rel``, for scaling only.
    """

    stateSelect = ac.Option(
        "default", choices=STATE_SELECT, doc="priority of s_rel, v_rel as states"
    )
    s_nominal = ac.Option(1e-4, doc="nominal value of s_rel")
    s_rel = ac.Variable(
        unit="m", state="stateSelect", nominal="s_nominal", doc="distance from flange_a to flange_b"
    )
    v_rel = ac.Variable(unit="m/s", state="stateSelect", doc="relative speed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v_rel, ac.der(self.s_rel))


class PartialElementaryOneFlangeAndSupport2(ac.Component):
    """One flange that works against a support, or against the ground without ``useSupport``.

    ``s = flange.s - support.s`` [m], ``support.f = -flange.f``.
    """

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed to the ground")
    flange = Flange()
    support = Support(when="useSupport")
    s = ac.Variable(unit="m", doc="position of the flange relative to the support")

    @property
    def s_support(self) -> Any:
        """Position of the support."""
        return self.support.s if self.useSupport else 0

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s, self.flange.s - self.s_support)
        if self.useSupport:
            yield ac.Eq(self.support.f, -self.flange.f)


class PartialElementaryTwoFlangesAndSupport2(PartialTwoFlanges):
    """Two flanges that work against a support, or against the ground without ``useSupport``.

    ``s_a = flange_a.s - support.s``, ``s_b = flange_b.s - support.s`` [m],
    ``support.f = -flange_a.f - flange_b.f``.
    """

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed to the ground")
    support = Support(when="useSupport")
    s_a = ac.Variable(unit="m", doc="position of flange_a relative to the support")
    s_b = ac.Variable(unit="m", doc="position of flange_b relative to the support")

    @property
    def s_support(self) -> Any:
        """Position of the support."""
        return self.support.s if self.useSupport else 0

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s_a, self.flange_a.s - self.s_support)
        yield ac.Eq(self.s_b, self.flange_b.s - self.s_support)
        if self.useSupport:
            yield ac.Eq(self.support.f, -self.flange_a.f - self.flange_b.f)


class PartialForce(PartialElementaryOneFlangeAndSupport2):
    """A force ``f = flange.f`` [N] on the flange; negative values push what is connected forward."""

    ICON = icons.FORCE

    f = ac.Variable(unit="N", doc="force at the flange, = flange.f")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.f, self.flange.f)


class PartialSpeedDependentForce(PartialForce):
    """A force that depends on the flange's speed ``v = der(s)`` [m/s] against the support."""

    __modelica__ = None

    v = ac.Variable(unit="m/s", doc="speed of the flange relative to the support")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v, ac.der(self.s))


class PartialAbsoluteSensor(ac.Component):
    """One flange that is measured without a force: ``flange.f = 0``."""

    ICON = icons.SENSOR

    flange = Flange()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange.f, 0)


class PartialRelativeSensor(PartialTwoFlanges):
    """Two flanges between which is measured, without inertia: ``flange_a.f + flange_b.f = 0``."""

    ICON = icons.SENSOR2

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.f + self.flange_b.f, 0)


class PartialFriction(Contact):
    """What friction elements share: a contact that slides or is stuck, as ``mode`` says.

    ``mode`` is -1 sliding backward, 0 stuck, 1 sliding forward, 2 free, 3 unknown. A stuck contact is ``locked``:
    its acceleration ``a_relfric`` is 0, and its friction is what that takes, the path parameter ``sa``. Where ``sa``
    exceeds ``f0_max``, sliding begins (``startForward``), and ends where the speed ``v_relfric`` becomes 0. With
    ``smooth`` there are neither modes nor events: the law of `acausal.components.laws.coulomb` creeps at rest, and it
    is stiffer for a smaller ``v_small``. A subclass states ``v_relfric``, ``a_relfric``, ``f0``, ``f0_max``
    and ``free``, and its force.
    """

    v_small = ac.Parameter(
        1e-3,
        unit="m/s",
        min=0,
        doc="a sliding contact turns back where Reinit gives it more speed against its direction; "
        "with smooth the speed below which friction is smoothed",
    )
    v_relfric = ac.Variable(unit="m/s", when="_locks", doc="speed of the surfaces")
    a_relfric = ac.Variable(unit="m/s2", when="_locks", doc="acceleration of the surfaces")
    f0 = ac.Variable(unit="N", when="_locks", doc="friction at rest, sliding forward")
    f0_max = ac.Variable(unit="N", when="_locks", doc="greatest friction while locked")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if not self.smooth:
            yield from self._contact(
                self.v_relfric, self.a_relfric, self.f0, self.f0_max, self.v_small
            )
