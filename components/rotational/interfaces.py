"""Bases that components and users' own elements extend; for the flange see `acausal.components.mechanics`."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.choices import STATE_SELECT
from acausal.components.mechanics.friction import Contact
from acausal.components.mechanics.rotational import Flange, Support

__modelica__ = "Modelica.Mechanics.Rotational.Interfaces"


class PartialTwoFlanges(ac.Component):
    """Two flanges without equations."""

    flange_a = Flange()
    flange_b = Flange()


class PartialOneFlangeAndSupport(ac.Component):
    """A flange and, with ``useSupport``, a support; for components put together from parts.

    Give the parts the same ``useSupport``, and connect their supports to this one where there is one.
    """

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed to the ground")
    flange = Flange()
    support = Support(when="useSupport")


class PartialTwoFlangesAndSupport(PartialTwoFlanges):
    """Two flanges and, with ``useSupport``, a support; for components put together from parts.

    Give the parts the same ``useSupport``, and connect their supports to this one where there is one.
    """

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed to the ground")
    support = Support(when="useSupport")


class PartialCompliant(PartialTwoFlanges):
    """An element without inertia, with a torque ``tau`` [N.m] over an angle ``phi_rel`` [rad].

    ``phi_rel = flange_b.phi - flange_a.phi``, ``flange_b.tau = tau``, ``flange_a.tau = -tau``.
    A subclass states ``tau``.
    """

    phi_rel = ac.Variable(unit="rad", doc="angle from flange_a to flange_b")
    tau = ac.Variable(unit="N.m", doc="torque between the flanges, = flange_b.tau")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi_rel, self.flange_b.phi - self.flange_a.phi)
        yield ac.Eq(self.flange_b.tau, self.tau)
        yield ac.Eq(self.flange_a.tau, -self.tau)


class PartialCompliantWithRelativeStates(PartialCompliant):
    """A compliant element that also knows ``w_rel = der(phi_rel)`` and ``a_rel = der(w_rel)``.

    Absolute angles and speeds of inertias are preferred as states, so ``stateSelect`` is
    ``"default"`` here (Modelica: ``"prefer"``); with ``"prefer"`` an element's ``phi_rel`` and
    ``w_rel`` become states. ``phi_nominal`` [rad] is the magnitude of ``phi_rel``, for scaling only.
    """

    stateSelect = ac.Option(
        "default", choices=STATE_SELECT, doc="priority of phi_rel, w_rel as states"
    )
    phi_nominal = ac.Option(1e-4, doc="nominal value of phi_rel")
    phi_rel = ac.Variable(
        unit="rad",
        state="stateSelect",
        nominal="phi_nominal",
        doc="angle from flange_a to flange_b",
    )
    w_rel = ac.Variable(unit="rad/s", state="stateSelect", doc="relative speed")
    a_rel = ac.Variable(unit="rad/s2", doc="relative acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w_rel, ac.der(self.phi_rel))
        yield ac.Eq(self.a_rel, ac.der(self.w_rel))


class PartialElementaryOneFlangeAndSupport2(ac.Component):
    """One flange that works against a support, or against the ground without ``useSupport``.

    ``phi = flange.phi - support.phi`` [rad], ``support.tau = -flange.tau``.
    """

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed to the ground")
    flange = Flange()
    support = Support(when="useSupport")
    phi = ac.Variable(unit="rad", doc="angle of the flange relative to the support")

    @property
    def phi_support(self) -> Any:
        """Angle of the support."""
        return self.support.phi if self.useSupport else 0

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi, self.flange.phi - self.phi_support)
        if self.useSupport:
            yield ac.Eq(self.support.tau, -self.flange.tau)


class PartialElementaryTwoFlangesAndSupport2(PartialTwoFlanges):
    """Two flanges that work against a support, or against the ground without ``useSupport``.

    ``phi_a = flange_a.phi - support.phi``, ``phi_b = flange_b.phi - support.phi`` [rad],
    ``support.tau = -flange_a.tau - flange_b.tau``.
    """

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed to the ground")
    support = Support(when="useSupport")
    phi_a = ac.Variable(unit="rad", doc="angle of flange_a relative to the support")
    phi_b = ac.Variable(unit="rad", doc="angle of flange_b relative to the support")

    @property
    def phi_support(self) -> Any:
        """Angle of the support."""
        return self.support.phi if self.useSupport else 0

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi_a, self.flange_a.phi - self.phi_support)
        yield ac.Eq(self.phi_b, self.flange_b.phi - self.phi_support)
        if self.useSupport:
            yield ac.Eq(self.support.tau, -self.flange_a.tau - self.flange_b.tau)


class PartialTorque(PartialElementaryOneFlangeAndSupport2):
    """A torque ``tau = -flange.tau`` [N.m] that drives what is connected to the flange."""

    ICON = icons.TORQUE

    tau = ac.Variable(unit="N.m", doc="driving torque, = -flange.tau")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.tau, -self.flange.tau)


class PartialAbsoluteSensor(ac.Component):
    """One flange that is measured without a torque: ``flange.tau = 0``."""

    ICON = icons.SENSOR

    flange = Flange()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange.tau, 0)


class PartialRelativeSensor(PartialTwoFlanges):
    """Two flanges between which is measured, without inertia: ``flange_a.tau + flange_b.tau = 0``."""

    ICON = icons.SENSOR2

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flange_a.tau + self.flange_b.tau, 0)


class PartialFriction(Contact):
    """What friction elements share: a contact that slides or is stuck, as ``mode`` says.

    ``mode`` is -1 sliding backward, 0 stuck, 1 sliding forward, 2 free, 3 unknown. A stuck contact is ``locked``:
    its acceleration ``a_relfric`` is 0, and its friction is what that takes, the path parameter ``sa``. Where ``sa``
    exceeds ``tau0_max``, sliding begins (``startForward``), and ends where the speed ``w_relfric`` becomes 0. With
    ``smooth`` there are neither modes nor events: the law of `acausal.components.laws.coulomb` creeps at rest, and it
    is stiffer for a smaller ``w_small``. A subclass states ``w_relfric``, ``a_relfric``,
    ``tau0``, ``tau0_max`` and ``free``, and its torque.
    """

    w_small = ac.Parameter(
        1e10,
        unit="rad/s",
        min=0,
        doc="a sliding contact turns back where Reinit gives it more speed against its direction; "
        "with smooth the speed below which friction is smoothed, 1e-4 rad/s unless it is given",
    )
    w_relfric = ac.Variable(unit="rad/s", when="_locks", doc="speed of the surfaces")
    a_relfric = ac.Variable(unit="rad/s2", when="_locks", doc="acceleration of the surfaces")
    tau0 = ac.Variable(unit="N.m", when="_locks", doc="friction at rest, sliding forward")
    tau0_max = ac.Variable(unit="N.m", when="_locks", doc="greatest friction while locked")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if not self.smooth:
            yield from self._contact(
                self.w_relfric, self.a_relfric, self.tau0, self.tau0_max, self.w_small
            )

    @property
    def _width(self) -> Any:
        """Speed below which the smooth law is smoothed."""
        return _smooth_width(self.w_small)


def _smooth_width(w_small: Any) -> Any:
    """Speed below which a smooth law is smoothed: ``w_small``, or 1e-4 rad/s where that keeps its default."""
    return ac.where(w_small < 1e9, w_small, 1e-4)
