import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal._jax import two_modes


@jax.custom_vjp
def cube(x):
    """It has derivatives in reverse mode only, marked by a factor."""
    return x**3


cube.defvjp(lambda x: (x**3, x), lambda x, c: (3 * x**2 * c * 10,))
call = two_modes(
    lambda args: {"y": cube(args[0]) * args[1], "n": args[2]},
    lambda args: {"y": args[0] ** 3 * args[1], "n": args[2]},
)


def value(x, a=2.0, n=3):
    return call((x, jnp.asarray(a), jnp.asarray(n)))["y"]


def test_each_mode_has_its_own_implementation():
    assert float(value(jnp.asarray(2.0))) == 16
    assert float(jax.grad(value)(2.0)) == 240
    assert float(jax.jacfwd(value)(2.0)) == 24
    assert float(jax.jit(jax.jacfwd(value, 1))(2.0, 2.0)) == 8
    assert float(jax.grad(value, 1)(2.0, 2.0)) == 8
    assert int(call((jnp.ones(()), jnp.ones(()), jnp.asarray(3)))["n"]) == 3


def test_it_is_mapped_in_both_modes():
    x = jnp.asarray([1.0, 2.0])
    for derivative, factor in ((jax.grad, 10), (jax.jacfwd, 1)):
        np.testing.assert_allclose(jax.vmap(derivative(value))(x), 6 * factor * x**2)
        np.testing.assert_allclose(
            derivative(lambda a: jax.vmap(lambda x: value(x, a))(x).sum())(2.0), 9
        )


def test_second_derivatives_are_refused():
    with pytest.raises(ac.DataError, match="second derivatives"):
        jax.jacfwd(jax.grad(value))(2.0)
