"""Models and networks as CasADi functions: the same values, and the same derivatives."""

import casadi as ca
import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical as el, neural
from examples.following_arm.model import Arm


class Circuit(ac.Component):
    """A source, a resistance and a neural capacitor; the source has a limit, and a table."""

    def __init__(self) -> None:
        super().__init__()
        self.source, self.ground = el.SignalVoltage(), el.Ground()
        self.resistor, self.coil = el.Resistor(R=2.0), el.Inductor(L=0.1)
        self.store = neural.Compliance(el.PositivePin, activation="tanh", width=5)
        self.connect(self.source.p, self.resistor.p)
        self.connect(self.resistor.n, self.coil.p)
        self.connect(self.coil.n, self.store.p)
        self.connect(self.store.n, self.source.n, self.ground.p)


class Functions(ac.Component):
    """Many functions in one equation."""

    x, u, y = ac.Variable(start=0.3), ac.Input(), ac.Variable()

    def equations(self):
        x, u = self.x, self.u
        terms = [
            ac.sin(x),
            ac.exp(-(x**2)),
            ac.tanh(u),
            ac.sqrt(1 + x**2),
            ac.atan2(x, 2),
            ac.log(2 + u**2),
        ]
        terms += [
            ac.where(x > u, x, u**3),
            ac.maximum(x, u),
            ac.minimum(x, 0.1),
            ac.sqrt((x - 1) ** 2),
            ac.cosh(x) / 3,
            x**-2,
        ]
        yield ac.Eq(ac.der(x), sum(terms) - x)
        yield ac.Eq(self.y, ac.where(ac.time < 1, 2 * x, u))


@pytest.mark.parametrize("model", [Arm(), Circuit(), Functions()], ids=lambda m: type(m).__name__)
def test_values_and_derivatives_are_those_of_the_model(model: ac.Component) -> None:
    system = ac.compile(model)
    names = system.variables[:6]
    function = ac.export.casadi(system, outputs=names)
    params = system.pack()
    rng = np.random.default_rng(0)
    x, u = rng.uniform(0.2, 1.0, len(system.states)), rng.uniform(0.2, 1.0, len(system.inputs))
    rates, y = (np.asarray(part).ravel() for part in function(0.3, x, u))
    both = jax.jit(lambda x: system.vector_field_and_observe(names, 0.3, x, u, params))
    for ours, theirs in zip((rates, y), both(x), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12)
    of = ca.SX.sym("x", len(x))
    slope = ca.Function("slope", [of], [ca.jacobian(function(0.3, of, u)[0], of)])(x)
    wanted = jax.jit(jax.jacfwd(lambda x: system.vector_field(0.3, x, u, params)))(x)
    np.testing.assert_allclose(slope, wanted, rtol=1e-10, atol=1e-12)


def test_a_network_alone_has_the_names_of_its_equation() -> None:
    system = ac.compile(Arm())
    law = ac.export.casadi(system, network="bearing.net")
    assert law.n_in() == law.n_out() == 1
    network = system.parameters()["bearing.net"]
    for w in (-3.0, 0.1):
        assert float(law(w)) == pytest.approx(float(network(w)), rel=1e-12)


def test_what_casadi_cannot_express_is_named() -> None:
    class Loop(ac.Component):
        x, z = ac.Variable(start=1.0), ac.Variable(start=1.0)

        def equations(self):
            yield ac.Eq(ac.der(self.x), -self.z)
            yield ac.Eq(self.z + ac.exp(self.z), self.x)

    with pytest.raises(
        ac.DataError, match=r"no counterpart of 'while'.*a nonlinear algebraic loop"
    ):
        ac.export.casadi(ac.compile(Loop()))
    with pytest.raises(ac.ModelError, match=r"export\.casadi"):
        ac.export.casadi(Arm())
    with pytest.raises(ac.ModelError, match=r"the model has no 'arm\.q'"):
        ac.export.casadi(ac.compile(Arm()), outputs=["arm.q"])


def test_products_reductions_and_loops() -> None:
    from acausal.export.casadi_function import Symbols, _elements, _objects, _Walk

    def function(a: jax.Array, b: jax.Array) -> tuple[jax.Array, ...]:
        carried, rows = jax.lax.scan(lambda c, r: (c * 0.5 + r.sum(), c - r[0]), a[0, 0], b)
        sums = a.sum(axis=1), a.max(axis=0), a.prod()
        return (
            a @ b,
            *sums,
            carried,
            rows,
            a[:, ::-1].T,
            jax.numpy.pad(a, 1),
            (3 * a).astype(int),
            jax.numpy.round(3 * a),
            (a > 0).astype(float),
            a[jax.numpy.array([1, 0, 1])],
        )

    rng = np.random.default_rng(1)
    a, b = rng.standard_normal((2, 3)), rng.standard_normal((3, 2))
    closed = jax.make_jaxpr(function)(a, b)
    columns = [ca.SX.sym("a", 6), ca.SX.sym("b", 6)]
    given = [_elements(c, s) for c, s in zip(columns, ((2, 3), (3, 2)), strict=True)]
    results = _Walk(ca).results(closed, given)
    for found, wanted in zip(results, function(a, b), strict=True):
        assert isinstance(found, Symbols)
        flat = ca.Function("f", columns, [ca.vertcat(*_objects(found).ravel().tolist())])(
            a.ravel(), b.ravel()
        )
        np.testing.assert_allclose(np.asarray(flat).reshape(wanted.shape), wanted, rtol=1e-12)
