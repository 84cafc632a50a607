"""Libraries of components: how a file's class names find Python classes.

A library is a module with a mapping ``PACKAGES`` from prefixes of names to its modules, such as
``{"Modelica.Mechanics.Translational": translational}``. Installed packages announce theirs as an entry point of
the group ``acausal.libraries``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from types import ModuleType
from typing import Any

from acausal.component import Component, Connector
from acausal.errors import DeclarationError


@dataclass(frozen=True)
class Library:
    """Classes by the names that files use.

    Attributes:
        module: the library's module. packages: prefix of names -> module that holds the classes.
    """

    module: ModuleType
    packages: tuple[tuple[str, ModuleType], ...]

    @cached_property
    def names(self) -> dict[str, Any]:
        """Every name that a file may use for a class: Modelica's and Python's."""
        found: dict[str, Any] = {}
        for prefix, package in self.packages:
            for middle, name, value in _public(package):
                if isinstance(value, type) and issubclass(value, Component | Connector):
                    found.setdefault(
                        ".".join(p for p in (prefix, _modelica(middle), name) if p), value
                    )
                    found.setdefault(f"{package.__name__}.{name}", value)
        return found

    def find(self, name: str) -> Any:
        """The class of that full name, or None."""
        return self.names.get(name)
