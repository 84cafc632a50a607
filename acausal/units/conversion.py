"""Units: Modelica's spelling read by pint, and values converted from one unit to another."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

import numpy as np

from acausal.errors import DataError


@cache
def registry() -> Any:
    """The unit registry (pint is slow to import, so only where a unit is read)."""
    import pint

    known = pint.UnitRegistry(cache_folder=None)
    known.define("@alias turn = rev")
    known.define("@alias ohm = Ohm")
    return known


@cache
def parse(text: str) -> Any:
    """A pint unit from Modelica's spelling: ``"N.m/rad"``, ``"kg/m3"``, ``"m/s2"``, ``"1"``, ``""``.

    Raises:
        DataError: for text that is no unit.
    """
    import pint

    spelled = re.sub(r"\.(?=[A-Za-z(])", "*", text.strip())
    spelled = re.sub(r"(?<=[A-Za-z])(-?\d+)", r"**\1", spelled)
    try:
        return registry().parse_units(spelled if spelled not in ("", "1") else "dimensionless")
    except (pint.PintError, ValueError, TypeError, AttributeError, SyntaxError) as e:
        raise DataError(f"'{text}' is no unit: {e}") from None


def convert(values: np.ndarray, given: str, wanted: str, what: str) -> np.ndarray:
    """Values in unit ``given`` as values in unit ``wanted``; ``what`` names them in an error.

    Raises:
        DataError: for a unit that is not known, or of another dimension.
    """
    if given == wanted:
        return values
    try:
        source, target = parse(given), parse(wanted)
    except DataError as e:
        raise DataError(f"{what}: {e}") from None
    if source.dimensionality != target.dimensionality:
        raise DataError(f"{what} is given in '{given}', which cannot become '{wanted or '1'}'.")
    return np.asarray(registry().Quantity(values, source).to(target).magnitude, float)
