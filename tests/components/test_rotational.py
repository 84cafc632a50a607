"""Rotational mechanics: MSL's names and defaults, laws at points, and a bench of motions."""

import inspect

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.special import expit

import acausal as ac
from acausal.components import constants, rotational as rot, translational as tl
from acausal.components.thermal import HeatPort
from acausal.flattening.flat_model import flatten

# Parameters and options with their defaults, as in MSL 4.1.0 (`...` marks those without a default).
FRICTION = {"peak": 1, "w_small": 1e10, "smoothness": "LinearSegments", "useHeatPort": False}
PRESSED = {**FRICTION, "mu_pos": [[0, 0.5]], "cgeo": 1, "fn_max": ...}
RELATIVE = {"phi_nominal": 1e-4}
BACKLASH = {"c": ..., "d": ..., "b": 0, "phi_rel0": 0, "useHeatPort": False, **RELATIVE}
NOMINAL = {"tau_nominal": ..., "TorqueDirection": True, "w_nominal": ..., "useSupport": False}
DEFAULTS = {
    "Fixed": {"phi0": 0},
    "Inertia": {"J": ...},
    "Coupling": {},
    "Disc": {"deltaPhi": 0},
    "Spring": {"c": ..., "phi_rel0": 0},
    "Damper": {"d": ..., "useHeatPort": False, **RELATIVE},
    "SpringDamper": {"c": ..., "d": ..., "phi_rel0": 0, "useHeatPort": False, **RELATIVE},
    "ElastoBacklash": BACKLASH,
    "ElastoBacklash2": BACKLASH,
    "BearingFriction": {**FRICTION, "tau_pos": [[0, 1]], "useSupport": False},
    "Brake": {**PRESSED, "useSupport": False},
    "Clutch": {**PRESSED, **RELATIVE},
    "OneWayClutch": {**PRESSED, **RELATIVE},
    "IdealGear": {"ratio": ..., "useSupport": False},
    "LossyGear": {
        "ratio": ..., "lossTable": [[0, 1, 1, 0, 0]], "smoothness": "LinearSegments",
        "useSupport": False, "useHeatPort": False, "w_small": 1e-4,
    },
    "IdealPlanetary": {"ratio": ...},
    "Gearbox": {
        "ratio": ..., "lossTable": [[0, 1, 1, 0, 0]], "c": ..., "d": ..., "b": 0,
        "useSupport": False, "useHeatPort": False,
    },
    "IdealGearR2T": {"ratio": ..., "useSupportR": False, "useSupportT": False},
    "IdealRollingWheel": {"radius": ..., "useSupportR": False, "useSupportT": False},
    "InitializeFlange": {
        "use_phi_start": True, "use_w_start": True, "use_a_start": True, "stateSelect": "default",
    },
    "RelativeStates": {"phi_nominal": 1},
    "TorqueToAngleAdaptor": {"use_w": True, "use_a": True},
    "AngleToTorqueAdaptor": {"use_w": True, "use_a": True},
    "GeneralTorqueToAngleAdaptor": {"use_pder": True, "use_pder2": True},
    "GeneralAngleToTorqueAdaptor": {"use_pder": True, "use_pder2": True},
    "AngleSensor": {},
    "SpeedSensor": {},
    "AccSensor": {},
    "RelAngleSensor": {},
    "RelSpeedSensor": {},
    "RelAccSensor": {},
    "TorqueSensor": {},
    "PowerSensor": {},
    "MultiSensor": {},
    "Position": {"exact": False, "f_crit": 50, "useSupport": False},
    "Speed": {"exact": False, "f_crit": 50, "useSupport": False},
    "Accelerate": {"useSupport": False},
    "Move": {"useSupport": False},
    "Torque": {"useSupport": False},
    "Torque2": {},
    "InverseSpeedDependentTorque": {**NOMINAL, "w0": ...},
    "LinearSpeedDependentTorque": NOMINAL,
    "QuadraticSpeedDependentTorque": NOMINAL,
    "ConstantTorque": {"tau_constant": ..., "useSupport": False},
    "SignTorque": {"tau_nominal": ..., "reg": "Exp", "w0": ..., "useSupport": False},
    "ConstantSpeed": {"w_fixed": ..., "useSupport": False},
    "TorqueStep": {"stepTorque": ..., "offsetTorque": ..., "startTime": 0, "useSupport": False},
    "EddyCurrentTorque": {
        "useExcitationInput": False, "constantExcitation": 1, "tau_nominal": ..., "w_nominal": ...,
        "TRef": ..., "alpha20": ..., "T": 293.15, "useHeatPort": False, "useSupport": False,
    },
}  # fmt: skip

