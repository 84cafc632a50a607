"""Electromotive force: ideal conversion between electrical and mechanical power."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons
from acausal.components.mechanics import rotational, translational

from .interfaces import OnePort

__modelica__ = "Modelica.Electrical.Analog.Basic"


class RotationalEMF(OnePort):
    """Rotary motor: ``v = k w``, ``tau = -k i`` with ``w = der(phi)``, ``phi = flange.phi - support.phi``.

    ``tau = flange.tau`` [N.m] is the cut torque, ``tauElectrical = -tau``. With ``useSupport`` the torque
    acts against the flange ``support``, else against the ground.
    """

    ICON = icons.EMF

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed to the ground")
    k = ac.Parameter(unit="N.m/A", doc="torque per current, = voltage per speed")
    flange = rotational.Flange_b()
    support = rotational.Flange_b(when="useSupport")
    phi = ac.Variable(unit="rad", doc="angle of the flange relative to the support")
    w = ac.Variable(unit="rad/s", doc="speed of the flange relative to the support")
    tau = ac.Variable(unit="N.m", doc="torque at the flange")
    tauElectrical = ac.Variable(unit="N.m", doc="electrical torque, = -tau")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi, self.flange.phi - (self.support.phi if self.useSupport else 0))
        yield ac.Eq(self.w, ac.der(self.phi))
        yield ac.Eq(self.k * self.w, self.v)
        yield ac.Eq(self.tau, -self.k * self.i)
        yield ac.Eq(self.tauElectrical, -self.tau)
        yield ac.Eq(self.tau, self.flange.tau)
        if self.useSupport:
            yield ac.Eq(self.support.tau, -self.tau)


class TranslationalEMF(OnePort):
    """Linear motor: ``v = k vel``, ``f = -k i`` with ``vel = der(s)``, ``s = flange.s - support.s``.

    ``f = flange.f`` [N] is the cut force, ``fElectrical = -f``. With ``useSupport`` the force acts against
    the flange ``support``, else against the ground.
    """

    ICON = icons.LINEAR_EMF

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed to the ground")
    k = ac.Parameter(unit="N/A", doc="force per current, = voltage per speed")
    flange = translational.Flange_b()
    support = translational.Flange_b(when="useSupport")
    s = ac.Variable(unit="m", doc="position of the flange relative to the support")
    vel = ac.Variable(unit="m/s", doc="speed of the flange relative to the support")
    f = ac.Variable(unit="N", doc="force at the flange")
    fElectrical = ac.Variable(unit="N", doc="electrical force, = -f")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.s, self.flange.s - (self.support.s if self.useSupport else 0))
        yield ac.Eq(self.vel, ac.der(self.s))
        yield ac.Eq(self.k * self.vel, self.v)
        yield ac.Eq(self.f, -self.k * self.i)
        yield ac.Eq(self.fElectrical, -self.f)
        yield ac.Eq(self.f, self.flange.f)
        if self.useSupport:
            yield ac.Eq(self.support.f, -self.f)
