"""Models with events as C and as FMUs: the trajectories of `acausal.simulate`, and what fmpy says of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from ctypes import c_double
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import rotational as rot
from acausal.export.c_text import events
from tests.simulation.steps.test_chattering import Level
from tests.support.bridges import bridge
from tests.support.exported_c import ExportedC
from tests.support.fmus import Unpacked, need_fmpy
from tests.support.hybrid import Ball, Braked, Sampled, Step, Thermostat, ball_height
from tests.support.paths import SHARED
from tests.support.slow import in_turn, some_slow
from tests.test_event_oracles import LONGER


class Relay(ac.Component):
    """A lag that an input switches on above one level, and off below another."""

    level = ac.Input()
    x = ac.Variable(start=0.0, fixed=True)
    on = ac.Discrete(0, kind="bool")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.x), self.on - self.x)
        yield ac.Eq(self.on, (self.level > 0.6) | ((ac.pre(self.on) > 0.5) & (self.level > 0.3)))


class Charging(ac.Component):
    """A capacitor that a switch charges fast, where the source is above it, and that discharges slowly."""

    v = ac.Variable(start=0.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        above = 10 * ac.sin(314 * (ac.time - 0.002)) - self.v
        yield ac.Eq(ac.der(self.v), ac.where(above > 0, 1e4 * above, 0, events=True) - 100 * self.v)


class Slipping(ac.Component):
    """A shaft with Coulomb friction that a torque moves, stops and turns back."""

    def __init__(self) -> None:
        super().__init__()
        self.shaft, self.friction = rot.Inertia(J=1.0), rot.BearingFriction(tau_pos=[[0.0, 1.0]])
        self.push = rot.Torque()
        self.connect(self.push.flange, self.shaft.flange_a)
        self.connect(self.shaft.flange_b, self.friction.flange_a)


class Held(ac.Component):
    """A shaft that is driven against two frictions, which lock its one motion."""

    def __init__(self) -> None:
        super().__init__()
        rest = ac.Start(0.0, fixed=True)
        self.shaft, self.push = rot.Inertia(J=0.5, phi=rest, w=rest), rot.Torque()
        self.first, self.second = (rot.BearingFriction(tau_pos=[[0.0, tau]]) for tau in (0.4, 0.7))
        self.connect(self.push.flange, self.shaft.flange_a)
        self.connect(self.shaft.flange_b, self.first.flange_a)
        self.connect(self.first.flange_b, self.second.flange_a)


@dataclass(frozen=True)
class Case:
    """A model, and how it is driven.

    Attributes:
        make: the model. end: of the run [s]. dt: length of the steps [s]. solver: of the steps.
        inputs: by name, functions of arrays of times, linear between the steps.
    """

    make: Callable[[], ac.Component]
    end: float
    dt: float
    solver: str = "rk4"
    inputs: tuple[tuple[str, Callable[[np.ndarray], np.ndarray]], ...] = ()

    @cached_property
    def system(self) -> ac.System:
        return ac.compile(self.make())

    @cached_property
    def t(self) -> np.ndarray:
        return np.arange(round(self.end / self.dt) + 1) * self.dt

    @cached_property
    def u(self) -> np.ndarray:
        """Inputs at the steps' ends, shape (n, n_inputs)."""
        given = dict(self.inputs)
        columns = [given[name](self.t) for name in self.system.inputs]
        return np.stack(columns, 1) if columns else np.zeros((len(self.t), 0))

    def run(self, **steps: Any) -> ac.Solution:
        samples = {n: (self.t, self.u[:, i]) for i, n in enumerate(self.system.inputs)}
        span = (0.0, float(self.t[-1]))
        return ac.simulate(self.system, span, inputs=samples, saveat=self.t, **steps)

    @cached_property
    def expected(self) -> np.ndarray:
        """States after each step, shape (n, n_states)."""
        found = self.run(dt=self.dt, solver=self.solver)
        return np.stack([np.asarray(found[name]) for name in self.system.states], 1)


