"""Published reference trajectories of a library of planar mechanics, simulated with default arguments."""

from typing import Any

import pytest

from tests.support.paths import SHARED
from tests.support.slow import some_slow
from tests.test_event_oracles import WIDTH, compare

FOLDER = SHARED / "oracles" / "planar"
NETLISTS = sorted(p.stem for p in FOLDER.glob("*.json"))
QUICK = ("PlanarPendulum",)
MACHINES = (
    "PlanarCraneCrab",
    "PlanarFreeBody",
    "PlanarMechanicsTest_Sensors_AbsoluteRotated",
    "PlanarMechanicsTest_Sensors_CutForces",
    "PlanarPistonEngine",
    "PlanarPowerDistanceDemo",
    "PlanarSpringDamperDemo",
    "PlanarVehicleComponents_TestIdealWheel",
    "PlanarWheelBasedCraneCrab",
)
"""Examples whose elements are in the others, too."""
SLOW = [name for name in NETLISTS if name not in QUICK + MACHINES]


def test_oracles_are_there() -> None:
    if not FOLDER.is_dir():
        pytest.skip("the reference trajectories lie beside the repository, in ../shared/oracles")
    assert len(NETLISTS) >= 16


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("name", some_slow(NETLISTS, SLOW, MACHINES))
def test_oracle(name: str, record_property: Any) -> None:
    errors = compare(name, FOLDER)
    for column, value in errors.items():
        record_property("oracle", (name, column, value))
    wrong = {column: f"{value:.1e}" for column, value in errors.items() if not value <= WIDTH}
    assert not wrong
