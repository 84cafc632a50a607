"""Formulas: short sums of terms in one variable, which can replace a network in a model."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import NamedTuple, TypeAlias

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import sympy as sp
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal.networks import check_inputs

NEAREST = 1e-12
"""The root is constant below this, where its derivative would be unbounded."""


AnyArray: TypeAlias = Array | np.ndarray


class Term(NamedTuple):
    """A term of a formula, without its coefficient.

    Attributes:
        value: of ``x / s``, given the array library to compute it with (`jax.numpy` or `numpy`) and ``x / s``.
        symbol: the same in sympy.
        scaled: whether the term has a scale ``s``; the scale of a power is part of its coefficient.
    """

    value: Callable[[ModuleType, AnyArray], AnyArray]
    symbol: Callable[[sp.Expr], sp.Expr]
    scaled: bool


def _root(xp: ModuleType, x: AnyArray) -> AnyArray:
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
    """``f(x) = Σ c_i term_i(x / s_i)``: a law that can be the network of a neural element, ``net=formula``.

    Its coefficients and scales can be trained, like weights.

    Attributes:
        terms: names in `TERMS`.
        coefficients, scales: c and s, shape (number of terms,).
    """

    terms: tuple[str, ...] = eqx.field(static=True)
    coefficients: Float[Array, " n_terms"]
    scales: Float[Array, " n_terms"]

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The value for a scalar."""
        check_inputs(self, inputs, 1)
        point = jnp.asarray(inputs[0], float)
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
