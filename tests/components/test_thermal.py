"""Heat transfer: MSL's names and defaults, temperature scales, and a bench of analytic responses."""

import inspect

import numpy as np
import pytest

import acausal as ac
from acausal.components import thermal
from acausal.flattening.flat_model import flatten

SCALES = {"celsius": "Celsius", "fahrenheit": "Fahrenheit", "rankine": "Rankine"}

# Parameters and options with their defaults, as in MSL 4.1.0 (`...` marks those without a default).
DEFAULTS = {
    "HeatCapacitor": {"C": ...},
    "ThermalConductor": {"G": ...},
    "ThermalResistor": {"R": ...},
    "BodyRadiation": {"Gr": ...},
    "Convection": {},
    "ConvectiveResistor": {},
    "ThermalCollector": {"m": 3},
    "ThermalCollectorMatrix": {"Ns": ..., "Np": ...},
    "GeneralHeatFlowToTemperatureAdaptor": {"use_pder": True},
    "GeneralTemperatureToHeatFlowAdaptor": {"use_pder": True},
    "TemperatureSensor": {},
    "RelTemperatureSensor": {},
    "HeatFlowSensor": {},
    "ConditionalFixedHeatFlowSensor": {"useFixedTemperature": False},
    "FixedTemperature": {"T": ...},
    "PrescribedTemperature": {},
    "FixedHeatFlow": {"Q_flow": ..., "T_ref": 293.15, "alpha": 0},
    "PrescribedHeatFlow": {"T_ref": 293.15, "alpha": 0},
    "DirectCapacity": {"C": 1},
    "InverseCapacity": {"C": 1},
    "Conduction": {"G": 1},
}  # fmt: skip
BASES = ("Element1D",)


def minimal(cls):
    """An instance with the value 1 for all that must be given."""
    if cls is thermal.ThermalCollectorMatrix:
        return cls(Ns=2, Np=3)
    needed = {
        name: 1.0
        for name, d in cls._declared.items()
        if isinstance(d, ac.Parameter) and d.default is None
    }
    return cls(**needed)


# -- declarations ------------------------------------------------------------------------------------


def test_every_class_is_documented_and_in_the_table():
    for name in thermal.__all__:
        found = getattr(thermal, name)
        assert inspect.getdoc(found), name
        concrete = inspect.isclass(found) and issubclass(found, ac.Component)
        concrete = concrete and not name.startswith("Partial") and name not in BASES
        assert concrete == (name in DEFAULTS), name


@pytest.mark.parametrize("name", DEFAULTS)
def test_names_and_defaults_are_those_of_the_standard_library(name):
    cls = getattr(thermal, name)
    for key, default in DEFAULTS[name].items():
        assert cls._declared[key].default == (None if default is ... else default), key


@pytest.mark.parametrize("name", DEFAULTS)
def test_every_class_has_as_many_equations_as_unknowns(name):
    model = flatten(minimal(getattr(thermal, name)))
    assert model.n_equations == model.n_variables - len(model.inputs)


@pytest.mark.parametrize(
    "component",
    [
        thermal.ThermalCollector(m=5),
        thermal.ConditionalFixedHeatFlowSensor(useFixedTemperature=True),
        thermal.GeneralHeatFlowToTemperatureAdaptor(use_pder=False),
        thermal.GeneralTemperatureToHeatFlowAdaptor(use_pder=False),
    ],
    ids=repr,
)
def test_options_keep_the_balance(component):
    model = flatten(component)
    assert model.n_equations == model.n_variables - len(model.inputs)


@pytest.mark.parametrize("module", SCALES)
def test_other_scales_have_the_same_classes(module):
    scale = getattr(thermal, module)
    for name in scale.__all__:
        cls = getattr(scale, name)
        assert inspect.getdoc(cls)
        model = flatten(minimal(cls))
        assert model.n_equations == model.n_variables - len(model.inputs)
    assert {SCALES[module], "Kelvin"} <= set(scale.ToKelvin._declared)


def test_a_heat_capacity_cannot_be_negative():
    with pytest.raises(ac.DeclarationError, match=r"C=-1 is out of range: at least 0 J/K"):
        thermal.HeatCapacitor(C=-1)


class Device(thermal.PartialConditionalHeatPort):
    """Two heat sources behind one optional heat port."""

    def __init__(self, **modifiers):
        super().__init__(**modifiers)
        self.sources = [thermal.FixedHeatFlow(Q_flow=2), thermal.FixedHeatFlow(Q_flow=3)]
        for source in self.sources:
            self.connect(source.port, self.internalHeatPort)


