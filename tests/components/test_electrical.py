"""Electrical circuits: MSL's names and defaults, characteristics at points, and a bench of responses."""

import inspect
import json
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal.codegen import default_parameters, pack
from acausal.components import (
    blocks,
    electrical as el,
    nature,
    rotational as rot,
    translational as tl,
)
from acausal.components.electrical import op_amp_circuits as oc
from acausal.components.thermal import HeatPort
from acausal.flattening.flat_model import flatten

HEAT = {"useHeatPort": False, "T": 293.15}
BY_TEMPERATURE = {"useHeatPort": None, "T": 293.15, "useTemperatureDependency": False}
RESISTANCE = {"T_ref": 300.15, "alpha": 0, "useHeatPort": False, "T": callable}
SWITCH = {"Ron": 1e-5, "Goff": 1e-5, **HEAT}
ARC = {**SWITCH, "V0": ..., "dVdt": ..., "Vmax": ...}
KNEE = {"Ron": 1e-5, "Goff": 1e-5, "Vknee": 0, **HEAT}
SIGNAL = {"offset": 0, "startTime": 0}
VARIABLE = {
    "useConstantAmplitude": False, "constantAmplitude": 1, "useConstantFrequency": False,
    "constantFrequency": 1, "offset": 0,
}  # fmt: skip
LINE = {"length": ..., "N": 1, "useHeatPort": False, "T": 293.15, "T_ref": 300.15}
THYRISTOR = {
    "VDRM": 100, "VRRM": 100, "IDRM": 0.1, "VTM": 1.7, "IH": 6e-3, "ITM": 25, "VGT": 0.7, "IGT": 5e-3,
    "TON": 1e-6, "TOFF": 15e-6, "Vt": 0.04, "Nbv": 0.74, **HEAT,
}  # fmt: skip
BIPOLAR = {
    "Bf": 50, "Br": 0.1, "Is": 1e-16, "Vak": 0.02, "Tauf": 0.12e-9, "Taur": 5e-9, "Ccs": 1e-12,
    "Cje": 0.4e-12, "Cjc": 0.5e-12, "Phie": 0.8, "Me": 0.4, "Phic": 0.8, "Mc": 0.333, "Gbc": 1e-15,
    "Gbe": 1e-15, "EMin": -100, "EMax": 40, "Vt": 0.02585, "Tnom": 300.15, "XTI": 3, "XTB": 0,
    "EG": 1.11, "NF": 1, "NR": 1, "IC": 0, "UIC": False, "useSubstrate": False, **BY_TEMPERATURE,
}  # fmt: skip
SUPPLY = {"Vps": 15, "Vns": -15}
CIRCUIT = {**SUPPLY, "V0": 15000}

# Parameters and options with their defaults, as in MSL 4.1.0: `...` marks those without, `callable` those
# that are computed from others.
IMPULSE = {"approximation": "Heidler", "T1": 10e-6, "T2": 350e-6, "m": 5}

DEFAULTS = {
    "Ground": {},
    "Resistor": {"R": ..., **RESISTANCE},
    "Conductor": {"G": ..., **RESISTANCE},
    "Capacitor": {"C": ...},
    "Inductor": {"L": ...},
    "SaturatingInductor": {"Inom": ..., "Lnom": ..., "Lzer": ..., "Linf": ..., "Ipar": callable},
    "Transformer": {"L1": ..., "L2": ..., "M": ...},
    "M_Transformer": {"N": 3, "L": [1, 0.1, 0.2, 2, 0.3, 3]},
    "Gyrator": {"G1": ..., "G2": ...},
    "RotationalEMF": {"useSupport": False, "k": ...},
    "TranslationalEMF": {"useSupport": False, "k": ...},
    "VCV": {"gain": ...},
    "VCC": {"transConductance": ...},
    "CCV": {"transResistance": ...},
    "CCC": {"gain": ...},
    "OpAmp": {"Slope": ...},
    "OpAmpDetailed": {
        "Rdm": 2e6, "Rcm": 2e9, "Cin": 1.4e-12, "Vos": 1e-3, "Ib": 80e-9, "Ios": 20e-9, "vcp": 0,
        "vcm": 0, "Avd0": 106, "CMRR": 90, "fp1": 5, "fp2": 2e6, "fp3": 20e6, "fp4": 100e6, "fz": 5e6,
        "sr_p": 0.5e6, "sr_m": 0.5e6, "Rout": 75, "Imaxso": 25e-3, "Imaxsi": 25e-3, "Ts": 1.2e-6,
    },
    "VariableResistor": RESISTANCE,
    "VariableConductor": RESISTANCE,
    "VariableCapacitor": {"Cmin": np.finfo(float).eps, "IC": 0, "UIC": False},
    "VariableInductor": {"Lmin": np.finfo(float).eps, "IC": 0, "UIC": False},
    "Potentiometer": {
        "R": ..., "T_ref": 293.15, "alpha": 0, "useHeatPort": False, "T": callable,
        "useRinput": False, "rConstant": 0.5,
    },
    "GeneralCurrentToVoltageAdaptor": {"use_pder": True, "use_fder": True},
    "GeneralVoltageToCurrentAdaptor": {"use_pder": True, "use_fder": True},
    "IdealDiode": KNEE,
    "IdealThyristor": KNEE,
    "IdealGTOThyristor": KNEE,
    "IdealTriac": {"Ron": 1e-5, "Goff": 1e-5, "Vknee": 0.8, "Rdis": 100, "Cdis": 0.005},
    "IdealTwoWaySwitch": SWITCH,
    "IdealIntermediateSwitch": SWITCH,
    "IdealOpeningSwitch": SWITCH,
    "IdealClosingSwitch": SWITCH,
    "ControlledIdealTwoWaySwitch": {"level": 0.5, **SWITCH},
    "ControlledIdealIntermediateSwitch": {"level": 0.5, **SWITCH},
    "ControlledIdealOpeningSwitch": {"level": 0.5, **SWITCH},
    "ControlledIdealClosingSwitch": {"level": 0.5, **SWITCH},
    "OpenerWithArc": ARC,
    "CloserWithArc": ARC,
    "ControlledOpenerWithArc": {"level": 0.5, **ARC},
    "ControlledCloserWithArc": {"level": 0.5, **ARC},
    "AD_Converter": {"N": 8, "VRefHigh": ..., "VRefLow": ..., "Rin": ...},
    "DA_Converter": {"N": 8, "Vref": ...},
    "IdealOpAmp": {},
    "IdealOpAmp3Pin": {},
    "IdealOpAmpLimited": {},
    "IdealizedOpAmpLimited": {
        "V0": 15000, "useSupply": False, **SUPPLY, "strict": True, "homotopyType": "NoHomotopy",
    },
    "IdealTransformer": {"n": ..., "considerMagnetization": False, "Lm1": ...},
    "Idle": {},
    "Short": {},
    "Diode": {
        "Ids": 1e-6, "Vt": 0.04, "Maxexp": 15, "R": 1e8, "EG": 1.11, "N": 1, "TNOM": 300.15, "XTI": 3,
        **BY_TEMPERATURE,
    },
    "Diode2": {
        "Vf": 0.7, "Ids": 1e-13, "Rs": 16, "Vt": callable, "N": 1, "Bv": 100, "Gp": 1e-6, **HEAT,
    },
    "ZDiode": {
        "Ids": 1e-6, "Vt": 0.04, "Maxexp": 30, "R": 1e8, "Bv": 5.1, "Ibv": 0.7, "Nbv": 0.74, **HEAT,
    },
    "NMOS": {
        "W": 20e-6, "L": 6e-6, "Beta": 0.041e-3, "Vt": 0.8, "K2": 1.144, "K5": 0.7311, "dW": -2.5e-6,
        "dL": -1.5e-6, "RDS": 1e7, "Tnom": 300.15, "kvt": -6.96e-3, "kk2": 6e-4, **BY_TEMPERATURE,
    },
    "PMOS": {
        "W": 20e-6, "L": 6e-6, "Beta": 0.0105e-3, "Vt": -1, "K2": 0.41, "K5": 0.839, "dW": -2.5e-6,
        "dL": -2.1e-6, "RDS": 1e7, "Tnom": 300.15, "kvt": -2.9e-3, "kk2": 6.2e-4, **BY_TEMPERATURE,
    },
    "NPN": BIPOLAR,
    "PNP": BIPOLAR,
    "Thyristor": THYRISTOR,
    "SimpleTriac": THYRISTOR,
    "PotentialSensor": {},
    "VoltageSensor": {},
    "CurrentSensor": {},
    "PowerSensor": {},
    "MultiSensor": {},
    "SupplyVoltage": SUPPLY,
    "DCPowerSupply": {"V0": 60, "I0": 50, "P0": 1200, "Rcv": 1e-3, "Gcc": 1e-3, "iBack": 1e-3},
    "LightningImpulse": {"amplitude": ..., **IMPULSE, "offset": 0, "startTime": 0},
    "LightningImpulseVoltage": {"V": ..., **IMPULSE, "offset": 0},
    "LightningImpulseCurrent": {"I": ..., **IMPULSE, "offset": 0},
    "SignalVoltage": {},
    "ConstantVoltage": {"V": ...},
    "StepVoltage": {"V": ..., **SIGNAL},
    "RampVoltage": {"V": ..., "duration": ..., **SIGNAL},
    "SineVoltage": {"V": ..., "phase": 0, "f": ..., **SIGNAL},
    "CosineVoltage": {"V": ..., "phase": 0, "f": ..., **SIGNAL},
    "SineVoltageVariableFrequencyAndAmplitude": VARIABLE,
    "CosineVoltageVariableFrequencyAndAmplitude": VARIABLE,
    "ExpSineVoltage": {"V": ..., "f": ..., "phase": 0, "damping": ..., **SIGNAL},
    "ExponentialsVoltage": {
        "vMax": ..., "riseTime": ..., "riseTimeConst": ..., "fallTimeConst": ..., **SIGNAL,
    },
    "PulseVoltage": {"V": ..., "width": ..., "period": ..., **SIGNAL},
    "SawToothVoltage": {"V": ..., "period": ..., **SIGNAL},
    "TrapezoidVoltage": {
        "V": ..., "rising": ..., "width": ..., "falling": ..., "period": ..., "nperiod": -1, **SIGNAL,
    },
    "TableVoltage": {"table": [[0, 0], [1, 1], [2, 4]], **SIGNAL},
    "SignalCurrent": {},
    "ConstantCurrent": {"I": ...},
    "StepCurrent": {"I": ..., **SIGNAL},
    "RampCurrent": {"I": ..., "duration": ..., **SIGNAL},
    "SineCurrent": {"I": ..., "phase": 0, "f": ..., **SIGNAL},
    "CosineCurrent": {"I": ..., "phase": 0, "f": ..., **SIGNAL},
    "SineCurrentVariableFrequencyAndAmplitude": VARIABLE,
    "CosineCurrentVariableFrequencyAndAmplitude": VARIABLE,
    "ExpSineCurrent": {"I": ..., "f": ..., "phase": 0, "damping": ..., **SIGNAL},
    "ExponentialsCurrent": {
        "iMax": ..., "riseTime": ..., "riseTimeConst": ..., "fallTimeConst": ..., **SIGNAL,
    },
    "PulseCurrent": {"I": ..., "width": ..., "period": ..., **SIGNAL},
    "SawToothCurrent": {"I": ..., "period": ..., **SIGNAL},
    "TrapezoidCurrent": {
        "I": ..., "rising": ..., "width": ..., "falling": ..., "period": ..., "nperiod": -1, **SIGNAL,
    },
    "TableCurrent": {"table": [[0, 0], [1, 1], [2, 4]], **SIGNAL},
    "OLine": {"r": ..., "l": ..., "g": ..., "c": ..., "alpha_R": 0, "alpha_G": 0, **LINE},
    "ULine": {"r": ..., "c": ..., "alpha": 0, **LINE},
    "M_OLine": {
        "length": 0.1, "N": 5, "lines": 4, "r": [4.76e5, 1.72e5, 1.72e5, 1.72e5],
        "useInternalGround": True, "alpha_R": 0, "alpha_G": 0, "useHeatPort": False,
        "T": 293.15, "T_ref": 300.15,
    },
    "NonlinearResistor": {"Ga": ..., "Gb": ..., "Ve": ...},
    "Transistor": {},
    "Nand": {},
}  # fmt: skip

