"""Simulation by the loop of steps: adaptive ones, and fixed ones of models with events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import diffrax as dfx
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import array, cast, is_real, known, traced
from acausal.codegen import Field, Packed
from acausal.errors import DataError, SimulationError, StepLimitError, listing, shown
from acausal.events import Ahead, non_converged
from acausal.simulation import solvers
from acausal.simulation.finite import warn_of_undefined
from acausal.simulation.inputs import TimeFunction, breaks, evaluate, evaluate_all
from acausal.simulation.log import FEW_VALUES, VALUES, Log
from acausal.simulation.run import Run
from acausal.simulation.solution import Solution
from acausal.simulation.statistics import Statistics
from acausal.simulation.steps.loop import CHATTERS, EXHAUSTED, NOT_CONVERGED, REACHED, LoopResult
from acausal.simulation.steps.methods import paced
from acausal.simulation.steps.problem import EDGE_STEPS, Integration, RightHandSide
from acausal.simulation.steps.solve import FirstRun, Solved, begin_to_compile, first_run, solve

Tolerance = float | Array

REST = "The model slides along this condition, or bounces for ever: give it a state of rest, or a hysteresis."
"""What to do where events follow each other without end."""


class ModelField(RightHandSide):
    """The right-hand side for inputs that are functions of time.

    Attributes:
        packed: parameters.
        inputs: functions of time.
        system, d, until: see `RightHandSide`.
    """

    packed: Packed
    inputs: tuple[TimeFunction, ...]

    def ahead(self, t: Array, apart: Array) -> Ahead:
        """The next of these times."""
        return self.system.edges.ahead(self.packed, t, apart, self.d)

    def at(self, t: Array) -> Field:
        """It at one time."""
        return self.system.field(t, evaluate(self.inputs, t, self.until), self.packed, self.d)


@dataclass(frozen=True)
class InSteps:
    """Simulation in steps that end where an input is known to jump, and at events.

    Attributes:
        saved: times to save.
        solver: a solver with an error estimate, or of fixed steps; ``None``: Tsit5, and a stiff method from where the
            model is stiff.
        rtol: relative tolerance of a step.
        atol: absolute tolerance, in the states' units.
        max_steps: limit of steps.
        dtype: precision of time and states.
        ends: of fixed steps of a model with events; by default, steps follow their errors.
        forward: allow derivatives in forward mode only, of any order.
        max_step: the longest step in seconds; None: as their errors allow.
    """

    saved: Float[np.ndarray, " n"]
    solver: solvers.Solver | None
    rtol: Tolerance
    atol: Tolerance
    max_steps: int
    dtype: np.dtype[Any]
    ends: Float[np.ndarray, " n_ends"] | None = None
    forward: bool = False
    max_step: float | None = None

    def begin_to_compile(self, run: Run) -> None:
        """Begin to compile what `simulate` will run, whatever the values at the start are."""
        begin_to_compile(self._posed(run))

    def simulate(self, run: Run) -> Solution:
        """Simulate.

        Raises:
            SimulationError: if the end is not reached.
        """
        posed = self._posed(run)
        solved = solve(posed)
        found, c = solved.found, solved.found.counts
        x, saved_d = found.saved
        if (why := known(found.why)) is not None and not traced(x):
            if int(why) == REACHED:
                run.refuse_broken(x, self.saved, solved.method)
                _refuse_without_end(run, found, solved.method)
            else:
                has_dt = self.ends is not None
                explicit = self.solver is not None and not int(c.jacobians)
                most = posed.problem.max_steps if has_dt else self.max_steps
                raise _stopped(run, solved, int(why), most, has_dt, explicit)
        own = c.steps, c.rejected, c.rates, c.jacobians, c.corrections, solved.stiff_from
        statistics = Statistics(solved.method, *own, c.edges, c.by_wave, c.by_span, c.looks)
        ts = posed.problem.ts
        values = cast(run.start, self.dtype)._replace(t=ts, x=x, d=saved_d)
        values = values._replace(u=evaluate_all(run.inputs, ts))
        undefined = known(c.undefined)
        if undefined is not None and np.ndim(undefined) == 0 and int(undefined):
            warn_of_undefined(run.system, values, int(undefined))
        inputs = None if found.log is None else run.inputs
        return Solution(values, run.system, statistics, found.log, inputs)

    def _posed(self, run: Run) -> FirstRun:
        ts, jumps = breaks(run.inputs, run.begin, run.end)
        method: Any = self.solver
        max_steps, max_step = self.max_steps + EDGE_STEPS * len(ts), self.max_step
        if self.ends is not None:
            inner = np.union1d(ts, self.ends[1:-1])
            ts, jumps = inner, np.isin(inner, ts[jumps])
            max_steps, max_step = max(max_steps, 20 * len(self.ends)), None
            chosen = dfx.Tsit5() if self.solver is None else self.solver
            scheme = solvers.for_fixed_steps(chosen)
            method = paced(scheme, run.system.state_jacobian, self.dtype)
        problem = Integration(
            ModelField(run.start.packed, run.inputs, system=run.system, d=run.start.d),
            run.start.x,
            array(run.begin),
            array(run.end),
            array(self.saved),
            array(ts),
            array(jumps, bool),
            array(self.rtol),
            array(self.atol),
            max_steps,
            events=run.system.events,
            max_step=None if max_step is None else array(max_step),
            forward=self.forward,
        )
        problem, d = cast((problem, run.start.d), self.dtype)
        log = None
        if d is not None:
            room = FEW_VALUES if traced(problem, d) else VALUES
            log = Log.empty(len(problem.x) + len(d), self.dtype, values=room)
        return first_run(problem, method, d=d, log=log)


def _stopped(
    run: Run, solved: Solved, why: int, max_steps: int, has_dt: bool, explicit: bool
) -> SimulationError:
    """Why a run stopped short of its end."""
    found = solved.found
    reached = float(found.t)
    where = (
        f"The simulation with {solved.method} stopped at t = {reached:g} s, before {run.end:g} s"
    )
    last, events = _last(run, found), run.system.events
    at = run.at(found.t, found.x)._replace(d=found.d)
    if why == NOT_CONVERGED and events is not None:
        places = non_converged(events, at)
        circle = listing(map(run.system.describe_discrete, places), 6) or "conditions"
        advice = "Break the circle by pre(...)."
        from acausal.fmu import HISTORY  # nothing else of a simulation needs the room

        if HISTORY in circle:
            advice = "An FMU is part of this circle: delay a signal to it, or use it by co-simulation, kind='cs'."
        return SimulationError(
            f"{where}: at an event {circle} change each other without end{last}. {advice}"
        )
    if why == CHATTERS:
        return SimulationError(f"{where}: events follow each other without end{last}. {REST}")
    ahead = (run.end - run.begin) / max_steps if why == EXHAUSTED else run.end - reached
    reason = run.explain(at, 0.0 if found.log is not None else ahead)
    if reason := reason or ("" if why == EXHAUSTED else run.said()):
        return SimulationError(f"{where}{last}.{reason}")
    if why != EXHAUSTED and has_dt:
        return SimulationError(
            f"{where}: its values are not finite{last}. The model diverges there, or is too fast for these steps: take "
            "a shorter dt, or leave dt out for adaptive steps."
        )
    if why != EXHAUSTED:
        loops = [name for name, _ in run.system.reduced.solved_positions]
        dead = (
            f" Or a loop passes a dead point of its states, from which {listing(loops, 3)} follow: prefer none of its "
            "joints (stateSelect), then all are states."
        )
        return SimulationError(
            f"{where}: its steps became too small, or its values not finite{last}. The model may diverge there: check "
            f"its parameters, initial values and inputs.{dead if loops else ''}"
        )
    slides = "" if found.log is None else f"It has had {int(found.log.total)} events{last}. "
    if jump := run.explain_jump(at, ahead):
        return StepLimitError(
            f"{where}, after max_steps={max_steps}. {slides}There {jump}. If the model slides along this jump, "
            "give it a hysteresis, or a smooth transition; else raise max_steps, or loosen rtol."
        )
    hint = "it is stiff (choose solver='auto' or 'stiff'), " if explicit else ""
    return StepLimitError(
        f"{where}, after max_steps={max_steps}. {slides}Perhaps {hint}it slides or diverges there, or its inputs are "
        "rough (raise max_steps, loosen rtol, or give dt for fixed steps)."
    )


def _refuse_without_end(run: Run, found: LoopResult, method: str) -> None:
    """Refuse a run that has gone on behind events that followed each other without end.

    Raises:
        SimulationError: for it.
    """
    events, log = run.system.events, found.log
    if events is not None and log is not None and (last := log.without_end(run.end - run.begin)):
        t, condition = last[0], events.describe(last[1])
        raise SimulationError(
            f"The simulation with {method} cannot go on behind t = {t:.9g} s: events follow each other without end "
            f"({condition}). {REST}"
        )


def _last(run: Run, found: LoopResult) -> str:
    """The conditions that changed last."""
    if found.log is None:
        return ""
    words = list(dict.fromkeys(words for _, words in found.log.conditions(run.system)[-6:]))
    return f" ({'; '.join(words)})" if words else ""


def check_tolerances(rtol: Tolerance, atol: Tolerance, n_states: int) -> None:
    """Refuse tolerances with which no step can be accepted.

    Raises:
        DataError: for one that is negative or not a finite number, nor one such number for each state; or where the
            absolute one is zero: a state that is zero could have no error.
    """
    for name, given in {"rtol": rtol, "atol": atol}.items():
        if not _is_tolerance(given, n_states):
            raise DataError(
                f"{name}={shown(given)} is not a tolerance; give a positive number, such as {name}=1e-6, or an array "
                "of one for each state."
            )
    if not (traced(atol) or np.all(atol)):
        raise DataError(
            "atol=0 allows a state that is zero no error, so that no step is accepted; give a small number, such as "
            "atol=1e-12."
        )


def _is_tolerance(given: Tolerance, n_states: int) -> bool:
    """Whether this is a finite number, or an array of these, none below zero where they are known."""
    if not is_real(given) or isinstance(given, list | tuple):
        return False
    if np.shape(given) not in ((), (n_states,)):
        return False
    return traced(given) or bool((np.isfinite(given) & (np.asarray(given) >= 0)).all())