CASES = {
    "ball": Case(Ball, 2.5, 0.01),
    "ball, implicit": Case(Ball, 1.5, 0.01, "kvaerno3"),
    "thermostat": Case(Thermostat, 40.0, 0.1),
    "sampled": Case(Sampled, 1.0, 0.03, "tsit5"),
    "step": Case(Step, 2.0, 0.07),
    "braked": Case(Braked, 3.0, 0.05),
    "relay": Case(Relay, 6.0, 0.05, "rk4", (("level", np.sin),)),
    "slipping": Case(Slipping, 6.0, 0.05, "rk4", (("push.tau", lambda t: 2 * np.sin(2 * t)),)),
    "held": Case(Held, 6.0, 0.05, "rk4", (("push.tau", lambda t: 2 * np.sin(2 * t)),)),
}


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("name", some_slow(CASES, ["ball, implicit", "slipping", "held"]))
def test_steps_in_c_are_those_of_simulate(name: str, tmp_path: Path) -> None:
    case = CASES[name]
    model = ExportedC(case.system, tmp_path, solver=case.solver)
    model.u[:] = case.u[0]
    assert model.call("begin") == 0
    found = [model.x.copy()]
    for k, end in enumerate(case.u[1:], 1):
        assert model.step(case.dt, end) == 0
        model.time[0] = case.t[k]
        found.append(model.x.copy())
    scale = np.abs(case.expected).max(axis=0)
    assert len(case.run(dt=case.dt, solver=case.solver).events) >= 2
    assert np.abs((np.stack(found) - case.expected) / scale).max() < 1e-9


def test_a_discrete_variable_is_an_output(tmp_path: Path) -> None:
    model = ExportedC(CASES["ball"].system, tmp_path, outputs=["n", "h"])
    assert model.call("begin") == 0
    for _ in range(10):
        assert model.step(0.25) == 0
    count, height = model.outputs()
    assert count == 4
    assert height == pytest.approx(ball_height(1.0, 0.8, 2.5), abs=1e-9)


@pytest.mark.parametrize("name", ["ball", "level"])
def test_a_model_that_bounces_for_ever_is_named(name: str, tmp_path: Path) -> None:
    system = CASES["ball"].system if name == "ball" else ac.compile(Level(to=0.0))
    model = ExportedC(system, tmp_path)
    assert model.call("begin") == 0
    status = [model.step(0.5) for _ in range(10)]
    chattering = int(model.header.split("_CHATTERING = ")[1].split(",")[0])
    assert chattering in status


@pytest.mark.machines
def test_a_bridge_at_rest_begins_to_conduct(tmp_path: Path) -> None:
    """All its conditions have numbers that are zero; see tests/simulation/steps/test_bridges.py."""
    case = Case(lambda: bridge(L=3e-4, phase=0.0), 2e-3, 1e-4, "kvaerno3")
    model = ExportedC(case.system, tmp_path, solver=case.solver)
    assert model.call("begin") == 0
    found = [model.x.copy()]
    for _ in case.t[1:]:
        assert model.step(case.dt) == 0
        found.append(model.x.copy())
    expected = case.run(rtol=1e-10, atol=1e-11, solver="stiff")
    exact = np.stack([np.asarray(expected[name]) for name in case.system.states], 1)
    np.testing.assert_allclose(np.stack(found), exact, atol=1e-3 * np.abs(exact).max())


# -- FMUs ------------------------------------------------------------------------------------------


def run_fmu(path: Path, case: Case, kind: str, **options: Any) -> Any:
    fmpy = need_fmpy()
    given = None
    if case.inputs:
        columns = [("time", float), *((n, float) for n in case.system.inputs)]
        given = np.array([(t, *u) for t, u in zip(case.t, case.u, strict=True)], dtype=columns)
    return fmpy.simulate_fmu(
        str(path),
        stop_time=float(case.t[-1]),
        output_interval=case.dt,
        fmi_type=kind,
        input=given,
        relative_tolerance=1e-10,
        record_events=False,
        **options,
    )


