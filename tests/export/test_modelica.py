"""Modelica text, compiled and simulated by rumoca."""

import copy
import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, digital, electrical as el, neural, translational as tl
from examples.qvm import model as qvm
from tests.support.hybrid import Ball, Sampled, Thermostat

POINTS = 41


@pytest.fixture
def rumoca():
    return pytest.importorskip("rumoca", reason="rumoca, which runs the text, is not installed")


class RC(ac.Component):
    def __init__(self):
        super().__init__()
        self.source = el.ConstantVoltage(V=5.0)
        self.r = el.Resistor(R=100.0)
        self.c = el.Capacitor(C=1e-3, v=ac.Start(1.0, fixed=True))
        self.ground = el.Ground()
        self.connect(self.source.p, self.r.p)
        self.connect(self.r.n, self.c.p)
        self.connect(self.c.n, self.source.n, self.ground.p)


class Oscillator(ac.Component):
    def __init__(self):
        super().__init__()
        self.wall = tl.Fixed()
        self.mass = tl.Mass(m=2.0, s=ac.Start(0.1, fixed=True), v=ac.Start(0.0, fixed=True))
        self.damper = tl.SpringDamper(c=50.0, d=3.0)
        self.spring_nn = neural.Compliance(
            input_scale=0.1, output_scale=5.0, odd=True, activation="tanh"
        )
        for element in (self.damper, self.spring_nn):
            self.connect(self.wall.flange, element.flange_a)
            self.connect(element.flange_b, self.mass.flange_a)


class Decays(ac.Component):
    k = ac.Parameter([1.0, 2.0, 3.0], shape=3)
    x = ac.Variable(shape=3, start=1.0, fixed=True)

    def equations(self):
        for i in range(3):
            yield ac.Eq(ac.der(self.x[i]), -self.k[i] * self.x[i])


class Vectors(ac.Component):
    def __init__(self):
        super().__init__()
        self.several = Decays(k=[0.5, 0.5, 1.5], x=ac.Start([3.0, 2.0, 1.0]))
        self.same = Decays(k=2.0, x=ac.Start(2.0))


class Alike(ac.Component):
    """Names that would be one in Modelica, or would hide a type, a function or a package."""

    Modelica = ac.Parameter(0.2)
    Real = ac.Parameter(3.0)
    sin = ac.Parameter(0.5)
    exp = ac.Variable()
    y = ac.Variable(start=1.0, fixed=True)

    def __init__(self):
        super().__init__()
        x = {"x": ac.Start([1.0, 2.0, 3.0])}
        self.a = [Decays(k=[1.0, 2.0, 3.0], **x), Decays(k=[4.0, 5.0, 6.0], **x)]
        self.a_1 = Decays(k=[7.0, 8.0, 9.0], **x)

    def equations(self):
        wave = self.sin * ac.exp(-self.exp) * ac.sin(ac.time) * self.Real
        parts = self.a[0].x[0] - self.a_1.x[0]
        yield ac.Eq(self.exp, self.y)
        yield ac.Eq(ac.der(self.y), self.Modelica + parts - wave)


NETLIST = {
    "parameters": {"k": 30.0},
    "variables": {"slow": {"start": 1.0, "fixed": True}},
    "equations": ["der(slow) = if slow > 0.5 then -slow else -0.5*cos(slow)"],
    "components": {
        "fixed": {"class": "Modelica.Mechanics.Translational.Components.Fixed"},
        "spring": {
            "class": "Modelica.Mechanics.Translational.Components.SpringDamper",
            "with": {"c": "2*k", "d": 0.7},
        },
        "mass": {
            "class": "Modelica.Mechanics.Translational.Components.Mass",
            "with": {
                "m": 1.0,
                "s": {"start": 0.6, "fixed": True},
                "v": {"start": 0.0, "fixed": True},
            },
        },
    },
    "connections": [
        ["fixed.flange", "spring.flange_a"],
        ["spring.flange_b", "mass.flange_a"],
    ],
}

