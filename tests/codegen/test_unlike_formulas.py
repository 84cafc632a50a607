"""Many unlike formulas that are computed together: the same values, derivatives, messages and C."""

from functools import partial
from itertools import combinations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.codegen import UnlikeFormulas, unlike_formulas
from tests.support.exported_c import ExportedC
from tests.support.parts import Equations

TERMS = (
    lambda s: s.x**3 - 2 * s.v,
    lambda s: -(s.x**2) * s.v / (1.7 + s.x**2),
    lambda s: ac.sin(s.a * ac.time) * s.x,
    lambda s: ac.where(s.x > 0.1 * s.a, ac.sqrt(s.x), s.v),
    lambda s: ac.atan2(s.x, s.v + 3) + ac.maximum(s.x, s.v),
    lambda s: 1 / (s.a + s.v**2) - ac.exp(-s.x),
    lambda s: ac.log(s.b + s.x) * s.u,
)
PAIRS = tuple(combinations(range(len(TERMS)), 2))
X, U = jnp.asarray([0.4, -0.3]), jnp.asarray([0.7])


def unlike():
    """A sum of laws of which no two are alike, and of a last one that reads others."""
    names = [f"y{i}" for i, _ in enumerate(PAIRS)]

    def equations(s):
        for name, (i, j) in zip(names, PAIRS, strict=True):
            yield ac.Eq(getattr(s, name), (i + 1) * TERMS[i](s) - 0.3 * TERMS[j](s))
        yield ac.Eq(s.last, s.y7 * s.y12)
        yield ac.Eq(ac.der(s.x), s.v - 0.01 * sum(getattr(s, n) for n in names))
        yield ac.Eq(ac.der(s.v), s.last - s.x)

    return Equations(f"x v {' '.join(names)} last", equations, inputs="u", a=1.3, b=2.0)


@pytest.fixture(scope="module")
def systems():
    """The model with its formulas together, and each for itself."""
    apart = ac.compile(unlike())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(unlike_formulas, "MANY_FORMULAS", len(PAIRS))
        together = ac.compile(unlike())
    return together, apart


@partial(jax.jit, static_argnums=0)
def rates(system, x, a):
    return system.vector_field(0.9, x, U, system.pack({"a": a}))


def test_there_are_fewer_operations_than_formulas(systems):
    (whole,) = (i for i in systems[0].program.instructions if isinstance(i, UnlikeFormulas))
    assert whole.size == len(PAIRS)
    nodes = sum(f.expression.count_ops() for f in whole.formulas)
    assert len(whole.operations) < nodes / 4
    assert not any(isinstance(i, UnlikeFormulas) for i in systems[1].program.instructions)


@pytest.mark.slow
def test_values_and_derivatives_are_those_of_the_formulas(systems):
    both = [jax.jit(jax.vmap(jax.jacrev(rates, (1, 2)), (None, 0, None)), static_argnums=0)] * 2
    points = jnp.asarray([[0.4, -0.3], [0.01, 0.5]])  # both cases of a condition
    together, apart = (f(s, points, 1.2) for f, s in zip(both, systems, strict=True))
    jax.tree.map(lambda a, b: np.testing.assert_allclose(a, b, rtol=1e-11), together, apart)
    values = [rates(s, X, 1.2) for s in systems]
    np.testing.assert_allclose(*values, rtol=1e-12)


@pytest.mark.slow
def test_people_read_formulas(systems):
    assert systems[0].equations == systems[1].equations
    with pytest.raises(ac.SimulationError, match=r"'y5' = .*log\(b \+ x\).* is nan"):
        ac.simulate(
            systems[0],
            1.0,
            dt=0.5,
            solver="euler",
            x0={"x": 0.4, "v": 0.0},
            inputs={"u": 0.7},
            params={"b": -3.0},
        )


def test_c_computes_them_together(systems, tmp_path):
    model = ExportedC(systems[0], tmp_path)
    model.x[:], model.u[:], model.time[:] = X, U, 0.9
    np.testing.assert_allclose(model.derivatives(), rates(systems[1], X, 1.3), rtol=1e-12)
