"""Measured data: one record of named signals over one time base."""

from __future__ import annotations

import csv
import re
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard, get_args

import numpy as np
from jaxtyping import Float
from numpy.typing import ArrayLike

from acausal._jax import check_time
from acausal.by_name import ByName, names_in
from acausal.data.signal import (
    Beyond,
    Interpolation,
    Signal,
    check_samples,
    check_time_base,
    is_uniform,
)
from acausal.errors import DataError, listing, nearest, need_path, shown
from acausal.units import convert

if TYPE_CHECKING:
    from pandas import DataFrame

    from acausal.system import System

HEADER = re.compile(r"\s*(?P<name>[^\[\]]*?)\s*(?:\[(?P<unit>[^\[\]]*)\])?\s*")
"""A column's header: ``name`` or ``name [unit]``."""

Choices: TypeAlias = str | Mapping[str, str] | None
"""A choice for all signals, or choices by name; where there is none, the default."""


@dataclass(frozen=True, eq=False)
class Data(ByName):
    """A record of measured signals. ``data["mass.s"]`` is one, ``data[["mass.s", "mass.v"]]`` are two side by side.

    Arguments:
        time: sample times, shape (n,), strictly increasing; in seconds unless ``units["time"]`` says
            otherwise.
        signals: samples by name, each of shape (n,); or a pandas DataFrame with a column for each.
        units: unit of every signal by name; by default the model's units are assumed.
        interpolation: of inputs between samples, one choice for all or by name, as of an
            `acausal.Signal`: ``"linear"``, ``"previous"``, ``"cubic"`` or ``"band-limited"``. Where nothing is
            chosen it is linear, and cubic for an input that the model differentiates.
        before_start, after_end: of inputs beyond the samples, one choice for all or by name, as of an
            `acausal.Signal`: ``"refuse"`` (the default) a simulation that reaches beyond the samples, ``"hold"`` the
            end values, continue them in a ``"linear"`` way, or repeat the record as a ``"periodic"`` one.

    Raises:
        DataError: for a time base that does not increase, samples that are missing or not finite
            real numbers, a signal without a unit where others have one, an unknown choice.
    """

    time: Float[np.ndarray, " n"]
    signals: Mapping[str, Float[np.ndarray, " n"]]
    units: Mapping[str, str] | None = None
    interpolation: Choices = None
    before_start: Choices = None
    after_end: Choices = None

    def __init__(
        self,
        time: ArrayLike,
        signals: Mapping[str, ArrayLike] | DataFrame,
        units: Mapping[str, str] | None = None,
        interpolation: Choices = None,
        *,
        before_start: Choices = None,
        after_end: Choices = None,
    ) -> None:
        if not isinstance(units, Mapping | None):
            raise DataError(
                f"units={shown(units)} has no names; give a unit by name: {{'mass.s': 'm'}}."
            )
        for name, unit in (units or {}).items():
            if not isinstance(unit, str):
                raise DataError(f"units: '{name}' has {shown(unit)}; give a text such as 'N/m'.")
        unit_of_time = (units or {}).get("time", "s")
        ts = np.asarray(time)
        check_time_base(ts, "The record")
        ts = convert(ts.astype(float), unit_of_time, "s", "'time'")
        columns = _by_name(signals)
        for name, values in columns.items():
            check_samples(values, ts.shape, f"'{name}'")
        if units is not None:
            _check_units(units, columns)
            units = {n: u for n, u in units.items() if n != "time"}
        choices = {
            "interpolation": (interpolation, get_args(Interpolation)),
            "before_start": (before_start, get_args(Beyond)),
            "after_end": (after_end, get_args(Beyond)),
        }
        for what, (given, known) in choices.items():
            _check_choices(what, given, known, columns)
        for field, value in (
            ("time", ts),
            ("signals", {n: np.asarray(v, float) for n, v in columns.items()}),
            ("units", units),
            *((what, given) for what, (given, _) in choices.items()),
        ):
            object.__setattr__(self, field, value)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the signals."""
        return tuple(self.signals)

    @classmethod
    def of(cls, record: Data | Mapping[str, Any] | DataFrame) -> Data:
        """A record as it is; or made from a plain mapping ``{"time": ..., name: ...}``, or from a pandas DataFrame.

        A data frame has the times in a column ``time``, or as its index.
        """
        if isinstance(record, Data):
            return record
        if is_data_frame(record):
            return cls(*_time_and_signals(record))
        if not isinstance(record, Mapping):
            raise DataError(f"A record is acausal.Data or a mapping, not {shown(record)}")
        if "time" not in record:
            raise DataError(f"The record has no 'time': {nearest('time', record)}")
        return cls(record["time"], {n: v for n, v in record.items() if n != "time"})

    @classmethod
    def from_csv(
        cls,
        path: str | Path,
        interpolation: Choices = None,
        *,
        before_start: Choices = None,
        after_end: Choices = None,
    ) -> Data:
        """Read a file whose first line names the columns, as ``name`` or ``name [unit]``.

        One column is called ``time``. Either every column has a unit or none has. The other arguments are those of
        `Data`.

        Raises:
            DataError: for a file that cannot be read, with the line's number.
        """
        path = need_path(path, "from_csv")
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
        if "time" not in names:
            raise DataError(f"{path} has no column 'time': {nearest('time', names)}")
        columns = dict(zip(names, values.reshape(len(rows), len(names)).T, strict=True))
        try:
            return cls(
                columns.pop("time"),
                columns,
                units or None,
                interpolation,
                before_start=before_start,
                after_end=after_end,
            )
        except DataError as e:
            raise DataError(f"{path}: {e}") from None

    def for_system(self, system: System) -> Data:
        """The record in the model's units.

        Raises:
            DataError: for a name that is not a variable of the model, or a unit of another dimension.
        """
        if not hasattr(system, "vector_field"):
            raise DataError(
                f"for_system needs a compiled model, got {shown(system)}: give ac.compile(model)."
            )
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
        converted = {
            n: convert(v, given[n], system.unit(n), f"'{n}'") for n, v in self.signals.items()
        }
        return self._with(self.time, converted, keep_units=False)

    def columns(self, names: Iterable[str], purpose: str) -> Float[np.ndarray, "n n_names"]:
        """The named signals side by side; ``purpose`` is what they are needed for, in an error.

        Raises:
            DataError: if the record lacks signals; it lists them.
        """
        names = names_in(names)
        missing = [n for n in names if n not in self.signals]
        if missing:
            raise DataError(f"The data lack {listing(missing)}, {purpose}.")
        return self._side_by_side(names)

    def signal(self, name: str, interpolation: Interpolation = "linear") -> Signal:
        """A signal as a function of time; ``interpolation`` is for one for which the record has no choice."""

        def chosen(given: Choices, default: str) -> Any:
            return (given if isinstance(given, str) else (given or {}).get(name)) or default

        return Signal(
            self.time,
            self[name],
            chosen(self.interpolation, interpolation),
            before_start=chosen(self.before_start, "refuse"),
            after_end=chosen(self.after_end, "refuse"),
            name=name,
        )

    def between(self, start: float, end: float) -> Data:
        """The samples with ``start <= time <= end``.

        Raises:
            DataError: if there are fewer than two, or for what is not a time.
        """
        check_time(start, "start")
        check_time(end, "end")
        inside = (self.time >= start) & (self.time <= end)
        if inside.sum() < 2:
            raise DataError(
                f"No two samples lie between {start:g} and {end:g} s; the record goes from "
                f"{self.time[0]:g} to {self.time[-1]:g} s."
            )
        return self._with(self.time[inside], {n: v[inside] for n, v in self.signals.items()})

    def select(self, names: Iterable[str]) -> Data:
        """The record with only the named signals."""
        return self._with(self.time, {n: self[n] for n in names_in(names)})

    def _with(
        self, time: np.ndarray, signals: Mapping[str, np.ndarray], *, keep_units: bool = True
    ) -> Data:
        """A record like this one with other samples; its signals keep what was chosen for them."""

        def kept(given: Choices) -> Choices:
            if given is None or isinstance(given, str):
                return given
            return {n: choice for n, choice in given.items() if n in signals}

        return Data(
            time,
            signals,
            {n: self.units[n] for n in signals} if keep_units and self.units is not None else None,
            kept(self.interpolation),
            before_start=kept(self.before_start),
            after_end=kept(self.after_end),
        )

    @property
    def uniform(self) -> bool:
        """Whether the samples are equally spaced in time."""
        return is_uniform(self.time)

    @property
    def sample_time(self) -> float:
        """Mean time between samples, in seconds."""
        return float(self.time[-1] - self.time[0]) / (len(self.time) - 1)

    def _column(self, name: str) -> Float[np.ndarray, " n"]:
        if name not in self.signals:
            raise DataError(f"The record has no '{name}': {nearest(name, self.signals)}")
        return self.signals[name]

    def _side_by_side(self, names: tuple[str, ...]) -> Float[np.ndarray, "n n_names"]:
        columns = [self._column(n) for n in names]
        return np.stack(columns, axis=1) if columns else np.zeros((len(self), 0))

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


def _check_choices(
    what: str, given: Choices, known: tuple[str, ...], signals: Mapping[str, Any]
) -> None:
    if given is None:
        return
    if not isinstance(given, str | Mapping):
        raise DataError(
            f"{what}={shown(given)}; choose one of {', '.join(known)}, for all or by name."
        )
    by_name = {"The record": given} if isinstance(given, str) else given
    for name, choice in by_name.items():
        if choice not in known:
            raise DataError(f"{name} has {what}={shown(choice)}; choose one of {', '.join(known)}.")
        if not isinstance(given, str) and name not in signals:
            raise DataError(
                f"There is a choice of {what} for '{name}' but no such signal: {nearest(name, signals)}"
            )


def is_data_frame(thing: object) -> TypeGuard[DataFrame]:
    """Whether something is a pandas DataFrame; pandas is not imported for that."""
    pandas = sys.modules.get("pandas")
    return pandas is not None and isinstance(thing, pandas.DataFrame)


def _by_name(signals: Mapping[str, ArrayLike] | DataFrame) -> Mapping[str, ArrayLike]:
    """Samples by name.

    Raises:
        DataError: for anything else, and for a name that is no text, or that occurs twice.
    """
    if is_data_frame(signals):
        if not signals.columns.is_unique:
            doubled = signals.columns[signals.columns.duplicated()][0]
            raise DataError(f"The data frame has two columns '{doubled}'.")
        signals = {name: signals[name].to_numpy() for name in signals.columns}
    if not isinstance(signals, Mapping):
        raise DataError(
            "The signals of a record have names: give ac.Data(time, {'mass.s': samples}), "
            f"not {_described(signals)}."
        )
    return {name: signals[name] for name in names_in(signals, "signals")}


def _time_and_signals(frame: DataFrame) -> tuple[ArrayLike, DataFrame]:
    """The times and the other columns of a data frame."""
    if "time" in frame.columns:
        return frame["time"].to_numpy(), frame.drop(columns="time")
    if frame.index.name is None and type(frame.index).__name__ == "RangeIndex":
        raise DataError(
            "The data frame has no time: its index only counts the rows. Give it a column 'time' in seconds, "
            "or times as its index."
        )
    return frame.index.to_numpy(), frame


def _described(thing: object) -> str:
    shape = getattr(thing, "shape", None)
    return shown(thing) if shape is None else f"an array of shape {shape}"


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
