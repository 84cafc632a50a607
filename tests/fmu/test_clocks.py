"""An FMU written by hand in C, with clocks of all kinds, against closed forms."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from tests.support.fmus import compiled_fmu

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="Clocked" instantiationToken="clocked">
  <ModelExchange modelIdentifier="clocked"/>
  <CoSimulation modelIdentifier="clocked" hasEventMode="true" mightReturnEarlyFromDoStep="true"
    canHandleVariableCommunicationStepSize="true"/>
  <ModelVariables>
    <Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>
    <Float64 name="u" valueReference="1" causality="input" variability="discrete" start="0" clocks="20"/>
    <Float64 name="y" valueReference="2" causality="output" variability="discrete" clocks="20"/>
    <Float64 name="K" valueReference="3" causality="parameter" variability="fixed" start="2"/>
    <Float64 name="z" valueReference="4" causality="output" start="0" initial="exact" reinit="true"/>
    <Float64 name="der(z)" valueReference="5" derivative="4"/>
    <Float64 name="level" valueReference="6" causality="parameter" variability="fixed" start="1e9"/>
    <Float64 name="instant" valueReference="7" causality="output" variability="discrete" clocks="21"/>
    <Float64 name="delay" valueReference="8" causality="parameter" variability="fixed" start="0.15"/>
    <Float64 name="b" valueReference="9" causality="output" variability="discrete"/>
    <Float64 name="a" valueReference="10" causality="output" variability="discrete"/>
    <Float64 name="interval" valueReference="11" causality="parameter" variability="fixed" start="0.1"/>
    <Clock name="tick" valueReference="20" causality="input" intervalVariability="constant" intervalDecimal="0.1"/>
    <Clock name="crossed" valueReference="21" causality="output" intervalVariability="triggered"/>
    <Clock name="later" valueReference="22" causality="input" intervalVariability="countdown"/>
    <Clock name="burst" valueReference="23" causality="input" intervalVariability="changing"/>
    <Clock name="ask" valueReference="24" causality="input" intervalVariability="triggered"/>
  </ModelVariables>
  <ModelStructure>
    <Output valueReference="2"/>
    <Output valueReference="4"/>
    <Output valueReference="7"/>
    <Output valueReference="9"/>
    <Output valueReference="10"/>
    <Output valueReference="21"/>
    <ContinuousStateDerivative valueReference="5"/>
    <EventIndicator valueReference="12"/>
  </ModelStructure>
</fmiModelDescription>
""".replace("    <Clock", '    <Float64 name="above" valueReference="12"/>\n    <Clock', 1)

Clocked = Callable[..., Path]
NAMES = ("z", "y", "instant", "b", "crossed", "tick", "later", "burst")
KINDS = pytest.mark.parametrize("kind", ["me", "cs"])


@pytest.fixture(scope="module")
def clocked(tmp_path_factory: pytest.TempPathFactory) -> Clocked:
    """The FMU, with its description changed."""
    folder = tmp_path_factory.mktemp("clocked")

    def of(before: str = "", after: str = "") -> Path:
        assert before in DESCRIPTION
        return compiled_fmu(folder, "clocked", DESCRIPTION.replace(before, after))

    return of


class Loop(ac.Component):
    """The controller of the FMU with its own state: u = 1 - gain z."""

    gain = ac.Parameter(0.5)

    def __init__(self, path: Path, kind: Any, **more: Any) -> None:
        super().__init__()
        self.part = ac.FMU(path, kind=kind, **more)
        self.u = ac.Output()
        self.connect(self.u, self.part.u)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.u, 1 - self.gain * self.part.z)


