"""Sparse systems inside JAX programs, beside dense ones."""

from __future__ import annotations

import threading
import weakref
from concurrent.futures import ThreadPoolExecutor

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import scipy.sparse.linalg

from acausal.codegen import sparse
from acausal.codegen.sparse import SparseMatrix
from acausal.structure.elimination_order import analyse

N = 30


@pytest.fixture(scope="module")
def system():
    """A sparse matrix, its entries, a right side, and the dense solution as a function of both."""
    generator = np.random.default_rng(0)
    dense = np.where(generator.random((N, N)) < 0.1, generator.normal(size=(N, N)), 0)
    dense[np.arange(N), generator.permutation(N)] += 2.0
    rows, columns = np.nonzero(dense)
    entries = dense[rows, columns]

    def solve(entries, b):
        return jnp.linalg.solve(jnp.zeros((N, N)).at[rows, columns].set(entries), b)

    matrix = SparseMatrix(analyse(rows, columns, entries, N))
    return matrix, jnp.asarray(entries), jnp.asarray(generator.normal(size=N)), solve


def close(found, expected):
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())


def test_solutions_are_those_of_the_dense_system(system):
    matrix, entries, b, dense = system
    close(jax.jit(matrix.solve)(entries, b), dense(entries, b))


@pytest.mark.parametrize("argument", [pytest.param(0, marks=pytest.mark.slow), 1])
def test_derivatives_of_all_orders_and_modes(system, argument):
    matrix, entries, b, dense = system

    def loss(solve):
        return lambda *args: jnp.sum(solve(*args) ** 3)

    for transform in (jax.grad, jax.jacfwd):
        of = [transform(loss(solve), argument) for solve in (matrix.solve, dense)]
        close(*(jax.jit(derivative)(entries, b) for derivative in of))
    direction = jnp.ones_like((entries, b)[argument])

    def curvature(solve):
        def along(scale):
            moved = [entries, b]
            moved[argument] = moved[argument] + scale * direction
            return loss(solve)(*moved)

        return jax.jit(jax.grad(jax.grad(along)))(0.0)

    close(curvature(matrix.solve), curvature(dense))


@pytest.mark.parametrize("axes", [(0, 0), (None, 0), (0, None)])
def test_batches(system, axes):
    matrix, entries, b, dense = system
    scale = jnp.asarray([1.0, 0.5, 2.0])[:, None]
    batch = [v if a is None else scale * v for a, v in zip(axes, (entries, b), strict=True)]
    close(*(jax.jit(jax.vmap(solve, axes))(*batch) for solve in (matrix.solve, dense)))


@pytest.mark.slow
def test_batches_of_batches(system):
    matrix, entries, b, dense = system
    each = jnp.arange(1.0, 4.0)[:, None]
    nested = [
        jax.vmap(jax.vmap(s, (None, 0)), (0, None))(each * entries, each**2 * b)
        for s in (matrix.solve, dense)
    ]
    close(*nested)


def test_a_matrix_is_factorized_as_often_as_it_changes(system, monkeypatch):
    matrix, entries, b, _ = system
    matrix = SparseMatrix(matrix.pattern)
    calls = count_factorizations(monkeypatch)

    @jax.jit
    def march(entries, b):
        return jax.lax.scan(lambda x, _: (matrix.solve(entries, x), None), b, None, length=5)[0]

    jax.block_until_ready(march(entries, b))
    jax.block_until_ready(jax.grad(lambda b: march(entries, b).sum())(b))
    assert len(calls) == 1
    jax.block_until_ready(march(2 * entries, b))
    assert len(calls) == 2


def count_factorizations(monkeypatch):
    calls = []
    plain = scipy.sparse.linalg.splu

    def counted(*args, **kwargs):
        calls.append(args)
        return plain(*args, **kwargs)

    monkeypatch.setattr(sparse, "splu", counted)
    return calls


def test_matrices_that_alternate_are_factorized_once_each(system, monkeypatch):
    matrix, entries, b, dense = system
    matrix = SparseMatrix(matrix.pattern)
    calls = count_factorizations(monkeypatch)
    scale = jnp.asarray([1.0, 2.0, 3.0])[:, None]
    solve = jax.jit(jax.vmap(matrix.solve, (0, None)))
    for _ in range(3):
        close(solve(scale * entries, b), jax.vmap(dense, (0, None))(scale * entries, b))
    assert len(calls) == 3


@pytest.mark.parametrize(("most", "budget"), [(2, 1 << 23), (64, 2 * N)])
def test_the_oldest_factorizations_are_dropped(system, monkeypatch, most, budget):
    matrix, entries, b, dense = system
    matrix = SparseMatrix(matrix.pattern)
    monkeypatch.setattr(sparse, "MOST", most)
    monkeypatch.setattr(sparse, "BUDGET", budget)
    calls = count_factorizations(monkeypatch)
    for scale in (1.0, 2.0, 3.0, 3.0, 1.0):
        close(matrix.solve(scale * entries, b), dense(scale * entries, b))
    assert len(calls) == 4


def test_matrices_that_differ_in_one_entry_are_different(system):
    matrix, entries, b, dense = system
    for i in (0, len(entries) - 1):
        changed = entries.at[i].multiply(1 + 1e-6)
        close(matrix.solve(changed, b), dense(changed, b))
        close(matrix.solve(entries, b), dense(entries, b))


def test_the_transposed_system_has_the_same_factors(system, monkeypatch):
    matrix, entries, b, _ = system
    matrix = SparseMatrix(matrix.pattern)
    calls = count_factorizations(monkeypatch)
    x = matrix.solve(entries, b, transposed=True)
    close(matrix.times(entries, x, transposed=True), b)
    gradients = jax.grad(lambda b: matrix.solve(entries, b, transposed=True) @ b)(b)
    close(gradients, x + matrix.solve(entries, b))
    assert len(calls) == 1


@pytest.mark.parametrize("factor", [0.0, jnp.nan, jnp.inf])
def test_what_cannot_be_solved_is_nan(system, factor):
    matrix, entries, b, _ = system
    assert jnp.isnan(matrix.solve(factor * entries, b)).all()


def test_single_precision_stays_single(system):
    matrix, entries, b, dense = system
    found = matrix.solve(entries.astype(jnp.float32), b.astype(jnp.float32))
    assert found.dtype == jnp.float32
    np.testing.assert_allclose(found, dense(entries, b), rtol=1e-4, atol=1e-4)


def test_one_thread_makes_and_drops_all_factorizations(system, monkeypatch):
    """SciPy does not free those that another thread drops than the one that has made them."""
    made, dropped = [], []

    class Noted:
        def __init__(self, *args, **options):
            made.append(threading.get_ident())
            self.nnz = scipy.sparse.linalg.splu(*args, **options).nnz
            weakref.finalize(self, lambda: dropped.append(threading.get_ident()))

    monkeypatch.setattr(sparse, "splu", Noted)
    monkeypatch.setattr(sparse, "MOST", 1)
    entries = np.asarray(system[1])
    kept = SparseMatrix(system[0].pattern)._factorizations
    for scale in (1.0, 2.0, 3.0):
        with ThreadPoolExecutor(1) as other:
            assert other.submit(lambda scale=scale: kept.of(scale * entries).nnz).result() > 0
    assert len(made) == 3
    assert len(dropped) == 2
    assert set(made) == set(dropped)
