"""Roots that Newton's method alone does not find."""

import itertools

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import brentq

from acausal.codegen import newton
from acausal.codegen.dense_loop import solve_block


def root(residual, guess, scale=1.0):
    block = lambda z: (z, residual(z))  # noqa: E731
    return jax.jit(lambda z: newton.root(newton.Dense(block, jnp.linalg.solve), z, scale))(guess)


def freudenstein_and_roth(z):
    """A local minimum of the residual's size lies on Newton's way: J. Moré et al., TOMS 7 (1981), problem 2."""
    x, y = z
    return jnp.array([x - 13 + ((5 - y) * y - 2) * y, x - 29 + ((1 + y) * y - 14) * y])


def cycle(z):
    """Newton's method goes to and fro between 0 and 1; the path leads to the root backwards."""
    return z**3 - 2 * z + 2


def folded(z):
    """One unknown, whose path from the guess turns back twice before it reaches the root."""
    return z**3 - 3 * z + 2.5


@pytest.mark.parametrize(
    ("residual", "guess", "found"),
    [
        (freudenstein_and_roth, [15.0, -2.0], [5.0, 4.0]),
        (folded, [1.5], [-2.0536]),
        (cycle, [0.0], [-1.7693]),
    ],
)
def test_a_root_behind_a_minimum(residual, guess, found):
    guess = jnp.array(guess)
    z, arrived = root(residual, guess)
    assert bool(arrived)
    np.testing.assert_allclose(z, found, rtol=1e-4)
    np.testing.assert_allclose(residual(z), 0, atol=1e-9)


def test_no_root_is_told():
    _, arrived = root(lambda z: z**2 + 1, jnp.array([0.7]))
    assert not bool(arrived)


@pytest.mark.slow
def test_a_small_unknown_beside_a_large_number():
    """Between two rounded values of their sum a slope of 1e-5 is left: 300 steps along it led nowhere."""
    evaluated = itertools.count()

    def residual(z):
        next(evaluated)
        return 1e-5 * z + 100 * (60.0 + 3e-13 + z - 60.0)

    with jax.disable_jit():
        z, arrived = root(residual, jnp.array([1e-3]))
    assert bool(arrived)
    assert next(evaluated) < 30
    np.testing.assert_allclose(z, -3e-13, atol=2e-14)


def test_units_do_not_matter():
    def scaled(z):
        return jnp.array([1e9, 1e-7]) * freudenstein_and_roth(z * jnp.array([1e6, 1e-3]))

    guess = jnp.array([15e-6, -2e3])
    z, arrived = root(scaled, guess, scale=jnp.array([1e-6, 1e3]))
    assert bool(arrived)
    np.testing.assert_allclose(z, [5e-6, 4e3], rtol=1e-6)


def test_side_by_side():
    guesses = jnp.array([[15.0, -2.0], [5.1, 4.1]])
    z, arrived = jax.vmap(lambda g: root(freudenstein_and_roth, g))(guesses)
    assert bool(arrived.all())
    np.testing.assert_allclose(z, [[5, 4], [5, 4]], rtol=1e-6)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("guess", [0.0, 1e-3])
def test_a_small_difference_that_is_amplified(guess):
    """The step is as small as a rounding beside the current, and volts in what is computed from it."""

    def diode(v):
        return 1e-6 * (jnp.exp(jnp.minimum(v / 0.04, 15)) * (1 + jnp.maximum(v / 0.04 - 15, 0)) - 1)

    def block(z, gain):
        difference = 1 - 1e3 * z[0]
        v = (1 + gain) * difference
        return jnp.stack([z[0], v]), jnp.stack([1e5 * (z[0] - diode(v)) - v])

    def own(gain):
        return brentq(lambda v: float(block([(1 - v / (1 + gain)) / 1e3], gain)[1][0]), 0, 1)

    gains = jnp.array([1e2, 5e4, 1e5, 1e7, 1e9])
    found = jax.vmap(lambda a: solve_block(lambda z: block(z, a), jnp.array([guess])))(gains)
    roundings = 1e-10 + 1e-15 * gains
    for gain, v, rounding in zip(gains, found[:, 1], roundings, strict=True):
        assert float(v) == pytest.approx(own(gain), rel=float(rounding)), gain


def test_an_amplified_jump_is_no_root():
    def block(z):
        v = 1e9 * (1 - 1e3 * z)
        return v, v + 5 * jnp.sign(v)

    assert np.isnan(solve_block(block, jnp.array([0.0]))).all()


def test_a_guess_that_is_no_number_ends_the_search():
    """The steps of this linear equation are finite all the same, and halving them would lead nowhere."""
    solve = lambda jacobian, r: jnp.ones(jacobian.shape[1])  # noqa: E731
    dense = newton.Dense(lambda z: (z, z - 1.0), solve)
    for guess in (jnp.nan, jnp.inf):
        _, reached = jax.jit(lambda z: newton.root(dense, z))(jnp.array([guess]))
        assert not reached
