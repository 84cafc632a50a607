"""Adaptive steps of one-step schemes, by diffrax's `step`."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple, cast

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import either, without_derivatives
from acausal.simulation.steps.problem import Attempt, Counts, Integration, RightHandSide

State = Float[Array, " n_states"]

SAFETY, SHORTER, LONGER = 0.9, 0.2, 10.0
"""Of the next step's length over this one's: a factor of safety, the least and the most."""

STIFF_RATIO = 2.0
"""The step times the fastest mode, beyond which stability and not accuracy limits the steps.

Tsit5 and its like are stable up to 3.3 on the negative real axis. Steps at that limit are rejected now and then, and
the next ones are shorter: with a threshold of 3.25 a clutch that sticks took 1113 steps until that was seen, with 2.0
it is 61. An oscillator, which is not stiff, stays below at tolerances from 1e-2 to 1e-6.
"""

STIFF_AFTER = 15
"""So many of the last steps must be limited by stability before a model counts as stiff (Hairer & Wanner, IV.2)."""

RELEASED = 6
"""So many steps in sequence that are not limited start that count again."""


INSIDE, OF_DEFECT = (0.52, 0.71), 0.2
"""Where in a step the right-hand side is looked at once more, and what a defect there counts as an error.

The stages of Tsit5 lie at 0, 0.16, 0.33, 0.9, 0.98 and 1: with these points no gap is wider than 0.19 of the step.
"""

SMALL = 0.05
"""Steps with errors below this part of what is allowed are looked into."""


class Memory(NamedTuple):
    """What is known between two steps.

    Attributes:
        h: the length to try next, in seconds.
        x: the state.
        first: the derivative there, or what a solver keeps between its steps.
        limited: the steps that stability has limited. free: those in sequence that it has not.
    """

    h: Float[Array, ""]
    x: State
    first: Any
    limited: Int[Array, ""]
    free: Int[Array, ""]


class Made(NamedTuple):
    """A step.

    Attributes:
        x: the state at its end. error: an estimate of its error.
        dense: what the scheme's interpolation takes.
        first: of the next step. done: whether its equations are solved.
        fastest: an estimate of the fastest mode, in 1/s.
        counts: what it has cost.
        factors: of the matrix that its equations were solved with, if there are some.
    """

    x: State
    error: State
    dense: dict[str, Any]
    first: Any
    done: Bool[Array, ""]
    fastest: Float[Array, ""]
    counts: Counts
    factors: Any = None


def look_inside(
    problem: Integration,
    error: Array,
    step: tuple[Array, Array],
    between: Callable[[Array], State],
    points: tuple[float, ...],
    size: Callable[[State], Array],
    weight: float,
    below: float,
) -> tuple[Array, Array, Array]:
    """Look at more points of a step whose error is small, or in which the right-hand side may bend.

    Arguments:
        error: of the step, over what is allowed.
        step: the time of its begin, and its length. between: the state that its interpolation has at a time within it.
        points: shares of the step. size: of a defect, over what is allowed; it is how far the interpolation is from the
            equations at a point, times the step's length.
        weight: what a defect counts as an error.
        below: the error below which it is small; of a right-hand side that bends, any that is allowed.

    Returns:
        The error of the step after that, the evaluations that took, and whether the step counts no more.
    """
    looks = error < (1.0 if problem.field.bends else below)
    begin, length = step

    def one(at: tuple[Array, State, State]) -> Array:
        t, x, slope = at
        return size(length * (problem.field(t, x) - slope))

    def largest() -> Array:
        times = begin + jnp.asarray(points, length.dtype) * length
        slopes = jax.vmap(lambda t: jax.jvp(between, (t,), (jnp.ones_like(t),)))
        at = times, *slopes(times)
        if problem.field.is_long:
            return jnp.max(lax.map(one, at))
        return jnp.max(jnp.stack([one(each) for each in zip(*at, strict=True)]))

    found = lax.cond(looks, largest, lambda: jnp.zeros_like(error))
    found = weight * jnp.where(jnp.isfinite(found), found, jnp.inf)
    found = jnp.maximum(error, found)
    return found, len(points) * looks.astype(jnp.int32), (error < 1) & (found >= 1)


class OneStep(eqx.Module):
    """A scheme whose steps know only the state at their start.

    Attributes:
        solver: the diffrax solver.
    """

    solver: Any

    @property
    def name(self) -> str:
        """For messages."""
        return type(self.solver).__name__

    def first(self, field: RightHandSide, t: Array, h: Array, x: State, f: State) -> Any:
        """What the first step, or one after a jump, may use: the derivative."""
        return f

    @abstractmethod
    def make(self, field: RightHandSide, t: Array, h: Array, x: State, first: Any) -> Made:
        """One step."""

    def begin(self, problem: Integration, t: Array, x: State) -> tuple[Memory, Counts]:
        """What is known at the begin, or after a jump; and what that cost."""
        f, h = first_step(problem, t, x, self._order)
        zero = jnp.zeros((), jnp.int32)
        return Memory(h, x, self.first(problem.field, t, h, x, f), zero, zero), Counts.of(rates=2)

    chooses: ClassVar[bool] = True
    """It chooses the lengths of its steps."""

    def resumed(self, memory: Memory, before: Memory) -> Memory:
        """What is known behind a jump: how often stability has limited the steps is not forgotten."""
        return memory._replace(limited=before.limited, free=before.free)

    def attempt(self, problem: Integration, memory: Memory, t: Array, h: Array) -> Attempt:
        """Try a step of length h from t."""
        x = memory.x
        made = self.make(problem.field, t, h, x, memory.first)
        error = lax.stop_gradient(problem.tolerances.size(made.error, x, made.x))
        error = jnp.where(made.done & jnp.isfinite(error), error, jnp.inf)
        fixed, dense = without_derivatives((problem, made.dense))
        begin, length, *ends = lax.stop_gradient((t, h, x, made.x))

        error, rates, looked = look_inside(
            fixed,
            error,
            (begin, length),
            lambda at: self.between(dense, begin, length, at),
            INSIDE,
            lambda off: fixed.tolerances.size(self.as_state(made, off), *ends),
            OF_DEFECT,
            self.small,
        )
        accepted = error < 1
        factor = SAFETY * error ** (-1 / self._order)
        least, most = jnp.where(accepted, 1.0, SHORTER), jnp.where(accepted, LONGER, SAFETY)
        longer = h * jnp.clip(factor, least, most).astype(h.dtype)
        whole = jnp.maximum(longer, memory.h)  # h may be what was left up to a stop
        longer = jnp.where(accepted, whole, longer)
        is_limited = h * lax.stop_gradient(made.fastest) > STIFF_RATIO
        free = jnp.where(is_limited, 0, memory.free + 1)
        limited = jnp.where(free >= RELEASED, 0, memory.limited + is_limited)
        after = Memory(longer, made.x, made.first, limited, free)
        before = memory._replace(h=longer)
        return Attempt(
            accepted,
            made.x,
            either(accepted, after, before),
            made.dense,
            (),
            is_limited,
            accepted & (limited >= STIFF_AFTER),
            made.counts.plus(Counts.of(rates=rates, looks=looked)),
        )

    small: ClassVar[float] = SMALL
    """Steps with errors below this part of what is allowed are looked into."""

    def as_state(self, made: Made, off: State) -> State:
        """What a defect within a step means for the state there."""
        return off

    def between(self, dense: dict[str, Any], t: Array, h: Array, at: Array) -> State:
        """The state at a time within a step from t of length h."""
        one = jnp.ones_like(h)
        whole = self.solver.interpolation_cls(t0=0 * one, t1=one, **dense)
        return whole.evaluate(part_of_step(t, h, at))

    def adjoint(self, to_last: State) -> State:
        """The adjoint behind the last step."""
        return to_last

    def at_start(self, adjoint: State) -> State:
        """The cotangent of the first state."""
        return adjoint

    def back(
        self,
        of_moved: Any,
        own: list[Array],
        row: Any,
        begin: State,
        adjoint: State,
        to_saved: Float[Array, "n_saved n_states"],
        which: tuple[Array, Array],
    ) -> tuple[State, list[Array]]:
        """The adjoint before a step, and the cotangents of what moves.

        Arguments:
            of_moved: what moves -> (method, problem, start). own: what moves.
            row: the step, one of `Rows`. begin: the state at its start.
            adjoint: behind it. to_saved: cotangents of the states saved; those in the range ``which`` lie in the step.
        """
        t, h = row.t, row.h
        ts = of_moved(own)[1].ts

        def step(own: list[Array], x: State) -> tuple[State, dict[str, Any]]:
            field = of_moved(own)[1].field
            made = self.make(field, t, h, x, self.first(field, t, h, x, field(t, x)))
            return made.x, made.dense

        (_, dense), pull = jax.vjp(step, own, begin)
        by_own, by_x = pull((adjoint, self._to_dense(ts, row, dense, to_saved, which)))
        return by_x, by_own

    def _to_dense(
        self, ts: Array, row: Any, dense: Any, to_saved: Array, which: tuple[Array, Array]
    ) -> Any:
        """The cotangents of what the interpolation takes; arguments as of `back`."""

        def add(state: tuple[Array, Any]) -> tuple[Array, Any]:
            j, total = state
            pull = jax.vjp(lambda d: self.between(d, row.t, row.h, ts[j]), dense)[1]
            return j + 1, jax.tree.map(jnp.add, total, pull(to_saved[j])[0])

        nothing = jax.tree.map(jnp.zeros_like, dense)
        if not len(ts):
            return nothing
        return lax.while_loop(lambda s: s[0] < which[1], add, (which[0], nothing))[1]

    @property
    def _order(self) -> float:
        """The order of the local error of the embedded scheme."""
        return float(cast(float, self.solver.order(None)))


class Foreign(OneStep):
    """Any other adaptive diffrax solver, by its own `step`."""

    def first(self, field: RightHandSide, t: Array, h: Array, x: State, f: State) -> Any:
        """The solver's state."""
        return self.solver.init(_term(field), t, t + h, x, None)

    def make(self, field: RightHandSide, t: Array, h: Array, x: State, first: Any) -> Made:
        """One step."""
        end, error, dense, last, result = self.solver.step(
            _term(field), t, t + h, x, None, first, False
        )
        done = result == dfx.RESULTS.successful
        return Made(end, error, dense, last, done, jnp.zeros_like(h), Counts.of())

    def between(self, dense: dict[str, Any], t: Array, h: Array, at: Array) -> State:
        """The state at a time within a step."""
        return self.solver.interpolation_cls(t0=t, t1=t + h, **dense).evaluate(at)


