"""Every ```python block of README.md and docs/ runs, page by page and in order.

The blocks of a page share one namespace and an empty working directory. A block that cannot run is
fenced as ```py. A page with the comment ``<!-- slow -->`` runs with the slow tests.

An ```output block that follows a ```python block shows what that one prints, and is compared with it:
word by word, numbers to within two units of their last digit; a line ``...`` stands for any lines.
"""

import contextlib
import io
import re
import sys
import textwrap
from collections.abc import Callable, Iterator
from itertools import groupby
from pathlib import Path
from types import ModuleType
from typing import Any

import matplotlib.pyplot as plt
import pytest

import acausal as ac
from tests.support.paths import ROOT
from tests.support.scripts import script

PAGES = [*ROOT.glob("README.md"), *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"^([ \t]*)```python[ \t]*\n(.*?)^\1```[ \t]*$", re.MULTILINE | re.DOTALL)
OUTPUT = re.compile(r"\s*^([ \t]*)```output[ \t]*\n(.*?)^\1```[ \t]*$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?(?!\w)")


def blocks(page: Path) -> Iterator[str]:
    """Yield the code of each block, after empty lines that make its line numbers the page's."""
    for block, _ in blocks_and_outputs(page):
        yield block


def blocks_and_outputs(page: Path) -> Iterator[tuple[str, str | None]]:
    """Yield the code of each block as `blocks` does, and the output that the page shows below it."""
    text = page.read_text(encoding="utf-8")
    for match in BLOCK.finditer(text):
        code = "\n" * text.count("\n", 0, match.start(2)) + textwrap.dedent(match[2])
        shown = OUTPUT.match(text, match.end())
        yield code, shown and textwrap.dedent(shown[2])


def agree(shown: str, printed: str, other: list[tuple[str, str]] | None = None) -> bool:
    """Whether a page shows what was printed, up to the last digit of numbers and omitted lines.

    Numbers whose last digits differ are added to ``other``, as shown and as printed.
    """
    wanted = [line.split() for line in shown.splitlines() if line.strip()]
    found = [line.split() for line in printed.splitlines() if line.strip()]
    pieces = [list(group) for dots, group in groupby(wanted, lambda w: w == ["..."]) if not dots]
    start = 0
    for number, piece in enumerate(pieces):
        last = len(found) - len(piece)
        first_only = number == 0 and wanted[0] != ["..."]
        if number == len(pieces) - 1 and wanted[-1] != ["..."]:
            start = max(start, last)
        places = range(start, (start if first_only else last) + 1)
        place = next((i for i in places if _alike(piece, found[i : i + len(piece)])), None)
        if place is None:
            return False
        start = place + len(piece)
        if other is not None:
            pairs = zip(_numbers(piece), _numbers(found[place:start]), strict=True)
            other += [(a, b) for a, b in pairs if a != b]
    return start == len(found) or bool(wanted and wanted[-1] == ["..."])


def _alike(shown: list[list[str]], printed: list[list[str]]) -> bool:
    one, other = "\n".join(map(" ".join, shown)), "\n".join(map(" ".join, printed))
    if NUMBER.sub("#", one) != NUMBER.sub("#", other):
        return False
    return all(
        _close(a, b) for a, b in zip(NUMBER.findall(one), NUMBER.findall(other), strict=True)
    )


def _numbers(lines: list[list[str]]) -> list[str]:
    return NUMBER.findall("\n".join(map(" ".join, lines)))


def _close(shown: str, printed: str) -> bool:
    digits, _, exponent = shown.partition("e")
    unit = 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))
    exact = "." not in shown and not exponent
    return abs(float(shown) - float(printed)) <= (0 if exact else 2.001 * unit)


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
def test_blocks_run(
    page: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    record_property: Callable[[str, object], None],
) -> None:
    # A registered module, as dataclasses look up the module of the class they are applied to.
    module = ModuleType("page_" + re.sub(r"\W", "_", page.stem))
    monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.chdir(tmp_path)
    try:
        for block, shown in blocks_and_outputs(page):
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(compile(block, str(page), "exec"), vars(module))
            if shown is not None:
                line = block.count("\n") - block.lstrip("\n").count("\n")
                other: list[tuple[str, str]] = []
                assert agree(shown, printed.getvalue(), other), (
                    f"{page.name}, block at line {line + 1}, prints:\n{printed.getvalue()}"
                )
                for numbers in other:
                    record_property("digit", (f"{page.name}:{line + 1}", *numbers))
    finally:
        plt.close("all")


def test_fences_name_a_language_and_nothing_else() -> None:
    """The documentation renders a fence such as ```python notest as running text."""
    fence = re.compile(r"^[ \t]*```[ \t]*\w+[ \t]+\S.*$", re.MULTILINE)
    found = {page.name: fence.findall(page.read_text(encoding="utf-8")) for page in PAGES}
    assert not {name: lines for name, lines in found.items() if lines}, "fence it as ```py"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_output_follows_a_block(page: Path) -> None:
    """An ```output fence anywhere else would show what no test compares."""
    compared = [shown for _, shown in blocks_and_outputs(page) if shown is not None]
    assert page.read_text(encoding="utf-8").count("```output") == len(compared)


