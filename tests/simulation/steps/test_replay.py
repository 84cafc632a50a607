"""Derivatives of adaptive runs: exact for the steps that were made, in both modes, whatever the method."""

import functools
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.simulation.steps import replay
from tests.support.parts import Equations
from tests.support.slow import some_slow
from tests.support.stiff import Plate

TS = np.linspace(0, 2, 9)


@functools.cache
def driven() -> ac.System:
    """A pendulum with a fast actuator, pushed by an input."""
    return ac.compile(
        Equations(
            "x v f",
            lambda s: [
                ac.Eq(ac.der(s.x), s.v),
                ac.Eq(ac.der(s.v), s.f - s.k * ac.sin(s.x) - 0.1 * s.v),
                ac.Eq(ac.der(s.f), s.fast * (s.u - s.f)),
            ],
            inputs="u",
            k=4.0,
            fast=300.0,
        )
    )


SAMPLES = np.random.default_rng(0).normal(size=9)


def saved(solver: str, k: Any, x0: Any, u: Any, **options: Any) -> Any:
    return ac.simulate(
        driven(),
        (0, 2),
        params={"k": k},
        x0={"x": x0, "v": 0.0, "f": 0.0},
        inputs={"u": ac.Signal(TS, u)},
        solver=solver,
        saveat=TS,
        rtol=1e-9,
        atol=1e-11,
        max_steps=5000,
        **options,
    ).x


def loss(solver: str, k: Any, x0: Any, u: Any) -> Any:
    x = saved(solver, k, x0, u)
    return jnp.sum(x[:, 0] ** 2) + x[-1, 2]


POINT = 4.0, 1.0, jnp.asarray(SAMPLES)


@pytest.mark.parametrize("solver", some_slow(["tsit5", "bdf", "auto"], ["auto"], ["tsit5", "bdf"]))
def test_reverse_forward_and_differences_agree(solver: str):
    of = functools.partial(loss, solver)
    reverse = jax.grad(of, (0, 1, 2))(*POINT)
    forward = jax.jacfwd(of, (0, 1))(*POINT)
    np.testing.assert_allclose(forward, reverse[:2], rtol=1e-7)
    jitted = jax.jit(of)
    # at each point BDF chooses its steps anew, within a tolerance that the difference divides by its step
    h, near = (1e-3, 2e-3) if solver == "bdf" else (1e-4, 2e-5)
    for i, direction in enumerate(np.eye(3)):
        steps = [direction[0] * h, direction[1] * h, direction[2] * h * np.eye(9)[4]]
        both = [
            jitted(*(a + sign * b for a, b in zip(POINT, steps, strict=True))) for sign in (1, -1)
        ]
        found = (both[0] - both[1]) / (2 * h)
        expected = reverse[i] if i < 2 else reverse[2][4]
        assert float(found) == pytest.approx(float(expected), rel=near, abs=1e-7)


@pytest.mark.machines
@pytest.mark.parametrize("solver", some_slow(["tsit5", "bdf"], ["tsit5"], ["bdf"]))
def test_a_long_run_is_made_again_part_by_part(solver: str, monkeypatch: pytest.MonkeyPatch):
    """The same derivatives, to the last digits, with room for some tens of steps only."""
    jax.clear_caches()
    whole = jax.grad(functools.partial(loss, solver), (0, 1, 2))(*POINT)
    monkeypatch.setattr(replay, "MEMORY", 500)
    monkeypatch.setattr(replay, "FEWEST", 1)
    jax.clear_caches()
    parts = jax.grad(functools.partial(loss, solver), (0, 1, 2))(*POINT)
    jax.clear_caches()
    for a, b in zip(whole, parts, strict=True):
        np.testing.assert_allclose(b, a, rtol=1e-12)


@pytest.mark.slow
def test_derivatives_side_by_side_are_those_in_turn():
    gradient = jax.grad(functools.partial(loss, "bdf"))
    ks = jnp.asarray([2.0, 4.0])
    together = jax.vmap(lambda k: gradient(k, *POINT[1:]))(ks)
    np.testing.assert_allclose(together, [gradient(k, *POINT[1:]) for k in ks], rtol=1e-6)


@pytest.mark.slow
def test_every_sample_of_an_input_counts():
    """Steps end at the corners of the input: no sample lies unseen within a step."""
    by_u = jax.grad(functools.partial(loss, "tsit5"), 2)(*POINT)

    def of(u: Any) -> Any:
        x = ac.simulate(
            driven(),
            (0, 2),
            dt=1e-3,
            x0={"x": 1.0, "v": 0.0, "f": 0.0},
            inputs={"u": ac.Signal(TS, u)},
            solver="rk4",
        ).x
        return jnp.sum(x[::250, 0] ** 2) + x[-1, 2]

    np.testing.assert_allclose(by_u, jax.grad(of)(POINT[2]), rtol=1e-5, atol=1e-8)


@pytest.mark.machines
def test_sparse_factors_serve_the_derivative():
    system = ac.compile(Plate(11))
    start = jnp.asarray(system.initial_state())

    def last(conductance: Any, x0: Any) -> Any:
        sol = ac.simulate(
            system,
            (0, 20),
            params={"conductor[1].G": conductance},
            x0=x0,
            saveat=[20.0],
            rtol=1e-10,
            atol=1e-10,
        )
        return sol.x[-1, 1]

    by_g, by_x = jax.grad(last, (0, 1))(0.1, start)
    h = 1e-3
    found = (last(0.1 + h, start) - last(0.1 - h, start)) / (2 * h)
    assert float(by_g) == pytest.approx(float(found), rel=1e-4)
    # all temperatures raised by one degree raise the last one by as much
    assert float(by_x.sum()) == pytest.approx(1.0, rel=1e-7)


def test_second_derivatives_are_refused_in_reverse_mode():
    of = functools.partial(loss, "tsit5")
    with pytest.raises(ac.DataError, match="no second derivatives"):
        jax.hessian(of)(*POINT)
