"""One simulation of a model, whatever its steps: where it starts, its inputs, and its modes at the start."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, cast

import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float
from numpy.typing import NDArray

from acausal._jax import compiled, traced
from acausal.codegen import Values, explain_jump, said_by_modules
from acausal.errors import SimulationError
from acausal.events import Events, coincide, guards
from acausal.simulation.finite import explain_ahead
from acausal.simulation.inputs import TimeFunction, evaluate
from acausal.simulation.stability import modes

if TYPE_CHECKING:
    from acausal.system import System

RUN_AWAY = 1e30
"""States larger than this, in units of their nominal values or of their start, have run away."""

APART = 4.0
"""Instants of a clock that are nearer to each other, in units of times that are the same instant, are one event."""

EIGENVALUES = 300
"""Models with more states are not examined: dense Jacobians would not pay."""


class Run(NamedTuple):
    """The task of one simulation.

    Attributes:
        system: the model.
        start: the values of the model at the start; its time is a number.
        inputs: the model's inputs as functions of time.
        end: the last time, in seconds.
    """

    system: System
    start: Values
    inputs: tuple[TimeFunction, ...]
    end: float

    @property
    def begin(self) -> float:
        """The first time, in seconds."""
        return cast(float, self.start.t)

    def at(self, t: ArrayLike, x: Float[Array | np.ndarray, " n_states"]) -> Values:
        """The values of the model at a time and a state."""
        return self.start._replace(t=t, x=jnp.asarray(x), u=evaluate(self.inputs, t))

    def check_start(self) -> None:
        """Refuse an initial state, or inputs or discrete variables at the start, that are not finite."""
        found = (
            ("The initial value of", self.system.states, self.start.x),
            ("At the start, the input", self.system.inputs, self.start.u),
        )
        for what, names, values in found:
            if traced(values):
                continue
            bad = np.flatnonzero(~np.isfinite(np.asarray(values)))
            if len(bad):
                raise SimulationError(
                    f"{what} '{names[bad[0]]}' is {float(values[bad[0]])}.{self.said()}"
                )

        d = self.start.d
        if d is not None and not traced(d) and not np.isfinite(np.asarray(d)).all():
            place = int(np.argmin(np.isfinite(np.asarray(d))))
            what = self.system.describe_discrete(place)
            period = ", as its period is not above zero" if "sample(" in what else ""
            raise SimulationError(
                f"At the start '{what}' is {float(d[place])}{period}.{self.said()}"
            )
        check_clocks(self.system, self.start, self.end)

    def said(self) -> str:
        """What modules say of numbers that are not finite, as a further sentence; empty where they say nothing."""
        said = said_by_modules(self.start.packed.modules)
        return f" {said}" if said else ""

    def modes(self) -> NDArray[np.complex128]:
        """Eigenvalues of the Jacobian at the start, shape (n,), in 1/s.

        There are none while JAX traces, nor for models with more than `EIGENVALUES` states.
        """
        nothing = np.zeros(0, complex)
        if traced(self.start, self.inputs) or not 0 < len(self.start.x) <= EIGENVALUES:
            return nothing
        t = np.reshape(self.start.t, 1)
        found = modes(
            self.system, self.start._replace(t=t, x=self.start.x[None], u=self.start.u[None])
        )
        return nothing if found is None else found[0]

    @property
    def limits(self) -> Float[np.ndarray, " n_states"]:
        """The magnitudes beyond which states have run away."""
        return limits_of(self.system, self.start.x)

    def broken(self, x: Float[Array | np.ndarray, "n n_states"]) -> tuple[int, str] | None:
        """The first of some points at which a state is not finite or has run away, and a clause on it; or None."""
        x, limits = np.asarray(x), self.limits
        if np.max(np.abs(x), initial=0.0) < np.min(limits, initial=np.inf):
            return None
        with np.errstate(invalid="ignore"):
            good = np.abs(x) < limits
        if good.all():
            return None
        row = int(np.argmin(good.all(axis=1)))
        i = int(np.argmin(good[row]))
        name, value = self.system.states[i], float(x[row, i])
        if not np.isfinite(value):
            return row, f"'{name}' is not finite"
        by_nature = "(if that is its usual size, give its start a nominal value)"
        return row, f"'{name}' has run away to {value:.3g} {by_nature}"

    def refuse_broken(
        self, x: Float[Array | np.ndarray, "n n_states"], ts: Float[np.ndarray, " n"], name: str
    ) -> None:
        """Refuse states, at their times, that are `broken` by the method of some name.

        Raises:
            SimulationError: for them.
        """
        if (broken := self.broken(x)) is not None:
            row, what = broken
            raise SimulationError(
                f"The simulation with {name} broke down before t = {ts[row]:g} s: {what}. "
                "The model may diverge there: check its parameters, initial values and inputs."
            )

    def explain(self, at: Values, ahead: float) -> str:
        """Find the equation without a finite value at a point, or within some seconds along its derivative.

        Returns:
            A sentence; an empty text where nothing is found, or where the state itself has run away.
        """
        if not (np.abs(at.x) < self.limits).all():
            return ""

        def later(t: ArrayLike, x: Array) -> Values:
            return self.at(t, x)._replace(d=at.d)

        reason = explain_ahead(self.system, later, at, ahead)
        return "" if reason is None else f" There {reason}"

    def explain_jump(self, at: Values, ahead: float) -> str | None:
        """A clause on a formula that jumps at a point, within some seconds along its derivative, or None."""
        other = at._replace(x=at.x + ahead * self.system.rates(at))
        return explain_jump(self.system.program, at, other, self.system.reduced.name)


def limits_of(
    system: System, start: Float[Array | np.ndarray, " n_states"]
) -> Float[np.ndarray, " n_states"]:
    """The magnitudes beyond which states have run away, by those at the start."""
    return RUN_AWAY * np.maximum(system.nominal, np.abs(np.asarray(start)))


def check_clocks(system: System, start: Values, end: float) -> None:
    """Refuse clocks whose instants count as one between a start and an end [s]: events miss those behind the first.

    Raises:
        SimulationError: for them.
    """
    events = system.events
    if events is None or start.d is None or not events.ticks.any() or traced(start):
        return
    period, begin = np.asarray(_periods(events.clocks, start)), float(np.asarray(start.t))
    longest = max(abs(begin), abs(end), end - begin)
    least = APART * coincide(start.x.dtype) * longest
    fast = period < least
    if fast.any():
        i = int(np.argmax(fast))
        clock = events.describe(int(np.flatnonzero(events.ticks)[i]))
        raise SimulationError(
            f"'{clock}' ticks every {float(period[i]):.3g} s, which times up to {longest:g} s cannot "
            f"tell apart: give a period of {least:.3g} s or more, or a shorter span of time."
        )


@compiled
def _periods(clocks: Events, at: Values) -> Float[Array, " n_clocks"]:
    """How long after a tick each clock ticks again."""
    assert at.d is not None
    return guards(clocks, at) - guards(clocks, at._replace(d=at.d + 1))
