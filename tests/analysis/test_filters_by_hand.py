"""Nonlinear filters against the same written in NumPy, and the consistency of what they say of themselves."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import chi2

import acausal as ac
from tests.analysis.test_estimate import Pendulum, gathered
from tests.support.slow import some_slow

H, N, R, RUB = 0.05, 80, 0.05, 0.2
WALK = np.array([0.0, 0.3, 0.05])
"""Deviations of the noise of angle, rate and length after a second."""

START, SPREAD = np.array([0.8, -0.5, 1.1]), np.array([0.2, 0.3, 0.1])


def rates(z: np.ndarray) -> np.ndarray:
    phi, w, length = z
    return np.array([w, -9.81 / length * np.sin(phi) - RUB * w, 0 * length])


def step(z: np.ndarray, h: float = H) -> np.ndarray:
    """One of Runge and Kutta, for real and complex numbers."""
    a = rates(z)
    b = rates(z + h / 2 * a)
    c = rates(z + h / 2 * b)
    return z + h / 6 * (a + 2 * b + 2 * c + rates(z + h * c))


def shown(z: np.ndarray) -> np.ndarray:
    phi, _, length = z
    return np.array([length * np.sin(phi)])


def tangent(function, z, P):
    """Value, slope and nothing left, by complex steps."""
    columns = [np.imag(function(z + 1e-30j * e)) / 1e-30 for e in np.eye(3)]
    return function(z), np.stack(columns, axis=1), 0.0


def cubature(function, z, P):
    """Mean, regression line and what it leaves, by points of the same weight."""
    apart = np.sqrt(3) * np.linalg.cholesky(P)
    y = np.array([function(z + s * a) for s in (1, -1) for a in apart.T])
    mean, points = y.mean(axis=0), np.concatenate([apart.T, -apart.T])
    slope = np.linalg.solve(P, points.T @ (y - mean) / 6).T
    return mean, slope, (y - mean).T @ (y - mean) / 6 - slope @ P @ slope.T


def by_hand(line, y):
    """Means, covariances and the log likelihood; a measurement that is NaN is left out."""
    z, P, found, likelihood = START, np.diag(SPREAD**2), [], 0.0
    for k, value in enumerate(y):
        if k:
            before = z
            z, A, left = line(step, z, P)
            P = A @ P @ A.T + left + gathered(tangent(rates, before, P)[1], np.diag(WALK**2), H)
        if np.isfinite(value):
            expected, C, left = line(shown, z, P)
            S = (C @ P @ C.T + left).item() + R**2
            gain = P @ C.T / S
            off = value - expected.item()
            z, P = z + gain[:, 0] * off, P - gain * S @ gain.T
            likelihood -= (off**2 / S + np.log(2 * np.pi * S)) / 2
        found.append((z, P))
    means, covariances = map(np.array, zip(*found, strict=True))
    return means, covariances, likelihood


def truths(runs: int, rng: np.random.Generator) -> np.ndarray:
    """Ways of pendulums from uncertain starts with noise, shape (3, N, runs)."""
    z = START[:, None] + SPREAD[:, None] * rng.standard_normal((3, runs))
    way = [z]
    h = H / 10
    for _ in range(N - 1):
        for _ in range(10):
            z = step(z, h) + WALK[:, None] * np.sqrt(h) * rng.standard_normal((3, runs))
        way.append(z)
    return np.stack(way, axis=1)


def estimate(system: ac.System, y: np.ndarray, method: str) -> ac.Estimation:
    return ac.estimate(
        system, ac.Data(H * np.arange(N), {"x": y}, missing="nan"), method, sensors={"x": R},
        x0={"phi": START[0], "w": START[1]}, params={"length": START[2], "rub": RUB}, window=10,
        states={"phi": SPREAD[0], "w": SPREAD[1]}, parameters={"length": SPREAD[2]},
        noise={"w": WALK[1], "length": WALK[2]}, dt=H, solver="rk4",
    )  # fmt: skip


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize(("method", "line"), [("ekf", tangent), ("ukf", cubature)])
def test_a_pendulum_with_a_drifting_length_is_estimated_as_by_hand(method, line):
    rng = np.random.default_rng(0)
    y = shown(truths(1, rng)[:, :, 0])[0] + R * rng.standard_normal(N)
    y[20:26], y[40::3] = np.nan, np.nan
    found = estimate(ac.compile(Pendulum(), check_units=False), y, method)
    means, covariances, likelihood = by_hand(line, y)
    np.testing.assert_allclose(found.x, means[:, :2], atol=1e-9)
    np.testing.assert_allclose(found["length"], means[:, 2], atol=1e-9)
    np.testing.assert_allclose(found.covariance, covariances, atol=1e-9)
    assert float(found.log_likelihood) == pytest.approx(likelihood, abs=1e-7)


@pytest.mark.parametrize("method", some_slow(["ekf", "ukf", "mhe"], ["ukf"], ["ekf", "mhe"]))
def test_errors_and_innovations_of_200_pendulums_are_as_large_as_is_said(method):
    """Normalized errors of estimates (NEES) and innovations (NIS), within their bounds of 99.9 %."""
    runs, rng = 200, np.random.default_rng(1)
    way = truths(runs, rng)
    y = shown(way)[0] + R * rng.standard_normal((N, runs))
    system = ac.compile(Pendulum(), check_units=False)
    nees, nis = [], 0.0
    for k in range(runs):
        found = estimate(system, y[:, k], method)
        z = np.column_stack([found.x, found["length"]])
        off = (z - way[:, :, k].T)[[N // 2, N - 1], :, None]
        P = np.asarray(found.covariance)[[N // 2, N - 1]]
        nees.append(np.sum(off * np.linalg.solve(P, off), axis=(1, 2)))
        nis += float(np.sum(found.nis))
    low, high = chi2.ppf([0.0005, 0.9995], 3 * runs)
    assert np.all((np.sum(nees, axis=0) > low) & (np.sum(nees, axis=0) < high))
    low, high = chi2.ppf([0.0005, 0.9995], N * runs)
    assert low < nis < high
