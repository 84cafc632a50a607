"""Where exports are written, and the packages that they need."""

from __future__ import annotations

import logging
from importlib import import_module
from pathlib import Path
from types import ModuleType

from acausal.errors import DataError, need_flag, need_path, reason

LOGGER = logging.getLogger(__name__)


def new_file(given: object, function: str, overwrite: bool) -> Path:
    """The path of a file that may be written.

    Arguments:
        given: what the user gave. function: that was called with it, for the message.
        overwrite: whether the file may exist.

    Raises:
        DataError: for what is no path, a path that exists, or a folder that does not.
    """
    path = need_path(given, f"export.{function}")
    if path.is_dir():
        raise DataError(f"export.{function}: '{path}' is a folder; give the path of a file.")
    overwrite = need_flag(overwrite, f"export.{function}: overwrite")
    if path.exists() and not overwrite:
        raise DataError(
            f"export.{function}: '{path}' exists; give another path, or overwrite=True."
        )
    if not path.parent.is_dir():
        raise DataError(f"export.{function}: there is no folder '{path.parent}'; make it first.")
    return path


def write(path: Path, content: str | bytes, function: str) -> None:
    """Write a file.

    Raises:
        DataError: with the operating system's reason.
    """
    data = content.encode() if isinstance(content, str) else content
    try:
        path.write_bytes(data)
        LOGGER.info("wrote %s, %d bytes", path, len(data))
    except OSError as error:
        raise DataError(f"export.{function}: cannot write '{path}': {reason(error)}.") from None


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
