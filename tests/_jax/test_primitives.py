"""What acausal takes for granted of jaxprs; and that a JAX that writes them otherwise costs speed, not results."""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax

import acausal as ac
from acausal._jax import lanes, primitives
from acausal._jax.batching import batched, is_small
from tests.support.oscillator import learned

X = jnp.arange(1.0, 13.0).reshape(4, 3)

USES = {
    "broadcast_in_dim": lambda x: jnp.broadcast_to(x, (2, 4, 3)),
    "dot_general": lambda x: x.T @ x,
    "pad": lambda x: jnp.pad(x, 1),
    "reshape": lambda x: x.reshape(2, 6),
    "scan": lambda x: lax.scan(lambda c, r: (c + r @ x[0], c), 0.0, x),
    "slice": lambda x: lax.slice(x, (1, 0), (3, 3), (1, 2)),
    "transpose": lambda x: x.T,
}


@pytest.mark.parametrize("name", primitives.PARAMETERS)
def test_operations_have_the_parameters_that_are_read(name: str) -> None:
    found = [e for e, _ in primitives.all_equations(jax.make_jaxpr(USES[name])(X).jaxpr)]
    read = [primitives.parameters(e) for e in found if primitives.name_of(e) == name]
    assert read
    assert all(len(values) == len(primitives.PARAMETERS[name]) for values in read)


def test_what_a_loop_shares_carries_and_reads_is_told_apart() -> None:
    def loop(x: jax.Array, gain: jax.Array) -> object:
        return lax.scan(lambda c, r: ((gain * c[0] + r[0], -c[1]), r[1]), (x[0], gain), (x, x))

    equations = jax.make_jaxpr(loop)(X, X[0]).jaxpr.eqns
    (scan,) = (e for e in equations if primitives.name_of(e) == primitives.SCAN)
    found = primitives.scan_of(scan.params)
    assert (found.n_constants, found.n_carry, len(scan.invars)) == (1, 2, 5)


@pytest.mark.parametrize(
    "function",
    [jax.jit(jnp.sin), jax.nn.relu, jax.checkpoint(jnp.sin)],
    ids=["jit", "rule", "remat"],
)
def test_called_jaxprs_are_found(function: Callable[..., jax.Array]) -> None:
    equations = jax.make_jaxpr(function)(X).jaxpr.eqns
    calls = [e for e in equations if primitives.name_of(e) in primitives.CALLS]
    assert calls
    for call in calls:
        assert primitives.is_readable(call)
        assert len(primitives.called(call).jaxpr.invars) == len(call.invars)


@pytest.mark.slow
def test_the_steps_of_a_model_need_no_detour(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every operation of a batch of simulations and of its gradient has a rule."""
    detours: list[str] = []

    def noted(equation, inputs, width):
        detours.append(primitives.name_of(equation))
        raise AssertionError(detours)

    monkeypatch.setattr(lanes, "_vmapped", noted)
    force = jnp.sin(jnp.arange(8.0))

    def loss(params, x0):
        run = ac.simulate(
            learned(),
            (0, 0.7),
            dt=0.1,
            inputs={"push.f": force},
            params=params,
            x0=x0,
            solver="heun",
        )
        return jnp.sum(run["mass.a"] ** 2)

    params = learned().parameters(0)
    networks = {"extra.net": params["extra.net"]}

    def mean(networks, x0s):
        return jnp.mean(jax.vmap(lambda x0: loss({**params, **networks}, x0))(x0s))

    gradient = eqx.filter_jit(eqx.filter_grad(mean))(networks, jnp.ones((9, 2)))
    assert np.isfinite(gradient["extra.net"].weights[0]).all()
    assert not detours


# -- another JAX -------------------------------------------------------------------------------------


def without_numbers(equation):
    raise primitives.UnknownEquationError("'scan' has no parameter num_consts, num_carry")


def misread(equation):
    return primitives.Scan(None, 1, 1, {})  # pyright: ignore[reportArgumentType]


def renamed(*_: object):
    raise KeyError("jaxpr")


CHANGES = {
    "scan without its numbers of arguments": ("scan_of", without_numbers),
    "scan misread": ("scan_of", misread),
    "calls renamed": ("called", renamed),
    "parameters renamed": ("_read", renamed),
    "equations of another kind": ("name_of", lambda equation: equation.primitive.title),
}


@pytest.fixture(params=CHANGES)
def changed(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if request.param == "equations of another kind":  # only where equations are evaluated
        monkeypatch.setattr(lanes, "_apply", CHANGES[request.param][1])
    else:
        monkeypatch.setattr(primitives, *CHANGES[request.param])


def looped(x: jax.Array, gain: jax.Array) -> list[jax.Array]:
    def step(carry, row):
        return carry + jax.nn.relu(gain * row[None])[0], jnp.sin(carry)

    end, outputs = lax.scan(step, x, jnp.arange(5.0))
    return [end, outputs]


@pytest.mark.usefixtures("changed")
def test_where_jaxprs_are_not_understood_functions_are_mapped_by_jax() -> None:
    xs, gain = jnp.linspace(-1.0, 1.0, 11), jnp.asarray(0.3)
    with pytest.raises(primitives.UnknownEquationError):
        jax.make_jaxpr(lanes.lanes(looped, (True, False), 11))(xs, gain)
    expected = jax.vmap(looped, (0, None))(xs, gain)
    found = jax.jit(jax.vmap(batched(looped), (0, None)))(xs, gain)
    for own, wanted in zip(found, expected, strict=True):
        np.testing.assert_allclose(own, wanted, rtol=1e-12)


@pytest.mark.cases(fast=1, slow=4)
@pytest.mark.usefixtures("changed")
def test_simulations_and_gradients_stay_the_same() -> None:
    force = jnp.sin(jnp.arange(8.0))

    def loss(start, x0):
        options = {"dt": 0.1, "inputs": {"push.f": force}, "solver": "heun"}
        run = ac.simulate(learned(), (0, 0.7), x0=start * x0, **options)
        return jnp.sum(run["mass.a"] ** 2)

    x0s = jnp.linspace(0.1, 1.0, 22).reshape(11, 2)
    mapped = jax.vmap(jax.value_and_grad(loss), (None, 0))(1.0, x0s)
    single = [jax.value_and_grad(loss)(1.0, x0) for x0 in (x0s[0], x0s[-1])]
    for row, expected in zip((0, -1), single, strict=True):
        np.testing.assert_allclose([v[row] for v in mapped], expected, rtol=1e-10)


def test_a_loop_that_hides_its_body_is_left_to_jax(monkeypatch: pytest.MonkeyPatch) -> None:
    traced = jax.make_jaxpr(looped)(X[0, 0], X[0, 0]).jaxpr
    assert is_small(traced)
    monkeypatch.setattr(primitives, "_inner", lambda params: iter(()))
    assert not is_small(traced)


def test_a_parameter_that_is_missing_is_named() -> None:
    (equation,) = jax.make_jaxpr(lambda x: x.reshape(2, 6))(X).jaxpr.eqns
    changed = equation.replace(params={"sizes": (2, 6)})
    with pytest.raises(
        primitives.UnknownEquationError, match="'reshape' has no parameter new_sizes"
    ):
        primitives.parameters(changed)
