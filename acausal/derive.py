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
    taken = set(slots)
    rates = [_fresh(f"der({s.name})", taken) for s in slots]
    terms = [template.residual.diff(time)]
    terms += [slope(template, i) * r for i, r in enumerate(rates)]
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


def _fresh(name: str, taken: set[sp.Symbol]) -> sp.Symbol:
    """A slot of that name, or nearly: the derivative in a slot may stand there with the other sign."""
    symbol = sp.Symbol(name, real=True)
    return _fresh(f"{name}'", taken) if symbol in taken else symbol


@cache
def slope(template: Template, column: int) -> sp.Expr:
    """Partial derivative of the residual with respect to a variable slot."""
    symbol = template.variables[column]
    return sp.Add(*(term.diff(symbol) for term in _terms_of(template)[symbol]))


@cache
def _terms_of(template: Template) -> dict[Any, list[sp.Expr]]:
    """The terms of the residual that each symbol stands in (a balance of flows may have thousands)."""
    found: dict[Any, list[sp.Expr]] = {s: [] for s in template.variables}
    for term in sp.Add.make_args(template.residual):
        for symbol in term.free_symbols:
            found.setdefault(symbol, []).append(term)
    return found


@cache
def _deciding(template: Template) -> set[Any]:
    """The symbols that decide a case or a step: there the residual jumps without a slope that tells."""
    places = template.residual.atoms(Relational, sp.Function)
    return set().union(*(p.free_symbols for p in places if not isinstance(p, sp.Piecewise)))


@cache
def solve(template: Template, column: int) -> sp.Expr | None:
    """The slot as an explicit expression of the others; None where it does not stand linearly."""
    symbol, coefficient = template.variables[column], slope(template, column)
    if coefficient == 0 or symbol in coefficient.free_symbols or symbol in _deciding(template):
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
    if symbols & _deciding(template):
        return False
    return not any(slope(template, c).free_symbols & symbols for c in columns)
