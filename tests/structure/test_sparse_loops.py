"""Loops of many unknowns: solved by sparse matrices as they would be by dense ones."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical as el, rotational as rot
from acausal.structure import SparseLoop, TornLoop, blocks as steps
from tests.support.parts import Equations


class Cubic(el.OnePort):
    """A conductor that grows stiffer: ``i = G v + K v**3``."""

    G = ac.Parameter(1.0, unit="S")
    K = ac.Parameter(0.3, unit="A/V3")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.i, self.G * self.v + self.K * self.v**3)


class Net(ac.Component):
    """A square of n by n nodes; ``make(k)`` gives its edges; two corners hold capacitors, one a source."""

    def __init__(self, n, make, grounded=True):
        super().__init__()
        self.ground, self.source = el.Ground(), el.SignalVoltage()
        self.c = [el.Capacitor(C=1.0), el.Capacitor(C=2.0)]
        edges = [((i, j), (i, j + 1)) for i in range(n) for j in range(n - 1)]
        edges += [((j, i), (j + 1, i)) for i in range(n) for j in range(n - 1)]
        self.edge = [make(k) for k in range(len(edges))]
        node = {(i, j): [] for i in range(n) for j in range(n)}
        for (a, b), edge in zip(edges, self.edge, strict=True):
            node[a].append(edge.p)
            node[b].append(edge.n)
        for at, part in zip([(0, n - 1), (n - 1, 0), (0, 0)], [*self.c, self.source], strict=True):
            node[at].append(part.p)
        for pins in node.values():
            self.connect(*pins)
        self.connect(self.source.n, *(c.n for c in self.c))
        if grounded:
            self.connect(self.ground.p, self.source.n)


class Train(ac.Component):
    """n inertias, rigidly geared to each other; a torque drives the first."""

    def __init__(self, n):
        super().__init__()
        self.torque = rot.Torque()
        self.inertia = [rot.Inertia(J=1.0 + 0.1 * k) for k in range(n)]
        self.gear = [rot.IdealGear(ratio=1.0 + 0.01 * k) for k in range(n - 1)]
        self.connect(self.torque.flange, self.inertia[0].flange_a)
        for a, gear, b in zip(self.inertia, self.gear, self.inertia[1:], strict=False):
            self.connect(a.flange_b, gear.flange_a)
            self.connect(gear.flange_b, b.flange_a)


MODELS = {
    "linear": lambda: Net(3, lambda k: el.Conductor(G=1.0 + 0.1 * k)),
    "nonlinear": lambda: Net(3, lambda k: Cubic(G=1.0 + 0.1 * k)),
    "some of each": lambda: Net(3, lambda k: Cubic() if k % 5 == 0 else el.Conductor(G=1.0)),
    "geared": lambda: Train(5),
}


@pytest.fixture(scope="module", params=MODELS)
def both(request):
    """The model with its loop as a mesh, and with the same loop dense."""
    compiled = []
    for large in (10, 10**6):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(steps, "LARGE", large)
            patch.setattr(steps, "WRITTEN", large)
            compiled.append(ac.compile(MODELS[request.param]()))
    mesh, dense = compiled
    assert any(isinstance(s, SparseLoop) for s in mesh.reduced.steps)
    assert any(isinstance(s, TornLoop) for s in dense.reduced.steps)
    return mesh, dense


def arguments(system):
    x = jnp.linspace(0.5, 1.5, len(system.states))
    return x, jnp.asarray([2.0]), system.pack()


def field(system):
    return lambda x, u, packed: system.vector_field(0.3, x, u, packed)


@pytest.mark.cases(fast=1)
def test_the_right_side_is_that_of_the_dense_loop(both):
    found, expected = (jax.jit(field(s))(*arguments(s)) for s in both)
    np.testing.assert_allclose(found, expected, rtol=1e-10)


@pytest.mark.cases(fast=1)
def test_gradients_by_states_inputs_and_parameters(both):
    def gradient(system):
        loss = lambda *args: jnp.sum(field(system)(*args) ** 2)  # noqa: E731
        by_x, by_u, by_parameters = jax.jit(jax.grad(loss, argnums=(0, 1, 2)))(*arguments(system))
        return jnp.concatenate([by_x, by_u, by_parameters.values])

    found, expected = map(gradient, both)
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-10)


@pytest.mark.cases(fast=1)
def test_batches(both):
    scale = jnp.asarray([[0.5], [1.0], [1.5]])

    def batch(system):
        x, u, packed = arguments(system)
        return jax.vmap(field(system), (0, None, None))(scale * x, u, packed)

    found, expected = map(batch, both)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.cases(fast=1)
def test_every_variable_can_be_observed(both):
    mesh, _ = both
    names = [n for n in mesh.variables if n.endswith((".v", ".i", ".a", ".tau"))]
    read = [jax.jit(partial(s.observe, names))(0.3, *arguments(s)) for s in both]
    np.testing.assert_allclose(*read, rtol=1e-8, atol=1e-9)


@pytest.mark.cases(fast=1)
def test_second_derivatives(both):
    def curvature(system):
        x, u, packed = arguments(system)
        return jax.jit(jax.hessian(lambda u: field(system)(x, u, packed)[-1]))(u)

    found, expected = map(curvature, both)
    np.testing.assert_allclose(found, expected, rtol=1e-7, atol=1e-10)


def test_the_equations_of_a_mesh_can_be_read(both):
    mesh, _ = both
    loop = next(s for s in mesh.reduced.steps if isinstance(s, SparseLoop))
    assert len(mesh.equations) == len(mesh.states) + len(loop.unknowns)


def test_a_mesh_that_floats_is_refused():
    with pytest.raises(ac.StructureError, match=r"potential|determine|undetermined"):
        ac.compile(Net(9, lambda k: el.Conductor(G=1.0), grounded=False))


@pytest.mark.slow
def test_meshes_that_nothing_joins_are_solved_together():
    class Two(ac.Component):
        def __init__(self):
            super().__init__()
            self.one = Net(6, lambda k: el.Conductor(G=1.0))
            self.other = Net(6, lambda k: el.Conductor(G=2.0))

    system, alone = ac.compile(Two()), ac.compile(Net(6, lambda k: el.Conductor(G=1.0)))
    assert sum(isinstance(s, SparseLoop) for s in system.reduced.steps) == 1
    x = jnp.asarray([1.0, -1.0, 1.0, -1.0])
    found = system.vector_field(0.0, x, jnp.asarray([3.0, 3.0]), system.pack())
    expected = alone.vector_field(0.0, x[:2], jnp.asarray([3.0]), alone.pack())
    np.testing.assert_allclose(found[:2], expected, rtol=1e-10)
    np.testing.assert_allclose(found[2:], 2 * expected, rtol=1e-10)


def ring(formula, n=12):
    """n unknowns ``y``, each a little drawn to the next: ``formula(y) + coupling * (next - y) = x``."""
    names = [f"y{k}" for k in range(n)]

    def stated(s):
        y = [getattr(s, name) for name in names]
        yield ac.Eq(ac.der(s.x), y[0])
        for here, after in zip(y, y[1:] + y[:1], strict=True):
            yield ac.Eq(formula(here) + s.coupling * (after - here), s.x)

    component = Equations(" ".join(["x", *names]), stated, coupling=0.05)
    component.modify(x=ac.Start(0.0, fixed=True), **{name: ac.Start(0.0) for name in names})
    return component


@pytest.fixture
def mesh_from_ten(monkeypatch):
    """Loops of more than ten unknowns become meshes."""
    monkeypatch.setattr(steps, "LARGE", 10)
    monkeypatch.setattr(steps, "WRITTEN", 10)


@pytest.mark.slow
@pytest.mark.usefixtures("mesh_from_ten")
def test_a_root_that_newtons_method_alone_does_not_find():
    system = ac.compile(ring(lambda y: y**3 - 2 * y + 2))
    assert any(isinstance(s, SparseLoop) for s in system.reduced.steps)
    assert system.vector_field(0.0, [0.0], None, None)[0] == pytest.approx(-1.7692923542)


@pytest.mark.slow
@pytest.mark.usefixtures("mesh_from_ten")
def test_the_place_of_a_breakdown():
    no_root = ac.compile(ring(lambda y: y**2 + 1))
    expected = (
        r"finds no solution of the equations for 'y0', .*leaves 'Equations: .*y\d+\*\*2.*off by"
    )
    with pytest.raises(ac.SimulationError, match=expected):
        ac.simulate(no_root, (0, 1), dt=0.5)
    singular = ac.compile(ring(lambda y: y))
    params = {**singular.parameters(), "coupling": 0.5}  # of an even ring: y, -y, y, ... is free
    with pytest.raises(ac.SimulationError, match=r"linear equations for 'y0', .* are singular"):
        ac.simulate(singular, (0, 1), dt=0.5, params=params)


@pytest.mark.slow
@pytest.mark.usefixtures("mesh_from_ten")
def test_gradients_of_a_simulation_in_every_mode():
    make = lambda k: el.Diode() if k % 5 == 4 else el.Resistor(R=100.0 + k)  # noqa: E731
    system = ac.compile(Net(3, make))
    assert any(isinstance(s, SparseLoop) for s in system.reduced.steps)
    params, x0 = system.parameters(), jnp.zeros(2)

    def loss(r):
        packed = system.pack({**params, "edge[2].R": r})
        step = lambda x, u: (x + 0.1 * system.vector_field(0.0, x, u, packed), None)  # noqa: E731
        return jax.lax.scan(step, x0, jnp.full((3, 1), 5.0))[0][0]

    r, h = 102.0, 0.01
    backward = jax.jit(jax.value_and_grad(loss))
    values, gradients = jax.jit(jax.vmap(backward))(jnp.asarray([r - h, r, r + h]))
    slope = (values[2] - values[0]) / (2 * h)
    assert abs(slope) > 1e-6
    forward = jax.jit(lambda r: jax.jvp(loss, (r,), (1.0,)))
    for found in ((values[1], gradients[1]), backward(r), forward(r)):
        np.testing.assert_allclose(found, (values[1], slope), rtol=1e-6)


@pytest.mark.slow
def test_a_dense_loop_with_many_terms_is_solved_as_a_matrix() -> None:
    n = 30
    matrix = np.random.default_rng(0).normal(size=(n, n)) + n * np.eye(n)

    def equations(s: Any) -> Iterator[ac.Eq]:
        unknowns = [getattr(s, f"y{i}") for i in range(n)]
        yield ac.Eq(ac.der(s.x), unknowns[0])
        for i, row in enumerate(matrix.tolist()):
            yield ac.Eq(sum(a * y for a, y in zip(row, unknowns, strict=True)), (i + 1) * s.x)

    system = ac.compile(Equations(" ".join(["x", *(f"y{i}" for i in range(n))]), equations))
    assert any(isinstance(s, SparseLoop) for s in system.reduced.steps)
    found = system.observe([f"y{i}" for i in range(n)], 0.0, np.ones(1), None, system.pack())
    np.testing.assert_allclose(found, np.linalg.solve(matrix, np.arange(1.0, n + 1)), rtol=1e-9)
