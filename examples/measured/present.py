"""The command line, the table and the page of an example."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

import acausal as ac
from acausal.reporting import Page


@dataclass(frozen=True)
class Row:
    """A line of a table of errors.

    Attributes:
        model: its name. errors: by column; one that is not known is left out.
        spread: standard deviations, of those that have any.
    """

    model: str
    errors: Mapping[str, float]
    spread: Mapping[str, float] | None = None

    def cells(self, columns: Mapping[str, str]) -> list[str]:
        """The row as text, in order of the columns."""
        return [self.model, *(self._cell(name) for name in columns)]

    def _cell(self, name: str) -> str:
        if name not in self.errors:
            return ""
        spread = self.spread or {}
        around = f" ± {spread[name]:.2g}" if name in spread else ""
        return f"{self.errors[name]:.3g}{around}"


WIDE = 160
"""Columns of a table that is written to a file."""


def show(title: str, columns: Mapping[str, str], rows: Sequence[Row]) -> None:
    """Print a table; ``columns`` are headers by name of the error."""
    table = Table("", *map(escape, columns.values()), title=title)
    for row in rows:
        table.add_row(*map(escape, row.cells(columns)))
    Console(width=None if sys.stdout.isatty() else WIDE).print(table)


def opening(
    title: str,
    lead: str,
    built: ac.Component,
    equations: Any,
    errors: tuple[str, Mapping[str, str], Sequence[Row]],
) -> Page:
    """A page that begins with a model and its errors.

    Arguments:
        title, lead: of the page.
        built: what is drawn; ``equations``: those of its system.
        errors: what a table of them is headed, its ``columns`` as those of `show`, and its rows.
    """
    page, (corner, columns, rows) = Page(title, lead), errors
    page.section("The model")
    page.drawing(
        ac.diagram(built).svg, "The connected components; those that are tinted hold a network."
    )
    page.equations(equations)
    page.section("The result")
    page.table([corner, *columns.values()], [row.cells(columns) for row in rows])
    return page


def command(
    name: str, about: str, run: Callable[[Path | None, int, Path], Mapping[str, Any]]
) -> None:
    """Parse the command line, run an example, and print what it returns as one line of JSON."""
    parser = argparse.ArgumentParser(prog=f"python -m examples.{name}", description=about)
    parser.add_argument("--data", type=Path, help="folder with the data set's files")
    parser.add_argument("--seeds", type=int, default=5, help="trainings, each with other weights")
    parser.add_argument("--out", type=Path, default=Path("out") / name, help="where the page goes")
    given = parser.parse_args()
    if given.seeds < 1:
        parser.error(f"--seeds {given.seeds}: give one training or more")
    try:
        figures = run(given.data, given.seeds, given.out)
    except ac.DataError as error:
        sys.exit(str(error))
    print(json.dumps(figures))
