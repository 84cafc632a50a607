"""Measured records: from a folder, or through the package `nonlinear_benchmarks`."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

import numpy as np
from scipy.io import loadmat

import acausal as ac


def load(folder: Path | None, name: str, files: Sequence[str]) -> list[dict[str, np.ndarray]]:
    """The files of a data set, as vectors and numbers by name.

    Arguments:
        folder: where the files are, or a folder that has them in a folder ``name.lower()``; ``None`` lets
            `nonlinear_benchmarks` fetch them.
        name: of the data set in that package.
        files: their names.

    Raises:
        DataError: for files that are not there.
    """
    places = _fetched(name) if folder is None else _in(folder, name.lower(), files)
    by_name = {place.name: place for place in places}
    return [_vectors(by_name[file]) for file in files]


def _in(folder: Path, name: str, files: Sequence[str]) -> list[Path]:
    for place in (folder, folder / name):
        if all((place / file).is_file() for file in files):
            return [place / file for file in files]
    raise ac.DataError(f"There is no {' and '.join(files)} in {folder}, nor in {folder / name}.")


def _fetched(name: str) -> list[Path]:
    try:
        package = import_module("nonlinear_benchmarks")
    except ImportError:
        raise ac.DataError(
            f"The data are not part of this project: pip install nonlinear-benchmarks, which fetches them, or "
            f"download {name} from https://www.nonlinearbenchmark.org and say where it is by --data."
        ) from None
    places = getattr(package, name)(data_file_locations=True)
    return [Path(p) for p in ([places] if isinstance(places, str) else places)]


def _vectors(path: Path) -> dict[str, np.ndarray]:
    return {n: v.ravel() for n, v in loadmat(path).items() if not n.startswith("_")}
