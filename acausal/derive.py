"""Derive: sympy, once per template: differentiate in time, solve for a slot, tell what is linear."""

from __future__ import annotations

from functools import cache
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from acausal.symbols import time
from acausal.template import Template


@cache
def differentiate(template: Template) -> tuple[Template, tuple[tuple[int, bool], ...]]:
    """The template's total time derivative, and where its slots come from.

    Returns:
        The new template and, per variable slot, (column of the old template, whether differentiated).
    """
    slots = list(template.variables)
    rates = [_fresh(f"der({s.name})", slots) for s in slots]
    terms = [template.residual.diff(time)]
    terms += [template.residual.diff(s) * r for s, r in zip(slots, rates, strict=True)]
    residual = sp.Add(*terms)
    present = residual.free_symbols
    kept = [(i, False) for i, s in enumerate(slots) if s in present]
    kept += [(i, True) for i, r in enumerate(rates) if r in present]
    variables = tuple(rates[i] if raised else slots[i] for i, raised in kept)
    derivative = Template(
        residual,
        variables,
        (0,) * len(variables),
        template.parameters,
        template.modules,
        f"derivative of {template.origin}",
    )
    return derivative, tuple(kept)


def _fresh(name: str, taken: list[sp.Symbol]) -> sp.Symbol:
    """A slot of that name, or nearly: the derivative in a slot may stand there with the other sign."""
    symbol = sp.Symbol(name, real=True)
    return _fresh(f"{name}'", taken) if symbol in taken else symbol


@cache
def slope(template: Template, column: int) -> sp.Expr:
    """Partial derivative of the residual with respect to a variable slot."""
    return template.residual.diff(template.variables[column])


@cache
def _decides(template: Template, column: int) -> bool:
    """Whether the slot decides a case or a step: there the residual jumps without a slope that tells."""
    symbol = template.variables[column]
    places = template.residual.atoms(Relational, sp.Function)
    return any(
        symbol in place.free_symbols for place in places if not isinstance(place, sp.Piecewise)
    )


@cache
def solve(template: Template, column: int) -> sp.Expr | None:
    """The slot as an explicit expression of the others; None where it does not stand linearly."""
    symbol, coefficient = template.variables[column], slope(template, column)
    if coefficient == 0 or symbol in coefficient.free_symbols or _decides(template, column):
        return None
    rest: Any = template.residual.xreplace({symbol: sp.S.Zero})
    if rest.has(sp.nan, sp.zoo, sp.oo):
        rest = sp.expand(template.residual - coefficient * symbol)
    return -rest / coefficient


@cache
def is_safely_solvable(template: Template, column: int) -> bool:
    """Whether the slot stands linearly with a coefficient that cannot vanish while a simulation runs.

    Numbers and products of parameters count as safe, anything that depends on variables, time or cases does not.
    """
    if solve(template, column) is None:
        return False
    coefficient = slope(template, column)
    unsafe = coefficient.free_symbols & {*template.variables, time}
    return not unsafe and not coefficient.has(sp.Piecewise, sp.Function)


@cache
def is_linear(template: Template, columns: tuple[int, ...]) -> bool:
    """Whether the residual is affine in these slots together."""
    symbols = {template.variables[c] for c in columns}
    return not any(
        slope(template, c).free_symbols & symbols or _decides(template, c) for c in columns
    )
