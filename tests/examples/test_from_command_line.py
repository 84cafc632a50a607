"""Every example that takes measured data runs as its command does, page included.

Trainings are as short as they can be: what they reach is tested beside each example. With the marker ``machines`` the
commands run in full.
"""

import importlib
import json
import sys
import warnings
from pathlib import Path
from typing import Any

import pytest

import acausal as ac
from tests.support.paths import SHARED
from tests.support.slow import some_slow

DATA = SHARED / "data"
COMMANDS = {
    "battery_cell": ("leaf_cell", ()),
    "cascaded_tanks": ("cascaded_tanks", ("--seeds", "1")),
    "emps": ("emps", ("--seeds", "1")),
    "silverbox": ("silverbox", ("--seeds", "1")),
}
"""By example, the folder of its data, and what makes the command short."""


def ran(
    name: str, wanted: tuple[str, ...], folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> dict[str, Any]:
    """What a command prints as its last line, once its page is checked."""
    data = DATA / COMMANDS[name][0]
    if not data.is_dir():
        pytest.skip(f"the measured data '{data.name}' are not here")
    argv = [name, "--data", str(data), "--out", str(folder), *wanted]
    monkeypatch.setattr(sys, "argv", argv)
    command = importlib.import_module(f"examples.{name}.__main__")
    if hasattr(command, "main"):
        command.main()
    else:
        study = importlib.import_module(f"examples.{name}.study")
        present = importlib.import_module("examples.measured.present")
        present.command(name, "", study.run)
    page = (folder / "index.html").read_text(encoding="utf-8")
    assert page.count("<table>") >= 1
    assert page.count("data:image/png;base64,") >= 2
    assert "<math" in page
    assert ">nan<" not in page
    return json.loads(capsys.readouterr().out.splitlines()[-1])


@pytest.mark.parametrize(
    "name", some_slow(COMMANDS, ["battery_cell", "silverbox"], ["cascaded_tanks", "emps"])
)
def test_an_example_runs_from_its_data_to_its_page(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    study = importlib.import_module("examples.cascaded_tanks.study")
    monkeypatch.setattr(study, "HELD", study.HELD[:1])  # each part that is held out compiles again
    for train in (ac.fit, ac.ensemble):
        monkeypatch.setattr(
            ac, train.__name__, lambda *a, shortened=train, **k: shortened(*a, **{**k, "epochs": 1})
        )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a training of one update has much to warn of
        said = ran(name, COMMANDS[name][1], tmp_path, monkeypatch, capsys)
    assert said["seconds"] > 0


@pytest.mark.machines
@pytest.mark.filterwarnings(
    "ignore:.*limit of its modifier"
)  # baselines that lack physics reach them
@pytest.mark.parametrize("name", COMMANDS)
def test_an_example_runs_in_full(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ran(name, (), tmp_path, monkeypatch, capsys)["seconds"] > 0
