"""L-BFGS whose line search takes one evaluation an update, so that a training's program holds the model once.

``python -m benchmarks.optimizers`` trains the quarter vehicle with it and with others (optimistix 0.1.0, optax 0.2.8).
After as many updates over the whole record, the loss of `optimistix.LBFGS` is 1.003 times ours (median of five seeds),
in the same time; to find seven parameters it takes 1.2 to 1.7 times the updates. `optax.lbfgs` reaches the same losses
in 4 to 15 times the seconds, since its line search evaluates the model again, and takes 3 times as long to compile.
`optimistix.BFGS` reaches 0.99 times the loss in the same time, but holds a square matrix: of 3.3 MB for the 643 weights
here; of 3000 weights its part of an update takes 6 times as long as ours.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import jax
import jax.numpy as jnp
from jax import lax
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import Descent, DescentMethod

DECREASE, CURVATURE = 1e-4, 0.9
"""Wolfe's conditions: the share of the decrease by the directional derivative that the loss must fall by, and the share
of the directional derivative that may be left."""

TRIALS = 20
"""Points on a line after which the search restarts along the negative gradient."""

STALLED = 1e-12
"""Relative decrease of the loss below which the search has converged."""

FIRST, SHARE = 1e-3, 0.01
"""Length of the very first trial, and the share of the loss by which the slope lets it fall there, at most.

