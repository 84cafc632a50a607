"""Short formulas for learned laws."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.analysis.distillation import TERMS
from acausal.components import neural, translational as tl

X = sp.Symbol("x", real=True)


def friction(v: Any) -> Any:
    """Coulomb and viscous friction with a Stribeck bump."""
    return 824.36 * v * jnp.exp(-1250 * v**2) + 30 * jnp.tanh(500 * v) + 150 * v


@pytest.mark.cases(fast=1, slow=5)
@pytest.mark.parametrize(
    ("law", "interval", "terms", "derivatives"),
    [
        (lambda v: 30 * jnp.tanh(v / 0.002) + 150 * v, (-0.3, 0.3), 2, {0.1: 150}),
        (friction, (-0.3, 0.3), 3, {0.2: 150}),
        (lambda s: 368449.0 * s**2 + 5747.8 * s, (-0.02, 0.02), 2, {0.0: 5747.8}),
        (lambda h: 0.5 * jnp.sqrt(h), (0.0, 10.0), 1, {4.0: 0.125}),
        (lambda v: 1e-9 * jnp.expm1(v / 0.04), (-0.2, 0.7), 1, {0.0: 2.5e-8}),
        (lambda x: 80 * x**3 - 2.0, (-0.7, 0.7), 2, {0.5: 60}),
    ],
    ids=["coulomb", "stribeck", "progressive", "outflow", "diode", "hardening"],
)
def test_laws_of_physics_are_found_again(law, interval, terms, derivatives):
    found = ac.distill(law, *interval)
    assert len(found.formula.terms) == terms
    assert found.relative_error < 1e-4
    for at, derivative in derivatives.items():
        assert float(sp.diff(found.expression, X).subs(X, at)) == pytest.approx(
            derivative, rel=1e-3
        )


@pytest.mark.slow
def test_formula_expression_and_search_agree():
    points = np.linspace(-1.5, 1.5, 7)
    for name in TERMS:
        formula = ac.Formula((name,), jnp.asarray([2.5]), jnp.asarray([0.5]))
        values = np.asarray(jax.jit(jax.vmap(formula))(points))
        exact = [float(formula.expression().subs(X, p)) for p in points]
        np.testing.assert_allclose(values, exact, atol=1e-5, err_msg=name)
        np.testing.assert_allclose(values, 2.5 * TERMS[name].value(np, points / 0.5), atol=1e-5)
        assert np.isfinite(jax.jit(jax.grad(formula))(0.0)), name


def test_a_bent_line_is_no_wide_exponential():
    """``144 exp(0.02 x) - 144`` is a line and a square, and says less."""
    found = ac.distill(lambda x: 3 * x + 0.03 * x**2 + 0.03 * jnp.sin(7 * x), -1.57, 1.51)
    assert set(found.formula.terms) == {"linear", "square"}
    assert found.relative_error < 0.01


def test_noise_is_not_fitted():
    wiggles = np.random.default_rng(0).standard_normal(12)

    def law(x: Any) -> Any:
        ripple = sum(a * jnp.sin(20 * (i + 1) * x) for i, a in enumerate(wiggles))
        return 5 * x + 0.02 * ripple

    found = ac.distill(law, -1.0, 1.0)
    assert found.formula.terms == ("linear",)
    assert 0.01 < found.error < 0.1
    assert "5" in repr(found)


def test_a_formula_takes_the_place_of_a_network():
    class Slide(ac.Component):
        def __init__(self, law: Any) -> None:
            super().__init__()
            self.ground, self.damper = tl.Fixed(), neural.Resistance(net=law)
            self.mass = tl.Mass(m=2.0, v=ac.Start(1.0, fixed=True), s=ac.Start(0.0, fixed=True))
            self.connect(self.ground.flange, self.damper.flange_a)
            self.connect(self.damper.flange_b, self.mass.flange_a)

    formula = ac.distill(lambda v: 4.0 * v, -1.0, 1.0).formula
    system = ac.compile(Slide(formula))
    solution = ac.simulate(system, (0.0, 1.0), dt=1e-3, solver="rk4")
    assert float(solution["mass.v"][-1]) == pytest.approx(np.exp(-2.0), rel=1e-6)


@pytest.mark.slow
def test_the_law_of_an_energy_is_distilled():
    element = neural.Compliance(energy=True, input_scale=0.1, output_scale=10.0)

    class Hung(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.ground, self.spring, self.mass = tl.Fixed(), element, tl.Mass(m=1.0)
            self.connect(self.ground.flange, self.spring.flange_a)
            self.connect(self.spring.flange_b, self.mass.flange_a)

    network = ac.compile(Hung()).parameters(1)["spring.net"]
    found = ac.distill(network, -0.1, 0.1, terms=2)
    off = jax.jit(jax.vmap(lambda x: network.law(x) - found.formula(x)))
    miss = np.asarray(off(np.linspace(-0.1, 0.1, 401)))
    assert np.sqrt(np.mean(miss**2)) == pytest.approx(found.error, rel=1e-3)


@pytest.mark.parametrize(
    ("chosen", "sentence"),
    [
        ({"low": 1.0, "high": 1.0}, "distill: 1 to 1 is not an interval; give low < high."),
        ({"low": "a"}, "distill: low='a'; give a finite number."),
        ({"tolerance": None}, "distill: tolerance=None; give a finite number."),
        ({"terms": 0}, "distill: terms=0; give a whole number, 1 or more."),
        ({"terms": "x"}, "distill: terms='x'; give a whole number, 1 or more."),
        ({"among": 3}, "among: 3 is not a name; give a text such as 'mass.s', or a list."),
        ({"among": ["tan"]}, "distill: there is no term 'tan': did you mean 'tanh'?"),
        ({"network": lambda x, T: x * T}, "distill: the network is not a law of one variable"),
        ({"network": lambda x: jnp.log(x)}, "distill: the network is not finite everywhere"),
    ],
)
def test_mistakes_get_one_sentence(chosen, sentence):
    given = {"network": lambda x: 2 * x, "low": -1.0, "high": 1.0} | chosen
    with pytest.raises((ac.TrainingError, ac.DataError)) as error:
        ac.distill(**given)
    assert str(error.value).startswith(sentence)
    assert "\n" not in str(error.value)


def test_small_units_are_no_obstacle():
    """What is above all no warning, which is an error in tests."""
    short = ac.distill(lambda x: 2e6 * x**3, 1e-6, 1e-5)
    assert str(short.formula.expression()) == "2000000.0*x**3"
    falling = ac.distill(lambda x: jnp.exp(-x / 50), 10_000.0, 20_000.0)
    assert np.isfinite(falling.error)
