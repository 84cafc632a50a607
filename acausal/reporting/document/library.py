"""The plot library that pages carry: d3, from the package mpld3. Without it plots are plain pictures."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

PACKAGE, FILES = "mpld3", "mpld3/js/d3.v*.min.js"
INSTALL = "pip install 'acausal[page]'"


def plot_library() -> str | None:
    """The text of d3, or None where it is not installed."""
    try:
        root = distribution(PACKAGE).locate_file("")
    except PackageNotFoundError:
        return None
    found = sorted(Path(str(root)).glob(FILES))
    return found[-1].read_text(encoding="utf-8") if found else None
