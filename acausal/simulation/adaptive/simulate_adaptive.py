"""Simulation in adaptive steps."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import cast, known, traced
from acausal.codegen import Field, Packed
from acausal.errors import SimulationError, StepLimitError
from acausal.simulation import solvers
from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.adaptive.search import EXHAUSTED, REACHED, Found
from acausal.simulation.adaptive.solve import solve
from acausal.simulation.adaptive.tolerances import Tolerance
from acausal.simulation.inputs import TimeFunction, breaks, evaluate, evaluate_all
from acausal.simulation.run import Run
from acausal.simulation.solution import Solution
from acausal.simulation.statistics import Statistics


class ModelField(eqx.Module):
    """The right-hand side of a model whose parameters and inputs are given: (time, state) -> derivative.

    Attributes:
        packed: parameters.
        inputs: functions of time.
        system: the model.
        d: discrete variables, or None.
    """

    packed: Packed
    inputs: tuple[TimeFunction, ...]
    system: Any = eqx.field(static=True)
    d: Float[Array, " n_discrete"] | None = None

    def at(self, t: Array) -> Field:
        """It at one time."""
        return self.system.field(t, evaluate(self.inputs, t), self.packed, self.d)

    def __call__(self, t: Array, x: Float[Array, " n_states"]) -> Float[Array, " n_states"]:
        """The derivatives of the states."""
        return self.at(t)(x)


def simulate_adaptive(
    run: Run,
    saved: Float[np.ndarray, " n"],
    solver: solvers.Solver | None,
    rtol: Tolerance,
    atol: Tolerance,
    max_steps: int,
    dtype: np.dtype[Any],
    *,
    forward: bool = False,
) -> Solution:
    """Simulate in steps whose lengths follow their errors, and that end where an input is known to jump.

    Arguments:
        run: what to simulate.
        saved: times to save.
        solver: a solver with an error estimate; ``None``: Tsit5, and BDF from where the model is stiff.
        rtol: relative tolerance of a step.
        atol: absolute tolerance, in the states' units.
        max_steps: limit of steps.
        dtype: precision of time and states.
        forward: allow derivatives in forward mode only, of any order.

    Raises:
        SimulationError: if the end is not reached.
    """
    ends = breaks(run.inputs, run.begin, run.end)
    problem = Problem(
        ModelField(run.start.packed, run.inputs, run.system),
        run.start.x,
        jnp.asarray(run.begin),
        jnp.asarray(run.end),
        jnp.asarray(saved),
        jnp.asarray(ends.ts),
        jnp.asarray(ends.jumps),
        jnp.asarray(rtol, float),
        jnp.asarray(atol, float),
        max_steps,
    )
    problem = cast(problem, dtype)
    solved = solve(problem, solver, run.system.state_jacobian, forward=forward)
    found, c = solved.found, solved.found.counts
    if (why := known(found.why)) is not None and not traced(found.saved):
        _check(run, saved, found, int(why), max_steps, solved.method, solver is None)
    statistics = Statistics(
        solved.method, c.steps, c.rejected, c.rates, c.jacobians, c.corrections, solved.stiff_from
    )
    u = evaluate_all(run.inputs, problem.ts)
    values = cast(run.start, dtype)._replace(t=problem.ts, x=found.saved, u=u)
    return Solution(values, run.system, statistics)


def _check(
    run: Run,
    ts: Float[np.ndarray, " n"],
    found: Found,
    why: int,
    max_steps: int,
    name: str,
    automatic: bool,
) -> None:
    if why == REACHED:
        return run.refuse_broken(found.saved, ts, name)
    reached = float(found.t)
    where = f"The simulation with {name} stopped at t = {reached:g} s, before {run.end:g} s"
    exhausted = why == EXHAUSTED
    ahead = (run.end - run.begin) / max_steps if exhausted else run.end - reached
    if reason := run.explain(run.at(reached, found.x), ahead):
        raise SimulationError(f"{where}.{reason}")
    if not exhausted:
        raise SimulationError(
            f"{where}: its steps became too small, or its values not finite. "
            "The model may diverge there: check its parameters, initial values and inputs."
        )
    hint = "" if automatic else "it is stiff (choose solver='auto' or 'bdf'), "
    raise StepLimitError(
        f"{where}, after max_steps={max_steps}. Perhaps {hint}it diverges there, "
        "or its inputs are rough (raise max_steps, loosen rtol, or give dt for fixed steps)."
    )
