"""Coolant circuits: MSL's names and defaults, media, and a bench of analytic responses."""

import inspect
from itertools import pairwise

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import fluid, neural, rotational, thermal, translational as tl
from acausal.flattening.flat_model import flatten

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
    "DoubleRamp": {
        "offset": 1, "startTime": 0.2, "interval": 0.2, "height_1": -1, "duration_1": 0.2, "height_2": 1,
        "duration_2": 0.2,
    },
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
    "RelativeSensor", "FlowSensor", "PartialMedium", "PartialAdiabatic", "PartialSinglePort",
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
    if "medium" in cls._declared:
        assert cls._declared["medium"].default == fluid.Medium()
    for key, default in DEFAULTS[name].items():
        assert cls._declared[key].default == (None if default is ... else default), key


@pytest.mark.parametrize("name", DEFAULTS)
def test_every_class_has_as_many_equations_as_unknowns(name):
    model = flatten(minimal(getattr(fluid, name)))
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
    with pytest.raises(
        ac.DeclarationError, match=r"is not a medium; give a record such as fluid\.Wat"
    ):
        fluid.Ambient(medium=fluid.Water)


def test_equal_media_make_one_form():
    class Two(ac.Component):
        def __init__(self):
            super().__init__()
            self.a, self.b = (
                fluid.Ambient(medium=fluid.Water()),
                fluid.Ambient(medium=fluid.Water()),
            )

    model = flatten(Two())
    assert len(model.layout.forms) == 2  # and that of the model itself
    values = {model.layout.parameter(i): v for i, v in enumerate(model.value)}
    assert values["a.cp"] == values["b.cp"] == 4177


def test_an_input_needs_no_constant_and_the_other_way_round():
    with pytest.raises(ac.DeclarationError, match="'constantVolumeFlow'; give it"):
        flatten(fluid.VolumeFlow())
    assert len(flatten(fluid.VolumeFlow(useVolumeFlowInput=True)).inputs) == 1


@pytest.mark.parametrize(("m", "states"), [(0, ()), (0.0, ()), (0.1, ("pump.T",))])
def test_without_mass_there_is_no_state(m, states):
    class Line(ac.Component):
        def __init__(self):
            super().__init__()
            self.left, self.right = fluid.Ambient(), fluid.Ambient()
            self.pump = fluid.VolumeFlow(m=0.5, constantVolumeFlow=1)
            self.connect(self.left.flowPort, self.pump.flowPort_a)
            self.connect(self.pump.flowPort_b, self.right.flowPort)

    line = Line()
    line.pump.m = m
    assert ac.compile(line).states == states


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
            (
                getattr(p, "flowPort", None) or p.flowPort_a,
                getattr(p, "flowPort", None) or p.flowPort_b,
            )
            for p in parts
        ]
        for (_, left), (right, _) in pairwise(ends):
            self.connect(left, right)

    def heated(self):
        """Water is pumped through a pipe that is heated, upwards."""
        self.inlet = fluid.Ambient(
            medium=WATER, constantAmbientTemperature=300, constantAmbientPressure=1e5
        )
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
        self.filled = fluid.VolumeFlow(
            medium=WATER, m=0.5, T0=320, T0fixed=True, useVolumeFlowInput=True
        )
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


OBSERVED = """
    against.Q_flow against.V_flow boiler.T boost.V_flow bypass.V_flow cold_side.port.Q_flow
    cooler.T_a cylinder.H cylinder.T cylinder.f cylinder.flowPort.m_flow cylinder.m dp.y
    drain.T_port enthalpy.y exponential.V_flow filled.T filled.T_a filled.T_q heater.port.T
    high.H high.T high.level high.m ideal.V_flow ideal.V_flow1 ideal.dp ideal.dp1
    ideal.flange_a.tau level.flowPort.m_flow level.flowPort.p linear.V_flow low.H low.TTank
    low.flowPort.p low.level low.m mass.y one_way.V_flow one_way.backward outlet.T outlet.T_port
    p.y T.y dT.y pipe.T pipe.T_a pipe.T_b pipe.dT pipe.dp pipe.pressureDrop pump.dp shuttle.T shuttle.T_a
    shuttle.T_b stove.T straight.V_flow volume.y
"""


@pytest.fixture(scope="module")
def system():
    return ac.compile(Bench())


