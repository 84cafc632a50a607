"""Dimensions of units: ``"N.m/rad"`` as exponents of the SI's base units, and how large a unit is.

Tables here hold the usual units of models; the others come from pint. To use pint for all of them would be slow: its
import and registry take 0.5 s in every process that compiles a model, whereas the 75 units of the library are read here
in 5 ms, and the quarter vehicle is checked in 1.3 ms. The tests compare the tables with pint.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

from acausal.errors import UnitError, nearest, shortened, shown
from acausal.units.spelling import SpellingError, factors_of

if TYPE_CHECKING:
    import pint

BASE = {"kg": "[mass]", "m": "[length]", "s": "[time]", "A": "[current]",
        "K": "[temperature]", "mol": "[substance]", "cd": "[luminosity]"}  # fmt: skip
"""The SI's base units, and pint's names of their dimensions."""

DERIVED = {
    **dict.fromkeys(("rad", "sr", "deg", "rev"), "1"),
    "N": "kg.m/s2", "Pa": "kg/(m.s2)", "J": "kg.m2/s2", "W": "kg.m2/s3", "var": "W",
    "V": "kg.m2/(A.s3)", "Ohm": "kg.m2/(A2.s3)", "S": "A2.s3/(kg.m2)", "C": "A.s",
    "F": "A2.s4/(kg.m2)", "H": "kg.m2/(A2.s2)", "Wb": "kg.m2/(A.s2)", "T": "kg/(A.s2)",
    "Hz": "1/s", "g": "kg", "t": "kg", "l": "m3", "bar": "kg/(m.s2)", "mbar": "bar", "mmHg": "bar",
    "eV": "kg.m2/s2", "lm": "cd", "min": "s", "h": "s", "d": "s", "degC": "K", "degF": "K", "degR": "K",
}  # fmt: skip
"""Further symbols of units in Modelica, and a unit of the same dimension, perhaps of another scale."""

FACTORS = {"deg": math.pi / 180, "rev": 2 * math.pi, "g": 1e-3, "t": 1e3, "l": 1e-3, "bar": 1e5, "mbar": 1e2,
           "mmHg": 133.322387415, "eV": 1.602176634e-19, "min": 60.0, "h": 3600.0, "d": 86400.0, "degF": 5 / 9,
           "degR": 5 / 9}  # fmt: skip
"""Symbols that are not of the SI's scale, and how many of the SI's units each is."""

ZEROS = {"degC": 273.15, "degF": 459.67 * 5 / 9}
"""Where the scales of temperatures begin [K]."""

PREFIXES = {
    "da": 1e1, "Y": 1e24, "Z": 1e21, "E": 1e18, "P": 1e15, "T": 1e12, "G": 1e9, "M": 1e6, "k": 1e3, "h": 1e2,
    "d": 1e-1, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12, "f": 1e-15, "a": 1e-18, "z": 1e-21, "y": 1e-24,
}  # fmt: skip
PREFIXED = (*BASE, "g", "N", "Pa", "J", "W", "V", "Ohm", "S", "C", "F", "H", "Wb", "T", "Hz", "l",
             "eV", "rad")  # fmt: skip
"""Symbols that a prefix may precede."""

QUANTITIES = {
    "1": "pure number", "m": "length", "m2": "area", "m3": "volume", "s": "time", "m/s": "speed",
    "m/s2": "acceleration", "1/s": "frequency or angular velocity", "1/s2": "angular acceleration",
    "kg": "mass", "kg.m2": "moment of inertia", "m3/s": "volume flow",
    "kg/m3": "density", "N": "force", "N/m": "stiffness", "N.s/m": "damping or mass flow", "N.s": "momentum",
    "N.m": "torque or energy", "N.m.s": "rotational damping", "W": "power", "Pa": "pressure",
    "Pa.s": "viscosity", "K": "temperature", "1/K": "temperature coefficient", "J/K": "heat capacity",
    "W/K": "thermal conductance", "K/W": "thermal resistance", "J/(kg.K)": "specific heat capacity",
    "J/kg": "specific energy", "A": "current", "V": "voltage", "C": "charge", "Ohm": "resistance",
    "S": "conductance", "F": "capacitance", "H": "inductance", "Wb": "magnetic flux",
    "T": "flux density", "A/m": "magnetic field strength", "V/m": "electric field strength",
    "1/H": "reluctance", "H/m": "permeability", "F/m": "permittivity", "Ohm.m": "resistivity",
    "S/m": "conductivity",
}  # fmt: skip
"""Units in the spelling of messages, and the quantities that they measure."""

SPELLED = ("N", "W", "V", "Ohm", "Wb")
"""Derived units that messages use in spelling a unit that is not among `QUANTITIES`."""

_longest_first = "|".join(sorted((*BASE, *DERIVED), key=len, reverse=True))
LETTERS = re.compile(rf"{_longest_first}|[kMm](?:{_longest_first})")
JOINED = re.compile(rf"(?:{LETTERS.pattern})+")
"""Several units without a dot between them."""

Exponent = int | Fraction


@dataclass(frozen=True)
class Dimension:
    """A product of powers of the base units, in the order of `BASE`, and the unit in which it is counted.

    Attributes:
        factor: how many of the SI's units that unit is; NaN where it is not known.
        zero: where its scale begins [K]; None where that is not known, as for differences and products.
        name: of the unit, as it was read.
    """

    exponents: tuple[Exponent, ...]
    factor: float = field(default=1.0, compare=False)
    zero: float | None = field(default=None, compare=False)
    name: str = field(default="", compare=False)
    scale: tuple[str, float] = field(init=False)  # without roundoff

    def __post_init__(self) -> None:
        object.__setattr__(self, "scale", (f"{self.factor:.9g}", self.zero or 0.0))

    def __mul__(self, other: Dimension) -> Dimension:
        exponents = tuple(a + b for a, b in zip(self.exponents, other.exponents, strict=True))
        return Dimension(exponents, self.factor * other.factor)

    def __truediv__(self, other: Dimension) -> Dimension:
        return self * other**-1

    def __pow__(self, exponent: Exponent) -> Dimension:
        whole = exponent.numerator if exponent.denominator == 1 else exponent
        return Dimension(tuple(a * whole for a in self.exponents), self.factor ** float(exponent))

    def __str__(self) -> str:
        """A unit as a person writes it: ``"N.m"``, ``"A.s2/kg"``, ``"1"``, ``"bar"``, ``"0.001 m/s"``."""
        if (self.factor == 1.0 or math.isnan(self.factor)) and not self.zero:
            return _usual().get(self.exponents) or _spelled(self)
        return self.name or f"{self.factor:.6g} {self.of_si}".removesuffix(" 1")

    @property
    def of_si(self) -> Dimension:
        """The SI's unit of this dimension."""
        return Dimension(self.exponents)

    def agrees(self, other: Dimension) -> bool:
        """Whether both are counted in one unit, as far as their factors are known."""
        unknown = math.isnan(self.factor * other.factor)
        return self.exponents == other.exponents and (unknown or self.scale[0] == other.scale[0])

    def is_on_scale_of(self, other: Dimension) -> bool:
        """Whether both scales begin at one point, as far as these are known."""
        return self.zero is None or other.zero is None or self.zero == other.zero


