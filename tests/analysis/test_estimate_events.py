"""Kalman filters of models with events: what is sampled, modes, and jumps of states."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.hybrid import GRAVITY, Ball, Sampled
from tests.support.slow import some_slow

H, N, R, Q, K, SPREAD = 0.05, 41, 0.02, 0.3, 2.0, 0.4


def by_hand(y: np.ndarray) -> tuple[np.ndarray, ...]:
    """Means and covariances of plant and controller, the likelihood, and smoothed means, in matrices.

    The controller samples at every second row, before the measurement of that row is used.
    """
    a = np.exp(-H)
    flow, sample = np.array([[a, 1 - a], [0, 1]]), np.array([[1.0, 0], [-K, 0]])
    m, P = np.array([0.1, K * (1 - 0.1)]), np.diag([SPREAD**2, 0])
    means, covariances, ahead, likelihood = [], [], [], 0.0
    for k, measured in enumerate(y):
        step = sample @ flow if k % 2 == 0 else flow
        if k:
            m = step @ m + np.array([0, K * (k % 2 == 0)])
            P = step @ P @ step.T + np.diag([Q**2 * (1 - a**2) / 2, 0])
        ahead.append((step, m, P))
        S = P[0, 0] + R**2
        v, gain = measured - m[0], P[:, 0] / S
        likelihood -= 0.5 * (v**2 / S + np.log(2 * np.pi * S))
        m, P = m + gain * v, P - np.outer(gain, gain) * S
        means.append(m)
        covariances.append(P)
    smooth = [means[-1]]
    for k in reversed(range(len(y) - 1)):
        step, mean, spread = ahead[k + 1]
        back = covariances[k] @ step.T @ np.linalg.pinv(spread)
        smooth.insert(0, means[k] + back @ (smooth[0] - mean))
    return np.array(means), np.array(covariances), np.array(likelihood), np.array(smooth)


def sampled() -> tuple[ac.System, ac.Data, dict[str, Any]]:
    """A plant with a sampled controller, its record, and what is known of it."""
    system, t = ac.compile(Sampled()), H * np.arange(N)
    run = ac.simulate(system, t[-1], saveat=t, rtol=1e-9)
    noise = R * np.random.default_rng(1).standard_normal(N)
    given = {"sensors": {"x": R}, "x0": {"x": 0.1}, "states": {"x": SPREAD}}
    return system, ac.Data(t, {"x": np.asarray(run["x"]) + noise}), given


@pytest.mark.slow
def test_what_a_controller_has_sampled_is_estimated_as_a_state_is():
    system, data, given = sampled()
    found = ac.estimate(system, data, noise={"x": Q}, **given)
    m, P, likelihood, late = by_hand(data["x"])
    np.testing.assert_allclose(np.stack([found["x"], found["u"]], axis=1), m, atol=2e-6)
    np.testing.assert_allclose(found.deviation(["x", "u"])[:, 0], np.sqrt(P[:, 0, 0]), atol=1e-6)
    np.testing.assert_allclose(found.deviation("u"), np.sqrt(P[:, 1, 1]), atol=2e-6)
    assert float(found.log_likelihood) == pytest.approx(float(likelihood), abs=1e-3)
    assert "  x " in repr(found)
    np.testing.assert_allclose(found.smooth()["x"], late[:, 0], atol=2e-6)


@pytest.mark.machines
def test_noise_is_fitted_through_events():
    system, data, given = sampled()
    likelihood = ac.estimate(system, data, noise={"x": Q}, **given).log_likelihood
    assert ac.estimate(system, data, noise="fit", **given).log_likelihood > likelihood


@pytest.mark.parametrize("method", some_slow(["ekf", "ukf", "enkf"], ["ukf"], ["ekf", "enkf"]))
def test_a_ball_is_followed_through_its_bounces(method: str):
    """From a wrong start; in the air an error of speed becomes one of height, a bounce turns and shortens both."""
    system, t = ac.compile(Ball()), np.linspace(0.0, 1.6, 161)
    run = ac.simulate(system, t[-1], saveat=t, rtol=1e-9)
    data = ac.Data(
        t, {"h": np.asarray(run["h"]) + 0.02 * np.random.default_rng(2).standard_normal(161)}
    )
    found = ac.estimate(
        system, data, method, sensors={"h": 0.02}, x0={"h": 1.1, "v": 0.3},
        states={"h": 0.1, "v": 0.3}, noise={"v": 0.02}, members=100,
    )  # fmt: skip
    assert run["n"][-1] == 2
    assert np.array_equal(np.unique(found["n"]), [0, 1, 2])
    high = (
        np.asarray(run["h"]) > 0.1
    )  # near the ground it is not known on which side of the bounce the ball is
    off = np.abs(np.asarray(found["v"] - run["v"]))
    assert np.all(
        off[high & (t > 0.8)] < 4 * np.asarray(found.deviation("v"))[high & (t > 0.8)] + 0.01
    )
    assert np.sqrt(np.mean(off[high & (t > 0.8)] ** 2)) < 0.2
    energy = GRAVITY * found["h"] + found["v"] ** 2 / 2
    assert np.all(np.isfinite(energy))


def test_what_does_not_follow_events_says_so():
    t = H * np.arange(N)
    data, ball = ac.Data(t, {"h": t}), ac.compile(Ball())
    with pytest.raises(ac.ModelError, match="method='mhe', does not follow events"):
        ac.estimate(ball, data, "mhe")
    with pytest.raises(ac.ModelError, match="observer does not follow events"):
        ac.observer(ball, {"h": 0.1}, {"v": 0.1}, H)
