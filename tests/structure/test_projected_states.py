"""States of mechanisms that no choice of coordinates follows everywhere: motions through dead points, and starts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import jax
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal.components import planar
from tests.support.exported_c import ExportedC, need_compiler
from tests.support.parts import Equations, Pendulum
from tests.support.planar import chained

Eq, der = ac.Eq, ac.der
G = 9.81


def turning(**starts: ac.Start) -> ac.Component:
    """A pendulum with speed enough to turn over."""
    return Pendulum(x=ac.Start(0.6, fixed=True), y=ac.Start(-0.8), **{"v": ac.Start(8.0), **starts})


@pytest.fixture(scope="module")
def pendulum() -> ac.System:
    return ac.compile(turning())


def angles(t: np.ndarray, phi: float, w: float) -> np.ndarray:
    def rates(_: float, z: np.ndarray) -> list[float]:
        return [z[1], -G * np.sin(z[0])]

    return solve_ivp(rates, (0, t[-1]), [phi, w], "DOP853", t, rtol=1e-12, atol=1e-12).y[0]


@pytest.mark.slow
def test_a_pendulum_in_cartesian_coordinates_turns_over(pendulum: ac.System) -> None:
    assert pendulum.states == ("x", "y", "v", "w")
    found = ac.simulate(pendulum, 5.0, rtol=1e-8, atol=1e-10)
    phi = angles(np.asarray(found.t), np.arcsin(0.6), 10.0)
    assert np.ptp(phi) > 6 * np.pi
    np.testing.assert_allclose(found["x"], np.sin(phi), atol=2e-5)
    np.testing.assert_allclose(found["y"], -np.cos(phi), atol=2e-5)
    np.testing.assert_allclose(found["x"] ** 2 + found["y"] ** 2, 1.0, atol=1e-12)
    np.testing.assert_allclose(found["x"] * found["v"] + found["y"] * found["w"], 0.0, atol=1e-9)
    np.testing.assert_allclose(found.x[:, 0], found["x"], atol=1e-6)  # which the state follows


@pytest.mark.slow
def test_speeds_need_no_names() -> None:
    def stated(s: Equations) -> Iterator[ac.Eq]:
        yield Eq(der(der(s.x)), -s.f * s.x)
        yield Eq(der(der(s.y)), -s.f * s.y - G)
        yield Eq(s.x**2 + s.y**2, 1)

    model = Equations("x y f", stated)
    system = ac.compile(model)
    assert system.states == ("x", "y", "der(x)", "der(y)")
    start = np.asarray(system.initial_state(x0={"x": 0.6, "der(x)": 8.0}))
    np.testing.assert_allclose(np.abs(start), [0.6, 0.8, 8.0, 6.0], atol=1e-6)
    assert np.isfinite(rates_of(system, start)).all()


def rates_of(system: ac.System, x: np.ndarray) -> np.ndarray:
    return np.asarray(system.vector_field(0.0, x, None, system.parameters()))


@pytest.mark.slow
def test_its_starts_move_as_little_as_they_must(pendulum: ac.System) -> None:
    found = pendulum.initialize()
    assert found["w"] == pytest.approx(6.0)  # nobody has given it
    assert found["v"] == pytest.approx(8.0, rel=1e-5)
    assert "x**2 + y**2 = 1" in str(found)
    found = pendulum.initialize(x0={"x": 0.28, "v": 0.0})
    assert [float(found[n]) for n in ("x", "y", "v", "w")] == pytest.approx([0.28, -0.96, 0, 0])
    with pytest.raises(ac.InitializationError, match=r"not met: '.*x\*\*2 \+ y\*\*2 = 1 by"):
        pendulum.initial_state(x0={"x": 1.0, "y": 1.0})
    near = pendulum.initial_state(
        x0=np.array([0.7, -0.9, 1.0, 0.0])
    )  # all as an array: the nearest
    assert float(near[0] ** 2 + near[1] ** 2) == pytest.approx(1.0, abs=1e-12)
    free = ac.compile(Pendulum())  # at zero the constraint has no slope
    assert abs(float(free.initial_state()[1])) == pytest.approx(1.0)


@pytest.mark.slow
def test_it_comes_to_rest_and_its_linearization_has_two_states() -> None:
    hanging = ac.compile(Pendulum(x=ac.Start(0.9), y=ac.Start(0.2)))
    np.testing.assert_allclose(hanging.initial_state(steady=True), [0, -1, 0, 0], atol=1e-9)
    found = ac.linearize(hanging, x="steady")
    assert found.states == ("x", "v")
    np.testing.assert_allclose(found.A, [[0, 1], [-G, 0]], atol=1e-9)


@pytest.mark.slow
def test_its_gradients_are_those_of_differences(pendulum: ac.System) -> None:
    def end(v: jax.Array | float) -> jax.Array:
        return ac.simulate(pendulum, 1.0, x0={"v": v}, rtol=1e-9, atol=1e-11)["x"][-1]

    slope, h = jax.grad(end)(8.0), 1e-4
    assert slope == pytest.approx(float(end(8 + h) - end(8 - h)) / (2 * h), rel=1e-4)


@pytest.mark.slow
def test_exported_steps_turn_over_as_simulated_ones_do(pendulum: ac.System, tmp_path: Path) -> None:
    need_compiler()
    model = ExportedC(pendulum, tmp_path, solver="rk4", outputs=("x", "y"))
    found = ac.simulate(pendulum, 2.0, dt=1e-3, solver="rk4")
    for _ in range(2000):
        assert model.step(1e-3) == 0
    np.testing.assert_allclose(model.outputs(), [found["x"][-1], found["y"][-1]], atol=1e-9)
    assert np.sum(model.outputs() ** 2) == pytest.approx(1.0, abs=1e-12)


class Reeled(ac.Component):
    """A pendulum whose length changes in time."""

    x = ac.Variable(start=0.6)
    y = ac.Variable(start=-0.8)
    v = ac.Variable(start=6.0)
    w = ac.Variable()
    f = ac.Variable()

    def equations(self) -> Iterator[ac.Eq]:
        yield Eq(der(self.x), self.v)
        yield Eq(der(self.y), self.w)
        yield Eq(der(self.v), -self.f * self.x)
        yield Eq(der(self.w), -self.f * self.y - G)
        yield Eq(self.x**2 + self.y**2, (1 + 0.2 * ac.sin(3 * ac.time)) ** 2)


@pytest.mark.slow
def test_a_constraint_may_move() -> None:
    system = ac.compile(Reeled())
    start = np.asarray(system.initial_state())
    np.testing.assert_allclose(start, [0.6, -0.8, 6.0, 3.75], atol=1e-6)  # w alone has no start
    found = ac.simulate(system, 3.0, rtol=1e-8, atol=1e-10)

    def rates(t: float, z: np.ndarray) -> list[float]:
        length, growth = 1 + 0.2 * np.sin(3 * t), 0.6 * np.cos(3 * t)
        return [z[1], -(G * np.sin(z[0]) + 2 * growth * z[1]) / length]

    begin, t = [np.arcsin(0.6), 0.8 * 6.0 + 0.6 * 3.75], np.asarray(found.t)
    phi = solve_ivp(rates, (0, 3), begin, "DOP853", t, rtol=1e-12, atol=1e-12).y[0]
    wanted = (1 + 0.2 * np.sin(3 * t)) * np.sin(phi)
    np.testing.assert_allclose(found["x"], wanted, atol=2e-5)


class Sleigh(ac.Component):
    """A sleigh on a blade, which does not slip sideways: it turns at a constant rate, with a constant speed."""

    vx = ac.Variable(start=1.0)
    vy = ac.Variable()
    phi = ac.Variable(start=0.3, fixed=True)
    f = ac.Variable()

    def equations(self) -> Iterator[ac.Eq]:
        yield Eq(der(self.phi), 2)
        yield Eq(der(self.vx), -self.f * ac.sin(self.phi))
        yield Eq(der(self.vy), self.f * ac.cos(self.phi))
        yield Eq(self.vx * ac.sin(self.phi), self.vy * ac.cos(self.phi))


@pytest.mark.slow
def test_speeds_are_projected_alone_where_positions_are_free() -> None:
    system = ac.compile(Sleigh())
    assert system.states == ("vx", "vy", "phi")
    found = ac.simulate(system, 5.0, rtol=1e-8, atol=1e-10)
    speed = found["vx"] * np.cos(found["phi"]) + found["vy"] * np.sin(found["phi"])
    np.testing.assert_allclose(speed, 1 / np.cos(0.3), atol=1e-7)


def preferring() -> ac.Component:
    model = turning()
    model.modify(x=ac.Start(0.6, state="prefer"), v=ac.Start(0.0, state="prefer"))
    return model


def reset() -> Equations:
    """A point on a circle of which one speed jumps: it must be a state itself."""

    def stated(s: Equations) -> Iterator[ac.Eq | ac.When]:
        yield Eq(der(s.x), s.v)
        yield Eq(der(s.y), s.w)
        yield Eq(der(s.v), -s.f * s.x)
        yield Eq(der(s.w), -s.f * s.y - G)
        yield Eq(s.x**2 + s.y**2, 1)
        yield ac.When(s.x < 0, ac.Reinit(s.v, 0))

    model = Equations("x y v w f", stated)
    model.modify(x=ac.Start(0.6), y=ac.Start(-0.8))
    return model


@pytest.mark.parametrize("make", [preferring, reset])
def test_where_one_is_preferred_or_jumps_it_is_the_state(make: type[ac.Component]) -> None:
    assert ac.compile(make()).states == ("x", "v")


class Linkage(ac.Component):
    """A four-bar linkage that swings, stated from its rocker: the crank turns round, the rocker turns back."""

    def __init__(self, *, reverse: bool = False) -> None:
        super().__init__()
        self.ground, self.other = planar.Fixed(r=(1.0, 0.0)), planar.Fixed()
        self.joint = [planar.Revolute() for _ in range(4)]
        starts = ((2.2, 2.0), (0.9, None), (0.4, None))
        for joint, (phi, w) in zip(self.joint, starts, strict=False):
            joint.modify(phi=ac.Start(phi), **({} if w is None else {"w": ac.Start(w)}))
        self.rod = [planar.FixedTranslation(r=(length, 0.0)) for length in (0.8, 1.0, 0.4)]
        self.body = [planar.Body(m=1.0, I=0.02) for _ in self.rod]
        *links, last = self.joint
        end = chained(self, self.ground.frame, links, self.rod, self.body)
        first, second = (last.frame_b, last.frame_a) if reverse else (last.frame_a, last.frame_b)
        self.connect(end, first)
        self.connect(second, self.other.frame)


@pytest.mark.slow
@pytest.mark.parametrize("reverse", [False, True])
def test_a_linkage_that_is_stated_from_its_rocker_passes_dead_points(reverse: bool) -> None:
    system = ac.compile(Linkage(reverse=reverse))
    assert system.states == tuple(f"joint[{i}].{n}" for i in (1, 2, 3) for n in ("phi", "w"))
    found = ac.simulate(system, 4.0, rtol=1e-8, atol=1e-10)
    assert found["joint[1].w"][0] == pytest.approx(2.0, rel=1e-4)  # the only speed that is given
    energy = sum(
        0.5 * (found[f"body[{i}].v[1]"] ** 2 + found[f"body[{i}].v[2]"] ** 2)
        + 0.01 * found[f"body[{i}].w"] ** 2
        + G * found[f"body[{i}].r[2]"]
        for i in (1, 2, 3)
    )
    assert np.ptp(energy) < 1e-5 * np.max(np.abs(energy))
    assert np.ptp(found["body[3].phi"]) > 4 * np.pi
    assert np.ptp(found["body[1].phi"]) < np.pi
    gap = [found[f"joint[4].frame_{s}.{c}"] for c in "xy" for s in "ab"]
    np.testing.assert_allclose(gap[::2], gap[1::2], atol=1e-12)