CIRCUITS = {
    "Buffer": {"k": 1, "R1": 1000, "R2": callable, **CIRCUIT},
    "Gain": {"k": 1, "R1": 1000, "R2": callable, **CIRCUIT},
    "Add": {"k1": 1, "k2": 1, "R": 1000, "R1": callable, "R2": callable, **CIRCUIT},
    "Feedback": {"k": 1, "R1": 1000, "R3": callable, **CIRCUIT},
    "Der": {"k": 1, "f": ..., "R": 1000, "C": callable, **CIRCUIT},
    "Integrator": {"k": 1, "f": ..., "R": 1000, "C": callable, **CIRCUIT},
    "FirstOrder": {"k": 1, "R1": 1000, "R2": callable, "T": ..., "C": callable, **CIRCUIT},
    "Derivative": {"k": 1, "R1": 1000, "R2": callable, "T": ..., "C": callable, **CIRCUIT},
    "PI": {"k": 1, "R1": 1000, "R2": callable, "T": ..., "C": callable, **CIRCUIT},
    "DifferentialAmplifierData": {
        "VSource": 400,
        "fSource": 50,
        "RLoad": 10,
        "RGround": 100e3,
        "V0": 10e3,
        "VSupply": 15,
        "k": 100,
        "R1": 100e3,
        "R2": callable,
        "R3": callable,
        "R4": callable,
        "RInstrument": 100e3,
    },
}

PARTIAL = {
    "ConditionalHeatPort", "CurrentSource", "FourPin", "IdealSemiconductor", "IdealSwitch",
    "IdealSwitchWithArc", "OnePort",
    "TwoPin", "TwoPort", "VoltageSource", "PartialOpAmp",
}  # fmt: skip

TABLES = [(el, DEFAULTS), (oc, CIRCUITS)]
CLASSES = [(module, name, table[name]) for module, table in TABLES for name in table]
IDS = [name for _, name, _ in CLASSES]


def minimal(cls):
    """An instance with the value 1 for all that must be given."""
    needed = {
        name: 1.0
        for name, d in cls._declared.items()
        if isinstance(d, ac.Parameter) and d.default is None and d.when is None
    }
    return cls(**needed)


def circuit(*nets, **parts):
    """A model of parts with a ground; a net is a line of the pins that it joins."""

    class Circuit(ac.Component):
        pass

    model = Circuit()
    for name, part in {**parts, "ground": el.Ground()}.items():
        setattr(model, name, part)
    for net in nets:
        model.connect(*(_end(model, path) for path in net.split()))
    return model


def _end(model: Any, path: str) -> Any:
    for name in path.split("."):
        model = getattr(model, name)
    return model


def settled(system, names):
    """A function from inputs to variables of a model without states, once its switches agree with them."""
    packed = system.pack()
    read = jax.jit(lambda values: system.read(names, values))
    return lambda u: np.asarray(read(system.start_values(packed, None, u, 0.0)))


FIXED = ac.Start(fixed=True)
AT_ZERO = ac.Start(0.0, fixed=True)


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
            assert np.array_equal(declared, default), key


@pytest.mark.parametrize(("module", "name", "defaults"), CLASSES, ids=IDS)
def test_every_class_has_as_many_equations_as_unknowns(module, name, defaults):
    model = flatten(minimal(getattr(module, name)))
    known = len(model.inputs) + len(model.discrete)
    assert model.n_equations == model.n_variables - known


