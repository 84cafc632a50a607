"""Planar mechanics: energy, balance of forces, loops, joints the other way round, what is drawn only."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import neural, planar, rotational as rot
from acausal.export.fmu_text.variables import shown_by_others
from acausal.training.build_problem import build_problem
from acausal.training.options import FitOptions
from examples.four_bar.model import FourBar as DrivenFourBar
from tests.support.exported_c import ExportedC
from tests.support.planar import chained

GRAVITY = 9.81


class FourBar(ac.Component):
    """A loop of three links on two fixed frames, whose crank turns round if it is fast enough; weights pull upward.

    Arguments:
        parts: in which order they are declared. reversed_joints: whether joints are connected the other way round.
    """

    LENGTHS = (0.4, 1.0, 0.8)

    def __init__(self, order: int = 1, *, reversed_joints: bool = False, d: float = 0.0) -> None:
        super().__init__()
        sign = -1 if reversed_joints else 1
        angles = (0.6, 0.2, 1.2)  # about where the loop closes
        makers: list[tuple[str, Any]] = [
            ("left", lambda: planar.Fixed()),
            ("right", lambda: planar.Fixed(r=(1.0, 0.0))),
            ("crank", lambda: planar.Revolute(
                useFlange=True, stateSelect="always",
                phi=ac.Start(sign * angles[0], fixed=True), w=ac.Start(0.0, fixed=True),
            )),
            ("first", lambda: planar.Revolute(phi=ac.Start(sign * (angles[1] - angles[0])))),
            ("second", lambda: planar.Revolute(phi=ac.Start(sign * (angles[2] - angles[1])))),
            ("rocker", lambda: planar.Revolute(phi=ac.Start(-sign * angles[2]))),
            ("damper", lambda: rot.Damper(d=d)),
            *((f"rod{i}", lambda n=length: planar.FixedTranslation(r=(n, 0.0)))
              for i, length in enumerate(self.LENGTHS)),
            *((f"body{i}", lambda: planar.Body(m=1.0, I=0.02, g=(0.0, GRAVITY))) for i in range(3)),
        ]  # fmt: skip
        for name, make in makers[::order]:
            setattr(self, name, make())
        rods = [self.rod0, self.rod1, self.rod2]
        ends = [self.left.frame, rods[0].frame_b, rods[1].frame_b, rods[2].frame_b]
        starts = [rods[0].frame_a, rods[1].frame_a, rods[2].frame_a, self.right.frame]
        joints = (self.crank, self.first, self.second, self.rocker)
        for joint, before, after in zip(joints, ends, starts, strict=True):
            first, second = ("frame_b", "frame_a") if reversed_joints else ("frame_a", "frame_b")
            self.connect(before, getattr(joint, first))
            self.connect(getattr(joint, second), after)
        for rod, body in zip(rods, (self.body0, self.body1, self.body2), strict=True):
            self.connect(rod.frame_b, body.frame_a)
        self.connect(self.crank.support, self.damper.flange_a)
        self.connect(self.damper.flange_b, self.crank.flange_a)


BODIES = ("body0", "body1", "body2")


def energy(found: ac.Solution) -> np.ndarray:
    """Of the bodies of a `FourBar`."""
    total = np.zeros(len(found.t))
    for body in BODIES:
        v_x, v_y, w, y = (
            np.asarray(found[f"{body}.{n}"]) for n in ("v[1]", "v[2]", "w", "frame_a.y")
        )
        total += (v_x**2 + v_y**2) / 2 + 0.02 * w**2 / 2 - GRAVITY * y
    return total


def gap(found: ac.Solution) -> np.ndarray:
    """How far the links of a `FourBar` are from closing, by their angles alone."""
    angles = [np.asarray(found[f"{body}.phi"]) for body in BODIES]
    links = zip(FourBar.LENGTHS, angles, strict=True)
    return np.abs(sum(n * np.exp(1j * phi) for n, phi in links) - 1.0)


def turns(found: ac.Solution) -> float:
    """How often the crank of a `FourBar` has turned."""
    return float(found["crank.phi"][-1] - found["crank.phi"][0]) / (2 * np.pi)


FAST: dict[str, Any] = {"x0": {"crank.w": 14.0}}
TIGHT: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-13, "solver": "dopri8"}


@pytest.fixture(scope="module")
def four_bar() -> tuple[ac.System, ac.Solution]:
    system = ac.compile(FourBar(d=0.0))
    return system, ac.simulate(system, 64.0, saveat=np.linspace(0.0, 64.0, 6401), **FAST, **TIGHT)


@pytest.mark.slow
def test_a_loop_keeps_its_assembly_and_its_energy_over_100_turns(
    four_bar: tuple[ac.System, ac.Solution],
) -> None:
    system, found = four_bar
    assert system.states == ("crank.phi", "crank.w", "rocker.phi", "body1.phi")
    assert turns(found) > 100
    assert np.ptp(energy(found)) < 1e-8
    assert gap(found).max() < 1e-9
    assert np.ptp(np.asarray(found["rocker.phi"])) < np.pi  # it goes to and fro
    guesses = np.stack([np.asarray(found[name]) for name in system.states[2:]], axis=1)
    np.testing.assert_allclose(np.asarray(found.x)[:, 2:], guesses, atol=1e-10)


@pytest.mark.slow
def test_exported_steps_of_a_loop_are_those_of_the_model(
    four_bar: tuple[ac.System, ac.Solution], tmp_path: Path
) -> None:
    system = four_bar[0]
    own = ac.simulate(system, 1.5, dt=0.01, solver="rk4", **FAST)
    assert turns(own) > 2
    assert np.ptp(energy(own)) < 0.01
    names = tuple(f"{body}.phi" for body in BODIES)
    assert shown_by_others(system, (*names, "crank.phi"), scalars=True) == ("crank.phi",)
    model = ExportedC(system, tmp_path, solver="rk4", derivatives=False, outputs=names)
    assert "guess(body1.phi)" in model.header
    model.x[1] = 14.0
    for k in range(len(own.t)):
        wanted = [float(own[name][k]) for name in names]
        np.testing.assert_allclose(model.outputs(), wanted, atol=1e-11)
        assert model.step(0.01) == 0


@pytest.mark.slow
def test_records_of_a_loop_need_none_of_the_angles_that_it_computes(
    four_bar: tuple[ac.System, ac.Solution],
) -> None:
    system, found = four_bar
    signals = {name: np.asarray(found[name])[:200] for name in ("crank.phi", "crank.w")}
    data = {"": ac.Data(found.t[:200], signals)}
    params, options = system.parameters(), FitOptions(modifiers=["body0.m"])
    states = build_problem(system, data, ("crank.w",), params, options).records.x
    np.testing.assert_allclose(np.asarray(states), np.asarray(found.x)[:200], atol=1e-9)


@pytest.mark.slow
def test_neither_the_order_nor_the_direction_of_joints_matters(
    four_bar: tuple[ac.System, ac.Solution],
) -> None:
    other = ac.compile(FourBar(order=-1, reversed_joints=True))
    again = ac.simulate(other, 1.0, dt=0.01, x0={"crank.w": -14.0}, **TIGHT)
    rows = np.searchsorted(four_bar[1].t, np.asarray(again.t) - 1e-6)
    for name in ("crank.phi", "rocker.phi"):
        turn = np.asarray(again[name]) + np.asarray(four_bar[1][name])[rows]
        np.testing.assert_allclose(np.mod(turn + 1.0, 2 * np.pi), 1.0, atol=1e-7)


@pytest.mark.machines
def test_a_gradient_goes_through_a_turning_loop(four_bar: tuple[ac.System, ac.Solution]) -> None:
    system = four_bar[0]

    @jax.jit
    def at_end(mass: Any, damping: Any) -> Any:
        params = {**system.parameters(), "body1.m": mass, "damper.d": damping}
        found = ac.simulate(system, 0.8, dt=0.01, params=params, solver="heun", **FAST)
        return found["crank.phi"][-1]

    at = (1.0, 0.01)
    assert float(at_end(*at)) > 2 * np.pi
    found = jax.grad(at_end, (0, 1))(*at)
    for i, exact in enumerate(found):
        step = [1e-5 * (k == i) for k in range(2)]
        above, below = (
            at_end(*(a + s * h for a, h in zip(at, step, strict=True))) for s in (1, -1)
        )
        assert float(exact) == pytest.approx(float(above - below) / 2e-5, rel=1e-6)


class Fold(ac.Component):
    """A position ``y`` that goes on only by a jump, where its cubic turns back."""

    x, y = ac.Variable(start=0.0, fixed=True), ac.Variable(start=-1.0)
    v = ac.Variable()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.x), 1.0)
        yield ac.Eq(self.y**3 - self.y, self.x)
        yield ac.Eq(self.v, ac.der(self.y))


@pytest.mark.slow
def test_another_solution_is_no_silent_result() -> None:
    system = ac.compile(Fold())

    def end(begin: Any) -> Any:
        return ac.simulate(system, 0.6, dt=0.02, solver="euler", x0={"x": begin})["x"][-1]

    with pytest.warns(UserWarning, match=r"'y' jumps .* there it is another one"):
        end(0.0)
    with pytest.warns(UserWarning, match=r"'y' jumps .* there it is another one"):
        assert jax.grad(end)(0.0) == 1.0


class Slider(ac.Component):
    """A crank moves a piston; the piston's way is a state.

    Arguments:
        end: the joint between rod and piston.
    """

    def __init__(self, end: planar.Revolute) -> None:
        super().__init__()
        self.wall, self.disc = planar.Fixed(), planar.Body(m=1.0, I=0.1, g=(0.0, 0.0))
        self.slide = planar.Prismatic(
            r=(1.0, 0.0),
            stateSelect="always",
            s=ac.Start(0.9, fixed=True),
            v=ac.Start(0.5, fixed=True),
        )
        self.drive, self.pin = (planar.Revolute(phi=ac.Start(phi)) for phi in (0.6, -1.0))
        self.end = end
        self.crank, self.rod = (planar.FixedTranslation(r=(length, 0.0)) for length in (0.3, 0.8))
        self.connect(self.wall.frame, self.drive.frame_a, self.slide.frame_a)
        self.connect(self.drive.frame_b, self.crank.frame_a, self.disc.frame_a)
        self.connect(self.crank.frame_b, self.pin.frame_a)
        self.connect(self.pin.frame_b, self.rod.frame_a)
        self.connect(self.rod.frame_b, self.end.frame_a)
        self.connect(self.end.frame_b, self.slide.frame_b)


@pytest.mark.slow
def test_a_dead_point_of_the_state_is_an_error_that_names_the_remedy() -> None:
    system = ac.compile(Slider(planar.Revolute(phi=ac.Start(0.4))))
    assert system.states[:2] == ("slide.s", "slide.v")
    with pytest.raises(ac.SimulationError, match=r"dead point of its states.*stateSelect"):
        ac.simulate(system, (0.0, 3.0), dt=0.01, solver="rk4")


class Cut(ac.Component):
    """A four-bar whose last joint may be cut, and whose crank turns."""

    def __init__(self, last: planar.Revolute) -> None:
        super().__init__()
        self.left, self.right = planar.Fixed(), planar.Fixed(r=(1.0, 0.0))
        self.joint = [planar.Revolute(phi=ac.Start(phi)) for phi in (0.6, 0.0, -2.3)]
        begin = ac.Start(0.6, fixed=True), ac.Start(14.0, fixed=True)
        self.joint[0].modify(stateSelect="always", phi=begin[0], w=begin[1])
        self.last = last
        self.rod = [planar.FixedTranslation(r=(length, 0.0)) for length in FourBar.LENGTHS]
        self.body = [planar.Body(m=1.0, I=0.02) for _ in self.rod]
        end = chained(self, self.left.frame, self.joint, self.rod, self.body)
        self.connect(end, self.last.frame_a)
        self.connect(self.last.frame_b, self.right.frame)


@pytest.mark.slow
def test_a_cut_joint_moves_as_the_closed_loop_does_and_does_not_drift() -> None:
    start = ac.Start(1.7)  # the assembly
    closed = ac.compile(Cut(planar.Revolute(phi=start)))
    cut = ac.compile(Cut(planar.CutRevolute(phi=start)))
    assert cut.states == tuple(f"joint[{i}].{n}" for i in (1, 2, 3) for n in ("phi", "w"))
    names = ("last.phi", "last.frame_a.fx", *(f"body[{i}].z" for i in (1, 2, 3)))
    assert not cut.program.iterates(cut.program.gather(cut.nodes_of(names)[0]).sources)
    at = np.linspace(0.0, 3.0, 61)
    one, other = (ac.simulate(s, 3.0, saveat=at, **TIGHT) for s in (closed, cut))
    assert float(one["joint[1].phi"][-1]) > 2 * 2 * np.pi
    assert np.abs(np.asarray(other[["last.gap[1]", "last.gap[2]"]])).max() < 1e-9
    for name in ("joint[1].phi", "joint[2].phi", "joint[3].phi", "last.phi"):
        np.testing.assert_allclose(other[name], one[name], atol=1e-9)
    np.testing.assert_allclose(other["last.frame_a.fx"], one["last.frame_a.fx"], atol=1e-6)


@pytest.mark.slow
def test_a_loop_with_a_cut_joint_passes_the_dead_points_of_its_parts() -> None:
    system = ac.compile(Slider(planar.CutRevolute(phi=ac.Start(0.4))))
    assert len(system.states) == 6
    found = ac.simulate(system, 5.0, saveat=np.linspace(0.0, 5.0, 501), **TIGHT)
    assert abs(float(found["drive.phi"][-1])) > 2 * np.pi
    assert float(np.min(found["slide.s"])) == pytest.approx(0.5, abs=1e-4)  # both arms in line
    assert float(np.max(found["slide.s"])) == pytest.approx(1.1, abs=1e-4)
    assert np.abs(np.asarray(found[["end.gap[1]", "end.gap[2]"]])).max() < 1e-9
    np.testing.assert_allclose(
        np.abs(np.asarray(found["disc.w"])), abs(found["disc.w"][0]), rtol=1e-8
    )


# -- world and files -------------------------------------------------------------------------------


def document(**world: Any) -> dict[str, Any]:
    """A body that falls, and one in a subsystem."""
    free: dict[str, Any] = {"class": "PlanarMechanics.Parts.Body", "with": {"m": 1.0, "I": 0.1}}
    drawn = {"sphereDiameter": "planarWorld.defaultBodyDiameter", "sphereColor": "{0,0,0}"}
    return {
        "model": "Falling",
        "components": {
            "body": {**free, "with": {**free["with"], **drawn}},
            "inner": {"components": {"body": free, "own": free}},
            "planarWorld": {"class": "PlanarMechanics.PlanarWorld", "with": world},
        },
    }


def loaded(folder: Path, content: dict[str, Any]) -> ac.Component:
    (folder / "model.json").write_text(json.dumps(content), encoding="utf-8")
    return ac.load(folder / "model.json")


def test_bodies_of_a_file_take_the_gravity_of_the_world_around_them(tmp_path: Path) -> None:
    content = document(constantGravity="{1, -3}")
    inner = content["components"]["inner"]["components"]
    inner["own"] = {**inner["own"], "with": {"m": 1.0, "I": 0.1, "g": [0, -1]}}
    model = loaded(tmp_path, content)
    ac.save(model, tmp_path / "again.json")
    for read in (model, ac.load(tmp_path / "again.json")):
        system = ac.compile(read)
        params = system.parameters()
        x = np.zeros(18)
        fallen = [system.observe(f"{n}.a[2]", 0.0, x, None, params) for n in ("body", "inner.body")]
        np.testing.assert_allclose(fallen, -3.0)
        assert system.observe("inner.own.a[2]", 0.0, x, None, params) == pytest.approx(-1.0)


def test_a_file_is_told_of_a_modifier_that_is_nothing(tmp_path: Path) -> None:
    content = document()
    content["components"]["body"]["with"]["sphereDiametre"] = 0.1
    with pytest.raises(ac.ModelError, match="sphereDiametre"):
        loaded(tmp_path, content)


# -- sensors and sources -------------------------------------------------------------------------------


class Measured(ac.Component):
    """A free body, and all that measures it against a frame that is turned and away."""

    def __init__(self) -> None:
        super().__init__()
        self.body = planar.Body(m=2.0, I=0.5, g=(0.0, 0.0))
        self.wall = planar.Fixed(r=(1.0, 2.0), phi=0.5)
        self.push = planar.WorldForce(resolveInFrame="frame_b")
        self.place = planar.AbsolutePosition(resolveInFrame="frame_resolve")
        self.speed = planar.AbsoluteVelocity()
        self.acceleration = planar.AbsoluteAcceleration(resolveInFrame="world")
        self.seen = planar.RelativeVelocity(resolveInFrame="frame_b")
        self.distance = planar.Distance()
        self.cut = planar.CutForceAndTorque(resolveInFrame="world", positiveSign=False)
        self.power = planar.Power()
        self.connect(self.push.frame_b, self.power.frame_a)
        self.connect(self.power.frame_b, self.cut.frame_a)
        self.connect(self.cut.frame_b, self.body.frame_a)
        for sensor in (self.place, self.speed, self.acceleration):
            self.connect(sensor.frame_a, self.body.frame_a)
        self.connect(self.place.frame_resolve, self.wall.frame)
        for sensor in (self.seen, self.distance):
            self.connect(sensor.frame_a, self.wall.frame)
            self.connect(sensor.frame_b, self.body.frame_a)


def test_sensors_show_the_motion_along_the_axes_of_their_frames() -> None:
    system = ac.compile(Measured())
    state: dict[str, float] = {
        "r[1]": 3.0,
        "r[2]": 4.0,
        "v[1]": 1.0,
        "v[2]": -2.0,
        "phi": 0.7,
        "w": 0.3,
    }
    x = np.array([state[name.removeprefix("body.")] for name in system.states])
    u = {"push.force[1]": 6.0, "push.force[2]": 1.0, "push.force[3]": 0.2}
    forces = np.array([u[name] for name in system.inputs])

    def found(name: str) -> float:
        return float(system.observe(name, 0.0, x, forces, system.parameters()))

    def turned(angle: float, x: float, y: float) -> np.ndarray:
        c, s = np.cos(angle), np.sin(angle)
        return np.array([c * x - s * y, s * x + c * y])

    def vector(name: str) -> np.ndarray:
        return np.array([found(f"{name}[{i + 1}]") for i in range(2)])

    force = turned(0.7, 6.0, 1.0)
    np.testing.assert_allclose(vector("acceleration.a"), force / 2.0)
    np.testing.assert_allclose(vector("cut.force"), -force)
    assert found("cut.torque") == pytest.approx(-0.2)
    np.testing.assert_allclose(vector("place.r"), turned(-0.5, 3.0, 4.0))
    assert found("place.r[3]") == pytest.approx(0.2)
    for name in ("speed.v", "seen.v_rel"):
        np.testing.assert_allclose(vector(name), turned(-0.7, 1.0, -2.0))
        assert found(f"{name}[3]") == pytest.approx(0.3)
    assert found("distance.distance") == pytest.approx(np.hypot(2.0, 2.0))
    assert found("power.power") == pytest.approx(force @ [1.0, -2.0] + 0.2 * 0.3)


# -- neural elements -------------------------------------------------------------------------------


def mounted() -> ac.Component:
    """A body in a bushing whose wall is turned."""
    model = ac.Component()
    model.wall = planar.Fixed(phi=0.3)
    model.bushing = neural.Bushing(
        passive=True, convex=True, width=4, depth=1, input_scale=[0.1, 0.1, 0.1], output_scale=50.0
    )
    model.body = planar.Body(m=1.0, I=0.1, g=(0.0, 0.0))
    model.connect(model.wall.frame, model.bushing.frame_a)
    model.connect(model.bushing.frame_b, model.body.frame_a)
    return model


def test_a_bushing_gives_back_no_more_than_it_took_less_what_it_lost() -> None:
    system = ac.compile(mounted())
    params = system.parameters(3)
    x = jax.random.normal(jax.random.key(0), (6,))

    def stored(x: Any) -> Any:
        return system.observe("bushing.E", 0.0, x, np.zeros(0), params) + kinetic(x)

    def kinetic(x: Any) -> Any:
        at = {name.removeprefix("body."): x[i] for i, name in enumerate(system.states)}
        return (at["v[1]"] ** 2 + at["v[2]"] ** 2) / 2 + 0.1 * at["w"] ** 2 / 2

    rate = jax.grad(stored)(x) @ system.vector_field(0.0, x, np.zeros(0), params)
    lost = system.observe("bushing.lossPower", 0.0, x, np.zeros(0), params)
    assert lost > 0
    assert float(rate) == pytest.approx(-float(lost), rel=1e-9)


def test_equations_of_a_linkage_are_left_implicit_where_nobody_could_read_them() -> None:
    equations = ac.compile(DrivenFourBar()).equations
    assert sum(equation.rhs == 0 for equation in equations) >= 6
    assert max(equation.count_ops() for equation in equations) < 400


class SliderCrank(ac.Component):
    """A crank of 0.3 m that drives a slider by a rod of 1 m."""

    def __init__(self, crank: str, others: str, s: float):
        super().__init__()
        self.ground, self.rails = planar.Fixed(), planar.Fixed()
        self.crank = planar.Revolute(
            phi=ac.Start(0.3, fixed=True), w=ac.Start(8.0, fixed=True), stateSelect=crank
        )
        self.short, self.long = (
            planar.FixedTranslation(r=(0.3, 0)),
            planar.FixedTranslation(r=(1, 0)),
        )
        self.pin, self.wrist = (
            planar.Revolute(stateSelect=others),
            planar.Revolute(stateSelect=others),
        )
        self.slide = planar.Prismatic(r=(1.0, 0.0), stateSelect=others, s=ac.Start(s))
        self.wheel, self.slider = planar.Body(m=1.0, I=0.2), planar.Body(m=2.0, I=0.01)
        self.connect(self.ground.frame, self.crank.frame_a)
        self.connect(self.crank.frame_b, self.short.frame_a, self.wheel.frame_a)
        self.connect(self.short.frame_b, self.pin.frame_a)
        self.connect(self.pin.frame_b, self.long.frame_a)
        self.connect(self.long.frame_b, self.wrist.frame_a)
        self.connect(self.wrist.frame_b, self.slide.frame_b, self.slider.frame_a)
        self.connect(self.rails.frame, self.slide.frame_a)


@pytest.mark.parametrize(("crank", "others"), [("always", "never"), ("prefer", "default")])
@pytest.mark.parametrize("s", [1.28, 1.0])
def test_a_preferred_or_fixed_crank_is_the_state(crank, others, s):
    assert ac.compile(SliderCrank(crank, others, s)).states[:2] == ("crank.phi", "crank.w")


@pytest.mark.slow
def test_a_crank_passes_its_dead_points():
    run = ac.simulate(ac.compile(SliderCrank("always", "never", 1.28)), 1.0)
    energy = 0.1 * run["crank.w"] ** 2 + run["slide.v"] ** 2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-5)
    assert float(run["crank.phi"][-1]) == pytest.approx(7.3628, abs=1e-3)


@pytest.mark.parametrize("name", ["planarWorld", "world"])
def test_the_gravity_of_a_world_acts_on_all_bodies_around_it(name: str, tmp_path: Path) -> None:
    class Moon(ac.Component):
        """A body, one within a part, and one with a gravity of its own."""

        def __init__(self) -> None:
            super().__init__()
            setattr(self, name, planar.PlanarWorld(constantGravity=[0.0, -1.62]))
            self.body = planar.Body(m=1.0, I=1.0)
            self.lift = Lift()
            self.light = planar.Body(m=1.0, I=1.0, g=[0.0, 0.0])

    moon = Moon()
    ac.save(moon, tmp_path / "moon.json")
    for model in (moon, ac.load(tmp_path / "moon.json")):
        run = ac.simulate(ac.compile(model), 1.0, dt=0.5)
        ends = [float(run[f"{n}.r[2]"][-1]) for n in ("body", "lift.body", "light")]
        assert ends == pytest.approx([-0.81, -0.81, 0.0], abs=1e-9)


class Lift(ac.Component):
    """A part with a body in it."""

    def __init__(self) -> None:
        super().__init__()
        self.body = planar.Body(m=2.0, I=1.0)
