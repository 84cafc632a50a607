"""Pages are self-contained, show what they are given and cannot be broken by it."""

import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import pytest
import sympy as sp

import acausal as ac
from acausal.reporting import Page, write_json


def test_a_page_holds_all_it_was_given(tmp_path: Path) -> None:
    page = Page("Title <1>", "lead & more")
    page.section("Section")
    page.text("text with <tags>")
    page.table(["name", "value"], [["a", 1], ["b", 2]], [True, False])
    x, t = sp.symbols("body.s time")
    force = sp.Function("spring.net")(x)
    page.equations(
        [sp.Eq(sp.Derivative(x, t), force / 2, evaluate=False)],
        {"body.s": "z_b", "spring.net": "F"},
    )
    figure, ax = plt.subplots()
    ax.plot([0, 1])
    page.figure(figure, "a picture", tmp_path / "picture.png")
    plt.close(figure)
    page.drawing("<svg></svg>", "a <drawing>")
    text = page.write(tmp_path / "new" / "index.html", "the end").read_text(encoding="utf-8")
    escaped = (
        "Title &lt;1&gt;",
        "lead &amp; more",
        "text with &lt;tags&gt;",
        "<svg></svg><figcaption>a &lt;",
    )
    for piece in (*escaped, 'class="hit"', 'class="miss"', "the end"):
        assert piece in text
    assert "<mi>z</mi>" in text
    assert "<mi>F</mi>" in text
    assert "data:image/png;base64," in text
    assert "http://" not in text.replace("http://www.w3.org", "")
    assert "https://" not in text
    assert (tmp_path / "picture.png").stat().st_size > 1000


def test_figures_are_written_as_json(tmp_path: Path) -> None:
    path = write_json(tmp_path / "out" / "report.json", {"loss": 0.03})
    assert json.loads(path.read_text()) == {"loss": 0.03}


def test_a_page_that_cannot_be_written_is_told_in_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(ac.DataError, match=r"^'.*index\.html' cannot be written: "):
        Page("Title").write(tmp_path / "file" / "index.html")


def test_equations_of_arrays_of_parts_have_short_names(tmp_path: Path) -> None:
    charge, current = sp.symbols("particle.shell[1].Q particle.shell[2].Q")
    page = Page("Cell")
    page.equations([sp.Eq(charge, 2 * current, evaluate=False)])
    text = page.write(tmp_path / "index.html").read_text(encoding="utf-8")
    assert "<msub><mi>Q</mi><mtext>shell 1</mtext></msub>" in text
    assert "particle" not in text
