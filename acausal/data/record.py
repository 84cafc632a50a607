"""Measured data: one record of named signals over one time base."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast, get_args

import numpy as np
from jaxtyping import Float
from numpy.typing import ArrayLike

from acausal.data.signal import Interpolation, Signal, check_samples, check_time_base, is_uniform
from acausal.errors import DataError, listing, nearest
from acausal.units import convert

if TYPE_CHECKING:
    from acausal.system import System

HEADER = re.compile(r"\s*(?P<name>[^\[\]]*?)\s*(?:\[(?P<unit>[^\[\]]*)\])?\s*")
"""A column's header: ``name`` or ``name [unit]``."""


@dataclass(frozen=True, eq=False)
class Data:
    """A record of measured signals.

    Arguments:
        time: sample times, shape (n,), strictly increasing; in seconds unless ``units["time"]`` says
            otherwise.
        signals: samples by name, each of shape (n,).
        units: unit of every signal by name; by default the model's units are assumed.
        interpolation: of inputs between samples, one choice for all or by name, as of an
            `acausal.Signal`: ``"linear"`` (the default), ``"previous"``, ``"cubic"`` or ``"band-limited"``.

    Raises:
        DataError: for a time base that does not increase, samples that are missing or not finite,
            a signal without a unit where others have one, an unknown interpolation.
    """

    time: Float[np.ndarray, " n"]
    signals: Mapping[str, Float[np.ndarray, " n"]]
    units: Mapping[str, str] | None = None
    interpolation: str | Mapping[str, str] = "linear"

    def __init__(
        self,
        time: ArrayLike,
        signals: Mapping[str, ArrayLike],
        units: Mapping[str, str] | None = None,
        interpolation: str | Mapping[str, str] = "linear",
    ) -> None:
        unit_of_time = (units or {}).get("time", "s")
        ts = np.asarray(time)
        check_time_base(ts, "The record")
        ts = convert(ts.astype(float), unit_of_time, "s", "'time'")
        for name, values in signals.items():
            check_samples(values, ts.shape, f"'{name}'")
        if units is not None:
            _check_units(units, signals)
            units = {n: u for n, u in units.items() if n != "time"}
        _check_interpolation(interpolation, signals)
        columns = {n: np.asarray(v, float) for n, v in signals.items()}
        for field, value in (
            ("time", ts),
            ("signals", columns),
            ("units", units),
            ("interpolation", interpolation),
        ):
            object.__setattr__(self, field, value)

    @classmethod
    def of(cls, record: Data | Mapping[str, Any]) -> Data:
        """A record as it is, or made from a plain mapping ``{"time": ..., name: ...}``."""
        if isinstance(record, Data):
            return record
        if not isinstance(record, Mapping):
            raise DataError(f"A record is acausal.Data or a mapping, not {record!r:.80}")
        if "time" not in record:
            raise DataError(f"The record has no 'time': {nearest('time', record)}")
        return cls(record["time"], {n: v for n, v in record.items() if n != "time"})

    @classmethod
    def from_csv(cls, path: str | Path) -> Data:
        """Read a file whose first line names the columns, as ``name`` or ``name [unit]``.

        One column is called ``time``. Either every column has a unit or none has.

        Raises:
            DataError: for a file that cannot be read, with the line's number.
        """
        try:
            with Path(path).open(newline="", encoding="utf-8-sig") as file:
                lines = [(number, row) for number, row in enumerate(csv.reader(file), 1) if row]
        except (OSError, UnicodeDecodeError, csv.Error) as e:
            raise DataError(f"{path} cannot be read: {e}") from None
        if not lines:
            raise DataError(f"{path} is empty; its first line must name the columns.")
        (number, header), *rows = lines
        names, units = _columns(header, f"{path}, line {number}")
        values = np.array([_numbers(row, names, f"{path}, line {n}") for n, row in rows])
        if "time" not in names:
            raise DataError(f"{path} has no column 'time': {nearest('time', names)}")
        columns = dict(zip(names, values.reshape(len(rows), len(names)).T, strict=True))
        try:
            return cls(columns.pop("time"), columns, units or None)
        except DataError as e:
            raise DataError(f"{path}: {e}") from None

    def for_system(self, system: System) -> Data:
        """The record in the model's units.

        Raises:
            DataError: for a name that is not a variable of the model, or a unit of another dimension.
        """
        known = (*system.variables, *system.inputs)
        unknown = [n for n in self.signals if n not in known]
        if unknown:
            raise DataError(
                f"The data have {listing(unknown)}, but the model does not: "
                f"{nearest(unknown[0], known)} Leave others out by data.select([...])."
            )
        if self.units is None:
            return self
        given = self.units
        return Data(
            self.time,
            {n: convert(v, given[n], system.unit(n), f"'{n}'") for n, v in self.signals.items()},
            interpolation=self.interpolation,
        )

    def columns(self, names: Iterable[str], purpose: str) -> Float[np.ndarray, "n n_names"]:
        """The named signals side by side; ``purpose`` is what they are needed for, in an error.

        Raises:
            DataError: if the record lacks signals; it lists them.
        """
        names = tuple(names)
        missing = [n for n in names if n not in self.signals]
        if missing:
            raise DataError(f"The data lack {listing(missing)}, {purpose}.")
        if not names:
            return np.zeros((len(self), 0))
        return np.stack([self.signals[n] for n in names], axis=1)

    def signal(self, name: str) -> Signal:
        """A signal as a function of time."""
        chosen = self.interpolation
        kind = chosen if isinstance(chosen, str) else chosen.get(name, "linear")
        return Signal(self.time, self[name], cast(Interpolation, kind), name=name)

    def between(self, start: float, end: float) -> Data:
        """The samples with ``start <= time <= end``.

        Raises:
            DataError: if there are fewer than two.
        """
        inside = (self.time >= start) & (self.time <= end)
        if inside.sum() < 2:
            raise DataError(
                f"No two samples lie between {start:g} and {end:g} s; the record goes from "
                f"{self.time[0]:g} to {self.time[-1]:g} s."
            )
        return self._with(self.time[inside], {n: v[inside] for n, v in self.signals.items()})

    def select(self, names: Iterable[str]) -> Data:
        """The record with only the named signals."""
        names = tuple(names)
        for name in names:
            if name not in self.signals:
                raise DataError(f"The record has no '{name}': {nearest(name, self.signals)}")
        return self._with(self.time, {n: self.signals[n] for n in names})

    def _with(self, time: np.ndarray, signals: Mapping[str, np.ndarray]) -> Data:
        units = None if self.units is None else {n: self.units[n] for n in signals}
        chosen = self.interpolation
        if not isinstance(chosen, str):
            chosen = {n: kind for n, kind in chosen.items() if n in signals}
        return Data(time, signals, units, chosen)

    @property
    def uniform(self) -> bool:
        """Whether the samples are equally spaced in time."""
        return is_uniform(self.time)

    @property
    def sample_time(self) -> float:
        """Mean time between samples, in seconds."""
        return float(self.time[-1] - self.time[0]) / (len(self.time) - 1)

    def __getitem__(self, name: str) -> Float[np.ndarray, " n"]:
        if name not in self.signals:
            raise DataError(f"The record has no '{name}': {nearest(name, self.signals)}")
        return self.signals[name]

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        spacing = f"{self.sample_time:g} s" if self.uniform else "an uneven time base"
        return (
            f"Data({len(self)} samples at {spacing}, {self.time[0]:g} to {self.time[-1]:g} s: "
            f"{listing(self.signals)})"
        )


def _check_units(units: Mapping[str, str], signals: Mapping[str, Any]) -> None:
    without = [n for n in signals if n not in units]
    if without:
        raise DataError(
            f"{listing(without)} have no unit while other signals have one; give units to all."
        )
    extra = [n for n in units if n not in signals and n != "time"]
    if extra:
        raise DataError(
            f"There are units for {listing(extra)} but no such signal: {nearest(extra[0], signals)}"
        )


def _check_interpolation(given: str | Mapping[str, str], signals: Mapping[str, Any]) -> None:
    by_name = {"The record": given} if isinstance(given, str) else given
    for name, kind in by_name.items():
        if kind not in get_args(Interpolation):
            raise DataError(
                f"{name} has interpolation={kind!r}; choose one of {', '.join(get_args(Interpolation))}."
            )
        if not isinstance(given, str) and name not in signals:
            raise DataError(
                f"There is an interpolation for '{name}' but no such signal: {nearest(name, signals)}"
            )


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
