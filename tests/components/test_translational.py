"""Translational mechanics: MSL's names and defaults, laws at points, and a bench of motions."""

import inspect
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.special import expit

import acausal as ac
from acausal.components import rotational, translational as tl
from acausal.components.thermal import HeatPort
from acausal.flattening.flat_model import flatten

# Parameters and options with their defaults, as in MSL 4.1.0 (`...` marks those without a default).
DEFAULTS: dict[str, dict[str, Any]] = {
    "Fixed": {"s0": 0},
    "Mass": {"m": ..., "L": 0},
    "Rod": {"L": 0},
    "Spring": {"c": ..., "s_rel0": 0},
    "Damper": {"d": ..., "useHeatPort": False, "s_nominal": 1e-4},
    "SpringDamper": {"c": ..., "d": ..., "s_rel0": 0, "useHeatPort": False, "s_nominal": 1e-4},
    "ElastoGap": {"c": ..., "d": ..., "s_rel0": 0, "n": 1, "useHeatPort": False},
    "SupportFriction": {
        "f_pos": [[0, 1]], "peak": 1, "v_small": 1e-3, "useSupport": False, "useHeatPort": False,
        "smoothness": "LinearSegments",
    },
    "Brake": {
        "mu_pos": [[0, 0.5]], "peak": 1, "cgeo": 1, "fn_max": ..., "v_small": 1e-3,
        "useSupport": False, "useHeatPort": False, "smoothness": "LinearSegments",
    },
    "IdealGear": {"ratio": ..., "useSupport": False},
    "IdealGearR2T": {"ratio": ..., "useSupportR": False, "useSupportT": False},
    "IdealRollingWheel": {"radius": ..., "useSupportR": False, "useSupportT": False},
    "Vehicle": {
        "m": ..., "g": 9.80665, "J": ..., "R": ..., "A": ..., "Cd": ..., "rho": 1.2, "useWindInput": False,
        "vWindConstant": 0, "useCrInput": False, "CrConstant": 0.015, "vReg": 1e-3,
        "useInclinationInput": False, "inclinationConstant": 0,
    },
    "RollingResistance": {
        "fWeight": ..., "useCrInput": False, "CrConstant": 0.01, "useInclinationInput": False,
        "inclinationConstant": 0, "reg": "Exp", "v0": 0.1, "useSupport": False,
    },
    "InitializeFlange": {
        "use_s_start": True, "use_v_start": True, "use_a_start": True, "stateSelect": "default",
    },
    "MassWithStopAndFriction": {
        "m": ..., "L": 0, "smax": ..., "smin": ..., "v_small": 1e-3, "F_prop": ...,
        "F_Coulomb": ..., "F_Stribeck": ..., "fexp": ..., "useHeatPort": False,
    },
    "RelativeStates": {},
    "GeneralForceToPositionAdaptor": {"use_pder": True, "use_pder2": True},
    "GeneralPositionToForceAdaptor": {"use_pder": True, "use_pder2": True},
    "PositionSensor": {},
    "SpeedSensor": {},
    "AccSensor": {},
    "RelPositionSensor": {},
    "RelSpeedSensor": {},
    "RelAccSensor": {},
    "ForceSensor": {},
    "PowerSensor": {},
    "MultiSensor": {},
    "Position": {"exact": False, "f_crit": 50, "useSupport": False},
    "Speed": {"exact": False, "f_crit": 50, "useSupport": False},
    "Accelerate": {"useSupport": False},
    "Move": {"useSupport": False},
    "Force": {"useSupport": False},
    "Force2": {},
    "InverseSpeedDependentForce": {
        "f_nominal": ..., "ForceDirection": True, "v_nominal": ..., "v0": ..., "useSupport": False,
    },
    "LinearSpeedDependentForce": {
        "f_nominal": ..., "ForceDirection": True, "v_nominal": ..., "useSupport": False,
    },
    "QuadraticSpeedDependentForce": {
        "f_nominal": ..., "ForceDirection": True, "v_nominal": ..., "useSupport": False,
    },
    "ConstantForce": {"f_constant": ..., "useSupport": False},
    "SignForce": {"f_nominal": ..., "reg": "Exp", "v0": ..., "useSupport": False},
    "ConstantSpeed": {"v_fixed": ..., "useSupport": False},
    "ForceStep": {"stepForce": ..., "offsetForce": ..., "startTime": 0, "useSupport": False},
    "EddyCurrentForce": {
        "useExcitationInput": False, "constantExcitation": 1, "f_nominal": ..., "v_nominal": ...,
        "TRef": ..., "alpha20": ...,
        "T": 293.15, "useHeatPort": False, "useSupport": False,
    },
}  # fmt: skip


