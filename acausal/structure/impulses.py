"""Signals that jump in time where a model needs their derivative: an impulse, which no step of an integration has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from acausal.flattening import SIGNS, STEPS
from acausal.modeling import literal, time
from acausal.structure.jacobian import numeric_function

PERIODS = 3
"""Of what repeats, so many periods are looked at."""

ASIDE, JUMP, STAYS = (1e-6, 1e-8), 1e-9, 0.5
"""Values are compared so far before and behind an instant, and differ by more than the second part of the largest. A
jump is as large if the distance is shorter, to the third part; a steep ramp is not."""

UNKNOWN = (TypeError, ValueError, ArithmeticError, NameError, AttributeError)
"""What numbers outside of a function's domain, and functions that NumPy has not, end in."""


def jump_of(expression: Any, values: Mapping[sp.Symbol, float]) -> float | None:
    """A time after zero at which what time alone makes of an expression jumps; None if there is none.

    Arguments:
        values: the numbers of parameters. What depends on other symbols is left out.
    """
    known = ((s, float(values[s])) for s in expression.free_symbols if s in values)
    return _jump(expression, tuple(sorted(known, key=str)))


@lru_cache(maxsize=4096)
def _jump(expression: Any, values: tuple[tuple[sp.Symbol, float], ...]) -> float | None:
    """What `jump_of` finds, once for each expression and its numbers."""
    number = literal(expression).xreplace({s: sp.Float(v) for s, v in values})
    terms = [t for t in sp.Add.make_args(number) if t.free_symbols == {time}]
    timed = sp.Add(*terms)
    if not timed.has(sp.Piecewise, *STEPS, *SIGNS):
        return None
    function = numeric_function(timed, ())

    def rise(t: float, aside: float) -> float:
        return abs(float(function(t * (1 + aside))) - float(function(t * (1 - aside))))

    with np.errstate(all="ignore"), suppress(*UNKNOWN):
        found = {t: tuple(rise(t, aside) for aside in ASIDE) for t in sorted(_instants(timed))}
        size = max((abs(float(function(t * (1 + ASIDE[0])))) for t in found), default=0.0)
        for t, (wide, near) in found.items():
            if near > max(STAYS * wide, JUMP * size):
                return t
    return None


def _instants(number: Any) -> Iterator[float]:
    """Times after zero at which conditions that are linear in time change."""
    steps: dict[Any, Any] = {}
    for step in number.atoms(*STEPS):
        whole, *period = step.args
        steps[step] = whole / period[0] if period else whole
    edges = [r.lhs - r.rhs for r in number.atoms(Relational)]
    edges += [s.args[0] for s in number.atoms(*SIGNS)]
    lines = [whole - k for whole in steps.values() for k in range(1, PERIODS + 1)]
    for edge in edges:
        inside = [s for s in steps if edge.has(s)]
        lines += [edge.xreplace(dict.fromkeys(inside, sp.Integer(k))) for k in range(PERIODS)]
    for line in lines:
        slope = line.diff(time)
        if slope.is_number and slope.is_real and slope != 0:
            t = float(-line.xreplace({time: sp.S.Zero}) / slope)
            if t > 0:
                yield t
