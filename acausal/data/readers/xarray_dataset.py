"""xarray data sets: variables over a coordinate that is the time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from acausal.data.readers.table import Selection, SignalTable, seconds
from acausal.errors import DataError, listing, need_package, shown


def read_xarray(dataset: Any, selection: Selection) -> SignalTable:
    """A table from a data set whose variables have one dimension each, with the times as its coordinate.

    Units are those of ``attrs["units"]``.

    Raises:
        DataError: for anything else.
    """
    if not hasattr(dataset, "data_vars"):
        raise DataError(f"from_xarray needs an xarray.Dataset, not {shown(dataset)}.")
    variables = {str(name): variable for name, variable in dataset.data_vars.items()}
    chosen = {n: variables[n] for n in selection.names(variables, "The data set")}
    odd = [n for n, v in chosen.items() if len(v.dims) != 1 or v.dims[0] not in v.coords]
    if odd:
        raise DataError(
            f"The data set has {listing(odd)} over other than one dimension with times as its coordinate; "
            "leave them out."
        )
    times = {n: v.coords[v.dims[0]] for n, v in chosen.items()}
    kinds = {t.dtype.kind if t.dtype.kind in "mM" else "f" for t in times.values()}
    if len(kinds) > 1:
        words = {"M": "dates", "m": "durations", "f": "numbers"}
        raise DataError(
            f"The times of the data set are {' and '.join(words[k] for k in sorted(kinds))}, which have no common "
            "start; give all of one kind."
        )
    of_times = dict.fromkeys(_unit(t) for t in times.values() if t.dtype.kind not in "mM")
    if len(of_times) > 1:
        raise DataError(
            f"The times of the data set have the units {listing(map(str, of_times))}; give them in one unit."
        )
    units = {n: _unit(v) for n, v in chosen.items()} | {"time": next(iter(of_times), None)}
    first = min((t.to_numpy()[0] for t in times.values() if t.size), default=None)
    signals = {n: (seconds(times[n].to_numpy(), first), v.to_numpy()) for n, v in chosen.items()}
    return selection.table(None, signals, {n: u for n, u in units.items() if u is not None})


def dataset(
    time: np.ndarray, signals: Mapping[str, np.ndarray], units: Mapping[str, str] | None
) -> Any:
    """An `xarray.Dataset` with a variable for each signal over the coordinate ``time``, units in ``attrs``."""
    xarray = need_package("xarray", "A data set", "xarray")

    def attributes(name: str) -> dict[str, str]:
        return {} if units is None else {"units": units[name]}

    return xarray.Dataset(
        {n: ("time", values, attributes(n)) for n, values in signals.items()},
        coords={"time": ("time", time, {"units": "s"} if units is not None else {})},
    )


def _unit(variable: Any) -> str | None:
    unit = variable.attrs.get("units")
    return unit if isinstance(unit, str) else None