@pytest.fixture(scope="module")
def bench(system):
    inputs = {
        "warm.ambientTemperature": lambda t: 360 + 10 * t, "drain.ambientPressure": 2e5,
        "shuttle.volumeFlow": lambda t: -0.01 * jnp.sin(2 * np.pi * t),
        "filled.volumeFlow": lambda t: -0.01 * jnp.sin(2 * np.pi * t),
        "source.ambientPressure": lambda t: 30 * jnp.cos(np.pi * t),
        "linear.y": 1.0, "exponential.y": 3.0,
    }  # fmt: skip
    solution = ac.simulate(system, t=(0, 1), dt=0.01, inputs=inputs)
    return solution.to_dict(OBSERVED.split())  # by one program


def test_states_are_levels_and_temperatures_of_what_has_a_mass(system):
    assert set(system.states) == {
        "pipe.T", "filled.T", "high.T", "high.level", "low.T", "low.level", "boiler.T", "boiler.level",
        "cylinder.T", "cylinder.s", "shaft.phi",
    }  # fmt: skip


@pytest.mark.slow
def test_a_heated_pipe(bench):
    flow = 1e-3 * WATER.rho
    drop = 1e6 * 1e-3 + 3e3 / 1.9e-3**2 * 0.9e-3**2
    rise = (8e3 + 1e-3 * drop) / (flow * WATER.cp) * (1 - np.exp(-bench["time"] * flow / 0.5))
    assert np.allclose(bench["pipe.pressureDrop"], drop)
    assert np.allclose(bench["pipe.dp"], drop + WATER.rho * 9.80665 * 2)
    assert np.allclose(bench["pump.dp"], 1e5 - bench["pipe.dp"])
    assert np.allclose(bench["pipe.T"], 300 + rise, atol=1e-6)
    assert np.allclose(bench["pipe.T_a"], 300, atol=1e-6)
    assert np.allclose(bench["pipe.T_b"], 300 + rise, atol=1e-6)
    assert np.allclose(bench["pipe.dT"], rise, atol=1e-6)
    assert np.allclose(bench["heater.port.T"], 300 + rise / 4, atol=1e-6)
    assert np.allclose(bench["outlet.T_port"], 300 + rise, atol=1e-6)
    assert np.allclose(bench["outlet.T"], 293.15)


@pytest.mark.slow
def test_two_flows_mix_and_sensors_tell(bench):
    warm = 360 + 10 * bench["time"]
    mixed = (3 * warm + 280) / 4
    assert np.allclose(bench["mass.y"], 4e-3 * WATER.rho)
    assert np.allclose(bench["volume.y"], 4e-3)
    assert np.allclose(bench["enthalpy.y"], 4e-3 * C * mixed)
    assert np.allclose(bench["p.y"], 2e5)
    assert np.allclose(bench["dp.y"], -2e5)
    assert np.allclose(bench["T.y"], mixed, atol=1e-5)
    assert np.allclose(bench["dT.y"], warm - mixed, atol=1e-5)
    assert np.allclose(bench["drain.T_port"], mixed, atol=1e-5)


def test_a_flow_turns_round_from_rest(bench):
    t = bench["time"]
    forth = t > 0.5
    k = WATER.rho / 0.5 * 0.01 / (2 * np.pi)
    first = 350 - 30 * np.exp(-k * (1 - np.cos(2 * np.pi * t)))
    second = 300 + (350 - 30 * np.exp(-2 * k) - 300) * np.exp(-k * (1 + np.cos(2 * np.pi * t)))
    T = np.where(forth, second, first)
    assert np.allclose(bench["filled.T"], T, atol=1e-4)
    moving = np.abs(np.sin(2 * np.pi * t)) > 1e-6
    assert np.allclose(bench["shuttle.T"][moving], np.where(forth, 300, 350)[moving], atol=1e-3)
    west = np.where(forth, 300, (350 + T) / 2)
    assert np.allclose(bench["shuttle.T_a"][moving], west[moving], atol=1e-3)
    for name in ("shuttle.T", "shuttle.T_a", "shuttle.T_b", "filled.T_a", "filled.T_q"):
        assert np.all((bench[name] > 299) & (bench[name] < 351)), name
    assert bench["shuttle.T"][0] == pytest.approx((300 + 350 + 320) / 3, rel=0.1)


