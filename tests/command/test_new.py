"""A new library of components."""

import subprocess
import sys
from pathlib import Path

import pytest

from acausal.command import main
from tests.support.paths import ROOT


@pytest.mark.slow
def test_its_tests_pass(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "my_springs", "--into", str(tmp_path)]) == 0
    assert "src/my_springs/springs.py" in capsys.readouterr().out
    library = tmp_path / "my_springs"
    command = [sys.executable, "-m", "pytest", "-q", "-W", "error"]
    env = {"PATH": "/usr/bin:/bin", "PYTHONPATH": str(ROOT), "JAX_PLATFORMS": "cpu"}
    done = subprocess.run(
        command, cwd=library, env=env, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "4 passed" in done.stdout


@pytest.mark.parametrize("words", [("check", "--select", "E,F,W,B,D1,UP"), ("format", "--check")])
def test_it_is_clean(tmp_path: Path, words: tuple[str, ...]) -> None:
    main(["new", "my_springs", "--into", str(tmp_path)])
    for file in (tmp_path / "my_springs" / "src").rglob("*.py"):
        command = [sys.executable, "-m", "ruff", *words, "--isolated", "--line-length", "120"]
        done = subprocess.run([*command, file], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("name", ["2fast", "my-springs", "class", "json", "acausal", "ümlaut"])
def test_names_that_cannot_be(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", name, "--into", str(tmp_path)]) == 2
    assert f"'{name}' is " in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_nothing_is_replaced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "springs").mkdir()
    assert main(["new", "springs", "--into", str(tmp_path)]) == 4
    assert "exists; choose another name" in capsys.readouterr().err
