"""Hidden constraints: combinations of equations that constrain states alone.

Two capacitors in parallel have the equations ``c1.v = p - n`` and ``c2.v = p - n``. Structurally these determine the
potentials p and n; in fact they tie the voltages to each other. Where unknowns have constant factors, such
combinations are found: first modulo a prime, for parameters without relations, then exactly. Each replaces one of its
equations, so that index reduction sees it. (For factors that are integers: Otter & Elmqvist 2017,
"Transformation of Differential Algebraic Array Equations to Index One Form".)
"""

from __future__ import annotations

from functools import cache, reduce
from operator import add, mul
from random import Random
from typing import Any

import sympy as sp

from acausal.flattening import Statement, Template, specialised
from acausal.structure.equations import Equations
from acausal.structure.rank import cancelling, prune_singletons

PRIME = 2**61 - 1
RESIDUES = sp.GF(PRIME)
ColumnByUnknown = dict[int, int]
"""Unknown -> its column."""
Part = tuple[Statement, sp.Expr, tuple[int, ...], tuple[int, ...]]
"""A template, its factor, the slots of variables that are kept, and the slot of the sum for each parameter."""


def expose_constraints(system: Equations) -> dict[int, list[int]]:
    """Replace equations that, combined with others, constrain states alone by that constraint.

    Returns:
        For every replaced equation, the others that it was combined with.
    """
    highest = _highest(system)
    residue = cache(lambda parameter: RESIDUES(Random(parameter).randrange(1, PRIME)))
    suspects: dict[int, dict[int, Any]] = {}
    for e in prune_singletons(highest):
        template = system.template[e]
        values = dict(zip(template.parameters, map(residue, system.parameters[e]), strict=True))
        columns = highest[e].items()
        suspects[e] = {v: _modular(_factor(template, c), values) for v, c in columns}
    found: dict[int, list[int]] = {}
    for combination in cancelling(suspects):
        numbers = {p: i for i, p in enumerate(_parameters(system, combination))}
        for factors in _exactly(system, {e: highest[e] for e in combination}, numbers):
            *others, target = combination
            _replace(system, target, factors, numbers)
            found[target] = others
    return found


def _highest(system: Equations) -> dict[int, ColumnByUnknown]:
    """The unknowns without a derivative of every equation, if all of them have constant factors there."""
    derivative, known = system.structure.derivative, system.known
    found: dict[int, ColumnByUnknown] = {}
    for e, (template, row) in enumerate(zip(system.template, system.variables, strict=True)):
        columns = {v: c for c, v in enumerate(row) if derivative[v] < 0 and v not in known}
        constant = (_factor(template, c) is not None for c in columns.values())
        if columns and (template.coefficients() or all(constant)):
            found[e] = columns
    return found


@cache
def _factor(template: Statement, column: int) -> Any:
    """The slot's factor if it is a number or a rational function of parameters, else None."""
    factor = template.partial(column)
    if not factor.free_symbols <= {*template.parameters} or not factor.is_rational_function():
        return None
    if not template.is_solvable(column):
        return None
    return factor.xreplace({f: sp.Rational(f) for f in factor.atoms(sp.Float)})


def _modular(expression: Any, values: dict[Any, Any]) -> Any:
    if expression.is_Symbol:
        return values[expression]
    if expression.is_Rational:
        return RESIDUES(int(expression.p)) / RESIDUES(int(expression.q))
    if expression.is_Pow:
        return _modular(expression.base, values) ** int(expression.exp)
    return reduce(mul if expression.is_Mul else add, (_modular(a, values) for a in expression.args))


def _parameters(system: Equations, equations: dict[int, Any]) -> list[int]:
    return list(dict.fromkeys(p for e in equations for p in system.parameters[e]))


def _exactly(
    system: Equations, rows: dict[int, ColumnByUnknown], numbers: dict[int, int]
) -> list[dict[int, sp.Expr]]:
    """Factors with which these equations cancel, if there are any: polynomials in ``_symbol(number)``."""
    coefficients: dict[int, dict[int, Any]] = {}
    for e, columns in rows.items():
        template = system.template[e]
        own = {
            s: _symbol(numbers[p])
            for s, p in zip(template.parameters, system.parameters[e], strict=True)
        }
        coefficients[e] = {v: _factor(template, c).xreplace(own) for v, c in columns.items()}
    present = {s for row in coefficients.values() for x in row.values() for s in x.free_symbols}
    symbols = [s for s in map(_symbol, numbers.values()) if s in present]
    field: Any = sp.QQ.frac_field(*symbols) if symbols else sp.QQ
    exact = {e: {v: field.from_sympy(x) for v, x in row.items()} for e, row in coefficients.items()}
    found: list[dict[int, sp.Expr]] = []
    for factors in cancelling(exact):
        ring = field.get_ring()
        common = reduce(ring.lcm, (field.denom(f) for f in factors.values()))
        found.append({e: field.to_sympy(f * common) for e, f in factors.items()})
    return found


def _symbol(number: int) -> sp.Symbol:
    return sp.Symbol(f"p{number}", real=True)


# -- the combination ----------------------------------------------------------------------------------


def _replace(
    system: Equations, target: int, factors: dict[int, sp.Expr], numbers: dict[int, int]
) -> None:
    """Put a combination of equations in the place of one of them."""
    derivative = system.structure.derivative
    parts: list[Part] = []
    nodes: list[int] = []
    modules: list[int] = []
    for e, factor in factors.items():
        row = system.variables[e]
        kept = tuple(c for c, v in enumerate(row) if derivative[v] >= 0 or v in system.known)
        parameters = tuple(numbers[p] for p in system.parameters[e])
        parts.append((system.template[e], factor, kept, parameters))
        nodes += [row[c] for c in kept]
        modules += system.modules[e]
    template = _combined(tuple(parts), len(numbers))
    codes = [nodes.index(v) + 1 for v in nodes]
    special, (columns, used, called) = specialised(
        template, (*codes, *[0] * len(numbers)), system.origin[target]
    )
    every = list(numbers)
    system.template[target] = special
    system.variables[target] = [nodes[c] for c in columns]
    system.parameters[target] = [every[c] for c in used]
    system.modules[target] = [modules[c] for c in called]
    system.incidence[target] = [v for v in system.variables[target] if v not in system.known]


@cache
def _combined(parts: tuple[Part, ...], n_parameters: int) -> Template:
    """The sum of multiples of equations, without the slots that cancel."""
    terms: list[sp.Expr] = []
    variables: list[sp.Symbol] = []
    modules: list[sp.Symbol] = []
    for i, (template, factor, kept, numbers) in enumerate(parts):
        own = {
            s: sp.Symbol(f"{s.name}|{i}", real=s.is_real)
            for s in (*template.variables, *template.modules)
        }
        variables += [own[template.variables[c]] for c in kept]
        modules += [own[s] for s in template.modules]
        shared = {s: _symbol(n) for s, n in zip(template.parameters, numbers, strict=True)}
        gone = {s: sp.S.Zero for c, s in enumerate(template.variables) if c not in kept}
        terms.append(factor * template.residual.xreplace({**own, **shared, **gone}))
    return Template(
        sp.Add(*terms),
        tuple(variables),
        (0,) * len(variables),
        tuple(_symbol(n) for n in range(n_parameters)),
        tuple(modules),
    )
