"""List the component library: python docs/make_components.py.

Writes, for each package, the list of docs/components/ between its markers, its pictures in docs/images/icons/, and
the page of docs/reference/. tests/components/test_components_page.py says when it has to be run again.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections.abc import Container
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import takewhile
from pathlib import Path
from types import ModuleType

import acausal
import acausal.components

HERE = Path(__file__).resolve().parent
PAGES, REFERENCE, ICONS = HERE / "components", HERE / "reference", HERE / "images" / "icons"
MECHANICS, FLUIDS = ("translational", "rotational", "planar"), ("thermal", "fluid", "hydraulic")
FIRST = (*MECHANICS, "electrical", "battery", "magnetic", *FLUIDS, "blocks", "neural")
"""Order of the packages on the page; any other follows."""
LEADING, TRAILING = ("components", "basic"), ("sources", "sensors", "adaptors", "utilities")
"""Modules of a package that are listed first and last."""
BASES = ("interfaces", "bases")
"""Modules whose classes are connectors and bases: listed by name alone."""


SET = acausal.Parameter, acausal.Option, acausal.Module
"""What a user of a class gives."""
LISTED = re.compile(r"[A-Z]\w*:\n|```|>>>")
GIVEN: dict[str, dict[str, object]] = {
    "CombiTable1Ds": {"table": [[0.0, 0.0], [1.0, 1.0]]},
    "CombiTable1Dv": {"table": [[0.0, 0.0], [1.0, 1.0]]},
    "CombiTimeTable": {"table": [[0.0, 0.0], [1.0, 1.0]]},
    "TimeTable": {"table": [[0.0, 0.0], [1.0, 1.0]]},
    "StateSpace": {"A": [[1.0]], "B": [[1.0]], "C": [[1.0]], "D": [[0.0]]},
    "ThermalCollectorMatrix": {"Ns": 1, "Np": 1},
}
"""What classes need before they can be drawn."""
LONG, MANY = 88, 16
"""How long an equation is at most that is shown, and how many are."""
CELL, COLUMNS, TRIM = (240, 140), 10, 9
"""Room of a picture on a sheet, in pixels, how many are in a row, and what a view leaves out around each."""
STYLE = ":root{color:#1f2933}@media(prefers-color-scheme:dark){:root{color:#e4e8ec}}"


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
    def law(self) -> str:
        """What the docstring says before its lists of arguments and examples, in Markdown."""
        paragraphs = (inspect.getdoc(self.cls) or "").split("\n\n")
        said = takewhile(lambda p: not LISTED.match(p), paragraphs)
        return "\n\n".join(said).replace("``", "`")

    @property
    def parameters(self) -> list[tuple[str, str, str, str]]:
        """Name, unit, default and meaning of what can be set."""
        found: dict[str, acausal.modeling.Declaration] = {}
        for base in reversed(self.cls.__mro__):
            for name, value in vars(base).items():
                if isinstance(value, SET):
                    found[name] = value
                else:
                    found.pop(name, None)  # it follows from others
        return [
            (name, declared.unit, _shown(getattr(declared, "default", None)), declared.doc)
            for name, declared in found.items()
            if not name.startswith("_")
        ]

    @cached_property
    def equations(self) -> list[str]:
        """Its own equations, as far as they are short; none of what is made of parts."""
        if not issubclass(self.cls, acausal.Component):
            return []
        try:
            made = [str(equation) for equation in self._made.equations()]
        except (acausal.AcausalError, NotImplementedError):  # it needs values, or a subclass
            return []
        return [text for text in made if len(text) <= LONG][:MANY]

    @cached_property
    def _made(self) -> acausal.Component:
        return self.cls(**GIVEN.get(self.cls.__name__, {}))

    @property
    def picture(self) -> str:
        """Its icon with its connectors, as SVG; empty for what has none."""
        if not issubclass(self.cls, acausal.Component) or self.cls.ICON is None:
            return ""
        try:
            return acausal.diagram(self._made, depth=0).svg
        except (acausal.AcausalError, NotImplementedError):  # it only says what is missing
            return ""

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


@cache
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
    return sorted(found, key=lambda e: (e.cls.__module__, _line(e.cls), e.name))


@cache
def _line(cls: type) -> int:
    """Where a class begins; to find that, Python parses the whole file."""
    return inspect.getsourcelines(cls)[1]


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
    drawn = {name for name, _ in pictures(package)}
    parts = [_group(package, m, groups[m], drawn) for m in sorted(groups, key=_place)]
    if bases := [_link(package, e) for e in entries if e.is_base]:
        parts.append(f"## Connectors and bases\n\n{', '.join(bases)}.")
    return "\n\n".join(parts)


@cache
def pictures(package: str) -> tuple[tuple[str, str], ...]:
    """Names and icons of the package's classes."""
    found = ((entry.name, entry.picture) for entry in classes(package) if not entry.is_base)
    return tuple((name, svg) for name, svg in found if svg)