def test_valves_pass_what_the_pressure_drop_drives(bench):
    dp = 30 * np.cos(np.pi * bench["time"])
    x = np.sign(dp) * np.sqrt(np.abs(dp) / 4 * 2)
    assert np.allclose(bench["linear.V_flow"], 0.5 * 0.505 * x, atol=1e-5)
    assert np.allclose(bench["exponential.V_flow"], 0.5 * x, atol=1e-5)
    passing = np.where(dp > 0, 4 * dp, 1e-3 * dp)
    assert np.allclose(bench["one_way.V_flow"], passing, atol=1e-9)
    assert np.allclose(bench["one_way.backward"], dp < 0)
    assert np.allclose(bench["against.V_flow"], np.where(dp < 0, -4 * dp, -1e-3 * dp), atol=1e-9)
    assert np.allclose(bench["against.Q_flow"], -dp * bench["against.V_flow"])
    V = np.asarray(bench["straight.V_flow"])
    assert np.allclose(5 * V + 2.5 * np.sign(V) * np.maximum(np.abs(V) - 2, 0) ** 2, dp)


def test_tanks_level_and_mix(bench):
    apart = 0.8 * np.exp(-4 * bench["time"])
    assert np.allclose(bench["high.level"] - bench["low.level"], apart, atol=1e-6)
    assert np.allclose(bench["high.m"] + bench["low.m"], 1)
    assert np.allclose(bench["high.H"] + bench["low.H"], 0.9 * 350 + 0.1 * 300, atol=1e-5)
    assert np.allclose(bench["high.T"], 350, atol=1e-6)
    assert np.allclose(bench["low.TTank"] * bench["low.m"], 350 * bench["low.m"] - 5, atol=1e-5)
    assert np.allclose(bench["low.flowPort.p"], 1e5 + 10 * bench["low.level"])
    assert np.allclose(bench["boiler.T"], 300 + 6 * bench["time"], atol=1e-6)


def test_a_closed_circuit_balances(bench):
    assert np.allclose(bench["boost.V_flow"], 2)
    assert np.allclose(bench["bypass.V_flow"], 1)
    assert np.allclose(bench["level.flowPort.m_flow"], 0, atol=1e-9)
    assert np.allclose(bench["level.flowPort.p"], 5)
    assert np.allclose(bench["stove.T"], 296, atol=1e-6)
    assert np.allclose(bench["cooler.T_a"], 293, atol=1e-6)
    assert np.allclose(bench["cold_side.port.Q_flow"], 6, atol=1e-6)


def test_an_ideal_pump_turns_shaft_power_into_pressure(bench):
    assert np.allclose(bench["ideal.V_flow"], 1)
    assert np.allclose(bench["ideal.dp"], -5)
    assert np.allclose(bench["ideal.flange_a.tau"], 1)
    assert np.allclose(bench["ideal.dp1"], 10)
    assert np.allclose(bench["ideal.V_flow1"], 2)


def test_a_cylinder_draws_in(bench):
    m = 2 * (0.1 + 0.5 * bench["time"])
    assert np.allclose(bench["cylinder.m"], m, atol=1e-6)
    assert np.allclose(bench["cylinder.T"], 350 - 50 * 0.2 / m, atol=1e-5)
    assert np.allclose(bench["cylinder.f"], -2e5)
    assert np.allclose(bench["cylinder.flowPort.m_flow"], 1)
    assert np.allclose(bench["cylinder.H"], m * bench["cylinder.T"], atol=1e-5)


@pytest.mark.parametrize(("p", "T_port"), [(3.0, 350.0), (-3.0, 300.0)])
def test_a_neural_element_passes_enthalpy_on(p, T_port):
    class Line(ac.Component):
        def __init__(self):
            super().__init__()
            self.left = fluid.Ambient(
                medium=WATER, constantAmbientTemperature=350, constantAmbientPressure=p
            )
            self.right = fluid.Ambient(medium=WATER, constantAmbientTemperature=300)
            self.element = neural.Resistance(fluid.FlowPort, net=lambda key: lambda dp: 0.1 * dp)
            self.connect(self.left.flowPort, self.element.flowPort_a)
            self.connect(self.element.flowPort_b, self.right.flowPort)

    system = ac.compile(Line())
    names = ["element.dp", "element.m_flow", "left.T_port", "right.T_port", "right.flowPort.H_flow"]
    values = system.observe(names, 0.0, np.zeros(0), np.zeros(0), system.parameters())
    H_flow = 0.1 * p * WATER.cp * T_port
    assert np.allclose(values, [p, 0.1 * p, T_port, T_port, H_flow], rtol=1e-6)
