"""Regularizers of modes: their formulas, their gradients, and an instability that they prevent."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.training.objective.modal import Modal, eigenvalues, jacobians
from acausal.training.objective.regularizers import Context, Trajectory
from tests.support.oscillator import C, D, M, force, learned, plain, record

OMEGA, DELTA = np.sqrt(C / M), D / (2 * M)
"""Frequency [rad/s] of the undamped oscillator, and how fast the damped one dies out [1/s]."""


def context(system: ac.System) -> Context:
    data = record(end=5.0)
    x = jnp.asarray(data.columns(system.states, "a state"))
    u = jnp.asarray(data.columns(system.inputs, "an input"))
    return Context((), {}, Trajectory(system, jnp.asarray(data.time), x, u))


# -- eigenvalues -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_eigenvalues_have_the_gradient_of_differences():
    rng = np.random.default_rng(0)
    A, weights = jnp.asarray(rng.normal(size=(6, 6))), rng.normal(size=(2, 6))

    def total(A: Any) -> Any:
        re, im = eigenvalues(A)
        order = jnp.lexsort((im, re))
        return weights[0] @ re[order] + weights[1] @ im[order]

    derivatives = jax.grad(total)(A)
    for i, j in ((0, 0), (1, 4), (5, 2)):
        step = jnp.zeros((6, 6)).at[i, j].set(1e-6)
        difference = (total(A + step) - total(A - step)) / 2e-6
        assert float(derivatives[i, j]) == pytest.approx(float(difference), rel=1e-6)


def test_a_free_mass_has_a_gradient():
    """Its two eigenvalues of 0 share one eigenvector: there is no derivative, and none is invented."""
    A = jnp.asarray([[0.0, 1.0], [0.0, 0.0]])
    assert np.isfinite(jax.grad(lambda A: eigenvalues(A)[0].sum())(A)).all()


# -- penalties ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("regularizer", "expected"),
    [
        (ac.Stability(3.0, margin=1.0), 3 * 2 * (1 - DELTA) ** 2),
        (ac.Stability(3.0, margin=0.9 * DELTA), 0.0),
        (ac.DampingRatio(2.0, ratio=0.3), 2 * 2 * (0.3 - DELTA / OMEGA) ** 2),
        (ac.DampingRatio(ratio=0.9 * DELTA / OMEGA), 0.0),
        (ac.FrequencyRange(high=OMEGA / 2), 2 * 1.0),
        (ac.FrequencyRange(low=4 * OMEGA), 2 * 0.75**2),
        (ac.FrequencyRange(low=0.9 * OMEGA, high=1.1 * OMEGA), 0.0),
    ],
)
def test_penalties_of_an_oscillator_are_its_formulas(regularizer: Modal, expected: float):
    found = regularizer(plain().parameters(), context(plain()))
    assert float(found) == pytest.approx(expected, rel=1e-9, abs=1e-12)


@pytest.mark.slow
def test_jacobians_are_those_of_linearizations_farther_out():
    system, seen = learned(), context(learned())
    params, t = system.parameters(0), seen.trajectory
    assert t is not None
    A = jacobians(params, t, 3, 2.0)
    x = t.x.mean(axis=0) + 2 * (t.x[-1] - t.x.mean(axis=0))
    expected = ac.linearize(system, x, t.u[-1], params=params).A
    np.testing.assert_allclose(A[-1], expected, rtol=1e-12)


@pytest.mark.slow
def test_the_gradient_of_a_penalty_is_that_of_differences():
    """Through the network along the record."""
    system, seen = learned(), context(learned())
    arrays, rest = eqx.partition(system.parameters(0), eqx.is_inexact_array)
    wanted = ac.DampingRatio(ratio=0.5, points=5)

    @eqx.filter_jit
    def total(arrays: Any) -> Any:
        return wanted(eqx.combine(arrays, rest), seen)

    gradient = jax.grad(total)(arrays)
    direction = jax.tree.map(lambda a: jax.random.normal(jax.random.key(1), a.shape), arrays)
    rate = sum(
        jax.tree.leaves(jax.tree.map(lambda g, d: jnp.sum(g * d), gradient, direction)),
        jnp.zeros(()),
    )
    ends = [
        total(jax.tree.map(lambda a, d, e=e: a + e * d, arrays, direction)) for e in (1e-6, -1e-6)
    ]
    assert float(rate) == pytest.approx(float(ends[0] - ends[1]) / 2e-6, rel=1e-6)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:After training, 'spring.d' is -0")  # without the margin
def test_a_sensor_that_lags_makes_no_instability():
    """Late accelerations look like a damping that is less by about c τ; the margin holds against that."""
    lag, time, start = 0.02, np.linspace(0, 5, 501), 5.0
    params = plain().parameters()
    true = ac.simulate(
        plain(), (0, 5), dt=0.01, inputs={"push.f": force(time)}, solver="rk4",
        params=params | {"spring.d": 0.5},
    )  # fmt: skip
    late = np.interp(time - lag, time, np.asarray(true["mass.a"]))
    signals = {n: np.asarray(true[n]) for n in ("mass.s", "mass.v")}
    data = ac.Data(time, {**signals, "mass.a": late, "push.f": force(time)})
    ends: dict[float | None, float] = {}
    for margin in (None, 0.2):
        fit = ac.fit(
            plain(), data, "mass.a", modifiers={"spring.d": ac.Shift(1.0)}, epochs=40,
            regularizers=[] if margin is None else [ac.Stability(1e3, margin=margin, points=3)],
            params=params | {"spring.d": start}, strategy="equation_error", progress=False,
        )  # fmt: skip
        ends[margin] = start + fit.history.modifiers["spring.d"][-1]
    assert ends[None] < -0.1
    assert ends[0.2] == pytest.approx(2 * M * 0.2, abs=0.02)  # Re λ = −d/2m


def test_states_can_be_left_out():
    wanted = ac.Stability(margin=1.0, states=("mass.v",))
    found = wanted(plain().parameters(), context(plain()))
    assert float(found) == pytest.approx((1 - D / M) ** 2)
    with pytest.raises(ac.TrainingError, match=r"names the state 'mass\.x': did you mean 'mass"):
        ac.Stability(states=("mass.x",))(plain().parameters(), context(plain()))
