"""Digital signals: gates by IEEE 1164's tables, sources that change at exact times, converters."""

import inspect
import json
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, digital as dg, electrical as el
from acausal.components.digital.logic import LOGIC, signal

VALUES = "UX01ZWLH-"
GATES = (dg.And, dg.Nand, dg.Or, dg.Nor, dg.Xor, dg.Xnor)


def strong(value: str) -> str:
    """What a gate sees of a value."""
    return {"L": "0", "H": "1", "U": "U", "0": "0", "1": "1"}.get(value, "X")


def expected(gate: type, a: str, b: str) -> str:
    """The table of a gate."""
    inverts = {"0": "1", "1": "0"} if gate in (dg.Nand, dg.Nor, dg.Xnor) else {}
    pair = {strong(a), strong(b)}
    decides = {dg.And: "0", dg.Nand: "0", dg.Or: "1", dg.Nor: "1"}.get(gate)
    if decides in pair:
        value = decides
    elif pair & {"U", "X"}:
        value = "U" if "U" in pair else "X"
    elif decides:
        value = pair.pop()
    else:
        value = "0" if len(pair) == 1 else "1"
    return inverts.get(value or "", value or "")


class Gates(ac.Component):
    """Gates of a class, one for every pair of values."""

    def __init__(self, gate: type) -> None:
        super().__init__()
        self.values = [dg.Set(x=value) for value in LOGIC]
        self.gates = [gate() for _ in range(81)]
        for made, pair in zip(self.gates, product(self.values, repeat=2), strict=True):
            for i, value in enumerate(pair):
                self.connect(value.y, made.x[i])


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("gate", GATES)
def test_gates_follow_their_tables(gate: type) -> None:
    end = ac.simulate(ac.compile(Gates(gate)), 1.0, saveat=[1.0])
    pairs = list(product(VALUES, repeat=2))
    outputs = end.to_dict(f"gates[{k + 1}].y" for k in range(len(pairs)))
    found = [VALUES[int(column[0]) - 1] for name, column in outputs.items() if name != "time"]
    assert found == [expected(gate, a, b) for a, b in pairs]


class Inverters(ac.Component):
    """An inverter for every value."""

    def __init__(self) -> None:
        super().__init__()
        self.values = [dg.Set(x=value) for value in LOGIC]
        self.inverse = [dg.Not() for _ in LOGIC]
        for value, made in zip(self.values, self.inverse, strict=True):
            self.connect(value.y, made.x)


@pytest.mark.slow
def test_an_inverter_follows_its_table() -> None:
    end = ac.simulate(ac.compile(Inverters()), 1.0, saveat=[1.0])
    found = [VALUES[int(end[f"inverse[{k + 1}].y"][0]) - 1] for k in range(9)]
    assert found == [{"0": "1", "1": "0"}.get(strong(a), strong(a)) for a in VALUES]


class Latch(ac.Component):
    """Two gates, each at the other's output: they remember which input was active last."""

    def __init__(self, gate: type, active: str, quiet: str) -> None:
        super().__init__()
        pulse = (active, quiet)
        self.set = dg.Table(t=(1, 2, 5, 6), x=pulse * 2, y0=quiet)
        self.reset = dg.Table(t=(3, 4), x=pulse, y0=quiet)
        self.first, self.second = gate(n=2), gate(n=2)
        self.connect(self.set.y, self.first.x[0])
        self.connect(self.reset.y, self.second.x[0])
        self.connect(self.second.y, self.first.x[1])
        self.connect(self.first.y, self.second.x[1])


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize(
    ("gate", "active", "quiet"), [(dg.Nand, "'0'", "'1'"), (dg.Nor, "'1'", "'0'")]
)
def test_gates_in_a_loop_remember(gate: type, active: str, quiet: str) -> None:
    system = ac.compile(Latch(gate, active, quiet))
    found = ac.simulate(system, 7.0, saveat=np.arange(7) + 0.5)
    one, other = signal(quiet), signal(active)
    held = [signal("'U'"), other, other, one, one, other, other]
    assert found["second.y"].tolist() == held
    assert found["first.y"].tolist() == [v if v == 1 else one + other - v for v in held]


class Delays(ac.Component):
    """A signal that rises at 1, falls at 2, is 1 too shortly at 3, and 1, X and 0 from 4, 5 and 6 on; delayed."""

    def __init__(self) -> None:
        super().__init__()
        values = tuple(f"'{v}'" for v in "010101X0")
        self.signal = dg.Table(t=(0, 1, 2, 3, 3.1, 4, 5, 6), x=values)
        self.same = dg.InertialDelay(delayTime=0.25)
        times = {"tLH": 0.2, "tHL": 0.4}
        self.sensitive = dg.InertialDelaySensitive(**times, y0="'0'")
        self.buffer, self.inverter = dg.BufGate(**times), dg.InvGate(**times)
        self.gate, self.one = dg.AndGate(n=2, **times), dg.Set()
        for name in ("same", "sensitive", "buffer", "inverter"):
            self.connect(self.signal.y, getattr(self, name).x)
        self.connect(self.signal.y, self.gate.x[0])
        self.connect(self.one.y, self.gate.x[1])


