"""Steps far outside the solver's region of stability: states stay finite, derivatives do not."""

import functools

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from tests.support.parts import Equations

Eq, der = ac.Eq, ac.der


@functools.cache
def sticking() -> ac.System:
    """Two inertias and a friction clutch that sticks: a mode at -7.5e4 1/s."""
    inertias = lambda s: [  # noqa: E731
        Eq(der(s.v), s.push - s.f), Eq(2 * der(s.w), s.f), Eq(s.f, s.limit * ac.tanh((s.v - s.w) / 1e-3)),
    ]  # fmt: skip
    return ac.compile(Equations("v w f", inertias, inputs="push", limit=50.0))


def end(limit, *, dt, solver="heun"):
    params = {"limit": limit}
    inputs = {"push": 1.0}
    return ac.simulate(sticking(), (0, 1), dt=dt, inputs=inputs, params=params, solver=solver).x[-1, 0]


@pytest.mark.parametrize("solver", ["heun", "rk4", "euler"])
def test_it_is_nan_not_finite_garbage(solver):
    print(jax.value_and_grad(lambda p: end(p, dt=1e-3, solver=solver))(50.0))
    print(jax.value_and_grad(lambda p: end(p, dt=1e-5, solver=solver))(50.0))
    assert 0
