"""Lanes: every rule computes what `jax.vmap` computes, with the instances last."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax

from acausal._jax.lanes import lanes

WIDTH = 5
M = jnp.asarray(np.random.default_rng(0).standard_normal((4, 3)))


def newton(x):
    return lax.while_loop(lambda s: jnp.abs(s * s - x) > 1e-9, lambda s: (s + x / s) / 2, x)


def loop(x, m):
    def step(carry, row):
        total, count = carry
        return (total + row * m, count + 1), (total, row)

    (total, count), (totals, _) = lax.scan(step, (x, 0), jnp.arange(6.0).reshape(3, 2)[:, 0])
    return total, totals, jnp.asarray(count, float)


# name: function of a number s, a vector v of 3, a matrix m of 4 x 3 and a shared matrix.
FUNCTIONS = {
    "numbers": lambda s, v, m, w: (s * 2.0 + jnp.sin(s) / 3, -s, s**3, jnp.where(s > 0, s, 1.0)),
    "number and vector": lambda s, v, m, w: (s * v, v / s, jnp.clip(v, -s, jnp.abs(s))),
    "shared": lambda s, v, m, w: (w + m, w * s, w[:, 0] - 1, v + w[1]),
    "shared alone": lambda s, v, m, w: (jnp.tanh(w).sum(),),
    "shapes": lambda s, v, m, w: (
        m.T,
        m.reshape(2, 6),
        m.ravel()[::2],
        v[None],
        m[1:3, ::2],
        m[::-1],
    ),
    "pieces": lambda s, v, m, w: (
        jnp.concatenate([m, w]),
        jnp.stack([s, v[0]]),
        jnp.stack([v, w[0]], axis=1),
        jnp.pad(m, 1),
        jnp.pad(v, 1, constant_values=s),
        *jnp.split(v, 3),
        *(jnp.unstack(m)),
    ),
    "sums": lambda s, v, m, w: (m.sum(0), m.sum(), m.max(1), m.min(), (m > 0).any(1), v.prod()),
    "products": lambda s, v, m, w: (w @ v, m @ v, w.T @ m, v @ v, jnp.outer(v, w[0]), v @ m.T),
    "long products": lambda s, v, m, w: (jnp.tile(w, (40, 20)) @ jnp.tile(v, 20),),
    "product of stacks": lambda s, v, m, w: (jnp.einsum("ij,ij->i", m, w),),
    "integers": lambda s, v, m, w: (jnp.floor(v).astype(int) % 3, (v > s) & (v < 2)),
    "rule for derivatives": lambda s, v, m, w: (jax.nn.relu(v), jax.jit(jax.nn.softplus)(m)),
    "loop": lambda s, v, m, w: loop(v, w[0]),
    "without a rule": lambda s, v, m, w: (newton(jnp.abs(s) + 1), jnp.sort(v), jnp.cumsum(m, 0)),
    "gradient": lambda s, v, m, w: jax.grad(
        lambda s, v, m, w: jnp.sum(jax.nn.relu(w @ (s * v)) * (m @ v)), argnums=(0, 1, 2, 3)
    )(s, v, m, w),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_lanes_compute_what_vmap_computes(name):
    function = FUNCTIONS[name]
    rng = np.random.default_rng(1)
    s, v, m = (rng.standard_normal((*shape, WIDTH)) for shape in ((), (3,), (4, 3)))

    @jax.jit
    def both(s, v, m):
        vmapped = jax.vmap(function, (-1, -1, -1, None), -1)(s, v, m, M)
        return lanes(function, (True, True, True, False), WIDTH)(s, v, m, M), vmapped

    results, expected = both(s, v, m)
    assert [r.shape for r in results] == [e.shape for e in expected]
    assert [r.dtype for r in results] == [e.dtype for e in expected]
    for result, value in zip(results, expected, strict=True):
        np.testing.assert_allclose(result, value, rtol=1e-12, atol=1e-12)
