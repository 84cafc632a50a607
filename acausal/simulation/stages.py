"""The stages of diagonally implicit Runge–Kutta steps."""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import without_derivatives
from acausal.codegen import StateJacobian
from acausal.simulation.newton import (
    KAPPA,
    Equation,
    Fields,
    Patience,
    State,
    Tolerances,
    solve,
)
from acausal.simulation.tableau import Tableau


class ImplicitScheme(eqx.Module):
    """How stages are found: by a tableau, with a Jacobian, to tolerances."""

    tableau: Tableau = eqx.field(static=True)
    jacobian: StateJacobian = eqx.field(static=True)
    tolerances: Tolerances
    patience: Patience = eqx.field(static=True)


class Stages(NamedTuple):
    """The stages of a step.

    Attributes:
        increments: the step times their derivatives, shape (n_stages, n_states); NaN where they are not found.
        done: whether they are. jacobians, corrections: what that has cost.
        factors: of the matrix that the last one was solved with.
    """

    increments: Float[Array, "n_stages n_states"]
    done: Bool[Array, ""]
    jacobians: Int[Array, ""]
    corrections: Int[Array, ""]
    factors: Any


class _Row(NamedTuple):
    """A stage: weights of the others, its own weight, its place in the step, and weights for a guess."""

    weights: Float[Array, " n_stages"]
    own: Float[Array, ""]
    fraction: Float[Array, ""]
    guess: Float[Array, " n_stages"]
    at: Int[Array, ""]


def stages(
    scheme: ImplicitScheme, fields: Fields, h: Array, x: State, first: State | None
) -> Stages:
    """The stages of a step of length h from x; ``first`` is the derivative there, if it is known."""
    tableau, jacobian = scheme.tableau, scheme.jacobian
    rows = _rows(tableau, x.dtype)
    increments = jnp.zeros((len(tableau.rows), *x.shape), x.dtype)
    if not tableau.diagonal[0]:
        increments = increments.at[0].set(h * (fields(0.0)(x) if first is None else first))

    def guess(row: _Row, increments: Array) -> State:
        return x + (row.weights + row.own * row.guess) @ increments

    def one(carry: tuple[Any, Any, Any], row: _Row) -> tuple[tuple[Any, Any, Any], None]:
        increments, factors, (done, jacobians, corrections) = carry
        known = x + row.weights @ increments
        equation = Equation(fields, row.fraction, row.own * h, known, x)
        how = scheme.tolerances, KAPPA, scheme.patience
        found = solve(equation, jacobian, factors, guess(row, increments), *how)
        increment = jnp.where(found.done, (found.x - known) / row.own, jnp.nan)
        cost = done & found.done, jacobians + found.jacobians, corrections + found.made
        return (increments.at[row.at].set(increment), found.factors, cost), None

    begin = _Row(*(part[0] for part in rows))
    fixed, at, c = without_derivatives((fields, guess(begin, increments), begin.own * h))
    factors = jacobian.factorized(fixed(begin.fraction), at, c)
    cost = jnp.array(True), jnp.ones((), jnp.int32), jnp.zeros((), jnp.int32)
    (increments, factors, cost), _ = lax.scan(one, (increments, factors, cost), rows)
    done, jacobians, corrections = cost
    return Stages(increments, done, jacobians, corrections, factors)


def _rows(tableau: Tableau, dtype: Any) -> _Row:
    """The implicit stages, one behind the other."""
    n, begin = len(tableau.rows), 0 if tableau.diagonal[0] else 1
    guesses = tableau.square(tableau.guesses) if tableau.guesses else np.eye(n, k=-1)
    parts = tableau.square(tableau.rows), tableau.diagonal, tableau.fractions, guesses
    weights, own, fraction, guess = (jnp.asarray(part[begin:], dtype) for part in parts)
    return _Row(weights, own, fraction, guess, jnp.arange(begin, n))