def sheet(package: str) -> str:
    """All icons of a package in one SVG file, each as a view of the name of its class."""
    views, drawings = [], []
    for number, (name, svg) in enumerate(pictures(package)):
        x, y = CELL[0] * (number % COLUMNS), CELL[1] * (number // COLUMNS)
        width, height = (float(re.search(rf' {k}="([\d.]+)"', svg)[1]) for k in ("width", "height"))
        inner = svg.partition("</style>")[2]
        box = re.search(r'viewBox="([^"]*)"', svg)[1]
        place = f'x="{x}" y="{y}" width="{width:g}" height="{height:g}" viewBox="{box}"'
        inside = f"{x + TRIM} {y + TRIM} {width - 2 * TRIM:g} {height - 2 * TRIM:g}"
        views.append(f'<view id="{name}" viewBox="{inside}"/>')
        drawings.append(f"<svg {place}>{inner}")
    rows = -(-len(drawings) // COLUMNS)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{CELL[0] * COLUMNS}" height="{CELL[1] * rows}" '
        'font-family="system-ui,sans-serif" font-size="11" fill="none" stroke-linecap="round" '
        f'stroke-linejoin="round"><style>{STYLE}</style>\n'
        + "\n".join([*views, *drawings])
        + "\n</svg>\n"
    )


def _place(module: str) -> tuple[int, str]:
    name = module.rpartition(".")[2]
    places = {**dict.fromkeys(LEADING, 0), **{n: 2 + i for i, n in enumerate(TRAILING)}}
    return places.get(name, 1), module


def _group(package: str, module: str, entries: list[Entry], drawn: Container[str]) -> str:
    caption = "General" if module == _path(package) else _caption(module)
    cards = "\n\n".join(_card(package, entry, entry.name in drawn) for entry in entries)
    return f'## {caption}\n\n<div class="components" markdown>\n\n{cards}\n\n</div>'


def _card(package: str, entry: Entry, has_picture: bool) -> str:
    """Picture, name, law, parameters and equations of a class."""
    icon = f"![](../images/icons/{package}.svg#{entry.name}){{ .icon }}\n\n" if has_picture else ""
    more = f"[Reference](../reference/{package}.md#{entry.anchor})"
    rows = [f"| `{n}` | {_code(u)} | {_code(d)} | {m} |" for n, u, d, m in entry.parameters]
    names = ", ".join(f"<code>{name}</code>" for name, *_ in entry.parameters)
    table = "\n".join(["| | unit | default | |", "|---|---|---|---|", *rows]) if rows else ""
    equations = "\n".join(["```text", *entry.equations, "```"]) if entry.equations else ""
    folded = "\n\n".join(part for part in (table, equations) if part)
    summary = f"<details markdown><summary>{names or 'Equations'}</summary>"
    details = f"{summary}\n\n{folded}\n\n</details>\n\n" if folded else ""
    return f"<div markdown>\n\n### {entry.name}\n\n{icon}{entry.law} {more}\n\n{details}</div>"


def _code(text: str) -> str:
    return f"`{text}`" if text else ""


def _shown(default: object) -> str:
    """A default, if it is a plain value."""
    plain = isinstance(default, bool | int | float) or (isinstance(default, str) and default)
    return f"{default:g}" if type(default) is float else str(default) if plain else ""


def _caption(module: str) -> str:
    """A module's docstring up to the first stop."""
    docstring = inspect.getdoc(importlib.import_module(module)) or ""
    text = " ".join(docstring.partition("\n\n")[0].split())
    return re.split(r";|\.\s|\.$|: ", text.replace("``", "`"))[0]


def _link(package: str, entry: Entry) -> str:
    return f"[`{entry.name}`](reference/{package}.md#{entry.anchor})"


def page(package: str) -> str:
    """The text of a package's page with its list made again."""
    path = PAGES / f"{package}.md"
    start, end = f"<!-- classes of {package} -->\n", "<!-- end -->"
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    if start not in text:
        raise SystemExit(f"write docs/components/{path.name} around the lines\n{start}{end}")
    before, _, rest = text.partition(start)
    return before + start + "\n" + listing(package) + "\n\n" + end + rest.partition(end)[2]


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
    ICONS.mkdir(exist_ok=True)
    for package in packages():
        (PAGES / f"{package}.md").write_text(page(package), encoding="utf-8")
        (ICONS / f"{package}.svg").write_text(sheet(package), encoding="utf-8")
        (REFERENCE / f"{package}.md").write_text(reference(package), encoding="utf-8")


if __name__ == "__main__":
    main()
