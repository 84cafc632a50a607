"""Solve torn algebraic blocks: linear ones directly, nonlinear ones by Newton with implicit gradients."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import optimistix as optx

Block = Callable[[Any], tuple[Any, Any]]
"""From tearing variables (m,) to all unknowns (n,) and residuals (m,)."""


def solve_linear(block: Block, guess: Any) -> Any:
    """Unknowns of a block that is affine in its tearing variables."""
    origin = jnp.zeros_like(guess)
    constant = block(origin)[1]
    matrix = jax.jacfwd(lambda tears: block(tears)[1])(origin)
    return block(-_solve(matrix, constant))[0]


def solve_nonlinear(block: Block, guess: Any) -> Any:
    """Unknowns of a nonlinear block near a guess; NaN where Newton's method does not converge.

    Gradients follow from the implicit function theorem.
    """
    solver = optx.Newton(rtol=1e-10, atol=1e-10)
    solution = optx.root_find(
        lambda tears, _: block(tears)[1], solver, guess, max_steps=100, throw=False
    )
    converged = solution.result == optx.RESULTS.successful
    return jnp.where(converged, block(solution.value)[0], jnp.nan)


def _solve(a: Any, b: Any) -> Any:
    """``a^-1 b``; spelled out for the small sizes where a library call costs more than the arithmetic."""
    match a.shape[0]:
        case 1:
            return b / a[0]
        case 2:
            determinant = a[0, 0] * a[1, 1] - a[0, 1] * a[1, 0]
            first = a[1, 1] * b[0] - a[0, 1] * b[1]
            second = a[0, 0] * b[1] - a[1, 0] * b[0]
            return jnp.stack([first, second]) / determinant
        case _:
            return jnp.linalg.solve(a, b)
