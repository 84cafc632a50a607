"""Newton's method for the stages of implicit Runge–Kutta schemes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
import optimistix as optx
from jax import Array

KAPPA = 0.01
"""How much of a step's tolerance the iteration may leave."""

SLOW = 0.1
"""Rate of convergence at which the Jacobian is renewed."""


class _Iteration(eqx.Module):
    """Where the iteration is: the factors of the Jacobian, and the sizes of the last two corrections."""

    factors: tuple[Array, Array]
    size: Array
    previous: Array
    renewed: Array
    count: Array

    @property
    def rate(self) -> Array:
        """How much smaller the last correction was than the one before."""
        return self.size / self.previous


class StageNewton(optx.AbstractRootFinder[Any, Any, Any, _Iteration]):
    """Newton's method with a Jacobian that is kept as long as the iteration converges fast.

    diffrax solves a stage for its slope, or its slope times the step; the tolerances are those of the state, so
    a correction counts by what it changes in the state. (`diffrax.VeryChord` takes them for tolerances of the
    slope; of a stiff model that is less than rounding leaves, and every step fails.)
    E. Hairer, G. Wanner: Solving Ordinary Differential Equations II, Springer 1996, section IV.8.

    Attributes:
        rtol, atol: tolerances of the state. norm: of corrections over tolerances.
        diverges: the rate of convergence at which the search is given up, so that a shorter step is tried;
            infinite where the step is fixed.
    """

    rtol: float
    atol: float
    norm: Callable[[Any], Any] = optx.max_norm
    diverges: float = 2.0

    def init(
        self,
        fn: Any,
        y: Array,
        args: Any,
        options: dict[str, Any],
        f_struct: Any,
        aux_struct: Any,
        tags: frozenset[object],
    ) -> _Iteration:
        """The start of an iteration, from the Jacobian at a point; diffrax hands it on to a step's other stages."""
        if "init_state" in options:
            return options["init_state"]
        infinite = jnp.full((), jnp.inf, y.dtype)
        return _Iteration(_factors(fn, y, args), infinite, infinite, jnp.array(False), jnp.array(0))

    def step(
        self,
        fn: Any,
        y: Array,
        args: Any,
        options: dict[str, Any],
        state: _Iteration,
        tags: frozenset[object],
    ) -> tuple[Array, _Iteration, Any]:
        """One correction."""
        renew = (state.count > 1) & (state.rate > SLOW)
        factors = jax.lax.cond(renew, lambda: _factors(fn, y, args), lambda: state.factors)
        residual, aux = fn(y, args)
        correction = jax.scipy.linalg.lu_solve(factors, residual)
        found = y - correction
        at, per_unit = _state(found, args)
        size = self.norm(correction * per_unit / (self.atol + self.rtol * jnp.abs(at)))
        return found, _Iteration(factors, size, state.size, renew, state.count + 1), aux

    def terminate(
        self,
        fn: Any,
        y: Array,
        args: Any,
        options: dict[str, Any],
        state: _Iteration,
        tags: frozenset[object],
    ) -> tuple[Array, optx.RESULTS]:
        """Whether the iteration has converged, or does not."""
        rate = state.rate
        left = jnp.where(rate < 1, state.size * rate / (1 - rate), state.size)
        converged = (state.count > 1) & (left < KAPPA)
        broken = (state.count > 0) & ~jnp.isfinite(state.size)
        failed = broken | (state.renewed & (rate > self.diverges))
        result = optx.RESULTS.where(
            failed, optx.RESULTS.nonlinear_divergence, optx.RESULTS.successful
        )
        return converged | failed, result

    def postprocess(
        self,
        fn: Any,
        y: Array,
        aux: Any,
        args: Any,
        options: dict[str, Any],
        state: _Iteration,
        tags: frozenset[object],
        result: optx.RESULTS,
    ) -> tuple[Array, Any, dict[str, Any]]:
        """The root as it is."""
        return y, aux, {}


def stage_newton() -> Any:
    """A `StageNewton` with the tolerances of the step-size controller."""
    return dfx.with_stepsize_controller_tols(StageNewton)()


def _factors(fn: Any, y: Array, args: Any) -> tuple[Array, Array]:
    jacobian = jax.jacfwd(lambda y: fn(y, args)[0])(y)
    return jax.scipy.linalg.lu_factor(jacobian)


def _state(y: Array, args: Any) -> tuple[Array, Array]:
    """The state of a stage, and what a unit of the stage's unknown is in it.

    The arguments are what diffrax gives the equations of a stage: for its slope, for its slope times the step,
    or for the whole step of the implicit Euler method.
    """
    match args:
        case _, diagonal, _, product, _, partial, _, control:
            per_unit = diagonal * product(jnp.ones_like(y), control)
        case _, diagonal, _, _, partial, _, _:
            per_unit = diagonal * jnp.ones_like(y)
        case _:
            partial, per_unit = args[2], jnp.ones_like(y)
    return partial + per_unit * y, per_unit
