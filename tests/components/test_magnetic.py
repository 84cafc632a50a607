"""Magnetic circuits: MSL's names and defaults, permeances and forces at points, and a bench of coils."""

import inspect
from dataclasses import fields

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical as el, magnetic as mag, translational as tl
from acausal.components.magnetic import force, hard_magnetic, leakage, soft_magnetic
from acausal.components.magnetic.hysteresis_data import Everett
from acausal.components.nature import mu_0
from acausal.flattening.flat_model import flatten

MATERIAL = {
    "nonLinearPermeability": True, "material": soft_magnetic.BaseData(), "mu_rConst": 1, "mu_i": callable,
    "B_myMax": callable, "c_a": callable, "c_b": callable, "n": callable,
}  # fmt: skip
PULL = {"useSupport": False, "dlBydx": 1, "mu_r": ...}

# Parameters and options with their defaults, as in MSL 4.1.0: `...` marks those without, `callable` those
# that are computed from others.
HYSTERESIS = {
    "l": 0.1, "A": 1e-4, "includeEddyCurrents": False, "sigma": 10e6, "d": 0.5e-3,
    "useHeatPort": False, "T": 293.15,
}  # fmt: skip

DEFAULTS = {
    "Ground": {},
    "ElectroMagneticConverter": {"N": 1},
    "ElectroMagneticConverterWithLeakageInductance": {
        "N": ..., "L": 10e-3, "A": 10e-6, "mu_rel": 1, "G_m": callable,
    },
    "ConstantReluctance": {"R_m": 1},
    "ConstantPermeance": {"G_m": 1},
    "VariableReluctance": {},
    "VariablePermeance": {},
    "LeakageWithCoefficient": {"c_usefulFlux": ...},
    "EddyCurrent": {
        "useConductance": False, "G": 1 / 0.098e-6, "rho": 0.098e-6, "l": 1, "A": 1, "R": callable,
        "useHeatPort": False, "T": 273.15,
    },
    "Idle": {},
    "Short": {},
    "Crossing": {},
    "GenericFluxTube": {"l": 0.01, "area": 0.0001, **MATERIAL},
    "Cuboid": {"l": 0.01, "a": 0.01, "b": 0.01, **MATERIAL},
    "HollowCylinderAxialFlux": {"l": 0.01, "r_i": 0, "r_o": 0.01, **MATERIAL},
    "HollowCylinderRadialFlux": {
        "l": 0.01, "r_i": 0.01, "r_o": 0.02, "alpha": 2 * np.pi, **MATERIAL,
    },
    "HollowCylinderCircumferentialFlux": {
        "l": 0.02, "r_i": 0.01, "r_o": 0.02, "alpha": np.pi / 2, **MATERIAL,
    },
    "Toroid": {"r": 0.1, "d": 0.01, "alpha": np.pi / 2, **MATERIAL},
    "GenericHystTellinenSoft": {"Js": 1.8, "Br": 0.9, "Hc": 120, "K": 1, **HYSTERESIS},
    "GenericHystTellinenHard": {"Br": 1.2, "Hc": 5e5, "M": callable, "K": 1, **HYSTERESIS},
    "GenericHystTellinenPermanentMagnet": {
        "Br": 1.2, "Hc": 5e5, "M": callable, "K": 1, **HYSTERESIS,
    },
    "GenericHystTellinenEverett": {"mat": Everett(), **HYSTERESIS, "sigma": callable},
    "GenericLinearPermanentMagnet": {
        "l": 0.1, "A": 1e-4, "mat": hard_magnetic.BaseData(), "B_r": callable, "mu_r": callable,
    },
    "ConstantMagneticPotentialDifference": {"V_m": ...},
    "SignalMagneticPotentialDifference": {},
    "ConstantMagneticFlux": {"Phi": 1},
    "SignalMagneticFlux": {},
    "MagneticPotentialDifferenceSensor": {},
    "MagneticFluxSensor": {},
}  # fmt: skip

