"""Alias elimination: what is equal up to sign becomes one variable, and derivatives stay chains."""

import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.flattening.flat_model import flatten
from acausal.flattening.template import Template, slot
from acausal.structure.aliases import eliminate_aliases
from tests.support.oracle import worst
from tests.support.parts import Equations, Fixed, Mass, SpringDamper, model

Eq, der = ac.Eq, ac.der


def aliases(component):
    """Name and sign of every variable's representative, and names of derivatives."""
    flat = flatten(component)
    found = eliminate_aliases(flat)
    name = lambda i: "0" if i == found.zero else _name(flat, found, i)  # noqa: E731
    n = flat.n_variables
    same = {
        flat.layout.variable(i): (name(int(found.representative[i])), int(found.sign[i]))
        for i in range(n)
    }
    rates = {
        name(i): (name(int(d)), int(found.derivative_sign[i]))
        for i, d in enumerate(found.derivative)
        if d >= 0
    }
    return same, rates, found


def _name(flat, found, i):
    return (
        flat.layout.variable(i)
        if i < flat.n_variables
        else f"der({_name(flat, found, found.base[i])})"
    )


def test_signs_along_a_chain():
    same, _, found = aliases(
        Equations(
            "a b c d", lambda s: [Eq(s.a, -s.b), Eq(s.c, s.b), Eq(-s.d, s.c), Eq(der(s.a), 1)]
        )
    )
    assert same == {"a": ("a", 1), "b": ("a", -1), "c": ("a", -1), "d": ("a", 1)}
    assert found.redundant == ()


def test_zero_swallows():
    same, rates, _ = aliases(
        Equations("a b c", lambda s: [Eq(s.a, 0), Eq(s.b, -s.a), Eq(s.c, der(s.b))])
    )
    assert {r for r, _ in same.values()} == {"0"}
    assert rates == {}


def test_equal_and_opposite_is_zero():
    same, _, found = aliases(Equations("a b", lambda s: [Eq(s.a, s.b), Eq(s.a, -s.b)]))
    assert {r for r, _ in same.values()} == {"0"}
    assert found.redundant == ()


def test_derivatives_are_merged_with_their_variables():
    same, rates, _ = aliases(
        Equations(
            "x y v w",
            lambda s: [Eq(s.x, -s.y), Eq(der(s.x), s.v), Eq(der(s.y), s.w), Eq(s.v, 1)],
        )
    )
    assert same["w"] == ("v", -1)
    assert rates == {"x": ("v", 1)}


def test_specialising_reveals_further_aliases():
    # a + b - c = 0 is an alias once b is zero
    same, _, _ = aliases(
        Equations("a b c", lambda s: [Eq(s.a + s.b - s.c, 0), Eq(s.b, 0), Eq(s.a, 3)])
    )
    assert same["c"] == ("a", 1)


def test_an_equation_that_says_nothing_new_is_told():
    _, _, found = aliases(Equations("a b", lambda s: [Eq(s.a, s.b), Eq(s.b, s.a)]))
    assert [(str(o), c) for o, c in found.redundant] == [("Equations: b = a", 0)]


def test_the_name_is_an_inputs_a_preferred_states_or_the_shallowest():
    class Inner(ac.Component):
        a = ac.Variable(state="prefer")
        b = ac.Variable()
        u = ac.Input()
        c = ac.Variable()

        def equations(self):
            yield Eq(self.b, self.a)
            yield Eq(self.c, self.u)

    class Outer(ac.Component):
        b = ac.Variable()
        c = ac.Variable()
        d = ac.Variable()

        def __init__(self):
            super().__init__()
            self.inner = Inner()
            self.box = Equations("e", lambda s: [Eq(s.e, 1)])

        def equations(self):
            yield Eq(self.b, self.inner.b)
            yield Eq(self.c, self.inner.c)
            yield Eq(self.d, self.box.e)

    same, _, _ = aliases(Outer())
    assert same["b"] == ("inner.a", 1)
    assert same["c"] == ("inner.u", 1)
    assert same["box.e"] == ("d", 1)


RINGS = {
    "growth": ("x", lambda s: [Eq(der(s.x), s.x)]),
    "decay": ("x", lambda s: [Eq(der(s.x), -s.x)]),
    "oscillator": ("x v", lambda s: [Eq(der(s.x), s.v), Eq(der(s.v), -s.x)]),
    "two in a ring": ("x y", lambda s: [Eq(der(s.x), s.y), Eq(der(s.y), s.x)]),
    "three in a ring": (
        "x y z",
        lambda s: [Eq(der(s.x), s.y), Eq(der(s.y), s.z), Eq(der(s.z), -s.x)],
    ),
    "closed afterwards": (
        "a b w",
        lambda s: [Eq(der(s.a), s.w), Eq(der(s.w), s.b), Eq(s.a, s.b)],
    ),
    "one signal integrated twice": (
        "x y z",
        lambda s: [Eq(der(s.x), s.z), Eq(der(s.y), -s.z), Eq(s.z, s.y - s.x**2)],
    ),
    "zero integrated twice": ("x y", lambda s: [Eq(der(s.x), 0), Eq(der(s.y), 0)]),
}


