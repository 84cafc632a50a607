"""From the component tree to numbered variables, equation instances and connection sets."""

import re
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.flattening.connections import connection_sets
from acausal.flattening.flat_model import flatten
from acausal.flattening.templates import FEW_VARIANTS
from acausal.units.check import check_dimensions
from tests.support.oracle import worst
from tests.support.parts import (
    Equations,
    Fixed,
    Flange,
    Force,
    Ground,
    Mass,
    Model,
    Resistor,
    SpringDamper,
    TwoFlanges,
    model,
)


def variables(flat):
    return [flat.layout.variable(i) for i in range(flat.n_variables)]


def parameters(component):
    """Values of all parameters by name, as they run."""
    system = ac.compile(component)
    packed = system.pack(None)
    names = [system.flat.layout.parameter(i) for i in range(len(system.flat.value))]
    at = system.layout.position
    return {n: float(packed.values[at[i]]) for i, n in enumerate(names) if at[i] >= 0}


def nodes(component):
    """Connection sets, as sets of dotted connector names (``|`` marks a side seen from within)."""
    layout = flatten(component).layout
    found = []
    for connected in connection_sets(layout).sets:
        names = [layout.variable(v) for v in connected.variables]
        marks = ["|" * inner for inner in connected.inner]
        found.append({n + m for n, m in zip(names, marks, strict=True)})
    return found


# -- numbering ------------------------------------------------------------------------------------------


def test_variables_are_numbered_in_order_of_declaration():
    flat = flatten(model("a.flange_b - b.flange", a=Mass(m=1.0), b=Fixed()))
    assert variables(flat) == [
        "a.flange_a.s",
        "a.flange_a.f",
        "a.flange_b.s",
        "a.flange_b.f",
        "a.s",
        "a.v",
        "a.a",
        "b.flange.s",
        "b.flange.f",
    ]
    assert [flat.layout.find_variable(n) for n in variables(flat)] == list(range(9))
    assert flat.layout.find_variable("a.flange_c.s") is None
    assert flat.layout.find_variable("") is None


def test_equal_components_share_their_templates():
    flat = flatten(model(a=Mass(m=1.0), b=Mass(m=2.0), c=Mass(m=3.0)))
    assert len(flat.layout.forms) == 2  # Model and Mass
    assert all(len(g) == 3 for g in flat.groups if (g.components >= 0).all())


class Rule(ac.Component):
    """Two laws that subclasses inherit."""

    x, y = ac.Variable(), ac.Variable()
    k = ac.Parameter()

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.y / self.k)
        yield ac.Eq(self.y**2, 1 - self.x)


class First(Rule):
    k = ac.Parameter(default=1.0)


class Second(Rule):
    k = ac.Parameter(default=0.0)


def test_classes_that_inherit_equations_share_their_templates_and_are_named_each():
    flat = flatten(model(a=First(), b=Second(k=2.0)))
    (one, two), (other, another) = zip(*[flat.groups[:2], flat.groups[2:]], strict=True)
    assert one.template is two.template
    assert other.template is another.template
    assert str(another.origins[0]) == "Second: y**2 = 1 - x"
    classes = {f"a{i}": type(f"Class{i}", (First,), {})() for i in range(FEW_VARIANTS + 1)}
    assert len(ac.compile(model(**classes)).program.instructions) == 2
    with pytest.raises(
        ac.ModelError, match=r"^Second: der\(x\) = y/k: division by zero; k is zero there"
    ):
        ac.compile(model(a=First(), b=Second()))


def test_what_the_author_keeps_in_an_instance_tells_forms_apart():
    class Gain(ac.Component):
        x = ac.Variable()

        def __init__(self, k, power):
            super().__init__()
            self._k, self.power = k, power

        def equations(self):
            yield ac.Eq(ac.der(self.x), self._k * self.x**self.power)

    system = ac.compile(model(a=Gain(1.0, 1), b=Gain(2.0, 1), c=Gain(2.0, 2)))
    rates = system.vector_field(0.0, jnp.full(3, 3.0), None, system.parameters())
    assert rates.tolist() == [3.0, 6.0, 18.0]