@pytest.mark.parametrize(
    "component",
    [
        el.Resistor(R=1, useHeatPort=True),
        el.Diode(useTemperatureDependency=True),
        el.Diode(useTemperatureDependency=True, useHeatPort=False),
        el.NMOS(useTemperatureDependency=True),
        el.NPN(useTemperatureDependency=True, useSubstrate=True, UIC=True),
        el.RotationalEMF(k=1, useSupport=True),
        el.TranslationalEMF(k=1, useSupport=True),
        el.Potentiometer(R=1, useRinput=True, useHeatPort=True),
        el.VariableCapacitor(UIC=True),
        el.VariableInductor(UIC=True),
        el.IdealizedOpAmpLimited(useSupply=True),
        el.IdealTransformer(n=1, considerMagnetization=True, Lm1=1),
        el.SineVoltageVariableFrequencyAndAmplitude(useConstantAmplitude=True),
        el.CosineCurrentVariableFrequencyAndAmplitude(useConstantFrequency=True),
        el.GeneralCurrentToVoltageAdaptor(use_pder=False, use_fder=False),
        el.GeneralVoltageToCurrentAdaptor(use_pder=False, use_fder=False),
        el.OLine(N=3, r=1, l=1, g=1, c=1, length=1, useHeatPort=True),
        el.ULine(N=3, r=1, c=1, length=1, useHeatPort=True),
        el.M_OLine(N=2, useInternalGround=False, useHeatPort=True),
        el.M_Transformer(N=2, L=[1, 0.1, 2]),
        el.SimpleTriac(useHeatPort=True),
    ],
    ids=repr,
)
def test_options_keep_the_balance(component):
    model = flatten(component)
    known = len(model.inputs) + len(model.discrete)
    assert model.n_equations == model.n_variables - known


def test_a_transformer_needs_all_its_inductances():
    with pytest.raises(ac.DeclarationError, match="N=2 needs 3 inductances L, got 6"):
        el.M_Transformer(N=2)


def test_lines_need_all_their_values():
    with pytest.raises(ac.DeclarationError, match="lines=2 needs 2 values r, got 4"):
        el.M_OLine(lines=2)
    with pytest.raises(ac.DeclarationError, match="N=1 is out of range: at least 2"):
        el.M_OLine(N=1)


def test_a_circuit_without_ground_says_so():
    model = circuit("v.p r.p", "v.n r.n", v=el.ConstantVoltage(V=1), r=el.Resistor(R=1))
    with pytest.raises(ac.StructureError, match="ground"):
        ac.compile(model)


def test_a_source_passes_its_options_on():
    source = el.TrapezoidVoltage(V=1, rising=0, width=1, falling=0, period=2, nperiod=3)
    assert source.signalSource.nperiod == 3
    source.modify(nperiod=4)
    assert source.signalSource.nperiod == 4
    table = el.TableCurrent(table=[[0, 1], [1, 2]])
    assert table.signalSource.table == [[0, 1], [1, 2]]


class Cut(ac.Component):
    """A capacitor discharged by a resistor, with signals in between."""

    def __init__(self):
        super().__init__()
        self.c = el.Capacitor(C=2.0, v=ac.Start(1.0, fixed=True))
        self.r, self.ground, self.other = el.Resistor(R=4.0), el.Ground(), el.Ground()
        self.to_v = el.GeneralCurrentToVoltageAdaptor(use_pder=False, use_fder=False)
        self.to_i = el.GeneralVoltageToCurrentAdaptor(use_pder=False, use_fder=False)
        self.connect(self.c.p, self.to_v.pin_p)
        self.connect(self.c.n, self.to_v.pin_n, self.ground.p)
        self.connect(self.to_v.p, self.to_i.p)
        self.connect(self.to_i.f, self.to_v.f)
        self.connect(self.to_i.pin_p, self.r.p)
        self.connect(self.to_i.pin_n, self.r.n, self.other.p)


def test_a_circuit_cut_by_signals_behaves_as_the_whole():
    system = ac.compile(Cut())
    derivative = system.vector_field(0.0, [3.0], [], system.parameters())
    assert float(derivative[0]) == pytest.approx(-3.0 / (4.0 * 2.0))


# -- characteristics ---------------------------------------------------------------------------------


class Curves(ac.Component):
    """One-ports, each at the voltage ``u``."""

    u = ac.Input(unit="V")

    def __init__(self, **elements):
        super().__init__()
        self.ground = el.Ground()
        for name, element in elements.items():
            source = el.SignalVoltage()
            setattr(self, name, element)
            setattr(self, f"source_{name}", source)
            self.connect(self.u, source.v)
            self.connect(source.p, element.p)
            self.connect(source.n, element.n, self.ground.p)


@pytest.fixture(scope="module")
def curves():
    elements = {
        "diode": el.Diode(),
        "hot": el.Diode(useTemperatureDependency=True, useHeatPort=False, T=350.0, N=1.5),
        "zener": el.ZDiode(),
        "series": el.Diode2(Bv=5),
        "ideal": el.IdealDiode(Ron=0.1, Goff=0.01, Vknee=0.5),
        "resistor": el.Resistor(R=2, alpha=0.01, T=310.15),
        "conductor": el.Conductor(G=2, alpha=0.01, T=310.15),
        "chua": el.NonlinearResistor(Ga=-0.75, Gb=-0.4, Ve=1),
    }
    system = ac.compile(Curves(**elements))
    names = [
        f"{name}.{x}" for name in elements for x in ("i", "LossPower") if hasattr(elements[name], x)
    ]
    observe = settled(system, names)
    return lambda u: dict(zip(names, observe(jnp.asarray([float(u)])).tolist(), strict=True))


def exlin(x, high):
    return np.exp(high) * (1 + x - high) if x > high else np.exp(x)


VOLTAGES = (-6.0, -5.2, -1.0, 0.0, 0.3, 0.55, 0.75, 1.5)


@pytest.mark.parametrize("v", VOLTAGES)
def test_diodes(curves, v):
    found = curves(v)
    assert found["diode.i"] == pytest.approx(1e-6 * (exlin(v / 0.04, 15) - 1) + v / 1e8)
    w = 1.5 * nature.k * 350 / nature.q
    ratio = 350 / 300.15
    saturation = 1e-6 * ratio ** (3 / 1.5) * np.exp((ratio - 1) * 1.11 / w)
    assert found["hot.i"] == pytest.approx(saturation * (exlin(v / w, 15) - 1) + v / 1e8)
    reverse = 0.7 * exlin(-(v + 5.1) / (0.74 * 0.04), 30)
    zener = 1e-6 * (exlin(v / 0.04, 30) - 1) - reverse + v / 1e8
    assert found["zener.i"] == pytest.approx(zener)
    assert found["diode.LossPower"] == pytest.approx(v * found["diode.i"])


@pytest.mark.parametrize("v", VOLTAGES)
def test_a_diode_with_series_resistance_breaks_down(curves, v):
    w = nature.R * 293.15 / nature.F

    def current(vd):
        if vd < -5 / 2:
            return -1e-13 * (np.exp(-(vd + 5) / w) + 1 - 2 * np.exp(-5 / (2 * w)))
        return 1e-13 * (exlin(vd / w, 0.7 / w + 1) - 1)

    vd = brentq(lambda vd: vd + 16 * current(vd) - v, -6.2, 2, xtol=1e-15)
    assert curves(v)["series.i"] == pytest.approx(current(vd) + 1e-6 * v, rel=1e-6, abs=1e-15)


@pytest.mark.parametrize("v", VOLTAGES)
def test_linear_and_ideal_characteristics(curves, v):
    found = curves(v)
    assert found["resistor.i"] == pytest.approx(v / 2.2)
    assert found["conductor.i"] == pytest.approx(v * 2 / 1.1)
    assert found["resistor.LossPower"] == pytest.approx(v**2 / 2.2)
    knee = (v - 0.5) / 0.1 + 0.005 if v > 0.5 else 0.01 * v
    assert found["ideal.i"] == pytest.approx(knee)
    inner = max(min(v, 1), -1)
    assert found["chua.i"] == pytest.approx(-0.4 * (v - inner) - 0.75 * inner)