STEPS = [[0.0, 0.8, 0.5, 0.4, 0.7], [10.0, 0.9, 0.6, 0.5, 0.8]]
"""A table of losses."""


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
    for name in set(rot.__all__) - {"utilities"}:
        cls = getattr(rot, name)
        assert inspect.getdoc(cls), name
        concrete = issubclass(cls, ac.Component) and not name.startswith("Partial")
        assert concrete == (name in DEFAULTS), name


@pytest.mark.parametrize("name", DEFAULTS)
def test_names_and_defaults_are_those_of_the_standard_library(name):
    cls = getattr(rot, name)
    for key, default in DEFAULTS[name].items():
        declared = cls._declared[key].default
        if default is ...:
            assert declared is None, key
        else:
            assert np.array_equal(declared, default), key
    parameters = ((k, d) for k, d in cls._declared.items() if not isinstance(d, ac.Input))
    missing = {k for k, d in parameters if getattr(d, "default", 0) is None}
    assert missing == {k for k, default in DEFAULTS[name].items() if default is ...}


@pytest.mark.parametrize("name", DEFAULTS)
def test_every_class_has_as_many_equations_as_unknowns(name):
    model = flatten(minimal(getattr(rot, name)))
    assert model.n_equations == model.n_variables - len(model.inputs) - len(model.discrete)


@pytest.mark.parametrize(
    "component",
    [
        rot.Torque(useSupport=True),
        rot.Position(useSupport=True, exact=True),
        rot.IdealGear(ratio=2, useSupport=True),
        rot.BearingFriction(useSupport=True, useHeatPort=True),
        rot.LossyGear(ratio=2, lossTable=STEPS, useSupport=True, useHeatPort=True),
        rot.Gearbox(ratio=2, lossTable=STEPS, c=1, d=1, useSupport=True, useHeatPort=True),
        rot.IdealGearR2T(ratio=2, useSupportR=True, useSupportT=True),
        rot.IdealRollingWheel(radius=0.3, useSupportT=True),
        rot.InitializeFlange(use_a_start=False),
        rot.TorqueToAngleAdaptor(use_w=False),
        rot.AngleToTorqueAdaptor(use_a=False),
        rot.AngleToTorqueAdaptor(use_w=False),
        rot.GeneralTorqueToAngleAdaptor(use_pder=False),
        rot.GeneralAngleToTorqueAdaptor(use_pder2=False),
        rot.EddyCurrentTorque(
            tau_nominal=1, w_nominal=1, TRef=293.15, alpha20=0, useExcitationInput=True
        ),
    ],
    ids=repr,
)
def test_options_keep_the_balance(component):
    model = flatten(component)
    assert model.n_equations == model.n_variables - len(model.inputs) - len(model.discrete)


def test_inertias_are_preferred_as_states():
    class Pair(ac.Component):
        def __init__(self):
            super().__init__()
            self.inertia = rot.Inertia(J=1)
            self.spring = rot.SpringDamper(c=1, d=1)
            self.wanted = rot.SpringDamper(c=1, d=1, stateSelect="prefer")

    model = flatten(Pair())
    rank = {model.layout.variable(i): r for i, r in enumerate(model.state)}
    assert (rank["inertia.phi"], rank["inertia.w"], rank["inertia.a"]) == (3, 3, 2)
    assert rank["spring.phi_rel"] == rank["spring.w_rel"] == 2
    assert rank["wanted.phi_rel"] == rank["wanted.w_rel"] == 3.5


def test_a_loss_table_decides_whether_a_gear_is_ideal():
    assert rot.LossyGear(ratio=1).ideal
    assert rot.LossyGear(ratio=1, lossTable=[[0, 1, 1, 0, 0]]).ideal
    assert not rot.LossyGear(ratio=1, lossTable=STEPS).ideal
    assert not rot.Gearbox(ratio=1, c=1, d=1, lossTable=STEPS).lossyGear.ideal
    for table in ([[0, 1]], [0, 1, 1, 0, 0], 1.0):
        with pytest.raises(ac.DeclarationError, match=r"lossTable needs rows of 5 numbers"):
            rot.LossyGear(ratio=1, lossTable=table)


# -- laws at points ----------------------------------------------------------------------------------

SPEEDS = (-3.0, -0.05, 0.0, 0.02, 3.0)


class Laws(ac.Component):
    """Torque elements, each at a flange of its own that moves with the input speed."""

    def __init__(self, **elements):
        super().__init__()
        self.drive = rot.Speed(exact=True)
        self.ground = rot.Fixed()
        for name, element in elements.items():
            setattr(self, name, element)
            if isinstance(element, rot.PartialCompliant):
                self.connect(element.flange_a, self.ground.flange)
                self.connect(element.flange_b, self.drive.flange)
            else:
                end = "flange" if hasattr(type(element), "flange") else "flange_a"
                self.connect(self.drive.flange, getattr(element, end))


