"""Coolant circuits: MSL's names and defaults, media, and a bench of analytic responses."""

import inspect

import numpy as np
import pytest

import acausal as ac
from acausal.components import fluid, neural, rotational, thermal
from acausal.components import translational as tl
from acausal.flatten import flatten
from tests.oracle import worst

FRICTION = {
    "V_flowLaminar": ..., "dpLaminar": ..., "V_flowNominal": ..., "dpNominal": ..., "frictionLoss": 0,
}  # fmt: skip
VOLUME = {"m": 0, "T0": 293.15, "T0fixed": False}

# Parameters and options with their defaults, as in MSL 4.1.0 (`...` marks those without a default; zero
# and 293.15 K are what Modelica proposes for the others that it leaves without a value).
DEFAULTS = {
    "Pipe": {**VOLUME, **FRICTION, "tapT": 1, "useHeatPort": False, "h_g": 0, "g": 9.80665},
    "Valve": {
        **VOLUME, "LinearCharacteristic": True, "y1": ..., "Kv1": ..., "kv0": ..., "dp0": ...,
        "rho0": ..., "frictionLoss": 0,
    },
    "OneWayValve": {
        **VOLUME, "V_flowNominal": ..., "dpForward": 1e-6, "dpNominal": ..., "V_flowBackward": ...,
        "frictionLoss": 0,
    },
    "OpenTank": {
        "T0": 293.15, "T0fixed": False, "ATank": ..., "hTank": ..., "pAmbient": 0, "g": 9.80665,
        "useHeatPort": False,
    },
    "Cylinder": {"T0": 293.15, "T0fixed": False, "A": ..., "L": ..., "useSupport": False},
    "Ambient": {
        "usePressureInput": False, "constantAmbientPressure": 0, "useTemperatureInput": False,
        "constantAmbientTemperature": 293.15,
    },
    "AbsolutePressure": {"p": 0},
    "VolumeFlow": {**VOLUME, "useVolumeFlowInput": False, "constantVolumeFlow": ...},
    "PressureIncrease": {
        **VOLUME, "usePressureIncreaseInput": False, "constantPressureIncrease": ...,
    },
    "IdealPump": {**VOLUME, "wNominal": ..., "dp0": ..., "V_flow0": ...},
    "PressureSensor": {},
    "TemperatureSensor": {},
    "RelPressureSensor": {},
    "RelTemperatureSensor": {},
    "MassFlowSensor": {},
    "VolumeFlowSensor": {},
    "EnthalpyFlowSensor": {},
}  # fmt: skip
BASES = (
    "TwoPort", "SimpleFriction", "SinglePortLeft", "SinglePortBottom", "AbsoluteSensor",
    "RelativeSensor", "FlowSensor",
)  # fmt: skip

# rho, cp, cv, lambda, nu
MEDIA = {
    "Medium": (1, 1, 1, 1, 1),
    "Air_30degC": (1.149, 1007, 720, 0.0264, 16.3e-6),
    "Air_70degC": (1.015, 1010, 723, 0.0293, 20.3e-6),
    "Water_10degC": (999.7, 4192, 4192, 0.588, 1.307e-6),
    "Water": (995.6, 4177, 4177, 0.615, 0.8e-6),
    "Water_90degC": (965.3, 4205, 4205, 0.676, 0.347e-6),
    "Gylcol20_20degC": (1028, 3910, 3910, 0.523, 1.69e-6),
    "Gylcol50_20degC": (1078, 3300, 3300, 0.405, 3.98e-6),
    "MineralOil": (868, 2010, 2010, 0.14, 81.8e-6),
}


def minimal(cls, **given):
    """An instance with the value 1 for all that must be given."""
    needed = {
        name: 1.0
        for name, d in cls._declared.items()
        if isinstance(d, ac.Parameter) and d.default is None
    }
    return cls(**{**needed, **given})


# -- declarations ------------------------------------------------------------------------------------


