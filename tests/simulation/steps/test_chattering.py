"""What is no event: a fast mode that swings where stability limits the steps, and rounding at the time of another."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, electrical as el
from tests.gradients.models import Built, at
from tests.support.hybrid import Ball


def boost() -> ac.Component:
    """A boost converter: while the diode conducts, its resistance and the capacitor are a mode of 1 ns."""
    return Built(
        "source.p inductor.p",
        "inductor.n switch.p diode.p",
        "diode.n c.p load.p",
        "source.n switch.n c.n load.n ground.p",
        "pulse.y switch.control",
        source=el.ConstantVoltage(V=12),
        inductor=el.Inductor(L=1e-3, i=at(0.0)),
        switch=el.IdealClosingSwitch(),
        diode=el.IdealDiode(),
        c=el.Capacitor(C=1e-4, v=at(0.0)),
        load=el.Resistor(R=10),
        pulse=blocks.BooleanPulse(width=50, period=1e-4),
        ground=el.Ground(),
    )


@pytest.mark.slow
def test_a_boost_converter_has_the_events_of_its_switch_alone() -> None:
    run = ac.simulate(ac.compile(boost()), 2e-3)
    np.testing.assert_allclose([e.t for e in run.events], 5e-5 * np.arange(1, 41), rtol=1e-9)
    assert {e.component for e in run.events} == {"pulse"}
    assert run.statistics is not None
    assert run.statistics.steps + run.statistics.rejected < 150
    np.testing.assert_allclose(run["c.v"][-1], 33.14408, rtol=1e-5)


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize(
    "ramps", [{"rising": 0.0}, {"falling": 0.0}, {"rising": 0.0, "falling": 0.0}]
)
def test_a_trapezoid_without_a_ramp_stays_within_its_amplitude(ramps: dict[str, Any]) -> None:
    """The end of a ramp of no length falls on the event that begins it; startTime makes rounding count."""
    shape: dict[str, Any] = {
        "rising": 0.1,
        "falling": 0.1,
        "width": 0.5,
        "period": 1.0,
        "startTime": 0.3,
    } | ramps
    clock = blocks.discrete.Sampler(samplePeriod=0.27)
    model = Built(
        "s.y i.u clock.u", s=blocks.Trapezoid(**shape), i=blocks.Integrator(), clock=clock
    )
    run = ac.simulate(ac.compile(model), 3.3)
    assert np.max(np.abs(run["s.y"])) <= 1
    area = shape["width"] + (shape["rising"] + shape["falling"]) / 2
    np.testing.assert_allclose(run["i.y"][-1], 3 * area, rtol=1e-6)


class Level(ac.Component):
    """A level that falls, and is set when it is below zero: to the threshold itself, it goes on falling."""

    h = ac.Variable(start=1.0, fixed=True)
    to = ac.Parameter(0.0)

    def equations(self) -> Any:
        yield ac.Eq(ac.der(self.h), -1)
        yield ac.When(self.h < 0, ac.Reinit(self.h, self.to))


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("options", [{}, {"dt": 0.01}], ids=["adaptive", "fixed"])
@pytest.mark.parametrize("to", [0.0, 1e-12])
def test_a_state_that_is_set_to_its_own_threshold_has_events_without_end(
    level: ac.System, to: float, options: dict[str, float]
) -> None:
    with pytest.raises(ac.SimulationError, match=r"events follow each other .*\(h < 0\)"):
        ac.simulate(level, 2.0, params={"to": to}, **options)


def test_a_state_that_is_set_beyond_its_threshold_goes_on(level: ac.System) -> None:
    run = ac.simulate(level, 2.0, params={"to": 0.3})
    np.testing.assert_allclose([e.t for e in run.events], [1.0, 1.3, 1.6, 1.9], rtol=1e-9)
    np.testing.assert_allclose(run["h"][-1], 0.2, rtol=1e-8)


@pytest.fixture(scope="module")
def level() -> ac.System:
    return ac.compile(Level(to=0.0))


class Doubted(ac.Component):
    """A switch of which rounding says in either position that it should be in the other, for an instant."""

    rounding = ac.Parameter()
    s, x, off = ac.Variable(), ac.Variable(), ac.Discrete(kind="bool")

    def equations(self) -> Any:
        late = ac.time - 1 - ac.where(self.off > 0.5, 0.0, self.rounding)
        yield ac.Eq(self.s, ac.where(ac.time < 1, 1, late, events=True))
        yield ac.Eq(self.off, self.s < 0)
        yield ac.Eq(ac.der(self.x), 1 - self.off)


@pytest.mark.slow
def test_a_circle_of_rounding_ends_and_one_of_numbers_does_not() -> None:
    system = ac.compile(Doubted(rounding=1e-13))
    np.testing.assert_allclose(ac.simulate(system, 2)["x"][-1], 2, atol=1e-6)
    with pytest.raises(ac.SimulationError, match="without end"):
        ac.simulate(system, 2, params={"rounding": 1e-6})


@pytest.mark.slow
def test_a_ball_that_comes_to_rest_does_not_fall_through_the_floor() -> None:
    system = ac.compile(Ball())
    for e in (0.8, 0.5, 0.4, 0.3, 0.05):
        with pytest.raises(ac.SimulationError, match="follow each other without end"):
            ac.simulate(system, 6.0, params={"e": e})
    with pytest.warns(UserWarning, match="2 of 3 variants went on behind events"):
        runs = ac.sweep(system, {"e": [0.95, 0.5, 0.3]}, 5.0)
    assert float(runs["h"][0].min()) > -1e-9