FORCES = {
    "HollowCylinderAxialFlux": {"r_i": 0, "r_o": 0.01, **PULL},
    "HollowCylinderRadialFlux": {"r_i": 0.01, "r_o": 0.015, **PULL},
    "CuboidParallelFlux": {"a": 0.01, "b": 0.01, **PULL},
    "CuboidOrthogonalFlux": {"a": 0.01, "b": 0.01, **PULL},
    "LeakageAroundPoles": {"w": 0.1, "r": 0.01, "useSupport": False, "dlBydx": 1},
}

LEAKAGES = {
    "QuarterCylinder": {"l": 0.1},
    "QuarterHollowCylinder": {"l": 0.1, "ratio": ...},
    "HalfCylinder": {"l": 0.1},
    "HalfHollowCylinder": {"l": 0.1, "ratio": ...},
    "QuarterSphere": {"r": 0.005},
    "QuarterHollowSphere": {"t": ...},
    "EighthOfSphere": {"r": 0.01},
    "EighthOfHollowSphere": {"t": ...},
    "CoaxCylindersEndFaces": {
        "r_0": 10e-3,
        "r_1": 17e-3,
        "r_2": 20e-3,
        "l_g": callable,
        "t": callable,
    },
}

PARTIAL = {
    "GenericHysteresis", "GenericHysteresisTellinen", "GenericHystTellinenTable",
    "FixedShape", "Force", "Leakage", "Reluctance", "TwoPort", "TwoPortElementary", "TwoPortExtended",
}  # fmt: skip
TABLES = [(mag, DEFAULTS), (force, FORCES), (leakage, LEAKAGES)]
CLASSES = [(module, name, table[name]) for module, table in TABLES for name in table]
IDS = [f"{module.__name__.rpartition('.')[2]}.{name}" for module, name, _ in CLASSES]


def minimal(cls):
    """An instance with the value 1 for all that must be given."""
    needed = {
        name: 1.0
        for name, d in cls._declared.items()
        if isinstance(d, ac.Parameter) and d.default is None
    }
    return cls(**needed)


# -- declarations ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("module", "table"), TABLES)
def test_every_class_is_documented_and_in_the_table(module, table):
    for name in module.__all__:
        cls = getattr(module, name)
        assert inspect.getdoc(cls), name
        if isinstance(cls, type) and issubclass(cls, ac.Component):
            assert (name in table) != (name in PARTIAL), name


@pytest.mark.parametrize(("module", "name", "defaults"), CLASSES, ids=IDS)
def test_names_and_defaults_are_those_of_the_standard_library(module, name, defaults):
    declarations = getattr(module, name)._declared
    for key, default in defaults.items():
        declared = declarations[key].default
        if default is ...:
            assert declared is None, key
        elif default is callable:
            assert callable(declared), key
        else:
            assert declared == default, key


@pytest.mark.parametrize(("module", "name", "defaults"), CLASSES, ids=IDS)
def test_every_class_has_as_many_equations_as_unknowns(module, name, defaults):
    model = flatten(minimal(getattr(module, name)))
    assert model.n_equations == model.n_variables - len(model.inputs) - len(model.discrete)


@pytest.mark.parametrize(
    "component",
    [
        mag.Cuboid(nonLinearPermeability=False),
        mag.EddyCurrent(useConductance=True, useHeatPort=True),
        force.CuboidParallelFlux(mu_r=1, useSupport=True, dlBydx=-1),
    ],
    ids=repr,
)
def test_options_keep_the_balance(component):
    model = flatten(component)
    assert model.n_equations == model.n_variables - len(model.inputs)


def test_a_material_must_be_one():
    with pytest.raises(ac.DeclarationError, match=r"is not a soft magnetic material.*M350_50A\(\)"):
        mag.Cuboid(material="M350_50A")
    with pytest.raises(ac.DeclarationError, match="is not a hard magnetic material"):
        mag.GenericLinearPermanentMagnet(mat=mag.M350_50A())


def test_coefficients_of_a_material_are_parameters():
    values = ac.compile(Tubes(mag.Cuboid(material=mag.M350_50A(mu_i=1300.0), n=13.0))).parameters()
    names = ("mu_i", "B_myMax", "c_a", "c_b", "n")
    assert [float(values[f"tubes[1].{name}"]) for name in names] == [1300, 1.16, 24630, 2.44, 13]