def loop(n: int, h: float = 0.1, shift: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """The states z and the outputs y at n ticks."""
    zs, ys, z, x = list[float](), list[float](), 0.0, 0.0
    for _ in range(n):
        u = 1 - 0.5 * z
        y = 2 * u + x
        zs.append(z)
        ys.append(y)
        z, x = z + h * y, x + u
    return np.array(zs), np.array(ys)


@pytest.mark.slow
@KINDS
def test_a_controller_computes_at_the_ticks_of_its_clock(clocked: Clocked, kind: Any) -> None:
    part = ac.FMU(clocked(), kind=kind)
    assert "tick (input, constant of 0.1 s), crossed (output, triggered)" in repr(part)
    run = ac.simulate(ac.compile(Loop(clocked(), kind)), 1.0, dt=0.1)
    zs, ys = loop(11)
    np.testing.assert_allclose(run["part.z"], zs, atol=1e-12)
    np.testing.assert_allclose(run["part.y"], ys, atol=1e-12)


@pytest.mark.cases(fast=0, slow=4)
@KINDS
@pytest.mark.parametrize(
    ("clock", "more", "h", "shift"),
    [
        ('"constant" shiftDecimal="0.05" intervalDecimal="0.1"', {}, 0.1, 0.05),
        ('"constant" resolution="20" intervalCounter="2" shiftCounter="1"', {}, 0.1, 0.05),
        ('"fixed" intervalDecimal="0.1"', {"tick": 0.2}, 0.2, 0.0),
        ('"tunable"', {}, 0.1, 0.05),  # the FMU's shift is half its interval
        ('"fixed"', {"interval": 0.2}, 0.2, 0.1),
    ],
)
def test_periodic_clocks_have_an_interval_and_a_shift(
    clocked: Clocked, kind: Any, clock: str, more: dict[str, float], h: float, shift: float
) -> None:
    path = clocked('"constant" intervalDecimal="0.1"', clock)
    run = ac.simulate(
        ac.compile(Loop(path, kind, values=more, step=0.05 if kind == "cs" else None)), 1.0, dt=0.05
    )
    zs, ys = loop(1 + round((1.0 - shift) / h), h)
    at = np.array([round((shift + k * h) / 0.05) for k in range(len(zs) - 1)])
    np.testing.assert_allclose(np.asarray(run["part.z"])[at], zs[:-1], atol=1e-12)
    np.testing.assert_allclose(np.asarray(run["part.y"])[at + 1], ys[:-1], atol=1e-12)


@pytest.mark.slow
@KINDS
def test_clocks_that_the_fmu_triggers_counts_down_or_changes(clocked: Clocked, kind: Any) -> None:
    values = {"level": 0.75, "delay": 0.12}
    part = ac.FMU(clocked(), values, kind=kind, observe=["tick", "later", "burst"])
    run = ac.simulate(ac.compile(part), 0.6, dt=0.05, inputs={"u": 1.0, "ask": 0})
    found = {name: np.asarray(run[name])[1::2] for name in NAMES}
    behind = 0.05 * (
        kind == "me"
    )  # a co-simulation is seen where it was at the last communication point
    rises = np.arange(2, 8)
    np.testing.assert_allclose(
        found["z"], np.array([0, 0.2, 0.5, 0.9, 0.0875, 0.6875]) + behind * rises, atol=1e-9
    )
    np.testing.assert_allclose(found["y"], rises, atol=1e-12)
    first, second = 0.2625, 0.5 + 0.0625 / 7
    last = second if kind == "me" else first
    np.testing.assert_allclose(found["instant"], [0, 0, 0, first, first, last], atol=1e-9)
    np.testing.assert_array_equal(found["crossed"], [0, 0, 0, 1, 1, 1 + (kind == "me")])
    np.testing.assert_array_equal(found["tick"], np.arange(1, 7))
    np.testing.assert_array_equal(found["later"], [0, 0, 0, 0, 1, 1])
    np.testing.assert_array_equal(found["burst"], [0, 1, 1, 2, 2, 2])
    np.testing.assert_array_equal(found["b"], found["burst"])


class Counted(ac.Component):
    """The ticks of one FMU are those of a clock of another."""

    def __init__(self, path: Path, kind: Any) -> None:
        super().__init__()
        self.source = ac.FMU(path, {"level": 0.35}, kind=kind)
        self.sink = ac.FMU(path, kind=kind)
        self.connect(self.source.crossed, self.sink.ask)

    def equations(self) -> Iterator[Any]:
        return iter(())


@pytest.mark.cases(fast=0, slow=1)
@KINDS
def test_a_clock_of_one_fmu_triggers_that_of_another(clocked: Clocked, kind: Any) -> None:
    inputs = {"source.u": 1.0, "source.ask": 0, "sink.u": 0.0}
    run = ac.simulate(ac.compile(Counted(clocked(), kind)), 0.65, dt=0.01, inputs=inputs)
    crossings = (15, 37, 57) if kind == "me" else (20, 40, 60)  # seen at a communication point
    around = [at + side for at in crossings for side in (-1, 1)]
    np.testing.assert_array_equal(np.asarray(run["sink.a"])[around], [0, 1, 1, 2, 2, 3])


@pytest.mark.cases(fast=0, slow=1)
@KINDS
def test_a_triggered_clock_takes_an_interval(clocked: Clocked, kind: Any) -> None:
    system = ac.compile(ac.FMU(clocked(), {"ask": 0.25}, kind=kind))
    run = ac.simulate(system, 1.0, dt=0.125, inputs={"u": 0.0})
    np.testing.assert_array_equal(run["a"][1::2], [1, 2, 3, 4])


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@KINDS
def test_gradients_go_through_what_clocks_compute(clocked: Clocked, kind: Any) -> None:
    path = clocked()
    system = ac.compile(ac.FMU(path, {"level": 0.75, "delay": 0.12}, kind=kind))

    def last(k: Any) -> Any:
        return ac.simulate(system, 0.6, dt=0.05, inputs={"u": 1.0}, params={"K": k})["z"][-2]

    h = 1e-4
    quotient = (last(2 + h) - last(2 - h)) / (2 * h)
    np.testing.assert_allclose(jax.grad(last)(2.0), quotient, rtol=1e-5)
    loop = ac.compile(Loop(path, kind))

    def of_loop(gain: Any) -> Any:
        return ac.simulate(loop, 0.5, dt=0.1, params={"gain": gain})["part.z"][-1]

    with pytest.raises(
        ac.SimulationError,
        match="inputs of 'Clocked', which it takes at events or ticks of its clocks: if",
    ):
        jax.grad(of_loop)(0.5)


@pytest.mark.slow
def test_clocks_that_cannot_tick_are_refused(clocked: Clocked) -> None:
    with pytest.raises(ac.DeclarationError, match="'tick' of 'Clocked' is constant: it takes no"):
        ac.FMU(clocked(), {"tick": 0.2})
    with pytest.raises(
        ac.DeclarationError, match=r"interval -1\.0 of the clock 'ask' must be a time"
    ):
        ac.FMU(clocked(), {"ask": -1.0})
    with pytest.raises(ac.DeclarationError, match=r"memory=.* clocks"):
        ac.FMU(clocked(), kind="cs", memory=10)
    with pytest.raises(
        ac.DeclarationError, match="co-simulation has no event mode in which clocks"
    ):
        ac.FMU(clocked(' hasEventMode="true"'), kind="cs")
    still = ac.compile(ac.FMU(clocked('intervalDecimal="0.1"', 'intervalDecimal="0"')))
    with pytest.raises(
        ac.SimulationError, match="'tick' of 'Clocked' has an interval of 0 s, which"
    ):
        ac.simulate(still, 1.0, dt=0.1, inputs={"u": 0.0})
