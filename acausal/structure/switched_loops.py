"""Linear loops whose equations may come to depend on each other, as conditions void some of their terms.

Two frictions that lock one motion both say that it rests, and neither how much of the load it takes: that is left open,
although the motion is not.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np
import sympy as sp

from acausal.structure.algebraic_loops import BlockEquation, BlockShape
from acausal.structure.rank import singular

MANY = 8
"""With more switches equations are taken to depend on each other in some of their positions."""

Factors = Mapping[tuple[int, int], Any]
"""By equation and unknown, the expression that the unknown is multiplied by."""


def may_repeat_itself(shape: BlockShape) -> bool:
    """Whether conditions can void so many terms that equations depend on each other."""
    if not any(e.template.residual.has(sp.Piecewise) for e in shape.equations):
        return False
    if not shape.is_linear:
        return False
    factors = {
        (row, code): _in_block(e, e.template.partial(column))
        for row, e in enumerate(shape.equations)
        for column, code in enumerate(e.variables)
        if code >= 0
    }
    switches = sorted(set[Any]().union(*map(_voiding, factors.values())), key=str)
    if len(switches) < 2:
        return False
    return len(switches) > MANY or any(
        _repeats(factors, shape.n_unknowns, dict(zip(switches, values, strict=True)))
        for values in product((0.0, 1.0), repeat=len(switches))
    )


def _in_block(equation: BlockEquation, factor: Any) -> Any:
    """A factor with its slots named by what they read in the block."""
    template = equation.template
    tables = (
        ("v", template.variables, equation.variables),
        ("p", template.parameters, equation.parameters),
    )
    return factor.xreplace(
        {
            slot: sp.Symbol(f"{kind}{code}")
            for kind, slots, codes in tables
            for slot, code in zip(slots, codes, strict=True)
        }
    )


def _voiding(factor: Any) -> set[Any]:
    """What decides whether a factor is zero."""
    found: set[Any] = set()
    for cases in factor.atoms(sp.Piecewise):
        if any(value == 0 for value, _ in cases.args):
            found.update(*(condition.free_symbols for _, condition in cases.args))
    return found


def _repeats(factors: Factors, n: int, switched: Mapping[Any, float]) -> bool:
    """Whether equations depend on each other with switches in these positions, and any other numbers."""
    some = np.random.default_rng(0)
    symbols = sorted(set[Any]().union(*(f.free_symbols for f in factors.values())), key=str)
    numbers = {s: sp.Float(switched.get(s, some.uniform(0.5, 2.0))) for s in symbols}
    values = [factor.xreplace(numbers) for factor in factors.values()]
    rows, columns = zip(*factors, strict=True)
    return singular(rows, columns, [float(v) if v.is_number else 1.0 for v in values], n)