def test_options_and_sizes_tell_forms_apart():
    class Polynomial(ac.Component):
        order = ac.Option(1)
        k = ac.Parameter([1.0], shape=":")
        x = ac.Variable(shape="order")
        total = ac.Variable()

        def equations(self):
            for i, x in enumerate(self.x):
                yield ac.Eq(ac.der(x), i + 1)
            yield ac.Eq(self.total, sum(k * self.x[0] ** i for i, k in enumerate(self.k)))

    flat = flatten(model(a=Polynomial(), b=Polynomial(order=2), c=Polynomial(k=[1.0, 2.0, 3.0])))
    assert len(flat.layout.forms) == 4
    assert "b.x[2]" in variables(flat)
    assert "a.x[2]" not in variables(flat)


def test_ten_levels():
    class Box(TwoFlanges):
        """A spring in boxes."""

        def __init__(self, depth, **modifiers):
            super().__init__(**modifiers)
            self.inner = Box(depth - 1) if depth else SpringDamper(c=10.0, d=1.0)
            self.connect(self.flange_a, self.inner.flange_a)
            self.connect(self.inner.flange_b, self.flange_b)

    system = ac.compile(
        model(
            "x.flange - b.flange_a", "b.flange_b - m.flange_a", x=Fixed(), b=Box(10), m=Mass(m=2.0)
        )
    )
    assert ".".join(["b", *["inner"] * 11, "s_rel"]) in system.variables
    rates = system.vector_field(0.0, jnp.array([1.0, 1.0]), None, system.parameters())
    np.testing.assert_allclose(rates, [1.0, -5.5])
    assert worst(system) < 1e-12


# -- parameters -----------------------------------------------------------------------------------------


class Leaf(ac.Component):
    c = ac.Parameter(1.0)
    d = ac.Parameter(0.5)
    x = ac.Variable(start="c")

    def equations(self):
        yield ac.Eq(ac.der(self.x), -self.c * self.x + self.d)


class Middle(ac.Component):
    c = ac.Parameter(2.0)

    def __init__(self, **modifiers):
        super().__init__(**modifiers)
        self.leaf = Leaf(c=2 * self.c, d=self.c**2 + 1)


class Top(ac.Component):
    c = ac.Parameter(3.0)

    def __init__(self, **modifiers):
        super().__init__(**modifiers)
        self.middle = Middle(c=self.c + 1)
        self.other = Leaf(c=self.middle.leaf.c)


def test_parameters_bound_across_levels():
    assert parameters(Top()) == {
        "c": 3.0,
        "middle.c": 4.0,
        "middle.leaf.c": 8.0,
        "middle.leaf.d": 17.0,
        "other.c": 8.0,
        "other.d": 0.5,
    }
    assert parameters(Top(c=0.0))["middle.leaf.c"] == 2.0


def test_bound_parameters_follow_when_the_free_one_changes():
    system = ac.compile(Top())
    assert set(system.parameters()) == {"c", "other.d"}
    x = jnp.ones(2)
    rates = system.vector_field(0.0, x, None, {"c": 1.0, "other.d": 0.5})
    np.testing.assert_allclose(rates, [-4.0 + 5.0, -4.0 + 0.5])


def test_starts_may_name_a_parameter():
    assert ac.compile(Top()).initial_state().tolist() == [8.0, 8.0]


def test_defaults_may_be_computed_from_the_component():
    class Cylinder(ac.Component):
        r = ac.Parameter(2.0)
        area = ac.Parameter(lambda self: ac.pi * self.r**2)
        twice = ac.Parameter(lambda self: 2 * self.area)
        x = ac.Variable()

        def equations(self):
            yield ac.Eq(ac.der(self.x), self.twice)

    assert parameters(Cylinder())["twice"] == pytest.approx(8 * np.pi)
    assert parameters(Cylinder(area=3.0)) == {"r": 2.0, "area": 3.0, "twice": 6.0}


def test_vectors_and_matrices():
    class Linear(ac.Component):
        A = ac.Parameter(shape=(2, 2))
        b = ac.Parameter([1.0, 2.0], shape=2)
        x = ac.Variable(shape=2, start=0.5)

        def equations(self):
            for i, row in enumerate(self.A):
                total = sum(a * x for a, x in zip(row, self.x, strict=True))
                yield ac.Eq(ac.der(self.x[i]), total + self.b[i])

    linear = Linear(A=[[1.0, 2.0], [3.0, 4.0]], x=ac.Start([5.0, 6.0]))
    system = ac.compile(model(a=linear))
    assert system.states == ("a.x[1]", "a.x[2]")
    assert system.initial_state().tolist() == [5.0, 6.0]
    assert system.parameters()["a.A[2,1]"] == 3.0
    rates = system.vector_field(0.0, jnp.array([1.0, 10.0]), None, system.parameters())
    assert rates.tolist() == [22.0, 45.0]


