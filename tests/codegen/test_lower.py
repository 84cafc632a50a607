"""Every rule from sympy to JAX against sympy's own numbers, with gradients."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.codegen.lower import RULES, ModuleValue, collect, evaluate
from acausal.modeling import COMPUTABLE, GivenModule, ModuleCall, Prescribed, functions

x, y = sp.symbols("x y", real=True)

SMOOTH = {
    "number": sp.Float(1.5) + 0 * x,
    "rational": x * sp.Rational(2, 3),
    "pi": x + sp.pi,
    "sum": x - 2 * y - 3 + y * x,
    "negative sum": -x - y,
    "product": -2 * x * y,
    "quotient": x / (y * (1 + x**2)),
    "reciprocal": -1 / x,
    "square": x**2 + y**-3,
    "root": sp.sqrt(x) + 1 / sp.sqrt(y) + sp.cbrt(x),
    "power": x**1.7 + y**-0.3 + x**y + 2**x,
    "exp": sp.exp(-x),
    "log": sp.log(x),
    "sin": sp.sin(x),
    "cos": sp.cos(x),
    "tan": sp.tan(x),
    "asin": sp.asin(x / 2),
    "asinh": sp.asinh(x),
    "acos": sp.acos(x / 2),
    "atan": sp.atan(x),
    "atan2": sp.atan2(x, y) + sp.atan2(-y, -x),
    "angle": ac.atan2(x, y) + ac.atan2(-y, -x),
    "sinh": sp.sinh(x),
    "cosh": sp.cosh(x),
    "tanh": sp.tanh(x),
}
KINKED = {
    "abs": functions.Abs(x - 1),
    "max": ac.maximum(x, y, 1),
    "min": ac.minimum(x, y - 1),
    "piecewise": ac.where(x > y, x**2, ac.where(x > 1, y, -x)),
    "and": sp.Piecewise((x, (x > 0.5) & (y > 0.5)), (y, True)),
    "or": sp.Piecewise((x, (x > 1.5) | (y > 1.5)), (y, True)),
    "nested": sp.Piecewise((x, sp.Piecewise((x, y > 0.5), (y, True)) > 0.7), (y, True)),
    "not": sp.Piecewise((x, sp.Not((x > 0.5) & (y > 0.5))), (y, True)),
    "relations": sum(
        sp.Piecewise((i * x, relation(x, y)), (y, True))
        for i, relation in enumerate([sp.Ge, sp.Gt, sp.Le, sp.Lt, sp.Ne, sp.Eq], start=1)
    ),
}
STEPPED = {
    "sign": functions.sign(x - 1),
    "floor": functions.floor(3 * x),
    "ceiling": sp.ceiling(3 * x),
    "mod": sp.Mod(3 * x, 1),
    "heaviside": sp.Heaviside(x - 1),
}
POINTS = np.array([[0.3, 0.7], [1.4, 0.6], [0.9, 1.8], [1.7, 1.6]])


def by_sympy(expression, points):
    return np.array([float(expression.subs({x: a, y: b}).evalf()) for a, b in points])


def by_jax(expression, points):
    value = jax.jit(lambda a, b: evaluate(expression, {x: a, y: b}))(*points.T)
    return np.broadcast_to(value, len(points))


@pytest.mark.parametrize("name", [*SMOOTH, *KINKED, *STEPPED])
def test_values(name):
    expression = {**SMOOTH, **KINKED, **STEPPED}[name]
    np.testing.assert_allclose(by_jax(expression, POINTS), by_sympy(expression, POINTS), rtol=1e-11)


@pytest.mark.parametrize("name", [*SMOOTH, *KINKED])
def test_gradients_agree_with_sympys_derivatives(name):
    expression = {**SMOOTH, **KINKED}[name]
    for symbol, column in ((x, 0), (y, 1)):
        point = {x: POINTS[:, 0], y: POINTS[:, 1]}
        total = lambda v: jnp.sum(evaluate(expression, {**point, symbol: v}) * jnp.ones(4))  # noqa: B023, E731
        ours = jax.jit(jax.grad(total))(POINTS[:, column])
        derivative = sp.diff(expression, symbol)
        np.testing.assert_allclose(ours, by_sympy(derivative, POINTS), rtol=1e-12, atol=1e-14)
        np.testing.assert_allclose(ours, by_jax(derivative, POINTS), rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("name", STEPPED)
def test_steps_have_no_derivative(name):
    if name == "mod":
        pytest.skip("a saw tooth has one")
    total = lambda v: jnp.sum(evaluate(STEPPED[name], {x: v}))  # noqa: E731
    assert jax.jit(jax.grad(total))(POINTS[:, 0]).tolist() == [0.0] * 4


def test_all_rules_are_tested():
    tested = {
        type(n) for e in {**SMOOTH, **KINKED, **STEPPED}.values() for n in sp.preorder_traversal(e)
    }
    used = {cls for t in tested for cls in t.__mro__}
    elsewhere = {GivenModule, ModuleCall, Prescribed, sp.DiracDelta, type(sp.false)}
    assert set(RULES) - used == elsewhere


def test_everything_that_may_stand_in_an_equation_has_a_rule():
    assert set(COMPUTABLE) <= set(RULES)
    exported = [getattr(ac, name) for name in ac.__all__ if name != "der"]
    classes = {f for f in exported if isinstance(f, type) and issubclass(f, sp.Function)}
    assert all(any(issubclass(f, known) for known in COMPUTABLE) for f in classes)


def test_scalars_stay_scalars_and_lengths_broadcast():
    assert jnp.shape(evaluate(x * y, {x: jnp.array(2.0), y: jnp.array(3.0)})) == ()
    assert evaluate(x * y, {x: jnp.arange(3.0), y: 2.0}).tolist() == [0.0, 2.0, 4.0]


def test_common_subexpressions_are_computed_once():
    shared = sp.sin(x + y)
    jaxpr = jax.make_jaxpr(lambda a, b: evaluate(shared**2 + shared * sp.exp(shared), {x: a, y: b}))
    assert str(jaxpr(1.0, 2.0)).count("sin") == 1


def test_unknown_functions_are_named():
    with pytest.raises(ac.ModelError, match="'gamma' cannot be computed"):
        evaluate(sp.gamma(x), {x: 1.0})


def test_a_case_that_does_not_hold_does_not_spoil_the_gradient():
    guarded = ac.where(x > 0, sp.sqrt(x) * y + sp.log(x), -x * y)
    derivative = jax.jit(jax.grad(lambda a, b: evaluate(guarded, {x: a, y: b}), argnums=(0, 1)))
    assert [float(g) for g in derivative(-4.0, 3.0)] == [-3.0, 4.0]
    assert [float(g) for g in derivative(4.0, 3.0)] == [1.0, 2.0]
    big = ac.where(x < 1, x, sp.exp(-x * 1000) + sp.exp(x))
    assert float(jax.jit(jax.grad(lambda a: evaluate(big, {x: a})))(-2.0)) == 1.0


def test_a_case_within_a_case_that_does_not_hold_does_not_spoil_the_gradient():
    nested = ac.where(y > 0, ac.where(x >= 0, sp.sqrt(x), -x), x)
    assert float(jax.jit(jax.grad(lambda a: evaluate(nested, {x: a, y: -1.0})))(0.0)) == 1.0


def test_cases_with_finite_derivatives_are_read_as_they_are():
    """No masks where none are needed: models of friction are conditions for the most part."""
    gentle = ac.where(x > 0, ac.sin(y) * x**2, ac.where(y > 0, ac.tanh(x), abs(y)))
    made = jax.make_jaxpr(lambda a, b: evaluate(gentle, {x: a, y: b}))(1.0, 2.0)
    names = [equation.primitive.name for equation in made.eqns]
    assert not {"and", "or", "not", "stop_gradient"} & set(names)
    assert str(made).count("jit[name=_where") == 2


def test_functions_of_real_numbers_are_differentiated_as_such():
    weird = functions.Abs(sp.log(x)) + functions.sign(sp.log(x)) * x
    expected = sp.sign(sp.log(x)) * (1 / x + 1)
    np.testing.assert_allclose(
        by_jax(sp.diff(weird, x), POINTS), by_sympy(expected, POINTS), rtol=1e-11
    )


def test_prescribed_signals_hand_on_their_derivatives():
    signal = ac.prescribed(x, y, x * y)
    assert evaluate(signal, {x: 2.0, y: 3.0}) == 2.0
    once = signal.fdiff(2)
    assert evaluate(once, {x: 2.0, y: 3.0}) == 3.0
    assert evaluate(once.fdiff(2), {x: 2.0, y: 3.0}) == 6.0
    assert signal.diff(x) == 0


# -- modules ------------------------------------------------------------------------------------------------


class Cubic(eqx.Module):
    a: jax.Array
    power: int = eqx.field(static=True, default=3)

    def __call__(self, v, w=0.0):
        return self.a * v**self.power + v * w**2


class Shifted(eqx.Module):
    a: jax.Array
    b: jax.Array

    def __call__(self, v):
        return self.a * v + self.b


def call(module, orders, *args):
    symbols = sp.symbols(f"v:{len(args)}", real=True)
    node = ModuleCall(sp.Symbol("net"), sp.Tuple(*orders), *symbols)
    return evaluate(node, {sp.Symbol("net"): module, **dict(zip(symbols, args, strict=True))})


def test_a_module_and_its_derivatives():
    cubic = ModuleValue(Cubic(jnp.array(2.0)))
    assert call(cubic, (0,), 3.0) == 54.0
    assert call(cubic, (1,), 3.0) == 54.0
    assert call(cubic, (2,), 3.0) == 36.0
    assert call(cubic, (1, 1), 3.0, 5.0) == 10.0
    np.testing.assert_allclose(call(cubic, (1,), jnp.array([1.0, 3.0])), [6.0, 54.0])


def test_alike_modules_are_stacked_unlike_ones_are_not():
    alike = collect([Cubic(jnp.array(1.0)), Cubic(jnp.array(2.0))])
    assert alike.stacked
    assert call(alike, (0,), jnp.array([2.0, 3.0])).tolist() == [8.0, 54.0]
    assert call(alike, (0,), 2.0).tolist() == [8.0, 16.0]
    for unlike in (
        [Cubic(jnp.array(1.0)), Cubic(jnp.array(2.0), power=2)],
        [Cubic(jnp.array(1.0)), Shifted(jnp.array(2.0), jnp.array(12.0))],
    ):
        value = collect(unlike)
        assert not value.stacked
        assert call(value, (0,), jnp.array([2.0, 3.0])).tolist() == [8.0, 18.0]
        assert call(value, (1,), jnp.array([2.0, 3.0])).tolist()[0] == 12.0


@pytest.mark.slow
def test_modules_with_plain_functions_inside():
    make = lambda seed: eqx.nn.MLP("scalar", "scalar", 4, 1, key=jax.random.key(seed))  # noqa: E731
    nets = [make(0), make(1)]
    value = collect(nets)
    assert value.stacked
    at = jnp.array([0.3, -0.4])
    expected = [float(net(v)) for net, v in zip(nets, at, strict=True)]
    np.testing.assert_allclose(call(value, (0,), at), expected, rtol=1e-12)


@pytest.mark.parametrize(
    ("net", "reason"),
    [
        (lambda x: 1j * x, "its result is complex"),
        (lambda x, y: x, "missing 1 required positional argument"),
        (lambda x: jnp.stack([x, x]), "cannot reshape array of shape"),
    ],
)
def test_what_is_no_network_is_named(net, reason):
    with pytest.raises(ac.ModelError, match=f"the network 'net' cannot be evaluated .*{reason}"):
        call(ModuleValue(net), (0,), 3.0)
