"""Pages that are put together piece by piece, as examples and studies do: text, tables, equations and figures."""

from __future__ import annotations

import io
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import sympy as sp

from acausal.files import need_path, write_files
from acausal.reporting.document.content import (
    Block,
    Drawing,
    EquationList,
    PageContent,
    Section,
    Tab,
    Text,
    table,
)
from acausal.reporting.document.render import render

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Page:
    """A page under construction; every method appends to it.

    Arguments:
        title: headline of the page. lead: a sentence or two below it.
    """

    def __init__(self, title: str, lead: str = "") -> None:
        self.title, self.lead = title, lead
        self._sections: list[tuple[str, list[Block]]] = [("", [])]

    def section(self, title: str) -> None:
        """A heading."""
        self._sections.append((title, []))

    def add(self, block: Block) -> None:
        """Any part of a page."""
        self._sections[-1][1].append(block)

    def text(self, text: str) -> None:
        """A paragraph."""
        self.add(Text(text))

    def table(
        self,
        header: Sequence[str],
        rows: Iterable[Sequence[Any]],
        passed: Sequence[bool | None] = (),
    ) -> None:
        """A table; ``passed`` marks rows as a target hit (True) or missed (False)."""
        self.add(table(header, list(rows), passed))

    def equations(
        self, equations: Sequence[sp.Equality], names: Mapping[str, str] | None = None
    ) -> None:
        """Equations in short names; ``names`` chooses some of them, such as ``{"body.m": "m_b"}``."""
        self.add(EquationList(tuple((e.lhs, e.rhs) for e in equations), names or {}))

    def figure(self, figure: Figure, caption: str, save: Path | None = None) -> None:
        """A matplotlib figure, embedded, and also saved as PNG where a path is given."""
        written = io.BytesIO()
        figure.savefig(written, format="png", dpi=140, bbox_inches="tight")
        if save is not None:
            write_files({save: written.getvalue()})
        self.add(Drawing(written.getvalue(), caption))

    def drawing(self, svg: str, caption: str) -> None:
        """An SVG drawing, such as that of `acausal.diagram`, and a caption."""
        self.add(Drawing(svg, caption))

    def write(self, path: str | Path, footer: str = "") -> Path:
        """Write the page and create its folder.

        Raises:
            DataError: if it cannot be written.
        """
        path = need_path(path, "write")
        sections = tuple(Section(title, tuple(blocks)) for title, blocks in self._sections)
        content = PageContent(self.title, self.lead, "", (), (Tab("", sections),), footer)
        write_files({path: render(content)}, make_folders=True)
        return path


def write_json(path: str | Path, content: Any) -> Path:
    """Write figures as JSON and create the folder.

    Raises:
        DataError: if the file cannot be written.
    """
    path = need_path(path, "write_json")
    write_files({path: json.dumps(content, indent=2) + "\n"}, make_folders=True)
    return path
