"""Published reference trajectories: examples of the Modelica Standard Library, loaded, compiled, simulated, compared.

All take the same path; nothing here knows an example by its name, but one with state events, which
`tests.test_event_oracles` compares.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.paths import SHARED
from tests.support.slow import some_slow

FOLDER = SHARED / "oracles" / "msl"
EVENTS = {"HeatTransfer_ControlledTemperature"}
NETLISTS = sorted(p.stem for p in FOLDER.glob("*.json") if p.stem not in EVENTS)
TOLERANCE = 1e-3
"""Largest error relative to a column's range."""


def reference(path: Path, columns: list[str]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Times and columns of a CSV file."""
    with path.open(encoding="utf-8") as file:
        header = [name.strip('"') for name in file.readline().strip().split(",")]
        rows = np.loadtxt(file, delimiter=",")
    return rows[:, 0], {name: rows[:, header.index(name)] for name in columns}


def away_from_jumps(ts: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Where to compare: everywhere but where the curve jumps, an event that the file has twice."""
    compared = np.ones(len(ts), dtype=bool)
    window = 1e-9 * np.ptp(ts)
    for t in ts[1:][np.diff(ts) <= 0]:
        here = np.abs(ts - t) <= window
        if np.ptp(values[here]) > TOLERANCE * np.ptp(values):
            compared &= ~here
    return compared


def error(ts: np.ndarray, values: np.ndarray, times: np.ndarray, found: np.ndarray) -> float:
    """Largest difference, relative to the range of the reference (or its size, if it is constant)."""
    ours = found[np.searchsorted(times, ts)]
    scale = np.ptp(values) or np.abs(values).max() or 1.0
    compared = away_from_jumps(ts, values)
    return float(np.abs(ours - values)[compared].max() / scale)


LONG = (
    "Analog_HeatingRectifier",
    "Analog_OpAmps_LCOscillator",
    "FluidHeatFlow_TwoTanks",
    "Magnetic_FluxTubes_BasicSaturatedInductor",
)
"""They take more than a few seconds."""


def test_oracles_are_there() -> None:
    if not FOLDER.is_dir():
        pytest.skip("the reference trajectories lie beside the repository, in ../shared/oracles")
    assert len(NETLISTS) >= 25


@pytest.mark.cases(fast=2, slow=12)
@pytest.mark.parametrize("name", some_slow(NETLISTS, LONG))
def test_oracle(name: str, record_property: Any) -> None:
    model = ac.load(FOLDER / f"{name}.json")
    start, stop = (model.document[key] for key in ("start_time", "stop_time"))
    ts, columns = reference(FOLDER / f"{name}.csv", model.document["compare"])
    times = np.unique(np.clip(ts, start, stop))
    system = ac.compile(model)
    found = ac.simulate(system, (start, stop), saveat=times, rtol=1e-8, atol=1e-10)
    clipped = np.clip(ts, start, stop)
    errors = {
        column: error(clipped, values, times, np.asarray(found[column]))
        for column, values in columns.items()
    }
    for column, value in errors.items():
        record_property("oracle", (name, column, value))
    wrong = {column: f"{value:.1e}" for column, value in errors.items() if not value <= TOLERANCE}
    assert not wrong