CASES = {
    "rc": (RC, ("c.v", "r.i"), 0.3, ""),
    "oscillator": (Oscillator, ("mass.s", "spring_nn.f"), 2.0, ""),
    "vehicle": (qvm.with_networks, ("body.s", "wheel.v"), 0.5, "road_v_ref"),
    "ball": (Ball, ("h", "v", "n"), 1.5, ""),
    "thermostat": (Thermostat, ("T",), 20.0, ""),
    "sampled": (Sampled, ("x", "u"), 1.05, ""),
}


def agree(rumoca, system, names, end, folder, params=None, driven=""):
    """Compare what rumoca computes from the text with acausal, at times between the events."""
    path = ac.export.modelica(system, folder / "shipped.mo", params, selfcontained=True)
    text = path.read_text()
    title = re.findall(r"^  model (\w+)", text, re.MULTILINE)[-1]
    feed = f"equation m.{driven} = 0.1;" if driven else ""
    text += f"model Run\n  shipped.{title} m;\n{feed}\nend Run;\n"
    config = rumoca.SimConfig(rtol=1e-11, atol=1e-13)
    theirs = rumoca.Session().loads(text, model="Run").simulate(end, dt=end / 40, config=config)
    times = np.linspace(0, end, POINTS)
    inputs = {"road.v_ref": 0.1} if driven else None
    tolerances = {"rtol": 1e-10, "atol": 1e-12}
    ours = ac.simulate(system, (0, end), saveat=times, inputs=inputs, params=params, **tolerances)
    found = np.asarray(theirs.time)
    rows = np.abs(found[:, None] - times).argmin(axis=0)  # rumoca adds rows at events
    np.testing.assert_allclose(found[rows], times, atol=1e-9)
    instants = np.array([event.t for event in ours.events])
    between = np.abs(times[:, None] - instants).min(axis=1, initial=1.0) > 1e-6
    for name in names:
        scale = np.max(np.abs(ours[name]))
        computed = np.asarray(theirs[f"m.{name}"])[rows]
        np.testing.assert_allclose(
            computed[between], ours[name][between], rtol=0, atol=1e-6 * scale, err_msg=name
        )


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("case", CASES)
def test_rumoca_simulates_the_text_as_acausal_does(case, rumoca, tmp_path):
    make, names, end, driven = CASES[case]
    system = ac.compile(make())
    agree(rumoca, system, names, end, tmp_path, system.parameters(1), driven)


@pytest.mark.slow
def test_trained_numbers_are_in_the_text(rumoca, tmp_path):
    system = ac.compile(Oscillator())
    params = {**system.parameters(1), "damper.c": 61.5, "mass.m": 1.25}
    agree(rumoca, system, ("mass.s",), 1.0, tmp_path, params)
    assert system.parameters()["damper.c"] == 50.0
    text = ac.export.modelica(system, tmp_path / "standard.mo", params).read_text()
    assert "Components.SpringDamper damper(c=61.5, d=3)" in text


@pytest.mark.slow
def test_numbers_set_in_the_whole_model_are_in_the_text(rumoca, tmp_path):
    system = ac.compile(Ball(h=ac.Start(2.0)))
    agree(rumoca, system, ("h", "v"), 1.5, tmp_path, {"e": 0.6})


@pytest.mark.slow
def test_vectors(rumoca, tmp_path):
    system = ac.compile(Vectors())
    agree(rumoca, system, system.states, 1.0, tmp_path, {"several.k[2]": 4.0})
    whole = ac.compile(Decays(x=ac.Start([3.0, 2.0, 1.0])))
    (tmp_path / "shipped.mo").unlink()
    agree(rumoca, whole, whole.states, 1.0, tmp_path, {"k[3]": 0.5})