def test_a_number_fills_a_vector():
    class Table(ac.Component):
        k = ac.Parameter(shape=3)
        x = ac.Variable()

        def equations(self):
            yield ac.Eq(ac.der(self.x), sum(self.k))

    assert parameters(Table(k=2.0)) == {"k[1]": 2.0, "k[2]": 2.0, "k[3]": 2.0}


def test_a_zero_default_is_folded_and_a_given_zero_is_not():
    system = ac.compile(model(a=Mass(m=1.0), b=Mass(m=1.0, L=0.0)))
    assert "a.L" not in system.parameters()
    assert system.parameters()["b.L"] == 0.0


class Bar(ac.Component):
    """Two masses whose lengths are given by its own."""

    L = ac.Parameter(0.0)

    def __init__(self, **modifiers):
        super().__init__(**modifiers)
        self.a, self.b = Mass(m=1.0, L=self.L), Mass(m=1.0, L=2 * self.L)
        self.c = Mass(m=1.0, L=self.L + 1)
        self.connect(self.a.flange_b, self.b.flange_a)
        self.connect(self.b.flange_b, self.c.flange_a)


def test_what_folded_parameters_make_zero_is_folded():
    names = {"L", "a.L", "b.L", "c.L"}
    kept = set(ac.compile(Bar()).parameters())
    assert names & kept == set()
    assert ac.compile(Bar()).pack().values.tolist().count(1.0) == 4  # three masses, and c.L
    assert names & set(ac.compile(Bar(L=0.0)).parameters()) == {"L"}


class Sheet(ac.Component):
    """A resistance that is given, or else follows from what has no use then; a current through none has no equation."""

    given, given_is, squares, sheet = (
        ac.Parameter(0.0),
        ac.Parameter(),
        ac.Parameter(1.0),
        ac.Parameter(0.0),
    )
    R = ac.Parameter()
    i, x, y = ac.Variable(), ac.Variable(), ac.Variable()

    def __init__(self, **modifiers):
        super().__init__(**modifiers)
        other = self.squares * self.sheet
        is_given = ac.where(self.given > -1e40, 1, 0)
        self.modify(given_is=is_given, R=ac.where(self.given_is > 0.5, self.given, other))

    def equations(self):
        yield ac.Eq(ac.der(self.x), -self.i)
        yield ac.Eq(self.y, ac.time)
        yield ac.Eq(self.i * self.R, self.x - self.y)


def test_what_is_zero_whatever_the_others_are_is_folded():
    system = ac.compile(Sheet())
    assert "R" not in system.parameters()
    np.testing.assert_allclose(ac.simulate(system, 1)["i"], -1)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: model(a=Mass(), b=Mass()), "parameter without a value: 'a.m', 'b.m'; give it"),
        (lambda: model(a=Resistor()), "'a.R'"),
    ],
)
def test_a_parameter_without_a_value(make, told):
    with pytest.raises(ac.DeclarationError, match=re.escape(told)):
        ac.compile(make())


class Circle(ac.Component):
    p = ac.Parameter()
    q = ac.Parameter()
    r = ac.Parameter()
    x = ac.Variable()

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.p)


@pytest.mark.parametrize("wrap", [lambda p: p, lambda p: p + 1])
@pytest.mark.parametrize("pairs", ["p=p", "p=q q=p", "p=q q=r r=p", "p=q q=r r=q"])
def test_parameters_bound_in_a_circle(pairs, wrap):
    circle = Circle(**dict.fromkeys("pqr", 1.0))
    for pair in pairs.split():
        target, source = pair.split("=")
        setattr(circle, target, wrap(getattr(circle, source)))
    with pytest.raises(ac.DeclarationError, match="parameters are bound in a circle: "):
        ac.compile(circle)


