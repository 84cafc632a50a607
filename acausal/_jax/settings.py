"""JAX's settings, made as soon as JAX is imported, so that what needs no JAX need not wait for it."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from types import ModuleType

from acausal.errors import AcausalError


def configure_with_jax() -> None:
    """Make JAX's settings as soon as JAX is imported, whoever imports it; at once if it has been."""
    if "jax" in sys.modules:
        configure()
    elif not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())


def configure() -> None:
    """Compute in double precision, compile small loops as a whole, keep compiled programs between processes.

    A ``JAX_ENABLE_X64`` of the user's stays as it is: `need_double_precision` says what needs it.
    """
    import jax
    from jaxlib.version import __version__ as jaxlib_version

    from acausal._jax import compilation_cache, xla

    if "JAX_ENABLE_X64" not in os.environ:
        jax.config.update("jax_enable_x64", True)
    xla.choose_options(
        os.environ, jaxlib_version, other_devices=find_spec("jax_plugins") is not None
    )
    compilation_cache.begin(os.environ)


def need_double_precision() -> None:
    """Refuse to compute after double precision was switched off.

    Raises:
        AcausalError: with what to do instead.
    """
    import jax

    if not jax.config.jax_enable_x64:  # pyright: ignore[reportAttributeAccessIssue]
        raise AcausalError(
            "JAX's double precision is switched off, by JAX_ENABLE_X64 or after the import of acausal, which needs it "
            "to find initial values: jax.config.update('jax_enable_x64', True); to simulate or fit in single "
            "precision, give dtype='float32'."
        )


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
        configure()

    vars(loader)["exec_module"] = execute_and_configure
