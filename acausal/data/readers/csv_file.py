"""CSV files."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np

from acausal.errors import DataError

HEADER = re.compile(r"\s*(?P<name>[^\[\]]*?)\s*(?:\[(?P<unit>[^\[\]]*)\])?\s*")
"""A column's header: ``name`` or ``name [unit]``."""


def read_csv(path: Path) -> tuple[dict[str, np.ndarray], dict[str, str]]:
    """The columns and their units."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            lines = [(number, row) for number, row in enumerate(csv.reader(file), 1) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as e:
        raise DataError(f"{path} cannot be read: {e}") from None
    if not lines:
        raise DataError(f"{path} is empty; its first line must name the columns.")
    (number, header), *rows = lines
    names, units = _columns(header, f"{path}, line {number}")
    values = np.array([_numbers(row, names, f"{path}, line {n}") for n, row in rows])
    return dict(zip(names, values.reshape(len(rows), len(names)).T, strict=True)), units


def _columns(header: list[str], where: str) -> tuple[list[str], dict[str, str]]:
    names: list[str] = []
    units: dict[str, str] = {}
    if len(header) == 1 and ";" in header[0]:
        raise DataError(f"{where}: columns are separated by semicolons; commas are needed.")
    for cell in header:
        match = HEADER.fullmatch(cell)
        if match is None or not match["name"]:
            raise DataError(
                f"{where}: '{cell}' is not a column header; write 'name' or 'name [unit]'."
            )
        name = match["name"]
        if name in names:
            raise DataError(f"{where}: two columns are called '{name}'.")
        names.append(name)
        if match["unit"] is not None:
            units[name] = match["unit"]
    return names, units


def _numbers(row: list[str], names: list[str], where: str) -> list[float]:
    if len(row) != len(names):
        raise DataError(f"{where}: {len(row)} values for {len(names)} columns.")
    try:
        return [float(cell) for cell in row]
    except ValueError:
        pass
    name, cell = next((n, c) for n, c in zip(names, row, strict=True) if not _is_number(c))
    raise DataError(f"{where}: '{cell}' in column '{name}' is not a number.")


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
