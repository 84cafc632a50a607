"""Solve: states that meet initial conditions, moved as little as possible, and rest where all of them must."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
import optimistix as optx
from jaxtyping import Array, Float

from acausal._jax import compiled, traced, without_derivatives
from acausal.codegen import Dense, Values, root
from acausal.flattening import LeavesCaches
from acausal.initialization.conditions import Conditions, FixedStart

MAX_STEPS = 100
RELAXING, SHORTER, GROWTH, TINY = 200, 4.0, (0.5, 10.0), 1e-300
"""So many steps lead to rest; one that leads nowhere is made so much shorter, others grow between these factors."""

LEFT_OVER = 1e-6
"""How far off a condition may be, in nominal values."""
ROUNDING = 1e-9
"""A condition is met but for rounding if states move by less, in nominal values, to meet it."""


@dataclass(frozen=True)
class InitializationProblem:
    """One initialization problem: which states may change, and which conditions they must meet.

    Attributes:
        moved: states that may differ from their starts. ``starts``: fixed starts that must be met.
        resting: states that must be at rest. ``least_squares``: whether conditions are met in the least-squares sense.
    """

    moved: tuple[int, ...]
    starts: tuple[FixedStart, ...]
    resting: tuple[int, ...]
    least_squares: bool

    @property
    def rests_alone(self) -> bool:
        """Whether every state that may change is to be at rest, and none other."""
        return not self.starts and len(self.resting) > 0 and self.moved == self.resting


class InitialStates(NamedTuple):
    """States, how far each condition is off there, and the derivatives of that by the states that moved."""

    x: Float[Array, " n_states"]
    residuals: Float[Array, " n_conditions"]
    jacobian: Float[Array, "n_conditions n_moved"]

    @property
    def holds(self) -> bool:
        """Whether the conditions are met: little is left of them, or what rounding makes of fast rates."""
        left, by = np.asarray(self.residuals), np.asarray(self.jacobian)
        if (np.abs(left) < LEFT_OVER).all() or not (np.isfinite(left).all() and by.size):
            return bool((np.abs(left) < LEFT_OVER).all())
        change = np.asarray(_smallest(jnp.asarray(by), jnp.asarray(left)))
        met = np.abs(left - by @ change) < LEFT_OVER
        return bool(met.all() and (np.abs(change) < ROUNDING).all())


@dataclass(frozen=True)
class InitializationSolver(LeavesCaches):
    """Solves the initialization problems of a model."""

    conditions: Conditions

    def find(self, problem: InitializationProblem, start: Values) -> InitialStates:
        """The states, and what is left of the conditions; where they cannot be met, the nearest that was found."""
        found = self._satisfied(problem, start)
        alone = problem.rests_alone and not self.conditions.reduced.model.initial
        if problem.least_squares or not alone or traced(found.residuals) or found.holds:
            return found
        relaxed = self._satisfied(problem, start._replace(x=self._relaxed(problem, start)))
        return relaxed if relaxed.holds else found

    @cached_property
    def _satisfied(self) -> Callable[[InitializationProblem, Values], InitialStates]:
        """`_satisfy`, compiled once for every problem."""
        return compiled(self._satisfy)

    def _satisfy(self, problem: InitializationProblem, start: Values) -> InitialStates:
        """States that satisfy the conditions.

        The solution is found without derivatives; one Newton step from there, which moves nothing, carries them.
        """
        free = np.asarray(problem.moved, dtype=np.int64)
        mobility = self.conditions.mobility[free]
        nominal = self.conditions.nominal[free] * mobility
        x = start.x

        def residual(z: Array, at: Values) -> Array:
            return self._residual(problem, z * nominal, at)

        def stationary(z: Array, at: Values) -> Array:
            half = lambda z: jnp.sum(residual(z, at) ** 2) / 2  # noqa: E731
            return jax.grad(half)(z)

        packed, frozen_x = without_derivatives((start.packed, x))
        frozen = start._replace(x=frozen_x, packed=packed)
        if not problem.moved:
            rest = residual(jnp.zeros(0), frozen)
            return InitialStates(x, rest, jnp.zeros((len(rest), 0)))
        z0 = x[free] / nominal
        guess = jax.lax.stop_gradient(z0)
        least = _least_squares if problem.least_squares else partial(_least_change, 1 / mobility)
        z = jax.lax.stop_gradient(least(lambda z: residual(z, frozen), guess))
        vanishing = stationary if problem.least_squares else residual
        jacobian = jax.jacfwd(lambda z: vanishing(z, frozen))(z)
        change = z0 - guess
        z = z + change - _smallest(jacobian, vanishing(z, start) + jacobian @ change)
        at = jax.lax.stop_gradient(z)
        left = residual(at, frozen), jax.jacfwd(lambda z: residual(z, frozen))(at)
        return InitialStates(x.at[free].set(z * nominal), *left)

    def _residual(self, problem: InitializationProblem, moved: Array, at: Values) -> Array:
        free = np.asarray(problem.moved, dtype=np.int64)
        there = at._replace(x=at.x.at[free].set(moved))
        return self.conditions.residuals(problem.starts, problem.resting, there)

    # -- rest --------------------------------------------------------------------------------------

    def _relaxed(self, problem: InitializationProblem, start: Values) -> Array:
        """States that all come to rest, each after a time of its own: linearly implicit steps that grow as they do so.

        C. T. Kelley, D. E. Keyes: Convergence Analysis of Pseudo-Transient Continuation, SIAM Journal on Numerical
        Analysis 35 (1998).
        """
        free = np.asarray(problem.moved, dtype=np.int64)
        nominal = np.asarray(self.conditions.nominal)[free]

        def rates(z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            f, jacobian = self._rates(problem, start._replace(x=start.x.at[free].set(z * nominal)))
            return np.asarray(f), np.asarray(jacobian)

        x = np.asarray(start.x)[free] / nominal
        f, jacobian = rates(x)
        h = 1 / max(float(np.max(np.abs(jacobian), initial=0.0)), np.finfo(float).tiny)
        for _ in range(RELAXING):
            if not np.isfinite(f).all() or (np.abs(f) < LEFT_OVER).all():
                break
            with np.errstate(all="ignore"):
                there = x + np.asarray(_smallest(jnp.eye(len(x)) / h - jacobian, jnp.asarray(f)))
            g, jacobian_there = rates(there)
            if np.isfinite(there).all() and np.isfinite(g).all():
                h *= float(np.clip(np.linalg.norm(f) / max(np.linalg.norm(g), TINY), *GROWTH))
                x, f, jacobian = there, g, jacobian_there
            else:
                h /= SHORTER
        return start.x.at[free].set(x * nominal)

    @cached_property
    def _rates(self) -> Callable[[InitializationProblem, Values], tuple[Array, Array]]:
        """The rates of resting states, in nominal values, and their Jacobian, compiled once for every problem."""

        @compiled
        def rates(problem: InitializationProblem, at: Values) -> tuple[Array, Array]:
            free = np.asarray(problem.moved, dtype=np.int64)
            nominal = self.conditions.nominal[free]

            def residual(z: Array) -> Array:
                every = self._residual(problem, z * nominal, at)
                return every[len(every) - len(free) :]  # constraints come before rates

            z = at.x[free] / nominal
            return residual(z), jax.jacfwd(residual)(z)

        return rates


def _least_change(scale: np.ndarray, residual: Callable[[Array], Array], guess: Array) -> Array:
    """Newton's method with the smallest steps: a root near the guess even if there are many."""
    problem = Dense(lambda x: (x, residual(x)), _smallest_across)
    found, *_ = root(problem, guess, jnp.asarray(scale), MAX_STEPS)
    return found


def _smallest_across(
    bordered: Float[Array, "k+1 m"], r: Float[Array, " k+1"]
) -> Float[Array, " m"]:
    """The same at right angles to the last row, which holds in any case: others may contradict each other."""
    step, across = _smallest(bordered, r), bordered[-1]
    return step - across * (across @ step) / (across @ across)


def _smallest(jacobian: Float[Array, "k m"], r: Float[Array, " k"]) -> Float[Array, " m"]:
    """The smallest step that satisfies the linear equations, with equal weight for each equation."""
    size = jnp.max(jnp.abs(jacobian), axis=1, initial=0.0)
    weight = 1 / jnp.where(size > 0, size, 1.0)
    return jnp.linalg.pinv(weight[:, None] * jacobian) @ (weight * r)


def _least_squares(residual: Callable[[Array], Array], guess: Array) -> Array:
    solver = optx.LevenbergMarquardt(rtol=1e-10, atol=1e-12)
    found = optx.least_squares(lambda z, _: residual(z), solver, guess, max_steps=1000, throw=False)
    return found.value
