"""Model predictive control: the regulator of Riccati where there are no limits, and limits where there are."""

import re
from functools import cache

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are
from scipy.signal import cont2discrete

import acausal as ac
from acausal.components import translational as tl
from examples.following_arm import study
from examples.following_arm.model import ANGLE, LIMIT, MOTOR, Arm, Rubbing


class Cart(ac.Component):
    """A mass on a damper, pushed by two forces."""

    def __init__(self) -> None:
        super().__init__()
        self.mass, self.wall, self.damper = tl.Mass(m=2.0), tl.Fixed(), tl.Damper(d=1.0)
        self.push, self.wind = tl.Force(), tl.Force()
        self.connect(self.wall.flange, self.damper.flange_a)
        self.connect(self.damper.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.push.flange, self.wind.flange)


class Stopped(ac.Component):
    """A mass between stops, whose friction sticks."""

    def __init__(self, mass: ac.Component) -> None:
        super().__init__()
        self.mass, self.push = mass, tl.Force()
        self.connect(self.push.flange, self.mass.flange_a)


DT = 0.1


@cache
def cart() -> ac.System:
    return ac.compile(Cart())


@pytest.mark.parametrize("method", ["collocation", "rk4"])
def test_without_limits_it_is_the_regulator_of_riccati(method: str) -> None:
    A, B = np.array([[0.0, 1.0], [0.0, -0.5]]), np.array([[0.0], [0.5]])
    Ad, Bd, *_ = cont2discrete((A, B, np.eye(2), np.zeros((2, 1))), DT)
    Q, R = np.diag([3.0, 0.1]), np.array([[0.05]])
    P = solve_discrete_are(Ad, Bd, Q, R)
    K = np.linalg.solve(R + Bd.T @ P @ Bd, Bd.T @ P @ Ad)
    controller = ac.control.mpc(
        cart(), dt=DT, steps=60, track={"mass.s": 3.0, "mass.v": 0.1}, effort={"push.f": 0.05}, method=method
    )  # fmt: skip
    x = {"mass.s": 0.7, "mass.v": -0.2}
    plan = controller.step(x, inputs={"wind.f": 0.0})
    assert plan.solved
    assert plan.first["push.f"] == pytest.approx(-float((K @ [0.7, -0.2])[0]), rel=1e-4)
    again = controller.step(x, inputs={"wind.f": 0.0})
    assert again.first["push.f"] == pytest.approx(plan.first["push.f"], rel=1e-5)


def test_the_plant_has_the_parameters_of_the_controller_where_it_is_its_model() -> None:
    heavy = {"mass.m": 5.0}
    goals = {"track": {"mass.s": 1.0}, "effort": {"push.f": 1e-3}}
    controller = ac.control.mpc(cart(), dt=DT, steps=4, params=heavy, **goals)
    start = {"x0": {"mass.s": 1.0, "mass.v": 0.0}, "inputs": {"wind.f": 0.0}}
    same, heavier, own = (
        np.asarray(controller.run(cart(), 0.5, **start, **given)["mass.s"])
        for given in ({}, {"params": heavy}, {"params": {}})
    )
    np.testing.assert_array_equal(same, heavier)
    assert np.abs(same - own).max() > 1e-3


@pytest.mark.slow
def test_limits_hold_and_a_wind_that_is_known_is_met() -> None:
    controller = ac.control.mpc(
        cart(),
        dt=DT,
        steps=25,
        track={"mass.s": 1.0},
        effort={"push.f": 0.0},
        change={"push.f": 1e-4},
        limits={"push.f": (-4.0, 4.0), "mass.v": (-0.6, 0.6)},
    )
    wind = {"wind.f": lambda t: 1.5 if t > 1 else 0.0}
    record = controller.run(cart(), 5.0, x0={"mass.s": 1.0, "mass.v": 0.0}, inputs=wind)
    force, v, s = (np.asarray(record[n]) for n in ("push.f", "mass.v", "mass.s"))
    assert np.abs(force).max() <= 4.0 + 1e-6
    assert v.min() == pytest.approx(-0.6, abs=2e-3)  # as fast as it may
    assert abs(s[-1]) < 1e-3
    assert force[-1] == pytest.approx(-1.5, abs=2e-2)
    late = controller.step(
        {"mass.s": 0.0, "mass.v": 3.0}, inputs={"wind.f": np.zeros(25)}, before={"push.f": 0.0}
    )
    assert late.solved  # a limit that is left already
    assert late.first["push.f"] == pytest.approx(-4.0, abs=1e-5)