def minimal(cls):
    """An instance with the value 1 for all that must be given."""
    needed = {
        name: 1.0
        for name, d in cls._declared.items()
        if isinstance(d, ac.Parameter) and d.default is None
    }
    return cls(**needed)


class Ambient(ac.Component):
    """A heat port at a fixed temperature."""

    port = HeatPort()

    def equations(self):
        yield ac.Eq(self.port.T, 293.15)


# -- declarations ------------------------------------------------------------------------------------


def test_every_class_is_documented_and_in_the_table():
    for name in set(tl.__all__) - {"utilities"}:
        cls = getattr(tl, name)
        assert inspect.getdoc(cls), name
        concrete = issubclass(cls, ac.Component) and not name.startswith("Partial")
        assert concrete == (name in DEFAULTS), name


@pytest.mark.parametrize("name", DEFAULTS)
def test_names_and_defaults_are_those_of_the_standard_library(name):
    cls = getattr(tl, name)
    for key, default in DEFAULTS[name].items():
        declared = cls._declared[key].default
        if default is ...:
            assert declared is None, key
        else:
            assert np.array_equal(declared, default), key


@pytest.mark.parametrize("name", DEFAULTS)
def test_every_class_has_as_many_equations_as_unknowns(name):
    model = flatten(minimal(getattr(tl, name)))
    assert model.n_equations == model.n_variables - len(model.inputs) - len(model.discrete)


@pytest.mark.parametrize(
    "component",
    [
        tl.Force(useSupport=True),
        tl.Position(useSupport=True, exact=True),
        tl.IdealGear(ratio=2, useSupport=True),
        tl.SupportFriction(useSupport=True),
        tl.RollingResistance(fWeight=1, useCrInput=True, useInclinationInput=True),
        tl.Vehicle(
            m=1, J=1, R=1, A=1, Cd=1, useWindInput=True, useCrInput=True, useInclinationInput=True
        ),
        tl.InitializeFlange(use_a_start=False),
        tl.GeneralForceToPositionAdaptor(use_pder2=False),
        tl.GeneralForceToPositionAdaptor(use_pder=False),
        tl.GeneralPositionToForceAdaptor(use_pder=False),
        tl.EddyCurrentForce(
            f_nominal=1, v_nominal=1, TRef=293.15, alpha20=0.004, useExcitationInput=True
        ),
    ],
    ids=repr,
)
def test_options_keep_the_balance(component):
    model = flatten(component)
    assert model.n_equations == model.n_variables - len(model.inputs) - len(model.discrete)


def test_state_preferences_follow_options_and_starts():
    class Pair(ac.Component):
        def __init__(self):
            super().__init__()
            self.mass = tl.Mass(m=1, s=ac.Start(0.1, fixed=True))
            self.avoided = tl.Mass(m=1, stateSelect="avoid", s=ac.Start(state="always"))
            self.spring = tl.SpringDamper(c=1, d=1)
            self.wanted = tl.SpringDamper(c=1, d=1, stateSelect="prefer")

    model = flatten(Pair())
    rank = {model.layout.variable(i): r for i, r in enumerate(model.state)}
    assert (rank["mass.s"], rank["mass.v"], rank["mass.a"]) == (3, 3, 2)
    assert (rank["avoided.s"], rank["avoided.v"]) == (4.5, 1.5)
    assert rank["spring.s_rel"] == 2
    assert rank["wanted.s_rel"] == rank["wanted.v_rel"] == 3.5
    index = model.layout.find_variable("mass.s")
    assert (model.start[index], model.fixed[index]) == (0.1, True)


def test_starts_given_one_after_the_other_add_up():
    mass = tl.Mass(m=1, s=ac.Start(0.1, state="always"))
    mass.modify(s=ac.Start(fixed=True))
    mass.modify(s=ac.Start(0.2))
    assert mass._node.modifiers["s"] == ac.Start(0.2, fixed=True, state="always")


def test_a_missing_parameter_is_named():
    with pytest.raises(ac.DeclarationError, match="'c'; give it where the component is made"):
        flatten(tl.Spring())


