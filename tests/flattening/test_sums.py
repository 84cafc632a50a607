"""Nodes where many connectors meet: integers state their balance, and arrays compute it."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.components import electrical as el
from acausal.flattening.sums import FEW, Sum, balance
from acausal.flattening.template import Template
from acausal.structure import Accumulation, TornLoop

MANY = FEW + 7


def test_few_terms_are_a_template_and_many_a_total_of_the_same_meaning():
    few, many = (balance((1, -1, 2, *[1] * n)) for n in (FEW - 3, FEW - 2))
    assert isinstance(few, Template)
    assert isinstance(many, Sum)
    for stated in (few, many):
        a, b, c, *rest = stated.variables
        assert sp.expand(stated.residual - (a - b + 2 * c + sum(rest))) == 0


def test_merged_negated_and_vanished_slots_of_a_total():
    total = Sum((1, 1, -1, *[1] * FEW))
    pattern = (1, 1, -3, 0, *(j + 1 for j in range(4, 3 + FEW)))
    special, (left, _, _) = total.specialised(pattern)
    assert isinstance(special, Sum)
    assert special.coefficients() == (2, 1, *[1] * (FEW - 1))
    assert left == [0, 2, *range(4, 3 + FEW)]
    cancelled, (left, _, _) = total.specialised((1, -1, *[3] * (1 + FEW)))
    assert isinstance(cancelled, Template)
    assert (str(cancelled.residual), left) == (f"{FEW - 1}*f1", [2])


def test_the_derivative_of_a_total_is_a_total():
    derivative, sources = Sum((1, -1) * FEW).differentiated()
    assert derivative == Sum((1, -1) * FEW)
    assert sources == tuple((i, True) for i in range(2 * FEW))


class Star(ac.Component):
    """Branches from a common node, each of ``element`` and a capacitor in series; all end at the ground."""

    def __init__(self, n, element, center=None):
        super().__init__()
        self.ground = el.Ground()
        self.element = [element(k) for k in range(1, n + 1)]
        self.c = [el.Capacitor(C=0.1 * k) for k in range(1, n + 1)]
        for branch, c in zip(self.element, self.c, strict=True):
            self.connect(branch.n, c.p)
            self.connect(c.n, self.ground.p)
        self.connect(*(b.p for b in self.element))
        if center is not None:
            self.center = center
            self.connect(center.p, self.element[0].p)
            self.connect(center.n, self.ground.p)


def steps(system, kind):
    return [s for s in system.reduced.steps if isinstance(s, kind)]


def currents(system, x, n):
    packed = system.pack()
    return np.asarray(
        [system.observe(f"element[{k}].p.i", 0.0, x, None, packed) for k in range(1, n + 1)]
    )


def test_a_storage_in_a_large_node_takes_what_the_others_bring():
    system = ac.compile(Star(MANY, lambda k: el.Conductor(G=1.0 * k), el.Capacitor(C=2.0)))
    widths = [(len(s.terms), s.terms.shape[1]) for s in steps(system, Accumulation)]
    assert (1, MANY) in widths
    x = jnp.arange(1.0, MANY + 2)
    rate = system.observe("der(center.v)", 0.0, x, None, system.pack())
    assert float(rate) == pytest.approx(-currents(system, x, MANY).sum() / 2.0)
    text = str(system.equations[system.states.index("center.v")].rhs)
    assert all(f"element[{k}].G" in text for k in range(1, MANY + 1))


def test_large_nodes_of_one_size_are_summed_side_by_side():
    class Stars(ac.Component):
        def __init__(self):
            super().__init__()
            self.star = [
                Star(MANY, lambda k: el.Conductor(G=1.0 * k), el.Capacitor(C=2.0)) for _ in range(3)
            ]

    assert (3, MANY) in [s.terms.shape for s in steps(ac.compile(Stars()), Accumulation)]


def test_a_large_node_without_storage_is_a_loop_that_reads_one_sum():
    system = ac.compile(Star(MANY, lambda k: el.Conductor(G=1.0 * k)))
    (loop,) = steps(system, TornLoop)
    assert loop.shape.n_unknowns > MANY
    x = jnp.arange(1.0, MANY + 1)
    flows = currents(system, x, MANY)
    assert abs(flows.sum()) < 1e-9
    g, v = np.arange(1.0, MANY + 1), np.arange(1.0, MANY + 1)
    np.testing.assert_allclose(flows, g * ((g * v).sum() / g.sum() - v), rtol=1e-12, atol=1e-9)


def test_currents_that_sum_to_zero_are_one_state_less():
    system = ac.compile(Star(MANY, lambda k: el.Inductor(L=1.0 * k)))
    assert len(system.states) == 2 * MANY - 1
    x = jnp.linspace(-1.0, 1.0, len(system.states))
    assert abs(currents(system, x, MANY).sum()) < 1e-12
    rates = [
        system.observe(f"der(element[{k}].i)", 0.0, x, None, system.pack())
        for k in range(1, MANY + 1)
    ]
    assert abs(sum(map(float, rates))) < 1e-12


def test_gradients_pass_through_large_nodes():
    system = ac.compile(Star(MANY, lambda k: el.Conductor(G=1.0 * k), el.Capacitor(C=2.0)))
    x = jnp.linspace(-1.0, 1.0, len(system.states))
    packed = system.pack()
    derivative = jax.jacfwd(lambda x: system.vector_field(0.0, x, None, packed))(x)
    row = derivative[system.states.index("center.v")]
    by_name = dict(zip(system.states, row.tolist(), strict=True))
    assert by_name["c[3].v"] == pytest.approx(3.0 / 2.0)
    assert by_name["center.v"] == pytest.approx(-sum(range(1, MANY + 1)) / 2.0)
