"""Leakage flux tubes in air, of simple shapes: ``V_m = Phi R_m``, ``R_m = 1/G_m`` (Roters 1941)."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, nature

from .interfaces import Reluctance

__modelica__ = "Modelica.Magnetic.FluxTubes.Shapes.Leakage"


class Leakage(Reluctance):
    """Base: ``G_m`` [H] is ``mu_0`` times a length, which a subclass knows."""

    ICON = icons.tube("poles")

    __modelica__ = None

    @property
    def _length(self) -> Any:
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.G_m, nature.mu_0 * self._length)


class _Prism(Leakage):
    """A tube of the axial length ``l``."""

    l = ac.Parameter(
        0.1, unit="m", doc="axial length, orthogonal to the flux; 2 pi r of a round pole"
    )


class QuarterCylinder(_Prism):
    """From an edge to the opposite plane through a quarter cylinder: ``G_m = 0.52 mu_0 l``."""

    ICON = icons.tube("quarter")

    @property
    def _length(self) -> Any:
        return 0.52 * self.l


class QuarterHollowCylinder(_Prism):
    """Around a quarter of a hollow cylinder: ``G_m = 2 mu_0 l log(1 + ratio)/pi``."""

    ICON = icons.tube("quarter ring")

    ratio = ac.Parameter(doc="thickness over inner radius")

    @property
    def _length(self) -> Any:
        return 2 * self.l * ac.log(1 + self.ratio) / ac.pi


class HalfCylinder(_Prism):
    """Between the edges of a half cylinder: ``G_m = 0.26 mu_0 l``."""

    ICON = icons.tube("half")

    @property
    def _length(self) -> Any:
        return 0.26 * self.l


class HalfHollowCylinder(_Prism):
    """Around a half hollow cylinder: ``G_m = mu_0 l log(1 + ratio)/pi``."""

    ICON = icons.tube("half ring")

    ratio = ac.Parameter(doc="thickness over inner radius")

    @property
    def _length(self) -> Any:
        return self.l * ac.log(1 + self.ratio) / ac.pi


class QuarterSphere(Leakage):
    """Between the corners of a quarter sphere: ``G_m = 0.077 mu_0 2 r``."""

    ICON = icons.tube("quarter ball")

    r = ac.Parameter(0.005, unit="m", doc="radius")

    @property
    def _length(self) -> Any:
        return 0.077 * 2 * self.r


class QuarterHollowSphere(Leakage):
    """Between the edges of a quarter hollow sphere: ``G_m = 0.25 mu_0 t``."""

    ICON = icons.tube("quarter shell")

    t = ac.Parameter(unit="m", doc="thickness of the shell")

    @property
    def _length(self) -> Any:
        return 0.25 * self.t


class EighthOfSphere(Leakage):
    """From an edge to the opposite plane of an eighth of a sphere: ``G_m = 0.308 mu_0 r``."""

    ICON = icons.tube("eighth")

    r = ac.Parameter(0.01, unit="m", doc="radius")

    @property
    def _length(self) -> Any:
        return 0.308 * self.r


class EighthOfHollowSphere(Leakage):
    """From an edge to the opposite plane of an eighth of a hollow sphere: ``G_m = 0.5 mu_0 t``."""

    ICON = icons.tube("eighth shell")

    t = ac.Parameter(unit="m", doc="thickness of the shell")

    @property
    def _length(self) -> Any:
        return 0.5 * self.t


class CoaxCylindersEndFaces(Leakage):
    """Between the end planes of a cylinder and a coaxial hollow cylinder around it.

    ``G_m = 2 mu_0 (r_0 + l_g/2) log(1 + 2 min(t, r_0)/l_g)`` with the gap ``l_g = r_1 - r_0`` and the
    thickness ``t = r_2 - r_1``.
    """

    ICON = icons.tube("coaxial")

    r_0 = ac.Parameter(10e-3, unit="m", doc="radius of the inner cylinder")
    r_1 = ac.Parameter(17e-3, unit="m", doc="inner radius of the outer cylinder")
    r_2 = ac.Parameter(20e-3, unit="m", doc="outer radius of the outer cylinder")
    l_g = ac.Parameter(lambda self: self.r_1 - self.r_0, unit="m", doc="gap, computed")
    t = ac.Parameter(lambda self: self.r_2 - self.r_1, unit="m", doc="thickness, computed")

    @property
    def _length(self) -> Any:
        thickness = ac.minimum(self.t, self.r_0)
        return 2 * (self.r_0 + self.l_g / 2) * ac.log(1 + 2 * thickness / self.l_g)
