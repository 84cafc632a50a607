"""Flux tubes whose shape changes with an armature's position, and which therefore pull at it."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, nature
from acausal.components.mechanics.translational import Flange_b, Support

from .interfaces import Reluctance

__modelica__ = "Modelica.Magnetic.FluxTubes.Shapes.Force"


class Force(Reluctance):
    """Base: ``V_m = Phi R_m``, and the reluctance force ``F_m = V_m**2 dGmBydx/2 = -flange.f`` [N].

    ``l = s = flange.s - support.s`` [m] is the length that varies; without ``useSupport`` the support is
    fixed at 0. ``dlBydx`` is 1 where it grows with the armature's position, else -1. The relative
    permeability ``mu_r`` is constant. A subclass states ``G_m`` [H] and its derivative ``dGmBydx`` [H/m].
    """

    ICON = icons.tube("force")

    __modelica__ = None

    useSupport = ac.Option(False, doc="whether there is a support flange; else fixed at 0")
    dlBydx = ac.Option(1, choices=(1, -1), doc="derivative of l by the armature's position")
    flange = Flange_b()
    support = Support(when="useSupport")
    F_m = ac.Variable(unit="N", doc="reluctance force")
    s = ac.Variable(unit="m", doc="distance between flange and support")
    l = ac.Variable(unit="m", doc="length that varies")
    dGmBydx = ac.Variable(unit="H/m", doc="derivative of the permeance by the armature's position")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.F_m, self.V_m**2 * self.dGmBydx / 2)
        yield ac.Eq(self.s, self.flange.s - (self.support.s if self.useSupport else 0))
        if not self.is_given("l"):
            yield ac.Eq(self.l, self.s)
        yield ac.Eq(self.flange.f, -self.F_m)
        if self.useSupport:
            yield ac.Eq(self.support.f, -self.flange.f)

    def _stated(self, permeance: Any, dGmBydl: Any) -> Iterator[ac.Eq]:
        """The permeance and its derivative by ``l``."""
        yield ac.Eq(self.G_m, permeance)
        yield ac.Eq(self.dGmBydx, dGmBydl * self.dlBydx)


class _Permeable(Force):
    """A tube with a constant relative permeability."""

    mu_r = ac.Parameter(unit="1", doc="relative permeability")

    @property
    def _mu(self) -> Any:
        return nature.mu_0 * self.mu_r


class HollowCylinderAxialFlux(_Permeable):
    """Axial flux in a (hollow) cylinder of the length ``l``: ``G_m = mu_0 mu_r A/l``, ``B = Phi/A``.

    ``A = pi (r_o**2 - r_i**2)``.
    """

    ICON = icons.tube("axial", "F")

    r_i = ac.Parameter(0.0, unit="m", doc="inner radius")
    r_o = ac.Parameter(0.01, unit="m", doc="outer radius")
    B = ac.Variable(unit="T", doc="flux density")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        area = ac.pi * (self.r_o**2 - self.r_i**2)
        yield from self._stated(self._mu * area / self.l, -self._mu * area / self.l**2)
        yield ac.Eq(self.B, self.Phi / area)


class HollowCylinderRadialFlux(_Permeable):
    """Radial flux in a hollow cylinder of the length ``l``: ``G_m = 2 pi mu_0 mu_r l/log(r_o/r_i)``.

    ``B_avg = Phi/(pi (r_i + r_o) l)`` is the flux density at the mean radius.
    """

    ICON = icons.tube("radial", "F")

    r_i = ac.Parameter(0.01, unit="m", doc="inner radius")
    r_o = ac.Parameter(0.015, unit="m", doc="outer radius")
    B_avg = ac.Variable(unit="T", doc="flux density at the mean radius")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        dGmBydl = 2 * ac.pi * self._mu / ac.log(self.r_o / self.r_i)
        yield from self._stated(dGmBydl * self.l, dGmBydl)
        yield ac.Eq(self.B_avg, self.Phi / (ac.pi * (self.r_i + self.r_o) * self.l))


class CuboidParallelFlux(_Permeable):
    """Cuboid with the flux along the motion: ``G_m = mu_0 mu_r A/l``, ``A = a b``, ``B = Phi/A``."""

    ICON = icons.tube("cuboid", "F∥")

    a = ac.Parameter(0.01, unit="m", doc="width of the cross-section")
    b = ac.Parameter(0.01, unit="m", doc="height of the cross-section")
    B = ac.Variable(unit="T", doc="flux density")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        area = self.a * self.b
        yield from self._stated(self._mu * area / self.l, -self._mu * area / self.l**2)
        yield ac.Eq(self.B, self.Phi / area)


class CuboidOrthogonalFlux(_Permeable):
    """Cuboid with the flux across the motion: ``G_m = mu_0 mu_r A/b``, ``A = a l``, ``B = Phi/A``."""

    ICON = icons.tube("cuboid", "F⊥")

    a = ac.Parameter(0.01, unit="m", doc="width of the cross-section")
    b = ac.Parameter(0.01, unit="m", doc="height, in the direction of flux")
    B = ac.Variable(unit="T", doc="flux density")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        dGmBydl = self._mu * self.a / self.b
        yield from self._stated(dGmBydl * self.l, dGmBydl)
        yield ac.Eq(self.B, self.Phi / (self.a * self.l))


class LeakageAroundPoles(Force):
    """Leakage around poles at the distance ``l``: ``G_m = mu_0 w/pi log(1 + pi r/l)``."""

    ICON = icons.tube("poles", "F")

    w = ac.Parameter(0.1, unit="m", doc="width; the mean circumference of round poles")
    r = ac.Parameter(0.01, unit="m", doc="radius of the leakage field")
    mu_r = ac.Option(1.0, doc="without effect: the field is in air")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        width, ratio = nature.mu_0 * self.w, ac.pi * self.r / self.l
        dGmBydl = -width * self.r / (self.l**2 * (1 + ratio))
        yield from self._stated(width / ac.pi * ac.log(1 + ratio), dGmBydl)
