"""Partial derivatives in numbers, without JAX."""

import cProfile
import pstats

import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.components import blocks
from acausal.flattening.flat_model import flatten
from acausal.flattening.template import Template, slot
from acausal.modeling import ModuleCall, time
from acausal.structure.jacobian import (
    TIME,
    Point,
    is_constant,
    parameter_values,
    partials,
    random_values,
)
from acausal.structure.reduced_model import reduce
from tests.support.parts import Equations

x, y, p, q, net = (slot(n) for n in ("x", "y", "p", "q", "net"))
AT = Point(np.array([2.0, 3.0, -1.0]), np.array([10.0, 20.0]))


def partial(residual, column=0):
    template = Template(residual, (x, y), (0, 0), (p, q), (net,))
    rows = np.array([[0, 1], [2, 0]])
    return partials(template, column, rows, np.array([[0, 1], [1, 0]]), AT)


@pytest.mark.parametrize(
    ("residual", "expected"),
    [
        (3 * x - y, [3.0, 3.0]),
        (p * x + q, [10.0, 20.0]),
        (x**2 * y, [12.0, -4.0]),
        (sp.sin(time) * x, [np.sin(TIME)] * 2),
        (ac.where(y > 2.5, x, -5 * x), [1.0, -5.0]),
        (ac.maximum(x, y), [0.0, 0.0]),
        (ac.Abs(x), [1.0, -1.0]),
        (ac.sign(x) + x, [1.0, 1.0]),
        (ac.floor(x) + 2 * x, [2.0, 2.0]),
        (sp.sqrt(x), [0.5 / np.sqrt(2), 1.0]),  # no number at -1: taken for some
        (ac.prescribed(x, y) * 0 + y * x, [3.0, 2.0]),
    ],
)
def test_partial_derivatives_at_a_point(residual, expected):
    np.testing.assert_allclose(partial(residual), expected, rtol=1e-12)


def test_a_long_equation_reads_a_few_values_for_each_derivative(monkeypatch):
    """Of alike terms the derivatives are alike, too: they are one function."""
    n, made = 40, []
    xs, ps = ([slot(f"{name}{i}") for i in range(n)] for name in "xp")
    residual = sp.Add(*(u * v for u, v in zip(xs, ps, strict=True)))
    template = Template(residual, tuple(xs), (0,) * n, tuple(ps), ())
    at = Point(np.arange(1.0, n + 1), np.arange(n) + 10.0)
    lambdify = sp.lambdify
    monkeypatch.setattr(sp, "lambdify", lambda *given: made.append(given[0]) or lambdify(*given))
    rows = np.arange(n)[None]
    found = [partials(template, column, rows, rows, at)[0] for column in range(n)]
    assert found == at.parameters.tolist()
    assert len(made) <= 1
    assert all(len(arguments) == 2 for arguments in made)  # time, and one parameter


@pytest.mark.slow
def test_the_work_for_a_transfer_function_is_in_proportion_to_its_coefficients():
    def calls(order):
        block = blocks.TransferFunction(a=1.0 + np.arange(order), b=[1.0, 2.0])
        with cProfile.Profile() as profile:
            reduce(flatten(block))
        return pstats.Stats(profile).total_calls

    calls(3)
    assert calls(160) < 9 * calls(40)  # in the square 16 times as many


def test_modules_have_a_partial_derivative_other_than_zero():
    assert (partial(ModuleCall(net, sp.Tuple(0), x) * y) != 0).all()


@pytest.mark.parametrize(
    ("residual", "expected"),
    [(p * x + y**2, True), (3 * x, True), (x * y, False), (x * time, False), (x**2, False)],
)
def test_constant(residual, expected):
    assert is_constant(Template(residual, (x, y), (0, 0), (p, q), ()), 0) == expected
    with_net = Template(ModuleCall(net, sp.Tuple(0), p) * x, (x,), (0,), (p,), (net,))
    assert not is_constant(with_net, 0)


def test_bound_parameters_have_values():
    class Box(ac.Component):
        c = ac.Parameter(3.0)
        zero = ac.Parameter(0.0)

        def __init__(self):
            super().__init__()
            self.parts = [Equations("x", lambda s: [ac.Eq(s.x, s.k)], k=1.0) for _ in range(3)]
            self.last = Equations("x", lambda s: [ac.Eq(s.x, s.k)], k=1.0)
            for i, part in enumerate(self.parts):
                part.modify(k=self.c * i + self.zero)
            self.last.modify(k=self.parts[2].k ** 2)

    flat = flatten(Box())
    names = [flat.layout.parameter(i) for i in range(len(flat.value))]
    values = dict(zip(names, parameter_values(flat).tolist(), strict=True))
    assert values == {
        "c": 3.0,
        "zero": 0.0,
        "parts[1].k": 0.0,
        "parts[2].k": 3.0,
        "parts[3].k": 6.0,
        "last.k": 36.0,
    }


def test_random_values_are_always_the_same():
    assert random_values(5).tolist() == random_values(5).tolist()
    assert (random_values(100) > 0).all()
