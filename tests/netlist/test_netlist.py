"""Models as data: what a file means, that reading and writing are inverse, and what a file cannot do."""

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

import acausal as ac
from acausal.components import (
    blocks,
    fluid,
    magnetic,
    neural,
    rotational,
    thermal,
    translational as tl,
)
from acausal.flattening.flat_model import FlatModel, flatten
from examples.qvm import model as qvm
from tests.support.counted import calls_below
from tests.test_event_oracles import FOLDER as EVENTS, NETLISTS as WITH_EVENTS
from tests.test_oracles import FOLDER, NETLISTS

SCHEMA = json.loads(
    (Path(ac.__file__).parent / "netlist" / "netlist.schema.json").read_text(encoding="utf-8")
)
VALID = jsonschema.Draft202012Validator(SCHEMA)

TL = "Modelica.Mechanics.Translational.Components"
OSCILLATOR: dict[str, Any] = {
    "model": "Oscillator",
    "parameters": {"c": 100.0, "w": "sqrt(c/mass.m)"},
    "components": {
        "fixed": {"class": f"{TL}.Fixed"},
        "spring": {"class": f"{TL}.Spring", "with": {"c": "c"}},
        "mass": {"class": f"{TL}.Mass", "with": {"m": 4.0, "s": {"start": 0.1, "fixed": True}}},
    },
    "connections": [["fixed.flange", "spring.flange_a"], ["spring.flange_b", "mass.flange_a"]],
    "initial_equations": ["mass.v = w*mass.s"],
}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "model.json"


def read(file: Path, document: Any, libraries: Any = ()) -> Any:
    """Load a document that the schema allows."""
    text = document if isinstance(document, str) else json.dumps(document)
    VALID.validate(json.loads(text))
    file.write_text(text, encoding="utf-8")
    return ac.load(file, libraries=libraries)


def saved(model: ac.Component, file: Path, libraries: Any = ()) -> dict[str, Any]:
    """The document that a model is written as."""
    ac.save(model, file, libraries)
    document = json.loads(file.read_text(encoding="utf-8"))
    VALID.validate(document)
    return document


def content(flat: FlatModel) -> dict[str, Any]:
    """What a flat model says, by name."""
    layout = flat.layout
    names = [layout.variable(i) for i in range(flat.n_variables)]
    attributes = zip(flat.start, flat.fixed, flat.nominal, flat.state, strict=True)
    values = {layout.parameter(i): v for i, v in enumerate(flat.value.tolist())}
    bound = {
        layout.parameter(b.target): [layout.parameter(a) for a in b.arguments]
        for b in flat.bindings
    }
    return {
        "variables": dict(zip(names, ([float(x) for x in a] for a in attributes), strict=True)),
        "parameters": {name: v for name, v in values.items() if not math.isnan(v)},
        "bound": {name: set(arguments) for name, arguments in bound.items()},
        "equations": sorted(f"{g.template.residual}: {len(g)}" for g in flat.groups),
        "initial": sorted(f"{g.template.residual}: {len(g)}" for g in flat.initial),
        "inputs": [layout.variable(i) for i in flat.inputs],
    }


def same(one: ac.Component, other: ac.Component) -> None:
    assert content(flatten(one)) == content(flatten(other))


# -- round trips -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NETLISTS)
def test_an_oracle_is_written_as_it_was_read(name: str, file: Path) -> None:
    original = (FOLDER / f"{name}.json").read_text(encoding="utf-8")
    VALID.validate(json.loads(original))
    ac.save(ac.load(FOLDER / f"{name}.json"), file)
    assert file.read_text(encoding="utf-8") == json.dumps(json.loads(original), indent=1) + "\n"
    same(ac.load(file), ac.load(FOLDER / f"{name}.json"))


def test_a_model_of_python_makes_the_round_trip(file: Path) -> None:
    for model in (qvm.linear(), qvm.truth(), qvm.with_networks(wrong=True)):
        document = saved(model, file, [qvm])
        again = ac.load(file, libraries=[qvm])
        same(again, model)
        assert saved(again, file, [qvm]) == document
    assert document["model"] == "QuarterVehicle"
    assert document["components"]["body"]["class"] == f"{TL}.Mass"
    assert document["components"]["body"]["with"] == {"m": pytest.approx(350.0 / 0.9)}
    assert document["components"]["spring_nn"] == {
        "class": "acausal.components.neural.Compliance",
        "with": {"input_scale": 0.01, "output_scale": 200.0},
    }


