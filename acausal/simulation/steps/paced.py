"""Steps of a given length, up to the next time at which steps end."""

from __future__ import annotations

from typing import Any, ClassVar

import jax.numpy as jnp
from jaxtyping import Array

from acausal.simulation.steps.one_step import Made, Memory, OneStep, part_of_step
from acausal.simulation.steps.problem import Attempt, Counts, Integration, RightHandSide
from acausal.simulation.steps.runge_kutta import Explicit


class Paced(OneStep):
    """A one-step scheme whose steps count whatever their error is, and go from each known time to the next.

    Attributes:
        scheme: makes the steps.
    """

    scheme: OneStep

    def first(self, field: RightHandSide, t: Array, h: Array, x: Array, f: Array) -> Any:
        """What a step may use that begins here."""
        return self.scheme.first(field, t, h, x, f)

    def make(self, field: RightHandSide, t: Array, h: Array, x: Array, first: Any) -> Made:
        """One step."""
        made = self.scheme.make(field, t, h, x, first)
        knows = isinstance(self.scheme, Explicit)
        begin = first if knows else field(t, x)
        end = made.first if knows else field(t + h, made.x)
        return made._replace(dense={"ends": (x, made.x), "rates": (begin, end)})

    def between(self, dense: Any, t: Array, h: Array, at: Array) -> Array:
        """The state at a time within a step: on the cubic through its ends."""
        (x0, x1), (f0, f1), s = dense["ends"], dense["rates"], part_of_step(t, h, at)
        bend = (1 - 2 * s) * (x1 - x0) + (s - 1) * h * f0 + s * h * f1
        return (1 - s) * x0 + s * x1 + s * (s - 1) * bend

    def begin(self, problem: Integration, t: Array, x: Array) -> tuple[Memory, Counts]:
        """What is known at the begin, or after an event."""
        h = jnp.full_like(t, jnp.inf)
        zero = jnp.zeros((), jnp.int32)
        first = self.first(problem.field, t, jnp.ones_like(t), x, problem.field(t, x))
        return Memory(h, x, first, zero, zero), Counts.of(rates=1)

    chooses: ClassVar[bool] = False
    """Its steps are given."""

    def attempt(self, problem: Integration, memory: Memory, t: Array, h: Array) -> Attempt:
        """Make a step of length h from t."""
        made = self.make(problem.field, t, h, memory.x, memory.first)
        done = made.done & jnp.all(jnp.isfinite(made.x))
        again = jnp.where(done, jnp.inf, 0.0)  # it would be the same step
        after = memory._replace(h=again.astype(h.dtype), x=made.x, first=made.first)
        never = jnp.array(False)
        return Attempt(done, made.x, after, made.dense, (), never, never, made.counts)
