"""Records from files and from tables of other libraries, and back."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeAlias, TypedDict, Unpack

from acausal.data import readers
from acausal.data.by_signal import Choices
from acausal.data.given_columns import Missing
from acausal.data.readers import Selection, SignalTable
from acausal.errors import DataError, known_name, shown

if TYPE_CHECKING:
    from pandas import DataFrame

Paths: TypeAlias = str | Path | Sequence[str | Path]
"""One file, a pattern such as ``"runs/*.csv"``, or a list of files."""

READERS = {
    ".csv": "from_csv",
    ".txt": "from_csv",
    ".tsv": "from_csv",
    ".parquet": "from_parquet",
    ".mat": "from_mat",
    ".mdf": "from_mdf",
    ".mf4": "from_mdf",
}
"""Endings of files, and the method that reads them."""


class CsvOptions(TypedDict, total=False):
    """Options of all ways to read a record, as of `Formats.from_csv`."""

    columns: Sequence[str] | None
    rename: Mapping[str, str] | None
    units: Mapping[str, str] | None
    before_start: Choices
    after_end: Choices
    missing: Missing


class ReadOptions(CsvOptions, total=False):
    """The same, and ``interpolation`` as of `acausal.Data`."""

    interpolation: Choices


class Formats(ABC):
    """What a record can be read from and turned into.

    Methods that read files take one path and give one record, or take a pattern (``"runs/*.csv"``) or a list of paths
    and give a dictionary of records. They are called by the files' names without the ending; where these are the same,
    by the paths below the common folder. All methods have the `ReadOptions`, too.
    """

    time: Any
    signals: Any
    units: Mapping[str, str] | None

    @classmethod
    @abstractmethod
    def of(cls, record: Any) -> Self:
        """A record of what can be one."""

    @classmethod
    @abstractmethod
    def _of_table(cls, table: SignalTable, options: Mapping[str, Any]) -> Self:
        """The record of a table."""

    @classmethod
    def from_csv(
        cls,
        path: Paths,
        interpolation: Choices = None,
        *,
        time: str = "time",
        separator: str | None = None,
        decimal: str | None = None,
        encoding: str = "utf-8-sig",
        group: str | None = None,
        **options: Unpack[CsvOptions],
    ) -> Any:
        """Read a file whose first line names the columns, as ``name`` or ``name [unit]``.

        Either every column has a unit or none has. An empty cell, ``nan``, ``NA`` or ``null`` is a missing sample,
        with ``missing="nan"``.

        Arguments:
            path: one or many files, see `Formats`.
            interpolation: as of `Data`.
            time: name of the column with the times.
            separator: of the columns: a comma, a semicolon, a tab or a blank; by default guessed from the first line.
            decimal: the decimal mark, ``"."`` or ``","``; by default guessed from the first rows.
            encoding: of the text.
            group: name of a column that says which run a row belongs to. The result are records by run then.
            columns: names of the columns to read, besides the times; by default all.
            rename: names in the file, and the model's variables that they are: ``{"ch 7": "mass.a"}``.
            units: units by name of the signal in the record; they count, not those of the file.
            before_start, after_end, missing: as of `acausal.Data`.

        Raises:
            DataError: for a file that cannot be read, with the line's number and what was guessed.
        """
        read = partial(readers.read_csv, separator=separator, decimal=decimal, encoding=encoding)
        every = {**options, "interpolation": interpolation}
        return cls._of_files("from_csv", path, read, every, time, group)

    @classmethod
    def from_parquet(
        cls,
        path: Paths,
        *,
        time: str = "time",
        group: str | None = None,
        **options: Unpack[ReadOptions],
    ) -> Any:
        """Read a Parquet file as its data frame, see `from_dataframe`; needs ``acausal[parquet]``.

        Arguments:
            path: one or many files, see `Formats`.
            time: name of the column, or of the index, with the times.
            group, options: as of `from_csv`, and ``interpolation``.

        Raises:
            DataError: for a file that cannot be read.
        """
        return cls._of_files("from_parquet", path, readers.read_parquet, options, time, group)

    @classmethod
    def from_mat(cls, path: Paths, *, time: str = "time", **options: Unpack[ReadOptions]) -> Any:
        """Read the vectors of a MATLAB file; a field of a structure is called ``structure.field``.

        Without ``columns`` the record has every vector that is as long as the times. MATLAB's version 7.3 needs
        ``acausal[mat]``.

        Arguments:
            path: one or many files, see `Formats`.
            time: name of the variable with the times.
            options: as of `from_csv`, and ``interpolation``; a MATLAB file has no units of its own.

        Raises:
            DataError: for a file that cannot be read.
        """
        return cls._of_files("from_mat", path, readers.read_mat, options, time)

    @classmethod
    def from_mdf(cls, path: Paths, **options: Unpack[ReadOptions]) -> Any:
        """Read the channels of an MDF or MF4 file, each with its own times and unit; needs ``acausal[mdf]``.

        A channel whose name occurs in several groups is called ``name@group``. Without ``columns`` the record has all
        channels of numbers. Samples that the file marks as invalid are left out.

        Arguments:
            path: one or many files, see `Formats`.
            options: as of `from_csv`, and ``interpolation``.

        Raises:
            DataError: for a file that cannot be read.
        """
        return cls._of_files("from_mdf", path, readers.read_mdf, options)

    @classmethod
    def from_files(cls, path: Paths, **options: Any) -> Any:
        """Read files by the method for their ending, such as `from_csv` for ``.csv``.

        Arguments:
            path: one or many files of one kind, see `Formats`.
            options: of that method.

        Raises:
            DataError: for an ending that is not known, files of several kinds, and as that method does.
        """
        return getattr(cls, _reader(readers.files(path, "from_files")))(path, **options)

    @classmethod
    def stream(cls, given: Paths | Mapping[str, Any], **options: Any) -> Stream:
        """Describe records that do not fit in memory; each is read when a training of sequences needs it.

        Arguments:
            given: files as of `from_files`; or by name an `xarray.Dataset`, which may be opened lazily from Zarr or be
                computed by Dask, or a function without arguments that returns a record.
            options: of the method that reads them, such as `from_csv` or `from_xarray`; none for functions.

        Returns:
            A `Stream`; ``stream["run 7"]`` reads one record.

        Raises:
            DataError: if there are no files or records, or files are of several kinds.
        """
        if isinstance(given, Mapping):
            if not given:
                raise DataError("stream: there are no records; give at least one.")
            return Stream({name: cls._source(one, options) for name, one in given.items()})
        found = readers.files(given, "stream")
        found = {found.stem: found} if isinstance(found, Path) else found
        _reader(found)
        read = {n: partial(cls.from_files, path, **options) for n, path in found.items()}
        return Stream({n: partial(cls._one, n, function) for n, function in read.items()})

    @classmethod
    def _source(cls, given: Any, options: Mapping[str, Any]) -> Callable[[], Any]:
        if not callable(given):
            return partial(cls.from_xarray, given, **options)
        if options:
            raise DataError(
                f"stream: {next(iter(options))}= is for files and data sets; leave it out for functions."
            )
        return partial(cls._called, given)

    @classmethod
    def _called(cls, function: Callable[[], Any]) -> Self:
        return cls.of(function())

    @classmethod
    def _one(cls, name: str, read: Callable[[], Any]) -> Self:
        record = read()
        if not isinstance(record, cls):
            raise DataError(
                f"stream: the file of '{name}' has several records; leave out group=, or write a file for each."
            )
        return record

    @classmethod
    def from_dataframe(
        cls,
        frame: DataFrame,
        *,
        time: str = "time",
        group: str | None = None,
        **options: Unpack[ReadOptions],
    ) -> Any:
        """A record of a pandas DataFrame.

        Units are those of ``frame.attrs["units"]`` (by name), of a column's ``attrs["units"]``, or of column names
        such as ``name [unit]``. Dates become seconds from the first one.

        Arguments:
            frame: a column for each signal; the times are a column, or the index.
            time: name of the column, or of the index, with the times.
            group, options: as of `from_csv`, and ``interpolation``.

        Raises:
            DataError: for anything else.
        """
        selection, others = _split("from_dataframe", options, time, group)
        return cls._of_tables(readers.read_runs(frame, selection), others)

    @classmethod
    def from_xarray(cls, dataset: Any, **options: Unpack[ReadOptions]) -> Self:
        """A record of an `xarray.Dataset` whose variables have one dimension, with the times as its coordinate.

        Variables with other dimensions are signals with times of their own. Units are those of ``attrs["units"]``.

        Arguments:
            dataset: the data set.
            options: as of `from_csv`, and ``interpolation``.

        Raises:
            DataError: for anything else.
        """
        selection, others = _split("from_xarray", options)
        return cls._of_table(readers.read_xarray(dataset, selection), others)

    def to_dataframe(self) -> DataFrame:
        """A pandas DataFrame indexed by time, with the units in ``attrs["units"]``.

        Raises:
            DataError: if pandas is not installed.
        """
        return readers.data_frame(self.time, self.signals, self.units)

    def to_xarray(self) -> Any:
        """An `xarray.Dataset` over the coordinate ``time``, with the units in ``attrs["units"]``.

        Raises:
            DataError: if xarray is not installed.
        """
        return readers.dataset(self.time, self.signals, self.units)

    @classmethod
    def _of_files(
        cls,
        function: str,
        path: object,
        reader: Callable[[Path, Selection], SignalTable | dict[str, SignalTable]],
        options: Mapping[str, Any],
        time: str = "time",
        group: str | None = None,
    ) -> Self | dict[str, Self]:
        selection, others = _split(function, options, time, group)
        found = readers.files(path, function)
        if isinstance(found, Path):
            return cls._of_tables(reader(found, selection), others)
        records: dict[str, Self] = {}
        for name, file in found.items():
            one = cls._of_tables(reader(file, selection), others)
            records |= (
                {f"{name}/{run}": r for run, r in one.items()}
                if isinstance(one, dict)
                else {name: one}
            )
        return records

    @classmethod
    def _of_tables(
        cls, tables: SignalTable | dict[str, SignalTable], options: Mapping[str, Any]
    ) -> Self | dict[str, Self]:
        if isinstance(tables, dict):
            return {run: cls._of_table(table, options) for run, table in tables.items()}
        return cls._of_table(tables, options)


def _reader(found: Path | Mapping[str, Path]) -> str:
    """The method that reads some files."""
    paths = [found] if isinstance(found, Path) else list(found.values())
    endings = {path.suffix.lower(): path for path in paths}
    for ending, path in endings.items():
        if ending not in READERS:
            raise DataError(
                f"{shown(str(path))}: '{ending}' is no known ending of a file of data; give {', '.join(READERS)}."
            )
    if len(names := {READERS[ending] for ending in endings}) > 1:
        raise DataError("The files of data are of several kinds; give those of one kind.")
    return names.pop()


def _split(
    function: str, options: Mapping[str, Any], time: str = "time", group: str | None = None
) -> tuple[Selection, dict[str, Any]]:
    """What is read, and the options of the record itself."""
    known = ReadOptions.__annotations__
    for name in options:
        known_name(name, known, f"{function} has no option")
    of_selection = {n: options[n] for n in ("columns", "rename", "units") if n in options}
    others = {n: option for n, option in options.items() if n not in of_selection}
    return Selection(time, group=group, **of_selection), others


@dataclass(frozen=True, eq=False)
class Stream:
    """Records by name that stay in their files: ``stream["run 7"]`` reads one, ``dict(stream)`` reads all.

    `Data.stream` makes it; `acausal.fit` trains on it with ``strategy="sequences"``.

    Attributes:
        sources: by name, the function that reads the record.
    """

    sources: Mapping[str, Callable[[], Any]]

    def keys(self) -> Iterator[str]:
        """Names of the records."""
        return iter(self.sources)

    def __iter__(self) -> Iterator[str]:
        return iter(self.sources)

    def __len__(self) -> int:
        return len(self.sources)

    def __getitem__(self, name: str) -> Any:
        return self.sources[known_name(name, self.sources, "There is no record")]()

    def without(self, names: tuple[str, ...]) -> Stream:
        """The other records."""
        return Stream({n: read for n, read in self.sources.items() if n not in names})

    def __repr__(self) -> str:
        first = ", ".join(f"'{name}'" for name in list(self.sources)[:3])
        count = len(self)
        return f"Stream({count} record{'s' * (count > 1)}, read when needed: {first}{', ...' * (count > 3)})"