def test_values_from_outside_of_the_model_are_refused():
    class Inner(ac.Component):
        k = ac.Parameter()
        x = ac.Variable()

        def equations(self):
            yield ac.Eq(ac.der(self.x), self.k)

    outer = Top()
    outer.inner = Inner(k=outer.c)
    with pytest.raises(ac.DeclarationError, match="refers to 'c' of Top, which is not part of"):
        ac.compile(outer.inner)


@pytest.mark.slow
def test_an_array_may_be_declared_with_a_start_for_each_element():
    class Counts(ac.Component):
        n = ac.Discrete((5.0, 6.0), shape=2)
        x = ac.Variable(start=((1.0, 2.0),), shape=(1, 2))

        def equations(self):
            yield ac.When(ac.time > 0.7, *[ac.Eq(n, ac.pre(n) + 1) for n in self.n])
            for x in self.x[0]:
                yield ac.Eq(ac.der(x), 0)

    run = ac.simulate(ac.compile(Counts()), 1.0, dt=0.5)
    assert [run["n[1]"][0], run["n[2]"][0], run["n[2]"][-1]] == [5, 6, 7]
    assert [run["x[1,1]"][0], run["x[1,2]"][0]] == [1, 2]


@pytest.mark.parametrize("start", [("a", 1.0), (None, 1.0), (1.0,), ((1.0, 2.0), 3.0)])
def test_a_start_that_lacks_a_number_for_an_element_is_refused(start: Any):
    class Rates(ac.Component):
        x = ac.Variable(start=start, shape=2)

        def equations(self):
            for x in self.x:
                yield ac.Eq(ac.der(x), 0)

    with pytest.raises(ac.DeclarationError, match=r"start of 'x' has no number for x\[[12]\]"):
        ac.compile(Rates())


def test_wrong_sizes():
    class Table(ac.Component):
        k = ac.Parameter(shape=3)
        x = ac.Variable(shape=3)

        def equations(self):
            for x, k in zip(self.x, self.k, strict=True):
                yield ac.Eq(ac.der(x), k)

    with pytest.raises(ac.DeclarationError, match=r"Table 'a'\.k needs 3 values, got 2"):
        ac.compile(model(a=Table(k=[1.0, 2.0])))
    with pytest.raises(ac.DeclarationError, match="needs 3 values, got 1 by 3"):
        ac.compile(model(a=Table(k=[[1.0, 2.0, 3.0]])))
    with pytest.raises(ac.DeclarationError, match=r"start of 'x' has no number for x\[3\]"):
        ac.compile(model(a=Table(k=[1.0, 2.0, 3.0], x=ac.Start([1.0, 2.0]))))


# -- equations ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("stated", "told"),
    [
        (lambda s: [s.x], "equations() yields x; yield ac.Eq(left, right)"),
        (lambda s: None, "its equations cannot be read ('NoneType' object is not iterable)"),
        (lambda s: [ac.Eq(s.x, np.sin(s.x))], "use ac.sin"),
        (lambda s: [ac.Eq(s.x, 1)] if s.x > 0 else [], "truth value"),
        (lambda s: [ac.Eq(s.x, Mass(m=1.0).s)], "'s' belongs to Mass, which is not part of"),
        (lambda s: [ac.Eq(s.x, Mass(m=1.0).m)], "'m' belongs to Mass"),
    ],
)
def test_wrong_equations(stated, told):
    with pytest.raises(ac.DeclarationError, match=re.escape(told)):
        ac.compile(Equations("x", stated))


def test_symbols_and_functions_of_elsewhere():
    import sympy as sp

    with pytest.raises(ac.DeclarationError, match=r"x = k: 'k' is not declared"):
        ac.compile(Equations("x", lambda s: [ac.Eq(s.x, sp.Symbol("k"))]))
    with pytest.raises(ac.DeclarationError, match="'gamma' cannot be computed"):
        ac.compile(Equations("x", lambda s: [ac.Eq(ac.der(s.x), sp.gamma(s.x))]))
    with pytest.raises(ac.DeclarationError, match="must be real and finite"):
        ac.compile(Equations("x", lambda s: [ac.Eq(s.x, sp.I)]))


