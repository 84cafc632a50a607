"""Signals that jump where a model needs their derivative are said to: the impulse is left out."""

import warnings
from typing import Any

import pytest
import sympy as sp

import acausal as ac
from acausal.components import blocks, electrical, rotational
from acausal.structure.impulses import jump_of
from tests.support.parts import Equations, model

JUMPS = [
    (blocks.Step(startTime=0.5), "0.5"),
    (blocks.Pulse(period=2.0, width=25.0), "0.5"),
    (blocks.SawTooth(period=2.0), "2"),
    (blocks.Ramp(startTime=0.5, duration=0.0), "0.5"),
]
SMOOTH = [
    blocks.Sine(f=1.0),
    blocks.Ramp(startTime=0.5, duration=2.0),
    blocks.Trapezoid(rising=0.1, width=0.2, falling=0.1, period=1.0),
    blocks.Step(startTime=-1.0),
    blocks.Ramp(startTime=86400.0, duration=60.0),
    blocks.Ramp(startTime=100.0, duration=0.05),
    blocks.Trapezoid(startTime=1.0, rising=1e-3, width=0.2, falling=1e-3, period=1.0),
    blocks.Sine(f=50.0, startTime=1000.0),
    blocks.TimeTable(table=[[0, 0], [1, 2]]),
]


def turned(source: ac.Component) -> ac.Component:
    """A shaft whose speed is given exactly."""
    return model(
        "source.y - drive.w_ref",
        "drive.flange - shaft.flange_a",
        source=source,
        drive=rotational.Speed(exact=True),
        shaft=rotational.Inertia(J=1.0),
    )


@pytest.mark.parametrize(("source", "t"), JUMPS, ids=lambda v: type(v).__name__)
def test_an_impulse_is_said_to_be_left_out(source: Any, t: str) -> None:
    expected = f"the derivative of '{type(source).__name__}: y = .*', which jumps at t = {t} s"
    with pytest.warns(UserWarning, match=expected):
        ac.compile(turned(source))


@pytest.mark.parametrize("source", SMOOTH, ids=lambda v: type(v).__name__)
def test_what_does_not_jump_is_not_warned_of(source: Any) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ac.compile(turned(source))


def test_a_resistance_takes_the_jump() -> None:
    circuit = model(
        "v.p - r.p", "r.n - c.p", "c.n - v.n", "v.n - g.p",
        v=electrical.StepVoltage(V=1.0, startTime=0.5),
        r=electrical.Resistor(R=1.0), c=electrical.Capacitor(C=1.0), g=electrical.Ground(),
    )  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ac.compile(circuit)


def test_what_depends_on_variables_is_left_out() -> None:
    """A number in their place could make it undefined, or jump."""

    def equations(s: Any) -> list[ac.Eq]:
        late = ac.where(ac.time > 1, ac.time, 1)
        return [
            ac.Eq(ac.der(s.x), 1.0),
            ac.Eq(s.y, late / s.x + ac.log(s.x)),
            ac.Eq(s.v, ac.der(s.y)),
        ]

    component = Equations("x y v", equations)
    component.modify(x=ac.Start(1.0, fixed=True))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ac.compile(component)


def test_numbers_outside_of_a_domain_are_no_jump() -> None:
    t = ac.time
    assert jump_of(ac.sqrt(ac.where(t > 1, t, -1)), {}) is None
    assert jump_of(ac.where(t > 1, t, 1) + sp.Function("unknown")(t), {}) is None
    assert jump_of(sp.ceiling(t / 2), {}) == 2.0
    assert jump_of(sp.Mod(t, 3), {}) == 3.0