@pytest.fixture(scope="module")
def laws():
    one_way = {"tau_nominal": -6, "w_nominal": 2}
    both = {**one_way, "TorqueDirection": False}
    backlash = {"c": 100, "d": 5, "b": 0.2, "phi_rel0": 0.5}
    elements = {
        "linear": rot.LinearSpeedDependentTorque(**both),
        "linear_one_way": rot.LinearSpeedDependentTorque(**one_way),
        "quadratic": rot.QuadraticSpeedDependentTorque(**both),
        "quadratic_one_way": rot.QuadraticSpeedDependentTorque(**one_way),
        "inverse": rot.InverseSpeedDependentTorque(w0=0.1, **both),
        "inverse_one_way": rot.InverseSpeedDependentTorque(w0=0.1, **one_way),
        "sign_exp": rot.SignTorque(tau_nominal=-6, w0=0.1),
        "sign_sine": rot.SignTorque(tau_nominal=-6, w0=0.1, reg="Sine"),
        "sign_linear": rot.SignTorque(tau_nominal=-6, w0=0.1, reg="Linear"),
        "sign_cosine": rot.SignTorque(tau_nominal=-6, w0=0.1, reg="CoSine"),
        "eddy": rot.EddyCurrentTorque(
            tau_nominal=24, constantExcitation=0.5, w_nominal=2,
            TRef=293.15, alpha20=constants.alpha20Aluminium, T=343.15,
        ),
        "constant": rot.ConstantTorque(tau_constant=6),
        "step": rot.TorqueStep(stepTorque=2, offsetTorque=1, startTime=1),
        "friction": rot.BearingFriction(tau_pos=[[0, 5], [1, 7], [2, 7]], peak=1.2, smooth=True),
        "brake": rot.Brake(fn_max=8, cgeo=0.5, smooth=True),
        "clutch": rot.Clutch(fn_max=8, cgeo=0.5, smooth=True),
        "one_way": rot.OneWayClutch(fn_max=8, cgeo=0.5, smooth=True),
        "damper": rot.Damper(d=4),
        "spring_damper": rot.SpringDamper(c=100, d=4, phi_rel0=0.5),
        "tight": rot.ElastoBacklash(c=100, d=4, phi_rel0=0.5),
        "backlash": rot.ElastoBacklash(**backlash),
        "backlash2": rot.ElastoBacklash2(**backlash),
    }  # fmt: skip
    system = ac.compile(Laws(**elements))
    params = system.parameters()
    losing = ("eddy", "damper", "clutch", "spring_damper", "tight", "backlash", "backlash2")
    names = [f"{name}.tau" for name in elements] + [f"{name}.lossPower" for name in losing]

    @jax.jit
    def observe(w, phi, t, press):
        u = jnp.stack([w if name == "drive.w_ref" else press for name in system.inputs])
        return system.observe(names, t, jnp.stack([phi]), u, params)

    def torque(w, phi=0.0, t=0.0, press=0.5):
        values = np.asarray(observe(float(w), float(phi), float(t), float(press)))
        return dict(zip((n.removesuffix(".tau") for n in names), values, strict=True))

    assert system.states == ("drive.phi",)
    return torque


@pytest.mark.parametrize("w", SPEEDS)
def test_speed_dependent_torques(laws, w):
    tau, r = laws(w), w / 2
    assert tau["linear"] == pytest.approx(-6 * r)
    assert tau["linear_one_way"] == pytest.approx(-6 * abs(r))
    assert tau["quadratic"] == pytest.approx(-6 * r * abs(r))
    assert tau["quadratic_one_way"] == pytest.approx(-6 * r**2)
    assert tau["inverse"] == pytest.approx(-6 * w / 0.1 if abs(w) < 0.1 else -6 / r)
    assert tau["inverse_one_way"] == pytest.approx(-12 / max(abs(w), 0.1))
    assert tau["damper"] == pytest.approx(4 * w)
    assert tau["damper.lossPower"] == pytest.approx(4 * w**2)


@pytest.mark.parametrize("w", SPEEDS)
def test_regularized_signs(laws, w):
    tau, r = laws(w), max(min(w / 0.1, 1), -1)
    assert tau["sign_exp"] == pytest.approx(-6 * (2 * expit(w / 0.001) - 1))
    assert tau["sign_sine"] == pytest.approx(-6 * np.sin(np.pi / 2 * r))
    assert tau["sign_linear"] == pytest.approx(-6 * r)
    assert tau["sign_cosine"] == pytest.approx(-6 * np.sign(w) * (1 - np.cos(np.pi / 2 * r)))


@pytest.mark.parametrize("w", SPEEDS)
def test_eddy_current_brake_is_warm_and_half_excited(laws, w):
    tau, r = laws(w), w / (2 * (1 + 0.004 * 50))
    assert tau["eddy"] == pytest.approx(0.25 * 48 * r / (1 + r**2))
    assert tau["eddy.lossPower"] == pytest.approx(tau["eddy"] * w)


