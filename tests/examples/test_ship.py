"""The quarter vehicle, shipped: each form in another tool, and the whole command with a tiny training."""

import json
from dataclasses import replace

import pytest
from rich.console import Console

from examples.qvm import elsewhere, experiments, record, ship
from examples.qvm.elsewhere import TOOLS, MissingError, Vehicle
from tests.support.exported_c import need_compiler

BARS = {
    "C: derivatives": 1e-12,
    "C: step of rk4": 1e-9,
    "co-simulation": 1e-9,
    "CVode": 1e-5,
    "CasADi": 1e-10,
    "ONNX": 1e-12,
    "StableHLO": 1e-12,
    "Modelica": 1e-6,
}


@pytest.fixture(scope="module")
def shipped(tmp_path_factory):
    """The exports of a vehicle that was trained for a moment, and sentences on what is missing."""
    need_compiler()
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(record, "DURATION", 1.0)
        data = record.ride(0.02)
    trained = experiments.fit(
        experiments.DEMO, data, epochs=2, sequence_length=0.25, batch_size=2, progress=False
    )
    folder = tmp_path_factory.mktemp("ship")
    missing = ship.export_all(Console(quiet=True), trained, folder, notes={"a note": 1.5})
    return Vehicle(trained.system, trained.params, folder), missing


@pytest.mark.slow
@pytest.mark.parametrize("doing", TOOLS)
def test_each_tool_agrees_with_acausal(shipped, doing, monkeypatch):
    monkeypatch.setattr(elsewhere, "ROUNDS", 1)
    monkeypatch.setattr(elsewhere, "TURN", 1e-4)
    vehicle, missing = shipped
    if missing:
        pytest.skip(missing[0])
    try:
        rows = TOOLS[doing](vehicle)
    except MissingError as error:
        pytest.skip(str(error))
    for row in rows:
        bar = next((bar for name, bar in BARS.items() if name in row.form), 0.0)
        assert row.difference <= bar, row
        assert row.seconds is None or row.seconds > 0


@pytest.mark.slow
def test_differences_are_told(shipped, monkeypatch):
    """Other parameters in acausal than in the files."""
    monkeypatch.setattr(elsewhere, "ROUNDS", 1)
    vehicle, _ = shipped
    other = Vehicle(vehicle.system, {**vehicle.params, "body.m": 351.0}, vehicle.folder)
    rates, simulation = elsewhere.compiled_c(other)
    assert 1e-4 < rates.difference < 1e-1
    assert 1e-6 < simulation.difference < 1e-1


def test_every_file_has_its_card(shipped):
    vehicle, missing = shipped
    if missing:
        pytest.skip(missing[0])
    for ending in ship.FORMS:
        path = vehicle.path(ending)
        card = json.loads((path.parent / f"{path.name}.json").read_text())
        assert card["files"][0]["name"] == path.name
        assert "| a note | 1.5 |" in (path.parent / f"{path.name}.md").read_text()


def test_the_flag_is_told(shipped):
    pytest.importorskip("fmpy", reason="fmpy is not installed")
    first, second = ship.flag(shipped[0])
    assert "stays off" in first or "is on" in first
    assert "rises at 2 m/s, outside_training_range is on for" in second


def test_missing_tools_are_sentences(shipped, monkeypatch):
    def absent(name):
        raise MissingError(f"{name} is not installed (pip install 'acausal[export,export-proof]').")

    monkeypatch.setattr(elsewhere, "need", absent)
    monkeypatch.setattr(elsewhere.shutil, "which", lambda name: None)
    monkeypatch.setattr(elsewhere, "ROUNDS", 1)
    rows, missing = ship.run_all(Console(quiet=True), shipped[0])
    assert [row.form for row in rows] == ["acausal, jax.jit"]
    assert "Left out, compiling the C: There is no C compiler." in missing
    assert len(missing) == len(TOOLS) - 1
    assert ship.table(rows).row_count == 1


@pytest.mark.slow
def test_the_whole_command(tmp_path, monkeypatch):
    settings = {**experiments.DEMO.settings, "sequence_length": 0.25, "batch_size": 8}
    monkeypatch.setattr(ship, "DEMO", replace(experiments.DEMO, epochs=20, settings=settings))
    report = ship.run(out=tmp_path)
    assert report["loss"] < report["loss of the linear model"]
    written = json.loads((tmp_path / "report.json").read_text())
    assert written["rows"][0]["form"] == "acausal, jax.jit"
    assert len(written["rows"]) > 1
    assert (tmp_path / "vehicle.c.md").stat().st_size > 1000
