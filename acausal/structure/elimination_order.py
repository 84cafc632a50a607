"""An order of elimination for a large sparse matrix that causes little fill-in. This file knows numbers only.

The order is found once, when a model is compiled; each factorization uses it (as in circuit simulators: Davis &
Palamadai Natarajan 2010, "Algorithm 907: KLU").
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from typing import Any

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array
from scipy.sparse.csgraph import min_weight_full_bipartite_matching
from scipy.sparse.linalg import splu

Integers = np.ndarray[Any, np.dtype[np.int64]]
CHEAP = 4
"""Pivots with at most this many updates are taken first (Markowitz 1957)."""
THRESHOLD = 0.1
"""How much smaller than the largest entry beside it a pivot may be."""
CANCELLED = 1e-13
"""Relative size below which the difference of two equal numbers is roundoff."""
SETTINGS = {"SymmetricMode": True}
"""SuperLU then prefers the diagonal, where the order has put the pivots."""


@dataclass(frozen=True, eq=False)
class Pattern:
    """The positions of a square matrix's entries: entry ``k`` is in row ``rows[k]`` and column ``columns[k]``.

    Attributes:
        row_order, column_order: the order of elimination; the reordered matrix has its pivots on the diagonal.
    """

    rows: Integers
    columns: Integers
    row_order: Integers
    column_order: Integers


def analyse(rows: Integers, columns: Integers, values: np.ndarray, n: int) -> Pattern:
    """The pattern of a matrix and an order of elimination with little fill-in.

    Cheap pivots are taken one by one. The rest is matched to a diagonal of large entries (Duff & Koster 2001) and
    ordered by minimum degree.

    Raises:
        LinAlgError: if the matrix is singular.
    """
    matrix: Any = csc_array((values, (rows, columns)), shape=(n, n))
    matrix.eliminate_zeros()
    first, rest = _cheap_pivots(matrix)
    chosen_rows, chosen_columns = [r for r, _ in first], [c for _, c in first]
    if rest:
        left_rows, left_columns, core = _core(rest)
        diagonal = _diagonal(core)
        order = _minimum_degree(core[:, diagonal])
        chosen_rows += left_rows[order].tolist()
        chosen_columns += left_columns[diagonal[order]].tolist()
    orders = (np.asarray(o, dtype=np.int64) for o in (chosen_rows, chosen_columns))
    return Pattern(rows, columns, *orders)


def analyse_diagonal(rows: Integers, columns: Integers, n: int) -> Pattern:
    """The pattern of a matrix whose diagonal is present and good for pivots, ordered by minimum degree.

    Fast, because it needs no values: for ``I - c J`` with any Jacobian ``J``.
    """
    loss = 1.0 + np.bincount(rows, minlength=n) + np.bincount(columns, minlength=n)
    values = np.where(rows == columns, loss[rows], -1.0)  # dominant, whatever the order
    order = _minimum_degree(csc_array((values, (rows, columns)), shape=(n, n)))
    return Pattern(rows, columns, order, order)


def match_rows(rows: Integers, columns: Integers, values: np.ndarray, n: int) -> Integers:
    """For every column a row of its own, so that the product of the entries there is as large as can be.

    Raises:
        LinAlgError: if the matrix is singular, whatever its entries are.
    """
    return np.argsort(_diagonal(csr_array((values, (rows, columns)), shape=(n, n))))


SparseColumns = dict[int, dict[int, float]]
"""Entries by column and row."""


def _cheap_pivots(matrix: Any) -> tuple[list[tuple[int, int]], SparseColumns]:
    """The pivots (row, column) that cost little, in order, and the matrix after their elimination."""
    starts, indices, data = matrix.indptr.tolist(), matrix.indices.tolist(), matrix.data.tolist()
    columns = {
        c: dict(zip(indices[a:b], data[a:b], strict=True))
        for c, (a, b) in enumerate(itertools.pairwise(starts))
    }
    holders: dict[int, dict[int, None]] = {}
    for c, column in columns.items():
        for r in column:
            holders.setdefault(r, {})[c] = None

    def cheapest(c: int) -> tuple[int, int, int]:
        """Cost of a column's best pivot, the column, and the pivot's row."""
        column = columns[c]
        least = THRESHOLD * max(map(abs, column.values()))
        length, row = min((len(holders[r]), r) for r, v in column.items() if abs(v) >= least)
        return (len(column) - 1) * (length - 1), c, row

    pivots: list[tuple[int, int]] = []
    waiting = [cheapest(c) for c, column in columns.items() if column]
    heapify(waiting)
    while waiting and waiting[0][0] <= CHEAP:
        c = heappop(waiting)[1]
        if not columns.get(c):
            continue
        latest = cheapest(c)
        if latest[0] > CHEAP or (waiting and latest[0] > waiting[0][0]):
            heappush(waiting, latest)
            continue
        pivots.append((latest[2], c))
        for changed in _eliminate(columns, holders, c, latest[2]):
            if columns[changed]:
                heappush(waiting, cheapest(changed))
    return pivots, columns


def _eliminate(
    columns: SparseColumns, holders: dict[int, dict[int, None]], pivot: int, row: int
) -> list[int]:
    """Take a pivot's column and row out of the matrix; returns the columns that changed."""
    column = columns.pop(pivot)
    divisor = column.pop(row)
    for r in column:
        del holders[r][pivot]
    changed = [c for c in holders.pop(row) if c != pivot]
    for c in changed:
        other = columns[c]
        factor = other.pop(row) / divisor
        for r, value in column.items():
            before = other.get(r, 0.0)
            other[r] = after = before - factor * value
            if abs(after) <= CANCELLED * abs(before):
                del other[r]
                holders[r].pop(c, None)
            else:
                holders[r][c] = None
    return changed


def _core(columns: SparseColumns) -> tuple[Integers, Integers, Any]:
    """The rest as a matrix of its own, with the numbers of its rows and columns."""
    column_numbers = np.asarray(list(columns), dtype=np.int64)
    entries = [(r, i, v) for i, column in enumerate(columns.values()) for r, v in column.items()]
    r, i, values = (
        (np.asarray(part) for part in zip(*entries, strict=True)) if entries else [()] * 3
    )
    row_numbers, places = np.unique(r, return_inverse=True)
    n = len(column_numbers)
    if len(row_numbers) != n:
        raise np.linalg.LinAlgError("singular")
    return row_numbers, column_numbers, csr_array((values, (places, i)), shape=(n, n))


def _diagonal(matrix: Any) -> Integers:
    """A column for every row, so that the product of the entries there is as large as can be."""
    entries: Any = coo_array(matrix)
    size = np.abs(entries.data)
    largest = np.zeros(matrix.shape[0])
    np.maximum.at(largest, entries.row, size)
    with np.errstate(divide="ignore"):
        loss = 1.0 + np.log(largest[entries.row]) - np.log(size)
    loss = np.rint(1024 * loss)  # whole numbers: rounding lets the matching go on without end
    present = np.isfinite(loss)
    places = entries.row[present], entries.col[present]
    try:
        _, columns = min_weight_full_bipartite_matching(
            csr_array((loss[present], places), shape=matrix.shape)
        )
    except ValueError:
        raise np.linalg.LinAlgError("singular") from None
    return columns.astype(np.int64)


def _minimum_degree(matrix: Any) -> Integers:
    """An order for the diagonal's pivots, by SuperLU."""
    try:
        factors = splu(
            csc_array(matrix),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=THRESHOLD,
            options=SETTINGS,
        )
    except RuntimeError:
        raise np.linalg.LinAlgError("singular") from None
    return np.argsort(factors.perm_c)
