"""What is integrated in adaptive steps, and the numbers that a run leaves behind."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace
from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal.codegen import Field
from acausal.events import Ahead, Due, Events, due
from acausal.simulation.newton import Tolerances

SIDE = 16.0
"""Two times are apart if they differ by so many rounding errors."""

EDGE_STEPS = 8
"""So many more steps are allowed for each edge of the right-hand side, all in all so many times ``max_steps``; and for
each jump or kink of an input."""


class RightHandSide(eqx.Module):
    """The right-hand side of a model whose parameters and inputs are given: (time, state) -> derivative.

    Attributes:
        system: the model.
        d: discrete variables, or None. until: inputs do not jump before this time, nor there; None: they may.
    """

    system: Any = eqx.field(static=True, kw_only=True)
    d: Float[Array, " n_discrete"] | None = eqx.field(default=None, kw_only=True)
    until: Float[Array, ""] | None = eqx.field(default=None, kw_only=True)

    @property
    def has_edges(self) -> bool:
        """Whether times are known ahead at which it jumps or bends, or how long a step may be."""
        return bool(self.system.edges)

    @property
    def bends(self) -> bool:
        """Whether it jumps or bends somewhere that depends on states or inputs."""
        return self.system.edges.bends

    @property
    def is_long(self) -> bool:
        """Whether it takes long to compile: then there is one copy of it in a step, in a loop over the stages."""
        return self.system.program.is_long

    @abstractmethod
    def ahead(self, t: Array, apart: Array) -> Ahead:
        """What is known of the time to come, as of `Edges.ahead`."""

    @abstractmethod
    def at(self, t: Array) -> Field:
        """It at one time, as a function of the states."""

    def shift(self, t: Array) -> Array:
        """The model's time less the one that it is asked by."""
        return jnp.zeros_like(t)

    def due(self, events: Events, t: Array, x: Float[Array, " n_states"]) -> Due:
        """When conditions change whose time is known."""
        found = due(events, self.at(t).values(x))
        return found._replace(t=found.t - self.shift(t))

    @property
    def has_turns(self) -> bool:
        """Whether conditions depend on sines of states."""
        return bool(self.system.edges.phases)

    def turn(self, t: Array, x: Float[Array, " n_states"]) -> Array:
        """How long a step may be for these, as of `Edges.turn`."""
        field = self.at(t)
        return self.system.edges.turn(field.values(x), field(x))

    def __call__(self, t: Array, x: Float[Array, " n_states"]) -> Float[Array, " n_states"]:
        """The derivatives of the states."""
        return self.at(t)(x)


class Sided(RightHandSide):
    """A right-hand side between two edges: it sees no time beyond them, whatever rounding and stages say."""

    field: RightHandSide
    low: Float[Array, ""]
    high: Float[Array, ""]

    @property
    def has_edges(self) -> bool:
        """It has none but its ends."""
        return False

    def ahead(self, t: Array, apart: Array) -> Ahead:
        """As the whole."""
        return self.field.ahead(t, apart)

    def shift(self, t: Array) -> Array:
        """As of the whole."""
        return self.field.shift(t)

    def at(self, t: Array) -> Field:
        """It at one time; that is moved by rounding errors only, so its derivative stays."""
        inside = jnp.clip(t, self.low, self.high).astype(jnp.result_type(t))
        return self.field.at(t + lax.stop_gradient(inside - t))


class Integration(eqx.Module):
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
        max_step: the longest step, in seconds; None: as long as its error allows.
        max_tries: limit of steps, those that only search for the instant of an event included; None: none.
        until_stiff: whether to stop where stability limits the steps.
        forward: whether derivatives in forward mode must work, of any order, and none in reverse mode.
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
    max_step: Float[Array, ""] | None = None
    max_tries: int | None = eqx.field(static=True, default=None)
    until_stiff: bool = eqx.field(static=True, default=False)
    forward: bool = eqx.field(static=True, default=False)

    @property
    def watched(self) -> Events:
        """The events of a model that has some."""
        assert self.events is not None
        return self.events

    def held(
        self, d: Float[Array, " n_discrete"] | None, until: Float[Array, ""] | None = None
    ) -> Integration:
        """The problem between two events; up to a time at which inputs may jump, they are what they are before it.

        Stages of a step lie at its end, and beyond it (Kvaerno5): what they read there would belong to the next step,
        and how the state grows with the step's length would be wrong.
        """
        if until is not None:
            until = lax.stop_gradient(until)  # `nextafter` has no derivative
            until = jnp.nextafter(until, jnp.full_like(until, -jnp.inf))
        d = self.field.d if d is None else d
        return replace(self, field=replace(self.field, d=d, until=until))

    def apart(self, t: Float[Array, ""]) -> Float[Array, ""]:
        """How far another time must be from one to be another."""
        eps = SIDE * jnp.finfo(jnp.result_type(t)).eps
        return lax.stop_gradient(eps * jnp.maximum(jnp.abs(t), self.end - self.begin))

    def ahead(self, t: Float[Array, ""]) -> Ahead:
        """The next edges behind a time, and how long a step may be until then."""
        dtype = jnp.result_type(t)
        found = self.field.ahead(t, self.apart(t))
        return Ahead(*(jnp.asarray(v, dtype) for v in found))

    def sided(self, t: Float[Array, ""], edge: Float[Array, ""]) -> Integration:
        """The problem between a time and the next edge behind it."""
        low, high = lax.stop_gradient((t + self.apart(t), edge - self.apart(t)))
        f = self.field
        sided = Sided(f, low, high, system=f.system, d=f.d, until=f.until)
        return replace(self, field=sided)

    def behind(self, t: Float[Array, ""]) -> Integration:
        """The problem behind a time at which something has happened: an edge there is seen from its other side."""
        return self.sided(t, jnp.full_like(t, jnp.inf)) if self.field.has_edges else self

    @property
    def tolerances(self) -> Tolerances:
        """Of a step."""
        return Tolerances(self.rtol, self.atol)


class Counts(NamedTuple):
    """What a run has cost.

    Attributes:
        steps: accepted. rejected: repeated with a shorter length, for their error or because they were not solved.
        rates: evaluations of the right-hand side.
        jacobians: evaluations of its Jacobian, each factorized.
        corrections: Newton steps.
        edges: steps that end at an edge. by_wave, by_span: steps as long as a sine, or `max_step`, allows.
        looks: steps that are repeated for what a look inside has shown.
        searches: steps that only search for the instant of an event.
        undefined: steps at whose end a condition's number is NaN.
    """

    steps: Int[Array, ""]
    rejected: Int[Array, ""]
    rates: Int[Array, ""]
    jacobians: Int[Array, ""]
    corrections: Int[Array, ""]
    edges: Int[Array, ""]
    by_wave: Int[Array, ""]
    by_span: Int[Array, ""]
    looks: Int[Array, ""]
    searches: Int[Array, ""]
    undefined: Int[Array, ""]

    @staticmethod
    def of(**numbers: Any) -> Counts:
        """Some numbers, the others zero."""
        return Counts(*(jnp.asarray(numbers.get(n, 0), jnp.int32) for n in Counts._fields))

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
