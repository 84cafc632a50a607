"""The generated program: array code of fixed size, pure, and the same whatever the order of things."""

import itertools
import os
import random
import subprocess
import sys

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical
from tests.structure.test_hidden_constraints import MODELS
from tests.support.oracle import worst
from tests.support.parts import (
    Capacitor,
    Diode,
    Equations,
    Fixed,
    Force,
    Ground,
    Inductor,
    Mass,
    Model,
    Resistor,
    SignalVoltage,
    SpringDamper,
    model,
)


def chain(n):
    """n masses, a spring to the wall and one between each."""
    made = Model()
    made.wall = Fixed()
    made.masses = [Mass(m=1.0 + 0.1 * i) for i in range(n)]
    made.springs = [SpringDamper(c=10.0 + i, d=0.5) for i in range(n)]
    left = made.wall.flange
    for mass, spring in zip(made.masses, made.springs, strict=True):
        made.connect(left, spring.flange_a)
        made.connect(spring.flange_b, mass.flange_a)
        left = mass.flange_b
    return made


def jaxpr(system, names=()):
    x, u = jnp.ones(len(system.states)), jnp.ones(len(system.inputs))

    def program(t, x, u, packed):
        return system.vector_field(t, x, u, packed), system.observe(list(names), t, x, u, packed)

    return jax.make_jaxpr(program)(0.0, x, u, system.pack())


def inner_equations(program):
    """Equations of a jaxpr, those of inner ones among them."""
    for equation in program.eqns:
        yield equation
        for value in jax.tree.leaves(list(equation.params.values()), is_leaf=_is_jaxpr):
            if _is_jaxpr(value):
                yield from inner_equations(getattr(value, "jaxpr", value))


def _is_jaxpr(value):
    return hasattr(value, "eqns") or hasattr(value, "jaxpr")


def count(program):
    return sum(1 for _ in inner_equations(program))


# -- size -------------------------------------------------------------------------------------------------------


def test_the_program_of_a_chain_does_not_grow():
    names = ["masses[1].a", "springs[2].f"]
    few, many = (count(jaxpr(ac.compile(chain(n)), names).jaxpr) for n in (10, 200))
    assert few == many
    assert few < 100


def ladder(n):
    """n equal circuits with a loop each, that share a ground."""
    made = Model()
    made.g = Ground()
    made.v = [SignalVoltage() for _ in range(n)]
    made.r = [Resistor(R=1.0 + i) for i in range(n)]
    made.d = [Diode() for _ in range(n)]
    made.q = [Resistor(R=1.0) for _ in range(n)]
    made.l = [Inductor(L=1.0) for _ in range(n)]
    for v, r, d, q, inductor in zip(made.v, made.r, made.d, made.q, made.l, strict=True):
        made.connect(v.p, r.p)
        made.connect(r.n, d.p, q.p)
        made.connect(q.n, inductor.p)
        made.connect(d.n, inductor.n, v.n, made.g.p)
    return made


@pytest.mark.slow
def test_the_program_of_equal_loops_does_not_grow():
    few, many = (jaxpr(ac.compile(ladder(n))).jaxpr for n in (3, 60))
    assert count(few) == count(many)


def test_arguments_and_rates_are_slices():
    primitives = [e.primitive.name for e in inner_equations(jaxpr(ac.compile(chain(50))).jaxpr)]
    assert primitives.count("gather") == 0
    assert primitives.count("slice") > 3


def test_groups_of_one_stay_scalar():
    arithmetic = {"add", "sub", "mul", "div", "neg"}
    equations = inner_equations(jaxpr(ac.compile(chain(1))).jaxpr)
    shapes = {e.outvars[0].aval.shape for e in equations if e.primitive.name in arithmetic}
    assert shapes == {()}


# -- purity -----------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def small():
    return ac.compile(
        model(
            "w.flange - s.flange_a",
            "s.flange_b - m.flange_a",
            "m.flange_b - f.flange",
            w=Fixed(),
            s=SpringDamper(c=4.0, d=0.5),
            m=Mass(m=2.0),
            f=Force(),
        )
    )


def test_what_it_computes(small):
    x, u = jnp.array([0.5, 0.2]), jnp.array([3.0])
    rates = small.vector_field(0.0, x, u, small.parameters())
    np.testing.assert_allclose(rates, [0.2, (3.0 - 4.0 * 0.5 - 0.5 * 0.2) / 2.0])
    values = small.observe(
        ["m.a", "s.f", "s.flange_a.f", "w.flange.f"], 0.0, x, u, small.parameters()
    )
    np.testing.assert_allclose(values, [0.45, 2.1, -2.1, 2.1])