# -- a bench of experiments ----------------------------------------------------------------------------


def at(T):
    return ac.Start(T, fixed=True)


class Bench(ac.Component):
    """Independent experiments side by side, so that one program simulates all."""

    def __init__(self):
        super().__init__()
        # two masses, once joined by a conductor, once by two resistors with sensors in between
        self.hot, self.cold = (
            thermal.HeatCapacitor(C=2, T=at(400)),
            thermal.HeatCapacitor(C=2, T=at(300)),
        )
        self.conductor = thermal.ThermalConductor(G=3)
        self.connect(self.hot.port, self.conductor.port_a)
        self.connect(self.conductor.port_b, self.cold.port)

        self.left, self.right = (
            thermal.HeatCapacitor(C=2, T=at(400)),
            thermal.HeatCapacitor(C=2, T=at(300)),
        )
        self.first, self.second = thermal.ThermalResistor(R=1 / 3), thermal.ThermalResistor(R=0)
        self.flow = thermal.HeatFlowSensor()
        self.maybe = thermal.ConditionalFixedHeatFlowSensor()
        self.absent = thermal.ConditionalFixedHeatFlowSensor(useFixedTemperature=True)
        self.difference = thermal.RelTemperatureSensor()
        self.connect(self.left.port, self.flow.port_a, self.difference.port_a)
        self.connect(self.flow.port_b, self.first.port_a)
        self.connect(self.first.port_b, self.maybe.port_a)
        self.connect(self.maybe.port_b, self.second.port_a)
        self.connect(self.second.port_b, self.right.port, self.difference.port_b)

        # losses that grow with temperature; a heat flow signal; a device with and without heat port
        self.warming = thermal.HeatCapacitor(C=4, T=at(293.15))
        self.losses = thermal.FixedHeatFlow(Q_flow=20, alpha=0.1)
        self.connect(self.losses.port, self.warming.port)
        self.heated = thermal.HeatCapacitor(C=4, T=at(300))
        self.heater = thermal.PrescribedHeatFlow()
        self.connect(self.heater.port, self.heated.port)
        self.device, self.isolated = Device(useHeatPort=True), Device(T=310)
        self.sink = thermal.FixedTemperature(T=320)
        self.connect(self.device.heatPort, self.sink.port)

        # convection and radiation from a body at a given temperature, collected
        self.body = thermal.PrescribedTemperature()
        self.air = thermal.celsius.FixedTemperature(T=20)
        self.space = thermal.fahrenheit.FixedTemperature(T=-459.67)
        self.convection, self.resistor = thermal.Convection(), thermal.ConvectiveResistor()
        self.radiation = thermal.BodyRadiation(Gr=2)
        self.collector = thermal.ThermalCollector()
        self.connect(self.body.port, self.collector.port_b)
        self.connect(self.collector.port_a[0], self.convection.solid)
        self.connect(self.collector.port_a[1], self.resistor.solid)
        self.connect(self.collector.port_a[2], self.radiation.port_a)
        self.connect(self.air.port, self.convection.fluid, self.resistor.fluid)
        self.connect(self.radiation.port_b, self.space.port)
        self.thermometers = [
            thermal.TemperatureSensor(), *(getattr(thermal, m).TemperatureSensor() for m in SCALES)
        ]  # fmt: skip
        for thermometer in self.thermometers:
            self.connect(thermometer.port, self.body.port)

        # scales as blocks: there and back again
        self.there = [getattr(thermal, m).FromKelvin() for m in SCALES]
        self.back = [getattr(thermal, m).ToKelvin() for m in SCALES]
        for there, back, scale in zip(self.there, self.back, SCALES.values(), strict=True):
            self.connect(self.thermometers[0].T, there.Kelvin)
            self.connect(getattr(there, scale), getattr(back, scale))

        # adaptors
        self.driven = thermal.HeatCapacitor(C=2, T=at(300))
        self.to_T = thermal.GeneralHeatFlowToTemperatureAdaptor()
        self.connect(self.to_T.heatPort, self.driven.port)
        self.forced = thermal.HeatCapacitor(C=2)
        self.to_Q = thermal.GeneralTemperatureToHeatFlowAdaptor()
        self.connect(self.to_Q.heatPort, self.forced.port)


