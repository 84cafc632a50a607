"""Solve torn algebraic blocks: linear ones directly, nonlinear ones by Newton with implicit gradients."""

from __future__ import annotations

from collections.abc import Callable

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal._jax import value_and_jacobian
from acausal.codegen.elimination import eliminate
from acausal.codegen.newton import Dense, Residual, root

FEW = 12
"""The most unknowns that are eliminated in array operations; more take XLA too long to compile."""

Block = Callable[[Array], tuple[Array, Array]]
"""From tearing variables (m,) to all unknowns (n,) and residuals (m,)."""


def solve_linear(
    block: Block, guess: Float[Array, " m"], scale: Float[Array, " m"] | float = 1.0
) -> Float[Array, " n"]:
    """Unknowns of a block that is affine in its tearing variables; ``guess`` gives their number."""
    origin = jnp.zeros_like(guess)

    def solve(residual: Residual, start: Array) -> Array:
        r, jacobian = value_and_jacobian(residual, start, axis=-1)
        return -_solve(jacobian, r)

    return block(jax.lax.custom_root(lambda z: block(z)[1], origin, solve, _tangent))[0]


def solve_nonlinear(
    block: Block, guess: Float[Array, " m"], scale: Float[Array, " m"] | float = 1.0
) -> Float[Array, " n"]:
    """Unknowns of a nonlinear block near a guess; NaN where Newton's method does not converge.

    Gradients follow from the implicit function theorem.
    """

    def residual(tears: Array) -> Array:
        return block(tears)[1]

    def solve(function: Residual, start: Array) -> Array:
        found, converged = root(Dense(function, _solve), start, scale)
        return jnp.where(converged, found, jnp.nan)

    return block(jax.lax.custom_root(residual, guess, solve, _tangent))[0]


def nearest(
    block: Block, guess: Float[Array, " m"], scale: Float[Array, " m"] | float = 1.0
) -> Float[Array, " m"]:
    """Tearing variables where the search for a root of a nonlinear block ends, whether or not they are a root."""
    return root(Dense(lambda tears: block(tears)[1], _solve), guess, scale)[0]


def _tangent(linear: Residual, y: Float[Array, " m"]) -> Float[Array, " m"]:
    """Where a linear function is ``y``: its derivatives are those of a root, by the implicit function theorem."""
    return _solve(jax.jacfwd(linear)(jnp.zeros_like(y)), y)


def _solve(a: Float[Array, "m m"], b: Float[Array, " m"]) -> Float[Array, " m"]:
    """``a^-1 b``; spelled out for the small sizes where a library call costs more than the arithmetic."""
    match a.shape[0]:
        case 1:
            return b / a[0]
        case 2:
            determinant = a[0, 0] * a[1, 1] - a[0, 1] * a[1, 0]
            first = a[1, 1] * b[0] - a[0, 1] * b[1]
            second = a[0, 0] * b[1] - a[1, 0] * b[0]
            return jnp.stack([first, second]) / determinant
        case n if n <= FEW:
            return eliminate(a, b)
        case _:
            return jnp.linalg.solve(a, b)
