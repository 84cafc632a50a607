"""The table of coverage of the Modelica Standard Library is up to date."""

from tests.support.scripts import script

SCRIPT = "docs/make_coverage.py"


def test_the_page_is_up_to_date() -> None:
    made = script(SCRIPT)
    written = made.PAGE.read_text(encoding="utf-8")
    assert written == made.page(), "run python docs/make_coverage.py"


def test_the_page_tells_the_three_kinds_apart() -> None:
    text = script(SCRIPT).page()
    assert "| `Mass` | `translational.Mass` |" in text
    assert "| `Water` | `fluid.Water` |" in text
    assert "| `FixedDelay` | *refused* |" in text
    assert "| `Sampler` | `blocks.discrete.Sampler` |" in text
