"""Independent rows and columns of a sparse matrix: numbers decide where the structure alone is too optimistic."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from typing import Any

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from acausal.structure import graph

TOLERANCE = 1e-12
Column = dict[int, float]
"""The entries of a column that are not zero, by row."""


def choose_columns(matrix: Any, candidates: Sequence[int]) -> tuple[list[int], list[int]]:
    """One column for every row, as early as possible in ``candidates``, so that they are independent.

    The structure decides first. If its choice is singular in a connected part of rows and candidates, the columns of
    that part are chosen by elimination, greedily in their order (which is optimal: independent columns are a matroid).

    Returns:
        The columns in order of ``candidates``, and the rows that depend on others.
    """
    n, width = matrix.shape
    columns = _columns(matrix, candidates)
    incidence: list[list[int]] = [[] for _ in range(n)]
    for c in candidates:
        for row in columns[c]:
            incidence[row].append(c)
    chosen = graph.choose_variables(incidence, candidates, width)
    suspects = _singular_rows(incidence, columns, chosen, width)
    if not suspects:
        return chosen, []
    part = connected_parts(incidence, width)
    wrong = {int(part[row]) for row in suspects}
    inside = [c for c in candidates if columns[c] and int(part[n + c]) in wrong]
    kept, pivots = independent((c, columns[c]) for c in inside)
    keep = {*kept, *(c for c in chosen if int(part[n + c]) not in wrong)}
    left = [row for row in range(n) if int(part[row]) in wrong and row not in pivots]
    return [c for c in candidates if c in keep], left


def independent(columns: Iterable[tuple[int, Column]]) -> tuple[list[int], set[int]]:
    """The columns that do not depend on earlier ones, and the rows that they pivot on (sparse elimination)."""
    basis: list[tuple[int, Column]] = []
    basis_of: dict[int, int] = {}
    kept: list[int] = []
    for name, column in columns:
        rest = dict(column)
        scale = max(map(abs, rest.values()), default=0.0)
        waiting = [basis_of[row] for row in rest if row in basis_of]
        heapify(waiting)
        while waiting:
            pivot, known = basis[heappop(waiting)]
            factor = rest.pop(pivot, 0.0)
            for row, value in known.items() if factor else ():
                if row not in rest and row in basis_of:
                    heappush(waiting, basis_of[row])
                rest[row] = rest.get(row, 0.0) - factor * value
        pivot = max(rest, key=lambda row: abs(rest[row]), default=-1)
        if pivot >= 0 and abs(rest[pivot]) > TOLERANCE * scale:
            divisor = rest.pop(pivot)
            basis_of[pivot] = len(basis)
            basis.append((pivot, {row: value / divisor for row, value in rest.items()}))
            kept.append(name)
    return kept, set(basis_of)


def singular(rows: Sequence[int], columns: Sequence[int], values: Sequence[float], n: int) -> bool:
    """Whether an n by n matrix, given by its entries, is singular, whatever the units of its rows."""
    largest = [0.0] * n
    for row, value in zip(rows, values, strict=True):
        largest[row] = max(largest[row], abs(value))
    scaled: list[Column] = [{} for _ in range(n)]
    for row, column, value in zip(rows, columns, values, strict=True):
        if value:
            scaled[column][row] = value / largest[row]
    return len(independent(enumerate(scaled))[0]) < n


def prune_singletons(incidence: Mapping[int, Iterable[int]]) -> list[int]:
    """The rows that are left when those with a column of their own are removed, one after the other.

    The removed rows are not part of any combination of rows that cancels.
    """
    holders: dict[int, dict[int, None]] = {}
    for name, row in incidence.items():
        for c in row:
            holders.setdefault(c, {})[name] = None
    left = dict.fromkeys(incidence)
    lonely = [c for c, names in holders.items() if len(names) == 1]
    while lonely:
        for name in list(holders[lonely.pop()]):
            del left[name]
            for c in incidence[name]:
                del holders[c][name]
                if len(holders[c]) == 1:
                    lonely.append(c)
    return list(left)


def cancelling(rows: Mapping[int, Mapping[int, Any]]) -> list[dict[int, Any]]:
    """Combinations of rows that cancel: factors by row. Each ends with a row that is in no other.

    Exact for the numbers of any field (fractions, say, or residues of a prime).
    """
    uses = Counter(c for row in rows.values() for c in row)
    basis: list[_Reduced] = []
    basis_of: dict[int, int] = {}
    found: list[dict[int, Any]] = []
    for name, row in rows.items():
        rest, used = dict(row), list[tuple[int, Any]]()
        waiting = [basis_of[c] for c in rest if c in basis_of]
        heapify(waiting)
        while waiting:
            known = basis[number := heappop(waiting)]
            factor = rest.pop(known.pivot, None)
            if not factor:
                continue
            used.append((number, factor))
            for c, value in known.rest.items():
                if c not in rest and c in basis_of:
                    heappush(waiting, basis_of[c])
                rest[c] = rest[c] - factor * value if c in rest else -factor * value
        rest = {c: value for c, value in rest.items() if value}
        if rest:
            pivot = min(rest, key=lambda c: (uses[c], c))
            divisor = rest.pop(pivot)
            basis_of[pivot] = len(basis)
            reduced = {c: value / divisor for c, value in rest.items()}
            basis.append(_Reduced(pivot, reduced, name, divisor, tuple(used)))
        else:
            found.append({**_in_rows(used, basis), name: next(iter(row.values())) ** 0})
    return found


@dataclass(frozen=True)
class _Reduced:
    """``column pivot + rest``: row ``name`` less multiples of earlier ones (``used``), divided by ``divisor``."""

    pivot: int
    rest: dict[int, Any]
    name: int
    divisor: Any
    used: tuple[tuple[int, Any], ...]


def _in_rows(used: Sequence[tuple[int, Any]], basis: Sequence[_Reduced]) -> dict[int, Any]:
    """Minus the sum of multiples of reduced rows, in terms of the rows that they come from, in their order."""
    weight = {number: -factor for number, factor in used}
    waiting = [-number for number in weight]
    heapify(waiting)
    found: dict[int, Any] = {}
    while waiting:
        number = -heappop(waiting)
        if not (share := weight.pop(number, None)):
            continue
        share = share / basis[number].divisor
        found[number] = share
        for earlier, factor in basis[number].used:
            heappush(waiting, -earlier)
            weight[earlier] = (
                weight[earlier] - share * factor if earlier in weight else -share * factor
            )
    return {basis[number].name: found[number] for number in sorted(found)}


def _columns(matrix: Any, candidates: Sequence[int]) -> dict[int, Column]:
    """The candidates' columns; rows are scaled to a largest entry of one."""
    entries = matrix.tocoo()
    largest = np.zeros(matrix.shape[0])
    np.maximum.at(largest, entries.row, np.abs(entries.data))
    columns: dict[int, Column] = {c: {} for c in candidates}
    present = entries.data != 0
    scaled = entries.data[present] / largest[entries.row[present]]
    rows, names = entries.row[present].tolist(), entries.col[present].tolist()
    for row, c, value in zip(rows, names, scaled.tolist(), strict=True):
        if c in columns:
            columns[c][row] = value
    return columns


