"""Single precision: everything between the first state and the result is in it, and near double precision."""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.codegen.newton import Dense, root
from examples.qvm.model import with_networks
from examples.qvm.record import INPUT, rough_road
from tests.support.oscillator import force, learned, plain, record


@pytest.fixture(scope="module")
def vehicle():
    """The quarter vehicle, parameters for it, and a road of two seconds."""
    system = ac.compile(with_networks())
    time, speed = (a[:2001] for a in rough_road(1, scale=1.0))
    return system, system.parameters(0), (time, speed)


@pytest.mark.slow
def test_the_vehicle_and_its_gradient_are_near_those_in_double_precision(vehicle):
    system, params, road = vehicle

    @eqx.filter_jit
    @eqx.filter_value_and_grad(has_aux=True)
    def driven(networks, dtype):
        run = ac.simulate(
            system,
            (0, 2),
            dt=1e-3,
            solver="heun",
            inputs={INPUT: road},
            params=networks,
            dtype=dtype,
        )
        return jnp.mean(run["body.a"] ** 2), run

    (_, single), gradient = driven(params, jnp.float32)
    (_, double), expected = driven(params, jnp.float64)
    for name in ("body.a", "wheel.a", "body.v"):
        assert single[name].dtype == jnp.float32
        size = float(jnp.max(jnp.abs(double[name])))
        np.testing.assert_allclose(single[name], double[name], atol=2e-4 * size)
    assert {a.dtype.name for a in (single.t, single.x, single.u, single.packed.values)} == {
        "float32"
    }
    for name in ("spring_nn.net", "damper_nn.net"):
        for own, wanted in zip(gradient[name].weights, expected[name].weights, strict=True):
            np.testing.assert_allclose(own, wanted, atol=1e-3 * float(jnp.max(jnp.abs(wanted))))


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize(
    "choice",
    [
        {"rtol": 1e-5},
        {"rtol": 1e-5, "solver": "kvaerno3"},
        {"dt": 1e-2, "solver": "implicit_euler"},
        {"dt": 1e-2, "solver": "rk4"},
    ],
    ids=["adaptive", "implicit", "implicit fixed", "function of time"],
)
def test_every_kind_of_step(choice):
    inputs = {"push.f": lambda t: 3 * jnp.sin(2 * t)}
    runs = [
        ac.simulate(plain(), (0, 1), saveat=[0.5, 1.0], inputs=inputs, dtype=dtype, **choice)
        for dtype in (np.float32, np.float64)
    ]
    assert runs[0]["mass.s"].dtype == jnp.float32
    np.testing.assert_allclose(runs[0]["mass.s"], runs[1]["mass.s"], rtol=2e-4)


class Loop(ac.Component):
    """A state driven by the root of ``y + y^3 = x``."""

    x = ac.Variable(start=2.0, fixed=True)
    y = ac.Variable(start=1.0)

    def equations(self):
        yield ac.Eq(ac.der(self.x), -self.y)
        yield ac.Eq(self.y + self.y**3 + ac.sin(self.y), self.x)


@pytest.mark.slow
def test_nonlinear_loops_are_solved_as_well_as_rounding_allows():
    single, double = (
        ac.simulate(ac.compile(Loop()), (0, 1), dt=0.05, dtype=d)["y"] for d in ("f4", "f8")
    )
    assert single.dtype == jnp.float32
    np.testing.assert_allclose(single, double, rtol=1e-5)


def test_newton_knows_the_rounding():
    def block(z):
        return z, jnp.stack([z[0] ** 3 - 2, z[1] * jnp.exp(z[1]) - z[0]])

    found, converged = root(Dense(block, jnp.linalg.solve), jnp.ones(2, jnp.float32))
    assert converged
    assert found.dtype == jnp.float32
    assert float(found[0]) == pytest.approx(2 ** (1 / 3), rel=1e-6)


@pytest.mark.slow
def test_a_fit_in_single_precision_goes_the_same_way():
    fits = [
        ac.fit(
            learned(),
            record(),
            "mass.a",
            sequence_length=0.5,
            batch_size=4,
            epochs=20,
            dtype=dtype,
            progress=False,
        )
        for dtype in (np.float32, np.float64)
    ]
    single, double = (fit.params["extra.net"].weights for fit in fits)
    for own, wanted in zip(single, double, strict=True):
        assert own.dtype == jnp.float64
        assert not np.array_equal(own, wanted)
        np.testing.assert_allclose(own, wanted, atol=2e-3)
    assert fits[0].loss == pytest.approx(fits[1].loss, rel=1e-3)
    assert fits[0].loss < 0.9 * fits[0].loss_before


def test_a_model_computes_in_its_states_precision():
    x, u = jnp.ones(2, jnp.float32), jnp.ones(1, jnp.float32)
    packed = plain().pack()
    assert plain().vector_field(0.0, x, u, packed).dtype == jnp.float64
    single = eqx.tree_at(lambda p: p.values, packed, packed.values.astype(jnp.float32))
    assert plain().vector_field(0.0, x, u, single).dtype == jnp.float32
    assert plain().vector_field(0.0, [1, 2], [0], packed).dtype == jnp.float64


def test_other_precisions_are_refused():
    with pytest.raises(ac.DataError, match="dtype=float16: models compute in float64 or float32"):
        ac.simulate(plain(), (0, 1), dt=0.1, inputs={"push.f": force}, dtype=jnp.float16)


class Constant(ac.Component):
    """A rate that is a number."""

    x = ac.Variable(start=0.0, fixed=True)

    def equations(self):
        yield ac.Eq(ac.der(self.x), 2)


def test_a_rate_that_is_a_number_has_its_states_precision():
    run = ac.simulate(ac.compile(Constant()), 1.0, dtype="float32", solver="kvaerno3")
    np.testing.assert_allclose(run["x"][-1], 2.0, rtol=1e-5)
