"""Arrays in equations: NumPy's operations on them, and what an equation of arrays stands for."""

import numpy as np
import pytest
import sympy as sp
from scipy.linalg import expm

import acausal as ac
from acausal.modeling import each

A, B = np.array([[0.0, 1.0], [-4.0, -0.4]]), np.array([0.0, 2.0])


class Linear(ac.Component):
    """``der(x) = A x + b u``, ``y = 2 A^T x``, and what is above a level."""

    A = ac.Parameter(A, shape=(":", ":"))
    b = ac.Parameter(B, shape=2)
    u = ac.Input()
    x = ac.Variable(shape=2, start=(1.0, 0.0), fixed=True)
    y = ac.Variable(shape=(2, 1))
    above = ac.Variable(shape=2)

    def equations(self):
        yield ac.Eq(ac.der(self.x), self.A @ self.x + self.b * self.u)
        yield ac.Eq(self.y, 2 * (self.A.T @ self.x)[:, np.newaxis])
        yield ac.Eq(self.above, ac.where((self.x > 0.1) & (self.x[0] < 2), ac.exp(self.x), 0))


class Slow(ac.Component):
    """A vector that doubles at an instant, and what it was then; a parameter times each of its elements."""

    k = ac.Parameter(0.5)
    x = ac.Variable(shape=3, start=(1.0, 2.0, 3.0), fixed=True)
    held = ac.Discrete(shape=3)

    def equations(self):
        yield ac.Eq(ac.der(self.x), -self.k * self.x)
        kept = ac.Eq(self.held, ac.pre(self.x))
        yield ac.When(ac.time > 1, [ac.Reinit(self.x, 2 * self.x), kept])


def test_a_linear_model_is_written_with_its_matrices():
    run = ac.simulate(ac.compile(Linear()), 2.0, inputs={"u": 0.0}, rtol=1e-9, atol=1e-12)
    x = expm(2 * A) @ [1, 0]
    np.testing.assert_allclose(run["x"][-1], x, atol=1e-8)
    np.testing.assert_allclose(run["y"][-1, :, 0], 2 * A.T @ x, atol=1e-8)
    np.testing.assert_allclose(run["above"][-1], np.where(x > 0.1, np.exp(x), 0), atol=1e-8)


def test_a_matrix_is_given_by_its_name_though_an_entry_is_folded():
    system = ac.compile(Linear())  # A[1,1] is zero, and no parameter
    other = [[0.0, 1.0], [-9.0, -0.2]]
    run = ac.simulate(system, 2.0, params={"A": other}, inputs={"u": 0.0}, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(run["x"][-1], expm(2 * np.array(other)) @ [1, 0], atol=1e-7)
    with pytest.raises(ac.DataError, match=r"^params: 'A\[1,1\]' was left at its default of zero"):
        system.pack({"A": [[0.5, 1.0], [-9.0, -0.2]]})


@pytest.mark.slow
def test_jumps_and_discrete_equations_of_vectors():
    run = ac.simulate(ac.compile(Slow()), 2.0, rtol=1e-9, atol=1e-12)
    at_event = np.exp(-0.5) * np.array([1.0, 2.0, 3.0])
    np.testing.assert_allclose(run["held"][-1], at_event, rtol=1e-7)
    np.testing.assert_allclose(run["x"][-1], 2 * np.exp(-0.5) * at_event, rtol=1e-7)


def test_a_rod_of_differences_is_the_one_of_a_loop():
    class Rod(ac.Component):
        T = ac.Variable(shape=4)
        ends = ac.Input(shape=2)

        def equations(self):
            T = np.concatenate([self.ends[:1], self.T, self.ends[1:]])
            yield ac.Eq(ac.der(self.T), T[2:] - 2 * T[1:-1] + T[:-2])

    rod = Rod()
    around = [rod.ends[0], *rod.T, rod.ends[1]]
    one_by_one = [ac.Eq(ac.der(T), around[i + 2] - 2 * T + around[i]) for i, T in enumerate(rod.T)]
    assert list(each(rod.equations())) == one_by_one


def test_elements_are_read_by_one_index_and_by_several():
    part = Linear()
    assert part.A[0, 1] is part.A[0][1] is [*part.A[0]][1]
    assert [part.A.shape, len(part.b), str(part.A[1, 0])] == [(2, 2), 2, "A[2,1]"]
    assert part.x @ part.x == part.x[0] ** 2 + part.x[1] ** 2
    assert isinstance(ac.sin(part.x)[0], sp.sin)
    with pytest.raises(ValueError, match="read-only"):
        part.x[0] = 1.0
    with pytest.raises(IndexError):
        part.A[2, 0]


@pytest.mark.parametrize(
    ("sides", "told"),
    [
        (lambda p: (p.x, p.b[:1]), r"an array of shape \(2,\) on the left and .* \(1,\) on the right"),
        (lambda p: (p.u, p.x), r"a single value on the left and an array of shape \(2,\) on the r"),
        (lambda p: (p.x, ["1", 2]), "right side is str '1'"),
    ],
)  # fmt: skip
def test_sides_that_do_not_fit_are_refused(sides, told):
    with pytest.raises(ac.DeclarationError, match=told):
        ac.Eq(*sides(Linear()))


def test_an_array_holds_its_elements_and_one_of_no_dimension_is_its_only_one():
    class One(ac.Component):
        x = ac.Variable(shape=(), start=1.0, fixed=True)

        def equations(self):
            yield ac.Eq(ac.der(self.x), -self.x)

    part = Linear()
    assert part.x[0] in part.x
    assert part.b[0] not in part.x
    assert ac.compile(One()).states == ("x",)


def test_an_array_is_neither_true_nor_false():
    with pytest.raises(ac.DeclarationError, match=r"use ac\.where"):
        bool(Linear().x > 0)


def test_a_model_with_matrices_is_written_as_modelica_and_read_again(tmp_path):
    system = ac.compile(Linear())
    again = ac.compile(ac.load(ac.export.modelica(system, tmp_path / "Linear.mo")))
    assert sorted(again.states) == sorted(system.states)
    x, u = np.array([0.5, -0.2]), np.array([0.3])
    rates = [s.rates(s.values(0.0, x, u, s.pack())) for s in (system, again)]
    np.testing.assert_allclose(*rates, rtol=1e-14)