def _singular_rows(
    incidence: list[list[int]], columns: dict[int, Column], chosen: list[int], width: int
) -> list[int]:
    """Rows without a column of their own, and those of singular diagonal blocks."""
    allowed = set(chosen)
    own = [[c for c in row if c in allowed] for row in incidence]
    column_of = graph.match(own, width)
    lonely = [row for row, c in enumerate(column_of) if c < 0]
    if lonely:
        return lonely
    block = graph.order_blocks(own, column_of, width).block
    order = np.argsort(block, kind="stable")
    bounds = np.flatnonzero(np.diff(block[order])) + 1
    found: list[int] = []
    for members in np.split(order, bounds):
        rows = set(members.tolist())
        if len(rows) > 1:
            mine = [
                (column_of[r], {i: v for i, v in columns[column_of[r]].items() if i in rows})
                for r in rows
            ]
            if len(independent(mine)[0]) < len(rows):
                found += sorted(rows)
    return found


def connected_parts(incidence: list[list[int]], width: int) -> np.ndarray:
    """For every row, then every column, the connected part that it lies in."""
    n = len(incidence)
    rows = np.repeat(np.arange(n), [len(r) for r in incidence])
    cols = np.fromiter((n + c for r in incidence for c in r), dtype=np.int64, count=len(rows))
    edges = csr_array((np.ones(len(rows), dtype=np.int8), (rows, cols)), shape=(n + width,) * 2)
    return connected_components(edges, directed=False)[1]
