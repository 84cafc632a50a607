"""The numbers of multistep formulas on uneven times, against polynomials and published constants."""

import jax.numpy as jnp
import numpy as np
import pytest

from acausal.simulation.steps.multistep import (
    HARMONIC,
    POINTS,
    differences,
    error_constant,
    slopes,
    weights,
)

S = jnp.asarray([1.0, 1.7, 2.1, 3.4, 4.9, 5.2])
EVEN = jnp.arange(1.0, POINTS + 1)


@pytest.mark.parametrize("order", range(1, 6))
def test_a_polynomial_of_the_order_is_met(order: int) -> None:
    polynomial = np.polynomial.Polynomial(np.random.default_rng(order).normal(size=order + 1))
    values, count = jnp.asarray(polynomial(np.asarray(S))), jnp.asarray(order + 1)
    at = jnp.asarray(0.3)
    assert float(weights(S, count, at) @ values) == pytest.approx(polynomial(0.3), rel=1e-10)
    # s counts backwards, so that the derivative by time has the other sign
    derivative = -polynomial.deriv()(0.0)
    assert float(slopes(S, count) @ values) == pytest.approx(derivative, rel=1e-9, abs=1e-9)
    highest = abs(float(polynomial.deriv(order)(0.0)))
    found = abs(float(differences(S, jnp.asarray(order)) @ values))
    assert found == pytest.approx(highest, rel=1e-9)


@pytest.mark.parametrize("order", range(1, 6))
def test_even_steps_give_the_classical_formulas(order: int) -> None:
    """BDF of order q has the coefficient 1/(1 + 1/2 + ... + 1/q), weights of sum one, and the error 1/(q + 1)."""
    count = jnp.asarray(order + 1)
    own = weights(EVEN, count, jnp.zeros(())) - slopes(EVEN, count) / HARMONIC[order]
    assert float(own.sum()) == pytest.approx(1.0)
    known = {1: [1], 2: [4 / 3, -1 / 3], 3: [18 / 11, -9 / 11, 2 / 11]}.get(order)
    if known:
        np.testing.assert_allclose(own[:order], known, rtol=1e-12)
        np.testing.assert_allclose(own[order:], 0, atol=1e-12)
    assert float(error_constant(EVEN, jnp.asarray(order))) == pytest.approx(1 / (order + 1))
