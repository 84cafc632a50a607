"""What sympy does once per template."""

import pytest
import sympy as sp

import acausal as ac
from acausal.flattening.template import Template, slot
from acausal.modeling import Abs, ModuleCall, floor, sign, time

x, y, z, p, q = (slot(n) for n in "xyzpq")


def template(residual, variables=(x, y), parameters=(p, q), modules=()):
    present = residual.free_symbols
    return Template(
        residual,
        tuple(v for v in variables if v in present),
        tuple(0 for v in variables if v in present),
        tuple(v for v in parameters if v in present),
        modules,
    )


# -- differentiating ------------------------------------------------------------------------------------


def test_the_total_derivative_and_where_its_slots_come_from():
    derivative, sources = template(p * x**2 + y + sp.sin(time)).differentiated()
    dx, dy = slot("x", 1), slot("y", 1)
    assert sp.expand(derivative.residual - (2 * p * x * dx + dy + sp.cos(time))) == 0
    assert dict(zip(derivative.variables, sources, strict=True)) == {
        x: (0, False),
        dx: (0, True),
        dy: (1, True),
    }
    assert derivative.parameters == (p, q)[:1]


def test_a_slot_and_its_derivative_in_one_equation_stay_apart():
    # in the slot der(x) may stand minus the derivative of x: its name must not be taken again
    dx = slot("x", 1)
    derivative, sources = template(x * dx, (x, dx)).differentiated()
    assert len(set(derivative.variables)) == len(derivative.variables) == len(sources)
    own = dict(zip(sources, derivative.variables, strict=True))
    assert sp.expand(derivative.residual - (own[0, True] * dx + x * own[1, True])) == 0


def test_differentiating_twice():
    second, _ = template(x**3, (x,)).differentiated()[0].differentiated()
    assert second.residual.subs({x: 2, slot("x", 1): 3}).subs(
        dict.fromkeys(second.residual.free_symbols - {x, slot("x", 1)}, 5)
    ) in {6 * 2 * 3 * 3 + 3 * 4 * 5, 6 * 2 * 3 * 5 + 3 * 4 * 5}


def test_modules_are_carried_along():
    net = sp.Symbol("net", real=True)
    call = ModuleCall(net, sp.Tuple(0), x)
    derivative, _ = template(y - call, modules=(net,)).differentiated()
    assert derivative.residual == slot("y", 1) - ModuleCall(net, sp.Tuple(1), x) * slot("x", 1)


# -- solving --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("residual", "expected"),
    [
        (x - y, y),
        (p * x + q * y + 1, (-q * y - 1) / p),
        (y * x - 1, 1 / y),
        (x * (p + y**2) - sp.sin(y), sp.sin(y) / (p + y**2)),
        (ac.where(y > 0, x, 2 * x) - 1, 1 / ac.where(y > 0, 1, 2)),
        (3 - x + Abs(y), 3 + Abs(y)),
    ],
)
def test_what_stands_linearly_is_solved_for(residual, expected):
    found = template(residual).solved(0)
    assert found is not None
    for at in ({y: 0.7}, {y: 1.9}):
        values = {**at, p: 1.3, q: 0.4}
        assert float((found - expected).subs(values)) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(
    "residual",
    [
        x**2 - y,
        sp.exp(x) - y,
        x * Abs(x) - y,
        x + ac.where(x > 0, 1, -1) - y,
        x + floor(x) - y,
        x + sign(x) - y,
        x + sp.Heaviside(x) - y,
        ac.where(x > 0, x, 2 * x) - y,
        ac.maximum(x, 0) - y,
        ModuleCall(sp.Symbol("net"), sp.Tuple(0), x) + x - y,
    ],
)
def test_what_does_not_is_left_to_a_loop(residual):
    assert template(residual).solved(0) is None
    assert not template(residual).is_safely_solvable(0)
    assert not template(residual).is_linear((0,))


def test_the_rest_may_have_a_pole_at_zero():
    assert template(x / (x + y) * (x + y) - p).solved(0) is not None
    found = template(x * y + sp.log(y) - p).solved(0)
    assert sp.simplify(found - (p - sp.log(y)) / y) == 0


@pytest.mark.parametrize(
    ("residual", "safe"),
    [
        (2 * x - y, True),
        (p * q * x - y, True),
        (x / p - y, True),
        (y * x - 1, False),
        (time * x - y, False),
        (ac.where(p > 0, x, 0) - y, False),
        (sp.cos(p) * x - y, False),
    ],
)
def test_safe_divisors_cannot_vanish_on_the_way(residual, safe):
    assert template(residual).is_safely_solvable(0) == safe


def test_linear_in_several_slots_together():
    assert template(p * x + q * y + time).is_linear((0, 1))
    assert template(x * y).is_linear((0,))
    assert not template(x * y).is_linear((0, 1))
    assert not template(x + ac.where(y > 0, 1, 2)).is_linear((0, 1))
