"""The tree of classes: files and folders that are read when a name needs them, and the lookup of names.

Classes that the installed libraries have by their Modelica name are taken from there, even where their text is given.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

from acausal.modelica.classes import ClassNode
from acausal.modelica.grammar import parse
from acausal.modelica.meanings import Native, Predefined, Prefix, Value, is_icon
from acausal.modelica.si_units import ATTRIBUTES, UNITS
from acausal.modelica.tokens import read_source
from acausal.modeling import Component
from acausal.netlist import CONSTANTS, Library, function, is_structural

SI = re.compile(r"Modelica\.(?:Units\.(?:SI|NonSI)|SIunits(?:\.Conversions\.NonSIunits)?)\.(\w+)")
PACKAGES = frozenset(
    f"Modelica.{name}"
    for name in (
        *("Icons", "Constants", "Math", "Units", "Units.SI", "Units.NonSI", "Units.Conversions"),
        *("SIunits", "SIunits.Conversions", "SIunits.Conversions.NonSIunits"),
    )
)
"""Packages without components, which need no text."""


class Tree:
    """All classes that a model can name.

    Arguments:
        libraries: with native classes.
        path: folders in which packages are looked for.
    """

    def __init__(self, libraries: Sequence[Library], path: Sequence[Path] = ()) -> None:
        self.libraries = tuple(libraries)
        self.path = [
            *path,
            *(Path(p) for p in os.environ.get("MODELICAPATH", "").split(os.pathsep) if p),
        ]
        self.roots: dict[str, ClassNode | Prefix] = {}
        self._natives: dict[str, Any] = {}
        self._searched: dict[str, int] = {}
        """Name -> in how many folders of the path there is no package of that name."""

    def __deepcopy__(self, memo: Any) -> Tree:
        return self

    def add(self, file: Path) -> list[ClassNode]:
        """Read a file; the classes in it.

        Raises:
            ModelicaError: if it is wrong.
        """
        within, definitions = parse(read_source(file))
        words = within.split(".") if within else []
        above = file.resolve().parents  # the folder of the outermost package is searched, too
        depth = len(words) + (file.name == "package.mo")
        if depth < len(above) and above[depth] not in self.path:
            self.path.append(above[depth])
        parent = self.package(words)
        found: list[ClassNode] = []
        for definition in definitions:
            own = file.parent if file.name == "package.mo" else None
            node = ClassNode(definition, parent, self, own)
            if parent is None:
                self.roots[definition.name] = node
            elif isinstance(parent, ClassNode):
                parent.children[definition.name] = node
            found.append(node)
        return found

    def package(self, words: Sequence[str]) -> ClassNode | Prefix | None:
        """The package of that name: its class, where its text is given."""
        if not words:
            return None
        found = self.root(words[0])
        node: Any = found
        for i, word in enumerate(words[1:], start=2):
            inner = node.own(word) if isinstance(node, ClassNode) else None
            node = inner if isinstance(inner, ClassNode) else Prefix(".".join(words[:i]))
        return node or Prefix(".".join(words))

    def root(self, name: str) -> ClassNode | Prefix | None:
        """A package at the top."""
        if name in self.roots:
            return self.roots[name]
        for folder in islice(self.path, self._searched.get(name, 0), None):
            names = (
                [name, *sorted(p.name for p in folder.glob(f"{name} *"))] if folder.is_dir() else []
            )
            for known in names:
                for file in (folder / known / "package.mo", folder / f"{known}.mo"):
                    if file.is_file():
                        self.roots[name] = Prefix(name)
                        for node in self.add(file):
                            self.roots.setdefault(node.definition.name, node)
                        if isinstance(self.roots[name], ClassNode):
                            return self.roots[name]
                        del self.roots[name]  # the file has other classes
        self._searched[name] = len(self.path)
        if any(name == known.partition(".")[0] for lib in self.libraries for known in lib.packages):
            return Prefix(name)
        return self.roots.get(name)

    def native(self, full: str) -> Native | Predefined | Value | None:
        """What the libraries have by a full name."""
        if full not in self._natives:
            self._natives[full] = self._native(full)
        return self._natives[full]

    def _native(self, full: str) -> Native | Predefined | Value | None:
        for library in self.libraries:
            cls = library.find(full)
            if cls is not None:
                return Native(cls, full)
        word = full.rpartition(".")[2]
        found = SI.fullmatch(full)
        if found is not None and found[1] in UNITS:
            given = {"unit": UNITS[found[1]], **ATTRIBUTES.get(found[1], {})}
            return Predefined("Real", given)
        if full.startswith("Modelica.Constants.") and word in CONSTANTS:
            return Value(CONSTANTS[word])
        if full.startswith("Modelica."):
            for library in self.libraries:
                value = library.constant(full)
                if value is not None:
                    return Value(value)
            known = function(full)
            called = (
                [known] if known else [library.constant(f"{full}()") for library in self.libraries]
            )
            for value in called:
                if callable(value):
                    return Value(value)
        return None

    def resolve(self, full: str) -> Any:
        """A class, constant or package by its full name; None if there is none."""
        words = full.lstrip(".").split(".")
        found: Any = self.root(words[0])
        for word in words[1:]:
            if found is None:
                return None
            found = self.inside(found, word)
        return found

    def text(self, full: str) -> ClassNode | None:
        """The text of a class that a library has, too; None where there is none."""
        above, _, word = full.rpartition(".")
        package = self.resolve(above)
        if not isinstance(package, ClassNode):
            return None
        key = f"text of {word}"
        if key not in package.children:
            package.children[key] = package.text(word)
        return package.children[key]

    def text_with(self, native: Native, names: Iterable[str]) -> ClassNode | None:
        """The text of a library's class, if it has one of these names and the class here lacks it."""
        lacking = [n for n in names if not _has(native.cls, n)]
        text = self.text(native.name) if lacking else None
        return text if text and any(n in text.view().entries for n in lacking) else None

    def inside(self, package: Any, word: str) -> Any:
        """A member of a package."""
        if isinstance(package, ClassNode):
            return package.member(word)
        if isinstance(package, Prefix):
            full = f"{package.full}.{word}"
            found = self.native(full)
            if found is None and self.knows(full):
                return Prefix(full)
            return found
        return None

    def has_package(self, full: str) -> bool:
        """Whether a library covers classes of a package."""
        return full in PACKAGES or any(library.has_package(full) for library in self.libraries)

    def knows(self, full: str) -> bool:
        """Whether a name may be that of a package whose text is not given."""
        word = full.rpartition(".")[2]
        if full in PACKAGES or is_icon(full):
            return True
        return word[:1].isupper() and any(
            f"{name}.".startswith(f"{full}.") or f"{full}.".startswith(f"{name}.")
            for library in self.libraries
            for name in library.packages
        )


def _has(cls: Any, name: str) -> bool:
    """Whether a class of a library takes a modifier of this name."""
    if not (isinstance(cls, type) and issubclass(cls, Component)):
        return name in getattr(cls, "declarations", ())
    return name in (*cls._declared, *cls.UNUSED, *cls.OUTER) or is_structural(cls, name)
