"""Units of pint, from the factors that our own reader of units finds."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

from acausal.units.spelling import SpellingError, factors_of

if TYPE_CHECKING:
    import pint


@cache
def registry() -> pint.UnitRegistry[Any]:
    """The unit registry. Pint is imported and the registry made on first use, as this takes half a second."""
    import pint

    known = pint.UnitRegistry(cache_folder=None)
    known.define("@alias turn = rev")
    known.define("@alias ohm = Ohm")
    known.define("var = watt")  # of reactive power
    return known


@cache
def pint_unit(text: str) -> pint.Unit:
    """A pint unit from Modelica's spelling: ``"N.m/rad"``, ``"kg/m3"``, ``"m/s2"``, ``"1"``.

    Raises:
        SpellingError: for text that is not a unit, or a symbol that pint does not know.
    """
    import pint

    factors = factors_of(text)
    product = "*".join(s if power == 1 else f"{s}**{_number(power)}" for s, power in factors)
    try:
        return registry().parse_units(product or "dimensionless")
    except (pint.PintError, ValueError, TypeError, AttributeError, SyntaxError):
        raise SpellingError(text) from None


def _number(power: Fraction) -> int | float:
    return power.numerator if power.denominator == 1 else float(power)