@pytest.mark.slow
def test_a_loaded_netlist(rumoca, tmp_path):
    file = tmp_path / "loaded.json"
    file.write_text(json.dumps(NETLIST))
    system = ac.compile(ac.load(file))
    agree(rumoca, system, ("mass.s", "slow"), 2.0, tmp_path)


@pytest.mark.slow
def test_what_is_outer_in_a_part_is_written(tmp_path):
    text = """package io
      model Env parameter Real g = 5; Real T; equation T = 2 + time; end Env;
      model Part
        outer Env env; Real x(start=1, fixed=true);
      equation
        der(x) = -env.g*x + env.T;
      end Part;
      model Top inner Env env; Part p; Part q(x(start=2)); end Top;
    end io;"""
    (tmp_path / "io.mo").write_text(text)
    system = ac.compile(ac.load(tmp_path / "io.mo", "io.Top"))
    written = ac.export.modelica(system, tmp_path / "written.mo")
    assert "Part p(x(start=1, fixed=true), env_g=env.g);" in written.read_text()
    again = ac.simulate(ac.compile(ac.load(written)), 1.0)
    assert float(again["q.x"][-1]) == pytest.approx(float(ac.simulate(system, 1.0)["q.x"][-1]))


@pytest.mark.slow
def test_names_stay_apart(rumoca, tmp_path):
    system = ac.compile(Alike())
    agree(rumoca, system, ("y",), 1.0, tmp_path)
    text = (tmp_path / "shipped.mo").read_text()
    assert not [d for d in rumoca.validate_source(text) if d.level == "error"]
    declared = re.findall(r"^    (?:parameter )?\w+ ('?\w+'?)[ (;]", text, re.MULTILINE)
    assert {"'Modelica'", "'Real'", "'sin'", "'exp'", "a_1", "a_1_2", "a_2"} <= set(declared)


@pytest.mark.parametrize("case", CASES)
def test_names_of_the_standard_library_parse(case, rumoca, tmp_path):
    path = ac.export.modelica(CASES[case][0](), tmp_path / f"{case}.mo")
    text = path.read_text()
    assert ("Modelica." in text) == (case in ("rc", "oscillator", "vehicle"))
    assert not [d for d in rumoca.validate_source(text) if d.level == "error"]


def test_a_host_callback_is_named(tmp_path):
    def law(x):
        return jax.pure_callback(np.sin, jax.ShapeDtypeStruct((), float), x)

    system = ac.compile(Oscillator())
    params = {**system.parameters(), "spring_nn.net": law}
    message = (
        "'spring_nn.net': the operation 'pure_callback' of this network or table has no counterpart"
    )
    with pytest.raises(ac.DataError, match=message):
        ac.export.modelica(system, tmp_path / "a.mo", params)


def test_a_table_that_needs_the_library_is_named(tmp_path: Path) -> None:
    model = ac.Component()
    model.lut = blocks.CombiTable1Ds(table=[[0.0, 1.0], [1.0, 3.0], [2.0, 4.0]])
    with pytest.raises(ac.DataError, match=r"'lut.column\[1\]': .* leave out selfcontained=True"):
        ac.export.modelica(model, tmp_path / "a.mo", selfcontained=True)
    assert "CombiTable1Ds lut" in ac.export.modelica(model, tmp_path / "a.mo").read_text()


class Angle(ac.Connector):
    φ = ac.Potential(unit="rad")
    τ = ac.Flow(unit="N.m")


class Räder(ac.Component):
    ω = ac.Variable(start=1.0, fixed=True)
    Θ = ac.Parameter(2.0)
    a = Angle()

    def equations(self):
        yield ac.Eq(ac.der(self.ω), -self.Θ * self.ω)
        yield ac.Eq(self.a.φ, self.ω)


