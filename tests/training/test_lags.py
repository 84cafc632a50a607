"""First-order lags of sensors: exact for outputs that are linear over a row, without a limit on their speed."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal.training.objective.sensors import SensorRows, lagged
from tests.support.oscillator import plain, record

T = jnp.asarray([0.0, 0.1, 0.25, 0.3, 0.7, 2.0, 2.1, 2.4, 2.45])
FIRST = jnp.asarray([0] * 5 + [5] * 4)
LAST = jnp.asarray([4] * 5 + [8] * 4)
H = jnp.asarray([0.1, 0.15, 0.05, 0.4, 0.4, 0.1, 0.3, 0.05, 0.05])
ROWS = SensorRows(T, H, FIRST, LAST)
Y = jnp.asarray([1.0, 2.0, -1.0, 0.0, 3.0, -4.0, -4.0, 2.0, 1.0])


def lag(time_constant: float, y: jax.Array = Y) -> jax.Array:
    """The lagged output."""
    return lagged(y, ROWS, jnp.asarray(time_constant), y[FIRST])


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("time_constant", [0.01, 0.2, 5.0])
def test_a_lag_is_the_solution_of_its_equation(time_constant: float) -> None:
    found = lag(time_constant)
    for part in (slice(0, 5), slice(5, 9)):
        t, y = np.asarray(T[part]), np.asarray(Y[part])
        at = y[:1]
        for i in range(len(t) - 1):
            line = [t[i], t[i + 1]], [y[i], y[i + 1]]
            solved = solve_ivp(
                lambda s, z, line=line: (np.interp(s, *line) - z) / time_constant,
                line[0], at, method="LSODA", rtol=1e-10, atol=1e-12,
            )  # fmt: skip
            at = solved.y[:, -1]
            assert float(found[part][i + 1]) == pytest.approx(at[0], abs=1e-7)


def test_without_a_time_constant_there_is_no_lag() -> None:
    assert list(lag(0.0)) == list(Y)
    for small in (1e-300, 1e-12, 1e-5):
        np.testing.assert_allclose(lag(small), Y, atol=1e3 * small)
    assert np.isfinite(lag(1e9)).all()


def test_derivatives_exist_whatever_the_time_constant() -> None:
    slope = jax.jit(jax.jacfwd(lambda c: lagged(Y, ROWS, c, Y[FIRST])))
    gradient = jax.jit(jax.jacrev(lambda c: lagged(Y, ROWS, c, Y[FIRST])))
    at_zero = np.where(
        np.asarray(T) == np.asarray(T[FIRST]), 0.0, -np.diff(Y, prepend=0.0) / np.roll(H, 1)
    )
    np.testing.assert_allclose(slope(0.0), at_zero, atol=1e-12)
    for c in (0.0, 1e-300, 1e-4, 0.03, 2.0, 1e6):
        np.testing.assert_allclose(slope(c), gradient(c), rtol=1e-9, atol=1e-15)
    h = 1e-6
    np.testing.assert_allclose(slope(0.3), (lag(0.3 + h) - lag(0.3 - h)) / (2 * h), rtol=1e-6)


@pytest.mark.slow
def test_a_lag_is_found_and_one_that_is_not_there_goes_away() -> None:
    data = record(cubic=0.0, end=8.0)
    t, a = data.time, data.signals["mass.a"]
    h = float(t[1] - t[0])
    rows = SensorRows(
        jnp.asarray(t), jnp.asarray(h), jnp.zeros(len(t), int), jnp.full(len(t), len(t) - 1)
    )
    slow = lagged(jnp.asarray(a), rows, jnp.asarray(0.03), jnp.full(len(t), a[0]))
    fit = ac.fit(
        plain(),
        ac.Data(t, {**data.signals, "mass.a": np.asarray(slow)}),
        ("mass.a", "mass.s"),
        lags={"mass.a": ac.Lag(0.01), "mass.s": ac.Lag(0.05)},
        strategy="gauss_newton",
        progress=False,
    )
    assert fit.lags["mass.a"] == pytest.approx(0.03, abs=5e-4)
    assert 0 <= fit.lags["mass.s"] < 1e-3
    assert fit.loss < 0.01
    assert fit.delays == {}
