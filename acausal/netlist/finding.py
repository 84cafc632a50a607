"""`find`: components of the installed libraries by what they are called, what they do, and in which units."""

from __future__ import annotations

import inspect
import pkgutil
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from importlib import import_module
from types import ModuleType
from typing import Any, overload

from acausal.errors import DataError, shown
from acausal.modeling import Component, Connector, Declaration, declarations_of
from acausal.netlist.library import Library, installed

WIDTH = 100
"""A line of the list is cut there."""

NEAR, WITHIN, MODELICA, MENTIONED = 1, 2, 3, 4
"""How well a class fits a word, after 0 for its very name."""


@dataclass(frozen=True)
class PublicClass:
    """A public class of a library.

    Attributes:
        name: where it is below its library: ``"electrical.Resistor"``.
        cls: the class.
        modelica: its name in Modelica; an empty text if it has none there.
        also: what else it is called, as the library lists it.
    """

    name: str
    cls: type[Component] | type[Connector]
    modelica: str
    also: str = ""

    @cached_property
    def summary(self) -> str:
        """The first sentence of its docstring."""
        paragraph = (inspect.getdoc(self.cls) or "").partition("\n\n")[0]
        sentence = re.split(r"(?<=[.;:!?])\s*\n|(?<=\.)\s+(?=[A-Z`])", paragraph)[0]
        return " ".join(sentence.split()).rstrip(".;:").replace("``", "")

    @property
    def is_base(self) -> bool:
        """Whether others extend it, or connect by it: no component to use as it is."""
        module, word = self.cls.__module__.rpartition(".")[2], self.cls.__name__
        partial = word.lower().startswith("partial") or module in ("interfaces", "bases")
        return partial or issubclass(self.cls, Connector)

    @cached_property
    def units(self) -> frozenset[str]:
        """The units of what it declares, those of its connectors included."""
        return frozenset(d.unit for d in _declarations(self.cls))

    def rank(self, word: str) -> int | None:
        """How well it fits a word, 0 best; None if it does not."""
        own, word = self.cls.__name__.lower(), word.lower()
        if word == own:
            return 0
        if own.startswith(word) or own.endswith(word):
            return NEAR
        if word in self.name.lower():
            return WITHIN
        if word in f"{self.modelica} {self.also}".lower():
            return MODELICA
        return MENTIONED if word in self.summary.lower() else None


class FoundClasses(Sequence[type[Component] | type[Connector]]):
    """Classes that `find` has found, the best first: ``found[0]`` is a class, and ``found`` prints a line for each."""

    def __init__(self, entries: Sequence[PublicClass]) -> None:
        self.entries = tuple(entries)

    @property
    def names(self) -> tuple[str, ...]:
        """Where they are, below `acausal.components` or another library: ``"electrical.Resistor"``."""
        return tuple(entry.name for entry in self.entries)

    def __len__(self) -> int:
        return len(self.entries)

    @overload
    def __getitem__(self, index: int) -> type[Component] | type[Connector]: ...
    @overload
    def __getitem__(self, index: slice) -> FoundClasses: ...
    def __getitem__(self, index: int | slice) -> Any:
        """A class, or some of those found."""
        if isinstance(index, slice):
            return FoundClasses(self.entries[index])
        return self.entries[index].cls

    def __repr__(self) -> str:
        if not self.entries:
            return "Nothing is found; try a shorter word, or fewer of them."
        width = max(len(name) for name in self.names)
        lines = [f"{e.name:<{width}}  {e.summary}".rstrip() for e in self.entries]
        return "\n".join(
            line if len(line) <= WIDTH else f"{line[: WIDTH - 3]}..." for line in lines
        )


def find(text: str = "", *, unit: str | None = None) -> FoundClasses:
    """Search the installed libraries for components and connectors.

    Arguments:
        text: words, of which every one must occur in the class's name, in Modelica's name of it (versions 3 and 4), in
            what else it is called (``"thermostat"``), or in the first sentence of its description; upper or lower
            case. Without any, all classes fit.
        unit: of one of its parameters, variables or connectors, such as ``"N.m"``; ``"N*m"`` is the same.

    Returns:
        The classes, best first; bases and connectors last. It prints one line for each.

    Raises:
        DataError: for what is not a text.
    """
    for argument, given in (("text", text), ("unit", "" if unit is None else unit)):
        if not isinstance(given, str):
            raise DataError(f"find: {argument}={shown(given)} is not a text.")
    words, wanted = text.split(), None if unit is None else re.sub(r"\s*[*·]\s*| +", ".", unit)
    ranked: list[tuple[tuple[bool, int, str], PublicClass]] = []
    for entry in entries(installed()):
        ranks = [entry.rank(word) for word in words]
        if None not in ranks and (wanted is None or wanted in entry.units):
            best = max((rank for rank in ranks if rank is not None), default=0)
            ranked.append(((entry.is_base, best, entry.name), entry))
    return FoundClasses([entry for _, entry in sorted(ranked, key=lambda pair: pair[0])])


@cache
def entries(libraries: Sequence[Library]) -> tuple[PublicClass, ...]:
    """The public classes of some libraries, each once, under its shortest name."""
    found: dict[type, PublicClass] = {}
    for library in libraries:
        own = library.module.__name__
        modelica = library.written_names
        for module in _modules(library.module):
            for name in _public(module):
                cls = getattr(module, name)
                if not (isinstance(cls, type) and issubclass(cls, Component | Connector)):
                    continue
                path = f"{module.__name__}.{name}".removeprefix(f"{own}.")
                known = found.get(cls)
                if cls.__module__.startswith(own) and (
                    known is None or _place(path, cls) < _place(known.name, cls)
                ):
                    name = modelica.get(cls, "")
                    also = library.also_called.get(path, "")
                    found[cls] = PublicClass(path, cls, name if "." in name else "", also)
    return tuple(found.values())


def _place(path: str, cls: type) -> tuple[bool, int, str]:
    """Of several names of a class the least is shown: its own name, in the package that it is from."""
    return path.rpartition(".")[2] != cls.__name__, path.count("."), path


def _modules(module: ModuleType) -> Iterator[ModuleType]:
    """A library's module and its packages, with the public modules of each."""
    yield module
    for part in pkgutil.iter_modules(getattr(module, "__path__", ())):
        if part.ispkg and not part.name.startswith("_"):
            package = import_module(f"{module.__name__}.{part.name}")
            yield package
            public = [getattr(package, name) for name in _public(package)]
            yield from (m for m in public if isinstance(m, ModuleType))


def _public(module: ModuleType) -> list[str]:
    """The names that a module exports; without ``__all__`` what it defines itself."""
    stated: Sequence[str] | None = getattr(module, "__all__", None)
    if stated is not None:
        return [name for name in stated if hasattr(module, name)]
    own = [n for n, v in vars(module).items() if getattr(v, "__module__", "") == module.__name__]
    return [name for name in own if not name.startswith("_")]


def _declarations(cls: type) -> Iterator[Declaration]:
    for declared in declarations_of(cls).values():
        if isinstance(declared, Declaration):
            yield declared
        else:
            yield from _declarations(type(declared))
