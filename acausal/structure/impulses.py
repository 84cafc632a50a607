"""Signals that jump in time where a model needs their derivative: an impulse, which no step of an integration has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from acausal.modeling import literal, time

PERIODS = 3
"""Of what repeats, so many periods are looked at."""

ASIDE, JUMP = 1e-9, 1e-6
"""Values are compared so far before and behind an instant, and must differ by the second part of the largest."""


def jump_of(expression: Any, values: Mapping[sp.Symbol, float]) -> float | None:
    """A time after zero at which an expression of time jumps, with numbers for its symbols; None if there is none."""
    number = literal(expression)
    if not number.has(sp.Piecewise, sp.floor, sp.sign):
        return None
    number = number.xreplace(
        {s: sp.Float(values.get(s, 0.0)) for s in number.free_symbols - {time}}
    )
    function = sp.lambdify(time, number, "numpy", cse=True)
    with np.errstate(all="ignore"):
        found = {
            t: [float(function(t + side * ASIDE * t)) for side in (-1, 1)]
            for t in sorted(_instants(number))
        }
    size = max((abs(value) for values in found.values() for value in values), default=0.0)
    jumps = (t for t, (before, behind) in found.items() if abs(behind - before) > JUMP * size)
    return next(jumps, None)


def _instants(number: Any) -> Iterator[float]:
    """Times after zero at which conditions that are linear in time change."""
    edges = [r.lhs - r.rhs for r in number.atoms(Relational)] + [
        s.args[0] for s in number.atoms(sp.sign)
    ]
    floors = sorted(number.atoms(sp.floor), key=str)
    lines = [f.args[0] - k for f in floors for k in range(1, PERIODS + 1)]
    for edge in edges:
        inside = [f for f in floors if edge.has(f)]
        lines += [edge.xreplace(dict.fromkeys(inside, sp.Integer(k))) for k in range(PERIODS)]
    for line in lines:
        slope = line.diff(time)
        if slope.is_number and slope != 0:
            t = float(-line.xreplace({time: sp.S.Zero}) / slope)
            if t > 0:
                yield t
