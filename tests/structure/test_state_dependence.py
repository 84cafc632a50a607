"""The pattern of a model's Jacobian: every derivative that is not zero, and few others."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.structure import SparseLoop, TornLoop, blocks, jacobian_pattern
from tests.support.parts import Pendulum
from tests.support.stiff import Bridge, Chain, DiodeAndResistor, Ladder, Plate, Trains

MODELS = {
    "plate": (lambda: Plate(3), 33),
    "ladder": (lambda: Ladder(4), 10),
    "chain": (lambda: Chain(4), 24),
    "networks": (lambda: Chain(4, neural_spring=True), 24),
    "nonlinear loops": (lambda: Ladder(4, DiodeAndResistor), 10),
    "linear loops": (lambda: Ladder(4, Bridge), 10),
    "rigid trains": (lambda: Trains(3, 4), 9),
    "planar pendulum": (Pendulum, 16),
}


def check(model, most):
    system = ac.compile(model())
    n = len(system.states)
    size, rows, columns = jacobian_pattern(system.reduced, 1000)
    assert size == n
    x = jnp.asarray(np.random.default_rng(0).uniform(0.1, 0.5, n))
    params = system.parameters(1)
    jacobian = jax.jit(jax.jacfwd(lambda x: system.vector_field(0.0, x, None, params)))(x)
    assert jnp.isfinite(jacobian).all()
    outside = np.asarray(jacobian).copy()
    outside[rows, columns] = 0.0
    assert not outside.any()
    assert len(rows) == most
    places = rows * n + columns
    assert (np.diff(places) > 0).all()
    return system


@pytest.mark.cases(fast=3)
@pytest.mark.parametrize("name", MODELS)
def test_all_derivatives_are_in_the_pattern(name):
    check(*MODELS[name])


@pytest.mark.parametrize("name", ["nonlinear loops", "linear loops", "rigid trains"])
def test_loops_that_are_solved_together_stay_apart(name, monkeypatch):
    monkeypatch.setattr(blocks, "LARGE", 1)
    monkeypatch.setattr(blocks, "WRITTEN", 1)
    system = check(*MODELS[name])
    kinds = [type(step) for step in system.reduced.steps]
    assert kinds.count(SparseLoop) == 1
    assert TornLoop not in kinds


def test_too_many_entries_are_not_listed():
    reduced = ac.compile(Ladder(4)).reduced
    assert jacobian_pattern(reduced, 10) is None
    assert jacobian_pattern(reduced, 30) is not None
