"""CSV files, read in blocks of lines, so that a large one needs no Python object for each of its numbers."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path
from typing import TextIO

import numpy as np
from jaxtyping import Float, Int

from acausal.data.readers.table import Selection, SignalTable, headers, need_time
from acausal.errors import DataError, need_text, reason, shown

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
        if given is not None and not (isinstance(given, str) and given in known):
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


LINES = 50_000
"""Lines of a block."""

GUESS = 100
"""Lines after the header from which the decimal mark is guessed."""

MISSING = ("", "nan", "na", "n/a", "null")
"""Cells of a missing sample, in lower case."""


def read_csv(
    path: Path,
    selection: Selection,
    *,
    separator: str | None = None,
    decimal: str | None = None,
    encoding: str = "utf-8-sig",
) -> SignalTable | dict[str, SignalTable]:
    """A table from a file whose first line that is not blank names the columns; or one of each run, by name.

    Raises:
        DataError: for a file that cannot be read, with the line's number.
    """
    need_text(encoding, "encoding")
    try:
        with path.open(encoding=encoding) as file:
            return _read(file, path, selection, separator, decimal)
    except LookupError:
        raise DataError(
            f"encoding={encoding!r} is not known; give one such as 'latin-1'."
        ) from None
    except UnicodeDecodeError as e:
        raise DataError(
            f"{path} cannot be read: it is not {e.encoding}; say encoding='latin-1' or another."
        ) from None
    except csv.Error as e:
        raise DataError(f"{path} cannot be read: {e}.") from None
    except OSError as e:
        raise DataError(f"{path} cannot be read: {reason(e)}.") from None


def _read(
    file: TextIO, path: Path, selection: Selection, separator: str | None, decimal: str | None
) -> SignalTable | dict[str, SignalTable]:
    lines = enumerate(file, 1)
    number, header = next(((n, line) for n, line in lines if line.strip()), (0, ""))
    if not number:
        raise DataError(f"{path} is empty; its first line must name the columns.")
    head = list(islice(lines, GUESS))
    rows = [line for _, line in head if line.strip()]
    dialect = dialect_of(header, rows, separator, decimal)
    cells = dialect.header(header)
    names, units = headers(cells, f"{path}, line {number}")
    selection = selection.with_bare_time(cells, names)
    need_time(selection, names, str(path))
    chosen = [selection.time, *selection.names(names, str(path))]
    blocks, runs = list[Float[np.ndarray, "rows columns"]](), list[str]()
    for block in chain([head], iter(lambda: list(islice(lines, LINES)), [])):
        blocks.append(_numbers(block, [names.index(n) for n in chosen], names, dialect, path))
        if selection.group is not None:
            place = names.index(selection.group)
            runs += [dialect.cells(line)[place].strip() for _, line in block if line.strip()]
    values = np.concatenate(blocks)
    unit_of_time = {"time": units[selection.time]} if selection.time in units else {}
    units = {n: u for n, u in units.items() if n != selection.time} | unit_of_time

    def table(rows: Int[np.ndarray, " rows"], source: str) -> SignalTable:
        columns = dict(zip(chosen, values[rows].T, strict=True))
        return selection.table(
            columns.pop(selection.time),
            columns,
            units,
            source,
            lambda row: f"line {_line_of(path, int(rows[row]), file.encoding)}",
        )

    if selection.group is None:
        return table(np.arange(len(values)), str(path))
    return {
        run: table(np.flatnonzero(np.asarray(runs) == run), f"{path}, run '{run}'")
        for run in dict.fromkeys(runs)
    }


def _numbers(
    block: Sequence[tuple[int, str]],
    chosen: list[int],
    names: list[str],
    dialect: Dialect,
    path: Path,
) -> Float[np.ndarray, "rows columns"]:
    """The numbers of a block: all at once if it holds nothing but numbers, otherwise cell by cell."""
    filled = [(number, line) for number, line in block if line.strip()]
    found = _at_once([line for _, line in filled], chosen, len(names), dialect)
    if found is not None:
        return found
    rows = [_row(line, chosen, names, dialect, f"{path}, line {n}") for n, line in filled]
    return np.array(rows).reshape(len(rows), len(chosen))


def _at_once(
    lines: list[str], chosen: list[int], width: int, dialect: Dialect
) -> Float[np.ndarray, "rows columns"] | None:
    """The numbers of lines that hold nothing but numbers; None for others."""
    mark = dialect.separator
    widths = {len(line.split()) if mark == " " else line.count(mark) + 1 for line in lines}
    if widths != {width}:
        return None
    if dialect.decimal == ",":
        if mark == "," or any("." in line for line in lines):
            return None
        lines = [line.replace(",", ".") for line in lines]
    try:
        return np.loadtxt(
            lines,
            comments=None,
            delimiter=None if mark == " " else mark,
            usecols=chosen,
            ndmin=2,
        )
    except ValueError:
        return None


def _row(
    line: str, chosen: list[int], names: list[str], dialect: Dialect, where: str
) -> list[float]:
    cells = dialect.cells(line)
    if len(cells) != len(names):
        raise DataError(f"{where}: {len(cells)} values for {len(names)} columns ({dialect}).")
    return [_number(cells[i], names[i], dialect, where) for i in chosen]


def _number(cell: str, name: str, dialect: Dialect, where: str) -> float:
    if cell.strip().lower() in MISSING:
        return np.nan
    is_foreign = "_" in cell or (dialect.decimal == "," and "." in cell)
    try:
        if not is_foreign:
            return float(cell.replace(",", ".") if dialect.decimal == "," else cell)
    except ValueError:
        pass
    raise DataError(f"{where}: '{cell.strip()}' in column '{name}' is not a number ({dialect}).")


def _line_of(path: Path, row: int, encoding: str) -> int:
    """The number of the line that holds a row; the file is read again, as only an error needs it."""
    with path.open(encoding=encoding) as file:
        filled = (number for number, line in enumerate(file, 1) if line.strip())
        return next(islice(filled, row + 1, None))
