"""Values from one unit to another, and units in the base units of the SI: exponents, factor and offset."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.errors import DataError, UnitError
from acausal.units.dimensions import BASE, dimension, pint_unit, registry
from acausal.units.spelling import SpellingError, factors_of

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
        is_convertible = dimension(source) == dimension(target)
    except UnitError as e:
        reason = str(e).replace(f"'{source}'", f"'{given}'")
        raise DataError(f"{what}: {reason}") from None
    if not is_convertible:
        raise DataError(f"{what} is given in '{given}', which cannot become '{wanted or '1'}'.")
    quantity = registry().Quantity(values, pint_unit(source))
    return np.asarray(quantity.to(pint_unit(target)).magnitude, np.float64)


COHERENT = {"kg", "m", "s", "A", "K", "mol", "cd", "rad", "sr", "N", "Pa", "J", "W", "V", "Ohm", "S", "C", "F", "H",
            "Wb", "T", "Hz"}  # fmt: skip
"""Symbols with the factor 1."""


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
    """A unit in base units; None for what is not a unit, has fractions as exponents, or an unknown factor.

    Arguments:
        unit: for example ``"N.m/rad"``; radians count as pure numbers.
    """
    try:
        measured, factors = dimension(unit), factors_of(unit)
    except (UnitError, SpellingError):
        return None
    if measured is None or any(e.denominator != 1 for e in measured.exponents):
        return None
    factor, offset = 1.0, 0.0
    for symbol, power in factors:
        if symbol in COHERENT:
            continue
        scale = _scale(symbol)
        if scale is None:
            return None
        factor *= scale[0] ** float(power)
        if len(factors) == 1 and power == 1:
            offset = scale[1]
    exponents = {s: int(e) for s, e in zip(BASE, measured.exponents, strict=True) if e}
    return InSI(exponents, factor, offset)


def _scale(symbol: str) -> tuple[float, float] | None:
    """Factor and offset from a symbol to the base units."""
    try:
        at = convert(np.array([0.0, 1.0]), symbol, str(dimension(symbol)), symbol)
    except DataError:
        return None
    return float(f"{at[1] - at[0]:.12g}"), float(f"{at[0]:.12g}")
