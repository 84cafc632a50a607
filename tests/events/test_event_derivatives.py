"""Derivatives through what is found at one event, where one value leads to the next."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac


class Chain(ac.Component):
    """Three values sampled at once: each is read by the next one by way of a variable that is computed."""

    k = ac.Parameter(0.3)
    a, b, c = ac.Discrete(1.0), ac.Discrete(), ac.Discrete()
    v, w = ac.Variable(), ac.Variable()

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.v, self.k * self.a)
        yield ac.Eq(self.w, self.k * self.b)
        own = ac.Eq(self.a, 0.5 * ac.pre(self.a) + self.k)
        yield ac.When(ac.sample(0, 0.1), own, ac.Eq(self.b, self.v), ac.Eq(self.c, self.w))


@pytest.mark.cases(fast=0, slow=2)
@pytest.mark.parametrize("derivative", [jax.jacfwd, jax.jacrev])
def test_values_of_one_event_that_follow_from_each_other_have_derivatives(derivative: Any) -> None:
    system = ac.compile(Chain())

    def last(k: Any) -> Any:  # after samples at 0 and 0.1 s
        return ac.simulate(system, 0.15, saveat=[0.15], dt=0.05, params={"k": k})["c"][-1]

    k = 0.3
    a, by_k = 0.25 + 1.5 * k, 1.5
    np.testing.assert_allclose(last(k), k**2 * a, rtol=1e-12)
    np.testing.assert_allclose(derivative(last)(k), 2 * k * a + k**2 * by_k, rtol=1e-12)
