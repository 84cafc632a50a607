"""Integrate a model over rows of samples in adaptive steps, or in fixed ones that end at events.

`fixed_steps.integrate` does the same in fixed steps for a model without events.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal.codegen import Field, Packed, Values
from acausal.events import Ahead
from acausal.simulation.fixed_steps import Integrated, Runs, Steps
from acausal.simulation.log import Log
from acausal.simulation.sampled_inputs import Samples
from acausal.simulation.solvers import Scheme, Solver
from acausal.simulation.steps.loop import REACHED
from acausal.simulation.steps.methods import paced
from acausal.simulation.steps.problem import Integration, RightHandSide
from acausal.simulation.steps.solve import first_run, solve

if TYPE_CHECKING:
    from acausal.system import System

STEPS_PER_ROW = 100
"""Steps, at most, that a row takes on average: where an input has a corner, stiff methods begin with short ones."""

EVENTS_PER_ROW = 4
"""Steps of given length that a row takes on average, at most: events divide some."""

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


class Clock(RightHandSide):
    """The right-hand side by a clock that goes on from row to row, through all runs.

    Attributes:
        packed: parameters. steps: the rows. edges: the clock at their starts, and at the end.
        own: numbers that differ from row to row; places: where they lie in `Packed.values`.
        system, d, until: see `RightHandSide`.
    """

    packed: Packed
    steps: Steps
    edges: Float[Array, " n_1"]
    own: Float[Array, "n n_own"] | None
    places: tuple[int, ...] = eqx.field(static=True)

    @staticmethod
    def of(system: System, packed: Packed, steps: Steps, runs: Runs | None) -> Clock:
        """The clock of some rows."""
        lengths = jnp.broadcast_to(steps.h, (len(steps.t),))
        edges = jnp.concatenate([jnp.zeros(1, lengths.dtype), jnp.cumsum(lengths)])
        own, places = (None, ()) if runs is None else (runs.own, runs.places)
        return Clock(packed, steps, edges, own, places, system=system)

    def with_discrete(self, d: Float[Array, " n_discrete"] | None) -> Clock:
        """The same with discrete variables."""
        return replace(self, d=d)

    @property
    def has_edges(self) -> bool:
        """Whether times are known ahead at which it jumps or bends."""
        return super().has_edges or self.steps.parts is not None

    def ahead(self, t: Array, apart: Array) -> Ahead:
        """The next of these times, by the clock; within a row, as another run may begin behind it."""
        row, shift = self._row(t + apart), self.shift(t + apart)
        found = self.system.edges.ahead(self._packed(row), t + shift, apart, self.d)
        jump = found.jump - shift
        if self.steps.parts is not None:
            cuts = self.edges[row] + self.steps.parts.cuts[row] * self._length(row)
            jump = jnp.minimum(jump, jnp.min(jnp.where(cuts > t + apart, cuts, jnp.inf)))
        return Ahead(jump, found.bend - shift, found.longest)

    def shift(self, t: Array) -> Array:
        """The time of the records less that of the clock."""
        row = self._row(t)
        return self.steps.t[row] - self.edges[row]

    def _row(self, t: Array) -> Array:
        """In which row a time lies."""
        row = jnp.searchsorted(self.edges, t, side="right") - 1
        return jnp.clip(row, 0, len(self.edges) - 2)

    def _packed(self, row: Array) -> Packed:
        """The parameters of a row."""
        return self.packed if self.own is None else self.packed.replaced(self.places, self.own[row])

    def _length(self, row: Array) -> Array:
        """Of a row."""
        return self.steps.h if self.steps.h.ndim == 0 else self.steps.h[row]

    def at(self, t: Array) -> Field:
        """It at one time of the clock."""
        steps, inputs = self.steps, self.steps.inputs
        row = self._row(t if self.until is None else jnp.minimum(t, self.until))
        begin, start, end, coefficients, parts = (
            jax.tree.map(lambda a: a[row], part)
            for part in (steps.t, inputs.start, inputs.end, inputs.coefficients, steps.parts)
        )
        h = self._length(row)
        step = Steps(begin, h, Samples(start, end, inputs.functions, coefficients), parts)
        fraction = (t - self.edges[row]) / h
        return self.system.field(
            step.time(fraction), step.inputs_at(fraction), self._packed(row), self.d
        )


def integrate_in_steps(
    system: System,
    start: Values,
    steps: Steps,
    solver: Scheme | Adaptive,
    *,
    substeps: int = 1,
    outputs: Sequence[str] = (),
    direct: bool = False,
    runs: Runs | None = None,
    tries: int | None = None,
    discrete: Float[Array, "R n_discrete"] | None = None,
) -> Integrated:
    """Integrate the model over some rows. Pure: trace, differentiate and map it.

    Arguments:
        system, start, substeps, outputs, direct, runs: as for `fixed_steps.integrate`. Discrete variables begin as
            ``start`` says, else as agrees with the states.
        discrete: the start values of discrete variables in each run; by default those of the model.
        steps: the n rows and their inputs; steps end at each where the model has inputs, or events.
        solver: adaptive steps; or, for a model with events, a scheme of fixed ones.
        tries: so many steps of given length that a row takes on average at most, those that only search for the instant
            of an event included; ``None``: as many as it takes.

    Returns:
        What holds at the rows' starts and at the end; states are NaN from where a step cannot be made.
    """
    events, dtype = system.events, start.x.dtype
    d0 = None
    if events is not None:
        d0 = start.d
        if d0 is None:
            d0 = system.modes(start if discrete is None else start._replace(d=discrete[0])).d
    clock = Clock.of(system, start.packed, steps, runs).with_discrete(d0)
    edges, n = clock.edges, len(steps.t)
    restarts = None if runs is None else runs.restarts
    jumps = jnp.zeros(n - 1, bool)
    if system.inputs and n > 1:
        jumps = jnp.any(steps.inputs.end[:-1] != steps.inputs.start[1:], axis=1)
    if isinstance(solver, Adaptive):
        adaptive, method, parts = solver, solver.solver, 1
        breaks, most = edges[1:-1], STEPS_PER_ROW * n + FEWEST
        if events is None and not system.inputs and restarts is None:
            breaks, jumps = breaks[:0], jumps[:0]
    else:
        adaptive, parts = Adaptive(), substeps
        method = paced(solver, system.state_jacobian, dtype)
        breaks, most = _divided(edges, substeps), EVENTS_PER_ROW * n * substeps + FEWEST
    place = jnp.arange(1, n) * parts - 1

    def spread(rows: Array) -> Array:
        """Of inner edges, what belongs to the breaks."""
        if len(rows) == len(breaks):
            return rows
        return jnp.zeros((len(breaks), *rows.shape[1:]), rows.dtype).at[place].set(rows)

    others: tuple[Any, ...] = None, None, None
    if runs is not None and restarts is not None:
        first = restarts.first[1:], None
        if events is not None:
            first = _firsts(system, clock, runs, discrete)
        others = jax.tree.map(spread, (restarts.begins[1:], *first))
    problem = Integration(
        clock,
        start.x,
        edges[0],
        edges[-1],
        edges[:-1],
        breaks,
        spread(jumps),
        jnp.asarray(adaptive.rtol, dtype),
        jnp.asarray(adaptive.atol, dtype),
        most,
        *others,
        events=events,
        max_tries=None if tries is None else tries * n * parts + FEWEST,
        forward=direct,
    )
    log = None if d0 is None else Log.empty(len(start.x) + len(d0), dtype, values=0)
    found = solve(first_run(problem, method, d=d0, log=log)).found
    x, d = found.saved
    if restarts is not None:
        x = jnp.where(restarts.begins[:, None], restarts.first, x)
    end = jnp.where(found.why == REACHED, found.x, jnp.nan)
    if not outputs:
        return Integrated(x, None, end, found.log, d, found.d)

    def read(at: Array, x: Array, d: Array | None) -> Array:
        return system.read(tuple(outputs), clock.with_discrete(d).at(at).values(x))

    return Integrated(x, jax.vmap(read)(edges[:-1], x, d), end, found.log, d, found.d)


def _divided(edges: Float[Array, " n_1"], substeps: int) -> Float[Array, " n_breaks"]:
    """The times between rows, and those that divide each into equal parts."""
    parts = jnp.arange(1, substeps + 1, dtype=edges.dtype) / substeps
    ends = edges[:-1, None] + parts * jnp.diff(edges)[:, None]
    return ends.at[:, -1].set(edges[1:]).ravel()[:-1]


def _firsts(
    system: System,
    clock: Clock,
    runs: Runs,
    discrete: Float[Array, "R n_discrete"] | None,
) -> tuple[Float[Array, "n_inner n_states"], Float[Array, "n_inner n_discrete"]]:
    """With which states and discrete variables further runs begin, at the inner edges; only there they count."""
    begins, first = runs.restarts.begins[1:], runs.restarts.first[1:]
    rows = jnp.flatnonzero(begins, size=max(runs.count - 1, 1), fill_value=0)

    def one(t: Array, x: Array, d: Array | None) -> tuple[Array, Array]:
        found = system.modes(clock.at(t).values(x)._replace(d=d))
        assert found.d is not None
        return found.x, found.d

    further = None if discrete is None else discrete[1:]
    x, d = jax.vmap(one)(clock.edges[1:-1][rows], first[rows], further)
    empty = jnp.zeros((len(begins), d.shape[1]), d.dtype)
    return first.at[rows].set(x), empty.at[rows].set(d)