def test_blocks_are_found_and_numbered(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "# Page\n```python\na = 1\n```\n```py\nwrong(\n```\n```text\nno\n```\n"
        "!!! note\n    ```python\n    b = 2\n    if b:\n        c = 3\n    ```\n",
        encoding="utf-8",
    )
    assert [block.strip() for block in blocks(page)] == ["a = 1", "b = 2\nif b:\n    c = 3"]
    assert [len(block) - len(block.lstrip("\n")) for block in blocks(page)] == [2, 12]


EXTRAS = {
    "plot": r"\.plot\(",
    "diagram": r"ac\.diagram\(",
    "page": r"ac\.page\(|\.report\(",
    "dataframe": r"\.to_dataframe\(",
    "xarray": r"\.to_xarray\(",
    "notebook": r"ac\.sliders\(",
}
"""What a page's code needs, by extra."""


@pytest.mark.parametrize("name", ["README.md", "docs/index.md", "docs/getting-started.md"])
def test_what_a_page_installs_is_what_its_code_needs(name: str) -> None:
    """Of the pages on which readers begin; the first of several lines is for all of them."""
    text = (ROOT / name).read_text(encoding="utf-8")
    installed = re.findall(r"^pip install '\.\[(.*?)\]'", text, re.MULTILINE)
    code = "\n".join(block for _, block in BLOCK.findall(text))
    needed = {extra for extra, pattern in EXTRAS.items() if re.search(pattern, code)}
    assert needed <= set(",".join(installed).split(","))
    assert {"plot", "diagram", "page"} <= set(installed[0].split(","))


def test_no_page_denies_what_there_is() -> None:
    """Sentences that were true once."""
    found = [
        f"{page.name}: {sentence}"
        for page in PAGES
        for sentence in ("There are no events", "Gates have no delay", "not within the model")
        if sentence in page.read_text(encoding="utf-8")
    ]
    assert found == []


def test_how_it_works_names_modules_that_exist() -> None:
    text = (ROOT / "docs" / "how-it-works.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`(\w+\.py)`", text))
    assert named
    kernel = {path.name for path in (ROOT / "acausal").rglob("*.py")}
    assert named <= kernel


@pytest.mark.parametrize(
    ("shown", "printed", "same"),
    [
        ("loss 0.12", "loss  0.1213\n", True),
        ("loss 0.12", "loss 0.15", False),
        ("12 states", "13 states", False),
        ("a\n...\nz", "a\nb\nc\nz\n", True),
        ("a\n...\nz", "a\nb\nc\n", False),
        ("...\nz", "b\nz", True),
        ("a\n...", "a\nb\nc", True),
        ("a\n...", "b\nc", False),
        ("a", "a\nb", False),
        ("1.0e-07", "1.1e-07", True),
        ("", "a", False),
    ],
)
def test_outputs_are_compared(shown: str, printed: str, same: bool) -> None:
    assert agree(shown, printed) is same


def test_the_picture_of_the_rooms_is_up_to_date() -> None:
    house = script("docs/images/make_house.py")
    drawn = (ROOT / "docs" / "images" / "house.svg").read_text(encoding="utf-8")
    assert drawn == house.draw(), "run: python docs/images/make_house.py"


def test_the_picture_shows_every_room() -> None:
    house = script("docs/images/make_house.py")
    shown = {room.name for floor in house.floors() for room in floor}
    folders = {f"{p.parent.name}/" for p in (ROOT / "acausal").glob("*/__init__.py")}
    assert shown == (folders - {"components/"}) | {"errors.py", "files.py", "jobs.py", "system.py"}


@pytest.mark.slow
def test_the_reference_lists_the_public_names() -> None:
    """Names that packages re-export, from stubs too, and functions named as the module that defines them."""
    griffe = pytest.importorskip("griffe")
    extensions = griffe.load_extensions(str(ROOT / "docs" / "declarations.py"))
    kernel = griffe.load("acausal", search_paths=[str(ROOT)], extensions=extensions)
    listed = {name: member for name, member in kernel.members.items() if member.is_public}
    assert {*ac.__all__} <= {*listed}
    for name in ("Component", "compile", "simulate", "fit", "ensemble", "diagram"):
        assert not listed[name].is_module
        assert listed[name].has_docstring, f"acausal.{name} has no docstring"


def test_the_reference_shows_the_options_of_fit() -> None:
    page = (ROOT / "docs" / "reference" / "acausal.md").read_text(encoding="utf-8")
    (members,) = re.findall(r"::: acausal\.training\n    options:\n      members: \[(.*)\]", page)
    assert "FitOptions" in members.split(", ")
