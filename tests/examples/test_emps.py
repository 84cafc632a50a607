"""The example on the EMPS: its axis and controller, its errors, and that it learns the friction."""

import numpy as np
import pytest

import acausal as ac
from examples.emps import model, study
from examples.measured.load import load
from tests.support.paths import SHARED

DATA = SHARED / "data"
REAL = pytest.mark.skipif(not DATA.is_dir(), reason="the measured data are not here")
FILES = ["DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"]


@pytest.mark.parametrize("name", list(model.KINDS))
def test_every_axis_has_the_same_states_and_trains_what_it_has(name: str) -> None:
    kind = model.KINDS[name]
    system = kind.build(model.Axis)
    assert system.states == ("carriage.s", "carriage.v")
    assert system.inputs == (model.INPUT,)
    assert set(kind.trained) <= set(system.parameters())


def test_a_kind_with_another_friction_can_be_built_alone_and_controlled() -> None:
    kind = model.KINDS[model.OURS].instead(model.Coulomb)
    for whole in (model.Axis, model.Controlled):
        assert "friction.Fc" in kind.build(whole).parameters()


def test_a_volt_accelerates_all_of_the_mass() -> None:
    kind = model.KINDS["white box, published parameters"]
    system = kind.build(model.Axis)
    params = system.parameters()
    rate = system.vector_field(0.0, np.zeros(2), np.array([2.0]), params)
    assert float(rate[1]) == pytest.approx((2 * model.GAIN + 3.1648) / 95.1089, rel=1e-6)


def test_the_controller_is_the_known_one() -> None:
    system = model.KINDS["white box, published parameters"].build(model.Controlled)
    assert set(system.inputs) == {model.REFERENCE, model.PULSES}
    s, v, reference = 0.1, 0.02, 0.1003
    x = np.zeros(len(system.states))
    x[[system.states.index("carriage.s"), system.states.index("carriage.v")]] = s, v
    x[system.states.index("late.x[1]")] = v  # a delay at rest, whose output is its input
    u = np.array([{model.REFERENCE: reference, model.PULSES: 0.5}[n] for n in system.inputs])
    volts = system.observe("limit.y", 0.0, x, u, system.parameters())
    assert float(volts) == pytest.approx(243.45 * (160.18 * (reference - s) - v) + 0.5, rel=1e-6)


def test_relative_errors_leave_out_the_border() -> None:
    x = np.ones(100)
    wrong = np.where(np.arange(100) < study.BORDER, 7.0, 1.1)
    assert study.relative(wrong, x) == pytest.approx(10)


def test_smoothed_signals_keep_what_is_slow() -> None:
    t = study.H * np.arange(2000)
    true = study.smooth({"qm": np.sin(5 * t), "vir": np.cos(5 * t)})
    inside = slice(200, -200)
    assert true["carriage.v"][inside] == pytest.approx(5 * np.cos(5 * t)[inside], abs=1e-3)
    assert true["carriage.a"][inside] == pytest.approx(-25 * np.sin(5 * t)[inside], abs=1e-2)
    late = np.cos(5 * (t - study.H / 2))
    assert true[model.INPUT][inside] == pytest.approx(late[inside], abs=1e-4)


@pytest.mark.slow
@REAL
def test_the_published_model_follows_the_record() -> None:
    training, _ = load(DATA, "EMPS", FILES)
    kind = model.KINDS["white box, published parameters"]
    errors = study.closed_loop(kind, {}, training, (0, 7_000))
    assert errors["closed_loop_position"] < 0.002
    assert errors["closed_loop_force"] < 5


@REAL
@pytest.mark.slow
def test_the_friction_is_learned_in_a_few_updates() -> None:
    """As well as the published parameters say it, with room for the updates that are missing."""
    training, test = load(DATA, "EMPS", FILES)
    white = study.closed_loop(model.KINDS["white box, published parameters"], {}, test)
    kind = model.KINDS[model.OURS]
    fit = study.train(kind, study.record(training), epochs=(100, 25))
    ours = study.closed_loop(kind, fit.params, test)
    assert all(error < 1.25 * white[name] for name, error in ours.items())
    assert force_opposes(fit)


@REAL
@pytest.mark.machines
def test_the_friction_is_learned() -> None:
    training, test = load(DATA, "EMPS", FILES)
    white = study.judge(model.KINDS["white box, published parameters"], {}, test)
    kind = model.KINDS[model.OURS]
    fit = study.train(kind, study.record(training))
    ours = study.judge(kind, fit.params, test)
    assert ours["open_loop_test_mm"] < 5
    for name in ("position", "acceleration", "force"):
        assert ours[f"closed_loop_{name}"] < white[f"closed_loop_{name}"]
    assert ours["closed_loop_velocity"] < 1.05 * white["closed_loop_velocity"]
    kind = model.KINDS["passive network, with a tolerance of the offset alone"]
    along = study.closed_loop(kind, study.train(kind, study.record(training)).params, test)
    assert all(error < 1.02 * white[name] for name, error in along.items())
    assert force_opposes(fit)


def force_opposes(fit: ac.Fit) -> bool:
    net = fit.params["friction.net"]
    places = [(v, s) for v in np.linspace(-0.2, 0.2, 21) for s in (0.0, 0.12, 0.25)]
    return all(float(net(v, s)) * v >= 0 for v, s in places)
