"""Parameters at run time: the flat dict of the user and the few arrays of the program."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.codegen import Packed
from tests.support.oscillator import learned
from tests.support.parts import Capacitor, Equations, Ground, Mass, Model, Resistor, model


class Scale(eqx.Module):
    k: jax.Array

    def __call__(self, x):
        return self.k * x


class Called(ac.Component):
    net = ac.Module(lambda key: Scale(jax.random.normal(key)))
    gain = ac.Parameter(1.0)
    x = ac.Variable()

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.gain * self.net(self.x))


class Box(ac.Component):
    """Bound parameters over two levels, a shared module among own ones."""

    c = ac.Parameter(2.0)
    net = ac.Module(lambda key: Scale(jax.random.normal(key)))

    def __init__(self, **modifiers):
        super().__init__(**modifiers)
        self.parts = [Called(gain=self.c * i) for i in range(1, 4)]
        self.last = Called(gain=self.parts[2].gain ** 2, net=self.net)


def rates(system, params):
    return system.vector_field(0.0, jnp.ones(len(system.states)), None, params)


def test_defaults_are_the_models_values_by_dotted_name():
    system = ac.compile(model(a=Mass(m=1.5), b=Mass(m=2.5, L=0.1)))
    assert system.parameters() == {"a.m": 1.5, "b.m": 2.5, "b.L": 0.1}
    assert list(system.parameters()) == ["a.m", "b.m", "b.L"]


def test_modules_come_from_the_key():
    system = ac.compile(Box())
    first, again, other = system.parameters(), system.parameters(0), system.parameters(1)
    assert set(first) == {"c", "net", "parts[1].net", "parts[2].net", "parts[3].net"}
    assert first["net"].k == again["net"].k
    assert first["net"].k != other["net"].k
    assert first["net"].k != first["parts[1].net"].k
    assert system.parameters(jax.random.key(1))["net"].k == other["net"].k


def test_a_given_module_keeps_its_weights():
    given = Scale(jnp.array(4.0))
    system = ac.compile(Called(net=given))
    assert system.parameters(3)["net"] is given


def test_bound_parameters_are_computed_from_the_free_ones():
    system = ac.compile(Box())
    params = {**system.parameters(), "c": 10.0}
    k = [params[f"parts[{i}].net"].k for i in (1, 2, 3)]
    expected = [10 * k[0], 20 * k[1], 30 * k[2], 900 * params["net"].k]
    np.testing.assert_allclose(rates(system, params), expected)


def test_gradients_reach_free_parameters_and_weights():
    system = ac.compile(Box())
    params = jax.tree.map(jnp.asarray, system.parameters())
    grad = jax.jit(jax.grad(lambda p: jnp.sum(rates(system, p))))(params)
    k = [float(params[f"parts[{i}].net"].k) for i in (1, 2, 3)]
    c, k4 = 2.0, float(params["net"].k)
    assert float(grad["c"]) == pytest.approx(k[0] + 2 * k[1] + 3 * k[2] + 18 * c * k4)
    assert float(grad["net"].k) == pytest.approx(9 * c**2)
    assert float(grad["parts[2].net"].k) == pytest.approx(2 * c)


def test_numbers_of_any_kind_pack_alike():
    system = ac.compile(model(a=Mass(m=1.0), b=Mass(m=1.0)))
    kinds = [2, 2.0, np.float32(2.0), np.array(2.0), jnp.array(2.0)]
    for kind in kinds:
        packed = system.pack({"a.m": kind})
        assert sorted(packed.values.tolist()) == [1.0, 2.0]
        assert packed.values.dtype == jnp.float64


def test_missing_numbers_keep_the_models_values():
    system = ac.compile(model(a=Mass(m=1.5), b=Mass(m=2.5)))
    assert system.pack({}).values.tolist() == system.pack().values.tolist()


@pytest.mark.parametrize("traced", [(1,), (0, 2, 3), (4,), (0, 1, 2, 3, 4)])
def test_traced_numbers_take_their_places_among_known_ones(traced):
    system = ac.compile(model(**{f"m{k}": Mass(m=float(k + 1)) for k in range(5)}))
    values = {f"m{k}.m": 10.0 * k + 1 for k in traced}
    packed = jax.jit(lambda v: system.pack(v).values)(values)
    assert packed.tolist() == system.pack(values).values.tolist()


def test_known_numbers_are_one_constant_however_many_they_are():
    def equations_of(n):
        system = ac.compile(model(**{f"m{k}": Mass(m=float(k + 1)) for k in range(n)}))
        return len(jax.make_jaxpr(lambda m: system.pack({"m1.m": m}).values)(1.0).eqns)

    assert equations_of(4) == equations_of(40)


def test_packing_twice_is_packing_once():
    system = ac.compile(model(a=Mass(m=1.5)))
    packed = system.pack(system.parameters())
    assert isinstance(packed, Packed)
    assert system.pack(packed) is packed


def test_equal_parameters_of_equal_components_lie_side_by_side():
    made = Model()
    made.g = Ground()
    made.r = [Resistor(R=1.0 + i) for i in range(5)]
    made.c = [Capacitor(C=10.0 + i) for i in range(5)]
    for r, c in zip(made.r, made.c, strict=True):
        made.connect(r.p, c.p)
        made.connect(r.n, c.n, made.g.p)
    system = ac.compile(made)
    values = system.pack().values.tolist()
    assert values in ([*range(1, 6), *range(10, 15)], [*range(10, 15), *range(1, 6)])


@pytest.mark.parametrize(
    ("params", "told"),
    [
        ({"a.n": 1.0}, "no parameter 'a.n'; did you mean 'a.m'"),
        ({"a.L": 1.0}, "'a.L' was left at its default of zero and is folded"),
        ({"a.m": "heavy"}, "'a.m' must be numbers, got 'heavy'"),
        ({"a.m": [1.0, 2.0]}, "'a.m' must be numbers"),
        ({"a.m": jnp.ones(2)}, "'a.m' must be numbers"),
        ({"a.m": None}, "'a.m' must be numbers, got None"),
        ({"a.m": np.nan}, "'a.m' must be numbers, got nan"),
    ],
)
def test_wrong_parameters_are_told(params, told):
    system = ac.compile(model(a=Mass(m=1.0)))
    with pytest.raises(ac.DataError, match=told):
        system.pack(params)


@pytest.mark.parametrize(
    ("params", "told"),
    [
        ({"a.m": -1.0}, r"^params: 'a\.m' is -1, but must be at least 0 kg\.$"),
        ({"a.m": jnp.asarray(-1)}, "'a.m' is -1, but must be at least 0 kg"),
        ({"a.m": -1, "b.m": -2.0}, r"at least 0 kg; 'b\.m' is out of range, too\.$"),
        ({"g.gain": 11.0}, "'g.gain' is 11, but must be at most 10"),
    ],
)
def test_values_out_of_range_are_told(params, told):
    class Limited(ac.Component):
        gain = ac.Parameter(1.0, max=10)
        x = ac.Variable()

        def equations(self):
            yield ac.Eq(ac.der(self.x), self.gain)

    system = ac.compile(model(a=Mass(m=1.0), b=Mass(m=1.0), g=Limited(gain=2.0)))
    for refused in (system.pack, system.initialize, lambda p: ac.linearize(system, params=p)):
        with pytest.raises(ac.DataError, match=told):
            refused(params)
    with pytest.raises(ac.DataError, match=told):
        ac.simulate(system, (0, 1), dt=0.1, params=params)


def test_values_that_jax_traces_are_let_pass():
    system = ac.compile(model(a=Mass(m=1.0)))
    found = jax.jit(lambda m: system.pack({"a.m": m}).values)(-1.0)
    assert found.tolist() == [-1.0]
    assert system.pack(system.parameters() | {"a.m": 0.0}).values.tolist() == [0.0]


def test_a_bound_parameter_cannot_be_set():
    system = ac.compile(Box())
    with pytest.raises(
        ac.DataError, match=r"'last\.gain' is bound to an expression; change 'c' in"
    ):
        system.pack({**system.parameters(), "last.gain": 1.0})


def test_some_numbers_may_be_given_with_and_without_networks():
    system = ac.compile(Box())
    given = system.pack({"c": 1.0})
    whole = system.pack({**system.parameters(), "c": 1.0})
    assert eqx.tree_equal(given, whole)
    with pytest.raises(ac.DataError, match="no parameter 'd'; "):
        system.pack({"d": 1.0})


def test_a_function_that_makes_no_module_is_told():
    system = ac.compile(Called(net=lambda key: 3.0))
    with pytest.raises(ac.DeclarationError, match="'net': the function gave float, not a callable"):
        system.parameters()


def test_an_expression_that_divides_by_a_folded_parameter_is_told():
    class Inverse(ac.Component):
        k = ac.Parameter(0.0)
        x = ac.Variable()

        def __init__(self):
            super().__init__()
            self.part = Equations("y", lambda s: [ac.Eq(ac.der(s.y), s.g)], g=1.0)
            self.part.modify(g=1 / self.k)

        def equations(self):
            yield ac.Eq(ac.der(self.x), self.k)

    with pytest.raises(
        ac.DeclarationError, match=r"'part.g': its expression divides by a parameter"
    ):
        ac.compile(Inverse())


def test_a_number_is_no_network():
    with pytest.raises(ac.DataError, match=r"^params: 'extra\.net' must be networks, got 3\.0$"):
        learned().pack({"extra.net": 3.0})


class Chain(ac.Component):
    """Every parameter is bound to the one before."""

    net = ac.Module(lambda key: Scale(jax.random.normal(key)))

    def __init__(self, n):
        super().__init__()
        parts = [Called(gain=1.0, net=self.net)]
        for _ in range(n):
            parts.append(Called(gain=0.5 * parts[-1].gain + 1.0, net=self.net))
        self.parts = parts


@pytest.mark.slow
def test_a_long_chain_of_bound_parameters_is_packed_in_linear_time():
    system = ac.compile(Chain(400))
    values = system.pack().values
    np.testing.assert_allclose(values[:4], [1.0, 1.5, 1.75, 1.875])
    assert values[-1] == pytest.approx(2.0)
    params = system.parameters()

    def packed(gain):
        return system.pack({**params, "parts[1].gain": gain}).values

    operations = jax.make_jaxpr(packed)(1.0).eqns
    numbers = sum(v.aval.size for operation in operations for v in operation.outvars)
    assert numbers < 10 * len(values)  # a vector that grows step by step would add up to its square
    np.testing.assert_allclose(jax.jit(jax.jacfwd(packed))(1.0)[:4], [1.0, 0.5, 0.25, 0.125])


def test_bindings_that_zeros_make_alike_share_a_formula():
    """``a + b*z`` and ``a``: without the zero one expression, of unlike arguments."""

    class Pair(ac.Component):
        a, b, z = ac.Parameter(2.0), ac.Parameter(3.0), ac.Parameter(0.0)
        x = ac.Variable()

        def __init__(self):
            super().__init__()
            self.parts = [
                Mass(m=self.a**2 + self.b * self.z),
                Mass(m=self.a**2),
                Mass(m=self.a**2 + self.z),
            ]

        def equations(self):
            yield ac.Eq(ac.der(self.x), sum(part.m for part in self.parts))

    system = ac.compile(Pair())
    found = system.vector_field(0.0, np.zeros(len(system.states)), None, system.parameters())
    assert float(found[system.states.index("x")]) == 12
