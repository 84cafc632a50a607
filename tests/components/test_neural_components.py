"""Neural two-ports: names and signs by domain, networks of all kinds, inside a model's equations."""

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, neural, translational as tl
from acausal.components.thermal import HeatPort
from acausal.flattening.flat_model import flatten


class Pin(ac.Connector):
    """An electrical pin, as a user may declare one."""

    v = ac.Potential(unit="V")
    i = ac.Flow(unit="A")

    pair = ("p", "n")
    across = "v"
    through = "i"


class Node(ac.Component):
    """A capacity at a port of any such domain: ``c der(potential) = flow + u``."""

    c = ac.Parameter(2.0)
    u = ac.Input()

    def __init__(self, connector):
        super().__init__()
        self.port = connector()
        self.kind = connector.__name__

    def equations(self):
        kind = type(self.port)
        potential, flow = getattr(self.port, kind.potential()), getattr(self.port, kind.flow())
        yield ac.Eq(self.c * ac.der(potential), flow + self.u)


class Ground(ac.Component):
    """Potential zero at a port of any domain."""

    def __init__(self, connector):
        super().__init__()
        self.port = connector()
        self.kind = connector.__name__

    def equations(self):
        yield ac.Eq(getattr(self.port, type(self.port).potential()), 0)


class Circuit(ac.Component):
    """A capacity connected to the ground by a neural element."""

    def __init__(self, connector, element):
        super().__init__()
        self.node, self.ground, self.element = Node(connector), Ground(connector), element
        first, second = (getattr(element, name) for name in connector.pair)
        self.connect(self.node.port, first)
        self.connect(second, self.ground.port)


class QuarterVehicle(ac.Component):
    """Quarter vehicle with a neural suspension."""

    def __init__(self, spring, damper):
        super().__init__()
        self.body = tl.Mass(m=350)
        self.suspension = tl.SpringDamper(c=10e3, d=800)
        self.spring_nn, self.damper_nn = spring, damper
        self.wheel = tl.Mass(m=90)
        self.tyre = tl.SpringDamper(c=300e3, d=100)
        self.road = tl.Speed(exact=True)
        for element in (self.suspension, self.spring_nn, self.damper_nn):
            self.connect(self.body.flange_b, element.flange_a)
            self.connect(element.flange_b, self.wheel.flange_a)
        self.connect(self.wheel.flange_b, self.tyre.flange_a)
        self.connect(self.tyre.flange_b, self.road.flange)


class Cubic(eqx.Module):
    """A user's own law."""

    a: jax.Array

    def __call__(self, x):
        return self.a * x**3


class Outside(eqx.Module):
    """An equinox network that expects a vector."""

    mlp: eqx.nn.MLP

    def __call__(self, x):
        return self.mlp(jnp.stack([x]))[0]


def stated(component):
    """The component's own equations as text."""
    return [str(e) for e in component.equations()]


# -- declarations ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("element", "equations"),
    [
        (
            neural.Compliance(),
            ["flange_b.f = f", "flange_a.f = -f", "f = net(s_rel)"],
        ),
        (
            neural.Resistance(),
            ["flange_b.f = f", "flange_a.f = -f", "v_rel = der(s_rel)", "f = net(v_rel)"],
        ),
        (
            neural.Compliance(HeatPort),
            [
                "port_a.Q_flow = Q_flow",
                "port_b.Q_flow = -Q_flow",
                "q = net(dT)",
                "Q_flow = der(net(dT))",
            ],
        ),
        (
            neural.Resistance(HeatPort),
            ["port_a.Q_flow = Q_flow", "port_b.Q_flow = -Q_flow", "Q_flow = net(dT)"],
        ),
        (neural.Compliance(Pin), ["p.i = i", "n.i = -i", "q = net(v)", "i = der(net(v))"]),
        (neural.Resistance(Pin), ["p.i = i", "n.i = -i", "i = net(v)"]),
        (
            neural.Resistance(secondary=("T", "p")),
            ["flange_b.f = f", "flange_a.f = -f", "v_rel = der(s_rel)", "f = net(v_rel, T, p)"],
        ),
        (
            neural.Compliance(secondary=2),
            ["flange_b.f = f", "flange_a.f = -f", "f = net(s_rel, u1, u2)"],
        ),
    ],
)
def test_names_and_signs_are_the_domains(element, equations):
    difference, *others = stated(element)
    assert others == equations
    model = flatten(element)
    assert model.n_equations == model.n_variables - len(model.inputs)
    across = element.connector.across
    assert difference.startswith(f"{across} = ")


@pytest.mark.parametrize(
    ("connector", "difference"),
    [
        (tl.Flange, lambda e: e.flange_b.s - e.flange_a.s),
        (HeatPort, lambda e: e.port_a.T - e.port_b.T),
        (Pin, lambda e: e.p.v - e.n.v),
    ],
)
def test_the_difference_has_the_sign_of_the_domain(connector, difference):
    element = neural.Resistance(connector)
    assert next(iter(element.equations())).rhs == difference(element)


