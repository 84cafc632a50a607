"""Names that expressions in files can use: constants, functions and conversions of units, as in Modelica."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

import sympy as sp

from acausal.modeling import Atan2, der, dividend, floor

MAX_VALUES = 20
"""The most values that a minimum or maximum may have."""

CONSTANTS: dict[str, float] = {
    "pi": math.pi,
    "e": math.e,
    "D2R": math.pi / 180,
    "R2D": 180 / math.pi,
    "g_n": 9.80665,
    "sigma": 5.670374419184429e-8,
    "mu_0": 4e-7 * math.pi * 1.00000000055,
    "epsilon_0": 1 / (4e-7 * math.pi * 1.00000000055 * 299792458.0**2),
    "T_zero": -273.15,
    "R": 8.31446261815324,
    "k": 1.380649e-23,
    "q": 1.602176634e-19,
    "F": 96485.33212331,
    "N_A": 6.02214076e23,
    "h": 6.62607015e-34,
    "c": 299792458.0,
    "G": 6.6743e-11,
    "inf": 1e60,
    "eps": 2.220446049250313e-16,
    "small": 1e-60,
}
"""Of `Modelica.Constants`; ``inf`` and ``small`` are large and small enough to stay finite in expressions."""

BARE_CONSTANTS = ("pi", "e", "D2R", "R2D", "g_n", "mu_0", "T_zero", "inf", "eps", "small")
"""Constants that can be written without ``Modelica.Constants.``, as after an import."""

FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sqrt": sp.sqrt, "exp": sp.exp, "log": sp.log, "log10": lambda x: sp.log(x) / sp.log(10),
    "sin": sp.sin, "cos": sp.cos, "tan": sp.tan, "asin": sp.asin, "acos": sp.acos, "atan": sp.atan,
    "atan2": Atan2, "sinh": sp.sinh, "cosh": sp.cosh, "tanh": sp.tanh,
    "abs": sp.Abs, "sign": sp.sign, "der": der,
    "min": lambda *x: _extreme(sp.Min, x), "max": lambda *x: _extreme(sp.Max, x),
    "floor": floor, "integer": floor, "ceil": lambda x: -floor(-x),
    "div": lambda x, y: sp.sign(x / y) * _quotient(sp.Abs(x), sp.Abs(y)),
    "mod": lambda x, y: x - _quotient(x, y) * y,
}  # fmt: skip

CONVERSIONS: dict[str, tuple[float, float]] = {
    "deg": (math.pi / 180, 0.0),
    "degC": (1.0, 273.15),
    "degF": (5 / 9, 273.15 - 32 * 5 / 9),
    "degRk": (5 / 9, 0.0),
    "rpm": (math.pi / 30, 0.0),
    "kmh": (1 / 3.6, 0.0),
    "Hz": (2 * math.pi, 0.0),
    "bar": (1e5, 0.0),
    "day": (86400.0, 0.0),
    "hour": (3600.0, 0.0),
    "minute": (60.0, 0.0),
    "litre": (1e-3, 0.0),
    "kWh": (3.6e6, 0.0),
}
"""Of `Modelica.Units.Conversions`: the SI value is ``factor * x + offset``; ``from_deg(x)``, ``to_deg(x)``."""

PREFIXES = re.compile(r"(Modelica\.)?(Math|(Units\.|SIunits\.)?Conversions|Cv)\.")


def _quotient(x: Any, y: Any) -> Any:
    """The greatest integer not above ``x / y``."""
    return floor(dividend(x, y) / y)


def _extreme(kind: Any, values: tuple[Any, ...]) -> Any:
    """A minimum or maximum of few values: sympy compares each pair."""
    if not 0 < sum(max(1, len(kind.make_args(v))) for v in values) <= MAX_VALUES:
        raise TypeError
    return kind(*values)


def function(name: str) -> Callable[..., Any] | None:
    """The function of that name, with or without its package; None if there is none."""
    name = PREFIXES.sub("", name, count=1)
    direction, _, unit = name.partition("_")
    if direction in ("from", "to") and unit in CONVERSIONS:
        factor, offset = CONVERSIONS[unit]
        if direction == "from":
            return lambda x: factor * x + offset
        return lambda x: (x - offset) / factor
    return FUNCTIONS.get(name)