def test_an_option_outside_of_its_choices_is_refused():
    with pytest.raises(ac.DeclarationError, match="reg='Cubic' must be one of 'Exp'"):
        tl.SignForce(f_nominal=1, v0=1, reg="Cubic")


# -- laws at points ----------------------------------------------------------------------------------

SPEEDS = (-3.0, -0.05, 0.0, 0.02, 3.0)


class Laws(ac.Component):
    """Force elements, each at a flange of its own that moves with the input speed."""

    def __init__(self, **elements):
        super().__init__()
        self.drive = tl.Speed(exact=True)
        for name, element in elements.items():
            setattr(self, name, element)
            for end in ("flange", "flange_a"):
                if hasattr(type(element), end):
                    self.connect(self.drive.flange, getattr(element, end))


@pytest.fixture(scope="module")
def laws():
    elements = {
        "linear": tl.LinearSpeedDependentForce(f_nominal=-6, v_nominal=2, ForceDirection=False),
        "linear_one_way": tl.LinearSpeedDependentForce(f_nominal=-6, v_nominal=2),
        "quadratic": tl.QuadraticSpeedDependentForce(
            f_nominal=-6, v_nominal=2, ForceDirection=False
        ),
        "quadratic_one_way": tl.QuadraticSpeedDependentForce(f_nominal=-6, v_nominal=2),
        "inverse": tl.InverseSpeedDependentForce(
            f_nominal=-6, v_nominal=2, v0=0.1, ForceDirection=False
        ),
        "inverse_one_way": tl.InverseSpeedDependentForce(f_nominal=-6, v_nominal=2, v0=0.1),
        "sign_exp": tl.SignForce(f_nominal=-6, v0=0.1),
        "sign_sine": tl.SignForce(f_nominal=-6, v0=0.1, reg="Sine"),
        "sign_linear": tl.SignForce(f_nominal=-6, v0=0.1, reg="Linear"),
        "sign_cosine": tl.SignForce(f_nominal=-6, v0=0.1, reg="CoSine"),
        "eddy": tl.EddyCurrentForce(f_nominal=6, v_nominal=2, TRef=293.15, alpha20=0.004, T=343.15),
        "rolling": tl.RollingResistance(fWeight=600, inclinationConstant=0.75, reg="Linear"),
        "constant": tl.ConstantForce(f_constant=6),
        "step": tl.ForceStep(stepForce=2, offsetForce=1, startTime=1),
        "friction": tl.SupportFriction(f_pos=[[0, 5], [1, 7], [2, 7]], peak=1.2, smooth=True),
        "damper": tl.Damper(d=4),
        "gap": tl.ElastoGap(c=100, d=30, s_rel0=0.5, n=2),
    }
    model: Any = Laws(**elements)
    model.ground = tl.Fixed()
    model.connect(model.damper.flange_b, model.gap.flange_b, model.ground.flange)
    system = ac.compile(model)
    params = system.parameters()
    names = [f"{name}.f" for name in elements] + ["eddy.lossPower", "damper.lossPower"]

    @jax.jit
    def observe(v, s, t):
        return system.observe(names, t, jnp.stack([s]), jnp.full(len(system.inputs), v), params)

    def force(v, s=0.0, t=0.0):
        values = np.asarray(observe(float(v), float(s), float(t)))
        return dict(zip((n.removesuffix(".f") for n in names), values, strict=True))

    assert system.states == ("drive.s",)
    return force


@pytest.mark.parametrize("v", SPEEDS)
def test_speed_dependent_forces(laws, v):
    f, r = laws(v), v / 2
    assert f["linear"] == pytest.approx(6 * r)
    assert f["linear_one_way"] == pytest.approx(6 * abs(r))
    assert f["quadratic"] == pytest.approx(6 * r * abs(r))
    assert f["quadratic_one_way"] == pytest.approx(6 * r**2)
    assert f["inverse"] == pytest.approx(6 * v / 0.1 if abs(v) < 0.1 else 6 / r)
    assert f["inverse_one_way"] == pytest.approx(12 / max(abs(v), 0.1))
    assert f["damper"] == pytest.approx(-4 * v)  # flange_a moves: v_rel = -v
    assert f["damper"] * -v == pytest.approx(f["damper.lossPower"])


