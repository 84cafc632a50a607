"""Tolerances of states that stay small."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import acausal as ac


class Cycle(ac.Component):
    """An oscillator with a limit cycle of twice the size, beside a large state of another unit."""

    size, rate = ac.Parameter(1.0), ac.Parameter(0.1, unit="1/s")
    s = ac.Variable(start=0.0, fixed=True)
    v = ac.Variable(start=0.0, fixed=True)
    other = ac.Variable(unit="K", start=1.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.s), self.v)
        yield ac.Eq(ac.der(self.v), -self.s - 0.1 * self.v * ((self.s / self.size) ** 2 - 1))
        yield ac.Eq(ac.der(self.other), -self.rate * self.other)


@pytest.mark.slow
def test_small_states_are_as_exact_as_large_ones() -> None:
    system = ac.compile(Cycle())
    whole, small, coarse = (
        np.asarray(
            ac.simulate(system, 300.0, params={"size": size}, x0={"s": size, "v": 0.0}, **given)["s"]
        ) / size
        for size, given in ((1.0, {}), (1e-9, {}), (1e-9, {"atol": 1e-8}))
    )  # fmt: skip
    np.testing.assert_allclose(small, whole, atol=1e-3)
    assert abs(abs(coarse[-100:]).max() - 2) > 0.5  # without finer tolerances


class Two(ac.Component):
    """A small state beside a large one of the same unit, which sets the tolerance where both begin at zero."""

    rate = ac.Parameter(1.0, unit="1/s")
    a = ac.Variable(unit="V", start=1.0, fixed=True)
    b = ac.Variable(unit="V", start=0.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.a), -self.rate * self.a)
        yield ac.Eq(ac.der(self.b), self.rate * (1e-9 * self.a - 3 * self.b))


@pytest.mark.slow
def test_small_states_beside_large_ones_of_their_unit_take_no_finer_steps() -> None:
    system = ac.compile(Two())
    usual, given = ac.simulate(system, 2.0), ac.simulate(system, 2.0, atol=1e-8)
    assert usual.statistics == given.statistics


class Stage(ac.Component):
    """An oscillator of a nanometre beside a mass that moves by metres."""

    fine = ac.Variable(start=1e-9, fixed=True, unit="m")
    v = ac.Variable(start=0.0, fixed=True, unit="m/s")
    coarse = ac.Variable(start=0.0, fixed=True, unit="m")
    w = ac.Variable(start=1.0, fixed=True, unit="m/s")
    omega, rate = ac.Parameter(60.0, unit="rad/s"), ac.Parameter(0.5, unit="1/s")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.fine), self.v)
        yield ac.Eq(ac.der(self.v), -(self.omega**2) * self.fine)
        yield ac.Eq(ac.der(self.coarse), self.w)
        yield ac.Eq(ac.der(self.w), -self.rate * self.w)


def test_a_state_that_begins_small_beside_large_ones_is_exact() -> None:
    """It grew to 23 times its size, as an absolute tolerance of ten times that let it."""
    system = ac.compile(Stage(), check_units=False)
    for x0, size in ((None, 1e-9), ({"fine": 3e-10}, 3e-10)):
        run = ac.simulate(system, 2.0, x0=x0)
        np.testing.assert_allclose(run["fine"] / size, np.cos(60 * run.t), atol=1e-3)


@pytest.mark.slow
def test_a_state_of_a_sweep_that_begins_small_is_exact() -> None:
    system = ac.compile(Stage(), check_units=False)
    for over, size, given in (
        ({"rate": [0.5, 1.0]}, 1e-9, {}),
        ({"rate": [0.5, 1.0]}, 1e-9, {"saveat": np.linspace(0, 2, 101), "dtype": np.float32}),
        ({"fine": [2e-9, 3e-9]}, 3e-9, {}),
    ):
        swept = ac.sweep(system, over, 2.0, **given)
        np.testing.assert_allclose(swept["fine"][1] / size, np.cos(60 * swept.t), atol=5e-3)


def test_a_run_that_goes_on_from_another_takes_no_finer_steps() -> None:
    """What is left of a settled speed is an error of the steps, not small on purpose."""
    system = ac.compile(Stage(), check_units=False)
    end = {"fine": 1e-12, "v": 1e-11, "coarse": 2.0, "w": 1.0}
    runs = [ac.simulate(system, 2.0, x0=x0) for x0 in (end, np.array([*end.values()]))]
    usual = ac.simulate(system, 2.0, x0=end, atol=1e-8)
    assert {str(run.statistics) for run in runs} == {str(usual.statistics)}


class Steep(ac.Component):
    """A small state that a steep law pulls behind another, beside one of size 1."""

    size = ac.Parameter(1.0)
    x = ac.Variable(start=0.0)
    y = ac.Variable(start=1.0)

    def equations(self) -> Iterator[Any]:
        law = self.x + self.size * ac.sinh(self.x / self.size)
        yield ac.Eq(ac.der(self.x), 100 * (self.size * ac.cos(ac.time) * self.y - law))
        yield ac.Eq(ac.der(self.y), -0.1 * self.y**3)


def steep() -> ac.System:
    return ac.compile(Steep())


@pytest.mark.parametrize("solver", ["kvaerno3", "implicit_euler"])
def test_implicit_fixed_steps_solve_for_a_state_of_any_size(solver: str) -> None:
    system, ends = steep(), []
    for size in (1.0, 1e-9, 1e-12):
        sol = ac.simulate(system, 1.0, dt=0.01, solver=solver, params={"size": size})
        ends.append(np.asarray(sol["x"]) / size)
    np.testing.assert_allclose(ends[1:], [ends[0]] * 2, rtol=1e-9, atol=1e-12)
