"""Roots near a guess: Newton's method with damping, and a path to follow where that does not converge.

The path is Newton's homotopy ``residual(z) = (1 - s) residual(guess)``: at s = 0 the guess solves it, at s = 1 a
root does. It is followed by its length, so that it may turn back in s on its way. Newton's method alone is the
case of a path point with s = 1, found along the direction of z.
E. Allgower, K. Georg: Introduction to Numerical Continuation Methods, SIAM 2003, chapters 2 and 6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float

from acausal._jax import value_and_jacobian

Tolerance = dict[str, float]
"""By precision."""
TOLERANCE: Tolerance = {"float64": 1e-10, "float32": 1e-5}
STALLED: Tolerance = {"float64": 1e-6, "float32": 1e-3}
"""Relative size of the last step, and of a step that is accepted although roundoff stalls descent.

The last step changes what is computed from the unknowns by less than the latter: what is left is about its square.
"""
ROUNDED: Tolerance = {"float64": 1e-15, "float32": 5e-7}
"""Relative size of a step that only rounds the unknowns."""
UNSURE: Tolerance = {"float64": 1e-3, "float32": 1e-2}
"""How much of anything computed, plus one, a step may change that is accepted although descent stalls."""
SHRINKS = 0.9
"""A small step goes along a stair of rounded residuals if neither it nor they are this much smaller than before."""
FIRST, SHORTEST = 0.1, 1e-7
"""Of the path: the first stride, and the shortest one before the search gives up."""
STRIDES, CORRECTIONS = 400, 12
"""Of the path: most strides, and Newton steps after each."""
STRAIGHT = 0.7
"""Cosine of the largest angle between two strides."""

GOING, ARRIVED, STUCK = 0, 1, 2
ALONE, ON_THE_WAY, AT_THE_END, DONE, LOST = 0, 1, 2, 3, 4

Residual = Callable[[Array], Array]
"""From unknowns (m,) to residuals (k,)."""
Block = Callable[[Array], tuple[Array, Array]]
"""From unknowns (m,) to all that is computed from them (n,), and residuals (k,)."""


class Jacobian(Protocol):
    """The Jacobian (k, m) of residuals at a point, in whatever form."""

    def reach(self, sizes: Float[Array, " m"]) -> Float[Array, " k"]:
        """The largest changes of the residuals, (k,), when unknowns change by up to ``sizes``, (m,)."""
        ...

    def step(
        self, r: Float[Array, " k"], column: Float[Array, " k"], row: Float[Array, " m+1"]
    ) -> Float[Array, " m+1"]:
        """``z`` (m + 1,) with ``jacobian @ z[:-1] + column * z[-1] = r`` and ``row @ z = 0``."""
        ...

    def computed(self, dz: Float[Array, " m"]) -> tuple[Float[Array, " n"], Float[Array, " n"]]:
        """All that is computed from the unknowns at the point, and what a step changes of it."""
        ...


class RootProblem(Protocol):
    """Equations whose root is sought."""

    def residual(self, z: Array, /) -> Array:
        """From unknowns (m,) to residuals (k,)."""
        ...

    def linearized(self, z: Array, /) -> tuple[Array, Jacobian]:
        """The residuals and their Jacobian."""
        ...


@dataclass(frozen=True)
class Dense:
    """Equations whose Jacobian is a matrix, found by differentiation.

    Attributes:
        block: what the equations compute. ``solve``: solves linear equations, as many as unknowns or fewer: from a
            matrix (k, m) and right sides (k,) to (m,).
    """

    block: Block
    solve: Callable[[Array, Array], Array]

    def residual(self, z: Array) -> Array:
        """See `RootProblem`."""
        return self.block(z)[1]

    def linearized(self, z: Array) -> tuple[Array, Matrix]:
        """The residuals and their Jacobian, which share their evaluation."""
        both = jax.lax.optimization_barrier(value_and_jacobian(self.block, z, axis=-1))
        (values, r), (partials, jacobian) = both
        return r, Matrix(jacobian, self.solve, values, partials)


@dataclass(frozen=True)
class Matrix:
    """A Jacobian as a matrix.

    Attributes:
        entries: the matrix (k, m). ``solve``: see `Dense`.
        values, partials: what is computed from the unknowns, (n,), and its derivatives, (n, m).
    """

    entries: Array
    solve: Callable[[Array, Array], Array]
    values: Array
    partials: Array

    def reach(self, sizes: Float[Array, " m"]) -> Float[Array, " k"]:
        """See `Jacobian`."""
        return jnp.abs(self.entries) @ sizes

    def step(
        self, r: Float[Array, " k"], column: Float[Array, " k"], row: Float[Array, " m+1"]
    ) -> Float[Array, " m+1"]:
        """See `Jacobian`."""
        above = jnp.concatenate([self.entries, column[:, None]], axis=1)
        return self.solve(jnp.concatenate([above, row[None]]), jnp.append(r, 0.0))

    def computed(self, dz: Float[Array, " m"]) -> tuple[Float[Array, " n"], Float[Array, " n"]]:
        """See `Jacobian`."""
        return self.values, self.partials @ dz


class _Linearized(NamedTuple):
    """The residuals at a point, the largest change of each, the Newton step, and what `Jacobian.computed` gives."""

    r: Array
    reach: Array
    step: Array
    values: Array
    changes: Array


_State = tuple[Array, Array, Array, Array]
"""Of Newton's method: the point, the status, the number of steps, the length of the last one."""