@pytest.mark.slow
def test_the_record_of_a_loop_can_be_simulated_again() -> None:
    system, start = cart(), {"mass.s": 1.0, "mass.v": 0.0}
    controller = ac.control.mpc(
        system, dt=0.2, steps=6, track={"mass.s": 1.0}, effort={"push.f": 1e-2}
    )
    record = controller.run(system, 0.9, x0=start, inputs={"wind.f": 0.5})
    np.testing.assert_allclose(record.time, 0.2 * np.arange(6))  # the first sample behind the end
    again = ac.simulate(system, 1.0, inputs=record, saveat=record.time, x0=start, rtol=1e-9)
    np.testing.assert_allclose(again["mass.s"], record["mass.s"], atol=1e-6)

    def breeze(t: float) -> float:
        return 2.0 * t

    idle = ac.control.mpc(system, dt=0.5, steps=4, track={"mass.s": 1.0}, effort={"push.f": 1e9})
    record = idle.run(system, 2.0, x0=start, inputs={"wind.f": breeze})
    blown = ac.simulate(system, 2.0, inputs={"push.f": 0.0, "wind.f": breeze}, x0=start, rtol=1e-9)
    assert record["mass.s"][-1] == pytest.approx(float(blown["mass.s"][-1]), abs=1e-4)


class Lagging(ac.Component):
    """An actuator with a lag that is short against the sample time, before a slow plant."""

    u = ac.Input(unit="1")
    z = ac.Variable(unit="1", start=0.0)
    p = ac.Variable(unit="1", start=0.0)
    lag = ac.Parameter(0.01, unit="s")
    rate = ac.Parameter(1.0, unit="1/s")

    def equations(self):
        yield ac.Eq(self.lag * ac.der(self.z), self.u - self.z)
        yield ac.Eq(ac.der(self.p), self.rate * (self.z - 0.5 * self.p))


def test_explicit_steps_follow_a_lag_that_is_short_against_the_sample_time() -> None:
    given = {"dt": 0.1, "steps": 10, "track": {"p": 1.0}, "effort": {"u": 1e-3}}
    start, system = {"p": 0.0, "z": 0.0}, ac.compile(Lagging())
    plans = [
        ac.control.mpc(system, method=m, limits={"u": (None, 5.0)}, **given)
        for m in ("collocation", "rk4")
    ]
    first = [plan.step(start, reference={"p": 1.0}).first["u"] for plan in plans]
    assert first == pytest.approx([5.0, 5.0], abs=1e-3)
    with pytest.raises(ac.DataError, match="method='rk4' is unstable within dt=1 s"):
        ac.control.mpc(system, method="rk4", **{**given, "dt": 1.0})


def test_a_stiff_model_needs_collocation() -> None:
    class Stiff(ac.Component):
        x, u = ac.Variable(start=1.0), ac.Input()

        def equations(self):
            yield ac.Eq(ac.der(self.x), -1000 * (self.x - self.u))

    system = ac.compile(Stiff())
    goals = {"track": {"x": 1.0}, "effort": {"u": 1e-3}}
    plan = ac.control.mpc(system, dt=DT, steps=5, **goals).step([1.0], reference={"x": 2.0})
    np.testing.assert_allclose(plan.states["x"][1:], 2.0 / (1 + 1e-3), rtol=1e-4)


@pytest.mark.filterwarnings("ignore:.* does not explain the record")  # as friction is not viscous
@pytest.mark.slow
def test_a_learned_friction_leads_the_arm_better_than_a_viscous_one() -> None:
    found = study.compared()
    assert found["learned"].rms < 0.004
    assert found["viscous"].rms > 4 * found["learned"].rms
    assert np.abs(found["learned"].record[MOTOR]).max() <= LIMIT + 1e-6