class Pins(ac.Component):
    """Transistors with every pin at a potential of its own, the same for equal pins."""

    def __init__(self, pins, **transistors):
        super().__init__()
        self.ground = el.Ground()
        for pin in pins:
            source = el.SignalVoltage()
            setattr(self, pin, source)
            self.connect(source.n, self.ground.p)
            for name, transistor in transistors.items():
                if not hasattr(self, name):
                    setattr(self, name, transistor)
                self.connect(source.p, getattr(transistor, pin))


def currents(system, names):
    """A function from potentials by pin, and their rates, to the named variables by name."""
    params = system.pack()
    x = jnp.zeros(len(system.states))
    observe = jax.jit(lambda u: system.observe(names, 0.0, x, u, params))

    def at(rates=(), **potentials):
        given = {f"{pin}.v": v for pin, v in potentials.items()}
        given |= {f"der({pin}.v)": v for pin, v in dict(rates).items()}
        u = jnp.asarray([given.get(name, 0.0) for name in system.inputs])
        return dict(zip(names, np.asarray(observe(u)).tolist(), strict=True))

    return at


@pytest.fixture(scope="module")
def mosfets():
    transistors = {
        "n": el.NMOS(),
        "p": el.PMOS(),
        "hot": el.NMOS(useTemperatureDependency=True, useHeatPort=False, T=350.0),
    }
    names = [f"{t}.{pin}.i" for t in transistors for pin in "DGSB"] + ["n.LossPower"]
    return currents(ac.compile(Pins("DGSB", **transistors)), names)


def channel(potentials, W, L, beta, vt, k2, k5):
    """Current into the drain of an n-channel transistor, by cases as in the literature."""
    D, G, S, B = potentials
    ud, us = max(D, S), min(D, S)
    uds, ubs = ud - us, min(B - us, 0)
    ugst = (G - us - vt + k2 * ubs) * k5
    v = beta * W / L
    if ugst <= 0:
        current = uds * 1e-7
    elif ugst > uds:
        current = v * uds * (ugst - uds / 2) + uds * 1e-7
    else:
        current = v * ugst**2 / 2 + uds * 1e-7
    return -current if D < S else current


@pytest.mark.parametrize(
    "potentials",
    [
        (5, 0, 0, 0),
        (5, 3, 0, 0),
        (0.5, 5, 0, -1),
        (-3, 4, 1, 0),
        (1, 2, 1, 2),
        (0, 5, 5, 5),
        (-5, -4, 0, 0),
    ],
)
def test_field_effect_transistors(mosfets, potentials):
    found = mosfets(**dict(zip("DGSB", potentials, strict=True)))
    n = channel(potentials, 17.5e-6, 4.5e-6, 0.041e-3, 0.8, 1.144, 0.7311)
    p = -channel([-v for v in potentials], 17.5e-6, 3.9e-6, 0.0105e-3, 1.0, 0.41, 0.839)
    above = 350 - 300.15
    beta = 0.041e-3 * (350 / 300.15) ** -1.5
    vt, k2 = 0.8 * (1 - 6.96e-3 * above), 1.144 * (1 + 6e-4 * above)
    hot = channel(potentials, 17.5e-6, 4.5e-6, beta, vt, k2, 0.7311)
    for name, expected in (("n", n), ("p", p), ("hot", hot)):
        assert found[f"{name}.D.i"] == pytest.approx(expected, abs=1e-18)
        assert found[f"{name}.S.i"] == pytest.approx(-expected, abs=1e-18)
        assert found[f"{name}.G.i"] == found[f"{name}.B.i"] == 0
    assert found["n.LossPower"] == pytest.approx(n * (potentials[0] - potentials[2]))


@pytest.fixture(scope="module")
def bipolars():
    transistors = {
        "n": el.NPN(useSubstrate=True),
        "p": el.PNP(useSubstrate=True),
        "hot": el.NPN(
            useTemperatureDependency=True, useHeatPort=False, T=350.0, XTB=0.5, useSubstrate=True
        ),
    }
    names = [f"{t}.{pin}.i" for t in transistors for pin in "CBES"] + ["n.LossPower"]
    return currents(ac.compile(Pins("CBES", **transistors)), names)


def ebers_moll(potentials, rates, vt=0.02585, saturation=1e-16, bf=50, br=0.1):
    """Currents into collector, base, emitter and substrate of an NPN transistor."""

    C, B, E, _ = potentials

    def junction(v, conductance, transit, capacity, diffusion, exponent):
        growth = exlin(max(v / vt, -100), 40)
        x = v / diffusion
        depletion = capacity * (1 + exponent * x if x > 0 else (1 - x) ** -exponent)
        return saturation * (
            growth - 1
        ) + v * conductance, transit * saturation / vt * growth + depletion

    ibc, cbc = junction(B - C, 1e-15, 5e-9, 0.5e-12, 0.8, 0.333)
    ibe, cbe = junction(B - E, 1e-15, 0.12e-9, 0.4e-12, 0.8, 0.4)
    charge_bc, charge_be = cbc * (rates["B"] - rates["C"]), cbe * (rates["B"] - rates["E"])
    substrate = -1e-12 * (rates["C"] - rates["S"])
    collector = (ibe - ibc) * (1 - (B - C) * 0.02) - ibc / br - charge_bc - substrate
    base = ibe / bf + ibc / br + charge_bc + charge_be
    return collector, base, -base - collector - substrate, substrate


@pytest.mark.parametrize(
    "potentials",
    [(5, 0.7, 0, 0), (0.1, 0.75, 0, -1), (0, 0.7, 3, 0), (2, 0, 0, 0), (-1, -0.2, 0.5, 1)],
)
def test_bipolar_transistors(bipolars, potentials):
    rates = dict(zip("CBES", (1e6, -2e6, 3e6, 5e5), strict=True))
    found = bipolars(rates, **dict(zip("CBES", potentials, strict=True)))
    n = ebers_moll(potentials, rates)
    p = [-i for i in ebers_moll([-v for v in potentials], {k: -v for k, v in rates.items()})]
    ratio, vt = 350 / 300.15, nature.k * 350 / nature.q
    saturation = 1e-16 * ratio**3 * np.exp((ratio - 1) * 1.11 / vt)
    hot = ebers_moll(potentials, rates, vt, saturation, 50 * ratio**0.5, 0.1 * ratio**0.5)
    for name, expected in (("n", n), ("p", p), ("hot", hot)):
        values = [found[f"{name}.{pin}.i"] for pin in "CBES"]
        assert values == pytest.approx(expected, rel=1e-6, abs=1e-15)
        assert sum(values) == pytest.approx(0, abs=1e-12)


# -- sources -----------------------------------------------------------------------------------------


def pulse(t):
    return 1.0 if t % 0.5 < 0.1 else 0.0


WAVES = {
    "Step": ({}, lambda t: 1.0),
    "Ramp": ({"duration": 1.0}, lambda t: min(t, 1.0)),
    "Sine": ({"f": 2, "phase": 0.5}, lambda t: np.sin(4 * np.pi * t + 0.5)),
    "Cosine": ({"f": 2, "phase": 0.5}, lambda t: np.cos(4 * np.pi * t + 0.5)),
    "ExpSine": ({"f": 2, "damping": 3}, lambda t: np.exp(-3 * t) * np.sin(4 * np.pi * t)),
    "Pulse": ({"width": 20, "period": 0.5}, pulse),
    "SawTooth": ({"period": 0.5}, lambda t: t % 0.5 / 0.5),
    "Trapezoid": (
        {"rising": 0.2, "width": 0.3, "falling": 0.1, "period": 2},
        lambda t: np.interp(t % 2, [0, 0.2, 0.5, 0.6], [0, 1, 1, 0]),
    ),
}
TIMES = (0.0, 0.31, 0.46, 0.77, 1.43)