def test_classes_of_a_users_library(file: Path) -> None:
    document = saved(qvm.truth(), file, [qvm])
    assert document["components"]["friction"] == {"class": "examples.qvm.model.StribeckFriction"}
    with pytest.raises(ac.NetlistError, match=r"class ProgressiveSpring is in no library"):
        ac.save(qvm.truth(), file)
    with pytest.raises(
        ac.NetlistError, match=r"no class 'examples\.qvm\.model\.ProgressiveSpring'"
    ):
        ac.load(file)


class Suspension(ac.Component):
    """A subsystem with a connector, a signal and a parameter of its own."""

    c = ac.Parameter(10.0, unit="N/m", min=0)
    flange = tl.Flange()
    speed = ac.Output(unit="m/s")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.spring = tl.SpringDamper(c=self.c, d=2 * self.c / 10)
        self.masses = [tl.Mass(m=1.0, s=ac.Start(2 * self.c)), tl.Mass(m=2.0)]
        self.sensor = tl.SpeedSensor()
        self.connect(self.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.masses[0].flange_a)
        self.connect(self.masses[0].flange_b, self.masses[1].flange_a, self.sensor.flange)
        self.connect(self.sensor.v, self.speed)


class Vehicle(ac.Component):
    stiffness = ac.Parameter(50.0)

    def __init__(self) -> None:
        super().__init__()
        self.front = Suspension(c=2 * self.stiffness)
        self.rear = Suspension()
        self.gain = blocks.Gain(k=0.5)
        self.controller = blocks.LimPID(
            yMax=self.stiffness, k=3, controllerType="PI", limiter={"y": {"value": 1.0}}
        )
        self.connect(self.front.flange, self.rear.flange)
        self.connect(self.front.speed, self.gain.u)


def test_subsystems_of_python_make_the_round_trip(file: Path) -> None:
    document = saved(Vehicle(), file)
    front = document["components"]["front"]
    assert front["parameters"] == {"c": {"=": 10.0, "unit": "N/m", "min": 0}}
    assert front["with"] == {"c": "2*stiffness"}
    assert "with" not in document["components"]["rear"]
    assert front["connectors"] == {
        "flange": "Modelica.Mechanics.Translational.Interfaces.Flange",
        "speed": {"class": "Modelica.Blocks.Interfaces.RealOutput", "unit": "m/s"},
    }
    assert list(front["components"]) == ["spring", "masses[1]", "masses[2]", "sensor"]
    assert front["components"]["masses[1]"]["with"] == {"m": 1.0, "s": {"start": "2*c"}}
    assert document["components"]["controller"] == {
        "class": "Modelica.Blocks.Continuous.LimPID",
        "with": {
            "controllerType": "PI",
            "yMax": "stiffness",
            "k": 3.0,
            "limiter": {"y": {"start": 1.0}},
        },
    }
    again = ac.load(file)
    assert content(flatten(again)) == content(flatten(Vehicle()))
    assert saved(again, file) == document