def test_a_composite_may_state_equations_over_its_parts():
    class Pair(ac.Component):
        total = ac.Variable()

        def __init__(self):
            super().__init__()
            self.masses = [Mass(m=1.0), Mass(m=2.0)]

        def equations(self):
            yield ac.Eq(self.total, sum(m.m * ac.der(m.s) for m in self.masses))

    system = ac.compile(model(a=Pair(), b=Pair()))
    x = jnp.arange(8.0)
    assert system.states[1] == "a.masses[1].v"
    momentum = system.observe("b.total", 0.0, x, None, system.parameters())
    assert float(momentum) == x[5] + 2 * x[7]


@pytest.mark.parametrize(
    "equation",
    [
        lambda s: ac.Eq(ac.der(s.x * s.y), 1),
        lambda s: ac.Eq(ac.der(ac.der(s.y)), -s.x - ac.der(s.y)),
        lambda s: ac.Eq(ac.der(ac.sin(ac.time) * s.y**2), ac.time * s.x),
        lambda s: ac.Eq(ac.der(ac.where(s.y > 0.5, s.y**2, s.y - 0.25)), s.x),
        lambda s: ac.Eq(ac.der(s.k * s.y + s.k + 3), s.x),
    ],
)
def test_der_of_expressions(equation):
    assert (
        worst(ac.compile(Equations("x y", lambda s: [ac.Eq(ac.der(s.x), 1), equation(s)], k=2.0)))
        < 1e-12
    )


# -- connections ------------------------------------------------------------------------------------------


def test_a_node_is_the_same_however_it_was_joined():
    parts = lambda: {"a": Mass(m=1.0), "b": Mass(m=1.0), "c": Mass(m=1.0)}  # noqa: E731
    star = model("a.flange_a - b.flange_a", "a.flange_a - c.flange_a", **parts())
    chain = model("c.flange_a - b.flange_a", "b.flange_a - a.flange_a", **parts())
    again = model("a.flange_a - b.flange_a - c.flange_a", "c.flange_a - a.flange_a", **parts())
    expected = [{"a.flange_a.s", "b.flange_a.s", "c.flange_a.s"}]
    assert nodes(star) == nodes(chain) == nodes(again) == expected


def test_a_composites_connector_has_two_sides():
    class Box(TwoFlanges):
        def __init__(self):
            super().__init__()
            self.a, self.b = SpringDamper(c=1.0, d=1.0), SpringDamper(c=2.0, d=1.0)
            self.connect(self.flange_a, self.a.flange_a, self.b.flange_a)
            self.connect(self.a.flange_b, self.b.flange_b, self.flange_b)

    whole = model("m.flange_a - box.flange_a", m=Mass(m=1.0), box=Box())
    assert nodes(whole) == [
        {"m.flange_a.s", "box.flange_a.s"},
        {"box.flange_a.s|", "box.a.flange_a.s", "box.b.flange_a.s"},
        {"box.flange_b.s|", "box.a.flange_b.s", "box.b.flange_b.s"},
    ]
    flat = flatten(whole)
    assert flat.n_equations == flat.n_variables


def test_connections_may_cross_levels():
    class Box(ac.Component):
        def __init__(self):
            super().__init__()
            self.spring = SpringDamper(c=4.0, d=1.0)

    whole = model(
        "m.flange_a - box.spring.flange_a",
        "box.spring.flange_b - x.flange",
        m=Mass(m=2.0),
        box=Box(),
        x=Fixed(),
    )
    system = ac.compile(whole)
    assert system.vector_field(0.0, jnp.array([1.0, 0.0]), None, system.parameters())[1] == -2.0
    assert worst(system) < 1e-12


def test_an_unconnected_flow_is_zero_an_unconnected_inner_side_too():
    class Shell(ac.Component):
        flange = Flange()

        def equations(self):
            yield ac.Eq(self.flange.s, 0)

    system = ac.compile(model(shell=Shell()))
    assert system.observe("shell.flange.f", 0.0, jnp.zeros(0), None, {}) == 0.0


def test_flows_of_a_big_node_sum_to_zero():
    whole = Model()
    whole.mass, whole.ground = Mass(m=1.0), Fixed()
    whole.springs = [SpringDamper(c=float(i), d=1.0) for i in range(1, 41)]
    for spring in whole.springs:
        whole.connect(whole.mass.flange_b, spring.flange_a)
        whole.connect(spring.flange_b, whole.ground.flange)
    system = ac.compile(whole)
    rates = system.vector_field(0.0, jnp.array([1.0, 0.0]), None, system.parameters())
    assert float(rates[1]) == pytest.approx(-sum(range(1, 41)))
    force = system.observe("ground.flange.f", 0.0, jnp.array([1.0, 0.0]), None, system.parameters())
    assert float(force) == pytest.approx(sum(range(1, 41)))


