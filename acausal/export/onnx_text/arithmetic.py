"""Rules of operations on each element."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from acausal.export.onnx_text.builder import OnnxGraph, Rule, Site, Value

SAME = {
    "abs": "Abs", "add": "Add", "add_any": "Add", "ceil": "Ceil", "div": "Div", "eq": "Equal",
    "erf": "Erf", "exp": "Exp", "floor": "Floor", "ge": "GreaterOrEqual", "gt": "Greater", "le": "LessOrEqual",
    "log": "Log", "logistic": "Sigmoid", "lt": "Less", "max": "Max", "min": "Min", "mul": "Mul", "neg": "Neg",
    "pow": "Pow", "sign": "Sign", "sin": "Sin", "sqrt": "Sqrt", "sub": "Sub", "tanh": "Tanh",
}  # fmt: skip
"""Operations that ONNX has, too."""

LOGICAL = {"and": "And", "or": "Or", "xor": "Xor", "not": "Not"}
"""Operations on truth values."""


def same(operation: str) -> Rule:
    """One node of the same meaning."""
    return lambda site: [site.graph.add(operation, *site.names)]


def logical(operation: str) -> Rule:
    """One node, for truth values only: ONNX has no shifts and masks of all integers."""

    def rule(site: Site) -> list[str]:
        if site.kind != "b":
            raise site.refuse("of whole numbers")
        return [site.graph.add(operation, *site.names)]

    return rule


def _composed(function: Callable[..., str]) -> Rule:
    """Of one argument, by other operations."""
    return lambda site: [function(site.graph, *site.names)]


def _cos(g: OnnxGraph, x: str) -> str:
    """``1 - 2 sin(x/2)²``: some run times have no ``Cos`` in double precision, but all have ``Sin``."""
    half = g.add("Sin", g.add("Mul", x, g.number(0.5)))
    return g.add("Sub", g.number(1), g.add("Mul", g.number(2), g.add("Mul", half, half)))


def _log1p(g: OnnxGraph, x: str) -> str:
    """``log(u) x / (u - 1)`` with ``u = 1 + x``: its rounding errors cancel (Kahan)."""
    one = g.number(1)
    u = g.add("Add", x, one)
    less = g.add("Sub", u, one)
    tiny = g.add("Equal", less, g.number(0))
    infinite = g.add("IsInf", u)
    safe = g.add("Where", g.add("Or", tiny, infinite), one, less)
    ratio = g.add("Div", g.add("Where", infinite, one, x), safe)
    return g.add("Where", tiny, x, g.add("Mul", g.add("Log", u), ratio))


def _expm1(g: OnnxGraph, x: str) -> str:
    """``2 tanh(x/2) / (1 - tanh(x/2))`` below one, where the difference loses digits."""
    one, half = g.number(1), g.number(0.5)
    bounded = g.add("Max", g.add("Min", x, one), g.number(-1))
    t = g.add("Tanh", g.add("Mul", bounded, half))
    near = g.add("Div", g.add("Mul", t, g.number(2)), g.add("Sub", one, t))
    far = g.add("Sub", g.add("Exp", x), one)
    return g.add("Where", g.add("Less", g.add("Abs", x), one), near, far)


def _sinh(g: OnnxGraph, x: str) -> str:
    """``(m + m / (m + 1)) / 2`` of ``m = expm1(|x|)``."""
    m = _expm1(g, g.add("Abs", x))
    whole = g.add("Add", m, g.add("Div", m, g.add("Add", m, g.number(1))))
    return g.add("Mul", g.add("Sign", x), g.add("Mul", whole, g.number(0.5)))


def _cosh(g: OnnxGraph, x: str) -> str:
    whole = g.add("Add", g.add("Exp", x), g.add("Exp", g.add("Neg", x)))
    return g.add("Mul", whole, g.number(0.5))


def _asinh(g: OnnxGraph, x: str) -> str:
    """``sign(x) log1p(|x| + x² / (1 + √(1 + x²)))``."""
    one, a = g.number(1), g.add("Abs", x)
    square = g.add("Mul", a, a)
    root = g.add("Sqrt", g.add("Add", square, one))
    inner = g.add("Add", a, g.add("Div", square, g.add("Add", root, one)))
    return g.add("Mul", g.add("Sign", x), _log1p(g, inner))


def _acosh(g: OnnxGraph, x: str) -> str:
    d = g.add("Sub", x, g.number(1))
    root = g.add("Sqrt", g.add("Mul", d, g.add("Add", d, g.number(2))))
    return _log1p(g, g.add("Add", d, root))


def _atanh(g: OnnxGraph, x: str) -> str:
    """``sign(x) log1p(2 |x| / (1 - |x|)) / 2``."""
    a = g.add("Abs", x)
    ratio = g.add("Div", g.add("Mul", a, g.number(2)), g.add("Sub", g.number(1), a))
    return g.add("Mul", g.add("Sign", x), g.add("Mul", _log1p(g, ratio), g.number(0.5)))


def _angle(g: OnnxGraph, y: str, x: str) -> str:
    """The angle of a point of the plane.

    ONNX has ``Atan``, but run times know it in single precision only. So that value is a first guess, and one turn of
    the point by it gives the rest: of the turned point's angle z, about 1e-7, ``z - z³/3`` is exact.
    """
    zero, one = g.number(0), g.number(1)
    larger = g.add("Max", g.add("Abs", x), g.add("Abs", y))
    scale = g.add("Where", g.add("Equal", larger, zero), one, larger)
    y, x = g.add("Div", y, scale), g.add("Div", x, scale)
    flat = g.add("Less", g.add("Abs", y), g.add("Abs", x))
    over, under = g.add("Where", flat, y, x), g.add("Where", flat, x, y)
    safe = g.add("Where", g.add("Equal", under, zero), one, under)
    slope = g.cast(g.add("Div", over, safe), np.float32)
    small = g.add("Cast", g.add("Atan", g.add("Cast", slope, to=1)), to=g.kind(float))
    side = g.add("Where", g.add("Less", y, zero), g.number(-math.pi / 2), g.number(math.pi / 2))
    back = g.add("Where", g.add("Less", x, zero), g.add("Mul", side, g.number(2)), zero)
    guess = g.add("Where", flat, g.add("Add", small, back), g.add("Sub", side, small))
    c, s = _cos(g, guess), g.add("Sin", guess)
    across = g.add("Sub", g.add("Mul", y, c), g.add("Mul", x, s))
    along = g.add("Add", g.add("Mul", x, c), g.add("Mul", y, s))
    z = g.add("Div", across, g.add("Where", g.add("Equal", along, zero), one, along))
    cube = g.add("Mul", g.add("Mul", z, z), g.add("Mul", z, g.number(1 / 3)))
    return g.add("Add", guess, g.add("Sub", z, cube))


def _atan(g: OnnxGraph, x: str) -> str:
    """Also for infinite arguments."""
    far = g.add("IsInf", x)
    size = g.add("Where", far, g.number(1), x)
    angle = _angle(g, size, g.number(1))
    return g.add("Where", far, g.add("Mul", g.add("Sign", x), g.number(math.pi / 2)), angle)


def _leg(g: OnnxGraph, x: str) -> str:
    """``√((1 - x) (1 + x))``."""
    one = g.number(1)
    return g.add("Sqrt", g.add("Mul", g.add("Sub", one, x), g.add("Add", one, x)))


def _cbrt(g: OnnxGraph, x: str) -> str:
    """``sign(x) |x|^(1/3)``, and one step of Newton's method."""
    a = g.add("Abs", x)
    zero = g.add("Equal", a, g.number(0))
    a = g.add("Where", zero, g.number(1), a)
    r = g.add("Pow", a, g.number(1 / 3))
    ratio = g.add("Div", a, g.add("Mul", r, r))
    r = g.add("Sub", r, g.add("Div", g.add("Sub", r, ratio), g.number(3)))
    return g.add("Where", zero, x, g.add("Mul", g.add("Sign", x), r))