@pytest.mark.parametrize("name", RINGS)
def test_rings_and_branches_of_derivatives_stay_equations(name):
    variables, stated = RINGS[name]
    component = Equations(variables, stated)
    _, rates, _ = aliases(component)
    targets = [target for target, _ in rates.values() if target != "0"]
    assert len(set(targets)) == len(targets)
    for start in rates:
        seen = [start]
        while seen[-1] in rates:
            seen.append(rates[seen[-1]][0])
            assert len(set(seen)) == len(seen)
    assert worst(ac.compile(component)) < 1e-12


def test_integrating_one_input_twice():
    system = ac.compile(
        Equations("x y", lambda s: [Eq(der(s.x), s.u), Eq(der(s.y), -s.u)], inputs="u")
    )
    rates = system.vector_field(0.0, np.zeros(2), [3.0], system.parameters())
    assert rates.tolist() == [3.0, -3.0]


def test_inputs_are_free():
    cases = {
        "tie the input 'u' to zero": ("", lambda s: [Eq(s.u, 0)], "u"),
        "tie the input 'w' to the input 'u'": ("", lambda s: [Eq(s.u, s.w)], "u w"),
        "the input 'w' is made a derivative of the input 'u'": (
            "",
            lambda s: [Eq(s.w, der(s.u))],
            "u w",
        ),
    }
    for told, (variables, stated, inputs) in cases.items():
        with pytest.raises(ac.StructureError, match=told):
            ac.compile(Equations(variables, stated, inputs))


def test_a_variable_over_a_zero_default_is_told():
    class Inverse(ac.Component):
        k = ac.Parameter(0.0)
        x = ac.Variable()

        def equations(self):
            yield Eq(der(self.x), 1 / self.k)

    with pytest.raises(ac.StructureError, match="division by zero; k is zero there"):
        ac.compile(Inverse())


def test_specialised_templates():
    a, b, c, p = (slot(n) for n in "abcp")
    template = Template(a * p + b - c**2, (a, b, c), (0, 0, 0), (p,), ())
    merged, (variables, parameters, _) = template.specialised((1, -1, 3, 0))
    assert merged.residual == a * p - a - c**2
    assert (variables, parameters) == ([0, 2], [0])
    without, (variables, parameters, _) = template.specialised((1, 2, 0, 1))
    assert without.residual == b
    assert (variables, parameters) == ([1], [])


def test_a_chain_reduces_to_two_variables_a_mass():
    parts = {"x": Fixed(), **{f"m{i}": Mass(m=1.0) for i in range(3)}}
    parts |= {f"s{i}": SpringDamper(c=1.0, d=1.0) for i in range(3)}
    lines = [f"s{i}.flange_b - m{i}.flange_a" for i in range(3)]
    lines += [f"m{i}.flange_b - s{i + 1}.flange_a" for i in range(2)]
    system = ac.compile(model("x.flange - s0.flange_a", *lines, **parts))
    # per mass: s, v, a; per spring s_rel, v_rel, f
    kept = {int(r) for r in system.reduced.aliases.representative} - {system.reduced.aliases.zero}
    names = {system.reduced.name(i) for i in kept}
    assert "m0.flange_a.s" not in names
    assert "m2.flange_b.f" not in names


def test_the_angle_of_what_is_zero_is_zero() -> None:
    class Angle(ac.Component):
        x, y, phi, z = (ac.Variable() for _ in range(4))

        def equations(self):
            yield from (Eq(self.x, 0), Eq(self.y, self.x))
            yield Eq(self.phi, ac.atan2(self.y, self.x))
            yield Eq(der(self.z), ac.cos(ac.atan2(self.y, self.x)) + self.phi)

    system = ac.compile(Angle())
    assert float(system.vector_field(0.0, [0.0], None, system.parameters())[0]) == 1


def test_a_quotient_that_a_condition_avoids_may_have_no_value() -> None:
    class Guarded(ac.Component):
        x, y, z = (ac.Variable() for _ in range(3))

        def equations(self):
            yield from (Eq(self.x, 0), Eq(self.y, self.x))
            ratio = sp.Piecewise((self.y / self.x, self.x > self.z), (5, True))
            yield Eq(der(self.z), ratio)

    system = ac.compile(Guarded())
    assert float(system.vector_field(0.0, [1.0], None, system.parameters())[0]) == 5
