"""List the component library: python docs/make_components.py.

Writes the lists of docs/components.md, between their markers, and docs/reference/, a page for each package.
tests/test_components_page.py tells when it has to be run again.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import acausal
import acausal.components

HERE = Path(__file__).resolve().parent
PAGE, REFERENCE = HERE / "components.md", HERE / "reference"
MECHANICS, FLUIDS = ("translational", "rotational", "planar"), ("thermal", "fluid", "hydraulic")
FIRST = (*MECHANICS, "electrical", "battery", "magnetic", *FLUIDS, "blocks", "neural")
"""Order of the packages on the page; any other follows."""
LEADING, TRAILING = ("components", "basic"), ("sources", "sensors", "adaptors", "utilities")
"""Modules of a package that are listed first and last."""
BASES = ("interfaces", "bases")
"""Modules whose classes are connectors and bases: listed by name alone."""


@dataclass(frozen=True)
class Entry:
    """A public class: how a user of its package calls it, and where it is documented."""

    name: str
    cls: type
    anchor: str

    @property
    def text(self) -> str:
        """The first sentence of its docstring, in Markdown."""
        paragraph = (inspect.getdoc(self.cls) or "").partition("\n\n")[0]
        sentence = re.split(r"(?<=[.;:!?])\s*\n|(?<=\.)\s+(?=[A-Z`])", paragraph)[0]
        return " ".join(sentence.split()).rstrip(".;:").replace("``", "`")

    @property
    def module(self) -> str:
        """The module that defines it, without the package's path."""
        return ".".join(self.cls.__module__.split(".")[3:])

    @property
    def is_base(self) -> bool:
        """Whether it is a connector or a base, no component to use as it is."""
        return (
            not self.cls.__module__.startswith(acausal.components.__name__)
            or issubclass(self.cls, acausal.Connector)
            or self.module in BASES
            or self.name.startswith("Partial")
        )


def packages() -> list[str]:
    """Names of the library's packages that have public components, in the page's order."""
    found = pkgutil.iter_modules(acausal.components.__path__)
    shown = [m.name for m in found if m.ispkg and _public(importlib.import_module(_path(m.name)))]
    return sorted(shown, key=lambda n: (FIRST.index(n) if n in FIRST else len(FIRST), n))


def classes(package: str) -> list[Entry]:
    """The public classes of a package, then those of its public modules that are not the same."""
    module = importlib.import_module(_path(package))
    found = [*_entries(module, "")]
    known = {(e.cls, e.name) for e in found}
    for name in _modules(module):
        inner = _entries(getattr(module, name), f"{name}.")
        found += [e for e in inner if (e.cls, e.name.rpartition(".")[2]) not in known]
    return found


def _entries(module: ModuleType, prefix: str) -> list[Entry]:
    named = [(n, getattr(module, n)) for n in _public(module)]
    found = [Entry(prefix + n, v, f"{module.__name__}.{n}") for n, v in named if inspect.isclass(v)]
    return sorted(found, key=lambda e: (e.cls.__module__, inspect.getsourcelines(e.cls)[1], e.name))


def _modules(module: ModuleType) -> list[str]:
    """The public modules of a package."""
    return [n for n in _public(module) if inspect.ismodule(getattr(module, n))]


def _public(module: ModuleType) -> list[str]:
    """The names that a module exports; without ``__all__`` what it defines itself."""
    if hasattr(module, "__all__"):
        return list(module.__all__)
    own = [n for n, v in vars(module).items() if getattr(v, "__module__", "") == module.__name__]
    return [n for n in own if not n.startswith("_")]


def _path(package: str) -> str:
    return f"acausal.components.{package}"


def listing(package: str) -> str:
    """The package's classes as Markdown, grouped by the module that defines them."""
    entries = classes(package)
    groups: dict[str, list[Entry]] = {}
    for entry in entries:
        if not entry.is_base:
            groups.setdefault(entry.cls.__module__, []).append(entry)
    parts = [_group(package, module, groups[module]) for module in sorted(groups, key=_place)]
    if bases := [_link(package, e) for e in entries if e.is_base]:
        parts.append(f"Connectors and bases: {', '.join(bases)}.")
    return "\n\n".join(parts)


def _place(module: str) -> tuple[int, str]:
    name = module.rpartition(".")[2]
    places = {**dict.fromkeys(LEADING, 0), **{n: 2 + i for i, n in enumerate(TRAILING)}}
    return places.get(name, 1), module


def _group(package: str, module: str, entries: list[Entry]) -> str:
    caption = [] if module == _path(package) else [f"*{_caption(module)}*", ""]
    items = [f"- {_link(package, e)}" + (f": {e.text}" if e.text else "") for e in entries]
    return "\n".join([*caption, *items])


def _caption(module: str) -> str:
    """A module's docstring up to the first stop."""
    docstring = inspect.getdoc(importlib.import_module(module)) or ""
    text = " ".join(docstring.partition("\n\n")[0].split())
    return re.split(r";|\.\s|\.$|: ", text.replace("``", "`"))[0]


def _link(package: str, entry: Entry) -> str:
    return f"[`{entry.name}`](reference/{package}.md#{entry.anchor})"


def page(text: str) -> str:
    """The text of the page with all lists made anew."""
    for package in packages():
        start, end = f"<!-- classes of {package} -->\n", "<!-- end -->"
        if start not in text:
            raise SystemExit(
                f"{PAGE.name} has no section for {package}: write one around the lines\n{start}{end}"
            )
        before, _, rest = text.partition(start)
        text = before + start + "\n" + listing(package) + "\n\n" + end + rest.partition(end)[2]
    return text


def reference(package: str) -> str:
    """The text of a package's reference page."""
    path = _path(package)
    inner = [f"{path}.{name}" for name in _modules(importlib.import_module(path))]
    parts = [_directive(path, heading=False), *(_directive(p, heading=True) for p in inner)]
    return "\n\n".join([f"# {path}", *parts]) + "\n"


def _directive(path: str, *, heading: bool) -> str:
    shown = str(heading).lower()
    lines = [
        f"::: {path}",
        "    options:",
        '      filters: ["!^_", "!^equations$", "!^initial_equations$"]',
        "      show_if_no_docstring: true",
        f"      show_root_heading: {shown}",
        f"      show_root_toc_entry: {shown}",
        "      show_source: false",
        "      show_submodules: false",
    ]
    return "\n".join(lines)


def main() -> None:
    """Write everything."""
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    for package in packages():
        (REFERENCE / f"{package}.md").write_text(reference(package), encoding="utf-8")


if __name__ == "__main__":
    main()
