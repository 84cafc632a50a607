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

The classes that the Modelica Standard Library 4.1.0 has in our domains, and where they are here, below
`acausal.components`. This page is made by `docs/make_coverage.py`.

- A Python path: the class is there.
- *discrete*: the class needs discrete states (it remembers, or waits for events), which acausal does not have yet;
  making one says so.
- A dash: it is not there. Many of these are bases that only serve classes of Modelica's own.
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
