"""Elimination in array operations, compared with LAPACK."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from acausal._jax.batching import batched, is_small
from acausal.codegen.elimination import eliminate


def equations(n, *batch):
    """The same for the same sizes, whichever tests have run before."""
    rng = np.random.default_rng((n, *batch))
    return jnp.asarray(rng.normal(size=(*batch, n, n))), jnp.asarray(rng.normal(size=(*batch, n)))


@pytest.mark.slow
@pytest.mark.parametrize("n", [1, 2, 5, 12])
def test_the_solution_is_that_of_lapack(n):
    a, b = equations(n)
    np.testing.assert_allclose(jax.jit(eliminate)(a, b), np.linalg.solve(a, b), rtol=1e-11)


def test_rows_are_exchanged():
    a = jnp.asarray([[0.0, 1.0, 0.0], [0.0, 1e-20, 1.0], [1.0, 0.0, 1e20]])
    b = jnp.asarray([2.0, 3.0, 0.0])
    found = jax.jit(eliminate)
    np.testing.assert_allclose(found(a, b), [-3e20, 2.0, 3.0], rtol=1e-12)
    assert found(np.eye(4)[::-1], np.arange(4.0)).tolist() == [3, 2, 1, 0]


def test_the_residual_is_as_small_as_lapacks():
    a, b = equations(12, 200)
    found = jax.jit(jax.vmap(eliminate))(a, b)
    theirs = np.linalg.solve(a, b[..., None])[..., 0]

    def residual(x):
        size = np.abs(a).sum(-1) * np.abs(x).max(-1)[:, None]
        return np.max(np.abs(np.einsum("kij,kj->ki", a, x) - b) / size)

    assert residual(found) < 10 * residual(theirs)


@pytest.mark.parametrize("a", [np.zeros((3, 3)), np.ones((3, 3)), np.diag([1.0, 0.0, 2.0])])
def test_a_singular_matrix_has_no_finite_solution(a):
    assert not np.isfinite(jax.jit(eliminate)(a, np.ones(3))).all()


@pytest.mark.parametrize("rank", [1, 3, 4])
def test_equations_that_repeat_each_other_have_their_least_solution(rank):
    a, b = equations(4)
    a = a.at[:, rank:].set(a[:, :1] * 2) * jnp.asarray([[1e6], [1.0], [1e-3], [1.0]])
    least = jax.jit(lambda a, b: eliminate(a, b, True))
    np.testing.assert_allclose(least(a, a @ b), np.linalg.pinv(a) @ (a @ b), rtol=1e-9, atol=1e-12)
    pull = jax.jit(jax.grad(lambda b: jnp.sum(least(a, a @ b))))
    np.testing.assert_allclose(pull(b), (np.linalg.pinv(a) @ a).sum(0), atol=1e-9)


def test_pivots_are_found_in_all_columns():
    a = jnp.asarray([[0.0, 1.0, 0.0], [0.0, 0.0, 2.0], [0.0, 1.0, 0.0]])
    np.testing.assert_allclose(eliminate(a, jnp.asarray([3.0, 4.0, 3.0]), True), [0.0, 3.0, 2.0])


def test_nan_is_passed_on():
    a, b = equations(4)
    solve, wrong, of_wrong = jax.jit(eliminate), np.array(a), np.array(b)
    wrong[2, 1] = of_wrong[3] = np.nan
    assert np.isnan(solve(wrong, b)).any()
    assert np.isnan(solve(a, of_wrong)).any()


@pytest.mark.slow
def test_derivatives_in_both_modes_and_of_second_order():
    a, b = equations(4)
    for derivative in (jax.jacrev, jax.jacfwd):
        for argument in (0, 1):
            ours = jax.jit(derivative(eliminate, argument))(a, b)
            theirs = jax.jacfwd(jnp.linalg.solve, argument)(a, b)
            np.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-11)
    both = [
        jax.jit(jax.hessian(lambda s, solve=solve: jnp.sum(solve(a + s * jnp.eye(4), s * b) ** 2)))
        for solve in (eliminate, jnp.linalg.solve)
    ]
    np.testing.assert_allclose(both[0](0.3), both[1](0.3), rtol=1e-9)


@pytest.mark.slow
def test_a_loop_around_it_is_compiled_as_a_whole_and_side_by_side():
    a, b = equations(5, 11)

    def run(a, b):
        return [jax.lax.scan(lambda x, _: (eliminate(a, x), None), b, None, length=3)[0]]

    assert is_small(jax.make_jaxpr(run)(a[0], b[0]).jaxpr)
    found = jax.jit(jax.vmap(batched(run)))(a, b)[0]
    expected = np.linalg.solve(np.linalg.matrix_power(a, 3), b[..., None])[..., 0]
    np.testing.assert_allclose(found, expected, rtol=1e-8)
