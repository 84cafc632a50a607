"""The pages of the gallery: a schematic first, code that is not cut, figures for phones."""

from __future__ import annotations

import re

import pytest

from tests.support.paths import ROOT
from tests.support.scripts import script

DOCS = ROOT / "docs"
IMAGES = DOCS / "images"
PAGES = sorted(p.stem for p in (DOCS / "gallery").glob("*.md") if p.stem != "index")


@pytest.mark.parametrize("page", PAGES)
def test_a_page_opens_with_the_schematic_of_its_model(page: str) -> None:
    text = (DOCS / "gallery" / f"{page}.md").read_text(encoding="utf-8")
    first = re.search(r"!\[[^\]]+\]\(\.\./images/([\w.-]+)\)", text)
    assert first is not None
    assert first[1] == f"gallery-{page}.svg"
    assert first.start() < text.index("\n## ")
    assert (IMAGES / first[1]).exists(), "run: python docs/images/make_from_pages.py"
    assert f'.save("{first[1]}")' in text
    index = (DOCS / "gallery" / "index.md").read_text(encoding="utf-8")
    assert f"images/{first[1]}" in index


@pytest.mark.parametrize("page", PAGES)
def test_code_fits_a_window_of_1280_pixels(page: str) -> None:
    text = (DOCS / "gallery" / f"{page}.md").read_text(encoding="utf-8")
    code = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert max(len(line) for block in code for line in block.splitlines()) <= 105


def test_phones_see_panels_below_each_other() -> None:
    show = script("docs/narrow_pictures.py").on_page_content
    shown = show('<p><img alt="" src="../images/gallery-tanks.png"></p>')
    assert 'srcset="../images/gallery-tanks-narrow.png"' in shown
    other = '<p><img alt="" src="images/page.png"></p>'
    assert show(other) == other
    assert {f"gallery-{page}-narrow.png" for page in PAGES} == {
        path.name for path in IMAGES.glob("*-narrow.png")
    }
