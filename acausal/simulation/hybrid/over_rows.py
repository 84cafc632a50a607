"""Integrate a model with events over rows of samples, as `fixed_steps.integrate` does a model without."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import diffrax as dfx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal.codegen import Values
from acausal.simulation.adaptive.one_step import Foreign
from acausal.simulation.adaptive.over_rows import (
    FEWEST,
    STEPS_PER_ROW,
    Adaptive,
    Clock,
)
from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.adaptive.runge_kutta import Explicit
from acausal.simulation.adaptive.search import REACHED
from acausal.simulation.fixed_steps import Integrated, Runs, Steps
from acausal.simulation.hybrid.paced import Paced
from acausal.simulation.hybrid.solve import solve
from acausal.simulation.log import Log
from acausal.simulation.solvers import Scheme, Solver

if TYPE_CHECKING:
    from acausal.system import System

EVENTS_PER_ROW = 4
"""Steps of given length that a row takes on average, at most: events divide some."""


def integrate_with_events(
    system: System,
    start: Values,
    steps: Steps,
    solver: Scheme | Adaptive,
    *,
    substeps: int = 1,
    outputs: Sequence[str] = (),
    direct: bool = False,
    runs: Runs | None = None,
) -> Integrated:
    """Integrate a model with events over some rows. Pure: trace, differentiate and map it.

    Arguments:
        system, start, steps, substeps, outputs, direct, runs: as for `fixed_steps.integrate`.
        solver: of fixed steps, or adaptive ones.

    Returns:
        States and outputs at the rows' starts, and the state at the end; NaN from where a step cannot be made.
    """
    events = system.events
    assert events is not None
    clock = Clock.of(system, start.packed, steps, runs)
    edges = clock.edges
    n, dtype = len(edges) - 1, start.x.dtype
    jumps = jnp.zeros(n - 1, bool)
    if system.inputs and n > 1:
        jumps = jnp.any(steps.inputs.end[:-1] != steps.inputs.start[1:], axis=1)
    method, breaks, most = _method(solver, edges, substeps)
    adaptive = solver if isinstance(solver, Adaptive) else Adaptive()
    place = jnp.arange(1, n) * (substeps if not isinstance(solver, Adaptive) else 1) - 1

    def spread(rows: Array) -> Array:
        """Of inner edges, what belongs to the breaks."""
        return jnp.zeros((len(breaks), *rows.shape[1:]), rows.dtype).at[place].set(rows)

    d0 = system.modes(start).d
    restarts = None if runs is None else runs.restarts
    others: tuple[Any, ...] = ()
    if runs is not None and restarts is not None:
        begins = restarts.begins[1:]
        first, first_d = _firsts(system, clock, runs)
        jumps = jumps & ~begins
        others = spread(begins), spread(first), spread(first_d)
    problem = Problem(
        clock.with_modes(d0),
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
    )
    assert d0 is not None
    log = Log.empty(len(start.x) + len(d0), dtype, values=0)
    found = solve(problem, events, d0, method, system.state_jacobian, forward=direct, log=log).found
    x, d = found.saved, found.saved_d
    if restarts is not None:
        x = jnp.where(restarts.begins[:, None], restarts.first, x)
    end = jnp.where(found.why == REACHED, found.x, jnp.nan)
    if not outputs:
        return Integrated(x, None, end, found.log)

    def read(at: Array, x: Array, d: Array) -> Array:
        return system.read(tuple(outputs), clock.with_modes(d).at(at).values(x))

    return Integrated(x, jax.vmap(read)(edges[:-1], x, d), end, found.log)


def _method(
    solver: Scheme | Adaptive, edges: Float[Array, " n_1"], substeps: int
) -> tuple[Paced | Solver | None, Float[Array, " n_breaks"], int]:
    """The method, the times at which steps end, and how many steps there may be."""
    n = len(edges) - 1
    if isinstance(solver, Adaptive):
        return solver.solver, edges[1:-1], STEPS_PER_ROW * n + FEWEST
    scheme = Explicit(solver) if isinstance(solver, dfx.AbstractERK) else Foreign(solver)
    parts = jnp.arange(1, substeps + 1, dtype=edges.dtype) / substeps
    ends = edges[:-1, None] + parts * jnp.diff(edges)[:, None]
    ends = ends.at[:, -1].set(edges[1:])
    return Paced(scheme), ends.ravel()[:-1], EVENTS_PER_ROW * n * substeps + FEWEST


def _firsts(
    system: System, clock: Clock, runs: Runs
) -> tuple[Float[Array, "n_inner n_states"], Float[Array, "n_inner n_discrete"]]:
    """With which states and discrete variables further runs begin, at the inner edges; only there they count."""
    begins, first = runs.restarts.begins[1:], runs.restarts.first[1:]
    rows = jnp.flatnonzero(begins, size=max(runs.count - 1, 1), fill_value=0)

    def one(t: Array, x: Array) -> tuple[Array, Array]:
        found = system.modes(clock.at(t).values(x))
        assert found.d is not None
        return found.x, found.d

    x, d = jax.vmap(one)(clock.edges[1:-1][rows], first[rows])
    empty = jnp.zeros((len(begins), d.shape[1]), d.dtype)
    return first.at[rows].set(x), empty.at[rows].set(d)