def test_units_come_from_the_connector():
    declared: Any = neural.Resistance()._node.own_declarations
    assert [declared[n].unit for n in ("s_rel", "v_rel", "f")] == ["m", "m/s", "N"]
    declared = neural.Resistance(HeatPort)._node.own_declarations
    assert [declared[n].unit for n in ("dT", "Q_flow")] == ["K", "W"]


def test_elements_of_one_kind_share_their_equations():
    """Those of one domain with the same options and inputs; whatever their networks are."""

    class Several(ac.Component):
        def __init__(self):
            super().__init__()
            self.springs = [neural.Compliance(net=Cubic(jnp.asarray(float(i)))) for i in range(3)]
            self.others = [neural.Compliance(HeatPort), neural.Compliance(secondary=("T",))]

    form_of = flatten(Several()).layout.form_of.tolist()
    assert form_of[1] == form_of[2] == form_of[3]
    assert len({form_of[1], form_of[4], form_of[5]}) == 3
    assert repr(neural.Resistance(Pin)).startswith("Resistance\n")


def test_unknown_names_are_refused():
    with pytest.raises(
        ac.DeclarationError, match="Compliance has no 'widht': did you mean 'width'"
    ):
        neural.Compliance(widht=3)


# -- inside a model ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def vehicle():
    spring = neural.Compliance(input_scale=0.01, output_scale=100.0)
    return ac.compile(
        QuarterVehicle(spring, neural.Resistance(width=8, depth=1, activation="tanh"))
    )


def test_networks_are_parameters_by_name(vehicle):
    params = vehicle.parameters(jax.random.key(0))
    spring, damper = params["spring_nn.net"], params["damper_nn.net"]
    assert isinstance(spring, ac.MLP)
    assert (spring.input_scale, spring.output_scale) == (0.01, 100.0)
    assert sum(leaf.size for leaf in jax.tree.leaves(spring)) == 321
    assert (damper.activation, [len(b) for b in damper.biases]) == ("tanh", [8, 1])
    other = vehicle.parameters(jax.random.key(1))["spring_nn.net"]
    assert not np.allclose(spring.weights[0], other.weights[0])


def test_the_quarter_vehicle_is_the_papers(vehicle):
    params = vehicle.parameters(0)
    names = ("body.s", "body.v", "wheel.s", "wheel.v", "road.s")
    assert vehicle.states == names
    z_b, v_b, z_w, v_w, z_r = x = jnp.asarray([0.01, 0.2, -0.02, 0.1, 0.005])
    z_s, v_s, z_t, v_t = z_w - z_b, v_w - v_b, z_r - z_w, 0.3 - v_w
    force = 10e3 * z_s + 800 * v_s + params["spring_nn.net"](z_s) + params["damper_nn.net"](v_s)
    tyre = 300e3 * z_t + 100 * v_t
    expected = [v_b, force / 350, v_w, (tyre - force) / 90, 0.3]
    dx = jax.jit(lambda p: vehicle.vector_field(0.0, x, jnp.asarray([0.3]), p))(params)
    assert np.allclose(dx, jnp.stack([jnp.asarray(e) for e in expected]))
    derivative = jax.grad(lambda p: vehicle.vector_field(0.0, x, jnp.asarray([0.3]), p)[1])
    gradient = eqx.filter(jax.jit(derivative)(params), eqx.is_array)["spring_nn.net"]
    direct = jax.jit(jax.grad(lambda net: net(z_s) / 350))(params["spring_nn.net"])
    for a, b in zip(jax.tree.leaves(gradient), jax.tree.leaves(direct), strict=True):
        assert np.allclose(a, b)


@pytest.mark.parametrize(
    ("net", "law"),
    [
        (Cubic(jnp.asarray(2.0)), lambda x: 2 * x**3),
        (lambda key: Cubic(jax.random.normal(key)), None),
        (lambda key: Outside(eqx.nn.MLP(1, 1, 4, 1, key=key)), None),
    ],
    ids=["module", "factory", "equinox"],
)
def test_a_network_of_the_users_own(net, law):
    damper = neural.Resistance(net=Cubic(jnp.asarray(5.0)))
    system = ac.compile(QuarterVehicle(neural.Compliance(net=net), damper))
    params = system.parameters(3)
    law = law or params["spring_nn.net"]
    x = jnp.asarray([0.1, 0.2, 0.5, 0.7, 0.0])
    force = system.observe(
        ["spring_nn.f", "damper_nn.f", "spring_nn.s_rel"], 0.0, x, jnp.zeros(1), params
    )
    assert np.allclose(force, [law(jnp.asarray(0.4)), 5 * 0.5**3, 0.4])


class Row(ac.Component):
    """Several neural springs from one mass to another, alike or not."""

    def __init__(self, *nets):
        super().__init__()
        self.left, self.right = tl.Mass(m=1), tl.Mass(m=1)
        self.springs = [neural.Compliance(**net) for net in nets]
        for spring in self.springs:
            self.connect(self.left.flange_b, spring.flange_a)
            self.connect(spring.flange_b, self.right.flange_a)