class _PathSearch(NamedTuple):
    """State of the search: its phase, the last point (m + 1,) of scaled unknowns and s, and the next stride.

    The path is followed upward in s first; if that fails, in the other direction.
    """

    phase: Array
    point: Array
    direction: Array
    stride: Array
    strides: Array
    upward: Array


def root(
    equations: RootProblem,
    guess: Float[Array, " m"],
    scale: Float[Array, " m"] | float = 1.0,
    max_steps: int = 300,
) -> tuple[Float[Array, " m"], Bool[Array, ""]]:
    """A root near a guess, and whether it was reached; ``scale`` has the typical magnitudes of the unknowns, or one."""
    unit = jnp.abs(guess) + scale
    units = jnp.append(unit, 1.0)
    first = equations.residual(guess)
    begins = jnp.all(jnp.isfinite(first))
    upward = jnp.zeros_like(units).at[-1].set(1.0)
    begin = jnp.append(guess / unit, 0.0)

    def off(point: Array) -> Array:
        return equations.residual(point[:-1] * unit) - (1 - point[-1]) * first

    def linearized(point: Array, direction: Array) -> _Linearized:
        r, jacobian = equations.linearized(point[:-1] * unit)
        rest = r - (1 - point[-1]) * first
        sizes = units * (jnp.abs(point) + 1.0)
        reach = jacobian.reach(sizes[:-1]) + jnp.abs(first) * sizes[-1]
        step = jacobian.step(rest, first, direction / units)
        return _Linearized(rest, reach, step / units, *jacobian.computed(step[:-1]))

    def go_on(w: _PathSearch) -> _PathSearch:
        walking = w.phase == ON_THE_WAY
        direction = jnp.where(walking, w.direction, upward)
        ahead = jnp.where(walking, w.point + w.stride * w.direction, w.point.at[-1].set(1.0))
        limit = jnp.where(walking, CORRECTIONS, max_steps)
        point, arrived = _newton(off, lambda p: linearized(p, direction), ahead, limit)
        taken = point - w.point
        length = _norm(taken)
        straight = (jnp.sum(taken * w.direction) > STRAIGHT * length) & (length < 3 * w.stride)
        lost = walking & ((w.stride < SHORTEST) | (w.strides > STRIDES))
        back = lost & w.upward
        good = walking & ~lost & arrived & (straight | (jnp.abs(w.direction[-1]) == 1))
        passed = good & (point[-1] >= 1)
        ends = jnp.where(arrived, DONE, jnp.where((w.phase == ALONE) & begins, ON_THE_WAY, LOST))
        on = jnp.where(passed, AT_THE_END, jnp.where(lost & ~back, LOST, ON_THE_WAY))
        part = jnp.where(passed, (1 - w.point[-1]) / (point[-1] - w.point[-1]), 1.0)
        kept = jnp.where(good, w.point + part * taken, jnp.where(back, begin, w.point))
        stride = jnp.where(good, 1.5 * length, jnp.where(walking, w.stride / 3, w.stride))
        return _PathSearch(
            jnp.where(walking, on, ends),
            jnp.where(walking, kept, jnp.where(arrived | (w.phase != ALONE), point, begin)),
            jnp.where(good, taken / length, jnp.where(back, -upward, w.direction)),
            jnp.where(back, FIRST, stride),
            jnp.where(back, 0, w.strides + walking),
            w.upward & ~back,
        )

    stride = FIRST * jnp.ones_like(begin[-1])
    start = _PathSearch(jnp.array(ALONE), begin, upward, stride, jnp.array(0), jnp.array(True))
    end = jax.lax.while_loop(lambda w: w.phase < DONE, go_on, start)
    return end.point[:-1] * unit, end.phase == DONE