def wave_sources():
    """Every signal as a voltage and as a current source, with offset and a start, and what each gives."""
    made, expected = {}, {}
    common = {"offset": 0.25, "startTime": 0.3}
    for name, (parameters, law) in WAVES.items():
        made[f"v{name}"] = getattr(el, f"{name}Voltage")(V=2, **parameters, **common)
        made[f"i{name}"] = getattr(el, f"{name}Current")(I=2, **parameters, **common)
        for kind in "vi":
            expected[f"{kind}{name}.{kind}"] = lambda t, law=law: (
                0.25 + (2 * law(t - 0.3) if t > 0.3 else 0)
            )
    exponential = {"riseTime": 0.5, "riseTimeConst": 0.2, "fallTimeConst": 0.3}
    made["vExponentials"] = el.ExponentialsVoltage(vMax=2, **exponential)
    made["iExponentials"] = el.ExponentialsCurrent(iMax=2, **exponential)
    made["vTable"], made["iTable"] = el.TableVoltage(), el.TableCurrent()
    made["vConstant"], made["iConstant"] = el.ConstantVoltage(V=2), el.ConstantCurrent(I=2)
    for kind in "vi":
        expected[f"{kind}Exponentials.{kind}"] = lambda t: (
            2 * (1 - np.exp(-min(t, 0.5) / 0.2)) * np.exp(-max(t - 0.5, 0) / 0.3)
        )
        expected[f"{kind}Table.{kind}"] = lambda t: np.interp(t, [0, 1, 2], [0, 1, 4])
        expected[f"{kind}Constant.{kind}"] = lambda t: 2.0
    return made, expected


def test_sources_follow_their_signals():
    made, expected = wave_sources()
    model = circuit(**made, supply=el.SupplyVoltage())
    for source in made.values():
        closed = (source.p, source.n) if isinstance(source, el.CurrentSource) else (source.n,)
        model.connect(*closed, model.ground.p)
    model.connect(made["iConstant"].p, made["iConstant"].n, model.ground.p)
    model.connect(model.supply.ground, model.ground.p)
    system = ac.compile(model)
    params = system.parameters()
    names = [*expected, "supply.pin_p.v", "supply.pin_n.v"]
    observe = jax.jit(jax.vmap(lambda t: system.observe(names, t, jnp.zeros(0), None, params)))
    values = np.asarray(observe(jnp.asarray(TIMES)))
    for j, name in enumerate(expected):
        assert values[:, j] == pytest.approx([expected[name](t) for t in TIMES], abs=1e-12), name
    assert np.all(values[:, -2:] == (15, -15))


# -- switches, amplifiers and sensors ---------------------------------------------------------------


class Static(ac.Component):
    """Circuits without states, driven by the voltage ``u``."""

    u = ac.Input(unit="V")
    r, g = ac.Input(), ac.Input()

    def __init__(self):
        super().__init__()
        self.ground = el.Ground()
        self.drive = el.SignalVoltage()
        self.connect(self.u, self.drive.v)
        self.connect(self.drive.n, self.ground.p)
        self.ten = el.ConstantVoltage(V=10)
        self.connect(self.ten.n, self.ground.p)
        self._switches()
        self._amplifiers()
        self._two_ports()
        self._sensors()

    def load(self, name, pin, R=10.0):
        """A resistor from a pin to the ground."""
        resistor = el.Resistor(R=R)
        setattr(self, name, resistor)
        self.connect(pin, resistor.p)
        self.connect(resistor.n, self.ground.p)

    def _switches(self):
        self.opening, self.closing = el.IdealOpeningSwitch(), el.IdealClosingSwitch()
        self.pin_opening = el.ControlledIdealOpeningSwitch(level=1)
        self.pin_closing = el.ControlledIdealClosingSwitch(level=1)
        self.two_way = el.ControlledIdealTwoWaySwitch(level=1)
        self.crossing = el.ControlledIdealIntermediateSwitch(level=1)
        for name in ("opening", "closing", "pin_opening", "pin_closing"):
            switch = getattr(self, name)
            self.connect(self.ten.p, switch.p)
            self.load(f"load_{name}", switch.n)
            if name.startswith("pin"):
                self.connect(switch.control, self.drive.p)
            else:
                self.connect(self.u, switch.control)
        self.connect(self.ten.p, self.two_way.p, self.crossing.p1)
        self.connect(self.drive.p, self.two_way.control, self.crossing.control)
        self.connect(self.crossing.p2, self.ground.p)
        for name in ("two_way", "crossing"):
            self.load(f"load_{name}1", getattr(self, name).n1)
            self.load(f"load_{name}2", getattr(self, name).n2, R=20.0)

    def _amplifiers(self):
        self.supply = el.SupplyVoltage()
        self.connect(self.supply.ground, self.ground.p)
        self.limited, self.smooth = el.IdealOpAmpLimited(), el.OpAmp(Slope=1e4)
        self.comparator = el.IdealizedOpAmpLimited(useSupply=True)
        self.connect(self.supply.pin_p, self.limited.VMax, self.smooth.VMax, self.comparator.s_p)
        self.connect(self.supply.pin_n, self.limited.VMin, self.smooth.VMin, self.comparator.s_n)
        for name in ("limited", "smooth"):
            amplifier = getattr(self, name)
            first, second = el.Resistor(R=1e3), el.Resistor(R=3e3)
            setattr(self, f"first_{name}", first)
            setattr(self, f"second_{name}", second)
            self.connect(self.drive.p, first.p)
            self.connect(first.n, second.p, amplifier.in_n)
            self.connect(second.n, amplifier.out)
            self.connect(amplifier.in_p, self.ground.p)
        self.connect(self.drive.p, self.comparator.in_p)
        self.connect(self.comparator.in_n, self.ground.p)
        self.load("load_comparator", self.comparator.out, R=1e3)
        circuits = {
            "buffer": oc.Buffer(k=2),
            "gain": oc.Gain(k=3),
            "add": oc.Add(k2=2),
            "feedback": oc.Feedback(),
        }
        for name, made in circuits.items():
            setattr(self, name, made)
            self.connect(self.drive.p, made.p1)
            self.connect(made.n1, self.ground.p)
            if name in ("add", "feedback"):
                self.connect(self.ten.p, made.p1_2)

    def _two_ports(self):
        ports = {
            "vcv": el.VCV(gain=2), "vcc": el.VCC(transConductance=0.5), "ccv": el.CCV(transResistance=4),
            "ccc": el.CCC(gain=3), "gyrator": el.Gyrator(G1=0.5, G2=0.25), "trafo": el.IdealTransformer(n=2),
        }  # fmt: skip
        for name, port in ports.items():
            setattr(self, name, port)
            self.connect(port.n1, port.n2, self.ground.p)
            series = el.Resistor(R=2)
            setattr(self, f"series_{name}", series)
            self.connect(self.drive.p, series.p)
            self.connect(series.n, port.p1)
            self.load(f"load_{name}", port.p2)
        self.slider = el.Potentiometer(R=100, useRinput=True)
        self.connect(self.r, self.slider.r)
        self.connect(self.ten.p, self.slider.pin_p)
        self.connect(self.slider.pin_n, self.ground.p)
        self.variable, self.conductor = el.VariableResistor(), el.VariableConductor()
        self.connect(self.ten.p, self.variable.p, self.conductor.p)
        self.connect(self.variable.n, self.conductor.n, self.ground.p)
        self.connect(self.r, self.variable.R)
        self.connect(self.g, self.conductor.G)

    def _sensors(self):
        self.meter, self.power = el.MultiSensor(), el.PowerSensor()
        self.potential, self.voltage, self.current = (
            el.PotentialSensor(), el.VoltageSensor(), el.CurrentSensor(),
        )  # fmt: skip
        self.short, self.idle = el.Short(), el.Idle()
        self.connect(self.ten.p, self.meter.pc)
        self.connect(self.meter.nc, self.power.pc)
        self.connect(self.power.nc, self.current.p)
        self.connect(self.current.n, self.short.p)
        self.load("measured", self.short.n, R=4.0)
        for sensor in (self.meter, self.power):
            self.connect(sensor.pv, self.ten.p)
            self.connect(sensor.nv, self.ground.p)
        self.connect(self.voltage.p, self.idle.p, self.potential.p, self.ten.p)
        self.connect(self.voltage.n, self.idle.n, self.drive.p)