@pytest.fixture(scope="module")
def system():
    return ac.compile(Bench())


@pytest.fixture(scope="module")
def bench(system):
    inputs = {
        "heater.Q_flow": lambda t: 8 * t, "body.T": lambda t: 350 + 10 * t,
        "convection.Gc": 2.0, "resistor.Rc": 0.25, "to_T.f": lambda t: -4 * t,
        "to_Q.p": lambda t: 300 + t**2, "to_Q.pder": lambda t: 2 * t,
    }  # fmt: skip
    solution = ac.simulate(system, t=(0, 1), dt=0.01, inputs=inputs)
    return solution.to_dict()  # all variables by one program


def test_temperatures_are_the_states(system):
    assert set(system.states) == {
        f"{n}.T" for n in ("hot", "cold", "left", "right", "warming", "heated", "driven")
    }


@pytest.mark.parametrize(("hot", "cold"), [("hot", "cold"), ("left", "right")])
def test_two_masses_approach_each_other(bench, hot, cold):
    half = 50 * np.exp(-3 * bench["time"])
    assert np.allclose(bench[f"{hot}.T"], 350 + half, atol=1e-6)
    assert np.allclose(bench[f"{cold}.T"], 350 - half, atol=1e-6)
    assert np.allclose(bench[f"{cold}.der_T"], 3 * half, atol=1e-5)


def test_sensors_tell_flow_and_difference(bench):
    apart = 100 * np.exp(-3 * bench["time"])
    assert np.allclose(bench["conductor.Q_flow"], 3 * apart, atol=1e-5)
    assert np.allclose(bench["flow.Q_flow"], 3 * apart, atol=1e-5)
    assert np.allclose(bench["maybe.Q_flow"], 3 * apart, atol=1e-5)
    assert np.allclose(bench["difference.T_rel"], apart, atol=1e-6)
    assert np.allclose(bench["absent.Q_flow"], 0)
    assert np.allclose(bench["absent.port_a.T"], 293.15)


def test_losses_grow_with_temperature(bench):
    # 4 der(T) = 20 (1 + 0.1 (T - 293.15))
    assert np.allclose(bench["warming.T"], 283.15 + 10 * np.exp(bench["time"] / 2), atol=1e-6)


def test_a_heat_flow_signal_heats(bench):
    assert np.allclose(bench["heated.T"], 300 + bench["time"] ** 2, atol=1e-6)


def test_a_device_hands_its_heat_to_its_port_or_keeps_its_temperature(bench):
    assert np.allclose(bench["sink.port.Q_flow"], 5)
    assert np.allclose(bench["device.sources[1].port.T"], 320)
    assert np.allclose(bench["isolated.sources[2].port.T"], 310)
    assert np.allclose(bench["isolated.fixedTemperature.port.Q_flow"], 5)


def test_convection_and_radiation_are_collected(bench):
    T = 350 + 10 * bench["time"]
    assert np.allclose(bench["convection.Q_flow"], 2 * (T - 293.15))
    assert np.allclose(bench["resistor.Q_flow"], 4 * (T - 293.15))
    assert np.allclose(bench["radiation.Q_flow"], 2 * 5.670374e-8 * T**4, rtol=1e-6)
    parts = ("convection", "resistor", "radiation")
    assert np.allclose(bench["body.port.Q_flow"], -sum(bench[f"{n}.Q_flow"] for n in parts))


def test_temperatures_on_other_scales(bench):
    T = np.asarray(350 + 10 * bench["time"])
    expected = (T, T - 273.15, T * 1.8 - 459.67, T * 1.8)
    for i, value in enumerate(expected, start=1):
        assert np.allclose(bench[f"thermometers[{i}].T"], value)
    for i, value in enumerate(expected[1:], start=1):
        scale = list(SCALES.values())[i - 1]
        assert np.allclose(bench[f"there[{i}].{scale}"], value)
        assert np.allclose(bench[f"back[{i}].Kelvin"], T)


def test_adaptors_exchange_heat_flow_and_temperature(bench):
    assert np.allclose(bench["to_T.p"], 300 + bench["time"] ** 2, atol=1e-6)
    assert np.allclose(bench["to_T.pder"], 2 * bench["time"], atol=1e-6)
    assert np.allclose(bench["to_Q.f"], 4 * bench["time"])  # what drives C = 2 to 300 + t^2
