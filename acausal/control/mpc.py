"""Model predictive control: the inputs that bring a model nearest to its goals, within limits, over a horizon.

A model with trained networks is handed to IPOPT (A. Wächter, L. Biegler, 2006) by CasADi, with exact first and second
derivatives.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Float

import acausal.simulation as simulation
from acausal._jax import check_time, is_number, is_real
from acausal.analysis import parts_of_steps
from acausal.control.goals import Goals, Limits, Weights
from acausal.control.sizes import TypicalSizes, sizes
from acausal.control.transcription import METHODS, NonlinearProgram, program
from acausal.data import Data
from acausal.errors import (
    DataError,
    known_name,
    listing,
    need_compiled,
    need_whole,
    shown,
    warn,
)
from acausal.export import casadi
from acausal.modeling import by_name

if TYPE_CHECKING:
    from acausal.system import System

Course = float | Sequence[float] | Float[np.ndarray, " n"] | Callable[[float], float]
"""A number, one for each sample of the horizon, or a function of time."""

SAME = 1e-9
"""Of a sample time: an end that is so near to a sample is that sample."""


@dataclass(frozen=True, eq=False, repr=False)
class Plan:
    """What a controller intends.

    Attributes:
        t: the samples' times, shape (steps + 1,).
        inputs: by name, from sample to sample, shape (steps,) each.
        states: by name, at the samples, shape (steps + 1,) each.
        variables: those with goals or limits, from the first sample after the start on, shape (steps,) each.
        cost: what was minimised.
        solved: whether IPOPT found an optimum; if not, the plan is the best that it came to.
        status: in its words. seconds: that it took.
    """

    t: Float[np.ndarray, " n"]
    inputs: dict[str, Float[np.ndarray, " steps"]]
    states: dict[str, Float[np.ndarray, " n"]]
    variables: dict[str, Float[np.ndarray, " steps"]]
    cost: float
    solved: bool
    status: str
    seconds: float

    @property
    def first(self) -> dict[str, float]:
        """The inputs to give now."""
        return {name: float(values[0]) for name, values in self.inputs.items()}

    def __repr__(self) -> str:
        now = ", ".join(f"{n} = {v:.4g}" for n, v in self.first.items())
        span = f"{self.t[0]:g} to {self.t[-1]:g} s"
        return f"Plan for {span}: {now}; cost {self.cost:.4g}, {self.status}"


def mpc(
    system: System,
    *,
    dt: float,
    steps: int,
    track: Weights,
    effort: Weights,
    change: Weights | None = None,
    limits: Limits | None = None,
    terminal: float = 1.0,
    params: Mapping[str, Any] | None = None,
    method: str = "collocation",
    max_iterations: int = 200,
) -> MPC:
    """A controller that optimises the inputs of a model over a horizon, again at each sample.

    It minimises, over the samples of the horizon, the weighted squares of what variables are off their references, of
    inputs, and of what inputs change from sample to sample. Inputs are held between samples.

    Arguments:
        system: a compiled model without events and without nonlinear algebraic loops.
        dt: sample time [s]. steps: samples of the horizon.
        track: variables with references, and their weights [1/unit**2].
        effort: the inputs that the controller decides, and their weights, which may be 0. Other inputs are given.
        change: weights of changes of these inputs; 0 for others.
        limits: lowest and highest values of inputs, which hold, and of variables, which hold where they can.
        terminal: how many times the last sample's errors count.
        params: of the model, such as those of a fit; by default its own.
        method: ``"collocation"`` (Radau, for stiff models, too), or ``"rk4"``, in as many equal steps from sample to
            sample as the fastest mode at the start needs.
        max_iterations: of IPOPT for each plan.

    Raises:
        DataError: for names, weights, limits or numbers that do not fit, a model that CasADi cannot express, or if the
            package casadi is not installed.
    """
    need_compiled(system, "control.mpc")
    steps = need_whole(steps, "control.mpc: steps", DataError, 1)
    max_iterations = need_whole(max_iterations, "control.mpc: max_iterations", DataError, 1)
    if not is_number(dt) or not 0 < float(dt) < np.inf:
        raise DataError(f"control.mpc: dt={shown(dt)} is not a sample time; give seconds.")
    known_name(method, METHODS, "control.mpc: there is no method", then=";")
    goals = Goals(
        by_name(track, "control.mpc: track", "weights by name"),
        by_name(effort, "control.mpc: effort", "weights by name"),
        by_name(change, "control.mpc: change", "weights by name"),
        by_name(limits, "control.mpc: limits", "(low, high) by name"),
        terminal,
    )
    goals.check(system)
    if not system.states:
        raise DataError("control.mpc: the model has no states; there is nothing to plan.")
    if system.events is not None:
        raise DataError(
            "control.mpc: the model has events, which IPOPT cannot follow; smooth them (smooth=True of "
            "friction), or give its modes as inputs: ac.compile(model, inputs=[...])."
        )
    given = tuple(n for n in system.inputs if n not in effort)
    order = [(*goals.decided, *given).index(name) for name in system.inputs]
    model = casadi(system, params, outputs=goals.observed)
    n, parts = len(system.states), _parts(system, params, float(dt)) if method == "rk4" else 1
    solver = program(model, goals, order, n, float(dt), steps, method, parts, max_iterations)
    return MPC(system, params, float(dt), steps, goals, given, solver)


def _parts(system: System, params: Mapping[str, Any] | None, dt: float) -> int:
    """How many explicit steps follow the fastest mode of a model at its start within a sample time.

    Raises:
        DataError: if these are too many.
    """
    at = system.start_values(system.pack(params), None, system.input_values(None), 0.0)
    parts = parts_of_steps(system, at, dt)
    if parts is None:
        raise DataError(
            f"control.mpc: method='rk4' is unstable within dt={dt:g} s, as the model has much faster modes; take "
            "'collocation'."
        )
    return parts


class MPC:
    """A model predictive controller; made by `mpc`.

    It remembers its last plan, from which the next one starts: `reset` forgets it.

    Attributes:
        system, params, dt, steps, goals: of the model and the horizon.
        given: names of the inputs that it does not decide.
    """

    def __init__(
        self,
        system: System,
        params: Mapping[str, Any] | None,
        dt: float,
        steps: int,
        goals: Goals,
        given: tuple[str, ...],
        solver: NonlinearProgram,
    ) -> None:
        self.system, self.params, self.dt, self.steps = system, params, dt, steps
        self.goals, self.given = goals, given
        self._program = solver
        self.reset()

    def reset(self) -> None:
        """Forget the last plan, and what was typical: the next one starts where the state stays as it is."""
        self._last: Float[np.ndarray, " n"] | None = None
        self._sent = np.zeros(len(self.goals.decided))
        self._typical: TypicalSizes | None = None

    def step(
        self,
        x: Mapping[str, float] | ArrayLike,
        t: float = 0.0,
        *,
        reference: Mapping[str, Course] | None = None,
        inputs: Mapping[str, Course] | None = None,
        before: Mapping[str, float] | None = None,
    ) -> Plan:
        """The plan from a state on; its ``first`` inputs are to be given until the next sample.

        Arguments:
            x: all states, by name or as an array.
            t: the time [s].
            reference: of tracked variables, at the samples after ``t``; 0 for others.
            inputs: those that the controller does not decide; all of them.
            before: the decided inputs until now, for the weights ``change``; by default those of the last plan, or 0.

        Raises:
            DataError: for a name, number or length that does not fit.

        Warns:
            UserWarning: if IPOPT found no optimum.
        """
        check_time(t)
        goals, state = self.goals, self._state(x)
        times = t + self.dt * np.arange(self.steps + 1)
        goal = self._courses("reference", reference, tuple(goals.track), times[1:], 0.0)
        others = self._courses("inputs", inputs, self.given, times[:-1], None)
        sent = self._sent
        if before is not None:
            sent = self._courses("before", before, goals.decided, times[:1], 0.0)[:, 0]
        problem, last, earlier = self._program, self._last, self._typical
        now = sizes(problem.linearized, goals, state, t, goal, others, self.dt)
        typical, nominal = now.with_earlier(earlier), self.system.nominal
        size = typical.filled(nominal)
        given = np.concatenate([state, [t], sent, goal.ravel("F"), others.ravel("F"), size.numbers])
        if last is None or earlier is None:
            start = problem.start(state, size)
        else:
            start = problem.shifted(last, earlier.filled(nominal), size)
        began = time.perf_counter()
        found = problem.solve(x0=start, p=given, **problem.bounds(size))
        seconds = time.perf_counter() - began
        stats = problem.solve.stats()
        solved, status = bool(stats["success"]), str(stats["return_status"]).replace("_", " ")
        best = np.asarray(found["x"]).ravel()
        best = best if np.isfinite(best).all() else start
        u, ends, seen = (np.asarray(part) for part in problem.read(best, given))
        self._last, self._sent = best if solved else None, u[:, 0]
        self._typical = typical
        if not solved:
            warn(
                f"The controller found no optimum at t = {t:g} s ({status}): check limits and weights, or take a "
                "shorter horizon."
            )
        return Plan(
            times,
            dict(zip(goals.decided, u, strict=True)),
            dict(zip(self.system.states, ends, strict=True)),
            dict(zip(goals.observed, seen, strict=True)),
            float(found["f"]) * float(size.cost),
            solved,
            status,
            seconds,
        )

    def run(
        self,
        plant: System,
        until: float,
        *,
        x0: Mapping[str, float] | ArrayLike | None = None,
        reference: Mapping[str, Course] | None = None,
        inputs: Mapping[str, Course] | None = None,
        params: Mapping[str, Any] | None = None,
        observe: Sequence[str] = (),
    ) -> Data:
        """The closed loop with a plant, which may be another model: a record at the samples, decided inputs held.

        Arguments:
            plant: a compiled model with the states and decided inputs of this one, by their names.
            until: the end [s], or the first sample behind it; the loop starts at 0.
            x0: the plant's states at the start; by default its own.
            reference, inputs: as in `step`, numbers or functions of time. Plans hold these inputs between samples; the
                plant has them as they are.
            params: of the plant; by default its own, and those of the controller where the plant is its model.
            observe: further variables of the plant for the record.

        Raises:
            DataError: if the plant lacks a state or an input, or its events remember something.
            SimulationError: as `acausal.simulate`.
        """
        need_compiled(plant, "MPC.run")
        if not is_number(until) or not 0 < float(until) < np.inf:
            raise DataError(f"MPC.run: until={shown(until)} is not a time; give seconds.")
        self.reset()
        if params is None and plant is self.system:
            params = self.params
        lacking = [n for n in self.system.states if n not in plant.variables]
        lacking += [n for n in self.system.inputs if n not in plant.inputs]
        if lacking:
            raise DataError(f"MPC.run: the plant has no {listing(lacking)}.")
        if plant.remembered:
            raise DataError(
                f"MPC.run: the plant remembers {listing(plant.remembered)} between samples, which a new simulation "
                "would forget: make the loop with an exported FMU."
            )
        for what, courses in (("reference", reference), ("inputs", inputs)):
            if several := [
                n for n, c in (courses or {}).items() if not (callable(c) or is_number(c))
            ]:
                raise DataError(
                    f"MPC.run: {what} of {listing(several)} are neither numbers nor functions of time."
                )
        wanted = [*plant.states, *self.system.states, *self.goals.observed, *observe]
        names = [n for n in dict.fromkeys(wanted) if n in plant.variables]
        given: dict[str, Any] = dict(inputs or {})
        moving = {n: course for n, course in given.items() if callable(course)}
        u = plant.inputs_at(0.0, given)
        state = np.asarray(plant.initial_state(params, x0, inputs=u))
        own = plant.observe(self.system.states, 0.0, state, u, params or plant.parameters())
        rows: list[dict[str, float]] = []
        for k in range(int(np.ceil(until / self.dt - SAME)) + 1):
            t = k * self.dt
            plan = self.step(np.asarray(own), t, reference=reference, inputs=inputs)
            u = plant.inputs_at(t, {**given, **plan.first})
            held = dict(zip(plant.inputs, u.tolist(), strict=True))
            span = t, t + self.dt
            run = simulation.simulate(
                plant, span, saveat=span, x0=state, inputs={**held, **moving}, params=params
            )
            found = {n: np.asarray(run[n]) for n in names}
            rows.append({**{n: float(found[n][0]) for n in names}, **held})
            state, own = (
                np.array([found[n][-1] for n in each])
                for each in (plant.states, self.system.states)
            )
        columns = {n: np.array([row[n] for row in rows]) for n in rows[0]}
        kept = {n: "previous" for n in plant.inputs if n not in moving}
        return Data(self.dt * np.arange(len(rows)), columns, interpolation=kept)

    def _state(self, x: Mapping[str, float] | ArrayLike) -> np.ndarray:
        names = self.system.states
        if isinstance(x, Mapping) and (lacking := [n for n in names if n not in x]):
            raise DataError(f"MPC.step: x lacks {listing(lacking)}; give all states.")
        values: Any = [x[n] for n in names] if isinstance(x, Mapping) else x
        state = np.asarray(values, float) if is_real(values) else np.array(np.nan)
        if state.shape != (len(names),) or not np.isfinite(state).all():
            raise DataError(
                f"MPC.step: x={shown(x)} are not the {len(names)} states ({', '.join(names)})."
            )
        return state

    def _courses(
        self, argument: str, given: Mapping[str, Course] | None, names: Sequence[str],
        times: Float[np.ndarray, " n"], default: float | None,
    ) -> Float[np.ndarray, "n_names n"]:  # fmt: skip
        given = by_name(given, f"MPC.step: {argument}", "values by name")
        for name in given:
            known_name(name, names, f"MPC.step: {argument}:", then=" is none of them;")
        if default is None and (lacking := [n for n in names if n not in given]):
            raise DataError(
                f"MPC.step: {argument} lacks {listing(lacking)}, which nothing decides."
            )

        def course(name: str) -> Float[np.ndarray, " n"]:
            value = given.get(name, default)
            if callable(value):
                value = [value(float(t)) for t in times]
            column = np.asarray(value, float) if is_real(value) else np.array(np.nan)
            if column.shape not in ((), times.shape) or not np.isfinite(column).all():
                raise DataError(
                    f"MPC.step: {argument} of '{name}' is {shown(value)}; give a number, one for each of the "
                    f"{len(times)} samples, or a function of time."
                )
            return np.broadcast_to(column, times.shape)

        return np.array([course(n) for n in names]).reshape(len(names), len(times))
