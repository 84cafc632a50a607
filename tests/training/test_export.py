"""A trained model, written for other tools with its model card."""

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal.training.presentation.model_card import markdown
from tests.support.exported_c import need_compiler
from tests.support.oscillator import learned, record


@pytest.fixture(scope="module")
def fit() -> ac.Fit:
    return ac.fit(
        learned(), record(), "mass.a", sequence_length=0.5, batch_size=4, epochs=5, modifiers=["mass.m"],
        progress=False, validation=0.2,
    )  # fmt: skip


def read(path: Path) -> dict:
    return json.loads(path.with_name(path.name + ".json").read_text())


@pytest.mark.slow
def test_ranges_are_those_of_the_trained_record(fit):
    ((low, high),) = fit.ranges["extra.net"]
    seen = fit.arguments["extra.net"][:, 0]
    assert (low, high) == (seen.min(), seen.max())
    assert low < 0 < high


@pytest.mark.slow
def test_an_fmu_has_its_flag_and_its_card(fit, tmp_path):
    need_compiler()
    path = fit.export(tmp_path / "oscillator.fmu", notes={"loss of the linear model": 0.44})
    card = read(path)
    (file,) = card["files"]
    assert file["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
    (argument,) = card["networks"]["extra.net"]["arguments"]
    assert (argument["low"], argument["high"]) == fit.ranges["extra.net"][0]
    assert argument["name"] == "extra.s_rel [m]"
    assert card["losses"]["after training"] == fit.loss
    assert card["losses"]["over what is held out"] == fit.validation_loss
    assert card["training"]["updates done"] == 5
    assert card["training"]["sequence_length"] == "0.5"
    trained, held_out = card["data"]["trained on"], card["data"]["held out"]
    assert trained[0]["samples"] == 1601
    assert trained[0]["targets"] == {"mass.a": {"unit": "m/s2", "samples": 1601}}
    assert held_out[0]["targets"]["mass.a"]["samples"] == 400
    text = path.with_name("oscillator.fmu.md").read_text()
    assert text == markdown(card)
    assert file["sha256"] in text
    assert "| loss of the linear model | 0.44 |" in text
    assert "fit.export(..., confidence=fit.confidence())" in text
    fmpy = pytest.importorskip("fmpy", reason="fmpy is not installed")
    names = [v.name for v in fmpy.read_model_description(str(path)).modelVariables]
    assert "outside_training_range" in names


def test_c_has_the_trained_numbers_and_its_flag(fit, tmp_path):
    path = fit.export(tmp_path / "firmware" / "plant.c", outputs=["mass.a"])
    header = path.with_suffix(".h").read_text()
    assert "plant_outside(" in header
    assert "`plant_outside` tells when" in path.with_name("plant.c.md").read_text()
    assert repr(float(fit.params["mass.m"])) in path.read_text()
    assert [f["name"] for f in read(path)["files"]] == ["plant.c", "plant.h"]
    assert read(path)["export"]["options"] == {"outputs": "['mass.a']"}
    path = fit.export(tmp_path / "firmware" / "plant.c", ranges={})
    assert "outside" not in path.with_suffix(".h").read_text()
    assert "plant_outside" not in path.with_name("plant.c.md").read_text()


@pytest.mark.parametrize("ending", ["onnx", "mlir", "mo"])
def test_other_forms(fit, tmp_path, ending):
    if ending == "onnx":
        pytest.importorskip("onnx", reason="onnx is not installed")
    path = fit.export(tmp_path / f"Shipped.{ending}")
    assert path.stat().st_size > 500
    assert read(path)["files"][0]["name"] == path.name


@pytest.mark.slow
def test_the_card_tells_how_sure_it_is(fit, tmp_path):
    sure = fit.confidence()
    path = fit.export(tmp_path / "a.mlir", confidence=sure)
    card = read(path)
    assert card["confidence"] == sure.summary()
    assert card["parameters"]["mass.m"]["one sigma"] == sure.parameters["mass.m"]
    assert card["networks"]["extra.net"]["one sigma"] == pytest.approx(
        np.median(sure.laws["extra.net"].sigma)
    )
    assert f"- {sure.summary()[0]}" in path.with_name("a.mlir.md").read_text()


@pytest.mark.slow
def test_what_lies_beside_the_model_is_told(tmp_path):
    found = ac.fit(
        learned(), {"a": record(), "b": record()}, "mass.a", sequence_length=0.5, batch_size=2, epochs=2,
        per_record={"mass.m": None}, delays={"push.f": ac.Delay(start=0.01, max=0.02)}, progress=False,
    )  # fmt: skip
    delay = found.delays["push.f"]
    with pytest.warns(UserWarning, match=rf"does not have them.*'push.f' by {delay:.4g} s"):
        path = found.export(tmp_path / "late.mlir")
    card = read(path)
    assert card["beside the model"] == {"delays": {"push.f": delay}, "lags": {}}
    assert card["parameters"]["delay(push.f)"]["value"] == delay
    assert card["parameters"]["delay(push.f)"]["unit"] == "s"
    assert card["by record"] == {n: r.parameters for n, r in found.records.items()}
    text = path.with_name("late.mlir.md").read_text()
    assert f"| delay | push.f | {delay:.5g} |" in text
    assert "| record | mass.m |" in text


def test_wrong_calls_are_refused(fit, tmp_path):
    with pytest.raises(ac.DataError, match=r"no form '\.onx'; did you mean '\.onnx'"):
        fit.export(tmp_path / "a.onx")
    with pytest.raises(ac.DataError, match=r"fit\.export: 3 is not a path"):
        fit.export(3)
    (tmp_path / "a.mlir.md").mkdir()
    with pytest.raises(ac.DataError, match=r"fit\.export: '.*a\.mlir\.md' is a folder;"):
        fit.export(tmp_path / "a.mlir")
    assert not (tmp_path / "a.mlir").exists()