@pytest.mark.slow
def test_changes_that_do_not_last_are_not_passed_on() -> None:
    changes = {
        "same.y": "U 0, 0 0.25, 1 1.25, 0 2.25, 1 4.25, X 5.25, 0 6.25",
        "sensitive.y": "0 0, 1 1.2, 0 2.4, 1 4.2, X 5.4, 0 6.4",
        "buffer.y": "U 0, 0 0.4, 1 1.2, 0 2.4, 1 4.2, X 5.4, 0 6.4",
        "inverter.y": "U 0, 1 0.2, 0 1.4, 1 2.2, 0 4.4, X 5.2, 1 6.2",
        "gate.y": "U 0, 0 0.4, 1 1.2, 0 2.4, 1 4.2, X 5.4, 0 6.4",
    }
    found = ac.simulate(ac.compile(Delays()), 7.0, saveat=np.arange(0.05, 7, 0.1))
    for name, told in changes.items():
        rows = [pair.split() for pair in told.split(", ")]
        last = np.searchsorted([float(t) for _, t in rows], found.t, side="right") - 1
        assert [VALUES[int(v) - 1] for v in found[name]] == [rows[k][0] for k in last], name


class Strippers(ac.Component):
    """All values through the converters that strip strength off them, and numbers to values."""

    def __init__(self) -> None:
        super().__init__()
        self.values = [dg.Set(x=value) for value in LOGIC]
        for name in ("LogicToX01", "LogicToX01Z", "LogicToUX01"):
            made = getattr(dg, name)(n=9)
            setattr(self, name, made)
            for value, x in zip(self.values, made.x, strict=True):
                self.connect(value.y, x)
        self.real = dg.RealToLogic(upper_limit=2, lower_limit=-1, middle_value="'Z'")
        self.ramp = blocks.Ramp(height=6, duration=6, offset=-3)
        self.connect(self.ramp.y, self.real.x[0])


@pytest.mark.slow
def test_strength_is_stripped_and_numbers_become_values() -> None:
    found = ac.simulate(ac.compile(Strippers()), 6.0, saveat=[1.9, 2.1, 4.9, 5.1])
    tables = {"LogicToX01": "XX01XX01X", "LogicToX01Z": "XX01ZX01X", "LogicToUX01": "UX01XX01X"}
    for name, table in tables.items():
        assert [VALUES[int(found[f"{name}.y[{k}]"][0]) - 1] for k in range(1, 10)] == list(table)
    assert [VALUES[int(v) - 1] for v in found["real.y[1]"]] == list("0ZZ1")


class Sources(ac.Component):
    """All sources, and what converters make of a clock."""

    def __init__(self) -> None:
        super().__init__()
        self.set = dg.Set(x="'H'")
        self.step = dg.Step(stepTime=0.7)
        self.table = dg.Table(t=(0.3, 0.9), x=("'1'", "'L'"), y0="'U'")
        self.pulse = dg.Pulse(
            startTime=0.5, width=20, period=1, pulse="'1'", quiet="'0'", nperiod=1
        )
        self.clock = dg.Clock(startTime=0.5, period=1, width=50)
        self.boolean = dg.LogicToBoolean()
        self.back = dg.BooleanToLogic()
        self.number = dg.LogicToReal(value_1=5)
        self.connect(self.clock.y, self.boolean.x[0])
        self.connect(self.boolean.y[0], self.back.x[0])
        self.connect(self.back.y[0], self.number.x[0])


@pytest.mark.slow
def test_sources_change_at_their_times() -> None:
    ts = np.arange(0.05, 3, 0.1)
    found = ac.simulate(ac.compile(Sources()), (0.0, 3.0), saveat=ts)

    def of(name: str) -> list[str]:
        return [VALUES[int(v) - 1] for v in np.asarray(found[f"{name}.y"])]

    assert set(of("set")) == {"H"}
    assert of("step") == ["0" if t < 0.7 else "1" for t in ts]
    assert of("table") == ["U" if t < 0.3 else "1" if t < 0.9 else "L" for t in ts]
    on = (ts > 0.5) & ((ts - 0.5) % 1 < 0.5)
    assert of("clock") == ["1" if v else "0" for v in on]
    assert np.asarray(found["number.y[1]"]) == pytest.approx(np.where(on, 5, 0))
    assert of("pulse") == ["1" if 0.5 < t < 0.7 else "0" for t in ts]
    assert np.asarray(found["pulse.T0"])[[4, 14, -1]] == pytest.approx([0.5, 0.5, 1.5])
    assert np.asarray(found["pulse.np"])[[4, 14, -1]].tolist() == [0, 1, 2]


