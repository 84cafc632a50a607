"""Newton's method with damping, and a homotopy where it does not arrive."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp

from acausal.homotopy import Residual, Solve, homotopy

TOLERANCE, STALLED = 1e-10, 1e-6
"""Relative size of the last step, and of one that rounding keeps from making the residual smaller."""

GOING, ARRIVED, STUCK = 0, 1, 2


def root(
    residual: Residual, guess: Any, solve: Solve, scale: Any = 1.0, max_steps: int = 300
) -> tuple[Any, Any]:
    """A root near a guess, and whether it was reached: by Newton's method, else along a homotopy.

    Arguments:
        solve: what Newton's method subtracts, from the Jacobian and the residuals.
        scale: typical magnitude of the unknowns, (m,) or one for all.
        max_steps: of Newton's method.
    """

    def attempt(state: Any) -> Any:
        _, _, k = state
        along = lambda: homotopy(residual, guess, solve, scale, skipped=k == 0)  # noqa: E731
        begin = jax.lax.cond(k == 0, lambda: guess, along)
        return *newton(residual, begin, solve, scale, max_steps), k + 1

    z, arrived, _ = jax.lax.while_loop(
        lambda state: ~state[1] & (state[2] < 2), attempt, (guess, jnp.array(False), 0)
    )
    return z, arrived


def newton(
    residual: Residual, guess: Any, solve: Solve, scale: Any = 1.0, max_steps: int = 300
) -> tuple[Any, Any]:
    """A root near a guess by Newton's method, and whether it was reached.

    A step that does not make the residual smaller is halved until it does; what is smaller is judged with
    every equation divided by its slopes, so that units do not matter. Where no part of the step helps, but
    the step is small, rounding is all that is left; otherwise the method is stuck. Arguments as in `root`.
    """

    def advance(state: Any) -> Any:
        z, r, _, k = state
        jacobian = jax.jacfwd(residual)(z)
        full = solve(jacobian, r)
        slopes = jnp.abs(jacobian) @ (jnp.abs(z) + scale)
        size = lambda r: _norm(r / jnp.where(slopes > 0, slopes, 1.0))  # noqa: E731

        def too_far(trial: Any) -> Any:
            dz, new = trial
            return ~(size(new) < size(r)) & ~_is_tiny(dz, z) & jnp.all(jnp.isfinite(dz))

        def halve(trial: Any) -> Any:
            return trial[0] / 2, residual(z - trial[0] / 2)

        dz, new = jax.lax.while_loop(too_far, halve, (full, residual(z - full)))
        stopped = _is_tiny(dz, z)
        arrived = _is_tiny(full, z) | (stopped & _is_tiny(full, z, STALLED))
        return z - dz, new, jnp.where(arrived, ARRIVED, jnp.where(stopped, STUCK, GOING)), k + 1

    def unfinished(state: Any) -> Any:
        _, r, status, k = state
        return (status == GOING) & jnp.any(r != 0) & (k < max_steps)

    start = guess, residual(guess), jnp.array(GOING), 0
    z, r, status, _ = jax.lax.while_loop(unfinished, advance, start)
    return z, (status == ARRIVED) | jnp.all(r == 0)


def _norm(v: Any) -> Any:
    return jnp.sqrt(jnp.sum(v * v))


def _is_tiny(step: Any, at: Any, tolerance: float = TOLERANCE) -> Any:
    return jnp.all(jnp.abs(step) < tolerance * (jnp.abs(at) + tolerance))
