"""The example on the four-bar: its states, and that the motor's torque determines the friction of its worn joint."""

import json
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from examples.four_bar import model, study


def test_the_crank_drives_the_linkage_and_the_joint_is_learned() -> None:
    system = ac.compile(model.FourBar())
    assert system.states[:2] == (model.ANGLE, model.RATE)
    assert system.inputs == (model.SPEED,)
    assert model.FRICTION in system.parameters()
    assert study.truth(np.array([0.0, 10.0])) == pytest.approx([0.7, 0.6])


@pytest.mark.slow
def test_the_torque_determines_the_friction_and_the_page_moves(tmp_path: Path) -> None:
    found = study.run(tmp_path)
    assert found["held_Nm"] < 1.1 * study.NOISE
    assert found["viscous_held_Nm"] > 3 * study.NOISE
    assert found["friction_Nm"] < 0.02
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    for piece in ('class="motion"', "<table>", "<math"):
        assert piece in page
    assert ">nan<" not in page
    told = page.split('id="data">')[1].split("</script>")[0]
    (motion,) = json.loads(told)["motions"]
    assert motion["trace"] == "coupler.body"
    assert {"crank", "rocker"} < {shape["name"] for shape in motion["shapes"]}
