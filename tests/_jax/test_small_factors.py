"""Factors of covariances against NumPy's."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from acausal._jax import cholesky, solve_lower, solve_upper


@pytest.mark.parametrize("n", [1, 5, 14])
def test_factors_and_solutions_are_those_of_numpy(n):
    rng = np.random.default_rng(n)
    half, b = rng.standard_normal((n, n + 2)), rng.standard_normal((n, 3))
    a = half @ half.T
    root = jax.jit(cholesky)(a)
    np.testing.assert_allclose(root, np.linalg.cholesky(a), atol=1e-12)
    np.testing.assert_allclose(jax.jit(solve_lower)(root, b), np.linalg.solve(root, b), atol=1e-11)
    np.testing.assert_allclose(
        jax.jit(solve_upper)(root, b), np.linalg.solve(root.T, b), atol=1e-11
    )


def test_what_is_not_positive_has_no_finite_factor():
    assert not np.isfinite(jax.jit(cholesky)(jnp.asarray([[1.0, 2.0], [2.0, 1.0]]))).all()