def _power(site: Site) -> list[str]:
    """Small whole powers are products."""
    g, (x,), n = site.graph, site.names, int(site.params["y"])
    found = None
    for bit in bin(abs(n))[2:]:
        found = None if found is None else g.add("Mul", found, found)
        if bit == "1":
            found = x if found is None else g.add("Mul", found, x)
    if found is None:
        return [g.add("Add", g.add("Mul", x, g.number(0)), g.number(1))]
    return [found if n > 0 else g.add("Div", g.number(1), found)]


def _select(site: Site) -> list[str]:
    which, *cases = site.names
    if len(cases) != 2:
        raise site.refuse(f"of {len(cases)} cases")
    truth = which if site.kind == "b" else site.graph.cast(which, bool)
    return [site.graph.add("Where", truth, cases[1], cases[0])]


def _clamp(site: Site) -> list[str]:
    low, x, high = site.names
    return [site.graph.add("Min", site.graph.add("Max", x, low), high)]


def _convert(site: Site) -> list[str | Value]:
    g, old, new = site.graph, site.values[0].dtype, site.params["new_dtype"]
    if g.dtype(old) == g.dtype(new):
        return [site.values[0]]
    return [g.cast(site.names[0], new)]


def _round(site: Site) -> list[str]:
    """To even, as ONNX does; away from zero by ``sign(x) floor(|x| + 1/2)``."""
    g, (x,) = site.graph, site.names
    if int(site.params["rounding_method"]) == 1:
        return [g.add("Round", x)]
    up = g.add("Floor", g.add("Add", g.add("Abs", x), g.number(0.5)))
    return [g.add("Mul", g.add("Sign", x), up)]


RULES: dict[str, Rule] = {
    **{name: same(operation) for name, operation in SAME.items()},
    **{name: logical(operation) for name, operation in LOGICAL.items()},
    "acos": _composed(lambda g, x: _angle(g, _leg(g, x), x)),
    "acosh": _composed(_acosh),
    "asin": _composed(lambda g, x: _angle(g, x, _leg(g, x))),
    "asinh": _composed(_asinh),
    "atan": _composed(_atan),
    "atan2": _composed(_angle),
    "atanh": _composed(_atanh),
    "cbrt": _composed(_cbrt),
    "clamp": _clamp,
    "convert_element_type": _convert,
    "cos": _composed(_cos),
    "cosh": _composed(_cosh),
    "exp2": _composed(lambda g, x: g.add("Exp", g.add("Mul", x, g.number(math.log(2))))),
    "expm1": _composed(_expm1),
    "integer_pow": _power,
    "is_finite": _composed(
        lambda g, x: g.add("Not", g.add("Or", g.add("IsInf", x), g.add("IsNaN", x)))
    ),
    "log1p": _composed(_log1p),
    "ne": _composed(lambda g, x, y: g.add("Not", g.add("Equal", x, y))),
    "one_minus_square": _composed(lambda g, x: g.add("Sub", g.number(1), g.add("Mul", x, x))),
    "rem": lambda site: [site.graph.add("Mod", *site.names, fmod=1)],
    "round": _round,
    "rsqrt": _composed(lambda g, x: g.add("Reciprocal", g.add("Sqrt", x))),
    "select_n": _select,
    "sinh": _composed(_sinh),
    "square": _composed(lambda g, x: g.add("Mul", x, x)),
    "tan": _composed(lambda g, x: g.add("Div", g.add("Sin", x), _cos(g, x))),
}
"""By operation, how its nodes are made."""
