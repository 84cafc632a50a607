"""Derive: sympy, once per template: specialise, differentiate in time, solve for a slot, tell what is linear.

Of a `Total` integers tell the same, without sympy.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from acausal.errors import StructureError
from acausal.flattening import Statement, Template, Total, interned
from acausal.modeling import Prescribed, time


@cache
def specialised(
    template: Statement, pattern: tuple[int, ...]
) -> tuple[Statement, tuple[list[int], ...]]:
    """The template with slots merged, negated or set to zero, and the columns of the slots that remain.

    Arguments:
        pattern: for every variable slot 0 (zero), or ``±(1 + j)``: plus or minus slot j; for every parameter slot
            whether it is zero.
    """
    if isinstance(template, Total):
        special, left = template.specialised(pattern)
        return special, (left, [], [])
    n = len(template.variables)
    replaced: dict[sp.Symbol, Any] = {}
    for symbol, code in zip(template.variables, pattern[:n], strict=True):
        replaced[symbol] = (
            sp.S.Zero if code == 0 else sp.sign(code) * template.variables[abs(code) - 1]
        )
    for symbol, is_zero in zip(template.parameters, pattern[n:], strict=True):
        if is_zero:
            replaced[symbol] = sp.S.Zero
    replaced = {s: r for s, r in replaced.items() if s != r}
    residual: Any = template.residual.xreplace(replaced) if replaced else template.residual
    if residual.has(sp.zoo, sp.nan, sp.oo):
        zeros = [s.name for s, r in replaced.items() if r == 0 and s in template.parameters]
        raise StructureError(
            f"{template.origin}: division by zero; {' and '.join(zeros) or 'a variable'} is zero there"
        )
    present = residual.free_symbols
    variables = [i for i, s in enumerate(template.variables) if s in present]
    parameters = [i for i, s in enumerate(template.parameters) if s in present]
    modules = [i for i, s in enumerate(template.modules) if s in present]
    special = Template(
        residual,
        tuple(template.variables[i] for i in variables),
        (0,) * len(variables),
        tuple(template.parameters[i] for i in parameters),
        tuple(template.modules[i] for i in modules),
        template.origin,
    )
    return interned(special), (variables, parameters, modules)


@cache
def coefficients(template: Statement) -> tuple[Any, ...] | None:
    """Numbers that the slots are multiplied by, where the residual is nothing but the sum of that; else None."""
    if isinstance(template, Total):
        return template.coefficients
    if template.parameters or template.modules or not template.variables:
        return None
    slopes = [template.residual.diff(s) for s in template.variables]
    if not all(s.is_number and s != 0 for s in slopes):
        return None
    terms = (c * s for c, s in zip(slopes, template.variables, strict=True))
    return tuple(slopes) if sp.expand(template.residual - sp.Add(*terms)) == 0 else None


@cache
def alias(template: Statement) -> tuple[int, ...] | None:
    """``(s,)`` if the template states ``first = s * second``, ``()`` if it states ``first = 0``, else None."""
    if isinstance(template, Total) or len(template.variables) > 2:
        return None
    match coefficients(template):
        case (_,):
            return ()
        case (first, second) if -second / first in (1, -1):
            return (int(-second / first),)
        case _:
            return None


@cache
def differentiate(template: Statement) -> tuple[Statement, tuple[tuple[int, bool], ...]]:
    """The template's total time derivative, and where its slots come from.

    Returns:
        The new template and, per variable slot, (column of the old template, whether differentiated).
    """
    if isinstance(template, Total):
        return template.derivative, tuple((i, True) for i in range(len(template.coefficients)))
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


@cache
def settled(template: Template) -> tuple[Template, tuple[int, ...]]:
    """The equation with signals in the place of `Prescribed`, for when it is not differentiated any more.

    Returns:
        The new template and, per variable slot, the column of the old one: the signals that only stand for
        further derivatives are gone.
    """
    residual = template.residual.replace(Prescribed, lambda order, _, *signals: signals[int(order)])
    present = residual.free_symbols
    kept = tuple(c for c, s in enumerate(template.variables) if s in present)
    variables = tuple(template.variables[c] for c in kept)
    orders = tuple(template.orders[c] for c in kept)
    return replace(template, residual=residual, variables=variables, orders=orders), kept


@cache
def has_prescribed(template: Statement) -> bool:
    """Whether the derivatives of a signal are given in the equation."""
    return isinstance(template, Template) and template.residual.has(Prescribed)


def _fresh(name: str, taken: set[sp.Symbol]) -> sp.Symbol:
    """A slot of that name, or nearly: the derivative in a slot may stand there with the other sign."""
    symbol = sp.Symbol(name, real=True)
    return _fresh(f"{name}'", taken) if symbol in taken else symbol


def is_void(template: Statement) -> bool:
    """Whether the template says nothing: ``0 = 0``."""
    return isinstance(template, Template) and template.residual == 0


@cache
def slope(template: Statement, column: int) -> sp.Expr:
    """Partial derivative of the residual with respect to a variable slot."""
    if isinstance(template, Total):
        return sp.Integer(template.coefficients[column])
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
def is_solvable(template: Statement, column: int) -> bool:
    """Whether `solve` finds an expression."""
    return isinstance(template, Total) or solve(template, column) is not None


@cache
def is_safely_solvable(template: Statement, column: int) -> bool:
    """Whether the slot stands linearly with a coefficient that cannot vanish while a simulation runs.

    Numbers and products of parameters count as safe, anything that depends on variables, time or cases does not.
    """
    if isinstance(template, Total):
        return True
    if solve(template, column) is None:
        return False
    coefficient = slope(template, column)
    unsafe = coefficient.free_symbols & {*template.variables, time}
    return not unsafe and not coefficient.has(sp.Piecewise, sp.Function)


@cache
def is_linear(template: Statement, columns: tuple[int, ...]) -> bool:
    """Whether the residual is affine in these slots together."""
    if isinstance(template, Total):
        return True
    symbols = {template.variables[c] for c in columns}
    if symbols & _deciding(template):
        return False
    return not any(slope(template, c).free_symbols & symbols for c in columns)