def test_a_circuit_without_ground_says_so():
    class Ring(ac.Component):
        def __init__(self):
            super().__init__()
            self.source = mag.ConstantMagneticPotentialDifference(V_m=1)
            self.core = mag.ConstantReluctance()
            self.connect(self.source.port_p, self.core.port_p)
            self.connect(self.source.port_n, self.core.port_n)

    with pytest.raises(ac.StructureError, match="ground"):
        ac.compile(Ring())


# -- flux tubes --------------------------------------------------------------------------------------


class Tubes(ac.Component):
    """Tubes, each with the flux ``Phi``."""

    Phi = ac.Input(unit="Wb")

    def __init__(self, *tubes):
        super().__init__()
        self.ground = mag.Ground()
        self.tubes = list(tubes)
        self.sources = [mag.SignalMagneticFlux() for _ in tubes]
        for tube, source in zip(self.tubes, self.sources, strict=True):
            self.connect(self.Phi, source.Phi)
            self.connect(source.port_n, tube.port_p)
            self.connect(source.port_p, tube.port_n, self.ground.port)


def values(model, names, u=(1.0,)):
    """Variables of a model without states."""
    system = ac.compile(model)
    found = system.observe(names, 0.0, jnp.zeros(0), jnp.asarray(u), system.pack())
    return dict(zip(names, np.asarray(found).tolist(), strict=True))


MATERIALS = [getattr(mag, name) for name in soft_magnetic.__all__ if name != "BaseData"]


def test_materials_saturate():
    tubes = Tubes(*(mag.GenericFluxTube(material=material(), area=1e-3) for material in MATERIALS))
    names = [f"tubes[{i}].{x}" for i in range(1, len(MATERIALS) + 1) for x in ("mu_r", "H", "V_m")]
    for B in (0.01, 0.3, -1.1, 1.9):
        found = values(tubes, names, (1e-3 * B,))
        for i, material in enumerate(MATERIALS, start=1):
            d = material()
            b = abs(B / d.B_myMax)
            mu_r = 1 + (d.mu_i - 1 + d.c_a * b) / (1 + d.c_b * b + b**d.n)
            assert found[f"tubes[{i}].mu_r"] == pytest.approx(mu_r)
            assert found[f"tubes[{i}].H"] == pytest.approx(B / (mu_0 * mu_r))
            assert found[f"tubes[{i}].V_m"] == pytest.approx(0.01 * B / (mu_0 * mu_r))


def test_a_saturating_tube_has_a_derivative_everywhere():
    system = ac.compile(Tubes(mag.Cuboid(material=mag.M350_50A())))
    packed, x = system.pack(), jnp.zeros(0)
    derivative = jax.jit(
        jax.grad(lambda Phi: system.observe("tubes[1].V_m", 0.0, x, jnp.stack([Phi]), packed))
    )
    assert float(derivative(0.0)) == pytest.approx(0.01 / (mu_0 * 1210 * 1e-4))
    assert np.isfinite(derivative(1e-4))
    assert float(derivative(2e-4)) > 0


def test_shapes_have_their_permeance():
    shapes = {
        mag.GenericFluxTube(area=2e-4, l=0.02, mu_rConst=5): (2e-4, 2e-4 / 0.02),
        mag.Cuboid(l=0.02, a=0.03, b=0.04, mu_rConst=5): (12e-4, 12e-4 / 0.02),
        mag.HollowCylinderAxialFlux(l=0.02, r_i=0.01, r_o=0.03, mu_rConst=5): (
            np.pi * 8e-4, np.pi * 8e-4 / 0.02,
        ),
        mag.HollowCylinderRadialFlux(l=0.02, r_i=0.01, r_o=0.03, alpha=1.5, mu_rConst=5): (
            0.02 * 1.5 * 0.02, 1.5 * 0.02 / np.log(3),
        ),
        mag.HollowCylinderCircumferentialFlux(l=0.02, r_i=0.01, r_o=0.03, alpha=1.5, mu_rConst=5): (
            4e-4, 4e-4 / (0.02 * 1.5),
        ),
        mag.Toroid(r=0.05, d=0.02, alpha=1.5, mu_rConst=5): (np.pi * 1e-4, np.pi * 1e-4 / (0.05 * 1.5)),
    }  # fmt: skip
    for shape in shapes:
        shape.modify(nonLinearPermeability=False)
    names = [f"tubes[{i}].{x}" for i in range(1, len(shapes) + 1) for x in ("A", "G_m", "B", "H")]
    found = values(Tubes(*shapes), names, (2e-3,))
    for i, (area, length) in enumerate(shapes.values(), start=1):
        assert found[f"tubes[{i}].A"] == pytest.approx(area)
        assert found[f"tubes[{i}].G_m"] == pytest.approx(5 * mu_0 * length)
        assert found[f"tubes[{i}].B"] == pytest.approx(2e-3 / area)
        assert found[f"tubes[{i}].H"] == pytest.approx(2e-3 / area / (5 * mu_0))


