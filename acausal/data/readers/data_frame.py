"""pandas data frames, and Parquet files by them."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeGuard

import numpy as np

from acausal.data.readers.table import (
    Selection,
    SignalTable,
    headers,
    need_column,
    need_time,
    seconds,
)
from acausal.errors import DataError, need_package, reason, shown

if TYPE_CHECKING:
    from pandas import DataFrame, Index


def is_data_frame(thing: object) -> TypeGuard[DataFrame]:
    """Whether something is a pandas DataFrame; pandas is not imported for that."""
    pandas = sys.modules.get("pandas")
    return pandas is not None and isinstance(thing, pandas.DataFrame)


def read_data_frame(frame: object, selection: Selection, source: str = "") -> SignalTable:
    """A table from a data frame with the times in a column, or as its index.

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
    if selection.time in column_of:
        time = _array(frame[column_of[selection.time]])
    else:
        time = _array(_time_index(frame, selection, names, what))
    signals = {n: _array(frame[column_of[n]]) for n in selection.names(names, what)}
    units = {**in_headers, **_units(frame, column_of)}
    unit_of_time = units.pop(selection.time, units.pop("time", None))
    units |= {"time": unit_of_time} if unit_of_time is not None else {}
    return selection.table(seconds(time), signals, units, source)


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


def _time_index(frame: DataFrame, selection: Selection, names: list[str], what: str) -> Index:
    """The index, if it holds the times."""
    if selection.time not in ("time", frame.index.name):
        need_time(selection, names, what)
    if frame.index.name is None and frame.index.dtype.kind in "iu":
        raise DataError(
            f"{what} has no time: its index only counts the rows. Give it a column 'time' in seconds, "
            "or times as its index."
        )
    return frame.index


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
    of_columns = {n: frame[column].attrs.get("units") for n, column in column_of.items()}
    found = {
        n: of_frame.get(n, of_frame.get(column_of.get(n, n), of_columns.get(n)))
        for n in (*column_of, "time")
    }
    return {n: unit for n, unit in found.items() if isinstance(unit, str)}
