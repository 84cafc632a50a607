"""Assertions of components: parameters are looked at when they are given, what varies in a simulation's result."""

import copy
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import (
    blocks,
    digital,
    electrical,
    fluid,
    hydraulic,
    magnetic,
    translational,
)
from acausal.components.hydraulic.liquid import Liquid


class Vessel(ac.Component):
    """It empties ever faster; three signals grow."""

    area = ac.Parameter(1.0, unit="m2")
    height = ac.Parameter(2.0, unit="m")
    pumps = ac.Option(1)
    level = ac.Variable(unit="m", start=1.0, fixed=True)
    flow = ac.Variable(unit="m3/s")
    signals = ac.Variable(shape=3)

    def equations(self) -> Iterator[Any]:
        yield ac.Assert(self.pumps >= 1, "give it a pump")
        yield ac.Assert(self.height > 0.5 * self.area / self.area, "it is too low")
        yield ac.Assert(self.level >= 0, "it runs empty", level="warning")
        yield ac.Assert((self.signals < 5.01) | (ac.time > 100), "a signal is too large")
        yield ac.Eq(ac.der(self.level), -self.flow / self.area)
        yield ac.Eq(self.flow, 0.3 * ac.time)
        yield ac.Eq(self.signals, np.array([1, 2, 3]) * ac.time)


class Two(ac.Component):
    """Two vessels."""

    def __init__(self, **modifiers: Any) -> None:
        super().__init__()
        self.first = Vessel(**modifiers)
        self.second = Vessel(area=4.0)


@pytest.fixture(scope="module")
def two() -> ac.System:
    return ac.compile(Two())


def test_what_holds_is_silent(two: ac.System) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run = ac.simulate(two, 1.0)
    assert float(run["first.level"][-1]) == pytest.approx(1 - 0.15, rel=1e-5)


def test_the_first_point_is_named_where_something_does_not_hold(two: ac.System) -> None:
    with (
        pytest.warns(
            UserWarning, match=r"Vessel 'first': level >= 0 .* t = 2\.59 s .*: it runs empty"
        ),
        pytest.raises(
            ac.SimulationError,
            match=r"Vessel 'first': .*signals\[2\].* not hold at t = 2\.51 s \(signals\[2\] = 5\.02\), nor in 1 other",
        ),
    ):
        ac.simulate(two, 3.0, dt=0.01, saveat=np.arange(0, 3.0, 0.01) + 0.0)


@pytest.mark.parametrize(
    "given",
    [
        lambda system: ac.simulate(system, 1.0, params={"second.height": 0.2}),
        lambda system: ac.linearize(system, params={"second.height": 0.2}),
        lambda system: ac.compile(Two(height=0.2)),
    ],
)
def test_parameters_are_looked_at_when_they_are_given(
    two: ac.System, given: Callable[[Any], Any]
) -> None:
    with pytest.raises(ac.AcausalError, match=r"height > .* \(.*height = 0\.2.*\): it is too low"):
        given(two)


def test_what_python_knows_is_said_at_once() -> None:
    with pytest.raises(
        ac.DeclarationError, match=r"Vessel 'first', line \d+ of .*: give it a pump"
    ):
        ac.compile(Two(pumps=0))


@pytest.mark.slow
def test_a_sweep_names_the_variants(two: ac.System) -> None:
    with pytest.warns(UserWarning, match=r"1 of 3 variants .* first\.area = 0\.1: .*level >= 0"):
        ac.sweep(two, {"first.area": [0.1, 1.0, 3.0]}, 1.6)
    with pytest.warns(UserWarning, match=r"1 of 2 variants .* first\.height = 0\.1: .*too low"):
        ac.sweep(two, {"first.height": [0.1, 1.0]}, 1.0, dt=0.1)


def test_copies_assert_the_same(two: ac.System) -> None:
    with pytest.raises(ac.SimulationError, match="a signal is too large"):
        ac.simulate(copy.deepcopy(two), 2.55, dt=0.01)