@pytest.fixture(scope="module")
def static():
    system = ac.compile(Static())
    assert system.states == ()
    names = [n for n in system.variables if n.count(".") <= 2]
    observe = settled(system, names)

    def at(u, r=0.5):
        given = {"u": float(u), "r": float(r), "g": float(r)}
        values = observe(jnp.asarray([given[name] for name in system.inputs]))
        return dict(zip(names, np.asarray(values).tolist(), strict=True))

    return at


@pytest.mark.slow
@pytest.mark.parametrize("u", [0.0, 2.0])
def test_switches_open_and_close(static, u):
    found = static(u)
    closed, open_ = 10 / 10.00001, 1e-4
    for name in ("opening", "pin_opening"):
        assert found[f"load_{name}.i"] == pytest.approx(open_ if u else closed, rel=1e-3)
        assert found[f"{name}.off"] == (1 if u else 0)
    for name in ("closing", "pin_closing"):
        assert found[f"load_{name}.i"] == pytest.approx(closed if u else open_, rel=1e-3)
    first, second = found["load_two_way1.i"], found["load_two_way2.i"]
    assert (first, second) == pytest.approx((1e-4, 0.5) if u else (1, 1e-4), rel=1e-3)
    first, second = found["load_crossing1.v"], found["load_crossing2.v"]
    assert (first, second) == pytest.approx((0, 10) if u else (10, 0), abs=1e-2)
    assert found["two_way.LossPower"] >= 0
    assert found["crossing.LossPower"] >= 0


@pytest.mark.parametrize("u", [-8.0, -3.0, 0.0, 1.0, 6.0])
def test_amplifiers_are_limited(static, u):
    found = static(u)
    assert found["limited.out.v"] == pytest.approx(np.clip(-3 * u, -15, 15))
    assert found["limited.vin"] == pytest.approx(0 if abs(u) < 5 else (15 * np.sign(u) - 3 * u) / 4)
    if abs(u) < 4:
        assert found["smooth.out.v"] == pytest.approx(-3 * u, abs=0.02)
    assert abs(found["smooth.out.v"]) <= 15
    assert found["comparator.v_out"] == pytest.approx(15 * np.sign(u))
    drawn = -found["supply.positiveSupply.i"] * 15 - found["supply.negativeSupply.i"] * 15
    assert drawn == pytest.approx(found["load_comparator.LossPower"])


def test_basic_circuits_calculate(static):
    found = static(1.5)
    assert found["buffer.v2"] == pytest.approx(3, rel=1e-3)
    assert found["gain.v2"] == pytest.approx(-4.5, rel=1e-3)
    assert found["feedback.v2"] == pytest.approx(8.5, rel=1e-3)
    assert found["add.v2"] == -15  # 1.5 + 2 10, bounded
    assert static(-17.0)["add.v2"] == pytest.approx(-3, rel=1e-3)


def test_two_ports(static):
    u = 3.0
    found = static(u)
    assert found["load_vcv.v"] == pytest.approx(2 * u)
    assert found["load_vcc.i"] == pytest.approx(-0.5 * u)
    assert found["load_ccv.v"] == pytest.approx(4 * u / 2)
    assert found["load_ccc.i"] == pytest.approx(-3 * u / 2)
    # seen from the primary, 10 Ohm behind a gyrator are 1/(G1 G2 10 Ohm), behind a transformer n**2 10 Ohm
    assert found["series_gyrator.i"] == pytest.approx(u / (2 + 1 / (0.5 * 0.25 * 10)))
    assert found["series_trafo.i"] == pytest.approx(u / (2 + 4 * 10))
    power = found["trafo.v1"] * found["trafo.i1"] + found["trafo.v2"] * found["trafo.i2"]
    assert power == pytest.approx(0)
    assert found["trafo.im1"] == pytest.approx(0)


@pytest.mark.parametrize("r", [-0.5, 0.25, 1.0])
def test_signals_set_resistances(static, r):
    found = static(0.0, r)
    assert found["slider.contact.v"] == pytest.approx(10 * np.clip(r, 0, 1))
    assert found["slider.LossPower"] == pytest.approx(1)
    assert found["variable.i"] == pytest.approx(10 / r)
    assert found["conductor.i"] == pytest.approx(10 * r)


def test_sensors_measure_without_effect(static):
    found = static(2.0)
    assert found["measured.i"] == pytest.approx(2.5)
    assert found["meter.i"] == found["current.i"] == pytest.approx(2.5)
    assert found["meter.v"] == found["potential.phi"] == 10
    assert found["meter.power"] == found["power.power"] == pytest.approx(25)
    assert found["voltage.v"] == found["idle.v"] == 8


# -- responses ---------------------------------------------------------------------------------------


class Ambient(ac.Component):
    """A heat port at a fixed temperature."""

    port = HeatPort()

    def equations(self):
        yield ac.Eq(self.port.T, 293.15)


