"""What every reader returns, and how a user picks from it."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

import numpy as np

from acausal.data.by_signal import check_units
from acausal.data.samples import Place, sample
from acausal.errors import DataError, known_name, nearest, need_text, reason, shown
from acausal.modeling import by_name, names_in

HEADER = re.compile(r"\s*(?P<name>[^\[\]]*?)\s*(?:\[(?P<unit>[^\[\]]*)\])?\s*")
"""A column's header: ``name`` or ``name [unit]``."""


@dataclass(frozen=True)
class SignalTable:
    """Signals as read.

    Arguments:
        time: sample times; None if every signal has its own.
        signals: by name, samples or a pair (times, samples).
        units: by name, with that of ``"time"``; of all signals, or of none.
        source: names the file in errors; empty for an object in memory.
        place: names a sample in errors.
    """

    time: np.ndarray | None
    signals: Mapping[str, Any]
    units: Mapping[str, str]
    source: str = ""
    place: Place = sample


@dataclass(frozen=True)
class Selection:
    """What is read of a source, and under which names.

    Arguments:
        time: name of the column with the times.
        columns: the columns to read, besides the times; by default all.
        rename: names in the source, and what they are called in the record.
        units: units by name in the record; these count, not those of the source.
        group: name of a column that says which run a row belongs to; each run is a table of its own then.
    """

    time: str = "time"
    columns: Sequence[str] | None = None
    rename: Mapping[str, str] | None = None
    units: Mapping[str, str] | None = None
    group: str | None = None

    def names(self, known: Collection[str], source: str) -> list[str]:
        """The columns to read, without that of the times.

        Raises:
            DataError: for a choice of a column that the source does not have.
        """
        rename = by_name(self.rename, "rename", "{'column': 'mass.s'}")
        columns = None if self.columns is None else names_in(self.columns, "columns")
        group = () if self.group is None else (need_text(self.group, "group"),)
        for name in (*(columns or ()), *rename, *group):
            need_column(name, known, source)
        return [n for n in (known if columns is None else columns) if n not in (self.time, *group)]

    def with_bare_time(self, cells: Sequence[str], names: Sequence[str]) -> Self:
        """The selection with the name of the times where it has their whole header, ``name [unit]``.

        Arguments:
            cells: the headers of the source. names: the name in each.
        """
        whole = {cell.strip(): name for cell, name in zip(cells, names, strict=True)}
        known = isinstance(self.time, str) and self.time in whole
        return replace(self, time=whole[self.time]) if known else self

    def table(
        self,
        time: np.ndarray | None,
        signals: Mapping[str, Any],
        units: Mapping[str, str],
        source: str = "",
        place: Place = sample,
    ) -> SignalTable:
        """The chosen signals under the names that they have in the record.

        Arguments are those of `SignalTable`, by the names of the source; only ``"time"`` is called so already.

        Raises:
            DataError: if two signals get one name.
        """
        called = {n: names_in([(self.rename or {}).get(n, n)], "rename")[0] for n in signals}
        renamed: dict[str, Any] = {}
        for name, samples in signals.items():
            if called[name] in renamed or called[name] == "time":
                raise DataError(
                    f"rename: two columns{f' of {source}' if source else ''} are called '{called[name]}'."
                )
            renamed[called[name]] = samples
        found = {called.get(n, n): u for n, u in units.items() if n in signals or n == "time"}
        return SignalTable(time, renamed, {**found, **check_units(self.units)}, source, place)


def headers(cells: Sequence[str], where: str) -> tuple[list[str], dict[str, str]]:
    """Names and units of columns from ``name`` or ``name [unit]``.

    Raises:
        DataError: for a header of another form, and for two of one name.
    """
    names: list[str] = []
    units: dict[str, str] = {}
    for cell in cells:
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


def need_column(name: str, known: Collection[str], source: str) -> None:
    """Refuse a column that a source does not have."""
    known_name(name, known, f"{source} has no column")


def need_time(selection: Selection, known: Collection[str], source: str) -> None:
    """Refuse a source without the column of times."""
    if not isinstance(selection.time, str):
        raise DataError(
            f"time={shown(selection.time)} is not a column; give its name, such as 'time'."
        )
    if selection.time not in known:
        raise DataError(
            f"{source} has no column '{selection.time}': {nearest(selection.time, known)}"
            " Say time='...' if the times are called otherwise."
        )


def seconds(times: np.ndarray, first: Any = None) -> np.ndarray:
    """Durations and dates as seconds, dates from a ``first`` one, or from their own; other times as they are."""
    if times.dtype.kind == "M":
        times = times - (times[:1] if first is None else first)
    if times.dtype.kind != "m":
        return times
    found = times / np.timedelta64(1, "s")
    return np.asarray(found, float)


def beginning(path: Path, size: int) -> bytes:
    """The first bytes of a file.

    Raises:
        DataError: if it cannot be read.
    """
    try:
        with path.open("rb") as file:
            return file.read(size)
    except OSError as e:
        raise DataError(f"{path} cannot be read: {reason(e)}.") from None
