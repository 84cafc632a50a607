"""Linear laws in the place of networks, before the training of these."""

from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import ANY

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import (
    electrical as el,
    neural,
    rotational as rot,
    thermal,
    translational as tl,
)
from acausal.networks import (
    Affine,
    Law,
    OffsetCorrected,
    Scales,
    kept_promises,
    lacks_scales,
    linear_shape,
    networks,
    with_scales,
)
from acausal.training.auto.automatic import _scales_of, _stages
from acausal.training.auto.linear_start import (
    LinearStart,
    linear_module,
    linear_start,
    with_constants_at_zero,
)
from acausal.training.auto.step_choice import StepChoice, tried_steps
from acausal.training.build_problem import build_problem
from acausal.training.objective.problem import Problem
from acausal.training.objective.start_prior import StartPrior
from acausal.training.options import FitOptions
from acausal.training.strategy import segments
from benchmarks.by_default import Wired
from tests.support.hybrid_training import Zone

T = np.linspace(0.0, 0.02, 101)
VOLTS = np.sin(900 * T) + 0.5 * np.sin(2100 * T + 1)


def problem_of(learner: ac.Component, target: str, **signals: np.ndarray) -> Problem:
    system = ac.compile(learner)
    params = system.parameters()
    linear = {n: linear_module(linear_shape(net)) for n, net in networks(params).items()}
    options = FitOptions(solver="rk4")
    record = ac.Data(T, signals)
    return build_problem(system, {"run": record}, (target,), {**params, **linear}, options)


def start_of(problem: Problem) -> LinearStart:
    fresh = problem.system.parameters()
    return linear_start(problem, {n: linear_shape(fresh[n]) for n in problem.networks})


def element() -> ac.Component:
    return neural.Resistance(el.PositivePin, width=4, depth=1)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("solver", ["rk4", "kvaerno3"])
def test_a_linear_law_is_found_closer_than_its_decade(solver: str) -> None:
    """By Gauss-Newton, in implicit steps, too."""
    circuit = Wired(
        [("source.p", "element.p"), ("element.n", "capacitor.p"), ("capacitor.n", "source.n", "ground.p")],
        source=el.SignalVoltage(), element=element(), capacitor=el.Capacitor(C=1e-6), ground=el.Ground(),
    )  # fmt: skip
    v = np.zeros(len(T))
    for k, h in enumerate(np.diff(T)):  # exact for the mean voltage of a sample
        mean = (VOLTS[k] + VOLTS[k + 1]) / 2
        v[k + 1] = mean + (v[k] - mean) * np.exp(-h / 2e-3)
    problem = problem_of(circuit, "capacitor.v", **{"source.v": VOLTS, "capacitor.v": v})
    found = start_of(StepChoice(solver).over(problem))
    assert found.loss < 0.01
    assert found.laws["element.net"].slope[0] == pytest.approx(5e-4, rel=0.01)


def test_a_law_counts_by_what_is_usual_not_by_peaks() -> None:
    seen = np.concatenate([np.linspace(-1.0, 1.0, 999), [50.0]])[:, None]
    nothing, shape = Affine((1.0,), 0.0), linear_shape(Law()(0))
    (reach,) = _scales_of(seen, nothing, nothing, shape)[0].reach
    assert reach == pytest.approx(50.0 / 4)
    (reach,) = _scales_of(seen[:-1], nothing, nothing, shape)[0].reach
    assert reach == pytest.approx(np.sqrt(1 / 3), rel=0.01)


def test_models_with_events_begin_in_implicit_steps() -> None:
    assert list(tried_steps(FitOptions(), events=True)) == [StepChoice("kvaerno3", 1, ANY)]
    assert next(tried_steps(FitOptions(), events=False)).solver == "rk4"


@pytest.mark.slow
def test_laws_that_act_only_together_are_found_together() -> None:
    """Two resistors in series, one alone of which lets nothing through."""
    circuit = Wired(
        [("source.p", "one.p"), ("one.n", "other.p"), ("other.n", "capacitor.p"),
         ("capacitor.n", "source.n", "ground.p")],
        source=el.SignalVoltage(), one=element(), other=element(), capacitor=el.Capacitor(C=1e-6), ground=el.Ground(),
    )  # fmt: skip
    fine = np.linspace(0.0, T[-1], 100 * (len(T) - 1) + 1)
    drive, v = np.interp(fine, T, VOLTS), np.zeros(len(fine))
    for k, h in enumerate(np.diff(fine)):  # Euler, with 1 ms
        v[k + 1] = v[k] + h / 1e-3 * (drive[k] - v[k])
    found = start_of(
        problem_of(circuit, "capacitor.v", **{"source.v": VOLTS, "capacitor.v": v[::100]})
    )
    assert found.loss < 0.02
    (one,), (other,) = (found.laws[n].slope for n in ("one.net", "other.net"))
    assert one * other / (one + other) * 1e3 == pytest.approx(1.0, rel=0.02)


