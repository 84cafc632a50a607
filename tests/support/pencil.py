"""An independent judge of linear models: is the matrix pencil of the flat equations regular, and of which degree?

The equations ``sum_k A_k x^(k) = ...`` have exactly one solution for consistent initial values where
``det(sum_k A_k s^k)`` is not zero, and as many states as its degree in ``s`` (Gantmacher 1959, chapter XII).
Both are decided exactly: partial derivatives are dyadic numbers, taken modulo a prime.
"""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np

from acausal.flattening.flat_model import FlatModel
from acausal.structure.jacobian import Point, parameter_values, partials, random_values

PRIME = 2**61 - 1
Polynomial = dict[int, int]
"""Coefficients by power of ``s``, none of them zero."""
Row = dict[int, Polynomial]


def degree(flat: FlatModel) -> int | None:
    """How many states the model has at its own parameter values; None if its pencil is singular.

    Nonlinear equations are judged by their partial derivatives at a point without relations.
    """
    rows = _rows(flat)
    unknowns = flat.n_variables - len(flat.inputs)
    if len(rows) != unknowns:
        return None
    core = _eliminate_constants(rows)
    if core is None:
        return None
    columns = sorted({c for row in core for c in row})
    if len(columns) != len(core):
        return None
    highest = [max(max(row[c]) for row in core if c in row) for c in columns]
    values = [_determinant(core, columns, s) for s in range(1, sum(highest) + 2)]
    return _degree_of_interpolant(values)


def _rows(flat: FlatModel) -> list[Row]:
    """The partial derivatives of all flat equations, by unknown and order of differentiation."""
    n = flat.n_variables
    known = set(flat.inputs.tolist())
    orders = 1 + max((o for g in flat.groups for o in g.template.orders), default=0)
    point = Point(random_values(n * orders), parameter_values(flat))
    rows: list[Row] = []
    for group in flat.groups:
        own: list[Row] = [{} for _ in range(len(group))]
        place = group.variables + n * np.asarray(group.template.orders, dtype=np.int64)
        for column, order in enumerate(group.template.orders):
            found = partials(group.template, column, place, group.parameters, point)
            for row, v, value in zip(own, group.variables[:, column], found, strict=True):
                if int(v) not in known:
                    _add(row.setdefault(int(v), {}), {order: _modular(value)}, 1, 0)
        rows += own
    return [{c: p for c, p in row.items() if p} for row in rows]


def _modular(value: float) -> int:
    exact = Fraction(float(value))
    return exact.numerator * pow(exact.denominator, -1, PRIME) % PRIME


def _add(target: Polynomial, other: Polynomial, factor: int, shift: int) -> None:
    """``target += factor * s**shift * other``."""
    for power, value in other.items():
        total = (target.get(power + shift, 0) + factor * value) % PRIME
        if total:
            target[power + shift] = total
        else:
            target.pop(power + shift, None)


def _eliminate_constants(rows: list[Row]) -> list[Row] | None:
    """Schur complement of all pivots that do not depend on ``s``: the determinant but for a factor."""
    rows = [{c: dict(p) for c, p in row.items()} for row in rows]
    holders: dict[int, set[int]] = {}
    for i, row in enumerate(rows):
        for c in row:
            holders.setdefault(c, set()).add(i)
    left = dict.fromkeys(range(len(rows)))
    while True:
        pivots = [
            (len(rows[i]), len(holders[c]), i, c)
            for i in left
            for c, p in rows[i].items()
            if list(p) == [0]
        ]
        if not pivots:
            break
        used: set[int] = set()
        for _, _, i, c in sorted(pivots):
            if i in used or i not in left or list(rows[i].get(c, ())) != [0]:
                continue
            used |= {i, *holders[c]}
            _eliminate(rows, holders, i, c)
            del left[i]
    if any(not rows[i] for i in left):
        return None
    return [rows[i] for i in left]


def _eliminate(rows: list[Row], holders: dict[int, set[int]], pivot: int, column: int) -> None:
    own = rows[pivot]
    inverse = pow(own[column][0], -1, PRIME)
    for i in sorted(holders[column] - {pivot}):
        factor = rows[i].pop(column)
        for c, p in own.items():
            if c == column:
                continue
            entry = rows[i].setdefault(c, {})
            for shift, value in factor.items():
                _add(entry, p, -inverse * value % PRIME, shift)
            if entry:
                holders[c].add(i)
            else:
                del rows[i][c]
                holders[c].discard(i)
    for c in own:
        holders[c].discard(pivot)
    holders[column].clear()


def _determinant(core: list[Row], columns: list[int], s: int) -> int:
    powers = {k: pow(s, k, PRIME) for k in {k for row in core for p in row.values() for k in p}}
    place = {c: i for i, c in enumerate(columns)}
    n = len(core)
    matrix = [[0] * n for _ in range(n)]
    for i, row in enumerate(core):
        for c, p in row.items():
            matrix[i][place[c]] = sum(v * powers[k] for k, v in p.items()) % PRIME
    result = 1
    for k in range(n):
        pivot = next((i for i in range(k, n) if matrix[i][k]), None)
        if pivot is None:
            return 0
        if pivot != k:
            matrix[k], matrix[pivot], result = matrix[pivot], matrix[k], -result
        result = result * matrix[k][k] % PRIME
        inverse = pow(matrix[k][k], -1, PRIME)
        for i in range(k + 1, n):
            factor = matrix[i][k] * inverse % PRIME
            if factor:
                for j in range(k + 1, n):
                    matrix[i][j] = (matrix[i][j] - factor * matrix[k][j]) % PRIME
    return result


def _degree_of_interpolant(values: list[int]) -> int | None:
    """Degree of the polynomial through ``(1, values[0]), (2, values[1]), ...``; None for zero (Newton's form)."""
    found = None
    differences = list(values)
    for order in range(len(values)):
        if differences[0]:
            found = order
        differences = [(b - a) % PRIME for a, b in itertools.pairwise(differences)]
    return found