class Converters(ac.Component):
    """A sine through four bits and back."""

    def __init__(self) -> None:
        super().__init__()
        self.ground = el.Ground()
        self.source = el.SineVoltage(V=5, f=1, offset=5)
        self.clock = dg.Clock(startTime=0.05, period=0.1)
        self.there = el.AD_Converter(N=4, VRefHigh=10, VRefLow=0, Rin=1e6)
        self.back = el.DA_Converter(N=4, Vref=10)
        self.load = el.Resistor(R=1)
        self.connect(self.source.p, self.there.p)
        self.connect(self.source.n, self.there.n, self.ground.p, self.back.n, self.load.n)
        self.connect(self.back.p, self.load.p)
        self.connect(self.clock.y, self.there.trig)
        self.connect(self.clock.y, self.back.trig)
        for bit, to in zip(self.there.y, self.back.x, strict=True):
            self.connect(bit, to)


@pytest.mark.slow
def test_a_voltage_goes_through_bits_and_back() -> None:
    ts = np.arange(0.1, 1, 0.1)
    found = ac.simulate(ac.compile(Converters()), (0.0, 1.0), saveat=[0.04, *ts])
    code = np.floor((0.5 + 0.5 * np.sin(2 * np.pi * (ts - 0.05))) * 15 + 0.5)
    assert np.asarray(found["load.v"])[1:] == pytest.approx(code * 10 / 15)
    assert float(found["load.v"][0]) == 0
    bits = np.stack([np.asarray(found[f"there.y[{k}]"]) for k in range(1, 5)])
    assert (bits[:, 0] == signal("'X'")).all()
    assert ((bits[:, 1:] == signal("'1'")).T @ [1, 2, 4, 8]).tolist() == code.tolist()
    assert set(np.asarray(found["there.z"])) == {0}


def test_every_class_says_what_it_is() -> None:
    for name in dg.__all__:
        assert inspect.getdoc(getattr(dg, name)), name


def test_an_unknown_value_is_refused() -> None:
    with pytest.raises(ac.DeclarationError, match="not one of"):
        signal("2")
    with pytest.raises(ac.DeclarationError, match="pulse"):
        dg.Pulse(pulse="2")
    assert [signal(v) for v in LOGIC] == [signal(v[1]) for v in LOGIC] == list(range(1, 10))
    assert dg.Pulse(pulse="1").pulse == "'1'"


def test_a_file_names_values_as_modelica_does(tmp_path: Path) -> None:
    logic = "Modelica.Electrical.Digital.Interfaces.Logic"
    document = {
        "model": "Values",
        "components": {
            "set": {
                "class": "Modelica.Electrical.Digital.Sources.Set",
                "with": {"x": f"{logic}.'-'"},
            },
            "table": {
                "class": "Modelica.Electrical.Digital.Sources.Table",
                "with": {"x": f"{{{logic}.'1',{logic}.'0'}}", "t": "{1,2}", "y0": f"{logic}.'U'"},
            },
        },
        "connections": [],
    }
    path = tmp_path / "values.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    for _ in range(2):
        model: Any = ac.load(path)
        assert model.set.x == "'-'"
        assert list(model.table.x) == ["'1'", "'0'"]
        ac.save(model, path)


@pytest.mark.slow
def test_a_chain_of_full_adders_adds(tmp_path: Path) -> None:
    """6 + 3 = 9, and 7 + 1 = 8 half a second later, as a netlist with Modelica's short name of the values."""
    logic = "Modelica.Electrical.Digital"
    bits = {"a": ("011", "111"), "b": ("110", "100")}
    components: dict[str, Any] = {
        "adder": {"class": f"{logic}.Examples.Utilities.Adder", "with": {"n": 3}},
        "carry": {"class": f"{logic}.Sources.Set", "with": {"x": "L.'0'"}},
    }
    connections = [["carry.y", "adder.c_in"]]
    for name, (first, second) in bits.items():
        for i in range(3):
            values = f"{{L.'{first[i]}', L.'{second[i]}'}}"
            components[f"{name}{i}"] = {
                "class": f"{logic}.Sources.Table",
                "with": {"x": values, "t": "{0, 0.5}", "y0": "L.'0'"},
            }
            connections.append([f"{name}{i}.y", f"adder.{name}[{i + 1}]"])
    file = tmp_path / "adder.json"
    file.write_text(json.dumps({"components": components, "connections": connections}), "utf-8")
    found = ac.simulate(ac.compile(ac.load(file)), (0, 1), saveat=[0.4, 0.9])
    names = ["adder.s[1]", "adder.s[2]", "adder.s[3]", "adder.c_out"]
    sums = [[LOGIC[round(float(found[n][k])) - 1][1] for n in names] for k in (0, 1)]
    assert sums == [["1", "0", "0", "1"], ["0", "0", "0", "1"]]