def test_leakages_have_their_permeance():
    lengths = {
        leakage.QuarterCylinder(l=0.2): 0.52 * 0.2,
        leakage.QuarterHollowCylinder(l=0.2, ratio=2): 0.4 * np.log(3) / np.pi,
        leakage.HalfCylinder(l=0.2): 0.26 * 0.2,
        leakage.HalfHollowCylinder(l=0.2, ratio=2): 0.2 * np.log(3) / np.pi,
        leakage.QuarterSphere(r=0.2): 0.077 * 0.4,
        leakage.QuarterHollowSphere(t=0.2): 0.05,
        leakage.EighthOfSphere(r=0.2): 0.308 * 0.2,
        leakage.EighthOfHollowSphere(t=0.2): 0.1,
        leakage.CoaxCylindersEndFaces(r_0=2, r_1=3, r_2=4): 5 * np.log(3),
        leakage.CoaxCylindersEndFaces(r_0=2, r_1=3, r_2=9): 5 * np.log(5),
    }
    names = [f"tubes[{i}].G_m" for i in range(1, len(lengths) + 1)]
    found = values(Tubes(*lengths), names)
    assert list(found.values()) == pytest.approx([mu_0 * length for length in lengths.values()])


@pytest.mark.slow
def test_other_reluctances_sources_and_sensors():
    class Circuit(ac.Component):
        R, G = ac.Input(unit="1/H"), ac.Input(unit="H")

        def __init__(self):
            super().__init__()
            self.ground = mag.Ground()
            self.source = mag.ConstantMagneticPotentialDifference(V_m=12)
            self.sensor = mag.MagneticFluxSensor()
            self.drop = mag.MagneticPotentialDifferenceSensor()
            self.first, self.second = mag.ConstantReluctance(R_m=2), mag.ConstantPermeance(G_m=0.5)
            self.third, self.fourth = mag.VariableReluctance(), mag.VariablePermeance()
            self.leak = mag.LeakageWithCoefficient(c_usefulFlux=0.8)
            self.short, self.idle = mag.Short(), mag.Idle()
            self.crossing = mag.Crossing()
            self.connect(self.source.port_p, self.sensor.port_p)
            self.connect(self.sensor.port_n, self.first.port_p, self.drop.port_p)
            self.connect(self.first.port_n, self.short.port_p)
            self.connect(self.short.port_n, self.crossing.port_p1, self.idle.port_p)
            self.connect(self.crossing.port_p2, self.second.port_p)
            self.connect(self.second.port_n, self.third.port_p, self.drop.port_n)
            self.connect(self.third.port_n, self.fourth.port_p, self.leak.port_p)
            self.connect(self.fourth.port_n, self.crossing.port_n1)
            self.connect(
                self.crossing.port_n2, self.leak.port_n, self.idle.port_n, self.ground.port
            )
            self.connect(self.source.port_n, self.ground.port)
            self.connect(self.R, self.third.R_m)
            self.connect(self.G, self.fourth.G_m)
            self.connect(self.R, self.leak.R_mUsefulTot)

    names = ["sensor.Phi", "drop.V_m", "leak.R_m", "fourth.Phi", "leak.Phi", "idle.V_m"]
    found = values(Circuit(), names, (0.5, 0.5))
    behind = 1 / (0.5 + 1 / 2)  # the permeance 0.5 and the leakage of 0.8/0.2 times 0.5
    flux = 12 / (2 + 2 + 0.5 + behind)
    assert found["leak.R_m"] == pytest.approx(2)
    assert found["sensor.Phi"] == pytest.approx(flux)
    assert found["drop.V_m"] == pytest.approx(4 * flux)
    assert [found["fourth.Phi"], found["leak.Phi"]] == pytest.approx([flux / 2] * 2)
    assert found["idle.V_m"] == pytest.approx(12 - 2 * flux)


