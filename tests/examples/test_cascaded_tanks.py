"""The example of the Cascaded Tanks: its models, how it is judged, and what it learns of the measurement."""

import jax
import numpy as np
import pytest

import acausal as ac
from examples.cascaded_tanks import model, study
from examples.measured import judge, load
from tests.support.paths import SHARED

DATA = SHARED / "data"
REAL = pytest.mark.skipif(not DATA.is_dir(), reason="the measured data are not here")


WAY = {"solver": study.SOLVER, "dt": study.STEP}


@pytest.mark.parametrize("make", model.MODELS.values(), ids=lambda make: make.__name__)
def test_all_models_have_explicit_states_and_what_they_train(make) -> None:
    tanks, moves = make()
    system = ac.compile(tanks)
    assert system.states[:2] == ("upper.level", "lower.level")
    assert system.states[2:] == (
        ("float.y",) if make not in (model.linear, model.white_box) else ()
    )
    assert system.inputs == (model.INPUT,)
    assert set(moves) <= set(system.parameters())


def test_the_lower_level_comes_from_the_first_samples_where_the_upper_one_is_given() -> None:
    system = ac.compile(model.white_box()[0])
    u = 3.0 + np.sin(np.arange(40) / 5)
    data = study.record(u, np.zeros(40))
    start = {"upper.level": 0.11, "lower.level": 0.08}
    true = judge.follow(system, None, data, start, **WAY)
    told = study.record(u, np.asarray(true[model.OUTPUT]))
    way = {**WAY, "known": study.KNOWN, "given": {"upper.level": 0.11}}
    for guess in (None, {"lower.level": 0.12}):
        found = judge.simulate(system, None, told, model.OUTPUT, guess=guess, **way)
        assert float(found["lower.level"][0]) == pytest.approx(0.08, rel=1e-6)
        assert judge.rms(found, told, model.OUTPUT, known=study.KNOWN) < 1e-6


def test_a_float_that_sticks_rests_within_its_slack_and_follows_beyond() -> None:
    system = ac.compile(model.rising()[0])
    slack, within = system.parameters()["slack.uMax"], 2.0
    u = np.repeat([3.0, 1.5, 3.0], 150)
    start = {"upper.level": 0.09, "lower.level": 0.09, "float.y": 0.09}
    run = judge.follow(system, None, study.record(u, 0 * u), start, **WAY)
    level, at = np.asarray(run["lower.level"]), np.asarray(run["float.y"])
    fastest = np.max(np.abs(np.diff(level))) / study.SAMPLE_TIME
    assert slack < np.max(np.abs(at - level)) <= slack + within * fastest
    resting = np.diff(at) == 0
    assert np.max(np.abs(np.diff(level))[resting]) > 0.1 * slack


def test_a_training_does_not_see_what_is_held_out() -> None:
    begin, end = study.HELD[0]
    weights = study.training_weights(study.HELD[0])
    assert weights is not None
    seen = [weights[model.OUTPUT](study.SAMPLE_TIME * k) for k in range(study.SAMPLES)]
    assert seen == [float(not begin <= k < end) for k in range(study.SAMPLES)]
    assert study.training_weights(None) is None


def test_water_is_held_back_by_no_rim_but_leaves_over_it() -> None:
    """At rest what the pump brings leaves through both holes, or else over the rims."""
    system = ac.compile(model.white_box()[0])
    for volts, full in ((2.0, False), (8.0, True)):
        data = study.record(np.full(400, volts), np.zeros(400))
        start = {"upper.level": 0.09, "lower.level": 0.09}
        run = judge.follow(system, None, data, start, solver=study.SOLVER, dt=study.STEP)
        end = {n: float(run[f"{n}.m_flow"][-1]) for n in ("upper_hole", "over", "past")}
        assert sum(end.values()) == pytest.approx(6e-3 * volts, rel=1e-3)
        assert (end["past"] > 0) == full
        assert (float(run["upper.level"][-1]) > model.RIM) == full


@REAL
@pytest.mark.slow
def test_the_sensor_is_learned_in_a_few_updates() -> None:
    (measured,) = load.load(DATA, "Cascaded_Tanks", ["dataBenchmark.mat"])
    tanks, moves = model.rising()
    system = ac.compile(tanks)
    (ours,) = study.fits(measured, system, moves, [system.parameters(0)], None, epochs=60)
    assert study.test_error(measured, ours) < 0.36
    assert curve_rises(ours)


@REAL
@pytest.mark.machines
@pytest.mark.filterwarnings("ignore:.*limit of its modifier")  # some of the starts do
def test_the_sensor_is_learned() -> None:
    (measured,) = load.load(DATA, "Cascaded_Tanks", ["dataBenchmark.mat"])
    tanks, moves = model.rising()
    system = ac.compile(tanks)
    starts = [system.parameters(seed) for seed in range(study.STARTS)]
    (ours,) = study.fits(measured, system, moves, starts, None)
    assert study.test_error(measured, ours) < 0.25
    assert curve_rises(ours)
    assert 1e-4 < float(ours.params["slack.uMax"]) < 2e-3


def curve_rises(fit: ac.Fit) -> bool:
    learned = jax.vmap(fit.params[model.CURVE])(np.linspace(0.0, 0.2, 41))
    return bool(np.all(np.diff(learned) >= 0))