def test_units_are_checked() -> None:
    class Wrong(Vessel):
        def equations(self) -> Iterator[Any]:
            yield from super().equations()
            yield ac.Assert(self.level > self.flow, "nonsense")

    with pytest.raises(ac.UnitError, match=r"Assert\(level > flow.* is in m.* but .* in m"):
        ac.compile(Wrong())


VESSEL = Vessel()
WRONG: list[tuple[Callable[[], Any], str]] = [
    (lambda: ac.Assert(3, "x"), "is int 3; give a comparison"),
    (
        lambda: ac.Assert(ac.pre(VESSEL.level) > 1, "x"),
        r"reads pre\(level\); give that to a variable",
    ),
    (lambda: ac.Assert(ac.der(VESSEL.level) > 1, "x"), r"reads der\(level\)"),
    (lambda: ac.Assert(VESSEL.level > 1, 3), "the second argument is a text"),  # pyright: ignore[reportArgumentType]
    (lambda: ac.Assert(VESSEL.level > 1, "x", level="fatal"), "must be one of error, warning"),
]


@pytest.mark.parametrize(("made", "message"), WRONG)
def test_wrong_assertions_are_refused(made: Callable[[], Any], message: str) -> None:
    with pytest.raises(ac.DeclarationError, match=message):
        made()


def test_modelica_has_them_both_ways(tmp_path: Path, two: ac.System) -> None:
    written = ac.export.modelica(two, tmp_path / "two.mo").read_text()
    assert 'assert((level >= 0), "it runs empty", AssertionLevel.warning);' in written
    file = tmp_path / "falling.mo"
    file.write_text(
        """model Falling
          parameter Real least = 0.495;
          Real h(start=1, fixed=true);
        equation
          assert(least < 1, "least is too large");
          assert(h > 0.2, "low: " + String(h) + " m", AssertionLevel.warning);
          der(h) = -1;
          if time > 0.4 then
            assert(h > least, "late");
          end if;
        end Falling;"""
    )
    system = ac.compile(ac.load(file))
    with pytest.raises(
        ac.SimulationError, match=r"at t = 0\.51 s .*: late \(line 9 of falling\.mo\)"
    ):
        ac.simulate(system, 0.6, dt=0.01)
    with pytest.warns(UserWarning, match=r"0\.81 s .*: low: \.\.\. m \(line 6 of falling\.mo\)"):
        ac.simulate(system, 0.9, dt=0.01, params={"least": 0.01})
    with pytest.raises(ac.DataError, match=r"least < 1 .*\(least = 2\): least is too large"):
        ac.simulate(system, 0.1, params={"least": 2.0})


IMPOSSIBLE: list[tuple[Callable[[], ac.Component], str]] = [
    (lambda: blocks.Limiter(uMax=-1.0), "uMin <= uMax.*lower limit lies above"),
    (lambda: blocks.DeadZone(uMax=1.0, uMin=2.0), "uMin <= uMax"),
    (lambda: blocks.LimIntegrator(outMax=-1.0), "outMin <= outMax"),
    (lambda: blocks.LimPID(yMax=-1.0), "Limiter 'limiter': uMin <= uMax"),
    (lambda: blocks.Hysteresis(uLow=2.0, uHigh=1.0), "uLow <= uHigh"),
    (lambda: electrical.Transformer(L1=1.0, L2=1.0, M=1.5), "M.*2 < L1.L2"),
    (lambda: electrical.IdealizedOpAmpLimited(Vps=-15.0, Vns=15.0), "Vns < Vps"),
    (lambda: hydraulic.StaticPipe(length=1.0, diameter=0.0), "diameter > 0"),
    (lambda: hydraulic.Tube(length=1.0, diameter=0.1, n=0), "n=0 is out of range: at least 1"),
    (lambda: magnetic.HollowCylinderRadialFlux(r_i=0.03), "r_i < r_o .*wider outside"),
    (lambda: digital.Adder(n=0), "n=0 is out of range: at least 1"),
    (lambda: blocks.PadeDelay(delayTime=1.0, n=2, m=3), "m=3 must lie between 1 and n=2"),
    (
        lambda: hydraulic.Tube(length=1.0, diameter=0.1, fluid=Liquid(bulk_modulus=-1.0)),
        "bulk_modulus",
    ),
    (
        lambda: translational.MassWithStopAndFriction(
            m=1.0, L=0.1, smin=1.0, smax=0.0, F_prop=1.0, F_Coulomb=1.0, F_Stribeck=1.0, fexp=1.0
        ),
        "smin < smax",
    ),
]