# -- forces and magnets --------------------------------------------------------------------------------


class Gap(ac.Component):
    """Tubes with a force, each at the magnetic voltage 50 A, their armatures at the position ``s``."""

    s = ac.Input(unit="m")

    def __init__(self, *tubes):
        super().__init__()
        self.ground = mag.Ground()
        self.source = mag.ConstantMagneticPotentialDifference(V_m=50)
        self.fixed = tl.Fixed(s0=0.001)
        self.connect(self.source.port_n, self.ground.port)
        self.tubes = list(tubes)
        self.moves = [tl.Position(exact=True) for _ in tubes]
        for tube, move in zip(self.tubes, self.moves, strict=True):
            self.connect(self.source.port_p, tube.port_p)
            self.connect(tube.port_n, self.ground.port)
            self.connect(tube.flange, move.flange)
            self.connect(tube.support, self.fixed.flange)
            self.connect(self.s, move.s_ref)


def test_forces_follow_from_the_change_of_permeance():
    shape = {"mu_r": 3.0, "useSupport": True}
    lengths = {
        force.HollowCylinderAxialFlux(r_i=0.005, **shape): lambda l: 3 * np.pi * 0.75e-4 / l,
        force.HollowCylinderRadialFlux(**shape): lambda l: 6 * np.pi * l / np.log(1.5),
        force.CuboidParallelFlux(a=0.02, **shape): lambda l: 6e-4 / l,
        force.CuboidOrthogonalFlux(a=0.02, **shape): lambda l: 3 * 0.02 * l / 0.01,
        force.LeakageAroundPoles(useSupport=True): lambda l: (
            0.1 / np.pi * np.log(1 + np.pi * 0.01 / l)
        ),
        force.CuboidParallelFlux(dlBydx=-1, **shape): lambda l: 3e-4 / l,
    }
    names = [
        f"tubes[{i}].{x}"
        for i in range(1, 7)
        for x in ("G_m", "F_m", "Phi", "l", "flange.f", "support.f")
    ]
    s, l, h = 0.004, 0.003, 1e-6
    found = values(Gap(*lengths), names, (s,))
    for i, length in enumerate(lengths.values(), start=1):
        derivative = mu_0 * (length(l + h) - length(l - h)) / (2 * h) * (-1 if i == 6 else 1)
        assert found[f"tubes[{i}].l"] == pytest.approx(l)
        assert found[f"tubes[{i}].G_m"] == pytest.approx(mu_0 * length(l))
        assert found[f"tubes[{i}].Phi"] == pytest.approx(50 * mu_0 * length(l))
        assert found[f"tubes[{i}].F_m"] == pytest.approx(50**2 / 2 * derivative, rel=1e-5)
        assert found[f"tubes[{i}].flange.f"] == -found[f"tubes[{i}].F_m"]
        assert found[f"tubes[{i}].support.f"] == found[f"tubes[{i}].F_m"]


def test_a_magnet_drives_a_flux():
    names = [f.name for f in fields(hard_magnetic.BaseData)]
    assert names == ["H_cBRef", "B_rRef", "T_ref", "alpha_Br", "T_op"]
    hot = hard_magnetic.NdFeB(T_op=393.15)
    assert (hot.B_r, hot.H_cB) == pytest.approx((1.08, 810e3))
    magnet = mag.GenericLinearPermanentMagnet(l=0.01, A=2e-4, mat=hot)
    found = values(Tubes(magnet), ["tubes[1].B", "tubes[1].H", "tubes[1].V_m"], (-1e-4,))
    assert found["tubes[1].B"] == pytest.approx(-0.5)
    assert found["tubes[1].H"] == pytest.approx((1.08 - 0.5) / 1.08 * 810e3)
    assert found["tubes[1].V_m"] == pytest.approx(0.01 * found["tubes[1].H"])


# -- coils -------------------------------------------------------------------------------------------


