"""Libraries of components: how a file's class names find Python classes.

A library is a module. A class in it is found by its Python path, ``my_library.springs.CubicSpring``, and, where the
module has a ``CATALOG``, by Modelica's name. These attributes of the module are read:

- ``CATALOG``: Modelica's packages, each with the Python module that holds its classes and their names, such as
  ``{"Modelica.Blocks.Math": ("blocks", ("Gain", "Add"))}``.
- ``RECORDS``: constants and records by the last word of their name, such as ``{"Water": Water}``.
- ``ENUMERATIONS``: names of enumeration types; their values are read as the last word, a text.

Installed packages announce theirs as an entry point of the group ``acausal.libraries``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import entry_points
from types import ModuleType
from typing import Any

from acausal.component import Component, Connector


@dataclass(frozen=True)
class Library:
    """The classes and constants of one module, by the names that files use."""

    module: ModuleType

    @cached_property
    def modelica_names(self) -> dict[str, str]:
        """Modelica's name of a class -> its Python path within the library, for the classes that exist."""
        catalog: dict[str, tuple[str, tuple[str, ...]]] = getattr(self.module, "CATALOG", {})
        return {
            f"{package}.{name}": f"{self.module.__name__}.{place}.{name}"
            for package, (place, names) in catalog.items()
            for name in names
            if self._python(f"{self.module.__name__}.{place}.{name}") is not None
        }

    @cached_property
    def written_names(self) -> dict[type, str]:
        """The name that a class is written with: Modelica's where there is one."""
        found: dict[type, str] = {}
        for modelica, path in self.modelica_names.items():
            found.setdefault(self._python(path), modelica)
        return found

    def find(self, name: str) -> Any:
        """The class of a full name, or None."""
        return self._python(self.modelica_names.get(name, name))

    def name_of(self, cls: type) -> str | None:
        """The full name of a class, or None if it is not of this library."""
        if cls in self.written_names:
            return self.written_names[cls]
        own = self.module.__name__
        path = f"{cls.__module__}.{cls.__qualname__}"
        if cls.__module__ == own or cls.__module__.startswith(f"{own}."):
            return path if self._python(path) is cls else None
        return None

    def constant(self, name: str) -> Any:
        """A record, a constant or the value of an enumeration, by its full name; None if there is none."""
        words = name.removesuffix("()").split(".")
        records: dict[str, Any] = getattr(self.module, "RECORDS", {})
        if words[-1] in records:
            return records[words[-1]]
        enumerations: tuple[str, ...] = getattr(self.module, "ENUMERATIONS", ())
        return words[-1] if len(words) > 1 and words[-2] in enumerations else None

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
        return value if isinstance(value, type) and issubclass(value, Component | Connector) else None


def installed() -> tuple[Library, ...]:
    """The libraries that installed packages announce."""
    points = sorted(entry_points(group="acausal.libraries"), key=lambda point: point.name)
    return tuple(Library(point.load()) for point in points)
