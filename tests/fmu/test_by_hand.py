"""An FMU written by hand in C: structural parameters, matrices, and an end that it asks for."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

import acausal as ac
from tests.support.fmus import compiled_fmu

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="Linear" instantiationToken="linear">
  <ModelExchange modelIdentifier="linear_system"/>
  <CoSimulation modelIdentifier="linear_system"/>
  <ModelVariables>
    <Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>
    <UInt64 name="n" valueReference="1" causality="structuralParameter" variability="fixed" start="1"/>
    <Float64 name="A" valueReference="2" causality="parameter" variability="fixed" start="-1">
      <Dimension valueReference="1"/><Dimension valueReference="1"/>
    </Float64>
    <Float64 name="b" valueReference="3" causality="parameter" variability="fixed" start="1">
      <Dimension valueReference="1"/>
    </Float64>
    <Float64 name="start" valueReference="4" causality="parameter" variability="fixed" start="0">
      <Dimension valueReference="1"/>
    </Float64>
    <Float64 name="u" valueReference="5" causality="input" start="0"/>
    <Float64 name="x" valueReference="6"><Dimension valueReference="1"/></Float64>
    <Float64 name="der(x)" valueReference="7" derivative="6"><Dimension valueReference="1"/></Float64>
    <Float64 name="y" valueReference="8" causality="output"><Dimension valueReference="1"/></Float64>
  </ModelVariables>
  <ModelStructure>
    <Output valueReference="8"/>
    <ContinuousStateDerivative valueReference="7"/>
  </ModelStructure>
</fmiModelDescription>
"""


@pytest.fixture(scope="module")
def linear(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU."""
    return compiled_fmu(tmp_path_factory.mktemp("linear"), "linear_system", DESCRIPTION)


MATRIX = np.array([[-1.0, 0.5], [-3.0, -2.0]])
TWO: dict[str, Any] = {"n": 2, "A": MATRIX, "b": [1.0, 2.0], "start": [0.1, 0.2], "u": 3.0}


def exact(time: float) -> Any:
    """The states of `TWO`."""
    augmented = np.zeros((3, 3))
    augmented[:2, :2], augmented[:2, 2] = MATRIX, [3.0, 6.0]
    return (expm(augmented * time) @ [0.1, 0.2, 1.0])[:2]


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize(("kind", "error"), [("me", 1e-7), ("cs", 2e-3)])
def test_sizes_follow_from_structural_parameters(linear: Path, kind: Any, error: float) -> None:
    alone = ac.compile(ac.FMU(linear, {"u": 1.0}, kind=kind))  # with the sizes that the file has
    run = ac.simulate(alone, 0.8, dt=0.1, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(run["y[1]"][-1], 1 - np.exp(-0.8), atol=error)
    system = ac.compile(ac.FMU(linear, TWO, kind=kind))
    run = ac.simulate(system, 0.8, dt=0.1, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose([run[f"y[{i}]"][-1] for i in (1, 2)], exact(0.8), atol=error)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("kind", ["me", "cs"])
def test_values_can_be_read_where_an_fmu_ends(linear: Path, kind: Any) -> None:
    system = ac.compile(ac.FMU(linear, {"u": 1.0}, kind=kind, step=0.1 if kind == "cs" else None))
    run = ac.simulate(system, 1.0, dt=0.25)
    np.testing.assert_allclose(run["y[1]"][-1], 1 - np.exp(-1.0), atol=1e-3)
    says = "'Linear' asks to end the simulation at 1 s; end it there"
    if kind == "me":  # its states end, too
        with pytest.raises(ac.SimulationError, match=says):
            ac.simulate(system, 1.5, dt=0.25)
        return
    with pytest.warns(UserWarning, match=says):
        y = ac.simulate(system, 1.5, dt=0.25)["y[1]"]
    assert list(np.isfinite(y)) == [True] * 5 + [False] * 2


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"n": 2}, r"no values for 4 elements of 'A': give \{'A': ...\}, an array of shape \(2, 2"),
        ({"n": 2.5}, "'Linear' the structural parameter n=2.5; give a whole number"),
        ({"n": -1}, "'Linear' the structural parameter n=-1; give a whole number"),
    ],
)
def test_sizes_that_are_none_are_refused(linear: Path, values: Any, says: str) -> None:
    with pytest.raises(ac.DeclarationError, match=says):
        ac.FMU(linear, values)
