"""MDF and MF4 files, the car industry's format, by asammdf: channels in groups, each group with its own times."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from acausal.data.readers.table import Selection, SignalTable, beginning
from acausal.errors import DataError, listing, need_package, shown

STARTS = (b"MDF     ", b"UnFinMF ")
"""What a finished file begins with, and one whose writing was broken off."""


def read_mdf(path: Path, selection: Selection) -> SignalTable:
    """A table of channels with their own times.

    A channel whose name occurs in several groups is called ``name@group``. Without a choice of columns the table has
    all channels of numbers with two samples or more. Samples that the file marks as invalid are left out.

    Raises:
        DataError: for a file that cannot be read, or a chosen channel that does not hold numbers.
    """
    asammdf = need_package("asammdf", "An MDF file", "mdf")
    if beginning(path, len(STARTS[0])) not in STARTS:
        raise DataError(f"{path} is not an MDF file: it does not begin with 'MDF'.")
    try:
        file = asammdf.MDF(path)
    except Exception as e:  # asammdf raises whatever a wrong byte leads to
        raise DataError(f"{path} is not an MDF file: {shown(str(e))}.") from None
    with file:
        places = _places(file)
        chosen = selection.names(places, str(path))
        try:
            found = file.select([(None, *places[name]) for name in chosen])
            channels = {n: c.validate() for n, c in zip(chosen, found, strict=True)}
        except Exception as e:
            raise DataError(f"{path} cannot be read: {shown(str(e))}.") from None
    usable = {n: c for n, c in channels.items() if _is_usable(c)}
    asked = [*(selection.columns or ()), *(selection.rename or ())]
    odd = [n for n in asked if n not in usable and n in channels]
    if odd:
        raise DataError(
            f"{path}: {listing(odd)} are not numbers at two times or more; leave them out."
        )
    units = {n: str(c.unit or "") for n, c in usable.items()}
    units = units if any(units.values()) else {}
    signals = {n: (np.asarray(c.timestamps), np.asarray(c.samples)) for n, c in usable.items()}
    return selection.table(None, signals, units | ({"time": "s"} if units else {}), str(path))


def _places(file: Any) -> dict[str, tuple[int, int]]:
    """Group and index of every channel but the times, by a name that occurs once."""
    masters = set(file.masters_db.items())
    places: dict[str, tuple[int, int]] = {}
    for name, found in file.channels_db.items():
        of_name = [tuple(place) for place in found if tuple(place) not in masters]
        for group, index in dict.fromkeys(of_name):
            places[name if len(of_name) == 1 else f"{name}@{group}"] = (group, index)
    return places


def _is_usable(channel: Any) -> bool:
    samples = np.asarray(channel.samples)
    return samples.ndim == 1 and samples.dtype.kind in "biuf" and len(samples) >= 2