def test_constant_torque_and_step(laws):
    assert laws(0.0)["constant"] == 6
    assert laws(0.0, t=0.9)["step"] == 1
    assert laws(0.0, t=1.0)["step"] == 3


def test_friction_follows_its_table_with_a_peak_at_rest(laws):
    for w, sliding in ((0.5, 6.0), (1.5, 7.0), (4.0, 7.0)):
        assert laws(w)["friction"] == pytest.approx(sliding)
        assert laws(-w)["friction"] == pytest.approx(-sliding)
    greatest = max(laws(w)["friction"] for w in np.linspace(0, 0.02, 201))
    assert greatest == pytest.approx(1.2 * 5, rel=0.01)


def test_brake_and_clutches_are_pressed(laws):
    for press, tau in ((0.5, 1.0), (1.0, 2.0), (0.0, 0.0), (-1.0, 0.0)):
        for name in ("brake", "clutch", "one_way"):
            assert laws(2.0, press=press)[name] == pytest.approx(tau)
        assert laws(-2.0, press=press)["brake"] == pytest.approx(-tau)
    assert laws(-2.0)["clutch.lossPower"] == pytest.approx(2.0)
    assert laws(-1e-3, press=0.0)["one_way"] == pytest.approx(-100)


def test_without_backlash_there_are_spring_and_damper(laws):
    for w, phi in ((1.0, 0.6), (-7.0, 0.45)):
        tau = laws(w, phi)
        assert tau["tight"] == tau["spring_damper"] == pytest.approx(100 * (phi - 0.5) + 4 * w)
        assert tau["tight.lossPower"] == tau["spring_damper.lossPower"] == pytest.approx(4 * w**2)


@pytest.mark.parametrize(
    ("phi", "w", "tau", "loss", "tau2", "loss2"),
    [
        (0.55, 2.0, 0.0, 0.0, 0.0, 0.0),  # in the backlash
        (0.65, 0.0, 5.0, 0.0, 5.0, 0.0),  # pressed by 0.05
        (0.65, 0.2, 6.0, 0.2, 6.0, 0.2),  # and closing
        (0.65, 2.0, 10.0, 10.0, 15.0, 20.0),  # faster: damping is bounded by the spring
        (0.65, -0.2, 4.0, 0.2, 4.0, 0.2),  # opening
        (0.65, -2.0, 0.0, 0.0, 0.0, 0.0),  # never pulls
        (0.35, -0.2, -6.0, 0.2, -6.0, 0.2),  # the same on the other side
        (0.35, 2.0, 0.0, 0.0, 0.0, 0.0),
    ],
)
def test_backlash_pushes_only(laws, phi, w, tau, loss, tau2, loss2):
    found = laws(w, phi)
    assert found["backlash"] == pytest.approx(tau, abs=1e-12)
    assert found["backlash.lossPower"] == pytest.approx(loss, abs=1e-12)
    assert found["backlash2"] == pytest.approx(tau2, abs=1e-12)
    assert found["backlash2.lossPower"] == pytest.approx(loss2, abs=1e-12)


class Losses(ac.Component):
    """A gear with losses, moved at one side and loaded at the other."""

    def __init__(self):
        super().__init__()
        self.drive = rot.Speed(exact=True)
        self.gear = rot.LossyGear(ratio=-2, lossTable=STEPS, smooth=True)
        self.load = rot.Torque()
        self.connect(self.drive.flange, self.gear.flange_a)
        self.connect(self.gear.flange_b, self.load.flange)


@pytest.mark.parametrize(
    ("w", "tau_a", "loss"),
    [
        (5.0, 3.0, 0.15 * 3 + 0.45),  # flange_a drives
        (5.0, -3.0, (1 / 0.55 - 1) * 3 + 0.75),  # flange_b drives
        (-5.0, -3.0, -(0.15 * 3 + 0.45)),
        (-5.0, 3.0, -((1 / 0.55 - 1) * 3 + 0.75)),
        (0.0, 3.0, 0.0),
    ],
)
def test_losses_depend_on_which_side_drives(w, tau_a, loss):
    system = ac.compile(Losses())
    tau_b = 2 * (tau_a - loss)  # 0 = tau_b + ratio (tau_a - loss)
    given = {"drive.w_ref": w, "load.tau": tau_b}
    u = jnp.asarray([given.get(name, 0.0) for name in system.inputs])
    names = ["gear.flange_a.tau", "gear.tauLoss", "gear.lossPower"]
    found = system.observe(names, 0.0, jnp.zeros(1), u, system.parameters())
    assert np.allclose(found, [tau_a, loss, loss * w])
    assert found[2] >= 0


# -- structure ---------------------------------------------------------------------------------------


