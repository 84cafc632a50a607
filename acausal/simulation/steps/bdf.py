"""Backward differentiation formulas of order 1 to 5 with a fixed leading coefficient, for stiff models.

What is kept are the states at the last times themselves. So each step, whatever its order, is one equation,
``x - c f(t, x) = sum of weights * states before``, and that is all that a derivative has to know.
K. E. Brenan, S. L. Campbell, L. R. Petzold: Numerical Solution of Initial-Value Problems in DAEs, SIAM 1996, chapter 5.
"""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import either, without_derivatives
from acausal.codegen import StateJacobian
from acausal.simulation.newton import Equation, Fields, Newton, Patience, Rates, solve
from acausal.simulation.steps.multistep import (
    HARMONIC,
    MOST,
    POINTS,
    differences,
    error_constant,
    slopes,
    weights,
)
from acausal.simulation.steps.one_step import SMALL, first_step, look_inside
from acausal.simulation.steps.problem import Attempt, Counts, Integration, RightHandSide

State = Float[Array, " n_states"]


RENEW = 0.3
"""Relative change of the coefficient c beyond which the matrix of Newton's method is renewed."""

KEEP = 20
"""Steps after which it is renewed in any case."""

PATIENCE = Patience(5, 2.0, renews=False)
"""A matrix is renewed between steps alone."""

LEFT = 0.1
"""The part of a step's tolerance that may remain as error of its equations."""

INSIDE, OF_DEFECT = (0.36, 0.69), 0.002
"""Where in a step the right-hand side is looked at once more, and what a defect there counts as an error."""

TURNS = 5
"""A step's equation is begun again, with the derivatives where it has come to, so often at most."""

WORTH = 1.5
"""A longer step is taken if it is so many times longer."""

CAUTIOUS, BOLD = 6.0, 10.0
"""Factors of safety of the error at this order and below, and at the next one."""


class MultistepMemory(NamedTuple):
    """What is known between two steps.

    Attributes:
        h: the length to try next, in seconds.
        states: the latest, newest first, shape (POINTS, n_states). times: of them.
        known: how many of them belong to the run; the others only fill the table.
        order: of the next step. wait: steps before another order is considered.
        failures: since the last step that counts.
        matrix: of Newton's method, factorized. c: the coefficient it was made for. age: steps since then.
        stale: whether it must be renewed.
        guess: where the equation's derivatives are another branch's than at the prediction, the state so far.
        turns: how often in a row that was so.
    """

    h: Float[Array, ""]
    states: Float[Array, "points n_states"]
    times: Float[Array, " points"]
    known: Int[Array, ""]
    order: Int[Array, ""]
    wait: Int[Array, ""]
    failures: Int[Array, ""]
    matrix: Any
    c: Float[Array, ""]
    age: Int[Array, ""]
    stale: Bool[Array, ""]
    guess: State
    turns: Int[Array, ""]


class StepEquation(NamedTuple):
    """A step's equation: its coefficient, and the weights of the states before."""

    c: Float[Array, ""]
    weights: Float[Array, " points"]
    t: Float[Array, ""]
    times: Float[Array, " points"]
    order: Int[Array, ""]


class StepPolynomial(NamedTuple):
    """The polynomial through the end of a step and the points before it."""

    states: Float[Array, "points_1 n_states"]
    s: Float[Array, " points_1"]
    order: Int[Array, ""]


