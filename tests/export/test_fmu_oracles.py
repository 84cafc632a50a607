"""Published reference trajectories again: the models as FMUs, simulated by fmpy with CVode."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.fmus import need_fmpy
from tests.test_oracles import FOLDER, NETLISTS, TOLERANCE, error, reference

pytestmark = pytest.mark.slow
TIGHT = 1e-10
"""Of CVode: fmpy multiplies it by nominal values to an absolute tolerance, that of `tests.test_oracles`."""
OUTPUTS = 20_000
"""Instants of the result, so many that lines between them are as good as the curve."""


def test_oracles_are_there() -> None:
    if not FOLDER.is_dir():
        pytest.skip("the reference trajectories lie beside the repository, in ../shared/oracles")
    assert NETLISTS


@pytest.mark.cases(slow=4)
@pytest.mark.parametrize("name", NETLISTS)
def test_oracle_as_fmu(name: str, tmp_path: Path, record_property: Any) -> None:
    fmpy = need_fmpy()
    model = ac.load(FOLDER / f"{name}.json")
    start, stop = (model.document[key] for key in ("start_time", "stop_time"))
    columns = model.document["compare"]
    system = ac.compile(model)
    path = ac.export.fmu(system, tmp_path / "model.fmu", outputs=columns)
    assert fmpy.validation.validate_fmu(str(path)) == []
    found = fmpy.simulate_fmu(
        str(path), fmi_type="ModelExchange", start_time=start, stop_time=stop, output=columns,
        output_interval=(stop - start) / OUTPUTS, relative_tolerance=TIGHT,
    )  # fmt: skip
    ts, expected = reference(FOLDER / f"{name}.csv", columns)
    ts = np.clip(ts, start, stop)
    times = np.unique(ts)
    errors = {
        column: error(ts, values, times, np.interp(times, found["time"], found[column]))
        for column, values in expected.items()
    }
    for column, value in errors.items():
        record_property("oracle", (name, column, value))
    wrong = {column: f"{value:.1e}" for column, value in errors.items() if not value <= TOLERANCE}
    assert not wrong