@pytest.mark.cases(fast=0, slow=4)
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
@pytest.mark.parametrize("name", ["ball", "thermostat", "sampled", "relay", "braked"])
def test_fmus_run_in_fmpy(name: str, fmi: str, tmp_path: Path) -> None:
    fmpy, case = need_fmpy(), CASES[name]
    path = tmp_path / "model.fmu"
    ac.export.fmu(case.system, path, fmi=fmi, solver=case.solver, step=case.dt)
    assert fmpy.validation.validate_fmu(str(path)) == []
    states = case.system.states
    exact = case.run(rtol=1e-10, atol=1e-12)
    found = run_fmu(path, case, "ModelExchange")
    for state in states:
        values = np.interp(case.t, found["time"], found[state])
        assert values == pytest.approx(np.asarray(exact[state]), abs=1e-5)
    if not case.inputs:  # which are held during a step of co-simulation
        found = run_fmu(path, case, "CoSimulation")
        for state, expected in zip(states, case.expected.T, strict=True):
            assert np.abs(found[state][: len(expected)] - expected).max() < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_conditions_are_event_indicators(fmi: str, tmp_path: Path) -> None:
    path = tmp_path / "ball.fmu"
    ac.export.fmu(CASES["ball"].system, path, fmi=fmi, outputs=["n"])
    fmu = Unpacked(path, fmi)
    description = fmu.description
    with fmu.instance("ModelExchange") as instance:
        if fmi == "2.0":
            assert description.numberOfEventIndicators == 1
        else:
            (indicator,) = description.eventIndicators
            assert list(instance.fmu.getFloat64([indicator.variable.valueReference])) == [-1.0]
            assert not description.modelExchange.needsCompletedIntegratorStep
        (count,) = (v for v in description.modelVariables if v.name == "n")
        assert count.variability == "discrete"
        values = (c_double * 1)()
        instance.fmu.getEventIndicators(values, 1)
        assert list(values) == [-1.0]
        instance.fmu.enterEventMode()
        instance.set(["h", "v"], [-1e-15, -2.0])
        result = instance.update()
        assert bool(result[3])
        assert instance.get(["v", "n"]) == pytest.approx([1.6, 1.0])
        instance.update()  # nothing more happens
        assert instance.get(["v", "n"]) == pytest.approx([1.6, 1.0])


@pytest.mark.slow
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_known_times_are_time_events(fmi: str, tmp_path: Path) -> None:
    path = tmp_path / "sampled.fmu"
    ac.export.fmu(CASES["sampled"].system, path, fmi=fmi)
    fmu = Unpacked(path, fmi)
    with fmu.instance("ModelExchange") as instance:
        *_, has_next, following = instance.update()
        assert bool(has_next)
        assert following == pytest.approx(0.1)


@pytest.mark.slow
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_what_rises_from_zero_at_a_time_event_crosses_zero_after_it(
    fmi: str, tmp_path: Path
) -> None:
    path = tmp_path / "braked.fmu"
    ac.export.fmu(CASES["braked"].system, path, fmi=fmi)
    fmu = Unpacked(path, fmi)
    with fmu.instance("ModelExchange") as instance:
        instance.update()
        values = (c_double * 7)()
        for time, expected in [(1.0, 0), (1.5, 0), (1.51, 1)]:
            instance.fmu.setTime(time)
            if time == 1.5:
                instance.fmu.enterEventMode()
                instance.update()
                instance.fmu.enterContinuousTimeMode()
            instance.fmu.getEventIndicators(values, 7)
            assert sum(z > 0 for z in values) == expected


def test_states_of_fmus_hold_events(tmp_path: Path) -> None:
    path = tmp_path / "ball.fmu"
    ac.export.fmu(CASES["ball"].system, path, outputs=["h", "n"], step=0.01)
    fmu = Unpacked(path, "3.0")
    with fmu.instance("CoSimulation") as instance:
        for k in range(10):
            instance.fmu.doStep(0.1 * k, 0.1)
        state = instance.fmu.getFMUState()
        ends = []
        for _ in range(2):
            for k in range(10, 20):
                instance.fmu.doStep(0.1 * k, 0.1)
            ends.append(instance.get(["h", "v", "n"]).tolist())
            instance.fmu.setFMUState(state)
        assert ends[0] == ends[1]
        assert ends[0][2] > instance.get(["n"])[0]


@pytest.mark.slow
def test_steps_are_short_enough_after_a_condition_has_changed(tmp_path: Path) -> None:
    system, path = ac.compile(Charging()), tmp_path / "charging.fmu"
    ac.export.fmu(system, path, binary=False)
    assert float(need_fmpy().read_model_description(str(path)).defaultExperiment.stepSize) <= 1e-4
    says = "0.001 s are too long for 'rk4' .* where a condition is not what it is at the start"
    with pytest.warns(UserWarning, match=says):
        ac.export.fmu(system, path, step=1e-3)
    messages: list[str] = []
    fmu = Unpacked(path, "3.0")
    with fmu.instance("CoSimulation", messages) as instance:
        with pytest.raises(Exception, match="error"):
            instance.steps(0.01, 20)
        assert abs(instance.get(["v"])[0]) < 1e30
    assert "a state has run away after" in messages[0]
    assert "s: v; a smaller step may help" in messages[0]


