"""Module paths that have moved: the old ones work for one release, with a `DeprecationWarning` that names the new ones.

Python uses the finder below only for modules that it finds nowhere else.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any


@dataclass(frozen=True)
class Moved:
    """Where the names of an old module are now.

    Attributes:
        module: the new module.
        renamed: old name -> new name, for those that differ.
    """

    module: str
    renamed: Mapping[str, str] = field(default_factory=dict)


MOVED = {
    "acausal.bands": Moved(
        "acausal.data.band_limited",
        {"bow": "deviation_from_line", "bends": "polynomial_coefficients"},
    ),
    "acausal.expressions": Moved("acausal.netlist.parser"),
    "acausal.formula": Moved("acausal.analysis.formula"),
    "acausal.library": Moved("acausal.netlist.library"),
    "acausal.plot": Moved(
        "acausal.reporting",
        {name: f"plot_{name}" for name in ("band", "guides", "learned", "losses", "modifiers")},
    ),
    "acausal.report": Moved("acausal.reporting"),
    "acausal.training.regularizers": Moved("acausal.training.objective.regularizers"),
}
"""Old module paths that README, docs or docstrings of public names mentioned."""


def install() -> None:
    """Let Python find the old paths."""
    if not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.append(_Finder())


class _Finder(MetaPathFinder):
    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The spec of a module that has moved."""
        return ModuleSpec(fullname, _Loader(MOVED[fullname])) if fullname in MOVED else None


class _Loader(Loader):
    """Makes a module that looks its names up in the new one."""

    def __init__(self, moved: Moved) -> None:
        self.moved = moved

    def create_module(self, spec: ModuleSpec) -> None:
        """An ordinary empty module will do."""

    def exec_module(self, module: ModuleType) -> None:
        """Let the module look its names up, with a warning for each."""
        old, new = module.__name__, self.moved.module

        def find(name: str) -> Any:
            if name.startswith("__"):
                raise AttributeError(f"module '{old}' has no attribute '{name}'")
            found = getattr(import_module(new), now := self.moved.renamed.get(name, name))
            message = f"{old}.{name} has moved: use {new}.{now}; the old path will be removed in the next release"
            warnings.warn(message, DeprecationWarning, stacklevel=2)
            return found

        module.__doc__ = f"Moved to `{new}`."
        module.__dict__["__getattr__"] = find
