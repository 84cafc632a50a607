"""Files and packages of Modelica text: where classes are found, and what a loaded model can do."""

import copy
import json
from functools import partial
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.command import main
from acausal.components import neural, translational as tl
from acausal.modelica import statements
from acausal.modelica.evaluate import Evaluator
from acausal.modeling import Reference
from benchmarks import import_, library
from benchmarks.chain import Chain
from tests.export.test_modelica import CASES, Vectors

TEXTBOOK = Path(__file__).with_name("Textbook.mo")
PACKAGE = {
    "Plant/package.mo": "package Plant constant Real factor = 2; end Plant;",
    "Plant/package.order": "Sub\nLaw\n",
    "Plant/Law.mo": """within Plant;
        partial model Law "a law without its equation"
          Real x(start = 1, fixed = true);
          parameter Real k = factor;
        end Law;""",
    "Plant/Sub/package.mo": "within Plant; package Sub extends Modelica.Icons.Package; end Sub;",
    "Plant/Sub/Decay.mo": """within Plant.Sub;
        model Decay
          extends Law(k = 3*factor);
        equation
          der(x) = -k*x;
        end Decay;""",
    "User.mo": """model User
          import Plant.Sub.Decay;
          import P = Plant;
          import Plant.Sub.*;
          import Plant.{Law, Sub};
          Decay a;
          P.Sub.Decay b(k = P.factor), c;
        end User;""",
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in PACKAGE.items():
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return tmp_path


@pytest.mark.parametrize("file", ["Plant", "Plant/package.mo", "Plant/Sub/Decay.mo"])
def test_a_package_over_folders(folder: Path, file: str) -> None:
    model = ac.load(folder / file, "Plant.Sub.Decay")
    assert [str(e) for e in model.equations()] == ["der(x) = -k*x"]
    assert model._node.modifiers["k"] == 6


def test_packages_are_found_beside_the_file_and_by_path(folder: Path, tmp_path: Path) -> None:
    model = ac.load(folder / "User.mo")
    assert [model._node.children[n]._node.modifiers["k"] for n in "abc"] == [6, 2, 6]
    (folder / "elsewhere").mkdir()
    moved = (folder / "User.mo").rename(folder / "elsewhere" / "User.mo")
    with pytest.raises(ac.ModelicaError, match=r"line 2, .* 'Plant.Sub.Decay'; give the folder"):
        ac.load(moved)
    assert ac.load(moved, path=[folder]).a.x is not None


def test_a_package_is_a_namespace_of_classes(folder: Path, tmp_path: Path) -> None:
    plant = ac.import_modelica(folder / "Plant")
    assert repr(plant) == "Plant: Sub, Law, factor"
    assert (plant.factor, dir(plant.Sub)) == (2, ["Decay"])
    decay = plant.Sub.Decay(k=5.0)
    assert type(decay) is plant.Sub.Decay
    assert decay._node.modifiers["k"] == 5
    assert repr(ac.import_modelica("Plant", path=[folder]).Sub) == "Plant.Sub: Decay"
    (tmp_path / "parts.mo").write_text("connector C Real p; flow Real f; end C; function g end g;")
    parts = ac.import_modelica(tmp_path / "parts.mo", path=[folder])
    assert issubclass(parts.C, ac.Connector)
    with pytest.raises(AttributeError, match=r"parts\.mo has no 'D'; known are 'C', 'g'"):
        parts.D  # noqa: B018
    with pytest.raises(
        ac.ModelicaError, match=r"line 1, column \d+: 'g' is a function, not a model"
    ):
        parts.g  # noqa: B018
    with pytest.raises(ac.ModelicaError, match="there is no package 'Pump'; give the folder"):
        ac.import_modelica("Pump", path=[folder])


def test_a_python_model_has_parts_of_the_text() -> None:
    parts = ac.import_modelica(TEXTBOOK)

    class Discharge(ac.Component):
        def __init__(self, **modifiers: Any) -> None:
            self.c, self.r, self.g = parts.Capacitor(C=0.5), parts.Resistor(R=4.0), parts.Ground()
            self.connect(self.c.p, self.r.p)
            self.connect(self.c.n, self.r.n, self.g.p)
            super().__init__(**modifiers)

    system = ac.compile(Discharge())
    found = system.vector_field(0.0, np.array([3.0]), None, system.parameters())
    assert np.asarray(found) == pytest.approx([-1.5])
    with pytest.raises(ac.ModelError, match="Resistor has no 'RR': did you mean 'R'"):
        parts.Resistor(RR=4.0)


def test_a_file_beside_that_has_other_classes_hides_no_constant(tmp_path: Path) -> None:
    (tmp_path / "n.mo").write_text("package Other end Other;")
    (tmp_path / "p.mo").write_text(
        "package P constant Integer n=2; model M Real x[n]=ones(n); end M; end P;"
    )
    assert len(ac.load(tmp_path / "p.mo").x) == 2


def test_the_last_model_is_meant_or_one_by_its_name(tmp_path: Path) -> None:
    file = tmp_path / "two.mo"
    file.write_text("package P model A Real a=1; end A; model B Real b=1; end B; end P;")
    assert (type(ac.load(file)).__name__, type(ac.load(file, "A")).__name__) == ("B", "A")
    with pytest.raises(ac.ModelError, match=r"no model 'C'; it has 'P\.A', 'P\.B'"):
        ac.load(file, "C")
    netlist = tmp_path / "model.json"
    netlist.write_text(json.dumps({"components": {}}))
    with pytest.raises(ac.ModelError, match="is a netlist, which is one model"):
        ac.load(netlist, "A")
    with pytest.raises(ac.ModelError, match="takes the name of a model"):
        ac.load(file, 3)  # type: ignore[arg-type]


def test_a_model_within_another_is_meant_by_its_name_only(tmp_path: Path) -> None:
    file = tmp_path / "nested.mo"
    file.write_text("model Whole model Part Real x=1; end Part; Part a; end Whole;")
    assert (type(ac.load(file)).__name__, type(ac.load(file, "Part")).__name__) == ("Whole", "Part")
    file.write_text("partial model Whole model Part Real x=1; end Part; end Whole;")
    with pytest.raises(ac.ModelError, match="neither partial nor nested"):
        ac.load(file)


def test_lines_of_the_text_are_named_where_equations_do_not_fit(tmp_path: Path) -> None:
    file = tmp_path / "Bad.mo"
    file.write_text(
        "model Bad\n  Real x(start=1), y = 3*x;\nequation\n  der(x) = -x;\n  y = 2*x;\nend Bad;\n"
    )
    with pytest.raises(ac.StructureError, match=r"See lines 2, 4, 5 of Bad\.mo\."):
        ac.compile(ac.load(file))


def test_earlier_names_of_the_standard_library(tmp_path: Path) -> None:
    file = tmp_path / "old.mo"
    file.write_text("""model Old
      Modelica.Blocks.Sources.Clock clock;
      Modelica.Blocks.Sources.Sine sine(freqHz = 0.25);
      Real y = clock.y + sine.y;
    end Old;""")
    assert float(ac.simulate(ac.compile(ac.load(file)), 1.0, dt=0.5)["y"][-1]) == pytest.approx(2)


def test_the_experiment_is_kept() -> None:
    assert ac.load(TEXTBOOK, "RC").document == {"stop_time": 3}


def test_a_class_of_the_text_is_a_class_of_python() -> None:
    rc = ac.load(TEXTBOOK, "RC")
    other = type(rc.r)(R=5.0)
    assert other._node.modifiers["R"] == 5
    replaced = rc.replace("r", other)
    assert [replaced.r._node.modifiers["R"], rc.r._node.modifiers["R"]] == [5, rc.R]
    assert len(type(rc)(R=7.0).c._node.parent.children) == 4


def test_a_copy_reads_its_own_equations() -> None:
    model = copy.deepcopy(ac.load(TEXTBOOK, "NonlinearResistor"))
    own = list(model.equations())[-1].rhs.free_symbols
    owners = {symbol.owner for symbol in own if isinstance(symbol, Reference)}
    assert owners == {model._node}


def test_a_part_of_the_text_is_replaced_by_one_of_the_library() -> None:
    model = ac.load(TEXTBOOK, "Chain2").replace("link[2]", tl.SpringDamper(c=20.0, d=0.5))
    assert ac.compile(model).states == ("mass[1].s", "mass[1].v", "mass[2].s", "mass[2].v")


@pytest.mark.parametrize("text", import_.FILES)
def test_a_chain_of_text_is_that_of_python(tmp_path: Path, text: str) -> None:
    file = tmp_path / "Text.mo"
    file.write_text("\n".join(import_.FILES[text](6)))
    systems = [ac.compile(model) for model in (ac.load(file), Chain(3))]
    x = np.linspace(0.2, 0.5, 6)
    rates = [np.asarray(s.vector_field(0.0, x, None, s.parameters())) for s in systems]
    np.testing.assert_allclose(*rates, rtol=1e-14)


def test_what_an_array_of_parts_is_given_is_evaluated_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    evaluated: list[Any] = []
    monkeypatch.setattr(
        Evaluator,
        "comprehension",
        lambda self, e, whole=Evaluator.comprehension: (evaluated.append(e), whole(self, e))[1],
    )
    file = tmp_path / "Text.mo"
    file.write_text("\n".join(import_.FILES["arrays"](20)))
    assert len(ac.load(file).mass) == 10
    assert len(evaluated) == len({id(e) for e in evaluated}) == 3


def test_parts_that_are_alike_are_read_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read: list[str] = []
    whole = statements.equations
    monkeypatch.setattr(
        statements, "equations", lambda b: (read.append(type(b.component).__name__), whole(b))[1]
    )
    file = tmp_path / "Text.mo"
    file.write_text("\n".join(import_.FILES["own"](20)))
    ac.load(file)
    assert {"Chain", "Mass", "SpringDamper"} <= {*read}
    assert len(read) < 8  # of 21 parts and the model
    file.write_text("""package P
      model A parameter Real k = 1; Real x = k; equation assert(k > 0, "k is small"); end A;
      model M A a, b(k = -1); end M;
    end P;""")
    with pytest.raises(ac.ModelicaError, match="violated: k is small"):
        ac.load(file)


@pytest.mark.slow
@pytest.mark.parametrize("selfcontained", [True, False])
@pytest.mark.parametrize("case", ["oscillator", "sampled", "vectors"])
def test_an_export_comes_back(tmp_path: Path, case: str, selfcontained: bool) -> None:
    ours = ac.compile(Vectors() if case == "vectors" else CASES[case][0]())
    params = ours.parameters(1)
    file = ac.export.modelica(ours, tmp_path / "out.mo", params, selfcontained=selfcontained)
    again = ac.compile(ac.load(file))
    assert again.states == ours.states
    x = np.linspace(0.2, 0.5, len(ours.states))
    found, wanted = (
        np.asarray(s.vector_field(0.3, x, None, p))
        for s, p in ((again, again.parameters()), (ours, params))
    )
    assert np.max(np.abs(found - wanted)) < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("selfcontained", [True, False])
def test_gradients_of_an_export_are_the_native_ones(tmp_path: Path, selfcontained: bool) -> None:
    """Of a simulation's loss, with respect to the parameters and to all weights of a network."""
    law = neural.Compliance(input_scale=0.1, output_scale=5.0, odd=True, width=3, depth=1)
    ours = ac.compile(CASES["oscillator"][0]().replace("spring_nn", law))
    params = ours.parameters(1)
    file = ac.export.modelica(ours, tmp_path / "out.mo", params, selfcontained=selfcontained)
    again = ac.compile(ac.load(file))

    def loss(system: ac.System, params: Any) -> Any:
        run = ac.simulate(system, 0.2, dt=0.01, params=params)
        return jax.numpy.sum(run["mass.s"] ** 2 + 0.1 * run["mass.v"] ** 2)

    found = jax.grad(partial(loss, again))(again.parameters())
    wanted = jax.grad(partial(loss, ours))(params)
    layers = wanted.pop("spring_nn.net").net.net
    for kind in ("weights", "biases"):
        for layer, array in enumerate(getattr(layers, kind), start=1):
            for place in np.ndindex(array.shape):
                index = ",".join(str(i + 1) for i in place)
                wanted[f"spring_nn.net_1.{kind}_{layer}[{index}]"] = array[place]
    assert {*found} == {*wanted}
    scale = max(abs(v) for v in wanted.values())
    assert scale > 1e-3
    assert max(abs(found[k] - wanted[k]) for k in found) < 1e-9 * scale


def test_attributes_and_constants_of_a_netlist_are_written(tmp_path: Path) -> None:
    source = "Modelica.Electrical.Analog.Sources.SineVoltage"
    netlist = {
        "components": {
            "v": {"class": source, "with": {"V": {"=": 2.0, "displayUnit": "mV"}, "f": 1, "phase": "pi/2"}},
            "r": {"class": "Modelica.Electrical.Analog.Basic.Resistor", "with": {"R": 1.0}},
            "g": {"class": "Modelica.Electrical.Analog.Basic.Ground"},
        },
        "connections": [["v.p", "r.p"], ["v.n", "r.n"], ["g.p", "v.n"]],
    }  # fmt: skip
    file = tmp_path / "model.json"
    file.write_text(json.dumps(netlist))
    again = ac.load(ac.export.modelica(ac.load(file), tmp_path / "out.mo"))
    assert [again.v._node.modifiers[n] for n in ("V", "phase")] == [2, pytest.approx(np.pi / 2)]


def test_commands_take_a_file_and_a_class_of_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", f"{TEXTBOOK}:Textbook.RC"]) == 0
    assert "RC is right: 20 equations, 1 state" in capsys.readouterr().out
    assert main(["check", f"{TEXTBOOK}:Nope"]) == 3
    assert "there is no model 'Nope'" in capsys.readouterr().err


@pytest.mark.slow
def test_a_benchmark_counts_what_becomes_of_the_models_of_a_library(tmp_path: Path) -> None:
    (tmp_path / "package.mo").write_text("""package Lib
      model A Real x(start = 1, fixed = true); equation der(x) = -x; annotation(experiment(StopTime = 2)); end A;
      model B input Real u; Real x = u; end B;
      model C Real x = delay(time, 1); end C;
      partial model D end D;
      package P model E end E; end P;
    end Lib;""")
    found = [*library.names(tmp_path, examples=False)]
    assert found == ["Lib.A", "Lib.B", "Lib.C", "Lib.P.E"]
    assert [*library.names(tmp_path, examples=True)] == ["Lib.A"]
    columns = [library.outcome(tmp_path, name, [])[0] for name in found[:3]]
    assert columns == ["simulated", "simulated", "refused"]


def test_a_class_that_the_library_has_is_loaded_from_its_text(tmp_path: Path) -> None:
    """A package of the standard library's name has its own text, which is what is asked for."""
    (tmp_path / "package.mo").write_text("""package Modelica package Blocks package Math
      block Gain parameter Real k = 3; input Real u; output Real y = k*u; end Gain;
    end Math; end Blocks; end Modelica;""")
    model = ac.load(tmp_path, "Modelica.Blocks.Math.Gain")
    assert ac.compile(model).parameters() == {"k": 3.0}
