"""The examples on published measurements: loading, judging, presenting; each on a short record of the same kind."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

import acausal as ac
from examples.measured import judge, load, present
from examples.silverbox import model, study
from tests.support.paths import SHARED

DATA = SHARED / "data"
REAL = pytest.mark.skipif(not DATA.is_dir(), reason="the measured data are not here")


@pytest.fixture(scope="module")
def oscillator() -> tuple[ac.System, ac.Data]:
    """Duffing's oscillator, and what it does where the input is band-limited."""
    system = ac.compile(model.KINDS["white box (Duffing)"].build())
    ts = study.SAMPLE_TIME * np.arange(400)
    force = sum(0.02 * np.sin(2 * np.pi * f * ts + f) for f in (20.0, 63.0, 150.0))
    drive = ac.Signal(ts, force, "band-limited")
    true = ac.simulate(
        system,
        (0.0, ts[-1]),
        dt=study.SAMPLE_TIME,
        inputs={model.INPUT: drive},
        solver=study.SOLVER,
        x0={"mass.s": 0.05, "mass.v": -8.0},
    )
    signals = {model.INPUT: force, model.OUTPUT: np.asarray(true[model.OUTPUT])}
    return system, ac.Data(ts, signals, interpolation={model.INPUT: "band-limited"})


@pytest.mark.slow
def test_a_few_samples_tell_the_initial_state(oscillator: tuple[ac.System, ac.Data]) -> None:
    system, record = oscillator
    found = judge.simulate(system, None, record, model.OUTPUT, known=50, solver=study.SOLVER)
    assert float(found["mass.v"][0]) == pytest.approx(-8.0, rel=1e-4)
    assert judge.rms(found, record, model.OUTPUT, known=50) < 1e-6
    linear = ac.Data(record.time, record.signals)
    off = judge.simulate(system, None, linear, model.OUTPUT, known=50, solver=study.SOLVER)
    assert judge.rms(off, linear, model.OUTPUT, known=50) > 1e-4


def test_means_and_spreads_are_over_seeds() -> None:
    mean, around = judge.spread([{"a": 1.0}, {"a": 3.0}])
    assert (mean["a"], around["a"]) == (2.0, pytest.approx(np.sqrt(2)))
    assert judge.spread([{"a": 1.0}])[1] == {"a": 0.0}


def test_files_are_found_in_the_folder_or_below_it(tmp_path: Path) -> None:
    (tmp_path / "silverbox").mkdir()
    savemat(tmp_path / "silverbox" / "x.mat", {"V1": np.arange(3.0)[None], "Ts": 4.0})
    for folder in (tmp_path, tmp_path / "silverbox"):
        (found,) = load.load(folder, "Silverbox", ["x.mat"])
        assert found["V1"].tolist() == [0, 1, 2]
        assert found["Ts"].tolist() == [4]
    with pytest.raises(ac.DataError, match=r"There is no y\.mat in .*, nor in .*silverbox"):
        load.load(tmp_path, "Silverbox", ["y.mat"])


def test_rows_show_what_is_known(capsys: pytest.CaptureFixture[str]) -> None:
    row = present.Row("ours", {"a": 0.2161, "b": 3.0}, {"a": 0.0123, "b": 0.5})
    assert row.cells({"b": "B", "a": "A", "c": "C"}) == ["ours", "3 ± 0.5", "0.216 ± 0.012", ""]
    present.show("title", {"a": "A"}, [row])
    assert "0.216 ± 0.012" in capsys.readouterr().out


def test_a_command_ends_with_a_line_of_json(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.argv", ["x", "--data", str(tmp_path), "--seeds", "2"])
    present.command("x", "about", lambda folder, seeds, out: {"seeds": seeds, "out": str(out)})
    assert json.loads(capsys.readouterr().out) == {"seeds": 2, "out": str(Path("out") / "x")}
    monkeypatch.setattr("sys.argv", ["x", "--data", str(tmp_path)])
    with pytest.raises(SystemExit, match=r"There is no a\.mat"):
        present.command("x", "", lambda folder, seeds, out: load.load(folder, "X", ["a.mat"])[0])


@pytest.mark.parametrize("kind", model.KINDS.values(), ids=list(model.KINDS))
def test_every_silverbox_has_the_same_states_and_trains_what_it_has(kind: model.Kind) -> None:
    system = ac.compile(kind.build())
    assert system.states == ("mass.s", "mass.v")
    assert set(kind.trained) <= set(system.parameters())


@REAL
@pytest.mark.slow
def test_the_silverbox_is_learned_from_a_tenth_of_its_record(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Learned as far as 30 updates go: to a tenth of the error of a linear model, 7.8 mV."""
    (measured,) = load.load(DATA, "Silverbox", ["SNLS80mV.mat"])
    monkeypatch.setattr(study, "TRAIN", (81_000, 83_000))
    monkeypatch.setattr(study, "VALIDATION", (97_000, 97_500))
    monkeypatch.setattr(study, "TESTS", {"multisine": (105_712, 108_000)})
    (ours,) = study.train(measured, replace(model.KINDS[model.OURS], epochs=30))
    assert ours.errors["multisine"] < 0.9
    assert ours.errors["validation"] < 0.9


@REAL
@pytest.mark.machines
def test_the_silverbox_is_learned() -> None:
    (measured,) = load.load(DATA, "Silverbox", ["SNLS80mV.mat"])
    (white,) = study.train(measured, model.KINDS["white box (Duffing)"])
    (ours,) = study.train(measured, model.KINDS[model.OURS])
    assert white.errors["multisine"] == pytest.approx(0.31, abs=0.01)
    assert ours.errors["multisine"] < 0.25
    assert ours.errors["arrow_no_extrapolation"] < 0.26
    assert ours.errors["arrow_full"] < 0.39


@REAL
@pytest.mark.machines
def test_a_spring_that_promises_a_cube_goes_on_nearly_as_the_true_one() -> None:
    (measured,) = load.load(DATA, "Silverbox", ["SNLS80mV.mat"])
    (learned,) = study.train(measured, model.KINDS["spring: odd, rising, cubic beyond"])
    assert learned.errors["multisine"] < 0.4
    assert learned.errors["arrow_full"] < 0.8
