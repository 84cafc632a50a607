"""FMUs of OpenModelica, from the package gemseo-fmu: what they compute, and derivatives through their events."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from tests.support.foreign import foreign_fmu


class Own(ac.Component):
    """What ``Mass_Damper`` computes, in equations: a mass between a wall's spring and damper and a force."""

    d, c, m = ac.Parameter(10.0), ac.Parameter(1e4), ac.Parameter(1.0)
    f = ac.Input()
    s = ac.Variable(start=0.5, fixed=True)
    v = ac.Variable(fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.s), self.v)
        yield ac.Eq(self.m * ac.der(self.v), -self.d * self.v - self.c * (self.s - 1) - self.f)


@pytest.mark.slow
def test_a_mass_with_a_damper_is_that_of_our_equations() -> None:
    theirs, ours = ac.compile(ac.FMU(foreign_fmu("Mass_Damper"))), ac.compile(Own())
    names = {"damper.d": "d", "spring.c": "c", "mass.m": "m"}

    def run(system: ac.System, params: dict[str, Any]) -> Any:
        force = lambda t: 20 * jnp.sin(60 * t)  # noqa: E731
        return ac.simulate(system, 0.1, dt=1e-3, inputs={"f": force}, params=params)

    at = {"damper.d": 12.0, "spring.c": 9000.0, "mass.m": 1.2}
    own = {names[n]: v for n, v in at.items()}
    expected = run(ours, own)["s"]
    np.testing.assert_allclose(run(theirs, at)["y"], 0.5 - expected, atol=1e-12)
    found = jax.grad(lambda p: run(theirs, p)["y"][-1])(at)
    for name, slope in jax.grad(lambda p: run(ours, p)["s"][-1])(own).items():
        theirs_name = next(n for n, o in names.items() if o == name)
        np.testing.assert_allclose(found[theirs_name], -slope, rtol=1e-5)


class Halves(ac.Component):
    """Two masses, each an FMU of its own."""

    def __init__(self) -> None:
        super().__init__()
        self.a = ac.FMU(foreign_fmu("MassSpringSubSystem1"), {"k1": 1.0, "k2": 2.0, "m1": 1.0})
        self.b = ac.FMU(foreign_fmu("MassSpringSubSystem2"), {"k2": 2.0, "k3": 1.0, "m2": 3.0})
        self.connect(self.a.x1, self.b.x1)
        self.connect(self.b.x2, self.a.x2)


def test_two_halves_are_the_whole() -> None:
    values = {"k1": 1.0, "k2": 2.0, "k3": 1.0, "m1": 1.0, "m2": 3.0}
    whole = ac.simulate(ac.compile(ac.FMU(foreign_fmu("MassSpringSystem"), values)), 3.0, dt=0.01)
    halves = ac.simulate(ac.compile(Halves()), 3.0, dt=0.01)
    np.testing.assert_allclose(halves["a.x1"], whole["x1"], atol=1e-12)
    np.testing.assert_allclose(halves["b.x2"], whole["x2"], atol=1e-12)


class Area(ac.Component):
    """The area under a ramp."""

    def __init__(self) -> None:
        super().__init__()
        self.ramp = ac.FMU(
            foreign_fmu("ramp"), {"ramp.startTime": 0.3, "ramp.duration": 0.4, "ramp.height": 1.0}
        )
        self.area = ac.Variable(fixed=True)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.area), self.ramp.out)


@pytest.mark.slow
def test_events_are_found_whose_indicators_jump() -> None:
    system = ac.compile(Area())
    for duration in (0.3999, 0.4, 0.4001):
        run = ac.simulate(system, 2.0, saveat=[2.0], params={"ramp.ramp.duration": duration})
        np.testing.assert_allclose(run["area"][-1], 1.7 - duration / 2, rtol=1e-9)


@pytest.mark.slow
def test_instants_of_events_have_derivatives() -> None:
    system = ac.compile(Area())
    at = {"ramp.ramp.startTime": 0.3, "ramp.ramp.duration": 0.4, "ramp.ramp.height": 1.0}
    area = lambda p: ac.simulate(system, 2.0, saveat=[2.0], params=p)["area"][-1]  # noqa: E731
    found = jax.grad(area)(at)
    np.testing.assert_allclose([found[n] for n in at], [-1.0, -0.5, 1.5], rtol=1e-6)


def test_what_is_not_supported_is_refused() -> None:
    with pytest.raises(ac.DeclarationError, match=r"'mass\.s' of 'Mass_Damper' is computed"):
        ac.FMU(foreign_fmu("Mass_Damper"), {"mass.s": 1.0})


def test_what_an_fmu_says_reaches_the_user() -> None:
    system = ac.compile(ac.FMU(foreign_fmu("Mass_Damper"), {"mass.m": 0.0, "f": 0.0}))
    with pytest.raises(ac.SimulationError, match=r"nan\. FMU: .* terminated by an assertion"):
        ac.simulate(system, 0.1, dt=0.1)
