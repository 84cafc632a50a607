"""A deferred function is traced once, when a program that calls it is compiled."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from acausal._jax import two_modes
from acausal._jax.deferred import deferred


class Counted:
    """A function that counts how often JAX traces it."""

    def __init__(self) -> None:
        self.n = 0

    def __call__(self, x, y):
        self.n += 1
        return [x * y, jnp.sum(y)]


LIKE = [jax.ShapeDtypeStruct((3,), float), jax.ShapeDtypeStruct((), float)]


def test_it_is_traced_when_it_is_compiled():
    function = Counted()
    lazy = deferred(function, LIKE)
    traced = jax.jit(lambda x, y: lazy(x, y)[0] + 1).trace(jnp.ones(3), jnp.arange(3.0))
    assert function.n == 0
    assert traced.lower().compile()(jnp.ones(3), jnp.arange(3.0)).tolist() == [1, 2, 3]
    assert function.n == 1


@pytest.mark.parametrize("axes", [(0, None), (None, 1), (0, 1)])
def test_it_is_mapped(axes):
    rng = np.random.default_rng(0)
    x, y = (rng.normal(size=3) if a is None else rng.normal(size=(3, 3)) for a in axes)
    found = jax.vmap(deferred(Counted(), LIKE), axes)(x, y)
    for a, b in zip(found, jax.vmap(Counted(), axes)(x, y), strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-15)


def test_a_gradient_traces_no_forward_mode_and_a_map_of_it_no_more():
    forward, reverse = [], []

    def squared(kept):
        def function(x):
            kept.append(1)
            return jnp.sum(x**2)

        return function

    call = two_modes(squared(reverse), squared(forward))
    assert jax.jit(jax.grad(call))(jnp.arange(3.0)).tolist() == [0, 2, 4]
    alone = len(reverse)
    reverse.clear()
    gradients = jax.jit(jax.vmap(jax.grad(call)))(jnp.arange(6.0).reshape(2, 3))
    assert gradients.tolist() == [[0, 2, 4], [6, 8, 10]]
    assert len(reverse) == alone
    assert not forward
    assert jax.jit(jax.jacfwd(call))(jnp.arange(3.0)).tolist() == [0, 2, 4]
    assert forward
