"""Colours of columns: no two columns of one colour share a row, and there are few colours."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.structure import color_columns, long_rows


def band(n, width):
    rows, columns = np.nonzero(np.abs(np.subtract.outer(np.arange(n), np.arange(n))) <= width)
    return rows, columns, n, n


def grid(n):
    i = np.arange(n * n).reshape(n, n)
    a = np.concatenate([i[:, :-1].ravel(), i[:-1].ravel()])
    b = np.concatenate([i[:, 1:].ravel(), i[1:].ravel()])
    return (*(np.concatenate(p) for p in ((i.ravel(), a, b), (i.ravel(), b, a))), n * n, n * n)


def scattered(n, seed):
    rows, columns = np.nonzero(np.random.default_rng(seed).random((n, 2 * n)) < 0.03)
    return rows, columns, n, 2 * n


@pytest.mark.parametrize(
    ("pattern", "most"),
    [
        (band(30, 0), 1),
        (band(30, 1), 3),
        (band(30, 4), 9),
        (grid(12), 7),
        (scattered(100, 0), 25),
        (scattered(100, 1), 25),
        ((np.zeros(0, dtype=int), np.zeros(0, dtype=int), 0, 0), 0),
        ((np.zeros(0, dtype=int), np.zeros(0, dtype=int), 3, 3), 1),
    ],
)
def test_columns_of_a_color_share_no_row(pattern, most):
    rows, columns, _, n_columns = pattern
    colors = color_columns(*pattern)
    assert len(colors) == n_columns
    assert colors.max(initial=-1) < most
    assert sorted(set(colors.tolist())) == list(range(colors.max(initial=-1) + 1))
    in_row = list(zip(rows.tolist(), colors[columns].tolist(), strict=True))
    assert len(set(in_row)) == len(in_row)


def test_the_order_of_the_entries_does_not_matter():
    rows, columns, *shape = scattered(50, 3)
    mixed = np.random.default_rng(0).permutation(len(rows))
    assert (
        color_columns(rows[mixed], columns[mixed], *shape) == color_columns(rows, columns, *shape)
    ).all()


def test_few_long_rows_are_left_to_reverse_derivatives():
    rows, _, n, _ = band(100, 1)
    assert len(long_rows(rows, n)) == 0
    full = np.concatenate([rows, np.full(n, 70), np.full(n, 20)])
    assert long_rows(full, n).tolist() == [20, 70]
    assert len(long_rows(np.repeat(np.arange(n), n), n)) == 0
    assert len(long_rows(np.zeros(0, dtype=int), 0)) == 0
