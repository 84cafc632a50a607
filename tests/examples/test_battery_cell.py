"""The example on a battery cell: its records, that it starts from a voltage, learns, and keeps its promises."""

import sys

import jax
import numpy as np
import pytest

import acausal as ac
from examples.battery_cell import __main__ as command, charge, engineer, figures, study
from examples.battery_cell.laws import RisingSteps
from examples.battery_cell.model import NETS, build
from examples.battery_cell.predict import first_charge, predict, write
from examples.battery_cell.records import AFTER, CURRENT, KELVIN, Table, campaign, read
from tests.support.paths import SHARED

DATA = SHARED / "data"
ROWS = ("time", "current", "voltage", "ambient")
REAL = pytest.mark.skipif(not (DATA / "leaf_cell").is_dir(), reason="the measured data are absent")


@pytest.fixture(scope="module")
def system():
    return build()


@pytest.fixture(scope="module")
def params(system):
    return system.parameters(0)


def table(volts=np.nan, ambient=25.0):
    """A rest, a discharge, and a rest, in rows of unequal length."""
    time = np.array([1.0, 30.0, 60.0, 61.0, 65.0, 120.0, 180.0, 240.0, 300.0, 301.0, 360.0])
    current = np.array([0.0, 0.0, 0.0, -30.0, -30.0, -30.0, -30.0, -30.0, -30.0, 0.0, 0.0])
    voltage = np.full(len(time), volts)
    chamber = np.full(len(time), ambient + KELVIN)
    return Table(time, current, voltage, chamber, time[:2], chamber[:2])


@pytest.fixture(scope="module")
def made(system, params):
    """A record that the model itself has made."""
    plain = table(3.9)
    volts = predict(system, params, plain).voltage
    return Table(plain.time, plain.current, volts, plain.ambient, plain.case_time, plain.case)


@pytest.mark.slow
def test_a_jump_follows_the_row_before(made):
    data = made.data()
    jump = np.searchsorted(data.time, 60.0 + AFTER)
    assert data.time[jump] == pytest.approx(60.0 + AFTER)
    assert data[CURRENT][[jump - 1, jump]].tolist() == [0.0, -30.0]
    assert made.first_rest == 2


def test_a_charge_that_ends_at_constant_voltage_tapers_and_does_not_jump():
    plain = table(4.2)
    taper = Table(plain.time[:4], np.array([15.0, 11.0, 8.0, 0.0]), *([plain.ambient[:4]] * 4))
    assert taper.jumps.tolist() == [False, False, False, True]


def test_fewer_rows_keep_ends_and_jumps(made):
    few = made.few()
    assert {1.0, 60.0, 61.0, 300.0, 301.0, 360.0} <= set(few.time)


@pytest.mark.slow
def test_the_first_voltage_tells_the_charge(system, params, made):
    found = predict(system, params, made)
    assert found.rms < 1e-6
    assert first_charge(system, params, made, row=2) == pytest.approx(found.start, abs=1e-3)
    at_once = Table(*(getattr(made, n)[4:] for n in ROWS), made.case_time + 90, made.case)
    started = predict(system, params, at_once)
    assert abs(started.voltage[0] - made.voltage[4]) < 1e-6


def test_a_prediction_needs_one_voltage_only(system, params, made, tmp_path):
    lines = ["time [s],current [A],voltage [V],temperature [degC]"]
    for k, (t, i) in enumerate(zip(made.time, made.current, strict=True)):
        lines.append(f"{t},{i},{made.voltage[0] if k == 0 else ''},25")
    path = tmp_path / "record.csv"
    path.write_text("\n".join(lines))
    blind = read(path)
    found = predict(system, params, blind)
    assert np.isnan(found.rms)
    assert found.voltage == pytest.approx(made.voltage, abs=1e-5)
    write(tmp_path / "out.csv", blind, found)
    assert "predicted voltage [V]" in (tmp_path / "out.csv").read_text().splitlines()[0]


def test_what_a_record_lacks_is_named(tmp_path):
    path = tmp_path / "record.csv"
    path.write_text("time [s],current [A]\n1,0\n2,0\n")
    with pytest.raises(ac.DataError, match="no column 'voltage"):
        read(path, 25.0)
    path.write_text("time [s],current [A],voltage [V]\n1,0,\n2,0,3.9\n")
    with pytest.raises(ac.DataError, match="first row has no voltage"):
        read(path, 25.0)
    path.write_text("time [s],current [A],voltage [V]\n1,0,3.9\n2,0,3.9\n")
    with pytest.raises(ac.DataError, match="--ambient"):
        read(path)
    with pytest.raises(ac.DataError, match="cannot be read"):
        read(tmp_path / "none.csv")


@pytest.mark.parametrize("seed", range(3))
def test_the_curve_rises_whatever_its_weights(seed):
    net = RisingSteps(key=jax.random.key(seed))
    wild = jax.tree.map(lambda w: w + 2 * jax.random.normal(jax.random.key(7), w.shape), net)
    assert np.all(np.diff(jax.vmap(wild)(np.linspace(-0.1, 1.1, 121))) > 0)


def test_laws_are_positive_and_written(params, tmp_path):
    columns = engineer.laws(params)
    assert all(np.all(v > 0) for n, v in columns.items() if n.startswith(("R", "tau")))
    assert any(line.startswith("U(soc)") for line in engineer.formula(params))
    engineer.write(params, tmp_path / "laws.csv")
    assert len((tmp_path / "laws.csv").read_text().splitlines()) == 1 + len(engineer.CHARGES)


