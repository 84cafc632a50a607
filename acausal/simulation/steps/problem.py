"""What is integrated in adaptive steps, and the numbers that a run leaves behind."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import equinox as eqx
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal.codegen import Events, Field


class RightHandSide(Protocol):
    """The right-hand side of a model whose parameters and inputs are given.

    Attributes:
        d: discrete variables, or None. until: inputs do not jump before this time, nor there; None: they may.
    """

    d: Float[Array, " n_discrete"] | None
    until: Float[Array, ""] | None

    def at(self, t: Array) -> Field:
        """It at one time, as a function of the states."""
        ...

    def __call__(self, t: Array, x: Float[Array, " n_states"]) -> Float[Array, " n_states"]:
        """The derivatives of the states."""
        ...


class Problem(eqx.Module):
    """A run to be made.

    Attributes:
        field: the right-hand side.
        x: the first state, shape (n_states,).
        begin, end: in seconds.
        ts: times to save, increasing.
        breaks: times between begin and end at which steps end, increasing. jumps: where the field jumps there.
        rtol, atol: tolerances of a step.
        max_steps: limit of steps, those that are repeated included.
        restarts: at which breaks another run begins, if any do. first: with which state.
        first_d: and with which discrete variables.
        events: of the model; None for one without.
    """

    field: RightHandSide
    x: Float[Array, " n_states"]
    begin: Float[Array, ""]
    end: Float[Array, ""]
    ts: Float[Array, " n_saved"]
    breaks: Float[Array, " n_breaks"]
    jumps: Bool[Array, " n_breaks"]
    rtol: Float[Array, "*n_states"]
    atol: Float[Array, "*n_states"]
    max_steps: int = eqx.field(static=True)
    restarts: Bool[Array, " n_breaks"] | None = None
    first: Float[Array, "n_breaks n_states"] | None = None
    first_d: Float[Array, "n_breaks n_discrete"] | None = None
    events: Events | None = eqx.field(static=True, default=None)

    @property
    def watched(self) -> Events:
        """The events of a model that has some."""
        assert self.events is not None
        return self.events

    def held(
        self, d: Float[Array, " n_discrete"] | None, until: Float[Array, ""] | None = None
    ) -> Problem:
        """The problem between two events; up to a time at which inputs may jump, they are what they are before it.

        Stages of a step lie at its end, and beyond it (Kvaerno5): what they read there would belong to the next step,
        and how the state grows with the step's length would be wrong.
        """
        if until is not None:
            until = lax.stop_gradient(until)  # `nextafter` has no derivative
            until = jnp.nextafter(until, jnp.full_like(until, -jnp.inf))
        sides = self.field.d if d is None else d, until
        places = lambda p: (p.field.d, p.field.until)  # noqa: E731
        return eqx.tree_at(places, self, sides, is_leaf=lambda leaf: leaf is None)

    def size(
        self, change: Float[Array, " n_states"], *states: Float[Array, " n_states"]
    ) -> Float[Array, ""]:
        """The root mean square of a change over what the tolerances allow at some states."""
        if not change.size:
            return jnp.zeros((), change.dtype)
        largest = jnp.abs(states[0])
        for x in states[1:]:
            largest = jnp.maximum(largest, jnp.abs(x))
        return jnp.sqrt(jnp.mean((change / (self.atol + self.rtol * largest)) ** 2))


class Counts(NamedTuple):
    """What a run has cost.

    Attributes:
        steps: accepted. rejected: repeated with a shorter length, for their error or because they were not solved.
        rates: evaluations of the right-hand side.
        jacobians: evaluations of its Jacobian, each factorized.
        corrections: Newton steps.
    """

    steps: Int[Array, ""]
    rejected: Int[Array, ""]
    rates: Int[Array, ""]
    jacobians: Int[Array, ""]
    corrections: Int[Array, ""]

    @staticmethod
    def of(
        steps: Any = 0, rejected: Any = 0, rates: Any = 0, jacobians: Any = 0, corrections: Any = 0
    ) -> Counts:
        """Some numbers, the others zero."""
        given = (steps, rejected, rates, jacobians, corrections)
        return Counts(*(jnp.asarray(n, jnp.int32) for n in given))

    def plus(self, other: Counts) -> Counts:
        """The sums."""
        return Counts(*(a + b for a, b in zip(self, other, strict=True)))


class Attempt(NamedTuple):
    """What a method found for one step.

    Attributes:
        accepted: whether the step counts.
        x: the state at its end.
        memory: what the method knows next, whether the step counts or not; it holds the length ``h`` to try.
        dense: what `between` needs to interpolate within the step.
        row: what `back` needs to make the step again.
        limited: whether stability would rather have a shorter step.
        stiff: whether it has limited the lengths of the last steps.
        counts: what the attempt has cost.
    """

    accepted: Bool[Array, ""]
    x: Float[Array, " n_states"]
    memory: Any
    dense: Any
    row: Any
    limited: Bool[Array, ""]
    stiff: Bool[Array, ""]
    counts: Counts