@pytest.mark.slow
def test_a_constant_that_nothing_determines_is_left_out() -> None:
    """The current of a coil whose start is not measured takes any constant of the current beside it."""

    def circuit(coil: ac.Component) -> ac.Component:
        return Wired(
            [("source.p", "resistor.p"), ("resistor.n", "coil.p", "capacitor.p", "beside.p"),
             ("coil.n", "capacitor.n", "beside.n", "source.n", "ground.p")],
            source=el.SignalVoltage(), resistor=el.Resistor(R=100.0), coil=coil, capacitor=el.Capacitor(C=1e-5),
            beside=element(), ground=el.Ground(),
        )  # fmt: skip

    fine = np.linspace(0.0, T[-1], 200 * (len(T) - 1) + 1)
    drive, x = np.interp(fine, T, VOLTS), np.zeros((len(fine), 2))
    for k, h in enumerate(np.diff(fine)):  # Euler
        v, i = x[k]
        x[k + 1] = v + h / 1e-5 * ((drive[k] - v) / 100 - i - 5e-3 * v), i + h / 0.1 * v
    signals = {"source.v": VOLTS, "capacitor.v": x[::200, 0], "coil.i": x[::200, 1]}
    scales = {"beside.net": Scales((0.0,), (1.0,), 5e-3)}

    def kept(*measured: str, i: float = 0.0, size: float = 1.0) -> LinearStart:
        names = ("source.v", "capacitor.v", *measured)
        learner = circuit(el.Inductor(L=0.1, i=ac.Start(i)))
        problem = problem_of(learner, "capacitor.v", **{n: signals[n] for n in names})
        if (prior := problem.start_prior) is not None:
            problem = replace(problem, start_prior=StartPrior(size * prior.scale))
        start = start_of(problem)
        return with_constants_at_zero(start, {"beside.net": linear_shape(Law()(0))}, scales)

    assert kept("coil.i").loose == ()
    unknown = kept()
    assert unknown.loose == ("beside.net",)
    assert kept(size=1e-2).loose == unknown.loose  # before training, the current hardly moves
    assert kept(i=0.1).loose == ()  # it would have to start many times its range away
    law = unknown.laws["beside.net"]
    assert law.offset == 0.0
    assert law.slope[0] == pytest.approx(5e-3, rel=0.02)


@pytest.mark.parametrize("inputs", [1, 2])
def test_of_two_laws_that_share_a_constant_one_has_none(inputs: int) -> None:
    fine = np.linspace(0.0, T[-1], 100 * (len(T) - 1) + 1)
    push, x = np.interp(fine, T, VOLTS), np.zeros((len(fine), 2))
    for k, h in enumerate(np.diff(fine)):  # Euler
        s, v = x[k]
        x[k + 1] = s + h * v, v + h / 1e-3 * (push[k] - 2.0 * v - 3e3 * s - 0.5)
    signals = {"push.f": VOLTS, "mass.s": x[::100, 0], "mass.v": x[::100, 1]}
    given: dict[str, Any] = {"width": 4, "depth": 1, "secondary": ["T"][: inputs - 1]}
    if inputs == 2:
        signals |= {"spring.T": 20 + 1e3 * T, "damper.T": 20 + np.cos(900 * T)}
    sprung = Wired(
        [("wall.flange", "spring.flange_a", "damper.flange_a"),
         ("spring.flange_b", "damper.flange_b", "mass.flange_a"), ("mass.flange_b", "push.flange")],
        wall=tl.Fixed(), spring=neural.Compliance(**given), damper=neural.Resistance(**given),
        mass=tl.Mass(m=1e-3), push=tl.Force(),
    )  # fmt: skip
    start = start_of(problem_of(sprung, "mass.s", **signals))
    shapes = {n: linear_shape(Law(secondary=inputs - 1)(0)) for n in start.laws}
    scales = {n: Scales((0.0, 20.0)[:inputs], (1.0, 1.0)[:inputs], 1.0) for n in shapes}
    kept = with_constants_at_zero(start, shapes, scales)
    if inputs == 2:  # of several inputs, laws keep their constants, and both are named
        assert set(kept.loose) == set(shapes)
        assert kept.laws == start.laws
        return
    assert len(kept.loose) == 1
    assert sum(law.offset for law in kept.laws.values()) == pytest.approx(0.5, rel=0.05)