class Multistep(eqx.Module):
    """The method.

    Attributes:
        jacobian: the model's, by which the equations of a step are solved.
        branches: whether its rates have case distinctions.
    """

    name: ClassVar[str] = "BDF"
    jacobian: StateJacobian = eqx.field(static=True)
    branches: bool = eqx.field(static=True)

    def begin(self, problem: Integration, t: Array, x: State) -> tuple[MultistepMemory, Counts]:
        """What is known at the begin, or after a jump: one state."""
        f, h = first_step(problem, t, x, 1.0)
        back = jnp.arange(POINTS)
        states = x - (h * back)[:, None].astype(x.dtype) * lax.stop_gradient(f)
        zero, one = jnp.zeros((), jnp.int32), jnp.ones((), jnp.int32)
        # factors of the identity, to be renewed
        entries = jnp.zeros(self.jacobian.n_entries, x.dtype)
        matrix = self.jacobian.iteration_matrix.factorize(entries, jnp.zeros((), x.dtype))
        memory = MultistepMemory(
            h,
            states,
            t - h * back,
            one,
            one,
            2 * one,
            zero,
            matrix,
            jnp.ones_like(h),
            zero,
            jnp.array(True),
            x,
            zero,
        )
        return memory, Counts.of(rates=2)

    chooses: ClassVar[bool] = True
    """It chooses the lengths of its steps."""

    def resumed(self, memory: MultistepMemory, before: MultistepMemory) -> MultistepMemory:
        """What is known behind a jump."""
        return memory

    def attempt(self, problem: Integration, memory: MultistepMemory, t: Array, h: Array) -> Attempt:
        """Try a step of length h from t."""
        m, end = memory, t + h
        q = m.order
        s = (end - m.times) / h
        predicting = weights(s, q + 1, jnp.zeros_like(h))
        alpha = jnp.asarray(HARMONIC, h.dtype)[q]
        own = predicting - slopes(s, q + 1) / alpha
        known = own @ m.states
        c = h / alpha
        equation = Equation(Fields(_at, problem.field), end, c, known, m.states[0])
        problem, m = without_derivatives((problem, m))
        predicted, x_before = predicting @ m.states, m.states[0]
        begin = jnp.where(m.turns > 0, m.guess, predicted)
        constant = error_constant(s, q)
        renew = m.stale | (m.age >= KEEP) | (jnp.abs(c / m.c - 1) > RENEW)
        matrix, made_for = lax.cond(
            renew,
            lambda: (self.jacobian.factorized(problem.field.at(end), begin, c), c),
            lambda: (m.matrix, m.c),
        )
        scale, tolerances = 2 / (1 + c / made_for), problem.tolerances
        patience = PATIENCE._replace(doubts=self.branches)
        newton = solve(
            equation, self.jacobian, matrix, begin, tolerances, LEFT / constant, patience, scale
        )
        x, exact = lax.stop_gradient(newton.x), newton.x
        error = constant * problem.tolerances.size(x - predicted, x_before, x)
        error = jnp.where(newton.done, error, jnp.inf)
        inside = without_derivatives(
            StepPolynomial(jnp.concatenate([x[None], m.states]), _with_end(s), q)
        )

        fixed, begin, length, found = without_derivatives((matrix, t, h, x))

        def size(off: State) -> Array:  # solved with the matrix, as fast modes would count else
            change = self.jacobian.iteration_matrix.solve(fixed, off)
            return problem.tolerances.size(change, x_before, found)

        error, rates, looked = look_inside(
            problem,
            error,
            (begin, length),
            lambda at: self.between(inside, begin, length, at),
            INSIDE,
            size,
            OF_DEFECT,
            SMALL,
        )
        accepted = error < 1
        dense = StepPolynomial(jnp.concatenate([exact[None], memory.states]), _with_end(s), q)
        solved = m._replace(matrix=matrix, c=made_for, age=jnp.where(renew, 0, m.age + accepted))
        after = self._after(problem, solved, h, end, without_derivatives(dense), error)
        after = after._replace(states=dense.states[:-1])
        before = self._before(solved, newton, renew, h, error)._replace(states=memory.states)
        made = newton.made
        counts = Counts.of(rates=made + rates, jacobians=renew, corrections=made, looks=looked)
        return Attempt(
            accepted,
            exact,
            either(accepted, after, before),
            dense,
            StepEquation(c, own, end, m.times, q),
            jnp.array(False),
            jnp.array(False),
            counts,
        )

    def between(self, dense: StepPolynomial, t: Array, h: Array, at: Array) -> State:
        """The state at a time within a step."""
        return weights(dense.s, dense.order + 1, (t + h - at) / h) @ dense.states

    def _after(
        self,
        problem: Integration,
        m: MultistepMemory,
        h: Array,
        end: Array,
        dense: StepPolynomial,
        error: Array,
    ) -> MultistepMemory:
        """What is known after a step that counts, but for the states: the next order and length."""
        states, s, q = dense

        def size(derivative: Array) -> Array:
            """How large, over the tolerance, the derivative of an order is, times the step to the same power."""
            return problem.tolerances.size(
                differences(s, derivative) @ states, states[1], states[0]
            )

        def longer(error: Array, order: Array, safety: float) -> Array:
            return 1 / ((safety * error) ** (1 / (order + 1)) + 1e-6)

        same = longer(error, q, CAUTIOUS)
        wait = m.wait - 1
        free = (wait <= 0) & (m.failures == 0)
        can_fall = free & (q > 1)
        can_rise = free & (q < MOST) & (m.known >= q + 2)
        lower = lax.cond(
            can_fall, lambda: longer(size(q) / q, q - 1, CAUTIOUS), lambda: jnp.zeros_like(h)
        )
        upper = lax.cond(
            can_rise, lambda: longer(size(q + 2) / (q + 2), q + 1, BOLD), lambda: jnp.zeros_like(h)
        )
        best = jnp.maximum(same, jnp.maximum(lower, upper))
        is_worth = best >= WORTH
        order = jnp.where(best == upper, q + 1, jnp.where(best == lower, q - 1, q))
        order = jnp.where(is_worth & free & (best > same), order, q)
        factor = jnp.where(is_worth, jnp.minimum(best, 10.0), 1.0)
        factor = jnp.where(m.failures > 0, 1.0, factor)
        wait = jnp.where(order != q, order + 1, jnp.where(free, 2, wait))
        return m._replace(
            h=jnp.maximum(m.h, h * factor),  # a step may have been cut short
            times=jnp.concatenate([end[None], m.times[:-1]]),
            known=jnp.minimum(m.known + 1, POINTS),
            order=order,
            wait=wait,
            failures=jnp.zeros_like(m.failures),
            stale=jnp.array(False),
            turns=jnp.zeros_like(m.turns),
        )

    def _before(
        self, m: MultistepMemory, newton: Newton, renewed: Array, h: Array, error: Array
    ) -> MultistepMemory:
        """What is known where a step does not count: a matrix to renew, or a shorter length."""
        unsolved, q = ~newton.done, m.order
        turned = unsolved & newton.turned & (m.turns < TURNS)
        kept = unsolved & (~renewed | turned)
        failures = m.failures + jnp.where(kept, 0, 1)
        factor = 1 / ((CAUTIOUS * error) ** (1 / (q + 1)) + 1e-6)
        factor = jnp.clip(jnp.where(jnp.isfinite(factor), factor, 0.2), 0.2, 0.9)
        factor = jnp.where(unsolved, jnp.where(kept, 1.0, 0.25), factor)
        lowered = ~unsolved & (failures >= 3)
        return m._replace(
            h=h * factor,
            order=jnp.where(lowered, jnp.maximum(q - 1, 1), q),
            wait=jnp.where(lowered, q + 1, m.wait),
            failures=failures,
            stale=unsolved,
            guess=lax.stop_gradient(newton.x),
            turns=jnp.where(turned, m.turns + 1, 0),
        )

    def adjoint(self, to_last: State) -> Float[Array, "points_1 n_states"]:
        """The adjoints of the last state and of those before it."""
        return jnp.zeros((POINTS + 1, *to_last.shape), to_last.dtype).at[0].set(to_last)

    def at_start(self, adjoint: Float[Array, "points_1 n_states"]) -> State:
        """The cotangent of the first state."""
        return adjoint[0]

    def back(
        self,
        of_moved: Any,
        own: list[Array],
        row: Any,
        begin: State,
        adjoint: Float[Array, "points_1 n_states"],
        to_saved: Float[Array, "n_saved n_states"],
        which: tuple[Array, Array],
    ) -> tuple[Float[Array, "points_1 n_states"], list[Array]]:
        """See `OneStep.back`."""
        problem: Integration = of_moved(own)[1]
        equation: StepEquation = row.own
        s = _with_end((equation.t - equation.times) / row.h)

        def add(state: tuple[Array, Array]) -> tuple[Array, Array]:
            j, total = state
            at = (equation.t - problem.ts[j]) / row.h
            return j + 1, total + weights(s, equation.order + 1, at)[:, None] * to_saved[j]

        if len(problem.ts):
            _, adjoint = lax.while_loop(lambda a: a[0] < which[1], add, (which[0], adjoint))
        matrix = self.jacobian.factorized(problem.field.at(equation.t), row.x, equation.c)
        multiplier = self.jacobian.iteration_matrix.solve(matrix, adjoint[0], transposed=True)

        def rates(own: list[Array]) -> State:
            return of_moved(own)[1].field(equation.t, row.x)

        by_own = jax.vjp(rates, own)[1](equation.c * multiplier)[0]
        before = adjoint[1:] + equation.weights[:, None] * multiplier
        return jnp.concatenate([before, jnp.zeros_like(before[:1])]), by_own


def _with_end(s: Float[Array, " points"]) -> Float[Array, " points_1"]:
    """How far back some points lie from the end of a step, that end first."""
    return jnp.concatenate([jnp.zeros((1,), s.dtype), s])


def _at(t: Any, field: RightHandSide) -> Rates:
    return field.at(t)
