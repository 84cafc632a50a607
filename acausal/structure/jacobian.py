"""The Jacobian in numbers: partial derivatives of equations at a point, for questions that structure cannot answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import sympy as sp

from acausal.flattening import FlatModel, Integers, Statement, binding_levels
from acausal.modeling import ModuleCall, Prescribed, time

TIME = 0.37


@dataclass(frozen=True)
class Point:
    """Values of all variables (by node) and parameters."""

    variables: np.ndarray
    parameters: np.ndarray


def partials(
    template: Statement, column: int, variables: Integers, parameters: Integers, point: Point
) -> np.ndarray:
    """Partial derivatives with respect to one slot, for all rows of ``variables`` and ``parameters``.

    One that is not finite, or depends on a callable parameter, is replaced by some number other than zero.
    """
    expression = template.partial(column)
    if expression.is_Number:
        return np.full(len(variables), float(expression))
    slots = [(s, point.variables, variables, i) for i, s in enumerate(template.variables)]
    slots += [(s, point.parameters, parameters, i) for i, s in enumerate(template.parameters)]
    present = expression.free_symbols  # a few of hundreds, where the equation is a long sum
    read = [(s, values[rows[:, i]]) for s, values, rows, i in slots if s in present]
    numbered = {
        s: sp.Symbol(f"_{i}", real=True) for i, (s, _) in enumerate(read)
    }  # alike: one function
    function = numeric_function(expression.xreplace(numbered), tuple(numbered.values()))
    with np.errstate(all="ignore"):
        result = np.broadcast_to(function(TIME, *(v for _, v in read)), (len(variables),))
    return np.where(np.isfinite(result), result, 1.0)


def is_constant(template: Statement, column: int) -> bool:
    """Whether the partial derivative depends on parameters and numbers only."""
    partial = template.partial(column)
    return not (partial.free_symbols - {*template.parameters} or partial.has(ModuleCall))


def parameter_values(model: FlatModel) -> np.ndarray:
    """The model's own values of all parameters, bound ones computed (nan: bound in a circle)."""
    value = np.array(model.value)
    levels, _ = binding_levels(model.bindings, np.arange(len(value)))
    for ready in levels:
        groups: dict[Any, list[Any]] = {}
        for b in ready:
            groups.setdefault((b.expression, b.symbols), []).append(b)
        for (expression, symbols), members in groups.items():
            arguments = np.asarray([b.arguments for b in members]).reshape(len(members), -1)
            with np.errstate(all="ignore"):
                computed = numeric_function(expression, symbols)(TIME, *value[arguments].T)
            value[[b.target for b in members]] = np.nan_to_num(computed)
    return value


def random_values(n: int) -> np.ndarray:
    """Numbers without relations, the same at every call; positive, so that roots and logarithms exist."""
    return np.random.default_rng(0).uniform(0.5, 1.5, n)


@cache
def numeric_function(expression: sp.Expr, symbols: Sequence[sp.Symbol]) -> Callable[..., Any]:
    """An expression as a function of arrays: of time and its symbols; networks are some numbers."""
    calls = sorted(expression.atoms(ModuleCall), key=sp.default_sort_key)
    plain = expression.xreplace({c: sp.Float(0.6 + 0.1 * i) for i, c in enumerate(calls)})
    plain = plain.replace(Prescribed, lambda n, t, *signals: signals[int(n)])
    plain = plain.replace(sp.DiracDelta, lambda *_: sp.S.Zero)
    return sp.lambdify((time, *symbols), plain, "numpy")
