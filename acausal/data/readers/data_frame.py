"""pandas data frames, and Parquet files by them."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeGuard

import numpy as np

from acausal.data.readers.table import (
    HEADER,
    Selection,
    SignalTable,
    headers,
    need_column,
    need_time,
    seconds,
)
from acausal.data.samples import check_samples, check_time_base
from acausal.errors import DataError, need_package, reason, shown
from acausal.units import convert

if TYPE_CHECKING:
    from pandas import DataFrame, Index, Series


def is_data_frame(thing: object) -> TypeGuard[DataFrame]:
    """Whether something is a pandas DataFrame; pandas is not imported for that."""
    pandas = sys.modules.get("pandas")
    return pandas is not None and isinstance(thing, pandas.DataFrame)


def is_series(thing: object) -> TypeGuard[Series]:
    """Whether something is a pandas Series; pandas is not imported for that."""
    pandas = sys.modules.get("pandas")
    return pandas is not None and isinstance(thing, pandas.Series)


def read_data_frame(
    frame: object, selection: Selection, source: str = "", first: Any = None
) -> SignalTable:
    """A table from a data frame with the times in a column, or as its index.

    Dates count from a ``first`` one, or from their own.

    Raises:
        DataError: for anything else, for a frame without times, and for two columns of one name.
    """
    if not is_data_frame(frame):
        raise DataError(f"from_dataframe needs a pandas DataFrame, not {shown(frame)}.")
    what = source or "The data frame"
    need_unique(frame, what)
    texts = [name for name in frame.columns if isinstance(name, str)]
    if len(texts) < len(frame.columns):
        odd = next(name for name in frame.columns if not isinstance(name, str))
        raise DataError(f"{what} has a column {shown(odd)}; give it a name such as 'mass.s'.")
    names, in_headers = headers(texts, what)
    column_of = dict(zip(names, texts, strict=True))
    selection = selection.with_bare_time(texts, names)
    signals = {n: _array(frame[column_of[n]]) for n in selection.names(names, what)}
    if selection.time in names:
        label, time = selection.time, _array(frame[column_of[selection.time]])
    else:
        header = _header(frame.index)
        (name,), unit = headers([header], what)
        _need_time_index(frame.index, name, selection, names, what)
        label, time = "time" if name in names else name, _array(frame.index)
        column_of |= {} if name in names else {name: header}
        in_headers |= {label: unit[name]} if unit else {}
    units = {**in_headers, **_units(frame, column_of)}
    unit_of_time = units.pop(label, units.pop("time", None))
    if unit_of_time is not None and time.dtype.kind not in "mM":
        units["time"] = unit_of_time
    return selection.table(seconds(time, first), signals, units, source)


def read_series(
    series: Mapping[str, Series],
) -> dict[str, tuple[np.ndarray, np.ndarray, str | None]]:
    """The times [s], the samples and the unit of each series by name; its index holds the times.

    Dates count from the first of all. The unit is in a series' attributes or its name, ``name [unit]``.

    Raises:
        DataError: for what is no time base, or has no unit of time, and samples that are not finite real numbers.
    """
    dates = [_array(s.index) for s in series.values() if s.index.dtype.kind == "M" and len(s)]
    first = min((d[0] for d in dates), default=None)
    found: dict[str, tuple[np.ndarray, np.ndarray, str | None]] = {}
    for name, one in series.items():
        plain = not isinstance(one.name, str) or one.name in ("time", one.index.name)
        frame = one.to_frame("samples" if plain else one.name)
        table = read_data_frame(frame, Selection(), f"'{name}'", first)
        ((label, samples),) = table.signals.items()
        assert table.time is not None
        check_time_base(table.time, f"'{name}'")
        check_samples(samples, table.time.shape, f"'{name}'")
        time = convert(table.time, table.units.get("time", "s"), "s", f"The time of '{name}'")
        found[name] = time, samples, table.units.get(label)
    return found


def need_unique(frame: DataFrame, what: str) -> None:
    """Refuse a data frame with two columns of one name."""
    if not frame.columns.is_unique:
        doubled = frame.columns[frame.columns.duplicated()][0]
        raise DataError(f"{what} has two columns '{doubled}'.")


def read_runs(
    frame: object, selection: Selection, source: str = ""
) -> SignalTable | dict[str, SignalTable]:
    """`read_data_frame`, with a table of each run where the selection has a column that names them."""
    if selection.group is None or not is_data_frame(frame):
        return read_data_frame(frame, selection, source)
    texts = [n for n in frame.columns if isinstance(n, str)]
    need_column(selection.group, texts, source or "The data frame")
    parts = frame.groupby(selection.group, sort=False)
    what = f"{source}, run" if source else "Run"
    return {str(run): read_data_frame(part, selection, f"{what} '{run}'") for run, part in parts}


def units_said(signals: object) -> dict[str, str] | None:
    """Units in the attributes of a data frame, or of signals such as those of xarray; None where there are none."""
    if is_data_frame(signals):
        return _units(signals, {n: n for n in signals.columns if isinstance(n, str)}) or None
    if not isinstance(signals, Mapping):
        return None
    attributes = {name: getattr(given, "attrs", None) for name, given in signals.items()}
    found = {n: own["units"] for n, own in attributes.items() if own and "units" in own}
    return found or None


def read_parquet(path: Path, selection: Selection) -> SignalTable | dict[str, SignalTable]:
    """A table, or one of each run, from a Parquet file; the units are those that its data frame had."""
    pandas = need_package("pandas", "A Parquet file", "parquet")
    need_package("pyarrow", "A Parquet file", "parquet")
    try:
        frame = pandas.read_parquet(path, engine="pyarrow")
    except OSError as e:
        raise DataError(f"{path} cannot be read: {reason(e)}.") from None
    except Exception as e:  # pyarrow has errors of its own for each way in which a file is broken
        raise DataError(f"{path} is not a Parquet file: {shown(str(e))}.") from None
    return read_runs(frame, selection, str(path))


def data_frame(
    time: np.ndarray, signals: Mapping[str, np.ndarray], units: Mapping[str, str] | None
) -> DataFrame:
    """A data frame with the times as its index, and the units in ``attrs["units"]``."""
    pandas = need_package("pandas", "A data frame", "dataframe")
    frame = pandas.DataFrame(dict(signals), index=pandas.Index(time, name="time"))
    if units is not None:
        frame.attrs["units"] = {"time": "s", **units}
    return frame


def counts_rows(index: Index) -> bool:
    """Whether an index is one of whole numbers without a name, and so no times."""
    return index.name is None and index.dtype.kind in "iu"


def _header(index: Index) -> str:
    """The name of an index, such as ``t [ms]``; ``time`` where it has none."""
    return index.name if isinstance(index.name, str) and HEADER.fullmatch(index.name) else "time"


def _need_time_index(
    index: Index, label: str, selection: Selection, names: list[str], what: str
) -> None:
    """Refuse an index that does not hold the times."""
    if selection.time not in ("time", label, index.name):
        need_time(selection, [*names, label], what)
    if counts_rows(index):
        raise DataError(
            f"{what} has no time: its index only counts the rows. Give it a column 'time' in seconds, "
            "or times as its index."
        )


def _array(column: Any) -> np.ndarray:
    """Of a series or an index: numbers, with NaN where pandas lacks a value, dates, durations, or what else it has."""
    dtype: Any = column.dtype
    if isinstance(dtype, np.dtype):
        return column.to_numpy()
    if dtype.kind in "iufb":
        return column.to_numpy(float, na_value=np.nan)
    if dtype.kind in "mM":
        return column.to_numpy(f"{dtype.kind}8[ns]")
    return column.to_numpy()


def _units(frame: DataFrame, column_of: Mapping[str, str]) -> dict[str, str]:
    """Units in the attributes of the frame, or of its columns."""
    of_frame: Any = frame.attrs.get("units", {})
    of_frame = of_frame if isinstance(of_frame, Mapping) else {}
    of_columns = {
        n: frame[column].attrs.get("units")
        for n, column in column_of.items()
        if column in frame.columns
    }
    found = {
        n: of_frame.get(n, of_frame.get(column_of.get(n, n), of_columns.get(n)))
        for n in (*column_of, "time")
    }
    return {n: unit for n, unit in found.items() if isinstance(unit, str)}
