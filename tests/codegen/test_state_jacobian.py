"""Entries of the state Jacobian, found colour by colour, are those of the dense one."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.codegen import DenseIterationMatrix, SparseIterationMatrix, state_jacobian
from acausal.components import electrical as el
from acausal.structure import SparseLoop, TornLoop, blocks, jacobian_pattern
from tests.support.stiff import Bridge, Chain, DiodeAndResistor, Ladder, Pack, Plate

MODELS = {
    "plate": (lambda: Plate(7), 7),
    "ladder with loops": (lambda: Ladder(40, Bridge), 3),
    "ladder with nonlinear loops": (lambda: Ladder(40, DiodeAndResistor), 3),
    "chain with networks": (lambda: Chain(20, neural_spring=True), 6),
    "small": (lambda: Plate(3), 9),
}


@pytest.fixture(scope="module", params=MODELS)
def case(request):
    """The system, its derivatives as a function of states and parameters, and the number of colours."""
    make, n_colors = MODELS[request.param]
    system = ac.compile(make())

    def field(packed):
        return lambda x: system.rates(system.values(0.0, x, None, packed))

    return system, field, n_colors


@pytest.mark.cases(fast=1, slow=4)
def test_entries_are_those_of_the_dense_jacobian(case):
    system, field, n_colors = case
    jacobian, packed = system.state_jacobian, system.pack()
    n = len(system.states)
    assert (jacobian.pattern is None) == (n < 32)
    assert jacobian.n_colors == n_colors
    assert set(range(n)) <= set(jacobian.rows[jacobian.rows == jacobian.columns].tolist())
    entries = jax.jit(lambda x, packed: jacobian.entries(field(packed), x))
    dense = jax.jit(lambda x, packed: jax.jacfwd(field(packed))(x))
    for seed in range(3):
        x = jnp.asarray(np.random.default_rng(seed).uniform(0.1, 0.5, n))
        filled = np.zeros((n, n))
        filled[jacobian.rows, jacobian.columns] = entries(x, packed)
        expected = dense(x, packed)
        np.testing.assert_allclose(filled, expected, rtol=1e-12, atol=1e-12 * abs(expected).max())


def test_the_pattern_is_found_once(case):
    system, _, _ = case
    assert system.state_jacobian is system.state_jacobian
    assert system.state_jacobian.iteration_matrix is system.state_jacobian.iteration_matrix


def test_a_dense_jacobian_of_many_states(monkeypatch):
    system = ac.compile(Plate(7))
    monkeypatch.setattr(state_jacobian, "DENSE", 0.0)
    jacobian, packed = system.state_jacobian, system.pack()
    assert jacobian.pattern is None
    x = jnp.linspace(1.0, 2.0, 49)
    field = lambda x: system.rates(system.values(0.0, x, None, packed)) * x  # noqa: E731
    found, expected = jax.jit(lambda x: (jacobian.entries(field, x), jax.jacfwd(field)(x)))(x)
    np.testing.assert_allclose(found.reshape(49, 49), expected, rtol=1e-12)


class Thermostat(ac.Component):
    """n rooms in a row; what heats the first follows the mean of all temperatures."""

    def __init__(self, n):
        super().__init__()
        self.T = [ac.Variable(start=1.0 + i) for i in range(n)]
        self.heat = ac.Variable(start=0.0)

    def equations(self):
        yield ac.Eq(ac.der(self.heat), 1.0 - sum(self.T) / len(self.T))
        for i, T in enumerate(self.T):
            here = self.T[max(i - 1, 0) : i + 2]
            yield ac.Eq(ac.der(T), sum(here) - 3 * T**3 + (self.heat if i == 0 else 0.0))


@pytest.mark.slow
def test_a_row_that_reads_all_states_needs_one_derivative_more():
    system = ac.compile(Thermostat(40))
    jacobian, packed = system.state_jacobian, system.pack()
    assert jacobian.n_colors <= 4
    assert [system.states[i] for i in jacobian.pattern.long_rows] == ["heat"]
    x = jnp.linspace(0.5, 2.0, 41)
    field = lambda x: system.rates(system.values(0.0, x, None, packed))  # noqa: E731
    found, expected = jax.jit(lambda x: (jacobian.entries(field, x), jax.jacfwd(field)(x)))(x)
    filled = np.zeros((41, 41))
    filled[jacobian.rows, jacobian.columns] = found
    np.testing.assert_allclose(filled, expected, rtol=1e-12, atol=1e-12)


class Hardening(el.OnePort):
    """A resistor whose voltage grows faster than its current: ``v = R i + K i**3``."""

    R = ac.Parameter(1.0, unit="Ohm")
    K = ac.Parameter(0.5, unit="V/A3")

    def equations(self):
        yield from super().equations()
        yield ac.Eq(self.v, self.R * self.i + self.K * self.i**3)


def open_always(monkeypatch):
    """Models with few states and small loops are treated as large ones, whose closed loops make too many entries."""

    def too_many_if_closed(reduced, most, opened):
        return jacobian_pattern(reduced, most, opened) if opened else None

    monkeypatch.setattr(state_jacobian, "jacobian_pattern", too_many_if_closed)
    for name, limit in (("FEW", 5), ("SMALL", 5), ("WIDE", 0), ("DENSE", 9.0)):
        monkeypatch.setattr(state_jacobian, name, limit)


@pytest.mark.cases(fast=1)
@pytest.mark.parametrize("large", [10, 10**6], ids=["sparse", "torn"])
@pytest.mark.parametrize("resistor", [el.Resistor, Hardening])
def test_loops_that_join_all_states_are_opened(resistor, large, monkeypatch):
    monkeypatch.setattr(blocks, "LARGE", large)
    monkeypatch.setattr(blocks, "WRITTEN", large)
    open_always(monkeypatch)
    system = ac.compile(Pack(4, 2, lambda k: resistor(R=1.0 + 0.1 * k)))
    assert any(isinstance(s, SparseLoop if large == 10 else TornLoop) for s in system.reduced.steps)
    jacobian, packed = system.state_jacobian, system.pack()
    n = len(system.states)
    assert n < jacobian.pattern.size
    assert len(jacobian.open_loops) == 1
    x, b, u = jnp.linspace(0.5, 1.5, n), jnp.cos(jnp.arange(1.0 * n)), jnp.zeros(0)

    @jax.jit
    def run(x, packed):
        field, matrix = system.field(0.0, u, packed), jacobian.iteration_matrix
        kept = matrix.factorize(jacobian.entries(field, x), 0.3)
        found = matrix.solve(kept, b), matrix.solve(kept, b, transposed=True)
        return *found, jnp.eye(n) - 0.3 * jax.jacfwd(field)(x)

    once, transposed, dense = run(x, packed)
    np.testing.assert_allclose(dense @ once, b, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(dense.T @ transposed, b, rtol=1e-9, atol=1e-9)
    with pytest.raises(TypeError, match="open loops needs a Field"):
        jacobian.entries(lambda x: x, x)


@pytest.mark.slow
def test_states_and_unknowns_are_found_together(monkeypatch):
    """An implicit Euler step by Newton's method: with the loops solved for each guess, and with open loops."""
    open_always(monkeypatch)
    system = ac.compile(Pack(4, 2, lambda k: Hardening(R=1.0 + 0.1 * k)))
    jacobian, field = system.state_jacobian, system.field(0.0, jnp.zeros(0), system.pack())
    matrix, loops, n, h = jacobian.iteration_matrix, jacobian.open_loops, jacobian.n, 0.5
    x = jnp.linspace(0.5, 1.5, n)

    def closed(_, y):
        kept = matrix.factorize(jacobian.entries(field, y), h)
        return y - matrix.solve(kept, y - x - h * field(y))

    def opened(_, both):
        y, z = both[:n], both[n:]
        kept = matrix.factorize(jacobian.entries(field, y, z), h)
        found = field.with_open_loops(loops, y, z)
        return both - matrix.solve(kept, jnp.concatenate([y - x - h * found[:n], found[n:]]))

    @jax.jit
    def run(x):
        both = jnp.concatenate([x, field.loop_unknowns(loops, x)])
        return jax.lax.fori_loop(0, 8, closed, x), jax.lax.fori_loop(0, 8, opened, both)[:n]

    np.testing.assert_allclose(*run(x), rtol=1e-10)


