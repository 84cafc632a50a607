"""The scan with stored states, and batches: the numbers and derivatives of a plain scan, alone and mapped."""

from functools import partial

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax

import acausal as ac
from acausal._jax.batching import LARGEST, batched, is_small, operations
from acausal._jax.scan import stored_scan
from tests.support import oscillator

US, COUNT = jnp.linspace(0.0, 1.0, 7), jnp.arange(7)
MATRIX = jnp.asarray(np.random.default_rng(0).standard_normal((3, 3)))
GAIN, X0 = jnp.asarray(0.3), jnp.asarray([0.1, -0.2, 0.3])


def step(constants, x, row):
    matrix, gain, offset = constants
    u, i = row
    return jnp.tanh(matrix @ x) + gain * u, (jnp.sum(x) * gain + offset * (i % 2), x[0] * u)


def plain(step, constants, x0, rows):
    def body(x, row):
        new, outputs = step(constants, x, row)
        return new, (x, outputs)

    end, (states, outputs) = lax.scan(body, x0, rows)
    return states, end, outputs


def run(repeat, matrix=MATRIX, gain=GAIN, x0=X0, us=US):
    return repeat(step, (matrix, gain, 2), x0, (us, COUNT))


def loss(repeat, *args):
    """Depends on all results, and on each in its own way."""
    states, end, (first, second) = run(repeat, *args)
    return jnp.sum(jnp.sin(states)) + end @ end + jnp.sum(first**2) + second @ US


def assert_close(a, b):
    jax.tree.map(lambda x, y: np.testing.assert_allclose(x, y, rtol=1e-11, atol=1e-13), a, b)


def assert_same(transform, **jit):
    """That what is made of `stored_scan` is what is made of the scan."""
    assert_close(*(jax.jit(lambda f=f: transform(f), **jit)() for f in (stored_scan, plain)))


def test_it_repeats_a_step():
    assert_same(run)


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize("by", [(0, 1, 2, 3), (0,), (2,), (3,)])
def test_its_gradient_by_anything(by):
    assert_same(lambda f: jax.grad(partial(loss, f), by)(MATRIX, GAIN, X0, US))


@pytest.mark.parametrize(
    "pick", [lambda r: r[1][0], lambda r: r[0][3, 1], lambda r: r[2][1].sum()], ids=range(3)
)
def test_its_gradient_of_some_results(pick):
    assert_same(lambda f: jax.grad(lambda x, u: pick(run(f, x0=x, us=u)), (0, 1))(X0, US))


def test_a_step_may_close_over_what_is_differentiated():
    def total(f, gain):
        return f(lambda c, x, u: (c * x * gain + u, None), GAIN, X0, US)[1].sum()

    assert_same(lambda f: jax.grad(partial(total, f))(GAIN))


@pytest.mark.slow
@pytest.mark.parametrize("size", [1, 3, 8, 19])
def test_mapped_gradients(size):
    rng = np.random.default_rng(size)
    x0s, us = rng.standard_normal((size, 3)), rng.standard_normal((size, 7))

    def mean(f, matrix, gain, x0s, us):
        return jnp.mean(jax.vmap(partial(loss, f), (None, None, 0, 0))(matrix, gain, x0s, us))

    assert_same(lambda f: jax.value_and_grad(partial(mean, f), (0, 1, 2, 3))(MATRIX, GAIN, x0s, us))


@pytest.mark.slow
def test_gradients_for_many_constants():
    matrices = jnp.asarray(np.random.default_rng(3).standard_normal((9, 3, 3)))
    assert_same(lambda f: jax.vmap(jax.grad(partial(loss, f), (0, 1)), (0, None))(matrices, GAIN))


@pytest.mark.slow
def test_second_derivatives():
    assert_same(lambda f: jax.jacrev(jax.grad(partial(loss, f), 2), 2)(MATRIX, GAIN, X0))


