"""Permanent magnets (`Modelica.Magnetic.FluxTubes.Shapes.HysteresisAndMagnets`)."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, nature

from .hard_magnetic import BaseData
from .interfaces import TwoPort

__modelica__ = "Modelica.Magnetic.FluxTubes.Shapes.HysteresisAndMagnets"


class GenericLinearPermanentMagnet(TwoPort):
    """Permanent magnet with a straight characteristic: ``B = -B_r + mu_0 mu_r H``.

    ``V_m = H l``, ``Phi = B A``. ``B_r`` [T] and ``mu_r`` are those of the record ``mat``, one of
    `hard_magnetic`, unless given.
    """

    ICON = icons.MAGNET

    l = ac.Parameter(0.1, unit="m", doc="length in the direction of flux")
    A = ac.Parameter(1e-4, unit="m2", doc="cross-section")
    mat = ac.Option(BaseData(), doc="hard magnetic material")
    B_r = ac.Parameter(lambda self: self.mat.B_r, unit="T", doc="remanence")
    mu_r = ac.Parameter(lambda self: self.mat.mu_r, unit="1", doc="relative permeability")
    H = ac.Variable(unit="A/m", nominal=1e3, doc="magnetic field strength")
    B = ac.Variable(unit="T", doc="magnetic flux density")

    def modify(self, **modifiers: Any) -> None:
        """As of every component; the material must be a record of a hard magnetic material."""
        material = modifiers.get("mat", self.mat)
        if not isinstance(material, BaseData):
            raise ac.DeclarationError(
                f"{type(self).__name__}: mat={material!r} is not a hard magnetic material; "
                "give a record such as magnetic.hard_magnetic.NdFeB()"
            )
        super().modify(**modifiers)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.V_m, self.H * self.l)
        yield ac.Eq(self.Phi, self.B * self.A)
        yield ac.Eq(self.B, -self.B_r + nature.mu_0 * self.mu_r * self.H)
