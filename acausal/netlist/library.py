"""Libraries of components: how a file's class names find Python classes.

A library is a module. A class in it is found by its Python path, ``my_library.springs.CubicSpring``, and by Modelica's
name where the library lists one. These attributes of the module are read:

- ``MODELICA_NAMES``: Modelica's names of classes, each with the Python path below the module, such as
  ``{"Modelica.Blocks.Math.Gain": "Gain"}``.
- ``MODELICA``: packages of Modelica, each with the module below this one whose ``MODELICA_NAMES`` has its classes,
  such as ``{"Modelica.Blocks": "blocks"}``. That module is imported when a file names one of them.
- ``NOT_COVERED``: packages of Modelica, each with the names of classes that are not there, such as
  ``{"Modelica.Blocks.Math": "Exponentiation"}``.
- ``RENAMED``: earlier names of classes of Modelica, each with the present one.
- ``ALSO_CALLED``: what else classes are called, words by the Python path below the module, such as
  ``{"blocks.Hysteresis": "thermostat"}``, for `acausal.find`.
- ``RECORDS``: constants and records by the last word of their name, or the last two, such as ``{"Water": Water()}``.
- ``FUNCTIONS``: functions of numbers that expressions may call, by the last word of their name.
- ``ENUMERATIONS``: names of enumeration types; their values are read as the last word, a text.

Installed packages announce theirs as an entry point of the group ``acausal.libraries``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, is_dataclass
from difflib import get_close_matches
from functools import cache, cached_property
from importlib import import_module
from importlib.metadata import entry_points
from types import ModuleType
from typing import Any

from acausal.errors import nearest
from acausal.modeling import Component, Connector, Input, Output


@dataclass(frozen=True)
class Library:
    """The classes and constants of one module, by the names that files use."""

    module: ModuleType

    @cached_property
    def modelica_names(self) -> dict[str, str]:
        """Modelica's name of a component, connector or signal -> its Python path; imports all packages."""
        names = dict(self._listed)
        for place in self._packages.values():
            names |= self._names(place)
        return {name: path for name, path in names.items() if self._python(path) is not None}

    @cached_property
    def written_names(self) -> dict[type, str]:
        """The name that a class is written with: Modelica's where there is one."""
        found: dict[type, str] = {}
        for name, path in self.modelica_names.items():
            found.setdefault(self._python(path), name)
        return found

    def find(self, name: str) -> Any:
        """The class of a full name, or None."""
        renamed: dict[str, str] = getattr(self.module, "RENAMED", {})
        name, names = renamed.get(name, name), self._listed
        for package, place in self._packages.items():
            if name.startswith(f"{package}."):
                names = self._names(place)
        return self._python(names.get(name, name))

    def has_package(self, name: str) -> bool:
        """Whether classes that the library covers are in a package of this name, or below it."""
        for package, place in self._packages.items():
            if f"{package}.".startswith(f"{name}."):
                return True
            if name.startswith(f"{package}."):
                return any(known.startswith(f"{name}.") for known in self._names(place))
        return any(known.startswith(f"{name}.") for known in self._listed)

    def lacks(self, name: str) -> bool:
        """Whether Modelica has a class of this name that the library does not cover."""
        package, _, word = name.rpartition(".")
        not_covered: dict[str, str] = getattr(self.module, "NOT_COVERED", {})
        return name in self._listed or word in not_covered.get(package, "").split()

    def name_of(self, cls: type) -> str | None:
        """The full name of a class, or None if it is not of this library."""
        if cls in self.written_names:
            return self.written_names[cls]
        modules = cls.__module__.split(".")
        for length in range(1, len(modules) + 1):  # the shortest path that leads there
            path = ".".join((*modules[:length], cls.__qualname__))
            if self._python(path) is cls:
                return path
        return None

    def constant(self, name: str) -> Any:
        """A record, a constant, the value of an enumeration or, with ``()``, a function; None if there is none."""
        words = name.removesuffix("()").split(".")
        for known in (".".join(words[-2:]), words[-1]):
            if known in self.records:
                return self.records[known]
        if name.endswith("()"):
            return getattr(self.module, "FUNCTIONS", {}).get(words[-1])
        return words[-1] if len(words) > 1 and self.is_enumeration(words[-2]) else None

    def is_enumeration(self, name: str) -> bool:
        """Whether this is a type whose values are texts."""
        return name.rpartition(".")[2] in getattr(self.module, "ENUMERATIONS", ())

    def constant_name(self, value: Any) -> str | None:
        """How a record is written, or None if this library does not know it."""
        for name, record in self.records.items():
            if type(record) is type(value) and is_dataclass(record):
                changed = [
                    f"{field.name.rstrip('_')}={given!r}"
                    for field in fields(record)
                    if (given := getattr(value, field.name)) != getattr(record, field.name)
                ]
                return f"{name}({', '.join(changed)})"
        return None

    @cached_property
    def records(self) -> dict[str, Any]:
        """Constants and records by the last word of their name, or the last two."""
        return getattr(self.module, "RECORDS", {})

    @property
    def also_called(self) -> dict[str, str]:
        """What else classes are called, by their Python path below the module."""
        return getattr(self.module, "ALSO_CALLED", {})

    @property
    def _packages(self) -> dict[str, str]:
        return getattr(self.module, "MODELICA", {})

    @cached_property
    def packages(self) -> tuple[str, ...]:
        """Packages of Modelica whose classes it has."""
        return (*self._packages, *dict.fromkeys(n.rpartition(".")[0] for n in self._listed))

    @cached_property
    def _listed(self) -> dict[str, str]:
        """Modelica's name of a class -> its Python path, from the module itself."""
        return self._paths(self.module)

    def _names(self, place: str) -> dict[str, str]:
        """The same from a module below it."""
        return self._paths(import_module(f"{self.module.__name__}.{place}"))

    def _paths(self, module: ModuleType) -> dict[str, str]:
        names: dict[str, str] = getattr(module, "MODELICA_NAMES", {})
        return {name: f"{module.__name__}.{path}" for name, path in names.items()}

    def _python(self, path: str) -> Any:
        """A public class by its Python path, reached through the library's own modules only."""
        own = self.module.__name__
        if not path.startswith(f"{own}."):
            return None
        value: Any = self.module
        for word in path[len(own) + 1 :].split("."):
            if word.startswith("_") or not isinstance(value, ModuleType):
                return None
            value = getattr(value, word, None)
            if isinstance(value, ModuleType) and not value.__name__.startswith(f"{own}."):
                return None
        return value if is_element(value) else None


def is_element(value: Any) -> bool:
    """Whether a file may name this: a class of components or connectors, or a signal."""
    return isinstance(value, type) and (
        issubclass(value, Component | Connector) or value in (Input, Output)
    )


def find_class(libraries: Sequence[Library], name: str) -> Any:
    """The class of a full name.

    Raises:
        KeyError: with a clause that names the nearest known class.
    """
    for library in libraries:
        found = library.find(name)
        if found is not None:
            return found
    if any(library.lacks(name) for library in libraries):
        raise KeyError("the library does not cover it yet")
    known = [n for library in libraries for n in library.modelica_names]
    same = [n for n in known if n.rpartition(".")[2] == name.rpartition(".")[2]]
    if same or get_close_matches(name[:200], known, n=1):
        raise KeyError(nearest(name, same or known))
    modules = ", ".join(library.module.__name__ for library in libraries) or "none is installed"
    raise KeyError(f"name it as Modelica does, or by its Python path within a library ({modules})")


@cache
def installed() -> tuple[Library, ...]:
    """The libraries that installed packages announce."""
    points = sorted(entry_points(group="acausal.libraries"), key=lambda point: point.name)
    return tuple(Library(point.load()) for point in points)
