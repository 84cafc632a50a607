"""Published reference trajectories of the planar library: mechanisms, wheels and vehicles, compared by the tube."""

import pytest

from tests.support.paths import SHARED
from tests.support.slow import some_slow
from tests.test_event_oracles import WIDTH, compare

FOLDER = SHARED / "oracles" / "planar"
NETLISTS = sorted(p.stem for p in FOLDER.glob("*.json"))


def test_oracles_are_there() -> None:
    if not FOLDER.is_dir():
        pytest.skip("the reference trajectories lie beside the repository, in ../shared/oracles")
    assert len(NETLISTS) >= 16
