"""Several records: what a training takes as data, as records by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard

from acausal.data.formats import Stream
from acausal.data.readers import is_data_frame
from acausal.data.record import Data
from acausal.errors import DataError, shown

if TYPE_CHECKING:
    from pandas import DataFrame

Record: TypeAlias = "Data | Mapping[str, Any] | DataFrame"
"""One record: `Data`, a plain mapping ``{"time": ..., name: ...}``, or a pandas DataFrame."""

RecordsLike: TypeAlias = "Record | Sequence[Record] | Mapping[str, Record]"
"""One record, several of them, or several by name."""

ONE = "record"
"""Name of a record that is the only one and was given without a name."""


def records_of(given: Record | Sequence[Record] | Mapping[str, Record]) -> dict[str, Data]:
    """Records by name, in the order given.

    Arguments:
        given: one record, which is then called ``"record"``; a list or tuple of records, called ``"record 1"``,
            ``"record 2"``, ...; or a mapping from names to records. A mapping with a key ``"time"`` is one record.

    Raises:
        DataError: for anything else, for an empty collection, for a name that is not text or an empty one, and for
            a record that `Data.of` refuses, with its name.
    """
    if isinstance(given, Stream):
        raise DataError(
            "A stream is for ac.fit(..., strategy='sequences'), and here records are needed in memory: give some, such "
            "as [stream['run 7']], or dict(stream) to read all."
        )
    if _is_one_record(given):
        return {ONE: Data.of(given)}
    if isinstance(given, list | tuple):
        named = {f"{ONE} {number}": record for number, record in enumerate(given, 1)}
    elif isinstance(given, Mapping):
        if given and not any(_is_one_record(record) for record in given.values()):
            return {ONE: Data.of(given)}
        named = {_name(name): record for name, record in given.items()}
    else:
        raise DataError(
            f"Data are one record, a list of records, or records by name, not {shown(given)}: give acausal.Data."
        )
    if not named:
        raise DataError("There are no records; give at least one.")
    return {name: _record(name, record) for name, record in named.items()}


def _is_one_record(given: object) -> TypeGuard[Record]:
    return (
        isinstance(given, Data)
        or is_data_frame(given)
        or (isinstance(given, Mapping) and "time" in given)
    )


def _name(given: object) -> str:
    """The name of a record, as Python's own text."""
    if not isinstance(given, str) or not given.strip():
        raise DataError(f"{shown(given)} is not the name of a record; give a text such as 'run 1'.")
    return str(given)


def _record(name: str, given: Any) -> Data:
    try:
        return Data.of(given)
    except DataError as error:
        raise DataError(f"'{name}': {error}") from None
