"""The contract of a compiled model, on the quarter vehicle of Kamp, Ultsch and Brembeck (2023)."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.components import neural, translational as tl
from tests.support.oracle import worst
from tests.support.parts import Diode, Equations, Ground, Model, Resistor, SignalVoltage, model


class QuarterVehicle(ac.Component):
    """Quarter vehicle, with a neural suspension or without."""

    def __init__(self, *, learn, m_b=350.0, m_w=90.0):
        super().__init__()
        self.body = tl.Mass(m=m_b)
        self.suspension = tl.SpringDamper(c=10e3, d=800.0)
        elements = [self.suspension]
        if learn:
            self.spring_nn = neural.Compliance()
            self.damper_nn = neural.Resistance()
            elements += [self.spring_nn, self.damper_nn]
        self.wheel = tl.Mass(m=m_w)
        self.tyre = tl.SpringDamper(c=300e3, d=100.0)
        self.road = tl.Speed(exact=True)
        for element in elements:
            self.connect(self.body.flange_b, element.flange_a)
            self.connect(element.flange_b, self.wheel.flange_a)
        self.connect(self.wheel.flange_b, self.tyre.flange_a)
        self.connect(self.tyre.flange_b, self.road.flange)


@pytest.fixture(scope="module")
def linear():
    return ac.compile(QuarterVehicle(learn=False))


@pytest.fixture(scope="module")
def learning():
    return ac.compile(QuarterVehicle(learn=True))


STATES = ("body.s", "body.v", "wheel.s", "wheel.v", "road.s")
X = jnp.array([0.02, -0.3, 0.01, 0.4, -0.005])
U = jnp.array([0.7])


# -- names ------------------------------------------------------------------------------------------------------


def test_the_five_states_of_the_paper_in_order(linear, learning):
    assert linear.states == learning.states == STATES
    assert linear.inputs == learning.inputs == ("road.v_ref",)


def test_variables_bear_dotted_names(learning):
    assert {"suspension.s_rel", "spring_nn.f", "road.flange.f", "body.a"} <= set(learning.variables)


def test_parameters_are_a_flat_dict(learning):
    params = learning.parameters(jax.random.key(3))
    assert params["body.m"] == 350.0
    assert [n for n in params if n.endswith("net")] == ["spring_nn.net", "damper_nn.net"]
    leaves = jax.tree.leaves(params["spring_nn.net"])
    assert sum(np.size(leaf) for leaf in leaves) == 321


def test_units(linear):
    assert linear.unit("body.a") == "m/s2"
    assert linear.unit("tyre.c") == "N/m"
    assert linear.unit("der(body.s)") == "m/s"


def test_the_repr_is_a_short_table(learning):
    lines = repr(learning).splitlines()
    assert lines[0].startswith("System of QuarterVehicle (")
    assert "5 states" in lines[0]
    assert "body.s, body.v, wheel.s, wheel.v, road.s" in lines[1]
    assert len(lines) == 5
    assert (
        r"\frac{d}{d \mathtt{\text{time}}}" in learning._repr_latex_()
        or "aligned" in learning._repr_latex_()
    )


# -- equations --------------------------------------------------------------------------------------------------


def paper(learn):
    """Right-hand sides (12)-(16), with networks (19)-(20), in the names of the model."""
    z_b, v_b, z_w, v_w, z_r = (sp.Symbol(name) for name in STATES)
    m_b, m_w = sp.Symbol("body.m"), sp.Symbol("wheel.m")
    c_s, d_s = sp.Symbol("suspension.c"), sp.Symbol("suspension.d")
    c_t, d_t = sp.Symbol("tyre.c"), sp.Symbol("tyre.d")
    v_r = sp.Symbol("road.v_ref")
    z_s, v_s, z_t, v_t = z_w - z_b, v_w - v_b, z_r - z_w, v_r - v_w
    force = c_s * z_s + d_s * v_s
    if learn:
        force += sp.Function("spring_nn.net")(z_s) + sp.Function("damper_nn.net")(v_s)
    return [v_b, force / m_b, v_w, (c_t * z_t + d_t * v_t - force) / m_w, v_r]


@pytest.mark.parametrize("learn", [False, True])
def test_the_equations_are_those_of_the_paper(learn, linear, learning):
    equations = (learning if learn else linear).equations
    assert len(equations) == 5
    for name, equation, expected in zip(STATES, equations, paper(learn), strict=True):
        assert equation.lhs == sp.Derivative(sp.Symbol(name), sp.Symbol("time"))
        assert sp.simplify(equation.rhs - expected) == 0


def test_the_numbers_are_those_of_the_equations(linear):
    values = dict(zip(STATES, X.tolist(), strict=True)) | linear.parameters() | {"road.v_ref": 0.7}
    expected = [
        float(e.rhs.subs({sp.Symbol(n): v for n, v in values.items()})) for e in linear.equations
    ]
    rates = linear.vector_field(0.0, X, U, linear.parameters())
    np.testing.assert_allclose(rates, expected, rtol=1e-12)


def test_the_flat_equations_hold(linear, learning):
    assert worst(linear) < 1e-7
    assert worst(learning) < 1e-7


# -- values -----------------------------------------------------------------------------------------------------


def test_vector_field_and_observe_agree(learning):
    params = learning.parameters(0)
    rates = learning.vector_field(0.0, X, U, params)
    names = ["body.v", "body.a", "wheel.v", "wheel.a", "road.v"]
    np.testing.assert_allclose(learning.observe(names, 0.0, X, U, params), rates, rtol=1e-12)
    ders = [f"der({name})" for name in STATES]
    np.testing.assert_allclose(learning.observe(ders, 0.0, X, U, params), rates, rtol=1e-12)
    dx, y = learning.vector_field_and_observe(names, 0.0, X, U, params)
    np.testing.assert_allclose(dx, rates, rtol=1e-12)
    np.testing.assert_allclose(y, rates, rtol=1e-12)
    assert learning.observe("body.a", 0.0, X, U, params).shape == ()


def test_the_signs_are_those_of_the_paper(linear):
    z_s, v_s = linear.observe(["suspension.s_rel", "suspension.v_rel"], 0.0, X, U, {})
    assert float(z_s) == pytest.approx(X[2] - X[0])
    assert float(v_s) == pytest.approx(X[3] - X[1])


def test_gradients_reach_the_networks(learning):
    params = learning.parameters(0)
    nets = {k: v for k, v in params.items() if k.endswith("net")}

    @jax.jit
    @jax.grad
    def derivative(nets):
        return learning.observe("body.a", 0.0, X, U, {**params, **nets})

    grad = derivative(nets)
    # the last bias of either network shifts the force, which moves 350 kg
    for name in nets:
        assert float(jnp.ravel(grad[name].biases[-1])[0]) == pytest.approx(1 / 350)


def test_everything_can_be_jitted_and_vmapped(learning):
    packed = learning.pack(learning.parameters(0))
    f = jax.jit(jax.vmap(learning.vector_field, in_axes=(None, 0, 0, None)))
    many = f(0.0, jnp.stack([X, 2 * X]), jnp.stack([U, U]), packed)
    np.testing.assert_allclose(many[1], learning.vector_field(0.0, 2 * X, U, packed), rtol=1e-12)


def test_initial_states_by_name(linear):
    assert linear.initial_state(x0={"wheel.v": 2.0}).tolist() == [0.0, 0.0, 0.0, 2.0, 0.0]


# -- what is refused --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ask", "error", "told"),
    [
        (lambda s: s.observe("body.b", 0.0, X, U, {}), ac.ModelError, "no variable 'body.b'; did you mean"),
        (lambda s: s.observe("der(tyre.f)", 0.0, X, U, {}), ac.ModelError, r"does not differentiate 'tyre\.f'"),
        (lambda s: s.vector_field(0.0, X[:3], U, {}), ac.DataError, r"x has shape \(3,\); the model has 5 states"),
        (lambda s: s.vector_field(0.0, X, None, {}), ac.DataError, r"u has shape \(0,\).*road\.v_ref"),
        (lambda s: s.vector_field(0.0, None, U, {}), ac.DataError, "^x=None are not real numbers"),
        (lambda s: s.vector_field(0.0, X * 1j, U, {}), ac.DataError, r"^x=Array\(.* are not real numbers"),
        (lambda s: s.vector_field(0.0, X, "u", {}), ac.DataError, "^u='u' are not real numbers"),
        (lambda s: s.vector_field("now", X, U, {}), ac.DataError, "^t='now' is not a time; give seconds"),
        (lambda s: s.vector_field_and_observe(3, 0.0, X, U, {}), ac.DataError, "^3 is not a name"),
        (lambda s: s.unit(3), ac.DataError, "^3 is not a name"),
        (lambda s: s.parameters("seed"), ac.DataError, "^key='seed' is not a key; give a whole number"),
        (lambda s: s.parameters(1.5), ac.DataError, "^key=1.5 is not a key"),
        (lambda s: s.parameters(10**40), ac.DataError, "^key=1000000.* is not a key"),
        (lambda s: s.pack({3: 1.0}), ac.DataError, "^params: 3 is not a name"),
        (lambda s: ac.compile(s.model, budget=3), ac.ModelError, "^budget=3 is not a budget"),
        (lambda s: s.unit("body.b"), ac.ModelError, r"no 'body\.b'; did you mean"),
        (lambda s: s.pack({"body.mass": 1.0}), ac.DataError, r"no parameter 'body\.mass'"),
    ],
)  # fmt: skip
def test_wrong_questions(linear, ask, error, told):
    with pytest.raises(error, match=told):
        ask(linear)


def test_seeds_and_keys_of_all_kinds(learning):
    keys = (3, np.int64(3), jax.random.key(3), jax.random.PRNGKey(3))
    one, *others = (learning.parameters(key)["spring_nn.net"] for key in keys)
    for other in others:
        jax.tree.map(np.testing.assert_array_equal, one, other)


def test_only_components_are_compiled():
    with pytest.raises(ac.ModelError, match=r"not a class: ac\.compile\(QuarterVehicle\(\)\)"):
        ac.compile(QuarterVehicle)
    with pytest.raises(ac.ModelError, match="compile needs a Component, got dict"):
        ac.compile({})


def test_elements_are_counted_from_one():
    made = Model()
    made.m = [tl.Mass(m=1.0)]
    with pytest.raises(ac.ModelError, match=r"counted from 1, as in Modelica: 'm\[1\]\.s'"):
        ac.compile(made).observe("m[0].s", 0.0, jnp.zeros(2), None, {})


def test_a_model_can_be_compiled_twice():
    made = QuarterVehicle(learn=False)
    first, second = ac.compile(made), ac.compile(made)
    assert first.equations == second.equations


def test_compiling_does_not_depend_on_what_was_compiled_before():
    alone = ac.compile(QuarterVehicle(learn=False)).equations
    ac.compile(model(a=tl.Mass(m=1.0, L=2.0), b=tl.SpringDamper(c=1.0, d=1.0), c=tl.Fixed()).a)
    assert ac.compile(QuarterVehicle(learn=False)).equations == alone


# -- equations of other models ----------------------------------------------------------------------------------


def test_linear_loops_are_solved_in_the_equations():
    made = model(
        "v.p - r.p", "r.n - q.p - l.p", "q.n - l.n - v.n - g.p",
        v=SignalVoltage(), r=Resistor(R=1.0), q=Resistor(R=3.0), l=Inductive(), g=Ground(),
    )  # fmt: skip
    system = ac.compile(made)
    i, v, r, q, inductance = sp.symbols("l.i v.v r.R q.R l.L")
    expected = q * (v - r * i) / (r + q) / inductance
    assert sp.simplify(system.equations[0].rhs - expected) == 0
    assert len(system.equations) == 1


def test_nonlinear_loops_keep_their_names_and_their_equations_follow():
    made = model(
        "v.p - r.p", "r.n - d.p - l.p", "d.n - l.n - v.n - g.p",
        v=SignalVoltage(), r=Resistor(R=1.0), d=Diode(), l=Inductive(), g=Ground(),
    )  # fmt: skip
    system = ac.compile(made)
    first, *implicit = system.equations
    assert implicit
    unknowns = set().union(*(e.free_symbols for e in implicit))
    assert first.rhs.free_symbols <= {sp.Symbol("l.L"), *unknowns}
    # they hold for the values that the system computes
    x, u, params = jnp.array([0.2]), jnp.array([1.5]), system.parameters()
    values = {s: params.get(str(s)) for s in unknowns}
    names = [str(s) for s, v in values.items() if v is None]
    observed = system.observe(names, 0.0, x, u, params)
    values |= {sp.Symbol(n): float(v) for n, v in zip(names, observed, strict=True)}
    assert all(abs(float((e.lhs - e.rhs).subs(values))) < 1e-9 for e in implicit)


def test_a_loop_of_cases_is_shown_as_it_is():
    class Stopped(ac.Component):
        def __init__(self):
            super().__init__()
            self.mass, self.brake = tl.Mass(m=1.0), tl.Brake(fn_max=1.0)
            self.connect(self.mass.flange_b, self.brake.flange_a)

    _, move, *implicit = ac.compile(Stopped()).equations
    assert move.rhs == sp.Symbol("mass.a")
    assert any({str(s) for s in e.free_symbols} >= {"mass.a", "mass.m"} for e in implicit)


def test_time_and_shared_networks_in_the_equations():
    class Forced(Equations):
        net = ac.Module(lambda key: jnp.tanh)

    class Shared(ac.Component):
        net = ac.Module(lambda key: jnp.tanh)

        def __init__(self):
            super().__init__()
            self.part = Forced("x", lambda s: [ac.Eq(ac.der(s.x), s.net(s.x) + ac.sin(ac.time))])
            self.part.modify(net=self.net)

    x, time = sp.symbols("part.x time")
    assert ac.compile(Shared()).equations[0].rhs == sp.Function("net")(x) + sp.sin(time)


class Inductive(ac.Component):
    """An inductor with a current as state."""

    from tests.support.parts import Pin

    p, n = Pin(), Pin()
    L = ac.Parameter(2.0)
    i = ac.Variable()

    def equations(self):
        yield ac.Eq(self.p.v - self.n.v, self.L * ac.der(self.i))
        yield ac.Eq(self.p.i, self.i)
        yield ac.Eq(self.n.i, -self.i)


def test_double_precision_that_was_switched_off_is_noticed(linear):
    x, params, model = np.zeros(5), linear.parameters(), QuarterVehicle(learn=False)
    record = ac.Data(np.arange(3.0), {"road.v_ref": np.ones(3), "body.a": np.arange(3.0)})
    calls = [
        lambda: ac.compile(model),
        lambda: ac.simulate(linear, (0, 1), dt=0.1, inputs={"road.v_ref": 1.0}),
        lambda: ac.fit(linear, record, "body.a", modifiers=["body.m"]),
        lambda: linear.vector_field(0.0, x, np.zeros(1), params),
        lambda: ac.linearize(linear, x),
        linear.initialize,
    ]
    jax.config.update("jax_enable_x64", False)
    try:
        for call in calls:
            with pytest.raises(ac.AcausalError, match=r"switched off.*'jax_enable_x64', True"):
                call()
    finally:
        jax.config.update("jax_enable_x64", True)
