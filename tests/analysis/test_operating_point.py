"""Operating points: where a model rests."""

from collections.abc import Iterator

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical as el, rotational as rot, translational as tl
from tests.support.parts import model


class Motor(ac.Component):
    """A motor with friction and a load."""

    def __init__(self) -> None:
        super().__init__()
        self.source, self.ground = el.SignalVoltage(), el.Ground()
        self.r, self.l = el.Resistor(R=2.0), el.Inductor(L=1e-3)
        self.emf = el.RotationalEMF(k=0.5)
        self.rotor, self.friction = rot.Inertia(J=1e-2), rot.Damper(d=0.1)
        self.housing, self.load = rot.Fixed(), rot.Torque()
        self.connect(self.source.p, self.r.p)
        self.connect(self.r.n, self.l.p)
        self.connect(self.l.n, self.emf.p)
        self.connect(self.emf.n, self.source.n, self.ground.p)
        self.connect(self.emf.flange, self.rotor.flange_a, self.friction.flange_a)
        self.connect(self.friction.flange_b, self.housing.flange)
        self.connect(self.rotor.flange_b, self.load.flange)


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Motor())


RUNNING = ("l.i", "rotor.w")


def test_a_motor_turns_while_its_current_and_speed_rest(system: ac.System) -> None:
    inputs = {"source.v": 12.0, "load.tau": lambda t: -0.1 * t}
    point = ac.operating_point(system, inputs=inputs, steady=RUNNING, t=1.0)
    w = (0.5 * 12.0 / 2.0 - 0.1) / (0.1 + 0.5**2 / 2.0)
    assert float(point["rotor.w"]) == pytest.approx(w)
    assert float(point["l.i"]) == pytest.approx((12.0 - 0.5 * w) / 2.0)
    assert point.to_dict(["r.v"]) == {"r.v": pytest.approx(12.0 - 0.5 * w)}
    np.testing.assert_allclose(point[["source.v", "load.tau"]], [12.0, -0.1])
    assert point.unit("rotor.w") == "rad/s"
    assert "rotor.w" in point
    assert "12 V" in repr(point)


def test_without_inputs_it_stands_still(system: ac.System) -> None:
    point = ac.operating_point(system)
    np.testing.assert_allclose(point.x, 0.0, atol=1e-12)


def test_other_parameters_have_another_point(system: ac.System) -> None:
    params = {**system.parameters(), "r.R": 1.0}
    inputs = {"source.v": 12.0}
    point = ac.operating_point(system, inputs=inputs, params=params, steady=RUNNING)
    assert float(point["rotor.w"]) == pytest.approx(6.0 / (0.1 + 0.25))
    linear = ac.linearize(system, point, outputs=["rotor.w"])
    assert float(linear.A[system.states.index("l.i"), system.states.index("l.i")]) == -1000.0


@pytest.mark.slow
def test_a_point_that_does_not_exist_is_told(system: ac.System) -> None:
    with pytest.raises(ac.InitializationError):
        ac.operating_point(system, inputs={"source.v": 12.0})
    with pytest.raises(ac.DataError, match=r"inputs: 'source\.w' is not an input; did you mean"):
        ac.operating_point(system, inputs={"source.w": 12.0})
    with pytest.raises(ac.DataError, match=r"The model has no variable 'rotor\.q'"):
        _ = ac.operating_point(system)["rotor.q"]


def test_a_simulation_can_start_at_rest(system: ac.System) -> None:
    run = ac.simulate(system, 0.1, dt=0.01, inputs={"source.v": 0.0, "load.tau": 0.0}, x0="steady")
    np.testing.assert_allclose(run["rotor.w"], 0.0, atol=1e-12)


class Lag(ac.Component):
    """A lag whose start is fixed."""

    k = ac.Parameter(0.7)
    u = ac.Input()
    x = ac.Variable(start=0.3, fixed=True)

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.u - self.k * self.x)


def test_a_fixed_start_must_be_one_of_rest() -> None:
    system = ac.compile(Lag())
    assert float(ac.operating_point(system, inputs={"u": 0.21})["x"]) == 0.3
    assert float(ac.operating_point(system, inputs={"u": 1.0}, x0={"x": 0.5})["x"]) == 0.5
    told = r"not met: 'der\(x\) = 0 by 0.79'.*does not rest at the fixed 'x': .*\(fixed=False\), or name"
    with pytest.raises(ac.InitializationError, match=told):
        ac.operating_point(system, inputs={"u": 1.0})
    with pytest.raises(ac.InitializationError, match="does not rest at the fixed 'x'"):
        ac.simulate(system, 1.0, dt=0.1, inputs={"u": 1.0}, x0="steady")
    t = np.linspace(0.0, 1.0, 11)
    record = ac.Data(t, {"u": np.ones(11), "x": np.full(11, 1 / 0.7)})
    for data in (record, {"first": record, "second": record}):
        with pytest.raises(ac.InitializationError, match="does not rest at the fixed 'x'"):
            ac.fit(system, data, "x", modifiers=["k"], x0="steady", progress=False)