def test_names_are_ascii(rumoca, tmp_path):
    text = ac.export.modelica(Räder(), tmp_path / "r.mo").read_text(encoding="utf-8")
    assert re.sub('"[^"]*"', "", text).isascii()
    assert "der('{U+03C9}') = -'{U+0398}'*'{U+03C9}'" in text
    assert "a.'{U+03C6}' = '{U+03C9}'" in text
    assert not [d for d in rumoca.validate_source(text) if d.level == "error"]


def test_values_of_enumerations_have_their_types(tmp_path: Path) -> None:
    model = ac.Component()
    model.source, model.limiter = (
        blocks.Sine(f=1.0),
        blocks.Limiter(uMax=1.0, homotopyType="NoHomotopy"),
    )
    model.amplifier = el.IdealizedOpAmpLimited(homotopyType="UpperLimit")
    model.ground, model.load = el.Ground(), el.Resistor(R=1e3)
    model.before, model.after = digital.Set(x="'0'"), digital.Set(x="'L'")
    model.gate = digital.And(n=2)
    model.connect(model.before.y, model.gate.x[0])
    model.connect(model.after.y, model.gate.x[1])
    model.connect(model.source.y, model.limiter.u)
    model.connect(model.ground.p, model.amplifier.in_p, model.amplifier.in_n, model.load.n)
    model.connect(model.amplifier.out, model.load.p)
    path = ac.export.modelica(ac.compile(model), tmp_path / "enumerations.mo")
    text = path.read_text()
    for value in (
        "Modelica.Blocks.Types.LimiterHomotopy.NoHomotopy",
        "Modelica.Blocks.Types.LimiterHomotopy.UpperLimit",
        "Modelica.Electrical.Digital.Interfaces.Logic.'0'",
        "Modelica.Electrical.Digital.Interfaces.Logic.'L'",
    ):
        assert f"={value}" in text
    again = ac.load(path)
    assert (again.before.x, again.after.x) == ("'0'", "'L'")
    assert again.amplifier.homotopyType == "UpperLimit"


@pytest.mark.slow
@pytest.mark.parametrize(
    "declared", ["Integer n(start = 3, fixed = true)", "discrete Real n(start = 3)"]
)
def test_a_rate_that_is_a_discrete_variable_gives_the_state(tmp_path: Path, declared: str) -> None:
    (tmp_path / "counted.mo").write_text(
        f"""model Counted {declared}; Real x(start = 0, fixed = true);
        equation when sample(0.5, 0.5) then n = pre(n) + 1; end when; der(x) = n; end Counted;"""
    )
    system = ac.compile(ac.load(tmp_path / "counted.mo"))
    written = ac.export.modelica(system, tmp_path / "written.mo")
    assert "der(x) = n;" in written.read_text()
    again = ac.simulate(ac.compile(ac.load(written)), 2.2)
    assert float(again["x"][-1]) == pytest.approx(0.5 * (3 + 4 + 5 + 6) + 0.2 * 7)


