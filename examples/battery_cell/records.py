"""Records of a cell: tables of time, current and voltage as they were measured, made ready for the model."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float

import acausal as ac
from examples.battery_cell.model import AMBIENT, CURRENT, START, TEMPERATURE, VOLTAGE

KELVIN = 273.15
REST = 0.025
"""Currents up to this count as none [A]: the instrument shows 0.01 A where no current flows."""
JUMP = 0.3
"""A current that changes by more from row to row has jumped [A]."""
AFTER = 1e-3
"""How long after the row before it a jump happens [s]."""
GROWTH, LONGEST, CHANGE = 0.12, 60.0, 8e-3
"""Rows to train on: how far apart, of the time since the last jump; at most [s]; sooner after a change [V]."""
CURVE = np.array(
    [
        [0.0, 0.03, 0.06, 0.1, 0.19, 0.29, 0.38, 0.48, 0.57, 0.67, 0.76, 0.86, 0.95, 1.0],
        [2.9, 3.25, 3.53, 3.64, 3.72, 3.80, 3.84, 3.88, 3.91, 3.95, 3.99, 4.04, 4.13, 4.20],
    ]
)
"""States of charge and about what voltage such a cell has there: from where training starts."""

LOSS = 2e-3
"""About the resistance of such a cell [Ohm], likewise."""


@dataclass(frozen=True, eq=False)
class Table:
    """A record as measured.

    Attributes:
        time: of the rows [s].
        current: into the cell [A].
        voltage: [V]; NaN where it is not known.
        ambient: temperature of the chamber [K].
        case_time, case: times [s] of mean temperatures of the case [K], where these are measured.
    """

    time: Float[np.ndarray, " n"]
    current: Float[np.ndarray, " n"]
    voltage: Float[np.ndarray, " n"]
    ambient: Float[np.ndarray, " n"]
    case_time: Float[np.ndarray, " m"]
    case: Float[np.ndarray, " m"]

    @property
    def jumps(self) -> Bool[np.ndarray, " n"]:
        """Whether the current jumped just after the row before.

        A charging current that falls without stopping does not: that is how a charge at constant voltage ends.
        """
        before, after = self.current[:-1], self.current[1:]
        tapers = (after > 0) & (after < before)
        return np.append(False, (np.abs(after - before) > JUMP) & ~tapers)

    @property
    def measures_the_case(self) -> bool:
        """Whether the temperature of the case is measured; where it is not, it starts as that of the chamber."""
        return len(self.case_time) > 2

    def guess(self) -> float:
        """The state of charge that the first voltage tells about."""
        return float(np.interp(self.voltage[0] - LOSS * self.current[0], CURVE[1], CURVE[0]))

    @property
    def first_rest(self) -> int:
        """The last row before a current flows; the first where one flows at once."""
        flows = np.flatnonzero(self.current)
        return max(int(flows[0]) - 1, 0) if len(flows) else 0

    def few(self) -> Table:
        """The record with fewer rows, close together only after a jump of the current, and where the voltage moves."""
        kept, since = [0], self.time[0]
        for k, jumped in enumerate(self.jumps):
            if jumped:
                since = self.time[k - 1]
                kept += [k - 1, k]
                continue
            gap = self.time[k] - self.time[kept[-1]]
            moved = abs(self.voltage[k] - self.voltage[kept[-1]]) > CHANGE
            if gap >= min(LONGEST, GROWTH * (self.time[k] - since)) or moved:
                kept.append(k)
        rows = np.unique([*kept, len(self.time) - 1])
        return replace(
            self,
            time=self.time[rows],
            current=self.current[rows],
            voltage=self.voltage[rows],
            ambient=self.ambient[rows],
        )

    def data(self, start: float | None = None) -> ac.Data:
        """The record for training and simulation; the state of charge at its start is by default a guess.

        At every jump the current has one more sample: the new value just after the row before.
        """
        ahead = np.flatnonzero(self.jumps)
        corners = np.concatenate([self.time, self.time[ahead - 1] + AFTER])
        order = np.argsort(corners)
        current = np.concatenate([self.current, self.current[ahead]])[order]
        times = np.union1d(corners, self.case_time)
        began = self.guess() if start is None else start
        return ac.Data(
            times,
            {
                CURRENT: np.interp(times, corners[order], current),
                AMBIENT: np.interp(times, self.time, self.ambient),
                START: np.full(len(times), began),
                VOLTAGE: _at(times, self.time, self.voltage),
                TEMPERATURE: _at(times, self.case_time, self.case),
            },
            missing="nan",
        )


def _at(
    times: Float[np.ndarray, " m"],
    own: Float[np.ndarray, " n"],
    samples: Float[np.ndarray, " n"],
) -> Float[np.ndarray, " m"]:
    """Samples among other times, and NaN between them."""
    spread = np.full(len(times), np.nan)
    spread[np.searchsorted(times, own)] = samples
    return spread


def read(path: Path, ambient: float | None = None, case: Path | None = None) -> Table:
    """A record from a CSV file with the columns ``time [s],current [A],voltage [V]``, or more.

    A column ``temperature [degC]`` is the chamber's; a voltage may be left out but for the first row.

    Arguments:
        path: of the file.
        ambient: temperature of the chamber in degC where the file has none.
        case: a file with the columns ``tc1``, ``tc2``, ``tc3`` (on the cell) and ``tc4`` (in the chamber).

    Raises:
        DataError: for a file that cannot be read, or that lacks what is needed.
    """
    columns = _columns(path)
    for name in ("time [s]", "current [A]", "voltage [V]"):
        if name not in columns:
            raise ac.DataError(f"{path} has no column '{name}'; it has {', '.join(columns)}.")
    time, voltage = columns["time [s]"], columns["voltage [V]"]
    if np.isnan(voltage[0]):
        raise ac.DataError(f"{path}: the first row has no voltage, from which the cell starts.")
    current = np.where(np.abs(columns["current [A]"]) <= REST, 0.0, columns["current [A]"])
    chamber = columns.get("temperature [degC]", np.full(len(time), ambient))
    case_time, case_T = time[:2], chamber[:2]
    if case is not None:
        case_time, case_T, chamber = _thermocouples(_columns(case), time)
    if np.isnan(chamber.astype(float)).any():
        raise ac.DataError(f"{path} says no temperature of the chamber: give --ambient.")
    return Table(time, current, voltage, chamber + KELVIN, case_time, case_T + KELVIN)


def _thermocouples(
    columns: Mapping[str, np.ndarray], time: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times and means of the case's temperature, and the chamber's at the rows of the record; in degC.

    Both are means over a minute. After the last one the chamber stays as it was.
    """
    clock = columns["time [s]"]
    on_cell = np.mean([columns[f"tc{k} [degC]"] for k in (1, 2, 3)], axis=0)
    minute = max(1, round(60.0 / float(np.median(np.diff(clock)))))
    whole = len(clock) // minute * minute

    def means(values: np.ndarray) -> np.ndarray:
        return values[:whole].reshape(-1, minute).mean(axis=1)

    middle = means(clock)
    inside = (middle > time[0]) & (middle < time[-1])
    chamber = np.interp(time, middle, means(columns["tc4 [degC]"]))
    return middle[inside], means(on_cell)[inside], chamber


def _columns(path: Path) -> dict[str, np.ndarray]:
    """Columns by their headers, NaN where nothing stands."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            header, *rows = [row for row in csv.reader(file) if row]
            values = np.array(
                [[float(cell) if cell.strip() else np.nan for cell in row] for row in rows]
            )
    except (OSError, ValueError) as error:
        raise ac.DataError(f"{path} cannot be read: {error}") from None
    return {name.strip(): column for name, column in zip(header, values.T, strict=True)}


CHAMBER = {"hppc_10c": 10.0, "hppc_25c": 25.0, "hppc_40c": 40.0}
CASES = {"discharge_1c": "temperature_1c", "discharge_3c": "temperature_3c"}
NAMES = (*CHAMBER, *CASES)


def campaign(folder: Path) -> dict[str, Table]:
    """The five records of the campaign by name.

    Raises:
        DataError: for a file that is not there.
    """
    place = folder / "leaf_cell" if (folder / "leaf_cell").is_dir() else folder
    return {
        name: read(
            place / f"{name}.csv",
            CHAMBER.get(name),
            place / f"{CASES[name]}.csv" if name in CASES else None,
        )
        for name in NAMES
    }
