"""Simulation of models with events, in adaptive steps or in fixed ones."""

from __future__ import annotations

from typing import Any

import diffrax as dfx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from acausal._jax import cast, known, traced
from acausal.errors import SimulationError, StepLimitError, listing
from acausal.initialization import restless
from acausal.simulation import solvers
from acausal.simulation.adaptive.one_step import Foreign
from acausal.simulation.adaptive.problem import Problem
from acausal.simulation.adaptive.runge_kutta import Explicit
from acausal.simulation.adaptive.search import EXHAUSTED, REACHED, TOO_SHORT
from acausal.simulation.adaptive.simulate_adaptive import ModelField
from acausal.simulation.adaptive.tolerances import Tolerance
from acausal.simulation.hybrid.paced import Paced
from acausal.simulation.hybrid.search import CROWDED, UNSETTLED, Reached
from acausal.simulation.hybrid.solve import solve
from acausal.simulation.inputs import breaks, evaluate_all
from acausal.simulation.log import FEW_VALUES, VALUES, Log
from acausal.simulation.run import Run
from acausal.simulation.solution import Solution
from acausal.simulation.statistics import Statistics


def simulate_hybrid(
    run: Run,
    saved: Float[np.ndarray, " n"],
    solver: solvers.Solver | None,
    rtol: Tolerance,
    atol: Tolerance,
    max_steps: int,
    dtype: np.dtype[Any],
    *,
    ends: Float[np.ndarray, " n_ends"] | None = None,
    forward: bool = False,
) -> Solution:
    """Simulate a model with events.

    Arguments:
        run, saved, rtol, atol, max_steps, dtype, forward: as for `simulate_adaptive`.
        solver: ``None``: Tsit5, and Kvaerno5 from where the model is stiff.
        ends: of fixed steps; they end at events, too.

    Raises:
        SimulationError: if the end is not reached.
    """
    events, d = run.system.events, run.start.d
    assert events is not None
    assert d is not None
    known_times = breaks(run.inputs, run.begin, run.end)
    ts, jumps = known_times.ts, known_times.jumps
    method: Any = solver
    if ends is not None:
        inner = np.union1d(ts, ends[1:-1])
        jumps = np.isin(inner, ts[jumps])
        ts = inner
        max_steps = max(max_steps, 20 * len(ends))
        chosen = dfx.Tsit5() if solver is None else solver
        scheme = solvers.for_fixed_steps(chosen, dtype, direct=forward)
        explicit = isinstance(scheme, dfx.AbstractERK)
        method = Paced(Explicit(scheme) if explicit else Foreign(scheme))
    problem = Problem(
        ModelField(run.start.packed, run.inputs, run.system, d),
        run.start.x,
        jnp.asarray(run.begin),
        jnp.asarray(run.end),
        jnp.asarray(saved),
        jnp.asarray(ts),
        jnp.asarray(jumps),
        jnp.asarray(rtol, float),
        jnp.asarray(atol, float),
        max_steps,
    )
    problem, d = cast((problem, d), dtype)
    room = FEW_VALUES if traced(problem, d) else VALUES
    log = Log.empty(len(problem.x) + len(d), dtype, values=room)
    jacobian = run.system.state_jacobian
    solved = solve(problem, events, d, method, jacobian, forward=forward, log=log)
    found, c = solved.found, solved.found.counts
    if (why := known(found.why)) is not None and not traced(found.saved):
        _check(run, saved, found, int(why), max_steps, solved.method, isinstance(method, Paced))
    statistics = Statistics(
        solved.method, c.steps, c.rejected, c.rates, c.jacobians, c.corrections, solved.stiff_from
    )
    u = evaluate_all(run.inputs, problem.ts)
    values = cast(run.start, dtype)._replace(t=problem.ts, x=found.saved, u=u, d=found.saved_d)
    return Solution(values, run.system, statistics, found.log, run.inputs)


def _check(
    run: Run,
    ts: Float[np.ndarray, " n"],
    found: Reached,
    why: int,
    max_steps: int,
    name: str,
    has_dt: bool,
) -> None:
    if why == REACHED:
        return run.refuse_broken(found.saved, ts, name)
    reached = float(found.t)
    where = f"The simulation with {name} stopped at t = {reached:g} s, before {run.end:g} s"
    last = _last(run, found)
    at = run.at(found.t, found.x)._replace(d=found.d)
    if why == UNSETTLED:
        assert run.system.events is not None
        places = restless(run.system.events, at)
        circle = listing(map(run.system.describe_discrete, places), 6) or "conditions"
        raise SimulationError(
            f"{where}: at an event {circle} change each other without end{last}. Break the circle by pre(...)."
        )
    if why == CROWDED:
        raise SimulationError(
            f"{where}: events follow each other without end{last}. The model slides along this condition, or bounces "
            "for ever: give it a state of rest, or a hysteresis."
        )
    if reason := run.explain(at, 0.0):
        raise SimulationError(f"{where}{last}.{reason}")
    if why == TOO_SHORT:
        problem = "its values are not finite" if has_dt else "its steps became too small"
        mend = (
            "take a shorter dt, or leave dt out for adaptive steps"
            if has_dt
            else "check its parameters"
        )
        raise SimulationError(
            f"{where}: {problem}{last}. The model diverges there, or is too fast for these steps: {mend}."
        )
    hint = f"It has had {int(found.log.total)} events{last}"
    assert why == EXHAUSTED
    raise StepLimitError(
        f"{where}, after max_steps={max_steps}. {hint}. Perhaps it slides or diverges there; raise max_steps, or "
        "loosen rtol."
    )


def _last(run: Run, found: Reached) -> str:
    """The conditions that changed last."""
    words = list(dict.fromkeys(words for _, words in found.log.conditions(run.system)[-6:]))
    return f" ({'; '.join(words)})" if words else ""