def test_parameters_count_before_the_start(tmp_path: Path) -> None:
    path = tmp_path / "thermostat.fmu"
    ac.export.fmu(CASES["thermostat"].system, path, outputs=["on"])
    fmu = Unpacked(path, "3.0")
    made = fmu.fmpy.instantiate_fmu(fmu.folder, fmu.description, "CoSimulation")
    made.enterInitializationMode()
    on, high, low = fmu.of(["on"]), fmu.of(["high"]), fmu.of(["low"])
    assert list(made.getFloat64(on)) == [1.0]
    made.setFloat64(high, [14.0])
    made.setFloat64(low, [12.0])
    assert list(made.getFloat64(on)) == [0.0]
    made.exitInitializationMode()
    assert list(made.getFloat64(on)) == [0.0]
    made.terminate()
    made.freeInstance()


# -- published examples ------------------------------------------------------------------------------

FOLDER = SHARED / "oracles" / "msl_events"
EXAMPLES = sorted(p.stem for p in FOLDER.glob("*.json"))
COARSE = {"Analog_SwitchWithArc", "Rotational_LossyGearDemo3"}
"""Examples that break down with these steps, in `acausal.simulate` as in C."""


@pytest.mark.cases(slow=3)
@pytest.mark.parametrize("name", some_slow(EXAMPLES, EXAMPLES, LONGER))
def test_examples_in_c(name: str, tmp_path: Path) -> None:
    model = ac.load(FOLDER / f"{name}.json")
    system = ac.compile(model)
    if name in COARSE or system.events is None:
        pytest.skip("has no events, or needs shorter steps")
    start, stop = (model.document[key] for key in ("start_time", "stop_time"))
    t = np.linspace(start, stop, 401)
    found = ExportedC(system, tmp_path, name="model")
    found.time[0] = start
    assert found.call("begin") == 0
    states = [found.x.copy()]
    for end in t[1:]:
        assert found.step(end - found.time[0]) == 0
        found.time[0] = end
        states.append(found.x.copy())
    solution = ac.simulate(system, (start, stop), saveat=t, dt=t[1] - t[0], solver="rk4")
    expected = np.stack([np.asarray(solution[n]) for n in system.states] or [0 * t], 1)
    off = np.abs(np.stack(states) - expected[:, : len(system.states)])
    off /= np.abs(expected).max(axis=0)[: len(system.states)] + 1e-300
    # an event at the very time of a sample may be on either side of it, by rounding
    assert np.sum(off.max(axis=1, initial=0) > 1e-9) <= 1


@pytest.mark.cases(slow=1)
@pytest.mark.filterwarnings(
    "ignore:export.fmu. steps of"
)  # of a co-simulation that is not run here
@pytest.mark.parametrize("name", in_turn(EXAMPLES, 3, machines=LONGER))
def test_examples_as_fmus(name: str, tmp_path: Path) -> None:
    fmpy = need_fmpy()
    model = ac.load(FOLDER / f"{name}.json")
    system = ac.compile(model)
    start, stop = (model.document[key] for key in ("start_time", "stop_time"))
    path = ac.export.fmu(system, tmp_path / "model.fmu")
    assert fmpy.validation.validate_fmu(str(path)) == []
    found = fmpy.simulate_fmu(
        str(path),
        start_time=start,
        stop_time=stop,
        fmi_type="ModelExchange",
        output_interval=(stop - start) / 500,
        relative_tolerance=1e-8,
        record_events=False,
    )
    t = np.linspace(start, stop, 501)
    exact = ac.simulate(system, (start, stop), saveat=t, rtol=1e-8, atol=1e-10)
    off = np.zeros(len(t))
    for state in set(system.states) & set(found.dtype.names):
        expected = np.asarray(exact[state])
        got = np.interp(t, found["time"], found[state])
        off = np.maximum(off, np.abs(got - expected) / (np.ptp(expected) or 1))
    assert np.sum(off > 1e-5) <= 1


def test_limits_are_those_of_simulate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    system = ac.compile(Ball())
    monkeypatch.setattr(events, "BAND", 1.25e-7)
    monkeypatch.setattr(events, "PASSES", 77)
    text = ac.export.c(system, tmp_path)[1].read_text()
    assert "#define BAND R(1.25e-07)" in text
    assert "PASSES = 77" in text
