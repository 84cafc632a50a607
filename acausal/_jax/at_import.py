"""JAX's settings are made when JAX is imported, so that what needs no JAX need not wait for it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType


def configure_with_jax() -> None:
    """Make JAX's settings as soon as JAX is imported, whoever imports it; at once if it has been."""
    if "jax" in sys.modules:
        _configure()
    elif not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())


def _configure() -> None:
    from acausal._jax.settings import configure

    configure()


class _Finder(MetaPathFinder):
    """Finds JAX where the other finders do, and lets the settings follow its import."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The spec of JAX; None for any other module."""
        if fullname != "jax":
            return None
        others = (finder for finder in sys.meta_path if finder is not self)
        found = (finder.find_spec(fullname, path, target) for finder in others)
        spec = next((spec for spec in found if spec is not None), None)
        if spec is not None and spec.loader is not None:
            _follow(spec.loader)
        return spec


def _follow(loader: Loader) -> None:
    """Let the settings follow what a loader executes; it is JAX's own, and loads nothing else."""
    execute = loader.exec_module

    def execute_and_configure(module: ModuleType) -> None:
        execute(module)
        _configure()

    vars(loader)["exec_module"] = execute_and_configure
