"""An FMU written by hand in C: completed steps, and event mode of co-simulation."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from tests.support.fmus import compiled_fmu

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="Counter" instantiationToken="counter">
  <ModelExchange modelIdentifier="counter" needsCompletedIntegratorStep="true"/>
  <CoSimulation modelIdentifier="counter" hasEventMode="true" canHandleVariableCommunicationStepSize="true"/>
  <DefaultExperiment stepSize="0.1"/>
  <ModelVariables>
    <Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>
    <Float64 name="u" valueReference="1" causality="input" start="2"/>
    <Float64 name="x" valueReference="2" causality="output"/>
    <Float64 name="der(x)" valueReference="3" derivative="2"/>
    <Float64 name="n" valueReference="4" causality="output" variability="discrete"/>
    <Float64 name="rate" valueReference="5" causality="parameter" variability="tunable" start="0"/>
  </ModelVariables>
  <ModelStructure>
    <Output valueReference="2"/>
    <Output valueReference="4"/>
    <ContinuousStateDerivative valueReference="3"/>
  </ModelStructure>
</fmiModelDescription>
"""

Counter = Callable[[str], Path]


@pytest.fixture(scope="module")
def counter(tmp_path_factory: pytest.TempPathFactory) -> Counter:
    """The FMU, with a description."""
    folder = tmp_path_factory.mktemp("counter")
    return lambda description: compiled_fmu(folder, "counter", description)


@pytest.mark.slow
def test_an_fmu_is_told_of_completed_steps(counter: Counter) -> None:
    part = ac.FMU(counter(DESCRIPTION))
    assert "model exchange, with a completed step each 0.1 s" in repr(part)
    run = ac.simulate(ac.compile(part), 1.2, dt=0.1)  # x comes to 1 after 0.5 s, and again
    np.testing.assert_allclose(
        np.asarray(run["x"])[[4, 5, 6, 9, 10, 12]], [0.8, 0, 0.2, 0.8, 0, 0.4], atol=1e-9
    )
    np.testing.assert_allclose(np.asarray(run["n"])[[4, 6, 11]], [0, 1, 2])
    untold = counter(DESCRIPTION.replace(' needsCompletedIntegratorStep="true"', ""))
    with pytest.raises(ac.DeclarationError, match="need not be told of completed steps"):
        ac.FMU(untold, step=0.1)
    with pytest.raises(ac.SimulationError, match=r"asks to end the simulation at 1\.6 s"):
        ac.simulate(ac.compile(part), 3.0, dt=0.1)


def test_events_of_a_co_simulation_end_its_steps(counter: Counter) -> None:
    part = ac.FMU(counter(DESCRIPTION), {"u": 2.0}, kind="cs", step=0.2)
    run = ac.simulate(ac.compile(part), 1.0, dt=0.2)
    np.testing.assert_allclose(run["x"], 0.4 * np.arange(6), atol=1e-12)
    np.testing.assert_allclose(run["n"], [0, 0, 1, 2, 3, 4])


INPUT = '<Float64 name="v" valueReference="6" causality="input" variability="discrete" start="0"/>'
DISCRETE = DESCRIPTION.replace(' needsCompletedIntegratorStep="true"', "").replace(
    "  </ModelVariables>", f"    {INPUT}\n  </ModelVariables>"
)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["previous", "linear"])
def test_a_discrete_input_is_set_at_events(counter: Counter, kind: Any) -> None:
    """One that is held changes at the events that it makes, a ramp whenever it has changed by a thousandth."""
    system, at = ac.compile(ac.FMU(counter(DISCRETE), {"u": 0.0})), np.linspace(0.0, 1.0, 11)
    assert system.held_inputs == {"v"}
    times, v = np.array([0.0, 0.3, 1.0]), np.array([1.0, 1.3, 1.3])
    given = (times, v) if kind == "previous" else ac.Signal(times, v, "linear")
    run, behind = ac.simulate(system, 1.0, saveat=at, inputs={"v": given}), np.maximum(at - 0.3, 0)
    if kind == "previous":
        np.testing.assert_allclose(run["x"], at + 0.3 * behind, atol=1e-9)
    else:
        exact = np.where(at < 0.3, at + at**2 / 2, 0.345 + 1.3 * behind)
        np.testing.assert_allclose(run["x"], exact, atol=2e-3)
        assert 250 < len(run.events) < 350


@pytest.mark.slow
def test_gradients_through_discrete_inputs_are_refused(counter: Counter) -> None:
    def end(v: Any, **more: Any) -> Any:
        system = ac.compile(ac.FMU(counter(DISCRETE), {"u": 0.0}, **more))
        return ac.simulate(system, 0.2, inputs={"v": v}, dt=0.1)["x"][-1]

    with pytest.raises(ac.SimulationError, match=r"which it takes at events.*open_loop=True"):
        jax.grad(end)(1.0)
    assert jax.grad(lambda v: end(v, open_loop=True))(1.0) == 0


@pytest.mark.slow
def test_a_co_simulation_that_has_no_event_mode_after_all_does_without(counter: Counter) -> None:
    part = ac.FMU(counter(DESCRIPTION.replace('"counter">', '"eventless">')), kind="cs")
    run = ac.simulate(ac.compile(part), 1.0, dt=0.1)
    np.testing.assert_allclose(run["x"], 0.2 * np.arange(11), atol=1e-12)


@pytest.mark.slow
def test_a_library_without_clocks_is_named_where_the_description_has_one(counter: Counter) -> None:
    interval = 'intervalVariability="constant" intervalDecimal="1"'
    clock = f'<Clock name="tick" valueReference="9" causality="input" {interval}/>'
    path = counter(DESCRIPTION.replace("  </ModelVariables>", f"    {clock}\n  </ModelVariables>"))
    with pytest.raises(ac.SimulationError, match="library of 'Counter' lacks 'fmi3SetClock'"):
        ac.simulate(ac.compile(ac.FMU(path)), 3.0, dt=1.0)
