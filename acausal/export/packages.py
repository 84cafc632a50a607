"""The packages that exports need."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from acausal.errors import DataError


def need_package(name: str, function: str) -> ModuleType:
    """An optional package.

    Raises:
        DataError: where it is not installed, with the command that installs it.
    """
    try:
        return import_module(name)
    except ImportError:
        raise DataError(
            f"export.{function} needs the package '{name.partition('.')[0]}'; "
            "install it: pip install 'acausal[export]'"
        ) from None