@pytest.mark.parametrize(("made", "message"), IMPOSSIBLE)
def test_components_refuse_what_cannot_be(made: Callable[[], ac.Component], message: str) -> None:
    with pytest.raises(ac.DeclarationError, match=message):
        ac.compile(made())


@pytest.mark.slow
def test_tanks_say_that_they_run_empty_or_over() -> None:
    class Drained(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.tank = hydraulic.OpenTank(crossArea=1.0, level=ac.Start(0.1, fixed=True))
            self.pump = hydraulic.MassFlowSource(m_flow=-10.0)
            self.connect(self.pump.port, self.tank.port)

    with pytest.warns(UserWarning, match="OpenTank 'tank': level .* has run empty"):
        ac.simulate(ac.compile(Drained()), 20.0)


@pytest.mark.slow
@pytest.mark.parametrize(("flow", "said"), [(1e-3, "overflows"), (-1e-3, "has run empty")])
def test_a_tank_has_a_bottom_and_a_rim(flow: float, said: str) -> None:
    class Filled(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.tank = fluid.OpenTank(ATank=1e-2, hTank=0.2, level=ac.Start(0.1, fixed=True))
            self.pump = fluid.VolumeFlow(constantVolumeFlow=flow)
            self.source = fluid.Ambient(
                constantAmbientPressure=0.0, constantAmbientTemperature=293.0
            )
            self.connect(self.source.flowPort, self.pump.flowPort_a)
            self.connect(self.pump.flowPort_b, self.tank.flowPort)

    with pytest.warns(UserWarning, match=f"OpenTank 'tank': level .* {said}"):
        ac.simulate(ac.compile(Filled()), 2.0)


@pytest.mark.slow
def test_a_piston_says_that_it_passes_the_end_of_its_cylinder() -> None:
    class Pushed(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.cylinder = hydraulic.Actuator(area_a=1e-3, length_a=0.1)
            self.high, self.low = hydraulic.Boundary(p=1e5), hydraulic.Boundary(p=0.0)
            self.connect(self.high.port, self.cylinder.port_a)
            self.connect(self.low.port, self.cylinder.port_b)

    with pytest.warns(UserWarning, match="Actuator 'cylinder': .* passed the end of chamber b"):
        ac.simulate(ac.compile(Pushed()), 0.1)


class Halves(ac.Component):
    """Whole numbers that are none."""

    count = ac.Discrete(0, kind="int")
    on = ac.Discrete(0, kind="bool")
    level = ac.Option(1.5)

    def equations(self) -> Iterator[Any]:
        step = ac.Eq(self.count, ac.pre(self.count) + self.level)
        yield ac.When(ac.sample(0.25, 0.5), step, ac.Eq(self.on, 1 - ac.pre(self.on)))


@pytest.mark.slow
def test_fractions_of_whole_numbers_are_told() -> None:
    with pytest.warns(
        UserWarning, match=r"'count' is declared with kind='int', but is 1\.5 at t = 0\.3 s"
    ):
        ac.simulate(ac.compile(Halves()), 1.0, dt=0.1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ac.simulate(ac.compile(Halves(level=2)), 1.0, dt=0.1)
