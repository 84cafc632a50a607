"""Write `modelica-coverage.md`: which classes of the Modelica Standard Library there are here.

    python docs/make_coverage.py

A test compares the page with what this script makes.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

from acausal import components
from acausal.netlist import Library

PAGE = Path(__file__).with_name("modelica-coverage.md")
HEAD = """\
# Coverage of the Modelica Standard Library

The classes of the Modelica Standard Library 4.1.0 in our domains, and their names here, below `acausal.components`.
`docs/make_coverage.py` writes this page.

- A Python path: the class is there.
- *discrete*: the class needs discrete states (it remembers, or waits for events), which acausal does not have yet.
  If you make one, an error says so.
- A dash: the class is not there. Many of these are bases for Modelica's own classes only.
"""


def page() -> str:
    """The text of the page."""
    library = Library(components)
    rows: dict[str, list[tuple[str, str]]] = {
        package: [(name, status(library, package, place, name)) for name in names]
        for package, (place, names) in components.CATALOG.items()
    }
    lines = [HEAD, "| package | there | discrete | not there |", "|---|---:|---:|---:|"]
    total: Counter[str] = Counter()
    for package, classes in rows.items():
        count = Counter(kind(text) for _, text in classes)
        total += count
        lines.append(
            f"| `{package}` | {count['there']} | {count['discrete']} | {count['not there']} |"
        )
    lines.append(f"| all | {total['there']} | {total['discrete']} | {total['not there']} |")
    for package, classes in rows.items():
        lines += ["", f"## {package}", "", "| class | here |", "|---|---|"]
        lines += [f"| `{name}` | {text} |" for name, text in classes]
    return "\n".join(lines) + "\n"


def status(library: Library, package: str, place: str, name: str) -> str:
    """What the table says about a class."""
    cls = library.find(f"{package}.{name}")
    record = library.records.get(name)
    if cls is None:
        here = record is not None and type(record).__module__.startswith("acausal.components.")
        return f"`{place}.{name}`" if here else "–"
    return "*discrete*" if refused(cls) else f"`{place}.{name}`"


def refused(cls: Any) -> bool:
    """Whether a class says that it needs discrete states."""
    try:
        cls()
    except Exception as error:  # most classes want arguments, bases a subclass
        return "needs discrete states" in str(error)
    return False


def kind(text: str) -> str:
    """The column of the summary that a class counts in."""
    return {"–": "not there", "*discrete*": "discrete"}.get(text, "there")


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