@pytest.mark.parametrize("v", SPEEDS)
def test_regularized_signs(laws, v):
    f, r = laws(v), max(min(v / 0.1, 1), -1)
    assert f["sign_exp"] == pytest.approx(6 * (2 * expit(v / 0.001) - 1))
    assert f["sign_sine"] == pytest.approx(6 * np.sin(np.pi / 2 * r))
    assert f["sign_linear"] == pytest.approx(6 * r)
    assert f["sign_cosine"] == pytest.approx(6 * np.sign(v) * (1 - np.cos(np.pi / 2 * r)))
    assert f["rolling"] == pytest.approx(0.01 * 600 * 0.8 * r)


@pytest.mark.parametrize("v", SPEEDS)
def test_eddy_current_brake_is_warm(laws, v):
    f, r = laws(v), v / (2 * (1 + 0.004 * 50))
    assert f["eddy"] == pytest.approx(12 * r / (1 + r**2))
    assert f["eddy.lossPower"] == pytest.approx(f["eddy"] * v)


def test_constant_force_and_step(laws):
    assert laws(0.0)["constant"] == -6
    assert laws(0.0, t=0.9)["step"] == -1
    assert laws(0.0, t=1.0)["step"] == -3


def test_friction_follows_its_table_with_a_peak_at_rest(laws):
    for v, sliding in ((0.5, 6.0), (1.5, 7.0), (4.0, 7.0)):
        assert laws(v)["friction"] == pytest.approx(sliding)
        assert laws(-v)["friction"] == pytest.approx(-sliding)
    speeds = np.linspace(0, 0.02, 201)
    greatest = max(laws(v)["friction"] for v in speeds)
    assert greatest == pytest.approx(1.2 * 5, rel=0.01)


@pytest.mark.parametrize(
    ("s", "v", "expected"),
    [
        (-0.6, 1.0, 0.0),  # apart
        (-0.4, 0.0, -100 * 0.1**2),  # pressed together by 0.1
        (-0.4, 0.01, -1.0 - 0.3),  # and closing
        (-0.4, 1.0, -2.0),  # damping is bounded by the spring
        (-0.4, -1.0, 0.0),  # never pulls
    ],
)
def test_elastic_gap_pushes_only(laws, s, v, expected):
    assert laws(v, s)["gap"] == pytest.approx(expected, abs=1e-12)


def test_a_flange_is_initialized_and_driven_by_signals():
    class Model(ac.Component):
        def __init__(self):
            super().__init__()
            self.mass = tl.Mass(m=2, L=0.2)
            self.start = tl.InitializeFlange(use_a_start=False)
            self.adaptor = tl.GeneralForceToPositionAdaptor()
            self.connect(self.mass.flange_a, self.start.flange)
            self.connect(self.mass.flange_b, self.adaptor.flange)

    system = ac.compile(Model())
    given = {"start.s_start": 1.0, "start.v_start": 2.0, "adaptor.f": 6.0}
    u = jnp.asarray([given[name] for name in system.inputs])
    x = system.initial_state(inputs=u)
    signals = [f"adaptor.{name}" for name in ("p", "pder", "pder2")]
    values = system.observe(["mass.s", *signals], 0.0, x, u, system.parameters())
    assert np.allclose(values, [1.1, 1.2, 2.0, -3.0])  # f is positive into the adaptor


# -- motions -----------------------------------------------------------------------------------------