def part_of_step(t: Array, h: Array, at: Array) -> Array:
    """Where in a step a time lies, 0 to 1; a step without length, as events leave behind, is at its end."""
    none = h == 0
    return jnp.where(none, 1.0, (at - t) / jnp.where(none, 1.0, h))


def first_step(
    problem: Integration, t: Array, x: State, order: float
) -> tuple[State, Float[Array, ""]]:
    """The derivative, and a length for the first step (Hairer, Nørsett & Wanner 1993, II.4)."""
    fixed = lax.stop_gradient(x)
    d0 = problem.tolerances.size(fixed, fixed)

    def a_little(f: State) -> tuple[Array, Array]:
        """How fast the state moves, and a length after which the right-hand side is looked at once more."""
        d1 = problem.tolerances.size(f, fixed)
        small = (d0 < 1e-5) | (d1 < 1e-5)
        h0 = jnp.where(small, 1e-6, 0.01 * d0 / jnp.where(small, 1.0, d1))
        return d1, jnp.minimum(h0, problem.end - t)

    def go_on(at: tuple[Array, State], _: None) -> tuple[tuple[Array, State], State]:
        f = problem.field(*at)
        known = lax.stop_gradient(f)
        h0 = a_little(known)[1]
        return (at[0] + h0.astype(t.dtype), fixed + (h0 * known).astype(x.dtype)), f

    if problem.field.is_long:
        f, other = lax.scan(go_on, (t, x), length=2)[1]
    else:
        there, f = go_on((t, x), None)
        other = problem.field(*there)
    d1, h0 = a_little(lax.stop_gradient(f))
    d2 = problem.tolerances.size(lax.stop_gradient(other - f), fixed) / h0
    largest = jnp.maximum(d1, d2)
    flat = largest <= 1e-15
    h1 = (0.01 / jnp.where(flat, 1.0, largest)) ** (1 / (order + 1))
    h = jnp.minimum(100 * h0, jnp.where(flat, jnp.maximum(1e-6, h0 * 1e-3), h1))
    h = jnp.where(jnp.isfinite(h), h, h0 * 1e-3)
    return f, lax.stop_gradient(h.astype(x.dtype))


def _term(field: RightHandSide) -> dfx.ODETerm[Any]:
    def rates(t: Any, x: State, args: Any) -> State:
        return field(t, x)

    return dfx.ODETerm(rates)
