"""Write `modelica-coverage.md`: which classes of the Modelica Standard Library there are here.

    python docs/make_coverage.py

A test compares the page with what this script makes.
"""

from __future__ import annotations

import re
from collections import Counter
from importlib import import_module
from pathlib import Path
from typing import Any

from acausal import components
from acausal.netlist import Library

PAGE = Path(__file__).with_name("modelica-coverage.md")
OTHERS = ("PlanarMechanics", "Mechanics.MultiBody", "MB")
"""What is of another library, or only as much as that needs."""
HEAD = """\
# Coverage of the Modelica Standard Library

The classes of the Modelica Standard Library 4.1.0 in our domains, and their names here, below `acausal.components`.
`docs/make_coverage.py` writes this page.

- A Python path: the class is there.
- *refused*: the class needs what acausal does not have yet, such as the past of a signal. If you make one, an error
  says so.
- A dash: the class is not there. Many of these are bases for Modelica's own classes only.
"""


def page() -> str:
    """The text of the page."""
    library = Library(components)
    rows: dict[str, dict[str, str]] = {}
    places = [p for m, p in components.MODELICA.items() if domain_of(m) not in OTHERS]
    for place in places:
        module = import_module(f"{components.__name__}.{place}")
        for name, path in module.MODELICA_NAMES.items():
            package, _, word = name.rpartition(".")
            missing = refused(library.find(name))
            rows.setdefault(package, {})[word] = "*refused*" if missing else f"`{place}.{path}`"
    for package, words in components.NOT_COVERED.items():
        rows.setdefault(package, {}).update(dict.fromkeys(words.split(), "–"))
    domains: dict[str, list[str]] = {}
    for package in sorted(rows):
        domains.setdefault(domain_of(package), []).append(package)
    lines = [HEAD, "| domain | there | refused | not there |", "|---|---:|---:|---:|"]
    total: Counter[str] = Counter()
    for domain, packages in domains.items():
        count = Counter(kind(text) for package in packages for text in rows[package].values())
        total += count
        anchor = re.sub(r"[^a-z]", "", domain.lower())
        lines.append(f"| [{domain}](#{anchor}) | {counts(count)} |")
    lines.append(f"| all | {counts(total)} |")
    for domain, packages in domains.items():
        lines += ["", f"## {domain}", "", "| package | there | refused | not there |"]
        lines += ["|---|---:|---:|---:|"]
        for package in packages:
            count = Counter(kind(text) for text in rows[package].values())
            lines.append(f"| [`{package}`](#{package.lower()}) | {counts(count)} |")
        for package in packages:
            title = package.removeprefix(f"Modelica.{domain}").strip(".") or domain
            lines += ["", f"### {title} {{ #{package.lower()} }}", "", f"`{package}`", ""]
            lines += ["| class | here |", "|---|---|"]
            lines += [f"| `{name}` | {text} |" for name, text in sorted(rows[package].items())]
    return "\n".join(lines) + "\n"


def domain_of(package: str) -> str:
    """The part of the Modelica Standard Library that a package belongs to, as in ``Mechanics.Rotational``."""
    first, *others = package.removeprefix("Modelica.").split(".")
    return first if first == "Blocks" or not others else f"{first}.{others[0]}"


def counts(count: Counter[str]) -> str:
    """The columns of a summary."""
    return f"{count['there']} | {count['refused']} | {count['not there']}"


def refused(cls: Any) -> bool:
    """Whether a class says that it needs what acausal does not have."""
    try:
        cls()
    except Exception as error:  # most classes want arguments, bases a subclass
        return "which acausal does not have yet" in str(error)
    return False


def kind(text: str) -> str:
    """The column of the summary that a class counts in."""
    return {"–": "not there", "*refused*": "refused"}.get(text, "there")


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
