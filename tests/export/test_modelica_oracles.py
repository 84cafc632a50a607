"""Published reference trajectories once more: the models as Modelica text, compiled and simulated by rumoca."""

import re
from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.paths import SHARED
from tests.test_event_oracles import WIDTH, outside
from tests.test_oracles import TOLERANCE, error, reference

FOLDERS = {"msl": TOLERANCE, "msl_events": WIDTH}
CASES = [
    (folder, path.stem)
    for folder in FOLDERS
    for path in sorted((SHARED / "oracles" / folder).glob("*.json"))
    if (folder, path.stem) != ("msl", "HeatTransfer_ControlledTemperature")  # in msl_events, too
]
OTHERWISE = {
    "clutch.startBackward": "initial() holds until the first event (Modelica 3.6, section 8.6)",
    "clutch1.startBackward": "initial() holds until the first event (Modelica 3.6, section 8.6)",
    "triggeredSampler.y": "what holds at the start comes true then (Modelica 3.6, section 8.3.5)",
    "firstOrderHold.c": "a when-clause reads what another one assigned before (Modelica 3.6, appendix B)",
}
"""Columns that rumoca computes otherwise than the standard says, and the rule."""


def test_oracles_are_there() -> None:
    if not (SHARED / "oracles").is_dir():
        pytest.skip("the reference trajectories lie beside the repository, in ../shared/oracles")
    assert len(CASES) >= 46


@pytest.mark.cases(fast=5, slow=12)
@pytest.mark.parametrize(("folder", "name"), CASES)
def test_oracle_as_modelica(folder: str, name: str, tmp_path: Any) -> None:
    rumoca = pytest.importorskip("rumoca", reason="rumoca, which runs the text, is not installed")
    source = SHARED / "oracles" / folder / name
    model = ac.load(source.with_suffix(".json"))
    start, stop = (model.document[key] for key in ("start_time", "stop_time"))
    ts, columns = reference(source.with_suffix(".csv"), model.document["compare"])
    path = ac.export.modelica(ac.compile(model), tmp_path / "shipped.mo", selfcontained=True)
    text = path.read_text()
    title = re.findall(r"^  model (\w+)", text, re.MULTILINE)[-1]
    text += f"model Run\n  shipped.{title} m;\nend Run;\n"
    config = rumoca.SimConfig(rtol=1e-8, atol=1e-10)
    found = (
        rumoca.Session()
        .loads(text, model="Run")
        .simulate((start, stop), dt=(stop - start) / 5000, config=config)
    )
    times, clipped = np.asarray(found.time), np.clip(ts, start, stop)
    wrong = {}
    for column, values in columns.items():
        ours = np.asarray(found["m." + re.sub(r"\[(\d+)\]\.", r"_\1.", column)], float)
        if folder == "msl":
            grid = np.unique(clipped)
            far = error(clipped, values, grid, np.interp(grid, times, ours))
        else:
            far = outside(clipped, values, times, ours)
        if not far <= FOLDERS[folder] and column not in OTHERWISE:
            wrong[column] = f"{far:.1e}"
    assert not wrong