def test_two_potentials_and_two_flows():
    class Frame(ac.Connector):
        r = ac.Potential(shape=2)
        phi = ac.Potential()
        f = ac.Flow(shape=2)
        tau = ac.Flow()

    class Body(ac.Component):
        frame = Frame()

        def equations(self):
            for r, f in zip(self.frame.r, self.frame.f, strict=True):
                yield ac.Eq(ac.der(ac.der(r)), f)
            yield ac.Eq(2 * ac.der(ac.der(self.frame.phi)), self.frame.tau)

    class Bush(ac.Component):
        a, b = Frame(), Frame()

        def equations(self):
            for i in range(2):
                yield ac.Eq(self.a.f[i], 3 * (self.a.r[i] - self.b.r[i]))
                yield ac.Eq(self.a.f[i] + self.b.f[i], 0)
            yield ac.Eq(self.a.tau, self.a.phi - self.b.phi + self.a.r[0])
            yield ac.Eq(self.a.tau + self.b.tau, 0)

    system = ac.compile(model("p.frame - s.a", "s.b - q.frame", p=Body(), s=Bush(), q=Body()))
    assert len(system.states) == 12
    assert worst(system) < 1e-12


# -- signals ------------------------------------------------------------------------------------------------


class Gain(ac.Component):
    u = ac.Input()
    y = ac.Output()
    k = ac.Parameter(2.0)

    def equations(self):
        yield ac.Eq(self.y, self.k * self.u)


class TwoGains(ac.Component):
    """Two gains behind each other, as a block."""

    u = ac.Input()
    y = ac.Output()

    def __init__(self):
        super().__init__()
        self.first, self.second = Gain(), Gain(k=3.0)
        self.connect(self.u, self.first.u)
        self.connect(self.first.y, self.second.u)
        self.connect(self.second.y, self.y)


def test_signals_pass_levels_and_what_nothing_feeds_is_an_input_of_the_model():
    system = ac.compile(model("a.y - b.u", a=TwoGains(), b=TwoGains()))
    assert system.inputs == ("a.u",)
    assert float(system.observe("b.y", 0.0, jnp.zeros(0), [1.0], system.parameters())) == 36.0


def test_a_models_own_inputs_and_outputs():
    system = ac.compile(TwoGains())
    assert system.inputs == ("u",)
    assert float(system.observe("y", 0.0, jnp.zeros(0), [1.0], system.parameters())) == 6.0


def test_sinks_joined_without_a_source_share_one_input():
    system = ac.compile(model("a.u - b.u", a=Gain(), b=Gain()))
    assert system.inputs == ("a.u",)
    assert float(system.observe("b.y", 0.0, jnp.zeros(0), [1.0], system.parameters())) == 2.0


def test_one_source_may_feed_many():
    system = ac.compile(model("s.y - a.u - b.u", s=Gain(), a=Gain(), b=Gain()))
    assert system.inputs == ("s.u",)


def test_two_sources_of_one_signal_are_refused():
    with pytest.raises(ac.ConnectionError, match=re.escape("'a.y' and 'b.y' feed one signal")):
        ac.compile(model("a.y - c.u", "b.y - c.u", a=Gain(), b=Gain(), c=Gain()))


# -- options and modules --------------------------------------------------------------------------------------


def test_when_decides_about_every_kind_of_declaration():
    class Support(ac.Component):
        useSupport = ac.Option(False)
        flange = Flange()
        support = Flange(when="useSupport")
        s_fixed = ac.Parameter(1.5, when="not useSupport")
        f = ac.Variable(when="useSupport")

        def equations(self):
            if self.useSupport:
                yield ac.Eq(self.flange.s, self.support.s)
                yield ac.Eq(self.f, self.flange.f)
                yield ac.Eq(self.support.f, -self.flange.f)
            else:
                yield ac.Eq(self.flange.s, self.s_fixed)

    system = ac.compile(model("a.flange - b.support", a=Support(), b=Support(useSupport=True)))
    assert set(system.parameters()) == {"a.s_fixed"}
    assert "b.f" in system.variables
    assert float(system.observe("b.flange.s", 0.0, jnp.zeros(0), None, system.parameters())) == 1.5