NUMBER = Dimension((0,) * len(BASE))
BASES = {symbol: Dimension(tuple(int(other == symbol) for other in BASE)) for symbol in BASE}
SECOND = BASES["s"]


@cache
def dimension(text: str) -> Dimension | None:
    """The dimension of a unit in Modelica's spelling; None for ``""``, a unit that is not given.

    Raises:
        UnitError: for text that is not a unit; it names the nearest one.
    """
    if not isinstance(text, str):
        raise UnitError(f"{shown(text)} is not a unit; a text is needed, such as 'N/m'")
    return _read(text) if text.strip() else None


def described(measured: Dimension) -> str:
    """A unit and what it measures, for a message: ``"N (force)"``."""
    unit, si = str(measured), str(measured.of_si)
    return f"{unit} ({QUANTITIES[si]})" if si in QUANTITIES else unit


# -- reading ---------------------------------------------------------------------------------------


@cache
def _read(text: str) -> Dimension:
    try:
        factors = factors_of(text)
    except SpellingError:
        raise _no_unit(text) from None
    found = NUMBER
    for symbol, power in factors:
        found *= _symbol(symbol, text) ** power
    alone = len(factors) == 1 and factors[0][1] == 1 and math.isfinite(found.factor)
    return replace(found, name=text, zero=ZEROS.get(factors[0][0], 0.0) if alone else None)


