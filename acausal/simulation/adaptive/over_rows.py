"""Integrate a model over rows of samples in adaptive steps, as `fixed_steps.integrate` does in fixed ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal.codegen import Field, Packed, Values
from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.adaptive.search import REACHED
from acausal.simulation.adaptive.solve import solve
from acausal.simulation.fixed_steps import Integrated, Runs, Step, Steps
from acausal.simulation.solvers import Solver

if TYPE_CHECKING:
    from acausal.system import System

STEPS_PER_ROW = 100
"""Steps, at most, that a row takes on average: where an input has a corner, stiff methods begin with short ones."""

FEWEST = 1000
"""Steps that are allowed in any case."""


@dataclass(frozen=True)
class Adaptive:
    """Adaptive steps, where fixed ones are usual.

    Attributes:
        solver: one with an error estimate; ``None``: Tsit5, and BDF from where the model is stiff.
        rtol: relative tolerance of a step. atol: absolute tolerance, in the states' units.
    """

    solver: Solver | None = None
    rtol: float = 1e-6
    atol: float = 1e-8


class Clock(eqx.Module):
    """The right-hand side by a clock that goes on from row to row, through all runs.

    Attributes:
        packed: parameters. steps: the rows. edges: the clock at their starts, and at the end.
        own: numbers that differ from row to row; places: where they lie in `Packed.values`.
        d: discrete variables, or None.
    """

    packed: Packed
    steps: Steps
    edges: Float[Array, " n_1"]
    own: Float[Array, "n n_own"] | None
    places: tuple[int, ...] = eqx.field(static=True)
    system: Any = eqx.field(static=True)
    d: Float[Array, " n_discrete"] | None = None

    @staticmethod
    def of(system: System, packed: Packed, steps: Steps, runs: Runs | None) -> Clock:
        """The clock of some rows."""
        lengths = jnp.broadcast_to(steps.h, (len(steps.t),))
        edges = jnp.concatenate([jnp.zeros(1, lengths.dtype), jnp.cumsum(lengths)])
        own, places = (None, ()) if runs is None else (runs.own, runs.places)
        return Clock(packed, steps, edges, own, places, system)

    def with_modes(self, d: Float[Array, " n_discrete"] | None) -> Clock:
        """The same with discrete variables."""
        return Clock(self.packed, self.steps, self.edges, self.own, self.places, self.system, d)

    def __call__(self, t: Array, x: Float[Array, " n_states"]) -> Float[Array, " n_states"]:
        """The derivatives of the states."""
        return self.at(t)(x)

    def at(self, t: Array) -> Field:
        """It at one time of the clock."""
        steps, edges = self.steps, self.edges
        row = jnp.clip(jnp.searchsorted(edges, t, side="right") - 1, 0, len(edges) - 2)
        begin, start, end, coefficients = (
            jax.tree.map(lambda a: a[row], part)
            for part in (
                steps.t,
                steps.inputs.start,
                steps.inputs.end,
                steps.inputs.coefficients,
            )
        )
        h = steps.h if steps.h.ndim == 0 else steps.h[row]
        step = Step(begin, h, start, end, coefficients)
        fraction = (t - edges[row]) / h
        u = step.inputs(fraction, steps.inputs.functions)
        packed = self.packed
        if self.own is not None:
            packed = packed.replaced(self.places, self.own[row])
        return self.system.field(step.time(fraction), u, packed, self.d)


def integrate_adaptively(
    system: System,
    start: Values,
    steps: Steps,
    adaptive: Adaptive,
    *,
    outputs: Sequence[str] = (),
    direct: bool = False,
    runs: Runs | None = None,
) -> Integrated:
    """Integrate the model over some rows. Pure: trace, differentiate and map it.

    Arguments:
        system, start, outputs, direct, runs: as for `fixed_steps.integrate`.
        steps: the n rows and their inputs; steps end at each where the model has inputs.
        adaptive: the steps.

    Returns:
        States and outputs at the rows' starts, and the state at the end; NaN from where a step cannot be made.
    """
    n, dtype = len(steps.t), start.x.dtype
    field = Clock.of(system, start.packed, steps, runs)
    edges = field.edges
    restarts = None if runs is None else runs.restarts
    inner = edges[1:-1]
    if system.inputs and n > 1:
        jumps = jnp.any(steps.inputs.end[:-1] != steps.inputs.start[1:], axis=1)
    else:
        jumps = jnp.zeros(n - 1, bool)
        inner, jumps = (inner, jumps) if restarts is not None else (inner[:0], jumps[:0])
    begins = first = None
    if restarts is not None:
        begins, first = restarts.begins[1:], restarts.first[1:]
        jumps = jumps | begins
    problem = Problem(
        field,
        start.x,
        edges[0],
        edges[-1],
        edges[:-1],
        inner,
        jumps,
        jnp.asarray(adaptive.rtol, dtype),
        jnp.asarray(adaptive.atol, dtype),
        STEPS_PER_ROW * n + FEWEST,
        begins,
        first,
    )
    found = solve(problem, adaptive.solver, system.state_jacobian, forward=direct).found
    x = found.saved
    if restarts is not None:
        x = jnp.where(restarts.begins[:, None], restarts.first, x)
    reached = found.why == REACHED
    end = jnp.where(reached, found.x, jnp.nan)
    if not outputs:
        return Integrated(x, None, end)

    def read(clock: Array, x: Array) -> Array:
        at = field.at(clock)
        return system.read(tuple(outputs), Values(at.t, x, at.u, at.packed))

    return Integrated(x, jax.vmap(read)(edges[:-1], x), end)
