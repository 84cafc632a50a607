"""Values from one unit to another, and units in the base units of the SI: exponents, factor and offset."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.errors import DataError, UnitError
from acausal.units.dimensions import BASE, dimension, pint_unit, registry

Numbers = np.ndarray[Any, np.dtype[np.float64]]


BETWEEN = re.compile(r"(?<=[\w)])\s+(?=[^\W\d_]|\()")
"""A space between two symbols, as in ``"kg m"``: people write products so."""


def convert(values: Numbers, given: str, wanted: str, what: str) -> Numbers:
    """Values in unit ``given`` as values in unit ``wanted``; ``what`` names them in an error.

    Raises:
        DataError: for a unit that is not known, or of another dimension.
    """
    if given == wanted:
        return values
    source, target = (BETWEEN.sub(".", unit.strip()) or "1" for unit in (given, wanted))
    try:
        dimensions = [found and found.exponents for found in map(dimension, (source, target))]
    except UnitError as e:
        reason = str(e).replace(f"'{source}'", f"'{given}'")
        raise DataError(f"{what}: {reason}") from None
    if dimensions[0] != dimensions[1]:
        declare = f": declare unit='{given}' in the model, or give its numbers with the unit '1'"
        raise DataError(
            f"{what} is given in '{given}', which cannot become '{wanted or '1'}'{declare * (target == '1')}."
        )
    quantity = registry().Quantity(values, pint_unit(source))
    return np.asarray(quantity.to(pint_unit(target)).magnitude, np.float64)


@dataclass(frozen=True)
class InSI:
    """A unit: a value v of it is ``factor * v + offset`` in base units.

    Attributes:
        exponents: by the base unit's symbol, those that are not zero.
    """

    exponents: dict[str, int]
    factor: float = 1.0
    offset: float = 0.0


def in_si(unit: str) -> InSI | None:
    """A unit such as ``"N.m/rad"`` in base units, radians as pure numbers.

    None for what is not a unit, has fractions as exponents, or an unknown factor.
    """
    try:
        measured = dimension(unit)
    except UnitError:
        return None
    if measured is None or math.isnan(measured.factor):
        return None
    if any(e.denominator != 1 for e in measured.exponents):
        return None
    exponents = {s: int(e) for s, e in zip(BASE, measured.exponents, strict=True) if e}
    return InSI(exponents, float(f"{measured.factor:.12g}"), float(f"{measured.zero or 0.0:.12g}"))
