"""Units of an FMU's variables: a model has values in SI units, the FMU in units of its own."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from acausal.units import InSI, in_si

BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
NAMED = ("N", "Pa", "W", "V")
"""Units that are shown by their own name."""


@dataclass(frozen=True)
class Conversion:
    """A value v of the FMU is ``factor * v + offset`` in the model, which has it in ``unit``."""

    unit: str = ""
    factor: float = 1.0
    offset: float = 0.0

    def to_model(self, value: Any) -> Any:
        """A value of the FMU in the model's unit."""
        value = value if self.factor == 1.0 else self.factor * value
        return value if self.offset == 0.0 else value + self.offset

    def to_fmu(self, value: Any) -> Any:
        """A value of the model in the FMU's unit."""
        value = value if self.offset == 0.0 else value - self.offset
        return value if self.factor == 1.0 else value / self.factor


def definitions(units: Any) -> dict[str, InSI]:
    """The units that an FMU defines by base units, by name.

    Raises:
        ValueError: for a factor that is no number above or below zero.
    """
    found: dict[str, InSI] = {}
    for unit in units:
        if (base := unit.baseUnit) is not None:
            factor, offset = float(base.factor), float(base.offset)
            if factor == 0.0 or not math.isfinite(factor) or not math.isfinite(offset):
                raise ValueError(f"the unit '{unit.name}' has the factor {factor:g}")
            exponents = {s: int(e) for s in BASE if (e := getattr(base, s))}
            found[unit.name] = InSI(exponents, factor, offset)
    return found


def conversion(unit: str, known: Mapping[str, InSI], *, is_difference: bool) -> Conversion:
    """From a unit of an FMU to that of the model: as the FMU defines it, else as its text says.

    Arguments:
        is_difference: whether the variable is a difference, of two temperatures for example: it has no offset.
    """
    si = known.get(unit) or (in_si(unit) if unit else None)
    offset = 0.0 if si is None or is_difference else si.offset
    if si is None or (si.factor == 1.0 and offset == 0.0):
        return Conversion(unit)
    return Conversion(_spelled(si.exponents), si.factor, offset)


def _spelled(exponents: Mapping[str, int]) -> str:
    for name in NAMED:
        named = in_si(name)
        if named is not None and named.exponents == exponents:
            return name
    parts = (f"{s}{'' if e == 1 else e}" for s, e in exponents.items())
    return ".".join(parts) or "1"
