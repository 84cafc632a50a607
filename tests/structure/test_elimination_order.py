"""The order in which a sparse matrix is eliminated: complete, cheap, and refused where the matrix is singular."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment
from scipy.sparse import coo_array, csc_array
from scipy.sparse.linalg import splu

from acausal.structure.elimination_order import SETTINGS, THRESHOLD, analyse, match_rows


def reordered(rows, columns, values, n):
    pattern = analyse(rows, columns, values, n)
    assert sorted(pattern.row_order) == sorted(pattern.column_order) == list(range(n))
    matrix = coo_array((values, (rows, columns)), shape=(n, n)).tocsr()
    return csc_array(matrix[pattern.row_order][:, pattern.column_order])


def fill(matrix):
    factors = splu(matrix, "NATURAL", diag_pivot_thresh=THRESHOLD, options=SETTINGS)
    return factors.L.nnz + factors.U.nnz


def random(n, density, seed):
    generator = np.random.default_rng(seed)
    dense = np.where(generator.random((n, n)) < density, generator.normal(size=(n, n)), 0)
    dense[np.arange(n), generator.permutation(n)] += 1.0
    rows, columns = np.nonzero(dense)
    return rows, columns, dense[rows, columns], n


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize(("n", "density"), [(1, 1.0), (7, 0.3), (60, 0.02), (200, 0.005)])
def test_pivots_come_to_stand_on_the_diagonal(n, density, seed):
    matrix = reordered(*random(n, density, seed))
    factors = splu(matrix, "NATURAL", diag_pivot_thresh=THRESHOLD, options=SETTINGS)
    assert (factors.perm_r == np.arange(n)).mean() > 0.9


def test_an_arrow_does_not_fill_in():
    n = 50
    head, i = np.zeros(n - 1, dtype=int), np.arange(1, n)
    rows = np.concatenate([np.arange(n), head, i])
    columns = np.concatenate([np.arange(n), i, head])
    values = np.concatenate([np.full(n, 4.0), np.ones(2 * (n - 1))])
    assert fill(reordered(rows, columns, values, n)) <= len(values) + n


def test_a_band_in_any_order_does_not_fill_in_much():
    n, generator = 200, np.random.default_rng(0)
    i = np.arange(n - 1)
    rows = np.concatenate([np.arange(n), i, i + 1])
    columns = np.concatenate([np.arange(n), i + 1, i])
    a, b = generator.permutation(n), generator.permutation(n)
    values = np.concatenate([np.full(n, 2.5), np.full(2 * (n - 1), -1.0)])
    assert fill(reordered(a[rows], b[columns], values, n)) < 1.5 * len(values)


def test_a_grid_fills_in_less_than_in_its_natural_order():
    n = 24
    number = np.arange(n * n).reshape(n, n)
    a = np.concatenate([number[:, :-1].ravel(), number[:-1].ravel()])
    b = np.concatenate([number[:, 1:].ravel(), number[1:].ravel()])
    rows, columns = np.concatenate([a, b, number.ravel()]), np.concatenate([b, a, number.ravel()])
    values = np.concatenate([np.full(2 * len(a), -1.0), np.full(n * n, 4.1)])
    natural = csc_array(coo_array((values, (rows, columns)), shape=(n * n, n * n)))
    assert fill(reordered(rows, columns, values, n * n)) < 0.6 * fill(natural)


@pytest.mark.parametrize(
    "dense",
    [
        [[0.0, 0.0], [1.0, 1.0]],
        [[1.0, 2.0], [2.0, 4.0]],
        np.add.outer(np.arange(1.0, 9), np.arange(1.0, 9) ** 2),
    ],
    ids=["no entry", "twice the same", "of rank two"],
)
def test_singular_matrices_are_refused(dense):
    dense = np.asarray(dense)
    rows, columns = np.indices(dense.shape).reshape(2, -1)
    with pytest.raises(np.linalg.LinAlgError):
        analyse(rows, columns, dense.ravel(), len(dense))


@pytest.mark.parametrize("seed", range(5))
def test_entries_of_very_unlike_sizes_are_matched(seed):
    """With losses that are no whole numbers scipy's matching does not end, of these matrices that of seed 2."""
    n, random = 40, np.random.default_rng(seed)
    rows = np.concatenate([np.arange(n), random.integers(0, n, 3 * n)])
    columns = np.concatenate([random.permutation(n), random.integers(0, n, 3 * n)])
    rows, columns = np.divmod(np.unique(rows * n + columns), n)
    values = random.choice([1.0, 0.3, 7.0, 1e-17, 2e3], len(rows))
    found = match_rows(rows, columns, values, n)
    dense = np.full((n, n), -1e3)
    dense[rows, columns] = np.log(values)
    best = dense[linear_sum_assignment(dense, maximize=True)].sum()
    assert dense[found, np.arange(n)].sum() == pytest.approx(best, abs=n / 1000)