def test_a_law_without_constant_goes_along_in_files(tmp_path: Path) -> None:
    system = ac.compile(
        Wired(
            [("element.p", "capacitor.p"), ("element.n", "capacitor.n", "ground.p")],
            element=element(), capacitor=el.Capacitor(C=1.0), ground=el.Ground(),
        )
    )  # fmt: skip
    own = system.parameters()["element.net"]
    law = Affine((3.0,), -2.0)
    net = with_scales(own, Scales((20.0,), (5.0,), 15.0), law, without_constant=True)
    assert isinstance(net, OffsetCorrected)
    assert float(net(jnp.asarray(0.0))) == 0.0
    ac.save_params({**system.parameters(), "element.net": net}, tmp_path / "p.safetensors")
    loaded = ac.load_params(tmp_path / "p.safetensors", system)["element.net"]
    for v in (-4.0, 20.0, 31.0):
        assert float(loaded(v)) == float(net(v))


@pytest.mark.slow
def test_a_relay_is_followed_from_the_start_for_ever_longer() -> None:
    """Nothing measured says whether it is on in the middle of a record."""
    problem = problem_of(
        Zone(neural.Resistance(thermal.HeatPort, width=4, depth=1)),
        "zone.T",
        **{"zone.T": 290 + np.sin(T)},
    )
    assert problem.records.x is not None
    none = FitOptions()
    planned = _stages(problem, 101, 25, problem.params, problem.networks, False, None, none)
    titles = [*(f"first {n} samples" for n in (25, 35, 48, 68)), "whole record"]
    assert [stage.title for stage in planned] == [*titles, "whole record, longer"]
    first, *_, whole = segments(problem, planned, none)
    counts = np.asarray(first.objective.records.weight) > 0  # of one program with the whole record
    assert len(counts) == 101
    assert counts[:25].all()
    assert not counts[25:].any()
    assert whole.stage.gain == pytest.approx(2e-3)
    assert whole.epochs > 10 * whole.evaluate_every  # it goes on for as long as it gains something


def test_a_positive_law_begins_at_a_constant(tmp_path: Path) -> None:
    """Friction that locks has the sign of the speed: a motor's, in a newton millimetre, not in newton metres."""
    shaft = Wired(
        [("drive.flange", "inertia.flange_a"), ("inertia.flange_b", "friction.flange_a")],
        drive=rot.Torque(), inertia=rot.Inertia(J=1e-6), friction=neural.BearingFriction(width=4, depth=1),
    )  # fmt: skip
    system = ac.compile(shaft)
    own = system.parameters()["friction.net"]
    assert lacks_scales(own)
    shape = linear_shape(own)
    assert shape.positive
    constant = replace(linear_module(shape), offset=jnp.asarray(1e-3))
    assert constant(3.0) == pytest.approx(1e-3)
    net = with_scales(own, Scales((0.0,), (200.0,), 1.0), Affine((), 1e-3))
    assert "positive" in kept_promises(net)
    values = [float(net(w)) for w in (0.0, 100.0, 200.0)]
    assert values == pytest.approx([0.7e-3] * 3, abs=0.5e-3)
    ac.save_params({**system.parameters(), "friction.net": net}, tmp_path / "p.safetensors")
    loaded = ac.load_params(tmp_path / "p.safetensors", system)["friction.net"]
    assert [float(loaded(w)) for w in (0.0, 100.0, 200.0)] == values


class Busy(ac.Component):
    """A state that decays as a network says, and a condition that changes once in about every sample."""

    net = ac.Module("_fresh")
    x, y = ac.Variable(start=1.0, fixed=True), ac.Variable(fixed=True)
    n = ac.Discrete(0, kind="int")

    def _fresh(self, key: Any) -> Any:
        return Law(width=4, depth=1)(key)

    def equations(self) -> Any:
        yield ac.Eq(ac.der(self.x), -self.net(self.x))
        yield ac.Eq(ac.der(self.y), 1)
        yield ac.When(ac.sin(3e4 * self.y) > 0, ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.slow
def test_a_trial_that_runs_from_event_to_event_is_given_up() -> None:
    problem = problem_of(Busy(), "x", x=np.exp(-T))
    free = problem.simulate(problem.start()).loss
    held = replace(problem, tries=0)
    assert np.isfinite(free)
    assert not np.isfinite(held.simulate(held.start()).loss)