def _newton(
    residual: Residual,
    linearized: Callable[[Array], _Linearized],
    guess: Array,
    max_steps: Array,
) -> tuple[Array, Array]:
    """A root near a guess by Newton's method, and whether it was reached.

    A step that does not make the residual smaller is halved until it does. For this comparison every equation is
    divided by its partial derivatives, so that units do not matter. Where no part of the step helps, but the step is
    small, only roundoff is left; otherwise the method is stuck. A step is as small as what it changes of all that is
    computed from the unknowns: behind an amplifier, a small difference of them is large.
    """

    def advance(state: _State) -> _State:
        z, _, k, before = state
        r, reach, step, values, changes = linearized(z)
        full = jnp.where(jnp.all(r == 0), 0.0, step)
        weight = 1 / jnp.where(reach > 0, reach, 1.0)
        size = _norm(weight * r)
        amplified = _share(changes, values, STALLED[z.dtype.name])

        def is_small(dz: Array, part: Array) -> Array:
            tolerated = STALLED[dz.dtype.name]
            return (_is_tiny(dz, z) & (part * amplified < tolerated)) | _is_tiny(dz, z, ROUNDED)

        def too_far(trial: tuple[Array, Array, Array]) -> Array:
            dz, part, new = trial
            return ~(new < size) & ~is_small(dz, part) & jnp.all(jnp.isfinite(z - dz))

        def halve(trial: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
            dz, part, _ = trial
            left = jax.lax.optimization_barrier(residual(z - dz / 2))
            return dz / 2, part / 2, _norm(weight * left)

        twice = jnp.full_like(size, 2.0)
        dz, part, new = jax.lax.while_loop(too_far, halve, (2 * full, twice, jnp.inf * twice))
        there, stopped = is_small(full, jnp.ones_like(part)), is_small(dz, part)
        length = _norm(full)
        on_stair = (part == 1) & (length > SHRINKS * before) & (new > SHRINKS * size)
        is_sure = _share(changes, values, 1.0) < UNSURE[z.dtype.name]
        stalls = (stopped | on_stair) & is_sure & _is_tiny(full, z, STALLED)
        arrived = there | stalls
        stuck = stopped | ~jnp.all(jnp.isfinite(z - full))
        status = jnp.where(arrived, ARRIVED, jnp.where(stuck, STUCK, GOING))
        return z - jnp.where(there, full, dz), status, k + 1, length

    def unfinished(state: _State) -> Array:
        _, status, k, _ = state
        return (status == GOING) & (k < max_steps)

    begin = guess, jnp.array(GOING), jnp.array(0), jnp.full((), jnp.inf, guess.dtype)
    z, status, _, _ = jax.lax.while_loop(unfinished, advance, begin)
    return z, status == ARRIVED


def _norm(v: Array) -> Array:
    return jnp.sqrt(jnp.sum(v * v))


def _is_tiny(step: Array, at: Array, tolerance: Tolerance = TOLERANCE) -> Array:
    relative = tolerance[step.dtype.name]
    return jnp.all(jnp.abs(step) < relative * (jnp.abs(at) + relative))


def _share(changes: Array, values: Array, least: float) -> Array:
    """The largest change relative to values, or to the least of them; those that are not numbers do not count."""
    shares = jnp.abs(changes) / (jnp.abs(values) + least)
    return jnp.max(jnp.where(jnp.isnan(shares), 0.0, shares), initial=0.0)
