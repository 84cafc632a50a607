"""A bare environment: an installed wheel and what it declares to need, and nothing of what tests need besides.

Nothing is downloaded: the packages are links to those of the present environment.
"""

from __future__ import annotations

import sysconfig
import venv
from collections.abc import Iterable, Iterator
from importlib.metadata import Distribution, PathDistribution, distribution
from pathlib import Path

from packaging.requirements import Requirement


def environment(folder: Path, requirements: Iterable[str]) -> Path:
    """A new environment with pip and what is required; returns its interpreter."""
    venv.create(folder, with_pip=True)
    name = f"python{sysconfig.get_python_version()}"
    site = folder / "lib" / name / "site-packages"
    for found in closure(requirements):
        for part in top_level(found):
            if not (site / part).exists():
                (site / part).symlink_to(Path(str(found.locate_file(part))))
    return folder / "bin" / "python"


def requirements_of(metadata: Path) -> list[str]:
    """The requirements that a wheel's unpacked ``.dist-info`` declares."""
    return PathDistribution(metadata).requires or []


def closure(requirements: Iterable[str]) -> Iterator[Distribution]:
    """The installed packages that are required, directly or not, without extras that nobody asks for."""
    seen: set[tuple[str, str]] = set()
    todo = [(Requirement(text), "") for text in requirements]
    while todo:
        wanted, extra = todo.pop()
        if wanted.marker is not None and not wanted.marker.evaluate({"extra": extra}):
            continue
        for asked in ("", *sorted(wanted.extras)):
            if (wanted.name, asked) in seen:
                continue
            seen.add((wanted.name, asked))
            found = distribution(wanted.name)
            todo += [(Requirement(text), asked) for text in found.requires or []]
            if not asked:
                yield found


def top_level(found: Distribution) -> set[str]:
    """The files and folders in site-packages that a package consists of."""
    parts = {file.parts[0] for file in found.files or ()}
    return {part for part in parts if part not in ("..", "__pycache__", "bin")}
