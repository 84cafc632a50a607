"""docs/components/ and docs/reference/ list the library as it is."""

import re
from xml.etree import ElementTree

import pytest

from tests.support.paths import ROOT
from tests.support.scripts import script

DOCS = ROOT / "docs"
MEND = "run: python docs/make_components.py"


SCRIPT = script("docs/make_components.py")


def stated(page: str) -> str:
    """A page without its formulas, which versions of sympy write in different ways."""
    return re.sub(r"^```text\n.*?^```$", "", page, flags=re.MULTILINE | re.DOTALL)


def test_equations_are_on_the_page() -> None:
    page = (DOCS / "components" / "translational.md").read_text(encoding="utf-8")
    assert "f = c*(s_rel - s_rel0) + d*v_rel" in page


@pytest.mark.cases(fast=1, slow=11)
@pytest.mark.parametrize("package", SCRIPT.packages())
def test_every_public_class_is_on_its_page_with_its_law_and_parameters(package: str) -> None:
    page = DOCS / "components" / f"{package}.md"
    assert page.exists(), f"write {page.name}, then {MEND}"
    assert stated(page.read_text(encoding="utf-8")) == stated(SCRIPT.page(package)), MEND
    shown = re.findall(r"^### (\S+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    public = [entry.name for entry in SCRIPT.classes(package) if not entry.is_base]
    assert sorted(shown) == sorted(public), MEND
    assert f"](components/{package}.md)" in (DOCS / "components.md").read_text(encoding="utf-8")
    assert f"components/{package}.md" in (ROOT / "mkdocs.yml").read_text(encoding="utf-8")


@pytest.mark.parametrize("package", SCRIPT.packages())
def test_every_picture_of_a_page_is_on_the_sheet(package: str) -> None:
    pytest.importorskip("graphlay")
    page = (DOCS / "components" / f"{package}.md").read_text(encoding="utf-8")
    sheet = (DOCS / "images" / "icons" / f"{package}.svg").read_text(encoding="utf-8")
    assert sheet == SCRIPT.sheet(package), MEND
    views = {e.attrib["id"] for e in ElementTree.fromstring(sheet).iter() if e.tag.endswith("view")}
    assert set(re.findall(rf"icons/{package}\.svg#([\w.]+)\)", page)) == views


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
