"""pandas data frames."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, TypeGuard

from numpy.typing import ArrayLike

from acausal.errors import DataError

if TYPE_CHECKING:
    from pandas import DataFrame


def is_data_frame(thing: object) -> TypeGuard[DataFrame]:
    """Whether something is a pandas DataFrame; pandas is not imported for that."""
    pandas = sys.modules.get("pandas")
    return pandas is not None and isinstance(thing, pandas.DataFrame)


def time_and_signals(frame: DataFrame) -> tuple[ArrayLike, DataFrame]:
    """The times and the other columns of a data frame."""
    if "time" in frame.columns:
        return frame["time"].to_numpy(), frame.drop(columns="time")
    if frame.index.name is None and type(frame.index).__name__ == "RangeIndex":
        raise DataError(
            "The data frame has no time: its index only counts the rows. Give it a column 'time' in seconds, "
            "or times as its index."
        )
    return frame.index.to_numpy(), frame
