"""Colour the columns of a sparse matrix so that columns of one colour share no row. This file knows integers only.

Where few rows are much longer than the others, the others alone are coloured.

All columns of a colour can be found from one product of the matrix with a vector (Curtis, Powell & Reid 1974, "On the
estimation of sparse Jacobian matrices").
"""

from __future__ import annotations

import numpy as np

from acausal.structure.elimination_order import Integers

REVERSE = 4
"""What a row costs that is found by a reverse derivative, in colours."""


def long_rows(rows: Integers, n_rows: int) -> Integers:
    """The few rows, in order, without which half as many derivatives do; a row as long as others is not among them.

    A matrix needs at least as many colours as its longest row has entries, whose rows are given.
    """
    length = np.bincount(rows, minlength=n_rows)
    order = np.argsort(-length, kind="stable")
    costs = np.append(length[order], 0) + REVERSE * np.arange(n_rows + 1)
    best = int(np.argmin(costs))
    return np.sort(order[: best if 2 * costs[best] < costs[0] else 0])


def color_columns(rows: Integers, columns: Integers, n_rows: int, n_columns: int) -> Integers:
    """A colour for every column, counted from 0, shape (n_columns,), from the positions of the entries.

    The columns take the first colour that is free, those that meet most others first (Welsh & Powell 1967).
    """
    order = np.lexsort((rows, columns))
    row_of = rows[order].tolist()
    ends = np.searchsorted(columns[order], np.arange(n_columns + 1)).tolist()
    met = np.bincount(columns, np.bincount(rows, minlength=n_rows)[rows], n_columns)
    used = [0] * n_rows  # the colours in a row, as the bits of a number
    chosen = [0] * n_columns
    for column in np.argsort(-met, kind="stable").tolist():
        own = row_of[ends[column] : ends[column + 1]]
        taken = 0
        for row in own:
            taken |= used[row]
        free = ~taken & (taken + 1)
        chosen[column] = free.bit_length() - 1
        for row in own:
            used[row] |= free
    return np.asarray(chosen, dtype=np.int64)
