"""Explicit steps in reverse: stage by stage they give the derivatives of the steps written out."""

from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.simulation.steps import runge_kutta
from tests.support.parts import Equations

TS = np.linspace(0, 2, 5)


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@pytest.mark.parametrize("saved", [[2.0], np.linspace(0, 2, 41)], ids=["last", "many"])
@pytest.mark.parametrize(
    "solver", [pytest.param("tsit5", marks=pytest.mark.slow), diffrax.Heun()], ids=["tsit5", "heun"]
)
def test_stage_by_stage_is_as_written_out(solver: Any, saved: Any, monkeypatch: pytest.MonkeyPatch):
    """With a last stage that is the next step's first one, and without; with steps in which nothing is saved."""
    model = Equations(
        "x v",
        lambda s: [ac.Eq(ac.der(s.x), s.v), ac.Eq(ac.der(s.v), s.u - s.k * ac.sin(s.x))],
        inputs="u",
        k=4.0,
    )
    system = ac.compile(model)

    def loss(k: jax.Array, x0: jax.Array, u: jax.Array) -> jax.Array:
        x = ac.simulate(
            system,
            (0, 2),
            params={"k": k},
            x0=x0,
            inputs={"u": ac.Signal(TS, u)},
            solver=solver,
            saveat=saved,
            rtol=1e-4,
            atol=1e-6,
        ).x
        return jnp.sum(jnp.sin(x))

    point = jnp.asarray(4.0), jnp.asarray([1.0, 0.0]), jnp.sin(jnp.asarray(TS))
    written_out = jax.grad(loss, (0, 1, 2))(*point)
    monkeypatch.setattr(runge_kutta, "MANY", 0)
    jax.clear_caches()
    stage_by_stage = jax.grad(loss, (0, 1, 2))(*point)
    jax.clear_caches()
    for found, expected in zip(stage_by_stage, written_out, strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-14)
