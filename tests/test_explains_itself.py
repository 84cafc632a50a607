"""What a compiled model and a solution say of themselves: tables, units, and the completion of names."""

import copy
import sys

import pytest

import acausal as ac
from acausal.components import electrical as el, neural, translational as tl
from acausal.reporting import PlainTable


class RC(ac.Component):
    """A resistor charges a capacitor."""

    tau = ac.Parameter(0.1, unit="s", doc="time constant")
    y = ac.Output(unit="V", doc="voltage")

    def __init__(self) -> None:
        super().__init__()
        self.source = el.SignalVoltage()
        self.r = el.Resistor(R=100.0)
        self.c = el.Capacitor(C=self.tau / self.r.R, v=ac.Start(1.0, fixed=True))
        self.leak = neural.Resistance(el.Pin)
        self.ground = el.Ground()
        self.sensor = el.VoltageSensor()
        self.connect(self.source.p, self.r.p)
        self.connect(self.r.n, self.c.p, self.sensor.p, self.leak.p)
        self.connect(self.c.n, self.source.n, self.ground.p, self.sensor.n, self.leak.n)

    def equations(self):
        yield ac.Eq(self.y, self.c.v)


class Row(ac.Component):
    """Masses that nothing holds."""

    def __init__(self) -> None:
        super().__init__()
        self.body = [tl.Mass(m=1.0 + i) for i in range(11)]


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(RC())


def test_outputs_are_signals_that_nothing_takes(system: ac.System) -> None:
    assert system.outputs == ("y", "sensor.v")


def test_the_table_has_values_units_starts_and_origins(system: ac.System) -> None:
    pytest.importorskip("pandas")
    table = system.table()
    assert list(table.columns) == ["kind", "value", "unit", "doc", "start", "origin"]
    assert list(table.loc["r.R"])[:4] == ["parameter", 100.0, "Ohm", "resistance at T_ref"]
    assert table.loc["r.R", "origin"] == "given"
    assert table.loc["tau", "origin"] == "default"
    assert table.loc["r.alpha", "origin"] == "default, folded"
    assert tuple(table.loc["c.C", ["value", "origin"]]) == (pytest.approx(1e-3), "= tau/r.R")
    assert tuple(table.loc["c.v", ["kind", "start", "origin"]]) == ("state", 1.0, "fixed")
    assert table.loc["leak.net", "kind"] == "network"
    kinds = {kind: list(rows.index) for kind, rows in table.groupby("kind")}
    assert kinds["input"] == ["source.v"]
    assert kinds["output"] == ["y", "sensor.v"]
    assert "r.R" in table._repr_html_()


def test_the_table_shows_trained_parameters(system: ac.System) -> None:
    pytest.importorskip("pandas")
    params = {**system.parameters(0), "tau": 0.3}
    assert system.table(params).loc["c.C", "value"] == pytest.approx(3e-3)


def test_without_pandas_the_table_is_our_own(
    system: ac.System, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    table = system.table()
    assert isinstance(table, PlainTable)
    assert table["r.R"]["unit"] == "Ohm"
    first, *rows = repr(table).splitlines()
    assert first.split() == ["kind", "value", "unit", "doc", "start", "origin"]
    assert len(rows) == len(table)
    assert "<th>r.R</th><td>parameter</td><td>100</td><td>Ohm</td>" in table._repr_html_()
    with pytest.raises(ac.DataError, match=r"no row 'r\.r': did you mean"):
        _ = table["r.r"]


def test_names_are_completed_after_a_dot(system: ac.System) -> None:
    assert {"r", "c", "y", "tau", "states"} <= set(dir(system))
    assert {"v", "i", "R", "p"} <= set(dir(system.r))
    assert dir(system.r.p) == ["i", "v"]
    assert system.r.p.v == "r.p.v"
    assert type(copy.copy(system.r.p.v)) is str
    assert {system.r.p.v: 1.0} == {"r.p.v": 1.0}
    assert system.unit(system.r.R) == "Ohm"
    assert system.leak.net in system.layout.module_names


def test_elements_are_reached_by_their_number() -> None:
    row = ac.compile(Row())
    assert row.body[11].v == "body[11].v"
    assert dir(row.body[1]) == ["a", "flange_a", "flange_b", "m", "s", "v"]
    assert row.body[1]["v"] == "body[1].v"
    assert row.body[:1] == "b"


def test_a_wrong_name_is_an_attribute_error_that_helps(system: ac.System) -> None:
    with pytest.raises(AttributeError, match="did you mean 'states'"):
        _ = system.sates
    with pytest.raises(AttributeError, match=r"no 'simulate'; call ac\.simulate\(system, \.\.\.\)"):
        _ = system.simulate
    with pytest.raises(AttributeError, match=r"'r\.p' has no 'w'; known are 'v', 'i'"):
        _ = system.r.p.w
    assert not hasattr(system, "_repr_markdown_")
    assert copy.deepcopy(system).c.v == "c.v"


def test_a_solution_knows_units_and_completes_names() -> None:
    class Discharge(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.r, self.c = el.Resistor(R=1.0), el.Capacitor(C=1.0, v=ac.Start(1.0, fixed=True))
            self.ground = el.Ground()
            self.connect(self.r.p, self.c.p)
            self.connect(self.r.n, self.c.n, self.ground.p)

    system = ac.compile(Discharge())
    run = ac.simulate(system, (0, 1), dt=0.1)
    assert run.unit("c.v") == "V"
    assert run.unit("time") == "s"
    assert set(run._ipython_key_completions_()) == set(run.names)
    assert run[system.c.v].shape == (11,)
    assert run[[system.c.v, system.r.i]].shape == (11, 2)