class Train(ac.Component):
    """Planetary gear, clutch and brake, gearbox on an elastic support, wheel and rack."""

    def __init__(self):
        super().__init__()
        self.torque = rot.Torque()
        self.sun, self.ring = rot.Inertia(J=1), rot.Inertia(J=2)
        self.planetary = rot.IdealPlanetary(ratio=2)
        self.clutch = rot.Clutch(fn_max=10, mu_pos=[[0, 0.5], [1, 0.4]], w_small=1.0, smooth=True)
        self.brake = rot.Brake(fn_max=10, w_small=1.0, useHeatPort=True, smooth=True)
        self.gearbox = rot.Gearbox(
            ratio=3,
            c=100,
            d=1,
            b=0.01,
            lossTable=STEPS,
            useSupport=True,
            useHeatPort=True,
            smooth=True,
        )
        self.out, self.housing = rot.Inertia(J=5), rot.Inertia(J=3)
        self.mount = rot.SpringDamper(c=50, d=2)
        self.ground, self.ambient = rot.Fixed(), Ambient()
        self.wheel, self.rack = rot.IdealRollingWheel(radius=0.3), rot.IdealGearR2T(ratio=4)
        self.car, self.rod = tl.Mass(m=10), tl.Mass(m=1)
        self.disc = rot.Disc(deltaPhi=0.1)
        self.connect(self.torque.flange, self.sun.flange_a)
        self.connect(self.sun.flange_b, self.planetary.sun, self.clutch.flange_a)
        self.connect(self.planetary.ring, self.ring.flange_a)
        self.connect(self.ring.flange_b, self.brake.flange_a)
        self.connect(self.planetary.carrier, self.clutch.flange_b, self.gearbox.flange_a)
        self.connect(self.gearbox.flange_b, self.out.flange_a)
        self.connect(self.out.flange_b, self.disc.flange_a)
        self.connect(self.disc.flange_b, self.wheel.flangeR, self.rack.flangeR)
        self.connect(self.wheel.flangeT, self.car.flange_a)
        self.connect(self.rack.flangeT, self.rod.flange_a)
        self.connect(self.gearbox.support, self.housing.flange_a)
        self.connect(self.housing.flange_b, self.mount.flange_a)
        self.connect(self.mount.flange_b, self.ground.flange)
        self.connect(self.gearbox.heatPort, self.brake.heatPort, self.ambient.port)


@pytest.mark.slow
def test_a_drive_train_balances_power():
    system = ac.compile(Train())
    rng = np.random.default_rng(0)
    x = jnp.asarray(rng.uniform(0.2, 1.0, len(system.states)))
    given = {"torque.tau": 7.0, "clutch.f_normalized": 0.5, "brake.f_normalized": 0.3}
    u = jnp.asarray([given.get(name, 0.0) for name in system.inputs])
    names = [
        "sun.w", "ring.w", "out.w", "housing.w", "car.v", "rod.v",
        "sun.a", "ring.a", "out.a", "housing.a", "car.a", "rod.a",
        "gearbox.elastoBacklash.tau_c", "gearbox.w_rel", "mount.tau", "mount.w_rel",
        "clutch.lossPower", "ambient.port.Q_flow",
    ]  # fmt: skip
    values = np.asarray(system.observe(names, 0.0, x, u, system.parameters()))
    speeds, accelerations = values[:6], values[6:12]
    spring, w_spring, mount, w_mount, clutch, heat = values[12:]
    kinetic = np.sum(np.asarray([1, 2, 5, 3, 10, 1]) * speeds * accelerations)
    supplied = 7.0 * values[0]
    stored = kinetic + spring * w_spring + mount * w_mount
    assert supplied == pytest.approx(stored + clutch + heat)


# -- motions -----------------------------------------------------------------------------------------


