"""Solvers of algebraic blocks."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from acausal.codegen.dense_loop import FEW, solve_block
from tests.support.slow import some_slow


def plain(residual):
    """A block whose unknowns are its tearing variables."""
    return lambda z: (z, residual(z))


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("n", some_slow([1, 2, 3, FEW, FEW + 1], [FEW]))
def test_linear(n):
    rng = np.random.default_rng(n)
    a, b = rng.normal(size=(n, n)), rng.normal(size=n)
    solve = lambda a, b: solve_block(plain(lambda z: a @ z - b), jnp.ones(n), is_linear=True)  # noqa: E731
    np.testing.assert_allclose(jax.jit(solve)(a, b), np.linalg.solve(a, b), rtol=1e-10)
    ours, theirs = (jax.jit(jax.jacobian(f))(jnp.asarray(a), b) for f in (solve, jnp.linalg.solve))
    np.testing.assert_allclose(ours, theirs, rtol=1e-8, atol=1e-10)


@pytest.mark.cases(fast=1, slow=7)
@pytest.mark.parametrize(
    ("residual", "guess", "root"),
    [
        (lambda z: z**2 - 2, 1e-3, 2**0.5),
        (lambda z: jnp.arctan(z - 1), 30.0, 1.0),
        (lambda z: jnp.exp(4 * z) - 5, -3.0, np.log(5) / 4),
        (lambda z: jnp.log(z) + 1, 20.0, np.exp(-1)),
        (lambda z: z**3, 1.0, 0.0),
        (lambda z: 1e-8 * (z - 3), 0.0, 3.0),
        (lambda z: 1e8 * jnp.sinh(z - 3), 0.0, 3.0),
        (lambda z: jnp.where(z > 0, 10 * z, z) + 5, 8.0, -5.0),
    ],
)
def test_nonlinear(residual, guess, root):
    found = jax.jit(lambda z: solve_block(plain(residual), z))(jnp.array([guess]))
    np.testing.assert_allclose(found, [root], rtol=1e-8, atol=1e-7)


@pytest.mark.slow
def test_several_unknowns():
    def residual(z):
        return jnp.array([z[0] ** 2 + z[1] ** 2 - 4, z[0] * z[1] - 1])

    found = jax.jit(lambda z: solve_block(plain(residual), z))(jnp.array([2.0, 0.3]))
    np.testing.assert_allclose(residual(found), 0.0, atol=1e-12)


@pytest.mark.parametrize(
    "residual", [lambda z: z**2 + 1, lambda z: z * jnp.nan, lambda z: jnp.ones_like(z)]
)
def test_without_a_root_the_result_is_nan(residual):
    found = jax.jit(lambda z: solve_block(plain(residual), z))(jnp.array([0.7]))
    assert np.isnan(found).all()


@pytest.mark.slow
def test_equations_that_contradict_each_other_have_no_solution():
    def solve(b):
        twice = plain(lambda z: jnp.ones((2, 2)) @ z - b)
        return solve_block(twice, jnp.zeros(2), is_linear=True, may_repeat_itself=True)

    np.testing.assert_allclose(solve(jnp.array([3.0, 3.0])), [1.5, 1.5], rtol=1e-12)
    assert np.isnan(solve(jnp.array([3.0, 3.001]))).all()


@pytest.mark.slow
def test_gradients_of_first_and_second_order():
    def root(p):  # z + exp(z) = p
        return solve_block(plain(lambda z: z + jnp.exp(z) - p), jnp.zeros(1))[0]

    z = float(jax.jit(root)(2.0))
    first = 1 / (1 + np.exp(z))
    assert float(jax.jit(jax.grad(root))(2.0)) == pytest.approx(first)
    assert float(jax.jit(lambda p: jax.jvp(root, (p,), (1.0,)))(2.0)[1]) == pytest.approx(first)
    assert float(jax.jit(jax.hessian(root))(2.0)) == pytest.approx(-np.exp(z) * first**3)


@pytest.mark.slow
def test_a_batch_converges_each_by_itself():
    p = jnp.array([0.1, 4.0, 1e6])
    one = lambda q: solve_block(plain(lambda z: z**2 - q), jnp.array([0.5]))  # noqa: E731
    roots = jax.jit(jax.vmap(one))(p)
    np.testing.assert_allclose(roots[:, 0], np.sqrt(p), rtol=1e-9)