def test_what_does_not_fit_is_named() -> None:
    system = cart()
    good = {"dt": 0.1, "steps": 5, "track": {"mass.s": 1.0}, "effort": {"push.f": 0.0}}
    for wrong, *words in (
        ({"dt": 0}, "dt=0 is not a sample time"),
        ({"steps": 0}, "steps"),
        ({"track": {}}, "name what should follow a reference"),
        ({"track": {"mass.x": 1.0}}, "the model has no 'mass.x'"),
        ({"track": {"mass.s": -1.0}}, "-1.0 of 'mass.s' is not a weight"),
        ({"effort": {"mass.s": 1.0}}, "'mass.s' is no input that is decided"),
        ({"change": {"wind.f": 1.0}}, "'wind.f' is no input that is decided"),
        ({"limits": {"wind.f": (0, 1)}}, "'wind.f' is given, not decided"),
        ({"limits": {"push.f": (1, 0)}}, "(lowest, highest)"),
        ({"method": "heun"}, "there is no method 'heun'"),
        ({"terminal": -1.0}, "terminal=-1.0 is not a factor"),
    ):
        with pytest.raises(ac.AcausalError, match=re.escape(*words)):
            ac.control.mpc(system, **{**good, **wrong})
    stop = tl.MassWithStopAndFriction(
        m=1.0, L=1.0, smax=2.0, smin=-2.0, F_prop=1.0, F_Coulomb=5.0, F_Stribeck=10.0, fexp=2.0
    )
    with pytest.raises(ac.DataError, match="the model has events"):
        ac.control.mpc(ac.compile(Stopped(stop)), **{**good, "track": {"mass.s": 1.0}})
    controller = ac.control.mpc(system, **good)
    wind = {"wind.f": 0.0}
    for arguments, *words in (
        ({"x": [1.0]}, "are not the 2 states (mass.s, mass.v)"),
        ({"x": {"mass.s": 1.0}}, "x lacks 'mass.v'"),
        ({"x": [0, 0], "inputs": {}}, "inputs lacks 'wind.f'"),
        ({"x": [0, 0], "reference": {"mass.v": 1.0}}, "reference: 'mass.v' is none of them"),
        ({"x": [0, 0], "reference": {"mass.s": [1.0, 2.0]}}, "one for each of the 5 samples"),
    ):
        with pytest.raises(ac.DataError, match=re.escape(*words)):
            controller.step(**{"inputs": wind, **arguments})
    with pytest.raises(ac.DataError, match="until=0 is not a time"):
        controller.run(system, 0, inputs=wind)
    with pytest.raises(ac.DataError, match=r"'wind\.f' are neither numbers nor functions"):
        controller.run(system, 1.0, inputs={"wind.f": np.zeros(5)})
    with pytest.raises(ac.DataError, match="the plant has no"):
        controller.run(ac.compile(Arm(Rubbing())), 1.0, inputs=wind)
    assert ANGLE not in system.variables


class Stage(ac.Component):
    """A positioner of any size, with friction that grows."""

    size = ac.Parameter(1.0)
    f = ac.Input()
    s, v = ac.Variable(start=0.0), ac.Variable(start=0.0)

    def equations(self):
        yield ac.Eq(ac.der(self.s), self.v)
        yield ac.Eq(ac.der(self.v), (self.f - self.v - self.v**3 / self.size**2) / 2)


def test_a_plan_is_the_same_in_any_unit() -> None:
    """Micrometres in m, and pressures in Pa."""
    system, plans = ac.compile(Stage()), []
    for size in (1.0, 1e-6, 1e7):
        controller = ac.control.mpc(
            system, dt=0.1, steps=10, track={"s": 1.0}, effort={"f": 1e-4},
            limits={"f": (-4 * size, 4 * size), "v": (-0.6 * size, 0.6 * size)},
            params={"size": size},
        )  # fmt: skip
        controller.step({"s": 0.0, "v": 0.0})  # it is there already
        plan = controller.step({"s": size, "v": 0.0}, 0.1)
        assert plan.solved
        plans.append(np.concatenate([plan.inputs["f"], plan.states["s"], plan.states["v"]]) / size)
    np.testing.assert_allclose(plans[1:], [plans[0]] * 2, atol=1e-5)
    assert abs(plans[0][-10:]).max() < 0.601