class Scale(eqx.Module):
    k: float

    def __call__(self, x):
        return self.k * x


class Called(ac.Component):
    net = ac.Module()
    x = ac.Variable()

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.net(self.x))


def test_a_module_may_be_shared_by_several_components():
    class Shared(ac.Component):
        net = ac.Module()

        def __init__(self, **modifiers):
            super().__init__(**modifiers)
            self.a, self.b, self.c = (
                Called(net=self.net),
                Called(net=self.net),
                Called(net=Scale(5.0)),
            )

    system = ac.compile(Shared(net=Scale(2.0)))
    params = system.parameters()
    assert set(params) == {"net", "c.net"}
    rates = system.vector_field(0.0, jnp.array([1.0, 2.0, 3.0]), None, params)
    assert rates.tolist() == [2.0, 4.0, 15.0]


def test_a_module_is_needed():
    with pytest.raises(ac.DeclarationError, match="Called 'a' has no module 'net'; give net="):
        ac.compile(model(a=Called()))


def test_the_default_module_may_be_a_method():
    class Own(Called):
        net = ac.Module("make")
        gain = ac.Option(3.0)

        def make(self, key):
            return Scale(self.gain)

    system = ac.compile(model(a=Own(), b=Own(gain=4.0)))
    rates = system.vector_field(0.0, jnp.ones(2), None, system.parameters())
    assert rates.tolist() == [3.0, 4.0]


def test_flattening_twice_gives_the_same():
    whole = model("f.flange - m.flange_a", f=Force(), m=Mass(m=1.0), r=Resistor(R=1.0), g=Ground())
    first, second = flatten(whole), flatten(whole)
    assert [g.template for g in first.groups] == [g.template for g in second.groups]
    for a, b in zip(first.groups, second.groups, strict=True):
        np.testing.assert_array_equal(a.variables, b.variables)


def test_parameters_bound_to_a_parameter_are_that_parameter():
    class Box(ac.Component):
        c = ac.Parameter(3.0)

        def __init__(self):
            super().__init__()
            self.a = SpringDamper(c=self.c, d=1.0)
            self.b = SpringDamper(c=self.a.c, d=self.c * 1)

    flat = flatten(Box())
    target = flat.parameter_aliases
    names = [flat.layout.parameter(i) for i in range(len(target))]
    same = {names[i]: names[t] for i, t in enumerate(target) if t != i}
    assert same == {"a.c": "c", "b.c": "c", "b.d": "c"}


def test_parameters_are_found_by_name():
    flat = flatten(model(a=Mass(m=1.0), b=SpringDamper(c=2.0, d=3.0)))
    names = [flat.layout.parameter(i) for i in range(len(flat.value))]
    assert [flat.layout.find_parameter(n) for n in names] == list(range(len(names)))
    assert flat.layout.find_parameter("a.no_such") is None
    assert flat.layout.find_parameter("") is None


# -- numbers ----------------------------------------------------------------------------------------------


def law(number):
    """A class of its own, whose law differs from others in numbers alone."""

    def equations(self):
        yield ac.Eq(ac.der(self.x), -number * self.x + 0.5 * ac.tanh(number * self.x**2) + self.u)

    declared = {"x": ac.Variable(unit="m"), "u": ac.Parameter(default=1.0)}
    return type(
        f"Law{number:g}".replace(".", "_"), (ac.Component,), {**declared, "equations": equations}
    )


def laws(count):
    return model(
        **{f"a{i}": law(1.25 + 0.5 * i)(x=ac.Start(0.1, fixed=True)) for i in range(count)}
    )


def test_equations_that_differ_in_numbers_alone_are_one_from_so_many_on():
    few, many = flatten(laws(FEW_VARIANTS)), flatten(laws(FEW_VARIANTS + 2))
    assert len({g.template for g in few.groups}) == FEW_VARIANTS
    assert len(few.value) == few.n_parameters
    assert len({g.template for g in many.groups}) == 1
    assert sorted(many.value[many.n_parameters :]) == [
        0.5,
        *(1.25 + 0.5 * i for i in range(FEW_VARIANTS + 2)),
    ]
    assert [str(g.origins[0]) for g in many.groups[:1]] == [
        "Law1_25: der(x) = u - 1.25*x + 0.5*tanh(1.25*x**2)"
    ]