def test_parts_of_all_kinds_make_the_round_trip(file: Path) -> None:
    class Parts(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.table = blocks.CombiTimeTable(table=[[0, 0], [1, 2.5]], extrapolation="Periodic")
            self.motion = blocks.KinematicPTP(deltaq=[1, 2], qd_max=[1], qdd_max=[1])
            self.filter = blocks.CriticalDamping(n=3, f=2, initType="SteadyState")
            self.pipe = fluid.Pipe(
                medium=fluid.Water(rho=990.0),
                V_flowLaminar=1,
                dpLaminar=1,
                V_flowNominal=2,
                dpNominal=3,
                h_g=0,
            )
            self.core = magnetic.Cuboid(
                material=magnetic.M350_50A(), nonLinearPermeability=True, l=0.1, a=0.1, b=0.1
            )
            self.heat = neural.Compliance(
                thermal.HeatPort, secondary=("level",), width=4, activation="tanh"
            )
            self.mass = tl.Mass(
                m=1, s=ac.Start(nominal=2.0, state="always"), flange_a={"s": ac.Start(1.0)}
            )
            self.gear = rotational.IdealGear(ratio=2, useSupport=True)

    model = Parts()
    document = saved(model, file)
    given = {name: entry["with"] for name, entry in document["components"].items()}
    assert given["pipe"]["medium"] == "Water(rho=990.0)"
    assert given["core"]["material"] == "M350_50A()"
    assert given["table"] == {"table": [[0.0, 0.0], [1.0, 2.5]], "extrapolation": "Periodic"}
    assert given["filter"] == {"n": 3, "initType": "SteadyState", "f": 2.0}
    assert given["mass"]["s"] == {"nominal": 2.0, "stateSelect": "StateSelect.always"}
    assert given["mass"]["flange_a"] == {"s": {"start": 1.0}}
    assert given["heat"] == {
        "width": 4,
        "activation": '"tanh"',
        "connector": "Modelica.Thermal.HeatTransfer.Interfaces.HeatPort",
        "secondary": ['"level"'],
    }
    again = ac.load(file)
    assert type(again.heat) is type(model.heat)
    same(again, model)
    assert saved(again, file) == document


def test_what_changed_since_is_written(file: Path) -> None:
    model = read(file, OSCILLATOR)
    model.modify(c=200.0)
    model.mass.modify(m=5.0)
    model.damper = tl.Damper(d=2 * model.c)
    model.connect(model.mass.flange_b, model.damper.flange_a)
    document = saved(model, file)
    assert document["parameters"] == {"c": 200.0, "w": "sqrt(c/mass.m)"}
    assert document["components"]["mass"]["with"] == {"m": 5.0, "s": {"start": 0.1, "fixed": True}}
    assert document["components"]["damper"] == {"class": f"{TL}.Damper", "with": {"d": "2*c"}}
    assert document["connections"][2] == ["mass.flange_b", "damper.flange_a"]
    assert document["components"]["spring"] == OSCILLATOR["components"]["spring"]


def test_keys_of_the_experiment_are_kept(file: Path) -> None:
    notes = {
        "start_time": 0.0,
        "stop_time": 2,
        "compare": ["mass.s"],
        "unparsed": ["import x"],
        "description": "ä",
    }
    model = read(file, {**OSCILLATOR, **notes})
    assert model.document == notes
    assert saved(model, file) == {**OSCILLATOR, **notes}


def test_classes_keep_the_names_of_the_file(file: Path) -> None:
    document = {
        "connectors": {"flange": "Modelica.Mechanics.Translational.Interfaces.Flange_b"},
        "components": {
            "mass": {"class": "acausal.components.translational.Mass", "with": {"m": 1}},
            "rod": {"class": "acausal.components.translational.components.Rod"},
        },
    }
    model = read(file, document)
    assert saved(model, file) == document
    again = ac.load(file)
    again.other = tl.Mass(m=2)
    assert saved(again, file)["components"]["other"]["class"] == f"{TL}.Mass"


# -- what a file means -------------------------------------------------------------------------------


def values(model: ac.Component) -> dict[str, float]:
    """All parameters with their numbers, bound ones computed."""
    flat = flatten(model)
    known = flat.value.tolist()
    for _ in flat.bindings:
        for binding in flat.bindings:
            at = dict(zip(binding.symbols, (known[a] for a in binding.arguments), strict=True))
            expression: Any = binding.expression
            known[binding.target] = float(expression.xreplace(at))
    return {flat.layout.parameter(i): v for i, v in enumerate(known)}


def test_expressions_reach_parameters_of_the_model_and_of_parts(file: Path) -> None:
    model = read(
        file,
        {
            "parameters": {"b": "2*a", "a": "sine.f + 1", "unused": "Modelica.Constants.g_n"},
            "components": {
                "filter": {
                    "class": "Modelica.Blocks.Continuous.CriticalDamping",
                    "with": {"f": "50*sine.f", "n": 3.0},
                },
                "sine": {"class": "Modelica.Blocks.Sources.Sine", "with": {"f": "0.5*4"}},
                "gain": {"class": "Modelica.Blocks.Math.Gain", "with": {"k": "b^2"}},
            },
        },
    )
    found = values(model)
    assert found["filter.f"] == 100.0
    assert (found["a"], found["b"], found["gain.k"], found["unused"]) == (3.0, 6.0, 36.0, 9.80665)
    assert list(model._node.children) == ["filter", "sine", "gain"]
    assert model.filter.n == 3


def test_a_zero_of_the_model_is_folded_until_somebody_changes_it(file: Path) -> None:
    element = "Modelica.Electrical.Analog"
    document = {
        "model": "Charge",
        "parameters": {"C": 0.0},
        "components": {
            "capacitor": {
                "class": f"{element}.Basic.Capacitor",
                "with": {"C": "C", "v": {"start": 1.0}},
            },
            "resistor": {"class": f"{element}.Basic.Resistor", "with": {"R": 2.0}},
            "ground": {"class": f"{element}.Basic.Ground"},
        },
        "connections": [
            ["resistor.p", "capacitor.p"],
            ["resistor.n", "capacitor.n"],
            ["ground.p", "capacitor.n"],
        ],
    }
    model = read(file, document)
    system = ac.compile(model)
    assert system.states == ()
    assert repr(system).startswith("System of Charge (")
    ac.save(model, file)
    assert json.loads(file.read_text())["parameters"] == {"C": 0.0}
    model.modify(C=0.5)
    assert ac.compile(model).states == ("capacitor.v",)


def test_nested_modifiers(file: Path) -> None:
    model = read(
        file,
        {
            "components": {
                "pid": {
                    "class": "Modelica.Blocks.Continuous.LimPID",
                    "with": {
                        "yMax": {"displayUnit": "", "=": 12.0},
                        "limiter": {"u": {"start": 0.5}, "uMax": 7.0},
                        "P": {"k": {"unit": "1", "=": 2.0}},
                        "Ti": {"displayUnit": "ms"},
                    },
                },
                "mass": {
                    "class": f"{TL}.Mass",
                    "with": {"m": {"start": 3.0}, "flange_a": {"f": {"start": 1}}},
                },
            },
        },
    )
    found = values(model)
    assert (found["pid.yMax"], found["pid.limiter.uMax"], found["pid.P.k"]) == (12.0, 7.0, 2.0)
    assert (found["pid.Ti"], found["mass.m"]) == (0.5, 3.0)
    starts = content(flatten(model))["variables"]
    assert starts["pid.limiter.u"][0] == 0.5
    assert starts["mass.flange_a.f"][0] == 1.0


def test_vectors_and_matrices(file: Path) -> None:
    model = read(
        file,
        {
            "parameters": {"q": 2.0, "rows": [[0, 0], [1, "q"]], "k": "{1, q}"},
            "components": {
                "ptp": {
                    "class": "Modelica.Blocks.Sources.KinematicPTP",
                    "with": {"deltaq": "{q, 3*q}", "qd_max": [1], "qdd_max": "k"},
                },
                "table": {
                    "class": "Modelica.Blocks.Sources.CombiTimeTable",
                    "with": {"table": "rows"},
                },
                "other": {
                    "class": "Modelica.Blocks.Sources.CombiTimeTable",
                    "with": {"table": "[0, 0; 1, 2*q]"},
                },
                "gain": {"class": "Modelica.Blocks.Math.Gain", "with": {"k": "rows[2,2] + k[2]"}},
                "sum": {"class": "Modelica.Blocks.Math.Sum", "with": {"nin": "integer(q)"}},
            },
            "connections": [["ptp.y[2]", "gain.u"], ["ptp.y", "sum.u"]],
        },
    )
    found = values(model)
    assert [found[f"ptp.deltaq[{i}]"] for i in (1, 2)] == [2.0, 6.0]
    assert found["ptp.qdd_max[2]"] == 2.0
    assert (model.table.table, model.other.table) == ([[0, 0], [1, 2.0]], [[0, 0], [1, 4.0]])
    assert found["gain.k"] == 4.0
    assert model.sum.nin == 2
    assert len(model._node.connections) == 3
    assert saved(model, file)["connections"] == [["ptp.y[2]", "gain.u"], ["ptp.y", "sum.u"]]


def test_options_enumerations_records_and_constants(file: Path) -> None:
    model = read(
        file,
        {
            "parameters": {
                "medium": "Modelica.Thermal.FluidHeatFlow.Media.Water()",
                "support": "not false",
                "kind": "Modelica.Blocks.Types.Init.SteadyState",
                "order": 4,
            },
            "components": {
                "gear": {
                    "class": "Modelica.Mechanics.Rotational.Components.IdealGear",
                    "with": {"ratio": 2.0, "useSupport": "support"},
                },
                "lag": {
                    "class": "Modelica.Blocks.Continuous.FirstOrder",
                    "with": {"T": 1.0, "initType": "kind"},
                },
                "filter": {
                    "class": "Modelica.Blocks.Continuous.LowpassButterworth",
                    "with": {"f": 1.0, "n": "order/2", "initType": "Init.NoInit"},
                },
                "source": {
                    "class": "Modelica.Thermal.FluidHeatFlow.Sources.Ambient",
                    "with": {
                        "medium": "medium",
                        "constantAmbientPressure": 1.0,
                        "constantAmbientTemperature": 300.0,
                    },
                },
                "brake": {
                    "class": "Modelica.Mechanics.Rotational.Sources.EddyCurrentTorque",
                    "with": {
                        "alpha20": "Modelica.Electrical.Machines.Thermal.Constants.alpha20Copper",
                        "tau_nominal": 1.0,
                        "TRef": 293.15,
                        "w_nominal": 1.0,
                    },
                },
            },
        },
    )
    assert model.gear.useSupport is True
    assert model.lag.initType == "SteadyState"
    assert (model.filter.n, type(model.filter.n)) == (2, int)
    assert model.source.medium == fluid.Water()
    assert values(model)["brake.alpha20"] == 3.92e-3
    again = saved(model, file)
    assert again["parameters"]["medium"] == "Modelica.Thermal.FluidHeatFlow.Media.Water()"


def test_a_variable_may_be_given_a_value(file: Path) -> None:
    document = {
        **OSCILLATOR,
        "components": {
            **OSCILLATOR["components"],
            "energy": {
                "class": "Modelica.Blocks.Sources.RealExpression",
                "with": {"y": "c*mass.s^2/2 + time"},
            },
        },
    }
    model = read(file, document)
    flat = flatten(model)
    assert flat.n_equations == flat.n_variables
    assert saved(model, file) == document
    for key, raw, reason in (
        ("u", "1", r"with\.u is an input; connect a source to it"),
        ("k", "mass.s", "only parameters may stand in a parameter's value"),
    ):
        document["components"]["gain"] = {"class": "Modelica.Blocks.Math.Gain", "with": {key: raw}}
        with pytest.raises(ac.NetlistError, match=reason):
            read(file, document)


def test_connections_to_what_an_option_leaves_out_fall_away(file: Path) -> None:
    document: dict[str, Any] = {
        "components": {
            "force": {
                "class": "Modelica.Mechanics.Translational.Sources.ConstantForce",
                "with": {"f_constant": 1.0, "useSupport": False},
            },
            "fixed": {"class": f"{TL}.Fixed"},
        },
        "connections": [["fixed.flange", "force.support"]],
    }
    model = read(file, document)
    assert not model._node.connections
    assert saved(model, file)["connections"] == document["connections"]
    document["components"]["force"]["with"]["useSupport"] = True
    assert len(read(file, document)._node.connections) == 1


def test_subsystems(file: Path) -> None:
    corner = {
        "model": "Corner",
        "parameters": {"c": 10.0, "d": "c/5", "n": None},
        "connectors": {
            "flange": "Modelica.Mechanics.Translational.Interfaces.Flange_a",
            "command": {"class": "Modelica.Blocks.Interfaces.RealInput", "unit": "N"},
        },
        "components": {
            "spring": {"class": f"{TL}.SpringDamper", "with": {"c": "c", "d": "d"}},
            "mass": {"class": f"{TL}.Mass", "with": {"m": "n"}},
            "force": {"class": "Modelica.Mechanics.Translational.Sources.Force"},
            "out": {"class": "Modelica.Blocks.Interfaces.RealOutput"},
            "sensor": {"class": "Modelica.Mechanics.Translational.Sensors.SpeedSensor"},
        },
        "connections": [
            ["flange", "spring.flange_a"],
            ["spring.flange_b", "mass.flange_a"],
            ["mass.flange_b", "force.flange"],
            ["mass.flange_b", "sensor.flange"],
            ["command", "force.f"],
            ["sensor.v", "out"],
        ],
        "initial_equations": ["mass.s = c"],
        "with": {"n": "size", "d": 1.0, "spring": {"s_rel0": "size/2"}},
    }
    other = {**corner, "initial_equations": ["mass.v = d"], "with": {"n": 3.0}}
    document = {
        "model": "Vehicle",
        "parameters": {"size": 4.0},
        "components": {
            "front": corner,
            "rear": other,
            "sine": {
                "class": "Modelica.Blocks.Sources.Sine",
                "with": {"f": 1.0, "amplitude": "front.c"},
            },
        },
        "connections": [["front.flange", "rear.flange"], ["sine.y", "front.command"]],
    }
    model = read(file, document)
    found = values(model)
    assert [found[f"front.{n}"] for n in ("c", "d", "mass.m", "spring.s_rel0")] == [
        10.0,
        1.0,
        4.0,
        2.0,
    ]
    assert [found[f"rear.{n}"] for n in ("c", "d", "mass.m", "spring.s_rel0")] == [
        10.0,
        2.0,
        3.0,
        0.0,
    ]
    assert found["sine.amplitude"] == 10.0
    flat = flatten(model)
    assert [flat.layout.variable(i) for i in flat.inputs] == ["rear.command"]
    assert flat.n_equations == flat.n_variables - 1
    origins = sorted(str(group.origins[0]) for group in flat.initial)
    assert origins == ["Netlist: mass.s = c", "Netlist: mass.v = d"]
    assert saved(model, file) == document
    same(ac.load(file), model)


def test_lists_of_parts(file: Path) -> None:
    document = {
        "components": {
            "m[1]": {"class": f"{TL}.Mass", "with": {"m": 1.0}},
            "m[2]": {"class": f"{TL}.Mass", "with": {"m": "m[1].m + 1"}},
        },
        "connections": [["m[1].flange_b", "m[2].flange_a"]],
    }
    model = read(file, document)
    assert [type(part) for part in model.m] == [tl.Mass, tl.Mass]
    assert values(model)["m[2].m"] == 2.0
    assert saved(model, file) == document


def test_parameters_found_at_the_initial_time(file: Path) -> None:
    heat = "Modelica.Thermal.HeatTransfer.Components.HeatCapacitor"
    model = read(
        file,
        {
            "parameters": {"T_final": {"fixed": False, "start": 300.0, "unit": "K"}},
            "components": {
                "a": {"class": heat, "with": {"C": 15.0, "T": {"start": 373.15, "fixed": True}}},
                "b": {"class": heat, "with": {"C": 5.0, "T": {"start": 273.15, "fixed": True}}},
            },
            "initial_equations": ["T_final = (a.T*a.C + b.T*b.C)/(a.C + b.C)"],
        },
    )
    system = ac.compile(model)
    x = dict(zip(system.states, np.asarray(system.initial_state()), strict=True))
    assert x["T_final"] == pytest.approx(348.15)
    rates = system.vector_field(0.0, system.initial_state(), None, system.parameters())
    assert np.asarray(rates)[list(system.states).index("T_final")] == 0.0


def test_a_loaded_model_runs(file: Path) -> None:
    system = ac.compile(read(file, OSCILLATOR))
    found = ac.simulate(system, (0.0, 0.5), dt=1e-3)
    exact = 0.1 * (np.cos(5 * found.t) + np.sin(5 * found.t))
    np.testing.assert_allclose(found["mass.s"], exact, atol=1e-8)


@pytest.mark.slow
def test_forward_references_need_no_recursion(file: Path) -> None:
    chain = {f"p{i}": f"p{i + 1} + 1" for i in range(3000)} | {"p3000": 1.0}
    model = read(file, {"parameters": chain})
    assert len(flatten(model).bindings) == 3000


# -- what a file cannot do ---------------------------------------------------------------------------


def with_mass(**given: Any) -> dict[str, Any]:
    return {"components": {"mass": {"class": f"{TL}.Mass", "with": given}}}


def nested(levels: int) -> dict[str, Any]:
    document: dict[str, Any] = {"components": {}}
    for _ in range(levels):
        document = {"components": {"inner": document}}
    return document


HOSTILE: dict[str, tuple[Any, str]] = {
    "nothing": ("", "line 1, column 1: not JSON"),
    "half a file": ('{"model": "x",', "line 1, column 15: not JSON"),
    "no text": (b"\xff\xfe\x00", "not a text file in UTF-8"),
    "a list": ("[]", "a model is an object {...}, not a list"),
    "10 MB of brackets": ("[" * 5_000_000 + "]" * 5_000_000, "nested more than 100 deep"),
    "10 MB of objects": ('{"a":' * 2_000_000, "nested more than 100 deep"),
    "a deep value": (
        '{"parameters": {"a": ' + "[" * 300 + "]" * 300 + "}}",
        "nested more than 100 deep",
    ),
    "deep subsystems": (nested(200), "nested more than 100 deep"),
    "a name twice": ('{"model": "a", "model": "b"}', "'model' occurs twice in one object"),
    "a part twice": (
        '{"components": {"a": {"class": "x"}, "a": {"class": "y"}}}',
        "'a' occurs twice in one object",
    ),
    "NaN": ('{"stop_time": NaN}', "NaN is not a finite number"),
    "infinity": ('{"stop_time": -Infinity}', "-Infinity is not a finite number"),
    "half a surrogate pair": (
        '{"components": {"\\ud800": {"class": "x"}}}',
        r"'\ud800' is not a name",
    ),
    "a huge exponent": ('{"parameters": {"a": 1e999999999}}', "1e999999999 is not a finite number"),
    "a million digits": ('{"parameters": {"a": ' + "9" * 1_000_000 + "}}", "with 1000000 digits"),
    "a huge exponent in a text": (with_mass(m="1e999999999"), "not a finite number"),
    "a tower of powers": (with_mass(m="9^9^9^9"), "'^' is not expected there"),
    "a million characters": (
        with_mass(m="1+" * 500_000 + "1"),
        "an expression of 1000001 characters",
    ),
    "a call": (with_mass(m="open(1)"), "'open' cannot be called"),
    "code": (with_mass(m="__import__('os').system('true')"), "''' is not allowed"),
    "an attribute": (with_mass(m="mass.__class__"), "'mass.__class__' is not known here"),
    "an attribute of nothing": (with_mass(m="().__class__"), "'.' is not allowed"),
    "a private attribute": (with_mass(m="mass._node"), "is not known here"),
    "a method": (with_mass(m="mass.modify"), "'mass.modify' is not known here"),
    "a private modifier": (with_mass(_node=1), "has no '_node'"),
    "a dunder modifier": (with_mass(__init__=1), "has no '__init__'"),
    "a method as modifier": (with_mass(connect=1), "has no 'connect'"),
    "a dunder name": ({"parameters": {"__class__": 1}}, "'__class__' is not a name"),
    "a dunder part": (
        {"components": {"__init__": {"class": f"{TL}.Mass"}}},
        "'__init__' is not a name",
    ),
    "a method as part": (
        {"components": {"connect": {"class": f"{TL}.Mass"}}},
        "choose another name",
    ),
    "a module as class": (
        {"components": {"a": {"class": "os.system"}}},
        "there is no class 'os.system'",
    ),
    "the kernel as class": (
        {"components": {"a": {"class": "acausal.components.laws.ac.Component"}}},
        "there is no class",
    ),
    "a function as class": (
        {"components": {"a": {"class": "acausal.components.laws.coulomb"}}},
        "there is no class",
    ),
    "a private class": (
        {"components": {"a": {"class": "acausal.components.blocks.filters._Pair"}}},
        "there is no class",
    ),
    "a long class": ({"components": {"a": {"class": "x" * 1_000_000}}}, "there is no class 'xxx"),
    "a long part": ({"components": {"x" * 1_000_000: 1}}, "a component is an object"),
    "a long key": ({"x" * 1_000_000: 1}, "unknown key 'xxx"),
    "a long modifier": (with_mass(**{"x" * 1_000_000: 1}), "has no 'xxx"),
    "a long end": ({"connections": [["x" * 1_000_000, "y"]]}, "there is no 'xxx"),
    "a far element": (
        {**with_mass(m=1), "connections": [["mass.flange_a[" + "9" * 5000 + "]", "y"]]},
        "there is no",
    ),
    "a circle": (
        {"parameters": {"a": "b", "b": "c", "c": "a"}},
        "a -> b -> c -> a: each is given by the next",
    ),
    "itself": ({"parameters": {"a": "a"}}, "a -> a: each is given by the next"),
    "a wide circle": (
        {"parameters": {f"p{i}": f"p{(i + 1) % 5000}" for i in range(5000)}},
        "each is given by the next",
    ),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_ends_in_one_sentence(name: str, file: Path) -> None:
    given, sentence = HOSTILE[name]
    text = given if isinstance(given, str | bytes) else json.dumps(given)
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    with calls_below(2_000_000), pytest.raises(ac.NetlistError) as caught:
        ac.load(file)
    message = str(caught.value)
    assert sentence in message
    assert message.startswith("model.json")
    assert len(message) < 1000
    assert "\n" not in message
    assert message.encode()
    assert caught.value.__cause__ is None


def test_a_file_may_begin_with_a_byte_order_mark(file: Path) -> None:
    ac.save(qvm.linear(), file)
    file.write_bytes(b"\xef\xbb\xbf" + file.read_bytes())
    assert ac.compile(ac.load(file)).states == ac.compile(qvm.linear()).states


def test_files_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(ac.NetlistError, match="cannot be read"):
        ac.load(tmp_path / "none.json")
    with pytest.raises(ac.NetlistError, match="cannot be read"):
        ac.load(tmp_path)
    with pytest.raises(ac.NetlistError, match="cannot be written"):
        ac.save(qvm.linear(), tmp_path / "none" / "model.json")
    with pytest.raises(ac.ModelError, match="save needs a Component, got dict"):
        ac.save({}, tmp_path / "model.json")  # type: ignore[arg-type]
    with pytest.raises(ac.ModelError, match=r"libraries=\[...\] lists modules, got 'blocks'"):
        ac.load(tmp_path / "model.json", libraries=["blocks"])  # type: ignore[list-item]
    with pytest.raises(ac.ModelError, match=r"libraries=\[...\] lists modules, got 3"):
        ac.load(tmp_path / "model.json", libraries=3)  # type: ignore[arg-type]
    with pytest.raises(ac.ModelError, match=r"^load: None is not a path; give a text such as"):
        ac.load(None)  # type: ignore[arg-type]
    with pytest.raises(ac.ModelError, match=r"^save: 3.5 is not a path; give a text such as"):
        ac.save(qvm.linear(), 3.5)  # type: ignore[arg-type]
    with pytest.raises(ac.ModelError, match=r"^budget='x' is not a budget; give ac.Budget"):
        ac.load(tmp_path / "model.json", budget="x")  # type: ignore[arg-type]


def test_what_cannot_be_written(file: Path) -> None:
    class Stated(ac.Component):
        x = ac.Variable()

        def equations(self) -> Iterator[ac.Eq]:
            yield ac.Eq(ac.der(self.x), 1)

    class Inside(ac.Component):
        def __init__(self, part: ac.Component) -> None:
            super().__init__()
            self.part = part

    with pytest.raises(
        ac.NetlistError, match="Stated states equations of its own, which a file cannot"
    ):
        ac.save(Stated(), file)
    with pytest.raises(ac.NetlistError, match=r"Stated 'part': class Stated is in no library"):
        ac.save(Inside(Stated()), file)
    with pytest.raises(
        ac.NetlistError, match=r"part.*net: a file cannot hold a network; .*modify\(net=\.\.\.\)"
    ):
        ac.save(Inside(neural.Compliance(net=lambda key: None)), file)
    with pytest.raises(ac.NetlistError, match="was made with arguments that a file cannot hold"):
        ac.save(Inside(blocks.RealExpression(y=2 * ac.time)), file)
    outside = tl.Mass(m=2.0)
    with pytest.raises(ac.NetlistError, match="refers to 'm', which is not part of Inside"):
        ac.save(Inside(tl.Mass(m=2 * outside.m)), file)


# -- the schema --------------------------------------------------------------------------------------

WRONG_FORM: dict[str, Any] = {
    "no object": [],
    "unknown key": {"component": {}},
    "title": {"model": 1},
    "description": {"description": ["x"]},
    "time": {"stop_time": "1"},
    "truth as time": {"stop_time": True},
    "compare": {"compare": [1]},
    "unparsed": {"unparsed": "x"},
    "parameters": {"parameters": []},
    "parameter name": {"parameters": {"a b": 1}},
    "underscore": {"parameters": {"_a": 1}},
    "parameter attribute": {"parameters": {"a": {"=": 1, "fixd": False}}},
    "parameter fixed": {"parameters": {"a": {"=": 1, "fixed": 0}}},
    "parameter unit": {"parameters": {"a": {"=": 1, "unit": 2}}},
    "parameter bound": {"parameters": {"a": {"=": 1, "min": "0"}}},
    "components": {"components": ["x"]},
    "component": {"components": {"a": "x"}},
    "no class": {"components": {"a": {}}},
    "class": {"components": {"a": {"class": 1}}},
    "component key": {"components": {"a": {"class": f"{TL}.Fixed", "wth": {}}}},
    "modifiers": {"components": {"a": {"class": f"{TL}.Fixed", "with": [1]}}},
    "modifier": {"components": {"a": {"class": f"{TL}.Fixed", "with": {"s0": None}}}},
    "start": {"components": {"a": {"class": f"{TL}.Mass", "with": {"m": 1, "s": {"start": None}}}}},
    "part name": {"components": {"a-b": {"class": f"{TL}.Fixed"}}},
    "element name": {"components": {"a[0]": {"class": f"{TL}.Fixed"}}},
    "class and parts": {"components": {"a": {"class": f"{TL}.Fixed", "components": {}}}},
    "subsystem key": {"components": {"a": {"components": {}, "connection": []}}},
    "subsystem modifiers": {"components": {"a": {"components": {}, "with": []}}},
    "modifiers at the top": {"with": {}},
    "connectors": {"connectors": ["a"]},
    "connector": {"connectors": {"a": 1}},
    "connector key": {
        "connectors": {"a": {"class": "Modelica.Blocks.Interfaces.RealInput", "size": 2}}
    },
    "connector unit": {
        "connectors": {"a": {"class": "Modelica.Blocks.Interfaces.RealInput", "unit": 2}}
    },
    "connections": {"connections": {"a": "b"}},
    "connection": {"connections": ["a - b"]},
    "three ends": {"connections": [["a", "b", "c"]]},
    "end": {"connections": [["a", 1]]},
    "initial equations": {"initial_equations": "x = 1"},
    "initial equation": {"initial_equations": [1]},
}


def test_the_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("name", WRONG_FORM)
def test_schema_and_loader_refuse_the_same(name: str, file: Path) -> None:
    assert not VALID.is_valid(WRONG_FORM[name])
    file.write_text(json.dumps(WRONG_FORM[name]), encoding="utf-8")
    with pytest.raises(ac.NetlistError):
        ac.load(file)


@pytest.mark.skipif(
    not FOLDER.is_dir(), reason="the reference trajectories lie in ../shared/oracles"
)
def test_the_schema_knows_the_oracles() -> None:
    paths = [FOLDER / f"{name}.json" for name in NETLISTS]
    for path in (*paths, *(EVENTS / f"{name}.json" for name in WITH_EVENTS)):
        VALID.validate(json.loads(path.read_text(encoding="utf-8")))
