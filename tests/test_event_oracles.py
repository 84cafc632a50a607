"""Published reference trajectories with events: a sample agrees if it lies in the tube of our values beside it."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.paths import SHARED
from tests.support.slow import some_slow
from tests.test_oracles import reference

FOLDER = SHARED / "oracles" / "msl_events"
NETLISTS = sorted(p.stem for p in FOLDER.glob("*.json"))
WIDTH = 2e-3
"""How far beyond the tube the reference may lie, relative to a column's range."""

ROUNDING = 1e-10
"""A column that moves less, relative to its size, is constant."""

BETWEEN = 5
"""Points of ours between two of the reference."""

BEFORE = 1e-9
"""Of an example's duration: so long before each of the reference's times we look, too."""


def test_oracles_are_there() -> None:
    if not FOLDER.is_dir():
        pytest.skip("the reference trajectories lie beside the repository, in ../shared/oracles")
    assert len(NETLISTS) >= 21


def around(times: np.ndarray, start: float, stop: float) -> np.ndarray:
    """The reference's times, points between them, and an instant before each, as there may be an event."""
    times = np.unique(np.clip(times, start, stop))
    parts = [times[:-1] + (times[1:] - times[:-1]) * k / BETWEEN for k in range(BETWEEN)]
    before = np.maximum(times - BEFORE * (stop - start), start)
    return np.unique(np.concatenate([*parts, times[-1:], before]))


def outside(ts: np.ndarray, values: np.ndarray, times: np.ndarray, found: np.ndarray) -> float:
    """How far, at most, the reference lies outside of the tube, relative to its range."""
    distinct = np.unique(ts)
    place = np.searchsorted(distinct, ts)
    low = distinct[np.maximum(place - 1, 0)]
    high = distinct[np.minimum(place + 1, len(distinct) - 1)]
    first = np.searchsorted(times, low - 1e-12, side="left")
    last = np.searchsorted(times, high + 1e-12, side="right")
    least = np.asarray([found[a:b].min() for a, b in zip(first, last, strict=True)])
    most = np.asarray([found[a:b].max() for a, b in zip(first, last, strict=True)])
    size = np.abs(values).max()
    scale = np.ptp(values) if np.ptp(values) > ROUNDING * size else size or 1.0
    return float(np.maximum(np.maximum(least - values, values - most), 0).max() / scale)


LONG = (
    "Analog_AD_DA_conversion",
    "Analog_CharacteristicThyristors",
    "Analog_OpAmps_SchmittTrigger",
    "Analog_OpAmps_SignalGenerator",
    "Analog_SwitchWithArc",
    "Blocks_IntegerNetwork1",
    "Blocks_TotalHarmonicDistortion",
    "ModelicaTest_Blocks_Discrete",
    "ModelicaTest_Blocks_Mean",
    "Rotational_LossyGearDemo3",
    "Rotational_OneWayClutch",
    "Translational_Brake",
)
"""Examples that take more than ten seconds to compile."""

LONGER = (
    "ModelicaTest_Rotational_TestFriction",
    "Rotational_CoupledClutches",
    "Rotational_Friction",
)
"""Examples that take longest: the same elements as in the others, more of them."""


@pytest.mark.cases(fast=1, slow=4)
@pytest.mark.parametrize("name", some_slow(NETLISTS, LONG, LONGER))
def test_oracle(name: str, record_property: Any) -> None:
    errors = compare(name, rtol=1e-8, atol=1e-10)
    for column, value in errors.items():
        record_property("oracle", (name, column, value))
    wrong = {column: f"{value:.1e}" for column, value in errors.items() if not value <= WIDTH}
    assert not wrong


def compare(name: str, folder: Path = FOLDER, **options: Any) -> dict[str, float]:
    """How far each column of an example lies outside of the tube; where that is far, with points at all events.

    Arguments:
        options: of `acausal.simulate`.
    """
    model = ac.load(folder / f"{name}.json")
    start, stop = (model.document[key] for key in ("start_time", "stop_time"))
    ts, columns = reference(folder / f"{name}.csv", model.document["compare"])
    system, clipped = ac.compile(model), np.clip(ts, start, stop)

    def errors(times: np.ndarray) -> tuple[ac.Solution, dict[str, float]]:
        found = ac.simulate(system, (start, stop), saveat=times, **options)
        return found, {
            column: outside(clipped, values, times, np.asarray(found[column]))
            for column, values in columns.items()
        }

    times = around(ts, start, stop)
    found, far = errors(times)
    if all(value <= WIDTH for value in far.values()):
        return far
    events = [event.t for event in found.events]
    return errors(np.unique(np.concatenate([times, events])))[1]