def test_what_has_constants_runs_and_is_written_as_what_has_numbers():
    few, many = (ac.compile(laws(n)) for n in (FEW_VARIANTS, FEW_VARIANTS + 2))
    assert len(many.program.instructions) == 1 < len(few.program.instructions)
    assert many.equations[:FEW_VARIANTS] == few.equations
    assert dict(many.parameters()).keys() == {f"a{i}.u" for i in range(FEW_VARIANTS + 2)}
    x = jnp.linspace(0.1, 0.9, FEW_VARIANTS)
    rates = few.vector_field(0.0, x, None, few.pack())
    found = many.vector_field(
        0.0, jnp.append(x, x[:2]), None, many.pack({**many.parameters(), "a1.u": 1.0})
    )
    np.testing.assert_allclose(found[:FEW_VARIANTS], rates, rtol=1e-15)


def test_units_of_equations_with_constants_are_checked_with_their_numbers():
    def wrong(number):
        def equations(self):
            yield ac.Eq(ac.der(self.x), number * self.x * self.y)

        declared = {"x": ac.Variable(unit="m"), "y": ac.Variable(unit="m")}
        return type("Wrong", (ac.Component,), {**declared, "equations": equations})

    parts = {f"a{i}": wrong(1.5 + i)() for i in range(FEW_VARIANTS + 2)}
    with pytest.raises(ac.UnitError, match=r"Wrong 'a0'.*1\.5\*x\*y"):
        check_dimensions(flatten(model(**parts)))


class Rows(ac.Component):
    """A dense system of equations, whose numbers have signs and sizes of their own; the first unknown's are whole."""

    N = FEW_VARIANTS + 2
    A = np.random.default_rng(0).normal(size=(N, N)) + 3 * np.eye(N)
    A[:, 0] = np.arange(N) % 3 + 2.0
    x = ac.Variable(start=0.5, fixed=True)
    z = ac.Variable(shape=(N,))

    def equations(self):
        yield ac.Eq(ac.der(self.x), -self.x)
        for i, row in enumerate(self.A):
            given = [int(row[0]), *row[1:].tolist()]
            terms = sum(a * z for a, z in zip(given, self.z, strict=True))
            yield ac.Eq(terms - self.x, i - 14.0)


@pytest.mark.slow
def test_rows_of_a_matrix_are_one_equation_whatever_their_signs():
    system = ac.compile(Rows())
    assert len({g.template for g in system.flat.groups}) == 2
    run = ac.simulate(system, (0.0, 0.1), dt=0.1)
    given = np.arange(Rows.N) - 14.0 + 0.5
    found = [float(run[f"z[{i + 1}]"][0]) for i in range(Rows.N)]
    np.testing.assert_allclose(found, np.linalg.solve(Rows.A, given), rtol=1e-12)


def test_whole_numbers_stay_exact_and_apart_from_others():
    system = ac.compile(
        model(
            a=Equations("x y", lambda s: [ac.Eq(ac.der(s.x), -s.x), ac.Eq(2 * s.y, 2 * s.x)]),
            b=Equations("x y", lambda s: [ac.Eq(ac.der(s.x), -s.x), ac.Eq(2.0 * s.y, 2.0 * s.x)]),
        )
    )
    kinds = [{type(n) for n in g.template.residual.atoms(sp.Number)} for g in system.flat.groups]
    assert [any(issubclass(k, sp.Float) for k in some) for some in kinds].count(True) == 1


def test_a_parameter_that_follows_by_cases_has_no_event():
    class Decay(ac.Component):
        k = ac.Parameter(2.0)
        least = ac.Parameter(lambda self: ac.where(self.k > 1, self.k, 1, events=None))
        x = ac.Variable()

        def equations(self):
            yield ac.Eq(ac.der(self.x), -self.least * self.x)

    decay = ac.compile(Decay())
    rates = [decay.vector_field(0.0, jnp.ones(1), None, {"k": k}).item() for k in (0.5, 3.0)]
    assert rates == [-1.0, -3.0]