class Bench(ac.Component):
    """Independent experiments side by side, so that one program simulates all."""

    def __init__(self):
        super().__init__()
        self.ground = rot.Fixed(phi0=0.5)
        zero = {"phi": ac.Start(0.0, fixed=True)}
        at_rest = {"w": ac.Start(0.0, fixed=True)}

        # an oscillator about 0.5 + 0.25, forwards and with reversed flanges
        self.inertia = rot.Inertia(J=2, phi=ac.Start(0.85, fixed=True), **at_rest)
        self.spring = rot.Spring(c=200, phi_rel0=0.25)
        self.connect(self.ground.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.inertia.flange_a)
        self.inertia_r = rot.Inertia(J=2, phi=ac.Start(0.15, fixed=True), **at_rest)
        self.spring_r = rot.Spring(c=200, phi_rel0=0.25)
        self.connect(self.ground.flange, self.spring_r.flange_b)
        self.connect(self.spring_r.flange_a, self.inertia_r.flange_b)

        # a damper to the ground, with heat port
        self.braked = rot.Inertia(J=2, w=ac.Start(3, fixed=True), **zero)
        self.damper = rot.Damper(d=4, useHeatPort=True)
        self.ambient = Ambient()
        self.connect(self.braked.flange_b, self.damper.flange_a)
        self.connect(self.damper.flange_b, self.ground.flange)
        self.connect(self.damper.heatPort, self.ambient.port)

        # two inertias, a disc between them, driven by a measured torque
        self.push = rot.Torque()
        self.cut = rot.MultiSensor()
        self.left, self.right = rot.Inertia(J=1, **zero, **at_rest), rot.Inertia(J=2)
        self.disc = rot.Disc(deltaPhi=0.3)
        self.angle, self.speed, self.acc = rot.AngleSensor(), rot.SpeedSensor(), rot.AccSensor()
        self.rel_angle, self.rel_speed = rot.RelAngleSensor(), rot.RelSpeedSensor()
        self.rel_acc = rot.RelAccSensor()
        self.torque, self.power = rot.TorqueSensor(), rot.PowerSensor()
        self.connect(self.push.flange, self.cut.flange_a)
        self.connect(self.cut.flange_b, self.left.flange_a)
        self.connect(self.left.flange_b, self.torque.flange_a)
        self.connect(self.torque.flange_b, self.disc.flange_a)
        self.connect(self.disc.flange_b, self.power.flange_a)
        self.connect(self.power.flange_b, self.right.flange_a)
        for sensor in (self.angle, self.speed, self.acc):
            self.connect(sensor.flange, self.right.flange_b)
        for sensor in (self.rel_angle, self.rel_speed, self.rel_acc):
            self.connect(sensor.flange_a, self.ground.flange)
            self.connect(sensor.flange_b, self.right.flange_b)

        # a wheel drives a car, a pinion a rack
        self.engine = rot.ConstantTorque(tau_constant=6)
        self.wheel = rot.IdealRollingWheel(radius=0.5)
        self.car = tl.Mass(m=4, s=ac.Start(0, fixed=True), v=ac.Start(0, fixed=True))
        self.connect(self.engine.flange, self.wheel.flangeR)
        self.connect(self.wheel.flangeT, self.car.flange_a)

        # torques between two inertias and against a support
        self.between = rot.Torque2()
        self.one, self.two = (
            rot.Inertia(J=1, **zero, **at_rest),
            rot.Inertia(J=3, **zero, **at_rest),
        )
        self.against = rot.Torque(useSupport=True)
        self.connect(self.between.flange_a, self.one.flange_b)
        self.connect(self.between.flange_b, self.two.flange_a)
        self.connect(self.against.flange, self.two.flange_b)
        self.connect(self.against.support, self.one.flange_a)

        # bearing friction stops an inertia; a clutch takes one along; a free wheel does, too
        self.turning = rot.Inertia(J=2, w=ac.Start(1, fixed=True), **zero)
        self.bearing = rot.BearingFriction(tau_pos=[[0, 4]], smooth=True)
        self.connect(self.turning.flange_b, self.bearing.flange_a)
        self.fast = rot.Inertia(J=1, w=ac.Start(4, fixed=True), **zero)
        self.slow = rot.Inertia(J=3, **zero, **at_rest)
        self.clutch = rot.Clutch(fn_max=6, smooth=True)
        self.connect(self.fast.flange_b, self.clutch.flange_a)
        self.connect(self.clutch.flange_b, self.slow.flange_a)
        self.pedal = rot.TorqueStep(offsetTorque=4, stepTorque=-8, startTime=1)
        self.crank, self.hub = (
            rot.Inertia(J=1, **zero, **at_rest),
            rot.Inertia(J=1, **zero, **at_rest),
        )
        self.freewheel = rot.OneWayClutch(fn_max=1, smooth=True)
        self.connect(self.pedal.flange, self.crank.flange_a)
        self.connect(self.crank.flange_b, self.freewheel.flange_a)
        self.connect(self.freewheel.flange_b, self.hub.flange_a)

        # relative states
        self.a, self.b = rot.Inertia(J=1), rot.Inertia(J=1, **zero, **at_rest)
        self.states = rot.RelativeStates(
            phi_rel=ac.Start(0.1, fixed=True), w_rel=ac.Start(1, fixed=True)
        )
        self.connect(self.states.flange_a, self.b.flange_b)
        self.connect(self.states.flange_b, self.a.flange_a)


@pytest.fixture(scope="module")
def bench():
    inputs = {
        "push.tau": lambda t: 6 * t,
        "between.tau": 3.0,
        "against.tau": 0.0,
        "clutch.f_normalized": 0.5,
        "freewheel.f_normalized": 0.0,
    }
    return ac.simulate(ac.compile(Bench()), t=(0, 2), inputs=inputs, rtol=1e-8, atol=1e-10)