class Bench(ac.Component):
    """Independent experiments side by side, so that one program simulates all."""

    def __init__(self):
        super().__init__()
        self.ground = tl.Fixed(s0=0.5)
        at_rest = {"v": ac.Start(0.0, fixed=True)}

        # an oscillator about 0.5 + 0.25, forwards and with reversed flanges
        self.mass = tl.Mass(m=2, s=ac.Start(0.85, fixed=True), **at_rest)
        self.spring = tl.Spring(c=200, s_rel0=0.25)
        self.connect(self.ground.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)
        self.mass_r = tl.Mass(m=2, s=ac.Start(0.15, fixed=True), **at_rest)
        self.spring_r = tl.Spring(c=200, s_rel0=0.25)
        self.connect(self.ground.flange, self.spring_r.flange_b)
        self.connect(self.spring_r.flange_a, self.mass_r.flange_b)

        # a damper to the ground, with heat port
        self.braked = tl.Mass(m=2, s=ac.Start(0, fixed=True), v=ac.Start(3, fixed=True))
        self.damper = tl.Damper(d=4, useHeatPort=True)
        self.ambient = Ambient()
        self.connect(self.braked.flange_b, self.damper.flange_a)
        self.connect(self.damper.flange_b, self.ground.flange)
        self.connect(self.damper.heatPort, self.ambient.port)

        # two masses on a rod, pushed by a measured force
        self.push = tl.Force()
        self.cut = tl.MultiSensor()
        self.left = tl.Mass(m=1, L=0.2, s=ac.Start(0, fixed=True), **at_rest)
        self.rod = tl.Rod(L=1)
        self.right = tl.Mass(m=2, L=0.4)
        self.position, self.speed, self.acc = tl.PositionSensor(), tl.SpeedSensor(), tl.AccSensor()
        self.distance = tl.RelPositionSensor()
        self.relative, self.rel_acc = tl.RelSpeedSensor(), tl.RelAccSensor()
        self.force, self.power = tl.ForceSensor(), tl.PowerSensor()
        self.connect(self.push.flange, self.cut.flange_a)
        self.connect(self.cut.flange_b, self.left.flange_a)
        self.connect(self.left.flange_b, self.force.flange_a)
        self.connect(self.force.flange_b, self.rod.flange_a)
        self.connect(self.rod.flange_b, self.power.flange_a)
        self.connect(self.power.flange_b, self.right.flange_a)
        for sensor in (self.position, self.speed, self.acc):
            self.connect(sensor.flange, self.right.flange_b)
        for sensor in (self.distance, self.relative, self.rel_acc):
            self.connect(sensor.flange_a, self.ground.flange)
            self.connect(sensor.flange_b, self.right.flange_b)

        # a lever
        self.pull = tl.ConstantForce(f_constant=3)
        self.lever = tl.IdealGear(ratio=2)
        self.slow = tl.Mass(m=4, s=ac.Start(0, fixed=True), **at_rest)
        self.connect(self.pull.flange, self.lever.flange_a)
        self.connect(self.lever.flange_b, self.slow.flange_a)

        # forces between two masses and against a support
        self.between = tl.Force2()
        self.one = tl.Mass(m=1, s=ac.Start(0, fixed=True), **at_rest)
        self.two = tl.Mass(m=3, s=ac.Start(0, fixed=True), **at_rest)
        self.against = tl.Force(useSupport=True)
        self.connect(self.between.flange_a, self.one.flange_b)
        self.connect(self.between.flange_b, self.two.flange_a)
        self.connect(self.against.flange, self.two.flange_b)
        self.connect(self.against.support, self.one.flange_a)

        # friction stops a mass; a brake does, pressed with half of its force
        self.sliding = tl.Mass(m=2, s=ac.Start(0, fixed=True), v=ac.Start(1, fixed=True))
        self.friction = tl.SupportFriction(f_pos=[[0, 4]], smooth=True)
        self.connect(self.sliding.flange_b, self.friction.flange_a)
        self.wagon = tl.Mass(m=2, s=ac.Start(0, fixed=True), v=ac.Start(-1, fixed=True))
        self.brake = tl.Brake(fn_max=16, smooth=True)
        self.connect(self.wagon.flange_b, self.brake.flange_a)

        # a ball bounces under its weight; a slider meets its stop
        self.ball = tl.Mass(m=1, s=ac.Start(1, fixed=True), **at_rest)
        self.weight = tl.ConstantForce(f_constant=-10)
        self.floor = tl.Fixed()
        self.gap = tl.ElastoGap(c=1e4, d=20)
        self.connect(self.ball.flange_a, self.gap.flange_b)
        self.connect(self.gap.flange_a, self.floor.flange)
        self.connect(self.ball.flange_b, self.weight.flange)
        self.slider = tl.MassWithStopAndFriction(
            m=1, L=0.2, smax=1, smin=-1, F_prop=1, F_Coulomb=0.5, F_Stribeck=0.5, fexp=2, smooth=True,
            s=ac.Start(0, fixed=True), v=ac.Start(3, fixed=True),
        )  # fmt: skip

        # relative states
        self.a, self.b = tl.Mass(m=1), tl.Mass(m=1, s=ac.Start(0, fixed=True), **at_rest)
        self.states = tl.RelativeStates(
            s_rel=ac.Start(0.1, fixed=True), v_rel=ac.Start(1, fixed=True)
        )
        self.connect(self.states.flange_a, self.b.flange_b)
        self.connect(self.states.flange_b, self.a.flange_a)


