"""Many files at once: a pattern or a list of paths, and the names of their records."""

from __future__ import annotations

import glob
import os
from collections import Counter
from pathlib import Path

from acausal.errors import DataError, shown
from acausal.files import need_path


def files(given: object, function: str) -> Path | dict[str, Path]:
    """The path of one file, or those of many by the names of their records.

    Arguments:
        given: a path, a pattern such as ``"runs/*.csv"``, or a list of paths.
        function: that was called with it, for a message.

    Returns:
        Many files are called by their names without the ending; where these do not differ, by their paths below
        their common folder, without the ending. Those of a pattern are sorted.

    Raises:
        DataError: for what is not a path, and where there are no files.
    """
    if isinstance(given, list | tuple):
        paths = [need_path(path, function) for path in given]
    else:
        path = need_path(given, function)
        if not glob.has_magic(str(path)) or path.exists():
            return path
        found = glob.glob(str(path), recursive=True)  # noqa: PTH207 (a pattern may be absolute)
        paths = [Path(name) for name in sorted(found)]
    if not paths:
        raise DataError(f"{function}: no files at {shown(str(given))}; give at least one.")
    return dict(zip(_names(paths, function), paths, strict=True))


def _names(paths: list[Path], function: str) -> list[str]:
    stems = [path.stem for path in paths]
    if len(set(stems)) == len(stems):
        return stems
    folder = os.path.commonpath([path.absolute().parent for path in paths])
    names = [path.absolute().relative_to(folder).with_suffix("").as_posix() for path in paths]
    doubled = next((name for name, count in Counter(names).items() if count > 1), None)
    if doubled is not None:
        raise DataError(f"{function}: two files are called '{doubled}'; leave one out.")
    return names
