from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.analysis import arguments, calls, labels
from acausal.codegen import Values
from acausal.components import neural, translational as tl
from acausal.networks import law_at
from acausal.networks.in_params import networks
from tests.support.counted import compilations
from tests.support.oscillator import learned


def count(module):
    return sum(a.size for a in jax.tree.leaves(eqx.filter(module, eqx.is_inexact_array)))


class Spring(eqx.Module):
    """A module of a user, with a field that is called as the law of an energy is."""

    law: float

    def __call__(self, x: Any) -> Any:
        return self.law * x


def test_the_law_of_a_module_with_a_field_of_that_name_is_the_module():
    found = law_at(Spring(2.0), np.array([1.0, 2.0]), np.zeros(0))
    np.testing.assert_array_equal(found, [2.0, 4.0])


def test_a_law_at_some_points_is_one_program():
    net, points = ac.MLP(key=0), np.linspace(-1.0, 1.0, 23)
    with compilations() as names:
        found = law_at(net, points, np.zeros(0))
    assert [n for n in names if "law" not in n] == []
    np.testing.assert_allclose(found[3], net(points[3]), rtol=1e-12)


def test_the_papers_network():
    net = ac.MLP(key=0)
    assert count(net) == 321
    assert repr(net) == "MLP(1-16-16-1, relu)"
    assert net(0.3).shape == ()


def test_the_formula():
    net = ac.MLP(2, 3, 1, "tanh", input_scale=(2.0, 5.0), output_scale=7.0, key=1)
    (first, last), (b, c) = net.weights, net.biases
    hidden = np.tanh(first @ np.array([0.4 / 2, -1 / 5]) + b)
    assert float(net(0.4, -1.0)) == pytest.approx(float(7 * (last[0] @ hidden + c[0])))


def test_keys_and_seeds():
    a, b, c = ac.MLP(key=0), ac.MLP(key=jax.random.key(0)), ac.MLP(key=1)
    assert float(a(0.3)) == float(b(0.3)) != float(c(0.3))


def test_a_small_last_layer_starts_near_zero():
    assert abs(float(ac.MLP(last_layer=1e-3, key=0)(0.5))) < 1e-2


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ac.MLP(activation="rely", key=0), "no activation 'rely': did you mean 'relu'?"),
        (lambda: ac.MLP(width=0, key=0), "width=0"),
        (
            lambda: ac.MLP(width=9999, depth=60, key=0),
            "width=9999 and depth=60 has 5,998,810,059 weights",
        ),
        (lambda: ac.networks.Law(width=9999, depth=60), "weights; give 10,000,000 or less"),
        (lambda: ac.MLP(2, input_scale=(1.0,), key=0), "1 input scales for 2 inputs"),
        (lambda: ac.MLP(2, key=0)(1.0), "a network of 2 inputs is called with 1"),
    ],
)
def test_wrong_networks_are_refused(make, message):
    with pytest.raises(ac.DeclarationError) as error:
        make()
    assert message in str(error.value)


def test_offset_correction():
    params: dict[str, Any] = {"a.net": ac.MLP(key=0), "b.net": ac.MLP(2, key=1), "a.c": 3.0}
    corrected = ac.remove_offset(params)
    assert corrected["a.c"] == 3.0
    assert float(corrected["a.net"](0.0)) == 0.0
    assert float(corrected["b.net"](0.0, 0.7)) == 0.0
    difference = params["a.net"](0.4) - params["a.net"](0.0)
    assert float(corrected["a.net"](0.4)) == pytest.approx(float(difference))
    only = ac.remove_offset(params, ("b.net",))
    assert only["a.net"] is params["a.net"]


def test_tables_are_no_networks():
    params = {"net": ac.MLP(key=0), "table": ac.Signal([0.0, 1.0], [0.0, 1.0]), "c": 1.0}
    assert tuple(networks(params)) == ("net",)


def test_arguments_of_a_network_in_a_model():
    system = learned()
    x, packed = jnp.asarray([0.3, 0.0]), system.pack(system.parameters(0))
    np.testing.assert_allclose(
        arguments(system, "extra.net", Values(0.0, x, jnp.zeros(1), packed)), [[0.3]]
    )
    with pytest.raises(ac.ModelError, match=r"no module 'extra\.nut': did you mean 'extra\.net'"):
        calls(system, "extra.nut")


def test_arguments_with_expressions_and_several_calls():
    class Two(ac.Component):
        net = ac.Module(lambda key: ac.MLP(2, key=key))
        k = ac.Parameter(3.0)
        x = ac.Variable(start=1.0, fixed=True)
        T = ac.Input()

        def equations(self):
            yield ac.Eq(
                ac.der(self.x), self.net(self.k * self.x, self.T) + self.net(-self.x, 2 * self.k)
            )

    system = ac.compile(Two())
    packed = system.pack(system.parameters(0))
    at = Values(0.0, jnp.asarray([0.5]), jnp.asarray([20.0]), packed)
    seen = arguments(system, "net", at)
    assert sorted(np.asarray(seen).tolist()) == [[-0.5, 6.0], [1.5, 20.0]]


def test_arguments_and_labels_of_networks_in_a_list():
    class Row(ac.Component):
        def __init__(self):
            super().__init__()
            self.wall, self.mass = tl.Fixed(), [tl.Mass(m=1.0) for _ in range(3)]
            self.spring = [neural.Compliance(input_scale=0.1, output_scale=5.0) for _ in range(3)]
            left = self.wall.flange
            for spring, mass in zip(self.spring, self.mass, strict=True):
                self.connect(left, spring.flange_a)
                self.connect(spring.flange_b, mass.flange_a)
                left = mass.flange_b

    system = ac.compile(Row())
    x = np.zeros(6)
    x[[system.states.index(f"mass[{i}].s") for i in (1, 2, 3)]] = [0.1, 0.3, 0.7]
    at = Values(0.0, jnp.asarray(x), jnp.zeros(0), system.pack(system.parameters(0)))
    for i, stretched in ((1, 0.1), (2, 0.2), (3, 0.4)):
        seen = arguments(system, f"spring[{i}].net", at)
        np.testing.assert_allclose(seen, [[stretched]], rtol=1e-12)
        found = labels(system, f"spring[{i}].net", at.packed)
        assert found.arguments == (f"spring[{i}].s_rel [m]",)
        assert found.result == f"spring[{i}].f [N]"
    (together,) = calls(system, "spring[1].net", "spring[3].net")
    np.testing.assert_allclose(together.values(system, at), [[0.1], [0.4]], rtol=1e-12)


@pytest.mark.slow
def test_a_fourier_series_repeats_and_has_no_mean():
    net = ac.networks.Fourier(2.0, harmonics=3, output_scale=5.0)
    assert float(net(0.3)) == 0
    weights = (jnp.array([1.0, 0.5, -2.0]), jnp.array([0.0, 1.0, 0.3]))
    bent = eqx.tree_at(lambda n: (n.sines, n.cosines), net, weights)
    x = jnp.linspace(0, 2, 40, endpoint=False)
    values = jax.vmap(bent)(x)
    assert float(values.mean()) == pytest.approx(0, abs=1e-9)
    np.testing.assert_allclose(jax.vmap(bent)(x + 2), values, atol=1e-9)
    assert float(bent(0.5)) == pytest.approx(5 * (1 + 2 - 1), abs=1e-9)
    with pytest.raises(ac.DeclarationError, match="give a positive number"):
        ac.networks.Fourier(0.0)