So it does no harm at a good start. The slopes at its two ends tell the curvature, which makes the second trial as long
as the loss permits."""

STRETCH = 100.0
"""The most by which the trial after the very first one is longer than that; a later one is twice as long."""


class Search(Descent):
    """State of L-BFGS: the best point up to now, and the line from it along which it searches.

    Attributes:
        gradient: at the best point.
        direction: of the line; ``derivative``: of the loss along it, at the best point.
        step, low, high: the trial's place on the line, and the two places that enclose the minimum.
        trials: on this line.
        moves, changes: the last differences of points and of gradients, newest last.
        count: how many of them there are.
    """

    gradient: Float[Array, " n"]
    direction: Float[Array, " n"]
    derivative: Float[Array, ""]
    step: Float[Array, ""]
    low: Float[Array, ""]
    high: Float[Array, ""]
    trials: Int[Array, ""]
    moves: Float[Array, "memory n"]
    changes: Float[Array, "memory n"]
    count: Int[Array, ""]


@cache
def lbfgs(memory: int = 60) -> DescentMethod:
    """L-BFGS with a line search for Wolfe's conditions by interpolation and bisection.

    An update takes the gradient and the loss (`value=...`) at one point. A point that meets the conditions becomes the
    best, and the next point lies along a new direction; otherwise the next point is another one on the same line. So
    the parameters between two updates may be worse than the best up to now. An infinite loss counts as too long a step.

    J. Nocedal, S. Wright: Numerical Optimization, Springer 2006, algorithms 7.4 and 7.5; A. Lewis, M. Overton:
    Nonsmooth optimization via quasi-Newton methods, Mathematical Programming 141, 2013, algorithm 2.6.

    Arguments:
        memory: changes of the gradient from which the Hessian is estimated.
    """

    @jax.jit
    def init(params: Any) -> Any:
        point, _ = ravel_pytree(params)
        zero, none = jnp.zeros((), point.dtype), jnp.zeros_like(point)
        infinite, rows = jnp.full_like(zero, jnp.inf), jnp.zeros((memory, point.size), point.dtype)
        count, no = jnp.zeros((), int), jnp.zeros((), bool)
        return Search(
            point, infinite, no, none, none, zero, zero, zero, infinite, count, rows, rows, count
        )

    def update(updates: Any, state: Any, params: Any = None, **extra: Any) -> Any:
        point, unravel = ravel_pytree(params)
        gradient, _ = ravel_pytree(updates)
        state = _after_trial(state, point, extra["value"], gradient)
        return unravel(state.point + state.step * state.direction - point), state

    return DescentMethod(init, update)


def _after_trial(
    state: Search, point: Float[Array, " n"], value: Float[Array, ""], gradient: Float[Array, " n"]
) -> Search:
    """The state after a trial: a new line from it, another trial on the same line, or a restart."""
    first = ~jnp.isfinite(state.value)
    low_enough = value <= state.value + DECREASE * state.step * state.derivative
    flat_enough = gradient @ state.direction >= CURVATURE * state.derivative
    accepted = jnp.isfinite(value) & (first | (low_enough & flat_enough))
    tried = state.trials + 1
    helps = (value < state.value) & (tried >= TRIALS)
    case = jnp.select([accepted | helps, tried >= TRIALS], [0, 1], 2)
    return lax.switch(
        case,
        (
            lambda: _new_line(_accept(state, point, value, gradient)),
            lambda: _new_line(_restart(state)),
            lambda: _next_trial(state, value, gradient @ state.direction, low_enough, tried),
        ),
    )


def _accept(
    state: Search, point: Float[Array, " n"], value: Float[Array, ""], gradient: Float[Array, " n"]
) -> Search:
    """The state at a new best point."""
    move, change = point - state.point, gradient - state.gradient
    curved = move @ change > 1e-10 * (change @ change)
    keep = curved & jnp.isfinite(state.value)

    stalled = jnp.isfinite(state.value) & (state.value - value <= STALLED * jnp.abs(state.value))

    def append(rows: Array, row: Array) -> Array:
        return jnp.where(keep, jnp.concatenate([rows[1:], row[None]]), rows)

    return replace(
        state,
        point=point,
        value=value,
        gradient=gradient,
        moves=append(state.moves, move),
        changes=append(state.changes, change),
        count=jnp.where(keep, jnp.minimum(state.count + 1, len(state.moves)), state.count),
        converged=stalled,
    )


def _restart(state: Search) -> Search:
    """The same point without the differences before it; where there were none, the search has converged."""
    return replace(state, count=jnp.zeros_like(state.count), converged=state.count == 0)


def _next_trial(
    state: Search,
    value: Float[Array, ""],
    slope: Float[Array, ""],
    low_enough: Bool[Array, ""],
    tried: Int[Array, ""],
) -> Search:
    """Another trial on the same line: a longer step, or one between the two places that enclose the minimum."""
    low = jnp.where(low_enough, state.step, state.low)
    high = jnp.where(low_enough, state.high, state.step)
    excess = value - state.value - state.step * state.derivative
    parabola = -0.5 * state.derivative * state.step**2 / jnp.where(excess > 0, excess, 1.0)
    from_start = jnp.clip(
        jnp.where((excess > 0) & jnp.isfinite(excess), parabola, 0.0), 0.1 * high, 0.5 * high
    )
    between = jnp.where(high > 4 * low, jnp.sqrt(low * high), 0.5 * (low + high))
    inside = jnp.where(low == 0, from_start, between)
    flattened = slope / state.derivative
    secant = jnp.where(flattened < 1, low / jnp.where(flattened < 1, 1 - flattened, 1.0), jnp.inf)
    very_first = (state.count == 0) & (state.low == 0)
    longer = jnp.where(very_first, jnp.clip(secant, 2 * low, STRETCH * low), 2 * low)
    step = jnp.where(jnp.isfinite(high), inside, longer)
    return replace(state, step=step, low=low, high=high, trials=tried)


def _new_line(state: Search) -> Search:
    """A new line from the best point, along the quasi-Newton direction."""
    direction = -_times_inverse_hessian(state)
    derivative = direction @ state.gradient
    scaled = state.count > 0
    length = jnp.maximum(jnp.sqrt(direction @ direction), jnp.finfo(direction.dtype).tiny)
    share = jnp.where(state.value > 0, SHARE * state.value / length, jnp.inf)
    step = jnp.where(scaled, 1.0, jnp.minimum(FIRST, share) / length)
    zero = jnp.zeros_like(step)
    return replace(
        state,
        direction=direction,
        derivative=derivative,
        step=step,
        low=zero,
        high=jnp.full_like(step, jnp.inf),
        trials=jnp.zeros_like(state.trials),
    )


def _times_inverse_hessian(state: Search) -> Float[Array, " n"]:
    """The gradient times the estimated inverse of the Hessian, by the two-loop recursion."""
    memory = len(state.moves)
    counts = jnp.arange(memory) >= memory - state.count
    product = jnp.sum(state.moves * state.changes, axis=1)
    inverse = jnp.where(counts, 1.0 / jnp.where(counts, product, 1.0), 0.0)

    def backward(q: Array, row: tuple[Array, Array, Array]) -> tuple[Array, Array]:
        move, change, rho = row
        alpha = rho * (move @ q)
        return q - alpha * change, alpha

    def forward(q: Array, row: tuple[Array, Array, Array, Array]) -> tuple[Array, None]:
        move, change, rho, alpha = row
        return q + (alpha - rho * (change @ q)) * move, None

    rows = (state.moves, state.changes, inverse)
    q, alphas = lax.scan(backward, state.gradient, rows, reverse=True)
    last = state.changes[-1]
    scale = jnp.where(state.count > 0, product[-1] / jnp.maximum(last @ last, 1e-300), 1.0)
    return lax.scan(forward, scale * q, (*rows, alphas))[0]
