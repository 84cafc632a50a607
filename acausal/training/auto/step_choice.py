"""The method and length of steps, by measurement: their error stays below a tenth of what the noise leaves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from acausal.data import Data
from acausal.simulation import for_fixed_steps, solver_named
from acausal.training.objective.losses import LEAST
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.options import FitOptions

ORDER = {"heun": 2, "rk4": 4, "kvaerno3": 3}
MANY = 10_000
"""Rows from which on a method of second order is tried, which takes half of the time."""

SHARE = 0.1
"""The largest error, relative to the noise."""

FINEST = 32
"""Steps between two samples at most."""


class StepChoice(NamedTuple):
    """How a training integrates.

    Attributes:
        solver: its name; ``None`` where the user has chosen.
        parts: steps from sample to sample.
        error: of the steps, relative to the targets' deviation; NaN where it was not measured.
    """

    solver: str | None
    parts: int = 1
    error: float = float("nan")

    def of(self, options: FitOptions, data: Mapping[str, Data]) -> FitOptions:
        """The options with these steps."""
        if self.solver is None:
            return options
        usual = float(np.median(np.concatenate([np.diff(d.time) for d in data.values()])))
        dt = options.dt if self.parts == 1 else usual / self.parts
        return replace(options, solver=self.solver, dt=dt)

    def over(self, problem: Problem) -> Problem:
        """A problem with these steps."""
        assert self.solver is not None
        scheme = for_fixed_steps(solver_named(self.solver, fixed=False))
        return replace(problem, solver=scheme).in_parts(self.parts)


def allowed_error(loss: float) -> float:
    """The largest error of steps beside a loss, or beside that of the noise."""
    return SHARE * max(loss, LEAST)


def tried_steps(options: FitOptions, events: bool) -> Iterator[StepChoice]:
    """The steps with which a start is sought, until one explains something; a user's own are the only ones.

    In a model with events they are implicit: what it switches is often stiff, as an ideal diode that blocks is, and
    explicit steps would stumble from event to event.
    """
    given = (options.solver, options.rtol, options.atol)
    if any(value is not None for value in given):
        yield StepChoice(None)
        return
    if not events:
        yield StepChoice("rk4")
    if events or options.dt is None:
        yield StepChoice("kvaerno3")


def chosen_steps(
    step: StepChoice,
    problem: Problem,
    trainable: Trainable,
    noise: float | None,
    options: FitOptions,
) -> StepChoice:
    """The steps whose error is small enough, for some state of the training."""
    if step.solver is None or options.dt is not None:
        return step
    allowed = allowed_error(noise or 0.0)
    coarse = np.asarray(problem.simulate(trainable).y)

    def rough(solver: str, exact: np.ndarray) -> float:
        scheme = for_fixed_steps(solver_named(solver, fixed=False))
        found = replace(problem, solver=scheme).simulate(trainable)
        return difference(problem, np.asarray(found.y), exact)

    if problem.system.events is not None and (error := rough("rk4", coarse)) <= allowed:
        return StepChoice("rk4", 1, error)
    fine = np.asarray(problem.finer().simulate(trainable).y)
    error = difference(problem, coarse, fine)
    if not np.isfinite(error):
        return step
    order = ORDER[step.solver]
    if error > allowed:
        parts = int(np.ceil((error / allowed) ** (1 / order)))
        parts = min(1 << (parts - 1).bit_length(), FINEST)
        return StepChoice(step.solver, parts, error / parts**order)
    long = len(problem.records) >= MANY // 4 and step.solver == "rk4"
    if long and (of_heun := rough("heun", fine)) <= allowed:
        return StepChoice("heun", 1, of_heun)
    return step._replace(error=error)


def finer_steps(step: StepChoice, error: float, loss: float) -> StepChoice | None:
    """Finer steps, where those of a training err by more than they may beside its loss; else ``None``.

    A law is often steeper than the linear one along which steps were chosen. Where very many were needed, they are
    implicit.
    """
    allowed = allowed_error(loss)
    if step.solver is None or not allowed < error < np.inf:
        return None
    more = 2 * (error / allowed) ** (1 / ORDER[step.solver])
    parts = step.parts * (1 << (int(np.ceil(more)) - 1).bit_length())
    if parts > FINEST:
        return StepChoice("kvaerno3", step.parts)
    return StepChoice("rk4" if step.solver == "heun" else step.solver, parts)


def difference(problem: Problem, one: np.ndarray, other: np.ndarray) -> float:
    """The root mean square difference of predictions, as the loss counts it."""
    counts = np.asarray(problem.records.weight) > 0
    with np.errstate(all="ignore"):
        squares = np.where(counts, (one - other) / np.asarray(problem.records.sigma), 0.0) ** 2
        return float(np.sqrt(np.sum(squares.sum(axis=0) / np.maximum(counts.sum(axis=0), 1))))