def test_every_class_is_documented_and_in_the_table():
    for name in fluid.__all__:
        found = getattr(fluid, name)
        assert inspect.getdoc(found), name
        concrete = inspect.isclass(found) and issubclass(found, ac.Component) and name not in BASES
        assert concrete == (name in DEFAULTS), name


@pytest.mark.parametrize("name", DEFAULTS)
def test_names_and_defaults_are_those_of_the_standard_library(name):
    cls = getattr(fluid, name)
    assert cls._declared["medium"].default == fluid.Medium()
    for key, default in DEFAULTS[name].items():
        assert cls._declared[key].default == (None if default is ... else default), key


@pytest.mark.parametrize("name", DEFAULTS)
def test_every_class_has_as_many_equations_as_unknowns(name):
    model = flatten(minimal(getattr(fluid, name), medium=fluid.Water()))
    assert model.n_equations == model.n_variables - len(model.inputs)


@pytest.mark.parametrize(
    "component",
    [
        minimal(fluid.Pipe, useHeatPort=True, m=2),
        minimal(fluid.OpenTank, useHeatPort=True),
        minimal(fluid.Valve, LinearCharacteristic=False),
        fluid.Ambient(usePressureInput=True, useTemperatureInput=True),
        fluid.VolumeFlow(useVolumeFlowInput=True, constantVolumeFlow=1),
        fluid.PressureIncrease(usePressureIncreaseInput=True),
        minimal(fluid.Cylinder, useSupport=True),
    ],
    ids=repr,
)
def test_options_keep_the_balance(component):
    model = flatten(component)
    assert model.n_equations == model.n_variables - len(model.inputs)


@pytest.mark.parametrize("name", MEDIA)
def test_media(name):
    medium = getattr(fluid, name)()
    found = (medium.rho, medium.cp, medium.cv, medium.lambda_, medium.nu)
    assert found == MEDIA[name]
    assert isinstance(medium, fluid.Medium)


def test_a_medium_is_a_record():
    with pytest.raises(ac.DeclarationError, match=r"is no medium; give a record such as fluid\.Wat"):
        fluid.Ambient(medium=fluid.Water)


def test_equal_media_make_one_form():
    class Two(ac.Component):
        def __init__(self):
            super().__init__()
            self.a, self.b = fluid.Ambient(medium=fluid.Water()), fluid.Ambient(medium=fluid.Water())

    model = flatten(Two())
    assert len(model.layout.forms) == 2  # and that of the model itself
    values = {model.layout.parameter(i): v for i, v in enumerate(model.value)}
    assert values["a.cp"] == values["b.cp"] == 4177


def test_an_input_needs_no_constant_and_the_other_way_round():
    with pytest.raises(ac.DeclarationError, match="'constantVolumeFlow'; give it"):
        flatten(fluid.VolumeFlow())
    assert len(flatten(fluid.VolumeFlow(useVolumeFlowInput=True)).inputs) == 1


@pytest.mark.parametrize(("m", "states"), [(0, ()), (0.0, ()), (0.1, ("T",))])
def test_without_mass_there_is_no_state(m, states):
    pipe = fluid.VolumeFlow(m=0.5, constantVolumeFlow=1)
    pipe.m = m
    assert ac.compile(pipe).states == states


# -- a bench of experiments ----------------------------------------------------------------------------

WATER = fluid.Water()
C = WATER.rho * WATER.cp
LAMINAR = {"V_flowLaminar": 2.0, "V_flowNominal": 4.0, "dpLaminar": 10.0, "dpNominal": 30.0}


def at(value):
    return ac.Start(value, fixed=True)


