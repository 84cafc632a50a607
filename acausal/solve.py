"""Solve torn algebraic blocks: linear ones directly, nonlinear ones by Newton with implicit gradients."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

TOLERANCE, STALLED = 1e-10, 1e-6
"""Relative size of the last step, and of one that rounding keeps from making the residual smaller."""

Block = Callable[[Any], tuple[Any, Any]]
"""From tearing variables (m,) to all unknowns (n,) and residuals (m,)."""
Residual = Callable[[Any], Any]


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

    def residual(tears: Any) -> Any:
        return block(tears)[1]

    def step(function: Residual) -> Callable[[Any, Any], Any]:
        return lambda z, r: _solve(jax.jacfwd(function)(z), r)

    def solve(function: Residual, start: Any) -> Any:
        root, converged = newton(function, start, step(function))
        return jnp.where(converged, root, jnp.nan)

    def tangent(linear: Residual, y: Any) -> Any:
        return step(linear)(jnp.zeros_like(y), y)

    return block(jax.lax.custom_root(residual, guess, solve, tangent))[0]


def newton(
    residual: Residual, guess: Any, step: Callable[[Any, Any], Any], max_steps: int = 300
) -> tuple[Any, Any]:
    """A root near a guess by Newton's method, and whether it was reached.

    A step that does not make the residual smaller is halved until it does. Where no part of it does, but the
    step is small, rounding is all that is left.

    Arguments:
        step: from the point and its residual, what Newton's method subtracts.
    """

    def advance(state: Any) -> Any:
        z, r, _, k = state
        full = step(z, r)

        def too_far(trial: Any) -> Any:
            dz, new = trial
            return ~(_size(new) < _size(r)) & ~_is_tiny(dz, z) & jnp.all(jnp.isfinite(dz))

        def halve(trial: Any) -> Any:
            return trial[0] / 2, residual(z - trial[0] / 2)

        dz, new = jax.lax.while_loop(too_far, halve, (full, residual(z - full)))
        stalled = _is_tiny(dz, z) & _is_tiny(full, z, STALLED)
        return z - dz, new, _is_tiny(full, z) | stalled, k + 1

    def unfinished(state: Any) -> Any:
        _, r, arrived, k = state
        return ~arrived & (_size(r) > 0) & (k < max_steps)

    start = guess, residual(guess), jnp.array(False), 0
    z, r, arrived, _ = jax.lax.while_loop(unfinished, advance, start)
    return z, arrived | (_size(r) == 0)


def _size(residual: Any) -> Any:
    return jnp.max(jnp.abs(residual), initial=0.0)


def _is_tiny(step: Any, at: Any, tolerance: float = TOLERANCE) -> Any:
    return jnp.all(jnp.abs(step) < tolerance * (jnp.abs(at) + tolerance))


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
