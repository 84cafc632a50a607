"""The table of coverage of the Modelica Standard Library is up to date."""

import importlib.util
from types import ModuleType

from tests.support.paths import ROOT

SCRIPT = ROOT / "docs" / "make_coverage.py"


def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("make_coverage", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_up_to_date() -> None:
    made = script()
    written = made.PAGE.read_text(encoding="utf-8")
    assert written == made.page(), "run python docs/make_coverage.py"


def test_the_page_tells_the_three_kinds_apart() -> None:
    text = script().page()
    assert "| `Mass` | `translational.Mass` |" in text
    assert "| `Water` | `fluid.Water` |" in text
    assert "| `Sampler` | *discrete* |" in text