@pytest.mark.slow
def test_jit_vmap_and_grad_agree_with_the_plain_program(small):
    rng = np.random.default_rng(0)
    xs, us = jnp.asarray(rng.normal(size=(4, 2))), jnp.asarray(rng.normal(size=(4, 1)))
    packed = small.pack()

    def both(x, u, packed):
        return small.vector_field(0.0, x, u, packed), small.observe("m.a", 0.0, x, u, packed)

    plain = [both(x, u, packed) for x, u in zip(xs, us, strict=True)]
    batch = jax.jit(jax.vmap(both, in_axes=(0, 0, None)))(xs, us, packed)
    for i in range(2):
        np.testing.assert_allclose(batch[i], [p[i] for p in plain], rtol=1e-12)

    derivative = jax.jacobian(lambda x: both(x, us[0], packed)[0])(xs[0])
    np.testing.assert_allclose(derivative, [[0.0, 1.0], [-2.0, -0.25]], atol=1e-12)


def test_what_is_observed_together_is_computed_once(small):
    x, u, packed = jnp.ones(2), jnp.ones(1), small.pack()
    both = jax.make_jaxpr(lambda x: small.vector_field_and_observe(["m.a"], 0.0, x, u, packed))(x)
    alone = jax.make_jaxpr(lambda x: small.vector_field(0.0, x, u, packed))(x)
    assert count(both.jaxpr) <= count(alone.jaxpr) + 3


def test_only_what_is_asked_for_is_computed(small):
    x, u, packed = jnp.ones(2), jnp.ones(1), small.pack()
    one = jax.make_jaxpr(lambda x: small.observe("s.s_rel", 0.0, x, u, packed))(x)
    assert count(one.jaxpr) < 6


def test_parameters_can_be_batched(small):
    packed = small.pack()
    many = jax.vmap(lambda m: small.vector_field(0.0, jnp.ones(2), jnp.ones(1), {"m.m": m}))
    np.testing.assert_allclose(many(jnp.array([1.0, 2.0]))[:, 1], [-3.5, -1.75])
    assert packed.values.shape == (3,)


# -- the same whatever the order -----------------------------------------------------------------------------------


class Vehicle(ac.Component):
    """The same vehicle, put together in any order, any of its elements turned round."""

    def __init__(self, order, turned):
        super().__init__()
        make = {
            "body": lambda: Mass(m=350.0),
            "wheel": lambda: Mass(m=90.0),
            "link": lambda: Mass(m=5.0, L=0.2),
            "suspension": lambda: SpringDamper(c=1e4, d=800.0),
            "tyre": lambda: SpringDamper(c=3e5, d=100.0),
            "road": Fixed,
        }
        for name in order:
            setattr(self, name, make[name]())
        joints = [
            ("body.b", "suspension.a"),
            ("suspension.b", "link.a"),
            ("link.b", "wheel.a"),
            ("wheel.b", "tyre.a"),
            ("tyre.b", "road.a"),
        ]
        for joint in random.Random(str(order)).sample(joints, len(joints)):
            self.connect(*(self._end(*end.split("."), turned) for end in joint))

    def _end(self, name, side, turned):
        part = getattr(self, name)
        if isinstance(part, Fixed):
            return part.flange
        ends = {"a": part.flange_a, "b": part.flange_b}
        return ends[{"a": "b", "b": "a"}[side] if name in turned else side]


NAMES = ("body", "wheel", "link", "suspension", "tyre", "road")


def behaviour(order, turned=()):
    """Accelerations and forces at a state that is given by name."""
    system = ac.compile(Vehicle(order, turned))
    link = -0.2 - (0.1 if "link" not in turned else -0.1)  # it stands rigidly on the wheel
    at = {
        "body.s": 0.1,
        "body.v": 0.3,
        "wheel.s": -0.2,
        "wheel.v": -0.4,
        "link.s": link,
        "link.v": -0.4,
    }
    x = jnp.array([at[name] for name in system.states])
    names = ["body.a", "wheel.a", "link.a", "road.flange.f", "suspension.f", "tyre.f"]
    values = np.array(system.observe(names, 0.0, x, None, system.parameters()))
    values[-2:] = np.abs(
        values[-2:]
    )  # the force in a spring that is turned round is seen the other way
    return values


@pytest.mark.slow
def test_the_order_of_declaration_changes_nothing():
    expected = behaviour(NAMES)
    for i in range(3):
        order = random.Random(i).sample(NAMES, len(NAMES))
        np.testing.assert_allclose(behaviour(order), expected, rtol=1e-12)


