"""The example on the double pendulum: its states, its published errors, and what it needs to be told."""

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from examples.double_pendulum import model, study
from tests.support.paths import SHARED

DATA = SHARED / "data"
REAL = pytest.mark.skipif(not DATA.is_dir(), reason="the measured data are not here")


def test_the_arms_angles_are_the_states_and_both_fall_as_published() -> None:
    system = model.published()
    assert sorted(system.states) == sorted((*model.ANGLES, *model.SPEEDS))
    at = dict.fromkeys(system.states, 0.0) | {"upper.phi": np.pi / 2, "lower.phi": np.pi / 2}
    rate = system.vector_field(
        0.0, np.array([at[n] for n in system.states]), None, system.parameters()
    )
    found = dict(zip(system.states, np.asarray(rate), strict=True))
    a, b, c = 0.005648574, 0.003145359, 0.002775425
    torques = np.array([0.3330452, 0.1576134])
    expected = np.linalg.solve([[a, c], [c, b]], torques)
    np.testing.assert_allclose([found["upper.w"], found["lower.w"]], expected, rtol=1e-5)


def test_data_that_are_not_there_are_named(tmp_path: Path) -> None:
    with pytest.raises(ac.DataError, match="swing_01"):
        study.load(tmp_path)


@REAL
@pytest.mark.slow
def test_the_published_numbers_leave_what_they_are_known_to_leave() -> None:
    system = model.published()
    found = study.error(system, system.parameters(), list(study.load(DATA).values()))
    assert found == pytest.approx(0.0097, abs=1e-4)