def test_pictures_show_records_and_laws(system, params, made):
    figure = figures.record(made, predict(system, params, made))
    assert [ax.get_ylabel() for ax in figure.axes] == ["voltage [V]", "error [mV]"]
    drawn = [len(ax.lines) for ax in figures.laws(params).axes]
    assert drawn == [1, 1, len(engineer.DEGREES), len(engineer.DEGREES)]


@pytest.mark.slow
def test_training_lowers_the_errors_and_parameters_come_back(made, params, system, tmp_path):
    columns = (getattr(made, name) for name in ROWS)
    warmer = Table(*columns, made.case_time, made.case + np.array([0.0, 0.2]))
    fit = study.train({"one": made, "two": warmer}, epochs=2)
    assert set(fit.records) == {"one", "two"}
    assert fit.history.full_loss[-1, 1] < fit.history.full_loss[0, 1]
    study.save(fit, tmp_path / "cell.safetensors")
    loaded = ac.load_params(tmp_path / "cell.safetensors", system)
    kept = predict(system, loaded, made)
    known = predict(fit.system, fit.params, made)
    assert kept.voltage == pytest.approx(known.voltage, abs=1e-9)
    errors = study.judge(fit, {"one": made})["one"]
    assert errors.keys() == {"first", "rest", "trained"}


@pytest.mark.slow
def test_a_table_that_was_interrupted_goes_on(made, monkeypatch, tmp_path):
    tables, path = {"one": made, "two": made}, tmp_path / "out" / "lines.jsonl"
    calls: list[tuple[str, ...]] = []

    def train(kept, seed, epochs):
        if len(calls) == 2:
            raise KeyboardInterrupt
        calls.append(tuple(kept))
        return seed

    def judge(fit, tables):
        known = {"first": 1.0 + fit, "rest": 2.0, "case": 0.1, "trained": 0.5}
        return dict.fromkeys(tables, known)

    monkeypatch.setattr(study, "train", train)
    monkeypatch.setattr(study, "judge", judge)
    with pytest.raises(KeyboardInterrupt):
        study.leave_one_out(tables, range(1), path)
    assert study.summary(study.lines_of(path))["two"].keys() == {
        *("trained", "first", "rest", "case")
    }
    calls.clear()
    lines = study.leave_one_out(tables, range(1), path)
    assert calls == [("one",)]
    assert [line["out"] for line in lines] == [None, "one", "two"]
    path.write_text("[1]")
    with pytest.raises(ac.DataError, match="no results of --leave-one-out"):
        study.leave_one_out(tables, range(1), path)


def test_a_table_has_means_and_spreads_over_seeds():
    errors = {"trained": 2.0, "first": 3.0, "rest": 4.0, "case": 0.1}
    lines = [
        {"out": out, "errors": {"one": {n: e + seed for n, e in errors.items()}}}
        for seed in (0, 2)
        for out in (None, "one")
    ]
    row = study.summary(lines)["one"]
    assert row["trained"] == (3.0, pytest.approx(np.sqrt(2)), 2)
    assert row["left out, first"] == (4.0, pytest.approx(np.sqrt(2)), 2)


def test_the_command_says_what_is_missing(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(sys, "argv", ["battery_cell"])
    with pytest.raises(SystemExit):
        command.main()
    assert "--data FOLDER" in capsys.readouterr().err
    record = str(tmp_path / "record.csv")
    monkeypatch.setattr(sys, "argv", ["b", "--predict", record, "--out", str(tmp_path)])
    with pytest.raises(SystemExit, match="train first"):
        command.main()


@REAL
def test_the_campaign_is_read_as_it_is():
    tables = campaign(DATA)
    assert len(tables["hppc_10c"].time) == 13360
    assert tables["hppc_40c"].ambient[0] == pytest.approx(40 + KELVIN)
    assert tables["discharge_3c"].case.max() == pytest.approx(41.7 + KELVIN, abs=0.3)
    assert all(len(t.few().time) < 3000 for t in tables.values())
    assert set(NETS) <= set(build().parameters(0))


@pytest.mark.slow
@REAL
def test_the_cell_nears_two_records_in_a_few_updates():
    tables = {n: t for n, t in campaign(DATA).items() if n in ("discharge_1c", "discharge_3c")}
    fit = study.train(tables, epochs=4)
    errors = study.judge(fit, tables)
    assert fit.loss < 0.5 * fit.loss_before
    assert max(e["trained"] for e in errors.values()) < 33.0
    assert errors["discharge_1c"]["case"] < 0.5


@pytest.mark.machines
@REAL
def test_the_cell_follows_what_it_was_trained_on():
    tables = campaign(DATA)
    errors = study.judge(study.train(tables), tables)
    assert max(e["trained"] for e in errors.values()) < 15.0
    assert errors["discharge_1c"]["case"] < 0.5
    assert errors["discharge_3c"]["case"] < 0.5


@pytest.mark.slow
@REAL
def test_a_held_back_discharge_tells_its_charge_from_a_wrong_start():
    tables = campaign(DATA)
    fit = study.train({n: tables[n] for n in ("hppc_25c", "hppc_40c")}, epochs=8)
    held = charge.part(
        tables["discharge_1c"], 10025.0, 13655.0
    )  # a minute of rest, then until empty
    time, counted = held.data(0.0).time, charge.counted(fit.system, fit.params, held)
    late = time > held.time[0] + 660.0
    for soc in (0.6, 0.2):
        found = charge.estimate(fit.system, fit.params, held, soc)
        off = np.asarray(found["particle.soc"])[np.searchsorted(found.t, time)] - counted
        assert np.abs(off[late]).max() < 0.05
        assert found.deviation("particle.soc")[-1] < 0.01
