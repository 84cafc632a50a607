"""Every ```console block of the pages runs, page by page and in order, and prints what the page shows.

What is printed is compared as for ```output blocks, see test_docs.py; commands run in an empty folder.
"""

import re
import sys
import textwrap
from pathlib import Path

import pytest

from tests.support.console import Console, typed
from tests.support.paths import ROOT
from tests.test_docs import PAGES, agree

BLOCK = re.compile(r"^([ \t]*)```console[ \t]*\n(.*?)^\1```[ \t]*$", re.MULTILINE | re.DOTALL)


def blocks(page: Path) -> list[str]:
    """The sessions of a page."""
    text = page.read_text(encoding="utf-8")
    return [textwrap.dedent(found[2]) for found in BLOCK.finditer(text)]


@pytest.mark.slow
@pytest.mark.parametrize(
    "page", [p for p in PAGES if blocks(p)], ids=lambda p: p.relative_to(ROOT).as_posix()
)
def test_sessions_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    console = Console()
    for block in blocks(page):
        for one in typed(block):
            printed = console.run(one)
            assert agree(one.shown, printed), f"{' '.join(one.words)} prints:\n{printed}"


def test_there_are_sessions() -> None:
    assert ROOT / "docs" / "command-line.md" in [page for page in PAGES if blocks(page)]