class Bench(ac.Component):
    """Coils in electrical circuits, side by side: each has N = 100 turns and 2 Ohm at 1 V."""

    def __init__(self):
        super().__init__()
        self.ground, self.zero = el.Ground(), mag.Ground()
        self.v = el.ConstantVoltage(V=1)
        self.connect(self.v.n, self.ground.p)
        at_rest = ac.Start(0.0, fixed=True)
        for name, state in (("plain", "i"), ("eddy", "Phi"), ("primary", "Phi")):
            self.coil(name, mag.ElectroMagneticConverter(N=100, **{state: at_rest}))
        self.coil("leaky", mag.ElectroMagneticConverterWithLeakageInductance(
            N=100, L=mu_0, A=1e-4, i=at_rest))  # fmt: skip

        # an inductance of N**2/R_m = 0.5 H; the same with a leakage of N**2 1e-4 H = 1 H
        self.core, self.leaky_core = (mag.ConstantReluctance(R_m=2e4) for _ in range(2))
        self.close(self.plain, self.core)
        self.close(self.leaky, self.leaky_core)

        # a short-circuited turn in the core
        self.turn = mag.EddyCurrent(useConductance=True, G=5e3)
        self.eddy_core = mag.ConstantReluctance(R_m=2e4)
        self.close(self.eddy, self.eddy_core, self.turn)

        # a transformer with 50 turns and a load of 1 Ohm
        self.secondary, self.load = mag.ElectroMagneticConverter(N=50), el.Resistor(R=1)
        self.iron = mag.ConstantReluctance(R_m=2e4)
        self.close(self.primary, self.iron, self.secondary)
        self.connect(self.secondary.p, self.load.p)
        self.connect(self.secondary.n, self.load.n, self.ground.p)

    def coil(self, name, coil):
        """A coil behind a resistor."""
        setattr(self, name, coil)
        resistor = el.Resistor(R=2)
        setattr(self, f"r_{name}", resistor)
        self.connect(self.v.p, resistor.p)
        self.connect(resistor.n, coil.p)
        self.connect(coil.n, self.ground.p)

    def close(self, coil, *path):
        """Join tubes in series to the coil's ports."""
        before = coil.port_p
        for tube in path:
            self.connect(before, tube.port_p)
            before = tube.port_n
        self.connect(before, coil.port_n, self.zero.port)


@pytest.fixture(scope="module")
def bench():
    system = ac.compile(Bench())
    times = np.linspace(0, 1, 21)
    return ac.simulate(system, t=(0, 1), saveat=times, solver="tsit5", rtol=1e-8, atol=1e-12)


@pytest.mark.slow
def test_a_coil_is_an_inductor(bench):
    current = (1 - np.exp(-4 * bench.t)) / 2
    assert np.allclose(bench["plain.i"], current, atol=1e-6)
    assert np.allclose(bench["core.Phi"], 100 * current / 2e4, atol=1e-9)
    assert np.allclose(bench["plain.Phi"], -bench["core.Phi"], atol=1e-12)
    assert np.allclose(bench["plain.L_stat"][1:], 0.5)


def test_leakage_adds_to_the_inductance(bench):
    assert np.allclose(bench["leaky.i"], (1 - np.exp(-4 / 3 * bench.t)) / 2, atol=1e-6)
    assert np.allclose(bench["leaky.Psi"], 100 * bench["leaky.Phi_ind"])


def test_an_eddy_current_opposes_the_change(bench):
    # seen from the coil: N**2/G = 2 Ohm beside 0.5 H
    t = np.asarray(bench.t)
    assert np.allclose(bench["eddy.i"], 0.5 - 0.25 * np.exp(-2 * t), atol=1e-6)
    assert np.all(np.asarray(bench["turn.LossPower"]) >= 0)
    assert np.allclose(bench["turn.LossPower"], bench["eddy.v"] ** 2 / 2, atol=1e-6)


def test_two_coils_are_a_transformer(bench):
    # 4 Ohm beside 0.5 H, seen from the primary side behind 2 Ohm
    t = np.asarray(bench.t)
    voltage = 4 / 6 * np.exp(-(8 / 6) / 0.5 * t)
    assert np.allclose(bench["primary.v"], voltage, atol=1e-6)
    assert np.allclose(np.abs(bench["load.v"]), voltage / 2, atol=1e-6)