@pytest.mark.slow
def test_equal_loops_are_opened_side_by_side(monkeypatch):
    open_always(monkeypatch)
    system = ac.compile(Ladder(6, DiodeAndResistor))
    assert any(isinstance(s, TornLoop) and len(s.unknowns) > 1 for s in system.reduced.steps)
    jacobian, packed = system.state_jacobian, system.pack()
    assert jacobian.open_loops
    x, b, u = jnp.linspace(0.5, 1.5, 6), jnp.cos(jnp.arange(6.0)), jnp.zeros(0)

    @jax.jit
    def run(x, packed):
        field, matrix = system.field(0.0, u, packed), jacobian.iteration_matrix
        kept = matrix.factorize(jacobian.entries(field, x), 0.3)
        return matrix.solve(kept, b), jnp.eye(6) - 0.3 * jax.jacfwd(field)(x)

    found, dense = run(x, packed)
    np.testing.assert_allclose(dense @ found, b, rtol=1e-9, atol=1e-9)


def test_loops_stay_closed_where_the_jacobian_is_small():
    system = ac.compile(Pack(12, 3, lambda k: el.Resistor(R=1.0)))
    assert system.state_jacobian.open_loops == ()
    assert system.state_jacobian.pattern is None


def test_loops_are_opened_where_that_saves_entries(monkeypatch):
    system = ac.compile(Pack(40, 3, lambda k: el.Resistor(R=1.0)))
    jacobian = system.state_jacobian
    assert jacobian.n == 120
    assert jacobian.open_loops
    assert jacobian.n_entries < 0.1 * 120**2


def test_the_way_to_solve_follows_from_size_and_pattern(monkeypatch):
    assert isinstance(ac.compile(Plate(7)).state_jacobian.iteration_matrix, DenseIterationMatrix)
    monkeypatch.setattr(state_jacobian, "SMALL", 40)
    assert isinstance(ac.compile(Plate(7)).state_jacobian.iteration_matrix, SparseIterationMatrix)


def test_a_model_without_states_has_no_entries():
    class Nothing(ac.Component):
        x = ac.Variable()

        def equations(self):
            yield ac.Eq(self.x, 1.0)

    jacobian = ac.compile(Nothing()).state_jacobian
    assert jacobian.n_colors == 0
    assert jacobian.entries(lambda x: x, jnp.zeros(0)).shape == (0,)
