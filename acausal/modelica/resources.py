"""Files that a model names: by a path, or by an address ``modelica://Package/file`` or ``file:///path``."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from acausal.errors import shortened
from acausal.modelica.meanings import PATH_HINT
from acausal.modelica.operators import Frame


def path_of(text: str, frame: Frame, wrong: Callable[[str], Exception]) -> str:
    """The path that an address means; a path as it is.

    Raises:
        ModelicaError: as `wrong` makes it, for a package of which no folder is known.
    """
    scheme, _, rest = text.partition("://")
    if scheme.lower() == "file":
        path = unquote(rest)
        return path[1:] if path[2:3] == ":" else path  # a drive of Windows
    if scheme.lower() != "modelica":
        return text
    package, _, rest = rest.partition("/")
    folder = _folder(frame.node.tree.resolve(package))
    if folder is None:
        raise wrong(f"there is no folder of a package '{shortened(package)}'; {PATH_HINT}")
    return str(folder / unquote(rest))


def found_file(text: str, frame: Frame, wrong: Callable[[str], Exception]) -> str:
    """The path of a file: looked for beside the text that names it, beside that of the models around, and here.

    Raises:
        ModelicaError: as `wrong` makes it, if there is none.
    """
    path = path_of(text, frame, wrong)
    folders = dict.fromkeys((*filter(None, _around(frame)), Path.cwd()))
    for folder in folders:
        if (folder / path).is_file():
            return str(folder / path)
    where = "" if Path(path).is_absolute() else f" in {' or '.join(map(str, folders))}"
    raise wrong(f"there is no file '{shortened(path, 200)}'{where}")


def _around(frame: Frame) -> Iterator[Path | None]:
    yield _folder(frame.node)
    build = frame.build
    while build is not None:
        yield _folder(build.node)
        build = build.above


def _folder(node: Any) -> Path | None:
    """The folder of a package, or of the file that has the text of a class."""
    source = getattr(node, "source", None)
    return getattr(node, "folder", None) or (source and source.folder)
