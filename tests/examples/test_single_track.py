"""The example on the single-track vehicle: that a campaign determines the tyres of both axles."""

import json
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from examples.single_track import model, study


def test_the_vehicle_is_steered_and_its_tyres_are_learned() -> None:
    system = ac.compile(model.SingleTrack())
    assert system.inputs == (model.STEER,)
    assert {f"{axle}.net" for axle in model.AXLES} < set(system.parameters())
    assert sum(model.LOADS.values()) == pytest.approx(model.MASS * model.GRAVITY)
    assert study.truth("front", np.array([0.0, 1e3])) == pytest.approx([0.0, 0.67], abs=0.01)


@pytest.mark.slow
def test_a_campaign_determines_the_tyres(tmp_path: Path) -> None:
    found = study.run(tmp_path)
    for error, linear, target in (
        ("held_rad_s", "linear_held_rad_s", model.YAW_RATE),
        ("held_m_s2", "linear_held_m_s2", model.LATERAL),
    ):
        assert found[error] < 1.2 * study.NOISE[target]
        assert found[linear] > 3 * study.NOISE[target]
    assert found["friction"] < 0.05
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert ">nan<" not in page
    (motion,) = json.loads(page.split('id="data">')[1].split("</script>")[0])["motions"]
    assert motion["trace"] == "body"
