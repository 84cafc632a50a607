"""How a CSV file is written: what separates its columns, and its decimal mark."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

from acausal.errors import DataError, shown

SEPARATORS = {";": "semicolons", "\t": "tabs", ",": "commas", " ": "blanks"}
"""What may separate columns, in the order in which a header is searched for it."""

MARKS = {".": "a decimal point", ",": "a decimal comma"}

WITH_COMMA = re.compile(r"\s*[+-]?\d*,\d+(?:[eE][+-]?\d+)?\s*")
IN_BRACKETS = re.compile(r"\[[^\[\]]*\]|\"[^\"]*\"")
BLANKS = re.compile(r"[^\s\[]+(?:\s*\[[^\[\]]*\])?")


@dataclass(frozen=True)
class Dialect:
    """A separator and a decimal mark; ``str`` says them for a message."""

    separator: str
    decimal: str
    is_guess: bool

    def cells(self, line: str) -> list[str]:
        """The cells of a line with numbers."""
        if self.separator == " ":
            return line.split()
        return next(csv.reader([line.rstrip("\r\n")], delimiter=self.separator), [])

    def header(self, line: str) -> list[str]:
        """The cells of the line with the names; a unit in brackets belongs to the name before it."""
        return BLANKS.findall(line) if self.separator == " " else self.cells(line)

    def __str__(self) -> str:
        how = "guessed" if self.is_guess else "told"
        return f"{how}: columns separated by {SEPARATORS[self.separator]}, {MARKS[self.decimal]}"


def dialect_of(
    header: str, rows: Sequence[str], separator: str | None, decimal: str | None
) -> Dialect:
    """The dialect of a file, guessed where nothing is said.

    Arguments:
        header: the line with the names.
        rows: a few lines after it.
        separator: of the columns, one of `SEPARATORS`.
        decimal: mark, ``"."`` or ``","``.

    Raises:
        DataError: for an unknown separator or mark.
    """
    for what, given, known in (
        ("separator", separator, SEPARATORS),
        ("decimal", decimal, MARKS),
    ):
        if given is not None and given not in known:
            raise DataError(f"{what}={shown(given)}; choose one of {', '.join(map(repr, known))}.")
    is_guess = separator is None or decimal is None
    if separator is None:
        bare = IN_BRACKETS.sub("", header).strip(" \r\n")
        separator = next((s for s in SEPARATORS if s in bare), ",")
    if decimal is None:
        plain = Dialect(separator, ".", is_guess)
        cells = (cell for row in rows for cell in plain.cells(row))
        decimal = "," if any(WITH_COMMA.fullmatch(cell) for cell in cells) else "."
    return Dialect(separator, decimal, is_guess)