class Bench(ac.Component):
    """Independent experiments side by side, so that one program simulates all."""

    def __init__(self):
        super().__init__()
        self.ground = el.Ground()
        self.one = el.ConstantVoltage(V=1)
        self.sine = el.SineVoltage(V=1, f=0.5)
        self.connect(self.one.n, self.sine.n, self.ground.p)

        # a capacitor and an inductor are charged; what the resistor loses leaves at its heat port
        self.heated, self.ambient = el.Resistor(R=2, useHeatPort=True), Ambient()
        self.charged = el.Capacitor(C=0.25, v=AT_ZERO)
        self.chain(self.heated, self.charged)
        self.connect(self.heated.heatPort, self.ambient.port)
        self.energized = el.Inductor(L=1, i=AT_ZERO)
        self.chain(el.Resistor(R=2), self.energized)

        # a resonance rings
        self.c, self.l = el.Capacitor(C=0.5, v=ac.Start(3, fixed=True)), el.Inductor(L=2, i=AT_ZERO)
        self.connect(self.c.p, self.l.p)
        self.connect(self.c.n, self.l.n, self.ground.p)

        # capacitors side by side, and in a loop with a source; inductors in series
        self.c1, self.c2 = el.Capacitor(C=0.1, v=AT_ZERO), el.Capacitor(C=0.15)
        self.chain(el.Resistor(R=2), self.c1)
        self.connect(self.c1.p, self.c2.p)
        self.connect(self.c2.n, self.ground.p)
        self.upper, self.lower = el.Capacitor(C=2), el.Capacitor(C=1, v=AT_ZERO)
        self.connect(self.sine.p, self.upper.p)
        self.connect(self.upper.n, self.lower.p)
        self.connect(self.lower.n, self.ground.p)
        self.l1, self.l2 = el.Inductor(L=0.4, i=AT_ZERO), el.Inductor(L=0.6)
        self.chain(el.Resistor(R=2), self.l1, self.l2)

        # ideal amplifiers integrate and differentiate
        self.integrator, self.differentiator = el.IdealOpAmp3Pin(), el.IdealOpAmp()
        self.ri, self.ci = el.Resistor(R=2), el.Capacitor(C=0.25, v=AT_ZERO)
        self.connect(self.sine.p, self.ri.p)
        self.connect(self.ri.n, self.ci.p, self.integrator.in_n)
        self.connect(self.ci.n, self.integrator.out)
        self.rd, self.cd = el.Resistor(R=2), el.Capacitor(C=0.25)
        self.connect(self.sine.p, self.cd.p)
        self.connect(self.cd.n, self.rd.p, self.differentiator.n1)
        self.connect(self.rd.n, self.differentiator.p2)
        self.connect(
            self.integrator.in_p, self.differentiator.p1, self.differentiator.n2, self.ground.p
        )

        # a transformer of coupled inductors, and the same of an ideal one with leakage
        self.coupled = el.Transformer(L1=4.5, L2=1.1, M=2, i1=AT_ZERO, i2=AT_ZERO)
        self.core = el.IdealTransformer(n=2, considerMagnetization=True, Lm1=4)
        self.leak1, self.leak2 = el.Inductor(L=0.5, i=AT_ZERO), el.Inductor(L=0.1, i=AT_ZERO)
        self.matrix = el.M_Transformer(N=2, L=[4.5, 2, 1.1])
        self.rp, self.rs = ([el.Resistor(R=1) for _ in range(3)] for _ in range(2))
        for j, (first, second) in enumerate(
            [
                (self.coupled.p1, self.coupled.p2),
                (self.leak1.p, self.leak2.n),
                (self.matrix.p[0], self.matrix.p[1]),
            ]
        ):
            self.connect(self.sine.p, self.rp[j].p)
            self.connect(self.rp[j].n, first)
            self.connect(second, self.rs[j].p)
            self.connect(self.rs[j].n, self.ground.p)
        self.connect(self.leak1.n, self.core.p1)
        self.connect(self.core.p2, self.leak2.p)
        for port in (self.coupled, self.core):
            self.connect(port.n1, port.n2, self.ground.p)
        self.connect(self.matrix.n[0], self.matrix.n[1], self.ground.p)

        # saturation
        self.saturating = el.SaturatingInductor(Inom=1, Lnom=1, Lzer=2, Linf=0.5, i=AT_ZERO)
        self.connect(self.sine.p, self.saturating.p)
        self.connect(self.saturating.n, self.ground.p)

        # motors
        self.motor, self.rotor = el.RotationalEMF(k=0.5), rot.Inertia(J=0.1, phi=AT_ZERO, w=AT_ZERO)
        self.connect(self.motor.flange, self.rotor.flange_a)
        self.chain(el.Resistor(R=2), self.motor)
        self.coil, self.slide = el.TranslationalEMF(k=0.5), tl.Mass(m=0.1, s=AT_ZERO, v=AT_ZERO)
        self.connect(self.coil.flange, self.slide.flange_a)
        self.chain(el.Resistor(R=2), self.coil)

        # a capacitor behind a gyrator is an inductor: C = L G1 G2
        self.gyrator, self.cg = el.Gyrator(G1=0.5, G2=0.5), el.Capacitor(C=0.25, v=AT_ZERO)
        self.rg = el.Resistor(R=2)
        self.connect(self.one.p, self.rg.p)
        self.connect(self.rg.n, self.gyrator.p1)
        self.connect(self.gyrator.p2, self.cg.p)
        self.connect(self.gyrator.n1, self.gyrator.n2, self.cg.n, self.ground.p)

        # values that change, and a frequency that is a signal
        self.cv, self.lv = el.VariableCapacitor(UIC=True, IC=2), el.VariableInductor(UIC=True)
        self.chain(el.Resistor(R=1), self.cv)
        self.chain(el.Resistor(R=1), self.lv)
        self.chirp = el.SineVoltageVariableFrequencyAndAmplitude(phi=AT_ZERO)
        self.connect(self.chirp.n, self.ground.p)

    def chain(self, *parts):
        """Parts in series from the constant source to the ground; the parts get names of their own."""
        before = self.one.p
        for part in parts:
            if not any(part is child for child in vars(self).values()):
                setattr(self, f"part{len(vars(self))}", part)
            self.connect(before, part.p)
            before = part.n
        self.connect(before, self.ground.p)


@pytest.fixture(scope="module")
def bench():
    inputs = {
        "cv.C": lambda t: 1 + t, "lv.L": lambda t: 1 + t, "chirp.V": lambda t: 2 + t, "chirp.f": lambda t: t,
    }  # fmt: skip
    system = ac.compile(Bench())
    return ac.simulate(
        system,
        t=(0, 2),
        inputs=inputs,
        saveat=np.linspace(0, 2, 41),
        solver="tsit5",
        rtol=1e-8,
        atol=1e-10,
    )


@pytest.mark.slow
def test_capacitor_and_inductor_are_charged(bench):
    rising = 1 - np.exp(-2 * bench.t)
    assert np.allclose(bench["charged.v"], rising, atol=1e-6)
    assert np.allclose(bench["energized.i"], rising / 2, atol=1e-6)
    assert np.allclose(bench["ambient.port.Q_flow"], (1 - rising) ** 2 / 2, atol=1e-6)
    assert np.allclose(bench["heated.T_heatPort"], 293.15)


@pytest.mark.slow
def test_a_resonance_keeps_its_energy(bench):
    assert np.allclose(bench["c.v"], 3 * np.cos(bench.t), atol=1e-6)
    energy = 0.5 * bench["c.v"] ** 2 + 2 * bench["l.i"] ** 2
    assert np.allclose(energy, 4.5, atol=1e-6)


def test_capacitors_in_parallel_and_inductors_in_series_add_up(bench):
    rising = 1 - np.exp(-2 * bench.t)
    assert np.allclose(bench["c1.v"], 1 - np.exp(-2 * bench.t), atol=1e-6)
    assert np.allclose(bench["c2.i"], 1.5 * bench["c1.i"])
    assert np.allclose(bench["l1.i"], rising / 2, atol=1e-6)
    assert np.allclose(bench["l2.v"], 1.5 * bench["l1.v"])


def test_a_loop_of_capacitors_and_a_source_divides_the_voltage(bench):
    assert np.allclose(bench["lower.v"], np.sin(np.pi * bench.t) * 2 / 3, atol=1e-6)
    assert np.allclose(bench["lower.i"], np.pi * np.cos(np.pi * bench.t) * 2 / 3, atol=1e-6)


def test_ideal_amplifiers_integrate_and_differentiate(bench):
    integral = (1 - np.cos(np.pi * bench.t)) / np.pi / 0.5
    assert np.allclose(bench["integrator.out.v"], -integral, atol=1e-6)
    assert np.allclose(
        bench["differentiator.v2"], -0.5 * np.pi * np.cos(np.pi * bench.t), atol=1e-6
    )


def test_three_transformers_agree(bench):
    for side, current in (("rp", bench["rp[1].i"]), ("rs", bench["rs[1].i"])):
        assert np.max(np.abs(current)) > 0.05
        assert np.allclose(bench[f"{side}[2].i"], current, atol=1e-6)
        assert np.allclose(bench[f"{side}[3].i"], current, atol=1e-6)


def test_an_inductor_saturates(bench):
    flux = (1 - np.cos(np.pi * bench.t)) / np.pi
    assert np.allclose(bench["saturating.Psi"], flux, atol=1e-6)
    i, Lact = np.asarray(bench["saturating.i"]), np.asarray(bench["saturating.Lact"])
    assert np.allclose(Lact * i, flux, atol=1e-6)
    assert Lact[0] == pytest.approx(2)
    Ipar: Any = brentq(lambda x: 0.5 + 1.5 * x * np.arctan(1 / x) - 1, 1e-3, 10)
    assert np.allclose(Lact[1:], 0.5 + 1.5 * Ipar / i[1:] * np.arctan(i[1:] / Ipar))


def test_motors_reach_their_speed(bench):
    speed = 2 * (1 - np.exp(-0.25 / 0.2 * bench.t))
    assert np.allclose(bench["rotor.w"], speed, atol=1e-6)
    assert np.allclose(bench["slide.v"], speed, atol=1e-6)
    for motor in ("motor", "coil"):
        mechanical = bench["rotor.w"] * bench["motor.tauElectrical"]
        assert np.allclose(bench[f"{motor}.v"] * bench[f"{motor}.i"], mechanical, atol=1e-6)


def test_a_gyrator_makes_an_inductor_of_a_capacitor(bench):
    assert np.allclose(bench["rg.i"], (1 - np.exp(-2 * bench.t)) / 2, atol=1e-6)


