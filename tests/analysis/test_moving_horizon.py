"""Moving-horizon estimation against the Kalman filter, a solver of bounded least squares, and the truth."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import lsq_linear

import acausal as ac
from tests.analysis.test_estimate import GIVEN, N, Pendulum, by_hand, record
from tests.support.oscillator import plain


@pytest.mark.cases(fast=0, slow=3)
@pytest.mark.parametrize("window", [N, 2])
def test_of_a_linear_model_any_window_gives_the_kalman_filter_and_smoother(window):
    data = record()
    found = ac.estimate(plain(), data, "mhe", window=window, **GIVEN)
    m, P, likelihood, late, spread = by_hand(data)
    np.testing.assert_allclose(found.x, m, atol=1e-8)
    np.testing.assert_allclose(found.covariance, P, atol=1e-8)
    assert float(found.log_likelihood) == pytest.approx(float(likelihood), abs=1e-6)
    later = found.smooth()
    np.testing.assert_allclose(later.x, late, atol=1e-8)
    np.testing.assert_allclose(later.covariance, spread, atol=1e-8)


@pytest.mark.slow
def test_a_pendulum_is_found_from_a_wrong_start_sooner_than_by_a_filter():
    """The angle, of which the sine is measured, begins on the other side of where the sine bends."""
    system = ac.compile(Pendulum(), check_units=False)
    truth = ac.simulate(system, 6, dt=0.02, x0={"phi": 2.5, "w": -1.0})
    rng = np.random.default_rng(0)
    data = ac.Data(truth.t, {"x": truth["x"] + 0.02 * rng.standard_normal(len(truth.t))})
    off = {}
    for method in ("ekf", "mhe"):
        found = ac.estimate(
            system, data, method, states={"phi": 2.0, "w": 3.0}, x0={"phi": 0.5},
            noise={"w": 0.01}, sensors={"x": 0.02}, window=50,
        )  # fmt: skip
        off[method] = np.sqrt(np.mean(np.asarray(found["phi"] - truth["phi"])[100:] ** 2))
    assert off["mhe"] < 0.01 < 0.3 < off["ekf"]


class Tank(ac.Component):
    """A level that falls in proportion to itself; it is never negative."""

    h = ac.Variable(unit="m", start=1.0)
    rate = ac.Parameter(1.0, unit="1/s")

    def equations(self):
        yield ac.Eq(ac.der(self.h), -self.rate * self.h)


@pytest.mark.slow
def test_bounds_are_those_of_least_squares():
    t, q, r, first = 0.1 * np.arange(40), 0.1, 0.3, 0.5
    rng = np.random.default_rng(3)
    y = 0.2 * np.exp(-t) + r * rng.standard_normal(40)
    given = {
        "sensors": {"h": r}, "noise": {"h": q}, "states": {"h": first}, "x0": {"h": 0.2}, "dt": 0.02,
    }  # fmt: skip
    system, data = ac.compile(Tank()), ac.Data(t, {"h": y})
    found = ac.estimate(system, data, "mhe", window=40, bounds={"h": (0.0, None)}, **given)
    free = ac.estimate(system, data, "mhe", window=40, **given)
    assert np.min(free["h"]) < -0.02
    assert np.min(found["h"]) > -0.01 * first
    steps = np.eye(40) - np.exp(-0.1) * np.eye(40, k=-1)
    sigma = np.array([first, *[q * np.sqrt((1 - np.exp(-0.2)) / 2)] * 39])
    for last in (20, 30, 39):
        n = last + 1
        rows = np.concatenate([(steps / sigma[:, None])[:n, :n], np.eye(n) / r])
        wanted = np.concatenate([[0.2 / first], np.zeros(last), y[:n] / r])
        best = lsq_linear(rows, wanted, (0.0, np.inf), method="bvls").x[-1]
        assert float(found["h"][last]) == pytest.approx(best, abs=1e-3 * first)


def tank(method, **more):
    """Levels, deviation and likelihood by the noise of sensor and state, and the rate."""
    t, rng = 0.1 * np.arange(8), np.random.default_rng(3)
    data = ac.Data(t, {"h": 0.1 * np.exp(-t) + 0.3 * rng.standard_normal(8)})

    @jax.jit
    def found(theta):
        r, q, rate = theta
        found = ac.estimate(
            ac.compile(Tank()), data, method, states={"h": 0.5}, x0={"h": 0.2}, dt=0.1, solver="rk4",
            sensors={"h": r}, noise={"h": q}, params={"rate": rate}, **more,
        )  # fmt: skip
        return jnp.stack([jnp.sum(found["h"]), found.deviation("h")[-1], found.log_likelihood])

    return found


THETA = jnp.array([0.3, 0.5, 1.2])


def differences(function, h=1e-5):
    steps = h * np.eye(3)
    return np.stack([(function(THETA + d) - function(THETA - d)) / (2 * h) for d in steps], 1)


@pytest.mark.slow
def test_gradients_go_through_the_horizon():
    found = jax.jacrev(tank("mhe", window=4))(THETA)
    np.testing.assert_allclose(found, jax.jacrev(tank("ekf"))(THETA), rtol=1e-7, atol=1e-9)


@pytest.mark.slow
def test_with_bounds_they_are_those_of_differences():
    free, found = (tank("mhe", window=4, bounds=b) for b in (None, {"h": (0.0, None)}))
    assert abs(found(THETA)[0] - free(THETA)[0]) > 0.05
    np.testing.assert_allclose(jax.jacrev(found)(THETA), differences(found), rtol=1e-5, atol=1e-7)


@pytest.mark.machines
def test_gradients_of_a_nonlinear_horizon_are_those_of_differences():
    system = ac.compile(Pendulum(), check_units=False)
    truth = ac.simulate(system, 0.4, dt=0.02, x0={"phi": 2.5, "w": -1.0})
    noise = 0.02 * np.random.default_rng(0).standard_normal(len(truth.t))
    data = ac.Data(truth.t, {"x": truth["x"] + noise})

    @jax.jit
    def found(theta):
        r, q, rub = theta
        found = ac.estimate(
            system, data, "mhe", states={"phi": 2.0, "w": 3.0}, x0={"phi": 2.0}, window=8,
            dt=0.02, solver="rk4", sensors={"x": 0.1 * r}, noise={"w": q}, params={"rub": rub},
        )  # fmt: skip
        return jnp.stack([jnp.sum(found["phi"]), found.deviation("w")[-1], found.log_likelihood])

    np.testing.assert_allclose(jax.jacrev(found)(THETA), differences(found), rtol=2e-3, atol=1e-3)