@pytest.mark.slow
def test_signals_of_an_expandable_connector_are_connected_by_their_names(tmp_path: Path) -> None:
    (tmp_path / "bus.mo").write_text(
        """package Buses
          expandable connector Bus end Bus;
          model Send Bus bus; Modelica.Blocks.Sources.Sine o(f = 0.3); equation connect(o.y, bus.sig); end Send;
          model Receive
            Bus bus; Modelica.Blocks.Continuous.FirstOrder f(T = 1, y(start = 0, fixed = true));
          equation
            connect(bus.sig, f.u);
          end Receive;
          model All Send s; Receive r; equation connect(s.bus, r.bus); end All;
        end Buses;"""
    )
    system = ac.compile(ac.load(tmp_path / "bus.mo", "Buses.All"))
    written = ac.export.modelica(system, tmp_path / "written.mo")
    assert "connect(s.bus_sig, r.bus_sig);" in written.read_text()
    again = ac.simulate(ac.compile(ac.load(written)), 2.0)
    assert float(again["r.f.y"][-1]) == pytest.approx(
        float(ac.simulate(system, 2.0)["r.f.y"][-1]), rel=1e-9
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("sizes", "first", "second", "written"),
    [
        ("2", "b[2] = 20; b[1] = 10 + h;", "", ["b = {10 + h, 20};"]),
        (
            "2, 2",
            "b[2,1] = 21; b[1,1] = h; b[1,2] = 12; b[2,2] = 22;",
            "",
            ["b = {{h, 12}, {21, 22}};"],
        ),
        (
            "3",
            "b[3] = 30; b[1] = h;",
            "b[2] = 20 + h;",
            ["b[3] = 30;", "b[1] = h;", "b[2] = 20 + h;"],
        ),
    ],
)
def test_elements_that_a_when_assigns_keep_their_places(
    sizes: str, first: str, second: str, written: list[str], tmp_path: Path
) -> None:
    other = f"when h < 0.5 then {second} end when;" if second else ""
    (tmp_path / "places.mo").write_text(
        f"""model Places Real h(start = 2, fixed = true); discrete Real b[{sizes}](each start = 0);
        equation der(h) = -h; when h < 1 then {first} end when; {other} end Places;"""
    )
    system = ac.compile(ac.load(tmp_path / "places.mo"))
    path = ac.export.modelica(system, tmp_path / "written.mo")
    lines = [line.strip() for line in path.read_text().splitlines()]
    assert set(written) <= set(lines)
    ours, again = (ac.simulate(s, 2.0) for s in (system, ac.compile(ac.load(path))))
    names = [name for name in system.variables if name.startswith("b[")]
    for name in names:
        assert float(again[name][-1]) == pytest.approx(float(ours[name][-1]), rel=1e-6), name
    assert names


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("mass.m", lambda m: m.mass.modify(m=5.0)),
        ("mass.m", lambda m: m.mass.modify(m=2 * m.damper.d)),
        ("mass.s", lambda m: m.mass.modify(s=ac.Start(0.3))),
        ("mass.v", lambda m: m.mass.modify(v=ac.Start(0.0, fixed=False))),
        ("brake", lambda m: setattr(m, "brake", tl.Damper(d=1.0))),
        ("Oscillator", lambda m: m.connect(m.wall.flange, m.mass.flange_b)),
    ],
)
def test_a_model_that_was_changed_after_it_was_compiled_is_refused(
    name: str, change: Callable[[Oscillator], None], tmp_path: Path
) -> None:
    model = Oscillator()
    system = ac.compile(model)
    before = ac.export.modelica(copy.deepcopy(system), tmp_path / "osc.mo").read_text()
    change(model)
    with pytest.raises(ac.ModelError, match=rf"'{name}' was changed after .* compile it again"):
        ac.export.modelica(system, tmp_path / "osc.mo")
    assert (tmp_path / "osc.mo").read_text() == before


class Looked(ac.Component):
    """A table of the library, and a limit that is an option."""

    most = ac.Option(10)

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.clock = blocks.ContinuousClock()
        self.lut = blocks.CombiTable1Ds(table=[[0, 0], [1, 2]])
        self.connect(self.clock.y, self.lut.u)

    def equations(self) -> Iterator[Any]:
        yield ac.Assert(self.lut.y[0] < self.most, "too far")


@pytest.mark.parametrize(
    ("name", "change"),
    [("lut.table", {"lut": {"table": [[0, 0], [1, 3]]}}), ("most", {"most": 2})],
)
def test_so_is_one_whose_table_or_option_was(
    name: str, change: dict[str, Any], tmp_path: Path
) -> None:
    model = Looked()
    system = ac.compile(model)
    ac.export.modelica(copy.deepcopy(system), tmp_path / "looked.mo")
    model.modify(**change)
    with pytest.raises(ac.ModelError, match=f"'{name}' was changed"):
        ac.export.modelica(system, tmp_path / "looked.mo")
