"""The example of the Cascaded Tanks: its models, how it is judged, and what it learns of the measurement."""

from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from examples.cascaded_tanks import model, study
from examples.measured import judge, load

DATA = Path(__file__).parent.parent.parent / "shared" / "data"
REAL = pytest.mark.skipif(not DATA.is_dir(), reason="the measured data are not here")


@pytest.mark.parametrize("make", model.MODELS.values(), ids=lambda make: make.__name__)
def test_all_models_have_two_explicit_states_and_what_they_train(make) -> None:
    tanks, moves = make()
    system = ac.compile(tanks)
    assert system.states == ("upper.level", "lower.level")
    assert system.inputs == (model.INPUT,)
    assert set(moves) <= set(system.parameters())


def test_the_lower_level_comes_from_the_first_samples_where_the_upper_one_is_given() -> None:
    system = ac.compile(model.white_box()[0])
    u = 3.0 + np.sin(np.arange(40) / 5)
    data = study.record(u, np.zeros(40), 40)
    start = {"upper.level": 0.11, "lower.level": 0.08}
    way = {"solver": study.SOLVER, "dt": study.STEP}
    true = judge.follow(system, None, data, start, **way)
    told = study.record(u, np.asarray(true[model.OUTPUT]), 40)
    given = {"upper.level": 0.11}
    found = judge.simulate(
        system, None, told, model.OUTPUT, known=study.KNOWN, given=given, **way
    )  # fmt: skip
    assert float(found["lower.level"][0]) == pytest.approx(0.08, rel=1e-6)
    assert judge.rms(found, told, model.OUTPUT, known=study.KNOWN) < 1e-6


def test_water_is_held_back_by_no_rim_but_leaves_over_it() -> None:
    """At rest what the pump brings leaves through both holes, or else over the rims."""
    system = ac.compile(model.white_box()[0])
    for volts, full in ((2.0, False), (8.0, True)):
        data = study.record(np.full(400, volts), np.zeros(400), 400)
        start = {"upper.level": 0.09, "lower.level": 0.09}
        run = judge.follow(system, None, data, start, solver=study.SOLVER, dt=study.STEP)
        end = {n: float(run[f"{n}.m_flow"][-1]) for n in ("upper_hole", "over", "past")}
        assert sum(end.values()) == pytest.approx(6e-3 * volts, rel=1e-3)
        assert (end["past"] > 0) == full
        assert (float(run["upper.level"][-1]) > model.RIM) == full


@REAL
@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*has run into the limit of its modifier")  # of the white box
def test_the_sensor_and_the_white_box_are_learned() -> None:
    (measured,) = load.load(DATA, "Cascaded_Tanks", ["dataBenchmark.mat"])
    (white,) = study.train(measured, model.white_box)
    (ours,) = study.train(measured, model.with_tame_curve)
    assert ours.errors["validation"] < 0.25 < 0.3 < white.errors["validation"]
    assert ours.errors["test"] < white.errors["test"]
    areas = [float(ours.fit.params[f"{tank}_hole.area"]) for tank in ("upper", "lower")]
    assert areas[0] == pytest.approx(areas[1], rel=0.1)
