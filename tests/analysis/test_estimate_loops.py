"""Estimates of models with algebraic loops and hidden constraints: consistent after every correction."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from tests.components.test_planar import FourBar, gap


class Implicit(ac.Component):
    """A damped state whose sensor shows the solution of a cubic equation, implicitly or by Cardano's formula."""

    x = ac.Variable(start=1.0)
    z = ac.Variable(start=0.5)

    def __init__(self, *, explicit: bool = False) -> None:
        super().__init__()
        self._explicit = explicit

    def equations(self):
        yield ac.Eq(ac.der(self.x), ac.sin(2 * self.z) - self.x)
        if self._explicit:
            root = ac.sqrt(self.x**2 + 1 / 27)
            yield ac.Eq(self.z, (root + self.x) ** (1 / 3) - (root - self.x) ** (1 / 3))
        else:
            yield ac.Eq(self.z + self.z**3, 2 * self.x)


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("method", ["ekf", "ukf", "mhe"])
def test_an_implicit_equation_is_solved_as_its_formula_is(method):
    t = 0.05 * np.arange(80)
    data = ac.Data(t, {"z": 0.6 + 0.1 * np.random.default_rng(0).standard_normal(80)})
    found, formula = (
        ac.estimate(
            ac.compile(Implicit(explicit=explicit)), data, method, sensors={"z": 0.1}, window=5,
            noise={"x": 0.2}, states={"x": 0.5}, x0={"x": 1.0}, solver="rk4", dt=0.05,
        )
        for explicit in (False, True)
    )  # fmt: skip
    np.testing.assert_allclose(found.x, formula.x, atol=1e-9)
    np.testing.assert_allclose(found.covariance, formula.covariance, atol=1e-9)
    assert float(found.log_likelihood) == pytest.approx(float(formula.log_likelihood), abs=1e-6)
    np.testing.assert_allclose(found["z"] + found["z"] ** 3, 2 * found["x"], atol=1e-10)


@pytest.mark.slow
def test_a_linkage_stays_closed_from_a_wrong_start():
    """The angle of the crank is 0.2 rad off, and that of the rocker is measured, which follows in a loop."""
    system, t = ac.compile(FourBar(d=0.5)), 0.01 * np.arange(150)
    truth = ac.simulate(system, t[-1], dt=0.01, x0={"crank.w": 6.0}, solver="rk4")
    y = truth["rocker.phi"] + 0.02 * np.random.default_rng(0).standard_normal(len(t))
    given = {
        "states": {"crank.phi": 0.3, "crank.w": 3.0}, "x0": {"crank.phi": 0.4, "crank.w": 4.0},
        "solver": "rk4", "dt": 0.01,
    }  # fmt: skip
    sensors, noise = {"rocker.phi": 0.02}, {"crank.w": 0.02}
    data = ac.Data(t, {"rocker.phi": y})
    found = ac.estimate(system, data, sensors=sensors, noise=noise, **given)
    for estimates in (found, found.smooth()):
        assert np.max(gap(estimates)) < 1e-12
        guesses = np.stack([estimates["rocker.phi"], estimates["body1.phi"]], axis=1)
        np.testing.assert_allclose(estimates.x[:, 2:], guesses, atol=1e-10)
    assert np.max(np.abs(found["crank.phi"] - truth["crank.phi"])[50:]) < 0.03
    observer = ac.observer(system, sensors, noise, 0.01, **given)
    for k in range(20):
        told = observer.step(t[k], y={"rocker.phi": y[k]})
    np.testing.assert_allclose(list(told.values()), found.x[19], atol=1e-8)


class Bob(ac.Component):
    """A pendulum in Cartesian coordinates: index 3, of which two states are left."""

    x = ac.Variable(unit="m", start=0.6)
    y = ac.Variable(unit="m", start=-0.8)
    vx = ac.Variable(unit="m/s")
    vy = ac.Variable(unit="m/s")
    pull = ac.Variable(unit="1/s2")

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.vx)
        yield ac.Eq(ac.der(self.y), self.vy)
        yield ac.Eq(ac.der(self.vx), -self.pull * self.x)
        yield ac.Eq(ac.der(self.vy), -self.pull * self.y - 9.81)
        yield ac.Eq(self.x**2 + self.y**2, 1.0)


@pytest.mark.slow
def test_hidden_constraints_hold_after_every_correction():
    system = ac.compile(Bob(), check_units=False)
    assert system.states == ("x", "y", "vx", "vy")  # near the constraint, none of them alone
    t = 0.01 * np.arange(40)
    data = ac.Data(t, {"x": 0.6 + 0.05 * np.random.default_rng(0).standard_normal(40)})
    found = ac.estimate(
        system, data, sensors={"x": 0.05}, noise={"vx": 0.5},
        states=dict.fromkeys(system.states, 0.3),
    )  # fmt: skip
    x, y, vx, vy = (np.asarray(found[n]) for n in ("x", "y", "vx", "vy"))
    assert np.max(np.abs(x**2 + y**2 - 1)) < 1e-10
    assert np.max(np.abs(x * vx + y * vy)) < 1e-10