@pytest.mark.slow
def test_an_oscillator_swings_and_keeps_its_energy(bench):
    swing = 0.1 * np.cos(10 * bench.t)
    assert np.allclose(bench["inertia.phi"], 0.75 + swing, atol=1e-6)
    energy = bench["inertia.w"] ** 2 + 100 * (bench["spring.phi_rel"] - 0.25) ** 2
    assert np.allclose(energy, 1.0, rtol=1e-5)
    assert np.allclose(bench["inertia_r.phi"], 0.25 - swing, atol=1e-6)  # the mirror image


def test_a_damper_brakes_and_heats(bench):
    w = 3 * np.exp(-2 * bench.t)
    assert np.allclose(bench["braked.w"], w, atol=1e-6)
    assert np.allclose(bench["damper.a_rel"], 2 * w, atol=1e-5)
    assert np.allclose(bench["ambient.port.Q_flow"], 4 * w**2, atol=1e-5)


def test_coupled_inertias_turn_as_one_and_sensors_tell(bench):
    t = bench.t
    a, w, phi = 2 * t, t**2, t**3 / 3
    assert np.allclose(bench["left.phi"], phi, atol=1e-6)
    assert np.allclose(bench["angle.phi"], phi + 0.3, atol=1e-6)
    assert np.allclose(bench["speed.w"], w, atol=1e-6)
    assert np.allclose(bench["acc.a"], a, atol=1e-6)
    assert np.allclose(bench["rel_angle.phi_rel"], phi + 0.3 - 0.5, atol=1e-6)
    assert np.allclose(bench["rel_speed.w_rel"], w, atol=1e-6)
    assert np.allclose(bench["rel_acc.a_rel"], a, atol=1e-6)
    assert np.allclose(bench["cut.tau"], 6 * t, atol=1e-6)
    assert np.allclose(bench["cut.w"], w, atol=1e-6)
    assert np.allclose(bench["cut.power"], 6 * t * w, atol=1e-5)
    assert np.allclose(bench["torque.tau"], 2 * a, atol=1e-6)
    assert np.allclose(bench["power.power"], 2 * a * w, atol=1e-5)


def test_a_wheel_drives_a_car(bench):
    assert np.allclose(bench["car.a"], 6 / 0.5 / 4)
    assert np.allclose(bench["engine.phi"], bench["car.s"] / 0.5)


def test_a_torque_between_inertias_drives_them_apart(bench):
    assert np.allclose(bench["one.a"], -3.0)
    assert np.allclose(bench["two.a"], 1.0)


def test_friction_stops_and_then_holds(bench):
    t, w = np.asarray(bench.t), np.asarray(bench["turning.w"])
    assert np.allclose(w[t < 0.49], 1 - 2 * t[t < 0.49], atol=1e-6)
    assert np.all(np.abs(w[t > 0.55]) < 1e-6)
    assert np.all(bench["bearing.lossPower"] >= 0)


def test_a_clutch_brings_both_to_one_speed(bench):
    t, fast, slow = (np.asarray(a) for a in (bench.t, bench["fast.w"], bench["slow.w"]))
    assert np.allclose(fast + 3 * slow, 4.0, atol=1e-6)  # momentum is kept
    assert np.allclose(slow[t < 1.9], 0.5 * t[t < 1.9], atol=1e-3)
    assert np.all(bench["clutch.lossPower"] >= 0)


def test_a_free_wheel_drives_one_way_only(bench):
    t, crank, hub = (np.asarray(a) for a in (bench.t, bench["crank.w"], bench["hub.w"]))
    assert np.allclose(hub[t < 1], 2 * t[t < 1], atol=1e-3)  # together: 4 N.m on 2 kg.m2
    assert np.allclose(hub[t > 1.01], 2.0, atol=1e-3)  # the hub runs on
    assert np.allclose(crank[t > 1.01], 2 - 4 * (t[t > 1.01] - 1), atol=1e-3)


def test_relative_states_are_states(bench):
    assert {"states.phi_rel", "states.w_rel"} <= set(bench.system.states)
    assert np.allclose(bench["a.phi"], 0.1 + bench.t, atol=1e-6)


class Drives(ac.Component):
    """An inertia at each motion source."""

    def __init__(self):
        super().__init__()
        self.position = rot.Position(exact=True)
        self.speed = rot.Speed(exact=True)
        self.accelerate = rot.Accelerate()
        self.move = rot.Move()
        self.adaptor = rot.GeneralAngleToTorqueAdaptor()
        self.signals = rot.AngleToTorqueAdaptor()
        self.steady = rot.ConstantSpeed(w_fixed=0.5)
        self.filtered = rot.Position()
        self.lagging = rot.Speed(f_crit=1 / (2 * np.pi))
        sources = (
            self.position, self.speed, self.accelerate, self.move, self.adaptor, self.signals,
            self.steady, self.filtered, self.lagging,
        )  # fmt: skip
        self.inertias = [rot.Inertia(J=2) for _ in sources]
        for source, inertia in zip(sources, self.inertias, strict=True):
            self.connect(source.flange, inertia.flange_a)


