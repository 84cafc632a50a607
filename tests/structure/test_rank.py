"""Independent columns: numbers where the structure promises too much."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.sparse import csr_array, eye_array, hstack

from acausal.structure.rank import (
    cancelling,
    choose_columns,
    independent,
    prune_singletons,
    singular,
)
from tests.support.counted import calls_below

matrices = st.tuples(st.integers(1, 4), st.integers(1, 6)).flatmap(
    lambda size: st.lists(
        st.lists(st.sampled_from([0, 0, 1, -1, 2]), min_size=size[1], max_size=size[1]),
        min_size=size[0],
        max_size=size[0],
    ).map(lambda rows: np.array(rows, dtype=float))
)


def earliest(matrix, candidates):
    """The first independent columns by trying all."""
    rank = np.linalg.matrix_rank(matrix[:, candidates])
    return next(
        list(c)
        for c in itertools.combinations(candidates, rank)
        if np.linalg.matrix_rank(matrix[:, list(c)]) == rank
    )


@given(matrices, st.permutations(range(6)))
def test_the_earliest_independent_columns_are_chosen(matrix, preference):
    candidates = [c for c in preference if c < matrix.shape[1]]
    chosen, left = choose_columns(csr_array(matrix), candidates)
    rank = np.linalg.matrix_rank(matrix)
    assert len(left) == len(matrix) - rank
    if not left:
        assert chosen == earliest(matrix, candidates)


def test_structure_is_not_enough():
    # a - b + c = 0 and a - b - d = 0: a and b cannot both be computed
    matrix = csr_array(np.array([[1.0, -1, 1, 0], [1, -1, 0, -1]]))
    assert choose_columns(matrix, [0, 1, 2, 3]) == ([0, 2], [])
    assert choose_columns(matrix, [3, 1, 0, 2]) == ([3, 1], [])


def test_dependent_rows_are_told():
    matrix = csr_array(np.array([[2.0, -3, 0], [4, -6, 0], [0, 0, 1]]))
    chosen, left = choose_columns(matrix, [0, 1, 2])
    assert chosen == [0, 2]
    assert left == [1]


def test_entries_that_are_zero_count_as_absent():
    matrix = csr_array(([0.0, 1.0, 1.0], ([0, 0, 1], [0, 1, 0])), shape=(2, 2))
    assert choose_columns(matrix, [0, 1]) == ([0, 1], [])


def test_units_do_not_matter():
    matrix = np.array([[1.0, -1, 1, 0], [1, -1, 0, -1]])
    scaled = csr_array(np.diag([1e9, 1e-9]) @ matrix)
    assert choose_columns(scaled, [0, 1, 2, 3]) == ([0, 2], [])


@given(
    st.integers(1, 5).flatmap(
        lambda n: st.lists(st.sampled_from([0, 1, -1, 3]), min_size=n * n, max_size=n * n)
    )
)
def test_singular_agrees_with_the_determinant(entries):
    n = int(len(entries) ** 0.5)
    matrix = np.array(entries, dtype=float).reshape(n, n)
    rows, columns = np.indices((n, n)).reshape(2, -1).tolist()
    assert singular(rows, columns, entries, n) == (abs(np.linalg.det(matrix)) < 1e-6)


def test_nearly_dependent_is_not_dependent():
    columns = [(0, {0: 1.0, 1: 1.0}), (1, {0: 1.0, 1: 1.0 + 1e-6})]
    assert independent(columns)[0] == [0, 1]


@pytest.mark.parametrize("n", [10_000])
def test_many_constraints_take_linear_time(n):
    # a chain of rigid joints, x[i] - x[i+1] = 0, with one spot that needs elimination
    chain = (eye_array(n, n + 1) - eye_array(n, n + 1, k=1)).tocsr()
    spot = csr_array(np.array([[1.0, -1, 1, 0], [1, -1, 0, -1]]))
    zeros = csr_array((n, 4))
    matrix = csr_array(hstack([chain, zeros])).tolil()
    matrix.resize((n + 2, n + 5))
    matrix[n:, n + 1 :] = spot
    given = csr_array(matrix)
    with calls_below(2_000_000):
        chosen, left = choose_columns(given, list(range(n + 5)))
    assert left == []
    assert chosen[-2:] == [n + 1, n + 3]


# -- rows that cancel ---------------------------------------------------------------------------------------------


def as_rows(matrix):
    """The entries that are not zero, of the rows that have some."""
    rows = {
        i: {c: Fraction(int(v)) for c, v in enumerate(row) if v} for i, row in enumerate(matrix)
    }
    return {i: row for i, row in rows.items() if row}


@given(matrices)
def test_all_combinations_that_cancel_are_found(matrix):
    rows = as_rows(matrix)
    found = cancelling(rows)
    assert len(found) == len(rows) - np.linalg.matrix_rank(matrix)
    for factors in found:
        total = sum(float(f) * matrix[i] for i, f in factors.items())
        assert not total.any()
        assert all(factors.values())
    last = [list(factors)[-1] for factors in found]
    assert not any(row in factors for row in last for factors in found if [*factors][-1] != row)


@given(matrices)
def test_rows_that_are_not_crowded_stand_in_no_combination(matrix):
    rows = as_rows(matrix)
    inside = prune_singletons(rows)
    assert {i for factors in cancelling(rows) for i in factors} <= set(inside)
    assert len(cancelling({i: rows[i] for i in inside})) == len(cancelling(rows))


def test_a_chain_has_no_crowd_and_a_ring_is_one():
    chain = {i: (i, i + 1) for i in range(5)}
    assert prune_singletons(chain) == []
    ring = {i: (i, (i + 1) % 5) for i in range(5)} | {5: (2, 7)}
    assert prune_singletons(ring) == [0, 1, 2, 3, 4]
    turned = {i: {a: Fraction(1), b: Fraction(-1)} for i, (a, b) in list(ring.items())[:5]}
    assert cancelling(turned) == [dict.fromkeys(range(5), 1)]