@pytest.fixture(scope="module")
def bench():
    inputs = {
        "push.f": lambda t: 6 * t,
        "between.f": 3.0,
        "against.f": 0.0,
        "brake.f_normalized": 0.5,
    }
    return ac.simulate(ac.compile(Bench()), t=(0, 2), inputs=inputs, rtol=1e-8, atol=1e-10)


@pytest.mark.slow
def test_an_oscillator_swings_and_keeps_its_energy(bench):
    swing = 0.1 * np.cos(10 * bench.t)
    assert np.allclose(bench["mass.s"], 0.75 + swing, atol=1e-6)
    energy = bench["mass.v"] ** 2 + 100 * (bench["spring.s_rel"] - 0.25) ** 2
    assert np.allclose(energy, 1.0, rtol=1e-5)
    assert np.allclose(bench["mass_r.s"], 0.25 - swing, atol=1e-6)  # the mirror image


def test_a_damper_brakes_and_heats(bench):
    v = 3 * np.exp(-2 * bench.t)
    assert np.allclose(bench["braked.v"], v, atol=1e-6)
    assert np.allclose(bench["ambient.port.Q_flow"], 4 * v**2, atol=1e-5)
    assert np.allclose(bench["damper.heatPort.T"], 293.15)


def test_masses_on_a_rod_move_as_one_and_sensors_tell(bench):
    t = bench.t
    a, v, s = 2 * t, t**2, t**3 / 3
    assert np.allclose(bench["left.s"], s, atol=1e-6)
    assert np.allclose(bench["position.s"], s + 0.1 + 1 + 0.4, atol=1e-6)
    assert np.allclose(bench["speed.v"], v, atol=1e-6)
    assert np.allclose(bench["acc.a"], a, atol=1e-6)
    assert np.allclose(bench["distance.s_rel"], s + 1.5 - 0.5, atol=1e-6)
    assert np.allclose(bench["relative.v_rel"], v, atol=1e-6)
    assert np.allclose(bench["rel_acc.a_rel"], a, atol=1e-6)
    assert np.allclose(bench["cut.f"], 6 * t, atol=1e-6)
    assert np.allclose(bench["cut.power"], 6 * t * v, atol=1e-5)
    assert np.allclose(bench["force.f"], 2 * a, atol=1e-6)
    assert np.allclose(bench["power.power"], 2 * a * v, atol=1e-5)


def test_a_lever_multiplies_the_force(bench):
    assert np.allclose(bench["slow.a"], 2 * 3 / 4)
    assert np.allclose(bench["lever.s_a"], 2 * bench["slow.s"])


def test_a_force_between_masses_drives_them_apart(bench):
    assert np.allclose(bench["one.a"], -3.0)
    assert np.allclose(bench["two.a"], 1.0)


@pytest.mark.parametrize(("mass", "sign"), [("sliding", 1), ("wagon", -1)])
def test_friction_stops_and_then_holds(bench, mass, sign):
    t, v = np.asarray(bench.t), np.asarray(bench[f"{mass}.v"])
    before = t < 0.49
    assert np.allclose(v[before], sign * (1 - 2 * t[before]), atol=1e-6)
    assert np.all(np.abs(v[t > 0.55]) < 1e-6)


def test_friction_only_dissipates(bench):
    assert np.all(bench["friction.lossPower"] >= 0)
    assert np.all(bench["brake.lossPower"] >= 0)
    assert np.all(bench["slider.lossPower"] >= 0)


def test_a_bouncing_ball_loses_height_and_is_never_pulled(bench):
    t, s = np.asarray(bench.t), np.asarray(bench["ball.s"])
    falling = t < 0.44
    assert np.allclose(s[falling], 1 - 5 * t[falling] ** 2, atol=1e-6)
    assert np.all(np.asarray(bench["gap.f"]) <= 1e-9)
    bounce = np.max(s[t > 0.6])
    assert 0.3 < bounce < 0.99
    energy = 10 * s + 0.5 * np.asarray(bench["ball.v"]) ** 2 + 5e3 * np.minimum(s, 0) ** 2
    assert np.all(np.diff(energy) < 1e-6)


def test_a_slider_comes_to_rest_at_its_stop(bench):
    s, stopped = np.asarray(bench["slider.s"]), np.asarray(bench["slider.stopped"])
    assert np.max(s) < 0.9 + 0.01
    assert np.min(s[np.argmax(stopped) :]) > 0.88
    assert set(stopped.tolist()) <= {0.0, 1.0}


