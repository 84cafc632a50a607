"""Flux tubes of fixed shape, of a material whose permeability is constant or depends on the flux density."""

from collections.abc import Iterator
from math import pi
from typing import Any

import acausal as ac
from acausal.components import icons, nature

from .interfaces import Reluctance
from .soft_magnetic import BaseData

__modelica__ = "Modelica.Magnetic.FluxTubes.Shapes.FixedShape"

_INSIDE_OUT = "a hollow cylinder is wider outside"
"""What it means that its radii are not in order."""


class FixedShape(Reluctance):
    """Base: ``V_m = Phi R_m``, ``R_m = 1/G_m``, ``B = Phi/A``, ``H = B/(mu_0 mu_r)``.

    The relative permeability ``mu_r`` is ``mu_rConst``, or with ``nonLinearPermeability``
    ``1 + (mu_i - 1 + c_a b)/(1 + c_b b + b**n)`` with ``b = |B/B_myMax|``. Its coefficients are those of
    the record ``material``, one of `soft_magnetic`, unless given. A subclass states ``A`` and ``G_m``.
    """

    __modelica__ = None

    nonLinearPermeability = ac.Option(True, doc="whether mu_r depends on B")
    material = ac.Option(BaseData(), doc="soft magnetic material")
    mu_rConst = ac.Parameter(1.0, unit="1", doc="relative permeability if it is constant")
    mu_i = ac.Parameter(
        lambda self: self.material.mu_i,
        unit="1",
        when="nonLinearPermeability",
        doc="relative permeability at B = 0",
    )
    B_myMax = ac.Parameter(
        lambda self: self.material.B_myMax,
        unit="T",
        when="nonLinearPermeability",
        doc="flux density at the greatest permeability",
    )
    c_a = ac.Parameter(
        lambda self: self.material.c_a, when="nonLinearPermeability", doc="coefficient of mu_r"
    )
    c_b = ac.Parameter(
        lambda self: self.material.c_b, when="nonLinearPermeability", doc="coefficient of mu_r"
    )
    n = ac.Parameter(
        lambda self: self.material.n, when="nonLinearPermeability", doc="exponent of mu_r"
    )
    B = ac.Variable(unit="T", doc="magnetic flux density")
    A = ac.Variable(unit="m2", nominal=1e-4, doc="cross-section that the flux penetrates")
    H = ac.Variable(unit="A/m", nominal=1e3, doc="magnetic field strength")
    mu_r = ac.Variable(unit="1", nominal=1e3, doc="relative permeability")

    def modify(self, **modifiers: Any) -> None:
        """As of every component; the material must be a record of a soft magnetic material."""
        material = modifiers.get("material", self.material)
        if not isinstance(material, BaseData):
            raise ac.DeclarationError(
                f"{type(self).__name__}: material={material!r} is not a soft magnetic material; "
                "give a record such as magnetic.M350_50A()"
            )
        super().modify(**modifiers)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.mu_r, self._permeability)
        yield ac.Eq(self.B, self.Phi / self.A)
        yield ac.Eq(self.H, self.B / (nature.mu_0 * self.mu_r))

    @property
    def _permeability(self) -> Any:
        if not self.nonLinearPermeability:
            return self.mu_rConst
        b = ac.Abs(self.B / self.B_myMax)
        power = ac.maximum(b, 1e-12) ** self.n  # whose derivative is finite at 0
        return 1 + (self.mu_i - 1 + self.c_a * b) / (1 + self.c_b * b + power)

    def _stated(self, area: Any, per_permeability: Any) -> Iterator[ac.Eq]:
        """The cross-section, and the permeance from what it is per permeability [m]."""
        yield ac.Eq(self.A, area)
        yield ac.Eq(self.G_m, nature.mu_0 * self.mu_r * per_permeability)


class GenericFluxTube(FixedShape):
    """Any shape: ``A = area``, ``G_m = mu_0 mu_r A/l``."""

    ICON = icons.marked(icons.RELUCTANCE, "A/l")

    l = ac.Parameter(0.01, unit="m", doc="length in the direction of flux")
    area = ac.Parameter(0.0001, unit="m2", doc="cross-section")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield from self._stated(self.area, self.area / self.l)


class Cuboid(FixedShape):
    """Rectangular cross-section: ``A = a b``, ``G_m = mu_0 mu_r A/l``."""

    ICON = icons.tube("cuboid")

    l = ac.Parameter(0.01, unit="m", doc="length in the direction of flux")
    a = ac.Parameter(0.01, unit="m", doc="width of the cross-section")
    b = ac.Parameter(0.01, unit="m", doc="height of the cross-section")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        area = self.a * self.b
        yield from self._stated(area, area / self.l)


class HollowCylinderAxialFlux(FixedShape):
    """Axial flux in a (hollow) cylinder: ``A = pi (r_o**2 - r_i**2)``, ``G_m = mu_0 mu_r A/l``."""

    ICON = icons.tube("axial")

    l = ac.Parameter(0.01, unit="m", doc="axial length")
    r_i = ac.Parameter(0.0, unit="m", doc="inner radius; zero for a cylinder")
    r_o = ac.Parameter(0.01, unit="m", doc="outer radius")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Assert(self.r_i < self.r_o, _INSIDE_OUT)
        area = ac.pi * (self.r_o**2 - self.r_i**2)
        yield from self._stated(area, area / self.l)


class HollowCylinderRadialFlux(FixedShape):
    """Radial flux in a hollow cylinder or a sector of it: ``G_m = mu_0 mu_r alpha l/log(r_o/r_i)``.

    ``A = l alpha (r_o + r_i)/2`` is that of the mean radius.
    """

    ICON = icons.tube("radial")

    l = ac.Parameter(0.01, unit="m", doc="axial length, orthogonal to the flux")
    r_i = ac.Parameter(0.01, unit="m", doc="inner radius")
    r_o = ac.Parameter(0.02, unit="m", doc="outer radius")
    alpha = ac.Parameter(2 * pi, unit="rad", doc="central angle")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Assert(self.r_i < self.r_o, _INSIDE_OUT)
        width = self.l * self.alpha
        area = width * (self.r_o + self.r_i) / 2
        yield from self._stated(area, width / ac.log(self.r_o / self.r_i))


class HollowCylinderCircumferentialFlux(FixedShape):
    """Flux around a hollow cylinder: ``A = l (r_o - r_i)``, ``G_m = mu_0 mu_r A/(alpha (r_o + r_i)/2)``."""

    ICON = icons.tube("around")

    l = ac.Parameter(0.02, unit="m", doc="axial length, orthogonal to the flux")
    r_i = ac.Parameter(0.01, unit="m", doc="inner radius")
    r_o = ac.Parameter(0.02, unit="m", doc="outer radius")
    alpha = ac.Parameter(pi / 2, unit="rad", doc="central angle")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Assert(self.r_i < self.r_o, _INSIDE_OUT)
        area = self.l * (self.r_o - self.r_i)
        yield from self._stated(area, area / ((self.r_o + self.r_i) / 2 * self.alpha))


class Toroid(FixedShape):
    """Flux around a toroid with a circular cross-section: ``A = pi d**2/4``, ``G_m = mu_0 mu_r A/(r alpha)``."""

    ICON = icons.tube("toroid")

    r = ac.Parameter(0.1, unit="m", doc="mean radius of the toroid")
    d = ac.Parameter(0.01, unit="m", doc="diameter of the core")
    alpha = ac.Parameter(pi / 2, unit="rad", doc="central angle")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        area = ac.pi * self.d**2 / 4
        yield from self._stated(area, area / (self.r * self.alpha))