class Bench(ac.Component):
    """Independent circuits side by side, so that one program simulates all."""

    def __init__(self):
        super().__init__()
        self.ambient = fluid.Ambient()
        self.heated()
        self.mixing()
        self.reversing()
        self.valves()
        self.tanks()
        self.closed()
        self.machines()

    def line(self, *parts):
        """Connect two-ports one after the other; single ports stand at the ends."""
        ends = [
            (getattr(p, "flowPort", None) or p.flowPort_a, getattr(p, "flowPort", None) or p.flowPort_b)
            for p in parts
        ]
        for (_, left), (right, _) in zip(ends, ends[1:], strict=False):
            self.connect(left, right)

    def heated(self):
        """Water is pumped through a pipe that is heated, upwards."""
        self.inlet = fluid.Ambient(medium=WATER, constantAmbientTemperature=300, constantAmbientPressure=1e5)
        self.pump = fluid.VolumeFlow(medium=WATER, constantVolumeFlow=1e-3)
        self.pipe = fluid.Pipe(
            medium=WATER, m=0.5, T0=300, T0fixed=True, tapT=0.25, h_g=2, useHeatPort=True, V_flowLaminar=1e-4,
            dpLaminar=100, V_flowNominal=2e-3, dpNominal=5e3, frictionLoss=1,
        )  # fmt: skip
        self.heater = thermal.FixedHeatFlow(Q_flow=8e3)
        self.outlet = fluid.Ambient(medium=WATER)
        self.line(self.inlet, self.pump, self.pipe, self.outlet)
        self.connect(self.heater.port, self.pipe.heatPort)

    def mixing(self):
        """Two flows meet, are measured, and leave."""
        self.warm = fluid.Ambient(medium=WATER, useTemperatureInput=True)
        self.cold = fluid.Ambient(medium=WATER, constantAmbientTemperature=280)
        self.one = fluid.VolumeFlow(medium=WATER, constantVolumeFlow=3e-3)
        self.two = fluid.VolumeFlow(medium=WATER, constantVolumeFlow=1e-3)
        self.mass, self.volume, self.enthalpy = (
            cls(medium=WATER)
            for cls in (fluid.MassFlowSensor, fluid.VolumeFlowSensor, fluid.EnthalpyFlowSensor)
        )
        self.p, self.T = fluid.PressureSensor(), fluid.TemperatureSensor(medium=WATER)
        self.dp, self.dT = fluid.RelPressureSensor(), fluid.RelTemperatureSensor(medium=WATER)
        self.drain = fluid.Ambient(medium=WATER, usePressureInput=True)
        self.line(self.warm, self.one, self.mass, self.volume, self.enthalpy, self.drain)
        self.line(self.cold, self.two, self.mass)
        self.connect(self.p.flowPort, self.T.flowPort, self.mass.flowPort_a)
        self.connect(self.dp.flowPort_a, self.dT.flowPort_a, self.one.flowPort_a)
        self.connect(self.dp.flowPort_b, self.dT.flowPort_b, self.one.flowPort_b)

    def reversing(self):
        """A flow turns round, from rest: through an empty and through a filled pipe."""
        self.west = fluid.Ambient(medium=WATER, constantAmbientTemperature=300)
        self.east = fluid.Ambient(medium=WATER, constantAmbientTemperature=350)
        self.shuttle = fluid.VolumeFlow(medium=WATER, useVolumeFlowInput=True, constantVolumeFlow=1)
        self.filled = fluid.VolumeFlow(medium=WATER, m=0.5, T0=320, T0fixed=True, useVolumeFlowInput=True)
        self.line(self.west, self.shuttle, self.east)
        self.line(self.west, self.filled, self.east)

    def valves(self):
        """Pressure drops are given, flows follow."""
        self.source = fluid.Ambient(usePressureInput=True)
        given = {"y1": 2, "Kv1": 0.5, "kv0": 0.01, "dp0": 4, "rho0": 2}
        self.linear = fluid.Valve(**given)
        self.exponential = fluid.Valve(**given, LinearCharacteristic=False)
        self.one_way = fluid.OneWayValve(
            V_flowNominal=2, dpForward=0.5, dpNominal=100, V_flowBackward=0.1
        )
        self.against = fluid.OneWayValve(
            V_flowNominal=2, dpForward=0.5, dpNominal=100, V_flowBackward=0.1, frictionLoss=1
        )
        self.straight = fluid.Pipe(**LAMINAR)
        for part in (self.linear, self.exponential, self.one_way, self.straight):
            self.line(self.source, part, self.ambient)
        self.line(self.ambient, self.against, self.source)

    def tanks(self):
        """Two tanks on one level in the end; a third one is heated."""
        given = {"ATank": 1, "hTank": 1, "g": 10, "T0fixed": True, "pAmbient": 1e5}
        self.high = fluid.OpenTank(**given, T0=350, level=at(0.9))
        self.low = fluid.OpenTank(**given, T0=300, level=at(0.1))
        self.between = fluid.Pipe(**LAMINAR)
        self.line(self.high, self.between, self.low)
        self.boiler = fluid.OpenTank(**given, T0=300, level=at(0.5), useHeatPort=True)
        self.flame = thermal.FixedHeatFlow(Q_flow=3)
        self.connect(self.flame.port, self.boiler.heatPort)

    def closed(self):
        """A closed circuit with a branch; heat in, heat out."""
        self.level = fluid.AbsolutePressure(p=5)
        self.boost = fluid.PressureIncrease(constantPressureIncrease=15)
        self.stove, self.bypass, self.cooler = (
            fluid.Pipe(**LAMINAR, useHeatPort=True) for _ in range(3)
        )
        self.fire, self.nothing = thermal.FixedHeatFlow(Q_flow=6), thermal.FixedHeatFlow(Q_flow=0)
        self.cold_side = thermal.FixedTemperature(T=290)
        self.line(self.level, self.boost, self.stove, self.cooler, self.boost)
        self.line(self.boost, self.bypass, self.cooler)
        self.connect(self.fire.port, self.stove.heatPort)
        self.connect(self.nothing.port, self.bypass.heatPort)
        self.connect(self.cold_side.port, self.cooler.heatPort)

    def machines(self):
        """A pump at half speed, and a cylinder that draws in."""
        self.shaft = rotational.ConstantSpeed(w_fixed=5)
        self.ideal = fluid.IdealPump(wNominal=10, dp0=40, V_flow0=4)
        self.load = fluid.Pipe(**LAMINAR)
        self.line(self.ambient, self.ideal, self.load, self.ambient)
        self.connect(self.shaft.flange, self.ideal.flange_a)
        self.hot = fluid.Ambient(constantAmbientTemperature=350, constantAmbientPressure=1e5)
        self.cylinder = fluid.Cylinder(A=2, L=1, T0=300, T0fixed=True)
        self.piston = tl.ConstantSpeed(v_fixed=0.5, s=at(0.1))
        self.connect(self.hot.flowPort, self.cylinder.flowPort)
        self.connect(self.piston.flange, self.cylinder.flange)


@pytest.fixture(scope="module")
def system():
    return ac.compile(Bench())


@pytest.fixture(scope="module")
def bench(system):
    inputs = {
        "warm.ambientTemperature": lambda t: 360 + 10 * t, "drain.ambientPressure": 2e5,
        "shuttle.volumeFlow": lambda t: -0.01 * np.sin(2 * np.pi * t),
        "filled.volumeFlow": lambda t: -0.01 * np.sin(2 * np.pi * t),
        "source.ambientPressure": lambda t: 10 * np.cos(np.pi * t),
        "linear.y": 1.0, "exponential.y": 3.0,
    }  # fmt: skip
    return ac.simulate(system, t=(0, 1), dt=0.01, inputs=inputs, rtol=1e-8, atol=1e-8)


def test_states_are_levels_and_temperatures_of_what_has_a_mass(system):
    assert set(system.states) == {
        "pipe.T", "filled.T", "high.T", "high.level", "low.T", "low.level", "boiler.T", "boiler.level",
        "cylinder.T", "piston.s", "shaft.phi",
    }  # fmt: skip