class Relay(ac.Component):
    """A lag that a relay behind another lag draws down: at rest it has switched, or there is no rest."""

    u = ac.Input()
    x, y = ac.Variable(), ac.Variable()
    on = ac.Discrete(kind="bool")

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.u - self.x - 2 * self.on)
        yield ac.Eq(ac.der(self.y), self.x - self.y)
        yield ac.Eq(self.on, self.y > 1)


@pytest.mark.slow
def test_a_model_with_events_rests_with_the_modes_that_belong_to_its_rest():
    system, inputs = ac.compile(Relay()), {"u": 4.0}
    point = ac.operating_point(system, inputs=inputs)
    run = ac.simulate(system, 1.0, inputs=inputs, x0="steady")
    np.testing.assert_allclose(point[["x", "y"]], [2, 2], rtol=1e-12)
    np.testing.assert_allclose(run.x, [[2, 2]] * len(run.t), rtol=1e-9)
    by_u = jax.jacobian(lambda u: system.initial_state(x0="steady", inputs={"u": u}))(4.0)
    np.testing.assert_allclose(by_u, [1, 1], rtol=1e-12)


@pytest.mark.slow
def test_a_model_whose_modes_contradict_its_rest_is_refused():
    system, inputs = ac.compile(Relay()), {"u": 2.0}
    for rest in (
        lambda: ac.operating_point(system, inputs=inputs),
        lambda: ac.simulate(system, 1.0, inputs=inputs, x0="steady"),
    ):
        with pytest.raises(ac.InitializationError, match=r"no discrete variables agree .* 'on'"):
            rest()


@pytest.mark.slow
def test_a_transistor_comes_to_rest_where_newton_alone_does_not_find_it() -> None:
    made = model(
        "supply.p - above.p", "supply.p - collector.p", "above.n - below.p", "above.n - T.B",
        "collector.n - T.C", "T.E - emitter.p", "supply.n - below.n", "supply.n - emitter.n",
        "supply.n - ground.p",
        supply=el.ConstantVoltage(V=12.0), above=el.Resistor(R=47e3), below=el.Resistor(R=10e3),
        collector=el.Resistor(R=4.7e3), emitter=el.Resistor(R=1e3), T=el.NPN(), ground=el.Ground(),
    )  # fmt: skip
    system = ac.compile(made)
    point, run = ac.operating_point(system), ac.simulate(system, 1e-3)
    assert point["T.C.v"] == pytest.approx(float(run["T.C.v"][-1]), abs=1e-5)
    assert point["T.B.v"] == pytest.approx(1.93375, abs=1e-5)


class Integrating(ac.Component):
    """A store without an outlet."""

    u = ac.Input()
    x = ac.Variable()

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.u)


def test_a_model_without_rest_is_told_so() -> None:
    told = r"no rest was found near the start; where the search ended: 'der\(x\) = 0 by 2'\. Does"
    with pytest.raises(ac.InitializationError, match=told):
        ac.operating_point(ac.compile(Integrating()), inputs={"u": 2.0})


class Branches(ac.Component):
    """Two branches, each with a rest of its own, or only the upper one."""

    low = ac.Parameter(-5.0)
    x = ac.Variable(start=2.0)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.x), ac.where(self.x > 1, 3 - self.x, self.low, events=True))


@pytest.mark.parametrize("low", [1.0, -5.0])
def test_the_rest_is_looked_for_in_the_branch_of_the_start(low: float) -> None:
    system = ac.compile(Branches(low=low))
    point = ac.operating_point(system)
    assert float(point["x"]) == pytest.approx(3, rel=1e-12)
    np.testing.assert_allclose(ac.linearize(system, point).A, [[-1]])
    np.testing.assert_allclose(system.vector_field(0.0, [2.0], None, system.parameters()), [1])
    np.testing.assert_allclose(system.vector_field(0.0, [0.5], None, system.parameters()), [low])


@pytest.mark.slow
def test_a_friction_that_yields_is_no_rest() -> None:
    class Pushed(ac.Component):
        """A mass on a rough floor and a spring, pushed by more than the floor holds."""

        def __init__(self) -> None:
            super().__init__()
            self.push, self.mass = tl.ConstantForce(f_constant=30.0), tl.Mass(m=2.0)
            self.floor, self.spring = (
                tl.SupportFriction(f_pos=[[0.0, 4.0], [1.0, 5.0]]),
                tl.Spring(c=100.0),
            )
            self.wall = tl.Fixed()
            self.connect(self.push.flange, self.mass.flange_a)
            self.connect(self.mass.flange_b, self.floor.flange_a)
            self.connect(self.floor.flange_b, self.spring.flange_a)
            self.connect(self.spring.flange_b, self.wall.flange)

    with pytest.raises(
        ac.InitializationError, match=r"conditions change, .* and 'mass\.v' moves by 13 m/s"
    ):
        ac.operating_point(ac.compile(Pushed()))