def test_relative_states_are_states(bench):
    assert {"states.s_rel", "states.v_rel"} <= set(bench.system.states)
    assert np.allclose(bench["states.s_rel"], 0.1 + bench.t, atol=1e-6)
    assert np.allclose(bench["a.s"], 0.1 + bench.t, atol=1e-6)


class Drives(ac.Component):
    """A mass at each motion source."""

    def __init__(self):
        super().__init__()
        self.position = tl.Position(exact=True)
        self.speed = tl.Speed(exact=True)
        self.accelerate = tl.Accelerate()
        self.move = tl.Move()
        self.steady = tl.ConstantSpeed(v_fixed=0.5)
        self.adaptor = tl.GeneralPositionToForceAdaptor()
        self.filtered = tl.Position()
        self.lagging = tl.Speed(f_crit=1 / (2 * np.pi))
        sources = (
            self.position, self.speed, self.accelerate, self.move, self.steady,
            self.adaptor, self.filtered, self.lagging,
        )  # fmt: skip
        self.masses = [tl.Mass(m=2) for _ in sources]
        for source, mass in zip(sources, self.masses, strict=True):
            self.connect(source.flange, mass.flange_a)


@pytest.fixture(scope="module")
def drives():
    system = ac.compile(Drives())
    s, v, a = (lambda t: t**3), (lambda t: 3 * t**2), (lambda t: 6 * t)
    given = {
        "position.s_ref": s, "der(position.s_ref)": v, "der(der(position.s_ref))": a,
        "speed.v_ref": v, "der(speed.v_ref)": a, "accelerate.a_ref": a,
        "move.u[1]": s, "move.u[2]": v, "move.u[3]": a,
        "adaptor.p": s, "adaptor.pder": v, "adaptor.pder2": a,
        "filtered.s_ref": s, "lagging.v_ref": lambda t: t,
    }  # fmt: skip
    inputs = {name: given[name] for name in system.inputs}
    return ac.simulate(system, t=(0, 1), inputs=inputs, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("mass", [1, 2, 3, 4, 6])
def test_prescribed_motions_are_followed_exactly(drives, mass):
    t = drives.t
    assert np.allclose(drives[f"masses[{mass}].s"], t**3, atol=1e-6)
    assert np.allclose(drives[f"masses[{mass}].v"], 3 * t**2, atol=1e-6)
    assert np.allclose(drives[f"masses[{mass}].flange_a.f"], 12 * t, atol=1e-6)


def test_constant_speed(drives):
    assert np.allclose(drives["masses[5].s"], 0.5 * drives.t, atol=1e-6)
    assert np.allclose(drives["adaptor.f"], 12 * drives.t, atol=1e-6)


def test_a_filtered_position_follows_closely(drives):
    assert np.allclose(drives["masses[7].s"], drives.t**3, atol=0.02)
    assert np.allclose(drives["filtered.a"][250:], 6 * drives.t[250:], atol=0.1)


def test_a_filtered_speed_is_a_first_order_lag(drives):
    t = drives.t
    assert np.allclose(drives["masses[8].v"], t - (1 - np.exp(-t)), atol=1e-6)


def test_a_vehicle_accelerates_as_its_resistances_say():
    vehicle = tl.Vehicle(
        m=1000, J=10, R=0.5, A=2, Cd=0.3, vWindConstant=5, CrConstant=0.01, inclinationConstant=0.1,
        v=ac.Start(20.0, fixed=True),
    )  # fmt: skip

    class Drive(ac.Component):
        def __init__(self):
            super().__init__()
            self.vehicle = vehicle
            self.torque = rotational.ConstantTorque(tau_constant=800)
            self.connect(self.torque.flange, vehicle.flangeR)

    system = ac.compile(Drive())
    x0 = np.asarray(system.initial_state()).copy()
    x0[list(system.states).index("vehicle.windSpeed.v")] = 5.0
    found = system.observe(
        ["vehicle.a", "vehicle.v", "vehicle.inertia.w", "vehicle.fDrag.f"],
        0.0, jnp.asarray(x0), None, system.parameters(),
    )  # fmt: skip
    alpha, weight = np.arctan(0.1), 1000 * 9.80665
    drag = 0.3 * 1.2 * 2 / 2 * (20 - 5) ** 2
    force = 800 / 0.5 - drag - 0.01 * weight * np.cos(alpha) - weight * np.sin(alpha)
    a = force / (1000 + 10 / 0.5**2)
    assert np.allclose(found, [a, 20, 40, drag])
