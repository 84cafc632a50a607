"""Conditions at zero that are decided by their rates, consistently with each other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
from jaxtyping import Array

import acausal as ac
from acausal.codegen import Field, Values
from acausal.events import fire
from acausal.simulation.steps.problem import Integration, RightHandSide
from acausal.simulation.steps.rows import Row, rates_at

M = jnp.asarray([[1.0, 2.0, 0.0], [0.0, 1.0, 2.0], [2.0, 0.0, 1.0]])
"""Modes circle with this matrix where all that disagree change at once (Murty, 1974)."""


class AtZero(ac.Component):
    """Three conditions whose numbers are zero; by these, the first holds and the others do not."""

    u = ac.Input()
    x, y, z = (ac.Variable(start=0.0, fixed=True) for _ in range(3))
    a, b, c = (ac.Discrete(kind="bool") for _ in range(3))

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.a, self.x >= 0)
        yield ac.Eq(self.b, self.y > 0)
        yield ac.Eq(self.c, self.z - self.u > 0)
        yield from (ac.Eq(ac.der(v), 0) for v in (self.x, self.y, self.z))


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(AtZero())


def start(system: ac.System) -> Values:
    return system.start_values(system.pack(None), None, jnp.zeros(1), 0.0)


@pytest.mark.parametrize("instant", [0.0, 1e-12])
def test_modes_solve_the_complementarity_problem_of_the_rates(
    system: ac.System, instant: float
) -> None:
    def rates(x: Array, d: Array) -> tuple[Array, Array]:
        """Of z where a condition holds, of -w where not, with w = M z - 1 and the other one zero."""
        on = jnp.diag(d[:3])
        z = jnp.linalg.solve(on @ M @ on + jnp.eye(3) - on, d[:3])
        return jnp.zeros(3), jnp.where(d[:3] > 0.5, z, 1 - M @ z)

    assert system.events is not None
    after = fire(system.events, start(system), -jnp.ones(3), rates, instant=jnp.asarray(instant))
    assert after.converged
    assert after.d.tolist() == ([1.0] * 6 if instant else [1.0, 0.0, 0.0] * 2)


class Kinked(RightHandSide):
    """A right-hand side whose input falls until 1 s, and rises then."""

    at_start: Values

    def ahead(self, t: Array, apart: Array) -> Any:
        raise NotImplementedError

    def at(self, t: Array) -> Field:
        return self.system.field(
            t, jnp.where(t < 1, 1 - t, t - 1)[None], self.at_start.packed, self.d
        )


def test_rates_that_decide_are_those_behind_a_kink(system: ac.System) -> None:
    at, n, one = start(system), jnp.asarray(0), jnp.ones(())
    assert at.d is not None
    none, d = jnp.zeros(0), at.d
    kinked = Kinked(at, system=system, d=d)
    problem = Integration(
        kinked, at.x, 0 * one, one, none, none, none, one, one, max_steps=9, events=system.events
    )
    before = jnp.asarray(np.nextafter(1.0, 0.0))

    def rate(instant: float) -> float:
        row = Row(0 * one, one, one, n, n, n, n, at.x, instant=jnp.asarray(instant))
        return float(rates_at(problem, before, row)(at.x, d)[1][2])

    assert rate(0.0) == 1
    assert rate(1e-12) == -1
