"""Write `modelica-coverage.md`: which classes of the Modelica Standard Library there are here.

    python docs/make_coverage.py

A test compares the page with what this script makes.
"""

from __future__ import annotations

from collections import Counter
from importlib import import_module
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
    rows: dict[str, dict[str, str]] = {}
    for place in components.MODELICA.values():
        module = import_module(f"{components.__name__}.{place}")
        for name, path in module.MODELICA_NAMES.items():
            package, _, word = name.rpartition(".")
            discrete = refused(library.find(name))
            rows.setdefault(package, {})[word] = "*discrete*" if discrete else f"`{place}.{path}`"
    for package, words in components.NOT_COVERED.items():
        rows.setdefault(package, {}).update(dict.fromkeys(words.split(), "–"))
    lines = [HEAD, "| package | there | discrete | not there |", "|---|---:|---:|---:|"]
    total: Counter[str] = Counter()
    for package, classes in sorted(rows.items()):
        count = Counter(kind(text) for text in classes.values())
        total += count
        lines.append(
            f"| `{package}` | {count['there']} | {count['discrete']} | {count['not there']} |"
        )
    lines.append(f"| all | {total['there']} | {total['discrete']} | {total['not there']} |")
    for package, classes in sorted(rows.items()):
        lines += ["", f"## {package}", "", "| class | here |", "|---|---|"]
        lines += [f"| `{name}` | {text} |" for name, text in sorted(classes.items())]
    return "\n".join(lines) + "\n"


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
