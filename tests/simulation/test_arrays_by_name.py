"""Arrays by their own name: initial values, parameters, inputs and results."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.modeling.names import by_element, elements_of

K = np.array([1.0, 2.0, 3.0])
X0 = np.array([1.0, -2.0, 3.0])


class Three(ac.Component):
    """Three decays that are driven, and a matrix of their multiples."""

    k = ac.Parameter(K.tolist(), shape=3)
    u = ac.Input(shape=3)
    x = ac.Variable(start=1.0, shape=3)
    A = ac.Variable(shape=(2, 3))

    def equations(self) -> Iterator[ac.Eq]:
        for x, k, u in zip(self.x, self.k, self.u, strict=True):
            yield ac.Eq(ac.der(x), -k * x + u)
        for i, row in enumerate(self.A):
            for a, x in zip(row, self.x, strict=True):
                yield ac.Eq(a, (i + 1) * x)


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Three())


NO = {"u": np.zeros(3)}


@pytest.mark.slow
def test_a_whole_array_is_given_and_read(system: ac.System) -> None:
    run = ac.simulate(system, 1.0, inputs=NO, x0={"x": X0}, params={"k": tuple(2 * K)})
    exact = X0 * np.exp(-2 * K * run.t[:, None])
    np.testing.assert_allclose(run["x"], exact, atol=1e-5)
    assert run["A"].shape == (len(run.t), 2, 3)
    np.testing.assert_array_equal(run["A"][:, 1, 2], run["A[2,3]"])
    np.testing.assert_array_equal(run[["x[2]", "x[1]"]], run["x"][:, 1::-1])


@pytest.mark.slow
def test_lists_hold_anything_that_an_element_takes(system: ac.System) -> None:
    def end(k: jax.Array | float) -> jax.Array:
        run = ac.simulate(system, 1.0, dt=0.02, inputs=NO, x0={"x": X0}, params={"k": [k, 2, 3]})
        return run["x"][-1, 0]

    np.testing.assert_allclose(jax.grad(end)(1.0), -np.exp(-1), rtol=1e-5)
    functions = [jnp.sin, ac.Signal([0, 1], [2, 2]), 3.0]
    run = ac.simulate(system, 1.0, dt=0.02, inputs={"u": functions}, x0={"x": X0})
    np.testing.assert_allclose(run["u"][-1], [np.sin(1), 2, 3])


def test_elements_of_parts_are_no_array() -> None:
    known = ["cell[1].x[1]", "cell[2].x[1]", "x[1]", "x[2]", "y[2]"]
    assert elements_of("cell", known) is elements_of("y", known) is None
    assert elements_of("x", known).tolist() == ["x[1]", "x[2]"]
    rows = by_element({"x": ((1, 2),)}, ["x[1,1]", "x[1,2]"], "params")
    assert rows == {"x[1,1]": 1, "x[1,2]": 2}


@pytest.mark.parametrize(
    "u",
    [K, ([0.0, 2.0], [K, K]), np.tile(K, (5, 1)), {"u[1]": 1.0, "u[2]": 2.0, "u[3]": 3.0}],
    ids=["numbers", "times and samples", "samples", "elements"],
)
def test_inputs_of_every_form(system: ac.System, u: object) -> None:
    inputs = u if isinstance(u, dict) else {"u": u}
    run = ac.simulate(system, 1.0, dt=0.25, inputs=inputs, x0={"x": np.ones(3)})
    np.testing.assert_allclose(run["x"], 1.0, atol=1e-12)  # at rest
    np.testing.assert_array_equal(run["u"][-1], K)


def test_derivatives_by_an_array(system: ac.System) -> None:
    def end(k: jax.Array) -> jax.Array:
        run = ac.simulate(system, 1.0, dt=0.02, inputs=NO, x0={"x": X0}, params={"k": k})
        return jnp.sum(run["x"][-1])

    np.testing.assert_allclose(jax.grad(end)(jnp.asarray(K)), -X0 * np.exp(-K), rtol=1e-5)


@pytest.mark.slow
def test_a_record_and_a_point_of_rest(system: ac.System) -> None:
    record = ac.Data([0.0, 1.0], {"u[1]": [0, 1], "u[2]": [2, 3], "other": [0, 0]})
    np.testing.assert_array_equal(record["u"], [[0, 2], [1, 3]])
    rest = ac.operating_point(system, inputs={"u": K * X0})
    np.testing.assert_allclose(rest["x"], X0)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: ac.simulate(s, 1.0, inputs=NO, x0={"x": [1.0, 2.0]}),
         "x0: 'x' is an array of shape (3,); its values have the shape (2,)."),
        (lambda s: ac.simulate(s, 1.0, inputs=NO, x0={"x": X0, "x[1]": 1.0}),
         "x0: 'x[1]' is given twice, by itself and within its array."),
        (lambda s: ac.simulate(s, 1.0, inputs=NO, params={1: 1.0}), "params: 1 is not a name"),
        (lambda s: ac.operating_point(s, inputs={None: 1.0}), "inputs: None is not a name"),
        (lambda s: ac.simulate(s, 1.0, inputs=NO, params={"k": 1.0}),
         "params: 'k' is an array of shape (3,); its values have the shape ()."),
        (lambda s: ac.simulate(s, 1.0, inputs={"u": ([0.0, 1.0], [[1.0, 2.0], [1.0, 2.0]])}),
         "inputs: 'u' is an array of shape (3,); its values have the shape (2, 2)."),
        (lambda s: ac.simulate(s, 1.0, inputs=NO, x0={"x": [1.0, np.nan, 2.0]}), "x[2]"),
        (lambda s: ac.simulate(s, 1.0, inputs={"u": lambda t: np.zeros(3)}),
         "inputs: 'u' is an array of shape (3,); give a list of one for each element."),
        (lambda s: ac.simulate(s, 1.0, inputs={"u": [[0.0], [1.0, 2.0]]}),
         "inputs: 'u' is an array of shape (3,), not [[0.0], [1.0, 2.0]]."),
        (lambda s: ac.simulate(s, 1.0, inputs=NO)["y"], "The model has no variable 'y'"),
        (lambda s: ac.simulate(s, 1.0, inputs=NO)["x[4]"], "The model has no variable 'x[4]'"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_said(
    system: ac.System, call: Callable[[ac.System], object], message: str
) -> None:
    with pytest.raises(ac.DataError) as caught:
        call(system)
    assert message in str(caught.value)
