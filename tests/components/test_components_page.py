"""docs/components.md and docs/reference/ list the library as it is."""

import re

import pytest

from tests.support.paths import ROOT
from tests.support.scripts import script

DOCS = ROOT / "docs"
MEND = "run: python docs/make_components.py"


SCRIPT = script("docs/make_components.py")
PAGE = (DOCS / "components.md").read_text(encoding="utf-8")


def _section(package: str) -> str:
    start = f"<!-- classes of {package} -->"
    assert start in PAGE, f"write a section for {package} in docs/components.md, then {MEND}"
    return PAGE.partition(start)[2].partition("<!-- end -->")[0]


@pytest.mark.parametrize("package", SCRIPT.packages())
def test_every_public_class_is_on_the_page_and_no_other(package: str) -> None:
    shown = re.findall(r"\[`([\w.]+)`\]\(", _section(package))
    public = [entry.name for entry in SCRIPT.classes(package)]
    assert sorted(shown) == sorted(public), MEND


@pytest.mark.parametrize("package", SCRIPT.packages())
def test_every_package_has_a_reference_page(package: str) -> None:
    page = DOCS / "reference" / f"{package}.md"
    assert page.exists(), MEND
    assert page.read_text(encoding="utf-8") == SCRIPT.reference(package), MEND
    navigation = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    assert f"reference/{package}.md" in navigation, "add the page to nav in mkdocs.yml"


@pytest.mark.cases(fast=3, slow=99)
@pytest.mark.parametrize("package", SCRIPT.packages())
def test_every_public_class_says_what_it_is(package: str) -> None:
    silent = [entry.name for entry in SCRIPT.classes(package) if not entry.text]
    assert not silent, "their docstrings are empty"