@pytest.mark.parametrize(
    "nets",
    [
        [{}, {}, {}],
        [{}, {"width": 4}, {"activation": "tanh"}],
        [{"net": lambda key: Outside(eqx.nn.MLP(1, 1, 4, 1, key=key))}] * 3,
    ],
    ids=["alike", "unlike", "equinox"],
)
def test_elements_side_by_side_use_their_own_networks(nets):
    system = ac.compile(Row(*nets))
    params = system.parameters(0)
    x = jnp.asarray(
        [0.1 if n == "left.s" else 0.3 if n == "right.s" else 0.0 for n in system.states]
    )
    names = [f"springs[{i}]" for i in (1, 2, 3)]
    forces = system.observe([f"{n}.f" for n in names], 0.0, x, None, params)
    expected = [params[f"{n}.net"](jnp.asarray(0.2)) for n in names]
    assert np.allclose(forces, expected)
    assert len(set(np.round(expected, 12).tolist())) == 3
    acceleration = system.observe("left.a", 0.0, x, None, params)
    assert np.allclose(acceleration, sum(expected))


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("connector", [HeatPort, Pin])
def test_flow_domains(connector):
    """``(c + net') der(v) = u`` with a neural capacity, ``c der(v) = u - net(v)`` with a resistance."""
    potential = connector.potential()
    x, u = jnp.asarray([0.3]), jnp.asarray([1.5])
    for element in (neural.Compliance, neural.Resistance):
        system = ac.compile(Circuit(connector, element(connector, activation="tanh", width=4)))
        assert len(system.states) == 1
        params = system.parameters(0)
        assert np.allclose(system.observe(f"node.port.{potential}", 0.0, x, u, params), 0.3)
        net = params["element.net"]
        (rate,) = system.vector_field(0.0, x, u, params)
        if element is neural.Compliance:
            expected = 1.5 / (2.0 + jax.grad(net)(0.3))
            stored = system.observe("element.q", 0.0, x, u, params)
            assert np.allclose(stored, net(0.3))
        else:
            expected = (1.5 - net(0.3)) / 2.0
        assert np.allclose(rate, expected)


def test_a_secondary_input_is_an_input_of_the_model():
    element = neural.Resistance(HeatPort, secondary=("T",), activation="tanh")
    system = ac.compile(Circuit(HeatPort, element))
    assert system.inputs == ("node.u", "element.T")
    params = system.parameters(0)
    flow = system.observe("element.Q_flow", 0.0, [0.3], [0.0, 2.0], params)
    assert np.allclose(flow, params["element.net"](0.3, 2.0))


def test_reversing_an_odd_element_changes_nothing():
    class Reversed(ac.Component):
        def __init__(self, swap):
            super().__init__()
            self.mass = tl.Mass(m=2)
            self.element = neural.Resistance(net=Cubic(jnp.asarray(3.0)))
            self.ground = tl.Fixed()
            ends = [self.element.flange_a, self.element.flange_b]
            first, second = reversed(ends) if swap else ends
            self.connect(self.mass.flange_b, first)
            self.connect(second, self.ground.flange)

    x = jnp.asarray([0.1, 0.5])
    fields = []
    for swap in (False, True):
        system = ac.compile(Reversed(swap))
        fields.append(system.vector_field(0.0, x, None, system.parameters()))
    assert np.allclose(fields[0], fields[1])
    assert np.allclose(fields[0], [0.5, -3 * 0.5**3 / 2])


def test_a_network_is_differentiated_by_index_reduction():
    """A mass at a position that a network gives: its speed is the network's derivative."""

    class Follower(ac.Component):
        def __init__(self):
            super().__init__()
            self.circuit = Circuit(HeatPort, neural.Resistance(HeatPort, net=Cubic(jnp.ones(()))))
            self.position = blocks.RealExpression()
            self.move = tl.Position(exact=True)
            self.mass = tl.Mass(m=2, stateSelect="avoid")
            self.connect(self.position.y, self.move.s_ref)
            self.connect(self.move.flange, self.mass.flange_a)

        def equations(self):
            yield ac.Eq(self.position.y, self.circuit.element.Q_flow)

    system = ac.compile(Follower())
    params = system.parameters()
    given = {"circuit.node.u": 1.0, "der(circuit.node.u)": 4.0}
    u = jnp.asarray([given[n] for n in system.inputs])
    names = ["mass.s", "mass.v", "mass.a", "move.flange.f"]
    s, v, a, f = system.observe(names, 0.0, [0.5], u, params)
    T, rate = 0.5, (1 - 0.5**3) / 2
    second = (4 - 3 * T**2 * rate) / 2
    assert np.allclose([s, v], [T**3, 3 * T**2 * rate])
    assert np.allclose(a, 6 * T * rate**2 + 3 * T**2 * second)
    assert np.allclose(f, -2 * a)