@pytest.mark.parametrize("turned", ["body", "wheel", "suspension", "tyre"])
def test_turning_an_element_round_changes_nothing(turned):
    np.testing.assert_allclose(behaviour(NAMES, (turned,)), behaviour(NAMES), rtol=1e-12)


@pytest.mark.parametrize("order", list(itertools.islice(itertools.permutations("rcl"), 0, 6, 2)))
def test_the_order_of_electrical_parts_changes_nothing(order):
    kinds = {"r": Resistor(R=2.0), "c": Capacitor(C=0.5), "l": Inductor(L=3.0)}
    lines = ("v.p - r.p", "r.n - l.p", "l.n - c.p", "c.n - v.n - g.p")
    parts = {name: kinds[name] for name in order}
    system = ac.compile(model(*lines, **parts, v=SignalVoltage(), g=Ground()))
    at = {"c.v": 0.7, "l.i": -0.4}
    x = jnp.array([at[name] for name in system.states])
    rates = system.vector_field(0.0, x, [5.0], system.parameters())
    by_name = dict(zip(system.states, rates.tolist(), strict=True))
    assert by_name["c.v"] == pytest.approx(-0.8)
    assert by_name["l.i"] == pytest.approx((5.0 - 0.7 + 0.8) / 3.0)


def text():
    """All that is derived from some models, as text."""
    found = []
    hidden = [make() for make, _ in list(MODELS.values())[-3:]]
    for made in (Vehicle(NAMES, ("tyre",)), chain(4), ladder(3), *hidden):
        system = ac.compile(made)
        found.append(
            str((system.states, system.inputs, list(system.parameters()), system.equations))
        )
        found.append(str(jaxpr(system, system.variables)))
    return "\n".join(found)


@pytest.mark.slow
def test_hash_seeds_do_not_change_the_code():
    code = "from tests.codegen import test_generate; print(test_generate.text())"
    runs = [
        subprocess.Popen(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed, "JAX_PLATFORMS": "cpu"},
            stdout=subprocess.PIPE,
            text=True,
        )
        for seed in ("0", "12345")
    ]
    expected = text()  # of this process, with a seed of its own
    assert len(expected) > 10_000
    for run in runs:
        assert run.communicate()[0].strip() == expected


# -- inputs -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [1, 2])
def test_the_derivative_of_an_input_that_stands_negated(order):
    def stated(s):
        rate = ac.der(s.x) if order == 1 else ac.der(ac.der(s.x))
        return [ac.Eq(s.x, -s.u), ac.Eq(s.y, rate)]

    system = ac.compile(Equations("x y", stated, inputs="u"))
    assert system.inputs == ("u", "der(u)", "der(der(u))")[: order + 1]
    u = [0.4, 0.5, 0.7][: order + 1]
    names = ["x", "y", "der(x)", system.inputs[-1]]
    values = system.observe(names, 0.0, [], u, {})
    np.testing.assert_allclose(values, [-0.4, -u[-1], -0.5, u[-1]])
    assert worst(system) == 0.0


def test_an_inductor_between_the_poles_of_a_current_source():
    parts = {"s": electrical.SignalCurrent(), "l": electrical.Inductor(L=2.0)}
    system = ac.compile(model("s.p - l.p", "s.n - l.n - g.p", g=electrical.Ground(), **parts))
    values = system.observe(["l.i", "l.v", "s.v"], 0.0, [], [0.4, 0.5], system.parameters())
    np.testing.assert_allclose(values, [-0.4, -1.0, -1.0])


# -- odd shapes of data --------------------------------------------------------------------------------------------


def test_equal_rates_of_many_states():
    class Counter(ac.Component):
        x = ac.Variable()
        rate = ac.Input()

        def equations(self):
            yield ac.Eq(ac.der(self.x), self.rate)

    made = Model()
    made.c = [Counter() for _ in range(4)]
    for a, b in itertools.pairwise(made.c):
        made.connect(a.rate, b.rate)
    system = ac.compile(made)
    assert system.inputs == ("c[1].rate",)
    assert system.vector_field(0.0, jnp.zeros(4), [2.0], {}).tolist() == [2.0] * 4


def test_scattered_arguments():
    made = Model()
    made.m = [Mass(m=1.0 + i) for i in range(12)]
    made.s = [SpringDamper(c=1.0 + i, d=0.1) for i in range(20)]
    rng = np.random.default_rng(1)
    for spring in made.s:
        i, j = rng.choice(12, 2, replace=False)
        made.connect(made.m[i].flange_a, spring.flange_a)
        made.connect(made.m[j].flange_b, spring.flange_b)
    assert worst(ac.compile(made)) < 1e-12