@pytest.fixture(scope="module")
def drives():
    system = ac.compile(Drives())
    phi, w, a = (lambda t: t**3), (lambda t: 3 * t**2), (lambda t: 6 * t)
    given = {
        "position.phi_ref": phi, "der(position.phi_ref)": w, "der(der(position.phi_ref))": a,
        "speed.w_ref": w, "der(speed.w_ref)": a, "accelerate.a_ref": a,
        "move.u[1]": phi, "move.u[2]": w, "move.u[3]": a,
        "adaptor.p": phi, "adaptor.pder": w, "adaptor.pder2": a,
        "signals.phi": phi, "signals.w": w, "signals.a": a,
        "filtered.phi_ref": phi, "lagging.w_ref": lambda t: t,
    }  # fmt: skip
    inputs = {name: given[name] for name in system.inputs}
    return ac.simulate(system, t=(0, 1), inputs=inputs, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("number", [1, 2, 3, 4, 5, 6])
def test_prescribed_motions_are_followed_exactly(drives, number):
    t = drives.t
    assert np.allclose(drives[f"inertias[{number}].phi"], t**3, atol=1e-6)
    assert np.allclose(drives[f"inertias[{number}].w"], 3 * t**2, atol=1e-6)
    assert np.allclose(drives[f"inertias[{number}].flange_a.tau"], 12 * t, atol=1e-6)


def test_adaptors_tell_the_torque_that_drives(drives):
    assert np.allclose(drives["adaptor.f"], 12 * drives.t, atol=1e-6)
    assert np.allclose(drives["signals.tau"], 12 * drives.t, atol=1e-6)


def test_constant_speed(drives):
    assert np.allclose(drives["inertias[7].phi"], 0.5 * drives.t, atol=1e-6)


def test_filtered_motions_follow(drives):
    t = drives.t
    assert np.allclose(drives["inertias[8].phi"], t**3, atol=0.02)
    assert np.allclose(drives["inertias[9].w"], t - (1 - np.exp(-t)), atol=1e-6)


class Signals(ac.Component):
    """Two inertias and a spring between them; with adaptors, only signals join them."""

    def __init__(self, *, adaptors):
        super().__init__()
        self.one, self.two = rot.Inertia(J=1), rot.Inertia(J=3)
        self.spring = rot.SpringDamper(c=10, d=1)
        ends = (
            ("a", self.one.flange_b, self.spring.flange_a),
            ("b", self.two.flange_a, self.spring.flange_b),
        )
        for name, inertia, spring in ends:
            if not adaptors:
                self.connect(inertia, spring)
                continue
            motion, torque = rot.TorqueToAngleAdaptor(), rot.AngleToTorqueAdaptor()
            setattr(self, f"motion_{name}", motion)
            setattr(self, f"torque_{name}", torque)
            self.connect(inertia, motion.flange)
            self.connect(torque.flange, spring)
            self.connect(motion.phi, torque.phi)
            self.connect(motion.w, torque.w)
            self.connect(motion.a, torque.a)
            self.connect(torque.tau, motion.tau)


def test_signals_carry_what_flanges_do():
    rates = []
    for adaptors in (False, True):
        system = ac.compile(Signals(adaptors=adaptors))
        assert system.states == ("one.phi", "one.w", "two.phi", "two.w")
        x = jnp.asarray([0.1, 0.2, 0.5, -0.3])
        rates.append(system.vector_field(0.0, x, jnp.zeros(0), system.parameters()))
    assert np.allclose(rates[0], [0.2, 4 - 0.5, -0.3, -(4 - 0.5) / 3])
    assert np.allclose(rates[0], rates[1])


def test_a_flange_is_initialized_and_driven_by_signals():
    class Model(ac.Component):
        def __init__(self):
            super().__init__()
            self.inertia = rot.Inertia(J=2)
            self.start = rot.InitializeFlange(use_a_start=False)
            self.adaptor = rot.GeneralTorqueToAngleAdaptor()
            self.connect(self.inertia.flange_a, self.start.flange)
            self.connect(self.inertia.flange_b, self.adaptor.flange)

    system = ac.compile(Model())
    given = {"start.phi_start": 1.0, "start.w_start": 2.0, "adaptor.f": 6.0}
    u = jnp.asarray([given[name] for name in system.inputs])
    x = system.initial_state(inputs=u)
    signals = [f"adaptor.{name}" for name in ("p", "pder", "pder2")]
    values = system.observe(signals, 0.0, x, u, system.parameters())
    assert np.allclose(values, [1.0, 2.0, -3.0])  # f is positive into the adaptor