def test_capacitance_and_inductance_may_change(bench):
    t = np.asarray(bench.t)
    assert np.allclose(bench["cv.v"], (2 + t + t**2 / 2) / (1 + t) ** 2, atol=1e-6)
    assert np.allclose(bench["lv.i"], (t + t**2 / 2) / (1 + t) ** 2, atol=1e-6)


def test_a_frequency_may_be_a_signal(bench):
    assert np.allclose(bench["chirp.v"], (2 + bench.t) * np.sin(np.pi * bench.t**2), atol=1e-6)


@pytest.mark.slow
def test_a_saturation_current_is_differentiable():
    """The parameter that scales the saturation follows from the others to 1e-8."""
    model = circuit("l.p l.n ground.p", l=el.SaturatingInductor(Inom=3, Lnom=1, Lzer=2, Linf=0.5))
    layout = ac.compile(model).layout

    def scale(Lnom):
        packed = pack(layout, {**default_parameters(layout, jax.random.key(0)), "l.Lnom": Lnom})
        return packed.values[-1]

    for Lnom in (0.51, 0.7, 1.0, 1.5, 1.99):
        ratio = (Lnom - 0.5) / 1.5
        exact = brentq(lambda x, r=ratio: x / 3 * np.arctan(3 / x) - r, 1e-3, 1e3)
        assert scale(Lnom) == pytest.approx(exact, rel=1e-6)
    step = float(scale(1.001) - scale(0.999)) / 0.002
    assert float(jax.grad(scale)(jnp.asarray(1.0))) == pytest.approx(step, rel=1e-4)


def test_a_line_is_symmetric_and_delays():
    line = el.OLine(N=8, r=1e-3, l=0.5, g=1e-6, c=0.5, length=1)
    model = circuit(
        "v.p r1.p", "r1.n line.p1", "line.p2 r2.p", "v.n r2.n line.p3 ground.p",
        v=el.StepVoltage(V=2), r1=el.Resistor(R=1), r2=el.Resistor(R=1), line=line,
    )  # fmt: skip
    system = ac.compile(model)
    assert len(system.states) == 17
    free = {"line.R[1].R", "line.L[2].L", "line.C[3].C", "line.length"} & set(system.parameters())
    assert free == {"line.length"}  # the parts' own follow from it
    sol = ac.simulate(system, t=(0, 8), saveat=[0.05, 8.0])
    assert sol["r2.v"][0] < 1e-3
    assert sol["r1.i"][0] > 0.5
    assert sol["r2.v"][1] == pytest.approx(1, abs=0.02)
    assert sol["line.v[4]"][1] == pytest.approx(1, abs=0.02)


class Sources(ac.Component):
    """Impulses of both shapes, and a supply with a load that grows from next to nothing to next to a short circuit."""

    def __init__(self) -> None:
        super().__init__()
        self.heidler = el.LightningImpulse(amplitude=2.0, startTime=1e-6)
        self.double = el.LightningImpulse(
            amplitude=2.0, approximation="DoubleExp", T1=1.2e-6, T2=50e-6
        )
        self.supply = el.DCPowerSupply()
        self.load = el.VariableConductor()
        self.ramp, self.power = (
            blocks.Ramp(height=6, duration=4e-4, offset=-3),
            blocks.Power(base=10),
        )
        self.ground = el.Ground()
        self.connect(self.ramp.y, self.power.u)
        self.connect(self.power.y, self.load.G)
        self.connect(self.supply.p, self.load.p)
        self.connect(self.supply.n, self.load.n, self.ground.p)


@pytest.mark.slow
def test_impulses_have_their_times_and_a_supply_its_three_limits() -> None:
    ts = np.linspace(0, 4e-4, 8001)
    found = ac.simulate(ac.compile(Sources()), (0, 4e-4), saveat=ts)
    for name, rise, half in (("heidler", 10e-6, 350e-6), ("double", 1.2e-6, 50e-6)):
        y = np.asarray(found[f"{name}.y"]) / 2
        top = int(y.argmax())
        assert y[top] == pytest.approx(1, abs=1e-5)
        t10, t90 = (np.interp(part, y[:top], ts[:top]) for part in (0.1, 0.9))
        assert t90 - t10 == pytest.approx(0.8 * rise, rel=2e-3)
        t50 = np.interp(-0.5, -y[top:], ts[top:])
        assert t50 - (t10 - 0.1 * rise) == pytest.approx(half, rel=2e-3)
    v, i = np.asarray(found["supply.v"]), -np.asarray(found["supply.i"])
    assert v[0] == pytest.approx(60, abs=1e-3)
    assert i[-1] == pytest.approx(50, abs=1e-3)
    assert (v * i).max() == pytest.approx(1200)
    assert (v * i)[4000] == pytest.approx(1200)


def test_an_impulse_needs_a_rise_that_is_shorter_than_its_decay() -> None:
    with pytest.raises(ac.DeclarationError, match=r"T1=1e-05 and T2=1e-06 must be positive"):
        ac.compile(el.LightningImpulse(amplitude=1.0, T2=1e-6))


def test_a_record_gives_parameters_to_others(tmp_path: Path) -> None:
    circuits = "Modelica.Electrical.Analog.Examples.OpAmps.OpAmpCircuits"
    components = {
        "data": {"class": f"{circuits}.DifferentialAmplifierData", "with": {"k": 50.0}},
        "r": {
            "class": "Modelica.Electrical.Analog.Basic.Resistor", "with": {"R": "2*data.R3"},
        },
        "g": {"class": "Modelica.Electrical.Analog.Basic.Ground"},
    }  # fmt: skip
    file = tmp_path / "record.json"
    file.write_text(
        json.dumps({"components": components, "connections": [["r.p", "g.p"]]}), "utf-8"
    )
    system = ac.compile(ac.load(file))
    resistance = system.observe("r.R_actual", 0.0, np.zeros(0), np.zeros(0), system.parameters())
    assert resistance == pytest.approx(2 * 100e3 / 50)


class LogarithmicAmplifier(ac.Component):
    """An amplifier of a high gain with a diode beside a resistor in its feedback, and a low-pass behind it."""

    GAIN = 1e5

    def __init__(self) -> None:
        super().__init__()
        self.amplifier = el.VCV(gain=self.GAIN)
        self.source = el.ConstantVoltage(V=1.0)
        self.into, self.back, self.out = (el.Resistor(R=R) for R in (1e3, 1e5, 1e3))
        self.diode = el.Diode()
        self.capacitor = el.Capacitor(C=1e-6, v=ac.Start(0.0, fixed=True))
        self.ground = el.Ground()
        grounded = self.source.n, self.amplifier.p1, self.amplifier.n2, self.capacitor.n
        self.connect(self.ground.p, *grounded)
        self.connect(self.source.p, self.into.p)
        self.connect(self.into.n, self.back.p, self.diode.p, self.amplifier.n1)
        self.connect(self.back.n, self.diode.n, self.amplifier.p2, self.out.p)
        self.connect(self.out.n, self.capacitor.p)


@pytest.mark.slow
def test_a_diode_around_an_amplifier_of_a_high_gain():
    """Its voltage hangs on the input of the amplifier, 3 µV, beside 1 V of the source."""
    gain = LogarithmicAmplifier.GAIN

    def off(v):
        diode = 1e-6 * (np.exp(v / 0.04) - 1) + v / 1e8
        return (1 - v / (1 + gain)) / 1e3 - diode - v / 1e5

    v = brentq(off, 0, 0.6)
    system = ac.compile(LogarithmicAmplifier())
    result = ac.simulate(system, 3e-3, rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(result["diode.v"], v, rtol=1e-8)
    np.testing.assert_allclose(result["back.v"], 1e5 * result["back.i"], rtol=1e-6)
    charged = -v * gain / (1 + gain) * (1 - np.exp(-np.asarray(result.t) / 1e-3))
    np.testing.assert_allclose(result["capacitor.v"], charged, atol=1e-6)
