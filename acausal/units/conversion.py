"""Conversion: values from one unit to another."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from acausal.errors import DataError, UnitError
from acausal.units.dimensions import dimension
from acausal.units.pint_units import pint_unit, registry

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
