"""The notebooks of the pages are valid and run; a figure is shown once."""

import base64
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from tests.support.paths import ROOT
from tests.support.scripts import script
from tests.test_docs import blocks

nbformat = pytest.importorskip("nbformat")

PICTURES = {"image/png", "image/svg+xml"}


@pytest.fixture(scope="module")
def hook() -> ModuleType:
    return script("docs/notebooks.py")


def pages() -> list[str]:
    docs = ROOT / "docs"
    return [p.relative_to(docs).as_posix() for p in sorted(docs.rglob("*.md")) if any(blocks(p))]


def read(hook: ModuleType, page: str) -> Any:
    return nbformat.reads(hook.text_of(page), as_version=4)


@pytest.mark.parametrize("page", pages())
def test_every_page_is_a_valid_notebook_with_all_of_its_code(hook: ModuleType, page: str) -> None:
    found = read(hook, page)
    nbformat.validate(found)
    code = [cell.source for cell in found.cells if cell.cell_type == "code"]
    assert code == [block.strip("\n") for block in blocks(ROOT / "docs" / page)]
    text = "\n".join(cell.source for cell in found.cells if cell.cell_type == "markdown")
    assert "<!--" not in text
    assert "](images/" not in text


def test_a_page_becomes_cells(hook: ModuleType) -> None:
    text = (
        "<!-- slow -->\n# Title\n\n![a picture](images/step.png)\n\n```python\nprint(1)\n```\n\n"
        "```output\n1\n```\n\nSee [events](events.md#x), [the list](modelica-coverage.md).\n\n"
        '!!! note "Mind"\n    one\n\n    two\n\n```py\nwrong(\n```\n'
    )
    title, code, end = hook.notebook("page.md", text)["cells"]
    (picture,) = title["attachments"].values()
    assert base64.b64decode(picture["image/png"])[1:4] == b"PNG"
    assert "](attachment:step.png)" in title["source"]
    assert code["source"] == "print(1)"
    assert code["outputs"][0]["text"] == "1\n"
    assert "See [events](events.ipynb), the list." in end["source"]
    assert "> **Mind**\n>\n> one\n>\n> two" in end["source"]
    assert "```py\nwrong(" in end["source"]


def test_pages_link_to_their_notebooks(hook: ModuleType) -> None:
    class Page:
        class file:  # noqa: N801 (as mkdocs calls it)
            src_uri = "gallery/motor.md"

    text = "<!-- slow -->\n# Title\n\ntext\n\n```python\nprint(1)\n```\n"
    linked = hook.on_page_markdown(text, page=Page, config=None, files=None)
    assert "# Title\n\n[Download as a notebook](../notebooks/gallery-motor.ipynb)" in linked
    assert hook.on_page_markdown("# No code\n", page=Page, config=None, files=None) == "# No code\n"


def executed(found: Any, folder: Path) -> Any:
    """The notebook after a run in a kernel of its own, in that folder."""
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    resources = {"metadata": {"path": str(folder)}}
    nbclient.NotebookClient(
        found, timeout=300, kernel_name="python3", resources=resources
    ).execute()
    return found


@pytest.fixture
def kernel(monkeypatch: pytest.MonkeyPatch) -> None:
    """Kernels draw as a notebook does, and import the checkout."""
    monkeypatch.delenv("MPLBACKEND", raising=False)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")


def pictures(cell: Any) -> int:
    return sum(
        bool(PICTURES & set(output.get("data", {})))
        for output in cell.outputs
        if output.output_type in ("display_data", "execute_result")
    )


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_a_notebook_runs(hook: ModuleType, kernel: None, tmp_path: Path) -> None:
    """One page; the code of all runs in `tests.test_docs`."""
    found = executed(read(hook, "netlist.md"), tmp_path)
    errors = [o for c in found.cells for o in c.get("outputs", []) if o.output_type == "error"]
    assert not errors


MODEL = """
import acausal as ac

class Decay(ac.Component):
    x = ac.Variable(start=1.0, fixed=True)
    k = ac.Parameter(1.0)

    def equations(self):
        yield ac.Eq(ac.der(self.x), -self.k * self.x)

class Two(ac.Component):
    def __init__(self):
        super().__init__()
        self.a, self.b = Decay(k=1.0), Decay(k=2.0)

system = ac.compile(Two())
run = ac.simulate(system, (0, 1), dt=0.1)
"""


FIT = """
data = ac.Data(run.t, {n: run[n] for n in ("a.x", "b.x")})
fit = ac.fit(system, data, ["a.x"], modifiers=["a.k"], epochs=3)
"""


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_every_figure_is_shown_once_and_results_show_html(kernel: None, tmp_path: Path) -> None:
    cells = [
        MODEL,
        "run.plot('a.x')",
        "figure = run.plot('a.x')\nprint('drawn')",
        "figure",
        "ac.diagram(Two())",
        "system",
        "run",
        "ac.sliders(system, (0, 1), {'a.k': (0.1, 10.0)}, dt=0.1)",
        FIT,
    ]
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(c) for c in cells])
    found = executed(book, tmp_path)
    assert [pictures(cell) for cell in found.cells[:5]] == [0, 1, 1, 1, 1]
    for cell in found.cells[5:7]:
        (output,) = cell.outputs
        assert "<svg" in output.data["text/html"] or "<math" in output.data["text/html"]
    assert "application/vnd.jupyter.widget-view+json" in found.cells[7].outputs[0].data
    (bar,) = found.cells[8].outputs  # one output, written anew
    assert "epoch 3/3" in bar.data["text/html"]
    assert "<progress" in bar.data["text/html"]
