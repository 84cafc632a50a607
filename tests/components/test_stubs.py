"""What type checkers know of the library is what its classes declare."""

import ast
import json
import subprocess
import sys

import pytest

from tests.support.paths import ROOT
from tests.support.scripts import script

MEND = "run: python docs/make_stubs.py"

USE = """
import acausal as ac
from acausal.components import electrical as el, translational as tl

good = el.Resistor(R=3, useHeatPort=True, v=ac.Start(1.0))
good.R = 5.0
value: float = good.R * good.p.v
vehicle = tl.Vehicle(m=1000.0, mass={"s": ac.Start(1.0, fixed=True)})
vehicle.connect(vehicle.mass.flange_a, vehicle.inertia.flange_b)


class Own(el.OnePort):
    G = ac.Parameter(unit="S")


own = Own(G=3.0)
own.G = ac.Start(1.0, fixed=False)
el.Resistor(bogus=3)
el.utilities.Resistor(bogus=3)
el.Resistor(R="3")
el.Resistor(3)
tl.Vehicle(bogus=3)
tl.Mass(stateSelect="sometimes")
el.Resister(R=3)
"""
FIRST_WRONG = 1 + USE.splitlines().index("el.Resistor(bogus=3)")


SCRIPT = script("docs/make_stubs.py")


@pytest.mark.cases(fast=5, slow=21)
@pytest.mark.parametrize("module", SCRIPT.modules())
def test_the_stub_is_up_to_date(module: str) -> None:
    path = SCRIPT.path_of(module)
    assert path.exists(), MEND
    written, made = path.read_text(encoding="utf-8"), SCRIPT.stub(module)
    same = ast.dump(ast.parse(written)) == ast.dump(ast.parse(made))  # whatever ruff's format
    assert same, MEND


def test_there_is_no_stub_of_what_is_gone() -> None:
    found = {path.resolve() for path in (ROOT / "components").rglob("*.pyi")}
    assert found == {SCRIPT.path_of(module) for module in SCRIPT.modules()}, "remove it"


@pytest.mark.slow
def test_pyright_knows_the_parameters() -> None:
    path = ROOT / "tests" / "components" / "_use_of_stubs.py"
    path.write_text(USE, encoding="utf-8")
    try:
        command = [sys.executable, "-m", "pyright", "--outputjson", str(path)]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    finally:
        path.unlink()
    found = json.loads(done.stdout)["generalDiagnostics"]
    lines = [d["range"]["start"]["line"] + 1 for d in found if d["severity"] == "error"]
    wrong = len(USE.splitlines()) - FIRST_WRONG + 1
    assert lines == list(range(FIRST_WRONG, FIRST_WRONG + wrong)), done.stdout
