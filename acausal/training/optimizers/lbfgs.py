"""L-BFGS whose line search takes one evaluation an update, so that a training's program holds the model once."""

from __future__ import annotations

from functools import cache
from typing import Any

import equinox as eqx
import jax.numpy as jnp
from jax import Array, lax
from jax.flatten_util import ravel_pytree

from acausal.training.optimizers.descent import Descent, DescentMethod

DECREASE, CURVATURE = 1e-4, 0.9
"""Wolfe's conditions: how much of the foreseen decrease, and how much less of the slope, ends a search."""

TRIALS = 20
"""Points on a line after which the search starts anew from the gradient alone."""

STALLED = 1e-12
"""Relative decrease of the loss below which the search is at its end."""

FIRST = 0.1
"""Length of the very first step."""


class Search(Descent):
    """Where L-BFGS is: the best point up to now, and the line from it along which it searches.

    Attributes:
        direction, slope: of the line, and of the loss along it.
        step, low, high: the trial's place on the line, and between which two the minimum lies.
        trials: on this line.
        moves, turns: the last changes of the point and of the gradient, newest last, shape (memory, P).
        count: how many of them there are.
    """

    direction: Array
    slope: Array
    step: Array
    low: Array
    high: Array
    trials: Array
    moves: Array
    turns: Array
    count: Array


@cache
def lbfgs(memory: int = 60) -> DescentMethod:
    """L-BFGS with a search for Wolfe's conditions by interpolation and bisection.

    An update takes the gradient and the loss (`value=...`) at one point. A point
    that serves becomes the new best, and the next one lies along a new direction; otherwise the next one
    is another on the same line. So the parameters between two updates may be worse than the best up to now.
    An infinite loss is taken for too long a step.

    J. Nocedal, S. Wright: Numerical Optimization, Springer 2006, algorithms 7.4 and 7.5; A. Lewis, M. Overton:
    Nonsmooth optimization via quasi-Newton methods, Mathematical Programming 141, 2013, algorithm 2.6.

    Arguments:
        memory: changes of the gradient from which the curvature is estimated.
    """

    def init(params: Any) -> Any:
        point, _ = ravel_pytree(params)
        zero, none = jnp.zeros((), point.dtype), jnp.zeros_like(point)
        infinite, rows = jnp.full_like(zero, jnp.inf), jnp.zeros((memory, point.size), point.dtype)
        count, no = jnp.zeros((), int), jnp.zeros((), bool)
        return Search(
            point, infinite, none, no, none, zero, zero, zero, infinite, count, rows, rows, count
        )

    def update(updates: Any, state: Any, params: Any = None, **told: Any) -> Any:
        point, unravel = ravel_pytree(params)
        gradient, _ = ravel_pytree(updates)
        state = _judge(state, point, told["value"], gradient)
        return unravel(state.point + state.step * state.direction - point), state

    return DescentMethod(init, update)


def _judge(state: Search, point: Array, value: Array, gradient: Array) -> Search:
    """What a trial leads to: a new line from it, another trial, or the same line anew."""
    first = ~jnp.isfinite(state.value)
    low_enough = value <= state.value + DECREASE * state.step * state.slope
    flat_enough = gradient @ state.direction >= CURVATURE * state.slope
    serves = jnp.isfinite(value) & (first | (low_enough & flat_enough))
    tried = state.trials + 1
    helps = (value < state.value) & (tried >= TRIALS)
    case = jnp.select([serves | helps, tried >= TRIALS], [0, 1], 2)
    return lax.switch(
        case,
        (
            lambda: _turn(_moved(state, point, value, gradient)),
            lambda: _turn(_forgotten(state)),
            lambda: _another(state, value, low_enough, tried),
        ),
    )


def _moved(state: Search, point: Array, value: Array, gradient: Array) -> Search:
    """The state at a new best point."""
    move, turn = point - state.point, gradient - state.gradient
    curved = move @ turn > 1e-10 * (turn @ turn)
    keep = curved & jnp.isfinite(state.value)

    stalled = jnp.isfinite(state.value) & (state.value - value <= STALLED * jnp.abs(state.value))

    def append(rows: Array, row: Array) -> Array:
        return jnp.where(keep, jnp.concatenate([rows[1:], row[None]]), rows)

    return eqx.tree_at(
        lambda s: (s.point, s.value, s.gradient, s.moves, s.turns, s.count, s.converged),
        state,
        (
            point,
            value,
            gradient,
            append(state.moves, move),
            append(state.turns, turn),
            jnp.where(keep, jnp.minimum(state.count + 1, len(state.moves)), state.count),
            stalled,
        ),
    )


def _forgotten(state: Search) -> Search:
    """The same point without its past; where there was none, the search is at its end."""
    return eqx.tree_at(
        lambda s: (s.count, s.converged), state, (jnp.zeros_like(state.count), state.count == 0)
    )


def _another(state: Search, value: Array, low_enough: Array, tried: Array) -> Search:
    """Another trial on the same line: longer, or between the two that enclose the minimum."""
    low = jnp.where(low_enough, state.step, state.low)
    high = jnp.where(low_enough, state.high, state.step)
    bow = value - state.value - state.step * state.slope
    parabola = -0.5 * state.slope * state.step**2 / jnp.where(bow > 0, bow, 1.0)
    from_start = jnp.clip(
        jnp.where((bow > 0) & jnp.isfinite(bow), parabola, 0.0), 0.1 * high, 0.5 * high
    )
    inside = jnp.where(low == 0, from_start, 0.5 * (low + high))
    step = jnp.where(jnp.isfinite(high), inside, 2 * low)
    return eqx.tree_at(lambda s: (s.step, s.low, s.high, s.trials), state, (step, low, high, tried))


def _turn(state: Search) -> Search:
    """A new line from the best point."""
    direction = -_times_inverse_curvature(state)
    slope = direction @ state.gradient
    known = state.count > 0
    length = jnp.sqrt(direction @ direction)
    step = jnp.where(known, 1.0, FIRST / jnp.maximum(length, jnp.finfo(length.dtype).tiny))
    zero = jnp.zeros_like(step)
    return eqx.tree_at(
        lambda s: (s.direction, s.slope, s.step, s.low, s.high, s.trials),
        state,
        (direction, slope, step, zero, jnp.full_like(step, jnp.inf), jnp.zeros_like(state.trials)),
    )


def _times_inverse_curvature(state: Search) -> Array:
    """The gradient times the estimated inverse of the Hessian, by the two-loop recursion."""
    memory = len(state.moves)
    counts = jnp.arange(memory) >= memory - state.count
    product = jnp.sum(state.moves * state.turns, axis=1)
    inverse = jnp.where(counts, 1.0 / jnp.where(counts, product, 1.0), 0.0)

    def back(q: Array, row: tuple[Array, Array, Array]) -> tuple[Array, Array]:
        move, turn, rho = row
        alpha = rho * (move @ q)
        return q - alpha * turn, alpha

    def forth(q: Array, row: tuple[Array, Array, Array, Array]) -> tuple[Array, None]:
        move, turn, rho, alpha = row
        return q + (alpha - rho * (turn @ q)) * move, None

    rows = (state.moves, state.turns, inverse)
    q, alphas = lax.scan(back, state.gradient, rows, reverse=True)
    last = state.turns[-1]
    scale = jnp.where(state.count > 0, product[-1] / jnp.maximum(last @ last, 1e-300), 1.0)
    return lax.scan(forth, scale * q, (*rows, alphas))[0]
