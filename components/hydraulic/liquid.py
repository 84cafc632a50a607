"""Liquids that are compressed, with air in them."""

from dataclasses import dataclass
from typing import Any

import acausal as ac

LEAST = 1e-3
"""Least absolute pressure over that of the ambience: below it the density does not fall any further."""


@dataclass(frozen=True)
class Liquid:
    """A liquid at one temperature, as a record that components take by their option ``fluid``.

    With the absolute pressure ``p_abs`` a mass fills ``(1 - air) exp(-(p_abs - p_ambient)/bulk_modulus) + air
    (p_ambient/p_abs)**(1/n)`` times the volume that it fills at ``p_ambient``. Pressures of ports count from the
    ambience: ``p_abs = p_ambient + p``.

    Arguments:
        density: at the pressure of the ambience [kg/m3].
        bulk_modulus: of the liquid without air [Pa].
        viscosity: dynamic [Pa.s].
        air: part of the volume at the pressure of the ambience that is undissolved air.
        n: polytropic exponent of the air.
        p_ambient: absolute pressure of the ambience [Pa].
    """

    density: float = 997.0
    bulk_modulus: float = 2.09e9
    viscosity: float = 1.0016e-3
    air: float = 0.0
    n: float = 1.4
    p_ambient: float = 101325.0

    def __post_init__(self) -> None:
        positive = ("density", "bulk_modulus", "viscosity", "n", "p_ambient")
        wrong = next((name for name in positive if not getattr(self, name) > 0), None)
        if wrong or not 0 <= self.air < 1:
            name, range_ = (wrong, "above zero") if wrong else ("air", "0 to 1, without 1")
            raise ac.DeclarationError(f"Liquid.{name}={getattr(self, name)} must be {range_}")

    def density_at(self, p: Any) -> Any:
        """The density at a pressure above that of the ambience."""
        volume = (1 - self.air) * ac.exp(-p / self.bulk_modulus)
        if self.air:
            ratio = ac.maximum(1 + p / self.p_ambient, LEAST)
            volume += self.air * ratio ** (-1 / self.n)
        return self.density / volume


WATER = Liquid()
OIL = Liquid(density=870.0, bulk_modulus=1.4e9, viscosity=0.04, air=0.005)
"""A mineral oil for hydraulics."""