def bounded(x):
    """It stays below one, and its derivative is -5."""
    return jnp.stack([-5.0, 0.5]) * (x - lax.stop_gradient(x)) + lax.stop_gradient(jnp.tanh(x))


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize(("n", "is_right"), [(20, True), (30, False)])
def test_derivatives_that_explode_are_nan(n, is_right):
    """In any units; where they have not exploded, they stay as they are, also beside one that has."""

    def end(x, rate, count=n, unit=1.0):
        def step(rate, x, row):
            return bounded(rate * x) + row, x

        return unit * stored_scan(step, rate, x, jnp.zeros((count, 2)))[1].sum()

    x, gradient = np.array([0.3, 0.4]), jax.jit(jax.grad(end, (0, 1)))
    for unit in (1e-30, 1.0, 1e30):
        by_x, by_rate = gradient(x, 1.0, unit=unit)
        assert bool(np.isfinite(by_x).all()) is is_right
        assert bool(np.isfinite(by_rate)) is is_right
    both = jax.jit(jax.vmap(jax.grad(end)))(np.stack([x, x]), np.array([1.0, 0.1]))
    assert np.isfinite(both).all(axis=1).tolist() == [is_right, True]


def test_derivatives_grow_with_the_states():
    """A state that grows by 1e25 has right derivatives as large."""

    def end(x):
        return stored_scan(lambda c, x, u: (3.0 * x, x), 0.0, x, jnp.zeros(52))[1]

    np.testing.assert_allclose(jax.jit(jax.grad(end))(2.0), 3.0**52)


def test_forward_mode_where_it_is_asked_for():
    direct = partial(stored_scan, direct=True)

    def jacobian(repeat):
        return jax.jit(jax.jacfwd(lambda x: run(repeat, x0=x)[1]))(X0)

    assert_close(jacobian(direct), jacobian(plain))
    with pytest.raises(TypeError, match="forward-mode"):
        jacobian(stored_scan)


def test_what_calls_a_library_is_left_to_jax():
    def sorting(c, x, u):
        return jnp.sort(c * x + u), x

    def solving(c, x, u):
        return jnp.linalg.solve(MATRIX, c * x + u), x

    for other in (sorting, solving):
        traced = jax.make_jaxpr(other)(GAIN, X0, US[0])
        assert not is_small(traced.jaxpr, in_loop=True)
        assert_same(lambda f, g=other: jax.jacfwd(lambda x: f(g, GAIN, x, US)[1])(X0))


@pytest.mark.cases(fast=1, slow=3)
@pytest.mark.parametrize(
    ("interpolation", "dt"),
    [("linear", 0.5), ("previous", 0.25), ("cubic", 0.2), ("band-limited", 0.1)],
)
def test_a_model_with_any_input_is_compiled_as_a_whole(interpolation: str, dt: float, monkeypatch):
    """Its number of steps is its own, so that it is traced anew."""
    found = []
    monkeypatch.setattr(
        "acausal._jax.scan.is_small",
        lambda jaxpr, in_loop: found.append(is_small(jaxpr, in_loop)) or found[-1],
    )
    force = ac.Signal(np.arange(4.0), np.arange(4.0) % 2, interpolation)
    ac.simulate(oscillator.learned(), (0.0, 3.0), dt=dt, inputs={"push.f": force}, solver="heun")
    assert found == [True]


def test_totals_are_written_once_a_turn_where_they_are_large():
    """In one turn of the derivative's loop are two steps then, else one."""

    def sines(width):
        weights = jnp.ones((width, 3))
        back = jax.grad(lambda w: jnp.sum(stored_scan(one, w, X0, US)[1]))
        return str(jax.make_jaxpr(back)(weights)).count("cos")

    def one(weights, x, u):
        return jnp.tanh(jnp.sin(u) * weights[0] + jnp.sum(weights) * x), None

    assert operations(jax.make_jaxpr(one)(jnp.ones((30, 3)), X0, US[0]).jaxpr) < 10
    assert sines(30) == 2 * sines(1)


def test_what_is_large_is_left_to_jax():
    def grows(n):
        return is_small(jax.make_jaxpr(jnp.sin)(jnp.zeros(n)).jaxpr, in_loop=True)

    assert grows(LARGEST)
    assert not grows(LARGEST + 1)
    assert not is_small(jax.make_jaxpr(jnp.matmul)(MATRIX, MATRIX).jaxpr, in_loop=True)


def test_a_batch_with_results_that_all_instances_share():
    def function(x, y):
        return [x + y, lax.fori_loop(0, 3, lambda _, z: z * 2, y)]

    results = jax.jit(jax.vmap(batched(function), (0, None)))(np.arange(11.0), GAIN)
    assert_close(results, [np.arange(11.0) + GAIN, np.full(11, 8 * float(GAIN))])
