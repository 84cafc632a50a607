"""Newton's method for the stages of implicit Runge–Kutta schemes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
import optimistix as optx
from jaxtyping import Array, Bool, Float, Int, PyTree

from acausal.simulation.stage_arguments import KEPT, stage_of

Unknown: TypeAlias = Float[Array, " n_states"]
LUFactors: TypeAlias = tuple[Float[Array, "n_states n_states"], Int[Array, " n_states"]]
StageResidual: TypeAlias = Callable[[Unknown, PyTree], tuple[Unknown, PyTree]]
"""(unknown, arguments) -> residual and auxiliary output."""

KAPPA = 0.01
"""The part of a step's tolerance that may remain as error when the iteration stops."""

SLOW = 0.1
"""Rate of convergence at which the Jacobian is renewed."""


class _Iteration(eqx.Module):
    """The state of the iteration: the factors of the Jacobian, and the sizes of the last two corrections."""

    factors: LUFactors
    size: Float[Array, ""]
    previous: Float[Array, ""]
    renewed: Bool[Array, ""]
    count: Int[Array, ""]

    @property
    def rate(self) -> Float[Array, ""]:
        """The ratio of the last two corrections."""
        return self.size / self.previous


class StageNewton(optx.AbstractRootFinder[Any, Any, Any, _Iteration]):
    """Newton's method that reuses its Jacobian as long as the iteration converges fast.

    diffrax solves a stage for its derivative, or its derivative times the step. The tolerances are those of the state,
    so a correction is measured by the change of the state. (`diffrax.VeryChord` applies them to the derivative; for a
    stiff model that is below its rounding error, and every step fails.)
    E. Hairer, G. Wanner: Solving Ordinary Differential Equations II, Springer 1996, section IV.8.

    Attributes:
        rtol, atol: tolerances of the state. norm: of corrections over tolerances.
        diverges: the rate of convergence at which the iteration stops, so that a shorter step is tried;
            infinite where the step is fixed.
    """

    rtol: float
    atol: float
    norm: Callable[[PyTree], Float[Array, ""]] = optx.max_norm
    diverges: float = 2.0

    def init(
        self,
        fn: StageResidual,
        y: Unknown,
        args: PyTree,
        options: dict[str, Any],
        f_struct: PyTree,
        aux_struct: PyTree,
        tags: frozenset[object],
    ) -> _Iteration:
        """The start of an iteration, from the Jacobian at a point; diffrax reuses it for the other stages of a step."""
        if KEPT in options:
            return options[KEPT]
        infinite = jnp.full((), jnp.inf, y.dtype)
        return _Iteration(_factors(fn, y, args), infinite, infinite, jnp.array(False), jnp.array(0))

    def step(
        self,
        fn: StageResidual,
        y: Unknown,
        args: PyTree,
        options: dict[str, Any],
        state: _Iteration,
        tags: frozenset[object],
    ) -> tuple[Unknown, _Iteration, PyTree]:
        """One correction."""
        renew = (state.count > 1) & (state.rate > SLOW)
        factors = jax.lax.cond(renew, lambda: _factors(fn, y, args), lambda: state.factors)
        residual, aux = fn(y, args)
        correction = jax.scipy.linalg.lu_solve(factors, residual)
        found = y - correction
        stage = stage_of(found, args)
        allowed = self.atol + self.rtol * jnp.abs(stage.state)
        size = self.norm(correction * stage.per_unit / allowed)
        return found, _Iteration(factors, size, state.size, renew, state.count + 1), aux

    def terminate(
        self,
        fn: StageResidual,
        y: Unknown,
        args: PyTree,
        options: dict[str, Any],
        state: _Iteration,
        tags: frozenset[object],
    ) -> tuple[Bool[Array, ""], optx.RESULTS]:
        """Whether the iteration stops, and why: it has converged, or it diverges."""
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
        fn: StageResidual,
        y: Unknown,
        aux: PyTree,
        args: PyTree,
        options: dict[str, Any],
        state: _Iteration,
        tags: frozenset[object],
        result: optx.RESULTS,
    ) -> tuple[Unknown, PyTree, dict[str, Any]]:
        """The root as it is."""
        return y, aux, {}


def stage_newton() -> optx.AbstractRootFinder[Any, Any, Any, Any]:
    """A `StageNewton` with the tolerances of the step-size controller."""
    return dfx.with_stepsize_controller_tols(StageNewton)()


def _factors(fn: StageResidual, y: Unknown, args: PyTree) -> LUFactors:
    jacobian = jax.jacfwd(lambda y: fn(y, args)[0])(y)
    return jax.scipy.linalg.lu_factor(jacobian)
