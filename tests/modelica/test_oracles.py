"""The reference models as Modelica text, exported and written by hand: the systems of the netlists."""

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from tests.support.paths import SHARED

FOLDER = SHARED / "oracles"
NETLISTS = sorted(p.relative_to(FOLDER).with_suffix("").as_posix() for p in FOLDER.glob("*/*.json"))
FILE = Path(__file__).with_name("Oracles.mo")
BY_HAND = (
    "T.Translational_SignConvention",
    "T.Translational_Damper",
    "T.Translational_Oscillator",
    "T.Translational_ElastoGap",
    "R.Rotational_First",
    "R.Rotational_FirstGrounded",
    "Rotational_ElasticBearing",
    "HeatTransfer_TwoMasses",
    "E.Analog_CauerLowPassAnalog",
    "E.Analog_ShowVariableResistor",
)

OTHER_STATES = ("planar/PlanarGearComponents_PlanetaryGear",)
"""Of an angle and another one that is rigidly joined to it the text chooses the other one."""


def agree(ours: ac.System, other: ac.System, start: float, end: float) -> None:
    """Compare the trajectories of the states of one system with those of another one, by name or in their order."""
    assert len(ours.states) == len(other.states)
    times, tolerances = np.linspace(start, end, 6), {"rtol": 1e-8, "atol": 1e-10}
    one, two = (ac.simulate(s, (start, end), saveat=times, **tolerances) for s in (ours, other))
    names = ours.states if {*ours.states} <= {*other.variables} else other.states
    for a, b in zip(ours.states, names, strict=True):
        np.testing.assert_allclose(two[b], one[a], rtol=1e-9, atol=1e-9 * (1 + np.ptp(one[a])))


def test_oracles_are_there() -> None:
    if not FOLDER.is_dir():
        pytest.skip("the reference trajectories lie beside the repository, in ../shared/oracles")
    assert len(NETLISTS) >= 63


@pytest.mark.cases(fast=0, slow=4)
@pytest.mark.parametrize("name", NETLISTS)
def test_an_export_is_the_system_of_the_netlist(name: str, tmp_path: Path) -> None:
    """In turn with the classes of the standard library, and with all classes in the file."""
    model = ac.load(FOLDER / f"{name}.json")
    ours = ac.compile(model)
    whole = NETLISTS.index(name) % 2 == 0
    again = ac.compile(ac.load(ac.export.modelica(ours, tmp_path / "out.mo", selfcontained=whole)))
    assert again.states == ours.states or name in OTHER_STATES
    start, stop = (model.document[key] for key in ("start_time", "stop_time"))
    agree(ours, again, start, start + (stop - start) / 10)


@pytest.mark.cases(fast=1, slow=6)
@pytest.mark.parametrize("name", BY_HAND)
def test_what_is_written_by_hand_is_the_system_of_the_netlist(name: str) -> None:
    if not FOLDER.is_dir():
        pytest.skip("the netlists lie beside the repository, in ../shared/oracles")
    ours = ac.compile(ac.load(FOLDER / "msl" / f"{name.rpartition('.')[2]}.json"))
    agree(ours, ac.compile(ac.load(FILE, f"Oracles.{name}")), 0.0, 2.0)