def _no_unit(text: str, meant: str | None = None) -> UnitError:
    known = [meant] if meant else [*QUANTITIES, *DERIVED]
    return UnitError(f"'{shortened(text)}' is not a unit; {nearest(meant or text, known)}")


def _symbol(symbol: str, text: str) -> Dimension:
    """The dimension of a symbol in a text; symbols that pint reads as an unlikely unit are refused."""
    known = _known(symbol)
    if known is not None:
        return known
    alike, found = _lookalike(symbol), _of_pint(symbol)
    if found is None or (alike is not None and _read(alike).exponents != found.exponents):
        raise _no_unit(text, text.replace(symbol, alike) if alike else None)
    return found


@cache
def _known(symbol: str) -> Dimension | None:
    """The dimension of a symbol of these tables, perhaps behind a prefix."""
    if symbol in BASES:
        return BASES[symbol]
    if symbol in DERIVED:
        return replace(_read(DERIVED[symbol]), factor=FACTORS.get(symbol, 1.0))
    for prefix, factor in PREFIXES.items():
        rest = symbol.removeprefix(prefix)
        if rest != symbol and rest in PREFIXED and (known := _known(rest)) is not None:
            return known * Dimension(NUMBER.exponents, factor)
    return None


def _lookalike(symbol: str) -> str | None:
    """The unit that may have been meant: in other letters (``"Kg"``), or two without a dot (``"Nm"``)."""
    for other in (*BASE, *DERIVED):
        if other.lower() == symbol.lower():
            return other
    return ".".join(LETTERS.findall(symbol)) if JOINED.fullmatch(symbol) else None


def _of_pint(symbol: str) -> Dimension | None:
    """The dimension of a symbol that only pint knows: ``"ft"``, ``"lbf"``, ``"newton"``; None for no unit."""
    try:
        unit = pint_unit(symbol)
    except SpellingError:
        return None
    powers: dict[str, Any] = dict(unit.dimensionality)
    exponents = tuple(Fraction(powers.pop(name, 0)) for name in BASE.values())
    if powers:
        return None
    none, one, two = (
        float(registry().Quantity(n, unit).to_base_units().magnitude) for n in (0.0, 1.0, 2.0)
    )
    proportional = none == 0.0 and math.isclose(two, 2 * one)  # not decibels, for example
    return Dimension(exponents, one if proportional else math.nan)


# -- writing ---------------------------------------------------------------------------------------


@cache
def _usual() -> dict[tuple[Exponent, ...], str]:
    return {_read(unit).exponents: unit for unit in QUANTITIES}


def _spelled(measured: Dimension) -> str:
    """The base units, or one derived unit and base units, whichever takes fewer factors."""
    powers = [dict(zip(BASE, measured.exponents, strict=True))]
    for unit in SPELLED:
        for power in (1, -1, 2, -2):
            rest = measured / _read(unit) ** power
            powers.append({unit: power, **dict(zip(BASE, rest.exponents, strict=True))})
    return _text(min(powers, key=lambda factors: sum(map(abs, factors.values()))))


def _text(powers: dict[str, Exponent]) -> str:
    above = [_power(unit, e) for unit, e in powers.items() if e > 0]
    below = [_power(unit, -e) for unit, e in powers.items() if e < 0]
    divisor = f"({'.'.join(below)})" if len(below) > 1 else "".join(below)
    return ".".join(above or ["1"]) + (f"/{divisor}" if below else "")


def _power(unit: str, exponent: Exponent) -> str:
    if exponent == 1:
        return unit
    return f"{unit}{exponent}" if exponent.denominator == 1 else f"{unit}^{float(exponent):g}"


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
