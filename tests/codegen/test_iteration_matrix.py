"""``I - c J`` is solved as by a dense matrix, in programs with loops, branches, batches and gradients."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from acausal.codegen import DenseIterationMatrix, SparseIterationMatrix

N, C = 40, 0.3


def scattered():
    generator = np.random.default_rng(0)
    dense = np.where(generator.random((N, N)) < 0.08, generator.normal(size=(N, N)), 0)
    dense[np.arange(N), np.arange(N)] = generator.normal(size=N)
    return dense


def full():
    return np.random.default_rng(1).normal(size=(N, N))


@pytest.fixture(
    scope="module",
    params=[
        (lambda n, *positions: DenseIterationMatrix(n, positions), scattered),
        (lambda n, *_: DenseIterationMatrix(n, None), full),
        (lambda n, *positions: SparseIterationMatrix.of(n, n, *positions), scattered),
        (lambda n, *positions: SparseIterationMatrix.of(n, n, *positions), full),
    ],
    ids=["dense, scattered", "dense, full", "sparse, scattered", "sparse, full"],
)
def case(request):
    """How to solve, the entries, a right side, and the dense matrix as a function of entries and c."""
    make, matrix = request.param
    dense = matrix()
    rows, columns = np.nonzero(dense)

    def iteration(entries, c):
        return jnp.eye(N) - c * jnp.zeros((N, N)).at[rows, columns].set(entries)

    b = np.random.default_rng(2).normal(size=N)
    return make(N, rows, columns), jnp.asarray(dense[rows, columns]), jnp.asarray(b), iteration


def close(found, expected):
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_both_systems_are_solved(case):
    matrix, entries, b, dense = case

    @jax.jit
    def run(entries, c, b):
        kept = matrix.factorize(entries, c)
        return matrix.solve(kept, b), matrix.solve(kept, b, transposed=True)

    x, y = run(entries, C, b)
    close(dense(entries, C) @ x, b)
    close(dense(entries, C).T @ y, b)


def test_what_is_kept_is_carried_by_a_loop_that_replaces_it_in_a_branch(case):
    matrix, entries, b, dense = case

    def run(factorize, solve):
        def step(carry):
            i, kept, x = carry
            c = C * (1 + i)
            kept = jax.lax.cond(i % 3 == 0, lambda: factorize(entries, c), lambda: kept)
            return i + 1, kept, solve(kept, x) + b

        start = 0, factorize(entries, 0.1), b
        return jax.lax.while_loop(lambda carry: carry[0] < 10, step, start)[2]

    found = jax.jit(lambda: run(matrix.factorize, matrix.solve))()
    close(found, run(dense, jnp.linalg.solve))


def test_batches(case):
    matrix, entries, b, dense = case
    scale = jnp.asarray([1.0, 0.5, 2.0])

    def run(factorize, solve):
        def each(scale):
            kept = factorize(scale * entries, C)
            return solve(kept, b) + solve(kept, scale * b)

        return jax.jit(jax.vmap(each))(scale)

    close(run(matrix.factorize, matrix.solve), run(dense, jnp.linalg.solve))


@pytest.mark.cases(fast=3)
@pytest.mark.parametrize("transform", [jax.grad, jax.jacfwd])
def test_derivatives_by_entries_shift_and_right_side(case, transform):
    matrix, entries, b, dense = case

    def run(factorize, solve):
        def loss(entries, c, b):
            kept = factorize(entries, c)
            turned = solve(kept, b, transposed=True)
            return jnp.sum(solve(kept, b) ** 3) + jnp.sum(turned**3)

        return jax.jit(transform(loss, argnums=(0, 1, 2)))(entries, C, b)

    def expected_solve(a, b, transposed=False):
        return jnp.linalg.solve(a.T if transposed else a, b)

    found = run(matrix.factorize, matrix.solve)
    expected = run(dense, expected_solve)
    for one, other in zip(found, expected, strict=True):
        close(one, other)


def test_a_singular_matrix_has_no_finite_solution(case):
    matrix, entries, b, _ = case
    kept = matrix.factorize(jnp.full_like(entries, jnp.nan), C)
    assert not jnp.isfinite(matrix.solve(kept, b)).any()
    diagonal = SparseIterationMatrix.of(2, 2, np.arange(2), np.arange(2))
    kept = diagonal.factorize(jnp.asarray([1.0, 2.0]), 1.0)
    assert not jnp.isfinite(diagonal.solve(kept, jnp.ones(2))).all()


def test_single_precision_stays_single(case):
    matrix, entries, b, dense = case
    kept = matrix.factorize(entries.astype(jnp.float32), jnp.float32(C))
    found = matrix.solve(kept, b.astype(jnp.float32))
    assert found.dtype == jnp.float32
    np.testing.assert_allclose(dense(entries, C) @ found, b, rtol=1e-3, atol=1e-3)
