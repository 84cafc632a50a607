"""Models, systems, solutions and fits: copied, pickled, sent to another process."""

from __future__ import annotations

import copy
import itertools
import multiprocessing
import pickle
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical as el, translational as tl
from acausal.modeling import Reference
from acausal.structure import SparseLoop, blocks
from tests.support.oscillator import learned, plain
from tests.support.spawned import simulated


def pickled(thing: Any) -> Any:
    return pickle.loads(pickle.dumps(thing))


COPIES = [copy.copy, copy.deepcopy, pickled]


class Bound(ac.Component):
    """A part whose parameter, start and default are expressions of others."""

    ratio = ac.Parameter(2.0)
    double = ac.Parameter(lambda self: 2 * self.ratio)

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.mass = tl.Mass(m=self.double, s=ac.Start(self.ratio, fixed=True))
        self.spring, self.fixed = tl.Spring(c=1.0 / self.mass.m), tl.Fixed()
        self.connect(self.fixed.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)


def program(system: ac.System) -> str:
    """What JAX is given."""
    x, u = np.ones(len(system.states)), np.ones(len(system.inputs))
    params = system.parameters()
    return str(jax.make_jaxpr(lambda *at: system.vector_field(*at, params))(0.0, x, u))


@pytest.mark.parametrize("again", COPIES)
def test_a_copied_model_is_one_of_its_own(again):
    model = Bound()
    other = again(model)
    assert other.mass is not model.mass
    assert other.mass.m is not model.mass.m
    assert other.mass.m is other.mass.m
    assert other.mass.m.owner is other.mass._node
    assert other.mass.m.declaration is model.mass.m.declaration
    other.modify(ratio=3.0)
    both = [ac.compile(m) for m in (model, other)]
    assert [s.initial_state()[0] for s in both] == [2.0, 3.0]
    assert program(both[0]) == program(both[1])


def test_a_copy_can_stand_beside_its_model():
    pair = ac.Component()
    model = Bound()
    again = pickled(model)
    pair.a, pair.b = model, again
    pair.b.modify(ratio=5.0)
    system = ac.compile(pair)
    assert system.states == ("a.mass.s", "a.mass.v", "b.mass.s", "b.mass.v")
    assert dict(zip(system.states, system.initial_state(), strict=True))["b.mass.s"] == 5.0


def test_symbols_of_a_process_stay_apart_from_those_that_it_is_sent(monkeypatch):
    sent = pickle.dumps(Bound())
    monkeypatch.setattr(Reference, "_serials", itertools.count())  # as in a new process
    received = pickle.loads(sent)
    last = max(received.mass.m.serial, received.spring.c.serial)
    assert Bound().mass.m.serial > last


@pytest.mark.parametrize("again", COPIES)
@pytest.mark.parametrize("make", [plain, learned])
def test_a_copied_system_computes_the_same(make, again):
    system = make()
    system.initialize()  # fills caches, compiled functions among them
    other = again(system)
    assert program(other) == program(system)
    assert other.variables == system.variables
    np.testing.assert_array_equal(other.initialize().x, system.initialize().x)
    assert str(other.equations) == str(system.equations)


class Counter(ac.Component):
    """Counts the instants of a clock, from the value before each."""

    n = ac.Discrete(0, kind="int")

    def equations(self) -> Any:
        yield ac.When(ac.sample(0.5, 1.0), ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.slow
@pytest.mark.parametrize("again", COPIES)
def test_a_copied_system_knows_values_before_events(again):
    system = again(ac.compile(Counter()))
    assert ac.simulate(system, 3.0, saveat=[0.0, 3.0])["n"].tolist() == [0, 3]
    assert ac.compile(again(system.model)).remembered == ("n",)


@pytest.mark.slow
def test_a_copied_system_with_a_sparse_loop(monkeypatch):
    monkeypatch.setattr(blocks, "LARGE", 4)
    monkeypatch.setattr(blocks, "WRITTEN", 4)
    net = ac.Component()
    net.source, net.ground = el.ConstantVoltage(V=1.0), el.Ground()
    net.r, net.d = [el.Resistor(R=1.0 + k) for k in range(6)], el.Resistor(R=2.0)
    net.c = el.Capacitor(C=1.0)
    net.connect(net.source.p, net.r[0].p, net.r[3].p)
    net.connect(net.r[0].n, net.r[1].p, net.r[2].p)
    net.connect(net.r[3].n, net.r[4].p, net.r[2].n, net.d.p)
    net.connect(net.r[1].n, net.r[4].n, net.r[5].p, net.c.p)
    net.connect(net.source.n, net.r[5].n, net.d.n, net.c.n, net.ground.p)
    system = ac.compile(net)
    assert any(isinstance(s, SparseLoop) for s in system.reduced.steps)
    x, params = np.array([0.1]), system.parameters()
    rate = system.vector_field(0.0, x, None, params)
    np.testing.assert_array_equal(pickled(system).vector_field(0.0, x, None, params), rate)


@pytest.mark.parametrize("again", COPIES)
def test_a_copied_solution_has_all_variables(again):
    solution = simulated((plain(), plain().parameters()))
    other = again(solution)
    np.testing.assert_array_equal(other.x, solution.x)
    np.testing.assert_array_equal(other["mass.a"], solution["mass.a"])


@pytest.mark.slow
def test_a_spawned_process_finds_the_same_trajectory():
    system = learned()
    params = system.parameters(1)
    heavier = {**params, "mass.m": 3.0}
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        found = pool.map_async(simulated, [(system, params), (system, heavier)]).get(120)
    for one, params_of_one in zip(found, (params, heavier), strict=True):
        expected = simulated((system, params_of_one))
        np.testing.assert_array_equal(one.x, expected.x)
        np.testing.assert_array_equal(one["mass.a"], expected["mass.a"])
