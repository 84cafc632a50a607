"""Every ```python block of README.md and docs/ runs, page by page and in order.

The blocks of a page share one namespace and an empty working directory. A block that cannot run is
fenced as ```py. A page with the comment ``<!-- slow -->`` runs with the slow tests.
"""

import re
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import matplotlib.pyplot as plt
import pytest

ROOT = Path(__file__).resolve().parent.parent
PAGES = [*ROOT.glob("README.md"), *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"^([ \t]*)```python[ \t]*\n(.*?)^\1```[ \t]*$", re.MULTILINE | re.DOTALL)


def blocks(page: Path) -> Iterator[str]:
    """Yield the code of each block, after empty lines that make its line numbers the page's."""
    text = page.read_text(encoding="utf-8")
    for match in BLOCK.finditer(text):
        yield "\n" * text.count("\n", 0, match.start(2)) + textwrap.dedent(match[2])


def pages() -> list[Any]:
    """Return a parameter for each page that has a block."""
    parameters: list[Any] = []
    for page in PAGES:
        if any(blocks(page)):
            slow = "<!-- slow -->" in page.read_text(encoding="utf-8")
            name = page.relative_to(ROOT).as_posix()
            parameters.append(pytest.param(page, id=name, marks=[pytest.mark.slow] if slow else []))
    return parameters


@pytest.mark.parametrize("page", pages())
def test_blocks_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # A registered module, as dataclasses look up the module of the class they are applied to.
    module = ModuleType("page_" + re.sub(r"\W", "_", page.stem))
    monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.chdir(tmp_path)
    try:
        for block in blocks(page):
            exec(compile(block, str(page), "exec"), vars(module))
    finally:
        plt.close("all")


def test_fences_name_a_language_and_nothing_else() -> None:
    """The documentation renders a fence such as ```python notest as running text."""
    fence = re.compile(r"^[ \t]*```[ \t]*\w+[ \t]+\S.*$", re.MULTILINE)
    found = {page.name: fence.findall(page.read_text(encoding="utf-8")) for page in PAGES}
    assert not {name: lines for name, lines in found.items() if lines}, "fence it as ```py"


def test_blocks_are_found_and_numbered(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "# Page\n```python\na = 1\n```\n```py\nwrong(\n```\n```text\nno\n```\n"
        "!!! note\n    ```python\n    b = 2\n    if b:\n        c = 3\n    ```\n",
        encoding="utf-8",
    )
    assert [block.strip() for block in blocks(page)] == ["a = 1", "b = 2\nif b:\n    c = 3"]
    assert [len(block) - len(block.lstrip("\n")) for block in blocks(page)] == [2, 12]
