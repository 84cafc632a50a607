"""MATLAB's MAT files: version 5 by scipy, version 7.3, which is HDF5, by h5py."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from acausal.data.readers.table import Selection, SignalTable, beginning, need_time
from acausal.errors import DataError, listing, need_package, shown

HDF = b"\x89HDF\r\n\x1a\n"
HDF_STARTS_AT = (0, 512)
"""MATLAB writes a block of 512 bytes before what is HDF5."""


def read_mat(path: Path, selection: Selection) -> SignalTable:
    """A table from the vectors of a MAT file; those in structures are called ``structure.field``.

    Without a choice of columns it has every vector that is as long as the times.

    Raises:
        DataError: for a file that cannot be read, or a chosen variable that is not a vector.
    """
    start = beginning(path, max(HDF_STARTS_AT) + len(HDF))
    is_hdf = any(start[at : at + len(HDF)] == HDF for at in HDF_STARTS_AT)  # version 7.3
    arrays = dict(_flattened("", _hdf(path) if is_hdf else _version_5(path)))
    need_time(selection, arrays, str(path))
    time = _vector(arrays[selection.time])
    if time is None:
        raise DataError(
            f"{path}: '{selection.time}' has shape {arrays[selection.time].shape}; "
            "a vector of times is needed."
        )
    chosen = selection.names(arrays, str(path))
    vectors = {name: _vector(arrays[name]) for name in chosen}
    if selection.columns is None:
        asked = selection.rename or {}
        vectors = {
            n: v
            for n, v in vectors.items()
            if n in asked or (v is not None and v.shape == time.shape)
        }
    odd = [n for n, v in vectors.items() if v is None]
    if odd:
        raise DataError(f"{path}: {listing(odd)} are not vectors of numbers; leave them out.")
    return selection.table(time, vectors, {}, str(path))


def _version_5(path: Path) -> Mapping[str, Any]:
    from scipy.io import loadmat

    try:
        found: Mapping[str, Any] = loadmat(path)
    except Exception as e:  # scipy raises whatever a wrong byte leads to
        raise DataError(f"{path} is not a MAT file: {shown(str(e))}.") from None
    return {name: value for name, value in found.items() if not name.startswith("__")}


def _hdf(path: Path) -> Mapping[str, Any]:
    h5py = need_package("h5py", f"{path} has MATLAB's version 7.3, which", "mat")
    try:
        with h5py.File(path, "r") as file:
            return _group(file)
    except OSError as e:
        raise DataError(f"{path} is not a MAT file: {shown(str(e))}.") from None


def _group(group: Any) -> dict[str, Any]:
    """What a group of an HDF5 file holds; MATLAB keeps its own things under names with ``#``."""
    found: dict[str, Any] = {}
    for name, item in group.items():
        if name.startswith("#"):
            continue
        if hasattr(item, "items"):
            found[name] = _group(item)
        elif item.attrs.get("MATLAB_class", b"double") not in (b"char", b"cell"):
            found[name] = item[()]
    return found


def _flattened(prefix: str, variables: Mapping[str, Any]) -> Iterator[tuple[str, np.ndarray]]:
    """Arrays with dotted names."""
    for name, value in variables.items():
        if isinstance(value, Mapping):
            yield from _flattened(f"{prefix}{name}.", value)
            continue
        array = np.asarray(value)
        if array.dtype.names and array.size == 1:
            fields = {field: array[field].item() for field in array.dtype.names}
            yield from _flattened(f"{prefix}{name}.", fields)
        else:
            yield f"{prefix}{name}", array


def _vector(array: np.ndarray) -> np.ndarray | None:
    """The numbers of a row or a column; None for anything else."""
    is_vector = array.size == max(array.shape, default=0) and array.dtype.kind in "biuf"
    return array.reshape(-1) if is_vector else None
