"""What the logger ``acausal`` is told, and that it is quiet unless somebody listens."""

import json
import logging
import subprocess
import sys

import pytest

import acausal as ac
from tests.support.oscillator import Oscillator, plain, record
from tests.support.paths import ROOT


@pytest.mark.slow
def test_it_is_quiet_by_default() -> None:
    code = (
        "import logging, acausal as ac\nfrom tests.support.oscillator import Oscillator\n"
        "system = ac.compile(Oscillator())\nlogging.getLogger('acausal.system').warning('x')"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout + done.stderr == ""


def test_compiling_and_simulating(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.INFO, "acausal"):
        system = ac.compile(Oscillator())
        ac.simulate(system, (0.0, 1.0), dt=0.1, inputs={"push.f": 0.0})
    compiled, simulating = (r for r in caplog.records if r.name.startswith("acausal"))
    assert compiled.name == "acausal.system"
    assert compiled.getMessage().startswith("compiled Oscillator in ")
    assert simulating.getMessage() == "simulating Oscillator from 0 to 1 s in 10 steps"


@pytest.mark.slow
def test_training(caplog: pytest.LogCaptureFixture, tmp_path) -> None:
    options = {"modifiers": {"spring.c": ac.Shift(10.0)}, "strategy": "gauss_newton", "epochs": 2}
    with caplog.at_level(logging.DEBUG, "acausal"):
        ac.fit(plain(), record().between(0, 2), ["mass.s"], checkpoint=tmp_path, **options)
    told = [r.getMessage() for r in caplog.records if r.name.startswith("acausal.training")]
    assert told[0] == "training spring.c of Oscillator by gauss_newton"
    assert any(line.startswith("wrote checkpoint ") for line in told)
    assert any(line.startswith("epoch 2 of 2: loss ") for line in told)
    assert told[-1].startswith("trained in ")


def test_verbose_commands(capsys: pytest.CaptureFixture[str], tmp_path) -> None:
    from acausal.command import main

    ac.save(ac.load(_file(tmp_path)), tmp_path / "again.json")
    assert main(["check", str(tmp_path / "again.json"), "-v"]) == 0
    assert "acausal.system: compiled Still in " in capsys.readouterr().err
    assert main(["check", str(tmp_path / "again.json")]) == 0
    assert capsys.readouterr().err == ""


def _file(folder):
    path = folder / "still.json"
    mass = {"class": "Modelica.Mechanics.Translational.Components.Mass", "with": {"m": 1.0}}
    path.write_text(json.dumps({"model": "Still", "components": {"mass": mass}}))
    return path
