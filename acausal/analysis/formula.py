"""Formulas: short sums of terms in one variable, which a model can hold in place of a network."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import sympy as sp
from jax import Array
from jax.typing import ArrayLike

NEAREST = 1e-12
"""Below this the root is cut off, where its slope has no bound."""


class Term(NamedTuple):
    """A term of a formula, without its coefficient.

    Attributes:
        value: of ``x / s``, given the array library to compute it with (`jax.numpy` or `numpy`) and ``x / s``.
        symbol: the same in sympy. scaled: whether ``s`` matters; of a power it is part of the coefficient.
    """

    value: Callable[[ModuleType, Any], Any]
    symbol: Callable[[Any], sp.Expr]
    scaled: bool


def _root(xp: ModuleType, x: Any) -> Any:
    return xp.sign(x) * xp.sqrt(xp.maximum(xp.abs(x), NEAREST))


TERMS: dict[str, Term] = {
    "constant": Term(lambda xp, x: xp.ones_like(x), lambda x: sp.Integer(1), False),
    "linear": Term(lambda xp, x: x, lambda x: x, False),
    "square": Term(lambda xp, x: x**2, lambda x: x**2, False),
    "cube": Term(lambda xp, x: x**3, lambda x: x**3, False),
    "signed square": Term(lambda xp, x: x * xp.abs(x), lambda x: x * sp.Abs(x), False),
    "signed root": Term(_root, lambda x: sp.sign(x) * sp.sqrt(sp.Abs(x)), False),
    "tanh": Term(lambda xp, x: xp.tanh(x), sp.tanh, True),
    "bump": Term(lambda xp, x: x * xp.exp(-(x**2)), lambda x: x * sp.exp(-(x**2)), True),
    "exponential": Term(lambda xp, x: xp.expm1(x), lambda x: sp.exp(x) - 1, True),
}
"""What a formula can be made of: powers, saturation, the Stribeck bump of friction, a diode's exponential."""


class Formula(eqx.Module):
    """``f(x) = Σ c_i term_i(x / s_i)``: a law that a neural element takes for its network, ``net=formula``.

    Its coefficients and scales are trained as weights are.

    Attributes:
        terms: names in `TERMS`.
        coefficients, scales: c and s, shape (number of terms,).
    """

    terms: tuple[str, ...] = eqx.field(static=True)
    coefficients: Array
    scales: Array

    def __call__(self, x: ArrayLike) -> Array:
        """The value for a scalar."""
        point = jnp.asarray(x, float)
        parts = zip(self.terms, self.scales, strict=True)
        values = [TERMS[name].value(jnp, point / scale) for name, scale in parts]
        return jnp.sum(self.coefficients * jnp.stack(values))

    def expression(self, x: sp.Expr | None = None) -> sp.Expr:
        """The formula in sympy, of a symbol (by default ``x``)."""
        symbol = sp.Symbol("x", real=True) if x is None else x
        parts = zip(self.terms, self.coefficients.tolist(), self.scales.tolist(), strict=True)
        return sp.Add(
            *(_number(c) * TERMS[name].symbol(symbol / _number(s)) for name, c, s in parts)
        )


def _number(value: float) -> sp.Expr:
    return sp.Integer(int(value)) if value == int(value) and abs(value) < 1e6 else sp.Float(value)
